"""Edits of whole curves, of corners, and of closed curves."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import curve_edits, point_edits, rule_edits
from app.document.group_edits import move_into
from app.document.limits import EditError
from app.document.model import Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.several_curves import set_appearance
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.storage.validation import validate
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

CUBIC_SPLINE = FAMILIES.named("cubic_spline")
SEPTIC_HERMITE = FAMILIES.named("septic_hermite")
SQUARE = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))


@pytest.fixture
def three():
    """Three curves, named A, B and C."""
    return Document(tuple(make_curve(SQUARE, name=name, family=HERMITE) for name in "ABC"))


def names(document):
    return "".join(curve.name for curve in document.curves)


def manual(family=HERMITE, **changes):
    """A document with a square of manual parameters 0, 1, 2, 3."""
    points = tuple(Point(x, y, t=float(t)) for t, (x, y) in enumerate(SQUARE))
    rule = Parametrization(ParametrizationKind.MANUAL)
    return Document((replace(make_curve((), family=family), points=points, parametrization=rule, **changes),))


def test_curves_are_added_moved_and_removed(three):
    added = curve_edits.add_curve(three, 1, make_curve((), name="N"))
    assert names(added) == "ANBC"
    assert names(curve_edits.add_curve(three, 3, make_curve((), name="N"))) == "ABCN"
    assert names(move_into(three, {0}, 3).document) == "BCA"
    assert names(move_into(three, {2}, 0).document) == "CAB"
    assert names(curve_edits.remove_curve(three, 1)) == "AC"


def test_removing_the_last_curve_leaves_an_empty_one():
    (curve,) = curve_edits.remove_curve(manual(), 0).curves
    assert curve.points == ()


def test_a_new_curve_gets_an_unused_name(three):
    assert curve_edits.unused_name(three) == "Curve 1"
    taken = curve_edits.rename_curve(three, 0, "Curve 1")
    assert curve_edits.unused_name(taken) == "Curve 2"


def test_setting_the_appearance_changes_only_the_appearance(three):
    changed = set_appearance(three, {1}, colour="#0072b2")
    changed = set_appearance(changed, {1}, visible=False)
    changed = set_appearance(changed, {1}, locked=True)
    curve = changed.curves[1]
    assert (curve.style.stroke, curve.visible, curve.locked) == ("#0072b2", False, True)
    assert curve.points == three.curves[1].points
    assert changed.curves[0] is three.curves[0]
    validate(changed)


# Locked


def test_changing_a_locked_curve_is_refused(three):
    locked = set_appearance(three, {1}, locked=True)
    for changed in (
        point_edits.move_points(locked, 1, [0], (1.0, 0.0)),
        rule_edits.set_family(locked, 1, LAGRANGE),
        curve_edits.remove_curve(locked, 1),
    ):
        with pytest.raises(EditError, match="“B” is locked"):
            curve_edits.refuse_locked(locked, changed)


def test_a_locked_curve_may_change_its_appearance_and_order(three):
    locked = set_appearance(three, {1}, locked=True)
    for changed in (
        locked,
        curve_edits.rename_curve(locked, 1, "Other"),
        set_appearance(locked, {1}, colour="#d55e00"),
        set_appearance(locked, {1}, visible=False),
        set_appearance(locked, {1}, locked=False),
        move_into(locked, {1}, 0).document,
        curve_edits.remove_curve(locked, 0),
        point_edits.move_points(locked, 0, [0], (1.0, 0.0)),
    ):
        curve_edits.refuse_locked(locked, changed)


# Corners


def test_a_corner_has_two_velocities_and_both_accelerations():
    document = point_edits.set_derivative(manual(), 0, 1, 2, (1.0, 2.0))
    cornered = point_edits.make_corner(document, 0, 1, (1.0, 0.0), (0.0, 1.0))
    point = cornered.curves[0].points[1]
    assert (point.corner, point.velocity, point.velocity_after) == (True, (1.0, 0.0), (0.0, 1.0))
    assert point.acceleration == point.acceleration_after == (1.0, 2.0)
    validate(cornered)


def test_reversing_a_corner_exchanges_its_jerks():
    document = point_edits.set_derivative(manual(), 0, 1, 3, (1.0, 2.0))
    document = point_edits.make_corner(document, 0, 1, (1.0, 0.0), (0.0, 1.0))
    document = point_edits.set_derivative(document, 0, 1, 3, (5.0, 6.0), ahead=True)
    document = point_edits.set_derivative(document, 0, 1, 2, (7.0, 8.0), ahead=True)
    point = document.curves[0].points[1]
    assert (point.jerk, point.jerk_after) == ((1.0, 2.0), (5.0, 6.0))
    parameters = [each.t for each in document.curves[0].points]
    turned = curve_edits.reverse_curve(document, 0, parameters).curves[0].points[-2]
    assert (turned.velocity, turned.velocity_after) == ((-0.0, -1.0), (-1.0, -0.0))
    assert (turned.acceleration, turned.acceleration_after) == ((7.0, 8.0), None)
    assert (turned.jerk, turned.jerk_after) == ((-5.0, -6.0), (-1.0, -2.0))
    validate(document)


def test_each_side_of_a_corner_is_set_by_itself():
    document = point_edits.make_corner(manual(), 0, 1, None, None)
    document = point_edits.set_velocity(document, 0, 1, (3.0, 0.0), ahead=True)
    document = point_edits.set_derivative(document, 0, 1, 2, (4.0, 0.0), ahead=False)
    point = document.curves[0].points[1]
    assert (point.velocity, point.velocity_after) == (None, (3.0, 0.0))
    assert (point.acceleration, point.acceleration_after) == ((4.0, 0.0), None)


def test_clearing_derivatives_clears_both_sides_of_a_corner():
    document = point_edits.make_corner(manual(), 0, 1, (1.0, 0.0), (0.0, 1.0))
    point = point_edits.clear_derivatives(document, 0, [1]).curves[0].points[1]
    assert (point.corner, point.velocity, point.velocity_after) == (True, None, None)


def test_numbers_of_both_sides_of_a_corner_are_checked():
    wild = Point(0.0, 0.0, corner=True, velocity_after=(1e13, 0.0))
    with pytest.raises(EditError, match="x of the velocity of point 0"):
        point_edits.set_points(manual(), 0, [wild])
    with pytest.raises(EditError, match="x of the velocity of the point"):
        point_edits.insert_points(manual(), 0, 0, [wild])


# Closed


def test_closing_a_polynomial_is_refused():
    with pytest.raises(EditError, match="is one polynomial"):
        curve_edits.set_closed(manual(LAGRANGE), 0, True)


def test_closing_two_points_is_refused_with_a_reason():
    document = point_edits.delete_points(manual(CUBIC_SPLINE), 0, [0, 1])
    with pytest.raises(EditError, match=r"at least three points here: through two, a cubic .*there and back"):
        curve_edits.set_closed(document, 0, True)


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE, SEPTIC_HERMITE])
def test_two_points_with_derivatives_can_be_closed_and_one_cannot(family):
    document = point_edits.delete_points(manual(family), 0, [2, 3])
    closed = curve_edits.set_closed(document, 0, True)
    validate(closed)
    lens = point_edits.set_velocity(point_edits.set_velocity(closed, 0, 0, (0.0, 4.0)), 0, 1, (0.0, -4.0))
    for each in (closed, lens):
        view = view_of(each.curves[0])
        places = view.curve.evaluate(np.linspace(*view.curve.domain, 33))
        assert view.is_current
        assert np.isfinite(places).all()
        assert np.allclose(places[[0, 16, 32]], [(0, 0), (2, 0), (0, 0)])
        # There and back: on one line, or round about it.
        height = 0.0 if each is closed else places[:, 1].max()
        assert np.allclose(places[8], (1.0, height))
        assert np.allclose(places[24], (1.0, -height))
    assert height > 0.5
    one = point_edits.delete_points(document, 0, [1])
    with pytest.raises(EditError, match="at least two points"):
        curve_edits.set_closed(one, 0, True)


@pytest.mark.parametrize(("family", "least"), [(HERMITE, 2), (CUBIC_SPLINE, 3)])
def test_a_closed_curve_stays_closed_as_long_as_its_points_make_an_area(family, least):
    document = curve_edits.set_closed(manual(family), 0, True)
    for count in (3, 2, 1):
        document = point_edits.delete_points(document, 0, [0])
        assert len(document.curves[0].points) == count
        assert document.curves[0].closed is (count >= least)


def test_closing_manual_parameters_adds_a_segment_of_mean_length():
    closed = curve_edits.set_closed(manual(), 0, True)
    assert closed.curves[0].parametrization.end == 4.0
    assert closed.curves[0].interval == (0.0, 4.0)
    assert view_of(closed.curves[0]).parameters.tolist() == [0, 1, 2, 3, 4]
    validate(closed)


def test_handles_stay_when_a_curve_is_closed():
    document = point_edits.set_velocity(manual(), 0, 0, (4.0, 2.0))
    closed = curve_edits.set_closed(document, 0, True, parameter_scale=0.5)
    assert closed.curves[0].points[0].velocity == (8.0, 4.0)


@each_row(
    "change",
    [
        lambda document: rule_edits.freeze_parameters(document, 0, [0.0, 5.0, 6.0, 9.0]),
        lambda document: point_edits.insert_points(document, 0, 4, [Point(1.0, 3.0, t=7.0)]),
        lambda document: point_edits.append_point(document, 0, Point(1.0, 3.0, t=4.5)),
        lambda document: rule_edits.set_family(rule_edits.set_family(document, 0, LAGRANGE), 0, HERMITE),
    ],
)
def test_the_interval_of_a_closed_curve_ends_after_its_last_parameter(change):
    closed = curve_edits.set_closed(manual(), 0, True)
    changed = change(closed)
    validate(changed)
    view = view_of(changed.curves[0])
    assert view.is_current
    assert view.parameters[-1] > view.parameters[-2]


def test_stored_manual_parameters_return_to_a_closed_curve():
    closed = curve_edits.set_closed(manual(), 0, True)
    uniform = rule_edits.set_parametrization(closed, 0, ParametrizationKind.UNIFORM, [])
    shorter = rule_edits.set_interval(uniform, 0, 0.0, 1.0)
    back = rule_edits.set_parametrization(shorter, 0, ParametrizationKind.MANUAL, [])
    validate(back)
    assert view_of(back.curves[0]).is_current


def test_the_t_of_the_last_point_must_be_less_than_the_end():
    closed = curve_edits.set_closed(manual(), 0, True)
    with pytest.raises(EditError, match="less than 4, the t at which the curve returns to its first point"):
        rule_edits.set_parameter(closed, 0, 3, 4.5, [0.0, 1.0, 2.0, 3.0, 4.0])
    later = rule_edits.set_parameter(closed, 0, 4, 6.0, [0.0, 1.0, 2.0, 3.0, 4.0])
    assert later.curves[0].parametrization.end == 6.0
    validate(later)


# Reverse


def test_reversing_reverses_points_parameters_and_sides():
    document = point_edits.make_corner(manual(), 0, 1, (1.0, 0.0), (0.0, 1.0))
    turned = curve_edits.reverse_curve(document, 0, [0.0, 1.0, 2.0, 3.0])
    points = turned.curves[0].points
    assert [point.position for point in points] == list(reversed(SQUARE))
    assert [point.t for point in points] == [0, 1, 2, 3]
    assert (points[2].velocity, points[2].velocity_after) == ((0.0, -1.0), (-1.0, 0.0))
    validate(turned)
    assert curve_edits.reverse_curve(turned, 0, [0.0, 1.0, 2.0, 3.0]) == document


def test_a_reversed_closed_curve_keeps_its_first_point():
    closed = curve_edits.set_closed(manual(), 0, True)
    turned = curve_edits.reverse_curve(closed, 0, [0.0, 1.0, 2.0, 3.0, 4.0])
    assert [point.position for point in turned.curves[0].points] == [
        SQUARE[0],
        SQUARE[3],
        SQUARE[2],
        SQUARE[1],
    ]
    validate(turned)


@pytest.mark.parametrize("closed", [False, True])
def test_stored_parameters_increase_after_reversing(closed):
    document = rule_edits.set_parametrization(manual(closed=closed), 0, ParametrizationKind.UNIFORM, [])
    document = rule_edits.set_interval(document, 0, 5.0, 5.5)
    turned = curve_edits.reverse_curve(document, 0, view_of(document.curves[0]).parameters.tolist())
    validate(turned)
