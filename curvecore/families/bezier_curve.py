"""Bezier curves: one polynomial over its control points, and the Bernstein functions.

Of high degree, a few hundred functions count at a t. B_i(x) is the chance of i heads among N tosses, which
lie within some sqrt(N) of N x: by Hoeffding's inequality all functions with |i - N x| >= W add up to
2 exp(-2 W**2 / N) at most [1]_.

References
----------
.. [1] W. Hoeffding, "Probability inequalities for sums of bounded random variables", Journal of the American
   Statistical Association 58 (1963) 13-30, theorem 2.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from math import comb
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import (
    MULTIPLIED,
    DoubleDouble,
    ExponentArray,
    Scaled,
    add,
    difference,
    divide,
    made_finite,
    multiply,
    power,
    rescaled,
    scale_by_power,
    small_power,
)
from curvecore.arrays import BoolArray, FloatArray, parameter_row, read_only
from curvecore.bezier.bernstein import elevated
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import Interpolant
from curvecore.families.same_shape import check_one_polynomial, pieces_of
from curvecore.parametrization import chebyshev, spread, uniform, with_one_more

_DRAWN = 8
"""Degree up to which the one piece is drawn and searched as it is, as `pieces` has it of all curves."""

_INTERPOLATED = 64
"""Control points up to which values at so many parameters stand for them."""

_PLAIN, _SAFE = 48, 900.0
"""Degree up to which functions may be plain products; powers of 2 that their factors stay within.

The largest binomial of that degree is below 2**48; inside the domain a product is at least 2**-48 times the
lesser of its factors.
"""

_FACTORED = 3
"""Order up to which derivatives of the functions are products; above, differences of such."""

_CHUNK = 1 << 15  # function values at a time


class BezierCurve(ParametricCurve):
    """One polynomial from the first control point to the last, shaped by the others.

    Of degree n - 1: c(t) = sum over i of B_i(x) p_i with the Bernstein functions
    B_i(x) = C(n - 1, i) x**i (1 - x)**(n - 1 - i), x = (t - t_0) / (t_(n-1) - t_0) [1]_. The parameters
    between the first and the last do nothing.

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
    BSplineCurve : Cubic pieces, each of which four control points pull.
    LagrangeCurve : The polynomial through its points.

    Notes
    -----
    With u = 2**-53, values and derivatives up to the third differ from the exact ones by at most
    c u sum |B_i^(order)(t)| |p_i|, c at most 25 for n <= 60, inside the domain and outside: x and 1 - x
    enter with 106 bits, for their powers multiply what is lost. A value takes O(n) operations. Results
    beyond the floating point range become the largest finite number of their sign. In the domain the
    functions are positive.

    References
    ----------
    .. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann 2002, chapters 5 and 6.

    Examples
    --------
    >>> from curvecore import BezierCurve
    >>> BezierCurve([[0, 0], [0, 4], [4, 4], [4, 0]], [0, 1, 2, 3]).evaluate(1.5).round(9).tolist()
    [2.0, 3.0]
    """

    __slots__ = ()

    name = "bezier"
    title = "Bézier"
    rank = 70
    functions = "Bernstein functions"
    interpolates = False
    most_points = None

    @property
    def degree(self) -> int:
        """The degree n - 1."""
        return len(self._parameters) - 1

    @property
    def is_positive(self) -> bool:
        """True: no Bernstein function is negative in the domain."""
        return True

    @property
    def nodes(self) -> FloatArray:
        """The Greville abscissae, where each function is largest: they lie evenly."""
        first, last = self.domain
        n = len(self._parameters)
        return np.append(first + (last - first) * (np.arange(n - 1) / (n - 1)), last)

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        first, last = self.domain
        inside = (t > first) & (t < last)
        if order or self.degree <= MULTIPLIED or not inside.any():
            return self._summed(t, order)
        at = _Coordinates.of(t[inside], first, last)
        x, y = (DoubleDouble(coordinate.high[:, 0], coordinate.low[:, 0]) for coordinate in (at.x, at.y))
        curve = np.empty((t.size, self.points.shape[1]))
        _, exponent = np.frexp(np.abs(self.points).max(axis=0))
        curve[inside] = np.ldexp(windowed_values(np.ldexp(self.points, -exponent), x, y), exponent)
        curve[~inside] = self._summed(t[~inside], 0)
        return curve

    def _summed(self, t: FloatArray, order: int) -> FloatArray:
        """Return the curve as the sum of all functions times the points."""
        curve = np.empty((t.size, self.points.shape[1]))
        _, exponent = np.frexp(np.abs(self.points).max(axis=0))
        points = np.ldexp(self.points, -exponent)
        for part, at in self._parts(t):
            values = _in_range(at, self.degree, order)
            if values is None:
                functions = _derivatives(at, self.degree, order)
                common = functions.exponent.max(axis=1, keepdims=True)
                values = scale_by_power(functions.mantissa, functions.exponent - common)
                curve[part] = scale_by_power(made_finite(values @ points), exponent + common)
            else:
                curve[part] = scale_by_power(values @ points, exponent)
        return curve

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        result = np.empty((t.size, len(self._parameters)))
        for part, at in self._parts(t):
            values = _in_range(at, self.degree, order)
            if values is None:
                functions = _derivatives(at, self.degree, order)
                values = scale_by_power(made_finite(functions.mantissa), functions.exponent)
            result[part] = values
        return result

    def bezier_pieces(self) -> FloatArray | None:
        """Return the control points, shape (1, n, dim); None of a degree above 8.

        A control polygon of high degree is far from its curve, and what halves it takes n**2 operations.
        """
        return self.points[None] if self.degree <= _DRAWN else None

    def exact_pieces(self) -> FloatArray:
        """Return the control points, shape (1, n, dim), of any degree."""
        return self.points[None]

    def interpolants(self) -> list[Interpolant] | None:
        """Return the one polynomial by its values at Chebyshev points, each rounded; None of more than 64."""
        n = len(self._parameters)
        if n > _INTERPOLATED:
            return None
        t = spread(chebyshev(n), *self.domain)
        return [Interpolant(t, self.evaluate(t)[:, None])]

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where a curve is not one polynomial."""
        check_one_polynomial(curve, cls.title)

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> Self:
        """Return the control points of a curve that is one polynomial."""
        cls.check_shape(curve)
        chain = pieces_of(curve, None, cls.title)
        parameters = spread(uniform(chain.controls.shape[1]), *curve.domain)
        return cls.from_jets(chain.controls[0][:, None], parameters)

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, n, dim): the ends stretch the curve along t, the others do nothing."""
        at = parameter_row(t)
        first, last = self.domain
        moves = np.zeros((at.size, *self.points.shape))
        velocity = self.evaluate(at, 1)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            moves[:, 0] = -velocity * ((last - at) / (last - first))[:, None]
            moves[:, -1] = -velocity * ((at - first) / (last - first))[:, None]
        return moves

    @property
    def idle_parameters(self) -> BoolArray:
        """All parameters but those at the ends."""
        idle = np.ones(len(self._parameters), dtype=bool)
        idle[[0, -1]] = False
        return idle

    def refined(self, t: float) -> Self:
        """Return the same curve with a control point more, wherever t is: its degree is raised by one."""
        return type(self)(elevated(self.points[None])[0], with_one_more(self._parameters, t))

    def restricted(self, start: float, end: float) -> Self:
        """Return the same curve between two parameters of its domain, of the same degree.

        By de Casteljau's algorithm: convex combinations, so that rounding does not grow.
        """
        first, last = self.domain
        points = _cut(self.points, (start - first) / (last - first), (last - start) / (last - first))[1]
        points = _cut(points, (end - start) / (last - start), (last - end) / (last - start))[0]
        inner = start + (self._parameters[1:-1] - first) / (last - first) * (end - start)
        return type(self)(points, np.concatenate(([start], inner, [end])))

    def _parts(self, t: FloatArray) -> Iterator[tuple[slice, _Coordinates]]:
        """Yield the parameters part by part, as many at a time as need little room."""
        step = max(1, _CHUNK // len(self._parameters))
        for begin in range(0, t.size, step):
            part = slice(begin, begin + step)
            yield part, _Coordinates.of(t[part], *self.domain)


class _Coordinates(NamedTuple):
    """Positions of parameters relative to the domain.

    Attributes
    ----------
    x, y : DoubleDouble, shape (m, 1)
        (t - t_0) / h and (t_(n-1) - t) / h, h = t_(n-1) - t_0.
    length, exponent : float and int
        h is length * 2**exponent.
    """

    x: DoubleDouble
    y: DoubleDouble
    length: float
    exponent: int

    @staticmethod
    def of(t: FloatArray, first: float, last: float) -> _Coordinates:
        start, end = np.array(first), np.array(last)
        h, exponent = np.frexp(end - start)
        whole = rescaled(difference(end, start), -exponent)
        # Both at once: each step through few numbers takes NumPy as long as the numbers do.
        upper, lower = np.empty((2, 2, t.size, 1))
        upper[0, :, 0], lower[0], upper[1], lower[1, :, 0] = t, first, last, t
        high, low = divide(rescaled(difference(upper, lower), -exponent), whole)
        return _Coordinates(
            DoubleDouble(high[0], low[0]), DoubleDouble(high[1], low[1]), float(h), int(exponent)
        )


def _in_range(at: _Coordinates, degree: int, order: int) -> FloatArray | None:
    """Return the functions, shape (m, degree + 1), where they are products in range; None elsewhere.

    (a + b)**i (c + d)**(N - i) is a**i c**(N - i) (1 + i b / a + (N - i) d / c) to all digits.
    """
    if order or degree > _PLAIN:
        return None
    bases = np.concatenate([at.x.high, at.y.high], axis=1)
    sizes = np.abs(bases)
    most = 2.0 ** (_SAFE / degree)
    # Powers of 0 are 0, which lies in no range but is right.
    if not (((sizes <= most) & (sizes >= 1.0 / most)) | (sizes == 0.0)).all():
        return None
    low = np.concatenate([at.x.low, at.y.low], axis=1)
    off = np.divide(low, bases, out=np.zeros_like(bases), where=bases != 0.0)
    table = np.ones((2, degree + 1, len(bases)))
    table[:, 1:] = bases.T[:, None]
    in_x, in_y = np.multiply.accumulate(table, axis=1)
    i = np.arange(degree + 1.0)[:, None]
    values: FloatArray = i * (off[:, 0] - off[:, 1])
    values += 1.0 + degree * off[:, 1]
    values *= in_x
    values *= in_y[::-1]
    values *= np.ldexp(*_binomials(degree))[:, None]
    return values.T


def _derivatives(at: _Coordinates, degree: int, order: int) -> Scaled:
    """Return derivatives of the functions of a degree with respect to t, shape (m, degree + 1)."""
    if order > degree:
        empty = np.zeros((len(at.x.high), degree + 1))
        return Scaled(empty, empty.astype(np.int64))
    if order <= _FACTORED:
        return _factored(at, degree, order)
    lower = _derivatives(at, degree - 1, order - 1)
    common = lower.exponent.max(axis=1, keepdims=True)
    values = np.pad(scale_by_power(lower.mantissa, lower.exponent - common), ((0, 0), (1, 1)))
    mantissa = degree / at.length * (values[:, :-1] - values[:, 1:])
    return Scaled(mantissa, np.broadcast_to(common - at.exponent, mantissa.shape))


def _factored(at: _Coordinates, degree: int, order: int) -> Scaled:
    """Return derivatives as products of powers and of a polynomial of degree `order` at most.

    B_i^(k) h**k = C(N, i) sum over j of (-1)**(k-j) C(k, j) i_(j) (N-i)_(k-j) x**(i-j) y**(N-i-k+j), with
    falling factorials i_(j) = i (i - 1) ... (i - j + 1). The powers that all terms share are taken out; the
    rest, which may vanish, is summed with 106 bits.
    """
    i = np.arange(degree + 1)
    in_x, in_y = power(at.x, np.maximum(i - order, 0)), power(at.y, np.maximum(degree - i - order, 0))
    counts = _binomials(degree)
    rest = _rest(at, i, degree, order) if order else 1.0
    mantissa = in_x.mantissa * in_y.mantissa * counts.mantissa
    exponent = in_x.exponent + in_y.exponent + counts.exponent - order * at.exponent
    return Scaled(mantissa * rest / at.length**order, exponent)


def _rest(at: _Coordinates, i: np.ndarray, degree: int, order: int) -> FloatArray:
    total = None
    for j in range(order + 1):
        factor = (-1.0) ** (order - j) * comb(order, j) * _falling(i, j) * _falling(degree - i, order - j)
        term = DoubleDouble(factor, np.zeros(degree + 1))
        term = multiply(term, small_power(at.x, np.maximum(np.minimum(i, order) - j, 0), order))
        in_y = np.maximum(np.minimum(degree - i, order) - (order - j), 0)
        term = multiply(term, small_power(at.y, in_y, order))
        total = term if total is None else add(total, term)
    assert total is not None
    return np.where(np.isfinite(total.high), total.high, 0.0)


def _falling(i: np.ndarray, count: int) -> FloatArray:
    """Return i (i - 1) ..., `count` factors, exact up to 2**53; 0 where i < count."""
    factors: FloatArray = np.ones(len(i))
    for k in range(count):
        factors = factors * np.maximum(i - k, 0)
    return factors


class _Binomials(NamedTuple):
    """C(N, i), i = 0 .. N, as numbers with exponents; see `Scaled`."""

    mantissa: FloatArray
    exponent: ExponentArray


@lru_cache(maxsize=64)
def _binomials(degree: int) -> _Binomials:
    mantissa, exponent = np.empty(degree + 1), np.empty(degree + 1, dtype=np.int64)
    value = 1
    for i in range(degree + 1):
        shift = max(value.bit_length() - 1000, 0)
        mantissa[i], carried = np.frexp(float(value >> shift))
        exponent[i] = carried + shift
        value = value * (degree - i) // (i + 1)
    return _Binomials(read_only(mantissa), exponent)


def _cut(points: FloatArray, s: float, r: float) -> tuple[FloatArray, FloatArray]:
    """Return the control points on both sides of the parameter s = 1 - r."""
    left, right = points.copy(), points.copy()
    work = points
    for k in range(1, len(points)):
        work = r * work[:-1] + s * work[1:]
        left[k], right[-1 - k] = work[0], work[-1]
    return left, right


# Values of high degree, by the functions that count at t

_LEFT_OUT = 100.0
"""Weights below 2 to minus so many are left out, all of them together."""

_WINDOW_CHUNK = 1 << 16


def windowed_values(points: FloatArray, x: DoubleDouble, y: DoubleDouble) -> FloatArray:
    """Return a Bezier curve at parameters x = 1 - y.

    Parameters
    ----------
    points : ndarray, shape (N + 1, dim)
        The control points.
    x, y : DoubleDouble, shape (m,)
        In (0, 1).

    Returns
    -------
    ndarray, shape (m, dim)
        Off by some ten units in the last place of the points that count, and by 2**-100 of the largest.
    """
    degree = len(points) - 1
    reach = int(np.ceil(np.sqrt(degree * (_LEFT_OUT + 1.0) * np.log(2.0) / 2.0)))
    result = np.empty((len(x.high), points.shape[1]))
    step = max(1, _WINDOW_CHUNK // (2 * reach + 1))
    with np.errstate(all="ignore"):
        for start in range(0, len(result), step):
            part = slice(start, start + step)
            some = (DoubleDouble(whole.high[part, None], whole.low[part, None]) for whole in (x, y))
            ratio = divide(*some)
            middle = np.clip(np.rint(degree * x.high[part]).astype(np.intp), 0, degree)[:, None]
            index = middle + np.arange(-reach, reach + 1)
            weights = _weights(index, middle, reach, degree, ratio)
            near = points[index.clip(0, degree)]
            result[part] = np.einsum("mk,mkd->md", weights, near) / weights.sum(axis=1)[:, None]
    return result


def _weights(
    index: np.ndarray, middle: np.ndarray, reach: int, degree: int, ratio: DoubleDouble
) -> FloatArray:
    """Return the functions over the middle one, by the quotients of neighbours; 0 beyond the ends."""
    before, here, after = index[:, :reach], index[:, reach:-1], index[:, reach + 1 :]
    rising = np.where(here < degree, (degree - here) / np.maximum(after, 1) * ratio.high, 0.0)
    falling = np.where(before >= 0, (before + 1) / np.maximum(degree - before, 1) / ratio.high, 0.0)
    weights = np.ones(index.shape)
    weights[:, reach + 1 :] = np.multiply.accumulate(rising, axis=1)
    weights[:, :reach] = np.multiply.accumulate(falling[:, ::-1], axis=1)[:, ::-1]
    # What the ratio was rounded by, as often as it is a factor.
    weights *= 1.0 + (index - middle) * (ratio.low / ratio.high)
    return weights
