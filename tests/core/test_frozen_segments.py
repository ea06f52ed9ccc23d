"""Vertices that stay at their places on the segments of a changing curve, against the curve itself."""

import numpy as np

from curvecore import (
    FrozenSegments,
    HermiteCurve,
    QuinticHermiteCurve,
    chord_length,
    flatten_pieces,
    natural_spline_accelerations,
    natural_spline_velocities,
    uniform,
)
from tests.polylines import worst_distance
from tests.rows import each_row

BOX = (-0.5, -0.5, 4.5, 3.0)
TOLERANCE = 1e-3


def curve_through(points, degree, parameters):
    t = parameters(points) if parameters is chord_length else parameters(len(points))
    velocities = natural_spline_velocities(points, t)
    if degree == 3:
        return HermiteCurve(points, velocities, t)
    return QuinticHermiteCurve(points, velocities, natural_spline_accelerations(points, t), t)


def wave_points(n):
    s = np.linspace(0, 1, n)
    return np.column_stack([4 * s, 1 + 0.7 * np.sin(9 * s)])


@each_row("parameters", [uniform, chord_length])
@each_row("degree", [3, 5])
@each_row("n", [2, 7, 20])
def test_a_moved_point_is_followed_within_the_tolerance(n, degree, parameters):
    points, rng = wave_points(n), np.random.default_rng(n)
    frozen = FrozenSegments(curve_through(points, degree, parameters), TOLERANCE, BOX)
    followed = 0
    for size in (0.0, 1e-3, 0.01, 0.03, 0.3, 3.0):
        moved = points.copy()
        moved[n // 2] += size * rng.standard_normal(2)
        curve = curve_through(moved, degree, parameters)
        pieces = frozen.follow(curve)
        if pieces is not None:
            followed += 1
            assert pieces.reached <= TOLERANCE
            assert worst_distance(curve, pieces, BOX) <= TOLERANCE
            assert (np.diff(pieces.parameters) > 0).all()
            assert np.abs(pieces.points - curve.evaluate(pieces.parameters)).max() <= 1e-14 * (1 + size)
    assert n == 2 or followed >= 3


def test_segments_outside_the_box_stay_coarse_until_inside():
    left = (-0.5, -0.5, 2.0, 3.0)
    curve = curve_through(wave_points(20), 3, uniform)
    frozen = FrozenSegments(curve, TOLERANCE, left)
    pieces = frozen.follow(curve)
    assert worst_distance(curve, pieces, left) <= TOLERANCE
    assert len(pieces.parameters) < 0.7 * len(FrozenSegments(curve, TOLERANCE).follow(curve).parameters)
    assert pieces.reached <= TOLERANCE
    assert frozen.follow(curve_through(wave_points(20) * [0.45, 1.0], 3, uniform)) is None


def test_a_curve_that_needs_far_fewer_vertices_gets_new_ones():
    points = wave_points(20)
    frozen = FrozenSegments(curve_through(points, 3, uniform), TOLERANCE, BOX)
    points[:, 1] *= 0.01
    assert frozen.follow(curve_through(points, 3, uniform)) is None


def test_where_vertices_are_left_out_nothing_is_followed():
    # A thousand points in line need two vertices.
    s = np.linspace(0, 1, 1000)
    straight = curve_through(np.column_stack([s, s]), 3, uniform)
    assert len(flatten_pieces(straight, TOLERANCE, BOX).parameters) < 100
    assert FrozenSegments(straight, TOLERANCE, BOX).follow(straight) is None


def test_other_curves_are_not_followed():
    frozen = FrozenSegments(curve_through(wave_points(20), 3, uniform), TOLERANCE, BOX)
    assert frozen.follow(curve_through(wave_points(20), 5, uniform)) is None
    assert frozen.follow(curve_through(wave_points(21), 3, uniform)) is None
    huge = HermiteCurve(1e300 * wave_points(20), np.full((20, 2), 1e305), uniform(20))
    assert frozen.follow(huge) is None
