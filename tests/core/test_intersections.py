"""Intersections of a curve with itself or another, against closed forms and all pairs of chords."""

import numpy as np
import pytest

from curvecore import (
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    chebyshev,
    chord_length,
    intersections,
    natural_spline_accelerations,
    natural_spline_velocities,
    self_intersections,
    uniform,
)
from curvecore.arithmetic import cross
from tests.rows import each_row


def crossings_of_chords(curve, count):
    """The pairs of crossing chords of a fine polyline, not neighbours."""
    points = curve.evaluate(np.linspace(*curve.domain, count))
    (x, y), (from_x, from_y) = points.T, points[:-1].T[:, :, None]
    along_x, along_y = np.diff(points, axis=0).T[:, :, None]
    # On which side of every chord every vertex lies.
    side = along_x * (y - from_y) - along_y * (x - from_x)
    apart = side[:, :-1] * side[:, 1:] < 0.0
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
            expected = crossings_of_chords(curve, 601)
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


def two_parabolas(apart):
    """Two parabolas whose tips are so far apart, with a bow between them."""
    up = HermiteCurve([[-1, 1 + apart], [1, 1 + apart]], [[2, -4], [2, 4]], [0, 1])
    bow = HermiteCurve([[1, 1 + apart], [1, -1]], [[5, 4], [-5, 4]], [1, 2])
    down = HermiteCurve([[1, -1], [-1, -1]], [[-2, 4], [-2, -4]], [2, 3])
    return Chain([up, bow, down])


@each_row("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
def test_a_tangential_touch(tolerance):
    found = self_intersections(two_parabolas(0.0), tolerance)
    # Newton's method halves the distance to a touch 20 times; it begins where parabolas 2 x**2 apart are
    # as far apart as the tolerance. Nearer than 1e-8 they are a rounding apart.
    assert found.parameters == pytest.approx(np.array([[0.5, 2.5]]), abs=np.sqrt(tolerance) / 2**20 + 1e-8)
    assert found.is_complete


@each_row("tolerance", [1e-6, 1e-9, 1e-12])
@each_row("times", [4, 1000])
def test_a_near_miss_is_no_intersection(tolerance, times):
    found = self_intersections(two_parabolas(times * tolerance), tolerance)
    assert found.parameters.shape == (0, 2)
    assert found.is_complete


def through_one_point(visits):
    """(w, t w) with w = t (t - 1) …, which is in (0, 0) at so many t."""
    t = np.linspace(-0.3, visits - 0.7, visits + 2)
    w = np.prod(t[:, None] - np.arange(visits), axis=1)
    return LagrangeCurve(np.stack((w, t * w), axis=1), t)


@pytest.mark.parametrize("visits", [3, 4, 5, 6])
def test_all_pairs_of_branches_at_a_multiple_point(visits):
    """At t = -1, 0 and 1 on one point, -1 and 1 were dropped: c is there half way between them, too."""
    found = self_intersections(through_one_point(visits), 1e-9)
    expected = np.argwhere(np.triu(np.ones((visits, visits)), 1))
    # In order but for roundings: the first of several pairs may be the last.
    assert np.unique(np.round(found.parameters, 8), axis=0).tolist() == expected.tolist()
    assert len(found.parameters) == len(expected)
    assert found.is_complete


@each_row("tolerance", [1e-6, 1e-9])
@each_row("loops", [3, 4])
def test_loops_that_begin_and_end_in_one_point(loops, tolerance):
    """Of three loops through a point, 3 of 5 pairs were found; the two ends of the closed curve are none."""
    angle = np.arange(loops + 1) * (2.0 * np.pi / loops)
    velocities = 8.0 * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    curve = HermiteCurve(np.zeros((loops + 1, 2)), velocities, np.arange(loops + 1))
    found = self_intersections(curve, tolerance)
    pairs = np.argwhere(np.triu(np.ones((loops + 1, loops + 1)), 1))
    assert found.parameters == pytest.approx(pairs[pairs[:, 1] - pairs[:, 0] < loops], abs=1e-6)
    assert found.is_complete


@pytest.mark.parametrize("family", [HermiteCurve, QuinticHermiteCurve])
@pytest.mark.parametrize("windings", [20, 50])
def test_a_spiral_of_1000_points_does_not_cross_itself(family, windings):
    angle = np.linspace(0.0, 2.0 * np.pi * windings, 1000)
    points = angle[:, None] * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    t = chord_length(points)
    data = [points, natural_spline_velocities(points, t), natural_spline_accelerations(points, t)]
    found = self_intersections(family(*data[: 2 if family is HermiteCurve else 3], t), 1e-6 * np.ptp(points))
    assert found.parameters.shape == (0, 2)
    assert found.is_complete


@pytest.mark.parametrize("seed", range(3))
def test_no_crossing_of_chords_is_missed_on_a_grid(seed):
    """Points on a grid of 5 by 5: coincident points, crossings at points, symmetry."""
    rng = np.random.default_rng(100 + seed)
    n = int(rng.integers(4, 14))
    points, t = rng.integers(-2, 3, (n, 2)).astype(float), chebyshev(n)
    curve = HermiteCurve(points, 5.0 * rng.standard_normal((n, 2)), t)
    for each in (LagrangeCurve(points, t), curve):
        found = self_intersections(each, 1e-9)
        expected = crossings_of_chords(each, 1201)
        assert found.is_complete
        assert len(found.parameters) >= len(expected)
        apart = np.abs(found.parameters[:, None] - expected).max(axis=2)
        assert not len(expected) or apart.min(axis=0).max() < 4e-3


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_a_curve_along_itself_ends_and_is_never_complete(tolerance):
    out, back = [[0, 0], [0, 0]], [[6, 3], [-6, -3]]
    line = HermiteCurve([[0, 0], [3, 0]], [[3, 0], [3, 0]], [0, 1])
    bow = HermiteCurve([[3, 0], [-1, 0]], [[9, 9], [9, -9]], [1, 2])
    once_more = HermiteCurve([[-1, 0], [4, 0]], [[5, 0], [5, 0]], [2, 3])
    for curve in (HermiteCurve(out, back, [0, 1]), Chain([line, bow, once_more])):
        found = self_intersections(curve, tolerance)
        assert not found.is_complete
        assert len(found.parameters) <= 1024


@each_row("size", [1e-300, 1e-150, 1e150, 1e300])
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


# Two curves


def test_two_curves_meet_at_exact_parameters():
    """The cubic y = x**3 - x and y = 0, over other domains."""
    t = np.linspace(-2.0, 2.0, 4)
    cubic = LagrangeCurve(np.stack((t, t**3 - t), axis=1), t)
    line = LagrangeCurve([[-2, 0], [2, 0]], [10, 14])
    found = intersections(cubic, line, 1e-10)
    assert found.is_complete
    assert found.parameters == pytest.approx(np.array([[-1, 11], [0, 12], [1, 13]]), abs=1e-14)
    assert found.points == pytest.approx(np.array([[-1, 0], [0, 0], [1, 0]]), abs=1e-14)
    back = intersections(line, cubic, 1e-10)
    assert back.parameters == pytest.approx(found.parameters[:, ::-1], abs=1e-14)


def test_two_curves_that_touch_meet_once_and_ends_that_lie_on_a_curve_meet_it():
    parabola = LagrangeCurve([[-1, 1], [0, 0], [1, 1]], [-1, 0, 1])
    touch = intersections(parabola, LagrangeCurve([[-1, 0], [1, 0]], [0, 1]), 1e-10)
    assert touch.parameters == pytest.approx(np.array([[0, 0.5]]), abs=1e-7)
    end = intersections(parabola, LagrangeCurve([[0.5, 0.25], [2, -3]], [0, 1]), 1e-10)
    assert end.parameters == pytest.approx(np.array([[0.5, 0.0]]), abs=1e-14)
    ends = intersections(
        LagrangeCurve([[0, 0], [1, 0]], [0, 1]), LagrangeCurve([[1, 0], [2, 5]], [1, 2]), 1e-10
    )
    assert ends.parameters.tolist() == [[1, 1]]
    assert (touch.is_complete, end.is_complete, ends.is_complete) == (True, True, True)


def test_two_curves_apart_do_not_meet_and_along_each_other_are_not_all_found():
    one, other = (LagrangeCurve([[x, 0], [x + 2, 0]], [0, 1]) for x in (0, 1))
    assert not intersections(one, other, 1e-10).is_complete
    apart = intersections(one, LagrangeCurve([[0, 1e-6], [2, 1e-6]], [0, 1]), 1e-10)
    assert (apart.parameters.shape, apart.is_complete) == ((0, 2), True)


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_two_splines_meet_as_often_as_their_polylines(rng, size):
    for _ in range(8):
        t = np.linspace(0.0, 1.0, 6)
        curves = []
        for points in size * rng.standard_normal((2, 6, 2)):
            curves.append(HermiteCurve(points, natural_spline_velocities(points, t), t))
        found = intersections(*curves, 1e-10 * size)
        a, b = (curve.evaluate(np.linspace(0.0, 1.0, 1501)) for curve in curves)
        u, v, w = np.diff(a, axis=0)[:, None], np.diff(b, axis=0)[None], b[None, :-1] - a[:-1, None]
        across = cross(u, v)
        s, r = cross(w, v) / across, cross(w, u) / across
        assert len(found.parameters) == ((s >= 0) & (s < 1) & (r >= 0) & (r < 1)).sum()
        assert found.is_complete
        one, other = (curve.evaluate(at) for curve, at in zip(curves, found.parameters.T, strict=True))
        assert np.abs(one - other).max(initial=0.0) <= 1e-14 * size
        assert np.abs(one - found.points).max(initial=0.0) <= 1e-14 * size
