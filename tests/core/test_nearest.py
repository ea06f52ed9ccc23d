"""The nearest point of a curve is the nearest of all."""

import numpy as np
import pytest

from curvecore import (
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    NearestWithin,
    QuinticHermiteCurve,
    chebyshev,
    chord_length,
    natural_spline_velocities,
    nearest,
    uniform,
)
from tests.rows import each_row


def curves(rng, n, dim):
    points, t = rng.standard_normal((n, dim)), chebyshev(n)
    velocities = natural_spline_velocities(points, t)
    yield LagrangeCurve(points, t)
    yield HermiteCurve(points, velocities, t)
    yield QuinticHermiteCurve(points, velocities, 5.0 * rng.standard_normal((n, dim)), t)


@pytest.mark.parametrize("dim", [1, 2, 3])
@pytest.mark.parametrize("n", [2, 5, 20])
def test_no_sample_of_the_curve_is_nearer(rng, n, dim):
    for curve in curves(rng, n, dim):
        dense = curve.evaluate(np.linspace(0.0, 1.0, 5001))
        for _ in range(8):
            point = 1.5 * rng.standard_normal(dim)
            found = nearest(curve, point, 1e-9)
            assert found.distance <= np.linalg.norm(dense - point, axis=1).min() + 1e-9
            assert found.error <= 1e-9
            assert (found.point == curve.evaluate(found.parameter)).all()
            assert found.distance == pytest.approx(np.linalg.norm(found.point - point), rel=1e-15)


QUARTER = 4.0 * (np.sqrt(2.0) - 1.0)


@each_row(
    ("velocities", "places"),
    [
        # A loop, a cusp, a straight line there and back, nearly a half circle, a line at even speed.
        ([[9.0, 9.0], [9.0, -9.0]], [[0.5, 1.125], [0.5, 3.0], [0.5, 0.0]]),
        ([[3.0, 3.0], [3.0, -3.0]], [[0.5, 0.75], [0.5, 2.0], [0.5, 0.0]]),
        ([[9.0, 0.0], [9.0, 0.0]], [[0.5, 0.0], [0.5, 1e-9], [-3.0, 0.0]]),
        ([[0.0, QUARTER / 2], [0.0, -QUARTER / 2]], [[0.5, 0.0], [0.5, 1e-3], [0.5, -7.0]]),
        ([[1.0, 0.0], [1.0, 0.0]], [[0.25, 0.0], [0.25, 1.0], [1.0, 1e-13]]),
    ],
)
@each_row("scale", [1.0, 1e-120, 1e120, 1e-200, 1e200])
@each_row("tolerance", [1e-3, 1e-9, 1e-12])
def test_one_cubic_of_every_shape(velocities, places, scale, tolerance):
    """Nothing is nearer than what is found, by more than is said; beyond 1e140 arrays take over.

    What is said has the roundings of control points of size 3, 8 u each.
    """
    curve = HermiteCurve([[0.0, 0.0], [scale, 0.0]], scale * np.array(velocities), [0.0, 1.0])
    dense = HermiteCurve([[0.0, 0.0], [1.0, 0.0]], velocities, [0.0, 1.0]).evaluate(
        np.linspace(0.0, 1.0, 20001)
    )
    for place in [*places, *dense[::2500]]:
        found = nearest(curve, scale * np.array(place), tolerance * scale)
        least = np.linalg.norm(dense - place, axis=1).min()
        assert found.distance / scale <= least + tolerance
        assert found.error <= (tolerance + 1e-14) * scale
        assert (found.distance - found.error) / scale <= least


@pytest.mark.parametrize("tolerance", [1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12])
def test_points_of_the_curve_are_their_nearest_points(rng, tolerance):
    for curve in curves(rng, 8, 2):
        for t in (0.0, 0.123, 0.7, 1.0):
            found = nearest(curve, curve.evaluate(t), tolerance)
            assert found.distance <= tolerance


def test_a_parabola_in_closed_form():
    """Of (t, t**2) the nearest to (0, a) is at t**2 = a - 1/2, and at 0 below 1/2."""
    t = np.linspace(-2.0, 2.0, 3)
    curve = LagrangeCurve(np.stack((t, t * t), axis=1), t)
    for a in (0.6, 1.0, 2.5):
        found = nearest(curve, [0.0, a], 1e-14)
        assert abs(found.parameter) == pytest.approx(np.sqrt(a - 0.5), abs=1e-9)
        assert found.distance == pytest.approx(np.sqrt(a - 0.25), abs=1e-14)
    for a in (-1.0, 0.0, 0.4, 0.5):
        # At 1/2, the centre of curvature, the distance is flat to fourth order.
        assert nearest(curve, [0.0, a], 1e-14).distance == pytest.approx(abs(a), abs=2e-14)


def test_the_nearest_parameter_is_accurate_to_rounding(rng):
    """Its last step is taken where no distance shows any more whether it was one in the right direction."""
    t = np.linspace(-2.0, 2.0, 3)
    curve = LagrangeCurve(np.stack((t, t * t), axis=1), t)
    for a in rng.uniform(0.6, 3.0, 100):
        found = nearest(curve, [0.0, a], 1e-6)
        assert abs(found.parameter) == pytest.approx(np.sqrt(a - 0.5), abs=1e-14)


def test_the_centre_of_a_circle_is_equally_near_to_all_points():
    angle = 2.0 * np.pi * uniform(65)
    point = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    velocity = 2.0 * np.pi * np.stack((-point[:, 1], point[:, 0]), axis=1)
    curve = QuinticHermiteCurve(point, velocity, -4.0 * np.pi**2 * point, uniform(65))
    found = nearest(curve, [0.0, 0.0], 1e-9)
    assert abs(found.distance - 1.0) < 1e-9
    assert found.error <= 1e-9


def test_the_other_side_of_a_break_is_considered():
    left = HermiteCurve([[0, 0], [1, 0]], [[1, 0], [1, 0]], [0, 1])
    right = HermiteCurve([[0, 5], [1, 5]], [[1, 0], [1, 0]], [1, 2])
    chain = Chain([left, right])
    assert nearest(chain, [0.25, 4.0], 1e-9).parameter == pytest.approx(1.25, abs=1e-8)
    assert nearest(chain, [0.25, 1.0], 1e-9).parameter == pytest.approx(0.25, abs=1e-8)


@pytest.mark.parametrize("size", [1e-300, 1e-150, 1e150, 1e300])
def test_sizes_do_not_matter(rng, size):
    scale = 2.0 ** round(np.log2(size))
    for curve in curves(rng, 5, 2):
        small = nearest(curve, [0.3, 0.2], 1e-9)
        large = nearest(curve.with_jets(scale * curve.jets), [0.3 * scale, 0.2 * scale], 1e-9 * scale)
        assert large.distance / scale == pytest.approx(small.distance, abs=2e-9)


def test_far_away_and_at_rest(rng):
    curve = HermiteCurve(np.ones((3, 2)), np.zeros((3, 2)), uniform(3))
    assert nearest(curve, [4.0, 5.0], 1e-9).distance == 5.0
    for curve in curves(rng, 5, 2):
        found = nearest(curve, [1e12, -1e12], 1e-3)
        dense = curve.evaluate(np.linspace(0.0, 1.0, 2001))
        assert found.distance <= np.linalg.norm(dense - [1e12, -1e12], axis=1).min() + 2e-3


def test_unusable_arguments(rng):
    curve = next(curves(rng, 4, 2))
    for point in ([0.0], [0.0, 1.0, 2.0], 3.0, [[0.0, 1.0]], [0.0, np.nan]):
        with pytest.raises(CurveError):
            nearest(curve, point, 1e-3)
    with pytest.raises(CurveError, match="tolerance"):
        nearest(curve, [0.0, 0.0], -1.0)


@pytest.mark.parametrize("n", [2, 3, 5, 12, 20])
@pytest.mark.parametrize("reach", [0.01, 0.1, 10.0])
def test_within_a_reach_no_sample_is_nearer(rng, n, reach):
    for curve in curves(rng, n, 2):
        t = np.linspace(0.0, 1.0, 5001)
        dense, within = curve.evaluate(t), NearestWithin(curve)
        for _ in range(12):
            place = curve.evaluate(rng.random()) + 2.0 * reach * rng.random() * rng.standard_normal(2)
            distances = np.linalg.norm(dense - place, axis=1)
            found = within.to(place, reach)
            if found is None:
                assert distances.min() > 0.998 * reach
            else:
                assert found.distance <= min(distances.min() + 1e-6, reach)
                assert (found.point == curve.evaluate(found.parameter)).all()
                assert found.distance == pytest.approx(nearest(curve, place, 1e-9).distance, abs=1e-6)
                assert found.error <= 1e-3 * reach


@pytest.mark.parametrize("reach", [9.0, 0.01])
def test_points_of_a_curve_that_runs_to_and_fro_are_their_nearest_points(reach):
    """A place on the curve was told to be 3.48 away: the nearest chord was that of another branch."""
    points = np.array([(0, 0), (4, 0.001), (1, 0.002), (3, 0.003)])
    for t in (uniform(4), chord_length(points)):
        curve = LagrangeCurve(points, t)
        within = NearestWithin(curve)
        for at in np.linspace(0.0, 1.0, 97):
            assert within.to(curve.evaluate(at), reach).distance < 1e-8


def test_a_chain_within_a_reach(rng):
    left = HermiteCurve([[0, 0], [1, 0]], [[1, 0], [1, 0]], [0, 1])
    right = HermiteCurve([[0, 5], [1, 5]], [[1, 0], [1, 0]], [1, 2])
    within = NearestWithin(Chain([left, right]))
    assert within.to([0.25, 4.0], 2.0).parameter == pytest.approx(1.25, abs=1e-8)
    assert within.to([0.25, 2.0], 1.5) is None
    assert within.to([0.25, 1e12], 1.5) is None
    for point in ([0.0], [0.0, np.inf]):
        with pytest.raises(CurveError, match=r"point|finite"):
            within.to(point, 1.0)
    with pytest.raises(CurveError, match="reach"):
        within.to([0.0, 0.0], 0.0)
