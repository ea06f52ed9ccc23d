"""The twice continuously differentiable cubic spline: its curve, and the system for its second derivatives.

The second derivatives at the joints solve one tridiagonal system (`spline_derivatives`), in which every
unknown outweighs its neighbours (`solve_dominant`); from there on a spline is evaluated as a cubic Hermite
curve with the velocities that follow.

References
----------
.. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter IV: end conditions.
"""

from __future__ import annotations

import math
from enum import StrEnum
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import DoubleDouble, add, difference, divide, made_finite, multiply, vector_lengths
from curvecore.arrays import FloatArray, IntArray, parameter_row, read_only
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import Interpolant, JointDerivatives, Slopes
from curvecore.families.hermite import HermiteCurve
from curvecore.families.hermite_taylor import TaylorPieces, taylor_pieces
from curvecore.families.setting import FamilySetting, SettingValue


class SplineEnds(StrEnum):
    """Conditions at the ends of a cubic spline: SciPy's ``bc_type``.

    Attributes
    ----------
    label
        The name for people.
    NATURAL
        c'' = 0 at both ends.
    CLAMPED
        c' = 0 at both ends.
    NOT_A_KNOT
        c''' does not jump at the second parameter and at the last but one: the first two pieces are one
        cubic, and the last two. Through three points the parabola.
    PERIODIC
        c' and c'' are the same at both ends: what makes a closed curve smooth at its seam.

    See Also
    --------
    CubicSplineCurve : The spline.

    Examples
    --------
    >>> from curvecore import SplineEnds
    >>> [ends.value for ends in SplineEnds]
    ['natural', 'clamped', 'not_a_knot', 'periodic']
    """

    NATURAL = "natural"
    CLAMPED = "clamped"
    NOT_A_KNOT = "not_a_knot"
    PERIODIC = "periodic"

    @property
    def label(self) -> str:
        """The name for people: Not a knot."""
        return self.value.replace("_", " ").capitalize()


class _Data(NamedTuple):
    """Derivatives of a spline at its joints, each (n, k): for k coordinates, or k basis functions."""

    points: FloatArray
    velocities: FloatArray
    bends: FloatArray


class _Lines(TaylorPieces):
    """c'' of a spline on its segments: its values at the end and the start of each; then the start, the end.

    An expansion would be less accurate where c'' is 0 between them: in this sum, the rounding of the length
    is a factor of both terms.
    """

    __slots__ = ()

    @staticmethod
    def _values(numbers: FloatArray, t: FloatArray) -> FloatArray:
        bends, joints = numbers[:2], numbers[2:]
        h = joints[1] - joints[0]
        joints -= t
        joints /= h
        joints *= bends
        return np.asarray(joints[1] - joints[0])


class CubicSplineCurve(ParametricCurve):
    """Cubic pieces with continuous acceleration.

    Twice continuously differentiable; c'''(t) may jump at the joints. Of all such curves through the points
    the one with natural ends has the least integral of c''(t)**2.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.
    **settings : str, optional
        ``ends``: the conditions at both ends, of `SplineEnds`: ``"natural"``, ``"clamped"``,
        ``"not_a_knot"`` or ``"periodic"``.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above, or the derivatives exceed the largest number.

    See Also
    --------
    HermiteCurve : With velocities of one's own.
    natural_spline_velocities : Its velocities, with natural ends.

    Notes
    -----
    It is the cubic Hermite curve with the velocities that make c'' continuous. Values and derivatives up to
    order 3 have errors of at most a small multiple of u sum |B_i^(order)(t) p_i|, u = 2**-53; but c''' of a
    not-a-knot spline on the last or the second segment loses as many digits as this is shorter than its
    neighbour. Periodic curves should end where they begin; else the last point is the first one moved, and c
    is periodic but for that move.

    References
    ----------
    .. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter IV.

    Examples
    --------
    >>> from curvecore import CubicSplineCurve
    >>> spline = CubicSplineCurve([[0], [1], [0]], [0, 1, 2])
    >>> spline([0.5, 1]).round(9).tolist()
    [[0.6875], [1.0]]
    >>> spline.evaluate([0, 2], order=2).round(9).tolist()
    [[0.0], [0.0]]
    >>> CubicSplineCurve([[0], [1], [0]], [0, 1, 2], ends="clamped").evaluate(0, order=1).tolist()
    [0.0]
    """

    __slots__ = ("_bends", "_hermite", "_lines", "_units")
    _caches = ("_bends", "_hermite", "_lines", "_units")

    name = "cubic_spline"
    title = "cubic spline"
    short_title = "spline"
    full_title = "C² cubic spline"
    rank = 40
    settings = (
        FamilySetting(
            "ends",
            "ends",
            SplineEnds.NATURAL.value,
            "Conditions at the ends: c″ = 0 (natural), c′ = 0 (clamped), c‴ continuous next to the ends "
            "(not a knot), or equal c′ and c″ (periodic)",
            choices=tuple((ends.value, ends.label) for ends in SplineEnds),
            when_closed=SplineEnds.PERIODIC.value,
        ),
    )
    can_close = True
    most_points = None

    _hermite: HermiteCurve | None  # the same curve
    _bends: FloatArray | None  # c'' at the joints
    _lines: dict[int, TaylorPieces] | None  # c'' and c''' on the segments
    _units: _Data | None  # of all basis functions

    def __init__(self, points: ArrayLike, parameters: ArrayLike, **settings: SettingValue) -> None:
        super().__init__(points, parameters, **settings)
        self._solve()

    @property
    def ends(self) -> SplineEnds:
        """The conditions at both ends."""
        return SplineEnds(str(self.chosen["ends"]))

    @property
    def breaks(self) -> FloatArray:
        """The parameters: c''' jumps there."""
        return self._parameters

    @property
    def degree(self) -> int:
        """The degree of the pieces: 3."""
        return 3

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the curve with other points; it shares everything that depends on the parameters."""
        curve = super().with_jets(jets)
        curve._units = self._units
        curve._solve()
        return curve

    def _evaluate_at_once(self, t: FloatArray, order: object) -> FloatArray | None:
        """Evaluate by points and velocities, or by c'' where that is more accurate."""
        if type(order) is int and order >= 2:
            return self._evaluate_lines(t, order)
        return self._pieces._evaluate_at_once(t, order)

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        if order < 2 and bool((self._outside(t) == 0).all()):
            return self._pieces._evaluate(t, order)
        if order >= 2 and (values := self._evaluate_lines(t, order)) is not None:
            return values
        jets = self._pieces.jets
        return self._summed(t, order, _Data(jets[:, 0], jets[:, 1], self._second))

    def _evaluate_lines(self, t: FloatArray, order: int) -> FloatArray | None:
        """Return c'' or c''' at unchecked t inside the domain, where there are enough of them."""
        if not t.size or not self._pieces._are_worth_expansions(t):
            return None
        if self._lines is None:
            self._lines = {}
            joints, bends = self._parameters, self._second
            slopes = taylor_pieces(joints[:-1], joints[1:], bends[:-1, None], bends[1:, None], 1)
            if slopes is not None:
                numbers = np.stack(np.broadcast_arrays(bends[1:].T, bends[:-1].T, joints[:-1], joints[1:]))
                self._lines = {2: _Lines.of(slopes.intervals, numbers, slopes.domain), 3: slopes}
        return self._lines[order].evaluate(t) if order in self._lines else None

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        if self._units is None:
            unit = np.eye(len(self._parameters))
            velocities, _ = spline_derivatives(unit, self._parameters, self.ends)
            self._units = _Data(unit, read_only(made_finite(velocities)), self._bends_for(unit))
        return self._summed(t, order, self._units)

    def _outside(self, t: FloatArray) -> IntArray:
        """Return -1 where t lies before the domain, 1 where it lies behind it, else 0."""
        first, last = self.domain
        return (t > last).astype(np.intp) - (t < first)

    def _summed(self, t: FloatArray, order: int, data: _Data) -> FloatArray:
        """Return sums of the data, (m, k), by the formula that is most accurate at each t."""
        outside = self._outside(t)
        inside = outside == 0
        if inside.all():
            return made_finite(self._inside(t, order, data))
        result = np.zeros((len(t), data.points.shape[1]))
        result[inside] = self._inside(t[inside], order, data)
        for end in (-1, 1):
            beyond = outside == end
            result[beyond] = self._beyond(t[beyond], order, data, end)
        return made_finite(result)

    def _inside(self, t: FloatArray, order: int, data: _Data) -> FloatArray:
        """Return sums by points and velocities, or by the second derivatives, of which c'' is linear."""
        if order < 2:
            segment, hermite = self._pieces.local_basis(t, order)
            given, factors = data.velocities, hermite[:, :, 1]
        else:
            segment = np.searchsorted(self._parameters[1:-1], t, side="right")
            start, end = self._parameters[segment], self._parameters[segment + 1]
            h = end - start
            linear = {2: ((end - t) / h, (t - start) / h), 3: (-1.0 / h, 1.0 / h)}
            given, factors = data.bends, np.stack(linear.get(order, (0.0 * h, 0.0 * h)), axis=1)
        result = given[segment]
        result *= factors[:, :1]
        behind = given[segment + 1]
        behind *= factors[:, 1:]
        result += behind
        if order < 2:
            rows, are_units = np.arange(len(t)), data is self._units
            for side in (0, 1):
                if are_units:  # each point is its own function alone
                    result[rows, segment + side] += hermite[:, side, 0]
                else:
                    result += hermite[:, side, :1] * data.points[segment + side]
        return result

    def _beyond(self, t: FloatArray, order: int, data: _Data, end: int) -> FloatArray:
        """Return sums outside of the domain, by the power series about its end."""
        here, next_to = (0, 1) if end < 0 else (-1, -2)
        h = self._parameters[next_to] - self._parameters[here]
        x = ((t - self._parameters[here]) / h)[:, None]
        bend = data.bends[here] * h * h
        jump = (data.bends[next_to] - data.bends[here]) * h * h
        terms = [data.points[here], data.velocities[here] * h, bend, jump][order:]
        result = np.zeros((len(t), data.points.shape[1]))
        for power, term in enumerate(terms):
            result += x**power * (term / math.factorial(power))
        for _ in range(order):
            result /= h
        return result

    def bezier_pieces(self) -> FloatArray:
        """Return the Bezier control points of all segments, shape (n - 1, 4, dim)."""
        return self._pieces.bezier_pieces()

    def bezier_slopes(self, exponent: int) -> Slopes | None:
        """Return the control points of the derivatives, from the points and velocities."""
        return self._pieces.bezier_slopes(exponent)

    def interpolants(self) -> list[Interpolant]:
        """Return the points and velocities at both ends of each segment."""
        return self._pieces.interpolants()

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c to c''' at the ends of all segments: up to c'' the same on both sides of a joint."""
        values, scale = (array.copy() for array in self._pieces.joint_derivatives(before=before))
        h, sizes = np.diff(self._parameters), vector_lengths(self._second)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            values[:, 2] = self._second[1:] if before else self._second[:-1]
            values[:, 3] = np.diff(self._second, axis=0) / h[:, None]
            scale[:, 2] = sizes[1:] if before else sizes[:-1]
            scale[:, 3] = (sizes[1:] + sizes[:-1]) / h
        return JointDerivatives(values, scale)

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, n, dim): at fixed velocities, and by the change of the velocities."""
        at = parameter_row(t)
        result = self._pieces.parameter_derivatives(at)
        segment, functions = self._pieces.local_basis(at)
        moves = velocity_moves(self.points, self._parameters, self.ends)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            for side in (0, 1):
                result += functions[:, side, 1, None, None] * moves[segment + side]
        return made_finite(result)

    # The system

    @property
    def _pieces(self) -> HermiteCurve:
        """The same curve by points and velocities."""
        if self._hermite is None:
            self._solve()
        assert self._hermite is not None
        return self._hermite

    @property
    def _second(self) -> FloatArray:
        """The second derivatives at the joints."""
        if self._bends is None:
            self._bends = self._bends_for(self.points)
        return self._bends

    def _bends_for(self, points: FloatArray) -> FloatArray:
        """Return the second derivatives for any points, (n, k): to the last digit, for they nearly cancel."""
        _, bends = spline_derivatives(points, self._parameters, self.ends)
        return read_only(made_finite(refined_bends(points, self._parameters, bends, self.ends)))

    def _solve(self) -> None:
        """Compute first and second derivatives at the joints."""
        velocities, _ = spline_derivatives(self.points, self._parameters, self.ends)
        if not np.isfinite(velocities).all():
            raise overflow_in(velocities)
        self._bends = self._lines = None
        self._hermite = HermiteCurve(self.points, velocities, self._parameters)


# The derivatives at the joints, by one tridiagonal system


def spline_derivatives(
    points: FloatArray, parameters: FloatArray, ends: SplineEnds
) -> tuple[FloatArray, FloatArray]:
    """Return the first and the second derivatives at the joints; O(n).

    Parameters
    ----------
    points : ndarray, shape (n, dim)
    parameters : ndarray, shape (n,)
        Ascending.
    ends : SplineEnds

    Returns
    -------
    tuple of ndarray, shape (n, dim)
        Not finite where no double holds them.
    """
    with np.errstate(all="ignore"):
        spline = _Spline.of(points, parameters, ends)
        return np.ldexp(spline.velocities, -spline.exponent), np.ldexp(spline.bends, -2 * spline.exponent)


def velocity_moves(points: FloatArray, parameters: FloatArray, ends: SplineEnds) -> FloatArray:
    """Return the derivatives of the velocities by each parameter, at fixed points; O(n**2).

    Parameters
    ----------
    points, parameters, ends
        As for `spline_derivatives`.

    Returns
    -------
    ndarray, shape (n, n, dim)
        ``[j, i]`` is d(c'(t_j)) / dt_i. Not finite where no double holds it.

    Notes
    -----
    The system differentiated: the same one for the changes of the second derivatives, with the derivatives
    of its rows by the lengths as right sides.
    """
    n, dim = points.shape
    with np.errstate(all="ignore"):
        spline = _Spline.of(points, parameters, ends)
        h, double = spline.h, 2.0 * spline.slope
        starts, finishes = (double - spline.velocities[:-1]) / h, (double - spline.velocities[1:]) / h
        # A segment becomes shorter by what its beginning moves, and longer by what its end does.
        lengths = (np.eye(n - 1, n, 1) - np.eye(n - 1, n))[:, :, None]
        shares = _Shares(*((share[:, None] * lengths).reshape(n - 1, -1) for share in (-starts, finishes)))
        thirds = np.diff(spline.bends, axis=0) / (h * h)
        ratios = (thirds[:, None] * lengths).reshape(n - 1, -1)
        bends = _bends(h, shares, ends, np.stack([ratios[1:2] - ratios[:1], ratios[-1:] - ratios[-2:-1]]))
        moves = _velocities(h, shares, bends, ends)
        return np.ldexp(moves, -2 * spline.exponent).reshape(n, n, dim)


def refined_bends(
    points: FloatArray, parameters: FloatArray, bends: FloatArray, ends: SplineEnds
) -> FloatArray:
    """Return second derivatives at the joints after one step of iterative refinement.

    What they leave of the rows of the system is found in double-double arithmetic from the numbers given, so
    that the roundings of lengths, slopes and elimination are gone [1]_.

    Parameters
    ----------
    points : ndarray, shape (n, dim)
    parameters : ndarray, shape (n,)
    bends : ndarray, shape (n, dim)
        As from `spline_derivatives`.
    ends : SplineEnds

    References
    ----------
    .. [1] N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., SIAM 2002, chapter 12.
    """
    with np.errstate(all="ignore"):
        exponent = int(np.frexp(np.diff(parameters).max())[1])
        t = np.ldexp(parameters, -exponent)[:, None]
        h = difference(t[1:], t[:-1])
        slope = divide(difference(points[1:], points[:-1]), h)
        scaled = np.ldexp(bends, 2 * exponent)
        starts, finishes = _halves_of_rows(h, slope, scaled)
        before = DoubleDouble(*(np.roll(part, 1, axis=0) for part in finishes))
        rows = -add(starts, before).high / 6.0
        last = np.zeros_like(rows)
        if ends is SplineEnds.CLAMPED:
            rows[0], last[-1] = -starts.high[0] / 6.0, -finishes.high[-1] / 6.0
        thirds = divide(difference(scaled[1:], scaled[:-1]), h)
        at, beside = ([0, -1], [1, -2]) if len(rows) > 1 else ([0, 0], [0, 0])
        high, low = (part[at] - part[beside] for part in thirds)
        change = _bends(h.high, _Shares(rows, last), ends, (high + low)[:, None] * [[[1.0]], [[-1.0]]])
        refined = bends + np.ldexp(change, -2 * exponent)
        return np.where(np.isfinite(refined), refined, bends)


def _halves_of_rows(
    h: DoubleDouble, slope: DoubleDouble, bends: FloatArray
) -> tuple[DoubleDouble, DoubleDouble]:
    """Return the terms of segments in the left sides of the rows of their ends, less the right ones."""
    near, far = bends[:-1], bends[1:]
    sixfold = multiply(slope, DoubleDouble(np.array(6.0), np.array(0.0)))
    halves = []
    for first, second, sign in ((near, far, -1.0), (far, near, 1.0)):
        total = add(DoubleDouble(2.0 * first, 0.0 * first), DoubleDouble(second, 0.0 * second))
        halves.append(add(multiply(h, total), DoubleDouble(sign * sixfold.high, sign * sixfold.low)))
    return halves[0], halves[1]


class _Shares(NamedTuple):
    """A sixth of the terms of segments in the right sides of the rows of their ends.

    Attributes
    ----------
    starts, finishes : ndarray, shape (n - 1, k)
        To the rows of the joints before and behind them.
    """

    starts: FloatArray
    finishes: FloatArray


class _Spline(NamedTuple):
    """A spline in a unit of t in which the longest segment has a length of about 1.

    Attributes
    ----------
    exponent : int
        The unit is 2**exponent.
    h : ndarray, shape (n - 1, 1)
        Lengths of the segments.
    slope : ndarray, shape (n - 1, dim)
        From point to point.
    velocities, bends : ndarray, shape (n, dim)
        The first and the second derivatives at the joints.
    """

    exponent: int
    h: FloatArray
    slope: FloatArray
    velocities: FloatArray
    bends: FloatArray

    @classmethod
    def of(cls, points: FloatArray, parameters: FloatArray, ends: SplineEnds) -> _Spline:
        # For lengths near 1, so that their squares stay in range.
        spacing = np.diff(parameters)
        exponent = int(np.frexp(spacing.max())[1])
        h = np.ldexp(spacing, -exponent)[:, None]
        slope = np.diff(points, axis=0) / h
        shares = _Shares(slope, -slope)
        bends = _bends(h, shares, ends)
        if ends is SplineEnds.NOT_A_KNOT:
            # Beside a short segment all depends on a small difference of second derivatives.
            bends = refined_bends(points, np.ldexp(parameters, -exponent), bends, ends)
        return cls(exponent, h, slope, _velocities(h, shares, bends, ends), bends)


def _velocities(h: FloatArray, shares: _Shares, bends: FloatArray, ends: SplineEnds) -> FloatArray:
    at_starts = shares.starts - h / 6.0 * (2.0 * bends[:-1] + bends[1:])
    at_ends = h / 6.0 * (bends[:-1] + 2.0 * bends[1:]) - shares.finishes
    # Of two segments the shorter one: in a long one terms may cancel that are large beside the result.
    inner = np.where(h[:-1] < h[1:], at_ends[:-1], at_starts[1:])
    velocities = np.concatenate((at_starts[:1], inner, at_ends[-1:]))
    if ends is SplineEnds.CLAMPED:
        velocities[[0, -1]] = 0.0
    elif ends is SplineEnds.PERIODIC:
        velocities[[0, -1]] = at_ends[-1] if h[-1] < h[0] else at_starts[0]
    return velocities


def _bends(h: FloatArray, shares: _Shares, ends: SplineEnds, jumps: FloatArray | None = None) -> FloatArray:
    """Return the second derivatives at the joints.

    The jumps, (2, 1, k), are those of the third derivative at the joints that are not knots; 0 without them.
    """
    bends = np.zeros((len(h) + 1, shares.starts.shape[1]))
    if ends is SplineEnds.PERIODIC:
        bends[:-1] = _periodic(h, shares)
        bends[-1] = bends[0]
        return bends
    before, after, right_side = _inner_rows(h, shares)
    if ends is SplineEnds.CLAMPED:
        none, half = np.zeros((1, 1)), np.full((1, 1), 0.5)
        edges = 3.0 * shares.starts[:1] / h[:1], 3.0 * shares.finishes[-1:] / h[-1:]
        bends[:] = solve_dominant(
            np.concatenate((none, before, half)),
            np.concatenate((half, after, none)),
            np.concatenate((edges[0], right_side, edges[1])),
        )
    elif len(h) > 1 and ends is SplineEnds.NOT_A_KNOT:
        bends[:] = _not_a_knot(h, before, after, right_side, np.zeros((2, 1, 1)) if jumps is None else jumps)
    elif len(h) > 1:
        before[0] = after[-1] = 0.0
        bends[1:-1] = solve_dominant(before, after, right_side)
    return bends


def _inner_rows(h: FloatArray, shares: _Shares) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the rows of the inner joints: c' is the same on both sides."""
    length = h[:-1] + h[1:]
    before, after = 0.5 * (h[:-1] / length), 0.5 * (h[1:] / length)
    return before, after, 3.0 * ((shares.starts[1:] + shares.finishes[:-1]) / length)


def _not_a_knot(
    h: FloatArray, before: FloatArray, after: FloatArray, right_side: FloatArray, jumps: FloatArray
) -> FloatArray:
    """Return all second derivatives; those at the ends lie on the lines through the two beside them.

    Lines that bend by the jumps, (2, 1, k), where these are not 0.
    """
    if len(right_side) == 1:
        # A parabola: 3/2 of the row is twice the second divided difference.
        return np.repeat(right_side / 1.5, 3, axis=0)
    first, last = h[0] / h[1], h[-1] / h[-2]
    rise, fall = h[0] * jumps[0], h[-1] * jumps[1]
    right_side[0] -= before[0] * rise[0]
    right_side[-1] -= after[-1] * fall[0]
    # The row of the joint beside an end, with the unknown at the end replaced.
    after[0], right_side[0] = (1.0 - first) / (2.0 + first), right_side[0] * (2.0 / (2.0 + first))
    before[-1], right_side[-1] = (1.0 - last) / (2.0 + last), right_side[-1] * (2.0 / (2.0 + last))
    before[0] = after[-1] = 0.0
    inner = solve_dominant(before, after, right_side)
    start = inner[:1] + first * (inner[:1] - inner[1:2]) + rise
    end = inner[-1:] + last * (inner[-1:] - inner[-2:-1]) + fall
    return np.concatenate((start, inner, end))


def _periodic(h: FloatArray, shares: _Shares) -> FloatArray:
    """Return the second derivatives at all joints but the last, which is the first one again.

    The others are solved for twice: for the first one being 0, and for what it adds.
    """
    if len(h) == 1:
        return np.zeros_like(shares.starts)
    around = _Shares(*(np.concatenate((share[-1:], share)) for share in shares))
    before, after, right_side = _inner_rows(np.concatenate((h[-1:], h)), around)
    before_joint, after_joint = before[1:].copy(), after[1:].copy()
    seam = np.zeros_like(before_joint)
    seam[0] -= before_joint[0]
    seam[-1] -= after_joint[-1]
    before_joint[0] = after_joint[-1] = 0.0
    both = solve_dominant(before_joint, after_joint, np.concatenate((right_side[1:], seam), axis=1))
    rest, share = both[:, :-1], both[:, -1:]
    left = right_side[:1] - before[:1] * rest[-1:] - after[:1] * rest[:1]
    first = left / (1.0 + before[:1] * share[-1:] + after[:1] * share[:1])
    return np.concatenate((first, rest + share * first))


# Tridiagonal systems in which every unknown outweighs its neighbours

_FEW_EQUATIONS = 48
"""Equations, up to which a full matrix takes a fifth of the time of NumPy's calls without one."""
_WIDE = 64  # columns from which on a loop over the rows takes less than rounds over all of them


def overflow_in(derivatives: FloatArray) -> CurveError:
    """Return the error for derivatives, (n, dim), of which the first row that is not finite has no double."""
    i = int(np.argmin(np.isfinite(derivatives).all(axis=1)))
    return CurveError(
        f"points around {i} lie too far apart for such close parameters: "
        "the derivative there exceeds the largest number",
        (i,),
    )


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
    if len(right_side) <= _FEW_EQUATIONS:
        return _solve_few(before, after, right_side)
    if right_side.shape[1] >= _WIDE:
        return _solve_row_by_row(before, after, right_side)
    n, distance = len(right_side), 1
    # Row by column: along a short axis NumPy's operations take many times as long.
    left, right, values = before[:, 0], after[:, 0], np.ascontiguousarray(right_side.T)
    while distance < n and (left.any() or right.any()):
        d = distance
        diagonal = np.ones(n)
        diagonal[d:] -= left[d:] * right[:-d]
        diagonal[:-d] -= right[:-d] * left[d:]
        solved = values.copy()
        solved[:, d:] -= left[d:] * values[:, :-d]
        solved[:, :-d] -= right[:-d] * values[:, d:]
        next_left, next_right = np.zeros(n), np.zeros(n)
        next_left[d:] = -left[d:] * left[:-d]
        next_right[:-d] = -right[:-d] * right[d:]
        left, right = next_left / diagonal, next_right / diagonal
        values = solved / diagonal
        distance *= 2
    return np.ascontiguousarray(values.T)


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
