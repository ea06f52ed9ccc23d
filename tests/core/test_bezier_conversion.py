"""Control points of stretches of any curve, exactly."""

from fractions import Fraction

import numpy as np
import pytest

from curvecore import (
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    bezier_segments,
    bezier_stretch,
    chebyshev,
    elevate_degree,
    lagrange_to_bezier,
    uniform,
)
from tests.core.made_curves import de_casteljau
from tests.rows import each_row


@each_row("by", [0, 1, 2, 7])
def test_degree_elevation_keeps_the_curve(rng, by):
    controls = rng.standard_normal((4, 2))
    higher = elevate_degree(controls, by)
    assert higher.shape == (4 + by, 2)
    for s in (Fraction(0), Fraction(1, 3), Fraction(1)):
        # Convex combinations: one rounding of numbers near 1 for each degree.
        assert de_casteljau(higher, s) == pytest.approx(de_casteljau(controls, s), abs=1e-15)


def test_degree_elevation_of_a_line_in_closed_form():
    assert elevate_degree([[0.0, 3.0], [8.0, 3.0]], 3).tolist() == [[2.0 * k, 3.0] for k in range(5)]


@pytest.mark.parametrize("n", [2, 3, 8, 15])
def test_a_polynomial_in_bezier_form(rng, n):
    points, t = rng.standard_normal((n, 2)), np.sort(rng.random(n))
    curve = LagrangeCurve(points, t)
    found = lagrange_to_bezier(curve)
    assert found.control_points.shape == (n, 2)
    size = np.abs(found.control_points).max()
    for i, x in enumerate(t):
        s = (Fraction(x) - Fraction(t[0])) / (Fraction(t[-1]) - Fraction(t[0]))
        # Each control point is rounded once.
        assert de_casteljau(found.control_points, s) == pytest.approx(points[i], abs=1.2e-16 * size + 1e-16)


@pytest.mark.parametrize("t", [uniform(6), chebyshev(9), np.array([0.0, 0.1, 0.7, 2.0])])
def test_the_condition_number_is_that_of_the_matrix(t):
    n = len(t)
    s = (t - t[0]) / (t[-1] - t[0])
    k = np.arange(n)
    binomial = np.array([float(np.prod(np.arange(n - j, n)) / np.prod(np.arange(1, j + 1))) for j in k])
    matrix = binomial * s[:, None] ** k * (1.0 - s[:, None]) ** (n - 1 - k)
    found = lagrange_to_bezier(LagrangeCurve(np.zeros((n, 2)), t)).condition
    assert found == pytest.approx(np.linalg.cond(matrix, np.inf), rel=1e-9)


def test_errors_grow_by_the_condition_number_at_most():
    t = uniform(7)
    matrix = lagrange_to_bezier(LagrangeCurve(np.eye(7), t)).control_points
    worst = int(np.argmax(np.abs(matrix).sum(axis=1)))
    moved = lagrange_to_bezier(LagrangeCurve(np.sign(matrix[worst])[:, None], t))
    assert np.abs(moved.control_points).max() == pytest.approx(moved.condition, rel=1e-14)


def test_the_control_points_of_two_points_are_the_points():
    found = lagrange_to_bezier(LagrangeCurve([[0.0, 1.0], [2.0, 5.0]], [3.0, 4.5]))
    assert found.control_points.tolist() == [[0.0, 1.0], [2.0, 5.0]]
    assert found.condition == 1.0


def test_control_points_of_hermite_segments_and_of_parts(rng):
    t = np.array([0.0, 0.25, 1.0, 1.5])
    data = rng.standard_normal((3, 4, 2))
    for curve in (HermiteCurve(*data[:2], t), QuinticHermiteCurve(*data, t)):
        for i in range(3):
            whole = bezier_stretch(curve, t[i], t[i + 1])
            assert whole == pytest.approx(bezier_segments(curve)[i], abs=1e-15)
            part = bezier_stretch(curve, t[i] + 0.0625, t[i] + 0.125)
            assert part[0] == pytest.approx(curve.evaluate(t[i] + 0.0625), abs=1e-14)
            assert de_casteljau(part, Fraction(1, 2)) == pytest.approx(
                curve.evaluate(t[i] + 0.09375), abs=1e-14
            )


def test_pieces_of_a_chain_and_stretches_of_a_polynomial(rng):
    one = LagrangeCurve(rng.standard_normal((4, 2)), [0, 1, 2, 3])
    two = LagrangeCurve(np.vstack((one.points[-1:], rng.standard_normal((2, 2)))), [3, 4, 5])
    chain = Chain([one, two])
    assert (bezier_stretch(chain, 3.0, 4.0) == bezier_stretch(two, 3.0, 4.0)).all()
    middle = de_casteljau(bezier_stretch(one, 0.5, 1.5), Fraction(1, 2))
    assert middle == pytest.approx(one.evaluate(1.0), abs=1e-14)
    with pytest.raises(CurveError, match="no joint"):
        bezier_stretch(chain, 2.0, 4.0)


def test_unusable_arguments(rng):
    curve = HermiteCurve(*rng.standard_normal((2, 3, 2)), [0, 1, 2])
    with pytest.raises(CurveError, match=r"parameters\[1\] is inside the stretch"):
        bezier_stretch(curve, 0.5, 1.5)
    for pair in ((0.5, 0.5), (-1.0, 0.5), (1.5, 3.0)):
        with pytest.raises(CurveError, match="must ascend inside the domain"):
            bezier_stretch(curve, *pair)
    with pytest.raises(CurveError, match="must be a LagrangeCurve"):
        lagrange_to_bezier(curve)
    with pytest.raises(CurveError, match="at most 64 points"):
        lagrange_to_bezier(LagrangeCurve(np.zeros((65, 1)), uniform(65)))
    with pytest.raises(CurveError, match="by must be at least 0"):
        elevate_degree([[0.0], [1.0]], -1)
