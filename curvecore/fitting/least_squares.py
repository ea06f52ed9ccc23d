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
    rows = problem.rows(at, places)
    ends = None if closed else problem.rows(own[[0, -1]], places[[0, -1]], reduced=False)
    try:
        return sides.curve(make, guess, _solved(rows, ends, guess.shape[3], sides.end_positions))
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
    """Rows of the linear problem: the functions at the data, and what the guess leaves."""

    def __init__(self, make: Make, knots: FloatArray, sides: _Sides, guess: FloatArray) -> None:
        self._sides, self._dim = sides, guess.shape[-1]
        jets = guess[:, 1].copy()
        jets[-1] = guess[-1, 0]
        # Corners do not change the functions.
        self._curve = make(jets, knots)
        self._guess = guess

    def rows(self, t: FloatArray, points: FloatArray, *, reduced: bool = True) -> FloatArray:
        """Return [A | b], (rows, count + dim): A x = b where the curve passes through the data."""
        columns, size = self._sides.columns, self._sides.count
        if not self._curve.is_local:
            basis = self._curve.basis(t).reshape(len(t), -1)
            rows = self._placed(columns[:-1, 0].reshape(-1), columns[-1, 0], basis)
            rows[:, :size] *= self._sides.scale
            rows[:, size:] = points - basis @ self._guess[:, 0].reshape(basis.shape[1], -1)
            return rows
        parts = []
        segment, values = self._curve.local_basis(t)
        order = np.argsort(segment, kind="stable")
        found, starts = np.unique(segment[order], return_index=True)
        for j, members in zip(found.tolist(), np.split(order, starts[1:]), strict=True):
            own = np.concatenate([columns[j, 1], columns[j + 1, 0]])
            basis = values[members].reshape(len(members), -1)
            jets = np.concatenate([self._guess[j, 1], self._guess[j + 1, 0]])
            part = np.hstack([basis * self._sides.scale[own], points[members] - basis @ jets])
            if reduced and len(part) > part.shape[1]:
                part = _triangular(part)
            rows = self._placed(columns[j, 1], columns[j + 1, 0], part[:, : len(own)])
            rows[:, size:] = part[:, len(own) :]
            parts.append(rows)
        return np.concatenate(parts)

    def _placed(self, first: IntArray, last: IntArray, values: FloatArray) -> FloatArray:
        """Return rows with the values where their unknowns are, `first` and `last`; these may be the same."""
        rows = np.zeros((len(values), self._sides.count + self._dim))
        rows[:, first] = values[:, : len(first)]
        rows[:, last] += values[:, len(first) :]
        return rows


def _solved(rows: FloatArray, ends: FloatArray | None, dim: int, pivots: tuple[int, int]) -> FloatArray:
    """Return the unknowns, (count, dim), that solve the rows as well as can be, and the ends exactly."""
    count = rows.shape[1] - dim
    moves = np.zeros((count, dim))
    own = list(pivots)
    if ends is None or abs(np.linalg.det(ends[:, own])) < _NEGLIGIBLE:
        moves[:] = _least_squares(rows, dim)
        return moves
    others = np.setdiff1d(np.arange(count), own)
    # The two end positions by all others: x_own = rest_b - rest_A x_others.
    rest = np.linalg.solve(ends[:, own], np.delete(ends, own, axis=1))
    reduced = np.delete(rows, own, axis=1)
    touched = np.flatnonzero(rows[:, own].any(axis=1))
    reduced[touched] -= rows[touched][:, own] @ rest
    if len(others):
        moves[others] = _least_squares(reduced, dim)
    moves[own] = rest[:, len(others) :] - rest[:, : len(others)] @ moves[others]
    return moves


def _least_squares(rows: FloatArray, dim: int) -> FloatArray:
    """Return x of least |A x - b|, and of these the least x, for rows [A | b]."""
    count = rows.shape[1] - dim
    if len(rows) > rows.shape[1]:
        rows = _triangular(rows)
    matrix, right = rows[:, :count], rows[:, count:]
    diagonal = np.abs(np.diagonal(matrix))
    if len(matrix) >= count and diagonal.min() > 1e-6 * diagonal.max():
        return np.asarray(np.linalg.solve(matrix[:count], right[:count]))
    if not np.isfinite(rows).all():
        raise np.linalg.LinAlgError
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=_ROUNDING)[0])


def _triangular(rows: FloatArray) -> FloatArray:
    """Return R of rows = Q R: its rows have the same lengths and angles as all of them together."""
    return np.asarray(np.linalg.qr(rows, mode="r"), dtype=np.float64)
