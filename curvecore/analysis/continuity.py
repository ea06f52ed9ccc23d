"""Smoothness of a curve at its joints, measured.

References
----------
.. [1] B. A. Barsky and T. D. DeRose, "Geometric continuity of parametric
   curves: three equivalent characterizations", IEEE Computer Graphics and
   Applications 9 (6), 1989, 60-69.
.. [2] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 11.1 to 11.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.analysis.curvature import curvature_of
from curvecore.arithmetic import SMALLEST, UNIT_ROUNDOFF, vector_lengths
from curvecore.arrays import BoolArray, FloatArray, IntArray, tolerance_value
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import JOINT_ORDERS, JOINT_ROUNDINGS

_BREAK = -1
_DATA_ROUNDINGS = 48.0 * UNIT_ROUNDOFF
"""Share of the largest coordinate, over powers of a length of t, by which rounded data change derivatives."""
_UNDERFLOW = SMALLEST / JOINT_ROUNDINGS
"""Size of terms whose rounding is that of numbers next to 0."""


class Joint(NamedTuple):
    """Jumps at one joint: the value after minus the value before.

    Attributes
    ----------
    joint : int
        Of the joint in ``curve.parameters``; 0 for the joint of a closed curve.
    parameter : float
        t_i.
    point_jump, velocity_jump, acceleration_jump, jerk_jump : ndarray, shape (dim,)
        Of c, c', c'' and c''', per unit of t.
    angle : float
        Between the tangent directions, in radians, from 0 to pi; NaN where
        the curve rests on a side and has no direction: its speed is 0, or below
        the tolerance beside way over time of both segments.
    curvature_before, curvature_after : float
        Signed in the plane; NaN where the curve rests, or is of dim 1.
    curvature_jump : float
        After minus before; in space the length of the difference of the
        curvature vectors.
    parametric : int
        The largest k for which c .. c^(k) are certainly continuous, up to 3; -1 is a break.
    geometric : int
        The same for a suitable change of t: 1 is a common tangent direction,
        2 a common curvature too, 3 also a common change of the curvature along
        the curve. At least 0 unless there is a break; at a
        point at rest never more.
    is_parametric_open, is_geometric_open : bool
        Whether double precision does not decide about the next order: its jump is
        below the rounding of this computation, and that is no small one.
    roundings : ndarray, shape (4,)
        Bounds of the jumps of c, c', c'' and c''' that rounding alone can make.
    speed_ratio : float
        ``|c'|`` after over that before: 1 where the speed goes on, whatever
        the direction does; NaN where the curve rests on a side.

    See Also
    --------
    joint_report : The function that returns them.

    Examples
    --------
    >>> from curvecore import HermiteCurve, joint_report
    >>> (joint,) = joint_report(HermiteCurve([[0, 0], [1, 0], [1, 1]], [[1, 0], [0, 1], [0, 1]], [0, 1, 2]))
    >>> joint.label, joint.parameter, joint.acceleration_jump.round(9).tolist()
    ('C1', 1.0, [4.0, -4.0])
    """

    joint: int
    parameter: float
    point_jump: FloatArray
    velocity_jump: FloatArray
    acceleration_jump: FloatArray
    jerk_jump: FloatArray
    angle: float
    curvature_before: float
    curvature_after: float
    curvature_jump: float
    parametric: int
    geometric: int
    speed_ratio: float
    is_parametric_open: bool
    is_geometric_open: bool
    roundings: FloatArray

    @property
    def jumps(self) -> tuple[FloatArray, ...]:
        """The jumps of c and its derivatives, by their order."""
        return self.point_jump, self.velocity_jump, self.acceleration_jump, self.jerk_jump

    @property
    def label(self) -> str:
        """The class in words: ``"C3"``, ``"C1, G2"``, ``"C0, G1"``, ``"C0"``, ``"break"`` ...

        G is named only where it says more than C. ``"≥C1"`` is C1, and perhaps more: that is not decided.
        """
        if self.parametric == _BREAK:
            return "break"
        motion, line = ("≥" if more else "" for more in (self.is_parametric_open, self.is_geometric_open))
        # An open G of the order of C says more than a C that is decided.
        says_more = (self.geometric, line) > (self.parametric, motion)
        return f"{motion}C{self.parametric}" + says_more * f", {line}G{self.geometric}"


def joint_report(curve: ParametricCurve, tolerance: float = 1e-9, closed: bool = False) -> list[Joint]:
    """Measure the jumps at every joint and say how smooth the curve is there.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim. A `Chain` may jump in anything at a joint
        between pieces, the Hermite families in their next derivative. A
        `LagrangeCurve` has no joints: its t_i are reported as C3.
    tolerance : float, optional
        How large a jump counts as none: relative to the extent of the points for
        c; to the larger of both sides for its derivatives, for the curvature and
        for its change along the curve; in radians for the angle. A jump that
        rounding can make is none too, where that is less than this share of a
        typical size: that of a curve covering the ways of both segments in their
        times. Else it is not decided. Derivatives that are differences are
        compared by the digits that these keep.
    closed : bool, optional
        Whether the curve is meant to be closed, so that its end and its
        beginning are a joint too, reported last as joint 0.

    Returns
    -------
    list of Joint
        In order of t.

    Raises
    ------
    CurveError
        If the tolerance is not a positive number.

    See Also
    --------
    Joint : What it returns.

    Examples
    --------
    >>> from curvecore import HermiteCurve, joint_report
    >>> curve = HermiteCurve([[0, 0], [1, 0], [1, 1]], [[1, 0], [0, 1], [0, 1]], [0, 1, 2])
    >>> [(joint.parameter, joint.label) for joint in joint_report(curve)]
    [(1.0, 'C1')]
    """
    limit = tolerance_value(tolerance)
    t = curve.parameters
    limits = np.full(JOINT_ORDERS, limit)
    if curve.difference_digits:
        limits[1:] = np.maximum(limit, 10.0 ** (1.5 - np.array(curve.difference_digits)))
    indices = (np.arange(1, len(t)) % (len(t) - 1))[: None if closed else -1]
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        before, after, typical = _sides(curve, indices)
        jumps = after.values - before.values
        motion = _verdicts(_Jumps.of_motion(before, after, typical), limits)
        extent = np.ptp(curve.points, axis=0).max()
        motion[:, 0] = np.where(vector_lengths(jumps[:, 0]) <= limit * extent, _NONE, _JUMPS)
        rests = _rests(before, limits, typical) | _rests(after, limits, typical)
        before, after = before.with_direction(~rests), after.with_direction(~rests)
        angle = _angles(before.values[:, 1], after.values[:, 1])
        bends = _bends(before.values, after.values)
        line = _verdicts(_Jumps.of_line(before, after, typical, angle, bends), limits[1:])
        ratio = after.sizes[:, 1] / before.sizes[:, 1]
    motion, line = _agreed(motion, np.column_stack((motion[:, :1], line)), rests)
    parametric, is_parametric_open = _orders(motion)
    geometric, is_geometric_open = _orders(line)
    numbers = (angle, *bends, parametric, geometric, ratio, is_parametric_open, is_geometric_open)
    columns = (
        indices.tolist(),
        t[indices].tolist(),
        *jumps.swapaxes(0, 1),
        *(column.tolist() for column in numbers),
        before.roundings + after.roundings,
    )
    return [Joint._make(row) for row in zip(*columns, strict=True)]


class _Side(NamedTuple):
    """One side of joints.

    Attributes
    ----------
    values : ndarray, shape (k, 4, dim)
        c to c'''.
    sizes, roundings : ndarray, shape (k, 4)
        Their lengths, and bounds of the errors of their computation.
    data_errors : ndarray, shape (k, 4)
        Their errors that come from coordinates and parameters, if these were rounded to doubles.
    """

    values: FloatArray
    sizes: FloatArray
    roundings: FloatArray
    data_errors: FloatArray

    def with_direction(self, has_direction: BoolArray) -> _Side:
        """Return the side with velocities that are NaN where there is no direction."""
        values, sizes = self.values.copy(), self.sizes.copy()
        values[~has_direction, 1] = sizes[~has_direction, 1] = np.nan
        return self._replace(values=values, sizes=sizes)

    def of_line(self, errors: FloatArray) -> FloatArray:
        """Return errors (k, 3) of direction, curvature and its change along the curve, by those of values."""
        speed, acceleration, jerk = self.sizes[:, 1:].T
        _, off_speed, off_acceleration, off_jerk = errors.T
        angle = off_speed / speed
        pull = acceleration / speed
        bend = (off_acceleration + 2.0 * acceleration * angle) / speed / speed
        turn = off_jerk + 6.0 * pull * off_acceleration + (3.0 * jerk + 12.0 * acceleration * pull) * angle
        return np.column_stack((angle, bend, turn / speed / speed / speed)) + SMALLEST


def _sides(curve: ParametricCurve, indices: IntArray) -> tuple[_Side, _Side, FloatArray]:
    """Return the sides before and after joints, and typical sizes of derivatives there, (k, 4).

    Typical is a curve that covers the ways of both segments beside a joint in their times: of both together,
    so that a short segment does not count alone.
    """
    ends, starts = (curve.joint_derivatives(before=side) for side in (True, False))
    t, powers = curve.parameters, np.arange(JOINT_ORDERS)
    h = np.diff(t)
    chords = vector_lengths(ends.values[:, 0] - starts.values[:, 0])
    speeds = 0.5 * (vector_lengths(starts.values[:, 1]) + vector_lengths(ends.values[:, 1]))
    distances = 0.5 * (chords + h * speeds)
    distance, time = (part[indices - 1] + part[indices] for part in (distances, h))
    typical = distance[:, None] / time[:, None] ** powers
    # A parameter that is off moves the curve as a point does that is off along it.
    errors = _DATA_ROUNDINGS * (np.abs(curve.points).max() + np.abs(t).max() * typical[:, 1])
    values = [ends.values[indices - 1], starts.values[indices]]
    scales = [part + _UNDERFLOW for part in (ends.scale[indices - 1], starts.scale[indices])]
    # Where nothing can jump, nothing does, whatever is computed on both sides.
    is_smooth = ~np.isin(t[indices], curve.breaks)
    values[0][is_smooth] = values[1][is_smooth]
    scales[0][is_smooth] = scales[1][is_smooth] = 0.0
    before, after = (
        _Side(part, vector_lengths(part), JOINT_ROUNDINGS * scale, errors[:, None] / h[rows, None] ** powers)
        for part, scale, rows in zip(values, scales, (indices - 1, indices), strict=True)
    )
    return before, after, typical


def _rests(side: _Side, limits: FloatArray, typical: FloatArray) -> BoolArray:
    """Return whether the speed is certainly within the limit of the typical one: there is no direction."""
    return np.maximum(side.sizes, side.roundings)[:, 1] <= (limits * typical)[:, 1]


class _Jumps(NamedTuple):
    """Jumps, and the numbers that they are compared with, all (k, orders).

    Attributes
    ----------
    jumps
    sizes
        Of the quantities that jump: the larger one of both sides.
    typical
        Their sizes on a curve that covers the same ways in the same times.
    roundings, data_errors
        Of both sides together; see `_Side`.
    """

    jumps: FloatArray
    sizes: FloatArray
    typical: FloatArray
    roundings: FloatArray
    data_errors: FloatArray

    @classmethod
    def of_motion(cls, before: _Side, after: _Side, typical: FloatArray) -> _Jumps:
        """Return the jumps of c to c'''."""
        return cls(
            vector_lengths(after.values - before.values),
            np.maximum(before.sizes, after.sizes),
            typical,
            before.roundings + after.roundings,
            before.data_errors + after.data_errors,
        )

    @classmethod
    def of_line(
        cls, before: _Side, after: _Side, typical: FloatArray, angle: FloatArray, bends: _Bends
    ) -> _Jumps:
        """Return the jumps of direction, curvature and its change along the curve."""
        turns = [_turn_vectors(side.values) for side in (before, after)]
        length = typical[:, :1]
        bend = np.maximum(np.abs(bends.before), np.abs(bends.after))
        return cls(
            np.column_stack((angle, np.abs(bends.jump), vector_lengths(turns[1] - turns[0]))),
            np.column_stack((np.ones(len(length)), bend, np.maximum(*map(vector_lengths, turns)))),
            length ** -np.arange(3.0),
            before.of_line(before.roundings) + after.of_line(after.roundings),
            before.of_line(before.data_errors) + after.of_line(after.data_errors),
        )


_NONE, _JUMPS, _OPEN = range(3)
"""Verdicts on a jump: there is none, there is one, and rounding hides which."""


def _verdicts(of: _Jumps, limits: FloatArray) -> IntArray:
    """Return the verdicts (k, orders) for relative limits (orders,).

    There is none within the limit of the larger value, or where roundings can make it that are within the
    limit of a typical one.
    """
    is_sure = of.roundings <= limits * np.maximum(of.sizes, of.typical)
    # Of numbers beyond the doubles nothing is certain, but of a curve that goes nowhere.
    is_sure = (is_sure & np.isfinite(of.typical)) | (of.typical[:, :1] == 0.0)
    invisible = np.minimum(limits * of.typical, of.data_errors)
    is_none = of.jumps <= np.maximum(limits * of.sizes, of.roundings + invisible)
    return np.where(is_none, np.where(is_sure, _NONE, _OPEN), _JUMPS)


def _agreed(motion: IntArray, line: IntArray, rests: BoolArray) -> tuple[IntArray, IntArray]:
    """Return the classes of both kinds, raised by each other: a C2 joint with a tangent is G2."""
    goes_on = np.logical_and.accumulate(motion == _NONE, axis=1)
    has_tangent = line[:, 1] == _NONE
    line = np.where(goes_on & has_tangent[:, None], _NONE, line)
    bends = np.logical_or.accumulate(line == _JUMPS, axis=1) & ~rests[:, None]
    return np.where((motion == _OPEN) & bends, _JUMPS, motion), line


def _orders(verdicts: IntArray) -> tuple[IntArray, BoolArray]:
    """Return the number of leading columns without a jump, less one, and whether the next is open."""
    count: IntArray = np.logical_and.accumulate(verdicts == _NONE, axis=1).sum(axis=1)
    beyond = np.column_stack((verdicts, np.full(len(verdicts), _JUMPS)))
    return count - 1, beyond[np.arange(len(count)), count] == _OPEN


def _unit(vectors: FloatArray) -> FloatArray:
    length = vector_lengths(vectors)[:, None]
    return np.where(length > 0.0, vectors / length, np.nan)


def _angles(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return angles between vectors: 2 atan2(|a - b|, |a + b|), accurate for small and large ones."""
    a, b = _unit(first), _unit(second)
    # Not `vector_lengths`: it would turn NaN into an angle.
    return np.asarray(2.0 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1)))


class _Bends(NamedTuple):
    """Curvatures before and after joints, and their jumps."""

    before: FloatArray
    after: FloatArray
    jump: FloatArray


def _bends(before: FloatArray, after: FloatArray) -> _Bends:
    """Return the curvatures of c, c', c'', (k, 3, dim), on both sides."""
    if before.shape[2] < 2:
        none = np.full(len(before), np.nan)
        return _Bends(none, none, none)
    first, second = (curvature_of(values[:, 1], values[:, 2]) for values in (before, after))
    if before.shape[2] == 2:
        return _Bends(first, second, second - first)
    return _Bends(first, second, vector_lengths(_bend_vectors(after) - _bend_vectors(before)))


def _bend_vectors(values: FloatArray) -> FloatArray:
    """Return the curvature vectors: the part of c'' across c', over |c'|**2."""
    unit = _unit(values[:, 1])
    across = values[:, 2] - (values[:, 2] * unit).sum(axis=1, keepdims=True) * unit
    return np.asarray(across / vector_lengths(values[:, 1])[:, None] ** 2)


def _turn_vectors(values: FloatArray) -> FloatArray:
    """Return the part across c' of the third derivative by the arc length, (k, dim).

    With v = |c'| and v' = c' c'' / v that of c''' / v**3 - 3 v' c'' / v**4.
    """
    unit, speed = _unit(values[:, 1]), vector_lengths(values[:, 1])[:, None]
    growth = (unit * values[:, 2]).sum(axis=1, keepdims=True)
    # Step by step: the cube of a speed is soon beyond the doubles.
    third = (values[:, 3] - 3.0 * (growth / speed) * values[:, 2]) / speed / speed / speed
    return np.asarray(third - (third * unit).sum(axis=1, keepdims=True) * unit)
