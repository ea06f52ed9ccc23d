"""Other points for the same curve: the shape is kept, or the change is measured."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import point_edits, rule_edits
from app.document.constraints import is_straight
from app.document.derivatives import VelocityRule
from app.document.limits import EditError
from app.document.model import Document, ParametrizationKind, Point, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.distances import dense
from app.view_model.join import joined
from app.view_model.point_kinds import (
    jolts_of,
    with_corners,
    with_handle_retracted,
    with_smooth_points,
    with_symmetric_points,
)
from app.view_model.reshape import Reshaped, frozen, inserted_index, reversed_curve, with_point_inserted
from app.view_model.split import Split, split
from tests.rows import each_row

POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.0), (6.0, -1.0), (7.0, 1.0))
WITH_VELOCITIES = [family for family in FAMILIES if family.derivatives]
OVER_CONTROL_POINTS = [family for family in FAMILIES if not family.interpolates]
# Values are about 10, a handful of operations of 2⁻⁵³ each on values and derivatives.
ROUNDING = 1e-13
# Hundreds in each segment, of which each has few coefficients.
PLACES = np.random.default_rng(3).uniform(0.0, 1.0, 1000)


def view(family=HERMITE, points=POINTS, *, manual=True, closed=False, corner=None, **changes):
    """The view of a curve through `points`."""
    curve = replace(make_curve(points, family=family), closed=closed, **changes)
    if corner is not None:
        points = list(curve.points)
        points[corner] = replace(points[corner], corner=True)
        curve = replace(curve, points=tuple(points))
    made = view_of(curve)
    if not manual:
        return made
    frozen = rule_edits.freeze_parameters(Document((curve,)), 0, made.parameters.tolist())
    return view_of(frozen.curves[0])


def distance(before, after, shift=0.0):
    """The largest distance between two views at the same t: a second measurement, at other places."""
    t, values = at_places(before)
    return np.abs(values - after.curve.evaluate(t + shift)).max()


@lru_cache(maxsize=4)
def at_places(view):
    start, end = view.curve.domain
    t = start + (end - start) * PLACES
    return t, view.curve.evaluate(t)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("rule", VelocityRule)
@pytest.mark.parametrize("family", WITH_VELOCITIES)
def test_a_point_inserted_under_manual_parameters_keeps_the_shape(family, rule, closed):
    before = view(family, closed=closed, velocity_rule=rule)
    for t in np.linspace(*before.curve.domain, 12)[1:-1]:
        made = with_point_inserted(before, float(t))
        after = view_of(made.curve)
        assert len(made.curve.points) == len(POINTS) + 1
        assert made.residual < ROUNDING
        assert distance(before, after) < ROUNDING
        assert not made.parameters_moved


@pytest.mark.parametrize("family", WITH_VELOCITIES)
def test_a_point_inserted_beside_a_corner_keeps_the_corner(family):
    before = view(family, corner=2)
    t = float(before.parameters[1:3].mean())
    made = with_point_inserted(before, t)
    assert made.curve.points[3].corner
    assert made.residual < ROUNDING
    assert distance(before, view_of(made.curve)) < ROUNDING


def test_estimates_that_the_new_point_does_not_change_stay_estimates():
    before = view(points=[(float(x), float(x % 3)) for x in range(12)], velocity_rule=VelocityRule.BESSEL)
    made = with_point_inserted(before, float(before.parameters[5:7].mean()))
    explicit = [index for index, point in enumerate(made.curve.points) if point.velocity is not None]
    # The Bessel rule looks at the neighbours, so only those of the new point are written down.
    assert explicit == [5, 6, 7]


def test_a_natural_spline_through_one_more_of_its_points_is_the_same():
    made = with_point_inserted(view(), 0.37)
    assert made.residual < ROUNDING
    assert not made.curve.has_derivatives


def test_a_new_point_on_a_polynomial_changes_nothing_under_manual_parameters():
    before = view(LAGRANGE)
    made = with_point_inserted(before, 0.41)
    assert made.residual < ROUNDING
    assert view_of(made.curve).curve.degree == before.curve.degree + 1


@pytest.mark.parametrize("kind", [ParametrizationKind.UNIFORM, ParametrizationKind.CHORD_LENGTH])
@pytest.mark.parametrize("family", [family for family in FAMILIES if family.interpolates])
def test_an_insertion_under_a_rule_keeps_the_shape_or_measures_the_change(family, kind):
    """Parameters become manual where that keeps it; else the rule stays, and says what moved."""
    before = view(family, manual=False)
    curve = before.source
    before = view_of(replace(curve, parametrization=replace(curve.parametrization, kind=kind)))
    t = float(before.parameters[2:4].mean())
    made = with_point_inserted(before, t)
    after = view_of(made.curve)
    assert made.curve.points[3].position == tuple(before.curve.evaluate(t))
    if made.left_rule:
        assert made.curve.is_manual
        assert distance(before, after) < ROUNDING
        return
    assert made.parameters_moved
    assert made.curve.points[3].t is None
    old, new = (
        each.curve.evaluate(np.linspace(0, 1, count)) for each, count in ((before, 300), (after, 9000))
    )
    moved = np.hypot(*(old[:, None] - new[None]).transpose(2, 0, 1)).min(axis=1).max()
    # From no old point is the new curve farther away than was said; 9000 samples lie about 0.002 apart.
    assert 1e-4 < moved <= made.residual + 0.002


@each_row("kind", [ParametrizationKind.UNIFORM, ParametrizationKind.MANUAL])
@each_row("count", [2, 3, 4, 5, 6, 12])
@each_row("family", OVER_CONTROL_POINTS)
def test_one_more_control_point_keeps_the_shape_under_every_rule(family, count, kind):
    """A B-spline leaves its rule for that; the inner parameters of a Bézier curve do nothing anyway."""
    points = [(float(x), float(x * x % 5)) for x in range(count)]
    before = view(family, points, manual=kind is ParametrizationKind.MANUAL)
    if kind is not ParametrizationKind.MANUAL:
        rule = replace(before.source.parametrization, kind=kind)
        before = view_of(replace(before.source, parametrization=rule))
    for t in np.linspace(*before.curve.domain, 10)[1:-1]:
        made = with_point_inserted(before, float(t))
        after = view_of(made.curve)
        assert len(made.curve.points) == count + 1
        assert made.residual < ROUNDING
        assert distance(before, after) < ROUNDING
        assert not made.parameters_moved
        assert made.left_rule is (made.curve.is_manual and kind is not ParametrizationKind.MANUAL)
        assert made.sentence.endswith("The parameters are now manual.") is made.left_rule
        if family.name == "bezier":
            assert made.curve.parametrization.kind is kind
        # The one that is called the new one is the nearest to the place on the curve, by its parameter.
        index = inserted_index(before, float(t))
        assert abs(after.curve.nodes[index] - t) == np.abs(after.curve.nodes - t).min()


def test_a_knot_is_not_inserted_twice():
    """Knots of higher multiplicity are not written down by parameters that increase."""
    before = view(FAMILIES.named("b_spline"))
    with pytest.raises(EditError, match="The knot at t of point 3 is already there"):
        with_point_inserted(before, float(before.parameters[3]))
    # What is no knot stands nobody in the way.
    made = with_point_inserted(before, float(before.parameters[1]))
    assert distance(before, view_of(made.curve)) < ROUNDING


@each_row("place", [0.3, "a parameter"])
@each_row("count", [2, 3, 4, 5, 6, 12])
@each_row("family", OVER_CONTROL_POINTS)
def test_a_curve_over_control_points_is_split_exactly(family, count, place):
    before = view(family, [(float(x), float(x * x % 5)) for x in range(count)], manual=False)
    t = float(before.parameters[count // 2]) if place == "a parameter" and count > 2 else 0.3
    made = split(before, t)
    assert made.residual < ROUNDING
    first, second = map(view_of, made.curves)
    assert (first.curve.domain, second.curve.domain) == ((0.0, t), (t, 1.0))
    for part in (first, second):
        assert distance(part, before) < ROUNDING
    assert [part.name for part in made.curves] == ["Curve 1 a", "Curve 1 b"]


def test_handles_stay_when_a_point_is_inserted_under_a_rule():
    before = view(manual=False)
    document = point_edits.set_velocity(Document((before.source,)), 0, 5, (3.0, 40.0))
    before = view_of(document.curves[0])
    made = with_point_inserted(before, float(before.parameters[1:3].mean()))
    after = view_of(made.curve)
    reach = [
        np.array(each.velocity_of(last)) * each.spacing(last, ahead=False)
        for each, last in ((before, 5), (after, 6))
    ]
    assert reach[1] == pytest.approx(reach[0], rel=1e-12)


@each_row("t", [0.0, 1.0, -1.0, 2.0])
def test_no_point_is_inserted_at_a_point_or_outside_the_curve(t):
    with pytest.raises(EditError, match=r"not inside the curve|already there"):
        with_point_inserted(view(), t)


def test_points_without_a_curve_cannot_be_reshaped():
    lonely = view_of(make_curve([(1.0, 1.0)]))
    for act in (frozen, lambda each: with_point_inserted(each, 0.5), lambda each: split(each, 0.5)):
        with pytest.raises(EditError, match="at least two points"):
            act(lonely)
    with pytest.raises(EditError, match="at least two points"):
        joined(lonely, view())


# Split


@pytest.mark.parametrize("manual", [False, True])
@pytest.mark.parametrize("family", WITH_VELOCITIES)
def test_the_halves_of_a_hermite_curve_are_the_curve(family, manual):
    before = view(family, manual=manual, corner=2)
    for t in (*np.linspace(0, 1, 11)[1:-1], *before.parameters[1:-1]):
        done = split(before, float(t))
        first, second = map(view_of, done.curves)
        assert done.residual < ROUNDING
        assert first.curve.domain[1] == second.curve.domain[0] == pytest.approx(t)
        assert distance(first, before) < ROUNDING
        assert distance(second, before) < ROUNDING


@each_row("family", [*WITH_VELOCITIES, *OVER_CONTROL_POINTS, LAGRANGE])
def test_a_curve_is_cut_at_several_parameters_at_once(family):
    """At a joint and between joints, in whatever order they are named."""
    before = view(family)
    cuts = (0.83, float(before.parameters[2]), 0.1)
    parts = split(before, *cuts)
    assert [curve.name for curve in parts.curves] == [f"Curve 1 {letter}" for letter in "abcd"]
    assert parts.residual < 1e-11
    ends = [0.0, *sorted(cuts), 1.0]
    assert [view_of(curve).curve.domain for curve in parts.curves] == [
        pytest.approx(each) for each in pairwise(ends)
    ]


def test_a_corner_goes_into_both_halves_each_with_its_side():
    before = view(corner=2)
    first, second = split(before, float(before.parameters[2])).curves
    assert first.points[-1].velocity == before.velocity_of(2, ahead=False)
    assert second.points[0].velocity == before.velocity_of(2, ahead=True)
    assert not (first.points[-1].corner)
    assert not (second.points[0].corner)


@pytest.mark.parametrize("family", WITH_VELOCITIES)
def test_a_closed_curve_cut_once_is_one_open_curve(family):
    before = view(family, closed=True)
    for t in (0.0, 0.3, 0.99, *before.parameters):
        done = split(before, float(t))
        (curve,) = done.curves
        assert not curve.closed
        assert curve.points[0].position == curve.points[-1].position
        assert done.residual < ROUNDING
        start, end = view_of(curve).curve.domain
        assert end - start == pytest.approx(1.0)


def test_the_halves_of_a_polynomial_are_the_polynomial():
    before = view(LAGRANGE)
    done = split(before, 0.4)
    assert [len(curve.points) for curve in done.curves] == [6, 6]
    assert done.residual < ROUNDING
    for curve in done.curves:
        assert distance(view_of(curve), before) < ROUNDING


def test_a_polynomial_of_many_points_is_not_split():
    points = [(float(x), float(x % 2)) for x in range(41)]
    with pytest.raises(EditError, match="41 points cannot be split"):
        split(view(LAGRANGE, points), 0.5)


@each_row("family", FAMILIES)
def test_a_curve_is_not_split_at_its_ends(family):
    for t in (0.0, 1.0):
        with pytest.raises(EditError, match="between its ends"):
            split(view(family), t)


# Join


@pytest.mark.parametrize("family", WITH_VELOCITIES)
def test_the_parts_of_a_split_can_be_joined_again(family):
    before = view(family)
    for t in (0.3, float(before.parameters[2])):
        first, second = map(view_of, split(before, t).curves)
        made = joined(first, second)
        assert made.residual < ROUNDING
        assert not any(point.corner for point in made.curve.points)
        assert distance(before, view_of(made.curve)) < ROUNDING


@pytest.mark.parametrize("family", WITH_VELOCITIES)
def test_curves_that_meet_at_an_angle_make_a_corner(family):
    first = view(family)
    second = view(family, [(7.0, 1.0), (7.0, 4.0), (5.0, 5.0)], manual=False)
    made = joined(first, second)
    assert [index for index, point in enumerate(made.curve.points) if point.corner] == [5]
    assert len(made.curve.points) == 8
    after = view_of(made.curve)
    assert made.residual < ROUNDING
    assert distance(second, after, shift=1.0) < ROUNDING


@each_row("family", WITH_VELOCITIES)
@each_row("apart", [0.0, 2.0])
@each_row("cornered", ["first", "second", "both"])
def test_former_corners_at_joined_ends_keep_their_drawn_sides(family, apart, cornered):
    """A start that carries both sides of a corner has the one after it; the other went in: off by 1.9."""
    corner = {
        "corner": True,
        "velocity": (5.0, 5.0),
        "velocity_after": (0.0, -7.0),
        "acceleration": (1.0, 2.0),
        "acceleration_after": (-30.0, 4.0),
    }
    first, second = view(family).source, view(family, [(7.0, 1.0), (9.0, 4.0), (8.0, 5.0)]).source
    x, y = first.points[-1].position
    start = replace(second.points[0], x=x + apart, y=y)
    end = first.points[-1]
    if cornered != "second":
        end = replace(end, **corner)
    if cornered != "first":
        start = replace(start, **corner)
    a = view_of(replace(first, points=(*first.points[:-1], end)))
    b = view_of(replace(second, points=(start, *second.points[1:])))
    made = joined(a, b)
    assert made.residual < ROUNDING
    assert made.sentence.startswith("Shape kept")
    corners = [index for index, point in enumerate(made.curve.points) if point.corner]
    last = len(first.points) - 1
    assert corners == ([last, last + 1] if apart else [last])
    assert is_straight(made.curve, last) is bool(apart)


def test_a_change_beyond_rounding_is_not_reported_as_shape_kept():
    curve = view().source
    assert Reshaped(curve, 1e-12).sentence == "Shape kept, largest change 1e−12."
    assert Reshaped(curve, 1.9).sentence == "Shape changed by up to 1.9."
    assert Split((curve, curve), 1e-3).sentence == "shape changed by up to 0.001."


def test_a_straight_segment_connects_curves_that_do_not_meet():
    first = view()
    second = view(HERMITE, [(9.0, 1.0), (10.0, 4.0), (12.0, 5.0)])
    made = joined(first, second)
    after = view_of(made.curve)
    assert len(made.curve.points) == 9
    assert made.residual < ROUNDING
    assert after.velocity_of(5, ahead=False) == first.velocity_of(5)
    assert after.velocity_of(6) == second.velocity_of(0)
    assert is_straight(made.curve, 5)
    halfway = after.curve.evaluate(after.parameters[5:7].mean())
    assert halfway == pytest.approx((first.points[-1] + second.points[0]) / 2)


@pytest.mark.parametrize(
    ("first", "second", "reason"),
    [
        (view(LAGRANGE), view(), "Two polynomials cannot be joined"),
        (view(), view(QUINTIC_HERMITE), "one family for both"),
        (view(closed=True), view(), "is closed and has no end"),
    ],
)
def test_some_curves_cannot_be_joined(first, second, reason):
    with pytest.raises(EditError, match=reason):
        joined(first, second)


# Reverse


@each_row("closed", [False, True])
@each_row("manual", [False, True])
@each_row("family", FAMILIES)
def test_reversing_keeps_the_shape_and_twice_is_the_curve(family, manual, closed):
    before = view(family, manual=manual, closed=closed and family is not LAGRANGE, corner=1)
    document = point_edits.set_velocity(Document((before.source,)), 0, 1, (3.0, 1.0), ahead=True)
    before = view_of(document.curves[0])
    made = reversed_curve(before)
    # Through wild parameters a polynomial carries the rounding of its parameters, 1e-16, times some 100.
    assert made.residual < 1e-12
    again = reversed_curve(view_of(made.curve)).curve
    old, new = view_of(before.source), view_of(again)
    t = dense(old.parameters)
    assert new.curve.evaluate(t) == pytest.approx(old.curve.evaluate(t), abs=1e-12)
    assert [point.position for point in again.points] == [point.position for point in before.source.points]


def test_parameters_that_would_coincide_are_not_reversed():
    points = (Point(0, 0, t=0.0), Point(1, 1, t=1e-20), Point(2, 0, t=1.0))
    curve = replace(view(LAGRANGE).source, points=points)
    with pytest.raises(EditError, match="too close together"):
        reversed_curve(view_of(curve))


# Closed


@each_row("manual", [False, True])
@each_row("corner", [None, 2])
@each_row("rule", VelocityRule)
@each_row("family", WITH_VELOCITIES)
def test_a_closed_curve_is_smooth_across_its_seam(family, rule, corner, manual):
    closed = view(family, closed=True, velocity_rule=rule, corner=corner, manual=manual)
    start, end = closed.curve.domain
    for order in range(family.derivatives + 1):
        first, last = closed.curve.evaluate(start, order), closed.curve.evaluate(end, order)
        scale = np.abs(closed.curve.evaluate(np.linspace(start, end, 50), order)).max()
        assert first == pytest.approx(last, abs=1e-13 * scale)


def test_a_closed_natural_cubic_is_the_periodic_spline():
    points = np.array(POINTS)
    closed = view(closed=True, manual=False)
    splines = pytest.importorskip("scipy.interpolate")
    around = np.vstack([points, points[:1]])
    expected = splines.CubicSpline(closed.parameters, around, bc_type="periodic")
    t = np.linspace(0, 1, 301)
    assert closed.curve.evaluate(t) == pytest.approx(expected(t), abs=1e-12)
    # C² across the seam, too.
    assert closed.curve.evaluate(0.0, 2) == pytest.approx(closed.curve.evaluate(1.0, 2), rel=1e-9)


def test_explicit_data_at_the_seam_count_on_both_sides():
    closed = view(QUINTIC_HERMITE, closed=True)
    document = point_edits.set_velocity(Document((closed.source,)), 0, 0, (5.0, -3.0))
    document = point_edits.set_derivative(document, 0, 0, 2, (1.0, 2.0))
    after = view_of(document.curves[0])
    for order, expected in ((1, (5.0, -3.0)), (2, (1.0, 2.0))):
        for t in after.curve.domain:
            assert after.curve.evaluate(t, order) == pytest.approx(expected)


def test_a_corner_at_the_seam_has_two_sides():
    closed = view(closed=True, corner=0)
    start, end = closed.curve.domain
    assert closed.velocity_of(0, ahead=True) == pytest.approx(tuple(closed.curve.evaluate(start, 1)))
    assert closed.velocity_of(0, ahead=False) == pytest.approx(tuple(closed.curve.evaluate(end, 1)))
    assert closed.velocity_of(0, ahead=True) != pytest.approx(closed.velocity_of(0, ahead=False))


# Corners


@each_row("closed", [False, True])
@each_row("rule", VelocityRule)
@each_row("family", WITH_VELOCITIES)
@each_row("chosen", [[2], [1, 2, 4]])
def test_corners_and_smooth_points_keep_the_shape(family, rule, closed, chosen):
    before = view(family, closed=closed, velocity_rule=rule, manual=False)
    cornered = view_of(with_corners(before, chosen))
    assert [index for index, point in enumerate(cornered.source.points) if point.corner] == chosen
    assert distance(before, cornered) < ROUNDING
    # The segments differ in length, and with them the handles, which become equally long.
    symmetric = view_of(with_symmetric_points(cornered, chosen))
    assert all(are_mirrored(symmetric, index) for index in chosen)
    assert distance(symmetric, view_of(with_symmetric_points(symmetric, chosen))) < ROUNDING
    if not rule.is_spline or family.derivatives == 1 or chosen == [2]:
        # Between equal segments point 4 keeps estimates of higher orders, which follow the velocities.
        assert distance(symmetric, view_of(with_symmetric_points(before, chosen))) < ROUNDING
    # Handles that lie on a line are tied as they are, from a corner as from a point that is none.
    for start, shape in ((before, before), (cornered, before), (symmetric, symmetric)):
        smooth = view_of(with_smooth_points(start, chosen))
        assert [index for index, point in enumerate(smooth.source.points) if point.tied] == chosen
        assert distance(shape, smooth) < ROUNDING
        assert distance(shape, view_of(with_corners(smooth, chosen))) < ROUNDING
        assert distance(symmetric, view_of(with_symmetric_points(smooth, chosen))) < ROUNDING


def are_mirrored(shown, index):
    """Whether all derivatives at a point, per unit of the segment on each side, are the same."""
    before, after = (
        [
            np.array(shown.derivative_of(index, order, ahead=ahead))
            * shown.spacing(index, ahead=ahead) ** order
            for order in range(1, shown.source.family.derivatives + 1)
        ]
        for ahead in (False, True)
    )
    return np.allclose(before, after, rtol=1e-12, atol=1e-12)


def test_a_cusp_is_a_visible_corner():
    """The facts of a curve said "2 points with two sides" of retracted handles."""
    cusp = view(QUINTIC_HERMITE, manual=False)
    for ahead in (False, True):
        cusp = view_of(with_handle_retracted(cusp, 2, ahead=ahead))
    assert cusp.corners == [2]
    assert jolts_of(cusp) == []


@each_row("family", WITH_VELOCITIES)
def test_symmetric_points_between_equal_segments_keep_the_shape_and_stay_symmetric(family):
    before = view(family, points=[(0, 0), (1, 2), (2, 0), (3, 2), (4, 0)], manual=False)
    for start in (before, view_of(with_corners(before, [2]))):
        symmetric = view_of(with_symmetric_points(start, [2]))
        assert symmetric.source.points[2].even
        assert symmetric.source.points[2].velocity == pytest.approx(before.velocity_of(2))
        assert distance(before, symmetric) < ROUNDING
        moved = view_of(point_edits.move_points(Document((symmetric.source,)), 0, [3], (0.4, 1.5)).curves[0])
        assert are_mirrored(moved, 2)


def test_symmetric_handles_that_cancel_each_other_get_one_direction():
    """Their mean was zero: a point without a tangent."""
    cornered = with_corners(view(manual=False), [2])
    point, ahead = cornered.points[2], view(manual=False).spacing(2, ahead=True)
    behind = view(manual=False).spacing(2, ahead=False)
    turned = replace(
        point, velocity=(-3.0 / behind, -1.0 / behind), velocity_after=(3.0 / ahead, 1.0 / ahead)
    )
    start = view_of(replace(cornered, points=(*cornered.points[:2], turned, *cornered.points[3:])))
    symmetric = view_of(with_symmetric_points(start, [2]))
    assert are_mirrored(symmetric, 2)
    assert np.multiply(symmetric.velocity_of(2), ahead) == pytest.approx((3.0, 1.0))


def test_the_start_of_a_closed_curve_may_be_a_corner():
    before = view(QUINTIC_HERMITE, closed=True, manual=False)
    cornered = view_of(with_corners(before, [0]))
    assert cornered.source.points[0].velocity_after == before.velocity_of(0)
    assert distance(before, cornered) < ROUNDING
    assert are_mirrored(view_of(with_symmetric_points(cornered, [0])), 0)
    assert distance(before, view_of(with_smooth_points(cornered, [0]))) < ROUNDING


@pytest.mark.parametrize(
    ("rule", "changed"), [(VelocityRule.NATURAL_SPLINE, (0, 8)), (VelocityRule.BESSEL, (3, 5))]
)
def test_symmetric_sets_no_other_point(rule, changed):
    """Estimates of a spline follow the new velocity, which keeps curvature continuous; local ones stay."""
    points = [(float(x), float(x % 3)) for x in range(9)]
    cornered = view_of(with_corners(view(points=points, velocity_rule=rule), [4]))
    document = point_edits.set_velocity(Document((cornered.source,)), 0, 4, (30.0, -20.0), ahead=True)
    turned = view_of(document.curves[0])
    smooth = view_of(with_symmetric_points(turned, [4]))
    assert smooth.velocity_of(4) == pytest.approx(
        (np.array(turned.velocity_of(4)) + turned.velocity_of(4, ahead=False)) / 2
    )
    assert point_edits.explicit_points(smooth.source, range(9)) == {4}
    t = np.linspace(0, 1, 501)
    moved = t[np.abs(turned.curve.evaluate(t) - smooth.curve.evaluate(t)).max(axis=1) > ROUNDING]
    low, high = turned.parameters[list(changed)]
    assert low <= moved.min() < low + 0.01
    assert high - 0.01 < moved.max() <= high


def test_without_a_curve_there_are_no_tangents():
    nothing = view_of(make_curve([(0, 0)], family=HERMITE))
    for make in (with_corners, with_smooth_points, with_symmetric_points):
        with pytest.raises(EditError, match="no tangent at point 0"):
            make(nothing, [0])
