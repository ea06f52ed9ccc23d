"""The Transform panel: exact position, size and angle, typed with units; real keys and clicks."""

from __future__ import annotations

import numpy as np
import pytest
from extents import CLOSE, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QLineEdit, QScrollArea, QToolButton

from app.document.model import Document, make_curve
from app.document.several_curves import set_style
from app.document.style import Style
from app.families import HERMITE
from tests.gui.editor_facts import transform, undo_text

Key, LEFT = Qt.Key, Qt.MouseButton.LeftButton
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
POINTS = ((0.0, 0.0), (10.0, 20.0), (30.0, 22.0), (40.0, 5.0))
EXACT = 1e-11
"""Rounding of lengths of some tens."""


@pytest.fixture
def leaf(editor):
    """A curve in millimetres with a stroke of 2 mm, another one below, and the panel."""
    one = replace(make_curve(POINTS, name="Leaf", family=HERMITE), style=Style(width=2.0))
    two = make_curve([(0, -20), (20, -10), (40, -20)], name="Base", family=HERMITE)
    editor.session.commit(replace(Document((one, two)), unit="mm"), "Begin")
    editor.fit()
    editor.key(Key.Key_M, CTRL | SHIFT)
    return editor


def field(editor, name):
    found = editor.window.findChild(QLineEdit, f"transform{name}")
    assert found is not None
    return found


def number_in(editor, name):
    return float(field(editor, name).text().replace("−", "-"))


def enter(editor, name, text, key=Key.Key_Return):
    edit = field(editor, name)
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)
    QTest.keyClick(edit, key)
    editor.settle()


def click(editor, name):
    button = editor.window.findChild(QToolButton, name)
    assert button is not None
    QTest.mouseClick(button, LEFT)
    editor.settle()


def whole_buttons(editor):
    """Return the buttons that flip and turn by a quarter."""
    names = ("flipHorizontally", "flipVertically", "rotateLeft", "rotateRight")
    return [editor.window.findChild(QToolButton, f"{name}Button") for name in names]


def label(editor, name):
    return editor.window.findChild(QLabel, name).text()


def size(editor, *places):
    return np.ptp(sampled_bounds(editor, *places), axis=0)


def points(editor):
    return np.array([point.position for point in editor.curve.points])


# What is shown


def test_the_key_leads_to_the_width(leaf):
    assert QApplication.focusWidget() is field(leaf, "Width")
    assert field(leaf, "Width").selectedText() == field(leaf, "Width").text()
    assert field(leaf, "Width").cursorPosition() == 0, "the first digits are seen"


def test_the_panel_shows_the_bounds_of_the_curve_without_stroke_or_points(leaf):
    bounds = sampled_bounds(leaf)
    assert bounds[1][1] > 22.1
    shown = [float(field(leaf, name).text()) for name in ("X", "Y", "Width", "Height")]
    # Four decimals.
    assert shown == pytest.approx([*bounds.mean(axis=0), *np.ptp(bounds, axis=0)], abs=5e-5, rel=0)
    assert label(leaf, "transformWhat") == "All 4 points"


def test_the_panel_follows_the_selection_and_drags(leaf):
    leaf.select([1, 2])
    assert label(leaf, "transformWhat") == "2 points"
    assert [field(leaf, name).text() for name in ("X", "Y", "Height")] == ["20", "21", "2"]
    leaf.session.selected.set_curves({0, 1})
    leaf.settle()
    assert label(leaf, "transformWhat") == "2 curves"
    leaf.select([3])
    leaf.press((40, 5))
    leaf.move((45, 5))
    leaf.release((45, 5))
    assert float(field(leaf, "X").text()) == pytest.approx(45, abs=2 * leaf.pixel)
    assert not field(leaf, "Width").isEnabled(), "one point has no width"


def test_without_points_all_fields_are_disabled(leaf):
    leaf.session.new()
    leaf.settle()
    assert label(leaf, "transformWhat") == "Nothing selected"
    assert not any(field(leaf, name).isEnabled() for name in ("X", "Width", "Angle", "Turn"))
    assert not any(button.isEnabled() for button in whole_buttons(leaf))


def test_without_a_selection_buttons_and_fields_are_disabled(leaf):
    assert all(button.isEnabled() for button in whole_buttons(leaf))
    for _ in range(2):
        leaf.escape()
    leaf.settle()
    assert label(leaf, "transformWhat") == "Nothing selected"
    assert not any(button.isEnabled() for button in whole_buttons(leaf))


def test_a_locked_curve_cannot_be_changed_and_the_panel_gives_the_reason(leaf):
    leaf.trigger("curveLocked")
    assert "locked" in label(leaf, "transformProblem")
    assert not field(leaf, "Width").isEnabled()


# Size


WIDTHS = [("70 mm", 70.0), ("7cm", 70.0), ("2in", 50.8), ("100/3", 100 / 3), ("1in+1mm", 26.4)]


def test_a_typed_width_is_that_of_the_curve_exactly(leaf):
    for text, width in WIDTHS:
        before = sampled_bounds(leaf)
        enter(leaf, "Width", text)
        after = sampled_bounds(leaf)
        assert np.ptp(after, axis=0) == pytest.approx((width, np.ptp(before, axis=0)[1]), abs=CLOSE), text
        assert after.mean(axis=0) == pytest.approx(before.mean(axis=0), abs=CLOSE), f"{text}: about the pivot"
        bounds = leaf.window.canvas.tools.box.bounds
        assert bounds.size[0] == pytest.approx(width, abs=EXACT), text
        assert undo_text(leaf) == f"Set width of all 4 points to {width:.6g} mm", text
        assert leaf.session.undo_stack.count() == 2, text
        leaf.trigger("undo")
        assert points(leaf).tolist() == [list(point) for point in POINTS], text


def test_a_share_changes_the_present_height(leaf):
    height = size(leaf)[1]
    enter(leaf, "Height", "+10%")
    assert size(leaf)[1] == pytest.approx(1.1 * height, abs=CLOSE)
    enter(leaf, "Height", "50%")
    assert size(leaf)[1] == pytest.approx(0.55 * height, abs=CLOSE)


def test_the_lock_keeps_proportions(leaf):
    width, height = size(leaf)
    click(leaf, "panelProportionsButton")
    enter(leaf, "Width", "70")
    assert size(leaf) == pytest.approx((70.0, 70.0 * height / width), abs=CLOSE)
    enter(leaf, "Height", "10")
    assert size(leaf) == pytest.approx((10.0 * width / height, 10.0), abs=CLOSE)
    assert leaf.window.preferences.keep_proportions
    click(leaf, "panelProportionsButton")


def test_selected_curves_have_one_size_together(leaf):
    leaf.session.selected.set_curves({0, 1})
    leaf.settle()
    enter(leaf, "Width", "70")
    assert size(leaf, 0, 1)[0] == pytest.approx(70.0, abs=CLOSE)
    assert undo_text(leaf) == "Set width of 2 curves to 70 mm"


def test_scaling_a_curve_keeps_the_width_of_its_stroke(leaf):
    width, _ = size(leaf)
    enter(leaf, "Width", "50%")
    transform(leaf, "S", "3")
    leaf.trigger("selectAll")
    start = leaf.grip(1, 0)
    leaf.drag(start, (start[0] + 10, start[1]))
    assert size(leaf)[0] == pytest.approx(1.5 * width + 10, abs=2 * leaf.pixel)
    assert leaf.curve.style.width == 2.0


def test_points_alone_leave_the_stroke(leaf):
    leaf.select([1, 2])
    enter(leaf, "Width", "30")
    assert points(leaf)[1:3, 0].tolist() == [5.0, 35.0]
    assert leaf.curve.style.width == 2.0
    assert undo_text(leaf) == "Set width of 2 points to 30 mm"


def test_undo_reverts_the_entry_and_while_typing_the_text(leaf):
    for name, text in (("Width", "70"), ("Height", "30")):
        enter(leaf, name, text)
    edit, steps = field(leaf, "Height"), leaf.session.undo_stack
    assert steps.index() == 3
    leaf.type_text(edit, "12")
    QTest.keyClick(edit, Key.Key_Z, CTRL)
    assert (steps.index(), edit.text()) == (3, "30")
    QTest.keyClick(edit, Key.Key_Escape)
    for left in (2, 1):
        QTest.keyClick(edit, Key.Key_Z, CTRL)
        assert steps.index() == left
        assert number_in(leaf, "Height") == pytest.approx(size(leaf)[1], abs=5e-5, rel=0)
    QTest.keyClick(edit, Key.Key_Z, CTRL | SHIFT)
    assert size(leaf)[0] == pytest.approx(70.0, abs=CLOSE)


# Position and pivot


def test_the_selected_reference_point_of_the_box_is_moved_to_the_numbers(leaf):
    click(leaf, "pivotBottomLeft")
    low = sampled_bounds(leaf)[0]
    assert number_in(leaf, "X") == pytest.approx(low[0], abs=1e-5)
    enter(leaf, "X", "1in")
    enter(leaf, "Y", "-2")
    assert sampled_bounds(leaf)[0] == pytest.approx((25.4, -2.0), abs=CLOSE)
    assert undo_text(leaf) == "Move all 4 points to y −2 mm"
    assert [leaf.curve.style.width, leaf.session.undo_stack.count()] == [2.0, 3]
    assert leaf.window.findChild(QToolButton, "pivotBottomLeft").isChecked()
    enter(leaf, "Width", "70")
    assert sampled_bounds(leaf)[0] == pytest.approx((25.4, -2.0), abs=CLOSE), "it grows away from the pivot"


def test_the_pivot_chooser_displays_the_pivot_and_its_centre_resets_the_pivot(leaf):
    names = [f"pivot{name}" for name in ("Middle", "TopRight")]
    down = lambda: [leaf.window.findChild(QToolButton, name).isChecked() for name in names]  # noqa: E731
    assert down() == [True, False]
    click(leaf, "pivotTopRight")
    assert down() == [False, True]
    assert leaf.window.canvas.marks.pivot == pytest.approx(sampled_bounds(leaf)[1], abs=CLOSE)
    leaf.trigger("selectAll")
    leaf.drag(leaf.window.canvas.marks.pivot, (20.0, 10.0))
    assert down() == [False, False]
    assert float(field(leaf, "X").text()) == pytest.approx(20.0, abs=2 * leaf.pixel)
    click(leaf, "pivotMiddle")
    assert down() == [True, False]
    assert leaf.session.box.pivot is None


def test_flips_in_the_panel_are_about_the_pivot(leaf):
    click(leaf, "pivotRight")
    right = sampled_bounds(leaf)[1][0]
    click(leaf, "flipHorizontallyButton")
    assert points(leaf)[:, 0] == pytest.approx([2 * right - x for x, _ in POINTS], abs=CLOSE)
    assert leaf.window.findChild(QToolButton, "pivotLeft").isChecked(), "the same place is at the left now"


# Angle


def test_rotate_by_turns_with_every_enter(leaf):
    click(leaf, "pivotBottom")
    x, y = leaf.window.canvas.tools.box.centre
    enter(leaf, "Turn", "30")
    assert undo_text(leaf) == "Rotate all 4 points by 30°"
    QTest.keyClick(field(leaf, "Turn"), Key.Key_Return)
    click(leaf, "transformTurnButton")
    assert leaf.session.undo_stack.count() == 4
    assert points(leaf) == pytest.approx(np.array([(x - (b - y), y + (a - x)) for a, b in POINTS]), abs=EXACT)
    assert field(leaf, "Angle").text() == "90"


def test_angles_are_displayed_to_a_thousandth_and_stored_exactly(leaf):
    enter(leaf, "Turn", "22.3692597")
    leaf.window.canvas.setFocus()
    assert field(leaf, "Turn").text() == field(leaf, "Angle").text() == "22.369"
    field(leaf, "Turn").setFocus()
    assert field(leaf, "Turn").text() == "22.3692597"
    click(leaf, "transformTurnButton")
    leaf.window.canvas.setFocus()
    assert field(leaf, "Angle").text() == "44.739"


def test_the_angle_counts_from_the_selection_and_resets_to_zero(leaf):
    leaf.trigger("selectAll")
    enter(leaf, "Angle", "30°")
    assert undo_text(leaf) == "Rotate 4 points to 30°"
    enter(leaf, "Angle", "-75")
    enter(leaf, "Angle", "0")
    assert points(leaf) == pytest.approx(np.array(POINTS), abs=EXACT)
    enter(leaf, "Angle", "30")
    transform(leaf, "R", "15")
    assert float(field(leaf, "Angle").text()) == pytest.approx(45.0)
    enter(leaf, "Angle", "0")
    # The quarter of it that was about the middle of the turned box has moved the curve a little.
    assert points(leaf) - points(leaf)[0] == pytest.approx(np.array(POINTS), abs=EXACT)
    enter(leaf, "Angle", "20")
    leaf.select([1, 2])
    assert field(leaf, "Angle").text() == "0", "another selection"


def test_a_copy_has_the_angle_of_its_original_plus_its_own_rotation(leaf):
    leaf.key(Key.Key_Escape)
    assert leaf.session.selected.curves == {0}
    for shown, amount in ((45, "45"), (75, "30")):
        leaf.key(Key.Key_D, CTRL)
        leaf.key(Key.Key_R)
        # Digit by digit: each is seen.
        leaf.type_amount(amount)
        leaf.key(Key.Key_Return)
        assert number_in(leaf, "Angle") == pytest.approx(shown)
    enter(leaf, "Angle", "0")
    assert points(leaf) - points(leaf)[0] == pytest.approx(np.array(POINTS), abs=EXACT)
    assert len(leaf.session.document.curves) == 4


def test_quarter_turns_have_buttons_and_keys(leaf):
    x, y = sampled_bounds(leaf).mean(axis=0)
    click(leaf, "rotateRightButton")
    assert points(leaf) == pytest.approx(np.array([(x + (b - y), y - (a - x)) for a, b in POINTS]), abs=CLOSE)
    assert undo_text(leaf) == "Rotate all 4 points by −90°"
    leaf.key(Key.Key_BracketLeft, CTRL)
    assert points(leaf) == pytest.approx(np.array(POINTS), abs=CLOSE)
    assert undo_text(leaf) == "Rotate all 4 points by 90°"


# What is not taken


NO_LENGTHS = [
    ("Width", "7 foo", "is not a unit of length"),
    ("Width", "1e13", "between"),
    ("Width", "0", "greater than 0"),
    ("Height", "-3", "greater than 0"),
    ("Height", "-100%", "greater than 0"),
    ("X", "3 apples", "is not a unit of length"),
    ("Turn", "much", "is not a number"),
]


def test_an_invalid_length_stays_in_the_field_and_changes_nothing(leaf):
    for name, text, reason in NO_LENGTHS:
        document = leaf.session.document
        enter(leaf, name, text)
        assert leaf.session.document is document, text
        assert reason in label(leaf, "transformProblem"), text
        assert field(leaf, name).text() == text, text
        shown = field(leaf, name)
        QTest.keyClick(shown, Key.Key_Escape)
        assert shown.text() != text, text
        assert not leaf.window.findChild(QLabel, "transformProblem").isVisible(), text


@pytest.mark.parametrize("typed", ["", "3 apples"])
def test_one_escape_discards_typed_text_and_focuses_the_canvas(leaf, typed):
    """It took two, and the first had looked as if it had done that."""
    leaf.window.activateWindow()
    edit, document = field(leaf, "Width"), leaf.session.document
    before = edit.text()
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, typed)
    QTest.keyClick(edit, Key.Key_Escape)
    leaf.settle()
    assert float(edit.text().split()[0]) == pytest.approx(float(before.split()[0]), abs=1e-3)
    assert leaf.window.canvas.hasFocus()
    assert leaf.session.document is document


def test_a_unit_needs_a_unit_of_the_document(leaf):
    leaf.session.change("No unit", lambda document: replace(document, unit=""))
    document = leaf.session.document
    enter(leaf, "Width", "70 mm")
    assert leaf.session.document is document
    assert "The document has no unit" in label(leaf, "transformProblem")


def test_typed_text_without_enter_changes_nothing(leaf):
    document = leaf.session.document
    for name in ("X", "Width", "Angle", "Turn"):
        edit = field(leaf, name)
        QTest.mouseClick(edit, LEFT)
        edit.selectAll()
        leaf.type_text(edit, "12")
        leaf.window.canvas.setFocus(Qt.FocusReason.MouseFocusReason)
    assert leaf.session.document is document
    for name in ("X", "Y", "Width", "Height", "Angle", "Turn"):
        enter(leaf, name, field(leaf, name).text(), Key.Key_Tab)
    assert leaf.session.document is document, "numbers that are only shown round nothing"


def test_the_reference_of_alignment_is_set_in_the_panel_and_in_the_menu(leaf):
    box = leaf.window.findChild(QComboBox, "alignReference")
    assert box.currentText() == "Each other"
    QTest.keyClick(box, Key.Key_Down)
    assert leaf.action("alignToFirst").isChecked()
    leaf.trigger("alignToEachOther")
    assert box.currentText() == "Each other"


def test_the_keyboard_selects_a_reference_point_by_tab_and_arrows(leaf):
    field(leaf, "X").setFocus()
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Backtab)
    assert QApplication.focusWidget().objectName() == "pivotMiddle"
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Left)
    assert QApplication.focusWidget().objectName() == "pivotLeft"
    low, high = sampled_bounds(leaf)
    assert leaf.window.canvas.marks.pivot == pytest.approx((low[0], (low[1] + high[1]) / 2), abs=CLOSE)
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Down)
    assert leaf.window.canvas.marks.pivot == pytest.approx(low, abs=CLOSE)


def test_the_lock_binds_the_grips_at_the_corners(leaf):
    """A corner stretched what the lock of the panel said keeps its proportions."""
    leaf.session.selected.select_whole({1})
    leaf.settle()
    before = size(leaf, 1)
    leaf.trigger("keepProportions")
    x, y = leaf.grip(1, 1)
    leaf.drag((x, y), (x + 20.0, y + 1.0))
    grown = size(leaf, 1) / before
    assert grown[0] == pytest.approx(grown[1])
    assert grown[0] > 1.2
    x, y = leaf.grip(1, 0)
    leaf.drag((x, y), (x + 20.0, y))
    assert size(leaf, 1)[1] == pytest.approx(before[1] * grown[1])
    leaf.trigger("keepProportions")


def test_typing_the_displayed_short_number_sets_exactly_the_short_number(leaf):
    """80.6367 for 80.636709675 was taken for no change."""
    enter(leaf, "Width", "80.636709675")
    leaf.window.canvas.setFocus()
    before = leaf.session.document
    width = field(leaf, "Width")
    width.setFocus()
    QTest.keyClick(width, Key.Key_Return)
    leaf.window.canvas.setFocus()
    assert leaf.session.document is before
    assert width.text() == "80.6367"
    enter(leaf, "Width", "80.6367")
    assert number_in(leaf, "Width") == 80.6367
    leaf.trigger("undo")
    assert leaf.session.document == before
    # With the unit beside it, and a list of numbers.
    leaf.session.change("Thirds", lambda document: set_style(document, {0}, width=1 / 3, dash=(2 / 3, 1.0)))
    leaf.show_dock("styleDock")
    for name, said, wanted in (
        ("strokeWidth", "0.3333 mm", {"width": 0.3333}),
        ("dashList", "0.666667 1", {"dash": (0.666667, 1.0)}),
    ):
        edit = leaf.window.findChild(QLineEdit, name)
        assert edit.text() == said
        edit.setFocus()
        edit.selectAll()
        leaf.type_text(edit, said)
        QTest.keyClick(edit, Key.Key_Return)
        style = leaf.session.document.curves[0].style
        assert {each: getattr(style, each) for each in wanted} == wanted


def test_a_field_shows_few_decimals_and_the_exact_number_when_focused_or_hovered(leaf):
    """Of a width of 80.636709675 the field showed what had room."""
    enter(leaf, "Width", "80.636709675")
    leaf.window.canvas.setFocus()
    width = field(leaf, "Width")
    assert width.text() == "80.6367"
    assert width.toolTip().startswith("80.636709675 · Width")
    assert width.fontMetrics().horizontalAdvance(width.text()) < width.width() - 10
    width.setFocus()
    assert width.text() == "80.636709675"
    stroke = 3.472361234
    leaf.session.change("Width", lambda document: set_style(document, {0}, width=stroke))
    leaf.show_dock("styleDock")
    line = leaf.window.findChild(QLineEdit, "strokeWidth")
    assert line.text() == f"{stroke:.4f} mm" != f"{stroke} mm"
    line.setFocus()
    assert line.text() == f"{stroke} mm"
    assert line.toolTip().startswith(f"{stroke} mm · ")
    QTest.keyClick(line, Key.Key_A, CTRL)
    leaf.type_text(line, "auto")
    QTest.keyClick(line, Key.Key_Return)
    leaf.settle()
    assert line.toolTip().startswith("Width of the line")


def test_enter_returns_the_focus_to_the_canvas_and_its_keys_work_at_once(leaf):
    session, canvas = leaf.session, leaf.window.canvas
    session.selected.select_whole([0])
    for name in ("X", "Width", "Angle"):
        enter(leaf, name, "17")
        assert canvas.hasFocus(), name
    # What is refused is mended first, and what acts each time is pressed again.
    enter(leaf, "Width", "nonsense")
    assert field(leaf, "Width").hasFocus()
    QTest.keyClick(field(leaf, "Width"), Key.Key_Escape)
    enter(leaf, "Turn", "30")
    assert field(leaf, "Turn").hasFocus()
    enter(leaf, "X", "5")
    before = session.document.curves[0].points[0].x
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Right)
    assert session.document.curves[0].points[0].x > before
    enter(leaf, "X", "5", Key.Key_Tab)
    assert field(leaf, "Y").hasFocus()


def test_the_panel_fits_a_new_window_of_1440_by_900_without_scrolling(new_editor):
    new_editor.window.resize(1440, 900)
    new_editor.new()
    new_editor.window.canvas.camera.show_box((0, 210), (0, 297))
    new_editor.trigger("rectangleTool")
    new_editor.drag((50, 50), (90, 80))
    new_editor.key(Key.Key_M, CTRL | SHIFT)
    (area,) = new_editor.window.context.docks["transformDock"].findChildren(QScrollArea)
    assert field(new_editor, "X").isVisible()
    assert area.verticalScrollBar().maximum() == 0
