"""The curve with given joints that is nearest to data with given parameters: linear least squares.

Every curve is linear in its jets, so that the sum of the squared distances of the data from c(u_k) is least
where a linear problem says. Orthogonal transformations solve it, not the normal equations: these would square
its condition number [1]_. Where the functions are local, the rows of each segment are reduced by themselves,
to as many as a segment has unknowns; the rest does not depend on how many data there are [2]_.

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

Make = Callable[[FloatArray, FloatArray], ParametricCurve]
"""Jets (k, R, dim) and parameters (k,) to a curve."""

_ROUNDING = 1e-11
"""Singular values below this share of the largest are those of what the data do not tell."""

_NEGLIGIBLE = 1e-6
"""Determinant of the ends below which a family's curves cannot be made to end where the data do."""


def least_squares_curve(
    family: type[ParametricCurve],
    points: ArrayLike,
    parameters: ArrayLike,
    knots: ArrayLike,
    *,
    corners: Sequence[int] = (),
    closed: bool = False,
    settings: Mapping[str, SettingValue] | None = None,
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
    settings : mapping, optional
        Values of the family's `settings`, by their names; of a closed curve such as make it periodic.

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
    places = point_array(points)
    own = np.asarray(knots, dtype=np.float64)
    own = parameter_array(own, len(own))
    at = parameter_values(parameters).values
    if at.shape != (len(places),):
        raise CurveError(f"parameters must have the shape ({len(places)},), like points")
    make = partial(family.from_jets, **(settings or {}))
    sides = _Sides(family, own, corners, closed)
    guess = sides.guess(places, at)
    problem = _Problem(make, own, sides, guess)
    blocks = problem.blocks(at, places)
    ends = None if closed else problem.blocks(own[[0, -1]], places[[0, -1]])
    try:
        return sides.curve(make, guess, _solved(blocks, ends, sides.count, sides.end_positions))
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

    def _agree(self, jets: FloatArray) -> None:
        """Let what is one unknown have one value."""
        values = np.zeros((self.count, jets.shape[-1]))
        values[self.columns[::-1]] = jets[::-1]
        jets[:] = values[self.columns]

    def curve(self, make: Make, guess: FloatArray, moves: FloatArray) -> ParametricCurve:
        """Return the curve whose unknowns have moved."""
        jets = guess + (moves * self.scale[:, None])[self.columns]
        pieces = []
        for start, end in pairwise(self.cuts):
            own = jets[start : end + 1, 1].copy()
            own[-1] = jets[end, 0]
            pieces.append(make(own, self.knots[start : end + 1]))
        return pieces[0] if len(pieces) == 1 else Chain(pieces)


class _Problem:
    """The linear problem: the functions at the data, and what the guess leaves."""

    def __init__(self, make: Make, knots: FloatArray, sides: _Sides, guess: FloatArray) -> None:
        self._sides, self._dim = sides, guess.shape[-1]
        jets = guess[:, 1].copy()
        jets[-1] = guess[-1, 0]
        # Corners do not change the functions.
        self._curve = make(jets, knots)
        self._guess = guess

    def blocks(self, t: FloatArray, points: FloatArray) -> list[_Block]:
        """Return [A | b] by segments, or as one: A x = b where the curve passes through the data."""
        columns = self._sides.columns
        if not self._curve.is_local:
            basis = self._curve.basis(t).reshape(len(t), -1)
            off = points - basis @ self._guess[:, 0].reshape(basis.shape[1], -1)
            return [self._block(columns[:-1, 0].reshape(-1), columns[-1, 0], basis, off)]
        blocks = []
        segment, values = self._curve.local_basis(t)
        order = np.argsort(segment, kind="stable")
        found, starts = np.unique(segment[order], return_index=True)
        for j, members in zip(found.tolist(), np.split(order, starts[1:]), strict=True):
            basis = values[members].reshape(len(members), -1)
            jets = np.concatenate([self._guess[j, 1], self._guess[j + 1, 0]])
            off = points[members] - basis @ jets
            blocks.append(self._block(columns[j, 1], columns[j + 1, 0], basis, off))
        return blocks

    def _block(self, first: IntArray, last: IntArray, basis: FloatArray, off: FloatArray) -> _Block:
        """Return rows of the unknowns at both ends; a closed curve of one segment has them twice."""
        own, place = np.unique(np.concatenate([first, last]), return_inverse=True)
        values = np.zeros((len(basis), len(own) + self._dim))
        values[:, place[: len(first)]] = basis[:, : len(first)]
        values[:, place[len(first) :]] += basis[:, len(first) :]
        values[:, : len(own)] *= self._sides.scale[own]
        values[:, len(own) :] = off
        return _Block(own, values)


class _Block(NamedTuple):
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


def _solved(
    blocks: list[_Block], ends: list[_Block] | None, count: int, pivots: tuple[int, int]
) -> FloatArray:
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


def _without(block: _Block, own: list[int], held: FloatArray) -> _Block:
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
    return _Block(columns[kept], values[:, np.append(kept, np.full(values.shape[1] - width, True))])


def _least_squares(blocks: list[_Block], count: int) -> FloatArray:
    """Return x of least |A x - b|; unknowns in no block are 0.

    Block by block: an unknown that no later block has is expressed by those that are left. Each step is as
    small as a segment, so that the whole is linear in their number.
    """
    dim = blocks[0].values.shape[1] - len(blocks[0].columns)
    last_in = np.zeros(count, dtype=np.intp)
    for index, block in enumerate(blocks):
        last_in[block.columns] = index
    left = _Block(np.empty(0, dtype=np.intp), np.empty((0, dim)))
    steps: list[tuple[_Block, int]] = []
    for index, block in enumerate(blocks):
        columns = np.union1d(left.columns, block.columns)
        columns = columns[np.argsort(last_in[columns] > index, kind="stable")]
        ends_here = int((last_in[columns] <= index).sum())
        rows = np.concatenate([left.spread(columns), block.spread(columns)])
        if len(rows) > 1:
            rows = np.asarray(np.linalg.qr(rows, mode="r"), dtype=np.float64)
        steps.append((_Block(columns, rows[:ends_here]), ends_here))
        left = _Block(columns[ends_here:], rows[ends_here : len(columns), ends_here:])
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
    if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
        raise np.linalg.LinAlgError
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=_ROUNDING)[0])
