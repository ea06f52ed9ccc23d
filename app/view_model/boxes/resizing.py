"""Points and curves given a width or a height, about a place that stays."""

from __future__ import annotations

from collections.abc import Sequence

from ...document.edits import EditError
from ...document.model import Document, Vector
from ...document.point_group import PointGroup
from ...document.transforms import scaling
from ..curve.curve_view import CurveView
from .bounds import bounds_of
from .stretch import stretched

SIDES = ("width", "height")
"""What a length along x and along y is called."""


def resized(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    axis: int,
    length: float,
    about: Vector,
    *,
    keeps_proportions: bool = False,
) -> Document:
    """Return the document with a group whose box is `length` wide (axis 0) or high about a place.

    With `keeps_proportions` the other side goes along.

    Raises
    ------
    EditError
        If that side has no length, or is to have none.
    """
    bounds = bounds_of(views, group)
    if bounds is None:
        return document
    if not bounds.size[axis]:
        raise EditError(f"What has no {SIDES[axis]} cannot be given one.")
    if length <= 0.0:
        raise EditError(f"A {SIDES[axis]} is greater than 0; Flip mirrors.")
    factor, even = length / bounds.size[axis], axis if keeps_proportions else None
    x, y = (factor if keeps_proportions or each == axis else 1.0 for each in (0, 1))
    by = scaling(x, y, about)
    corners = by.point(bounds.low), by.point(bounds.high)
    return stretched(document, views, group, corners, even=even, about=about)
