"""The goals of lessons, measured on the curve that is edited.

A goal is written as ``measure comparison value``: ``lebesgue < 5``, ``family = quintic_hermite``. Beside it
stand the curve that it is about, and what has to stay as it was given (`KEPT`): nobody shall make Λ small by
deleting points. Nothing in it is executed; a measure is a name in a table.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from curvecore import CurveError, chord_length, joint_report

from ...document.model import Curve
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
"""The way of a point, as a share of the drawing, up to which it counts as left where it was."""


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
    curve
        Name of the curve that it is about; empty for any.
    kept
        Names in `KEPT` of the properties that have to stay as given.
    """

    measure: str
    comparison: str
    value: str
    curve: str = ""
    kept: tuple[str, ...] = ()


@dataclass(frozen=True)
class GoalResult:
    """Whether a curve meets a goal, and in words what is asked and what the curve has now."""

    is_met: bool
    text: str


def parse_goal(text: str, curve: str = "", kept: str = "") -> Goal:
    """Return the goal that `text` writes; raise `GoalError` where there is none.

    `kept` names what has to stay as it was given, separated by commas.
    """
    found = _GOAL.fullmatch(text.strip())
    if found is None:
        raise GoalError(f"“{text}” is no goal; write “measure < value”")
    measure, comparison, value = found.groups()
    names = tuple(filter(None, (name.strip() for name in kept.split(","))))
    for name in names:
        if name not in KEPT:
            raise GoalError(f"“{name}” cannot be kept; there are {', '.join(KEPT)}")
    goal = Goal(measure, comparison, value, curve, names)
    if goal.measure in _WORDS:
        if goal.comparison != "=":
            raise GoalError(f"“{text}”: {goal.measure} can only be =")
    elif goal.measure not in MEASURES:
        raise GoalError(f"“{goal.measure}” is no measure; there are {', '.join((*MEASURES, *_WORDS))}")
    else:
        _number(goal)
    return goal


def result_of(goal: Goal, view: CurveView, given: Curve | None = None) -> GoalResult:
    """Return whether the curve of `view` meets `goal`, in words; `given` is the curve as it was given."""
    if goal.curve and view.source.name != goal.curve:
        return GoalResult(False, f"{_asked(goal)}; click on the curve “{goal.curve}”, which is meant")
    if not view.is_current:
        return GoalResult(False, f"{_asked(goal)}; there is no curve now")
    is_met, now = _measured(goal, view)
    changed = [KEPT[name] for name in goal.kept if given is not None and not KEPT[name].is_kept(view, given)]
    if changed:
        return GoalResult(False, f"{_asked(goal)}{now}, but {changed[0].words}")
    return GoalResult(is_met, f"{_asked(goal)}{now}")


def _asked(goal: Goal) -> str:
    if goal.measure in _WORDS:
        return f"{_WORDS[goal.measure].words} {_WORDS[goal.measure].title_of(goal.value)}"
    return f"{MEASURES[goal.measure][0]} {_COMPARISONS[goal.comparison][1]} {goal.value}"


def _measured(goal: Goal, view: CurveView) -> tuple[bool, str]:
    """Return whether the value is the one that is asked for, and what it is now, in words."""
    if goal.measure in _WORDS:
        return _WORDS[goal.measure].of(view) == goal.value, ""
    value = MEASURES[goal.measure][1](view)
    now = number(value) if np.isfinite(value) else "∞"
    return _COMPARISONS[goal.comparison][0](value, _number(goal)), f"; now {now}"


def _number(goal: Goal) -> float:
    try:
        return float(goal.value)
    except ValueError:
        raise GoalError(f"“{goal.value}” is no number") from None


def _overshoot(view: CurveView) -> float:
    """Return how far the curve leaves the box of its points, in percent of the box's longer side."""
    curve = view.curve
    assert curve is not None
    drawn = curve.evaluate(np.linspace(*curve.domain, _SAMPLES))
    low, high = view.points.min(axis=0), view.points.max(axis=0)
    beyond = max(float((low - drawn.min(axis=0)).max()), float((drawn.max(axis=0) - high).max()), 0.0)
    size = size_of(view.points)
    return 100.0 * beyond / size if size > 0 else 0.0


def _smoothness(view: CurveView) -> float:
    """Return the least number of derivatives that are certainly continuous, of all joints."""
    assert view.curve is not None
    joints = joint_report(view.curve, closed=view.source.is_closed)
    return float(min((joint.parametric for joint in joints), default=np.inf))


def _chord_gap(view: CurveView) -> float:
    """Return the largest difference between a parameter and the chord-length parameter, on [0, 1]."""
    t = view.parameters
    try:
        chords = chord_length(view.at_knots)
    except CurveError:
        return np.inf
    return float(np.abs((t - t[0]) / (t[-1] - t[0]) - chords).max())


@dataclass(frozen=True)
class Kept:
    """Something that a goal wants left alone.

    Attributes
    ----------
    is_kept
        Whether the curve still has it, of its view and of the curve as it was given.
    words
        The words where it has not.
    """

    is_kept: Callable[[CurveView, Curve], bool]
    words: str


def _keeps_points(view: CurveView, given: Curve) -> bool:
    """Whether there are as many points as given, each about where it was: a lesson may ask to move one."""
    before = np.array([point.position for point in given.points])
    if before.shape != view.points.shape:
        return False
    return bool(np.abs(view.points - before).max() <= _LITTLE * size_of(before))


def _has_three_decimals(view: CurveView, _given: Curve) -> bool:
    return bool((np.round(view.parameters, 3) == view.parameters).all())


KEPT = {
    "points": Kept(_keeps_points, "the points are not the lesson’s any more (Undo brings them back)"),
    "family": Kept(
        lambda view, given: view.source.family == given.family, "the family is to stay what it was"
    ),
    "rule": Kept(
        lambda view, given: view.source.parametrization.kind is given.parametrization.kind,
        "another rule makes the parameters now",
    ),
    "decimals": Kept(_has_three_decimals, "some parameters have more than three decimals"),
}
"""Properties that a goal may want left alone, by name."""

MEASURES: dict[str, tuple[str, Callable[[CurveView], float]]] = {
    "points": ("Points", lambda view: float(len(view.points))),
    "lebesgue": ("Lebesgue constant Λ", growth_of_points),
    "overshoot": ("Overshoot in percent", _overshoot),
    "smoothness": ("Derivatives that are certainly continuous at every joint:", _smoothness),
    "chord_gap": ("Largest distance from the chord-length parameters", _chord_gap),
}
"""The measures by name: the words for each, and its function of a current view."""


class _Word(NamedTuple):
    """A property that is a word: what is said of it, the one of a view, and the words for a value."""

    words: str
    of: Callable[[CurveView], str]
    title_of: Callable[[str], str]


_WORDS = {
    "family": _Word(
        "The family is", lambda view: str(view.source.family), lambda name: FAMILIES.named(name).title
    ),
    "parametrization": _Word(
        "The parameters are",
        lambda view: str(view.source.parametrization.kind),
        lambda name: name.replace("_", " "),
    ),
}
