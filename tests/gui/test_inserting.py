"""Points inserted on the line, between those selected, and at special points, with real events."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.append import SPECIAL_POINTS
from app.view_model.curve.curve_view import view_of
from tests.exact_pieces import at, cross, pieces_of, sign_changes, value

SHIFT = Qt.KeyboardModifier.ShiftModifier
BOW = ((0, 0), (1, 2), (3, 2.5), (4, 1), (6, 0))


def begin(editor, *curves, kind=ParametrizationKind.MANUAL):
    """Edit the first of curves; with parameters of its own its shape is kept."""
    document = rule_edits.set_parametrization(
        Document(curves), 0, kind, view_of(curves[0]).parameters.tolist()
    )
    editor.session.commit(document, "Begin", active=0)
    editor.fit()
    return editor


def on_line(editor, segment, share=0.4):
    """Return a place of the line."""
    knots = editor.session.active_view.parameters
    t = knots[segment] + share * (knots[segment + 1] - knots[segment])
    return tuple(editor.session.active_view.curve.evaluate(float(t)).tolist())


def drawn(editor):
    view = editor.session.active_view
    return view.curve.evaluate(np.linspace(*view.curve.domain, 301))


def test_a_double_click_on_the_line_inserts_a_point(editor):
    begin(editor, make_curve(BOW, family=HERMITE))
    before, steps = drawn(editor), editor.session.undo_stack.count()
    place = on_line(editor, 1)
    editor.click(place)
    assert "c(t) = (" in editor.status
    assert editor.session.undo_stack.count() == steps
    editor.double_click(place)
    assert len(editor.curve.points) == 6
    assert editor.session.selected.points == {2}
    assert editor.curve.points[2].position == pytest.approx(place, abs=0.05)
    assert drawn(editor) == pytest.approx(before, abs=1e-9)
    assert (editor.session.undo_stack.count(), editor.session.undo_stack.undoText()) == (
        steps + 1,
        "Insert point 2",
    )
    assert "shape kept" in editor.status.lower()


def test_a_double_click_with_shift_inserts_nothing(editor):
    begin(editor, make_curve(BOW, family=HERMITE))
    editor.double_click(on_line(editor, 1), keys=SHIFT)
    assert len(editor.curve.points) == 5


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE, LAGRANGE])
def test_a_double_click_inserts_a_point_on_any_curve(editor, family):
    """On a curve that was not edited it did nothing but edit it."""
    other = make_curve([(0, 4), (3, 5), (6, 4)], name="Other", family=family)
    begin(editor, make_curve(BOW, family=HERMITE), other)
    editor.select([1, 2])
    place = tuple(editor.session.views[1].curve.evaluate(0.2).tolist())
    editor.hover(place)
    assert "click to edit it, double-click to insert a point" in editor.status
    before, steps = editor.session.views[1], editor.session.undo_stack.count()
    editor.double_click(place)
    assert editor.session.active_index == 1
    assert [len(curve.points) for curve in editor.session.document.curves] == [5, 4]
    assert editor.session.selected.points == {1}
    assert editor.curve.points[1].position == pytest.approx(place, abs=0.05)
    shape = before.curve.evaluate(np.linspace(*before.curve.domain, 301))
    assert drawn(editor) == pytest.approx(shape, abs=1e-9)
    assert editor.session.undo_stack.count() == steps + 1
    editor.trigger("undo")
    assert editor.session.document.curves[1] == other
    # Two clicks far apart are no double click.
    editor.session.selected.activate(0)
    editor.click(place)
    assert editor.session.active_index == 1
    editor.double_click(tuple(editor.session.views[0].curve.evaluate(0.3).tolist()))
    assert [len(curve.points) for curve in editor.session.document.curves] == [6, 3]


def test_a_double_click_inserts_nothing_on_curves_that_are_locked_or_selected_as_wholes(editor):
    locked = replace(make_curve([(0, 4), (3, 5), (6, 4)], name="Other"), locked=True)
    begin(editor, make_curve(BOW, family=HERMITE), locked)
    editor.double_click(tuple(editor.session.views[1].curve.evaluate(0.2).tolist()))
    assert editor.session.document.curves[1] == locked
    # While none is edited, a double click edits one, as its hint says; the next one inserts.
    editor.session.selected.select_whole([])
    place = on_line(editor, 1)
    editor.double_click(place)
    assert editor.session.selected.is_editing
    assert len(editor.curve.points) == 5
    editor.double_click(place)
    assert len(editor.curve.points) == 6


def is_as_told(editor, before):
    """Whether the shape is as it was, or said to be another: not all families can keep it."""
    return np.allclose(drawn(editor), before, atol=1e-6) == ("shape kept" in editor.status.lower())


def test_the_key_halves_segments_between_selected_points(editor):
    for family in FAMILIES:
        begin(editor, make_curve(BOW, family=family))
        before = drawn(editor)
        editor.select([1, 2, 4])
        editor.key(Qt.Key.Key_Insert)
        assert len(editor.curve.points) == 6, family
        assert is_as_told(editor, before), family
        editor.trigger("undo")
        editor.select([0, 1, 2, 4])
        editor.key(Qt.Key.Key_Insert)
        assert len(editor.curve.points) == 7, family
        assert is_as_told(editor, before), family
        assert editor.session.undo_stack.undoText() == "Insert 2 points between", family
        if family.interpolates:
            assert editor.session.selected.points == {0, 1, 2, 3, 4, 6}, family


def test_the_closing_segment_is_halved_and_unconnected_ends_are_refused(editor):
    begin(editor, make_curve(BOW, family=HERMITE), kind=ParametrizationKind.CHORD_LENGTH)
    editor.select([0, 4])
    editor.key(Qt.Key.Key_Insert)
    assert len(editor.curve.points) == 5
    assert editor.status.startswith("Select two neighbouring points")
    editor.trigger("closeCurve")
    editor.select([0, 4])
    editor.key(Qt.Key.Key_Insert)
    assert len(editor.curve.points) == 6
    assert editor.session.selected.points == {0, 4, 5}
    assert "The parameters are now manual." in editor.status


def test_under_a_rule_the_shape_stays_as_the_parameters_become_manual(editor):
    """The shape changed, which was only said, or kept by one click more."""
    kinds = (ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM)
    for act, kind in product(("double click", "key", "pen"), kinds):
        begin(editor, make_curve(BOW, family=HERMITE), kind=kind)
        before, document = drawn(editor), editor.session.document
        place = on_line(editor, 1)
        if act == "key":
            editor.select([1, 2, 3])
            editor.key(Qt.Key.Key_Insert)
        elif act == "pen":
            editor.add_point(*place)
        else:
            editor.double_click(place)
        assert len(editor.curve.points) == (7 if act == "key" else 6), (act, kind)
        assert drawn(editor) == pytest.approx(before, abs=1e-9), (act, kind)
        assert editor.curve.is_manual, (act, kind)
        assert "shape kept" in editor.status.lower(), (act, kind)
        assert editor.status.endswith("The parameters are now manual."), (act, kind)
        editor.trigger("undo")
        assert editor.session.document == document, (act, kind)


def test_the_parameter_rule_stays_where_the_shape_stays(editor):
    flat = make_curve([(0, 0), (2, 0), (6, 0)], family=LAGRANGE)
    begin(editor, flat, kind=ParametrizationKind.CHORD_LENGTH)
    editor.select([1, 2])
    editor.key(Qt.Key.Key_Insert)
    positions = [point.position for point in editor.curve.points]
    assert (positions[0], positions[1], positions[3]) == ((0, 0), (2, 0), (6, 0))
    # A point of the curve, rounded as its evaluation: 3.9999999999999996 by some kernels of BLAS.
    assert positions[2] == pytest.approx((4, 0), rel=2.0**-50, abs=0)
    assert editor.curve.parametrization.kind is ParametrizationKind.CHORD_LENGTH
    assert editor.status.startswith("Inserted 1 point. Shape kept")


# At extrema, inflections and extrema of curvature

SMALLEST_CHANGE = Fraction(1, 10**13)


def exact_turns(pieces, action):
    """The functions of t, exact up to a positive factor, whose changes of sign an action finds."""

    def curvature_slope(t):
        first, second, third = (at(pieces, t, order) for order in (1, 2, 3))
        square, dot = first[0] ** 2 + first[1] ** 2, first[0] * second[0] + first[1] * second[1]
        return cross(first, third) * square - 3 * cross(first, second) * dot

    return {
        "insertAtExtrema": [lambda t: at(pieces, t, 1)[0], lambda t: at(pieces, t, 1)[1]],
        "insertAtInflections": [lambda t: cross(at(pieces, t, 1), at(pieces, t, 2))],
        "insertAtCurvatureExtrema": [curvature_slope],
    }[action]


WAVE = ((0, 0), (2, 2), (3, -1), (5, 3), (4, -2))


@pytest.mark.parametrize("record", SPECIAL_POINTS, ids=lambda record: record.action)
@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
def test_the_palette_inserts_points_at_special_points_of_the_exact_curve(editor, family, record):
    begin(editor, make_curve(WAVE, family=family))
    before, document = editor.session.active_view, editor.session.document
    pieces, old = pieces_of(before), set(before.parameters.tolist())
    editor.run_command(f"Insert Points at {record.title}")
    after = editor.session.active_view
    new = [Fraction(t) for t in after.parameters.tolist() if t not in old]
    start, end = pieces[0][0], pieces[-1][1]
    functions = exact_turns(pieces, record.action)
    inside = sum(sign_changes(function, *piece[:2], 400) for function in functions for piece in pieces)
    assert len(new) == inside > 1
    # The exact function changes its sign within a rounding of each new parameter.
    near = Fraction(1, 10**12) * (end - start)
    assert all(any(f(t - near) * f(t + near) < 0 for f in functions) for t in new)
    assert set(np.flatnonzero(np.isin(after.parameters, [float(t) for t in new]))) == editor.session.selection
    # The new pieces are parts of the old ones.
    for start, end, points in pieces_of(after):
        middle = value(points, Fraction(1, 3))
        was = at(pieces, start + (end - start) / 3)
        assert all(abs(a - b) <= SMALLEST_CHANGE for a, b in zip(middle, was, strict=True))
    assert editor.status.startswith(f"Inserted {len(new)} points at {record.name}. Shape kept")
    assert editor.session.undo_stack.undoText() == f"Insert {len(new)} points at {record.name}"
    changed = editor.session.document
    editor.run_command(f"Insert Points at {record.title}")
    assert editor.session.document is changed
    assert editor.status == f"All {record.name} have points already."
    editor.trigger("undo")
    assert editor.session.document == document


def test_handles_at_inserted_extrema_are_horizontal_or_vertical(editor):
    begin(editor, make_curve(WAVE, family=HERMITE))
    editor.trigger("insertAtExtrema")
    view = editor.session.active_view
    velocities = [view.velocity_of(index) for index in editor.session.selection]
    assert len(velocities) > 3
    assert all(min(map(abs, velocity)) < 1e-14 * max(map(abs, velocity)) for velocity in velocities)


def test_points_are_inserted_on_the_selected_segments_alone(editor):
    begin(editor, make_curve(WAVE, family=HERMITE))
    editor.select([3, 4])
    editor.open_menu(on_line(editor, 3))
    editor.choose("insertAtExtrema")
    # x turns once and y once beyond point 3; on the other segments y turns twice.
    assert editor.session.selection == {4, 5}
    others = [point.position for at, point in enumerate(editor.curve.points) if at not in (4, 5)]
    assert others == [tuple(map(float, place)) for place in WAVE]


def test_points_are_inserted_to_all_selected_curves_in_one_step(editor):
    begin(editor, make_curve(WAVE, family=HERMITE), make_curve([(0, 4), (3, 6), (6, 4)], name="Bow"))
    editor.session.selected.select_whole([0, 1])
    steps = editor.session.undo_stack.count()
    editor.trigger("insertAtExtrema")
    assert len(editor.session.document.curves[1].points) == 3
    assert len(editor.session.document.curves[0].points) > 6
    assert editor.session.undo_stack.count() == steps + 1


def test_a_curve_without_inflections_says_so(editor):
    begin(editor, make_curve([(0, 0), (3, 2), (6, 0)], family=HERMITE))
    editor.trigger("insertAtInflections")
    assert len(editor.curve.points) == 3
    assert editor.status == "There are no inflections."


def test_families_insert_special_points_with_their_shape_or_say_why_not(editor):
    for family in FAMILIES:
        begin(editor, make_curve(WAVE, family=family))
        before, document = drawn(editor), editor.session.document
        editor.trigger("insertAtExtrema")
        if editor.session.document is document:
            assert "Convert it to Hermite first" in editor.status, family
            assert family.name in ("bezier", "b_spline", "floater_hormann"), family
        else:
            assert drawn(editor) == pytest.approx(before, abs=1e-8), family
            assert "Shape kept" in editor.status, family
