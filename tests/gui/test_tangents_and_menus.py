"""Tangents at points, context menus, and points on the clipboard; real mouse and key events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QLocale, QMimeData, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget

from app.actions.state import DERIVATIVES
from app.document import point_edits, rule_edits
from app.document.derivatives import AccelerationRule, VelocityRule
from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.help.shortcut_sheet import SheetState
from app.features.point_table.edits import keeping_sentence
from app.tools.canvas.select import SELECT

CTRL = Qt.KeyboardModifier.ControlModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier
WAVE = ((0, 0), (1, 1), (2, 0), (3, 1))


@pytest.fixture
def wave(editor):
    """A Hermite curve of four points, and an empty one after it."""
    curves = (make_curve(WAVE, name="Wave", family=HERMITE), make_curve((), name="Empty"))
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.fit()
    return editor


def entries(menu):
    return {action.objectName(): action.isEnabled() for action in menu.actions() if action.objectName()}


def close(editor):
    QTest.keyClick(editor.menu(), Qt.Key.Key_Escape)
    editor.settle()


# Tangents


def test_the_two_handles_of_a_corner_move_independently(wave):
    wave.select_point(1)
    before = wave.session.active_view.velocity_of(1)
    wave.key(Qt.Key.Key_2, ALT)
    assert wave.session.undo_stack.undoText() == "Corner at point 1"
    point = wave.curve.points[1]
    assert (point.corner, point.velocity, point.velocity_after) == (True, before, before)
    x, y = wave.handle(ahead=True).position
    wave.drag_handle((x, y + 0.5), ahead=True)
    point = wave.curve.points[1]
    assert point.velocity == before
    assert point.velocity_after[1] > before[1] + 1
    wave.drag_handle((0.5, 1.2), ahead=False)
    assert wave.curve.points[1].velocity_after == point.velocity_after
    assert wave.curve.points[1].velocity != before


def test_symmetric_merges_two_velocities(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    wave.drag_handle((1.5, 2), ahead=True)
    first, second = (wave.session.active_view.velocity_of(1, ahead=ahead) for ahead in (False, True))
    wave.key(Qt.Key.Key_1, ALT)
    point = wave.curve.points[1]
    assert point.even
    assert point.velocity == pytest.approx([(a + b) / 2 for a, b in zip(first, second, strict=True)])
    assert point.velocity_after == pytest.approx(point.velocity)


def test_estimated_resets_all_derivatives_to_the_rules(wave):
    wave.select([1, 2])
    wave.trigger("tangentCorner")
    assert wave.session.undo_stack.undoText() == "Corner at 2 points"
    # The ends, whose estimates the corners would have changed, are estimated again as well.
    wave.select([0, 1, 2, 3])
    wave.key(Qt.Key.Key_3, ALT)
    assert wave.curve.points == make_curve(WAVE).points
    for _ in range(2):
        wave.trigger("undo")
    assert wave.curve.points == make_curve(WAVE).points


def test_a_new_corner_keeps_the_curve_until_a_handle_is_dragged(wave):
    t, document = np.linspace(0, 1, 999), wave.session.document
    for family in (family for family in FAMILIES if family.derivatives):
        wave.session.commit(document, "Again")
        wave.choose_family(family)
        wave.select([1])
        for closed in (False, True):
            if closed:
                wave.trigger("closeCurve")
            before = wave.session.active_view.curve.evaluate(t)
            wave.key(Qt.Key.Key_2, ALT)
            assert wave.curve.points[1].corner, (family, closed)
            assert wave.session.active_view.curve.evaluate(t) == pytest.approx(before, abs=1e-13), family
            wave.key(Qt.Key.Key_1, ALT)
            assert wave.curve.points[1].even, (family, closed)
            assert wave.session.active_view.curve.evaluate(t) == pytest.approx(before, abs=1e-13), family


def marked(editor):
    names = ("tangentSmooth", "tangentSymmetric", "tangentCorner", "tangentEstimated")
    return [name.removeprefix("tangent") for name in names if editor.action(name).isChecked()]


def test_the_menu_checks_the_kind_of_the_points(wave):
    assert marked(wave) == []
    wave.select([1])
    assert marked(wave) == ["Estimated"]
    wave.trigger("tangentCorner")
    assert marked(wave) == ["Corner"]
    wave.trigger("tangentCorner")
    assert marked(wave) == ["Corner"]
    wave.trigger("tangentSmooth")
    assert marked(wave) == ["Smooth"]
    wave.trigger("tangentSymmetric")
    assert marked(wave) == ["Symmetric"]
    wave.trigger("tangentCorner")
    wave.select([1, 2])
    assert marked(wave) == []
    wave.select([])
    assert marked(wave) == []


def test_a_hidden_velocity_is_pulled_out(wave):
    wave.select([1])
    wave.session.commit(point_edits.set_velocity(wave.session.document, 0, 1, (0.0, 0.0)), "Stop")
    wave.open_menu(wave.point(1))
    wave.choose("pullVelocity")
    assert wave.session.undo_stack.undoText() == "Pull out velocity of point 1"
    # Along the points, from (0, 0) to (2, 0), a third of the way to (2, 0).
    assert wave.handle(ahead=True).position == pytest.approx((1 + 2**0.5 / 3, 1))
    document = wave.session.document
    wave.trigger("pullVelocity")
    assert wave.session.document is document
    assert wave.status == "The velocity is already pulled out. Drag a square handle."
    wave.trigger("undo")
    assert wave.curve.points[1].velocity == (0, 0)


def test_the_sheet_of_keys_and_the_point_table_speak_of_velocities():
    assert keeping_sentence([8], {1, 2}) == "Point 8 keeps its own velocity and acceleration"
    assert keeping_sentence([3, 8], {1}) == "2 points keep their own velocities"
    rows = SheetState(SELECT, point_count=1, has_derivatives=True).rows()
    said = " ".join(what for part in rows for _keys, what in part)
    assert "pull out its velocity" in said
    assert "set velocity (square)" in said
    assert "{" not in said


def test_an_estimated_velocity_becomes_explicit_without_a_change(wave):
    wave.select([0, 3])
    before = wave.session.active_view
    wave.trigger("pullVelocity")
    assert wave.session.undo_stack.undoText() == "Pull out velocity of 2 points"
    assert wave.curve.points[3].velocity == before.velocity_of(3, ahead=False)
    t = np.linspace(*before.curve.domain, 101)
    assert wave.session.active_view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t))


def test_both_velocities_of_a_corner_are_pulled_out(wave):
    wave.select([1])
    wave.session.commit(point_edits.make_corner(wave.session.document, 0, 1, (0, 0), (0, 0)), "Corner")
    wave.trigger("pullVelocity")
    assert wave.handle(ahead=True).position == pytest.approx((4 / 3, 2 / 3))
    assert wave.handle(ahead=False).position == pytest.approx((2 / 3, 2 / 3))


def test_all_points_become_corners_but_the_ends(wave):
    """It used to refuse everything: "Point 0 is an end of the curve"."""
    wave.key(Qt.Key.Key_A, CTRL)
    wave.key(Qt.Key.Key_2, ALT)
    assert [point.corner for point in wave.curve.points] == [False, True, True, False]
    assert wave.session.undo_stack.undoText() == "Corner at 2 points"
    assert wave.status == "Corner at points 1 and 2; the ends of an open curve cannot be corners."
    assert wave.message == ""
    assert [point.velocity is None for point in wave.curve.points] == [True, False, False, True]
    wave.trigger("undo")
    assert wave.curve.points == make_curve(WAVE).points
    wave.select([0, 3])
    document = wave.session.document
    wave.key(Qt.Key.Key_2, ALT)
    assert wave.session.document is document
    assert wave.status == "The ends of an open curve cannot be corners."


def test_a_closed_curve_has_corners_everywhere(wave):
    wave.trigger("closeCurve")
    wave.key(Qt.Key.Key_A, CTRL)
    wave.key(Qt.Key.Key_2, ALT)
    assert all(point.corner for point in wave.curve.points)
    assert wave.status == "Corner at points 0, 1, 2 and 3."


@pytest.mark.parametrize("rule", [VelocityRule.BESSEL, VelocityRule.NATURAL_SPLINE])
def test_a_corner_sets_no_more_estimates_than_the_shape_needs(editor, rule):
    """It used to set all velocities of a spline, and accelerations, which are zero by rule."""
    curve = replace(
        make_curve([(x, x % 3) for x in range(7)], family=QUINTIC_HERMITE),
        velocity_rule=rule,
        acceleration_rule=AccelerationRule.ZERO,
    )
    editor.session.commit(Document((curve,)), "Begin")
    before = editor.session.active_view.curve.evaluate(np.linspace(0, 1, 999))
    editor.select([3])
    editor.trigger("tangentCorner")
    points = editor.curve.points
    assert "".join("v" if point.velocity else "." for point in points) == "...v..."
    assert "".join("a" if point.acceleration else "." for point in points) == "...a..."
    assert (editor.status, editor.message) == ("Corner at point 3.", "")
    after = editor.session.active_view.curve.evaluate(np.linspace(0, 1, 999))
    assert after == pytest.approx(before, abs=1e-13)


def test_the_undo_step_names_the_side_of_a_corner(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    wave.hover(wave.handle(ahead=False).position)
    assert wave.window.status_line.hint.startswith("Drag to set the velocity of point 1, behind · ")
    wave.drag_handle((0.5, 1.2), ahead=False)
    assert wave.session.undo_stack.undoText() == "Set velocity of point 1, behind"
    wave.press(wave.handle(ahead=True).position)
    wave.move((1.5, 2))
    assert wave.status.startswith("Velocity of point 1, ahead: ")
    wave.release((1.5, 2))
    assert wave.session.undo_stack.undoText() == "Set velocity of point 1, ahead"
    wave.drag_point(1, to=(1.2, 2), keys=ALT)
    assert wave.session.undo_stack.undoText() == "Set velocity of point 1, ahead"
    wave.select_point(2)
    wave.drag_handle((2.5, 1))
    assert wave.session.undo_stack.undoText() == "Set velocity of point 2"


def test_an_end_is_no_corner(wave):
    wave.select_point(0)
    wave.trigger("tangentCorner")
    assert wave.status == "Point 0 is an end of the curve; a corner needs a segment on both sides."
    wave.trigger("closeCurve")
    wave.trigger("tangentCorner")
    assert wave.curve.points[0].corner


def test_tangents_need_points_and_derivatives(wave):
    names = ("tangentSmooth", "tangentSymmetric", "tangentCorner", "tangentEstimated")
    assert not any(wave.action(name).isEnabled() for name in names)
    wave.select_point(1)
    assert all(wave.action(name).isEnabled() for name in names)
    wave.choose_family(LAGRANGE)
    assert not any(wave.action(name).isEnabled() for name in names)


def test_the_form_shows_closed_and_the_number_of_corners(wave):
    wave.show_dock("curveDock")
    wave.trigger("closeCurve")
    wave.select_point(1)
    wave.trigger("tangentCorner")
    shown = wave.window.findChild(object, "curveFacts").text()
    facts = shown.replace("\N{NO-BREAK SPACE}", " ")
    assert "4 pieces · closed · 1 corner" in facts


def test_the_table_marks_the_side_of_a_corner_where_the_other_differs(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    model = wave.window.point_table.model()
    assert "before the corner" not in model.data(model.index(1, 3), Qt.ItemDataRole.ToolTipRole)
    wave.drag_handle((1.5, 1.5), index=1)
    tip = model.data(model.index(1, 3), Qt.ItemDataRole.ToolTipRole)
    assert "before the corner" in tip
    assert "before the corner" not in model.data(model.index(2, 3), Qt.ItemDataRole.ToolTipRole)


def test_the_table_marks_a_corner(wave):
    table = wave.window.point_table
    model, changed = table.model(), []
    disc = model.headerData(1, Qt.Orientation.Vertical, Qt.ItemDataRole.DecorationRole).toImage()
    wave.select([1])
    wave.trigger("tangentSmooth")
    model.dataChanged.connect(lambda top, bottom: changed.append((top.row(), bottom.row())))
    wave.trigger("tangentCorner")
    # The numbers are those before; the mark is new.
    wave.drag_handle((1.5, 1.5), index=1)
    assert any(top <= 1 <= bottom for top, bottom in changed)
    assert [model.shows_one_side(row, 3) for row in range(4)] == [False, True, False, False]
    assert not model.shows_one_side(1, 1)
    assert model.headerData(1, Qt.Orientation.Vertical, Qt.ItemDataRole.DecorationRole).toImage() != disc
    assert "Point 1, a corner" in model.headerData(1, Qt.Orientation.Vertical, Qt.ItemDataRole.ToolTipRole)
    assert "after it" in model.data(model.index(1, 3), Qt.ItemDataRole.AccessibleTextRole)
    place = table.visualRect(model.index(1, 3)).topLeft()
    inside = table.viewport().grab().toImage().pixelColor(place.x() + 3, place.y() + 3)
    wave.trigger("tangentEstimated")
    assert not model.shows_one_side(1, 3)
    assert table.viewport().grab().toImage().pixelColor(place.x() + 3, place.y() + 3) != inside


def test_a_click_on_a_handle_over_a_point_selects_the_point(wave):
    velocity = (1.0, -1.0)
    span = wave.parameters[2] - wave.parameters[1]
    reach = tuple(3 * part / span for part in velocity)
    wave.session.commit(point_edits.set_velocity(wave.session.document, 0, 1, reach), "Aim")
    wave.select([1])
    assert wave.handle().position == pytest.approx(wave.point(2))
    document = wave.session.document
    wave.click(wave.point(2))
    assert wave.session.selection == {2}
    assert wave.session.document is document
    wave.select([1])
    wave.click(wave.point(2), keys=SHIFT)
    assert wave.session.selection == {1, 2}
    wave.select([1])
    wave.drag_handle((2.5, 0.5))
    assert wave.point(2) == (2, 0)
    assert wave.curve.points[1].velocity != pytest.approx(reach)


def test_a_side_set_at_a_corner_counts_as_explicit(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    wave.trigger("resetVelocities")
    x, y = wave.handle(ahead=True).position
    wave.drag_handle((x, y + 0.5), ahead=True)
    assert wave.curve.points[1].velocity is None
    assert wave.action("resetVelocities").isEnabled()


# Menus


def test_the_menu_of_a_point(wave):
    menu = wave.open_menu(wave.point(2))
    assert wave.session.selection == {2}
    found = entries(menu)
    assert found["tangentCorner"]
    assert found["deleteSelection"]
    wave.choose("tangentCorner")
    assert wave.curve.points[2].corner


def test_x_and_y_of_a_point_are_typed_by_its_menu(wave):
    wave.open_menu(wave.point(2))
    wave.choose("typePoint")
    for text, key in (("2.25", Qt.Key.Key_Tab), ("-1/8", Qt.Key.Key_Return)):
        edit = QApplication.focusWidget()
        assert isinstance(edit, QLineEdit)
        edit.selectAll()
        QTest.keyClicks(edit, text)
        QTest.keyClick(edit, key)
        wave.settle()
    assert wave.point(2) == (2.25, -0.125)


def test_typing_the_position_of_a_point_again_keeps_the_open_editor(wave):
    """Qt refused to edit a cell that had a field: behind another window that had not lost the keyboard."""
    wave.select([2])
    other = QWidget()
    other.show()
    other.activateWindow()
    cells = wave.window.point_table.viewport()
    wave.trigger("typePoint")
    (field,) = cells.findChildren(QLineEdit)
    field.selectAll()
    QTest.keyClicks(field, "7")
    wave.trigger("typePoint")
    assert cells.findChildren(QLineEdit) == [field]
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert wave.point(2)[0] == 7.0
    other.close()
    wave.window.activateWindow()


def test_the_menu_keeps_a_selection_that_the_point_belongs_to(wave):
    wave.select([1, 2])
    wave.open_menu(wave.point(2))
    wave.choose("deleteSelection")
    assert len(wave.curve.points) == 2


@pytest.mark.parametrize("name", ["insertPointHere", "splitHere"])
def test_the_menu_of_the_curve_acts_at_the_position_of_the_click(wave, name):
    at = tuple(wave.session.active_view.curve.evaluate(0.43))
    wave.open_menu(at)
    wave.choose(name)
    place = wave.point(2) if name == "insertPointHere" else wave.curve.points[-1].position
    assert place == pytest.approx(at, abs=2 * wave.pixel)


def test_a_locked_curve_s_menu_offers_no_changes_of_shape(wave):
    wave.trigger("curveLocked")
    found = entries(wave.open_menu(tuple(wave.session.active_view.curve.evaluate(0.43))))
    assert not found["insertPointHere"]
    assert not found["splitHere"]
    assert found["curveLocked"]
    close(wave)


def test_the_menu_of_another_curve_is_for_that_curve(wave):
    at = tuple(wave.session.active_view.curve.evaluate(0.43))
    wave.session.selected.activate(1)
    wave.open_menu(at)
    assert wave.curve.name == "Wave"
    wave.choose("reverseCurve")
    assert wave.point(0) == (3, 1)


def test_the_menu_of_the_canvas(wave):
    wave.open_menu((1.5, 1.4))
    wave.choose("selectAll")
    assert len(wave.session.selection) == 4


def test_escape_closes_the_menu_without_a_change(wave):
    document = wave.session.document
    wave.open_menu((1.5, 1.4))
    close(wave)
    assert wave.session.document is document


def test_the_menu_key_opens_the_menu_of_the_selected_point(wave):
    wave.select([3])
    assert entries(wave.press_menu_key())["tangentSmooth"]
    close(wave)
    wave.select([])
    assert "selectAll" in entries(wave.press_menu_key())
    close(wave)


def test_there_is_no_menu_in_the_middle_of_a_drag(wave):
    wave.press(wave.point(1))
    wave.move((1, 2))
    with pytest.raises(LookupError, match="no menu open"):
        wave.open_menu((1.5, 0.5))
    wave.escape()


def test_a_right_press_cancels_a_drag_and_opens_no_menu(wave):
    document = wave.session.document
    wave.press(wave.point(1))
    wave.move((1, 2))
    assert wave.session.document is not document
    with pytest.raises(LookupError, match="no menu open"):
        wave.open_menu((1.5, 0.5))
    assert wave.session.document is document
    wave.move((2, 2))
    wave.release((2, 2))
    assert wave.session.document is document
    wave.open_menu((1.5, 1.4))
    close(wave)


def test_the_menu_of_the_canvas_has_snap_beside_grid(wave):
    names = list(entries(wave.open_menu((1.5, 1.4))))
    assert names.index("toggleSnap") == names.index("toggleGrid") + 1
    close(wave)


# Points on the clipboard


@pytest.mark.parametrize("name", ["pastePoints", "pasteAsCurve"])
def test_points_pasted_out_of_sight_are_brought_into_view(wave, name):
    wave.paste_text("40 0\n50 10")
    wave.trigger(name)
    assert wave.window.canvas.framing.shows_all_points


def test_a_pasted_curve_has_its_own_parameters(wave):
    document = rule_edits.set_interval(wave.session.document, 0, 0.5, 2.0)
    wave.session.commit(document, "Interval")
    wave.trigger("freezeParameters")
    wave.paste_text("0 5\n1 6\n2 5")
    wave.trigger("pasteAsCurve")
    assert wave.curve.parametrization == Parametrization()
    wave.session.selected.activate(0)
    wave.trigger("newCurve")
    assert (wave.curve.family, wave.curve.parametrization) == (HERMITE, Parametrization())
    wave.session.selected.activate(0)
    before = wave.session.active_view.curve.evaluate(np.linspace(0.5, 2, 99))
    wave.trigger("selectAll")
    wave.trigger("copyPoints")
    wave.trigger("pasteAsCurve")
    assert wave.parameters[0] == 0
    assert wave.parameters[-1] == 1
    assert wave.session.active_view.curve.evaluate(np.linspace(0, 1, 99)) == pytest.approx(before, abs=1e-13)


def test_an_empty_document_shows_t_from_0_to_1(wave):
    wave.session.commit(rule_edits.set_interval(wave.session.document, 0, 0.5, 2.0), "Interval")
    wave.new()
    low, _, high, _ = wave.window.basis_panel.pixel_map.box
    assert low == pytest.approx(-0.035, abs=1e-3)
    assert high == pytest.approx(1.035, abs=1e-3)


def test_points_are_copied_to_another_curve_with_their_derivatives(wave):
    wave.select_point(1)
    wave.trigger("tangentSmooth")
    wave.trigger("selectAll")
    source = wave.session.active_view
    wave.key(Qt.Key.Key_C, CTRL)
    assert wave.status == "Copied 4 points."
    wave.session.selected.activate(1)
    wave.choose_family(HERMITE)
    wave.key(Qt.Key.Key_V, CTRL)
    assert [point.position for point in wave.curve.points] == list(WAVE)
    assert wave.curve.points[1].velocity == pytest.approx(source.velocity_of(1))
    assert wave.session.selection == {0, 1, 2, 3}
    assert wave.session.undo_stack.undoText() == "Paste 4 points"


def test_handles_keep_their_proportions_with_other_parameters(wave):
    wave.select_point(1)
    wave.trigger("tangentSmooth")
    wave.select([0, 1, 2])
    wave.key(Qt.Key.Key_C, CTRL)
    source = wave.session.active_view
    wave.key(Qt.Key.Key_V, CTRL)
    view = wave.session.active_view
    reaches = [
        [part * each.spacing(index, ahead=True) for part in each.velocity_of(index)]
        for each, index in ((source, 1), (view, 5))
    ]
    assert reaches[1] == pytest.approx(reaches[0])


def test_cut_deletes_the_points(wave):
    wave.select([1, 2])
    wave.key(Qt.Key.Key_X, CTRL)
    assert [point.position for point in wave.curve.points] == [(0, 0), (3, 1)]
    assert wave.session.selection == frozenset()
    wave.trigger("undo")
    assert len(wave.curve.points) == 4
    wave.session.selected.activate(1)
    wave.key(Qt.Key.Key_V, CTRL)
    assert [point.position for point in wave.curve.points] == [(1, 1), (2, 0)]


def test_copied_points_are_also_text(wave):
    wave.select([1, 3])
    wave.key(Qt.Key.Key_C, CTRL)
    assert QGuiApplication.clipboard().text() == "1.0\t1.0\n3.0\t1.0"
    wave.choose_parametrization(ParametrizationKind.MANUAL)
    wave.key(Qt.Key.Key_C, CTRL)
    rows = QGuiApplication.clipboard().text().splitlines()
    assert [len(row.split("\t")) for row in rows] == [3, 3]
    assert float(rows[1].split("\t")[0]) == 1.0


def test_two_columns_of_text_are_appended(wave):
    for text in ("4 0\n5 1", "4\t0\n5\t1\n", "x;y\n4;0\n5;1", "4,0;0,0\n5,0;1,0"):
        wave.paste_text(text)
        wave.key(Qt.Key.Key_V, CTRL)
        assert [point.position for point in wave.curve.points[4:]] == [(4, 0), (5, 1)], text
        assert not wave.curve.is_manual, text
        wave.trigger("undo")


def test_decimal_commas_of_the_locale_are_read(wave):
    before = QLocale()
    QLocale.setDefault(QLocale(QLocale.Language.German))
    try:
        wave.paste_text("4,5 0,25")
        wave.key(Qt.Key.Key_V, CTRL)
    finally:
        QLocale.setDefault(before)
    assert wave.point(4) == (4.5, 0.25)


def test_a_paste_of_three_columns_sets_the_parameters(wave):
    wave.paste_text("t x y\n1.5 4 0\n2 5 1")
    wave.key(Qt.Key.Key_V, CTRL)
    assert wave.curve.is_manual
    assert wave.parameters[-3:] == [1.0, 1.5, 2.0]


NO_POINTS = (
    ("0.5 4 0", "Row 1: t must be greater than 1, the t of the last point, not 0.5."),
    ("t x y\n2 4 0\n2 5 1", "Row 3: t must be greater than 2, the t of the row before it, not 2."),
    ("4 0\n5 abc", "Row 2, column 2: “abc” is not a number."),
    ("4 0\n5", "Row 2 has 1 cell, but the first row has 2."),
    ("1 2 3 4", "Points have two columns, x y, or three, t x y; these are 4 columns."),
    ("7", "Points have two columns, x y, or three, t x y; this is one column."),
    ("", "There are no numbers on the clipboard."),
    ("1e13 0", "Row 1, column 1: Enter a number between −1e12 and 1e12."),
)


def test_text_without_points_is_refused_with_a_row_number(wave):
    document = wave.session.document
    for text, reason in NO_POINTS:
        wave.paste_text(text)
        wave.key(Qt.Key.Key_V, CTRL)
        assert wave.status.startswith(reason)
        assert wave.session.document is document, text


def test_text_can_be_pasted_as_a_new_curve(wave):
    wave.paste_text("0 5\n1 6\n2 5")
    wave.key(Qt.Key.Key_N, CTRL | ALT)
    assert wave.curve.name == "Curve 1"
    assert wave.curve.family is HERMITE
    assert len(wave.curve.points) == 3
    assert wave.curve is wave.session.document.curves[-1]
    wave.trigger("undo")
    assert wave.curve.name == "Wave"
    wave.paste_text("0 0 5\n1 1 6\n4 2 5")
    wave.trigger("pasteAsCurve")
    assert wave.parameters == [0, 1, 4]
    wave.paste_text("1 0 5\n1 1 6")
    wave.trigger("pasteAsCurve")
    assert wave.status.startswith("Row 2: t must be greater than 1")


def test_copied_points_can_be_pasted_as_a_new_curve(wave):
    wave.trigger("freezeParameters")
    wave.trigger("selectAll")
    wave.trigger("tangentSmooth")
    before = wave.session.active_view
    wave.trigger("copyPoints")
    wave.trigger("pasteAsCurve")
    assert wave.curve.name == "Curve 1"
    t = np.linspace(*before.curve.domain, 101)
    assert wave.session.active_view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t))


def test_a_paste_continues_manual_parameters_at_the_distances_of_the_points(wave):
    wave.trigger("freezeParameters")
    wave.select([1, 2])
    step = wave.parameters[2] - wave.parameters[1]
    wave.trigger("copyPoints")
    wave.trigger("pastePoints")
    assert wave.parameters[5] - wave.parameters[4] == pytest.approx(step)
    assert wave.session.active_view.is_current


def test_a_paste_into_a_closed_manual_curve_keeps_the_curve_valid(wave):
    wave.trigger("closeCurve")
    wave.trigger("freezeParameters")
    wave.select([1, 2])
    wave.trigger("copyPoints")
    wave.trigger("pastePoints")
    assert wave.session.active_view.is_current
    assert len(wave.curve.points) == 6


def test_pasting_points_into_a_locked_curve_is_refused(wave):
    wave.trigger("curveLocked")
    document = wave.session.document
    wave.paste_text("4 0\n5 1")
    wave.trigger("pastePoints")
    wave.select([1])
    wave.trigger("cutPoints")
    assert wave.session.document is document
    assert wave.session.selection == {1}


def test_the_table_keeps_its_own_copy_and_paste(wave):
    table = wave.window.point_table
    table.setFocus()
    table.setCurrentIndex(table.model().index(1, 1))
    QTest.keyClick(table, Qt.Key.Key_C, CTRL)
    wave.settle()
    assert QGuiApplication.clipboard().text() == "1.0"


def test_derivatives_are_copied_from_point_to_points(wave):
    wave.select_point(1)
    wave.drag_handle((1.5, 2))
    velocity = wave.curve.points[1].velocity
    wave.key(Qt.Key.Key_C, CTRL | ALT)
    assert wave.status == "Copied the derivatives of point 1."
    wave.select([2, 3])
    wave.key(Qt.Key.Key_V, CTRL | ALT | SHIFT)
    assert [point.velocity for point in wave.curve.points] == [None, velocity, velocity, velocity]
    assert wave.point(2) == (2, 0)
    assert wave.session.undo_stack.undoText() == "Paste derivatives to 2 points"


def test_both_sides_of_a_corner_are_copied(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    wave.drag_handle((1.5, 2), ahead=True)
    corner = wave.curve.points[1]
    wave.trigger("copyDerivatives")
    wave.select([2])
    wave.trigger("pasteDerivatives")
    point = wave.curve.points[2]
    assert (point.corner, point.velocity, point.velocity_after) == (
        True,
        corner.velocity,
        corner.velocity_after,
    )


def test_a_paste_without_derivatives_on_the_clipboard_is_reported(wave):
    wave.paste_text("1 2")
    wave.select_point(1)
    assert not wave.action("pasteDerivatives").isEnabled()
    broken = QMimeData()
    broken.setData(DERIVATIVES, b"{")
    QGuiApplication.clipboard().setMimeData(broken)
    wave.trigger("pasteDerivatives")
    assert "no derivatives on the clipboard" in wave.status
