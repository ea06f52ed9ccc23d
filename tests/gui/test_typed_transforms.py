"""G, S and R with nothing selected, and amounts typed for x and for y; real keys."""

from __future__ import annotations

import numpy as np
import pytest
from extents import CLOSE, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from app.document.model import Document, make_curve
from app.families import LAGRANGE
from app.features.reference_image.commands import ImageCommands
from tests.gui.editor_facts import transform, undo_text

SHIFT = Qt.KeyboardModifier.ShiftModifier
Key = Qt.Key
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0), (5.0, 1.0))


@pytest.fixture
def arch(editor):
    """Five points, none selected."""
    curves = (make_curve(POINTS, name="Arch"), make_curve([(0, -2), (4, -2)], name="Base"))
    editor.session.commit(Document(curves), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.select([])
    editor.hover((-1, 3))
    return editor


def points(editor):
    return np.array([point.position for point in editor.curve.points])


# Nothing selected


OF_ALL = [
    (Key.Key_G, "2", lambda p, _: np.add(p, (2, 0)), "All 5 points: move 2, 0", "Move all 5 points"),
    (Key.Key_S, "3", lambda p, c: 3 * p - 2 * c, "All 5 points: scale 3", "Scale all 5 points"),
    (Key.Key_R, "180", lambda p, c: 2 * c - p, "All 5 points: rotate 180°", "Rotate all 5 points"),
]


def test_transforms_act_on_all_points_with_nothing_selected(arch):
    for key, typed, expected, status, name in OF_ALL:
        other = arch.session.document.curves[1]
        centre = sampled_bounds(arch).mean(axis=0)
        arch.key(key)
        arch.type_amount(typed)
        assert arch.status.startswith(status), name
        assert "Escape cancels" in arch.status, name
        assert arch.window.canvas.marks.note.text == status, name
        arch.key(Key.Key_Return)
        # By default about the middle of the curve, not of its points.
        assert points(arch) == pytest.approx(expected(np.array(POINTS), centre), abs=CLOSE), name
        assert undo_text(arch) == name, name
        assert arch.session.selection == frozenset(), name
        assert arch.session.document.curves[1] is other, name
        assert arch.curve.family is LAGRANGE, name
        arch.trigger("undo")
        assert points(arch).tolist() == [list(each) for each in POINTS], name


def test_escape_cancels_a_transform_of_all_points(arch):
    for key in (Key.Key_G, Key.Key_S, Key.Key_R):
        document, steps = arch.session.document, arch.session.undo_stack.count()
        arch.key(key)
        arch.move((0.5, 4.5), held=False)
        assert arch.session.document != document, key
        assert arch.status.startswith("All 5 points: "), key
        arch.escape()
        assert arch.session.document is document, key
        assert arch.session.undo_stack.count() == steps, key
        assert arch.session.selection == frozenset(), key
        assert arch.status == "Cancelled.", key
        arch.window.status_line.clear_message()
        # A scale or a turn is reckoned from where the pointer is at its start.
        arch.hover((-1, 3))


def test_undo_can_be_used_where_there_is_no_step_before(editor):
    """What moved was seen, and Undo said that it needs a step."""
    undo = editor.action("undo")
    assert not undo.isEnabled()
    editor.hover((0.5, 0.5))
    editor.trigger("moveSelection")
    editor.hover((1.5, 1.0))
    assert editor.session.is_previewing
    assert undo.isEnabled()
    editor.trigger("undo")
    assert not editor.session.is_previewing
    assert not undo.isEnabled()


def test_the_pointer_moves_all_points_and_a_click_ends_the_transform(arch):
    arch.key(Key.Key_G)
    arch.move((0, 2), held=False)
    arch.click((0, 2))
    assert points(arch) == pytest.approx(np.add(POINTS, (1, -1)), abs=2 * arch.pixel)
    assert arch.session.selection == frozenset()


def test_transforms_act_on_selected_points_first(arch):
    arch.select([1, 2])
    arch.key(Key.Key_G)
    arch.type_amount("1")
    assert arch.status.startswith("Move 1, 0")
    arch.key(Key.Key_Return)
    assert points(arch)[:, 0].tolist() == [0, 2, 4, 4, 5]


def test_the_status_line_names_a_single_point(arch):
    arch.session.commit(Document((make_curve([(1, 1)]),)), "One")
    arch.key(Key.Key_G)
    arch.type_amount("1")
    assert arch.status.startswith("Move 1, 0 · Point 0 at 2, 1")
    arch.key(Key.Key_Return)
    assert (arch.point(0), undo_text(arch)) == ((2.0, 1.0), "Move point 0")


def test_a_transform_of_a_locked_or_empty_curve_is_refused(arch):
    arch.trigger("curveLocked")
    document = arch.session.document
    arch.key(Key.Key_G)
    assert arch.status == "“Arch” is locked. Unlock it in the list of curves to change it."
    assert not arch.window.canvas.is_dragging
    arch.trigger("newCurve")
    arch.key(Key.Key_S)
    assert arch.status == f"“{arch.curve.name}” has no points yet; press P to add some."
    assert not arch.window.canvas.is_dragging
    assert arch.session.document.curves[0] is document.curves[0]


# A number for x and one for y


# Keys, what is typed, how the status begins, and where point 1 ends.
TYPED = [
    (Key.Key_G, "1\t2", "Move x 1, y 2| · typing y · Tab: x", (2, 4)),
    (Key.Key_G, "1;2", "Move x 1, y 2|", (2, 4)),
    (Key.Key_G, "1,5\t-,25", "Move x 1.5, y −.25|", (2.5, 1.75)),
    (Key.Key_G, "\t2", "Move x 0, y 2|", (1, 4)),
    (Key.Key_G, "1\t", "Move x 1, y |", (2, 2)),
    (Key.Key_G, "1\t2\t5", "Move x 15|, y 2 · typing x · Tab: y", (16, 4)),
    (Key.Key_G, "1/4", "Move 0.25, 0 (1/4) ", (1.25, 2)),
    (Key.Key_G, "2*3", "Move 6, 0 (2*3) ", (7, 2)),
    (Key.Key_G, "(1+2)/-4y", "Move −0.75 along y ((1+2)/−4)", (1, 1.25)),
    (Key.Key_G, "1/2\t1.5+1.5", "Move x 1/2, y 1.5+1.5|", (1.5, 5)),
    (Key.Key_G, "5-", "Move −5, 0 ", (-4, 2)),
    (Key.Key_G, "y3\t1", "Move x 1|, y 3", (2, 5)),
    (Key.Key_G, "x3\t1", "Move x 3, y 1|", (4, 3)),
    (Key.Key_G, "3\t1y", "Move 1 along y", (1, 3)),
    (Key.Key_G, "3\t1x", "Move 3 along x", (4, 2)),
    (Key.Key_G, "3y", "Move 3 along y", (1, 5)),
    (Key.Key_S, "2\t3", "Scale x 2, y 3|", (0, 4)),
    (Key.Key_S, "2\t", "Scale x 2, y |", (0, 2)),
    (Key.Key_S, "\t3", "Scale x 1, y 3|", (1, 4)),
    (Key.Key_S, "2", "Scale 2", (0, 3)),
    (Key.Key_S, "4/2", "Scale 2 (4/2)", (0, 3)),
    (Key.Key_R, "9\t0", "Rotate 90°", (1, 0)),
    (Key.Key_R, "180/2", "Rotate 90° (180/2)", (1, 0)),
]


@pytest.mark.parametrize("key", [Key.Key_G, Key.Key_S, Key.Key_R])
def test_tab_moves_from_x_to_y(arch, key):
    """Points 1 and 3, at (1, 2) and (3, 0), are worked on; they are scaled and turned about (2, 1)."""
    four = Document((make_curve([(0, 0), (1, 2), (2, 3), (3, 0)]),))
    for typed, status, second in (case[1:] for case in TYPED if case[0] == key):
        arch.session.commit(four, "Four")
        arch.session.selected.set_points([1, 3])
        arch.key(key)
        arch.type_amount(typed)
        assert arch.status.startswith(status)
        arch.key(Key.Key_Return)
        assert arch.point(1) == pytest.approx(second, abs=1e-12), typed
        assert arch.session.selection == {1, 3}


@pytest.mark.parametrize(("typed", "shown"), [("1/", "Move 0, 0 (1/…)"), ("1\t-", "Move x 1, y −|")])
def test_an_incomplete_number_is_refused_and_can_be_corrected(arch, typed, shown):
    arch.select([1])
    arch.key(Key.Key_G)
    arch.type_amount(typed)
    assert arch.status.startswith(shown)
    arch.key(Key.Key_Return)
    assert arch.status.endswith("The number or expression is incomplete.")
    assert arch.window.canvas.is_dragging
    arch.type_amount("4")
    assert arch.status.startswith("Move ")
    arch.key(Key.Key_Return)
    assert arch.point(1) == {"1/": (1.25, 2), "1\t-": (2, -2)}[typed]


def test_a_click_cancels_a_transform_by_an_incomplete_number(arch):
    document, steps = arch.session.document, arch.session.undo_stack.count()
    arch.key(Key.Key_G)
    arch.type_amount("1/")
    arch.click((-1, 3))
    assert arch.status == "“1/”: The number or expression is incomplete."
    assert (arch.session.document, arch.session.undo_stack.count()) == (document, steps)
    assert not arch.window.canvas.is_dragging


UNITS = [
    ("mm", "13\t0.5m", "Move x 13, y 0.5m|", (14, 502)),
    ("mm", "13\t0.5mm", "Move x 13, y 0.5mm|", (14, 2.5)),
    ("mm", "1inx", "Move 25.4 along x (1in)", (26.4, 2)),
    ("mm", "y1/2cm", "Move 5 along y (1/2cm)", (1, 7)),
    ("in", "96px", "Move 1, 0 (96px)", (2, 2)),
    ("mm", "2CM", "Move 20, 0 (2", (21, 2)),
    ("ell", "3ell", "Move 3, 0 (3ell)", (4, 2)),
]


def test_a_unit_may_follow_the_number(arch):
    """The letter m dropped the move and took the tool that measures."""
    document = arch.session.document
    for unit, typed, shown, to in UNITS:
        arch.session.commit(replace(document, unit=unit), "Unit")
        arch.select([1])
        arch.key(Key.Key_G)
        arch.type_amount(typed)
        assert arch.status.startswith(shown), typed
        arch.key(Key.Key_Return)
        assert arch.point(1) == pytest.approx(to, abs=1e-12), typed
    arch.new()


NO_UNITS = [
    ("mm", "g2q", "“q” is not a unit of length"),
    ("mm", "g2mv", "“mv” is not a unit of length"),
    ("", "g2m", "The document has no unit of length. Type a number without “m”."),
    ("ell", "g2m", "The unit “ell” is not a length"),
    ("mm", "s2m", "A factor or an angle has no unit; type a number without “m”."),
    ("mm", "r2b", "A factor or an angle has no unit; type a number without “b”."),
    ("mm", "g2V", "“V” is not a unit of length"),
]


def test_other_letters_are_refused_and_act_on_nothing(arch):
    document = arch.session.document
    for unit, keys, reason in NO_UNITS:
        arch.session.commit(replace(document, unit=unit), "Unit")
        arch.select([1])
        for key in keys[:-1]:
            QTest.keyClicks(arch.window.canvas, key)
        before, tool = arch.session.document, arch.window.canvas.tools.record
        held = SHIFT if keys[-1].isupper() else Qt.KeyboardModifier.NoModifier
        last = getattr(Key, f"Key_{keys[-1].upper()}")
        QTest.keyPress(arch.window.canvas, last, held)
        assert arch.status.startswith(reason), keys
        assert arch.window.canvas.is_dragging, keys
        assert arch.window.canvas.tools.record is tool, keys
        assert arch.session.document == before, keys
        QTest.keyRelease(arch.window.canvas, last, held)
        # Keys that mean another transform still do.
        QTest.keyClick(arch.window.canvas, Key.Key_R, SHIFT)
        assert arch.status.startswith("Skew"), keys
        arch.escape()
    arch.new()


def test_operators_may_need_shift(arch):
    arch.select([1])
    arch.key(Key.Key_G)
    for key, character in ((Key.Key_2, "2"), (Key.Key_Asterisk, "*"), (Key.Key_3, "3")):
        held = SHIFT if character == "*" else Qt.KeyboardModifier.NoModifier
        QTest.keyClick(arch.window.canvas, key, held)
    assert arch.status.startswith("Move 6, 0 (2*3)")
    arch.key(Key.Key_Return)
    assert arch.point(1) == (7, 2)


def test_both_numbers_can_be_mended_and_given_up(arch):
    arch.select([1])
    arch.key(Key.Key_G)
    arch.type_amount("12\t34")
    for expected in ("Move x 12, y 3|", "Move x 12, y |", "Move 12, 0", "Move 1, 0"):
        arch.key(Key.Key_Backspace)
        assert arch.status.startswith(expected)
    arch.key(Key.Key_Tab, SHIFT)
    assert arch.status.startswith("Move x 1, y |")
    arch.key(Key.Key_Tab, SHIFT)
    assert arch.status.startswith("Move x 1|, y 0")
    arch.key(Key.Key_S)
    assert arch.status.startswith("Scale 1 ")
    arch.escape()
    assert points(arch).tolist() == [list(each) for each in POINTS]


def test_a_semicolon_counts_as_tab(arch):
    arch.select([1])
    arch.key(Key.Key_G)
    arch.type_amount("1")
    canvas = arch.window.canvas
    for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
        QApplication.sendEvent(canvas, QKeyEvent(kind, Key.Key_Semicolon, SHIFT, ";"))
    arch.type_amount("2")
    arch.key(Key.Key_Return)
    assert arch.point(1) == (2, 4)


def test_the_pointer_counts_no_longer_once_two_numbers_are_typed(arch):
    arch.select([1])
    arch.key(Key.Key_G)
    arch.type_amount("1\t2")
    arch.move((3, 4), held=False)
    assert arch.point(1) == (2, 4)
    arch.escape()
    assert arch.point(1) == (1, 2)


def test_tab_walks_the_points_again_afterwards(arch):
    arch.select([1])
    transform(arch, "G", "1\t2")
    QTest.keyClick(arch.window.canvas, Key.Key_Tab)
    assert arch.session.selection == {2}


def test_the_keys_are_in_the_hint_and_on_the_sheet(arch):
    arch.key(Key.Key_G)
    assert "type a number, or x Tab y" in arch.status
    arch.escape()
    assert "Tab" in arch.action("moveSelection").toolTip()
    assert "Tab" in arch.action("scaleSelection").toolTip()
    arch.trigger("showShortcuts")
    sheet = arch.window.findChild(QWidget, "shortcutSheet")
    assert any("Tab (or ;) moves from x to y" in label.text() for label in sheet.findChildren(QLabel))


def test_the_status_line_says_that_the_image_is_being_moved(arch, tmp_path):
    image = arch.window.grab()
    assert image.save(str(tmp_path / "shot.png"))
    arch.window.commands[ImageCommands].trace(tmp_path / "shot.png")
    arch.trigger("moveImage")
    arch.key(Key.Key_G)
    assert arch.status == "Move Image is in use. Press Escape to return to the points."
    assert not arch.window.canvas.is_dragging
