"""Samples that follow a changing curve, against the curve itself."""

import numpy as np
import pytest

from curvecore import FrozenFlattening, LagrangeCurve, chebyshev
from tests.polylines import worst_distance
from tests.rows import each_row

BOX = (-0.5, -0.5, 4.5, 3.0)
TOLERANCE = 1e-3


def wave(n):
    t = chebyshev(n)
    return LagrangeCurve(np.column_stack([4 * t, 1 + 0.7 * np.sin(9 * t)]), t)


@each_row("n", [2, 3, 7, 20, 60])
def test_a_moved_point_is_followed_within_the_tolerance(n):
    curve, rng = wave(n), np.random.default_rng(n)
    frozen = FrozenFlattening(curve, TOLERANCE, BOX)
    followed = 0
    for size in (0.0, 1e-3, 0.03, 0.3, 3.0):
        points = np.array(curve.points)
        points[rng.integers(n, size=2)] += size * rng.standard_normal(2)
        moved = curve.with_jets(points[:, None])
        pieces = frozen.follow(moved)
        if pieces is not None:
            followed += 1
            assert worst_distance(moved, pieces, BOX) <= TOLERANCE
            # The samples are those of the curve itself, to the rounding of one more sum.
            assert np.abs(pieces.points - moved.evaluate(pieces.parameters)).max() <= 1e-13 * (1 + size)
    assert followed >= 2


@pytest.mark.parametrize("n", [3, 7, 20])
def test_moved_parameters_are_followed_within_the_tolerance(n):
    curve = wave(n)
    frozen = FrozenFlattening(curve, TOLERANCE, BOX)
    parameters = np.array(curve.parameters)
    parameters[n // 2] += 0.05 * (parameters[n // 2 + 1] - parameters[n // 2])
    moved = LagrangeCurve(curve.points, parameters)
    pieces = frozen.follow(moved)
    assert pieces is not None
    assert worst_distance(moved, pieces, BOX) <= TOLERANCE


def test_samples_that_do_not_serve_any_more_are_not_used():
    straight = LagrangeCurve(np.column_stack([np.linspace(0, 4, 9), np.ones(9)]), chebyshev(9))
    frozen = FrozenFlattening(straight, 1e-6, BOX)
    points = np.array(straight.points)
    points[4, 1] += 1.5
    assert frozen.follow(straight.with_jets(points[:, None])) is None
    assert frozen.follow(straight) is not None


@pytest.mark.parametrize("interval", [(0.0, 2.0), (-3.0, -2.9), (1e6, 1e6 + 1.0)])
def test_another_interval_is_followed(interval):
    start, end = interval
    frozen = FrozenFlattening(wave(5), TOLERANCE, BOX)
    even = LagrangeCurve(wave(5).points, start + (end - start) * np.linspace(0.0, 1.0, 5))
    for curve in (LagrangeCurve(wave(5).points, start + (end - start) * chebyshev(5)), even):
        pieces = frozen.follow(curve)
        assert (pieces.parameters[0], pieces.parameters[-1]) == curve.domain
        assert np.array_equal(pieces.points, np.asarray(curve.evaluate(pieces.parameters)))
        assert worst_distance(curve, pieces, BOX) <= TOLERANCE


def test_samples_that_another_interval_cannot_tell_apart_are_not_followed():
    curve = LagrangeCurve(wave(5).points, 1e12 + np.arange(5) * 2.0**-10)
    assert FrozenFlattening(wave(5), TOLERANCE, BOX).follow(curve) is None


def test_a_higher_degree_is_not_followed():
    frozen = FrozenFlattening(wave(5), TOLERANCE, BOX)
    assert frozen.follow(wave(6)) is None
    assert frozen.follow(wave(4)) is not None


def test_a_curve_entering_the_box_from_outside_is_detected():
    points = np.array([[10.0, 10.0], [12.0, 14.0], [10.0, 18.0], [13.0, 19.0]])
    curve = LagrangeCurve(points, chebyshev(4))
    frozen = FrozenFlattening(curve, TOLERANCE, BOX)
    inside = curve.with_jets((points - [9.0, 9.0])[:, None])
    pieces = frozen.follow(inside)
    assert pieces is None or worst_distance(inside, pieces, BOX) <= TOLERANCE


@pytest.mark.parametrize("n", [3, 4, 6, 9])
def test_tips_that_move_along_their_own_line_are_followed_or_refused(n):
    """Samples on the chords of their neighbours say nothing of tips between them: 3.3 tolerances missed."""
    rng = np.random.default_rng(n)
    tolerance, followed = 1e-3, 0
    for _ in range(60):
        points = np.column_stack([rng.uniform(0.0, 4.0, n), 1.0 + rng.choice([0.0, 1e-3]) * rng.random(n)])
        curve = LagrangeCurve(points, chebyshev(n))
        frozen = FrozenFlattening(curve, tolerance)
        for size in (0.01, 0.03, 0.1):
            points[rng.integers(n), 0] += size
            moved = curve.with_jets(points[:, None])
            pieces = frozen.follow(moved)
            if pieces is not None:
                followed += 1
                assert worst_distance(moved, pieces, (-np.inf, -np.inf, np.inf, np.inf)) <= tolerance
    assert followed >= 40


@pytest.mark.parametrize("seed", range(8))
def test_the_estimate_for_calm_curves_is_the_greatest_of_the_pieces(seed):
    rng = np.random.default_rng(seed)
    answers = 0
    for size in 10.0 ** rng.uniform(-12, 12, 20):
        t = chebyshev(int(rng.integers(2, 25)))
        curve = LagrangeCurve(size * rng.normal(size=(len(t), 2)).cumsum(axis=0), t)
        frozen = FrozenFlattening(curve, 1e-3 * np.ptp(curve.points))
        points = np.array(curve.points)
        points[rng.integers(len(t))] += 0.05 * np.ptp(points) * rng.normal(size=2)
        samples = frozen._samples(curve.with_jets(points[:, None]))
        with np.errstate(all="ignore"):
            calm, each = frozen._calm_deviation(samples), frozen._deviation(samples)
        if calm < np.inf:
            answers += 1
            assert calm == pytest.approx(each.max(), rel=1e-9, abs=1e-12 * np.ptp(points))
    assert answers >= 3
