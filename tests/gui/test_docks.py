"""Docks: their buttons tell how they stand, and what is docked or put away leaves the right one in front."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QTabBar, QToolButton

from app.appearance.theme import ThemeMode
from app.testing import Editor
from tests.waiting import until

LEFT = Qt.MouseButton.LeftButton


def dock(editor, name):
    return editor.window.findChild(QDockWidget, name)


def button(editor, name):
    return editor.window.findChild(QToolButton, name)


def is_in_front(editor, name):
    return not dock(editor, name).visibleRegion().isEmpty()


@pytest.mark.parametrize("name", ["pointsDock", "historyDock"])
def test_a_panel_that_is_docked_again_comes_to_the_front(editor, name):
    editor.show_dock(name)
    button_ = button(editor, f"{name}Float")
    QTest.mouseClick(button_, LEFT)
    assert dock(editor, name).isFloating()
    editor.show_dock("curvesDock")
    QTest.mouseClick(button_, LEFT)
    assert not dock(editor, name).isFloating()
    editor.settle()
    assert is_in_front(editor, name)
    assert not is_in_front(editor, "curvesDock")


def test_the_key_of_a_panel_raises_a_tab_behind_and_hides_a_tab_in_front(editor):
    """The entry of a panel that nobody saw hid it."""
    editor.show_dock("styleDock")
    editor.run_command("curves panel")
    assert is_in_front(editor, "curvesDock")
    shown = dock(editor, "curvesDock").toggleViewAction()
    assert shown.isChecked()
    # What it covered comes back with the second.
    for is_there in (False, True):
        editor.run_command("curves panel")
        assert dock(editor, "curvesDock").isHidden() is not is_there
        assert shown.isChecked() is is_there
        assert is_in_front(editor, "curvesDock") is is_there
        assert is_in_front(editor, "styleDock") is not is_there


def test_a_double_click_on_the_title_floats_a_panel_and_another_docks_the_panel_in_front(editor):
    points = dock(editor, "pointsDock")
    title = points.titleBarWidget()
    for floats in (True, False):
        QTest.mouseDClick(title, LEFT, pos=title.rect().center())
        assert points.isFloating() is floats
        editor.settle()
    assert is_in_front(editor, "pointsDock")
    # The window that the button went down in was another one: without this, Qt takes it to be down still.
    QTest.mouseRelease(title, LEFT, pos=title.rect().center())


def test_the_tip_of_the_float_button_describes_a_press(editor):
    button_ = button(editor, "pointsDockFloat")
    assert (button_.isChecked(), button_.accessibleName()) == (False, "Float Points")
    assert button_.toolTip().startswith("Float")
    docked = button_.icon().cacheKey()
    QTest.mouseClick(button_, LEFT)
    assert (button_.isChecked(), button_.accessibleName()) == (True, "Dock Points")
    assert button_.toolTip().startswith("Dock")
    assert button_.icon().cacheKey() != docked
    QTest.mouseClick(button_, LEFT)
    assert (button_.isChecked(), button_.accessibleName()) == (False, "Float Points")
    assert button_.toolTip().startswith("Float")


def colours(widget):
    image = widget.grab().toImage()
    return {image.pixelColor(x, y).name() for x in range(image.width()) for y in range(image.height())}


@pytest.mark.parametrize("mode", [ThemeMode.LIGHT, ThemeMode.DARK])
def test_the_buttons_show_the_pointer_the_press_and_the_focus(editor, mode):
    editor.window.store.change(theme_mode=mode)
    editor.settle()
    for name in ("pointsDockFloat", "pointsDockClose"):
        looks = looks_of(editor, button(editor, name))
        assert all(one != other for place, one in enumerate(looks) for other in looks[:place]), name
    editor.window.store.change(theme_mode=ThemeMode.SYSTEM)


def looks_of(editor, button_):
    """Return the colours of a button that rests, is pointed at, pressed, and has the focus."""
    QTest.mouseMove(editor.window, editor.window.rect().center())
    editor.settle()
    looks = [colours(button_)]
    QTest.mouseMove(button_)
    editor.settle()
    looks.append(colours(button_))
    QTest.mousePress(button_, LEFT)
    looks.append(colours(button_))
    QTest.mouseMove(editor.window, editor.window.rect().center())
    QTest.mouseRelease(button_, LEFT, pos=button_.rect().bottomRight() * 9)
    button_.setFocus(Qt.FocusReason.TabFocusReason)
    editor.settle()
    return [*looks, colours(button_)]


def test_the_buttons_are_reached_by_tab_and_pressed_by_space(editor):
    editor.show_dock("curvesDock")
    float_button = button(editor, "curvesDockFloat")
    editor.window.findChild(QDockWidget, "curvesDock").activateWindow()
    float_button.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(float_button, Qt.Key.Key_Tab)
    assert QApplication.focusWidget() is button(editor, "curvesDockClose")
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Backtab)
    QTest.keyClick(float_button, Qt.Key.Key_Space)
    assert dock(editor, "curvesDock").isFloating()
    QTest.keyClick(float_button, Qt.Key.Key_Space)
    assert not dock(editor, "curvesDock").isFloating()


def test_the_keys_to_the_next_panel_focus_its_content(editor):
    editor.window.canvas.setFocus()
    seen = set()
    for _ in range(12):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_F6)
        seen.add(QApplication.focusWidget().objectName())
    assert "pointTable" in seen
    assert not {name for name in seen if name.endswith(("DockFloat", "DockClose"))}


@pytest.mark.parametrize("front", ["curveDock", "jointsDock"])
def test_escape_restores_the_front_tab_before_an_explanation(editor, front):
    editor.show_dock(front)
    editor.select([2])
    editor.key(Qt.Key.Key_W)
    assert is_in_front(editor, "wiggleDock")
    assert editor.session.scrub.t is not None
    editor.escape()
    assert dock(editor, "wiggleDock").isHidden()
    assert is_in_front(editor, front)
    assert editor.session.scrub.t is None
    assert editor.action("selectTool").isChecked()
    assert editor.session.selection == {2}


def test_a_previous_scrub_line_returns_to_its_position(editor):
    editor.scrub(0.3)
    t = editor.session.scrub.t
    editor.trigger("explainWidest")
    assert editor.session.scrub.t != t
    QTest.mouseClick(button(editor, "wiggleDockClose"), LEFT)
    assert editor.session.scrub.t == t
    editor.trigger("explainWiggle")
    editor.click(tuple(np.array(editor.session.active_view.curve.evaluate(0.8)).tolist()))
    editor.escape()
    assert editor.session.scrub.t == t


@pytest.mark.parametrize("size", [(1024, 700), (1400, 900)])
def test_an_opened_panel_takes_the_required_room_and_returns_the_room_when_closed(qtbot, size):
    editor = Editor(qtbot, size=size)
    points, transform = dock(editor, "pointsDock"), dock(editor, "transformDock")
    before = points.height()
    for _ in range(2):
        editor.key(Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
        until(lambda: not transform.widget().verticalScrollBar().maximum())
        spare = transform.widget().viewport().height() - transform.widget().content.sizeHint().height()
        # In a high window its share is enough, and nothing is taken for it.
        assert 0 <= spare <= 2 or (spare > 0 and abs(points.height() - before) <= 2)
        transform.close()
        until(lambda: abs(points.height() - before) <= 2)


def test_titles_of_many_panels_are_whole(qtbot):
    editor = Editor(qtbot, size=(1024, 700))
    for name in ("documentDock", "wiggleDock", "laboratoryDock", "transformDock"):
        editor.show_dock(name)
    editor.settle()
    bars = [bar for bar in editor.window.findChildren(QTabBar) if bar.isVisible()]
    bar = max(bars, key=QTabBar.count)
    assert bar.count() == 7
    wanted = [bar.fontMetrics().horizontalAdvance(bar.tabText(at)) for at in range(7)]
    assert all(bar.tabRect(at).width() > width for at, width in enumerate(wanted))
    assert bar.width() <= 360, "the others are reached by its arrows"
