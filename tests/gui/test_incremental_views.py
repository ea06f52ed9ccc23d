"""A view made from the one before it equals the view made from nothing, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from app.document import point_edits, rule_edits
from app.document.derivatives import AccelerationRule, VelocityRule
from app.document.limits import EditError
from app.document.model import Curve, Document, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE
from app.view_model.curve.curve_view import CurveView, view_of
from app.view_model.curve.handles import handles_of
from app.view_model.curve.moving import Flattener
from curvecore import LagrangeCurve
from curvecore.bezier.flatten import flatten_pieces, segment_distance

SQUARE = ((0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, 3.0), (5.5, 0.0))
numbers = st.floats(-5, 5, allow_subnormal=False)
vectors = st.tuples(numbers, numbers)
places = st.integers(0, 4)


def step(data, document: Document, curve: Curve, view: CurveView) -> Document:
    """One random edit."""
    index = data.draw(places) % len(curve.points)
    point = curve.points[index]
    match data.draw(st.integers(0, 11)):
        case 0 | 1 | 2:
            return point_edits.move_points(document, 0, {index}, data.draw(vectors))
        case 3:
            return point_edits.move_points(document, 0, range(len(curve.points)), data.draw(vectors))
        case 4:
            return point_edits.set_velocity(document, 0, index, data.draw(st.none() | vectors))
        case 5:
            return point_edits.set_derivative(document, 0, index, 2, data.draw(st.none() | vectors))
        case 6:
            return point_edits.make_corner(document, 0, index, data.draw(st.none() | vectors), None)
        case 7:
            flat = replace(point, corner=False, velocity_after=None, acceleration_after=None)
            points = (*curve.points[:index], flat, *curve.points[index + 1 :])
            return document.with_curve(0, replace(curve, points=points))
        case 8:
            return rule_edits.set_family(document, 0, data.draw(st.sampled_from(FAMILIES)))
        case 9:
            kind = data.draw(st.sampled_from(ParametrizationKind))
            return rule_edits.set_parametrization(document, 0, kind, view.parameters.tolist())
        case 10:
            return document.with_curve(0, replace(curve, closed=not curve.closed))
        case _:
            rules = data.draw(st.sampled_from(VelocityRule)), data.draw(st.sampled_from(AccelerationRule))
            changed = replace(curve, velocity_rule=rules[0], acceleration_rule=rules[1])
            return document.with_curve(0, changed)


def assert_same(view: CurveView, fresh: CurveView) -> None:
    assert view.problem == fresh.problem
    assert np.array_equal(view.points, fresh.points)
    assert np.array_equal(view.arrays.given, fresh.arrays.given, equal_nan=True)
    assert np.array_equal(view.arrays.times, fresh.arrays.times, equal_nan=True)
    assert np.array_equal(view.arrays.corners, fresh.arrays.corners)
    if not fresh.is_current:
        return
    assert np.array_equal(view.parameters, fresh.parameters)
    assert np.array_equal(view.curve.jets, fresh.curve.jets)
    assert type(view.curve) is type(fresh.curve)
    t = np.linspace(*fresh.curve.domain, 37)
    assert np.array_equal(view.curve.evaluate(t), fresh.curve.evaluate(t))
    assert_drawn(view, t)


def assert_drawn(view: CurveView, t: np.ndarray) -> None:
    """The polyline, taken over from view to view or not, lies within the tolerance of the curve."""
    drawn = view.flattened(1e-3, (-10.0, -10.0, 10.0, 10.0))
    points = view.curve.evaluate(t)
    inside = np.abs(points).max(axis=1) < 10.0
    piece = np.clip(np.searchsorted(drawn.parameters, t, side="right") - 1, 0, len(drawn.parameters) - 2)
    distance = segment_distance(points, drawn.points[piece], drawn.points[piece + 1])
    assert (distance[inside] <= 1e-3).all()


@given(st.data())
def test_random_edits_with_undo(data):
    document = Document((make_curve(SQUARE, family=data.draw(st.sampled_from(FAMILIES))),))
    view, history = view_of(document.curves[0]), [document]
    for _ in range(data.draw(st.integers(1, 8))):
        if data.draw(st.integers(0, 4)) == 0:
            # Undo, or a drag cancelled: an earlier value comes back.
            document = data.draw(st.sampled_from(history))
        else:
            try:
                document = step(data, document, document.curves[0], view)
            except EditError:
                continue
            history.append(document)
        view = view_of(document.curves[0], view)
        assert_same(view, view_of(document.curves[0]))


def test_unchanged_parts_of_a_view_are_the_same_objects():
    document = Document((make_curve(SQUARE, family=HERMITE),))
    view = view_of(document.curves[0])
    moved = view_of(point_edits.move_points(document, 0, {2}, (0.5, 0.0)).curves[0], view)
    assert moved.points is not view.points
    assert moved.arrays.given is view.arrays.given
    assert moved.arrays.times is view.arrays.times
    assert not moved.points.flags.writeable


def test_a_lagrange_curve_at_frozen_parameters_keeps_its_samples():
    document = Document((make_curve(SQUARE),))
    uniform = rule_edits.set_parametrization(document, 0, ParametrizationKind.UNIFORM, [])
    view = view_of(uniform.curves[0])
    key = (1e-3, (-10.0, -10.0, 10.0, 10.0))
    view.flattened(*key)
    frozen = set()
    for step_size in (0.0, 1e-3, 2e-3, 3e-3):
        view = view_of(point_edits.move_points(uniform, 0, {1}, (step_size, 0.1)).curves[0], view)
        view.flattened(*key)
        frozen.add(id(view._flattener._drawn._frozen))
    assert isinstance(view._flattener, Flattener)
    assert len(frozen) == 1


def dragged(family, way, kind=ParametrizationKind.UNIFORM):
    """A curve whose third point is dragged, as its view follows it, and its view made from nothing."""
    document = Document((make_curve(SQUARE, family=family),))
    document = rule_edits.set_parametrization(document, 0, kind, [])
    first = view_of(document.curves[0])
    view = view_of(point_edits.move_points(document, 0, {2}, (0.1, 0.0)).curves[0], first)
    view = view_of(point_edits.move_points(document, 0, {2}, way).curves[0], view)
    return view, view_of(view.source)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_a_dragged_point_computes_the_curve_on_request_only(family):
    view, fresh = dragged(family, (0.5, -0.25))
    assert view.is_followed
    drawn = view.flattened(1e-3, (-10.0, -10.0, 10.0, 10.0))
    assert view.is_current
    assert view.has_curve
    assert not view.problem
    assert not view.corners
    assert np.array_equal(view.parameters, fresh.parameters)
    assert view.basis_curve.functions_key == fresh.basis_curve.functions_key
    assert view.is_followed
    assert np.abs(drawn.points - fresh.curve.evaluate(drawn.parameters)).max() < 1e-13
    assert np.array_equal(view.curve.jets, fresh.curve.jets)
    assert not view.is_followed


@pytest.mark.parametrize("index", range(5))
@pytest.mark.parametrize(
    "family", [family for family in FAMILIES if family.derivatives], ids=lambda family: family.name
)
def test_handles_follow_a_dragged_point_and_are_exact_when_the_point_rests(family, index):
    view, fresh = dragged(family, (0.5, -0.25))
    expected = handles_of(fresh, index)
    followed = handles_of(view, index)
    assert view.is_followed
    assert [(each.order, each.ahead, each.explicit) for each in followed] == [
        (each.order, each.ahead, each.explicit) for each in expected
    ]
    for one, other in zip(followed, expected, strict=True):
        assert (one.position, one.anchor) == (
            pytest.approx(other.position, abs=1e-13),
            pytest.approx(other.anchor, abs=1e-13),
        )
    view.settle()
    assert handles_of(view, index) == expected


def test_parameters_that_answer_to_points_are_not_followed():
    assert not dragged(HERMITE, (0.5, 0.0), ParametrizationKind.CHORD_LENGTH)[0].is_followed


def test_the_handles_drawn_after_a_drag_are_exact(editor):
    """Released, undone, or given up halfway with Escape: the handles are those of the curve."""
    editor.choose_family(HERMITE)
    editor.select([2])
    layer, session = editor.window.canvas.drawing.points, editor.session

    def assert_exact():
        assert not session.active_view.is_followed
        assert list(layer.handles) == handles_of(view_of(session.active_curve), 2)

    editor.drag_point(2, to=(2.5, 1.5))
    assert_exact()
    editor.trigger("undo")
    assert_exact()
    place = editor.point(2)
    editor.press(place)
    editor.move((place[0] + 0.5, place[1] + 0.25))
    editor.escape()
    assert_exact()
    editor.release(place)


def test_a_curve_too_wild_for_frozen_samples_is_flattened_once_a_step():
    """Samples of its own were taken in every frame as well, and did not serve: a third of a second each."""
    rng = np.random.default_rng(5)
    t = np.linspace(0.0, 1.0, 120)
    flattener, key = Flattener(), (1e-3, (-3.0, -3.0, 3.0, 3.0))
    for _ in range(4):
        curve = LagrangeCurve(rng.normal(size=(120, 2)), t)
        line = flattener.polyline(curve, key)
        assert (line.parameters == flatten_pieces(curve, *key).parameters).all()
    assert flattener._drawn._frozen is None
    # Another scale is tried anew, and a calm curve is followed again.
    calm = LagrangeCurve(np.column_stack([t, t**2])[:9], np.linspace(0.0, 1.0, 9))
    for _ in range(2):
        flattener.polyline(calm, (2e-3, key[1]))
    assert flattener._drawn._frozen is not None
