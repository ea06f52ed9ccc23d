"""Goals: read, refused, measured; and the lessons' files."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Curve, Parametrization, ParametrizationKind, Point, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.lessons.lesson import (
    LessonError,
    find_lesson,
    lesson_code,
    lesson_names,
    load_lesson,
    parse_lesson,
    read_lesson,
)
from app.storage.files import load
from app.storage.format import encode
from app.storage.resources import resource
from app.view_model.analysis.goals import GoalError, parse_goal, result_of
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def value(text):
    return float(text.partition("now ")[2])


def test_the_lebesgue_constant_of_four_uniform_parameters():
    curve = make_curve(SQUARE)
    curve = Curve(curve.name, LAGRANGE, Parametrization(ParametrizationKind.UNIFORM), curve.points)
    result = result_of(parse_goal("lebesgue < 2"), view_of(curve))
    assert result.is_met
    # Brutman, Annals of Numerical Mathematics 4 (1997) 111-127: 1.6311
    assert value(result.text) == pytest.approx(1.631, abs=5e-4)


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


def test_undecided_smoothness_does_not_count():
    """Points 1e-12 apart: the natural spline's acceleration goes on, which doubles do not show."""
    places = ((0.0, 0.0), (1.0, 1.0), (1.0 + 1e-12, 1.0), (2.0, 0.0))
    view = view_of(Curve("n", HERMITE, Parametrization(), tuple(Point(*place) for place in places)))
    result = result_of(parse_goal("smoothness >= 2"), view)
    assert not result.is_met
    assert result.text == "Derivatives certified continuous at every joint: at least 2; now 1"


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
def test_a_goal_is_not_reached_when_its_conditions_are_broken(detour):
    name, number, change, words = DETOURS[detour]
    goal, curve = given(name, number)
    assert result_of(dataclasses.replace(goal, conditions=()), view_of(change(curve))).is_met
    result = result_of(goal, view_of(change(curve)), curve)
    assert not result.is_met
    assert words in result.text


def test_a_goal_is_about_its_curve():
    goal, curve = given("02_three_parameter_sets", 4)
    other = load(load_lesson("02_three_parameter_sets").document).curves[0]
    result = result_of(goal, view_of(other), curve)
    assert not result.is_met
    assert "Click the curve “Careless”" in result.text


def test_a_slightly_moved_point_meets_the_condition_points():
    goal, curve = given("03_chord_length", 3)
    points = (replace(curve.points[0], y=0.3), *curve.points[1:])
    moved = replace(rule_of(curve, ParametrizationKind.CENTRIPETAL), points=points)
    assert result_of(goal, view_of(moved), curve).is_met


def test_a_single_point_meets_no_goal():
    result = result_of(parse_goal("lebesgue > 0"), view_of(make_curve(SQUARE[:1])))
    assert not result.is_met
    assert "no curve" in result.text


@each_row(
    "text",
    [
        "",
        "lebesgue",
        "lebesgue < many",
        "length < 3",
        "family < hermite",
        "family = circle",
        "rule = arc_length",
        "__import__('os') = 1",
        "points < 3; x",
    ],
)
def test_text_that_is_no_goal_is_refused(text):
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
def test_a_wrong_lesson_is_refused_with_its_step(text, place):
    with pytest.raises(LessonError, match=place):
        parse_lesson(text, "some", Path("some.curve.json"))


def test_a_lesson_is_looked_up_by_name_and_by_number():
    assert find_lesson("chord_length") == find_lesson("3") == find_lesson("03_chord_length")
    with pytest.raises(LessonError, match="basis_functions"):
        find_lesson("calculus")


@each_row("name", lesson_names())
def test_the_document_of_a_lesson_is_in_the_form_of_a_saved_file(name):
    path = load_lesson(name).document
    assert encode(load(path)) == path.read_bytes()


OTHER_LESSON = """# Longest step
A lesson with a measure of its own.

## One
<!-- curve: C; goal: longest_step < 0.3; keep: ends -->
Text.
"""
OTHER_CODE = """
open(__file__ + ".was_run", "w").close()
MEASURES = {"longest_step": ("Longest step of t", lambda view: float(max(view.parameters[1:])))}
KEPT = {"ends": (lambda view, given: view.parameters[0] == 0.0, "the ends have moved")}
"""


def write_lesson(folder):
    folder.mkdir(parents=True)
    (folder / "lesson.md").write_text(OTHER_LESSON, encoding="utf-8")
    (folder / "lesson.py").write_text(OTHER_CODE, encoding="utf-8")


def test_the_python_of_a_foreign_lesson_is_never_run(tmp_path):
    write_lesson(tmp_path / "lessons" / "12_sent")
    assert lesson_code(tmp_path / "lessons" / "12_sent") is None
    with pytest.raises(LessonError, match="“longest_step” is not a measure"):
        read_lesson(tmp_path / "lessons" / "12_sent")
    link = resource("lessons") / "05_sensitivity" / ".." / ".." / ".."
    assert lesson_code(link / os.path.relpath(tmp_path, link.resolve()) / "lessons" / "12_sent") is None
    assert not list(tmp_path.rglob("*.was_run"))


def test_a_built_in_lesson_can_define_measures_and_conditions(tmp_path, monkeypatch):
    monkeypatch.setattr("app.features.lessons.lesson.resource", tmp_path.joinpath)
    write_lesson(tmp_path / "lessons" / "12_longest_step")
    (tmp_path / "lessons" / "12_longest_step" / "lesson.py").write_text(
        OTHER_CODE.replace("open(__file__", "# open(__file__"), encoding="utf-8"
    )
    assert lesson_names() == ["12_longest_step"]
    goal = load_lesson("12_longest_step").steps[0].goal
    assert goal.measure.label == "Longest step of t"
    (condition,) = goal.conditions
    assert condition.broken == "the ends have moved"
    curve = replace(make_curve(SQUARE), name="C")
    assert result_of(goal, view_of(curve), curve).text == "Longest step of t: below 0.3; now 1"
