"""Polylines of a curve that changes, as under a drag: results for the last curve are used again.

`Flattener` follows any curve. `MovingPoints` follows one of whose points some move together while all else
rests. Under rules that are linear in the points that curve is c(t) + w(t) D, where D is the offset of the
points: so are its polyline and its derivatives, and the core's curve is made only if somebody asks for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import msgspec
import numpy as np

from curvecore import FrozenFlattening, FrozenSegments, ParametricCurve, Pieces, flatten_pieces
from curvecore.drag.moved_points import MovedPoints

from ...document.differences import differ_only_in_points
from ...document.model import Curve, Vector
from ..geometry import at_knots
from .core_curve import Sides, moved_with_points
from .point_arrays import PointArrays, rows_changed

Box = tuple[float, float, float, float]
FlatteningKey = tuple[float, Box | None]
"""Tolerance, and the box in which it matters."""

_PAUSE = 30
"""Curves, after one that not even its own samples could follow, for which no samples are taken."""


Polyline: TypeAlias = Pieces
"""A curve as drawn: the parameters of its vertices (k,), the vertices (k, 2), and their deviation."""

_NOTHING = Polyline(np.empty(0), np.empty((0, 2)), np.empty(0))


class Flattener:
    """Flattens one curve after the other; views of a curve that changes hand it on from one to the next.

    A curve that is drawn again at the same scale gets samples, or parameters on its segments, that follow it.
    The visible part of it, and the whole of it for its extent, are requested in turn: each has its follower.
    """

    __slots__ = ("_drawn", "_whole")

    def __init__(self) -> None:
        self._drawn, self._whole = _Follower(), _Follower()

    def polyline(self, curve: ParametricCurve | None, key: FlatteningKey) -> Polyline:
        """Return the polyline of `curve` for the tolerance and the box `key`."""
        follower = self._whole if key[1] is None else self._drawn
        return follower.polyline(curve, key)


class _Follower:
    """Samples, or parameters on segments, that follow a curve while it is requested with the same key."""

    __slots__ = ("_frozen", "_last", "_pause")

    def __init__(self) -> None:
        self._last: FlatteningKey | None = None
        self._frozen: FrozenFlattening | FrozenSegments | None = None
        self._pause = 0

    def polyline(self, curve: ParametricCurve | None, key: FlatteningKey) -> Polyline:
        """Return the polyline of `curve` for the tolerance and the box `key`."""
        if curve is None:
            return _NOTHING
        if len(curve.pieces) > 1:
            return flatten_pieces(curve, *key)
        if key != self._last:
            # The first at this scale: there may never be another one.
            self._last, self._frozen, self._pause = key, None, 0
            return flatten_pieces(curve, *key)
        pieces = None if self._frozen is None else self._frozen.follow(curve)
        if pieces is None and self._pause == 0:
            self._frozen = _frozen(curve, key)
            pieces = self._frozen.follow(curve)
            if pieces is None:
                # Too wild to be followed; it may calm down.
                self._frozen, self._pause = None, _PAUSE
        elif pieces is None:
            self._pause -= 1
        return flatten_pieces(curve, *key) if pieces is None else pieces


def _frozen(curve: ParametricCurve, key: FlatteningKey) -> FrozenFlattening | FrozenSegments:
    return FrozenFlattening(curve, *key) if curve.bezier_pieces() is None else FrozenSegments(curve, *key)


# Points that move together

_LARGEST = 1e150
"""Size of data up to which no sum or product of two overflows."""

_ROUNDING = 1e-14
"""Largest difference between offsets of points that moved together, as a share of their coordinates."""


class MovingPoints:
    """Some points of a current curve that move together, all by the same offset.

    Parameters
    ----------
    source
        The document's value, before they moved.
    arrays
        The numbers in its points.
    curve
        Its core curve, in one piece.
    sides
        Its jets, where the family has derivatives.
    rows
        The points that move.

    Attributes
    ----------
    curve
        The curve before they moved.
    rows
        The points that move.
    at_rest, unit
        The data before they moved; their changes for an offset of 1 along x.
    handles
        Cache of the module ``handles``: handles before the points moved, and their share of the offset.

    Raises
    ------
    CurveError
        If the core has no such curve.
    """

    def __init__(
        self,
        source: Curve,
        arrays: PointArrays,
        curve: ParametricCurve,
        sides: Sides | None,
        rows: Sequence[int],
    ) -> None:
        self._source, self._arrays = source, arrays
        self.curve, self.rows = curve, list(rows)
        points, is_closed = at_knots(arrays.positions, closed=source.is_closed), source.is_closed
        self.at_rest = sides or Sides(points[:, None], points[:, None])
        which = np.zeros((len(arrays.points), 1))
        which[self.rows] = 1.0
        unit = [at_knots(which, closed=is_closed)[:, :, None]] * 2
        if sides is not None:
            derivatives = moved_with_points(source, points, curve.parameters, arrays)(which)
            unit = [np.hstack([unit[0], values]) for values in derivatives]
        before, after = unit
        self._unit_jets = np.vstack([after[:-1], before[-1:]])
        # An offset of 1 along x.
        self.unit = Sides(*(np.pad(values, ((0, 0), (0, 0), (0, 1))) for values in unit))
        self.handles: dict[tuple[int, bool], Any] = {}
        self._polylines: tuple[FlatteningKey, MovedPoints] | None = None

    @property
    def is_safe(self) -> bool:
        """Whether no move to anywhere in a document can fail."""
        data = [self.curve.jets, *self.unit]
        return all(bool((np.abs(values) < _LARGEST).all()) for values in data)

    def to(self, curve: Curve, arrays: PointArrays) -> Displacement | None:
        """Return the displacement to another value of the curve; None where anything else has changed."""
        old = self._arrays
        if (
            arrays.given is not old.given
            or arrays.corners is not old.corners
            or arrays.ties is not old.ties
            or arrays.times is not old.times
            or not (differ_only_in_points(self._source, curve) or _rules(self._source) == _rules(curve))
            or not curve.family.makes(self.curve)
        ):
            return None
        moved = rows_changed(arrays.points, old.points)
        if not moved:
            return Displacement(self, (0.0, 0.0))
        offset = self._common_offset(arrays) if moved == self.rows else None
        return None if offset is None else Displacement(self, offset)

    def _common_offset(self, arrays: PointArrays) -> Vector | None:
        if len(self.rows) == 1:
            new, old = arrays.points[self.rows[0]], self._arrays.points[self.rows[0]]
            return (new.x - old.x, new.y - old.y)
        moved = arrays.positions[self.rows]
        offsets = moved - self._arrays.positions[self.rows]
        if np.abs(offsets - offsets[0]).max() > _ROUNDING * np.abs(moved).max():
            return None
        x, y = offsets[0].tolist()
        return (x, y)

    def polyline(self, offset: Vector, key: FlatteningKey) -> Polyline | None:
        """Return the curve after a move as a polyline; None where flattening it is as fast."""
        if self._polylines is None or self._polylines[0] != key:
            unit = self.curve.with_jets(self._unit_jets)
            self._polylines = (key, MovedPoints(self.curve, unit, *key))
        return self._polylines[1].at(*offset)


class Displacement(msgspec.Struct, frozen=True, eq=False):
    """The points that moved, and their common offset."""

    moving: MovingPoints
    offset: Vector

    def polyline(self, key: FlatteningKey) -> Polyline | None:
        """Return the curve as a polyline, as `MovingPoints` does."""
        return self.moving.polyline(self.offset, key)


def _rules(curve: Curve) -> tuple[object, ...]:
    """Return all that shapes a curve besides its points."""
    rule, is_closed, count = curve.parametrization, curve.closed, len(curve.points)
    return (curve.family, curve.settings, rule, is_closed, count, *curve.rules)
