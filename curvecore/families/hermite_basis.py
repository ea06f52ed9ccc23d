"""Cardinal polynomials of two-point Hermite interpolation, in factored form.

On a segment with s = (t - t_i) / h and r = (t_(i+1) - t) / h, r + s = 1, the function f_k belongs to the k-th
derivative at the left end. Both s and r are subtractions of the given numbers, so each is accurate to a
rounding next to its own end; a polynomial expanded in s alone loses that at s = 1. Functions of the right end
follow from g_k(s, r) = (-1)**k f_k(r, s).

A factor in which r and s meet with opposite signs, such as 1 - 3 s = r - 2 s, vanishes within the segment,
and all functions of one order may do so at nearly the same parameter. Such factors are formed in
double-double arithmetic from the exact differences, so that each function keeps a small *relative* error.

Cubics and quintics are written out. Of R data at each end, the function of the k-th derivative at the left
end is the form

    f_k(s, r) = 1 / k! sum over j < R - k of C(2 R - 1 - k, j) s**(k + j) r**(2 R - 1 - k - j),

whose coefficients are all positive. They and those of the derivatives are integers over k!, and are found
here (`hermite_form`), so that no table of them is written down.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 7.5 and 7.6: cubic and quintic Hermite interpolation.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import UNIT_ROUNDOFF, DoubleDouble, add, difference, multiply, rescaled, times
from curvecore.arrays import FloatArray
from curvecore.bezier.bernstein import controls_between, derivative
from curvecore.families.defaults import Slopes


class LocalCoordinates(NamedTuple):
    """Positions of parameters within their segments.

    Attributes
    ----------
    s, r : ndarray, shape (m,)
        Distance from the left and from the right end over the length.
    from_left, from_right : DoubleDouble or None
        The distances without rounding, scaled like `length`; None where all
        factors of the functions in question have one sign.
    length : ndarray, shape (m,)
        The segment's length times a power of two, in [1/2, 1].
    """

    s: FloatArray
    r: FloatArray
    from_left: DoubleDouble | None
    from_right: DoubleDouble | None
    length: FloatArray

    def mirrored(self) -> LocalCoordinates:
        """Exchange the ends."""
        return LocalCoordinates(self.r, self.s, self.from_right, self.from_left, self.length)

    def linear(self, x: float, y: float) -> FloatArray:
        """Return x r + y s for small integers."""
        plain = x * self.r + y * self.s
        if self.from_left is None or self.from_right is None:
            return plain
        exact = add(times(self.from_right, x), times(self.from_left, y)).high / self.length
        return _finite(exact, plain)

    def quadratic(self, x: float, y: float, z: float) -> FloatArray:
        """Return x r**2 + y r s + z s**2 for small integers."""
        plain = x * self.r * self.r + y * (self.r * self.s) + z * self.s * self.s
        if self.from_left is None or self.from_right is None:
            return plain
        # (x r + y s) r + z s s
        inner = multiply(add(times(self.from_right, x), times(self.from_left, y)), self.from_right)
        exact = add(inner, times(multiply(self.from_left, self.from_left), z)).high
        return _finite(exact / self.length / self.length, plain)


def _finite(exact: FloatArray, plain: FloatArray) -> FloatArray:
    """Return `exact`, but `plain` far outside, where splitting overflows and nothing cancels."""
    finite = np.isfinite(exact)
    return exact if finite.all() else np.where(finite, exact, plain)


def local_coordinates(t: FloatArray, start: FloatArray, end: FloatArray, exact: bool) -> LocalCoordinates:
    """Return the position of t between start and end.

    Parameters
    ----------
    t, start, end : ndarray, shape (m,)
        start < end.
    exact : bool
        Whether factors that may vanish must be accurate too. They may for
        derivatives, and outside the segment.
    """
    h = end - start
    s, r = (t - start) / h, (end - t) / h
    if not exact:
        return LocalCoordinates(s, r, None, None, h)
    length, exponent = np.frexp(h)
    from_left = rescaled(difference(t, start), -exponent)
    from_right = rescaled(difference(end, t), -exponent)
    return LocalCoordinates(s, r, from_left, from_right, length)


LeftFunctions = Callable[[LocalCoordinates], tuple[FloatArray, ...]]


def _cubic_0(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    r2 = at.r * at.r
    return r2 * at.linear(1.0, 3.0), at.s * r2


def _cubic_1(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    return -6.0 * (at.s * at.r), at.r * at.linear(1.0, -2.0)


def _cubic_2(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    return 6.0 * at.linear(-1.0, 1.0), 2.0 * at.linear(-2.0, 1.0)


def _cubic_3(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    one = np.ones_like(at.s)
    return 12.0 * one, 6.0 * one


def _quintic_0(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    r3 = at.r * at.r * at.r
    sr3 = at.s * r3
    return r3 * at.quadratic(1.0, 5.0, 10.0), sr3 * at.linear(1.0, 4.0), 0.5 * at.s * sr3


def _quintic_1(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    s, r2 = at.s, at.r * at.r
    return (
        -30.0 * (s * s) * r2,
        r2 * (at.linear(1.0, -2.0) * at.linear(1.0, 6.0)),
        0.5 * (s * r2) * at.linear(2.0, -3.0),
    )


def _quintic_2(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    sr = at.s * at.r
    return (
        60.0 * sr * at.linear(-1.0, 1.0),
        12.0 * sr * at.linear(-3.0, 2.0),
        at.r * at.quadratic(1.0, -6.0, 3.0),
    )


def _quintic_3(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    return (
        -60.0 * at.quadratic(1.0, -4.0, 1.0),
        -12.0 * at.quadratic(3.0, -10.0, 2.0),
        -3.0 * at.quadratic(3.0, -6.0, 1.0),
    )


def _quintic_4(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    return 360.0 * at.linear(1.0, -1.0), 24.0 * at.linear(8.0, -7.0), 12.0 * at.linear(3.0, -2.0)


def _quintic_5(at: LocalCoordinates) -> tuple[FloatArray, ...]:
    one = np.ones_like(at.s)
    return -720.0 * one, -360.0 * one, -60.0 * one


#: Entry q holds the q-th derivatives with respect to s.
CUBIC: tuple[LeftFunctions, ...] = (_cubic_0, _cubic_1, _cubic_2, _cubic_3)
QUINTIC: tuple[LeftFunctions, ...] = (_quintic_0, _quintic_1, _quintic_2, _quintic_3, _quintic_4, _quintic_5)


# Functions of any number of data, as forms


class Form(NamedTuple):
    """A homogeneous polynomial scale / divisor * s**a r**b * (c_0 r**m + c_1 r**(m - 1) s + ... + c_m s**m).

    Attributes
    ----------
    scale, divisor : int
        The coefficients of the sum have no factor in common.
    of_s, of_r : int
        The powers a and b.
    coefficients : tuple of int
        c_0, ..., c_m, of which the first and the last are not 0.
    """

    scale: int
    divisor: int
    of_s: int
    of_r: int
    coefficients: tuple[int, ...]

    @classmethod
    def of(cls, coefficients: tuple[int, ...], divisor: int) -> Form:
        """Return the form of these coefficients of r**m, r**(m - 1) s, ... over a divisor."""
        first = next(k for k, value in enumerate(coefficients) if value)
        last = next(k for k, value in enumerate(reversed(coefficients)) if value)
        inner = coefficients[first : len(coefficients) - last]
        common = math.gcd(*inner)
        return cls(common, divisor, first, last, tuple(value // common for value in inner))

    def __call__(self, at: LocalCoordinates) -> FloatArray:
        """Return the values at positions in segments, (m,)."""
        values = self._sum(at) * (self.scale / self.divisor)
        for factor, times_ in ((at.s, self.of_s), (at.r, self.of_r)):
            for _ in range(times_):
                values = values * factor
        return values

    def _sum(self, at: LocalCoordinates) -> FloatArray:
        first, *others = self.coefficients
        plain: FloatArray = np.full_like(at.s, first)
        power = at.s
        for coefficient in others:
            plain = plain * at.r + coefficient * power
            power = power * at.s
        has_one_sign = min(self.coefficients) > 0 or max(self.coefficients) < 0
        if has_one_sign or at.from_left is None or at.from_right is None:
            return plain
        s = at.from_left
        exact = add(times(at.from_right, first), times(s, others[0]))
        for coefficient in others[1:]:
            s = multiply(s, at.from_left)
            exact = add(multiply(exact, at.from_right), times(s, coefficient))
        result = exact.high
        for _ in others:
            result = result / at.length
        # Far outside, splitting overflows, and nothing cancels.
        finite = np.isfinite(result)
        return result if finite.all() else np.where(finite, result, plain)


@cache
def hermite_form(width: int, k: int, order: int) -> tuple[int, ...]:
    """Return the coefficients of r**d, r**(d - 1) s, ..., s**d of a function's derivative by s, r = 1 - s.

    They are integers: those of the functions of the i-th derivatives at an end are multiplied by i!. Of the
    2 R functions, R = `width`, those of the left end come first.
    """
    if order:
        before = hermite_form(width, k, order - 1)
        degree = len(before) - 1
        return tuple((j + 1) * before[j + 1] - (degree - j) * before[j] for j in range(degree))
    of_end = k % width
    top = 2 * width - 1 - of_end
    left = [0] * of_end + [math.comb(top, j) for j in range(width - of_end)] + [0] * width
    return tuple(left) if k < width else tuple((-1) ** of_end * value for value in reversed(left))


def left_functions(width: int) -> tuple[LeftFunctions, ...]:
    """Return the functions of the left end and their derivatives by s, of which there are 2 R, for R data."""
    return tuple(_Functions(width, order) for order in range(2 * width))


class _Functions:
    """The order-th derivatives of all functions of the left end."""

    def __init__(self, width: int, order: int) -> None:
        self._forms = [Form.of(hermite_form(width, k, order), math.factorial(k)) for k in range(width)]

    def __call__(self, at: LocalCoordinates) -> tuple[FloatArray, ...]:
        """Return the values of f_0, ..., f_(R-1) at positions in segments."""
        return tuple(form(at) for form in self._forms)


class EndWeights(NamedTuple):
    """A derivative at an end of a segment of length 1 as a sum of data.

    Attributes
    ----------
    near, far : tuple of float, R numbers
        Weights of the data at this end, and of those at the other one.
    """

    near: tuple[float, ...]
    far: tuple[float, ...]


@cache
def end_weights(width: int, order: int) -> EndWeights:
    """Return the weights of the order-th derivative by s at s = 0."""
    at_start = [hermite_form(width, k, order)[0] / math.factorial(k % width) for k in range(2 * width)]
    return EndWeights(tuple(at_start[:width]), tuple(at_start[width:]))


# Derivatives from the jets at both ends of a segment


def end_derivative_terms(jets: FloatArray, parameters: FloatArray, end: int, order: int) -> FloatArray:
    """Return the terms of a derivative that is not given, at one end of every segment.

    Parameters
    ----------
    jets : ndarray, shape (n, R, dim)
    parameters : ndarray, shape (n,)
        Strictly increasing.
    end : int
        0 for the beginnings, 1 for the ends.
    order : int
        Of the derivative, at least R.

    Returns
    -------
    ndarray, shape (k, n - 1, dim)
        Their sum is the derivative, and its rounding is relative to their sizes.
    """
    h = np.diff(parameters)[:, None]
    near, far = (jets[1:], jets[:-1]) if end else (jets[:-1], jets[1:])
    # Seen from an end, the other one lies at the signed distance h.
    h = -h if end else h
    near_weights, far_weights = end_weights(jets.shape[1], order)
    # The weights of the points differ by their sign: their difference is what counts.
    terms = [far_weights[0] * ((far[:, 0] - near[:, 0]) / h)]
    for k in range(1, jets.shape[1]):
        for data, weight in ((near[:, k], near_weights[k]), (far[:, k], far_weights[k])):
            terms = [*terms, weight * data]
        if k < order:
            terms = [term / h for term in terms]
    return np.asarray(np.stack(terms) / h ** (order - jets.shape[1]))


def slopes_of(jets: FloatArray, parameters: FloatArray) -> Slopes | None:
    """Return control points of derivatives by the local s, of jets (n, R, dim); None out of range."""
    starts, ends = jets[:-1].copy(), jets[1:].copy()
    # Seen from the beginning of each segment, so that the origin counts for nothing.
    ends[:, 0] -= starts[:, 0]
    starts[:, 0] = 0.0
    controls = controls_between(starts, ends, np.diff(parameters)[:, None])
    slopes = derivative(controls)
    size = slopes.shape[1] * np.abs(controls).sum(axis=1)
    error = 8.0 * UNIT_ROUNDOFF * np.linalg.norm(size, axis=1)
    return Slopes(slopes, error) if np.isfinite(slopes).all() else None
