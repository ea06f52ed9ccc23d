"""Cardinal polynomials of two-point Hermite interpolation, in factored form.

On a segment with s = (t - t_i) / h and r = (t_(i+1) - t) / h, r + s = 1, the
function f_k belongs to the k-th derivative at the left end. Both s and r are
subtractions of the given numbers, so each is accurate to a rounding next to
its own end; a polynomial expanded in s alone loses that at s = 1. Functions
of the right end follow from g_k(s, r) = (-1)**k f_k(r, s).

A factor in which r and s meet with opposite signs, such as 1 - 3 s = r - 2 s,
vanishes within the segment, and all functions of one order may do so at
nearly the same place. Such factors are formed in double-double arithmetic from
the exact differences, so that each function keeps a small *relative* error.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 7.5 and 7.6: cubic and quintic Hermite interpolation.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import DoubleDouble, add, difference, multiply, rescaled, times
from curvecore.arrays import FloatArray


class LocalCoordinates(NamedTuple):
    """Places of parameters within their segments.

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
    """Return where t lies between start and end.

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
QUINTIC: tuple[LeftFunctions, ...] = (
    _quintic_0,
    _quintic_1,
    _quintic_2,
    _quintic_3,
    _quintic_4,
    _quintic_5,
)
