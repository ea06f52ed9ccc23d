"""A motion: from time to parameter, and the picture and sentences of it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.derivatives import VelocityRule
from app.document.model import Curve, Parametrization, ParametrizationKind, Point
from app.families import HERMITE, QUINTIC_HERMITE, Family
from app.storage.examples import first_sketch
from app.view_model.curve.curve_view import view_of
from app.view_model.geometry import usual_length
from app.view_model.motion import (
    ACTIVE,
    STATIONS,
    TRAIL,
    ArrowKind,
    Course,
    Scales,
    dot_at,
    dots_at,
    folded,
    jump_sentences,
    rivals_of,
    round_duration,
    runs_back,
    scales_of,
)
from app.view_model.motion_settings import Pace, Repeat
from curvecore import HermiteCurve, LagrangeCurve

QUARTERS = np.arange(0.0, 12.0, 0.25)
"""Sums of powers of two: nothing is rounded."""

LINE = HermiteCurve([[0, 0], [4, 0]], [[2, 0], [2, 0]], [1, 3])
BOTH = frozenset((HERMITE, QUINTIC_HERMITE))
WAVE = LagrangeCurve([[0, 0], [1, 2], [3, -1], [4, 0]], [0, 0.5, 1.5, 2.5])


def sketch(family: Family = HERMITE, **fields) -> Curve:
    return replace(first_sketch().curves[0], family=family, **fields)


@pytest.mark.parametrize(
    ("repeat", "expected"),
    [
        (Repeat.ONCE, [0, 0.5, 1, 1.5, 2, 2, 2, 2, 2]),
        (Repeat.LOOP, [0, 0.5, 1, 1.5, 0, 0.5, 1, 1.5, 0]),
        (Repeat.PING_PONG, [0, 0.5, 1, 1.5, 2, 1.5, 1, 0.5, 0]),
    ],
)
def test_once_loop_and_ping_pong_are_exact(repeat, expected):
    assert folded(np.arange(0, 4.5, 0.5), 2.0, repeat).tolist() == expected
    whole = round_duration(2.0, repeat)
    if repeat is not Repeat.ONCE:
        assert np.array_equal(folded(QUARTERS + 4 * whole, 2.0, repeat), folded(QUARTERS, 2.0, repeat))


def test_the_dot_of_a_ping_pong_runs_backwards():
    back = [runs_back(seconds, 2.0, Repeat.PING_PONG) for seconds in (0, 1.5, 2, 2.5, 3.5, 4, 5)]
    assert back == [False, False, False, True, True, False, False]
    assert not runs_back(2.5, 2.0, Repeat.LOOP)


def test_a_domain_in_seconds_is_played_in_real_time():
    course = Course(WAVE)
    assert course.duration == 2.5
    assert course.parameters_at(np.array([0, 0.5, 2.5])).tolist() == [0, 0.5, 2.5]
    assert Course(LINE).parameters_at(np.array([0, 1.5, 2])).tolist() == [1, 2.5, 3]


@pytest.mark.parametrize("accuracy", [1e-4, 1e-7, 1e-10])
def test_by_arc_length_equal_times_give_equal_lengths(accuracy):
    course = Course(WAVE, Pace.LENGTH, accuracy)
    t = course.parameters_at(np.linspace(0, course.duration, 9))
    assert t[[0, -1]].tolist() == [0, 2.5]
    # An independent measure: the polygon through 20,001 points of each part, too short by 1e-8 or so.
    parts = [WAVE.evaluate(np.linspace(a, b, 20_001)) for a, b in pairwise(t)]
    lengths = [np.linalg.norm(np.diff(part, axis=0), axis=1).sum() for part in parts]
    assert np.ptp(lengths) <= 2 * accuracy * 4 + 1e-7
    assert [course.elapsed_at(each) for each in t] == pytest.approx(
        np.linspace(0, 2.5, 9), abs=2 * accuracy + 1e-9
    )


def test_by_arc_length_the_speed_is_even_and_all_acceleration_is_bend():
    course = Course(WAVE, Pace.LENGTH)
    moments = course.moments_at(np.linspace(0, 2.5, 50))
    speeds = np.linalg.norm(moments.velocities, axis=1)
    assert np.ptp(speeds) <= 1e-12 * speeds.max()
    along = (moments.velocities * moments.accelerations).sum(axis=1)
    pulls = np.linalg.norm(moments.accelerations, axis=1)
    assert np.abs(along).max() <= 1e-12 * (speeds * pulls).max()
    # By differences of where it is: second differences with steps of 1e-4 are good to some 1e-6 here.
    h, at = 1e-4, 1.1
    exact = Course(WAVE, Pace.LENGTH, 1e-12)
    places = WAVE.evaluate(exact.parameters_at(np.array([at - h, at, at + h])))
    moment = exact.moments_at(exact.parameters_at(np.array([at])))
    assert (places[2] - places[0]) / (2 * h) == pytest.approx(moment.velocities[0], rel=1e-5)
    assert (places[2] - 2 * places[1] + places[0]) / h**2 == pytest.approx(
        moment.accelerations[0], rel=1e-3, abs=1e-3
    )


def test_a_curve_without_length_is_run_through_by_t():
    still = HermiteCurve(np.zeros((2, 2)), np.zeros((2, 2)), [0, 1])
    course = Course(still, Pace.LENGTH)
    assert course.parameters_at(np.array([0.25])).tolist() == [0.25]
    assert scales_of([course]) == Scales(0.0, 0.0)


def test_huge_numbers_give_a_dot():
    wild = LagrangeCurve([[0, 0], [1e300, -1e300], [1, 1]], [0, 0.5, 1])
    for pace in Pace:
        course = Course(wild, pace)
        dot = dot_at(course, 0.3, Repeat.LOOP, scales_of([course]))
        assert 0 <= dot.t <= 1


def test_a_backward_run_reverses_the_velocity_and_not_the_acceleration():
    course = Course(WAVE)
    there, back = (dot_at(course, each, Repeat.PING_PONG, Scales(1, 1)) for each in (1.0, 4.0))
    assert there.t == back.t == 1.0
    tips = [np.subtract([arrow.tip for arrow in dot.arrows], dot.position) for dot in (there, back)]
    assert tips[0][0] == pytest.approx(-tips[1][0])
    assert tips[0][1] == pytest.approx(tips[1][1])
    assert tips[0][0] == pytest.approx(WAVE.evaluate(1.0, 1))
    assert there.arrows[1].text == f"|a| {there.acceleration:.3g}"


def test_the_dots_of_the_trail_do_not_move():
    course = Course(LINE)
    step = course.duration / STATIONS
    first = dot_at(course, 1.01, Repeat.LOOP, Scales(1, 1)).trail
    assert len(first) == TRAIL
    assert np.diff(first[:, 0]) == pytest.approx(-2 * step)
    later = dot_at(course, 1.01 + step, Repeat.LOOP, Scales(1, 1)).trail
    assert np.array_equal(later[1:], first[:-1])
    assert len(dot_at(course, 0.0, Repeat.LOOP, Scales(1, 1)).trail) == 0
    # Once it has been round, the trail reaches back over the seam; where it runs once, it ends there.
    assert len(dot_at(course, 2.0, Repeat.LOOP, Scales(1, 1)).trail) == TRAIL
    assert dot_at(course, 2.0, Repeat.LOOP, Scales(1, 1)).trail[0, 0] == pytest.approx(4 - 2 * step)
    assert len(dot_at(course, 2.0, Repeat.ONCE, Scales(1, 1)).trail) == TRAIL


def test_the_longest_arrow_is_a_quarter_of_the_curve():
    course = Course(LINE)
    dot = dot_at(course, 0.5, Repeat.LOOP, scales_of([course]))
    (velocity,) = (arrow for arrow in dot.arrows if arrow.kind is ArrowKind.VELOCITY)
    assert velocity.tip == pytest.approx((2.0, 0.0))


def test_cubic_and_quintic_are_compared_by_their_accelerations():
    view = view_of(sketch(velocity_rule=VelocityRule.CATMULL_ROM))
    rivals = rivals_of(view, BOTH)
    cubic, quintic = rivals.values()
    assert cubic is view
    assert quintic.source.family == QUINTIC_HERMITE
    assert [role.title for role in rivals] == ["Hermite", "Quintic"]
    courses = {ACTIVE: Course(view.curve), **{role: Course(each.curve) for role, each in rivals.items()}}
    own, *others = dots_at(courses, 0.4, Repeat.LOOP, scales_of(list(courses.values())))
    assert own.arrows == ()
    assert [[arrow.kind for arrow in dot.arrows] for dot in others] == [[ArrowKind.ACCELERATION]] * 2


def test_the_sentence_has_the_measured_jumps():
    # h = 1, v = (1, 0): y'' is 6 (0 - 1) = -6 before the middle and 6 (3 - 1) = 12 after it, x'' is 0.
    points = tuple(Point(float(i), y, velocity=(1.0, 0.0)) for i, y in enumerate((0.0, 1.0, 3.0)))
    rule = Parametrization(ParametrizationKind.UNIFORM, start=0.0, end=2.0)
    text = jump_sentences(rivals_of(view_of(sketch(points=points, parametrization=rule)), BOTH))
    assert text == (
        "Hermite: acceleration jumps at its joint, at point 1 by 18.0.  Quintic: no jump of acceleration."
    )


def test_without_a_jump_the_sentence_gives_the_reason():
    text = jump_sentences(rivals_of(view_of(sketch(velocity_rule=VelocityRule.NATURAL_SPLINE)), BOTH))
    assert text.startswith(
        "Hermite, Quintic: no jump of acceleration (its velocities are those of the natural spline"
    )


def test_a_jump_hidden_by_rounding_is_not_reported():
    points = tuple(
        Point(*place) for place in ((0.0, 0.0), (1.0, 1.0), (1.0 + 1e-12, 1.0), (2.0, 0.0), (3.0, 1.0))
    )
    curve = sketch(points=points, velocity_rule=VelocityRule.NATURAL_SPLINE)
    text = jump_sentences({ACTIVE: view_of(curve)})
    assert text.endswith("double precision does not decide whether the acceleration jumps at 2 of 3 joints.")


def test_two_points_have_no_joints():
    view = view_of(sketch(points=first_sketch().curves[0].points[:2]))
    assert jump_sentences(rivals_of(view, BOTH)) == "Hermite, Quintic: no joints."
    assert rivals_of(view_of(sketch(points=())), BOTH) == {}
    assert rivals_of(view, frozenset()) == {}


def test_a_velocity_that_is_longer_than_all_floats_scales_nothing():
    """A motion of enormous curves raised a warning of NumPy's."""
    assert usual_length(np.array([[3.0, 4.0], [1.5e308, 1.5e308]]), 2.0) == 5.0
