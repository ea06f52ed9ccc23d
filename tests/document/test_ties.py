"""Tied velocities go the same way after every edit; straight segments stay so, and turn what is tied."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from app.document import point_edits, rule_edits
from app.document.constraints import (
    PARALLEL,
    angle_between,
    has_parallel_velocities,
    is_straight,
    is_straight_beside,
    tie,
    tied_to_straight_segment,
    turned_along,
    untie,
)
from app.document.curve_edits import reverse_curve
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.plain_numbers import with_plain_numbers
from app.document.point_edits import JetValue, with_jet_values
from app.document.point_group import points_of
from app.document.straight_edits import straighten
from app.document.transforms import Affine, Edge, align_points, rotation, scaling, transform_points
from app.families import HERMITE, QUINTIC_HERMITE
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from tests.rows import each_row

PLACES = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 1.0))
KINDS = (ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM, ParametrizationKind.CENTRIPETAL)

sizes = st.floats(1e-3, 1e3)
angles = st.floats(-math.pi, math.pi)
vectors = st.builds(lambda r, a: (r * math.cos(a), r * math.sin(a)), sizes, angles)
places = st.tuples(st.floats(-100, 100), st.floats(-100, 100))


def curve(points=PLACES, *, kind=ParametrizationKind.CHORD_LENGTH, family=HERMITE, closed=False, ties=(2,)):
    """A curve of points whose velocities are all set, tied at some."""
    made = [Point(x, y, velocity=(1.0 + i, 2.0)) for i, (x, y) in enumerate(points)]
    for index in ties:
        made[index] = tie(made[index], (3.0, 1.0), (7.0, 5.0))
    return Curve("Tied", family, Parametrization(kind), tuple(made), closed=closed)


def document(**fields):
    return Document((curve(**fields),))


def with_line(start=2, **fields):
    """A curve whose segment from `start` is straight, its ends corners or tied."""
    made = document(**fields)
    return straighten(
        made, 0, [start], [0.0, 0.2, 0.45, 0.8, 1.0, 1.3][: len(PLACES) + made.curves[0].closed]
    )


def sine(point):
    """The sine of the angle between the velocities of a point, by exact fractions, squared."""
    (a, b), (c, d) = (tuple(map(Fraction, each)) for each in (point.velocity, point.velocity_after))
    return (a * d - b * c) ** 2 / ((a * a + b * b) * (c * c + d * d))


@given(vectors, vectors)
def test_a_turned_vector_keeps_its_length(v, along):
    result = turned_along(v, along)
    # Four roundings of 2⁻⁵³ each: a quotient and a product, and those of the two lengths.
    assert math.hypot(*result) == pytest.approx(math.hypot(*v), rel=1e-15)
    assert angle_between(result, along) < 1e-15
    assert turned_along(v, v) == v


@given(vectors, vectors)
def test_tying_turns_only_the_shorter_handle(v, w):
    point = tie(Point(0.0, 0.0), v, w)
    assert has_parallel_velocities(point)
    assert sine(point) < Fraction(1, 10**30)
    longer = max(v, w, key=lambda each: math.hypot(*each))
    assert longer in (point.velocity, point.velocity_after)
    assert math.hypot(*point.velocity) == pytest.approx(math.hypot(*v), rel=1e-15)
    assert math.hypot(*point.velocity_after) == pytest.approx(math.hypot(*w), rel=1e-15)


@given(vectors, st.booleans())
def test_setting_a_velocity_turns_the_tied_one(vector, ahead):
    before = document()
    length = math.hypot(*getattr(before.curves[0].points[2], "velocity" if ahead else "velocity_after"))
    point = point_edits.set_velocity(before, 0, 2, vector, ahead=ahead).curves[0].points[2]
    mine, other = (point.velocity_after, point.velocity) if ahead else (point.velocity, point.velocity_after)
    assert mine == vector
    assert math.hypot(*other) == pytest.approx(length)
    assert has_parallel_velocities(point)


moves = st.one_of(
    st.builds(lambda by: lambda d: point_edits.move_points(d, 0, [2], by), places),
    st.builds(lambda by: lambda d: point_edits.move_points(d, 0, [1, 2], by), places),
    st.builds(lambda to: lambda d: point_edits.set_position(d, 0, 3, to), places),
    st.builds(lambda a: lambda d: transform_points(d, 0, [1, 2, 3], rotation(a, (1.0, 1.0))), angles),
    st.builds(
        lambda x, y: lambda d: transform_points(d, 0, range(5), scaling(x, y, (0.0, 1.0))),
        st.floats(0.1, 5), st.floats(-5, -0.1),
    ),
    st.builds(
        lambda k: lambda d: transform_points(d, 0, range(5), Affine(0.0, k, 0.0, 0.0, (0.0, 0.0))), sizes
    ),
    st.builds(lambda v, a: lambda d: point_edits.set_velocity(d, 0, 2, v, ahead=a), vectors, st.booleans()),
    st.builds(
        lambda v, a: lambda d: d.with_curve(0, with_jet_values(d.curves[0], [JetValue(2, 1, a, v)])),
        vectors, st.booleans(),
    ),
    st.just(lambda d: point_edits.delete_points(d, 0, [0])),
    st.builds(lambda edge: lambda d: align_points(d, points_of(0, [1, 3]), edge), st.sampled_from(Edge)),
    st.builds(lambda end: lambda d: rule_edits.set_interval(d, 0, 0.0, end), sizes),
)  # fmt: skip


@given(st.sampled_from(KINDS), st.booleans(), st.lists(moves, max_size=6))
def test_tied_velocities_stay_parallel_after_every_edit(kind, closed, changes):
    made = document(kind=kind, closed=closed)
    for change in changes:
        if len(made.curves[0].points) == 5:
            made = with_plain_numbers(change(made), made)
    (point,) = (each for each in made.curves[0].points if each.tied)
    assert has_parallel_velocities(point)
    assert sine(point) < Fraction(PARALLEL) ** 2
    assert decode(encode(made)) == made


def test_reversing_keeps_a_tie():
    before = curve()
    after = reverse_curve(Document((before,)), 0, [0.0, 0.2, 0.45, 0.8, 1.0]).curves[0].points[2]
    assert after.tied
    assert has_parallel_velocities(after)
    assert (after.velocity, after.velocity_after) == (
        tuple(-each for each in before.points[2].velocity_after),
        tuple(-each for each in before.points[2].velocity),
    )


def test_an_estimated_velocity_ends_the_tie():
    for ahead in (False, True):
        point = point_edits.set_velocity(document(), 0, 2, None, ahead=ahead).curves[0].points[2]
        assert (point.corner, point.tied) == (True, False)
    assert not point_edits.clear_derivatives(document(), 0, [2]).curves[0].points[2].tied
    assert (
        point_edits.clear_derivatives(document(family=QUINTIC_HERMITE), 0, [2], (2,)).curves[0].points[2].tied
    )


def test_accelerations_of_a_tied_point_are_independent():
    made = point_edits.set_derivative(document(family=QUINTIC_HERMITE), 0, 2, 2, (5.0, 5.0), ahead=True)
    point = made.curves[0].points[2]
    assert (point.acceleration, point.acceleration_after, point.tied) == (None, (5.0, 5.0), True)


# Straight segments


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("moved", [2, 3])
@given(to=places)
def test_a_straight_segment_stays_straight_when_its_end_moves(kind, closed, moved, to):
    before = with_line(kind=kind, closed=closed)
    assert is_straight(before.curves[0], 2)
    after = point_edits.set_position(before, 0, moved, to).curves[0]
    p, q = after.points[2], after.points[3]
    if math.dist(p.position, q.position) > 1e-6:
        assert is_straight(after, 2)
        # Tangent to it: the handle on the other side lies on the line.
        assert p.tied
        assert has_parallel_velocities(p)


def test_a_tied_handle_beside_a_straight_segment_stays_along_the_segment():
    before = with_line()
    assert is_straight_beside(before.curves[0], 2, ahead=True)
    line = before.curves[0].points[2].velocity_after
    after = point_edits.set_velocity(before, 0, 2, (10.0, 1.0)).curves[0]
    point = after.points[2]
    assert point.velocity_after == line
    along = (10.0 * line[0] + line[1]) / math.hypot(*line)
    assert math.hypot(*point.velocity) == pytest.approx(along)
    assert is_straight(after, 2)
    # Behind the point the curve would turn back: the handle goes no further than to it.
    assert point_edits.set_velocity(before, 0, 2, (-line[0], -line[1])).curves[0].points[2].velocity == (
        0.0,
        0.0,
    )


def test_a_handle_dragged_out_of_a_straight_segment_bends_the_segment():
    after = point_edits.set_velocity(with_line(), 0, 2, (1.0, 5.0), ahead=True).curves[0]
    assert not is_straight(after, 2)
    assert has_parallel_velocities(after.points[2])


def test_a_point_between_two_lines_is_a_corner():
    before = straighten(with_line(), 0, [1], [0.0, 0.2, 0.45, 0.8, 1.0])
    points = before.curves[0].points
    assert is_straight(before.curves[0], 1)
    assert is_straight(before.curves[0], 2)
    assert (points[2].corner, points[2].tied) == (True, False)


def test_two_straight_segments_in_different_directions_end_a_tie():
    straight = document(points=((0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (4.0, 0.0)), ties=())
    straight = straighten(straight, 0, [1, 2], [0.0, 0.25, 0.5, 0.75, 1.0])
    point = straight.curves[0].points[2]
    smooth = point_edits.set_points(
        straight,
        0,
        [*straight.curves[0].points[:2], replace(point, tied=True), *straight.curves[0].points[3:]],
    )
    assert has_parallel_velocities(smooth.curves[0].points[2])
    after = point_edits.move_points(smooth, 0, [2], (0.0, 1.0)).curves[0]
    assert is_straight(after, 1)
    assert is_straight(after, 2)
    assert not after.points[2].tied


def test_points_moved_together_keep_the_straight_segment_between_the_points():
    before = with_line(ties=())
    after = point_edits.move_points(before, 0, [2, 3], (2.0, 1.0))
    assert is_straight(after.curves[0], 2)


def test_curved_segments_are_not_straight():
    made = document(ties=())
    assert not any(is_straight(made.curves[0], segment) for segment in range(4))
    # Velocities that a point has on both sides bend the next segment when they turn.
    level = document(points=((0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (4.0, 0.0)), ties=())
    level = point_edits.set_points(
        level, 0, [replace(each, velocity=(4.0, 0.0)) for each in level.curves[0].points]
    )
    assert [is_straight(level.curves[0], segment) for segment in range(4)] == [False] * 4


# Files


def test_a_tie_is_written_only_for_tied_points():
    text = encode(document()).decode()
    assert text.count('"tied": true') == 1
    assert decode(text.encode()) == document()


@each_row(
    "point",
    [
        Point(0.0, 0.0, velocity=(1.0, 0.0), tied=True),
        Point(0.0, 0.0, velocity=(1.0, 0.0), corner=True, tied=True),
        Point(0.0, 0.0, velocity=(1.0, 0.0), corner=True, velocity_after=(1.0, 0.1), tied=True),
        Point(0.0, 0.0, velocity=(1.0, 0.0), corner=True, velocity_after=(-1.0, 0.0), tied=True),
    ],
)
def test_a_broken_tie_is_refused_in_a_file_and_removed_from_a_change(point):
    made = curve()
    wrong = Document((replace(made, points=(point, *made.points[1:])),))
    with pytest.raises(FormatError, match=r"points\[0\]\.tied needs a corner"):
        encode(wrong)
    assert with_plain_numbers(wrong).curves[0].points[0] == untie(point)


def test_an_untied_even_point_is_refused_in_a_file_and_mended_in_a_change():
    made, point = curve(), Point(0.0, 0.0, even=True)
    wrong = Document((replace(made, points=(point, *made.points[1:])),))
    with pytest.raises(FormatError, match=r"points\[0\]\.even needs a tied point"):
        encode(wrong)
    assert with_plain_numbers(wrong).curves[0].points[0] == Point(0.0, 0.0)


def test_a_retracted_handle_continues_no_straight_segment():
    """It has no direction: a corner between a handle of length 0 and a line became smooth."""
    start = Point(-1.0, 0.0, velocity=(1.0, 1.0))
    corner = Point(0.0, 1.0, corner=True, velocity=(0.0, 0.0), velocity_after=(4.0, -2.0))
    end = Point(2.0, 0.0, velocity=(4.0, -2.0))
    curve = replace(make_curve([], family=HERMITE), points=(start, corner, end))
    assert is_straight(curve, 1)
    assert tied_to_straight_segment(curve, 1) is corner
