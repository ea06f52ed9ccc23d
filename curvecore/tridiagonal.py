"""Tridiagonal systems of splines, in which every unknown outweighs its neighbours."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray

_FEW = 48  # equations, up to which a full matrix takes a fifth of the time of NumPy's calls without one
_WIDE = 64  # columns from which on a loop over the rows takes less than rounds over all of them


def solve_dominant(before: FloatArray, after: FloatArray, right_side: FloatArray) -> FloatArray:
    """Solve before_i x_(i-1) + x_i + after_i x_(i+1) = right_side_i in O(n).

    Cyclic reduction of every row at once: each round eliminates the nearest neighbours, which doubles the
    distance of those that remain and squares the bound on |before| + |after|, until nothing is left of them.

    Parameters
    ----------
    before, after : ndarray, shape (n, 1)
        With |before| + |after| <= 1/2, or at most 1 in the first and the last two rows;
        before[0] = after[-1] = 0.
    right_side : ndarray, shape (n, dim)
        Overwritten.

    Returns
    -------
    ndarray, shape (n, dim)
    """
    if len(right_side) <= _FEW:
        return _solve_few(before, after, right_side)
    if right_side.shape[1] >= _WIDE:
        return _solve_row_by_row(before, after, right_side)
    n, distance = len(right_side), 1
    while distance < n and (before.any() or after.any()):
        d = distance
        diagonal = np.ones((n, 1))
        diagonal[d:] -= before[d:] * after[:-d]
        diagonal[:-d] -= after[:-d] * before[d:]
        solved = right_side.copy()
        solved[d:] -= before[d:] * right_side[:-d]
        solved[:-d] -= after[:-d] * right_side[d:]
        next_before, next_after = np.zeros((n, 1)), np.zeros((n, 1))
        next_before[d:] = -before[d:] * before[:-d]
        next_after[:-d] = -after[:-d] * after[d:]
        before, after = next_before / diagonal, next_after / diagonal
        right_side = solved / diagonal
        distance *= 2
    return right_side


def _solve_row_by_row(before: FloatArray, after: FloatArray, right_side: FloatArray) -> FloatArray:
    """Solve the same by elimination row after row, each for all columns at once."""
    left, right = before[:, 0].tolist(), after[:, 0].tolist()
    for i in range(1, len(right_side)):
        pivot = 1.0 - left[i] * right[i - 1]
        right_side[i] -= left[i] * right_side[i - 1]
        right_side[i] /= pivot
        right[i] /= pivot
    for i in range(len(right_side) - 2, -1, -1):
        right_side[i] -= right[i] * right_side[i + 1]
    return right_side


def _solve_few(before: FloatArray, after: FloatArray, right_side: FloatArray) -> FloatArray:
    """Solve the same by elimination in a full matrix; dominance keeps the multipliers below 1."""
    n = len(right_side)
    matrix = np.eye(n)
    matrix.flat[n :: n + 1] = before[1:, 0]
    matrix.flat[1 :: n + 1] = after[:-1, 0]
    return np.asarray(np.linalg.solve(matrix, right_side), dtype=np.float64)
