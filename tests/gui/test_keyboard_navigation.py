"""Keyboard navigation: mnemonics of the menus, F6 between panels, Escape to the canvas, F11."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QColor, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QGraphicsView, QLineEdit, QMenu, QWidget
from shiboken6 import Shiboken

from app.actions.keymap import plain, with_mnemonics
from app.appearance.theme import theme_of
from app.features.curve_list.commands import CurveListCommands
from app.features.lessons.panel import LessonPanel
from app.qt.overrides import SafeOverrides
from app.window.window_commands import first_in

CTRL = Qt.KeyboardModifier.ControlModifier


def letter_of(text):
    """What is typed for an entry, as Qt reads it."""
    return QKeySequence.mnemonic(text).toString().removeprefix("Alt+")


def has_focus(widget):
    here = QApplication.focusWidget()
    return here is not None and (here is widget or widget.isAncestorOf(here))


def test_every_menu_and_entry_has_its_own_mnemonic(editor):
    bar = editor.window.menuBar()
    assert [letter_of(action.text()) for action in bar.actions()] == ["F", "E", "C", "P", "A", "N", "V", "H"]
    menus = [menu for menu in bar.findChildren(QMenu) if menu.title()]
    assert len(menus) > 15
    for menu in menus:
        menu.aboutToShow.emit()
        entries = [action for action in menu.actions() if action.text()]
        letters = [letter_of(action.text()) for action in entries]
        assert all(letters), [action.text() for action in entries]  # there was none
        # A menu with more entries than the alphabet has letters for them shares some.
        known = {letter for action in entries for letter in plain(action.text()).upper() if letter.isalnum()}
        assert len(set(letters)) == min(len(letters), len(known))
        menu.aboutToHide.emit()
        assert [action.text() for action in entries] == [plain(action.text()) for action in entries]


def test_alt_and_letters_choose_an_entry(editor):
    window = editor.window
    window.activateWindow()
    QTest.keyClick(window, Qt.Key.Key_V, Qt.KeyboardModifier.AltModifier)
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    grid = editor.action("toggleGrid")
    assert grid.isChecked()
    QTest.keyClick(menu, getattr(Qt.Key, f"Key_{letter_of(grid.text())}"))
    editor.settle()
    assert not grid.isChecked()
    assert grid.text() == "Grid"


def test_f10_opens_the_first_menu(editor):
    editor.window.activateWindow()
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_F10)
    opened = QApplication.activePopupWidget()
    assert opened is not None
    assert plain(opened.title()) == "File"
    opened.close()


@pytest.mark.parametrize(
    ("texts", "wanted"),
    [
        (["Save", "Save As…", "Select"], ["&Save", "Save &As…", "S&elect"]),
        # The last has one letter: whoever has it gives way.
        (["ab", "a"], ["a&b", "&a"]),
        (["R && D", "Open &Recent"], ["&R && D", "&Open Recent"]),
        # Typed, a letter that two have goes from the one to the other.
        (["…", "x", "x"], ["…", "&x", "&x"]),
    ],
)
def test_letters_are_given_out(texts, wanted):
    assert with_mnemonics(texts) == wanted


def test_f6_walks_every_panel_in_sight_and_back(editor):
    window = editor.window
    window.activateWindow()
    window.canvas.setFocus()
    seen = [dock for dock in window.context.docks.side if not dock.visibleRegion().isEmpty()]
    assert len(seen) == 2
    round_trip = [window.basis_panel, *seen, window.toolbar, window.canvas]
    for panel in round_trip:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_F6)
        editor.settle()
        assert has_focus(panel), QApplication.focusWidget()
    for panel in [*round_trip[-2::-1], window.canvas]:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_F6, Qt.KeyboardModifier.ShiftModifier)
        assert has_focus(panel), QApplication.focusWidget()
    # Seen: a frame in the colour of the focus, for who came by keys.
    accent = theme_of(window.palette()).accent
    corner = window.canvas.viewport().grab().toImage().pixelColor(1, 40)
    assert corner == accent
    editor.click(editor.point(0))
    assert accent_around(window.canvas.viewport()) == 0, "and who goes on by mouse sees the pointer"
    QTest.keyClick(window.canvas, Qt.Key.Key_F6)
    assert QColor(window.canvas.viewport().grab().toImage().pixel(1, 40)) != accent


def accent_around(widget):
    """Return how many pixels of a widget's left and right edges have the colour of the focus."""
    image, accent = widget.grab().toImage(), theme_of(widget.palette()).accent
    edges = (0, image.width() - 1)
    return sum(image.pixelColor(x, y) == accent for x in edges for y in range(image.height()))


def test_f6_to_the_lessons_draws_a_frame_and_escape_clears_the_message(editor):
    """The list of lessons took the focus and showed nothing; its word stayed when Escape had left it."""
    window = editor.window
    window.activateWindow()
    editor.trigger("toggleLessons")
    panel = window.findChild(LessonPanel)
    for _ in range(2):
        window.canvas.setFocus()
        while not has_focus(panel):
            QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_F6)
        editor.settle()
        assert editor.status == "Lessons."
        here = QApplication.focusWidget()
        assert accent_around(here) > here.height(), here
        QTest.keyClick(here, Qt.Key.Key_Escape)
        editor.settle()
        assert window.canvas.hasFocus()
        assert editor.status != "Lessons."
        assert accent_around(here) == 0
        panel.lesson_wanted.emit(0)
        editor.settle()
    panel.text.setFocus()
    assert accent_around(panel.text) > panel.text.height()
    window.canvas.setFocus()
    assert accent_around(panel.text) == 0


def test_escape_leaves_a_panel_for_the_canvas_and_then_steps_back(editor):
    window, table = editor.window, editor.window.point_table
    window.activateWindow()
    editor.select([1])
    table.setFocus()
    table.setCurrentIndex(table.numbers.index(1, 1))
    QTest.keyClick(table, Qt.Key.Key_Return)
    field = QApplication.focusWidget()
    assert field is not table
    QTest.keyClick(field, Qt.Key.Key_Escape)
    editor.settle()
    assert has_focus(table)
    QTest.keyClick(table, Qt.Key.Key_Escape)
    assert window.canvas.hasFocus()  # it stayed in the table
    assert editor.session.selection == {1}
    QTest.keyClick(window.canvas, Qt.Key.Key_Escape)
    assert not editor.session.selection
    editor.show_dock("curvesDock")
    window.commands[CurveListCommands].panel.view.setFocus()
    QTest.keyClick(window.commands[CurveListCommands].panel.view, Qt.Key.Key_Escape)
    assert window.canvas.hasFocus()


def test_tab_moves_from_the_points_to_the_message_and_on_to_the_functions(editor):
    window = editor.window
    editor.session.offer("It may be undone.", "fitView")
    window.canvas.setFocus()
    editor.select([len(editor.curve.points) - 1])
    passed = []
    for _ in range(3):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        passed.append(QApplication.focusWidget().objectName())
    assert passed == ["offeredAction", "closeMessage", "basisPanel"]


def test_f11_twice_leaves_a_maximised_window_maximised(editor):
    window = editor.window
    window.showMaximized()
    editor.settle()
    for is_presented in (True, False):
        QTest.keyClick(window.canvas, Qt.Key.Key_F11)
        editor.settle()
        assert window.isFullScreen() is is_presented
    assert window.isMaximized()  # it had become small


def test_a_panel_without_focusable_content_does_not_own_the_next_widget(qtbot):
    """The canvas' viewport was taken for a part of whatever came before it, and for deleted when that was."""
    window = QWidget()
    qtbot.addWidget(window)
    panel, view = QWidget(window), QGraphicsView(window)
    viewport = view.viewport()
    assert first_in(panel) is None
    owner = next(line for line in Shiboken.dump(viewport).splitlines() if line.startswith("parent"))
    assert owner.endswith(f"at {hex(id(view))}>")


class GreedyField(SafeOverrides, QLineEdit):
    """Claims every key, as Qt's fields do with Ctrl+E and others on X11 alone."""

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        return bool(super().event(event))


def test_in_a_text_field_keys_of_the_window_act_and_editing_keys_edit_the_text(editor):
    """On X11 Ctrl+E went to the end of the line."""
    field = GreedyField("none", editor.window)
    field.show()
    field.setFocus()
    steps = editor.session.undo_stack.count()
    QTest.keyClick(field, Qt.Key.Key_A, CTRL)
    assert field.selectedText() == "none"
    QTest.keyClick(field, Qt.Key.Key_X, CTRL)
    assert field.text() == ""
    QTest.keyClick(field, Qt.Key.Key_Z, CTRL)
    assert (field.text(), editor.session.undo_stack.count()) == ("none", steps)
    QTest.keyClick(field, Qt.Key.Key_E, CTRL)
    editor.settle()
    dialog = editor.window.findChild(QDialog, "exportDialog")
    assert dialog.isVisible()
    dialog.close()
