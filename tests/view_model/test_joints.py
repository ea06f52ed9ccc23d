"""The joint certificate, compared with joints made by hand."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import point_edits
from app.document.derivatives import AccelerationRule, VelocityRule
from app.document.model import Curve, Document, Parametrization, Point, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.analysis import joints
from app.view_model.analysis.joints import JointKind, as_text, certificate_of
from app.view_model.curve.curve_view import view_of
from app.view_model.point_kinds import with_smooth_points
from curvecore import joint_report
from tests.rows import each_row

POINTS = ((0.0, 0.0), (1.0, 1.0), (2.0, 0.5), (3.0, 1.5), (4.0, 0.0))


def certificate(points=None, family=HERMITE, **fields):
    points = points or [Point(x, y) for x, y in POINTS]
    return certificate_of(view_of(Curve("Test", family, Parametrization(), tuple(points), **fields)))


def with_point(index, **fields):
    points = [Point(x, y) for x, y in POINTS]
    points[index] = Point(*POINTS[index], **fields)
    return points


def test_a_spline_is_smooth_everywhere():
    result = certificate(velocity_rule=VelocityRule.NATURAL_SPLINE)
    assert result.summary == "C² everywhere."
    assert [row.joint for row in result.rows] == [1, 2, 3]
    assert all(row.kind is JointKind.SMOOTH and row.jumps[:3] == (0, 0, 0) for row in result.rows)
    assert all(row.angle == 0 and row.curvature == 0 for row in result.rows)


def test_estimated_cubics_jump_in_the_acceleration():
    result = certificate(velocity_rule=VelocityRule.BESSEL)
    assert result.summary == "C¹ everywhere."
    for row in result.rows:
        assert row.kind is JointKind.ACCELERATION
        assert row.jumps[:2] == (0, 0)
        assert row.jumps[2] > 0


def test_the_sizes_of_jumps_are_measured():
    """Speed 2 before and 6 after, in the same direction."""
    points = with_point(2, velocity=(2.0, 0.0), corner=True, velocity_after=(6.0, 0.0))
    row = certificate(points).rows[1]
    assert (row.kind, row.smoothness) == (JointKind.SPEED, "C⁰, G¹")
    assert row.jumps[1] == pytest.approx(4.0)
    assert row.angle == 0.0


@pytest.mark.parametrize(
    ("degrees", "text"),
    [(0.0, "0°"), (6.56e-15, "<0.001°"), (0.0123, "0.0123°"), (72.34, "72.3°"), (110.0, "110°")],
)
def test_an_angle_has_no_exponent(degrees, text):
    assert joints.angle_text(degrees) == text


def test_a_corner_has_an_angle_and_a_name_in_the_summary():
    points = with_point(2, velocity=(2.0, 0.0), corner=True, velocity_after=(0.0, 2.0))
    result = certificate(points, QUINTIC_HERMITE)
    row = result.rows[1]
    assert (row.kind, row.smoothness) == (JointKind.CORNER, "C⁰")
    assert row.angle == pytest.approx(90.0)
    assert row.jumps[1] == pytest.approx(math.hypot(2, 2))
    assert result.summary == "C² everywhere except joint 2: C⁰ (corner)."


def test_a_joint_that_keeps_the_direction_is_called_g1():
    """Accelerations that are zero on both sides: curvature and acceleration do not jump, the speed does."""
    points = with_point(
        2,
        velocity=(2.0, 0.0),
        acceleration=(0.0, 0.0),
        corner=True,
        velocity_after=(6.0, 0.0),
        acceleration_after=(0.0, 1.0),
    )
    result = certificate(points, QUINTIC_HERMITE)
    assert result.summary == "C² everywhere except joint 2: G¹."
    assert result.rows[1].curvature == pytest.approx(1 / 36)


def test_a_joint_at_rest_has_no_direction():
    result = certificate(with_point(2, velocity=(0.0, 0.0)), QUINTIC_HERMITE)
    row = result.rows[1]
    assert result.summary == "C² everywhere; stands still at joint 2."
    assert row.kind is JointKind.REST
    assert math.isnan(row.angle)
    assert "velocity is zero" in row.words


def test_a_joint_at_rest_on_one_side_is_named_with_its_class():
    """It was “except joint 2: stands still” beside a velocity that jumped by 14.2."""
    rest = {"velocity": (0.0, 0.0), "corner": True, "velocity_after": (0.0, -14.2)}
    result = certificate(with_point(2, **rest), QUINTIC_HERMITE)
    assert result.rows[1].smoothness == "C⁰"
    assert result.rows[1].jumps[1] == pytest.approx(14.2)
    assert result.summary == "C² everywhere except joint 2: stands still on one side (C⁰)."


def test_many_rough_joints_are_counted():
    points = [Point(float(i), (i * 7 % 5) / 2) for i in range(12)]
    for index in range(1, 5):
        points[index] = Point(
            points[index].x, points[index].y, velocity=(3.0, 0.0), corner=True, velocity_after=(0.0, 3.0)
        )
    result = certificate(points, QUINTIC_HERMITE, acceleration_rule=AccelerationRule.ZERO)
    assert result.summary == "C² everywhere except at 4 of 10 joints."


def test_the_joint_where_a_curve_closes_comes_last():
    result = certificate(closed=True)
    assert [row.joint for row in result.rows] == [1, 2, 3, 4, 0]
    assert result.rows[-1].position == POINTS[0]
    assert result.summary == "C² everywhere."


def test_one_polynomial_has_no_joints_and_neither_has_one_piece():
    assert certificate(family=LAGRANGE).rows == ()
    assert "One polynomial" in certificate(family=LAGRANGE).summary
    assert certificate([Point(0.0, 0.0), Point(1.0, 1.0)]).rows == ()
    assert certificate([Point(0.0, 0.0)]).summary == "A curve needs at least two points."


def test_a_close_up_reaches_as_far_as_the_nearer_neighbour():
    reaches = [row.reach for row in certificate().rows]
    lengths = [math.dist(a, b) for a, b in pairwise(POINTS)]
    assert reaches == pytest.approx([min(pair) for pair in pairwise(lengths)])


def test_the_text_is_a_table_with_exact_numbers():
    result = certificate(velocity_rule=VelocityRule.BESSEL)
    summary, head, *lines = as_text(result).splitlines()
    assert summary == result.summary
    assert len(lines) == 3
    assert all(len(line.split("\t")) == len(head.split("\t")) == 10 for line in lines)
    for order in (2, 3):
        assert [float(line.split("\t")[3 + order]) for line in lines] == [
            row.jumps[order] for row in result.rows
        ]
    assert all(row.jumps[3] > 0 for row in result.rows)


NEAR = [Point(0.0, 0.0), Point(1.0, 1.0), Point(1.0 + 1e-12, 1.0), Point(2.0, 0.0), Point(3.0, 1.0)]
"""Two points so near that accelerations of velocities that a rule estimates are rounding."""


def test_a_jump_hidden_by_rounding_is_undecided():
    result = certificate(NEAR)
    assert result.summary == "≥C¹ everywhere."
    for row in result.rows[:2]:
        assert (row.kind, row.kind.value, row.smoothness) == (JointKind.UNDECIDED, "?", "≥C¹")
        assert row.words.startswith(
            "The velocity is continuous. Double precision does not decide whether the acceleration "
            "is continuous: "
            "rounding alone can make it jump by 0."
        )
        assert row.jumps[:2] == (0.0, 0.0)
        assert math.isnan(row.jumps[2])
        assert math.isnan(row.curvature)
        assert row.angle == 0.0
    assert result.rows[2].kind is JointKind.SMOOTH
    *lines, last = [line.split("\t") for line in as_text(result).splitlines()[2:]]
    for line in lines:
        assert line[2:6] == ["≥C¹", "0.0", "0.0", "?"]
        assert line[7:] == ["0.0", "?", "1.0"]
    assert "?" not in last
    assert "nan" not in as_text(result)


def test_a_class_that_is_less_decided_is_named_in_the_summary():
    result = certificate([*NEAR, *(Point(4.0 + i, 0.5 * (i % 3)) for i in range(4))])
    assert result.summary == "C² everywhere except joint 1: ≥C¹; joint 2: ≥C¹."


def test_a_rest_has_no_numbers_of_a_direction():
    text = as_text(certificate(with_point(2, velocity=(0.0, 0.0)), QUINTIC_HERMITE))
    assert text.splitlines()[3].split("\t")[7:] == ["–", "–", "–"]


UNDECIDED = "Double precision does not decide"


@each_row(
    ("orders", "is_open", "kind", "words"),
    [
        (
            (1, 1),
            (True, True),
            JointKind.UNDECIDED,
            f"The velocity is continuous. {UNDECIDED} whether the acceleration is continuous:",
        ),
        (
            (0, 0),
            (True, True),
            JointKind.UNDECIDED,
            f"The curve is continuous. {UNDECIDED} whether the velocity is continuous:",
        ),
        (
            (2, 2),
            (True, True),
            JointKind.SMOOTH,
            f"Velocity and acceleration are continuous. {UNDECIDED} whether the jerk is continuous:",
        ),
        (
            (0, 0),
            (False, True),
            JointKind.UNDECIDED,
            f"The curve is continuous, the velocity jumps. {UNDECIDED} whether the direction is continuous.",
        ),
        (
            (1, 1),
            (False, True),
            JointKind.ACCELERATION,
            f"The velocity is continuous, the acceleration jumps. "
            f"{UNDECIDED} whether the curvature is continuous.",
        ),
        (
            (3, 0),
            (False, True),
            JointKind.SMOOTH,
            f"Velocity and acceleration are continuous. {UNDECIDED} whether the direction is continuous.",
        ),
    ],
)
def test_every_undecided_case_has_its_sentence(monkeypatch, orders, is_open, kind, words):
    names = ("parametric", "geometric", "is_parametric_open", "is_geometric_open")
    fields = dict(zip(names, (*orders, *is_open), strict=True))
    monkeypatch.setattr(
        joints,
        "joint_report",
        lambda *args, **kinds: [j._replace(**fields) for j in joint_report(*args, **kinds)],
    )
    row = certificate(velocity_rule=VelocityRule.BESSEL).rows[0]
    assert row.kind is kind
    assert row.words.startswith(words)
    assert (math.isnan(row.angle), row.measured == "") == (orders[1] == 0, orders[1] == 0)
    assert math.isnan(row.curvature) == (orders[1] <= 1)


@each_row("family", [family for family in FAMILIES if family.derivatives])
@each_row("closed", [False, True])
def test_a_smooth_point_is_certified_and_measured(family, closed):
    """Also where a closed curve returns to its start, and whatever the accelerations are."""
    places = [(0.0, 0.0), (2.0, 3.0), (5.0, 2.0), (4.0, -1.0)]
    before = view_of(replace(make_curve(places, family=family), closed=closed))
    made = with_smooth_points(before, range(4))
    (vx, vy), index = made.points[1].velocity, 0 if closed else 1
    document = point_edits.set_velocity(
        Document((made,)), 0, index, (3 * vx - vy, 3 * vy + 2 * vx), ahead=True
    )
    view = view_of(document.curves[0])
    row = next(row for row in certificate_of(view).rows if row.joint == index)
    assert row.smoothness.startswith("C⁰, G¹")
    point = view.source.points[index]
    assert row.speed_ratio == pytest.approx(np.hypot(*point.velocity_after) / np.hypot(*point.velocity))
    assert row.measured.startswith("∠ ")
    assert float(row.measured.removeprefix("∠ ").partition("°")[0].replace("−", "-")) < 1e-9
    assert row.measured.endswith(f"speeds 1 : {row.speed_ratio:.4g}")
    others = {row.smoothness for row in certificate_of(view).rows if row.joint != index}
    assert all(each.startswith(("C¹", "C²", "C³")) for each in others)
