"""Speed, curvature, box, inflections, extrema of curvature."""

import numpy as np
import pytest

from curvecore import (
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    arc_length,
    bounding_box,
    chebyshev,
    chord_length,
    coordinate_extrema,
    curvature,
    curvature_error,
    curvature_extrema,
    curvature_of,
    finite_difference_velocities,
    inflections,
    natural_spline_velocities,
    speed,
    uniform,
)
from curvecore.analysis.bounding_boxes import bounding_boxes
from curvecore.analysis.lengths import arc_lengths
from curvecore.bezier.pieces import bezier_pieces
from tests.core.made_curves import family
from tests.rows import each_row

FAMILIES = ["lagrange", "hermite", "quintic_hermite"]
every_family = pytest.mark.parametrize("name", FAMILIES)


def circle(segments, radius=1.0):
    """A quintic that has a circle's points, velocities and accelerations at the joints."""
    t = uniform(segments + 1)
    angle = 2.0 * np.pi * t
    point = radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    velocity = 2.0 * np.pi * np.stack((-point[:, 1], point[:, 0]), axis=1)
    return QuinticHermiteCurve(point, velocity, -((2.0 * np.pi) ** 2) * point, t)


def parabola(count=3):
    t = np.linspace(-1.0, 2.0, count)
    return LagrangeCurve(np.stack((t, t * t), axis=1), t)


@each_row("segments", [4, 8, 16, 32])
def test_a_circle_of_quintics_has_the_circles_curvature(segments):
    """Birkhoff and Priver (1967): |e'| <= 5**.5 h**5 M / 30000, |e''| <= h**4 M / 1920, M = max |c^(6)|."""
    curve = circle(segments)
    h, turn = 1.0 / segments, 2.0 * np.pi
    first, second = np.sqrt(5.0) * h**5 * turn**6 / 30000.0, h**4 * turn**6 / 1920.0
    t = np.linspace(0.0, 1.0, 1001)
    assert np.abs(speed(curve, t) - turn).max() <= first + 1e-12
    bound = second / turn**2 + 4.0 * first / turn
    assert np.abs(curvature(curve, t) - 1.0).max() <= 1.2 * bound + 1e-12


@every_family
def test_curvature_in_exact_arithmetic(rng, exact, name):
    points, t = rng.standard_normal((7, 2)), chebyshev(7)
    curve = family(name, points, t)
    where = np.linspace(0.0, 1.0, 40)
    node = [exact.rational(x) for x in t]
    data = [[[exact.rational(x) for x in row] for row in jet] for jet in curve.jets]
    found = curvature(curve, where)
    for k, x in enumerate(where):
        derivatives = []
        for order in (1, 2):
            if name == "lagrange":
                weights = exact.lagrange_weights(node)
                terms = exact.lagrange_terms(exact.rational(x), node, order)
                pairs = [(w * v, d[0]) for w, v, d in zip(weights, terms, data, strict=True)]
            else:
                segment, values = exact.hermite_terms(exact.rational(x), node, curve.jets.shape[1], order)
                pairs = [
                    (v, d) for end in (0, 1) for v, d in zip(values[end], data[segment + end], strict=True)
                ]
            derivatives.append([sum(b * d[axis] for b, d in pairs) for axis in (0, 1)])
        (u, v), (a, b) = derivatives
        cross, square = u * b - v * a, u * u + v * v
        truth = float(int(cross.p) / int(cross.q)) / float(int(square.p) / int(square.q)) ** 1.5
        # The short cut of many parameters loses up to the Lebesgue constant, here 2.
        assert found[k] == pytest.approx(truth, rel=1e-11, abs=1e-11)


def test_curvature_is_signed_in_the_plane_and_not_in_space():
    curve = parabola()
    assert curvature(curve, 0.0) == pytest.approx(2.0, rel=1e-14)
    mirrored = LagrangeCurve(curve.points * [1.0, -1.0], curve.parameters)
    assert curvature(mirrored, 0.0) == pytest.approx(-2.0, rel=1e-14)
    turned = LagrangeCurve(
        np.column_stack((curve.points[:, 0], curve.points[:, 1] * 0.6, curve.points[:, 1] * -0.8)),
        curve.parameters,
    )
    t = np.linspace(-1.0, 2.0, 50)
    assert curvature(turned, t) == pytest.approx(2.0 / (1.0 + 4.0 * t * t) ** 1.5, rel=1e-12)


def test_scalars_and_arrays():
    curve = parabola()
    assert curvature(curve, 0.5).shape == speed(curve, 0.5).shape == ()
    assert curvature(curve, []).shape == speed(curve, []).shape == (0,)


def test_a_point_at_rest_has_no_curvature():
    cusp = HermiteCurve([[0, 0], [1, 0]], [[3, 3], [3, -3]], [0, 1])
    assert np.isnan(curvature(cusp, 0.5))
    assert speed(cusp, 0.5) == 0.0


@each_row("size", [1e-150, 1e-300, 1e150, 1e300])
def test_curvature_of_tiny_and_huge_curves(size):
    velocity, acceleration = np.array([[3.0, 4.0]]) * size, np.array([[-4.0, 3.0]]) * size
    with np.errstate(over="ignore"):
        expected = 1.0 / (5.0 * size)
    found = curvature_of(velocity, acceleration)
    assert np.isfinite(found).all()
    assert found == pytest.approx(expected, rel=1e-14)


def test_the_short_cut_of_many_parameters_is_as_good_as_a_picture(rng):
    """Where it is taken it loses the Lebesgue constant at most: 1e4 for 20 uniform parameters."""
    for t in (chebyshev(20), uniform(20)):
        curve = LagrangeCurve(rng.standard_normal((20, 2)), t)
        where = np.linspace(0.0, 1.0, 500)
        exact = curvature_of(curve.evaluate(where, 1), curve.evaluate(where, 2))
        assert curvature(curve, where) == pytest.approx(exact, rel=1e-7, abs=1e-7)


@every_family
def test_the_box_holds_the_curve_and_is_reached(rng, name):
    for n in (2, 3, 7, 20):
        t = chebyshev(n)
        curve = family(name, rng.standard_normal((n, 2)), t)
        box = bounding_box(curve)
        dense = curve.evaluate(np.linspace(0.0, 1.0, 4001))
        assert (dense >= box.minimum - box.error).all()
        assert (dense <= box.maximum + box.error).all()
        # Between samples a coordinate grows by c'' h**2 / 8 at most.
        gap = np.abs(curve.evaluate(np.linspace(0.0, 1.0, 4001), 2)).max() / 4000**2 / 4
        assert (dense.min(axis=0) - box.minimum <= gap).all()
        assert (box.maximum - dense.max(axis=0) <= gap).all()
        assert box.error <= 1e-12 * np.abs(dense).max()


def test_the_box_of_a_cubic_in_closed_form():
    """y = t (1 - t) (1 - 2 t) has its extrema +-3**.5 / 18 at (3 -+ 3**.5) / 6."""
    box = bounding_box(HermiteCurve([[0, 0], [1, 0]], [[1, 1], [1, 1]], [0, 1]))
    assert box.minimum == pytest.approx([0.0, -np.sqrt(3.0) / 18.0], abs=1e-16)
    assert box.maximum == pytest.approx([1.0, np.sqrt(3.0) / 18.0], abs=1e-16)


def test_the_box_where_the_derivative_is_zero_at_both_ends():
    """A change of sign between zeros at both ends was once looked for in the wrong half."""
    points = [[0.0], [0.0]]
    curve = QuinticHermiteCurve(points, [[0.0], [0.0]], [[32.0], [0.0]], [0.0, 1.0])
    # y = 16 s**2 (1 - s)**3 is largest at 2 / 5.
    assert bounding_box(curve).maximum == pytest.approx([16.0 * 0.4**2 * 0.6**3], rel=1e-14)
    curve = QuinticHermiteCurve(points, [[0.0], [0.0]], [[-32.0], [0.0]], [0.0, 1.0])
    assert bounding_box(curve).minimum == pytest.approx([-16.0 * 0.4**2 * 0.6**3], rel=1e-14)


def test_the_box_where_a_polynomial_turns_between_two_of_its_pieces():
    """Of a symmetric curve in the middle, where its middle piece was halved: the largest value was 0.83."""
    half = [0.6, -0.04, 0.63, 0.21, 0.31, 0.83]
    curve = LagrangeCurve(np.reshape(half + half[::-1], (-1, 1)), uniform(12))
    assert bounding_box(curve).maximum == pytest.approx(curve.evaluate(0.5), abs=1e-14)
    assert bounding_box(curve).maximum == pytest.approx([0.928523788], abs=1e-9)


def test_the_box_of_thousands_of_segments_that_all_turn_twice():
    """Above 2048 such segments none was looked into: the box was flat."""
    t, ones = np.arange(2501.0), np.ones(2501)
    curve = HermiteCurve(np.stack([t, 0 * t], axis=1), np.stack([ones, ones], axis=1), t)
    assert bounding_box(curve).maximum[1] == pytest.approx(np.sqrt(3.0) / 18.0, abs=1e-12)


def test_boxes_and_lengths_of_many_curves_equal_those_of_each_curve(rng):
    """Chains, several degrees, and sizes from 1e-9 to 1e9."""
    curves = [
        family(name, 10.0**size * rng.standard_normal((n, 2)), chebyshev(n))
        for size, n in ((0, 2), (-9, 5), (9, 12))
        for name in ("lagrange", "hermite", "quintic")
    ]
    curves.append(
        Chain([HermiteCurve(*np.ones((2, 2, 2)), [0, 1]), HermiteCurve(np.eye(2), np.eye(2), [1, 3])])
    )
    parts = [bezier_pieces(curve) for curve in curves]
    for curve, part, box in zip(curves, parts, bounding_boxes(curves, parts), strict=True):
        alone = bounding_box(curve)
        assert np.array_equal(np.concatenate(alone[:2]), np.concatenate(box[:2]))
        assert alone.error == box.error
        (length,) = arc_lengths([part], [1e-9])
        own = arc_length(curve, 1e-9)
        assert abs(length.value - own.value) <= length.error + own.error
    together = arc_lengths(parts, [1e-9] * len(parts))
    for part, length in zip(parts, together, strict=True):
        assert length == pytest.approx(arc_lengths([part], [1e-9])[0], rel=1e-13)


def test_the_box_of_a_chain_with_a_break():
    one = HermiteCurve([[0, 0], [1, 0]], [[1, 0], [1, 0]], [0, 1])
    two = HermiteCurve([[5, 5], [6, 7]], [[1, 2], [1, 2]], [1, 2])
    box = bounding_box(Chain([one, two]))
    assert (box.minimum.tolist(), box.maximum.tolist()) == ([0, 0], [6, 7])


def test_inflections_in_closed_form():
    t = np.linspace(-1.0, 2.0, 4)
    cubic = LagrangeCurve(np.stack((t, (t - 0.3) ** 3), axis=1), t)
    assert inflections(cubic) == pytest.approx([0.3], abs=1e-12)
    assert inflections(parabola()).size == 0
    assert inflections(circle(8)).size == 0


def test_coordinate_extrema_in_closed_form():
    t = np.linspace(-1.0, 2.0, 4)
    cubic = LagrangeCurve(np.stack((t, (t - 1.5) * (t - 0.25) ** 2), axis=1), t)
    assert coordinate_extrema(cubic, 0).size == 0
    # The derivative is (t - 1/4) (3 t - 13/4).
    assert coordinate_extrema(cubic, 1) == pytest.approx([0.25, 13 / 12], abs=1e-14)


def test_a_coordinate_turns_back_at_a_corner_and_once_on_a_constant_stretch():
    roof = Chain(
        [
            HermiteCurve([[0, 0], [1, 1]], [[1, 1]] * 2, [0, 1]),
            HermiteCurve([[1, 1], [2, 0]], [[1, -1]] * 2, [1, 2]),
        ]
    )
    assert coordinate_extrema(roof, 1).tolist() == [1.0]
    points = [[0, 0], [1, 1], [2, 1], [3, 0]]
    table = HermiteCurve(points, [[1, 1], [1, 0], [1, 0], [1, -1]], [0, 1, 2, 3])
    assert coordinate_extrema(table, 1).tolist() == [2.0]
    assert coordinate_extrema(table, 0).size == 0


def sign_changes(values):
    signs = np.sign(values[np.abs(values) > 1e-9 * np.abs(values).max()])
    return int((signs[1:] != signs[:-1]).sum())


@every_family
@pytest.mark.parametrize("n", [3, 8, 20])
def test_inflections_and_extrema_are_as_many_as_dense_samples_show(rng, name, n):
    for t in (chebyshev(n), np.sort(np.append(rng.random(n - 2), [0.0, 1.0]))):
        points = rng.standard_normal((n, 2))
        if name == "lagrange" and n > 8 and t[1] != chebyshev(n)[1]:
            continue  # a polynomial through random parameters of that number leaves any picture
        curve = family(name, points, t)
        s = np.linspace(0.0, 1.0, 40001)[1:-1]
        velocity, acceleration = curve.evaluate(s, 1), curve.evaluate(s, 2)
        turn = velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0]
        found = inflections(curve)
        assert found.size == sign_changes(turn / np.linalg.norm(velocity, axis=1) ** 3)
        assert (np.diff(found) > 0.0).all()
        extrema = curvature_extrema(curve)
        assert (np.diff(extrema.parameters) > 0.0).all()
        width = 1e-5
        beside = [curvature(curve, np.clip(extrema.parameters + d, 0.0, 1.0)) for d in (-width, width)]
        slack = 1e-7 * np.abs(extrema.curvatures)
        high = (extrema.curvatures + slack >= beside[0]) & (extrema.curvatures + slack >= beside[1])
        low = (extrema.curvatures - slack <= beside[0]) & (extrema.curvatures - slack <= beside[1])
        assert np.where(extrema.is_maximum, high, low).all()


def test_a_joint_where_the_curvature_flips_is_an_inflection():
    curve = HermiteCurve([[0, 0], [1, 0], [2, 0]], [[1, 1], [1, -1], [1, 1]], [0, 1, 2])
    assert inflections(curve).tolist() == [1.0]
    assert 1.0 not in curvature_extrema(curve).parameters


def test_a_straight_part_between_opposite_bends_counts_once():
    points = [[-1, 1], [0, 0], [1, 0], [2, -1]]
    curve = HermiteCurve(points, [[1, -2], [1, 0], [1, 0], [1, -2]], [0, 1, 2, 3])
    assert inflections(curve).tolist() == [2.0]


def test_the_vertex_of_a_parabola():
    extrema = curvature_extrema(parabola())
    assert extrema.parameters == pytest.approx([0.0], abs=1e-12)
    assert extrema.curvatures == pytest.approx([2.0], rel=1e-12)
    assert extrema.is_maximum.tolist() == [True]


def test_an_ellipse_has_four_vertices():
    t = uniform(33)
    angle = 2.0 * np.pi * t + 0.3
    turn = 2.0 * np.pi
    point = np.stack((2.0 * np.cos(angle), np.sin(angle)), axis=1)
    velocity = turn * np.stack((-2.0 * np.sin(angle), np.cos(angle)), axis=1)
    curve = QuinticHermiteCurve(point, velocity, -turn * turn * point, t)
    extrema = curvature_extrema(curve)
    strong = np.abs(np.abs(extrema.curvatures) - np.where(extrema.is_maximum, 2.0, 0.25)) < 1e-3
    expected = (np.array([0.5, 1.0, 1.5, 2.0]) * np.pi - 0.3) / turn
    near = [np.abs(extrema.parameters[strong] - place).min() for place in expected]
    assert max(near) < 1e-3


def test_straight_lines_have_no_curvature():
    t = np.array([0.0, 0.1, 0.5, 0.7, 1.0])
    for name in FAMILIES:
        curve = family(name, np.outer(t, [3.0, 1.0]) + 0.1, t)
        assert inflections(curve).size == 0
        assert curvature_extrema(curve).parameters.size == 0


@every_family
@each_row("size", [1e-300, 1e-150, 1e150, 1e300])
def test_sizes_do_not_matter(name, size):
    """Multiplied by a power of two the curve keeps its places, and its box is as much larger."""
    scale = 2.0 ** round(np.log2(size))
    points = np.array([[0, 0], [1, 2], [3, 1], [4, 4], [5, 0]], dtype=float)
    t = uniform(5)
    small, large = family(name, points, t), family(name, scale * points, t)
    assert inflections(large) == pytest.approx(inflections(small), abs=1e-9)
    assert curvature_extrema(large).parameters == pytest.approx(curvature_extrema(small).parameters, abs=1e-6)
    assert bounding_box(large).maximum / scale == pytest.approx(bounding_box(small).maximum, rel=1e-14)


@every_family
def test_parameters_one_ulp_apart_and_one_point_repeated(rng, name):
    t = np.array([0.0, 0.5, np.nextafter(0.5, 1.0), 1.0])
    still = HermiteCurve(np.ones((4, 2)), np.zeros((4, 2)), uniform(4))
    wild = HermiteCurve(rng.standard_normal((4, 2)), rng.standard_normal((4, 2)), t)
    for curve in (still, wild):
        assert np.isfinite(bounding_box(curve).maximum).all()
        assert np.isfinite(inflections(curve)).all()
        assert np.isfinite(curvature_extrema(curve).parameters).all()
    assert bounding_box(still).error < 1e-14


def test_unusable_arguments():
    line = LagrangeCurve([[0.0], [1.0]], [0, 1])
    with pytest.raises(CurveError, match="dim 2 or more"):
        curvature(line, 0.5)
    for function in (inflections, curvature_extrema):
        with pytest.raises(CurveError, match="curve must be plane"):
            function(line)
    with pytest.raises(CurveError, match="every value must be finite"):
        speed(line, np.nan)


def exact_curvature(exact, curve, t):
    """From derivatives in fractions; the root of |c'|² is the last step."""
    nodes, sums = [exact.rational(x) for x in curve.parameters], []
    for order in (1, 2):
        if curve.jets.shape[1] == 1:
            weights, values = (
                exact.lagrange_weights(nodes),
                exact.lagrange_terms(exact.rational(t), nodes, order),
            )
            pairs = [(w * v, row[0]) for w, v, row in zip(weights, values, curve.jets, strict=True)]
        else:
            segment, values = exact.hermite_terms(exact.rational(t), nodes, curve.jets.shape[1], order)
            ends = zip(values, curve.jets[segment : segment + 2], strict=True)
            pairs = [pair for value, jet in ends for pair in zip(value, jet, strict=True)]
        sums.append([sum(b * exact.rational(d[axis]) for b, d in pairs) for axis in (0, 1)])
    (x1, y1), (x2, y2) = sums
    turn, square = x1 * y2 - y1 * x2, x1 * x1 + y1 * y1
    unit = exact.enclosed([turn, square])
    return float((unit[0] / (unit[1] * unit[1].sqrt())).mid())


def test_the_curvature_between_near_points_has_an_error_bound(exact):
    """Between points 1e-9 apart 1.5 was told, where it is -1.5: no rounding was mentioned."""
    for gap in (1e-3, 1e-6, 1e-9, 1e-12):
        points = np.array([[0.0, 0.0], [1.0, 1.0], [1.0 + gap, 1.0], [2.0, 0.0]])
        t = chord_length(points)
        curve = HermiteCurve(points, natural_spline_velocities(points, t), t)
        between = t[1] + (t[2] - t[1]) * np.array([0.0, 0.3, 0.9])
        where = np.concatenate((between, [0.3, 0.7, t[2]]))
        told, error = curvature(curve, where), curvature_error(curve, where)
        true = np.array([exact_curvature(exact, curve, x) for x in where])
        assert (np.abs(told - true) <= error).all()
        assert (error[3:] < 1e-12).all()
        assert (error[:3] > np.abs(told[:3])).all() == (gap < 1e-6)


@pytest.mark.parametrize(
    "family",
    [LagrangeCurve, HermiteCurve, QuinticHermiteCurve, SepticHermiteCurve],
    ids=lambda kind: kind.name,
)
def test_the_error_of_a_curvature_is_a_bound(rng, exact, family):
    for trial in range(12):
        n = int(rng.integers(2, 7))
        t = np.cumsum(10.0 ** -rng.uniform(0.0, 12.0 if trial % 2 else 2.0, n))
        jets = rng.standard_normal((n, family.derivatives + 1, 2)) + 10.0 ** rng.integers(0, 7)
        curve = family(*jets.swapaxes(0, 1), t)
        where = rng.uniform(t[0], t[-1], 4)
        error, told = curvature_error(curve, where), curvature(curve, where)
        for x, value, bound in zip(where, told, error, strict=True):
            assert abs(value - exact_curvature(exact, curve, x)) <= bound


@each_row("family", [HermiteCurve, QuinticHermiteCurve])
def test_where_estimates_cancel_the_curvature_has_no_bound(family):
    """The velocity at the turn of a line to and fro is 0; κ was 2.8e32 there, and its error 1.8e19."""
    points = [[0, 0], [1 / 3, 0.1], [-1 / 3, -0.1]]
    t = chord_length(points)
    jets = [points, finite_difference_velocities(points, t), np.zeros((3, 2))]
    curve = family(*jets[: family.derivatives + 1], t)
    assert np.isinf(curvature_error(curve, t[1])).all()


def test_the_error_of_the_curvature_grows_beside_a_cusp_and_has_no_bound_at_the_cusp(exact):
    # Control points (0, 0), (1, 1), (0, 1), (1, 0): c'(1/2) = 0.
    cusp = HermiteCurve([[0, 0], [1, 0]], [[3, 3], [3, -3]], [0, 1])
    where = 0.5 + np.array([1e-3, 1e-5, 1e-8, 1e-12])
    told, error = curvature(cusp, where), curvature_error(cusp, where)
    true = np.array([exact_curvature(exact, cusp, t) for t in where])
    assert (np.abs(told - true) <= error).all()
    assert (error[:2] < 1e-4 * told[:2]).all()
    assert (error[2:] > told[2:]).all()
    assert np.isnan(curvature(cusp, 0.5))
    assert np.isinf(curvature_error(cusp, 0.5)).all()
