"""Points and curves made to fill a box: exactly, also where the curve changes its shape.

Where a rule gives the parameters by the distances of the points, or estimates by their coordinates, a curve
whose points are stretched along one axis is not the stretched curve. The stretch is then corrected by the
resulting bounds, along secants through the last ones, until they fill the box.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..document.limits import EditError
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.several_curves import transform_group
from ..document.transforms import Affine, scaling
from .boxes import Bounds, bounds_of, is_whole
from .curve.curve_view import CurveView, view_of

_NEGLIGIBLE = 1e-10
"""Share of the largest change of a residual below which other changes are ignored."""


class Secants:
    """Fixed-point iteration x = g(x) with steps along secants (Anderson's mixing).

    Where g is smooth, ten such steps come as close as forty plain ones, and they also converge where plain
    steps oscillate.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._tried: list[tuple[FloatArray, FloatArray]] = []

    def after(self, x: FloatArray, image: FloatArray) -> FloatArray:
        """Return the next x to try, given the image g(x) of `x`."""
        self._tried = [*self._tried[-self._most :], (x, image)]
        if len(self._tried) == 1:
            return image
        xs, images = (np.array(values) for values in zip(*self._tried, strict=True))
        residuals = images - xs
        weights, *_ = np.linalg.lstsq(np.diff(residuals, axis=0).T, residuals[-1], rcond=_NEGLIGIBLE)
        return np.asarray(image - weights @ np.diff(images, axis=0))

    def forget(self) -> None:
        """Start again, where the last steps led away from the solution."""
        self._tried = []


Corners = tuple[Vector, Vector]
"""Images of the lower left and of the upper right corner of a box; a mirrored box has them exchanged."""

_ROUNDS = 40
_ROUNDING = 2.0**-50
"""Share of the largest coordinate within which bounds are computed."""

_IN_VAIN, _NEAR = 5, 1e-9
"""Rounds that do not halve the deviation before the search ends, and the share of the coordinates below which
a deviation is noise: bounds of curves that swing wildly are not known better.
"""


def stretched(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    corners: Corners,
    *,
    even: int | None = None,
    about: Vector | None = None,
    tolerance: float = 0.0,
) -> Document:
    """Return the document with a group stretched so that its bounds have given corners.

    Parameters
    ----------
    document, views
        The document, and the views of its curves.
    corners
        The new positions of the corners.
    even
        The axis, for a stretch with proportions kept, along which the corners count; along the other the
        position `about` keeps its share of the box.
    tolerance
        Largest deviation of the bounds; rounding is always allowed.
    """
    before = _measured(views, group)
    goal = _goal_of(corners, even, about)
    aim = goal.aimed(before, corners)
    plain = between(before, aim)
    is_similar = even is not None or abs(plain.xx) == abs(plain.yy)
    if tolerance and (is_similar or all(_follows(views, *part) for part in group.parts)):
        return transform_group(document, group, plain)
    largest = max(abs(value) for corner in (*corners, before.low, before.high) for value in corner)
    enough = max(tolerance, _ROUNDING * largest)
    best, least, secants, vain = document, math.inf, Secants(4), 0
    for _ in range(_ROUNDS):
        changed = transform_group(document, group, between(before, aim))
        reached = _measured(_views_of(changed, views, group), group)
        wanted = goal.from_(reached)
        off = _distance(reached, wanted)
        vain = vain + 1 if off > least / 2.0 else 0
        if off < least:
            best, least = changed, off
        if off <= enough or (vain == _IN_VAIN and least <= _NEAR * largest):
            break
        corrected = _corrected(aim[0], reached, wanted), _corrected(aim[1], reached, wanted)
        aim = _next_aim(secants, aim, corrected)
    return best


def _next_aim(secants: Secants, aim: Corners, corrected: Corners) -> Corners:
    """Return the next corners to try: along secants, unless these would mirror the box."""
    left, bottom, right, top = secants.after(np.ravel(aim), np.ravel(corrected)).tolist()
    (x, y), (end_x, end_y) = corrected
    if (right - left) * (end_x - x) < 0.0 or (top - bottom) * (end_y - y) < 0.0:
        secants.forget()
        return corrected
    return (left, bottom), (right, top)


class _Goal(msgspec.Struct, frozen=True):
    """The box to be filled.

    Attributes
    ----------
    box
        The box.
    even
        The axis along which it is filled where proportions are kept; None for both axes.
    share
        The fixed point along the other axis: from 0, the low end of the box, to 1.
    """

    box: Bounds
    even: int | None
    share: float

    def aimed(self, before: Bounds, corners: Corners) -> Corners:
        """Return the new corners, if curves change as their points do."""
        bounds = self.from_(before)
        x, y = (-1 if corners[1][axis] < corners[0][axis] else 1 for axis in (0, 1))
        return bounds.position(-x, -y), bounds.position(x, y)

    def from_(self, now: Bounds) -> Bounds:
        """Return the bounds that fill the box, with the present proportions where they are kept."""
        if self.even is None:
            return self.box
        length, other = self.box.size[self.even], 1 - self.even
        factor = length / now.size[self.even] if now.size[self.even] else 1.0
        size = factor * now.size[other]
        low, high = list(self.box.low), list(self.box.high)
        low[other] += self.share * (self.box.size[other] - size)
        high[other] = low[other] + size
        return Bounds((low[0], low[1]), (high[0], high[1]))


def _goal_of(corners: Corners, even: int | None, about: Vector | None) -> _Goal:
    box, other = _in_order(corners), 0 if even is None else 1 - even
    if about is None or not box.size[other]:
        return _Goal(box, even, 0.5)
    return _Goal(box, even, (about[other] - box.low[other]) / box.size[other])


def _measured(views: Sequence[CurveView], group: PointGroup) -> Bounds:
    bounds = bounds_of(views, group)
    assert bounds is not None
    return bounds


def _follows(views: Sequence[CurveView], curve: int, indices: frozenset[int]) -> bool:
    """Whether the bounds change as the points do: no parameter or estimate depends on the stretch."""
    view = views[curve]
    source = view.source
    is_linear = all(rule.is_linear for rule in source.rules)
    asks = source.parametrization.kind.depends_on_points
    return not is_whole(view, indices) or (is_linear and not asks)


def between(before: Bounds, corners: Corners) -> Affine:
    """Return the map of a box to new corners; a side without length is only moved."""
    low, high = corners
    factors = [(high[axis] - low[axis]) / before.size[axis] if before.size[axis] else 1.0 for axis in (0, 1)]
    shift = (low[0] - before.low[0], low[1] - before.low[1])
    return Affine(factors[0] - 1.0, 0.0, 0.0, factors[1] - 1.0, before.low, shift)


def _views_of(document: Document, views: Sequence[CurveView], group: PointGroup) -> Sequence[CurveView]:
    result = list(views)
    for index in group.curves:
        result[index] = view_of(document.curves[index], views[index])
    return result


def _in_order(corners: Corners) -> Bounds:
    (a, b), (c, d) = corners
    return Bounds((min(a, c), min(b, d)), (max(a, c), max(b, d)))


def _distance(one: Bounds, other: Bounds) -> float:
    ends = zip((*one.low, *one.high), (*other.low, *other.high), strict=True)
    return max(abs(a - b) for a, b in ends)


def _corrected(corner: Vector, reached: Bounds, wanted: Bounds) -> Vector:
    """Return the next aim of a corner: the map from the box that was reached to the wanted one."""
    aimed = []
    for axis in (0, 1):
        size, length = reached.size[axis], wanted.size[axis]
        factor = length / size if size and length else 1.0
        aimed.append(wanted.low[axis] + (corner[axis] - reached.low[axis]) * factor)
    return (aimed[0], aimed[1])


SIDES = ("width", "height")
"""Names of a length along x and along y."""


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
    """Return the document with a group whose box is `length` wide (axis 0) or high, scaled about a position.

    With `keeps_proportions` the other side changes by the same factor.

    Raises
    ------
    EditError
        If that side has no length, or is to have none.
    """
    bounds = bounds_of(views, group)
    if bounds is None:
        return document
    if not bounds.size[axis]:
        raise EditError(f"The selection has no {SIDES[axis]} to scale.")
    if length <= 0.0:
        raise EditError(f"The {SIDES[axis]} must be greater than 0; use Flip to mirror.")
    factor, even = length / bounds.size[axis], axis if keeps_proportions else None
    x, y = (factor if keeps_proportions or other == axis else 1.0 for other in (0, 1))
    by = scaling(x, y, about)
    corners = by.point(bounds.low), by.point(bounds.high)
    return stretched(document, views, group, corners, even=even, about=about)
