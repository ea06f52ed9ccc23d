"""Polylines of a piecewise polynomial curve that changes, as under a hand that drags it.

Where vertices lie on their segments is kept from one curve to the next: only the control points change,
and their second differences prove whether the vertices still lie close enough.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, box_edges, tolerance_value
from curvecore.bezier.bernstein_algebra import weights
from curvecore.bezier.control_points import bezier_segments, drawable_pieces, equal_parts
from curvecore.bezier.flatten import flatten_pieces
from curvecore.bezier.polylines import Pieces, chord_bound, may_enter
from curvecore.families.curve import ParametricCurve

_FINER = 1.5  # of the tolerance: room for segments to bend more before new vertices are needed
_WASTE = 2.0  # times the vertices needed, above which they are chosen anew
_MERGED = 0.9  # share of vertices, below which leaving some out saves more than is gained here
_MOST_PIECES = 64  # a segment


class FrozenSegments:
    """Places of vertices on the segments of one curve, which serve for others of as many segments.

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
            self._count = self._needed(controls, self._tolerance / _FINER)
        self._degree = controls.shape[1] - 1
        self._serves = bool((self._count <= _MOST_PIECES).all())
        if self._serves:
            self._place_vertices()
            merged = flatten_pieces(curve, tolerance, box).parameters.size
            self._serves = merged >= _MERGED / np.sqrt(_FINER) * (self._segment.size + 1)

    def _place_vertices(self) -> None:
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
        """Whether a segment in the box needs more; what is outside of it counts as infinitely far off."""
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
        share = np.sqrt(deviation[inside] * (_FINER / self._tolerance))
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
