"""Points and curves made to fill a box: exactly, also where the curve answers with another shape.

Where a rule gives the parameters by the distances of the points, or estimates by their coordinates, a curve
whose points are stretched along one axis is not the stretched curve; and strokes that are measured do not
grow as their curves do. The stretch is then corrected by the bounds that come out, along secants through the
last ones, until these are the ones wanted.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np

from ...document.model import Document, Vector
from ...document.point_group import PointGroup
from ...document.several_curves import mapped, scaled_strokes
from ...document.transforms import Affine
from ..curve.curve_view import CurveView, view_of
from ..geometry.fixed_point import Secants
from .bounds import BARE, Bounds, Strokes, bounds_of, is_whole

Corners = tuple[Vector, Vector]
"""Images of the lower left and of the upper right corner of a box; they may have changed places."""

_ROUNDS = 40
_ROUNDING = 2.0**-50
"""Share of the largest coordinate within which bounds are computed."""

_IN_VAIN, _NEAR = 5, 1e-9
"""Rounds without half the deviation that end it, and the share of the coordinates below which it is noise.

Curves that swing wildly have bounds that are no better known.
"""

_LEAST_SHARE = 0.01
"""Of the size of a box too small for its strokes: what the curves in it keep, so that they can grow again."""


def stretched(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    corners: Corners,
    strokes: Strokes = BARE,
    *,
    even: int | None = None,
    about: Vector | None = None,
    tolerance: float = 0.0,
) -> Document:
    """Return the document with a group stretched so that the corners of its bounds come where they shall.

    Parameters
    ----------
    document, views
        The document, and the views of its curves.
    corners
        Where the corners go.
    strokes
        Whether the bounds are those with strokes, and whether these are scaled.
    even
        An axis, for a stretch with proportions kept: along that one the corners count, and along the other
        the place `about`, which stays where it is in the box.
    tolerance
        By how much the bounds may be off; within rounding they always may.
    """
    before = _measured(views, group, strokes)
    goal = _goal_of(before, corners, strokes, even, about)
    aim = goal.aimed(before, corners)
    plain = between(before.bare, aim)
    is_similar = even is not None or abs(plain.xx) == abs(plain.yy)
    if tolerance and (is_similar or all(_follows(views, *part) for part in group.parts)):
        return _with_strokes(document, group, plain, strokes)
    largest = max(abs(value) for corner in (*corners, before.bare.low, before.bare.high) for value in corner)
    enough = max(tolerance, _ROUNDING * largest)
    best, least, secants, vain = document, math.inf, Secants(4), 0
    for _ in range(_ROUNDS):
        changed = _with_strokes(document, group, between(before.bare, aim), strokes)
        reached = _measured(_views_of(changed, views, group), group, strokes)
        wanted = goal.from_(reached)
        off = _distance(reached.outer, wanted.outer)
        vain = vain + 1 if off > least / 2.0 else 0
        if off < least:
            best, least = changed, off
        if off <= enough or (vain == _IN_VAIN and least <= _NEAR * largest):
            break
        corrected = (
            _corrected(aim[0], reached.bare, wanted.bare),
            _corrected(aim[1], reached.bare, wanted.bare),
        )
        aim = _next_aim(secants, aim, corrected)
    return best


def _next_aim(secants: Secants, aim: Corners, corrected: Corners) -> Corners:
    """Return the corners to be tried next: along secants, unless these would turn the box over."""
    left, bottom, right, top = secants.after(np.ravel(aim), np.ravel(corrected)).tolist()
    (x, y), (end_x, end_y) = corrected
    if (right - left) * (end_x - x) < 0.0 or (top - bottom) * (end_y - y) < 0.0:
        secants.forget()
        return corrected
    return (left, bottom), (right, top)


class _Measured(msgspec.Struct, frozen=True):
    """Bounds as they are measured, and those of the curves alone."""

    outer: Bounds
    bare: Bounds

    @property
    def margins(self) -> Vector:
        """The lengths by which strokes make width and height larger."""
        (width, height), (bare_width, bare_height) = self.outer.size, self.bare.size
        return (width - bare_width, height - bare_height)

    def mirrored(self, axis: int) -> _Measured:
        """Return them with the margins on both sides of an axis exchanged."""
        low, high = list(self.outer.low), list(self.outer.high)
        low[axis] = self.bare.low[axis] - (self.outer.high[axis] - self.bare.high[axis])
        high[axis] = self.bare.high[axis] + (self.bare.low[axis] - self.outer.low[axis])
        return _Measured(Bounds((low[0], low[1]), (high[0], high[1])), self.bare)


class _Goal(msgspec.Struct, frozen=True):
    """The box to be filled.

    Attributes
    ----------
    box
        Where it lies.
    asked
        Along which axes it is to be filled.
    share
        What stays along the others: from 0, the low end of the box, to 1.
    even
        The axis that gives the factor of both; None where each has its own.
    scales_strokes
        Whether strokes grow by the mean of the factors.
    """

    box: Bounds
    asked: tuple[bool, bool]
    share: Vector
    even: int | None
    scales_strokes: bool

    def aimed(self, before: _Measured, corners: Corners) -> Corners:
        """Return where the corners of the curves alone go, if they answer as the points do."""
        flips = [corners[1][axis] < corners[0][axis] for axis in (0, 1)]
        for axis in (0, 1):
            before = before.mirrored(axis) if flips[axis] else before
        bare = self.from_(before).bare
        x, y = (-1 if is_flipped else 1 for is_flipped in flips)
        return bare.place(-x, -y), bare.place(x, y)

    def from_(self, now: _Measured) -> _Measured:
        """Return the bounds that fill the box, by the margins of those that there are now."""
        sizes, thicker = self._sizes(now)
        sides = []
        for axis in (0, 1):
            size = sizes[axis] + now.margins[axis] * thicker
            room = 0.0 if self.asked[axis] else self.share[axis] * (self.box.size[axis] - size)
            low = self.box.low[axis] + room
            bare = low + (now.bare.low[axis] - now.outer.low[axis]) * thicker
            sides.append((low, low + size, bare, bare + sizes[axis]))
        (left, right, x, end_x), (bottom, top, y, end_y) = sides
        return _Measured(Bounds((left, bottom), (right, top)), Bounds((x, y), (end_x, end_y)))

    def _sizes(self, now: _Measured) -> tuple[Vector, float]:
        """Return the size that the curves alone should have, and the factor of strokes that goes with it."""
        bare, margins, wanted = now.bare.size, now.margins, self.box.size
        scales = self.scales_strokes and any(margins)
        thicker = _growth_of_strokes(bare, margins, wanted, self._axes) if scales else 1.0
        sizes = [
            max(wanted[axis] - margins[axis] * thicker, _LEAST_SHARE * wanted[axis])
            if self.asked[axis] else bare[axis]
            for axis in (0, 1)
        ]  # fmt: skip
        if self.even is not None and bare[self.even]:
            factor = sizes[self.even] / bare[self.even]
            sizes = [factor * bare[0], factor * bare[1]]
        return (sizes[0], sizes[1]), thicker

    @property
    def _axes(self) -> list[int]:
        """The axes that give the factors whose mean is that of strokes; one twice where it gives both."""
        asked = [axis for axis in (0, 1) if self.asked[axis]]
        return asked * 2 if self.even is not None else asked


def _goal_of(
    before: _Measured, corners: Corners, strokes: Strokes, even: int | None, about: Vector | None
) -> _Goal:
    box, share = _in_order(corners), [0.5, 0.5]
    # What has no length along an axis but that of its strokes cannot be stretched along it.
    asked = [
        (before.bare.size[axis] > 0.0 or not before.margins[axis]) and even in (None, axis) for axis in (0, 1)
    ]
    for axis in (0, 1):
        if about is not None and box.size[axis]:
            share[axis] = (about[axis] - box.low[axis]) / box.size[axis]
    return _Goal(box, (asked[0], asked[1]), (share[0], share[1]), even, strokes.scaled)


def _growth_of_strokes(bare: Vector, margins: Vector, wanted: Vector, axes: Sequence[int]) -> float:
    """Return the factor r of strokes with which curves fill a box, where r is the mean of their own factors.

    These are (w − r m) / b along each axis, w being the length wanted, b that of the curves alone and m that
    of the strokes: r² is their product, and with one of them alone that one.
    """
    if not axes or not all(wanted[axis] > 0.0 for axis in axes):
        return 1.0
    if len(axes) == 1:
        (w,), (m,), (b,) = ([each[axis] for axis in axes] for each in (wanted, margins, bare))
        return 2.0 * w / (m + math.sqrt(m * m + 4.0 * b * w))
    (w, v), (m, n), (b, c) = ([each[axis] for axis in axes] for each in (wanted, margins, bare))
    # (m n − b c) r² − (w n + v m) r + w v = 0: the smaller root, with which neither length is negative.
    sum_ = w * n + v * m
    return 2.0 * w * v / (sum_ + math.sqrt((w * n - v * m) ** 2 + 4.0 * b * c * w * v))


def _measured(views: Sequence[CurveView], group: PointGroup, strokes: Strokes) -> _Measured:
    outer, bare = bounds_of(views, group, strokes), bounds_of(views, group, BARE)
    assert outer is not None
    assert bare is not None
    return _Measured(outer, bare)


def _with_strokes(document: Document, group: PointGroup, by: Affine, strokes: Strokes) -> Document:
    """Return the document with a group mapped along the axes, its strokes too where they are scaled."""
    document = mapped(document, group, by)
    return scaled_strokes(document, group, 1.0 + by.xx, 1.0 + by.yy) if strokes.scaled else document


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


def _corrected(corner: Vector, reached: Bounds, wanted: Bounds) -> Vector:
    """Return where a corner is aimed at next: the map of what was reached to what is wanted."""
    aimed = []
    for axis in (0, 1):
        size, length = reached.size[axis], wanted.size[axis]
        factor = length / size if size and length else 1.0
        aimed.append(wanted.low[axis] + (corner[axis] - reached.low[axis]) * factor)
    return (aimed[0], aimed[1])
