"""Linear least squares of rows in which only some of the unknowns have a part.

References
----------
.. [1] G. H. Golub and C. F. Van Loan, "Matrix Computations", 4th ed., Johns Hopkins 2013, sections 5.3
   (QR), 5.5 (rank-deficient problems) and 6.2 (linear constraints).
.. [2] C. L. Lawson and R. J. Hanson, "Solving Least Squares Problems", SIAM 1995, chapter 27: sequential
   processing of banded problems.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray

_ROUNDING = 1e-11
"""Singular values below this share of the largest are those of what the data do not tell."""

_AT_ONCE, _LEAST = 3, 500
"""Rows for each column that are reduced at once, and rows in any case."""

_NEGLIGIBLE = 1e-6
"""Determinant of the ends below which a family's curves cannot be made to end where the data do."""


class Block(NamedTuple):
    """Rows of a linear problem in which only some of the unknowns have a part.

    Attributes
    ----------
    columns : ndarray of int, shape (w,)
        The unknowns.
    values : ndarray, shape (rows, w + dim)
        [A | b].
    """

    columns: IntArray
    values: FloatArray

    def spread(self, columns: IntArray) -> FloatArray:
        """Return the values for more unknowns, those of this block among them."""
        width = len(self.columns)
        values = np.zeros((len(self.values), len(columns) + self.values.shape[1] - width))
        order = np.argsort(columns)
        values[:, order[np.searchsorted(columns, self.columns, sorter=order)]] = self.values[:, :width]
        values[:, len(columns) :] = self.values[:, width:]
        return values


def reduced(rows: FloatArray) -> FloatArray:
    """Return no more rows than columns, [R | Q^T b] of rows [A | b]: the same sums of squares.

    Some rows at a time: they stay near the processor, and NumPy's QR keeps the interpreter to itself.
    """
    width = rows.shape[1]
    some = max(_AT_ONCE * width, _LEAST)
    while len(rows) > 2 * some:
        parts = np.array_split(rows, len(rows) // some)
        rows = np.concatenate([np.linalg.qr(part, mode="r") for part in parts])
    if len(rows) <= width:
        return rows
    return np.asarray(np.linalg.qr(rows, mode="r"), dtype=np.float64)


def solved(blocks: list[Block], ends: list[Block] | None, count: int, pivots: tuple[int, int]) -> FloatArray:
    """Return the unknowns, (count, dim), that solve the blocks as well as can be, and the ends exactly."""
    everything, own = np.arange(count), list(pivots)
    rows = None if ends is None else np.concatenate([each.spread(everything) for each in ends])
    if rows is None or abs(np.linalg.det(rows[:, own])) < _NEGLIGIBLE:
        return _least_squares(blocks, count)
    # The two end positions by all others: x_own = held_b - held_A x.
    held = np.linalg.solve(rows[:, own], rows)
    held[:, own] = 0.0
    moves = _least_squares([_without(each, own, held) for each in blocks], count)
    moves[own] = held[:, count:] - held[:, :count] @ moves
    return moves


def _without(block: Block, own: list[int], held: FloatArray) -> Block:
    """Put what holds the unknowns `own` in their place: row k of `held` says x_own[k] + A x = b."""
    inside = [k for k, column in enumerate(own) if column in block.columns]
    if not inside:
        return block
    reached = np.flatnonzero(
        held[inside, : held.shape[1] - (block.values.shape[1] - len(block.columns))].any(axis=0)
    )
    columns = np.union1d(block.columns, reached)
    values = block.spread(columns)
    width = len(columns)
    for k in inside:
        place = int(np.searchsorted(columns, own[k]))
        factor = values[:, place].copy()
        values[:, :width] -= factor[:, None] * held[k, columns]
        values[:, width:] -= factor[:, None] * held[k, held.shape[1] - values.shape[1] + width :]
    kept = ~np.isin(columns, own)
    return Block(columns[kept], values[:, np.append(kept, np.full(values.shape[1] - width, True))])


def _least_squares(blocks: list[Block], count: int) -> FloatArray:
    """Return x of least |A x - b|; unknowns in no block are 0.

    Block by block: an unknown that no later block has is expressed by those that are left. Each step is as
    small as a segment, so that the whole is linear in their number.
    """
    dim = blocks[0].values.shape[1] - len(blocks[0].columns)
    if len(blocks) == 1:
        found = np.zeros((count, dim))
        found[blocks[0].columns] = _any(blocks[0].values[:, :-dim], blocks[0].values[:, -dim:])
        return found
    last_in = np.zeros(count, dtype=np.intp)
    for index, block in enumerate(blocks):
        last_in[block.columns] = index
    left = Block(np.empty(0, dtype=np.intp), np.empty((0, dim)))
    steps: list[tuple[Block, int]] = []
    for index, block in enumerate(blocks):
        columns = np.union1d(left.columns, block.columns)
        columns = columns[np.argsort(last_in[columns] > index, kind="stable")]
        ends_here = int((last_in[columns] <= index).sum())
        rows = np.concatenate([left.spread(columns), block.spread(columns)])
        if len(rows) > 1:
            rows = np.asarray(np.linalg.qr(rows, mode="r"), dtype=np.float64)
        steps.append((Block(columns, rows[:ends_here]), ends_here))
        left = Block(columns[ends_here:], rows[ends_here : len(columns), ends_here:])
    found = np.zeros((count, dim))
    for (columns, rows), ends_here in reversed(steps):
        width = len(columns)
        right = rows[:, width:] - rows[:, ends_here:width] @ found[columns[ends_here:]]
        found[columns[:ends_here]] = _triangular(rows[:, :ends_here], right)
    return found


def _triangular(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Solve an upper triangular system; where it does not tell all unknowns, by the least ones."""
    diagonal = np.abs(np.diagonal(matrix))
    if matrix.shape[0] == matrix.shape[1] and diagonal.min(initial=1.0) > 1e-6 * diagonal.max(initial=0.0):
        return np.asarray(np.linalg.solve(matrix, right))
    return _any(matrix, right)


def _any(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return x of least |A x - b|; what it does not tell is as small as can be."""
    if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
        raise np.linalg.LinAlgError
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=_ROUNDING)[0])
