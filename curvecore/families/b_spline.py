"""Cubic B-splines: pieces that join with continuous second derivatives, over control points."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import DoubleDouble, add, difference, divide, made_finite, multiply
from curvecore.arrays import BoolArray, FloatArray, IntArray, parameter_row
from curvecore.bezier.bernstein import elevated
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import JOINT_ORDERS, JointDerivatives
from curvecore.families.same_shape import joint_jets, pieces_of
from curvecore.parametrization import with_one_more


class BSplineCurve(ParametricCurve):
    """Cubic pieces that join with continuous curvature, each shaped by four control points.

    Clamped: the curve begins at the first control point and ends at the last. The knots inside are
    t_2, ..., t_(n-3), as for the interpolating spline without knots next to its ends: n points have n - 4 of
    them, so that every knot is a parameter, and one more knot is one more point. t_1 and t_(n-2) do nothing.
    Three points have no knots inside and degree 2, two have degree 1.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        The control points p_i, finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    BezierCurve : One polynomial that all control points pull.
    CubicSplineCurve : The same pieces through the points.

    Notes
    -----
    The functions are those of de Boor and Cox [1]_. With u = 2**-53, values and derivatives up to the
    third differ from the exact ones by at most 25 u sum |B_i^(order)(t)| |p_i|, inside the domain and
    outside, where the first and the last piece go on. m values take O(m log n)
    operations.

    References
    ----------
    .. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapters IX to XI.

    Examples
    --------
    >>> from curvecore import BSplineCurve
    >>> curve = BSplineCurve([[0, 0], [0, 3], [3, 3], [3, 0], [6, 0]], [0, 1, 2, 3, 4])
    >>> curve.evaluate(2).round(9).tolist()
    [2.25, 2.25]
    """

    __slots__ = ()

    name = "b_spline"
    title = "B-spline"
    rank = 80
    functions = "B-spline functions"
    interpolates = False
    most_points = None

    @property
    def degree(self) -> int:
        """The degree of the pieces: 3, less of fewer than four points."""
        return min(3, len(self._parameters) - 1)

    @property
    def breaks(self) -> FloatArray:
        """The knots, each once: t_0, t_2, ..., t_(n-3), t_(n-1)."""
        t = self._parameters
        return np.concatenate((t[:1], t[2:-2], t[-1:]))

    @property
    def knots(self) -> FloatArray:
        """The knots, the ends as often as the degree and once more; shape (n + degree + 1,)."""
        t = self._parameters
        return np.concatenate((np.repeat(t[0], self.degree + 1), t[2:-2], np.repeat(t[-1], self.degree + 1)))

    @property
    def nodes(self) -> FloatArray:
        """The Greville abscissae: means of the `degree` knots inside each function's support."""
        p, n = self.degree, len(self._parameters)
        inner = self.knots[np.arange(1, n + 1)[:, None] + np.arange(p)]
        # Of what begins at the first knot, so that no rounding moves them beyond the ends.
        means = inner[:, 0] + (inner - inner[:, :1]).mean(axis=1)
        return np.asarray(np.minimum(means, self.domain[1]))

    @property
    def is_positive(self) -> bool:
        """True: no B-spline is negative in the domain."""
        return True

    def support(self, index: int) -> tuple[float, float]:
        """Return the interval between the knots outside of which B_index is 0."""
        knots = self.knots
        return float(knots[index]), float(knots[index + self.degree + 1])

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        first, values = self._local(t, order)
        curve = np.zeros((t.size, self.points.shape[1]))
        for k in range(values.shape[1]):
            curve += values[:, k, None] * self.points[first + k]
        return made_finite(curve)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        first, values = self._local(t, order)
        result = np.zeros((t.size, len(self._parameters)))
        np.put_along_axis(result, first[:, None] + np.arange(values.shape[1]), values, axis=1)
        return result

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, n, dim): splines, with a second knot at t_i.

        The derivative of a divided difference by one of its arguments has that argument twice. At t_i it is
        that of the piece to the right.
        """
        at = parameter_row(t)
        p, n = self.degree, len(self._parameters)
        interval = np.searchsorted(self._parameters[2:-2], at, side="right") + p
        result = np.zeros((at.size, n, self.points.shape[1]))
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            self._put_end_moves(result, at)
            for away in range(1 - p, p + 1):
                # Of one inner knot j for each t, beside or before its piece.
                j = interval + away
                some = np.flatnonzero((p < j) & (j < n))
                result[some, j[some] + 1 - p] = self._knot_moves(at[some], interval[some], j[some])
        return made_finite(result)

    def _knot_moves(self, t: FloatArray, interval: IntArray, j: IntArray) -> FloatArray:
        """Return dc(t)/dknots[j] of one inner knot for each t, (m, dim)."""
        p, n, knots = self.degree, len(self._parameters), self.knots
        piece = interval + (j <= interval)
        window = piece + np.arange(1 - p, p + 1)[:, None]
        functions = _functions(t, knots[window - (window > j)])
        moves = np.zeros((t.size, self.points.shape[1]))
        for k in range(p + 1):
            # The function of knots i to i + p + 1, of which knots[j] is there twice.
            i = piece - p + k
            counts = (j - p <= i) & (i <= j)
            i = np.clip(i, 1, n - 1)
            length = np.where(counts, knots[i + p] - knots[i], 1.0)
            share = np.where(counts, functions[:, k] / length, 0.0)
            moves -= share[:, None] * (self.points[i] - self.points[i - 1])
        return moves

    def _put_end_moves(self, result: FloatArray, t: FloatArray) -> None:
        """Write dc(t)/dt_i of both ends, whose degree + 1 knots move together."""
        p, n, knots = self.degree, len(self._parameters), self.knots
        first, functions = self._local(t, 0)
        for k in range(p + 1):
            i = first + k
            # Both ends of a step between points: of function i, behind the first knot and before the last.
            ahead, behind = np.maximum(p - i, 0), np.maximum(i - (n - 1 - p), 0)
            for end, here, weight in (
                (0, np.minimum(i + 1, n - 1), ahead),
                (n - 1, np.maximum(i, 1), behind),
            ):
                step = self.points[here] - self.points[here - 1]
                length = knots[here + p] - knots[0] if end == 0 else knots[-1] - knots[here]
                result[:, end] -= (weight * functions[:, k] / length)[:, None] * step

    def bezier_pieces(self) -> FloatArray:
        """Return the Bezier control points between the knots: the blossoms at their ends."""
        p, breaks = self.degree, self.breaks
        interval = np.arange(len(breaks) - 1) + p
        start, end = breaks[:-1], breaks[1:]
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            columns = [self._blossom(interval, [start] * (p - k) + [end] * k) for k in range(p + 1)]
        return made_finite(np.stack(columns, axis=1))

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where pieces are of a higher degree, or an acceleration jumps."""
        joint_jets(pieces_of(curve, 3, cls.title), 2, cls.title)

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> Self:
        """Return the control points of cubic pieces whose accelerations do not jump: a knot where they meet.

        Each is a blossom at the three knots inside of a function's support, of the longer of two pieces.
        """
        chain = pieces_of(curve, 3, cls.title)
        joint_jets(chain, 2, cls.title)
        controls, h = chain.controls, np.diff(chain.breaks)[:, None]
        # Of the piece behind a knot at the next knot but one, of that ahead of it at the one before.
        ahead = controls[:-1, 2] + h[1:] / h[:-1] * (controls[:-1, 2] - controls[:-1, 1])
        behind = controls[1:, 1] + h[:-1] / h[1:] * (controls[1:, 1] - controls[1:, 2])
        inner = np.where(h[:-1] >= h[1:], ahead, behind)
        first, last = controls[0], controls[-1]
        points = np.concatenate((first[:2], inner, last[2:]))
        return cls.from_jets(points[:, None], _with_idle(chain.breaks))

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c to c''' at the parameters: on both sides of a knot they are the same but for the last."""
        t = self._parameters[1:] if before else self._parameters[:-1]
        values, scale = [], []
        for order in range(JOINT_ORDERS):
            beside = before and order >= self.degree
            with np.errstate(over="ignore", under="ignore", invalid="ignore"):
                first, functions = self._local(np.nextafter(t, -np.inf) if beside else t, order)
            made_finite(functions)
            data = self.points[first[:, None] + np.arange(functions.shape[1])]
            # The functions add up to 1: where the origin lies counts for nothing.
            data = data - (data[:, :1] if order else 0.0)
            values.append(np.einsum("mk,mkd->md", functions, data))
            scale.append(np.einsum("mk,mkd->md", np.abs(functions), np.abs(data)).max(axis=1))
        return JointDerivatives(np.stack(values, axis=1), np.stack(scale, axis=1))

    @property
    def idle_parameters(self) -> BoolArray:
        """The parameters that are no knots."""
        return ~np.isin(self._parameters, self.breaks)

    def refined(self, t: float) -> Self | None:
        """Return the same curve with a control point more, by a knot at t; None where there is one.

        Of fewer than four points the degree is raised instead.
        """
        if t in self.breaks:
            return None
        if len(self._parameters) < 4:
            return type(self)(elevated(self.points[None])[0], with_one_more(self._parameters, t))
        breaks = self.breaks
        breaks = np.insert(breaks, np.searchsorted(breaks, t), t)
        return type(self)(_with_knot(self._knotted, t).points, self._around(breaks))

    def restricted(self, start: float, end: float) -> Self:
        """Return the same curve between two parameters of its domain, with the knots between them."""
        p = self.degree
        knotted = self._knotted
        for t in (start, end):
            # The ends of the domain are there as often as they have to be.
            for _ in range(p - int(np.count_nonzero(knotted.knots == t))):
                knotted = _with_knot(knotted, t)
        first = int(np.searchsorted(knotted.knots, start, side="right")) - 1 - p
        last = int(np.searchsorted(knotted.knots, end))
        inner = self.breaks[(self.breaks > start) & (self.breaks < end)]
        parameters = self._around(np.concatenate(([start], inner, [end])), last - first)
        return type(self)(knotted.points[first:last], parameters)

    @property
    def _knotted(self) -> _Knotted:
        return _Knotted(self.knots, self.points, self.degree)

    def _around(self, breaks: FloatArray, count: int | None = None) -> FloatArray:
        """Return parameters of which `breaks` are the knots; those next to the ends stay if they can."""
        count = len(breaks) + 2 if count is None else count
        if count < 4:
            return np.linspace(breaks[0], breaks[-1], count)
        parameters, old = _with_idle(breaks), self._parameters
        if len(breaks) > 2 and breaks[0] < old[1] < breaks[1]:
            parameters[1] = old[1]
        if len(breaks) > 2 and breaks[-2] < old[-2] < breaks[-1]:
            parameters[-2] = old[-2]
        return parameters

    def _blossom(self, interval: IntArray, arguments: list[FloatArray]) -> FloatArray:
        """Return the polar form of pieces [knots[j], knots[j + 1]] at `degree` arguments, (k, dim)."""
        knots, p = self.knots, self.degree
        points = [self.points[interval - p + k] for k in range(p + 1)]
        for level, t in enumerate(arguments, start=1):
            for k in range(p, level - 1, -1):
                start, end = knots[interval - p + k], knots[interval + 1 + k - level]
                s, r = ((t - start) / (end - start))[:, None], ((end - t) / (end - start))[:, None]
                points[k] = r * points[k - 1] + s * points[k]
        return points[p]

    # The functions that are not zero on the piece of each t

    def _local(self, t: FloatArray, order: int) -> tuple[IntArray, FloatArray]:
        """Return the index of the first of the degree + 1 functions on each t's piece, and their values."""
        p = self.degree
        first = np.searchsorted(self._parameters[2:-2], t, side="right")
        if order > p:
            return first, np.zeros((t.size, p + 1))
        if order:
            return first, self._derivatives(t, first + p, order)
        return first, _functions(t, self.knots[first + np.arange(1, 2 * p + 1)[:, None]])

    def _derivatives(self, t: FloatArray, interval: IntArray, order: int) -> FloatArray:
        """Return derivatives of the functions, with 106 bits: each may vanish within its piece."""
        first, last = self.domain
        _, exponent = np.frexp(last - first)
        knots, p = np.ldexp(self.knots, -exponent), self.degree
        t = np.ldexp(t, -exponent)
        zero = DoubleDouble(np.zeros(t.size), np.zeros(t.size))
        values = [DoubleDouble(np.ones(t.size), np.zeros(t.size))]
        for level in range(1, p + 1):
            carried, next_values = zero, []
            is_value = level <= p - order
            for k in range(level):
                start, end = knots[interval + 1 + k - level], knots[interval + 1 + k]
                share = divide(values[k], difference(end, start))
                if is_value:
                    next_values.append(add(carried, multiply(difference(end, t), share)))
                    carried = multiply(difference(t, start), share)
                else:
                    share = multiply(share, DoubleDouble(np.array(float(level)), np.array(0.0)))
                    next_values.append(add(carried, DoubleDouble(-share.high, -share.low)))
                    carried = share
            values = [*next_values, carried]
        stacked = np.stack([value.high for value in values], axis=1)
        return np.asarray(np.ldexp(stacked, -order * exponent))


def _functions(t: FloatArray, knots: FloatArray) -> FloatArray:
    """Return the functions on each t's piece, (m, degree + 1), by the recurrence of de Boor and Cox.

    Nothing cancels. Outside the domain the factors of one function have one sign as well, for the knots at
    the end that is passed are the same.

    Parameters
    ----------
    t : ndarray, shape (m,)
    knots : ndarray, shape (2 degree, m)
        As many on either side of each t's piece as the degree is.
    """
    p = len(knots) // 2
    values = np.zeros((p + 1, t.size))
    values[0] = 1.0
    for level in range(1, p + 1):
        carried = np.zeros(t.size)
        for k in range(level):
            start, end = knots[p + k - level], knots[p + k]
            length, here = end - start, values[k].copy()
            values[k] = carried + (end - t) / length * here
            carried = (t - start) / length * here
        values[level] = carried
    return values.T


def _with_idle(breaks: FloatArray) -> FloatArray:
    """Return parameters of which `breaks` are the knots: two more, beside the ends."""
    start, end = breaks[:2].tolist(), breaks[-2:].tolist()
    share = 1.0 / 3.0 if len(breaks) == 2 else 0.5
    low, high = start[0] + share * (start[1] - start[0]), end[1] - share * (end[1] - end[0])
    return np.concatenate((breaks[:1], [low], breaks[1:-1], [high], breaks[-1:]))


class _Knotted(NamedTuple):
    """A spline of a degree with knots that may be there more than once.

    Attributes
    ----------
    knots : ndarray, shape (n + degree + 1,)
    points : ndarray, shape (n, dim)
    degree : int
    """

    knots: FloatArray
    points: FloatArray
    degree: int


def _with_knot(spline: _Knotted, t: float) -> _Knotted:
    """Return the same spline with one more knot: convex combinations of its control points (Boehm 1980)."""
    knots, points, p = spline
    interval = int(np.searchsorted(knots, t, side="right")) - 1
    i = np.arange(interval - p + 1, interval + 1)
    start, end = knots[i], knots[i + p]
    s, r = ((t - start) / (end - start))[:, None], ((end - t) / (end - start))[:, None]
    longer = np.concatenate((points[: i[0]], r * points[i - 1] + s * points[i], points[interval:]))
    return _Knotted(np.insert(knots, interval + 1, t), longer, p)
