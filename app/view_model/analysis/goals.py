"""Goals of lessons, measured on the active curve.

A goal is written as ``measure comparison value``: ``lebesgue < 5``, ``family = quintic_hermite``. It names
its curve and the conditions under which it counts, so that nobody makes Λ small by deleting points. No part
of the text is executed: measures and conditions are names in two tables, `MEASURES` and `KEPT`. The Python
file of a lesson that comes with the program can add to both.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from curvecore import CurveError, chord_length, joint_report

from ...document.model import Curve, ParametrizationKind
from ...document.words import number
from ...families import FAMILIES
from ..basis import growth_of_points
from ..curve.curve_view import CurveView
from ..geometry import size_of

_GOAL = re.compile(r"(\w+)\s*(<=|>=|<|>|=)\s*(\S+)")
_COMPARISONS: dict[str, tuple[Callable[[float, float], bool], str]] = {
    "<": (operator.lt, "below"),
    "<=": (operator.le, "at most"),
    ">": (operator.gt, "above"),
    ">=": (operator.ge, "at least"),
    "=": (operator.eq, "exactly"),
}
_SAMPLES = 2000
_LITTLE = 0.1
"""Distance that a point may move and still count as unmoved, as a share of the size of the points."""


class GoalError(ValueError):
    """Text that is no goal; the message says why."""


class Measure(NamedTuple):
    """Property of a curve that a goal asks for.

    Attributes
    ----------
    label
        Beginning of the sentence that states the goal.
    value_of
        Value of a current view: a number, or one of the words.
    words
        Returns all values that are words, with their displayed texts; None where the values are numbers.
    """

    label: str
    value_of: Callable[[CurveView], float | str]
    words: Callable[[], dict[str, str]] | None = None


class Condition(NamedTuple):
    """Property of a curve that must stay as the lesson gave it.

    Attributes
    ----------
    is_kept
        Function of the view and of the curve as given: whether the curve still has the property.
    broken
        Clause that says what has changed.
    """

    is_kept: Callable[[CurveView, Curve], bool]
    broken: str


Measures = Mapping[str, tuple[str, Callable[[CurveView], float]]]
"""Label and function of the measures of a lesson, all of them numbers, by the name in the text of a goal."""

Conditions = Mapping[str, tuple[Callable[[CurveView, Curve], bool], str]]
"""Function and clause of conditions, by the name in the text of a goal."""


@dataclass(frozen=True)
class Goal:
    """Comparison that a curve meets or not, and the conditions under which it counts.

    Attributes
    ----------
    measure
        Property that is compared.
    comparison, value
        As written; a word can only be equal.
    curve
        Name of the curve that the goal is about; empty for any.
    conditions
        Properties that must stay as given.
    """

    measure: Measure
    comparison: str
    value: str
    curve: str = ""
    conditions: tuple[Condition, ...] = ()


@dataclass(frozen=True)
class GoalResult:
    """Whether a curve meets a goal, and the sentence that states the goal and the value now."""

    is_met: bool
    text: str


def parse_goal(
    text: str,
    curve: str = "",
    kept: str = "",
    *,
    measures: Measures | None = None,
    conditions: Conditions | None = None,
) -> Goal:
    """Return the goal that `text` states; raise `GoalError` where it states none.

    Parameters
    ----------
    kept
        Names of conditions, separated by commas.
    measures, conditions
        Those of the lesson, in addition to `MEASURES` and `KEPT`.
    """
    parts = _GOAL.fullmatch(text.strip())
    if parts is None:
        raise GoalError(f"“{text}” is not a goal; write “measure < value”")
    name, comparison, value = parts.groups()
    known = MEASURES | {key: Measure(*labelled) for key, labelled in (measures or {}).items()}
    if name not in known:
        raise GoalError(f"“{name}” is not a measure; the measures are {', '.join(known)}")
    goal = Goal(known[name], comparison, value, curve, _conditions(kept, {**KEPT, **(conditions or {})}))
    if goal.measure.words is None:
        _number(goal)
    elif comparison != "=":
        raise GoalError(f"“{text}”: {name} can only be =")
    elif value not in (words := goal.measure.words()):
        raise GoalError(f"“{value}” is not a {name}; write one of {', '.join(words)}")
    return goal


def _conditions(kept: str, known: Conditions) -> tuple[Condition, ...]:
    names = [name.strip() for name in kept.split(",") if name.strip()]
    for name in names:
        if name not in known:
            raise GoalError(f"“{name}” cannot be kept; write one of {', '.join(known)}")
    return tuple(Condition(*known[name]) for name in names)


def result_of(goal: Goal, view: CurveView, given: Curve | None = None) -> GoalResult:
    """Return whether the curve of `view` meets `goal`; `given` is the curve as the lesson gave it."""
    if goal.curve and view.source.name != goal.curve:
        return GoalResult(False, f"{_sentence(goal)}. Click the curve “{goal.curve}”: the goal is about it")
    if not view.is_current:
        return GoalResult(False, f"{_sentence(goal)}; there is no curve at the moment")
    is_met, now = _measured(goal, view)
    for condition in goal.conditions:
        if given is not None and not condition.is_kept(view, given):
            return GoalResult(False, f"{_sentence(goal)}{now}, but {condition.broken}")
    return GoalResult(is_met, f"{_sentence(goal)}{now}")


def _sentence(goal: Goal) -> str:
    if goal.measure.words is not None:
        return f"{goal.measure.label} {goal.measure.words().get(goal.value, goal.value)}"
    return f"{goal.measure.label}: {_COMPARISONS[goal.comparison][1]} {goal.value}"


def _measured(goal: Goal, view: CurveView) -> tuple[bool, str]:
    """Return whether the value of the view meets the goal, and the clause with the value."""
    value = goal.measure.value_of(view)
    if isinstance(value, str):
        return value == goal.value, ""
    now = number(value) if np.isfinite(value) else "∞"
    return _COMPARISONS[goal.comparison][0](value, _number(goal)), f"; now {now}"


def _number(goal: Goal) -> float:
    try:
        return float(goal.value)
    except ValueError:
        raise GoalError(f"“{goal.value}” is not a number") from None


def _overshoot(view: CurveView) -> float:
    """Return the distance by which the curve leaves the box of its points, in percent of its longer side."""
    curve = view.present_curve
    drawn = curve.evaluate(np.linspace(*curve.domain, _SAMPLES))
    low, high = view.points.min(axis=0), view.points.max(axis=0)
    beyond = max(float((low - drawn.min(axis=0)).max()), float((drawn.max(axis=0) - high).max()), 0.0)
    size = size_of(view.points)
    return 100.0 * beyond / size if size > 0 else 0.0


def _smoothness(view: CurveView) -> float:
    """Return the number of derivatives that are certified continuous at every joint."""
    joints = joint_report(view.present_curve, closed=view.source.is_closed)
    return float(min((joint.parametric for joint in joints), default=np.inf))


def _chord_gap(view: CurveView) -> float:
    """Return the largest difference between a parameter and the chord-length parameter, on [0, 1]."""
    t = view.parameters
    try:
        chords = chord_length(view.at_knots)
    except CurveError:
        return np.inf
    return float(np.abs((t - t[0]) / (t[-1] - t[0]) - chords).max())


def _keeps_points(view: CurveView, given: Curve) -> bool:
    """Return whether all points are there, each about where it was: a lesson may ask to move one."""
    before = np.array([point.position for point in given.points])
    if before.shape != view.points.shape:
        return False
    return bool(np.abs(view.points - before).max() <= _LITTLE * size_of(before))


KEPT: Conditions = {
    "points": Condition(_keeps_points, "the points have changed (Undo restores them)"),
    "family": Condition(lambda view, given: view.source.family == given.family, "the family has changed"),
    "rule": Condition(
        lambda view, given: view.source.parametrization.kind is given.parametrization.kind,
        "the rule for the parameters has changed",
    ),
    "decimals": Condition(
        lambda view, _given: bool((np.round(view.parameters, 3) == view.parameters).all()),
        "some parameters have more than three decimals",
    ),
}
"""Conditions by name."""

MEASURES = {
    "family": Measure(
        "The family is",
        lambda view: str(view.source.family),
        lambda: {family.name: family.title for family in FAMILIES},
    ),
    "rule": Measure(
        "The rule for the parameters is",
        lambda view: str(view.source.parametrization.kind),
        lambda: {str(kind): str(kind).replace("_", " ") for kind in ParametrizationKind},
    ),
    "points": Measure("Number of points", lambda view: float(len(view.points))),
    "lebesgue": Measure("Lebesgue constant Λ", growth_of_points),
    "overshoot": Measure("Overshoot in percent", _overshoot),
    "smoothness": Measure("Derivatives certified continuous at every joint", _smoothness),
    "chord_gap": Measure("Largest distance from the chord-length parameters", _chord_gap),
}
"""Measures by name."""
