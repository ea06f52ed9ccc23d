"""The pivot: the place that transforms turn, scale and mirror about, and that goes along with them.

What a transform did to points is read off them: whatever moved them, by the mouse, by a number, by undo, the
pivot is where the same map takes it. Points that were edited one by one leave it where it was.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.model import Curve, Vector
from ..document.point_group import PointGroup
from ..document.transforms import IDENTITY, Affine, mirrors, turn_of
from .boxes import Bounds, bounds_of
from .curve.curve_view import CurveView
from .resize import between

_SLACK = 1e-9
"""Share of the size of a group within which points count as mapped."""


class Anchor(msgspec.Struct, frozen=True, eq=False):
    """A group as it was at some moment.

    Attributes
    ----------
    group
        Which points.
    points, bounds
        Where they were, (k, 2), and the bounds of the group; None of no points.
    curves, count
        The curves that they were of, and how many the document had.
    """

    group: PointGroup
    points: FloatArray
    bounds: Bounds | None
    curves: tuple[Curve, ...]
    count: int

    def has_same_points(self, now: Anchor) -> bool:
        """Whether the points are where they were, or are copies at the same places."""
        return self.points.shape == now.points.shape and np.array_equal(self.points, now.points)

    def handed_to(self, copies: Anchor) -> Anchor:
        """Return what copies, which lie where this lies now, were at that moment."""
        return replace(self, group=copies.group, curves=copies.curves, count=copies.count)

    def group_in(self, curves: Sequence[Curve]) -> PointGroup | None:
        """Return the group where it is now; None where a curve of it is gone.

        A curve that was changed is in its place, where there are as many as before.
        """
        places = {id(curve): place for place, curve in enumerate(curves)}
        is_same_number, parts = len(curves) == self.count, list[tuple[int, frozenset[int]]]()
        for (before, indices), curve in zip(self.group.parts, self.curves, strict=True):
            place = places.get(id(curve), before if is_same_number else None)
            if place is None or any(index >= len(curves[place].points) for index in indices):
                return None
            parts.append((place, indices))
        return replace(self.group, parts=tuple(sorted(parts, key=lambda part: part[0])))

    def since(self, now: Anchor) -> Affine | None:
        """Return the map that a transform has done since; None where other points are meant by now.

        Points of other curves at the same places are their copies, and count as the same.
        """
        before, after = self.points, now.points
        if self.has_same_points(now):
            return IDENTITY
        if self.group.parts != now.group.parts or before.shape != after.shape:
            return None
        by = map_between(before, after)
        return by if by is IDENTITY else self._as_boxes(by, now)

    def _as_boxes(self, by: Affine, now: Anchor) -> Affine:
        """Return a map along the axes as that of the bounds: where a curve is stretched they are exact."""
        before, after, is_turned = self.bounds, now.bounds, max(abs(by.xy), abs(by.yx)) > _SLACK
        if is_turned or before is None or after is None:
            return by
        flips = (1.0 + by.xx < 0.0, 1.0 + by.yy < 0.0)
        x, y = (-1 if is_flipped else 1 for is_flipped in flips)
        return between(before, (after.place(-x, -y), after.place(x, y)))


def anchored(views: Sequence[CurveView], group: PointGroup, *, live: bool = False) -> Anchor:
    """Return a group as it is now; `live` while it is dragged, with its bounds as they are drawn."""
    parts = [views[curve].points[sorted(indices)] for curve, indices in group.parts]
    points = np.concatenate(parts) if parts else np.empty((0, 2))
    curves = tuple(views[curve].source for curve, _ in group.parts)
    return Anchor(group, points, bounds_of(views, group, as_drawn=live), curves, len(views))


class Pivot(msgspec.Struct, frozen=True, eq=False):
    """A pivot that was chosen, and the group that it belongs to."""

    place: Vector
    anchor: Anchor

    def at(self, now: Anchor) -> Pivot | None:
        """Return the pivot as it is now, None where the group is another one."""
        by = self.anchor.since(now)
        if by is None:
            return None
        place = by.point(self.place)
        size = float(np.ptp(now.points, axis=0).max(initial=0.0))
        # What it was turned about stays to the last bit.
        stays = math.dist(place, self.place) <= _SLACK * size
        return Pivot(self.place if stays else place, now)


class Turning:
    """The angle at which a group stands, from when it was selected on; a mirror image is no rotation.

    What is mirrored sideways and turned by 180° is what is mirrored upside down, and to mirror both ways is
    half a turn, though nobody turned anything: the angle before says which of the two it is.

    Attributes
    ----------
    anchor
        The group as it was then.
    """

    def __init__(self, anchor: Anchor) -> None:
        self.anchor, self._last = anchor, 0.0
        # The group as it was when it was asked for last.
        self._before = anchor
        # Whether it was a mirror image, and what is added since it became one, or none again.
        self._is_mirrored, self._more = False, 0.0

    def at(self, now: Anchor) -> float | None:
        """Return the angle now, from −180 to 180; None where the group is another one."""
        if self._before.has_same_points(now):
            # Copies are turned as what they are of, and by what they are turned from then on.
            self.anchor = self.anchor.handed_to(now)
        self._before = now
        by = self.anchor.since(now)
        if by is None:
            return None
        degrees = turn_of(by)
        if mirrors(by) is not self._is_mirrored:
            self._is_mirrored = not self._is_mirrored
            self._more = 180.0 if abs(_wrapped(degrees + self._last)) > 90.0 else 0.0
        self._last = _wrapped(degrees + self._more)
        return self._last


def _wrapped(degrees: float) -> float:
    return math.remainder(degrees, 360.0) + 0.0


def map_between(before: FloatArray, after: FloatArray) -> Affine:
    """Return the map of one set of points to another, that which changes shape least; none without one."""
    centre: FloatArray = before.mean(axis=0)
    shift: FloatArray = (after - centre).mean(axis=0)
    here: FloatArray = before - centre
    there: FloatArray = after - centre - shift
    slack = _SLACK * float(max(np.abs(here).max(initial=0.0), np.abs(there).max(initial=0.0)))
    middle, by = (float(centre[0]), float(centre[1])), (float(shift[0]), float(shift[1]))
    for matrix in (_similarity(here, there), _linear(here, there)):
        off: FloatArray = here @ matrix.T - there
        if np.abs(off).max(initial=0.0) <= slack:
            (xx, xy), (yx, yy) = (matrix - np.eye(2)).tolist()
            return Affine(xx, xy, yx, yy, middle, by)
    return IDENTITY


def _similarity(here: FloatArray, there: FloatArray) -> FloatArray:
    """Return the rotation with a scale, as a matrix, that maps points nearest to others."""
    a, b = here[:, 0] + 1j * here[:, 1], there[:, 0] + 1j * there[:, 1]
    length = float(np.vdot(a, a).real)
    turn = complex(np.vdot(a, b)) / length if length > 0.0 else 1.0 + 0.0j
    return np.array([[turn.real, -turn.imag], [turn.imag, turn.real]])


def _linear(here: FloatArray, there: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.lstsq(here, there, rcond=None)[0], dtype=np.float64).T
