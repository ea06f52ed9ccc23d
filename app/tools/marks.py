"""Marks of a gesture over the drawing: a value that the canvas draws."""

from __future__ import annotations

import msgspec

from ..document.model import Vector
from ..view_model.curve.curve_view import CurveView
from .box import TransformBox
from .snapping import Snap


class Note(msgspec.Struct, frozen=True):
    """A few words beside a position.

    Attributes
    ----------
    work
        The middle of the selection: the words stand on the other side.
    """

    position: Vector
    text: str
    work: Vector


class Ruler(msgspec.Struct, frozen=True):
    """A measured distance."""

    start: Vector
    end: Vector
    text: str


class Marks(msgspec.Struct, frozen=True):
    """All marks over the plot at once; None for those that are not drawn.

    A gesture or a tool returns them, ``Marks(band=(corner, opposite))``, and the canvas draws them.

    Attributes
    ----------
    band
        Two opposite corners of the rubber band.
    box, frame
        The box with grips around the selected points; the box without them, while they are dragged.
    pivot
        The position that is rotated, scaled and mirrored about.
    pivot_box
        The box that it is the middle of, where it was not set: without room there it is not drawn.
    snap
        The snap of the pointer.
    ruler
        The measured distance.
    note
        The amount of a transform, beside the pointer.
    axis
        A position on the locked axis, or on the mirror line, and its direction.
    preview_curve
        The curve as it would be with a point where the pen is.
    spot
        Where on the curve the pen would insert a point; the point of another curve under the pointer.
    line
        The line that the pencil has drawn so far.
    replaced
        The part of the curve that this line would replace.
    waiting
        Lines from which curves are being computed.
    guide
        Index of the guide under the pointer, or of the one that is dragged.
    """

    band: tuple[Vector, Vector] | None = None
    box: TransformBox | None = None
    frame: TransformBox | None = None
    pivot: Vector | None = None
    pivot_box: TransformBox | None = None
    snap: Snap | None = None
    ruler: Ruler | None = None
    note: Note | None = None
    axis: tuple[Vector, Vector] | None = None
    preview_curve: CurveView | None = None
    spot: Vector | None = None
    line: tuple[Vector, ...] = ()
    replaced: tuple[Vector, ...] = ()
    waiting: tuple[tuple[Vector, ...], ...] = ()
    guide: int | None = None
