"""A dot that runs along a curve: its parameter and speed at each time, and its picture.

At speed 1 the dot takes as many seconds as the domain of the curve is long: where t is in seconds, the
motion is the real one. The picture has dots with arrows and trails, and sentences about jumps at the joints.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Collection
from functools import partial

import msgspec
import numpy as np

from curvecore.analysis.continuity import joint_report
from curvecore.analysis.lengths import ArcLength
from curvecore.arrays import FloatArray, IntArray

from ..document.derivatives import VelocityRule
from ..families import Family
from .analysis.ghost import Ghost
from .arc_lengths import arc_lengths_of
from .curve.curve_view import CurveView, ParametricCurve, view_of
from .curve.distances import coincide
from .geometry import Samples, size_of, usual_length
from .line_styles import BLUE, PURPLE
from .motion_settings import Pace, Repeat, timed_families

ACCURACY = 1e-6
"""Error allowed in arc lengths, against the whole length: below a pixel."""

STATIONS = 60
"""Equal steps of time from one end of a curve to the other; trails are dots at some of them."""


def round_duration(duration: float, repeat: Repeat) -> float:
    """Return the seconds after which the motion repeats."""
    return 2.0 * duration if repeat is Repeat.PING_PONG else duration


def folded(seconds: FloatArray, duration: float, repeat: Repeat) -> FloatArray:
    """Return the time on the curve, in seconds from its start, of the dot at `seconds` >= 0 of the motion."""
    if repeat is Repeat.ONCE:
        return np.minimum(seconds, duration)
    if repeat is Repeat.LOOP:
        return np.asarray(np.fmod(seconds, duration))
    within = np.fmod(seconds, 2.0 * duration)
    return np.where(within <= duration, within, 2.0 * duration - within)


def runs_back(seconds: float, duration: float, repeat: Repeat) -> bool:
    """Whether the dot runs backwards."""
    return repeat is Repeat.PING_PONG and bool(np.fmod(seconds, 2.0 * duration) > duration)


class Course:
    """The run of a dot along one curve: parameters and derivatives at times.

    Parameters
    ----------
    curve
        Its domain gives the duration.
    pace
        By arc length the dot has a constant speed; a curve without length is run through by t.

    Attributes
    ----------
    duration
        Seconds from one end to the other.
    """

    def __init__(
        self, curve: ParametricCurve, pace: Pace = Pace.PARAMETER, accuracy: float = ACCURACY
    ) -> None:
        self.curve = curve
        self.pace = pace
        self._start, self._end = curve.domain
        self.duration = self._end - self._start
        self._lengths: ArcLength | None = None
        self._speed = 0.0
        self._stations = np.full((STATIONS + 1, 2), np.nan)
        self._is_known = np.zeros(STATIONS + 1, dtype=bool)
        if pace is Pace.LENGTH:
            self._measure(accuracy)

    def _measure(self, accuracy: float) -> None:
        lengths = arc_lengths_of(self.curve, accuracy)
        speed = lengths.total.value / self.duration
        if 0.0 < speed < np.inf:
            self._lengths, self._speed = lengths, speed

    def parameters_at(self, elapsed: FloatArray) -> FloatArray:
        """Return the parameters that the dot has reached after `elapsed` seconds, (m,)."""
        if self._lengths is not None:
            return self._lengths.parameter_at(elapsed * self._speed)
        return np.minimum(self._start + elapsed, self._end)

    def elapsed_at(self, t: float) -> float:
        """Return the seconds after which the dot is at parameter `t`."""
        t = min(max(t, self._start), self._end)
        if self._lengths is not None:
            return min(float(self._lengths.length_at(t)) / self._speed, self.duration)
        return t - self._start

    def stations(self, indices: IntArray) -> FloatArray:
        """Return the points (k, 2) at steps 0 … `STATIONS`; each is computed once."""
        new = np.unique(indices[~self._is_known[indices]])
        if len(new):
            with np.errstate(all="ignore"):
                t = self.parameters_at(new.astype(float) * (self.duration / STATIONS))
                self._stations[new] = self.curve.evaluate(t)
            self._is_known[new] = True
        return np.asarray(self._stations[indices])

    def moments_at(self, t: FloatArray, *, back: bool = False) -> Samples:
        """Return the dot at parameters (m,), with its derivatives per second; backwards with `back`."""
        with np.errstate(all="ignore"):
            points, velocities, accelerations = (self.curve.evaluate(t, order) for order in (0, 1, 2))
            if self._lengths is not None:
                velocities, accelerations = _at_even_speed(velocities, accelerations, self._speed)
        return Samples(t, points, -velocities if back else velocities, accelerations)


def _at_even_speed(
    velocities: FloatArray, accelerations: FloatArray, speed: float
) -> tuple[FloatArray, FloatArray]:
    """Return velocity and acceleration of a dot with constant speed: the latter is due to the bend alone."""
    # Not the squares of lengths: they would overflow at 1e154.
    length = np.hypot(velocities[:, 0], velocities[:, 1])[:, None]
    rests = length == 0.0
    unit = velocities / np.where(rests, 1.0, length)
    across = accelerations - (accelerations * unit).sum(axis=1, keepdims=True) * unit
    factor = speed / np.where(rests, 1.0, length)
    return unit * speed, np.where(rests, 0.0, across * factor * factor)


# The picture

TRAIL = 24
"""Dots of a trail."""

_SHARE = 0.25
"""The longest arrow against the size of the curve."""

_LONGEST = 3.0
"""Largest factor of an acceleration over nine tenths of all: at a cusp it would be infinite."""

_SAMPLES = 121


class Role(msgspec.Struct, frozen=True):
    """The curve that a dot runs along: the active one, or one that is compared with it.

    Attributes
    ----------
    families
        The families of the curve, several where their curves are the same; none for the active curve.
    radius
        Radius of the dot, in pixels: where dots meet, a ring of each is visible.
    """

    families: tuple[Family, ...] = ()
    radius: float = 6.0

    @property
    def title(self) -> str:
        """The name beside its arrows."""
        return ", ".join(family.short for family in self.families)

    @property
    def colour(self) -> str:
        """The colour of the ghost, which each theme has a shade of; empty for the accent."""
        return Ghost(family=self.families[0]).style.colour if self.families else ""


ACTIVE = Role()
"""The role of the dot of the active curve."""

_SMALLEST, _RING = 7.5, 2.5
"""Radius of the dot on top of others, and the step to each one below it."""


class ArrowKind(enum.Enum):
    """The derivative of an arrow: the letter beside its tip, and its colour."""

    def __init__(self, letter: str, colour: str) -> None:
        self.letter, self.colour = letter, colour

    VELOCITY = "v", BLUE
    ACCELERATION = "a", PURPLE


class Arrow(msgspec.Struct, frozen=True):
    """An arrow from a dot to a tip in the plane, and the text there."""

    kind: ArrowKind
    tip: tuple[float, float]
    text: str


class Dot(msgspec.Struct, frozen=True, eq=False):
    """A dot with its trail, its arrows and its speed.

    Attributes
    ----------
    trail
        Its last positions (k, 2) at equal steps of time, the latest first.
    speed, pull
        The lengths of velocity and acceleration, per second.
    """

    role: Role
    t: float
    position: tuple[float, float]
    trail: FloatArray
    arrows: tuple[Arrow, ...]
    speed: float
    acceleration: float


class Scales(msgspec.Struct, frozen=True):
    """Lengths in the plane of a velocity of 1 and an acceleration of 1."""

    velocity: float
    acceleration: float


def scales_of(courses: list[Course]) -> Scales:
    """Return scales that suit all dots, so that their arrows can be compared."""
    size = max(size_of(course.curve.points) for course in courses)
    sampled = [
        course.moments_at(course.parameters_at(np.linspace(0.0, course.duration, _SAMPLES)))
        for course in courses
    ]
    speed = usual_length(np.vstack([moments.velocities for moments in sampled]), _LONGEST)
    acceleration = usual_length(np.vstack([moments.accelerations for moments in sampled]), _LONGEST)
    return Scales(*(_SHARE * size / longest if longest > 0.0 else 0.0 for longest in (speed, acceleration)))


def dot_at(
    course: Course,
    seconds: float,
    repeat: Repeat,
    scales: Scales,
    role: Role = ACTIVE,
    kinds: tuple[ArrowKind, ...] = tuple(ArrowKind),
) -> Dot:
    """Return the dot after `seconds` of its motion; without arrows it has no trail."""
    t = course.parameters_at(folded(np.array([seconds]), course.duration, repeat))
    now = course.moments_at(t, back=runs_back(seconds, course.duration, repeat))
    position = (float(now.points[0, 0]), float(now.points[0, 1]))
    trail = _trail(course, seconds, repeat) if kinds else np.empty((0, 2))
    speed, acceleration = math.hypot(*now.velocities[0]), math.hypot(*now.accelerations[0])
    arrow = partial(_arrow, now, position, scales)
    return Dot(role, float(t[0]), position, trail, tuple(arrow(kind) for kind in kinds), speed, acceleration)


def dots_at(courses: dict[Role, Course], seconds: float, repeat: Repeat, scales: Scales) -> list[Dot]:
    """Return all dots after `seconds`; where two are compared, their accelerations are the arrows."""
    compared = len(courses) > 1
    kinds = (ArrowKind.ACCELERATION,) if compared else tuple(ArrowKind)
    return [
        dot_at(course, seconds, repeat, scales, role, () if compared and role is ACTIVE else kinds)
        for role, course in courses.items()
    ]


def colour_of(dot: Dot, arrow: Arrow) -> str:
    """Return the colour of an arrow: of its derivative, or in a comparison of its dot."""
    return dot.role.colour or arrow.kind.colour


def _trail(course: Course, seconds: float, repeat: Repeat) -> FloatArray:
    """Return the last positions at multiples of one step, so that the dots of a trail do not move."""
    whole = round_duration(STATIONS, repeat)
    # Counted within two rounds, so that a motion of days loses no digits.
    steps = seconds * STATIONS / course.duration
    if repeat is Repeat.ONCE or steps < whole:
        last = int(np.ceil(min(steps, whole))) - 1
    else:
        last = int(np.ceil(np.fmod(steps, whole)) + whole) - 1
    indices = last - np.arange(TRAIL)
    folds = folded(indices[indices >= 0].astype(float), STATIONS, repeat)
    return course.stations(folds.astype(np.intp))


def _arrow(now: Samples, position: tuple[float, float], scales: Scales, kind: ArrowKind) -> Arrow:
    is_velocity = kind is ArrowKind.VELOCITY
    x, y = (now.velocities if is_velocity else now.accelerations)[0].tolist()
    scale = scales.velocity if is_velocity else scales.acceleration
    tip = (position[0] + scale * x, position[1] + scale * y)
    return Arrow(kind, tip, f"|{kind.letter}| {three_digits(math.hypot(x, y))}")


def arrow_segments(start: tuple[float, float], tip: tuple[float, float], head: float) -> FloatArray:
    """Return shaft and barbs as segments (3, 4) = x1, y1, x2, y2.

    A short arrow has a small head, so that its shaft is visible.
    """
    along = np.subtract(tip, start)
    length = float(np.hypot(*along))
    barb = along * (min(head, length / 2) / length if length else 0.0)
    side = np.array([-barb[1], barb[0]]) * 0.45
    ends = [start, tip - barb + side, tip - barb - side]
    return np.array([[*tip, *end] for end in ends])


def three_digits(value: float) -> str:
    """Return a number in three digits, for the text beside an arrow."""
    return f"{value:#.3g}".rstrip(".").replace("e+", "e")


# Curves compared


def rivals_of(view: CurveView, compared: Collection[Family]) -> dict[Role, CurveView]:
    """Return the curves of some families through the points of `view`, and that of its own family.

    The largest dot comes first. Curves that are the same have one role; without families there are none.
    """
    same: list[tuple[CurveView, list[Family]]] = []
    for family in timed_families() if compared else ():
        is_active = family == view.source.family
        if not is_active and family not in compared:
            continue
        rival = view if is_active else view_of(view.source.with_family(family))
        known = next((families for other, families in same if coincide(other, rival)), None)
        if known is not None:
            known.append(family)
        elif rival.is_current:
            same.append((rival, [family]))
    largest = _SMALLEST + _RING * (len(same) - 1)
    return {
        Role(tuple(families), largest - _RING * index): rival for index, (rival, families) in enumerate(same)
    }


def jump_sentences(views: dict[Role, CurveView]) -> str:
    """Return sentences about measured jumps of the acceleration of compared curves at the joints."""
    titles: dict[str, list[str]] = {}
    for role, view in views.items():
        titles.setdefault(_jump_sentence(view), []).append(role.title)
    return "  ".join(f"{', '.join(names)}: {words}" for words, names in titles.items())


def _is_estimated(view: CurveView) -> bool:
    rule = view.source.velocity_rule
    return rule is VelocityRule.NATURAL_SPLINE and not any(point.velocity for point in view.source.points)


def _jump_sentence(view: CurveView) -> str:
    is_one = view.source.family.curve_class.is_one_polynomial
    joints = [] if is_one else joint_report(view.present_curve, closed=view.source.is_closed)
    if not joints:
        return "no joints."
    rough = [joint for joint in joints if joint.parametric < 2]
    jumping = [joint for joint in rough if not joint.is_parametric_open]
    if rough and not jumping:
        where = f"{len(rough)} of {len(joints)} joints"
        return f"double precision does not decide whether the acceleration jumps at {where}."
    if not jumping:
        is_spline = view.source.family.derivatives == 1 and _is_estimated(view)
        why = " (its velocities are those of the natural spline; others make it jump)" if is_spline else ""
        return f"no jump of acceleration{why}."
    sizes = [float(np.hypot(*joint.acceleration_jump)) for joint in jumping]
    worst = int(np.argmax(sizes))
    where = f"at {len(jumping)} of {len(joints)} joints, most" if len(joints) > 1 else "at its joint,"
    point = view.owner(jumping[worst].joint)
    return f"acceleration jumps {where} at point {point} by {three_digits(sizes[worst])}."
