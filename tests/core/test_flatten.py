"""The polyline is within the tolerance, tested at far more parameters than it has."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis.strategies import integers, lists, sampled_from

from curvecore import (
    MAX_VERTICES,
    Chain,
    HermiteCurve,
    LagrangeCurve,
    ToleranceWarning,
    chebyshev,
    chord_length,
    flatten,
    flatten_parameters,
    flatten_pieces,
    uniform,
)
from tests.core.made_curves import family
from tests.effort import calls_of
from tests.rows import each_row


def distances(curve, parameters, box=None, samples=40):
    """Distances from curve points inside the box to their own chord."""
    s = (np.arange(samples) + 0.5) / samples
    t = parameters[:-1, None] + np.diff(parameters)[:, None] * s
    points = curve.evaluate(t.ravel()).reshape(*t.shape, 2)
    polyline = curve.evaluate(parameters)
    # By coordinates: NumPy begins a loop for every row of two numbers.
    x, y = np.moveaxis(points - polyline[:-1, None], -1, 0)
    chord_x, chord_y = np.diff(polyline, axis=0).T[:, :, None]
    length = np.maximum(np.hypot(chord_x, chord_y), 1e-300)
    unit_x, unit_y = chord_x / length, chord_y / length
    along = np.clip(x * unit_x + y * unit_y, 0.0, length)
    distance = np.hypot(x - along * unit_x, y - along * unit_y)
    if box is not None:
        inside = ((points >= box[:2]) & (points <= box[2:])).all(axis=-1)
        distance = np.where(inside, distance, 0.0)
    return distance.max()


every_family = pytest.mark.parametrize("name", ["lagrange", "hermite", "quintic_hermite"])


@every_family
@each_row("tolerance", [1.0, 1e-1, 1e-2, 1e-3, 1e-4])
@each_row("n", [2, 3, 8, 20])
def test_within_tolerance(rng, name, tolerance, n):
    points = rng.standard_normal((n, 2))
    curve = family(name, points, chord_length(points))
    t = flatten_parameters(curve, tolerance)
    if np.abs(curve.evaluate(np.linspace(0.0, 1.0, 999))).max() < 1e4:
        # Values of 1e4 and a tolerance of 1e-4 are what MAX_VERTICES is enough for.
        assert distances(curve, t) <= tolerance
    assert (np.diff(t) > 0.0).all()
    assert (t[0], t[-1]) == curve.domain
    assert (flatten(curve, tolerance) == curve.evaluate(t)).all()


@every_family
@each_row("box", [(-0.3, -0.3, 0.3, 0.3), (0.0, 0.0, 1e-3, 1e-3), (5.0, 5.0, 6.0, 6.0)])
def test_box(rng, name, box):
    points = rng.standard_normal((12, 2))
    points[4] = [5e-4, 5e-4]
    curve = family(name, points, chebyshev(12))
    tolerance = (box[2] - box[0]) / 2000
    t = flatten_parameters(curve, tolerance, box)
    assert distances(curve, t, box, 400) <= tolerance
    full = flatten_parameters(curve, tolerance)
    assert t.size < full.size


@every_family
def test_outside_chords_stay_outside(rng, name):
    """No chord crosses the box by more than the tolerance where the curve does not."""
    angle = np.linspace(0.0, 2.0 * np.pi, 9)
    points = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    curve = family(name, points, uniform(9))
    polyline = flatten(curve, 1e-3, (-0.6, -0.6, 0.6, 0.6))
    s = np.linspace(0.0, 1.0, 200)
    dense = (polyline[:-1, None] + np.diff(polyline, axis=0)[:, None] * s[:, None]).reshape(-1, 2)
    assert np.abs(dense).max(axis=1).min() > 0.6


@every_family
def test_a_straight_line_needs_two_vertices(name):
    t = np.array([0.0, 0.1, 0.2, 0.5, 0.6, 0.9, 1.0])
    points = np.outer(t, [3.0, 1.0]) + np.array([1.0, -2.0])
    assert flatten_parameters(family(name, points, t), 1e-6).tolist() == [0.0, 1.0]


def test_a_line_run_at_changing_speed_needs_few_vertices():
    curve = HermiteCurve([[0.0, 0.0], [1.0, 1.0]], [[5.0, 5.0], [0.0, 0.0]], [0.0, 1.0])
    assert len(flatten(curve, 1e-4)) <= 6  # it turns back once
    curve = HermiteCurve([[0.0, 0.0], [1.0, 1.0]], [[0.0, 0.0], [0.0, 0.0]], [0.0, 1.0])
    assert len(flatten(curve, 1e-4)) == 2


def test_one_point_repeated():
    curve = HermiteCurve(np.ones((5, 2)), np.zeros((5, 2)), uniform(5))
    assert len(flatten(curve, 0.1)) == 2


@every_family
def test_few_vertices_on_smooth_curves(name):
    """A circle needs pi / acos(1 - tolerance) chords; three times as many are spent at most."""
    angle = np.linspace(0.0, 2.0 * np.pi, 33)
    points = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    curve = family(name, points, chebyshev(33) if name == "lagrange" else uniform(33))
    if name == "lagrange":
        angle = 2.0 * np.pi * chebyshev(33)
        curve = LagrangeCurve(np.stack((np.cos(angle), np.sin(angle)), axis=1), chebyshev(33))
    for tolerance in (1e-3, 1e-4, 1e-5):
        ideal = np.pi / np.arccos(1.0 - tolerance)
        assert len(flatten(curve, tolerance)) <= 3.0 * ideal + 2


def test_a_cusp_is_not_cut_off():
    curve = HermiteCurve([[0.0, 0.0], [1.0, 0.0]], [[9.0, 9.0], [9.0, -9.0]], [0.0, 1.0])
    assert distances(curve, flatten_parameters(curve, 1e-4), samples=400) <= 1e-4


@pytest.mark.parametrize("n", [20, 40, 60])
def test_narrow_oscillation_is_not_missed(n):
    """Runge: between the first two of n uniform parameters the polynomial leaves the picture."""
    t = uniform(n)
    points = np.stack((t, 1.0 / (1.0 + 25.0 * (2.0 * t - 1.0) ** 2)), axis=1)
    curve = LagrangeCurve(points, t)
    box = np.array([-0.2, -1.0, 1.2, 2.0])
    parameters = flatten_parameters(curve, 1e-3, box)
    assert distances(curve, parameters, box, 100) <= 1e-3
    assert parameters.size < 2000


@every_family
@pytest.mark.parametrize("size", [1e12, 1e100, 1e300])
def test_bounded_work_for_wild_curves(rng, name, size):
    points = size * rng.standard_normal((20, 2)).clip(-1, 1)
    points[7:9] = 0.0
    curve = family(name, points, uniform(20))
    with pytest.warns(ToleranceWarning, match="not 0.0005: it may not have more than"):
        everywhere = flatten(curve, 0.25 / 500)
    for polyline in (everywhere, flatten(curve, 0.25 / 500, (-1.0, -1.0, 1.0, 1.0))):
        assert len(polyline) <= MAX_VERTICES
        assert np.isfinite(polyline).all()


@pytest.mark.parametrize("name", ["hermite", "quintic_hermite"])
def test_a_box_around_a_joint_of_a_huge_curve(rng, name):
    """Segments of 1e6 times the box: only what is near the box is divided finely."""
    points = 1e6 * rng.standard_normal((20, 2))
    points[9] = [0.3, 0.2]
    curve = family(name, points, uniform(20))
    box = np.array([0.0, 0.0, 1.0, 1.0])
    t = flatten_parameters(curve, 1e-3, box)
    assert t.size < 3000
    near = np.sort(np.concatenate([t[(t > 0.45) & (t < 0.5)], [curve.parameters[9]]]))
    assert distances(curve, np.unique(near), box, 200) <= 1e-3


def test_many_joints(rng):
    t = uniform(3000)
    points = np.stack((np.cos(40 * t), np.sin(30 * t)), axis=1)
    curve = family("hermite", points, t)
    parameters = flatten_parameters(curve, 1e-3)
    assert parameters.size < 1500
    assert distances(curve, parameters) <= 1e-3


def test_joints_next_to_each_other(rng):
    """Parameters one ulp apart leave no room for vertices between them."""
    t = np.array([0.0, 0.5, np.nextafter(0.5, 1.0), 1.0])
    curve = HermiteCurve(rng.standard_normal((4, 2)), rng.standard_normal((4, 2)), t)
    parameters = flatten_parameters(curve, 1e-4)
    assert (np.diff(parameters) > 0.0).all()


@pytest.mark.parametrize(("points", "velocities"), [(1e-294, 1e7), (1e-300, 0.2), (1e-288, 1e12)])
def test_data_of_incomparable_sizes_are_flattened(points, velocities):
    """ "repeats may not contain negative values": more pieces were needed than an integer can count."""
    rng = np.random.default_rng(3)
    curve = HermiteCurve(
        points * rng.normal(size=(4, 2)), velocities * rng.normal(size=(4, 2)), np.arange(4.0)
    )
    with pytest.warns(ToleranceWarning):
        t = flatten_parameters(curve, 1e-8 * points)
    assert (np.diff(t) > 0).all()
    assert len(t) <= MAX_VERTICES


def test_a_wild_polynomial_through_very_many_points_is_given_up_in_time(rng):
    """Equal parameters and a thousand points: values of 1e250, and 16,000 vertices did not help."""
    curve = LagrangeCurve(rng.standard_normal((1000, 2)), np.linspace(0.0, 1.0, 1000))
    with pytest.warns(ToleranceWarning):
        t = flatten_parameters(curve, 1e-3, (-1.0, -1.0, 1.0, 1.0))
    assert t.size <= 2**22 // 1000 + 1
    assert (np.diff(t) > 0.0).all()


class _Counted(LagrangeCurve):
    """A curve that counts at how many parameters it is evaluated."""

    __slots__ = ()
    count = 0

    def _evaluate(self, t, order):
        type(self).count += t.size
        return super()._evaluate(t, order)


def test_between_the_vertices_of_a_too_wild_curve_nothing_is_measured():
    """In a frame of a drag of a thousand points there were 11,600 evaluations, for the same vertices."""
    s = np.linspace(0.0, 1.0, 1000)
    points = np.column_stack([4.0 * s, 1.0 + 0.7 * np.sin(14.0 * s)])
    curve = _Counted(points, chord_length(points))
    pieces = flatten_pieces(curve, 0.004, [-0.3, -0.1, 4.3, 2.1])
    assert _Counted.count < 3000
    assert pieces.reached > 1e6
    assert np.isin(curve.parameters, pieces.parameters).mean() > 0.9
    # Some kernels of BLAS round a row's sum otherwise where there are fewer rows. Each of the two is off by
    # 25 · 2⁻⁵³ Σ|B||d| at most (`test_lagrange_accuracy.py`).
    again = np.clip(curve.evaluate(pieces.parameters), -1e300, 1e300)
    with np.errstate(over="ignore", under="ignore"):
        size = np.abs(curve.basis(pieces.parameters)[..., 0]) @ np.abs(points)
    assert (np.abs(pieces.points - again) <= 2 * 25 * 2.0**-53 * size).all()


@pytest.mark.parametrize(
    ("name", "n", "size", "tolerance"),
    [
        ("lagrange", 1000, 1.0, 1e-4),
        ("hermite", 3000, 1.0, 1e-9),
        ("quintic_hermite", 20, 1e9, 1e-3),
        ("lagrange", 40, 1.0, 1e-3),
    ],
)
def test_a_polyline_of_too_few_vertices_reports_its_deviation(rng, name, n, size, tolerance):
    """It missed the tolerance up to 45 times without a sign, and its bounds were those of longer pieces."""
    points = size * rng.standard_normal((n, 2))
    curve = family(name, points, chebyshev(n) if n == 1000 else uniform(n))
    pieces = flatten_pieces(curve, tolerance)
    with pytest.warns(
        ToleranceWarning, match=f"by up to {pieces.reached:.3g}, not {tolerance:.3g}".replace("+", ".")
    ):
        t = flatten_parameters(curve, tolerance)
    assert np.array_equal(t, pieces.parameters)
    # Of a polynomial through 1,000 points each place of some 4,000 chords takes 1,000 factors.
    off = distances(curve, t, samples=10)
    assert tolerance < off <= pieces.reached
    assert pieces.reached <= 4.0 * off


@every_family
def test_a_reached_tolerance_gives_no_warning(rng, name):
    curve = family(name, rng.standard_normal((8, 2)), uniform(8))
    for tolerance in (1e-2, 1e-5):
        assert distances(curve, flatten_parameters(curve, tolerance)) <= tolerance
        assert flatten_pieces(curve, tolerance).reached <= tolerance
    # A tolerance below roundings is not the vertices' fault.
    line = family(name, np.linspace(0.0, 1.0, 8)[:, None] * [1e6, 3e6], uniform(8))
    flatten(line, 1e-12)


TURNS_BACK = {
    "line": [[1.7, 0], [6, 0], [0.2, 0], [4.4, 0]],
    "hairpins": [[3.6, 0.02], [4.63, 0.02], [2.75, 0.04], [4.57, 0.06], [1.5, 0.03], [5.05, 0.05]],
}


@each_row("name", TURNS_BACK)
@each_row("tolerance", [0.1, 1e-2, 1e-3, 1e-4])
def test_the_tips_of_a_curve_that_turns_back_are_drawn(name, tolerance):
    """They lay up to 34 tolerances beyond the polyline: the samples beside them all lay on it."""
    points = np.array(TURNS_BACK[name], dtype=float)
    curve = LagrangeCurve(points, uniform(len(points)))
    dense = curve.evaluate(np.linspace(0.0, 1.0, 20001))
    for angle in (0.0, 0.7, 2.0):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        turned = LagrangeCurve(points @ turn, curve.parameters)
        assert distances(turned, flatten_parameters(turned, tolerance), samples=400) <= tolerance
    drawn = flatten(curve, tolerance)
    assert np.abs(drawn.min(axis=0) - dense.min(axis=0)).max() <= tolerance
    assert np.abs(drawn.max(axis=0) - dense.max(axis=0)).max() <= tolerance


@settings(max_examples=200, deadline=None)
@given(
    along=lists(integers(-100, 100), min_size=3, max_size=9),
    slope=integers(-8, 8),
    width=sampled_from([0.0, 1e-3, 1e-2, 0.1]),
    fineness=sampled_from([50, 300, 3000]),
)
def test_curves_that_run_to_and_fro_stay_within_the_tolerance(along, slope, width, fineness):
    assume(len(set(along)) > 1)
    x = np.array(along, dtype=float)
    points = np.column_stack([x, slope * x / 8 + width * np.cos(7.0 * np.arange(len(x)))])
    curve = LagrangeCurve(points, uniform(len(x)))
    size = np.ptp(curve.evaluate(np.linspace(0.0, 1.0, 200)), axis=0).max()
    tolerance = size / fineness
    assert distances(curve, flatten_parameters(curve, tolerance)) <= tolerance


def chain(rng, count, made=HermiteCurve, joints=3):
    """Curves of as many joints end to end, with corners between them; the first and the last are straight."""
    points = np.cumsum(rng.normal(size=(count * (joints - 1) + 1, 2)), axis=0)
    straight = np.array([1.0, 0.5])
    points[: 2 * joints - 1] = straight * np.arange(2 * joints - 1)[:, None]
    pieces = []
    for index in range(count):
        own = slice(index * (joints - 1), (index + 1) * (joints - 1) + 1)
        slopes = rng.normal(size=(joints, 2)) if index > 1 else np.tile(straight, (joints, 1))
        t = np.arange(own.start, own.stop, dtype=float)
        pieces.append(made(points[own], slopes, t) if made is HermiteCurve else made(points[own], t))
    return Chain(pieces)


@each_row("made", [HermiteCurve, LagrangeCurve])
@each_row("box", [None, (-1.0, -1.0, 2.0, 2.0)])
@each_row("tolerance", [1.0, 1e-2, 1e-4])
def test_a_chain_is_within_tolerance_and_keeps_its_corners(rng, made, box, tolerance):
    curve = chain(rng, 9, made)
    pieces = flatten_pieces(curve, tolerance, box)
    assert (np.diff(pieces.parameters) > 0.0).all()
    corners = [piece.domain[0] for piece in curve.pieces] + [curve.domain[1]]
    assert np.isin(corners, pieces.parameters).all()
    np.testing.assert_allclose(pieces.points, curve.evaluate(pieces.parameters), atol=1e-13)
    assert pieces.reached <= tolerance
    for piece in curve.pieces:
        first, last = np.searchsorted(pieces.parameters, piece.domain)
        assert distances(piece, pieces.parameters[first : last + 1], box) <= tolerance * (1.0 + 1e-9)


def test_where_a_chain_jumps_the_end_of_the_curve_before_is_drawn():
    before = HermiteCurve([[0, 0], [1, 0]], [[1, 0], [1, 0]], [0, 1])
    after = HermiteCurve([[1, 1], [2, 1]], [[1, 0], [1, 0]], [1, 2])
    assert flatten_pieces(Chain([before, after]), 0.1).points.tolist() == [[0, 0], [1, 0], [2, 1]]


def test_a_wild_chain_has_vertices_for_each_of_its_curves(rng):
    curve = chain(rng, 4)
    wild = curve.with_jets(curve.jets * 1e9)
    pieces = flatten_pieces(wild, 1e-3)
    assert len(pieces.parameters) > MAX_VERTICES
    assert np.isfinite(pieces.points).all()


def test_more_corners_take_hardly_more_calls(rng):
    """Some 250 for each curve between two corners, when they were flattened apart."""
    few, many = (chain(rng, count) for count in (5, 45))
    calls = [calls_of(lambda curve=curve: flatten_pieces(curve, 1e-2)) for curve in (few, many)]
    assert calls[1] - calls[0] < 40 * 60
