"""Points inserted on the line, by a double click and between those selected, with real events."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from PySide6.QtCore import Qt

from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.curve.curve_view import view_of

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


def test_two_clicks_at_different_positions_insert_nothing(editor):
    begin(editor, make_curve(BOW, family=HERMITE), make_curve([(0, 4), (3, 5), (6, 4)], name="Other"))
    editor.double_click(on_line(editor, 1), keys=SHIFT)
    assert len(editor.curve.points) == 5
    # The first click goes to the other curve, which was not edited: the second one changes nothing.
    editor.double_click(tuple(editor.session.views[1].curve.evaluate(0.2).tolist()))
    assert editor.session.active_index == 1
    assert [len(curve.points) for curve in editor.session.document.curves] == [5, 3]


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
