"""A curve of one family written as one of another: the same curve at other data, or the reason why not."""

import numpy as np
import pytest

from curvecore import (
    BezierCurve,
    BSplineCurve,
    Chain,
    CurveError,
    FloaterHormannCurve,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    chebyshev,
    natural_spline_velocities,
    uniform,
)
from tests.rows import each_row

HERMITES = [HermiteCurve, QuinticHermiteCurve]


def times(n, seed=4):
    return np.cumsum(np.random.default_rng(seed).random(n) + 0.2)


def points(n, seed=5):
    return np.random.default_rng(seed).standard_normal((n, 2))


def off(first, second):
    t = np.linspace(*first.domain, 1001)
    assert first.domain == second.domain
    return np.abs(first.evaluate(t) - second.evaluate(t)).max() / np.abs(first.evaluate(t)).max()


@each_row("n", [2, 3, 4, 5, 9, 40])
@each_row("make", HERMITES)
def test_a_spline_has_joints_at_its_knots(make, n):
    spline = BSplineCurve(points(n), times(n))
    made = make.same_shape_as(spline)
    assert (made.parameters == spline.breaks).all()
    # Derivatives are differences of control points: a few roundings each.
    assert off(spline, made) < 1e-14


@each_row("n", [2, 3, 4, 9, 40])
def test_a_smooth_hermite_curve_is_a_spline(n):
    """The natural spline through points, whose accelerations do not jump."""
    t, p = times(n), points(n)
    curve = HermiteCurve(p, natural_spline_velocities(p, t), t)
    made = BSplineCurve.same_shape_as(curve)
    assert len(made.points) == n + 2
    assert (made.breaks == t).all()
    assert off(curve, made) < 1e-13
    # And back, to the data it was made of.
    back = HermiteCurve.same_shape_as(made)
    assert np.abs(back.jets - curve.jets).max() < 1e-12


def test_knots_far_closer_than_others():
    """Each control point comes from the longer of two pieces: the shorter one magnifies roundings by 1e6."""
    t = np.array([0.0, 1.0, 1.0 + 1e-6, 2.0, 3.5, 4.0])
    spline = BSplineCurve(points(8), np.sort(np.append(t, [0.5, 3.7])))
    made = BSplineCurve.same_shape_as(HermiteCurve.same_shape_as(spline))
    assert off(spline, made) < 1e-8


@pytest.mark.parametrize(("make", "most"), [(HermiteCurve, 4), (QuinticHermiteCurve, 6), (BSplineCurve, 4)])
def test_one_polynomial_of_low_degree_is_one_segment(make, most):
    for n in range(2, most + 1):
        curve = BezierCurve(points(n), times(n))
        made = make.same_shape_as(curve)
        assert off(curve, made) < 1e-14
        assert len(made.breaks) == 2
    too_high = BezierCurve(points(most + 1), times(most + 1))
    with pytest.raises(
        CurveError, match=f"polynomial of degree {most}, the pieces of a .* degree {most - 1}"
    ):
        make.same_shape_as(too_high)
    # A degree that was only raised is none: one more control point on a cubic.
    raised = BezierCurve(points(most), times(most)).refined(1.1)
    assert off(raised, make.same_shape_as(raised)) < 1e-13


@pytest.mark.parametrize("source", HERMITES)
def test_one_segment_is_a_bezier_curve(source):
    jets = np.random.default_rng(8).standard_normal((2, source.derivatives + 1, 2))
    curve = source.from_jets(jets, [1.0, 3.5])
    assert off(curve, BezierCurve.same_shape_as(curve)) < 1e-14
    assert off(curve, LagrangeCurve.same_shape_as(curve)) < 1e-14


@pytest.mark.parametrize("n", [2, 3, 7, 20])
def test_lagrange_and_bezier(n):
    """What rounds are the control points, and these are far away: 2e4 times as far as 20 points."""
    curve = LagrangeCurve(points(n), 3.0 * chebyshev(n))
    made = BezierCurve.same_shape_as(curve)
    size = np.abs(made.points).max() / np.abs(curve.points).max()
    assert off(curve, made) < 1e-15 * size
    # On the way back the Lebesgue constant of Chebyshev points comes to it, 3 at most.
    assert off(made, LagrangeCurve.same_shape_as(made)) < 3e-15 * size


def test_the_same_shape_keeps_a_bezier_curve_of_high_degree():
    curve = BezierCurve(points(60), times(60))
    assert off(curve, LagrangeCurve.same_shape_as(curve)) < 1e-12


def test_a_cubic_hermite_curve_is_quintic_where_nothing_jumps():
    t, p = times(9), points(9)
    smooth = HermiteCurve(p, natural_spline_velocities(p, t), t)
    made = QuinticHermiteCurve.same_shape_as(smooth)
    assert off(smooth, made) < 1e-14
    assert np.abs(HermiteCurve.same_shape_as(made).jets - smooth.jets).max() < 1e-12


def test_the_message_names_the_derivative_that_jumps():
    curve = HermiteCurve(points(4), points(4, 9), [0.0, 1.0, 2.5, 3.0])
    with pytest.raises(CurveError, match="its acceleration jumps at t = 1, and that of a"):
        BSplineCurve.same_shape_as(curve)


@pytest.mark.parametrize("make", [QuinticHermiteCurve, SepticHermiteCurve])
def test_where_a_derivative_jumps_pieces_meet_in_a_chain(make):
    t = np.array([0.0, 1.0, 2.5, 3.0])
    velocities = natural_spline_velocities(points(4), t)
    velocities[1] += (0.3, -0.2)
    curve = HermiteCurve(points(4), velocities, t)
    made = make.same_shape_as(curve)
    # The acceleration jumps at the changed velocity's own joint and at both beside it, if they are inside.
    assert [piece.domain for piece in made.pieces] == [(0.0, 1.0), (1.0, 2.5), (2.5, 3.0)]
    assert off(curve, made) < 1e-14
    assert all(type(piece) is make for piece in made.pieces)
    back = HermiteCurve.same_shape_as(made)
    assert off(curve, back) < 1e-14
    # Its velocity does not jump.
    assert type(back) is HermiteCurve


def test_a_spline_is_a_chain_of_septics_and_a_septic_of_low_degree_is_a_spline():
    t, p = times(6), points(6)
    spline = HermiteCurve(p, natural_spline_velocities(p, t), t)
    made = SepticHermiteCurve.same_shape_as(spline)
    # Its third derivative jumps at every joint.
    assert len(made.pieces) == 5
    assert off(spline, made) < 1e-14
    polynomial = LagrangeCurve(p, t)
    septic = SepticHermiteCurve.same_shape_as(polynomial)
    assert septic.points.shape == (2, 2)
    assert off(polynomial, septic) < 1e-13
    assert off(LagrangeCurve.same_shape_as(septic), polynomial) < 1e-12


def test_other_reasons():
    hermite = HermiteCurve(points(3), points(3, 9), [0.0, 1.0, 2.5])
    for make in (LagrangeCurve, BezierCurve):
        with pytest.raises(CurveError, match="is one polynomial from end to end, and this curve has 2"):
            make.same_shape_as(hermite)
    corner = Chain([hermite, HermiteCurve(points(2), points(2), [2.5, 4.0])])
    with pytest.raises(CurveError, match="has no corners inside, and this curve has 1"):
        BSplineCurve.same_shape_as(corner)
    many = LagrangeCurve(points(65), chebyshev(65))
    with pytest.raises(CurveError, match="known exactly"):
        BezierCurve.same_shape_as(many)


@each_row("degree", [1, 3, 5])
@each_row("n", [3, 7, 20, 60])
def test_a_degree_surely_beyond_the_limit_is_detected(n, degree):
    """Told without the exact control points; samples of a polynomial of the degree are left to these."""
    t = times(n)
    wild = LagrangeCurve(points(n), t)
    assert wild.surely_exceeds(degree) is (n - 1 > degree)
    sampled = BezierCurve(points(degree + 1), uniform(degree + 1)).evaluate((t - t[0]) / (t[-1] - t[0]))
    assert not LagrangeCurve(sampled, t).surely_exceeds(degree)
    huge = LagrangeCurve(points(n) * 1e150, t * 1e-150)
    assert huge.surely_exceeds(degree) is (n - 1 > degree)


def test_check_shape_refuses_without_writing_the_curve():
    """A jerk that jumps where the acceleration does not is a reason, which no corner is made for."""
    t, p = times(6), points(6)
    spline = HermiteCurve(p, natural_spline_velocities(p, t), t)
    with pytest.raises(CurveError, match="its jerk jumps at 4 joints, and that of a septic Hermite curve"):
        SepticHermiteCurve.check_shape(spline)
    jumping = HermiteCurve(p, points(6, 9), t)
    for make in (QuinticHermiteCurve, SepticHermiteCurve):
        make.check_shape(jumping)
    with pytest.raises(CurveError, match="its acceleration jumps"):
        BSplineCurve.check_shape(jumping)
    QuinticHermiteCurve.check_shape(spline)
    BezierCurve.check_shape(LagrangeCurve(p, t))
    rational = FloaterHormannCurve(p, t)
    for make in (LagrangeCurve, BezierCurve, HermiteCurve, BSplineCurve):
        with pytest.raises(CurveError, match="does not consist of polynomials, and a"):
            make.check_shape(rational)
    assert HermiteCurve.follows
    assert not BSplineCurve.follows
