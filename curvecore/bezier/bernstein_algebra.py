"""Polynomials in Bernstein form, many at a time: coefficients of shape (k, d + 1).

On [0, 1] a polynomial lies between its least and its largest coefficient, and
has at most as many roots as its coefficients change sign. Both statements
survive subdivision, which makes the coefficients converge to the values,
quadratically in the length [1]_. Searches that rest on them miss nothing and
need no starting values.

References
----------
.. [1] R. T. Farouki, "The Bernstein polynomial basis: a centennial
   retrospective", Computer Aided Geometric Design 29 (2012) 379-419: sections
   3.2 (bounds, variation), 4 (arithmetic) and 5.1 (conditioning).
.. [2] R. T. Farouki and V. T. Rajan, "Algorithms for polynomials in Bernstein
   form", Computer Aided Geometric Design 5 (1988) 1-26.
"""

from __future__ import annotations

from functools import cache
from math import comb
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray, read_only

_DEPTH = 40  # halvings after which an interval that still changes sign counts as a root
_MOST = (
    4096  # intervals at a time, or one for each coefficient: halving adds no changes of sign but by rounding
)
_STEPS = 60
_PRECISION = 2.0**-49
"""Steps of Newton's method at most, and the length of the last one."""


class PieceRoots(NamedTuple):
    """Roots of several polynomials.

    Attributes
    ----------
    piece : ndarray of int, shape (r,)
        Which polynomial.
    place : ndarray, shape (r,)
        Where, in [0, 1].
    """

    piece: IntArray
    place: FloatArray


@cache
def binomials(degree: int) -> FloatArray:
    """Return the binomial coefficients of a row, read-only, shape (degree + 1,)."""
    return read_only(np.array([float(comb(degree, k)) for k in range(degree + 1)]))


def weights(places: FloatArray, degree: int) -> FloatArray:
    """Return the Bernstein polynomials at places in [0, 1], shape (m, degree + 1)."""
    s, r = places[:, None], (1.0 - places)[:, None]
    k = np.arange(degree + 1)
    with np.errstate(under="ignore"):
        result: FloatArray = binomials(degree) * s**k * r ** (degree - k)
    return result


def values(coefficients: FloatArray, places: FloatArray) -> FloatArray:
    """Return polynomial i at places[i]: shape (k, d + 1, ...) and (k,) give (k, ...)."""
    with np.errstate(under="ignore"):
        level = coefficients
        s = places.reshape(-1, *(1,) * (coefficients.ndim - 1))
        while level.shape[1] > 1:
            level = level[:, :-1] + s * (level[:, 1:] - level[:, :-1])
    return level[:, 0]


def derivative(coefficients: FloatArray) -> FloatArray:
    """Return the coefficients of the derivatives with respect to s; of degree 0, zeros."""
    degree = coefficients.shape[1] - 1
    if degree == 0:
        return np.zeros_like(coefficients)
    result: FloatArray = degree * np.diff(coefficients, axis=1)
    return result


def product(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the coefficients of products, shapes (k, a + 1) and (k, b + 1) to (k, a + b + 1)."""
    a, b = first.shape[1] - 1, second.shape[1] - 1
    left, right = first * binomials(a), second * binomials(b)
    result = np.zeros((len(first), a + b + 1))
    with np.errstate(under="ignore"):
        for i in range(a + 1):
            result[:, i : i + b + 1] += left[:, i, None] * right
    result /= binomials(a + b)
    return result


def squared_length(vectors: FloatArray) -> FloatArray:
    """Return the coefficients of the squared lengths of vectors, shape (k, d + 1, dim) to (k, 2 d + 1)."""
    with np.errstate(under="ignore"):
        products = vectors @ vectors.swapaxes(1, 2)
        result: FloatArray = products.reshape(len(vectors), -1) @ _product_weights(vectors.shape[1] - 1)
    return result


@cache
def _product_weights(degree: int) -> FloatArray:
    """Return what the product of coefficients i and j counts in a square, ((d + 1)**2, 2 d + 1)."""
    result = np.zeros((degree + 1, degree + 1, 2 * degree + 1))
    for i, j in np.ndindex(degree + 1, degree + 1):
        result[i, j, i + j] = comb(degree, i) * comb(degree, j) / comb(2 * degree, i + j)
    return read_only(result.reshape(-1, 2 * degree + 1))


def elevated(coefficients: FloatArray, by: int = 1) -> FloatArray:
    """Return the same polynomials with coefficients of a higher degree, shape (k, d + 1 + by, ...)."""
    result = coefficients
    for _ in range(by):
        degree = result.shape[1]
        share = (np.arange(1, degree) / degree).reshape(1, -1, *(1,) * (result.ndim - 2))
        inner = share * result[:, :-1] + (1.0 - share) * result[:, 1:]
        result = np.concatenate([result[:, :1], inner, result[:, -1:]], axis=1)
    return result


@cache
def _left_half(degree: int) -> FloatArray:
    rows = [[comb(i, j) / 2.0**i if j <= i else 0.0 for j in range(degree + 1)] for i in range(degree + 1)]
    return read_only(np.array(rows))


def halves(coefficients: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the coefficients on [0, 1/2] and on [1/2, 1]; any trailing axes."""
    matrix = _left_half(coefficients.shape[1] - 1)
    flat = coefficients.reshape(*coefficients.shape[:2], -1)
    with np.errstate(under="ignore"):
        left, right = matrix @ flat, matrix[::-1, ::-1] @ flat
    return left.reshape(coefficients.shape), right.reshape(coefficients.shape)


@cache
def _parts(degree: int, count: int) -> FloatArray:
    """Return the matrix of the coefficients on `count` equal parts, (count (d + 1), d + 1)."""
    if count == 1:
        return np.eye(degree + 1)
    half, left = _parts(degree, count // 2), _left_half(degree)
    return read_only(np.concatenate([half @ left, half @ left[::-1, ::-1]]))


def subdivided(coefficients: FloatArray, count: int = 2) -> FloatArray:
    """Return a power of two of equal parts of every polynomial, in order, shape (count k, d + 1, ...)."""
    k, size = coefficients.shape[:2]
    with np.errstate(under="ignore"):
        flat = _parts(size - 1, count) @ coefficients.reshape(k, size, -1)
    parts = flat.reshape(k, count, size, *coefficients.shape[2:])
    # Neighbours share an end to the last digit, in whatever order products are summed.
    parts[:, 1:, 0] = parts[:, :-1, -1]
    return parts.reshape(-1, *coefficients.shape[1:])


def sign_changes(coefficients: FloatArray, noise: FloatArray) -> PieceRoots:
    """Find where polynomials change sign inside (0, 1).

    Parameters
    ----------
    coefficients : ndarray, shape (k, d + 1)
        Finite.
    noise : ndarray, shape (k,)
        Coefficients of at most this size count as 0: what rounding may have
        left of a 0. A polynomial that is nowhere larger changes no sign.

    Returns
    -------
    PieceRoots
        Ordered. Two roots closer than 2**-40 of the interval may be taken
        for one or none. Roots at 0 and 1 are not found; the caller compares
        neighbours there.
    """
    piece = np.arange(len(coefficients))
    start, size = np.zeros(len(piece)), 1.0
    work, limit = coefficients, noise
    found: list[_Bracket] = []
    most = max(_MOST, coefficients.size)
    for depth in range(_DEPTH):
        count = _variations(work, limit)
        single = count % 2 == 1 if depth == _DEPTH - 1 else count == 1
        # Just inside the right end, for the polynomial may be 0 at the end itself.
        rising = end_signs(work[single], limit[single], -1) > 0.0
        found.append(_Bracket(piece[single], start[single], work[single], rising, size))
        rest = count > 1
        if not rest.any() or 2 * int(rest.sum()) > most:
            break
        work = subdivided(work[rest])
        size *= 0.5
        begin = start[rest]
        start = np.stack((begin, begin + size), axis=1).ravel()
        piece, limit = np.repeat(piece[rest], 2), np.repeat(limit[rest], 2)
        found.append(_roots_at_cuts(piece, start, work, limit))
    return _polished(found)


class _Bracket(NamedTuple):
    """Intervals with one change of sign each; of length 0 where a root is known already.

    Attributes
    ----------
    piece : ndarray of int, shape (k,)
    start : ndarray, shape (k,)
    coefficients : ndarray, shape (k, d + 1)
        On the interval.
    rising : ndarray of bool, shape (k,)
        Whether the polynomial is positive behind the root.
    size : float
        Length of the intervals.
    """

    piece: IntArray
    start: FloatArray
    coefficients: FloatArray
    rising: BoolArray
    size: float


def _roots_at_cuts(piece: IntArray, start: FloatArray, work: FloatArray, limit: FloatArray) -> _Bracket:
    """Find roots where intervals were cut in two, which neither half has inside."""
    left, right = work[0::2], work[1::2]
    before, after = end_signs(left, limit[0::2], -1), end_signs(right, limit[1::2], 1)
    crossing = (np.abs(left[:, -1]) <= limit[0::2]) & (before * after < 0.0)
    return _Bracket(piece[0::2][crossing], start[1::2][crossing], right[crossing], after[crossing] > 0.0, 0.0)


def end_signs(coefficients: FloatArray, noise: FloatArray, direction: int) -> FloatArray:
    """Return signs just inside the left (direction 1) or right end (-1); 0 if all is noise."""
    signs = np.where(np.abs(coefficients) > noise[:, None], np.sign(coefficients), 0.0)[:, ::direction]
    first = np.argmax(signs != 0.0, axis=1)
    result: FloatArray = signs[np.arange(len(signs)), first]
    return result


def _variations(coefficients: FloatArray, noise: FloatArray) -> IntArray:
    """Count the changes of sign, zeros left out."""
    significant = np.abs(coefficients) > noise[:, None]
    count = np.zeros(len(coefficients), dtype=np.intp)
    last = np.zeros(len(coefficients))
    for k in range(coefficients.shape[1]):
        sign = np.where(significant[:, k], np.sign(coefficients[:, k]), 0.0)
        count += (sign * last) < 0.0
        last = np.where(sign != 0.0, sign, last)
    return count


def _polished(found: list[_Bracket]) -> PieceRoots:
    piece = np.concatenate([each.piece for each in found])
    place = np.concatenate([each.start + each.size * _refined(each) for each in found])
    order = np.lexsort((place, piece))
    return PieceRoots(piece[order], place[order])


def _refined(bracket: _Bracket) -> FloatArray:
    """Return where in [0, 1] the polynomials of a bracket change their sign, which they do once.

    One that does not has its root at the end it is nearer to. Newton's method, which falls back to halving.
    """
    count = len(bracket.piece)
    if not count or not bracket.size:
        return np.zeros(count)
    coefficients, rising = bracket.coefficients, bracket.rising
    low, high, place = np.zeros(count), np.ones(count), np.full(count, 0.5)
    slopes = derivative(coefficients)
    for _ in range(_STEPS):
        value, slope = values(coefficients, place), values(slopes, place)
        above = (value > 0.0) == rising
        high, low = np.where(above, place, high), np.where(above, low, place)
        with np.errstate(all="ignore"):
            step = place - value / slope
        inside: BoolArray = (step >= low) & (step <= high)
        following = np.where(inside, step, 0.5 * (low + high))
        following = np.where(value == 0.0, place, following)
        moved = np.abs(following - place).max()
        place = following
        if moved <= _PRECISION:
            break
    return place
