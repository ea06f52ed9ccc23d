"""The curve with given joints that is nearest to data with given parameters: linear least squares.

Every curve is linear in its jets, so that the sum of the squared distances of the data from c(u_k) is least
where a linear problem says. Orthogonal transformations solve it, not the normal equations: these would square
its condition number [1]_. Where the functions are local, the rows of each segment are reduced by themselves,
to as many as a segment has unknowns; where they are polynomials between breaks, those of each piece to as
many as it has coefficients. The rest does not depend on how many data there are [2]_.

References
----------
.. [1] G. H. Golub and C. F. Van Loan, "Matrix Computations", 4th ed., Johns Hopkins 2013, sections 5.3
   (QR), 5.5 (rank-deficient problems) and 6.2 (linear constraints).
.. [2] C. L. Lawson and R. J. Hanson, "Solving Least Squares Problems", SIAM 1995, chapter 27: sequential
   processing of banded problems.
.. [3] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter XIV: least squares by
   splines.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, parameter_array, parameter_values, point_array
from curvecore.errors import CurveError
from curvecore.families.chain import Chain
from curvecore.families.curve import ParametricCurve
from curvecore.families.setting import SettingValue
from curvecore.tangents import bessel_velocities

_HIGH = 12
"""Degree from which on a piece is not told by its values at nodes: one polynomial has as many functions."""

Make = Callable[[FloatArray, FloatArray], ParametricCurve]
"""Jets (k, R, dim) and parameters (k,) to a curve."""


def least_squares_curve(
    family: type[ParametricCurve],
    points: ArrayLike,
    parameters: ArrayLike,
    knots: ArrayLike,
    *,
    corners: Sequence[int] = (),
    closed: bool = False,
    weights: ArrayLike | None = None,
    settings: Mapping[str, SettingValue] | None = None,
    end_velocities: tuple[ArrayLike | None, ArrayLike | None] = (None, None),
) -> ParametricCurve:
    """Return the curve with given parameters of its own that is nearest to data with given parameters.

    All jets are unknowns: of a family with derivatives these too. The sum of squares of c(u_k) - q_k is
    least among the curves that begin in the first and end in the last of the data. What the data do not
    tell, since too few lie in a segment, stays near parabolas through the joints.

    Parameters
    ----------
    family : type of ParametricCurve
        The class of the curve.
    points : array_like, shape (m, dim)
        The data q_k; m >= 2.
    parameters : array_like, shape (m,)
        Those of the data, u_k, inside of the domain, in any order.
    knots : array_like, shape (k,)
        The curve's own parameters t_i, strictly increasing; k >= 2.
    corners : sequence of int, optional
        Joints at which derivatives may jump, between 1 and k - 2; 0 of a closed curve. The result is then
        a `Chain`.
    closed : bool, optional
        Whether the last joint is the first one again: of the same jet, unless 0 is a corner. The ends
        are then free.
    weights : array_like, shape (m,), optional
        What the square of each distance counts, above 0; else all count 1.
    settings : mapping, optional
        Values of the family's `settings`, by their names; of a closed curve such as make it periodic.
    end_velocities : pair of array_like, shape (dim,), optional
        The velocities at the first and the last joint of an open curve of a family with derivatives; None
        for those that are free.

    Returns
    -------
    ParametricCurve
        Of the family, or a `Chain` of such curves.

    Raises
    ------
    CurveError
        If the arguments do not go together, corners are asked for in a family that can have none, or
        the curve's functions are so much alike at the data that its points cannot be told from them.

    See Also
    --------
    fit : Parameters and knots are found, too.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, least_squares_curve
    >>> data = [[0, 0], [1, 1], [2, 4], [3, 9], [4, 16]]
    >>> curve = least_squares_curve(LagrangeCurve, data, [0, 1, 2, 3, 4], [0, 2, 4])
    >>> curve.points.round(9).tolist()
    [[0.0, 0.0], [2.0, 4.0], [4.0, 16.0]]
    """
    data = point_array(points)
    joints = np.asarray(knots, dtype=np.float64)
    joints = parameter_array(joints, len(joints))
    at = parameter_values(parameters).values
    if at.shape != (len(data),):
        raise CurveError(f"parameters must have the shape ({len(data)},), like points")
    counts = np.ones(len(data)) if weights is None else parameter_values(weights).values
    if counts.shape != at.shape or not (counts > 0.0).all():
        raise CurveError(f"weights must be {len(data)} numbers above 0")
    make = partial(family.from_jets, **(settings or {}))
    sides = _Sides(family, joints, corners, closed)
    guess = sides.guess(data, at)
    held = sides.hold_ends(guess, end_velocities)
    problem = _Problem(make, joints, sides, guess, held)
    blocks = problem.blocks(at, data, np.sqrt(counts))
    ends = None if closed else problem.blocks(joints[[0, -1]], data[[0, -1]], np.ones(2))
    try:
        return sides.curve(make, guess, solved(blocks, ends, sides.count, sides.end_positions))
    except np.linalg.LinAlgError:
        raise CurveError(
            f"points and parameters give no curve of {family.name}: they are too far apart"
        ) from None


class _Sides:
    """Unknowns of a curve: which of them the jets before and after each joint consist of.

    Attributes
    ----------
    columns : ndarray of int, shape (k, 2, R)
        The unknown that is the derivative r before (0) and after (1) joint j.
    count : int
        How many there are.
    scale : ndarray, shape (count,)
        What an unknown is measured in: h^r.
    """

    def __init__(
        self, family: type[ParametricCurve], knots: FloatArray, corners: Sequence[int], closed: bool
    ) -> None:
        self.knots, self.closed = knots, closed
        self.order = family.derivatives + 1
        last = len(knots) - 1
        if corners and not (family.is_local and family.derivatives):
            raise CurveError(f"a curve of {family.name} can have no corners")
        if not all(0 <= corner < last and (corner or closed) for corner in corners):
            raise CurveError(f"corners must be joints between 1 and {last - 1}, or 0 of a closed curve")
        self.cuts = sorted({0, last, *corners})
        columns = np.empty((last + 1, 2, self.order), dtype=np.intp)
        columns[:] = (np.arange(last + 1) * self.order)[:, None, None] + np.arange(self.order)
        count = (last + 1) * self.order
        for joint in [*corners, *([last] if closed and 0 in corners else [])]:
            columns[joint, 0, 1:] = count + np.arange(self.order - 1)
            count += self.order - 1
        if closed:
            columns[last, :, 0] = columns[0, 0, 0]
            if 0 not in corners:
                columns[last] = columns[0]
        used, compact = np.unique(columns, return_inverse=True)
        self.columns: IntArray = compact.reshape(columns.shape)
        self.count = len(used)
        spacing = np.diff(knots)
        near = np.minimum(np.append(spacing, spacing[-1]), np.append(spacing[0], spacing))
        self.scale = np.empty(self.count)
        self.scale[self.columns] = (near[:, None] ** -np.arange(float(self.order)))[:, None]

    @property
    def end_positions(self) -> tuple[int, int]:
        """The unknowns that are the first and the last position."""
        return int(self.columns[0, 0, 0]), int(self.columns[-1, 0, 0])

    def guess(self, points: FloatArray, parameters: FloatArray) -> FloatArray:
        """Return jets, (k, 2, R, dim), by parabolas through data at the joints."""
        order = np.argsort(parameters, kind="stable")
        at = [np.interp(self.knots, parameters[order], column[order]) for column in points.T]
        jets = np.zeros((len(self.knots), 2, self.order, points.shape[1]))
        jets[:, :, 0] = np.stack(at, axis=1)[:, None]
        if self.closed:
            jets[-1] = jets[0]
        if self.order > 1:
            for start, end in pairwise(self.cuts):
                stretch = slice(start, end + 1)
                velocities = bessel_velocities(jets[stretch, 0, 0], self.knots[stretch])
                jets[start:end, 1, 1] = velocities[:-1]
                jets[start + 1 : end + 1, 0, 1] = velocities[1:]
            jets[0, 0], jets[-1, 1] = jets[0, 1], jets[-1, 0]
            self._agree(jets)
        return jets

    def hold_ends(self, jets: FloatArray, velocities: tuple[ArrayLike | None, ArrayLike | None]) -> IntArray:
        """Set velocities at the ends of jets, and return their unknowns, which do not move."""
        held = [end for end, velocity in zip((0, -1), velocities, strict=True) if velocity is not None]
        if held and (self.closed or self.order < 2):
            raise CurveError("end_velocities are those of an open curve of a family with derivatives")
        for end in held:
            jets[end, :, 1] = velocities[end]
        return np.array([self.columns[end, 0, 1] for end in held], dtype=np.intp)

    def _agree(self, jets: FloatArray) -> None:
        """Let both rows of one unknown have one value."""
        values = np.zeros((self.count, jets.shape[-1]))
        values[self.columns[::-1]] = jets[::-1]
        jets[:] = values[self.columns]

    def curve(self, make: Make, guess: FloatArray, moves: FloatArray) -> ParametricCurve:
        """Return the curve whose unknowns have moved."""
        jets = guess + (moves * self.scale[:, None])[self.columns]
        pieces = []
        for start, end in pairwise(self.cuts):
            of_piece = jets[start : end + 1, 1].copy()
            of_piece[-1] = jets[end, 0]
            pieces.append(make(of_piece, self.knots[start : end + 1]))
        return pieces[0] if len(pieces) == 1 else Chain(pieces)


class _Problem:
    """The linear problem: the functions at the data, and the residuals of the guess."""

    def __init__(
        self, make: Make, knots: FloatArray, sides: _Sides, guess: FloatArray, held: IntArray
    ) -> None:
        self._sides, self._dim, self._held = sides, guess.shape[-1], held
        jets = guess[:, 1].copy()
        jets[-1] = guess[-1, 0]
        # Corners do not change the functions.
        self._curve = make(jets, knots)
        self._guess = guess

    def blocks(self, t: FloatArray, points: FloatArray, roots: FloatArray) -> list[Block]:
        """Return [A | b] by segments, or as one: A x = b where the curve passes through the data.

        `roots` are those of the weights, (m,).
        """
        curve, columns = self._curve, self._sides.columns
        if not curve.is_local:
            if curve.degree is not None and curve.degree < _HIGH and len(t) > len(curve.breaks):
                basis, off = self._by_pieces(t, points, roots)
            else:
                basis = curve.basis(t).reshape(len(t), -1)
                off = points - basis @ self._guess[:, 0].reshape(basis.shape[1], -1)
                basis, off = roots[:, None] * basis, roots[:, None] * off
            return [self._block(columns[:-1, 0].reshape(-1), columns[-1, 0], basis, off)]
        blocks = []
        segment, values = curve.local_basis(t)
        order = np.argsort(segment, kind="stable")
        segments, starts = np.unique(segment[order], return_index=True)
        for j, members in zip(segments.tolist(), np.split(order, starts[1:]), strict=True):
            basis = values[members].reshape(len(members), -1)
            jets = np.concatenate([self._guess[j, 1], self._guess[j + 1, 0]])
            root = roots[members, None]
            off = root * (points[members] - basis @ jets)
            blocks.append(self._block(columns[j, 1], columns[j + 1, 0], root * basis, off))
        return blocks

    def _by_pieces(
        self, t: FloatArray, points: FloatArray, roots: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return as many rows a piece as it has coefficients, of the same least squares.

        Those are its values at nodes: the rows of a piece are V N x with N the functions there, and with
        V = Q R they are R N x.
        """
        curve = self._curve
        assert curve.degree is not None
        nodes = 0.5 - 0.5 * np.cos(np.pi * (np.arange(curve.degree + 1) + 0.5) / (curve.degree + 1))
        breaks = curve.breaks
        lengths = np.diff(breaks)
        at = breaks[:-1, None] + lengths[:, None] * nodes
        functions = curve.basis(at.reshape(-1)).reshape(*at.shape, -1)
        guess = functions @ self._guess[:, 0].reshape(functions.shape[-1], -1)
        piece = np.searchsorted(breaks[1:-1], t, side="right")
        values = _lagrange_values(nodes, (t - breaks[piece]) / lengths[piece])
        off = points - np.einsum("mk,mkd->md", values, guess[piece])
        together = roots[:, None] * np.concatenate([values, off], axis=1)
        order = np.argsort(piece, kind="stable")
        indices, starts = np.unique(piece[order], return_index=True)
        rows = [
            (reduced(together[members]), j)
            for j, members in zip(indices.tolist(), np.split(order, starts[1:]), strict=True)
        ]
        count = len(nodes)
        return (
            np.concatenate([block[:, :count] @ functions[j] for block, j in rows]),
            np.concatenate([block[:, count:] for block, _ in rows]),
        )

    def _block(self, first: IntArray, last: IntArray, basis: FloatArray, off: FloatArray) -> Block:
        """Return rows of the unknowns at both ends; a closed curve of one segment has them twice."""
        columns, column_of = np.unique(np.concatenate([first, last]), return_inverse=True)
        together = reduced(np.concatenate([basis, off], axis=1))
        width = basis.shape[1]
        values = np.zeros((len(together), len(columns) + self._dim))
        values[:, column_of[: len(first)]] = together[:, : len(first)]
        values[:, column_of[len(first) :]] += together[:, len(first) : width]
        values[:, : len(columns)] *= self._sides.scale[columns]
        values[:, len(columns) :] = together[:, width:]
        moves = ~np.isin(columns, self._held)
        return Block(columns[moves], values[:, np.append(moves, np.full(self._dim, True))])


def _lagrange_values(nodes: FloatArray, x: FloatArray) -> FloatArray:
    """Return the polynomials that are 1 at one of the nodes and 0 at the others, (m, k)."""
    values = np.ones((len(x), len(nodes)))
    for k, node in enumerate(nodes.tolist()):
        for other in np.delete(nodes, k).tolist():
            values[:, k] *= (x - other) / (node - other)
    return values


# Linear least squares of rows in which only some of the unknowns have a part

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
    everything, unknowns = np.arange(count), list(pivots)
    rows = None if ends is None else np.concatenate([block.spread(everything) for block in ends])
    if rows is None or abs(np.linalg.det(rows[:, unknowns])) < _NEGLIGIBLE:
        return _least_squares(blocks, count)
    # The two end positions by all others: x_own = held_b - held_A x.
    held = np.linalg.solve(rows[:, unknowns], rows)
    held[:, unknowns] = 0.0
    moves = _least_squares([_without(block, unknowns, held) for block in blocks], count)
    moves[unknowns] = held[:, count:] - held[:, :count] @ moves
    return moves


def _without(block: Block, unknowns: list[int], held: FloatArray) -> Block:
    """Eliminate unknowns from a block: row k of `held` says x_unknowns[k] + A x = b."""
    inside = [k for k, column in enumerate(unknowns) if column in block.columns]
    if not inside:
        return block
    reached = np.flatnonzero(
        held[inside, : held.shape[1] - (block.values.shape[1] - len(block.columns))].any(axis=0)
    )
    columns = np.union1d(block.columns, reached)
    values = block.spread(columns)
    width = len(columns)
    for k in inside:
        column_of = int(np.searchsorted(columns, unknowns[k]))
        factor = values[:, column_of].copy()
        values[:, :width] -= factor[:, None] * held[k, columns]
        values[:, width:] -= factor[:, None] * held[k, held.shape[1] - values.shape[1] + width :]
    stays = ~np.isin(columns, unknowns)
    return Block(columns[stays], values[:, np.append(stays, np.full(values.shape[1] - width, True))])


def _least_squares(blocks: list[Block], count: int) -> FloatArray:
    """Return x of least |A x - b|; unknowns in no block are 0.

    Block by block: an unknown that no later block has is expressed by those that are left. Each step is as
    small as a segment, so that the whole is linear in their number.
    """
    dim = blocks[0].values.shape[1] - len(blocks[0].columns)
    if len(blocks) == 1:
        solution = np.zeros((count, dim))
        solution[blocks[0].columns] = _any(blocks[0].values[:, :-dim], blocks[0].values[:, -dim:])
        return solution
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
    solution = np.zeros((count, dim))
    for (columns, rows), ends_here in reversed(steps):
        width = len(columns)
        right = rows[:, width:] - rows[:, ends_here:width] @ solution[columns[ends_here:]]
        solution[columns[:ends_here]] = _triangular(rows[:, :ends_here], right)
    return solution


def _triangular(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Solve an upper triangular system; where it does not tell all unknowns, by the least ones."""
    diagonal = np.abs(np.diagonal(matrix))
    if matrix.shape[0] == matrix.shape[1] and diagonal.min(initial=1.0) > 1e-6 * diagonal.max(initial=0.0):
        return np.asarray(np.linalg.solve(matrix, right))
    return _any(matrix, right)


def _any(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return x of least |A x - b|, and of least norm where that leaves a choice."""
    if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
        raise np.linalg.LinAlgError
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=_ROUNDING)[0])
