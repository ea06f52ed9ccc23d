"""The joint certificate: the jumps at each joint, in numbers and in words."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from curvecore import Joint, joint_report

from ...document.words import NOTHING, names_of, number
from ..curve.curve_view import CurveView
from ..geometry import size_of

_MOST_NAMED = 3
"""Joints named one by one in the summary; of more, it has their number."""

_RESIDUE = 1e-9
"""A jump of the curvature below this share of the curvature itself is a rounding residue; likewise below this
number over the distance of the nearer neighbour."""

_LEAST_ANGLE = 1e-3
"""Degrees; a smaller angle is shown as below it."""


class JointKind(Enum):
    """The kinds of joints, from smooth to broken; the value is the sign, beside its colour."""

    SMOOTH = "✓"
    UNDECIDED = "?"
    ACCELERATION = "△"
    SPEED = "◇"
    REST = "○"
    CORNER = "▲"
    BREAK = "✕"


_RESTS = "The velocity is zero here, so the curve has no direction: there may be a corner or a cusp."

_WORDS = {
    (3, 2): "Smooth: velocity, acceleration, jerk, direction and curvature are continuous.",
    (2, 2): "Smooth: velocity, acceleration, direction and curvature are continuous; the jerk jumps.",
    (1, 2): "The acceleration jumps; velocity and curvature are continuous: the joint is not visible.",
    (1, 1): "The velocity is continuous; acceleration and curvature jump: a moving body feels a jerk.",
    (0, 2): "The speed jumps; direction and curvature are continuous: the joint is not visible in the line.",
    (0, 1): "Speed and curvature jump; the direction is continuous: no corner, but acceleration jumps.",
    (0, 0): "A corner: the direction jumps.",
    (-1, -1): "The curve is broken.",
}
"""The words for orders of parametric and geometric continuity, the latter up to curvature."""

_CONTINUOUS = (
    "The curve is continuous",
    "The velocity is continuous",
    "Velocity and acceleration are continuous",
)
_OF_MOTION = ("point", "velocity", "acceleration", "jerk")
_OF_LINE = ("point", "direction", "curvature", "change of the curvature")
"""The quantities that are continuous, or jump, by their orders: of the motion, and of the drawn line."""

_RAISED = str.maketrans("0123", "⁰¹²³")


@dataclass(frozen=True)
class JointRow:
    """One joint.

    Attributes
    ----------
    joint
        The index of its parameter: that of its point, if the curve passes its points.
    position
        Its position.
    reach
        The distance to the nearer of its neighbours, for a close-up.
    jumps
        Sizes of the jumps of c, c', c'' and c'''; exactly 0 where there is none beyond rounding, NaN where
        double precision does not decide.
    angle
        Between the tangents before and after, in degrees; NaN where the curve stands still, or where double
        precision does not decide.
    curvature
        The jump of the curvature; NaN as the angle.
    continuity
        The orders of parametric and geometric continuity, up to 3; -1 for a break.
    smoothness
        The same as "C³", "C¹, G²", "≥C¹" or "break".
    kind, words
        The kind of the joint, and a sentence about it.
    speed_ratio
        The speed after the joint over that before it; NaN where the curve stands still.
    measured
        The measured angle, and the speeds before and after, in a few words; empty at rest.
    """

    joint: int
    t: float
    position: tuple[float, float]
    reach: float
    jumps: tuple[float, ...]
    angle: float
    curvature: float
    continuity: tuple[int, int]
    smoothness: str
    kind: JointKind
    words: str
    speed_ratio: float
    measured: str

    def written(self, write: Callable[[float], str]) -> list[str]:
        """Return jumps, angle, jump of the curvature and speed ratio as texts: "?" for undecided values.

        Where the curve stands still its direction is not undecided: there is none.
        """
        undecided = JointKind.UNDECIDED.value
        of_line = NOTHING if self.kind is JointKind.REST else undecided
        texts = [undecided if math.isnan(jump) else write(jump) for jump in self.jumps]
        others = (self.angle, self.curvature, self.speed_ratio)
        return [*texts, *(of_line if math.isnan(number) else write(number) for number in others)]


@dataclass(frozen=True)
class Certificate:
    """All joints of a curve, and one sentence about them."""

    rows: tuple[JointRow, ...]
    summary: str


def certificate_of(view: CurveView) -> Certificate:
    """Return the certificate of a curve; without joints, with the reason in its summary."""
    if view.curve is None or not view.is_current:
        return Certificate((), view.problem)
    if view.source.family.curve_class.is_one_polynomial:
        return Certificate((), "One polynomial: no joints. All derivatives are continuous everywhere.")
    breaks = view.curve.breaks
    if len(breaks) == 2 < len(view.parameters) and not view.source.is_closed:
        # By the declaration of the family; differences could only show that jumps are small.
        return Certificate((), f"No joints: {view.source.family.a_curve} has no inner breaks.")
    report = joint_report(view.curve, closed=view.source.is_closed)
    joints = [joint for joint in report if joint.joint == 0 or view.parameters[joint.joint] in breaks]
    if not joints:
        return Certificate((), "One piece between two points: no joints.")
    reaches = _reaches(view)
    rows = tuple(_row(view, joint, reaches) for joint in joints)
    return Certificate(rows, _summary(rows))


def _row(view: CurveView, joint: Joint, reaches: list[float]) -> JointRow:
    point = view.owner(joint.joint)
    is_there = view.source.family.interpolates
    x, y = (view.points[point] if is_there else view.present_curve.evaluate(joint.parameter)).tolist()
    sizes = (math.hypot(*jump.tolist()) for jump in joint.jumps)
    continuity = (joint.parametric, max(joint.parametric, joint.geometric))
    kind = _kind(joint)
    return JointRow(
        joint=point,
        t=joint.parameter,
        position=(x, y),
        reach=reaches[point],
        jumps=tuple(_displayed_jump(joint, order, size) for order, size in enumerate(sizes)),
        angle=_angle(joint),
        curvature=_curvature_jump(joint, reaches[point]),
        continuity=continuity,
        smoothness=joint.label.translate(_RAISED),
        kind=kind,
        words=_words(joint, kind),
        speed_ratio=joint.speed_ratio,
        measured="" if math.isnan(_angle(joint)) else _measured(joint),
    )


def _displayed_jump(joint: Joint, order: int, size: float) -> float:
    is_rounding, is_next = size <= joint.roundings[order], order == joint.parametric + 1
    if order > joint.parametric and joint.is_parametric_open and (is_next or is_rounding):
        return math.nan
    return 0.0 if order <= joint.parametric or is_rounding else size


def _angle(joint: Joint) -> float:
    if joint.geometric >= 1:
        return 0.0
    return math.nan if joint.is_geometric_open else math.degrees(joint.angle)


def angle_text(degrees: float, digits: int = 3, mark: str = ".") -> str:
    """Return the text of an angle in degrees, never with an exponent."""
    if 0.0 < degrees < _LEAST_ANGLE:
        return f"<{number(_LEAST_ANGLE, mark=mark)}°"
    return f"{number(degrees, digits, mark, step=1.0)}°"


def _words(joint: Joint, kind: JointKind) -> str:
    """Return a sentence or two about a joint."""
    undecided, bound = "", ""
    if joint.is_parametric_open:
        undecided = _OF_MOTION[joint.parametric + 1]
        bound = f": rounding alone can make it jump by {number(joint.roundings[joint.parametric + 1], 2)}"
    elif joint.is_geometric_open:
        undecided = _OF_LINE[joint.geometric + 1]
    if kind is JointKind.REST:
        sure = _RESTS
    elif undecided:
        jumps = "" if joint.is_parametric_open or joint.parametric == 3 else _OF_MOTION[joint.parametric + 1]
        sure = _CONTINUOUS[min(joint.parametric, 2)] + (f", the {jumps} jumps." if jumps else ".")
    else:
        sure = _WORDS[joint.parametric, min(max(joint.parametric, joint.geometric), 2)]
    rest = f" Double precision does not decide whether the {undecided} is continuous{bound}."
    return sure + (rest if undecided else "")


def _measured(joint: Joint) -> str:
    """Return the measured angle and speeds."""
    return f"∠ {angle_text(_angle(joint))}, speeds 1 : {number(joint.speed_ratio, 4)}"


def _curvature_jump(joint: Joint, reach: float) -> float:
    scale = max(abs(joint.curvature_before), abs(joint.curvature_after))
    if joint.is_geometric_open and joint.geometric <= 1:
        return math.nan
    is_none = joint.geometric >= 2 or abs(joint.curvature_jump) <= _RESIDUE * max(scale, 1.0 / reach)
    return 0.0 if is_none else joint.curvature_jump


def _kind(joint: Joint) -> JointKind:
    if joint.parametric < 0:
        return JointKind.BREAK
    if math.isnan(joint.angle):
        return JointKind.REST
    if joint.parametric >= 2:
        return JointKind.SMOOTH
    if joint.is_parametric_open or (joint.is_geometric_open and joint.geometric == 0):
        return JointKind.UNDECIDED
    if joint.parametric == 1:
        return JointKind.ACCELERATION
    return JointKind.SPEED if joint.geometric >= 1 else JointKind.CORNER


def _reaches(view: CurveView) -> list[float]:
    """Return for every point the distance to the nearer of its neighbours at another position."""
    points = view.points
    ring = np.vstack([points[-1:], points, points[:1]])
    steps = np.hypot(*np.diff(ring, axis=0).T)
    if not view.source.is_closed:
        steps[0] = steps[-1] = np.inf
    steps[steps == 0] = np.inf
    nearer = np.minimum(steps[:-1], steps[1:])
    size = size_of(points) or 1.0
    reaches: list[float] = np.where(np.isfinite(nearer), nearer, size).tolist()
    return reaches


def _summary(rows: Sequence[JointRow]) -> str:
    """Return the class of most joints, those that are less smooth or undecided, and those at rest."""
    (orders, usual), _ = Counter((row.continuity, row.smoothness) for row in rows).most_common(1)[0]
    # Less smooth, or of the same orders but decided otherwise.
    worse = [row for row in rows if row.continuity <= orders and row.smoothness != usual]
    rests = [str(row.joint) for row in rows if row.kind is JointKind.REST and row not in worse]
    text = f"{usual} everywhere" if len(rows) > 1 else f"{usual} at its only joint"
    if len(worse) > _MOST_NAMED:
        text += f" except at {len(worse)} of {len(rows)} joints"
    elif worse:
        text += f" except {'; '.join(f'joint {row.joint}: {_brief(row)}' for row in worse)}"
    if rests:
        joints = f"joint {rests[0]}" if len(rests) == 1 else f"joints {names_of(rests)}"
        text += f"; stands still at {joints}"
    return f"{text}."


def _brief(row: JointRow) -> str:
    """Return the class of a less smooth joint: G¹ of C⁰, G¹, for the C⁰ is obvious."""
    if row.kind is JointKind.REST:
        return f"stands still{' on one side' * (row.jumps[1] > 0.0)} ({row.smoothness})"
    return (
        f"{row.smoothness} (corner)" if row.kind is JointKind.CORNER else row.smoothness.removeprefix("C⁰, ")
    )


def as_text(certificate: Certificate) -> str:
    """Return the certificate as a table of text, with tabs, for other programs; numbers are exact.

    It has "?" where double precision does not decide, and a dash where the curve stands still.
    """
    jumps = [f"jump of {derivative}" for derivative in ("c", "c'", "c''", "c'''")]
    lines = [certificate.summary]
    if certificate.rows:
        lines.append(
            "\t".join(["joint", "t", "class", *jumps, "angle (degrees)", "jump of curvature", "speed ratio"])
        )
    for row in certificate.rows:
        lines.append("\t".join([str(row.joint), repr(row.t), row.smoothness, *row.written(repr)]))
    return "\n".join(lines) + "\n"
