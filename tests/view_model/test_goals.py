"""Goals: read, refused, measured; and the lessons' files."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from app.document.format import encode
from app.document.model import Curve, Family, Node, Parametrization, ParametrizationKind, make_curve
from app.lessons import LessonError, find_lesson, lesson_names, load_lesson, parse_lesson
from app.view_model.curve_view import view_of
from app.view_model.goals import GoalError, parse_goal, standing_of

ROOT = Path(__file__).parents[2]
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def value(text):
    return float(text.partition("now ")[2])


def test_the_lebesgue_constant_of_four_uniform_parameters():
    curve = make_curve(SQUARE)
    curve = Curve(curve.name, Family.LAGRANGE, Parametrization(ParametrizationKind.UNIFORM), curve.nodes)
    standing = standing_of(parse_goal("lebesgue < 2"), view_of(curve))
    assert standing.is_met
    # Brutman, Annals of Numerical Mathematics 4 (1997) 111-127: 1.6311
    assert value(standing.text) == pytest.approx(1.631, abs=5e-4)


def test_a_parabola_leaves_its_box_by_an_eighth():
    """Through (0,0), (1,0), (1,1) under t = 0, 1/2, 1 the x-component is 3t - 2t², at most 9/8."""
    rule = Parametrization(ParametrizationKind.UNIFORM)
    curve = Curve("p", Family.LAGRANGE, rule, tuple(Node(*place) for place in SQUARE[:3]))
    assert value(standing_of(parse_goal("overshoot > 10"), view_of(curve)).text) == pytest.approx(
        12.5, abs=1e-3
    )


@pytest.mark.parametrize(("family", "order"), [(Family.HERMITE, 1), (Family.QUINTIC_HERMITE, 2)])
def test_joints_are_as_smooth_as_their_family(family, order):
    nodes = tuple(Node(*place, velocity=(1.0, 2.0)) for place in SQUARE)
    curve = Curve("s", family, Parametrization(), nodes)
    assert value(standing_of(parse_goal("smoothness >= 2"), view_of(curve)).text) == order


def test_the_distance_from_chord_lengths():
    nodes = tuple(Node(*place, t=t) for place, t in zip(SQUARE, (0.0, 0.3, 0.7, 1.0), strict=True))
    curve = Curve("m", Family.LAGRANGE, Parametrization(ParametrizationKind.MANUAL), nodes)
    text = standing_of(parse_goal("chord_gap < 0.01"), view_of(curve)).text
    assert value(text) == pytest.approx(1 / 3 - 0.3, rel=1e-3)


def test_a_curve_that_is_none_meets_nothing():
    standing = standing_of(parse_goal("lebesgue > 0"), view_of(make_curve(SQUARE[:1])))
    assert not standing.is_met
    assert "no curve" in standing.text


@pytest.mark.parametrize(
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


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("Title\n\n## A\nb", "begins with"),
        ("# Title\n\nno steps", "begins with"),
        ("# T\n## A\n<!-- goal: length < 3 -->\nb", "step 1"),
        ("# T\n## A\nb\n## B\n<!-- colour: red -->", "step 2"),
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
