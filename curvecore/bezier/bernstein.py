"""Polynomials in Bernstein form, many at a time: coefficients of shape (k, d + 1).

On [0, 1] a polynomial lies between its least and its largest coefficient, and has at most as many roots as
its coefficients change sign. Both statements survive subdivision, which makes the coefficients converge to
the values, quadratically in the length [1]_. Searches that rest on them miss nothing and need no starting
values; they halve `Arcs`.

Hermite segments are evaluated through their Bezier control points. Within a segment the Bernstein polynomials
are products of s and r = 1 - s, all of one sign, and their coefficients are sums of Hermite data that enter
the curve there with the same sign and at least that weight. Rounding the control points therefore costs no
more than rounding the data: the error is at most a small multiple of u sum |B_ir d_ir|. Outside the segment
this fails [3]_.

Chebyshev coefficients over [0, 1] are as good as values at the Chebyshev points [4]_.

References
----------
.. [1] R. T. Farouki, "The Bernstein polynomial basis: a centennial
   retrospective", Computer Aided Geometric Design 29 (2012) 379-419: sections
   3.2 (bounds, variation), 4 (arithmetic) and 5.1 (conditioning).
.. [2] R. T. Farouki and V. T. Rajan, "Algorithms for polynomials in Bernstein
   form", Computer Aided Geometric Design 5 (1988) 1-26.
.. [3] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 5.1, 7.5 and 7.6.
.. [4] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, chapters 3 and 4.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache
from math import comb
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray, read_only

_DEPTH = 40  # halvings after which an interval that still changes sign counts as a root
_MOST = 4096
"""Intervals at a time, or one for each coefficient: halving adds no changes of sign but by rounding."""
_STEPS = 60
_PRECISION = 2.0**-49
"""Steps of Newton's method at most, and the length of the last one."""


class PieceRoots(NamedTuple):
    """Roots of several polynomials.

    Attributes
    ----------
    piece : ndarray of int, shape (r,)
        Which polynomial.
    s : ndarray, shape (r,)
        Where, in [0, 1].
    """

    piece: IntArray
    s: FloatArray


@cache
def binomials(degree: int) -> FloatArray:
    """Return the binomial coefficients of a row, read-only, shape (degree + 1,)."""
    return read_only(np.array([float(comb(degree, k)) for k in range(degree + 1)]))


def weights(s: FloatArray, degree: int) -> FloatArray:
    """Return the Bernstein polynomials at s in [0, 1], shape (m, degree + 1)."""
    s, r = s[:, None], (1.0 - s)[:, None]
    k = np.arange(degree + 1)
    with np.errstate(under="ignore"):
        return np.asarray(binomials(degree) * s**k * r ** (degree - k))


def values(coefficients: FloatArray, at: FloatArray) -> FloatArray:
    """Return polynomial i at at[i] in [0, 1]: shape (k, d + 1, ...) and (k,) give (k, ...)."""
    with np.errstate(under="ignore"):
        level = coefficients
        s = at.reshape(-1, *(1,) * (coefficients.ndim - 1))
        while level.shape[1] > 1:
            level = level[:, :-1] + s * (level[:, 1:] - level[:, :-1])
    return level[:, 0]


def derivative(coefficients: FloatArray) -> FloatArray:
    """Return the coefficients of the derivatives with respect to s; of degree 0, zeros."""
    degree = coefficients.shape[1] - 1
    if degree == 0:
        return np.zeros_like(coefficients)
    return np.asarray(degree * np.diff(coefficients, axis=1))


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
        return products.reshape(len(vectors), -1) @ _product_weights(vectors.shape[1] - 1)


@cache
def _product_weights(degree: int) -> FloatArray:
    """Return the weights of the products of coefficients i and j in a square, ((d + 1)**2, 2 d + 1)."""
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
    brackets: list[_Bracket] = []
    most = max(_MOST, coefficients.size)
    for depth in range(_DEPTH):
        count = _variations(work, limit)
        single = count % 2 == 1 if depth == _DEPTH - 1 else count == 1
        # Just inside the right end, for the polynomial may be 0 at the end itself.
        rising = end_signs(work[single], limit[single], -1) > 0.0
        brackets.append(_Bracket(piece[single], start[single], work[single], rising, size))
        rest = count > 1
        if not rest.any() or 2 * int(rest.sum()) > most:
            break
        work = subdivided(work[rest])
        size *= 0.5
        begin = start[rest]
        start = np.stack((begin, begin + size), axis=1).ravel()
        piece, limit = np.repeat(piece[rest], 2), np.repeat(limit[rest], 2)
        brackets.append(_roots_at_cuts(piece, start, work, limit))
    return _polished(brackets)


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
    return np.asarray(signs[np.arange(len(signs)), first])


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


def _polished(brackets: list[_Bracket]) -> PieceRoots:
    piece = np.concatenate([bracket.piece for bracket in brackets])
    root = np.concatenate([bracket.start + bracket.size * _refined(bracket) for bracket in brackets])
    order = np.lexsort((root, piece))
    return PieceRoots(piece[order], root[order])


def _refined(bracket: _Bracket) -> FloatArray:
    """Return the parameters in [0, 1] at which the polynomials of a bracket change their sign, once each.

    One that does not has its root at the end it is nearer to. Newton's method, which falls back to halving.
    """
    count = len(bracket.piece)
    if not count or not bracket.size:
        return np.zeros(count)
    coefficients, rising = bracket.coefficients, bracket.rising
    low, high, root = np.zeros(count), np.ones(count), np.full(count, 0.5)
    slopes = derivative(coefficients)
    for _ in range(_STEPS):
        value, slope = values(coefficients, root), values(slopes, root)
        above = (value > 0.0) == rising
        high, low = np.where(above, root, high), np.where(above, low, root)
        with np.errstate(all="ignore"):
            step = root - value / slope
        inside: BoolArray = (step >= low) & (step <= high)
        following = np.where(inside, step, 0.5 * (low + high))
        following = np.where(value == 0.0, root, following)
        moved = np.abs(following - root).max()
        root = following
        if moved <= _PRECISION:
            break
    return root


# Hermite segments through their Bezier control points

_CHUNK = 4096  # parameters at a time: the dozen working arrays stay in the second-level cache


def control_points(jets: FloatArray, parameters: FloatArray) -> FloatArray:
    """Return the Bezier control points of every segment.

    Parameters
    ----------
    jets : ndarray, shape (n, R, dim)
        R >= 2.
    parameters : ndarray, shape (n,)
        Strictly increasing.

    Returns
    -------
    ndarray, shape (n - 1, 2 R, dim)
        Not finite where h v, h**2 a or h**3 j overflows.
    """
    return controls_between(jets[:-1], jets[1:], (parameters[1:] - parameters[:-1])[:, None])


def controls_between(starts: FloatArray, ends: FloatArray, h: FloatArray) -> FloatArray:
    """Return the control points of segments of lengths h (k, 1) from the jets at their ends, (k, R, dim)."""
    width = starts.shape[1]
    degree = 2 * width - 1
    controls = np.empty((len(h), degree + 1, starts.shape[2]))
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        for jets, step, column, inward in ((starts, h, 0, 1), (ends, -h, degree, -1)):
            scaled = [jets[:, 0]]
            for k in range(1, width):
                power = jets[:, k]
                for _ in range(k):
                    power = step * power
                scaled.append(power / math.perm(degree, k))
                away = sum(math.comb(k, j) * scaled[j] for j in range(1, k + 1))
                controls[:, column + k * inward] = scaled[0] + away
            controls[:, column] = scaled[0]
    return controls


def weighted_columns(controls: FloatArray) -> FloatArray:
    """Return control points times binomials, shape (degree + 1, dim, n - 1).

    One contiguous column for each coordinate, because gathering from columns
    costs a third of gathering rows and then striding over them.
    """
    weighted = controls.transpose(1, 2, 0) * binomials(controls.shape[1] - 1)[:, None, None]
    return np.ascontiguousarray(weighted)


def bernstein_weights(s: FloatArray, r: FloatArray, degree: int) -> tuple[FloatArray, ...]:
    """Return s**k r**(degree - k), k = 0 .. degree: Bernstein without binomials."""
    of_s, of_r = [s], [r]
    for powers, factor in ((of_s, s), (of_r, r)):
        for _ in range(degree - 1):
            powers.append(powers[-1] * factor)
    inner = (of_r[degree - k - 1] * of_s[k - 1] for k in range(1, degree))
    return of_r[-1], *inner, of_s[-1]


def evaluate_inside(
    t: FloatArray, segment: IntArray, parameters: FloatArray, columns: FloatArray
) -> FloatArray:
    """Return the curve at parameters inside the domain.

    Parameters
    ----------
    t : ndarray, shape (m,)
        Within the domain.
    segment : ndarray of int, shape (m,)
        The segment of each.
    parameters : ndarray, shape (n,)
        The joints.
    columns : ndarray, shape (degree + 1, dim, n - 1)
        From `weighted_columns`.

    Returns
    -------
    ndarray, shape (m, dim)
        At a joint exactly its point: there s and r are exactly 0 and 1.
    """
    count, dim, _ = columns.shape
    curve = np.empty((t.size, dim))
    gathered = np.empty(min(_CHUNK, t.size))
    total = np.empty_like(gathered)
    with np.errstate(under="ignore"):
        for first in range(0, t.size, _CHUNK):
            where = segment[first : first + _CHUNK]
            x = t[first : first + _CHUNK]
            start, end = parameters.take(where), parameters[1:].take(where)
            h = end - start
            weights = bernstein_weights((x - start) / h, (end - x) / h, count - 1)
            column, value = gathered[: x.size], total[: x.size]
            for d in range(dim):
                # mode="clip" is numpy's only gather into a given array that does not buffer.
                np.take(columns[0, d], where, out=value, mode="clip")
                value *= weights[0]
                for k in range(1, count):
                    np.take(columns[k, d], where, out=column, mode="clip")
                    column *= weights[k]
                    value += column
                curve[first : first + x.size, d] = value
    return curve


# Chebyshev coefficients


@cache
def to_chebyshev(degree: int) -> FloatArray:
    """Return the matrix from values at the degree + 1 points of `chebyshev` to coefficients; degree >= 1."""
    k = np.arange(degree + 1)
    matrix = (2.0 / degree) * np.cos(np.pi * np.outer(k, k) / degree) * (-1.0) ** k[:, None]
    matrix[:, [0, degree]] *= 0.5
    matrix[[0, degree]] *= 0.5
    return read_only(matrix)


@cache
def to_bernstein(degree: int) -> FloatArray:
    """Return the matrix from Chebyshev to Bernstein coefficients, shape (degree + 1, degree + 1)."""
    s = np.linspace(0.0, 1.0, degree + 1)
    chebyshev = np.cos(np.arange(degree + 1) * np.arccos(np.clip(2.0 * s - 1.0, -1.0, 1.0))[:, None])
    return read_only(np.asarray(np.linalg.solve(weights(s, degree), chebyshev), dtype=np.float64))


# Arcs that searches halve


class Arcs(NamedTuple):
    """Stretches of a curve as Bezier arcs.

    Attributes
    ----------
    controls : ndarray, shape (k, degree + 1, dim)
        Control points.
    start, end : ndarray, shape (k,)
        Where each begins and ends, in t or in another measure along the curve.
    """

    controls: FloatArray
    start: FloatArray
    end: FloatArray

    def selected(self, rows: BoolArray | IntArray) -> Arcs:
        """Return some of the arcs."""
        return Arcs(*(column[rows] for column in self))

    def halved(self) -> Arcs:
        """Return both halves of every arc, one after the other."""
        return self.divided(2)

    def divided(self, count: int) -> Arcs:
        """Return a power of two of equal parts of every arc, one after the other."""
        share = np.arange(count + 1) / count
        cuts = (1.0 - share) * self.start[:, None] + share * self.end[:, None]
        return Arcs(subdivided(self.controls, count), cuts[:, :-1].ravel(), cuts[:, 1:].ravel())


def joined_arcs(parts: Iterable[Arcs]) -> Arcs:
    """Return the arcs of all parts."""
    return Arcs(*(np.concatenate(column) for column in zip(*parts, strict=True)))
