"""Goals: read, refused, measured; and the lessons' files."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Curve, Parametrization, ParametrizationKind, Point, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.lessons.lesson import LessonError, find_lesson, lesson_names, load_lesson, parse_lesson
from app.storage.files import load
from app.storage.format import encode
from app.view_model.analysis.goals import GoalError, parse_goal, result_of
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

ROOT = Path(__file__).parents[2]
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def value(text):
    return float(text.partition("now ")[2])


def test_the_lebesgue_constant_of_four_uniform_parameters():
    curve = make_curve(SQUARE)
    curve = Curve(curve.name, LAGRANGE, Parametrization(ParametrizationKind.UNIFORM), curve.points)
    standing = result_of(parse_goal("lebesgue < 2"), view_of(curve))
    assert standing.is_met
    # Brutman, Annals of Numerical Mathematics 4 (1997) 111-127: 1.6311
    assert value(standing.text) == pytest.approx(1.631, abs=5e-4)


def test_a_parabola_leaves_its_box_by_an_eighth():
    """Through (0,0), (1,0), (1,1) under t = 0, 1/2, 1 the x-component is 3t - 2t², at most 9/8."""
    rule = Parametrization(ParametrizationKind.UNIFORM)
    curve = Curve("p", LAGRANGE, rule, tuple(Point(*place) for place in SQUARE[:3]))
    assert value(result_of(parse_goal("overshoot > 10"), view_of(curve)).text) == pytest.approx(
        12.5, abs=1e-3
    )


@pytest.mark.parametrize(("family", "order"), [(HERMITE, 1), (QUINTIC_HERMITE, 2)])
def test_joints_are_as_smooth_as_their_family(family, order):
    points = tuple(Point(*place, velocity=(1.0, 2.0)) for place in SQUARE)
    curve = Curve("s", family, Parametrization(), points)
    assert value(result_of(parse_goal("smoothness >= 2"), view_of(curve)).text) == order


def test_smoothness_that_is_not_decided_does_not_count():
    """Points 1e-12 apart: the natural spline's acceleration goes on, which doubles do not show."""
    places = ((0.0, 0.0), (1.0, 1.0), (1.0 + 1e-12, 1.0), (2.0, 0.0))
    view = view_of(Curve("n", HERMITE, Parametrization(), tuple(Point(*place) for place in places)))
    result = result_of(parse_goal("smoothness >= 2"), view)
    assert not result.is_met
    assert result.text == "Derivatives that are certainly continuous at every joint: at least 2; now 1"


def test_the_distance_from_chord_lengths():
    points = tuple(Point(*place, t=t) for place, t in zip(SQUARE, (0.0, 0.3, 0.7, 1.0), strict=True))
    curve = Curve("m", LAGRANGE, Parametrization(ParametrizationKind.MANUAL), points)
    text = result_of(parse_goal("chord_gap < 0.01"), view_of(curve)).text
    assert value(text) == pytest.approx(1 / 3 - 0.3, rel=1e-3)


def given(name, number):
    """The goal of a lesson's step, and the curve that it is about as the lesson has it."""
    lesson = load_lesson(name)
    goal = lesson.steps[number].goal
    return goal, next(curve for curve in load(lesson.document).curves if curve.name == goal.curve)


def rule_of(curve, kind):
    return replace(curve, parametrization=Parametrization(kind))


def by_chord_length(curve):
    return rule_of(curve, ParametrizationKind.CHORD_LENGTH)


def typed(curve, parameters):
    points = tuple(replace(point, t=float(t)) for point, t in zip(curve.points, parameters, strict=True))
    return replace(rule_of(curve, ParametrizationKind.MANUAL), points=points)


DETOURS = {
    # All of these were "reached".
    "deleting points": ("01_basis_functions", 4, lambda c: replace(c, points=c.points[:4]), "points"),
    "deleting joints": ("07_cubic_or_quintic", 4, lambda c: replace(c, points=c.points[:2]), "∞"),
    "another family": ("05_sensitivity", 3, lambda c: replace(c, family=HERMITE), "family"),
    "a rule for a drag": ("02_three_parameter_sets", 4, by_chord_length, "rule"),
    "a rule for typing": ("09_exercise_rounded_parameters", 1, by_chord_length, "rule"),
    "a rule, then by hand": (
        "10_exercise_far_point",
        1,
        lambda c: typed(c, view_of(by_chord_length(c)).parameters),
        "three decimals",
    ),
    "straight points": (
        "03_chord_length",
        3,
        lambda c: replace(c, points=tuple(replace(n, x=float(i), y=0.0) for i, n in enumerate(c.points))),
        "points",
    ),
    "another rule for growth": (
        "01_basis_functions",
        3,
        lambda c: typed(c, [0, 1e-6, *np.linspace(0.1, 1, 9)]),
        "rule",
    ),
}


@each_row("detour", DETOURS)
def test_a_goal_is_not_reached_by_a_way_that_misses_the_point(detour):
    name, number, change, words = DETOURS[detour]
    goal, curve = given(name, number)
    assert result_of(
        parse_goal(f"{goal.measure} {goal.comparison} {goal.value}"), view_of(change(curve))
    ).is_met
    standing = result_of(goal, view_of(change(curve)), curve)
    assert not standing.is_met
    assert words in standing.text


def test_a_goal_is_about_its_curve():
    goal, curve = given("02_three_parameter_sets", 4)
    other = load(load_lesson("02_three_parameter_sets").document).curves[0]
    standing = result_of(goal, view_of(other), curve)
    assert not standing.is_met
    assert "click on the curve “Careless”" in standing.text


def test_a_point_that_was_moved_a_little_does_not_count_as_another():
    goal, curve = given("03_chord_length", 3)
    points = (replace(curve.points[0], y=0.3), *curve.points[1:])
    moved = replace(rule_of(curve, ParametrizationKind.CENTRIPETAL), points=points)
    assert result_of(goal, view_of(moved), curve).is_met


def test_a_curve_that_is_none_meets_nothing():
    standing = result_of(parse_goal("lebesgue > 0"), view_of(make_curve(SQUARE[:1])))
    assert not standing.is_met
    assert "no curve" in standing.text


@each_row(
    "text",
    [
        "",
        "lebesgue",
        "lebesgue < many",
        "length < 3",
        "family < hermite",
        "__import__('os') = 1",
        "points < 3; x",
    ],
)
def test_what_is_no_goal_is_refused(text):
    with pytest.raises(GoalError):
        parse_goal(text)


@each_row(
    ("text", "place"),
    [
        ("Title\n\n## A\nb", "begins with"),
        ("# Title\n\nno steps", "begins with"),
        ("# T\n## A\n<!-- goal: length < 3 -->\nb", "step 1"),
        ("# T\n## A\nb\n## B\n<!-- colour: red -->", "step 2"),
        ("# T\n## A\n<!-- goal: lebesgue < 3 -->\nb", "step 1: a goal needs"),
        ("# T\n## A\n<!-- curve: C; goal: lebesgue < 3 -->\nb", "step 1: a goal needs"),
        ("# T\n## A\n<!-- curve: C; goal: lebesgue < 3; keep: colour -->\nb", "“colour” cannot be kept"),
    ],
)
def test_a_lesson_that_is_wrong_says_where(text, place):
    with pytest.raises(LessonError, match=place):
        parse_lesson(text, "some", Path("some.curve.json"))


def test_a_lesson_is_found_by_name_and_by_number():
    assert find_lesson("chord_length") == find_lesson("3") == find_lesson("03_chord_length")
    with pytest.raises(LessonError, match="basis_functions"):
        find_lesson("calculus")


def test_the_documents_are_what_the_script_makes():
    spec = importlib.util.spec_from_file_location("make_lessons", ROOT / "tests/data/make_lessons.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    made = {name: encode(document) for name, document in module.lessons().items()}
    assert made == {name: load_lesson(name).document.read_bytes() for name in lesson_names()}
