"""Points and curves made to fill a box: exactly, also where the curve answers with another shape.

Where a rule gives the parameters by the distances of the points, or estimates by their coordinates, a curve
whose points are stretched along one axis is not the stretched curve. The stretch is then corrected by the
bounds that come out, until these are the ones wanted.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.several_curves import mapped
from ..document.transforms import Affine
from .bounds import Bounds, bounds_of, is_whole
from .curve_view import CurveView, view_of

Corners = tuple[Vector, Vector]
"""Images of the lower left and of the upper right corner of a box; they may have changed places."""

_ROUNDS = 40
_ROUNDING = 2.0**-50
"""Share of the largest coordinate within which bounds are computed."""


def stretched(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    corners: Corners,
    *,
    tolerance: float = 0.0,
) -> Document:
    """Return the document with a group stretched so that the corners of its bounds come where they shall.

    Parameters
    ----------
    document, views
        The document, and the views of its curves.
    corners
        Where the corners go.
    tolerance
        By how much the bounds may be off; within rounding they always may.
    """
    before = bounds_of(views, group)
    assert before is not None
    plain = between(before, corners)
    if tolerance and (abs(plain.xx) == abs(plain.yy) or all(_follows(views, *part) for part in group.parts)):
        return mapped(document, group, plain)
    goal = _in_order(corners)
    largest = max(abs(value) for corner in (*corners, before.low, before.high) for value in corner)
    enough = max(tolerance, _ROUNDING * largest)
    aim, best, least = corners, document, float("inf")
    for _ in range(_ROUNDS):
        changed = mapped(document, group, between(before, aim))
        reached = bounds_of(_views_of(changed, views, group), group)
        assert reached is not None
        off = _distance(reached, goal)
        if off < least:
            best, least = changed, off
        if off <= enough:
            break
        aim = (_corrected(aim[0], reached, goal), _corrected(aim[1], reached, goal))
    return best


def _follows(views: Sequence[CurveView], curve: int, indices: frozenset[int]) -> bool:
    """Whether the bounds go as the points do: parameters and estimates answer to no stretch."""
    view = views[curve]
    source = view.source
    is_linear = all(rule.is_linear for rule in source.rules)
    asks = source.parametrization.kind.asks_where_points_are
    return not is_whole(view, indices) or (is_linear and not asks)


def between(before: Bounds, corners: Corners) -> Affine:
    """Return the map of a box by what becomes of its corners; a side without length is only moved."""
    low, high = corners
    factors = [(high[axis] - low[axis]) / before.size[axis] if before.size[axis] else 1.0 for axis in (0, 1)]
    shift = (low[0] - before.low[0], low[1] - before.low[1])
    return Affine(factors[0] - 1.0, 0.0, 0.0, factors[1] - 1.0, before.low, shift)


def _views_of(document: Document, views: Sequence[CurveView], group: PointGroup) -> Sequence[CurveView]:
    made = list(views)
    for place in group.curves:
        made[place] = view_of(document.curves[place], views[place])
    return made


def _in_order(corners: Corners) -> Bounds:
    (a, b), (c, d) = corners
    return Bounds((min(a, c), min(b, d)), (max(a, c), max(b, d)))


def _distance(one: Bounds, other: Bounds) -> float:
    ends = zip((*one.low, *one.high), (*other.low, *other.high), strict=True)
    return max(abs(a - b) for a, b in ends)


def _corrected(corner: Vector, reached: Bounds, goal: Bounds) -> Vector:
    """Return where a corner is aimed at next: the map of what was reached to what is wanted."""
    aimed = []
    for axis in (0, 1):
        size, wanted = reached.size[axis], goal.size[axis]
        factor = wanted / size if size and wanted else 1.0
        aimed.append(goal.low[axis] + (corner[axis] - reached.low[axis]) * factor)
    return (aimed[0], aimed[1])
