"""Explanation of a swing of the curve: the points that pull at one t, and how hard."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.bezier.flatten import segment_distance

from ...document.derivatives import DERIVATIVES
from ..basis import growth_at, weights_at
from ..curve.core_curve import is_explicit, unbounded
from ..curve.curve_view import CurveView
from ..geometry import segment_at, within_segments
from .wording import short

MOST_PULLS = 6
_COARSE, _FINE = 17, 65
_MOST_COARSE = 2000
"""Samples of a whole curve: of many points a few for each segment must do."""

_FAR_WEIGHT = 0.05
"""A weight below it is not worth a word."""

_CALM = 0.25
"""An overshoot below this share of the distance of the two points is what a round curve does anyway."""


@dataclass(frozen=True)
class Pull:
    """The effect of one point, or of a derivative that was set, at t.

    Attributes
    ----------
    point
        The point it belongs to.
    order
        0: its position; from 1 on: its derivative of that order.
    weight
        For a position its weight, with the derivatives that are estimated from it. For a derivative that
        was set how far it displaces the curve, as a multiple of the
        distance of the two points of the segment.
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
        Whether it is the sum of the sizes of all weights of points: their effects are not means.
    overshoot
        The farthest distance of the curve from the straight line between the two points.
    is_calm
        Whether that is what a round curve does anyway, so that there is nothing to cure.
    sentences
        The same in words.
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
    assert view.curve is not None
    knots = view.parameters
    count = max(1, min(_COARSE, _MOST_COARSE // len(knots)))
    shares = np.linspace(0.0, 1.0, count + 2)[1:-1]
    t = within_segments(knots, shares)
    at = view.curve.evaluate(knots)
    away = _distances(view.curve.evaluate(t.ravel()).reshape(*t.shape, 2), at[:-1, None], at[1:, None])
    return float(t.ravel()[int(np.argmax(away))])


def overshoot(view: CurveView, knot: int) -> tuple[float, float]:
    """Return how far a segment swings out of the straight line between its ends, and the t where."""
    assert view.curve is not None
    low, high = view.parameters[knot : knot + 2].tolist()
    t = np.linspace(low, high, _FINE)
    ends = view.curve.evaluate(np.array([low, high]))
    away = _distances(view.curve.evaluate(t), ends[0], ends[1])
    farthest = int(np.argmax(away))
    return float(away[farthest]), float(t[farthest])


def _distances(places: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the distances of places (…, 2) from segments whose ends are given."""
    # Far out on a wild curve nobody compares distances.
    return segment_distance(np.clip(np.nan_to_num(places, nan=1e150), -1e150, 1e150), start, end)


def explain(view: CurveView, t: float) -> Explanation | None:
    """Return who pulls at `t`; None where there is no curve."""
    if not view.is_current:
        return None
    knots = view.parameters
    t = min(max(t, float(knots[0])), float(knots[-1]))
    knot = segment_at(knots, t)
    segment = (knot, view.owner(knot), view.owner(knot + 1))
    chord = float(np.hypot(*(view.points[segment[2]] - view.points[segment[1]])))
    pulls = _pulls(view, t, knot, chord)
    swing, _ = overshoot(view, knot)
    lebesgue = unbounded(float(growth_at(view, np.array([t]))[0]))
    at_point = next((view.owner(each) for each in (knot, knot + 1) if knots[each] == t), None)
    pulling = (
        f"Right here it goes through point {at_point}, whatever the others do."
        if at_point is not None
        else _pull_words(view, pulls, segment)
    )
    words: tuple[str, ...] = (_swing_words(segment, swing, chord), pulling, _error_words(lebesgue))
    if not view.source.family.interpolates:
        words = (*_control_words(view, t, pulls), _error_words(lebesgue))
    if view.growth_holds:
        words = (*words, f"Λ(t) is that of small errors in x or y {view.growth_holds}, whichever grow more.")
    if view.linearised:
        words = (*words, f"The weights are those {view.linearised}.")
    is_calm, adds_up = swing <= _CALM * chord, not view.growth_holds
    return Explanation(t, segment, pulls[:MOST_PULLS], lebesgue, adds_up, swing, is_calm, words)


def _pulls(view: CurveView, t: float, knot: int, chord: float) -> tuple[Pull, ...]:
    """Return all that counts, the strongest first: points with their estimates, and what was set."""
    assert view.basis_curve is not None
    found = [Pull(point, 0, float(weight)) for point, weight in enumerate(weights_at(view, t)) if weight != 0]
    if view.sides is not None:
        basis = view.basis_curve.basis(np.array([t]))[0]
        for order in range(1, basis.shape[1]):
            # Derivatives ahead of the first point, and before the second.
            for at, ahead in ((knot, True), (knot + 1, False)):
                if not is_explicit(view.source.points[view.owner(at)], order, ahead=ahead):
                    continue
                x, y = (basis[at, order] * view.sides[ahead][at, order]).tolist()
                size = float(np.hypot(x, y)) / chord if chord > 0 else 0.0
                found.append(Pull(view.owner(at), order, size))
    return tuple(sorted(found, key=lambda pull: -abs(pull.weight)))


def _swing_words(segment: tuple[int, int, int], swing: float, chord: float) -> str:
    between = f"Between points {segment[1]} and {segment[2]}"
    if swing <= _CALM * chord:
        return f"{between} the curve is calm: it leaves their straight line by about {short(swing)} at most."
    times = f", {short(swing / chord)} times their distance" if chord > 0 else ""
    return f"{between} the curve swings out by {short(swing)}{times}."


def _pull_words(view: CurveView, pulls: tuple[Pull, ...], segment: tuple[int, int, int]) -> str:
    """Say who of those far away pulls hardest, or that nobody does."""
    far = [pull for pull in pulls if pull.order == 0 and pull.point not in segment[1:]]
    given = _given_words(pulls)
    if not far or abs(far[0].weight) < _FAR_WEIGHT:
        near = f"points {segment[1]} and {segment[2]}"
        if not view.source.family.derivatives:
            return f"Only {near} have a say here."
        return f"Only {near} and their derivatives count here{given}."
    pull = far[0]
    steps = segment[1] - pull.point if pull.point < segment[1] else pull.point - segment[2]
    verb = "pushes" if pull.weight < 0 else "pulls"
    away = "it is only the next point" if steps == 1 else f"it lies {steps} points away"
    follows = ", for the estimates follow it" if view.source.family.derivatives else ""
    return f"Point {pull.point} {verb} with weight {short(pull.weight)} though {away}{follows}{given}."


def _control_words(view: CurveView, t: float, pulls: tuple[Pull, ...]) -> tuple[str, str]:
    """Say which points beside the curve pull it, and that it stays among them where none pushes."""
    assert view.curve is not None
    count = sum(abs(pull.weight) >= _FAR_WEIGHT for pull in pulls)
    first = pulls[0]
    away = float(np.hypot(*(view.curve.evaluate(t) - view.points[first.point])))
    strongest = (
        f"Point {first.point} pulls hardest, with weight {short(first.weight)}; the curve passes it "
        f"{short(away)} away."
    )
    if min(pull.weight for pull in pulls) < 0:
        return strongest, "Points with negative weights push: the curve may leave the polygon of its points."
    few = "one point" if count == 1 else f"{count} points"
    return (
        strongest,
        f"It is a mean of the points, mostly of {few}, and cannot leave the hull of those that pull.",
    )


def _given_words(pulls: tuple[Pull, ...]) -> str:
    """Say which velocity or acceleration that was set carries the curve farthest, if it does."""
    strongest = next((pull for pull in pulls if pull.order > 0), None)
    if strongest is None or strongest.weight < _FAR_WEIGHT:
        return ""
    name = DERIVATIVES[strongest.order - 1].name
    carries = f"carries the curve {short(strongest.weight)} times their distance"
    return f"; the {name} set at point {strongest.point} {carries}"


def _error_words(lebesgue: float) -> str:
    if lebesgue < 1.05:
        return "Errors in the points do not grow here."
    return f"An error in the points can grow {short(lebesgue)} times here."
