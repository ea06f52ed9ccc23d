"""Every number that a lesson states, computed anew: none can be written without a check.

The text of each step is searched for numbers, in digits and in words; `CLAIMS` has a value for each of them,
in the order of the text. A number agrees when it is its value, rounded to the digits that are written.
"""

from __future__ import annotations

import math
import re
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import ParametrizationKind
from app.families import HERMITE, ChosenSettings
from app.features.lessons.lesson import lesson_names, load_lesson
from app.storage.files import load
from app.view_model.analysis.laboratory import try_methods
from app.view_model.analysis.laboratory_settings import (
    USUAL_SHIFT,
    Calculation,
    LaboratorySettings,
    RoundedPart,
)
from app.view_model.basis import growth_of_points
from app.view_model.curve.curve_view import view_of
from app.window.connect import all_actions
from curvecore import (
    chord_length,
    evaluate_rounded,
    exact_values,
    joint_report,
    operation_counts,
    round_significant,
    self_intersections,
)
from tests.rows import each_row

KIND = ParametrizationKind
NUMBERS = {
    word: value
    for value, word in enumerate(
        ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven")
    )
} | {"fourteen": 14, "twenty": 20, "forty": 40, "thousand": 1000, "twice": 2, "half": 0.5, "doubled": 2}
_WORDS = "|".join(NUMBERS)
_TOKEN = re.compile(
    rf"−?\d+(?:\.\d+)?(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?|[½⅓⅔¼]|\b(?:{_WORDS}|hundred|\w+fold|\w+teen)\b", re.IGNORECASE
)
_PLAIN = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")


def tokens(text):
    # "one" alone is a pronoun as often as a number; "1" is the number.
    return [found for found in _TOKEN.findall(text) if found.lower() != "one"]


def stated(token):
    """Return the number that a token writes, and half a unit of its last digit."""
    if token.lower() in NUMBERS:
        return float(NUMBERS[token.lower()]), 1e-9
    if token in "½⅓⅔¼":
        return {"½": 1 / 2, "⅓": 1 / 3, "⅔": 2 / 3, "¼": 1 / 4}[token], 1e-9
    mantissa, _, exponent = token.translate(_PLAIN).partition("·10")
    scale = 10.0 ** int(exponent or 0)
    return float(mantissa) * scale, 0.5 * scale * 10.0 ** -len(mantissa.partition(".")[2])


# What a claim is made of


@cache
def document(number):
    (name,) = [name for name in lesson_names() if name.startswith(f"{number:02d}_")]
    return load(load_lesson(name).document)


@cache
def curve(number, name=None, rule=None, family=None):
    """A curve of a lesson, under another rule or in another family."""
    found = next(each for each in document(number).curves if name in (None, each.name))
    if rule is not None:
        points = tuple(replace(point, t=None) for point in found.points)
        found = replace(found, parametrization=replace(found.parametrization, kind=rule), points=points)
    return replace(found, family=family) if family is not None else found


@cache
def drawn(which):
    """The core's curve, many parameters, its points there and its position functions."""
    core = view_of(which).curve
    t = np.linspace(*core.domain, 8001)
    return core, t, core.evaluate(t), core.basis(t)[:, :, 0]


def lowest(which, start=-np.inf, end=np.inf):
    _, t, _, basis = drawn(which)
    return basis[(t >= start) & (t <= end)].min()


def highest(which, start=-np.inf, end=np.inf):
    _, t, _, basis = drawn(which)
    return basis[(t >= start) & (t <= end)].max()


def constant(which, start=-np.inf, end=np.inf):
    """Λ, over a part of t."""
    _, t, _, basis = drawn(which)
    return np.abs(basis).sum(axis=1)[(t >= start) & (t <= end)].max()


def percent_outside(which):
    """How far the curve leaves the box of its points, in percent of its longer side."""
    core, _, points, _ = drawn(which)
    low, high = core.points.min(axis=0), core.points.max(axis=0)
    return 100 * max((low - points).max(), (points - high).max()) / (high - low).max()


@cache
def cardinals(which, move=1e-3):
    """What the curve does when one point moves, its velocities are estimated anew and its parameters stay."""
    before = view_of(which)
    held = tuple(replace(point, t=float(t)) for point, t in zip(which.points, before.parameters, strict=True))
    manual = replace(which.parametrization, kind=KIND.MANUAL)
    t = np.linspace(*before.curve.domain, 4001)
    functions = []
    for i, point in enumerate(held):
        ends = []
        for by in (move, -move):
            points = (*held[:i], replace(point, y=point.y + by), *held[i + 1 :])
            ends.append(
                view_of(replace(which, parametrization=manual, points=points)).curve.evaluate(t)[:, 1]
            )
        functions.append((ends[0] - ends[1]) / (2 * move))
    return t, np.array(functions)


def constant_with_estimates(which):
    return np.abs(cardinals(which)[1]).sum(axis=0).max()


@cache
def trial(number, digits, shift=0.0, rounding=RoundedPart.EVERY_STEP, family=None):
    settings = LaboratorySettings(True, rounding, digits, frozenset(Calculation), shift=shift)
    return try_methods(view_of(curve(number, family=family)), settings)


def error_at(t, digits=6):
    """The error of the monomials at one t of lesson 6, where only their coefficients are rounded."""
    core = view_of(curve(6)).curve
    found = evaluate_rounded(core.points, core.parameters, t, "monomial", digits, rounding="coefficients")
    return float(np.hypot(*(found - exact_values(core.points, core.parameters, t))[0]))


def error_in(segment, method, *args, **other):
    found = trial(*args, **other)
    inside = (found.t >= segment) & (found.t <= segment + 1)
    return found.outcome(method).errors[inside].max()


def largest(method, *args, **other):
    return trial(*args, **other).outcome(method).worst[0]


def speed(which, t):
    return float(np.hypot(*view_of(which).curve.evaluate(t, 1)))


def mean_speeds(which):
    view = view_of(which)
    return np.hypot(*np.diff(view.points, axis=0).T) / np.diff(view.parameters)


def gap(which, i):
    t = view_of(which).parameters
    return t[i + 1] - t[i]


def with_uniform(count):
    eleven = curve(1, "Eleven points")
    return constant(
        replace(eleven, points=tuple(replace(eleven.points[0], x=float(i)) for i in range(count)))
    )


def key(name):
    """The key of an action that is a digit."""
    return float(next(each.key for each in all_actions() if each.name == name))


def points_of(number, name=None):
    return len(curve(number, name).points)


def point(number, index, name=None):
    """The index of a point that there is."""
    assert index < points_of(number, name)
    return index


def setting(number, step, name):
    (lesson,) = [name for name in lesson_names() if name.startswith(f"{number:02d}_")]
    return load_lesson(lesson).steps[step].settings[name]


def leading(method, part, order):
    """The coefficient of n to the power `order` in a count that is a polynomial of that degree."""
    values = [getattr(operation_counts(method, n), part) for n in range(30, 32 + order)]
    assert len(set(np.diff(values, order))) == 1
    return np.diff(values, order)[0] / math.factorial(order)


def grown(method, n=20):
    """How many times the operations up to a first point twice as many points take."""
    return operation_counts(method, 2 * n).total(1) / operation_counts(method, n).total(1)


def digits_of(points):
    """The fewest digits that points can be rounded to without a change; 2 is the least that there is."""
    return next(k for k in range(2, 17) if (round_significant(points, k) == points).all())


def told(value):
    """A number of the lesson itself: what a person is asked to do or to type, or a part of a formula."""
    return lambda: value


FIVE, ELEVEN = curve(1, "Five points"), curve(1, "Eleven points")
STEP, OUT, CARELESS = (curve(2, name) for name in ("In step", "Out of step", "Careless"))
UNEVEN, CHORDS = curve(3), curve(3, rule=KIND.CHORD_LENGTH)
FAR = curve(10, "Yours")
BELL, BLEND = curve(11, "Bell"), curve(11, "Blend")
CHEBYSHEV = curve(1, "Eleven points", KIND.CHEBYSHEV)
MONOMIAL, BASIS = Calculation.MONOMIAL, Calculation.BASIS

CLAIMS = {
    "01 0": [lambda: drawn(FIVE)[0].basis([0.25])[0, 1, 0], lambda: drawn(FIVE)[0].basis([0.25])[0, 2, 0]],
    "01 1": [lambda: drawn(FIVE)[3].sum(axis=1).max()],
    "01 3": [
        lambda: points_of(1, "Eleven points"),
        lambda: lowest(ELEVEN),
        lambda: highest(ELEVEN),
        lambda: percent_outside(ELEVEN),
        lambda: constant(ELEVEN),
        told(3),
        lambda: points_of(1, "Eleven points") + 3,
        lambda: with_uniform(14),
    ],
    "01 4": [
        lambda: lowest(CHEBYSHEV),
        lambda: highest(CHEBYSHEV),
        lambda: speed(CHEBYSHEV, 0.0),
        lambda: speed(CHEBYSHEV, 0.5),
    ],
    "02": [lambda: len(document(2).curves)],
    "02 0": [lambda: len(document(2).curves), lambda: len(document(2).curves), lambda: points_of(2)],
    "02 1": [
        lambda: mean_speeds(STEP).min(),
        lambda: mean_speeds(STEP).max(),
        lambda: percent_outside(STEP),
        lambda: lowest(STEP),
        lambda: highest(STEP),
        lambda: constant(STEP),
    ],
    "02 2": [
        lambda: point(2, 3),
        lambda: point(2, 4),
        lambda: gap(OUT, 3),
        lambda: gap(OUT, 2),
        lambda: percent_outside(OUT),
        lambda: constant(OUT),
    ],
    "02 3": [
        *(lambda i=i: point(2, i) for i in range(6)),
        lambda: max(gap(CARELESS, i) for i in (0, 2, 4)),
        lambda: percent_outside(CARELESS),
    ],
    "02 5": [lambda: percent_outside(curve(2, "Careless", KIND.CHORD_LENGTH))],
    "03 0": [told(2), lambda: percent_outside(UNEVEN)],
    "03 1": [
        lambda: gap(CHORDS, 2),
        lambda: percent_outside(CHORDS),
        lambda: lowest(CHORDS, 0.149, 0.816),
        lambda: highest(CHORDS, 0.149, 0.816),
        lambda: constant(UNEVEN),
        lambda: constant(CHORDS),
    ],
    "03 2": [
        lambda: constant(UNEVEN, 0.5, 0.5),
        lambda: constant(CHORDS, 0.149, 0.816),
        lambda: constant(UNEVEN, 1 / 3, 1 / 2),
        lambda: constant(UNEVEN),
        lambda: point(3, 2),
    ],
    "03 3": [told(0), told(1), lambda: curve(3, rule=KIND.CENTRIPETAL).parametrization.alpha],
    "03 4": [
        lambda: key("familyHermite"),
        told(2),
        lambda: constant(curve(3, family=HERMITE)),
        lambda: constant_with_estimates(curve(3, family=HERMITE)),
        lambda: constant_with_estimates(curve(3, rule=KIND.CENTRIPETAL, family=HERMITE)),
        lambda: constant_with_estimates(curve(3, rule=KIND.CHORD_LENGTH, family=HERMITE)),
        told(3),
        lambda: constant(CHORDS),
    ],
    "04": [lambda: len(trial(4, 16).outcomes)],
    "04 0": [
        lambda: len(trial(4, 16).outcomes),
        lambda: points_of(4),
        lambda: len(trial(4, 16).outcomes),
        told(1),
        lambda: setting(4, 0, "digits"),
        lambda: len(trial(4, 16).outcomes),
    ],
    "04 2": [
        told(1),
        told(1),
        lambda: np.linalg.cond(np.vander(np.arange(8.0))),
        lambda: np.log10(np.linalg.cond(np.vander(np.arange(8.0)))),
        lambda: setting(4, 2, "digits"),
        lambda: trial(4, 5).outcome(MONOMIAL).lost,
        lambda: constant(curve(4)),
    ],
    "04 3": [
        lambda: setting(4, 3, "digits"),
        lambda: len(trial(4, 8).outcomes),
        lambda: max(each.worst[0] for each in trial(4, 8).outcomes),
        lambda: USUAL_SHIFT,
        lambda: view_of(curve(4)).parameters[0] + USUAL_SHIFT,
        lambda: view_of(curve(4)).parameters[-1] + USUAL_SHIFT,
        lambda: trial(4, 8, USUAL_SHIFT).condition,
    ],
    "04 4": [
        lambda: key("familyHermite"),
        lambda: setting(4, 4, "digits"),
        lambda: largest(BASIS, 4, 4, family=HERMITE),
        lambda: view_of(curve(4)).parameters[0],
        lambda: error_in(0, MONOMIAL, 4, 4, family=HERMITE),
        lambda: error_in(6, MONOMIAL, 4, 4, family=HERMITE),
    ],
    "05 0": [told(0.5), told(2), told(2), lambda: constant(curve(5))],
    "05 3": [told(3)],
    "05 4": [
        lambda: key("familyHermite"),
        lambda: point(5, 4),
        lambda: felt(4, 5),
        lambda: felt(4, 6),
        told(2),
        lambda: constant(curve(5)),
        lambda: constant_with_estimates(curve(5, family=HERMITE)),
    ],
    "06 0": [lambda: setting(6, 0, "digits")],
    "06 1": [
        lambda: setting(6, 1, "digits"),
        lambda: error_at(0.1),
        told(0.1),
        lambda: error_at(8.0),
        lambda: view_of(curve(6)).parameters[-1],
        lambda: USUAL_SHIFT,
        lambda: digits_of(view_of(curve(6)).points),
        lambda: setting(6, 1, "digits"),
    ],
    "06 3": [
        lambda: key("familyHermite"),
        lambda: largest(BASIS, 6, 6, family=HERMITE),
        lambda: highest(curve(6, family=HERMITE)),
        lambda: error_in(7, MONOMIAL, 6, 6, family=HERMITE),
    ],
    "07 0": [lambda: points_of(7) - 2],
    "07 2": [
        lambda: view_of(curve(7, "Quintic")).curve.degree,
        lambda: np.abs(drawn(curve(7, "Quintic"))[0].evaluate([0.0, 4.0], 2)).max(),
    ],
    "07 3": [told(2)],
    "07 4": [lambda: key("familyQuinticHermite")],
    "08 0": [
        told(2),
        told(1),
        lambda: leading("monomial", "setup", 3),
        lambda: leading("lagrange", "setup", 2),
        lambda: points_of(8),
        lambda: operation_counts("monomial", 20).total(1),
        lambda: operation_counts("lagrange", 20).total(1),
        lambda: setting(8, 0, "digits"),
        lambda: 1 + [name[:2] for name in lesson_names()].index("04"),
    ],
    "08 1": [
        lambda: points_of(8, "Forty points") / points_of(8),
        lambda: points_of(8, "Forty points") / points_of(8),
        lambda: grown("monomial"),
        lambda: grown("lagrange"),
        told(2**3),
        told(2**2),
        lambda: round(np.log2(grown("monomial", 10**6)), 5),
        lambda: round(np.log2(grown("lagrange", 10**6)), 5),
    ],
    "08 2": [
        lambda: leading("monomial", "per_point", 1),
        lambda: leading("barycentric", "per_point", 1),
        lambda: leading("lagrange", "per_point", 2),
        told(1000),
    ],
    "09": [told(3), lambda: len(document(9).curves), told(3)],
    "09 0": [lambda: points_of(9), *(lambda i=i: view_of(curve(9)).parameters[i] for i in range(6))],
    "09 1": [lambda: points_of(9) - 1, told(3), told(4.1), told(9.7)],
    "09 3": [told(0.0005), lambda: setting(9, 3, "epsilon"), lambda: setting(9, 3, "delta")],
    "10 0": [lambda: points_of(10), lambda: farthest(view_of(FAR).points)],
    "10 1": [told(3), told(3)],
    "10 2": [
        told(2),
        lambda: 2.0 if 1.75 < constant(by_hand(10)) / constant(FAR) < 2 else 0.0,
        lambda: constant(FAR),
        lambda: constant(by_hand(10)),
    ],
    "10 3": [told(3)],
    "10 4": [
        lambda: key("familyHermite"),
        lambda: key("familyQuinticHermite"),
        lambda: percent_outside(curve(10, "Yours", KIND.CHORD_LENGTH, HERMITE)),
        lambda: constant_with_estimates(curve(10, "Yours", KIND.CHORD_LENGTH, HERMITE)),
        lambda: constant(by_hand(10)),
    ],
    "11 0": [
        lambda: points_of(11, "Bell"),
        lambda: top(drawn(BELL)[2]),
        lambda: top(view_of(BELL).points),
        lambda: constant(BELL),
    ],
    "11 1": [lambda: constant(BLEND)],
    "11 2": [lambda: degree_of(BLEND), lambda: degree_of(BLEND) + 1],
    "11 3": [
        told(1),
        lambda: constant(blended(1)),
        told(10),
        lambda: points_of(11, "Blend"),
        lambda: constant(blended(10)),
    ],
}


def top(points):
    return points[:, 1].max()


def degree_of(which):
    return view_of(which).curve.chosen["degree"]


def blended(degree):
    return replace(BLEND, settings=ChosenSettings({"degree": degree}))


def felt(point, segment):
    """The largest share of an error of a point that is felt in a segment of lesson 5's Hermite curve."""
    t, functions = cardinals(curve(5, family=HERMITE))
    knots = view_of(curve(5)).parameters
    inside = (t >= knots[segment]) & (t <= knots[segment + 1])
    return np.abs(functions[point, inside]).max()


def farthest(points):
    """The point that is farthest from its nearest neighbour."""
    away = np.hypot(*(points[:, None] - points).T) + np.diag(np.full(len(points), np.inf))
    return int(away.min(axis=0).argmax())


def by_hand(number):
    """An exercise as it is solved: chord lengths with three decimals."""
    found = curve(number, "Yours")
    t = np.round(chord_length(view_of(found).points), 3)
    return replace(found, points=tuple(replace(n, t=float(x)) for n, x in zip(found.points, t, strict=True)))


def pages():
    for name in lesson_names():
        lesson = load_lesson(name)
        yield name[:2], f"{lesson.title}\n{lesson.summary}"
        for number, step in enumerate(lesson.steps):
            yield f"{name[:2]} {number}", f"{step.title}\n{step.text}"


@each_row(("place", "text"), pages(), ids=[place for place, _text in pages()])
def test_every_number_of_a_lesson_is_what_it_says(place, text):
    written, values = tokens(text), CLAIMS.get(place, [])
    assert len(written) == len(values), f"say in CLAIMS[{place!r}] what is meant by {written}"
    for token, value in zip(written, values, strict=True):
        number, half_a_unit = stated(token)
        assert value() == pytest.approx(number, abs=half_a_unit * 1.0001), token


def test_no_claim_is_left_over():
    assert CLAIMS.keys() <= {place for place, _text in pages()}


# What the lessons say without a number


def test_lesson_2_says_where_the_curves_swing_out():
    gaps = chord_length(view_of(STEP).points) - view_of(STEP).parameters
    assert np.abs(gaps).max() < 0.01  # "a time that goes with its length"
    _, t, points, _ = drawn(OUT)
    assert t[points[:, 0].argmin()] < view_of(OUT).parameters[1]  # "at its beginning"
    lengths = np.hypot(*np.diff(view_of(OUT).points, axis=0).T)
    assert lengths[3] > lengths[2]
    assert constant(OUT) < 1.2 * constant(STEP)  # "hardly grown"
    basis = drawn(STEP)[3]
    t, knots = drawn(STEP)[1], view_of(STEP).parameters
    inner = (t > knots[1]) & (t < knots[-2])
    assert np.abs(basis[inner]).max() < 1.1  # they are high near the ends only


def test_lesson_3_turns_back_without_a_loop():
    """It spoke of loops that were gone: there was none, under either rule."""
    for which in (UNEVEN, CHORDS):
        assert len(self_intersections(view_of(which).curve, 1e-6).parameters) == 0
    for which, goes_back in ((UNEVEN, True), (CHORDS, False)):
        core, t, _, _ = drawn(which)
        assert (float(core.evaluate(t, 1)[:, 0].min()) < 0) is goes_back
    assert percent_outside(CHORDS) > percent_outside(UNEVEN)
    _, t, points, _ = drawn(CHORDS)
    assert 0.149 < t[points[:, 1].argmin()] < 0.816  # "it sags in the long gap"
    _, t, points, _ = drawn(UNEVEN)
    assert t[points[:, 0].argmax()] > 5 / 6  # "on the right"
    assert points[t < 1 / 6, 0].max() > 2 * UNEVEN.points[1].x  # "at both ends … past the points"


def test_lesson_1_says_where_the_curve_runs():
    """It said that under Chebyshev parameters the curve runs slowly at its ends."""
    core, t, _, _ = drawn(CHEBYSHEV)
    speeds = np.hypot(*core.evaluate(t, 1).T)
    assert speeds[0] == pytest.approx(speeds[-1])
    assert speeds[[0, -1]].min() > 8 * speeds[4000]


def test_lesson_5_says_where_the_band_is_wide():
    which = curve(5)
    _, t, _, basis = drawn(which)
    knots, sums = view_of(which).parameters, np.abs(basis).sum(axis=1)
    by_segment = [sums[(t >= a) & (t <= b)].max() for a, b in pairwise(knots)]
    assert sorted(np.argsort(by_segment)[-2:].tolist()) == [0, 7]


def test_lesson_6_says_how_the_errors_go_along_t():
    def of(method, segment, **other):
        return error_in(segment, method, 6, 6, **other)

    ends, middle = (0, 7), (2, 3, 4, 5)
    # Every step: "the line of the monomials is flat", within a factor of ten.
    flat = [of(MONOMIAL, k) for k in range(8)]
    assert max(flat) < 10 * min(flat)
    # The coefficients: worse along t; with a shift "there is no good end".
    rising = [of(MONOMIAL, k, rounding=RoundedPart.COEFFICIENTS) for k in range(8)]
    assert rising == sorted(rising)
    shifted = [of(MONOMIAL, k, rounding=RoundedPart.COEFFICIENTS, shift=USUAL_SHIFT) for k in range(8)]
    assert min(shifted) > max(rising)
    assert max(shifted) < 2 * min(shifted)
    # Lagrange: "lower in the middle, higher at both ends".
    lagrange = Calculation.LAGRANGE
    assert min(of(lagrange, k) for k in ends) > max(of(lagrange, k) for k in middle)


def test_lesson_7_says_what_jumps():
    cubic, quintic = (view_of(curve(7, name)).curve for name in ("Cubic", "Quintic"))
    assert {joint.parametric for joint in joint_report(cubic)} == {1}
    assert {joint.parametric for joint in joint_report(quintic)} == {2}
    assert np.hypot(*cubic.evaluate(0.0, 2)) > 1  # "at the beginning it comes out of nothing"
    assert not cubic.evaluate(0.0, 1).any()
    points = tuple(replace(point, velocity=None) for point in curve(7, "Cubic").points)
    spline = view_of(replace(curve(7, "Cubic"), points=points)).curve
    assert {joint.parametric for joint in joint_report(spline)} == {2}
    assert np.hypot(*spline.evaluate(0.0, 1)) > 0.5  # "no longer stands still"


def test_lesson_11_says_what_the_degree_does():
    """At the highest degree it is the polynomial, which is above all points between the last of them."""
    _, t, bell, _ = drawn(BELL)
    assert np.abs(drawn(blended(10))[2] + np.array([0.0, 1.5]) - bell).max() < 1e-12
    assert {int(10 * each) for each in t[bell[:, 1] > 1.0 + 1e-9]} == {0, 9}
    # The lower curve is calm as it is given.
    assert top(drawn(BLEND)[2]) < top(view_of(BLEND).points) + 1e-9


def test_lesson_10_says_where_errors_still_grow():
    t, functions = cardinals(curve(10, "Yours", KIND.CHORD_LENGTH, HERMITE))
    knots = view_of(curve(10, "Yours", KIND.CHORD_LENGTH)).parameters
    assert knots[2] < t[np.abs(functions).sum(axis=0).argmax()] < knots[4]


@pytest.mark.parametrize("rule", [KIND.UNIFORM, KIND.CENTRIPETAL, KIND.CHORD_LENGTH])
def test_the_program_shows_what_moved_points_do(rule):
    """Λ was 1 on the screen, whatever the estimated velocities did: 1.50, 3.12 and 8.56 here."""
    which = curve(3, rule=rule, family=HERMITE)
    # The oracle has 4001 samples; at a maximum that is a relative error of about 1e-6.
    assert growth_of_points(view_of(which)) == pytest.approx(constant_with_estimates(which), rel=1e-4)
