"""Polylines of a curve that changes, as when a point is dragged: vertices are kept from curve to curve.

`FrozenFlattening` is for curves without Bezier pieces. They are linear in their points. While the parameters
stay, samples follow a moved point by B_i(t) times its displacement: no basis function is evaluated again.
When parameters move, the curve is evaluated once at the same samples, not sampled and refined anew; for a few
of them from the curve through the other points. Whether the samples still lie close enough is read off the
samples themselves. They start twice as close as the degree can make necessary, which is why nothing can hide
between them.

`FrozenSegments` is for curves of Bezier pieces, whatever moves. The positions of vertices on their segments
are kept: only the control points change, and their second differences prove whether the vertices still lie
close enough.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike

from curvecore.arithmetic import LIMIT
from curvecore.arrays import FloatArray, box_edges, tolerance_value
from curvecore.bezier.bernstein import weights
from curvecore.bezier.control_points import bezier_segments, drawable_pieces, equal_parts
from curvecore.bezier.flatten import (
    Pieces,
    chord_bound,
    flatten_pieces,
    may_enter,
    merged_pieces,
    sampled_pieces,
    segment_distance,
)
from curvecore.drag.moved_parameters import LeftOut
from curvecore.families.curve import ParametricCurve

ComplexArray = npt.NDArray[np.complex128]

_FINER = 4.0  # of the tolerance: room for the curve to bend more before new samples are needed
_MARGIN = 1.6  # on an estimate from one parameter for the whole of a piece
_MOST_MOVED = 4  # points whose parameters move, above which evaluating anew is as fast
_LEAST_SQUARE = 1e-290  # of lengths, below which products lose digits
_SHARE = 0.05  # of the tolerance, that roundings may take
_FEW = 512  # vertices, up to which drawing all takes less time than finding those that need not be
_MOST_COLUMNS = 16  # moved points, above which evaluating anew is as fast


class FrozenFlattening:
    """Samples of one curve that serve for others over the same interval, or another one if it has one piece.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2.
    tolerance : float
        Largest allowed distance from a curve to its polyline, above 0.
    box : (xmin, ymin, xmax, ymax), optional
        Where the tolerance matters; see `flatten_parameters`.

    Raises
    ------
    CurveError
        If tolerance or box are unusable.

    See Also
    --------
    FrozenSegments : The same for curves of Bezier pieces.
    flatten_pieces : Of one curve.

    Examples
    --------
    >>> from curvecore import FrozenFlattening, LagrangeCurve
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> frozen = FrozenFlattening(curve, 0.01)
    >>> moved = LagrangeCurve([[0, 0], [1, 2.25], [4, 0]], curve.parameters)
    >>> frozen.follow(moved).reached <= 0.01
    True
    """

    def __init__(self, curve: ParametricCurve, tolerance: float, box: ArrayLike | None = None) -> None:
        self._tolerance = tolerance_value(tolerance)
        self._edges = None if box is None else box_edges(box)
        self._curve = curve
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            pieces = sampled_pieces(curve, self._tolerance / _FINER, self._edges)
        self._parameters, self._points = pieces.parameters, pieces.points
        h = np.diff(self._parameters)
        self._quotient = h[1:] / h[:-1]
        self._leverage = 0.25 * _MARGIN * np.maximum(self._quotient, 1.0 / self._quotient)
        self._columns: dict[int, FloatArray] = {}
        self._left_out: LeftOut | None = None

    def follow(self, curve: ParametricCurve) -> Pieces | None:
        """Return the polyline of another curve.

        Parameters
        ----------
        curve : ParametricCurve
            Of dim 2; the fewer of its data differ from those of the curve
            given first, the sooner it is done.

        Returns
        -------
        Pieces or None
            None where the samples do not serve for this curve any more.
        """
        if not self._is_alike(curve):
            return None
        parameters = self._parameters_for(curve)
        if parameters is None:
            return None
        with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
            is_mapped = parameters is not self._parameters
            points = np.clip(curve.evaluate(parameters), -LIMIT, LIMIT) if is_mapped else self._samples(curve)
            bound = self._calm_deviation(points)
            if bound <= self._tolerance and len(points) <= _FEW:
                return Pieces(parameters, points, np.full(len(points) - 1, bound))
            deviation = self._deviation(points)
            if not np.isfinite(points).all() or np.any((deviation > self._tolerance) & (deviation < np.inf)):
                return None
            pieces = Pieces(parameters, points, deviation)
            return pieces if points.shape[0] <= _FEW else merged_pieces(pieces, self._tolerance)

    def _is_alike(self, curve: ParametricCurve) -> bool:
        """Whether the samples are close enough together for this curve."""
        old = self._curve
        if curve.functions_key != old.functions_key:
            return False
        if curve.degree is None or old.degree is None:
            return len(curve.points) == len(old.points) and curve.degree is old.degree
        return curve.degree <= old.degree

    def _parameters_for(self, curve: ParametricCurve) -> FloatArray | None:
        """Return the parameters of the samples on the interval of a curve; None if breaks lie between."""
        if np.array_equal(curve.breaks, self._curve.breaks):
            return self._parameters
        if not len(curve.breaks) == len(self._curve.breaks) == 2:
            return None
        (start, end), (new_start, new_end) = self._curve.domain, curve.domain
        share = (self._parameters - start) / (end - start)
        mapped: FloatArray = new_start * (1.0 - share) + new_end * share
        return mapped if (np.diff(mapped) > 0.0).all() else None

    def _samples(self, curve: ParametricCurve) -> FloatArray:
        """Return the curve at all samples, (m, 2)."""
        is_same = curve.parameters is self._curve.parameters
        if not (is_same or np.array_equal(curve.parameters, self._curve.parameters)):
            return np.clip(self._at_moved_parameters(curve), -LIMIT, LIMIT)
        moved = np.flatnonzero((curve.points != self._curve.points).any(axis=1))
        if len(moved) > _MOST_COLUMNS:
            return np.clip(curve.evaluate(self._parameters), -LIMIT, LIMIT)
        if not len(moved):
            return self._points
        columns = np.stack([self._column(index) for index in moved.tolist()], axis=1)
        displacement = curve.points[moved] - self._curve.points[moved]
        return np.clip(self._points + columns @ displacement, -LIMIT, LIMIT)

    def _at_moved_parameters(self, curve: ParametricCurve) -> FloatArray:
        if self._left_out is None or not self._left_out.serves(curve):
            self._left_out = self._leave_out(curve)
        if self._left_out is not None:
            known = self._left_out.evaluate(curve)
            if known.rounding <= _SHARE * self._tolerance:
                return known.points
        return curve.evaluate(self._parameters)

    def _leave_out(self, curve: ParametricCurve) -> LeftOut | None:
        """Return the curve without the points that `curve` has elsewhere; None where they are too many."""
        if len(curve.parameters) != len(self._curve.parameters) or not curve.is_one_polynomial:
            return None
        differs = (curve.parameters != self._curve.parameters) | (curve.points != self._curve.points).any(
            axis=1
        )
        moved = np.flatnonzero(differs)
        if len(moved) > min(_MOST_MOVED, len(differs) - 2):
            return None
        return LeftOut(self._curve, moved, self._parameters)

    def _column(self, index: int) -> FloatArray:
        """Return the basis function of a point at all samples, (m,)."""
        if index not in self._columns:
            unit = np.zeros((len(self._curve.parameters), 1, 1))
            unit[index] = 1.0
            self._columns[index] = self._curve.with_jets(unit).evaluate(self._parameters)[:, 0]
        return self._columns[index]

    def _calm_deviation(self, points: FloatArray) -> float:
        """Return the greatest estimate of `_deviation`; infinite where the curve may turn back.

        In a third of the operations: where three samples turn by less than a right angle, the middle one is
        as far from the chord of the others as from the line through them.
        """
        if len(points) < 3:
            return np.inf
        step = _steps(points)
        turn = step[1:] * step[:-1].conj()
        if not turn.real.min() > _LEAST_SQUARE or any(_overshoot_at_ends(step, self._quotient)):
            return np.inf
        off = np.abs(turn.imag) / np.abs(step[1:] + step[:-1])
        return float((off * self._leverage).max())

    def _deviation(self, points: FloatArray) -> FloatArray:
        """Return estimates of how far each piece leaves its chord; infinite for pieces outside the box.

        A sample lies |c''| h k / 2 off the chord of its neighbours, h and k away from it in t; a piece of
        length h leaves its own chord by |c''| h**2 / 8.
        """
        deviation = np.zeros(len(points) - 1)
        if len(deviation) < 2:
            return deviation
        off, quotient = segment_distance(points[1:-1], points[:-2], points[2:]), self._quotient
        deviation[:-1] = off / quotient
        deviation[1:] = np.maximum(deviation[1:], off * quotient)
        deviation *= 0.25 * _MARGIN
        overshoot = _overshoot(points, quotient)
        if overshoot is not None:
            deviation += _MARGIN * overshoot
        if self._edges is not None:
            reach = np.maximum(np.append(off, 0.0), np.insert(off, 0, 0.0))[:, None]
            if overshoot is not None:
                reach += _MARGIN * overshoot[:, None]
            low = np.minimum(points[:-1], points[1:]) - reach
            high = np.maximum(points[:-1], points[1:]) + reach
            deviation[~may_enter(np.stack([low, high], axis=1), self._edges)] = np.inf
        return deviation


def _overshoot(points: FloatArray, quotient: FloatArray) -> FloatArray | None:
    """Estimate by how much each piece overshoots an end of its chord and comes back; None where none does.

    Samples along the chord show nothing of it. `quotient` says how much longer in t each piece but the first
    is than the one before it.
    """
    step = _steps(points)
    onward = (step[1:] * step[:-1].conj()).real > 0.0
    first, last = _overshoot_at_ends(step, quotient)
    if not (first or last) and onward.all():
        return None
    after = step[1:] / quotient
    bend = (after - step[:-1]) * (2.0 / (1.0 + quotient))
    beyond = np.where(
        onward, 0.0, _parabola_overshoot((step[:-1] * quotient + after) / (1.0 + quotient), bend)
    )
    overshoot = np.zeros(len(step))
    overshoot[:-1] = beyond
    overshoot[1:] = np.maximum(overshoot[1:], beyond)
    overshoot[0], overshoot[-1] = max(overshoot[0], first), max(overshoot[-1], last)
    return overshoot


def _steps(points: FloatArray) -> ComplexArray:
    """Return the differences of points as complex numbers: one operation for both coordinates."""
    return np.diff(np.ascontiguousarray(points).view(np.complex128)[:, 0])


def _overshoot_at_ends(step: ComplexArray, quotient: FloatArray) -> tuple[float, float]:
    """Return the distances by which a curve first recedes, from its beginning and back from its end."""
    return (
        _overshoot_at_end(complex(step[0]), complex(step[1]), float(quotient[0])),
        _overshoot_at_end(complex(step[-1]), complex(step[-2]), 1.0 / float(quotient[-1])),
    )


def _overshoot_at_end(step: complex, following: complex, quotient: float) -> float:
    """Return the distance by which a curve first recedes, given the first steps from its end."""
    change = (following / quotient - step) / (1.0 + quotient)
    velocity = step - change
    if (velocity * step.conjugate()).real > 0.0:
        return 0.0
    return float(_parabola_overshoot(np.array([velocity]), np.array([2.0 * change]))[0])


def _parabola_overshoot(velocity: ComplexArray, bend: ComplexArray) -> FloatArray:
    """Return the distance from a point of a parabola to its turn: (v . c'')**2 / (2 |c''|**3)."""
    size = np.abs(bend)
    along = (velocity * bend.conj()).real / size
    return np.where(size > 0.0, 0.5 * along * along / size, 0.0)


# Curves of Bezier pieces

_FINER_SEGMENTS = 1.5  # of the tolerance: room for segments to bend more before new vertices are needed
_WASTE = 2.0  # times the vertices needed, above which they are chosen anew
_MERGED = 0.9  # share of vertices, below which leaving some out saves more than is gained here
_MOST_PIECES = 64  # a segment


class FrozenSegments:
    """Positions of vertices on the segments of one curve, which serve for others of as many segments.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2, of a family with Bezier pieces.
    tolerance : float
        Largest allowed distance from a curve to its polyline, above 0.
    box : (xmin, ymin, xmax, ymax), optional
        Where the tolerance matters; see `flatten_parameters`.

    Raises
    ------
    CurveError
        If tolerance or box are unusable.

    See Also
    --------
    FrozenFlattening : The same for curves of other families.
    flatten_pieces : Of one curve.

    Examples
    --------
    >>> from curvecore import FrozenSegments, HermiteCurve
    >>> curve = HermiteCurve([[0, 0], [1, 2], [4, 0]], [[1, 0], [1, 0], [1, 0]], [0, 1, 2])
    >>> moved = HermiteCurve([[0, 0], [1, 2.25], [4, 0]], [[1, 0], [1, 0], [1, 0]], [0, 1, 2])
    >>> FrozenSegments(curve, 0.01).follow(moved).reached <= 0.01
    True
    """

    def __init__(self, curve: ParametricCurve, tolerance: float, box: ArrayLike | None = None) -> None:
        self._tolerance = tolerance_value(tolerance)
        self._edges = None if box is None else box_edges(box)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            controls = bezier_segments(curve)
            self._count = self._needed(controls, self._tolerance / _FINER_SEGMENTS)
        self._degree = controls.shape[1] - 1
        self._serves = bool((self._count <= _MOST_PIECES).all())
        if self._serves:
            self._set_vertices()
            merged = flatten_pieces(curve, tolerance, box).parameters.size
            self._serves = merged >= _MERGED / np.sqrt(_FINER_SEGMENTS) * (self._segment.size + 1)

    def _set_vertices(self) -> None:
        self._segment, step = equal_parts(self._count.astype(np.intp))
        self._local = step / self._count[self._segment]
        self._weights = weights(self._local, self._degree)[:, None, :]
        self._squared = self._count * self._count

    def _needed(self, controls: FloatArray, tolerance: float) -> FloatArray:
        """Return into how many equal pieces each segment is to be divided."""
        need = np.maximum(1.0, np.ceil(np.sqrt(chord_bound(controls) / tolerance)))
        return need if self._edges is None else np.where(may_enter(controls, self._edges), need, 1.0)

    def follow(self, curve: ParametricCurve) -> Pieces | None:
        """Return the polyline of another curve.

        Parameters
        ----------
        curve : ParametricCurve
            Of dim 2, with as many segments of the same degree.

        Returns
        -------
        Pieces or None
            None where the vertices do not serve for this curve.
        """
        if not self._serves or curve.degree != self._degree or len(curve.breaks) != self._count.size + 1:
            return None
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            controls = drawable_pieces(curve)
            if controls is None:
                return None
            deviation = chord_bound(controls) / self._squared
            if self._misses(controls, deviation) or self._wastes(deviation):
                return None
            t = self._parameters(curve)
            # On the shortest of segments no float lies between two vertices.
            if not (t[1:] > t[:-1]).all():
                return None
            return Pieces(t, self._points(curve, controls), deviation[self._segment])

    def _misses(self, controls: FloatArray, deviation: FloatArray) -> bool:
        """Return whether a segment in the box needs more vertices; deviations outside become infinite."""
        off = np.flatnonzero(~(deviation <= self._tolerance))
        if not off.size:
            return False
        if self._edges is None or not np.isfinite(deviation).all():
            return True
        deviation[off] = np.inf
        return bool(may_enter(controls[off], self._edges).any())

    def _wastes(self, deviation: FloatArray) -> bool:
        """Whether far fewer vertices would do."""
        inside = deviation < np.inf
        share = np.sqrt(deviation[inside] * (_FINER_SEGMENTS / self._tolerance))
        needed = float(share @ self._count[inside]) + self._count.size
        return self._segment.size > _WASTE * needed

    def _parameters(self, curve: ParametricCurve) -> FloatArray:
        breaks = curve.breaks
        start, end = breaks[self._segment], breaks[1:][self._segment]
        t = np.empty(self._segment.size + 1)
        t[:-1] = np.minimum(start + self._local * (end - start), end)
        t[-1] = breaks[-1]
        return t

    def _points(self, curve: ParametricCurve, controls: FloatArray) -> FloatArray:
        points = np.empty((self._segment.size + 1, 2))
        np.matmul(self._weights, controls[self._segment], out=points[:-1, None, :])
        points[-1] = curve.points[-1]
        return points
