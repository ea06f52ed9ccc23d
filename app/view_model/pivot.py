"""The pivot: the centre of rotations, scalings and mirrorings, which follows transforms.

The map of a transform is found from the points before and after. Whether the mouse, a typed number or undo
moved them, the same map moves the pivot. Points that are edited one by one leave it where it was.
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
from ..document.transforms import IDENTITY, Affine, is_mirrored, rotation_of
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
        The points.
    points, bounds
        Their positions, (k, 2), and the bounds of the group; None of no points.
    curves, count
        The curves of these points, and the number of curves in the document.
    """

    group: PointGroup
    points: FloatArray
    bounds: Bounds | None
    curves: tuple[Curve, ...]
    count: int

    def has_same_points(self, now: Anchor) -> bool:
        """Whether the points are where they were, or copies lie there."""
        return self.points.shape == now.points.shape and np.array_equal(self.points, now.points)

    def handed_to(self, copies: Anchor) -> Anchor:
        """Return this anchor for copies that lie where the points lie now."""
        return replace(self, group=copies.group, curves=copies.curves, count=copies.count)

    def group_in(self, curves: Sequence[Curve]) -> PointGroup | None:
        """Return the group in these curves; None where a curve of it is gone.

        A curve that was changed has its index still where the number of curves is the same.
        """
        positions_by_id = {id(curve): curve_index for curve_index, curve in enumerate(curves)}
        is_same_number, parts = len(curves) == self.count, list[tuple[int, frozenset[int]]]()
        for (before, indices), curve in zip(self.group.parts, self.curves, strict=True):
            curve_index = positions_by_id.get(id(curve), before if is_same_number else None)
            if curve_index is None or any(index >= len(curves[curve_index].points) for index in indices):
                return None
            parts.append((curve_index, indices))
        return replace(self.group, parts=tuple(sorted(parts, key=lambda part: part[0])))

    def since(self, now: Anchor) -> Affine | None:
        """Return the map of a transform since this anchor; None where the group has other points now.

        Points of other curves at the same positions are copies, and count as the same.
        """
        before, after = self.points, now.points
        if self.has_same_points(now):
            return IDENTITY
        if self.group.parts != now.group.parts or before.shape != after.shape:
            return None
        by = map_between(before, after)
        return by if by is IDENTITY else self._as_boxes(by, now)

    def _as_boxes(self, by: Affine, now: Anchor) -> Affine:
        """Return a map along the axes as that of the bounds, which are exact where a curve is stretched."""
        before, after, is_turned = self.bounds, now.bounds, max(abs(by.xy), abs(by.yx)) > _SLACK
        if is_turned or before is None or after is None:
            return by
        flips = (1.0 + by.xx < 0.0, 1.0 + by.yy < 0.0)
        x, y = (-1 if is_flipped else 1 for is_flipped in flips)
        return between(before, (after.position(-x, -y), after.position(x, y)))


def anchored(views: Sequence[CurveView], group: PointGroup, *, live: bool = False) -> Anchor:
    """Return the anchor of a group now; `live` while it is dragged, with its bounds as drawn."""
    parts = [views[curve].points[sorted(indices)] for curve, indices in group.parts]
    points = np.concatenate(parts) if parts else np.empty((0, 2))
    curves = tuple(views[curve].source for curve, _ in group.parts)
    return Anchor(group, points, bounds_of(views, group, as_drawn=live), curves, len(views))


class Pivot(msgspec.Struct, frozen=True, eq=False):
    """A pivot that was set, and the group that it belongs to."""

    position: Vector
    anchor: Anchor

    def at(self, now: Anchor) -> Pivot | None:
        """Return the pivot after the transforms up to now; None where the group has other points."""
        by = self.anchor.since(now)
        if by is None:
            return None
        position = by.point(self.position)
        size = float(np.ptp(now.points, axis=0).max(initial=0.0))
        # The centre of a rotation stays to the last bit.
        stays = math.dist(position, self.position) <= _SLACK * size
        return Pivot(self.position if stays else position, now)


class Turning:
    """The angle of a group, counted from its selection; a mirror image is no rotation.

    A group mirrored sideways and turned by 180° is the same as one mirrored upside down, and mirroring both
    ways is the same as half a turn: the angle before decides between the two.

    Attributes
    ----------
    anchor
        The group when it was selected.
    """

    def __init__(self, anchor: Anchor) -> None:
        self.anchor, self._last = anchor, 0.0
        # The group at the last call of `at`.
        self._before = anchor
        # Whether it was a mirror image, and the angle that is added since that changed.
        self._is_mirrored, self._more = False, 0.0

    def at(self, now: Anchor) -> float | None:
        """Return the angle now, from −180 to 180; None where the group has other points."""
        if self._before.has_same_points(now):
            # Copies have the angle of their originals, and their own rotations from then on.
            self.anchor = self.anchor.handed_to(now)
        self._before = now
        by = self.anchor.since(now)
        if by is None:
            return None
        degrees = rotation_of(by)
        if is_mirrored(by) is not self._is_mirrored:
            self._is_mirrored = not self._is_mirrored
            self._more = 180.0 if abs(_wrapped(degrees + self._last)) > 90.0 else 0.0
        self._last = _wrapped(degrees + self._more)
        return self._last


def _wrapped(degrees: float) -> float:
    return math.remainder(degrees, 360.0) + 0.0


def map_between(before: FloatArray, after: FloatArray) -> Affine:
    """Return the map of one set of points to another that changes shape least; the identity without one."""
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
    """Return the matrix of the rotation with a scale that maps points nearest to others."""
    a, b = here[:, 0] + 1j * here[:, 1], there[:, 0] + 1j * there[:, 1]
    length = float(np.vdot(a, a).real)
    turn = complex(np.vdot(a, b)) / length if length > 0.0 else 1.0 + 0.0j
    return np.array([[turn.real, -turn.imag], [turn.imag, turn.real]])


def _linear(here: FloatArray, there: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.lstsq(here, there, rcond=None)[0], dtype=np.float64).T
