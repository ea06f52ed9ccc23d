"""The joint certificate: what jumps at each joint, in numbers and in words."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from curvecore import Joint, joint_report

from ...document.words import NOTHING, number
from ..curve.curve_view import CurveView
from ..geometry import size_of

_MOST_NAMED = 3
"""Joints named one by one in the summary; of more, their number is told."""

_RESIDUE = 1e-9
"""A jump of the curvature below this share of the curvature itself is a rounding residue."""


class JointKind(Enum):
    """The kinds of joints, from smooth to broken; the value is the sign, beside its colour."""

    SMOOTH = "✓"
    UNDECIDED = "?"
    ACCELERATION = "△"
    SPEED = "◇"
    REST = "○"
    CORNER = "▲"
    BREAK = "✕"


_RESTS = "The curve stands still here, so that it has no direction: a corner or a cusp may show."

_WORDS = {
    (
        3,
        2,
    ): "Smooth: velocity, acceleration and jerk go on without a jump; so do direction and curvature.",
    (
        2,
        2,
    ): "Smooth: velocity and acceleration go on, and so do direction and curvature; the jerk alone jumps.",
    (1, 2): "The acceleration jumps, the velocity does not. The curvature goes on: the eye sees no joint.",
    (1, 1): "The velocity goes on, the acceleration jumps, and the curvature with it: a mover feels a jerk.",
    (0, 2): "The speed jumps, but direction and curvature go on: the drawn line shows no joint.",
    (0, 1): "Speed and curvature jump; the direction goes on: no corner, but a mover feels a blow.",
    (0, 0): "A corner: the direction jumps.",
    (-1, -1): "The curve is broken.",
}
"""The words for orders of parametric and geometric continuity, the latter up to curvature."""

_GOES_ON = ("The curve goes on", "The velocity goes on", "Velocity and acceleration go on")
_OF_MOTION = ("point", "velocity", "acceleration", "jerk")
_OF_LINE = ("point", "direction", "curvature", "change of the curvature")
"""The quantities that go on, or jump, by their orders: of the motion, and of the line that is drawn."""

_RAISED = str.maketrans("0123", "⁰¹²³")


@dataclass(frozen=True)
class JointRow:
    """One joint.

    Attributes
    ----------
    joint
        The index of its parameter: that of the point it lies at, if the curve runs through its points.
    place
        Where it lies.
    reach
        The distance to the nearer of its neighbours: how closely to look.
    jumps
        Sizes of the jumps of c, c', c'' and c'''; exactly 0 where there is none beyond rounding, NaN where
        double precision does not decide whether there is one.
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
        The kind that this makes it, and the same in a sentence.
    speed_ratio
        The speed after the joint over that before it; NaN where the curve stands still.
    measured
        The angle as it was measured, and the speeds before and after, in a few words; empty where it rests.
    """

    joint: int
    t: float
    place: tuple[float, float]
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
        """Return jumps, angle, jump of the curvature and speed ratio as texts: "?" for what is not decided.

        There is nothing to decide about a direction where the curve stands still.
        """
        undecided = JointKind.UNDECIDED.value
        of_line = NOTHING if self.kind is JointKind.REST else undecided
        texts = [undecided if math.isnan(jump) else write(jump) for jump in self.jumps]
        others = (self.angle, self.curvature, self.speed_ratio)
        return [*texts, *(of_line if math.isnan(each) else write(each) for each in others)]


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
        return Certificate((), "One polynomial: no joints. Every derivative goes on, everywhere.")
    breaks = view.curve.breaks
    if len(breaks) == 2 < len(view.parameters) and not view.source.is_closed:
        # What the family says of itself; differences could only tell that they are small.
        return Certificate((), f"No joints: {view.source.family.a_curve} has no breaks inside.")
    report = joint_report(view.curve, closed=view.source.is_closed)
    joints = [joint for joint in report if joint.joint == 0 or view.parameters[joint.joint] in breaks]
    if not joints:
        return Certificate((), "One piece between two points: no joints.")
    reaches = _reaches(view)
    rows = tuple(_row(view, joint, reaches) for joint in joints)
    return Certificate(rows, _summary(rows))


def _row(view: CurveView, joint: Joint, reaches: list[float]) -> JointRow:
    point = view.owner(joint.joint)
    assert view.curve is not None
    is_there = view.source.family.interpolates
    x, y = (view.points[point] if is_there else view.curve.evaluate(joint.parameter)).tolist()
    sizes = (math.hypot(*jump.tolist()) for jump in joint.jumps)
    continuity = (joint.parametric, max(joint.parametric, joint.geometric))
    kind = _kind(joint)
    return JointRow(
        joint=point,
        t=joint.parameter,
        place=(x, y),
        reach=reaches[point],
        jumps=tuple(_shown_jump(joint, order, size) for order, size in enumerate(sizes)),
        angle=_angle(joint),
        curvature=_curvature_jump(joint),
        continuity=continuity,
        smoothness=joint.label.translate(_RAISED),
        kind=kind,
        words=_words(joint, kind),
        speed_ratio=joint.speed_ratio,
        measured="" if math.isnan(_angle(joint)) else _measured(joint),
    )


def _shown_jump(joint: Joint, order: int, size: float) -> float:
    if order <= joint.parametric:
        return 0.0
    is_next = order == joint.parametric + 1
    is_hidden = joint.is_parametric_open and (is_next or size <= joint.roundings[order])
    return math.nan if is_hidden else size


def _angle(joint: Joint) -> float:
    if joint.geometric >= 1:
        return 0.0
    return math.nan if joint.is_geometric_open else math.degrees(joint.angle)


def _words(joint: Joint, kind: JointKind) -> str:
    """Return what a joint is, as a sentence or two."""
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
        sure = _GOES_ON[min(joint.parametric, 2)] + (f", the {jumps} jumps." if jumps else ".")
    else:
        sure = _WORDS[joint.parametric, min(max(joint.parametric, joint.geometric), 2)]
    rest = f" Whether the {undecided} goes on, double precision does not decide{bound}."
    return sure + (rest if undecided else "")


def _measured(joint: Joint) -> str:
    """Return what was measured of the tangents, without a word on what is taken for none."""
    angle = f"{number(math.degrees(joint.angle), 3)}°"
    return f"∠ {angle}, speeds 1 : {number(joint.speed_ratio, 4)}"


def _curvature_jump(joint: Joint) -> float:
    scale = max(abs(joint.curvature_before), abs(joint.curvature_after))
    if joint.is_geometric_open and joint.geometric <= 1:
        return math.nan
    is_none = joint.geometric >= 2 or abs(joint.curvature_jump) <= _RESIDUE * scale
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
    """Return for every point the distance to the nearer of its neighbours that is elsewhere."""
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
    """Say the class of most joints, and which ones are less smooth, or not decided, or have no direction."""
    (orders, usual), _ = Counter((row.continuity, row.smoothness) for row in rows).most_common(1)[0]
    # Of the same orders, but more or less decided, or less smooth.
    worse = [
        row
        for row in rows
        if row.kind is JointKind.REST or (row.continuity <= orders and row.smoothness != usual)
    ]
    if not worse:
        return f"{usual} everywhere." if len(rows) > 1 else f"{usual} at its one joint."
    if len(worse) > _MOST_NAMED:
        return f"{usual} everywhere except at {len(worse)} of {len(rows)} joints."
    named = "; ".join(f"joint {row.joint}: {_brief(row)}" for row in worse)
    return f"{usual} everywhere except {named}."


def _brief(row: JointRow) -> str:
    """Name what is less smooth: of C⁰, G¹ the G¹, for the C⁰ goes without saying."""
    if row.kind is JointKind.REST:
        return "stands still"
    return (
        f"{row.smoothness} (corner)" if row.kind is JointKind.CORNER else row.smoothness.removeprefix("C⁰, ")
    )


def as_text(certificate: Certificate) -> str:
    """Return the certificate as a table of text, with tabs, for other programs; numbers are exact.

    There is a "?" where double precision does not decide, and a dash where the curve stands still.
    """
    jumps = [f"jump of {what}" for what in ("c", "c'", "c''", "c'''")]
    lines = [certificate.summary]
    if certificate.rows:
        lines.append(
            "\t".join(["joint", "t", "class", *jumps, "angle (degrees)", "jump of curvature", "speed ratio"])
        )
    for row in certificate.rows:
        lines.append("\t".join([str(row.joint), repr(row.t), row.smoothness, *row.written(repr)]))
    return "\n".join(lines) + "\n"
