"""What a lesson asks for, measured on the curve that is edited.

A goal is written as ``measure comparison value``: ``lebesgue < 5``, ``family = quintic_hermite``. Nothing in
it is executed; a measure is a name in a table.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.view_model.curve_view import CurveView, Floats
from app.view_model.growth import growth_of_points
from curvecore import CurveError, chord_length, joint_report

_GOAL = re.compile(r"(\w+)\s*(<=|>=|<|>|=)\s*(\S+)")
_COMPARISONS: dict[str, tuple[Callable[[float, float], bool], str]] = {
    "<": (operator.lt, "below"),
    "<=": (operator.le, "at most"),
    ">": (operator.gt, "above"),
    ">=": (operator.ge, "at least"),
    "=": (operator.eq, "exactly"),
}
_SAMPLES = 2000


class GoalError(ValueError):
    """A goal that cannot be read; the text says why."""


@dataclass(frozen=True)
class Goal:
    """Something that a curve meets or does not.

    Attributes
    ----------
    measure
        A name in `MEASURES`, or ``family`` or ``parametrization``.
    comparison, value
        As written; the value of ``family`` and ``parametrization`` is a word.
    """

    measure: str
    comparison: str
    value: str


@dataclass(frozen=True)
class Standing:
    """Where a curve stands.

    Attributes
    ----------
    text
        What is asked, and what the curve has now.
    """

    is_met: bool
    text: str


def parse_goal(text: str) -> Goal:
    """Return the goal that `text` writes; raise `GoalError` where there is none."""
    found = _GOAL.fullmatch(text.strip())
    if found is None:
        raise GoalError(f"“{text}” is no goal; write “measure < value”")
    goal = Goal(*found.groups())
    if goal.measure in _WORDS:
        if goal.comparison != "=":
            raise GoalError(f"“{text}”: {goal.measure} can only be =")
    elif goal.measure not in MEASURES:
        raise GoalError(f"“{goal.measure}” is no measure; there are {', '.join((*MEASURES, *_WORDS))}")
    else:
        _number(goal)
    return goal


def standing_of(goal: Goal, view: CurveView) -> Standing:
    """Return whether the curve of `view` meets `goal`, in words."""
    if goal.measure in _WORDS:
        label, value_of = _WORDS[goal.measure]
        wanted = goal.value.replace("_", " ")
        return Standing(value_of(view) == goal.value, f"{label} {wanted}")
    label, measure = MEASURES[goal.measure]
    compare, words = _COMPARISONS[goal.comparison]
    asked = f"{label} {words} {goal.value}"
    if not view.is_current:
        return Standing(False, f"{asked}; there is no curve now")
    value = measure(view)
    return Standing(compare(value, _number(goal)), f"{asked}; now {value:.4g}")


def _number(goal: Goal) -> float:
    try:
        return float(goal.value)
    except ValueError:
        raise GoalError(f"“{goal.value}” is no number") from None


def _lebesgue(view: CurveView) -> float:
    return growth_of_points(view)


def _overshoot(view: CurveView) -> float:
    """Return how far the curve leaves the box of its points, in percent of the box's longer side."""
    curve = view.curve
    assert curve is not None
    drawn = curve.evaluate(np.linspace(*curve.domain, _SAMPLES))
    low, high = view.points.min(axis=0), view.points.max(axis=0)
    beyond = max(float((low - drawn.min(axis=0)).max()), float((drawn.max(axis=0) - high).max()), 0.0)
    size = float((high - low).max())
    return 100.0 * beyond / size if size > 0 else 0.0


def _smoothness(view: CurveView) -> float:
    """Return the least number of continuous derivatives at any joint."""
    assert view.curve is not None
    joints = joint_report(view.curve, closed=view.source.is_closed)
    return float(min((joint.parametric for joint in joints), default=np.inf))


def _chord_gap(view: CurveView) -> float:
    """Return the largest difference between a parameter and the chord-length parameter, on [0, 1]."""
    t = view.parameters
    try:
        chords = chord_length(_at_knots(view))
    except CurveError:
        return np.inf
    return float(np.abs((t - t[0]) / (t[-1] - t[0]) - chords).max())


def _at_knots(view: CurveView) -> Floats:
    return np.vstack([view.points, view.points[:1]]) if view.source.is_closed else view.points


MEASURES: dict[str, tuple[str, Callable[[CurveView], float]]] = {
    "points": ("Points", lambda view: float(len(view.points))),
    "lebesgue": ("Lebesgue constant Λ", _lebesgue),
    "overshoot": ("Overshoot in percent", _overshoot),
    "smoothness": ("Derivatives that are continuous at every joint:", _smoothness),
    "chord_gap": ("Largest distance from the chord-length parameters", _chord_gap),
}
"""What can be measured: how it is called, and the function of a current view."""

_WORDS: dict[str, tuple[str, Callable[[CurveView], str]]] = {
    "family": ("The family is", lambda view: str(view.source.family)),
    "parametrization": ("The parameters are", lambda view: str(view.source.parametrization.kind)),
}
