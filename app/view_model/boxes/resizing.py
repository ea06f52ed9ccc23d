"""Points and curves given a width or a height, about a place that stays."""

from __future__ import annotations

from collections.abc import Sequence

from ...document.edits import EditError
from ...document.model import Document, Vector
from ...document.point_group import PointGroup
from ...document.transforms import scaling
from ...document.words import number
from ..curve.curve_view import CurveView
from .bounds import BARE, Strokes, bounds_of
from .stretch import stretched

SIDES = ("width", "height")
"""What a length along x and along y is called."""


def resized(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    axis: int,
    length: float,
    strokes: Strokes,
    about: Vector,
    *,
    keeps_proportions: bool = False,
) -> Document:
    """Return the document with a group whose box is `length` wide (axis 0) or high about a place.

    With `keeps_proportions` the other side goes along.

    Raises
    ------
    EditError
        If that side has no length, or is to be no longer than strokes that shall not scale.
    """
    bounds, bare = bounds_of(views, group, strokes), bounds_of(views, group, BARE)
    if bounds is None or bare is None:
        return document
    if not bare.size[axis]:
        raise EditError(f"What has no {SIDES[axis]} cannot be given one.")
    _refuse_length(document, length, axis, bounds.size[axis] - bare.size[axis], strokes)
    factor, even = length / bounds.size[axis], axis if keeps_proportions else None
    x, y = (factor if keeps_proportions or each == axis else 1.0 for each in (0, 1))
    by = scaling(x, y, about)
    corners = by.point(bounds.low), by.point(bounds.high)
    return stretched(document, views, group, corners, strokes, even=even, about=about)


def _refuse_length(document: Document, length: float, axis: int, thickness: float, strokes: Strokes) -> None:
    """Refuse a length along an axis along which strokes are so thick, where it is none that can be had."""
    if length <= 0.0:
        raise EditError(f"A {SIDES[axis]} is greater than 0; Flip mirrors.")
    if length <= thickness and not strokes.scaled:
        taken = f"{number(thickness, 6)} {document.unit}".rstrip()
        raise EditError(f"The strokes alone take {taken}; let them scale, or measure without.")
