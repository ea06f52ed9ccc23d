"""How smooth a curve is at its joints, measured.

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

from curvecore.analysis.geometry import curvature_of
from curvecore.arrays import BoolArray, FloatArray, tolerance_value
from curvecore.families.curve import Curve, JointDerivatives
from curvecore.vectors import vector_lengths

_BREAK = -1


class Joint(NamedTuple):
    """What happens at one joint; jumps are the value after minus the value before.

    Attributes
    ----------
    joint : int
        Of the joint in ``curve.parameters``; 0 for the joint of a closed curve.
    parameter : float
        t_i.
    point_jump, velocity_jump, acceleration_jump : ndarray, shape (dim,)
        Of c, c' and c'', per unit of t.
    angle : float
        Between the tangent directions, in radians, from 0 to pi; NaN where
        the curve rests on a side and has no direction.
    curvature_before, curvature_after : float
        Signed in the plane; NaN where the curve rests, or is of dim 1.
    curvature_jump : float
        After minus before; in space the length of the difference of the
        curvature vectors.
    parametric : int
        The largest k for which c .. c^(k) are continuous, up to 2; -1 is a break.
    geometric : int
        The same for a suitable change of t: 1 is a common tangent direction,
        2 a common curvature too. At least 0 unless there is a break; at a
        point at rest never more.
    """

    joint: int
    parameter: float
    point_jump: FloatArray
    velocity_jump: FloatArray
    acceleration_jump: FloatArray
    angle: float
    curvature_before: float
    curvature_after: float
    curvature_jump: float
    parametric: int
    geometric: int

    @property
    def label(self) -> str:
        """The class in words: ``"C2"``, ``"C1, G2"``, ``"C0, G1"``, ``"C0"``, ``"break"`` ...

        G is named only where it says more than C.
        """
        if self.parametric == _BREAK:
            return "break"
        more = f", G{self.geometric}" if self.geometric > self.parametric else ""
        return f"C{self.parametric}{more}"


def joint_report(curve: Curve, tolerance: float = 1e-9, closed: bool = False) -> list[Joint]:
    """Measure the jumps at every joint and say how smooth the curve is there.

    Parameters
    ----------
    curve : Curve
        Of any family and dim. A `Chain` may jump in anything at a joint
        between pieces, the Hermite families in their next derivative. A
        `LagrangeCurve` has no joints: its t_i are reported as C2.
    tolerance : float, optional
        How large a jump counts as none: relative to the extent of the points
        for c; for c' and c'' to the sum of the sizes of the terms they are
        made of, for instance 6 |dp| / h**2 + 4 |v| / h + 2 |w| / h for c'' of a
        cubic, which is what rounding is relative to as well. For the angle in
        radians. For the curvature relative to the larger one, and to the
        acceleration's terms over |c'|**2.
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
    """
    limit = tolerance_value(tolerance)
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        before, after = (curve.joint_derivatives(before=side) for side in (True, False))
        if not closed:
            before = JointDerivatives(before.values[:-1], before.scale[:-1])
            after = JointDerivatives(after.values[1:], after.scale[1:])
        else:
            after = JointDerivatives(*(np.roll(each, -1, axis=0) for each in after))
        extent = float(np.ptp(curve.points, axis=0).max())
        indices = [*range(1, len(curve.parameters) - 1), *([0] if closed else [])]
        return _measured(curve.parameters, indices, before, after, limit, extent)


def _measured(
    parameters: FloatArray,
    indices: list[int],
    before: JointDerivatives,
    after: JointDerivatives,
    tolerance: float,
    extent: float,
) -> list[Joint]:
    jumps = after.values - before.values
    size = vector_lengths(jumps)
    scale = np.maximum(before.scale, after.scale)
    scale[:, 0] = extent
    smooth = size <= tolerance * scale
    angle = _angles(before.values[:, 1], after.values[:, 1])
    bends = [_bends(each.values) for each in (before, after)]
    bend_jump = vector_lengths(bends[1] - bends[0])
    signed = [_signed(each.values) for each in (before, after)]
    if jumps.shape[2] <= 2:
        bend_jump = signed[1] - signed[0]
    slow = np.minimum(vector_lengths(before.values[:, 1]), vector_lengths(after.values[:, 1]))
    bend_scale = np.maximum(np.abs(signed[0]), np.abs(signed[1])) + scale[:, 2] / slow**2
    same_tangent = angle <= tolerance
    same_bend = np.abs(bend_jump) <= tolerance * bend_scale
    report = []
    for row, index in enumerate(indices):
        parametric = _order(smooth[row])
        geometric = _order(np.array([smooth[row, 0], same_tangent[row], same_bend[row]]))
        report.append(
            Joint(
                index,
                float(parameters[index]),
                jumps[row, 0],
                jumps[row, 1],
                jumps[row, 2],
                float(angle[row]),
                float(signed[0][row]),
                float(signed[1][row]),
                float(bend_jump[row]),
                parametric,
                geometric,
            )
        )
    return report


def _order(holds: BoolArray) -> int:
    """Return how many hold from the first on, less one."""
    return int(np.argmin(np.append(holds, False))) - 1


def _unit(vectors: FloatArray) -> FloatArray:
    length = vector_lengths(vectors)[:, None]
    return np.where(length > 0.0, vectors / length, np.nan)


def _angles(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return angles between vectors: 2 atan2(|a - b|, |a + b|), accurate for small and large ones."""
    a, b = _unit(first), _unit(second)
    # Not `vector_lengths`: it would turn NaN into an angle.
    angle: FloatArray = 2.0 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
    return angle


def _signed(values: FloatArray) -> FloatArray:
    if values.shape[2] < 2:
        return np.full(len(values), np.nan)
    return curvature_of(values[:, 1], values[:, 2])


def _bends(values: FloatArray) -> FloatArray:
    """Return the curvature vectors: the part of c'' across c', over |c'|**2."""
    unit = _unit(values[:, 1])
    across = values[:, 2] - (values[:, 2] * unit).sum(axis=1, keepdims=True) * unit
    bend: FloatArray = across / vector_lengths(values[:, 1])[:, None] ** 2
    return bend
