"""Base class of the drags, and the little geometry that they share."""

from __future__ import annotations

import msgspec

from ..document.model import Document, Vector
from ..view_model.curve.curve_view import CurveView
from .pointer import Pointer


class Drag(msgspec.Struct, frozen=True):
    """A drag: the document at a place of the pointer.

    Attributes
    ----------
    document
        The document at the press, which every place of the pointer changes anew.
    """

    document: Document

    @property
    def name(self) -> str:
        """The name of the step in the history."""
        raise NotImplementedError

    @property
    def scrolls(self) -> bool:
        """Whether the view moves on where it comes to the edge."""
        return True

    def name_at(self, pointer: Pointer) -> str:
        """Return the name of the step that ends here."""
        return self.name

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, for the status line."""
        return ""

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document for this position, computed from the press, never from the last move."""
        raise NotImplementedError

    def readout(self, pointer: Pointer) -> str:
        """Return the amount, such as "Rotate 30°"; empty where none is told."""
        return ""

    @property
    def refusal(self) -> str:
        """Why it cannot end now with a change; empty where it can."""
        return ""

    @property
    def remark(self) -> str:
        """What was meant, too, and stays as it is; empty for nothing."""
        return ""

    def about(self, pointer: Pointer) -> Vector | None:
        """Return what it rotates or skews about, None where it does neither."""
        return None

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return where the point is that is held, None where none is."""
        return None


class CurveDrag(Drag, frozen=True):
    """A drag that changes one curve.

    Attributes
    ----------
    curve
        Its place in the document.
    view
        Its view at the press.
    """

    curve: int
    view: CurveView


def minus(a: Vector, b: Vector) -> Vector:
    """Return the way from `b` to `a`."""
    return (a[0] - b[0], a[1] - b[1])


def plus(a: Vector, b: Vector) -> Vector:
    """Return where a way `b` from `a` leads."""
    return (a[0] + b[0], a[1] + b[1])


def longer_axis(way: Vector) -> int:
    """Return the axis, 0 or 1, that a way goes along further."""
    return 0 if abs(way[0]) >= abs(way[1]) else 1


def axis_held(way: Vector, pointer: Pointer) -> int | None:
    """Return the axis that a way is kept to by a key that is held, None while none is."""
    return longer_axis(way) if pointer.holds_line else None


def along_axis(way: Vector, axis: int | None) -> Vector:
    """Return the part of a way along one axis, all of it for None."""
    return way if axis is None else (way[0], 0.0) if axis == 0 else (0.0, way[1])
