"""Cardinal functions: the effect of a point on a curve whose derivatives follow the points.

Rules that estimate velocities and accelerations are linear in the points p and in the derivatives s that are
set, for given parameters: d_r = E_r p + F_r s. With them a curve is linear in its points and in what is set,

    c(t) = sum over i of C_i(t) p_i + sum over k of S_k(t) s_k,
    C_i(t) = B_i0(t) + sum over r >= 1 and j of B_jr(t) (E_r)_ji,

and C_i(t_j) is 1 for i = j, else 0. The B_i0 of a Hermite family say what a point does whose neighbours'
derivatives stay; the C_i what it does when they are estimated again, while what is set stays.

A rule that is not linear has its Jacobian for E_r: then C_i is what a small move does. Where such a rule has
kinks and treats each coordinate for itself, small errors may do more: all their signs are tried.

References
----------
.. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001,
   chapter IV: the rules; chapter XIII, (4) and problem 1: cardinal splines.
.. [2] A. R. Curtis, M. J. D. Powell and J. K. Reid, "On the estimation of
   sparse Jacobian matrices", J. Inst. Maths Applics 13 (1974) 117-119: many
   columns of a banded matrix from one product.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LARGEST, made_finite
from curvecore.arrays import FloatArray, IntArray, parameter_row, parameter_values, read_only
from curvecore.bezier.bernstein import controls_between
from curvecore.errors import CurveError
from curvecore.families.chain import joint_of_row
from curvecore.families.curve import ParametricCurve

Rule = Callable[[FloatArray, FloatArray], FloatArray]
"""Points (n, dim) and parameters (n,) to derivatives (n, dim), linear in the points."""

Follow = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Moves of the points (n, k) to what they do to the derivatives before and after each joint, each
(joints, R - 1, k); the two differ at corners, and rows of derivatives that were set by hand are 0."""


def estimation_matrix(rule: Rule, parameters: ArrayLike) -> FloatArray:
    """Return the matrix E of a rule: derivatives = E @ points, for all points with these parameters.

    Parameters
    ----------
    rule : callable
        Such as `natural_spline_velocities`; linear in the points. Of `catmull_rom_velocities` the knots
        must be given.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, n)
        ``[j, i]`` is what point i adds to the derivative at joint j.

    See Also
    --------
    follow_rules : The same for `CardinalBasis`.

    Examples
    --------
    >>> from curvecore import bessel_velocities, estimation_matrix
    >>> estimation_matrix(bessel_velocities, [0, 1, 2]).tolist()
    [[-1.5, 2.0, -0.5], [-0.5, 0.0, 0.5], [0.5, -2.0, 1.5]]
    """
    t = parameter_row(parameters)
    return rule(np.eye(len(t)), t)


def follow_rules(parameters: ArrayLike, *rules: Rule) -> Follow:
    """Return the `Follow` of an open curve without corners.

    Parameters
    ----------
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    *rules : callable
        One for each kind of derivative: ``rule(points, parameters)``, linear in the points.

    Returns
    -------
    callable
        What `CardinalBasis` takes.

    See Also
    --------
    CardinalBasis : What takes it.
    estimation_matrix : What a rule does.

    Notes
    -----
    Velocities that are set do not move: then a rule is a function of moves and t such as
    ``natural_spline_velocities(moves, t, velocities=np.where(is_set[:, None], 0.0 * moves, np.nan))``.

    Examples
    --------
    >>> from curvecore import CardinalBasis, HermiteCurve, bessel_velocities, follow_rules
    >>> curve = HermiteCurve([[0], [1], [9]], [[0], [0], [0]], [0, 1, 2])
    >>> CardinalBasis(curve, follow_rules(curve.parameters, bessel_velocities)).follows
    True
    """
    t = parameter_row(parameters)

    def follow(moves: FloatArray) -> tuple[FloatArray, FloatArray]:
        derivatives = np.stack([rule(moves, t) for rule in rules], axis=1)
        return derivatives, derivatives

    return follow


# Cardinal functions

REACH = 64
"""Joints after which an estimate has forgotten a point: a natural spline forgets half at every one."""

_FELT = 6
"""Neighbouring points on which the velocities of a segment depend at most, where a rule is not linear."""

_NEGLIGIBLE = 2.0**-60
_MOST_AT_ONCE = 1 << 18


def cardinal_basis(
    curve: ParametricCurve, t: ArrayLike, order: int = 0, *, rules: tuple[Rule, ...] = ()
) -> FloatArray:
    """Return the cardinal functions of an open curve all of whose derivatives are estimated.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family; only its parameters matter.
    t : float or array_like of any shape
        Finite, inside the domain or not.
    order : int, optional
        Order of the derivative, at least 0.
    rules : tuple of callable, optional
        The rule of the velocities, and for quintics that of the accelerations.

    Returns
    -------
    ndarray, shape (*shape of t, n)
        ``cardinal_basis(curve, t, rules=rules) @ points`` is the curve through any points with these
        parameters. Rows of order 0 add up to 1.

    See Also
    --------
    CardinalBasis : The functions of closed curves, too.
    estimation_matrix : What a rule does.

    Examples
    --------
    >>> from curvecore import HermiteCurve, bessel_velocities, cardinal_basis
    >>> curve = HermiteCurve([[0], [1], [9]], [[0], [0], [0]], [0, 1, 2])
    >>> cardinal_basis(curve, 0.5, rules=(bessel_velocities,)).round(9).tolist()
    [0.375, 0.75, -0.125]
    """
    follow = follow_rules(curve.parameters, *rules) if rules else None
    return CardinalBasis(curve, follow).basis(t, order)


def by_point(functions: FloatArray, count: int) -> FloatArray:
    """Return the functions of points: of a closed curve the last joint is the first point, and both count.

    Parameters
    ----------
    functions : ndarray, shape (m, joints, ...)
        One for each joint; with `joints` - `count` of them the curve comes back to its first points.
    count : int
        The number of points, at least half of the joints.

    Returns
    -------
    ndarray, shape (m, count, ...)
        The sums of the functions of each point.
    """
    result, repeated = functions[:, :count], functions.shape[1] - count
    if repeated:
        result = result.copy()
        result[:, :repeated] += functions[:, count:]
    return result


class LocalCardinals(NamedTuple):
    """The cardinal functions that count at each t.

    Attributes
    ----------
    points : ndarray of int, shape (m, w)
        Indices of points, no two the same in a row.
    values : ndarray, shape (m, w)
        C_i(t) of these points.
    """

    points: IntArray
    values: FloatArray


class _Estimates(NamedTuple):
    """Effects of the points on the derivatives at both ends of segments.

    Attributes
    ----------
    columns : ndarray of int, shape (segments, w)
        Indices of the points that have one.
    ends : ndarray of int, shape (segments, 2)
        Which of these columns are the points at the ends.
    values : ndarray, shape (segments, 2, R - 1, w)
        ``[j, e, r, k]`` belongs to end e of segment j, derivative r + 1 and point ``columns[j, k]``.
    """

    columns: IntArray
    ends: IntArray
    values: FloatArray


class CardinalBasis:
    """The cardinal functions C_i of the points of a curve.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family, or a `Chain` of Hermite curves; only its parameters matter.
    follow : Follow, optional
        How its derivatives follow the points; without it they stay where they are.
    closed : bool, optional
        Whether the last joint is the first point again.
    reach : int, optional
        How many joints away from a point the estimates still depend on it; more than that is left out.
    one_sided : sequence of Follow, optional
        Where the rule of the velocities is not linear, what small moves do on the side to which they lead,
        for each coordinate; those of a segment depend on six neighbouring points at most. `sums` and the
        Lebesgue constant are then those of the errors that do most, in any coordinate, and not of the C_i.

    Attributes
    ----------
    curve : ParametricCurve
        As given.
    parameters : ndarray, shape (joints,)
        Those of the curve.
    closed : bool
        As given.
    count : int
        The number n of points.
    one_sided : tuple of Follow
        As given.

    Raises
    ------
    CurveError
        If what `follow` returns does not have the shape of the curve's derivatives.

    See Also
    --------
    cardinal_basis : Its values for an open curve.
    follow_rules : How derivatives follow the points.
    lebesgue_constant : The worst that errors of the points can do.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import CardinalBasis, HermiteCurve, bessel_velocities, follow_rules, uniform
    >>> points = np.array([[0.0, 0.0], [1.0, 2.0], [4.0, 0.0], [5.0, 1.0]])
    >>> curve = HermiteCurve(points, bessel_velocities(points, uniform(4)), uniform(4))
    >>> cardinal = CardinalBasis(curve, follow_rules(uniform(4), bessel_velocities))
    >>> cardinal.basis(0.5).round(9).tolist()
    [-0.0625, 0.5625, 0.5625, -0.0625]
    >>> np.allclose(cardinal.basis(0.5) @ points, curve(0.5))
    True
    """

    __slots__ = ("_displaced", "_estimates", "closed", "count", "curve", "one_sided", "parameters")

    _displaced: tuple[FloatArray, FloatArray, list[FloatArray]] | None

    def __init__(
        self,
        curve: ParametricCurve,
        follow: Follow | None = None,
        *,
        closed: bool = False,
        reach: int = REACH,
        one_sided: Sequence[Follow] = (),
    ) -> None:
        self.curve = curve
        self.closed = closed
        self.parameters = curve.parameters
        self.count = len(self.parameters) - closed
        if follow is not None and not curve.is_local:
            raise CurveError("curve must be of a family whose functions are local")
        self.one_sided, self._displaced = tuple(one_sided), None
        self._estimates = None if follow is None else self._estimated(follow, reach)

    @property
    def follows(self) -> bool:
        """Whether any derivative follows the points."""
        return self._estimates is not None or bool(self.one_sided)

    # The estimates, segment by segment

    def _estimated(self, follow: Follow, reach: int) -> _Estimates | None:
        """Return the effects of points near each segment on the derivatives at its ends; None for none."""
        segments = len(self.parameters) - 1
        if self.count <= 2 * reach + 2:
            estimates = self._ends_of(follow, np.eye(self.count))
            columns = np.broadcast_to(np.arange(self.count), (segments, self.count))
        else:
            columns, estimates = self._trimmed(*self._near(follow, reach))
        if not estimates.any():
            return None
        joints = np.arange(segments)[:, None] + np.arange(2)
        belongs = joints[:, :, None] % self.count == columns[:, None, :]
        return _Estimates(columns, np.argmax(belongs, axis=2), read_only(np.ascontiguousarray(estimates)))

    def _near(self, follow: Follow, reach: int) -> tuple[IntArray, FloatArray]:
        """Return the points up to `reach` joints from each segment, and their effects on its ends.

        Points far enough apart move together [2]_: no segment feels two of one colour.
        """
        segments, width = len(self.parameters) - 1, 2 * reach + 2
        blocks = self.count // width
        first = np.arange(blocks + 1) * self.count // blocks
        colour = np.arange(self.count) - np.repeat(first[:-1], np.diff(first))
        moves = np.zeros((self.count, int(colour.max()) + 1))
        moves[np.arange(self.count), colour] = 1.0
        columns = np.arange(segments)[:, None] + np.arange(-reach, reach + 2)
        outside = (columns < 0) | (columns >= self.count)
        columns %= self.count
        ends = self._ends_of(follow, moves)
        estimates = np.take_along_axis(ends, colour[columns][:, None, None, :], axis=3)
        if not self.closed:
            estimates *= ~outside[:, None, None, :]
        return columns, estimates

    def _ends_of(self, follow: Follow, moves: FloatArray) -> FloatArray:
        """Return the effects of moves on the derivatives at the ends of segments, (segments, 2, R - 1, k)."""
        shape = (len(self.parameters), self.curve.jets.shape[1] - 1, moves.shape[1])
        before, after = follow(moves)
        if before.shape != shape or after.shape != shape:
            raise CurveError(f"follow must return two arrays of the shape {shape}, not {before.shape}")
        return np.stack((after[:-1], before[1:]), axis=1)

    def _trimmed(self, columns: IntArray, estimates: FloatArray) -> tuple[IntArray, FloatArray]:
        """Drop points so far away that their effects are negligible."""
        h = np.diff(self.parameters)[:, None]
        with np.errstate(over="ignore", under="ignore"):
            sizes = np.stack(
                [np.abs(estimates[:, :, r]).max(axis=1) * h ** (r + 1) for r in range(estimates.shape[2])]
            )
        counts = np.flatnonzero((sizes > _NEGLIGIBLE).any(axis=(0, 1)))
        middle = columns.shape[1] // 2
        low = min(int(counts.min(initial=middle)), middle - 1)
        high = max(int(counts.max(initial=middle)), middle)
        return columns[:, low : high + 1], estimates[:, :, :, low : high + 1]

    @property
    def controls(self) -> FloatArray:
        """The functions on each segment as Bezier control points, (segments, degree + 1, w): of w points."""
        if self._estimates is None:
            raise CurveError("only functions that follow the points have control points of their own")
        segments, _, orders, width = self._estimates.values.shape
        jets = np.zeros((segments, 2, orders + 1, width))
        jets[:, :, 1:] = self._estimates.values
        jets[:, :, 0] = self._estimates.ends[:, :, None] == np.arange(width)
        return controls_between(jets[:, 0], jets[:, 1], np.diff(self.parameters)[:, None])

    # The functions

    def local(self, t: ArrayLike, order: int = 0) -> LocalCardinals:
        """Return the cardinal functions, or their derivatives, that are not 0 by construction.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            Finite, inside the domain or not; a scalar counts as m = 1.
        order : int, optional
            Order of the derivative, at least 0.

        Returns
        -------
        LocalCardinals
            Of which points, and their values.
        """
        at = parameter_row(t)
        if self._estimates is None:
            return self._alone(at, order)
        columns, ends, estimates = self._estimates
        segment, basis = self.curve.local_basis(at, order)
        values = np.empty((len(at), columns.shape[1]))
        flat = estimates.reshape(len(estimates), -1, values.shape[1])
        weights = basis[:, :, 1:].reshape(len(at), 1, -1)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            step = max(_MOST_AT_ONCE // flat[0].size, 1)
            for start in range(0, len(at), step):
                here = slice(start, start + step)
                values[here] = (weights[here] @ flat[segment[here]])[:, 0]
            rows = np.arange(len(at))
            for end in (0, 1):
                values[rows, ends[segment, end]] += basis[:, end, 0]
        return LocalCardinals(columns[segment], made_finite(values))

    def _alone(self, t: FloatArray, order: int) -> LocalCardinals:
        """Return the functions where no derivative follows: B_i0."""
        if self.curve.is_local:
            segment, values = self.curve.local_basis(t, order)
            return LocalCardinals((segment[:, None] + np.arange(2)) % self.count, values[:, :, 0])
        basis = self.curve.basis(t, order)[:, :, 0]
        if len(self.curve.pieces) > 1:
            # Two rows of data belong to a joint of two pieces.
            rows = np.flatnonzero(np.diff(joint_of_row(self.curve), prepend=-1))
            basis = np.add.reduceat(basis, rows, axis=1)
        basis = by_point(basis, self.count)
        return LocalCardinals(np.broadcast_to(np.arange(self.count), basis.shape), basis)

    def basis(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return all cardinal functions, or their derivatives with respect to t.

        Parameters
        ----------
        t : float or array_like of any shape
            Finite, inside the domain or not.
        order : int, optional
            Order of the derivative, at least 0.

        Returns
        -------
        ndarray, shape (*shape of t, n)
            ``[..., i]`` is C_i.
        """
        at = parameter_values(t)
        points, values = self.local(at.values, order)
        result = np.zeros((len(values), self.count))
        np.put_along_axis(result, points, values, axis=1)
        return at.shaped(result)

    def sums(self, t: ArrayLike, sizes: ArrayLike = 1.0) -> FloatArray:
        """Return sum |C_i(t)| e_i: how far errors of the sizes e_i can displace c(t), at worst.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            A scalar counts as m = 1.
        sizes : float or array_like, shape (n,), optional
            At least 0; one for all points, or one each.

        Returns
        -------
        ndarray, shape (m,)
            With sizes 1 the Lebesgue function.
        """
        size = np.asarray(sizes, dtype=np.float64)
        if self.one_sided:
            return self._largest_displacements(parameter_row(t), np.broadcast_to(size, self.count))
        points, values = self.local(t)
        weighted = np.abs(values)
        if size.ndim:
            weighted = weighted * size[points]
        with np.errstate(over="ignore", under="ignore"):
            totals = weighted.sum(axis=1) * (1.0 if size.ndim else size)
            return np.asarray(np.minimum(totals, LARGEST))

    # Errors on one side of kinks

    def _largest_displacements(self, t: FloatArray, sizes: FloatArray) -> FloatArray:
        """Return the largest displacements of a coordinate, (m,), by errors of sizes (n,) and any signs."""
        if self._displaced is None or not np.array_equal(self._displaced[0], sizes):
            errors = signs_of_errors(self.count, closed=self.closed) * sizes[:, None]
            joints = (np.arange(len(self.parameters) - 1)[:, None] + np.arange(2)) % self.count
            velocities = [self._ends_of(follow, errors)[:, :, 0] for follow in self.one_sided]
            self._displaced = sizes, errors, [np.stack((errors[joints], jet), axis=2) for jet in velocities]
        _, errors, jets = self._displaced
        segment, basis = self.curve.local_basis(t)
        with np.errstate(over="ignore", invalid="ignore"):
            near, far = self._by_higher_derivatives(segment, basis, errors)
            moved = [np.einsum("mer,merk->mk", basis[:, :, :2], jet[segment]) + near for jet in jets]
            # Where a velocity jumps, its effect at the joint is no number.
            largest = np.fmax.reduce(np.abs(np.concatenate(moved, axis=1)), axis=1)
            return np.asarray(np.fmin(largest + far, LARGEST))

    def _by_higher_derivatives(
        self, segment: IntArray, basis: FloatArray, errors: FloatArray
    ) -> tuple[FloatArray | float, FloatArray | float]:
        """Return effects of errors near a segment under linear rules, (m, k), and a bound for the others."""
        if basis.shape[2] < 3 or self._estimates is None:
            return 0.0, 0.0
        columns, _, values = self._estimates
        points = columns[segment]
        effects = np.einsum("mer,merw->mw", basis[:, :, 2:], values[segment][:, :, 1:])
        offset = points - segment[:, None] + 2
        if self.closed:
            offset %= self.count
        is_far = (offset < 0) | (offset >= _FELT)
        far = np.abs(effects * errors[points, 0] * is_far).sum(axis=1)
        near = ((effects * (offset == k)).sum(axis=1, keepdims=True) for k in range(_FELT))
        return sum(effect * errors[(segment + k - 2) % self.count] for k, effect in enumerate(near)), far


def signs_of_errors(count: int, *, closed: bool) -> FloatArray:
    """Return signs of errors, (count, k): all combinations of any six neighbours."""
    width = min(count, _FELT + closed)
    words = 1.0 - 2.0 * (np.arange(1 << width) >> np.arange(width)[:, None] & 1).astype(np.float64)
    if not closed or count == width:
        return words[np.arange(count) % width]
    # At its seam a row of words lacks some ways: one of three rows has its seam elsewhere.
    rows = [(np.arange(count) - count * third // 3) % count % _FELT for third in range(3)]
    return np.concatenate([words[row, : 1 << _FELT] for row in rows], axis=1)
