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
from curvecore.arrays import BoolArray, FloatArray, IntArray, tolerance_value
from curvecore.families.curve import ParametricCurve
from curvecore.families.records import JointDerivatives
from curvecore.vectors import vector_lengths

_BREAK = -1


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
        the curve rests on a side and has no direction.
    curvature_before, curvature_after : float
        Signed in the plane; NaN where the curve rests, or is of dim 1.
    curvature_jump : float
        After minus before; in space the length of the difference of the
        curvature vectors.
    parametric : int
        The largest k for which c .. c^(k) are continuous, up to 3; -1 is a break.
    geometric : int
        The same for a suitable change of t: 1 is a common tangent direction,
        2 a common curvature too, 3 also a common change of the curvature along
        the curve. At least 0 unless there is a break; at a
        point at rest never more.
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

    @property
    def jumps(self) -> tuple[FloatArray, ...]:
        """The jumps of c and its derivatives, by their order."""
        return self.point_jump, self.velocity_jump, self.acceleration_jump, self.jerk_jump

    @property
    def label(self) -> str:
        """The class in words: ``"C3"``, ``"C1, G2"``, ``"C0, G1"``, ``"C0"``, ``"break"`` ...

        G is named only where it says more than C.
        """
        if self.parametric == _BREAK:
            return "break"
        more = f", G{self.geometric}" if self.geometric > self.parametric else ""
        return f"C{self.parametric}{more}"


def joint_report(curve: ParametricCurve, tolerance: float = 1e-9, closed: bool = False) -> list[Joint]:
    """Measure the jumps at every joint and say how smooth the curve is there.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim. A `Chain` may jump in anything at a joint
        between pieces, the Hermite families in their next derivative. A
        `LagrangeCurve` has no joints: its t_i are reported as C3.
    tolerance : float, optional
        How large a jump counts as none: relative to the extent of the points
        for c; for its derivatives to the sum of the sizes of the terms they are
        made of, for instance 6 |dp| / h**2 + 4 |v| / h + 2 |w| / h for c'' of a
        cubic, which is what rounding is relative to as well. For the angle in
        radians. For the curvature relative to the larger one, and to the
        acceleration's terms over |c'|**2; for its change likewise, and to the
        jerk's terms over |c'|**3.
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
    indices = (np.arange(1, len(t)) % (len(t) - 1))[: None if closed else -1]
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        ends, starts = (curve.joint_derivatives(before=side) for side in (True, False))
        before = JointDerivatives(*(each[: len(indices)] for each in ends))
        after = JointDerivatives(*(np.roll(each, -1, axis=0)[: len(indices)] for each in starts))
        jumps = after.values - before.values
        scale = np.maximum(before.scale, after.scale)
        scale[:, 0] = np.ptp(curve.points, axis=0).max()
        smooth = vector_lengths(jumps) <= limit * scale
        angle = _angles(before.values[:, 1], after.values[:, 1])
        bends = _bends(before.values, after.values)
        speeds = [vector_lengths(each.values[:, 1]) for each in (before, after)]
        slow = np.minimum(*speeds)
        ratio = np.where(slow > 0.0, speeds[1] / speeds[0], np.nan)
        bend_scale = np.maximum(np.abs(bends.before), np.abs(bends.after)) + scale[:, 2] / slow**2
        same_bend = np.abs(bends.jump) <= limit * bend_scale
        turns = [_turn_vectors(values) for values in (before.values, after.values)]
        # Each part of the change is a product: of the speed's own change by the acceleration's terms too.
        turn_scale = (scale[:, 3] + 3.0 * scale[:, 2] ** 2 / slow) / slow**3
        same_turn = vector_lengths(turns[1] - turns[0]) <= limit * turn_scale
    geometric = np.column_stack((smooth[:, 0], angle <= limit, same_bend, same_turn))
    numbers = (angle, *bends, _orders(smooth), _orders(geometric), ratio)
    vectors = jumps.swapaxes(0, 1)
    columns = (indices.tolist(), t[indices].tolist(), *vectors, *(each.tolist() for each in numbers))
    return [Joint._make(row) for row in zip(*columns, strict=True)]


def _orders(holds: BoolArray) -> IntArray:
    """Return how many columns hold from the first on, less one, (k,)."""
    orders: IntArray = np.logical_and.accumulate(holds, axis=1).sum(axis=1) - 1
    return orders


def _unit(vectors: FloatArray) -> FloatArray:
    length = vector_lengths(vectors)[:, None]
    return np.where(length > 0.0, vectors / length, np.nan)


def _angles(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return angles between vectors: 2 atan2(|a - b|, |a + b|), accurate for small and large ones."""
    a, b = _unit(first), _unit(second)
    # Not `vector_lengths`: it would turn NaN into an angle.
    angle: FloatArray = 2.0 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
    return angle


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
    bend: FloatArray = across / vector_lengths(values[:, 1])[:, None] ** 2
    return bend


def _turn_vectors(values: FloatArray) -> FloatArray:
    """Return the part across c' of the third derivative by the arc length, (k, dim).

    With v = |c'| and v' = c' c'' / v that of c''' / v**3 - 3 v' c'' / v**4.
    """
    unit, speed = _unit(values[:, 1]), vector_lengths(values[:, 1])[:, None]
    growth = (unit * values[:, 2]).sum(axis=1, keepdims=True)
    third = (values[:, 3] - 3.0 * (growth / speed) * values[:, 2]) / speed**3
    across: FloatArray = third - (third * unit).sum(axis=1, keepdims=True) * unit
    return across
