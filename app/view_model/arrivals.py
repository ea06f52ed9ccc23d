"""Curves that come from elsewhere: in the unit of the document, and where the pointer is."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

import msgspec
import numpy as np
from msgspec.structs import replace

from ..document.curve_edits import with_each
from ..document.curve_tree import Container
from ..document.model import Curve, Document, Vector
from ..document.several_curves import add_curves, mapped, moved, whole_curves
from ..document.shape_edits import place_above
from ..document.shapes import shape_of
from ..document.transforms import scaling
from .curve_view import view_of


class Arrival(msgspec.Struct, frozen=True):
    """A document with curves that were added to it.

    Attributes
    ----------
    document
        The document.
    places
        Where they are in it.
    """

    document: Document
    places: range


def with_curves(document: Document, curves: Sequence[Curve], active: int) -> Arrival:
    """Add curves in front of the active one, visible and free, under names of their own.

    They come in front of the shape and the groups that it is in, and are in none of them. A lone curve
    without points is what a new document begins with; it gives way.
    """
    is_blank = len(document.curves) == 1 and not document.curves[0].points
    first = 0 if is_blank else place_above(document, active)
    base = replace(document, curves=()) if is_blank else document
    return Arrival(add_curves(base, curves, first), range(first, first + len(curves)))


def with_part(document: Document, part: Curve, active: int) -> Arrival:
    """Add a part of the active curve in front of it and its shape, in the same groups."""
    first = shape_of(document, active).stop
    added = add_curves(document, (part,), first, Container(part.groups))
    return Arrival(added, range(first, first + 1))


def scaled(document: Document, curves: Collection[int], factor: float) -> Document:
    """Return the document with some of its curves, and the width of their lines, so many times as large."""
    if factor == 1.0:
        return document
    larger = mapped(document, whole_curves(document, curves), scaling(factor, factor, (0.0, 0.0)))
    return with_each(larger, curves, lambda curve: _with_line(curve, factor))


def _with_line(curve: Curve, factor: float) -> Curve:
    width = curve.style.width
    return curve if width is None else replace(curve, style=replace(curve.style, width=width * factor))


def centred_at(document: Document, curves: Collection[int], place: Vector, pixel: float) -> Document:
    """Return the document with some of its curves moved so that their middle is at a place.

    It is there to a `pixel`, by a clean number: the coordinates get no digits that nobody sees.
    """
    middle = _middle_of([document.curves[curve] for curve in sorted(curves)])
    if middle is None or not all(map(math.isfinite, (*place, *middle))):
        return document
    decimals = -math.floor(math.log10(pixel))
    across, up = (round(to - at, decimals) for to, at in zip(place, middle, strict=True))
    return moved(document, whole_curves(document, curves), (across, up))


def _middle_of(curves: Sequence[Curve]) -> Vector | None:
    """Return the middle of the box around curves; None where there is no point."""
    boxes = [view_of(curve).extent[1] for curve in curves if curve.points]
    if not boxes:
        return None
    low, high = np.min(boxes, axis=(0, 1)), np.max(boxes, axis=(0, 1))
    x, y = (low + (high - low) / 2).tolist()
    return x, y
