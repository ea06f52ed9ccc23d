"""Polylines of a curve while some of its data move along, and all else rests.

The curve is linear in its data: where all that move go the same way D, it is

    c(t) = c_0(t) + w(t) D

and vertices, once chosen, follow by a product each. No curve is made, and
nothing is measured: how far a piece leaves its chord grows with |D| at most
as fast as that of w does, so that vertices are chosen for all ways up to a
reach at once.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from curvecore.arithmetic import LIMIT
from curvecore.arrays import BoolArray, FloatArray, IntArray, box_edges, tolerance_value
from curvecore.bezier.bernstein import weights
from curvecore.bezier.control_points import drawable_pieces, equal_parts
from curvecore.bezier.flatten import Pieces, chord_bound, may_enter, sampled_pieces
from curvecore.families.curve import ParametricCurve

_REACH, _FARTHEST = 100.0, 1600.0  # tolerances: so far around a position vertices serve, as steps are long
_STEPS = 8.0  # so many more of the last one shall be within reach
_LEAST_REACH = 25.0
# Above these choosing them anew at every position saves more than is gained here.
_MOST_VERTICES, _MOST_SAMPLES = 1024, 2048
_FINER, _FINER_SAMPLES = 4.0, 6.0  # of the tolerance: room for vertices to be left out
_MARGIN = 1.6  # on an estimate from one parameter for the whole of a piece
_ROUNDS = 4  # of halving what is not close enough


class _Samples(NamedTuple):
    """Parameters (m,), the base, points before anything moves, (m, 2), and w, (m, 1)."""

    t: FloatArray
    base: FloatArray
    w: FloatArray


class _Vertices(NamedTuple):
    """Samples with bounds of how far the pieces between them leave their chords, (m - 1,)."""

    t: FloatArray
    base: FloatArray
    w: FloatArray
    deviation: FloatArray


class _Drawn(NamedTuple):
    """Vertices, their base x + iy and w (m, 1) complex: of pairs NumPy moves half as many."""

    t: FloatArray
    base: NDArray[np.complex128]
    w: NDArray[np.complex128]
    deviation: FloatArray


class MovedPoints:
    """Polylines of one curve, of which a part moves by any vector.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2, before anything moves.
    unit : ParametricCurve
        Of dim 1, of the same family and parameters: by how much the curve
        moves at each t when its part moves by 1.
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
    FrozenSegments, FrozenFlattening : The same for any other change of a curve.

    Examples
    --------
    >>> from curvecore import LagrangeCurve
    >>> from curvecore.drag.moved_points import MovedPoints
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> moved = MovedPoints(curve, curve.with_jets([[[0]], [[1]], [[0]]]), 0.01)
    >>> pieces = moved.at(0.0, 0.25)
    >>> pieces.points[pieces.parameters == 1].tolist(), pieces.reached <= 0.01
    ([[1.0, 2.25]], True)
    """

    def __init__(
        self, curve: ParametricCurve, unit: ParametricCurve, tolerance: float, box: ArrayLike | None = None
    ) -> None:
        self._curve, self._unit, self._tolerance = curve, unit, tolerance_value(tolerance)
        self._edges = None if box is None else box_edges(box)
        self._reach, self._centre, self._last = 0.0, (math.inf, math.inf), (0.0, 0.0)
        self._vertices: _Drawn | None = None
        # All samples, with those that are left out.
        self._samples: _Samples | None = None

    def at(self, dx: float, dy: float) -> Pieces | None:
        """Return the polyline of the curve whose part has moved by a vector.

        Parameters
        ----------
        dx, dy : float
            Finite.

        Returns
        -------
        Pieces or None
            None where choosing vertices for each position is quicker.
        """
        here, last = (dx, dy), self._last
        self._last = here
        if not math.dist(here, self._centre) <= self._reach:
            self._centre, reach = here, _STEPS * math.dist(here, last) / self._tolerance
            with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
                self._choose(min(max(reach, _REACH), _FARTHEST))
        if self._vertices is None:
            return None
        t, base, w, deviation = self._vertices
        return Pieces(t, (base + w * complex(dx, dy)).view(np.float64), deviation)

    def _choose(self, reach: float) -> None:
        """Choose vertices that serve within reach of the centre, a smaller one where that takes too many."""
        self._reach = reach * self._tolerance
        self._vertices = self._vertices_within_reach()
        if self._vertices is None and reach > _LEAST_REACH:
            self._choose(max(0.25 * reach, _LEAST_REACH))
            if self._vertices is None:
                # No more is tried until it is elsewhere.
                self._reach = reach * self._tolerance

    def _vertices_within_reach(self) -> _Drawn | None:
        """Return vertices that serve within reach of the centre; None where they are too many."""
        if len(self._curve.breaks) > _MOST_VERTICES:
            return None
        controls = drawable_pieces(self._curve)
        vertices = self._sampled() if controls is None else self._on_segments(controls)
        if vertices is None or not np.isfinite(vertices.base).all() or not np.isfinite(vertices.w).all():
            return None
        t, base, w, deviation = self._merged(vertices)
        return _Drawn(t, base.view(np.complex128), w.astype(np.complex128), deviation)

    def _on_segments(self, controls: FloatArray) -> _Vertices | None:
        """Divide each segment equally: bounds of second derivatives bound the deviations."""
        unit = drawable_pieces(self._unit)
        assert unit is not None
        moved = controls + unit * self._centre
        deviation = chord_bound(moved) + self._reach * chord_bound(np.pad(unit, ((0, 0), (0, 0), (0, 1))))
        is_inside = self._enters(moved, self._reach * np.abs(unit).max(axis=(1, 2)))
        count = np.maximum(1.0, np.ceil(np.sqrt(_FINER * deviation / self._tolerance)))
        count = np.where(is_inside, count, 1.0)
        if not count.sum() < _MOST_VERTICES:
            return None
        segment, step = equal_parts(count.astype(np.intp))
        local = step / count[segment]
        weight = weights(local, controls.shape[1] - 1)[:, None, :]
        base, w = (
            np.vstack([np.matmul(weight, values[segment])[:, 0], values[-1, -1:]])
            for values in (controls, unit)
        )
        start, end = self._curve.breaks[segment], self._curve.breaks[1:][segment]
        t = np.append(np.minimum(start + local * (end - start), end), self._curve.breaks[-1])
        if not (t[1:] > t[:-1]).all():
            return None
        return _Vertices(t, base, w, np.where(is_inside, deviation / (count * count), np.inf)[segment])

    def _sampled(self) -> _Vertices | None:
        """Return samples halved where they are too far apart for all moves within reach of the centre."""
        samples = self._samples or self._sample(self._first_samples())
        for _ in range(_ROUNDS):
            vertices = self._measured(samples)
            misses = (vertices.deviation > self._tolerance / _FINER_SAMPLES) & (vertices.deviation < np.inf)
            if not misses.any():
                self._samples = samples
                return vertices
            t = np.sort(np.concatenate([samples.t, 0.5 * (samples.t[1:] + samples.t[:-1])[misses]]))
            if len(t) > _MOST_SAMPLES:
                break
            samples = self._sample(t)
        # From the beginning, the next time.
        self._samples = None
        return None

    def _first_samples(self) -> FloatArray:
        moved = self._curve.with_jets(self._curve.jets + self._unit.jets * self._centre)
        return sampled_pieces(moved, self._tolerance / _FINER_SAMPLES, self._edges).parameters

    def _sample(self, t: FloatArray) -> _Samples:
        curve, unit = self._curve.evaluate(t), self._unit.evaluate(t)
        return _Samples(t, np.clip(curve, -LIMIT, LIMIT), np.clip(unit, -LIMIT, LIMIT))

    def _measured(self, samples: _Samples) -> _Vertices:
        """Return vertices with estimates of the deviations, from their own second differences.

        c'' is 2 o / (h k) where a sample lies o off the chord of its neighbours, h and k away from it in t; a
        piece of length h leaves its chord by |c''| h**2 / 8.
        """
        t, base, w = samples
        moved, h = base + w * self._centre, np.diff(t)[:, None]
        off = np.zeros(len(t))
        for values, size in ((moved, 1.0), (w, self._reach)):
            chord = (values[2:] * h[:-1] + values[:-2] * h[1:]) / (h[:-1] + h[1:])
            off[1:-1] += size * np.sqrt(((values[1:-1] - chord) ** 2).sum(axis=1))
        quotient = h[1:, 0] / h[:-1, 0]
        deviation = np.zeros(len(h))
        deviation[:-1] = off[1:-1] / quotient
        deviation[1:] = np.maximum(deviation[1:], off[1:-1] * quotient)
        deviation *= 0.25 * _MARGIN
        hulls = np.stack([moved[:-1], moved[1:]], axis=1)
        sizes = self._reach * np.abs(w[:, 0])
        near = np.maximum(off[1:] + sizes[1:], off[:-1] + sizes[:-1])
        return _Vertices(t, base, w, np.where(self._enters(hulls, near), deviation, np.inf))

    def _enters(self, points: FloatArray, room: FloatArray) -> BoolArray:
        """Tell which hulls, of points (k, j, 2) with so much room around them, (k,), the box may show."""
        if self._edges is None:
            return np.ones(len(points), dtype=bool)
        low, high = points.min(axis=1) - room[:, None], points.max(axis=1) + room[:, None]
        return may_enter(np.stack([low, high], axis=1), self._edges)

    def _merged(self, vertices: _Vertices) -> _Vertices:
        """Leave out vertices that the tolerance needs nowhere within reach, as `merged_pieces` does."""
        t, base, w, deviation = vertices
        offset, idle = 0, 0
        while idle < 2 and len(t) > 2:
            middle = np.arange(1 + offset, len(t) - 1, 2)
            joined = np.maximum(deviation[middle - 1], deviation[middle])
            joined += self._off_chord(base + w * self._centre, w, middle)
            dropped = joined <= self._tolerance
            deviation[middle[dropped] - 1] = joined[dropped]
            idle = 0 if 32 * np.count_nonzero(dropped) > len(t) else idle + 1
            stays = np.ones(len(t), dtype=bool)
            stays[middle[dropped]] = False
            t, base, w, deviation = t[stays], base[stays], w[stays], deviation[stays[:-1]]
            offset = 1 - offset
        return _Vertices(t, base, w, deviation)

    def _off_chord(self, points: FloatArray, w: FloatArray, middle: IntArray) -> FloatArray:
        """Return bounds of the distances of vertices from the chord of their neighbours, within reach."""
        start, chord = points[middle - 1], points[middle + 1] - points[middle - 1]
        square = (chord**2).sum(axis=1)
        share = ((points[middle] - start) * chord).sum(axis=1) / np.where(square > 0.0, square, 1.0)
        share = np.clip(share, 0.0, 1.0)[:, None]
        off = points[middle] - start - share * chord
        direction = w[middle] - (1.0 - share) * w[middle - 1] - share * w[middle + 1]
        return np.asarray(np.hypot(off[:, 0], off[:, 1]) + self._reach * np.abs(direction[:, 0]))
