"""Explanation of a swing of the curve: the points that pull at one t, and their weights; and cures.

`explain` says who pulls. `cures_of` tries other parameters and other families beside the document.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray
from curvecore.bezier.flatten import segment_distance

from ...document import point_edits, rule_edits
from ...document.derivatives import DERIVATIVES, VelocityRule
from ...document.model import Curve, Document, ParametrizationKind
from ...document.words import short
from ...families import FAMILIES, HERMITE, QUINTIC_HERMITE, Family
from ...tasks.progress import Report, silent, with_progress
from ..basis import growth_at, growth_of_points, set_weights_at, weights_at
from ..curve.core_curve import unbounded
from ..curve.curve_view import CurveView, view_of
from ..curve.distances import dense, keeps_shape, largest_distance
from ..geometry import segment_at, within_segments

MOST_PULLS = 6
_COARSE, _FINE = 17, 65
_MOST_COARSE = 2000
"""Samples of a whole curve: with many points each segment has few."""

_FAR_WEIGHT = 0.05
"""A weight below which a point is not mentioned."""

_CALM = 0.25
"""An overshoot below this share of the distance of the two points is normal for a round curve."""


@dataclass(frozen=True)
class Pull:
    """The effect of one point, or of a derivative that was set, at t.

    Attributes
    ----------
    point
        The index of the point.
    order
        0: its position; from 1 on: its derivative of that order.
    weight
        For a position its weight, with the derivatives that are estimated from it. For a derivative that
        was set the displacement of the curve, as a multiple of the distance of the two points of the segment.
    """

    point: int
    order: int
    weight: float


@dataclass(frozen=True)
class Explanation:
    """The explanation of the curve at one t.

    Attributes
    ----------
    t
        The parameter.
    segment
        The knot at the beginning of the segment, and the points at both its ends.
    pulls
        The strongest data, the strongest first.
    lebesgue
        Λ(t).
    adds_up
        Whether Λ(t) is the sum of the sizes of all weights, so that their effects are no means.
    overshoot
        The farthest distance of the curve from the straight line between the two points.
    is_calm
        Whether that is normal for a round curve, so that there is nothing to cure.
    sentences
        The explanation in words.
    """

    t: float
    segment: tuple[int, int, int]
    pulls: tuple[Pull, ...]
    lebesgue: float
    adds_up: bool
    overshoot: float
    is_calm: bool
    sentences: tuple[str, ...]


def widest(view: CurveView) -> float:
    """Return the t at which the curve is farthest from the straight line between its neighbouring points."""
    knots = view.parameters
    count = max(1, min(_COARSE, _MOST_COARSE // len(knots)))
    shares = np.linspace(0.0, 1.0, count + 2)[1:-1]
    t = within_segments(knots, shares)
    at = view.present_curve.evaluate(knots)
    away = _distances(
        view.present_curve.evaluate(t.ravel()).reshape(*t.shape, 2), at[:-1, None], at[1:, None]
    )
    return float(t.ravel()[int(np.argmax(away))])


def overshoot(view: CurveView, knot: int) -> tuple[float, float]:
    """Return the largest distance of a segment from the straight line between its ends, and its t."""
    low, high = view.parameters[knot : knot + 2].tolist()
    t = np.linspace(low, high, _FINE)
    ends = view.present_curve.evaluate(np.array([low, high]))
    away = _distances(view.present_curve.evaluate(t), ends[0], ends[1])
    farthest = int(np.argmax(away))
    return float(away[farthest]), float(t[farthest])


def _distances(positions: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the distances of positions (…, 2) from segments with given ends."""
    # Distances far out on a wild curve need no accuracy.
    return segment_distance(np.clip(np.nan_to_num(positions, nan=1e150), -1e150, 1e150), start, end)


def explain(view: CurveView, t: float) -> Explanation | None:
    """Return the explanation at `t`; None where there is no curve."""
    if not view.is_current:
        return None
    knots = view.parameters
    t = min(max(t, float(knots[0])), float(knots[-1]))
    knot = segment_at(knots, t)
    segment = (knot, view.owner(knot), view.owner(knot + 1))
    chord = float(np.hypot(*(view.points[segment[2]] - view.points[segment[1]])))
    pulls = _pulls(view, t, chord)
    swing, _ = overshoot(view, knot)
    lebesgue = unbounded(float(growth_at(view, np.array([t]))[0]))
    at_point = next((view.owner(end) for end in (knot, knot + 1) if knots[end] == t), None)
    pulling = (
        f"Here the curve passes through point {at_point}, wherever the others are."
        if at_point is not None
        else _pull_words(view, pulls, segment)
    )
    words: tuple[str, ...] = (_swing_words(segment, swing, chord), pulling, _error_words(lebesgue))
    if not view.source.family.interpolates:
        words = (*_control_words(view, t, pulls), _error_words(lebesgue))
    if view.growth_holds:
        words = (*words, f"Λ(t) is that of small errors in x or y {view.growth_holds}, whichever grows more.")
    if view.linearised:
        words = (*words, f"The weights are those {view.linearised}.")
    is_calm, adds_up = swing <= _CALM * chord, not view.growth_holds
    return Explanation(t, segment, pulls[:MOST_PULLS], lebesgue, adds_up, swing, is_calm, words)


def _pulls(view: CurveView, t: float, chord: float) -> tuple[Pull, ...]:
    """Return all pulls, the strongest first: points with their estimates, and derivatives that were set."""
    pulls = [Pull(point, 0, float(weight)) for point, weight in enumerate(weights_at(view, t)) if weight != 0]
    for (point, order, ahead), weight in (set_weights_at(view, t) if view.sides is not None else {}).items():
        x, y = view.source.points[point].explicit_sides(order)[ahead] or (0.0, 0.0)
        pulls.append(Pull(point, order, abs(weight) * float(np.hypot(x, y)) / chord if chord > 0 else 0.0))
    return tuple(sorted(pulls, key=lambda pull: -abs(pull.weight)))


def _swing_words(segment: tuple[int, int, int], swing: float, chord: float) -> str:
    between = f"Between points {segment[1]} and {segment[2]}"
    if swing <= _CALM * chord:
        return f"{between} the curve stays within about {short(swing)} of the straight line."
    times = f", {short(swing / chord)} times their distance" if chord > 0 else ""
    return f"{between} the curve overshoots by {short(swing)}{times}."


def _pull_words(view: CurveView, pulls: tuple[Pull, ...], segment: tuple[int, int, int]) -> str:
    """Return a sentence about the strongest of the far points, or that none pulls."""
    far = [pull for pull in pulls if pull.order == 0 and pull.point not in segment[1:]]
    given = _given_words(pulls)
    if not far or abs(far[0].weight) < _FAR_WEIGHT:
        near = f"points {segment[1]} and {segment[2]}"
        if not view.source.family.derivatives:
            return f"Only {near} affect the curve here."
        return f"Only {near} and their derivatives affect the curve here{given}."
    pull = far[0]
    steps = segment[1] - pull.point if pull.point < segment[1] else pull.point - segment[2]
    verb = "pushes" if pull.weight < 0 else "pulls"
    away = "it is only the next point" if steps == 1 else f"it is {steps} points away"
    follows = ", because the estimates follow it" if view.source.family.derivatives else ""
    return f"Point {pull.point} {verb} with weight {short(pull.weight)} although {away}{follows}{given}."


def _control_words(view: CurveView, t: float, pulls: tuple[Pull, ...]) -> tuple[str, str]:
    """Return sentences about the control points that pull, and that the curve stays in their hull."""
    count = sum(abs(pull.weight) >= _FAR_WEIGHT for pull in pulls)
    first = pulls[0]
    away = float(np.hypot(*(view.present_curve.evaluate(t) - view.points[first.point])))
    strongest = (
        f"Point {first.point} pulls hardest, with weight {short(first.weight)}; the curve passes it at a "
        f"distance of {short(away)}."
    )
    if min(pull.weight for pull in pulls) < 0:
        return strongest, "Points with negative weights push: the curve may leave the polygon of its points."
    few = "one point" if count == 1 else f"{count} points"
    return (
        strongest,
        f"The curve is a mean of the points, mostly of {few}, and stays in the hull of those that pull.",
    )


def _given_words(pulls: tuple[Pull, ...]) -> str:
    """Return a clause about the derivative that was set and displaces the curve most, if any does."""
    strongest = next((pull for pull in pulls if pull.order > 0), None)
    if strongest is None or strongest.weight < _FAR_WEIGHT:
        return ""
    name = DERIVATIVES[strongest.order - 1].name
    carries = f"moves the curve by {short(strongest.weight)} times their distance"
    return f"; the {name} set at point {strongest.point} {carries}"


def _error_words(lebesgue: float) -> str:
    if lebesgue < 1.05:
        return "Errors in the points do not grow here."
    return f"An error in the points can grow by a factor of {short(lebesgue)} here."


# Cures

_IN_USE = "The curve already has these settings."
_SAME = "It gives the same curve."

_WORSE = 1.05
"""Growth of a swing from which on it is worse: less does not show in the two displayed digits."""

_MOST_LAGRANGE = 250
"""Points up to which Lagrange curves are tried: with more it takes seconds, for a useless curve."""


class Remedy(NamedTuple):
    """Other parameters, or another family, with a velocity rule where it has velocities.

    Attributes
    ----------
    name
        A key, from which object names are made.
    label, step
        Its text in the window, and the name of the undo step.
    rule, family
        The rule for the parameters, or the family.
    velocity_rule, estimates
        The rule for the velocities of the family, and whether it replaces derivatives set by hand.
    """

    name: str
    label: str
    step: str
    rule: ParametrizationKind | None = None
    family: Family = HERMITE
    velocity_rule: VelocityRule = VelocityRule.NATURAL_SPLINE
    estimates: bool = False

    def applied(self, document: Document, curve: int, parameters: list[float]) -> Document:
        """Return the document with this remedy applied to one of its curves."""
        if self.rule is not None:
            return rule_edits.set_parametrization(document, curve, self.rule, parameters)
        result = rule_edits.set_family(document, curve, self.family)
        if not self.family.derivatives:
            return result
        result = rule_edits.set_rule(result, curve, self.velocity_rule)
        if self.estimates:
            result = point_edits.clear_derivatives(result, curve, range(len(document.curves[curve].points)))
        return result


def _parameters(name: str, kind: ParametrizationKind) -> Remedy:
    return Remedy(name, kind.label, f"Use {kind.phrase} parameters", kind)


CURES = (
    _parameters("chordLength", ParametrizationKind.CHORD_LENGTH),
    _parameters("centripetal", ParametrizationKind.CENTRIPETAL),
    _parameters("chebyshev", ParametrizationKind.CHEBYSHEV),
    Remedy(
        "hermite",
        "Hermite, local tangents",
        "Convert to Hermite",
        velocity_rule=VelocityRule.BESSEL,
    ),
    Remedy("quintic", "Quintic Hermite", "Convert to quintic Hermite", family=QUINTIC_HERMITE),
    Remedy("spline", "C² cubic spline", "Convert to the C² spline", estimates=True),
    *(
        Remedy(family.name, family.label, f"Convert to {family.title}", family=family)
        for family in FAMILIES
        if family.curve_class.is_calm
    ),
)
"""All remedies, in the order of the window."""


@dataclass(frozen=True, eq=False)
class Cure:
    """A remedy tried out on a curve.

    Attributes
    ----------
    document
        The document with it; None where it changes nothing or is impossible.
    points
        The curve as a polyline (k, 2), empty without one.
    overshoot
        The overshoot of the same segment with it; NaN without a curve.
    lebesgue
        The Lebesgue constant of the points with it; NaN where it is not computed.
    problem
        A sentence why it is impossible; empty if it is possible.
    """

    remedy: Remedy
    document: Document | None = None
    points: FloatArray = field(default_factory=lambda: np.empty((0, 2)))
    overshoot: float = np.nan
    lebesgue: float = np.nan
    problem: str = ""

    @property
    def is_in_use(self) -> bool:
        """Whether the curve already has these settings."""
        return self.problem == _IN_USE

    @property
    def is_same(self) -> bool:
        """Whether the curve would not change."""
        return self.problem == _SAME

    def is_worse(self, before: float) -> bool:
        """Whether the curve would swing out visibly farther than before."""
        return self.overshoot > _WORSE * before


@dataclass(frozen=True, eq=False)
class Cures:
    """All cures for one segment of a curve, and its overshoot and Lebesgue constant without any.

    Attributes
    ----------
    knot
        The beginning of the segment.
    """

    knot: int
    overshoot: float
    lebesgue: float
    cures: tuple[Cure, ...]


def cures_of(document: Document, curve: int, view: CurveView, knot: int, report: Report = silent) -> Cures:
    """Return all cures for a segment, tried out."""
    cures = []
    for remedy in with_progress(CURES, report, "Trying"):
        document_then = remedy.applied(document, curve, view.parameters.tolist())
        cures.append(_tried(remedy, document_then, curve, view, knot))
    return Cures(knot, overshoot(view, knot)[0], _lebesgue(view), tuple(cures))


def _tried(remedy: Remedy, document: Document, curve: int, view: CurveView, knot: int) -> Cure:
    source = document.curves[curve]
    if _shape(source) == _shape(view.source):
        return Cure(remedy, overshoot=overshoot(view, knot)[0], lebesgue=_lebesgue(view), problem=_IN_USE)
    family = source.family
    if not family.curve_class.is_local and len(view.parameters) > _MOST_LAGRANGE:
        what = "for one polynomial" if family.curve_class.is_one_polynomial else "to try it"
        return Cure(remedy, problem=f"Too many points {what}.")
    other = view_of(source)
    if not other.is_current or knot > len(other.parameters) - 2:
        return Cure(remedy, problem=other.problem or "There is no such segment.")
    swing, growth = overshoot(other, knot)[0], _lebesgue(other)
    if np.array_equal(other.parameters, view.parameters):
        t = dense(view.parameters)
        if keeps_shape(largest_distance(view, t, other, t), (view.source,)):
            return Cure(remedy, overshoot=swing, lebesgue=growth, problem=_SAME)
    return Cure(remedy, document, other.polyline, swing, growth)


def _shape(source: Curve) -> Curve:
    """Return a curve without rules that have no effect: the velocity rule where there are no velocities."""
    if not source.family.derivatives:
        return replace(source, velocity_rule=VelocityRule.NATURAL_SPLINE)
    return source


def _lebesgue(view: CurveView) -> float:
    if view.basis_curve is None or (
        not view.source.family.curve_class.is_local and len(view.parameters) > _MOST_LAGRANGE
    ):
        return float("nan")
    return growth_of_points(view)
