"""Self-intersections, against closed forms and against all pairs of chords."""

import time

import numpy as np
import pytest

from curvecore import (
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    chebyshev,
    natural_spline_accelerations,
    natural_spline_velocities,
    self_intersections,
    uniform,
)


def crossings_of_chords(curve, count):
    """The pairs of crossing chords of a fine polyline, not neighbours."""
    points = curve.evaluate(np.linspace(*curve.domain, count))
    a, b = points[:-1], points[1:]

    def cross(u, v):
        return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]

    chord = (b - a)[:, None]
    apart = cross(chord, a[None] - a[:, None]) * cross(chord, b[None] - a[:, None]) < 0.0
    return np.argwhere(np.triu(apart & apart.T, 2)) / (count - 1.0)


@pytest.mark.parametrize("seed", range(4))
def test_as_many_as_crossing_chords(seed):
    rng = np.random.default_rng(seed)
    for n in (4, 9, 14):
        points, t = rng.standard_normal((n, 2)), chebyshev(n)
        velocities = natural_spline_velocities(points, t)
        accelerations = natural_spline_accelerations(points, t)
        for curve in (
            LagrangeCurve(points, t),
            HermiteCurve(points, velocities, t),
            QuinticHermiteCurve(points, velocities, accelerations, t),
        ):
            found = self_intersections(curve, 1e-9)
            expected = crossings_of_chords(curve, 1601)
            assert found.is_complete
            assert len(found.parameters) == len(expected)
            if len(expected):
                # The grid orders pairs with almost equal beginnings differently.
                apart = np.abs(found.parameters[:, None] - expected).max(axis=2)
                assert apart.min(axis=0).max() < 2e-3
                assert apart.min(axis=1).max() < 2e-3
                gap = np.diff(curve.evaluate(found.parameters.ravel()).reshape(-1, 2, 2), axis=1)
                assert np.linalg.norm(gap, axis=2).max() <= 1e-9


def test_the_loop_of_a_cubic_in_closed_form():
    """(t**2, t**3 - t) meets itself at t = -1 and 1, in (1, 0)."""
    t = np.linspace(-2.0, 1.5, 4)
    found = self_intersections(LagrangeCurve(np.stack((t * t, t**3 - t), axis=1), t), 1e-12)
    assert found.parameters == pytest.approx(np.array([[-1.0, 1.0]]), abs=1e-12)
    assert found.points == pytest.approx(np.array([[1.0, 0.0]]), abs=1e-12)


@pytest.mark.parametrize("size", [0.3, 1e-2, 1e-4, 1e-6])
def test_small_loops(size):
    """(t**2, t**3 - a t) meets itself at t = +-a**.5: a loop as long as a."""
    t = np.linspace(-1.0, 1.25, 4)
    curve = LagrangeCurve(np.stack((t * t, t**3 - size * t), axis=1), t)
    found = self_intersections(curve, 1e-13)
    root = np.sqrt(size)
    assert found.parameters == pytest.approx(np.array([[-root, root]]), rel=1e-6)


def circle(segments):
    t = uniform(segments + 1)
    angle = 2.0 * np.pi * t
    point = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    point[-1] = point[0]
    velocity = 2.0 * np.pi * np.stack((-point[:, 1], point[:, 0]), axis=1)
    return QuinticHermiteCurve(point, velocity, -4.0 * np.pi**2 * point, t)


def test_closed_curves_and_cusps_do_not_cross_themselves():
    cusp = HermiteCurve([[0, 0], [1, 0]], [[3, 3], [3, -3]], [0, 1])
    line = HermiteCurve([[0, 0], [1, 1], [2, 2]], [[1, 1]] * 3, [0, 1, 2])
    still = HermiteCurve(np.ones((3, 2)), np.zeros((3, 2)), uniform(3))
    for curve in (cusp, line, circle(4), circle(12), still):
        found = self_intersections(curve, 1e-9)
        assert found.parameters.shape == (0, 2)
        assert found.points.shape == (0, 2)


def test_a_corner_is_not_a_crossing_and_two_pieces_of_a_chain_cross():
    one = HermiteCurve([[0, 0], [2, 2]], [[2, 2], [2, 2]], [0, 1])
    two = HermiteCurve([[2, 2], [2, 0]], [[0, -2], [0, -2]], [1, 2])
    three = HermiteCurve([[2, 0], [0, 2]], [[-2, 2], [-2, 2]], [2, 3])
    found = self_intersections(Chain([one, two, three]), 1e-10)
    assert found.parameters == pytest.approx(np.array([[0.5, 2.5]]), abs=1e-10)


def test_a_tangential_touch():
    """Two parabolas that touch in (0, 0), with a bow between them."""
    up = HermiteCurve([[-1, 1], [1, 1]], [[2, -4], [2, 4]], [0, 1])
    bow = HermiteCurve([[1, 1], [1, -1]], [[5, 4], [-5, 4]], [1, 2])
    down = HermiteCurve([[1, -1], [-1, -1]], [[-2, 4], [-2, -4]], [2, 3])
    found = self_intersections(Chain([up, bow, down]), 1e-6)
    # Where two parabolas 2 x**2 apart are 1e-6 apart, x is 7e-4.
    assert found.parameters == pytest.approx(np.array([[0.5, 2.5]]), abs=1e-3)
    assert found.is_complete


def test_a_curve_along_itself_ends_in_bounded_time():
    there_and_back = HermiteCurve([[0, 0], [0, 0]], [[6, 3], [-6, -3]], [0, 1])
    start = time.perf_counter()
    found = self_intersections(there_and_back, 1e-9)
    assert time.perf_counter() - start < 3.0
    assert not found.is_complete


@pytest.mark.parametrize("size", [1e-300, 1e-150, 1e150, 1e300])
def test_sizes_do_not_matter(size):
    scale = 2.0 ** round(np.log2(size))
    t = np.linspace(-2.0, 1.5, 4)
    curve = LagrangeCurve(scale * np.stack((t * t, t**3 - t), axis=1), t)
    assert self_intersections(curve, 1e-9 * scale).parameters == pytest.approx(
        np.array([[-1.0, 1.0]]), abs=1e-8
    )


def test_unusable_arguments():
    with pytest.raises(CurveError, match="curve must be plane"):
        self_intersections(LagrangeCurve([[0.0], [1.0]], [0, 1]), 1e-3)
    with pytest.raises(CurveError, match="tolerance"):
        self_intersections(circle(4), 0.0)
