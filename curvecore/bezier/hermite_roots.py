"""Roots of derivatives of the cardinal Hermite polynomials, and their Taylor coefficients there.

Expanded about a root, a polynomial has no constant term, so that it keeps a small *relative* error next to
the root in plain arithmetic. Of the 2 R functions of a segment every one vanishes somewhere else; between two
such roots, each expansion holds as far as the middle, where the terms of every function sum up in size to at
most some nine times the function itself.

The polynomials have integer coefficients. The roots of those of cubics are rational; all are found in exact
arithmetic, once for every R and every order.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import DoubleDouble
from curvecore.arrays import FloatArray, IntArray, read_only
from curvecore.families.hermite_basis import hermite_form

_LARGEST_DENOMINATOR = 64
_DIGITS = 2**160
_ZERO = Fraction(1, 2**120)


class ExpansionPoints(NamedTuple):
    """Positions in a segment, in s from 0 to 1, about which the functions are expanded.

    Attributes
    ----------
    positions : ndarray, shape (P,)
        Ascending.
    inner : ndarray of int, shape (k,)
        Which of them are no ends of the segment.
    shares : DoubleDouble, shape (2, k, 1)
        1 - s and s of these.
    cuts : ndarray, shape (P - 1,)
        The middles between neighbours.
    coefficients : ndarray, shape (K, P, 2 R)
        ``[j, i, k]`` belongs to the j-th power of s minus position i and to function k: those of the left end
        in the order of their derivatives, then those of the right end; K = 2 R - order.
    """

    positions: FloatArray
    inner: IntArray
    shares: DoubleDouble
    cuts: FloatArray
    coefficients: FloatArray


@cache
def expansion_points(width: int, order: int) -> ExpansionPoints:
    """Return the positions for the order-th derivatives by s of the functions, R = `width` at each end."""
    functions = range(2 * width)
    # About the middle, too: of mirrored data a derivative is 0 there, and a cusp at rest.
    middle = {Fraction(1, 2)} if order else set()
    positions = sorted(middle.union(*(_roots(width, k, order) for k in functions)))
    coefficients = [
        [[_taylor(width, k, order, j, position) for k in functions] for position in positions]
        for j in range(2 * width - order)
    ]
    cuts = [float(a + b) / 2.0 for a, b in pairwise(positions)]
    inner = [i for i, position in enumerate(positions) if 0 < position < 1]
    return ExpansionPoints(
        read_only(np.array([float(position) for position in positions])),
        np.array(inner, dtype=np.intp),
        _parts([[1 - positions[i] for i in inner], [positions[i] for i in inner]]),
        read_only(np.array(cuts)),
        read_only(np.array(coefficients)),
    )


def _value(form: tuple[int, ...], s: Fraction) -> Fraction:
    left, right = s.numerator, s.denominator - s.numerator
    total, power = 0, 1
    for value in form:
        total = total * right + value * power
        power *= left
    return Fraction(total, s.denominator ** (len(form) - 1))


def _taylor(width: int, k: int, order: int, power: int, position: Fraction) -> float:
    value = _value(hermite_form(width, k, order + power), position)
    # Of an irrational root, the function itself is 0 but for the digits that were not computed.
    exact = value if abs(value) > _ZERO else Fraction(0)
    return float(exact / (math.factorial(power) * math.factorial(k % width)))


def _roots(width: int, k: int, order: int) -> set[Fraction]:
    """Return the roots of a function from 0 to 1: exact where they are simple fractions, else to 2**-160."""
    form, slope = hermite_form(width, k, order), hermite_form(width, k, order + 1)
    roots = {Fraction(end) for end in (0, 1) if form[-end] == 0}
    for ratio in np.roots(np.trim_zeros(form)[::-1]):
        # The roots inside are simple: a multiple one, whose digits are few, is an end.
        if abs(ratio.imag) > 0.0 or ratio.real <= 0.0:
            continue
        root = Fraction(float(ratio.real / (1.0 + ratio.real)))
        simple = root.limit_denominator(_LARGEST_DENOMINATOR)
        if _value(form, simple) != 0:
            for _ in range(3):
                root -= _value(form, root) / _value(slope, root)
                root = Fraction(round(root * _DIGITS), _DIGITS)
        roots.add(root if _value(form, simple) != 0 else simple)
    return roots


def _parts(exact: list[list[Fraction]]) -> DoubleDouble:
    high = [[float(value) for value in row] for row in exact]
    low = [
        [float(value - Fraction(part)) for value, part in zip(*rows, strict=True)]
        for rows in zip(exact, high, strict=True)
    ]
    return DoubleDouble(*(read_only(np.array(part).reshape(2, -1, 1)) for part in (high, low)))
