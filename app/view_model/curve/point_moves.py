"""A curve some of whose points move together, as under a drag, while all else rests: nothing is made anew.

Under rules that are linear in the points it is c(t) + w(t) D, where D is the way of the points: so are its
polyline and its derivatives. The core's curve is made of the points as they are by whoever needs it.
"""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from curvecore import ParametricCurve
from curvecore.arrays import FloatArray
from curvecore.drag.moved_points import MovedPoints

from ...document.model import Curve, Vector
from ...document.steps import differ_in_points
from ..geometry import at_knots
from .flattener import FlatteningKey, Polyline
from .handle_arms import Handles, PointSides
from .jets import Sides, moved_with_points
from .point_arrays import PointArrays, rows_changed

_LARGEST = 1e150
"""Size of data up to which no sum or product of two overflows."""

_ROUNDING = 1e-14
"""Differences between the ways of points that moved together, as a share of where they are."""


class PointMoves:
    """Moves of some points of a current curve, all by the same way.

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
        The data before they moved; by how much they move along, as for a way of 1 along x.
    handles
        Handles on some sides of points, before they moved, and by how much they move along: kept by
        `handles`.

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
            unit = [np.hstack([unit[0], each]) for each in derivatives]
        before, after = unit
        self._unit_jets = np.vstack([after[:-1], before[-1:]])
        # A way of 1 along x.
        self.unit = Sides(*(np.pad(each, ((0, 0), (0, 0), (0, 1))) for each in unit))
        self.handles: dict[tuple[int, bool], tuple[PointSides, Handles, FloatArray]] = {}
        self._polylines: tuple[FlatteningKey, MovedPoints] | None = None

    @property
    def is_safe(self) -> bool:
        """Whether no move to anywhere in a document can fail."""
        data = [self.curve.jets, *self.unit]
        return all(bool((np.abs(each) < _LARGEST).all()) for each in data)

    def to(self, curve: Curve, arrays: PointArrays) -> Motion | None:
        """Return the motion to another value where that is all that it differs in, else None."""
        old = self._arrays
        if (
            arrays.given is not old.given
            or arrays.corners is not old.corners
            or arrays.ties is not old.ties
            or arrays.times is not old.times
            or not (differ_in_points(self._source, curve) or _rules(self._source) == _rules(curve))
            or not curve.family.makes(self.curve)
        ):
            return None
        moved = rows_changed(arrays.points, old.points)
        if not moved:
            return Motion(self, (0.0, 0.0))
        way = self._common_way(arrays) if moved == self.rows else None
        return None if way is None else Motion(self, way)

    def _common_way(self, arrays: PointArrays) -> Vector | None:
        if len(self.rows) == 1:
            new, old = arrays.points[self.rows[0]], self._arrays.points[self.rows[0]]
            return (new.x - old.x, new.y - old.y)
        places = arrays.positions[self.rows]
        ways = places - self._arrays.positions[self.rows]
        if np.abs(ways - ways[0]).max() > _ROUNDING * np.abs(places).max():
            return None
        x, y = ways[0].tolist()
        return (x, y)

    def polyline(self, way: Vector, key: FlatteningKey) -> Polyline | None:
        """Return the curve after a move as a polyline; None where it is drawn as quickly from itself."""
        if self._polylines is None or self._polylines[0] != key:
            unit = self.curve.with_jets(self._unit_jets)
            self._polylines = (key, MovedPoints(self.curve, unit, *key))
        return self._polylines[1].at(*way)


class Motion(msgspec.Struct, frozen=True, eq=False):
    """A move: which points move, and how far they came."""

    moves: PointMoves
    way: Vector

    def polyline(self, key: FlatteningKey) -> Polyline | None:
        """Return the curve as a polyline, as `PointMoves` does."""
        return self.moves.polyline(self.way, key)


def _rules(curve: Curve) -> tuple[object, ...]:
    """Return what shapes a curve besides its points."""
    rule, is_closed, count = curve.parametrization, curve.closed, len(curve.points)
    return (curve.family, curve.settings, rule, is_closed, count, *curve.rules)
