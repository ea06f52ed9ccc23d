"""Jumps at joints are the ones that were built in."""

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest

from curvecore import (
    BSplineCurve,
    Chain,
    CubicSplineCurve,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    catmull_rom_velocities,
    chord_length,
    joint_report,
    natural_spline_velocities,
    uniform,
)
from tests.rows import each_row

T = np.array([0.0, 1.0, 2.5, 3.0, 4.0])
POINTS = np.array([[0, 0], [1, 2], [3, 1], [4, 4], [5, 0]], dtype=float)
ORIGIN = np.zeros(2)


def joined(before, after):
    """Two quintics that meet at t = 0 with the given point, velocity and acceleration on each side."""
    far = [ORIGIN + 1.0, ORIGIN + 1.0, ORIGIN]
    left = QuinticHermiteCurve(*zip(far, before, strict=True), [-1.0, 0.0])
    right = QuinticHermiteCurve(*zip(after, far, strict=True), [0.0, 1.0])
    (joint,) = joint_report(Chain([left, right]))
    return joint


P, V, A = np.array([2.0, 1.0]), np.array([3.0, 4.0]), np.array([-1.0, 2.0])


@each_row(
    ("after", "label", "parametric", "geometric"),
    [
        ((P, V, A), "C2", 2, 2),
        ((P, V, np.add(A, [1.0, 0.0])), "C1", 1, 1),
        # An acceleration along the velocity changes the speed and not the curvature.
        ((P, V, A + 2.0 * V), "C1, G2", 1, 2),
        ((P, 2.0 * V, A), "C0, G1", 0, 1),
        # c(2 t): velocity twice, acceleration four times.
        ((P, 2.0 * V, 4.0 * A), "C0, G2", 0, 2),
        ((P, [4.0, -3.0], A), "C0", 0, 0),
        ((P, -V, A), "C0", 0, 0),
        ((np.add(P, [0.0, 0.5]), V, A), "break", -1, -1),
    ],
)
def test_the_class_that_was_built_in(after, label, parametric, geometric):
    joint = joined((P, V, A), after)
    assert (joint.label, joint.parametric, joint.geometric) == (label, parametric, geometric)
    assert joint.point_jump == pytest.approx(np.subtract(after[0], P), abs=1e-15)
    assert joint.velocity_jump == pytest.approx(np.subtract(after[1], V), abs=1e-14)
    assert joint.acceleration_jump == pytest.approx(np.subtract(after[2], A), abs=1e-14)
    assert (joint.joint, joint.parameter) == (1, 0.0)


J = np.array([0.5, -3.0])


def joined_septics(before, after):
    """The same of two septics, with the jerk on each side."""
    far = [np.resize(number, len(before[0])) for number in (1.0, 1.0, 0.0, 0.0)]
    left = SepticHermiteCurve(*zip(far, before, strict=True), [-1.0, 0.0])
    right = SepticHermiteCurve(*zip(after, far, strict=True), [0.0, 1.0])
    (joint,) = joint_report(Chain([left, right]))
    return joint


@each_row("dim", [2, 3])
@each_row(
    ("change", "label"),
    [
        ((1.0, 0.0, 0.0), "C3"),
        # c(phi(t)) with phi' = b1, phi'' = b2, phi''' = b3: the line goes on, the motion does not.
        ((1.0, 0.0, 2.0), "C2, G3"),
        ((1.0, -1.5, 2.0), "C1, G3"),
        ((2.0, 0.5, -1.0), "C0, G3"),
    ],
)
def test_third_order_contact_is_detected(dim, change, label):
    """The chain rule of Barsky and DeRose: beta constraints of the third order."""
    p, v, a, j = (np.resize(x, dim) + 0.25 * np.arange(dim) for x in (P, V, A, J))
    b1, b2, b3 = change
    after = (p, b1 * v, b1**2 * a + b2 * v, b1**3 * j + 3.0 * b1 * b2 * a + b3 * v)
    assert joined_septics((p, v, a, j), after).label == label
    across = np.zeros(dim)
    across[:2] = -v[1], v[0]
    other = joined_septics((p, v, a, j), (*after[:3], after[3] + 0.01 * across))
    assert other.label == {"C3": "C2", "C2, G3": "C2", "C1, G3": "C1, G2", "C0, G3": "C0, G2"}[label]
    assert other.jerk_jump == pytest.approx(after[3] + 0.01 * across - j, rel=1e-12)


def test_septics_are_three_times_continuous(rng):
    curve = SepticHermiteCurve(POINTS, *rng.standard_normal((3, 5, 2)), T)
    assert [joint.label for joint in joint_report(curve)] == ["C3"] * 3


@each_row("angle", [1e-12, 1e-6, 0.1, 1.0, 3.0, np.pi])
def test_angles(angle):
    turned = [np.cos(angle) * 3.0 - np.sin(angle) * 4.0, np.sin(angle) * 3.0 + np.cos(angle) * 4.0]
    joint = joined((P, V, A), (P, turned, A))
    assert joint.angle == pytest.approx(angle, abs=1e-15)
    assert joint.geometric >= 1 if angle < 1e-9 else joint.geometric == 0


def test_curvatures_on_both_sides():
    joint = joined((P, V, A), (P, V, [-2.0, 2.0]))
    assert joint.curvature_before == pytest.approx((3.0 * 2.0 + 4.0) / 125.0)
    assert joint.curvature_after == pytest.approx((3.0 * 2.0 + 8.0) / 125.0)
    assert joint.curvature_jump == pytest.approx(4.0 / 125.0)


@pytest.mark.parametrize("shift", [0.0, 1e3])
def test_splines_are_twice_continuous_and_catmull_rom_is_not(shift):
    spline = HermiteCurve(POINTS + shift, natural_spline_velocities(POINTS, T), T)
    assert [joint.label for joint in joint_report(spline)] == ["C2"] * 3
    rom = HermiteCurve(POINTS + shift, catmull_rom_velocities(POINTS, T), T)
    assert [joint.label for joint in joint_report(rom)] == ["C1"] * 3


def test_reported_jumps_match_the_pieces(rng):
    curve = HermiteCurve(POINTS, rng.standard_normal((5, 2)), T)
    for joint in joint_report(curve):
        i = joint.joint
        left = HermiteCurve(POINTS[i - 1 : i + 1], curve.jets[i - 1 : i + 1, 1], T[i - 1 : i + 1])
        jump = curve.evaluate(T[i], 2) - left.evaluate(T[i], 2)
        assert joint.acceleration_jump == pytest.approx(jump, rel=1e-12)
        assert (joint.velocity_jump == 0.0).all()


def test_one_polynomial_is_smooth_at_its_points():
    report = joint_report(LagrangeCurve(POINTS, T))
    assert [joint.label for joint in report] == ["C3"] * 3
    assert all((jump == 0.0).all() for joint in report for jump in joint.jumps)
    assert joint_report(LagrangeCurve(POINTS[:2], T[:2])) == []


def test_a_closed_curve_has_one_joint_more():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 0]], dtype=float)
    curve = HermiteCurve(square, [[1, 1], [0, 1], [-1, 0], [2, 2]], uniform(4))
    last = joint_report(curve, closed=True)[-1]
    assert (last.joint, last.label) == (0, "C0, G1")
    assert last.velocity_jump.tolist() == [-1.0, -1.0]


def test_a_point_at_rest_has_no_direction():
    joint = joined((P, ORIGIN, A), (P, ORIGIN, A))
    assert np.isnan(joint.angle)
    assert np.isnan(joint.curvature_before)
    assert (joint.parametric, joint.geometric) == (2, 0)


def test_space_and_line():
    for dim in (1, 3):
        curve = HermiteCurve(np.ones((3, dim)) * [[0], [1], [3]], np.ones((3, dim)), uniform(3))
        (joint,) = joint_report(curve)
        assert joint.parametric == 1
        assert np.isnan(joint.curvature_jump) if dim == 1 else joint.curvature_jump == pytest.approx(0.0)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_the_tolerance_is_relative(tolerance):
    for scale in (1e-100, 1.0, 1e100):
        for share, smooth in ((0.1, True), (10.0, False)):
            shifted = natural_spline_velocities(POINTS, T)
            shifted[2] += share * tolerance * np.array([3.0, 1.0])
            pieces = [
                HermiteCurve(scale * POINTS[:3], scale * natural_spline_velocities(POINTS, T)[:3], T[:3]),
                HermiteCurve(scale * POINTS[2:], scale * shifted[2:], T[2:]),
            ]
            joint = joint_report(Chain(pieces), tolerance)[1]
            assert (joint.parametric >= 1) == smooth


def test_unusable_arguments():
    with pytest.raises(CurveError, match="tolerance"):
        joint_report(LagrangeCurve(POINTS, T), 0.0)


def exact_ratio(v, w):
    """|w| / |v| to well below a rounding, by exact squares."""
    squares = [sum(Fraction(float(each)) ** 2 for each in vector) for vector in (v, w)]
    scale = 10**40
    return Fraction(isqrt(int(squares[1] / squares[0] * scale**2)), scale)


@each_row("factor", [0.1, 1 / 3, 1.0, 1.8, 7.3, 1e3])
@each_row("direction", [(1.0, 0.0), (0.3, 0.7), (-1e-3, 0.999), (3.0, -4.0)])
@each_row("make", ["cubic", "quintic", "septic"])
def test_a_joint_with_a_jump_of_speed_keeps_the_direction(make, direction, factor):
    """Tied velocities: what is measured is what exact fractions say of the data."""
    before, after = np.array(direction), factor * np.array(direction)
    orders = {"cubic": 1, "quintic": 2, "septic": 3}[make]
    family = {"cubic": HermiteCurve, "quintic": QuinticHermiteCurve, "septic": SepticHermiteCurve}[make]
    rest = [np.zeros((2, 2))] * (orders - 1)
    left = family([[-1.0, -1.0], [0.0, 0.0]], [[1.0, 1.0], before], *rest, [0.0, 0.4])
    right = family([[0.0, 0.0], [2.0, 1.0]], [after, [1.0, 0.0]], *rest, [0.4, 1.0])
    (joint,) = joint_report(Chain([left, right]))
    cross, dot = (
        Fraction(before[0]) * Fraction(after[1]) - Fraction(before[1]) * Fraction(after[0]),
        sum(Fraction(a) * Fraction(b) for a, b in zip(before, after, strict=True)),
    )
    # Two roundings of the product in each coordinate; the unit vectors add two more.
    assert abs(joint.angle - float(cross / dot)) < 6 * 2.0**-53
    assert joint.speed_ratio == pytest.approx(float(exact_ratio(before, after)), rel=8 * 2.0**-53)
    assert joint.geometric >= 1
    assert joint.label.startswith("C0, G" if factor != 1.0 else "C")


def test_the_speed_of_a_curve_at_rest_has_no_ratio():
    at_rest = HermiteCurve([[0, 0], [1, 0], [2, 0]], [[1, 0], [0, 0], [1, 0]], [0, 1, 2])
    (joint,) = joint_report(at_rest)
    assert np.isnan(joint.speed_ratio)
    corner = Chain(
        [
            HermiteCurve([[0, 0], [1, 0]], [[1, 0], [1, 0]], [0, 1]),
            HermiteCurve([[1, 0], [1, 1]], [[0, 1], [0, 1]], [1, 2]),
        ]
    )
    # A corner that is run through at one speed.
    assert joint_report(corner)[0].speed_ratio == 1.0


@pytest.mark.parametrize("exponent", [10, 20, 30, 40])
def test_the_acceleration_jumps_by_24_beside_a_short_piece(exponent):
    """It was C3 there: the jump is below 1e-9 of the terms of c'', which are some 6 / gap."""
    gap = 2.0**-exponent
    points = [[0, 0], [1, 1], [1 + 2 * gap, 1], [2, 0]]
    curve = HermiteCurve(points, [[2, 0]] * 4, [0, 0.5, 0.5 + gap, 1])
    joints = joint_report(curve)
    assert [joint.label for joint in joints] == ["C1", "C1"]
    last = -6.0 / (0.5 - gap) ** 2
    assert [joint.acceleration_jump.tolist() for joint in joints] == [[0, 24], [0, pytest.approx(last)]]


def test_the_curvature_changes_otherwise_behind_a_joint_by_28_percent():
    """dκ/ds jumps from 1.7346 to 2.2273 (300 bits), which was G3."""
    points = np.array([[0, 0], [1, 1], [1.0001, 1], [2, 0]])
    t = chord_length(points)
    joints = joint_report(HermiteCurve(points, natural_spline_velocities(points, t), t))
    assert [joint.label for joint in joints] == ["C2", "C2"]


@pytest.mark.parametrize("far", [1e5, 1e9, 1e12])
def test_a_b_spline_that_is_moved_is_as_smooth_as_before(far):
    """Moved by 1e5 it was G3."""
    points = np.array([[0, 0], [1, 2], [3, 2], [4, 0], [6, 1], [7, 3]], dtype=float)
    labels, moved = (
        [joint.label for joint in joint_report(BSplineCurve(points + way, uniform(6)))] for way in (0.0, far)
    )
    assert labels == moved == ["C3", "C2", "C2", "C3"]


def test_not_a_knot_joints_have_no_jump():
    """The jerk jumped at the last joint, by what the velocities are rounded by."""
    points = [[0, 3], [0, -1], [-4, 0], [-4.003, -0.002], [3, -3]]
    curve = CubicSplineCurve(points, chord_length(points), ends="not_a_knot")
    assert [joint.label for joint in joint_report(curve)] == ["C3", "C2", "C3"]


def near_points(gap):
    points = np.array([[0, 0], [1, 1], [1 + gap, 1], [2, 0]])
    t = chord_length(points)
    return HermiteCurve(points, natural_spline_velocities(points, t), t)


def test_a_class_hidden_by_rounding_is_left_open():
    """Velocities of the natural spline: c'' goes on, but 1e-12 apart nobody sees that in doubles."""
    for joint in joint_report(near_points(1e-12)):
        assert (joint.label, joint.parametric, joint.geometric) == ("≥C1", 1, 1)
        assert joint.is_parametric_open
        assert joint.is_geometric_open
        assert 0.0 < np.linalg.norm(joint.acceleration_jump) < joint.roundings[2] < 1.0


@each_row(
    ("size", "duration", "label"),
    [(1e-100, 1e50, "C2"), (1e100, 1e-50, "C2"), (1e-140, 1e90, "≥C1"), (1e300, 1.0, "C2, ≥G2")],
)
def test_beyond_the_range_of_doubles_nothing_is_certain(size, duration, label):
    """The jerk of the third is 1e-410, and dκ/ds of the last 1e-600: they were C3 and G3."""
    curve = CubicSplineCurve(size * POINTS, duration * T)
    assert {joint.label for joint in joint_report(curve)} == {label}


@each_row(
    ("orders", "is_open", "label"),
    [
        ((1, 1), (True, True), "≥C1"),
        ((1, 2), (True, False), "≥C1, G2"),
        ((1, 2), (True, True), "≥C1, ≥G2"),
        ((1, 1), (False, True), "C1, ≥G1"),
        ((2, 0), (False, True), "C2"),
        ((-1, -1), (False, False), "break"),
    ],
)
def test_labels_mark_classes_that_are_left_open(orders, is_open, label):
    (joint,) = joint_report(HermiteCurve(POINTS[:3], POINTS[:3], T[:3]))
    names = ("parametric", "geometric", "is_parametric_open", "is_geometric_open")
    assert joint._replace(**dict(zip(names, (*orders, *is_open), strict=True))).label == label


def test_a_rest_decides_nothing_about_the_acceleration():
    """There is no direction, so that none goes on; c'' is 0 on both sides, of terms of 6 / gap."""
    gap = 2.0**-40
    points = [[0, 0], [1, 0], [1 + gap, 0], [2, 0]]
    joint, _ = joint_report(HermiteCurve(points, [[6, 0], [0, 0], [3, 0], [2, 0]], [0, 0.5, 0.5 + gap, 1]))
    assert (joint.label, joint.geometric, joint.acceleration_jump.tolist()) == ("≥C1", 0, [0, 0])


@pytest.mark.parametrize("share", [1e-30, 1e-16, 1e-11])
def test_a_speed_below_the_tolerance_is_a_rest(share):
    """A cusp whose velocity is left of the rounding of a rule had a direction, that of the rounding."""
    curve = HermiteCurve([[0, 0], [1, 0], [0, 1]], [[2, 0], [share, share], [0, -2]], [0, 1, 2])
    (joint,) = joint_report(curve)
    assert (joint.label, joint.geometric) == ("C1", 0)
    assert np.isnan([joint.angle, joint.speed_ratio, joint.curvature_after, joint.curvature_jump]).all()
