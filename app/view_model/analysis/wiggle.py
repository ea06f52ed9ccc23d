"""Why the curve swings out where it does: who pulls at one t, and how hard."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.view_model.analysis.wording import short
from app.view_model.curve_view import CurveView
from curvecore import lebesgue_function

Floats = npt.NDArray[np.float64]

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
    """What one datum does at t.

    Attributes
    ----------
    node
        The point it belongs to.
    order
        0: its position; 1: its velocity; 2: its acceleration.
    weight
        For a position its weight. For a derivative how far it displaces the curve, as a multiple of the
        distance of the two points of the segment.
    """

    node: int
    order: int
    weight: float


@dataclass(frozen=True)
class Explanation:
    """Why the curve is where it is at one t.

    Attributes
    ----------
    t
        The parameter.
    segment
        The knot at the beginning of the segment, and the nodes at both its ends.
    pulls
        The strongest data, the strongest first.
    lebesgue
        The sum of the sizes of all weights of points.
    overshoot
        How far the curve swings out of the straight line between the two points, at its farthest.
    sentences
        The same in words.
    """

    t: float
    segment: tuple[int, int, int]
    pulls: tuple[Pull, ...]
    lebesgue: float
    overshoot: float
    sentences: tuple[str, ...]


def widest(view: CurveView) -> float:
    """Return the t at which the curve is farthest from the straight line between its neighbouring points."""
    assert view.curve is not None
    knots = view.parameters
    count = max(1, min(_COARSE, _MOST_COARSE // len(knots)))
    shares = np.linspace(0.0, 1.0, count + 2)[1:-1]
    t = knots[:-1, None] + np.diff(knots)[:, None] * shares
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


def _distances(places: Floats, start: Floats, end: Floats) -> Floats:
    """Return the distances of places (…, 2) from segments whose ends are given."""
    along = end - start
    # Far out on a wild curve squares overflow; beyond this nobody compares distances.
    off = np.clip(np.nan_to_num(places, nan=1e150), -1e150, 1e150) - start
    squared = (along**2).sum(axis=-1)
    share = (off * along).sum(axis=-1) / np.where(squared > 0, squared, 1.0)
    gap = off - np.clip(share, 0.0, 1.0)[..., None] * along
    return np.asarray(np.hypot(gap[..., 0], gap[..., 1]))


def explain(view: CurveView, t: float) -> Explanation | None:
    """Return who pulls at `t`; None where there is no curve."""
    if not view.is_current or view.curve is None or view.skeleton is None:
        return None
    knots = view.parameters
    t = min(max(t, float(knots[0])), float(knots[-1]))
    knot = min(int(np.searchsorted(knots, t, side="right")) - 1, len(knots) - 2)
    segment = (knot, view.owner(knot), view.owner(knot + 1))
    chord = float(np.hypot(*(view.points[segment[2]] - view.points[segment[1]])))
    pulls = _pulls(view, t, knot, chord)
    swing, _ = overshoot(view, knot)
    lebesgue = float(lebesgue_function(view.skeleton, t))
    at_point = next((view.owner(each) for each in (knot, knot + 1) if knots[each] == t), None)
    pulling = (
        f"Right here it goes through point {at_point}, whatever the others do."
        if at_point is not None
        else _pull_words(view, pulls, segment)
    )
    words = (_swing_words(segment, swing, chord), pulling, _error_words(lebesgue))
    return Explanation(t, segment, pulls[:MOST_PULLS], lebesgue, swing, words)


def _pulls(view: CurveView, t: float, knot: int, chord: float) -> tuple[Pull, ...]:
    """Return all data that count, the strongest first."""
    assert view.skeleton is not None
    basis = view.skeleton.basis(np.array([t]))[0]
    positions = view.by_node(basis[:, 0])
    found = [Pull(node, 0, float(weight)) for node, weight in enumerate(positions) if weight != 0]
    if view.sides is not None:
        for order in range(1, basis.shape[1]):
            # Velocity and acceleration ahead of the first point, and before the second.
            for at, jets in ((knot, view.sides.after), (knot + 1, view.sides.before)):
                x, y = (basis[at, order] * jets[at, order]).tolist()
                size = float(np.hypot(x, y)) / chord if chord > 0 else 0.0
                found.append(Pull(view.owner(at), order, size))
    return tuple(sorted(found, key=lambda pull: -abs(pull.weight)))


def _swing_words(segment: tuple[int, int, int], swing: float, chord: float) -> str:
    between = f"Between points {segment[1]} and {segment[2]}"
    if swing <= _CALM * chord:
        return f"{between} the curve is calm: it leaves their straight line by {short(swing)} at most."
    times = f", {short(swing / chord)} times their distance" if chord > 0 else ""
    return f"{between} the curve swings out by {short(swing)}{times}."


def _pull_words(view: CurveView, pulls: tuple[Pull, ...], segment: tuple[int, int, int]) -> str:
    """Say who of those far away pulls hardest, or that nobody does."""
    if view.source.family.derivatives:
        strongest = next((pull for pull in pulls if pull.order > 0), None)
        name = ("", "velocity", "acceleration")[strongest.order] if strongest is not None else ""
        local = f"Only points {segment[1]} and {segment[2]} and their derivatives count here"
        if strongest is None or strongest.weight < _FAR_WEIGHT:
            return f"{local}."
        return (
            f"{local}; the {name} of point {strongest.node} "
            f"carries the curve {short(strongest.weight)} times their distance."
        )
    far = [pull for pull in pulls if pull.node not in segment[1:]]
    if not far or abs(far[0].weight) < _FAR_WEIGHT:
        return f"Only points {segment[1]} and {segment[2]} have a say here."
    pull = far[0]
    steps = segment[1] - pull.node if pull.node < segment[1] else pull.node - segment[2]
    verb = "pushes" if pull.weight < 0 else "pulls"
    away = "it is only the next point" if steps == 1 else f"it lies {steps} points away"
    return f"Point {pull.node} {verb} with weight {short(pull.weight)} though {away}."


def _error_words(lebesgue: float) -> str:
    if lebesgue < 1.05:
        return "Errors in the points do not grow here."
    return f"An error in the points can grow {short(lebesgue)} times here."
