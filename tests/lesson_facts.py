"""Computed values for the claims of lessons, and the numbers that a text states."""

from __future__ import annotations

import math
import re
from functools import cache

import numpy as np
from msgspec.structs import replace

from app.document.model import ParametrizationKind
from app.families import FAMILIES, FamilySettingValues
from app.features.lessons.lesson import Lesson, lesson_names
from app.storage.files import load
from app.view_model.analysis.laboratory import try_methods
from app.view_model.analysis.settings import USUAL_SHIFT, Calculation, LaboratorySettings, RoundedPart
from app.view_model.curve.curve_view import view_of
from app.window.connect import all_actions
from curvecore import chord_length, evaluate_rounded, exact_values, operation_counts, round_significant

WORDS = {
    word: value
    for value, word in enumerate(
        ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven")
    )
} | {"fourteen": 14, "twenty": 20, "forty": 40, "thousand": 1000, "twice": 2, "half": 0.5, "doubled": 2}
_TOKEN = re.compile(
    r"−?\d+(?:\.\d+)?(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?|[½⅓⅔¼]"
    rf"|\b(?:{'|'.join(WORDS)}|hundred|\w+fold|\w+teen)\b",
    re.IGNORECASE,
)
_PLAIN = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")


def numbers_in(text):
    """Return the matches of all numbers in a text, in digits and in words.

    "One" alone is a pronoun as often as a number; "1" is the number.
    """
    return [match for match in _TOKEN.finditer(text) if match[0].lower() != "one"]


def value_of(number):
    """Return the value of a written number, and half a unit of its last digit."""
    if number.lower() in WORDS:
        return float(WORDS[number.lower()]), 1e-9
    if number in "½⅓⅔¼":
        return {"½": 1 / 2, "⅓": 1 / 3, "⅔": 2 / 3, "¼": 1 / 4}[number], 1e-9
    mantissa, _, exponent = number.translate(_PLAIN).partition("·10")
    scale = 10.0 ** int(exponent or 0)
    return float(mantissa) * scale, 0.5 * scale * 10.0 ** -len(mantissa.partition(".")[2])


class LessonFacts:
    """Computed values of a lesson: what ``claims(lesson)`` in its ``lesson.py`` gets.

    Rules and families are named as in documents: ``lesson.curve("Uneven", rule="chord_length")``.
    """

    every_step, coefficients = RoundedPart.EVERY_STEP, RoundedPart.COEFFICIENTS
    monomial, lagrange, basis = Calculation.MONOMIAL, Calculation.LAGRANGE, Calculation.BASIS
    usual_shift = USUAL_SHIFT

    def __init__(self, lesson: Lesson) -> None:
        self.lesson = lesson
        self.document = load(lesson.document)

    # Curves

    def curve(self, name=None, rule=None, family=None):
        """Return a curve of the lesson, the first one without a name, with another rule or family."""
        curve = next(each for each in self.document.curves if name in (None, each.name))
        if rule is not None:
            kind = ParametrizationKind(rule)
            points = tuple(replace(point, t=None) for point in curve.points)
            rules = replace(curve.parametrization, kind=kind)
            curve = replace(curve, parametrization=rules, points=points)
        return replace(curve, family=FAMILIES.named(family)) if family is not None else curve

    def with_setting(self, curve, **settings):
        return replace(curve, settings=FamilySettingValues(settings))

    def with_estimated_velocities(self, curve, which):
        points = list(curve.points)
        points[which] = [replace(point, velocity=None) for point in points[which]]
        return replace(curve, points=tuple(points))

    def with_uniform_points(self, curve, count):
        return replace(curve, points=tuple(replace(curve.points[0], x=float(i)) for i in range(count)))

    def solved_by_hand(self, name):
        """Return an exercise as it is solved: chord lengths with three decimals."""
        curve = self.curve(name)
        t = np.round(chord_length(self.points(curve)), 3)
        pairs = zip(curve.points, t, strict=True)
        return replace(curve, points=tuple(replace(point, t=float(x)) for point, x in pairs))

    # Views

    def core(self, curve):
        return view_of(curve).curve

    def points(self, curve):
        return view_of(curve).points

    def parameters(self, curve):
        return view_of(curve).parameters

    def gaps(self, curve):
        """Return the differences of neighbouring parameters."""
        return np.diff(self.parameters(curve))

    def distances(self, curve):
        """Return the distances of neighbouring points."""
        return np.hypot(*np.diff(self.points(curve), axis=0).T)

    def point(self, curve, index):
        """Return the index of a point that exists."""
        assert index < len(curve.points)
        return index

    def farthest_point(self, curve):
        """Return the index of the point that is farthest from its nearest neighbour."""
        points = self.points(curve)
        away = np.hypot(*(points[:, None] - points).T) + np.diag(np.full(len(points), np.inf))
        return int(away.min(axis=0).argmax())

    def samples(self, curve):
        """Return many parameters, the points there and the values of the position functions."""
        return _samples(curve)[1:]

    def lowest(self, curve, start=-np.inf, end=np.inf):
        t, _, basis = self.samples(curve)
        return basis[(t >= start) & (t <= end)].min()

    def highest(self, curve, start=-np.inf, end=np.inf):
        t, _, basis = self.samples(curve)
        return basis[(t >= start) & (t <= end)].max()

    def lebesgue(self, curve, start=-np.inf, end=np.inf):
        """Return Λ over a part of t, with velocities as they are."""
        t, _, basis = self.samples(curve)
        return np.abs(basis).sum(axis=1)[(t >= start) & (t <= end)].max()

    def percent_outside(self, curve):
        """Return how far the curve leaves the box of its points, in percent of its longer side."""
        core, _, points, _ = _samples(curve)
        low, high = core.points.min(axis=0), core.points.max(axis=0)
        return 100 * max((low - points).max(), (points - high).max()) / (high - low).max()

    def speed(self, curve, t):
        return float(np.hypot(*self.core(curve).evaluate(t, 1)))

    def speeds(self, curve):
        """Return the speeds at the parameters of `samples`."""
        core, t, _, _ = _samples(curve)
        return np.hypot(*core.evaluate(t, 1).T)

    # Estimated velocities

    def cardinals(self, curve):
        """Return parameters, and the displacement there when a point moves and its velocities follow.

        The parameters of the points stay. A second method, by differences: the program has formulas.
        """
        return _cardinals(curve)

    def lebesgue_with_estimates(self, curve):
        return np.abs(_cardinals(curve)[1]).sum(axis=0).max()

    def share_felt(self, curve, point, segment):
        """Return the largest share of an error in a point that is felt in a segment."""
        t, functions = _cardinals(curve)
        knots = self.parameters(curve)
        return np.abs(functions[point, (t >= knots[segment]) & (t <= knots[segment + 1])]).max()

    # Laboratory

    def trial(self, digits, shift=0.0, rounding=RoundedPart.EVERY_STEP, family=None):
        return _trial(self.curve(family=family), digits, shift, rounding)

    def largest_error(self, method, digits, **other):
        return self.trial(digits, **other).outcome(method).worst[0]

    def error_in(self, segment, method, digits, **other):
        """Return the largest error with segment ≤ t ≤ segment + 1."""
        trial = self.trial(digits, **other)
        inside = (trial.t >= segment) & (trial.t <= segment + 1)
        return trial.outcome(method).errors[inside].max()

    def monomial_error_at(self, t, digits):
        """Return the error of the monomials at one t when only their coefficients are rounded."""
        core = self.core(self.curve())
        rounded = evaluate_rounded(
            core.points, core.parameters, t, "monomial", digits, rounding="coefficients"
        )
        return float(np.hypot(*(rounded - exact_values(core.points, core.parameters, t))[0]))

    def digits_of(self, points):
        """Return the fewest digits to which points can be rounded without a change; 2 is the least."""
        return next(k for k in range(2, 17) if (round_significant(points, k) == points).all())

    def leading_coefficient(self, method, part, order):
        """Return the coefficient of n to the power `order` in a count that is a polynomial of that degree."""
        values = [getattr(operation_counts(method, n), part) for n in range(30, 32 + order)]
        assert len(set(np.diff(values, order))) == 1
        return np.diff(values, order)[0] / math.factorial(order)

    def growth_of_cost(self, method, n=20):
        """Return the factor by which twice as many points cost more, up to a first point of the curve."""
        return operation_counts(method, 2 * n).total(1) / operation_counts(method, n).total(1)

    # The program

    def setting(self, step, name):
        """Return a setting of the analysis in a step."""
        return self.lesson.steps[step - 1].settings[name]

    def key(self, name):
        """Return the key of an action, where it is a digit."""
        return float(next(each.key for each in all_actions() if each.name == name))

    def number_of_lesson(self, name):
        """Return the number of a lesson in the list of lessons."""
        return 1 + [each.partition("_")[2] for each in lesson_names()].index(name)


@cache
def _samples(curve):
    core = view_of(curve).curve
    t = np.linspace(*core.domain, 8001)
    return core, t, core.evaluate(t), core.basis(t)[:, :, 0]


@cache
def _cardinals(curve, move=1e-3):
    before = view_of(curve)
    pairs = zip(curve.points, before.parameters, strict=True)
    held = tuple(replace(point, t=float(t)) for point, t in pairs)
    manual = replace(curve.parametrization, kind=ParametrizationKind.MANUAL)
    t = np.linspace(*before.curve.domain, 4001)
    functions = []
    for i, point in enumerate(held):
        ends = []
        for by in (move, -move):
            points = (*held[:i], replace(point, y=point.y + by), *held[i + 1 :])
            moved = replace(curve, parametrization=manual, points=points)
            ends.append(view_of(moved).curve.evaluate(t)[:, 1])
        functions.append((ends[0] - ends[1]) / (2 * move))
    return t, np.array(functions)


@cache
def _trial(curve, digits, shift, rounding):
    settings = LaboratorySettings(True, rounding, digits, frozenset(Calculation), shift=shift)
    return try_methods(view_of(curve), settings)
