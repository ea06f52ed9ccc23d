"""Evaluation of Hermite segments through their Bezier control points.

Within a segment the Bernstein polynomials are products of s and r = 1 - s, all
of one sign, and their coefficients are sums of Hermite data that enter the
curve there with the same sign and at least that weight. Rounding the control
points therefore costs no more than rounding the data: the error is at most a
small multiple of u sum |B_ir d_ir|. Outside the segment this fails.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 5.1, 7.5 and 7.6.
"""

from __future__ import annotations

import math

import numpy as np

from curvecore.arrays import FloatArray, IntArray
from curvecore.bezier.bernstein_algebra import binomials

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
