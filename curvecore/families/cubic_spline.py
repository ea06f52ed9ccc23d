"""The twice continuously differentiable cubic spline."""

from __future__ import annotations

import math
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import made_finite, vector_lengths
from curvecore.arrays import FloatArray, IntArray, parameter_row, read_only
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.hermite import HermiteCurve
from curvecore.families.records import Interpolant, JointDerivatives, Slopes
from curvecore.families.setting import FamilySetting, SettingValue
from curvecore.families.spline_system import SplineEnds, refined_bends, spline_derivatives, velocity_moves
from curvecore.families.taylor_pieces import TaylorPieces, taylor_pieces


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
        values: FloatArray = joints[1] - joints[0]
        return values


class CubicSplineCurve(ParametricCurve):
    """Cubic pieces whose bend does not jump.

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
    place = 40
    settings = (
        FamilySetting(
            "ends",
            "ends",
            SplineEnds.NATURAL.value,
            "The conditions at both ends: c″ = 0, c′ = 0, no jump of c‴ beside them, or the same c′ and c″",
            choices=tuple((each.value, each.label) for each in SplineEnds),
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
        """3."""
        return 3

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the curve with other points; it shares everything that depends on the parameters."""
        curve = super().with_jets(jets)
        curve._units = self._units
        curve._solve()
        return curve

    def _evaluate_at_once(self, t: FloatArray, order: object) -> FloatArray | None:
        """Evaluate by the points and velocities what is as accurate by these, else by c''."""
        if type(order) is int and order >= 2:
            return self._evaluate_lines(t, order)
        return self._pieces._evaluate_at_once(t, order)

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        if order < 2 and bool((self._outside(t) == 0).all()):
            return self._pieces._evaluate(t, order)
        if order >= 2 and (found := self._evaluate_lines(t, order)) is not None:
            return found
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
        return self._summed(t, order, self._units)[:, :, None]

    def _outside(self, t: FloatArray) -> IntArray:
        """Return -1 where t lies before the domain, 1 where it lies behind it, else 0."""
        first, last = self.domain
        return (t > last).astype(np.intp) - (t < first)

    def _summed(self, t: FloatArray, order: int, data: _Data) -> FloatArray:
        """Return sums of the data, (m, k), by the formula that is most accurate at each t."""
        outside = self._outside(t)
        inside = outside == 0
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
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
            rows, own = np.arange(len(t)), data is self._units
            for side in (0, 1):
                if own:  # each point is its own function alone
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
        values, scale = (each.copy() for each in self._pieces.joint_derivatives(before=before))
        h, sizes = np.diff(self._parameters), vector_lengths(self._second)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            values[:, 2] = self._second[1:] if before else self._second[:-1]
            values[:, 3] = np.diff(self._second, axis=0) / h[:, None]
            scale[:, 2] = sizes[1:] if before else sizes[:-1]
            scale[:, 3] = (sizes[1:] + sizes[:-1]) / h
        return JointDerivatives(values, scale)

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, n, dim): at fixed velocities, and by what these change."""
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
        finite = np.isfinite(velocities).all(axis=1)
        if not finite.all():
            index = int(np.argmin(finite))
            raise CurveError(
                f"points around {index} lie too far apart for parameters so close: "
                "the derivative there exceeds the largest number",
                (index,),
            )
        self._bends = self._lines = None
        self._hermite = HermiteCurve(self.points, velocities, self._parameters)
