"""Cardinal polynomials of two-point Hermite interpolation, in factored form.

On a segment with s = (t - t_i) / h and r = (t_(i+1) - t) / h, r + s = 1, the
function f_k belongs to the k-th derivative at the left end. Both s and r are
subtractions of the given numbers, so each is accurate to a rounding next to
its own end; a polynomial expanded in s alone loses that at s = 1. Functions
of the right end follow from g_k(s, r) = (-1)**k f_k(r, s).

Factors in which s and r have opposite signs, such as 1 - 3 s = r - 2 s, are
evaluated as they stand: the roundings stay below u times the largest of the
functions of that order, not below u times the factor at its own zero.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 7.5 and 7.6: cubic and quintic Hermite interpolation.
"""

from __future__ import annotations

from collections.abc import Callable

from curvecore.arrays import FloatArray

__all__ = ["CUBIC", "QUINTIC", "LeftFunctions"]

LeftFunctions = Callable[[FloatArray, FloatArray], tuple[FloatArray, ...]]


def _cubic_0(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    r2 = r * r
    return r2 * (r + 3.0 * s), s * r2


def _cubic_1(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    return -6.0 * (s * r), r * (r - 2.0 * s)


def _cubic_2(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    return 6.0 * (s - r), 2.0 * (s - 2.0 * r)


def _cubic_3(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    one = 0.0 * s + 1.0
    return 12.0 * one, 6.0 * one


def _quintic_0(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    r3 = r * r * r
    sr3 = s * r3
    return r3 * (r * r + 5.0 * (r * s) + 10.0 * (s * s)), sr3 * (r + 4.0 * s), 0.5 * s * sr3


def _quintic_1(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    r2 = r * r
    return (
        -30.0 * (s * s) * r2,
        r2 * ((r - 2.0 * s) * (r + 6.0 * s)),
        0.5 * (s * r2) * (2.0 * r - 3.0 * s),
    )


def _quintic_2(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    sr = s * r
    return (
        60.0 * sr * (s - r),
        12.0 * sr * (2.0 * s - 3.0 * r),
        r * (r * r - 6.0 * sr + 3.0 * (s * s)),
    )


def _quintic_3(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    s2, sr, r2 = s * s, s * r, r * r
    return (
        -60.0 * (r2 - 4.0 * sr + s2),
        -12.0 * (3.0 * r2 - 10.0 * sr + 2.0 * s2),
        -3.0 * (3.0 * r2 - 6.0 * sr + s2),
    )


def _quintic_4(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    return 360.0 * (r - s), 24.0 * (8.0 * r - 7.0 * s), 12.0 * (3.0 * r - 2.0 * s)


def _quintic_5(s: FloatArray, r: FloatArray) -> tuple[FloatArray, ...]:
    one = 0.0 * s + 1.0
    return -720.0 * one, -360.0 * one, -60.0 * one


#: Entry q holds the q-th derivatives with respect to s.
CUBIC: tuple[LeftFunctions, ...] = (_cubic_0, _cubic_1, _cubic_2, _cubic_3)
QUINTIC: tuple[LeftFunctions, ...] = (_quintic_0, _quintic_1, _quintic_2, _quintic_3, _quintic_4, _quintic_5)
