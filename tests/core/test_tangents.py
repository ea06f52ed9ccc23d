from itertools import pairwise

import numpy as np
import pytest

from curvecore import (
    CurveError,
    HermiteCurve,
    akima_velocities,
    bessel_velocities,
    catmull_rom_velocities,
    centripetal,
    chord_length,
    finite_difference_velocities,
    monotone_velocities,
    natural_spline_accelerations,
    natural_spline_jerks,
    natural_spline_velocities,
    uniform,
    zero_accelerations,
)
from tests.rows import each_row

T = np.array([0.0, 0.1, 0.5, 0.6, 2.0, 2.5])
VELOCITIES = [
    monotone_velocities,
    akima_velocities,
    finite_difference_velocities,
    bessel_velocities,
    natural_spline_velocities,
    lambda points, t: catmull_rom_velocities(points, t, 0.0),
    lambda points, t: catmull_rom_velocities(points, t, 0.5),
]
every_rule = pytest.mark.parametrize("rule", VELOCITIES)


@every_rule
def test_two_points_give_the_line(rule):
    assert (rule([[0.0, 1.0], [3.0, 5.0]], [1.0, 3.0]) == [[1.5, 2.0], [1.5, 2.0]]).all()


@each_row("rule", VELOCITIES[:6])
def test_straight_lines_at_constant_velocity(rule):
    """Catmull-Rom with knots other than the parameters keeps the direction only."""
    points = np.outer(T, [3.0, -2.0]) + np.array([1.0, 1.0])
    assert rule(points, T) == pytest.approx(np.tile([3.0, -2.0], (6, 1)), rel=1e-13)


@every_rule
@each_row("scale", [1e-150, 1e150])
def test_velocities_scale(rule, rng, scale):
    points = rng.standard_normal((6, 2))
    assert rule(points, scale * T) * scale == pytest.approx(rule(points, T), rel=1e-12)
    assert rule(scale * points, T) / scale == pytest.approx(rule(points, T), rel=1e-12)


def test_finite_difference_is_the_mean_of_the_chords(rng):
    points = rng.standard_normal((6, 2))
    slope = np.diff(points, axis=0) / np.diff(T)[:, None]
    velocities = finite_difference_velocities(points, T)
    assert velocities[1:-1] == pytest.approx((slope[:-1] + slope[1:]) / 2, rel=1e-14)
    assert (velocities[[0, -1]] == slope[[0, -1]]).all()


def test_bessel_is_exact_for_parabolas():
    points = np.stack((T**2, 3.0 - T + 2.0 * T**2), axis=1)
    expected = np.stack((2.0 * T, 4.0 * T - 1.0), axis=1)
    assert bessel_velocities(points, T) == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_classical_catmull_rom(rng):
    points = rng.standard_normal((6, 2))
    velocities = catmull_rom_velocities(points, uniform(6), 0.0)
    assert velocities[1:-1] == pytest.approx(2.5 * (points[2:] - points[:-2]), rel=1e-13)


@pytest.mark.parametrize(("alpha", "rule"), [(0.5, centripetal), (1.0, chord_length)])
def test_catmull_rom_on_its_own_knots_is_bessel(rng, alpha, rule):
    points = rng.standard_normal((20, 3))
    t = 7.0 * rule(points)
    expected = bessel_velocities(points, t)
    assert catmull_rom_velocities(points, t, alpha) == pytest.approx(expected, rel=1e-10, abs=1e-10)


def test_catmull_rom_names_coincident_points():
    points = [[0.0, 0.0], [1.0, 1.0], [1.0, 1.0]]
    with pytest.raises(CurveError, match="points 1 and 2 coincide; Catmull-Rom"):
        catmull_rom_velocities(points, uniform(3))
    assert np.isfinite(catmull_rom_velocities(points, uniform(3), 0.0)).all()


@each_row("n", [2, 3, 4, 5, 33, 64, 65, 1000])
def test_natural_spline_against_scipy(rng, n):
    from scipy.interpolate import CubicSpline

    # Spacing over six decades; the system is diagonally dominant, with a condition number below 3.
    t = np.cumsum(10.0 ** rng.uniform(-6, 0, n))
    points = rng.standard_normal((n, 2))
    spline = CubicSpline(t, points, bc_type="natural")
    velocities = natural_spline_velocities(points, t)
    slopes = np.abs(np.diff(points, axis=0) / np.diff(t)[:, None]).max()
    assert np.abs(velocities - spline(t, 1)).max() <= 1e-13 * slopes
    accelerations = natural_spline_accelerations(points, t)
    # From SciPy only: its own accelerations come from differences of velocities and lose digits.
    curve = HermiteCurve(points, velocities, t)
    h = np.diff(t)
    assert np.abs((accelerations[:-1] - curve.evaluate(t[:-1], 2)) * h[:, None]).max() <= 1e-11 * slopes
    assert (accelerations[[0, -1]] == 0.0).all()


def test_natural_spline_is_twice_differentiable(rng):
    points = rng.standard_normal((6, 2))
    curve = HermiteCurve(points, natural_spline_velocities(points, T), T)
    left = curve.evaluate(np.nextafter(T[1:-1], -1.0), 2)
    assert left == pytest.approx(curve.evaluate(T[1:-1], 2), rel=1e-9, abs=1e-9)
    assert natural_spline_accelerations(points, T)[1:-1] == pytest.approx(left, rel=1e-9, abs=1e-9)


def test_natural_spline_of_ten_thousand_points(rng):
    t = np.sort(rng.random(10_000))
    points = np.stack((np.cos(t), t), axis=1)
    expected = np.stack((-np.sin(t), np.ones_like(t)), axis=1)
    # Inside, the error is of third order in a spacing of at most 2e-3.
    assert np.abs(natural_spline_velocities(points, t) - expected)[100:-100].max() < 1e-8


def test_zero_accelerations():
    assert zero_accelerations([[1, 2], [3, 4], [5, 6]]).tolist() == [[0.0, 0.0]] * 3


@each_row("rule", [*VELOCITIES, natural_spline_accelerations])
def test_unusable_input(rule):
    with pytest.raises(CurveError, match="strictly increasing"):
        rule([[0.0], [1.0], [2.0]], [0.0, 1.0, 1.0])
    with pytest.raises(CurveError, match="points must have at least 2 rows"):
        rule([[0.0]], [0.0])


@every_rule
def test_derivatives_beyond_the_range(rule):
    with pytest.raises(CurveError, match="exceeds the largest number"):
        rule([[0.0], [1e300], [0.0]], [0.0, 1e-150, 2e-150])


def test_jerks_are_those_of_the_spline_between_its_sides(rng, exact):
    """By fractions: the spline's third derivatives are the slopes of its accelerations; (de Boor, IV (9))."""
    points = rng.standard_normal((6, 2))
    jerks = natural_spline_jerks(points, T)
    spline = HermiteCurve(points, natural_spline_velocities(points, T), T)
    sides = [spline.joint_derivatives(before=side).values[:, 3] for side in (True, False)]
    assert jerks[0] == pytest.approx(sides[1][0], rel=1e-11)
    assert jerks[-1] == pytest.approx(sides[0][-1], rel=1e-11)
    h = [exact.rational(b) - exact.rational(a) for a, b in pairwise(T)]
    for i in range(1, 5):
        share = float((h[i - 1] / (h[i - 1] + h[i])).p) / float((h[i - 1] / (h[i - 1] + h[i])).q)
        between = (1.0 - share) * sides[0][i - 1] + share * sides[1][i]
        assert jerks[i] == pytest.approx(between, rel=1e-11, abs=1e-11 * np.abs(jerks).max())


def test_jerks_are_linear_in_the_points_and_scale(rng):
    points, others = rng.standard_normal((2, 6, 2))
    both = natural_spline_jerks(2.0 * points - 3.0 * others, T)
    parts = 2.0 * natural_spline_jerks(points, T) - 3.0 * natural_spline_jerks(others, T)
    assert both == pytest.approx(parts, rel=1e-12, abs=1e-12 * np.abs(parts).max())
    for scale in (1e-90, 1e90):
        assert natural_spline_jerks(points, scale * T) * scale**3 == pytest.approx(
            natural_spline_jerks(points, T), rel=1e-11
        )
    assert (natural_spline_jerks([[0.0, 1.0], [3.0, 5.0]], [1.0, 3.0]) == 0.0).all()
    with pytest.raises(CurveError, match="too far apart"):
        natural_spline_jerks(points, 1e-150 * T)
