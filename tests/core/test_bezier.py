from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from curvecore import (
    CurveError,
    FloaterHormannCurve,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    bezier_segments,
    chebyshev,
    chord_length,
    cubic_path,
    uniform,
)
from curvecore.bezier.control_points import _nearest_pieces, chebyshev_samples, cubic_shape
from tests.core.made_curves import de_casteljau

T = np.array([0.0, 0.25, 1.0, 1.5])


def curves(rng):
    data = [rng.standard_normal((4, 2)) for _ in range(4)]
    return HermiteCurve(*data[:2], T), QuinticHermiteCurve(*data[:3], T), SepticHermiteCurve(*data, T)


def test_control_points_make_the_curve(rng):
    for curve in curves(rng):
        controls = bezier_segments(curve)
        assert controls.shape == (3, curve.degree + 1, 2)
        for i in range(3):
            for s in (Fraction(0), Fraction(1, 4), Fraction(1, 2), Fraction(7, 8), Fraction(1)):
                t = float(Fraction(T[i]) + s * Fraction(T[i + 1] - T[i]))
                assert de_casteljau(controls[i], s) == pytest.approx(curve.evaluate(t), abs=1e-14)


def test_published_formulas():
    points, velocities, accelerations = (
        np.array([[0.0], [1.0]]),
        np.array([[3.0], [5.0]]),
        np.array([[2.0], [4.0]]),
    )
    h = 0.5
    cubic = bezier_segments(HermiteCurve(points, velocities, [0.0, h]))[0, :, 0]
    assert cubic == pytest.approx([0.0, h * 3 / 3, 1 - h * 5 / 3, 1.0], abs=1e-15)
    quintic = bezier_segments(QuinticHermiteCurve(points, velocities, accelerations, [0.0, h]))[0, :, 0]
    ahead = [0.0, h * 3 / 5, 2 * h * 3 / 5 + h * h * 2 / 20]
    behind = [1 - 2 * h * 5 / 5 + h * h * 4 / 20, 1 - h * 5 / 5, 1.0]
    assert quintic == pytest.approx([*ahead, *behind], abs=1e-15)


def test_septic_control_points_give_the_data_back_in_fractions():
    """Dyadic data, against derivatives at the ends of the Bezier curve in exact arithmetic."""
    h, data = Fraction(1, 2), [[Fraction(k * k + r, 8) for r in range(4)] for k in (1, 3)]
    columns = np.array([[float(x) for x in row] for row in data])
    curve = SepticHermiteCurve(*columns.T[:, :, None], [0.0, float(h)])
    p, v, a, j = data[0]
    ahead = [p, p + h * v / 7, p + 2 * h * v / 7 + h**2 * a / 42]
    ahead.append(p + 3 * h * v / 7 + 3 * h**2 * a / 42 + h**3 * j / 210)
    controls = bezier_segments(curve)[0, :, 0]
    assert controls[:4] == pytest.approx([float(x) for x in ahead], rel=1e-15)
    p, v, a, j = data[1]
    behind = [p, p - h * v / 7, p - 2 * h * v / 7 + h**2 * a / 42]
    behind.append(p - 3 * h * v / 7 + 3 * h**2 * a / 42 - h**3 * j / 210)
    assert controls[:3:-1] == pytest.approx([float(x) for x in behind], rel=1e-15)
    for exact, given in ((ahead, data[0]), (behind, data[1])):
        step = h if exact is ahead else -h
        differences, level = [], exact
        while level:
            differences.append(level[0])
            level = [b - a for a, b in pairwise(level)]
        scale = [Fraction(1), Fraction(7), Fraction(42), Fraction(210)]
        assert [d * f / step**k for k, (d, f) in enumerate(zip(differences, scale, strict=True))] == given


def test_lagrange_has_no_segments():
    with pytest.raises(CurveError, match="must be of a family of piecewise polynomials"):
        bezier_segments(LagrangeCurve([[0.0], [1.0]], [0.0, 1.0]))


def deviation(curve, path):
    s = np.linspace(0.0, 1.0, 65)
    weights = np.stack(((1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3), axis=1)
    t = path.parameters[:-1, None] + np.diff(path.parameters)[:, None] * s
    exact = curve.evaluate(t.ravel()).reshape(*t.shape, -1)
    return np.linalg.norm(np.einsum("sk,pkd->psd", weights, path.control_points) - exact, axis=-1).max()


def test_cubic_path_of_a_cubic_is_exact(rng):
    curve = curves(rng)[0]
    path = cubic_path(curve, 1e-30)
    assert path.deviation == 0.0
    assert (path.control_points == bezier_segments(curve)).all()


@pytest.mark.parametrize("tolerance", [1e-1, 1e-3, 1e-5, 1e-7])
def test_cubic_path_keeps_the_tolerance(rng, tolerance):
    points = rng.standard_normal((12, 2))
    for curve in (
        *curves(rng)[1:],
        LagrangeCurve(points, chebyshev(12)),
        LagrangeCurve(points, uniform(12)),
    ):
        path = cubic_path(curve, tolerance)
        measured = deviation(curve, path)
        assert measured <= path.deviation <= tolerance
        controls = path.control_points
        assert (controls[1:, 0] == controls[:-1, 3]).all()
        assert (controls[0, 0] == curve.points[0]).all()
        assert (controls[-1, 3] == curve.points[-1]).all()
        # Smooth: the handles on both sides of a joint point the same way.
        ahead, behind = controls[1:, 1] - controls[1:, 0], controls[:-1, 3] - controls[:-1, 2]
        cross = ahead[:, 0] * behind[:, 1] - ahead[:, 1] * behind[:, 0]
        size = np.linalg.norm(ahead, axis=1) * np.linalg.norm(behind, axis=1)
        # Control points carry an error of u |p|, handles may be as short as 1e-3 |p|.
        assert (np.abs(cross) <= 1e-9 * size + 1e-15 * np.abs(controls).max() * np.sqrt(size)).all()


@pytest.mark.parametrize("degree", [3, 5, 12, 30])
def test_a_polynomial_stays_below_the_bound_between_samples(rng, degree):
    """For random ones and those that swing most between their zeros (Ehlich and Zeller 1964)."""
    samples, margin = chebyshev_samples(degree)
    series = np.vstack([np.eye(degree + 1)[-1], rng.standard_normal((200, degree + 1))])
    chebyshev_series = np.polynomial.chebyshev.chebval
    dense = np.abs(chebyshev_series(np.linspace(-1.0, 1.0, 20_001), series.T)).max(axis=1)
    sampled = np.abs(chebyshev_series(2.0 * samples - 1.0, series.T)).max(axis=1)
    assert (dense <= margin * sampled * (1.0 + 1e-12)).all()
    assert margin < 1.3


def test_deviations_stay_below_the_reported_bound(rng):
    points = np.vstack([rng.standard_normal((11, 2)), [[5.0, 5.0], [5.0, 5.0 + 1e-6]]])
    for curve in (LagrangeCurve(points, chord_length(points)), *curves(rng)):
        path = cubic_path(curve, 1e-5)
        assert path.is_bound
        assert deviation(curve, path) <= path.deviation * (1.0 + 1e-9) + 1e-14
    assert not cubic_path(FloaterHormannCurve(points, uniform(13)), 1e-3).is_bound
    # Cubics that are the curve itself but for rounding.
    assert not cubic_path(LagrangeCurve(points[:4], uniform(4)), 1e-3).is_bound
    assert not cubic_path(LagrangeCurve(rng.standard_normal((40, 2)), chebyshev(40)), 1e-3).is_bound


def test_pieces_grow_like_the_fourth_root(rng):
    """Cubic interpolation is of fourth order: a 10,000th of the tolerance, ten times the pieces."""
    curve = curves(rng)[1]
    counts = [len(cubic_path(curve, tolerance).control_points) for tolerance in (1e-4, 1e-8)]
    assert 8 <= counts[1] / counts[0] <= 12


def distance(points, curve, start, end):
    """The largest distance of points from a stretch: the nearest of many, then Newton's steps."""
    t = np.linspace(start, end, 801)
    apart = np.linalg.norm(points[:, None] - curve.evaluate(t), axis=2)
    t, nearest = t[np.argmin(apart, axis=1)], apart.min(axis=1)
    for _ in range(6):
        velocity = curve.evaluate(t, 1)
        ahead = np.einsum("kd,kd->k", points - curve.evaluate(t), velocity)
        t = np.clip(t + ahead / np.maximum(np.square(velocity).sum(axis=1), 1e-300), start, end)
    return np.minimum(nearest, np.linalg.norm(points - curve.evaluate(t), axis=1)).max()


@pytest.mark.parametrize("tolerance", [1e-1, 1e-3, 1e-5, 1e-7])
def test_a_cubic_shape_keeps_the_tolerance_both_ways(rng, tolerance):
    points = rng.standard_normal((8, 2))
    for curve in (
        *curves(rng)[1:],
        LagrangeCurve(points, uniform(8)),
        FloaterHormannCurve(points, uniform(8)),
    ):
        path = cubic_shape(curve, tolerance)
        assert path.deviation <= tolerance
        controls, t = path.control_points, path.parameters
        assert (controls[1:, 0] == controls[:-1, 3]).all()
        assert np.isin(curve.breaks, t).all()
        np.testing.assert_array_equal(controls[:, 0], curve.evaluate(t[:-1]))
        s = np.linspace(0.0, 1.0, 65)[:, None]
        weights = np.hstack(((1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3))
        for piece, start, end in zip(controls, t[:-1], t[1:], strict=True):
            there = distance(weights @ piece, curve, start, end)
            cubic = HermiteCurve(piece[::3], 3 * (piece[1::2] - piece[::2]), [0.0, 1.0])
            back = distance(curve.evaluate(np.linspace(start, end, 65)), cubic, 0.0, 1.0)
            assert max(there, back) <= path.deviation * (1 + 1e-9) + 1e-14
        # Smooth: the handles on both sides of a joint point the same way.
        ahead, behind = controls[1:, 1] - controls[1:, 0], controls[:-1, 3] - controls[:-1, 2]
        size = np.linalg.norm(ahead, axis=1) * np.linalg.norm(behind, axis=1)
        assert (np.einsum("kd,kd->k", ahead, behind) >= (1 - 1e-9) * size - 1e-15).all()


def test_a_shape_takes_less_than_half_of_the_pieces_and_grows_like_the_sixth_root(rng):
    """A thousandth of the tolerance takes 3.2 times the pieces, not 5.6 (de Boor, Höllig and Sabin)."""
    curve = curves(rng)[1]
    pieces = {tolerance: len(cubic_shape(curve, tolerance).control_points) for tolerance in (1e-5, 1e-8)}
    assert 2 * pieces[1e-5] < len(cubic_path(curve, 1e-5).control_points)
    assert pieces[1e-8] <= 4 * pieces[1e-5]


def test_a_shape_takes_as_few_pieces_as_the_best_of_random_divisions(rng):
    """With one piece fewer, two thousand random divisions of the same stretch are all too far away."""
    velocities, accelerations = [[1.0, 3.0], [2.0, -3.0]], [[0.0, -9.0], [4.0, 20.0]]
    curve = QuinticHermiteCurve([[0.0, 0.0], [3.0, 1.0]], velocities, accelerations, [0.0, 1.0])
    count = len(cubic_shape(curve, 1e-4).control_points)
    assert count >= 3
    samples, margin = chebyshev_samples(25)
    for _ in range(2000):
        inner = np.sort(rng.uniform(0.0, 1.0, count - 2))
        deviation = _nearest_pieces(curve, np.array([0.0, *inner, 1.0]), samples, margin)[1]
        assert deviation.max() > 1e-4


def test_a_wild_shape_gives_an_honest_deviation(rng):
    curve = LagrangeCurve(1e12 * rng.standard_normal((40, 2)), uniform(40))
    path = cubic_shape(curve, 1e-3)
    assert np.isfinite(path.control_points).all()
    assert len(path.control_points) <= 4096
    assert path.deviation > 1e-3


def test_a_wild_curve_gives_an_honest_deviation(rng):
    points = 1e12 * rng.standard_normal((40, 2))
    path = cubic_path(LagrangeCurve(points, uniform(40)), 1e-3)
    assert np.isfinite(path.control_points).all()
    assert len(path.control_points) <= 4096
    assert path.deviation > 1e-3
