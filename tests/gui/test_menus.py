"""Menus of a bearable height, words that stand alone, and a way back to every panel."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QByteArray, QEvent, QObject, QPoint, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QDockWidget, QMenu

from app.actions.keymap import plain
from app.session import Session
from app.settings.preferences import Preferences
from app.window import MainWindow
from app.window.main_window import first_size
from tests.gui.curve_rows import open_row_menu
from tests.waiting import until

_ROOM = 540 - 30
"""Height of a window of 960 × 540 below its menu bar."""

_MOST_ENTRIES = 20


def menus_of(menu: QMenu):
    """Yield a menu and those within it."""
    yield menu
    for action in menu.actions():
        if action.menu() is not None:
            yield from menus_of(action.menu())


def all_menus(editor):
    """Yield every menu of the menu bar and the menus within it."""
    for entry in editor.window.menuBar().actions():
        yield from menus_of(entry.menu())


def panels_menu(editor) -> QMenu:
    return editor.window.findChild(QMenu, "panelsMenu")


def choose(menu: QMenu, text: str) -> None:
    """Open a menu and click on an entry of it."""
    menu.popup(QPoint(0, 0))
    (entry,) = [action for action in menu.actions() if plain(action.text()) == text]
    QTest.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(entry).center())


def test_every_menu_fits_a_small_window_with_room_for_two_more_entries(editor):
    for menu in all_menus(editor):
        menu.aboutToShow.emit()
        entries = [action for action in menu.actions() if not action.isSeparator()]
        assert len(entries) <= _MOST_ENTRIES, menu.title()
        tallest = max((menu.actionGeometry(entry).height() for entry in entries), default=0)
        height = menu.sizeHint().height()
        assert height <= _ROOM, menu.title()
        # Fonts of 14 pixels are the measure for what may come; some have 17, and as many more for each entry.
        higher = max(0.0, menu.fontMetrics().height() - 14)
        assert height + 2 * tallest - (len(entries) + 2) * higher <= _ROOM, menu.title()


def test_families_and_parameters_are_first_in_the_menu_curve(editor):
    (curve,) = [entry.menu() for entry in editor.window.menuBar().actions() if plain(entry.text()) == "Curve"]
    entries = [plain(action.text()) for action in curve.actions()]
    assert entries[:6] == [
        "Lagrange", "Hermite", "Quintic Hermite", "More Families", "Parameters", "Estimates",
    ]  # fmt: skip


def test_the_menu_bar_names_the_objects_of_the_editor(editor):
    bar = editor.window.menuBar().actions()
    assert [plain(entry.text()) for entry in bar] == [
        "File", "Edit", "Curve", "Points", "Arrange", "Analysis", "View", "Help",
    ]  # fmt: skip


def test_names_in_the_palette_are_clear_without_their_menu(editor):
    found = editor.find_command("")
    for word in ("Top", "Smooth", "Uniform", "Play", "Overwrite"):
        assert word not in found
    editor.select([0, 1])
    assert editor.find_command("top")[0] == "Align Top"
    editor.choose_family("hermite")
    assert editor.find_command("smooth")[0] == "Smooth Tangents"
    assert len(found) == len(set(found))


def test_the_rules_come_first_among_the_parameters(editor):
    (menu,) = [each for each in editor.window.findChildren(QMenu) if each.objectName() == "parametersMenu"]
    texts = [plain(action.text()) for action in menu.actions()]
    assert texts[:9] == [
        "Uniform", "Chord length", "Centripetal", "Power α", "Chebyshev (2nd kind)",
        "Chebyshev (1st kind)", "Manual", "", "Freeze Parameters",
    ]  # fmt: skip


def test_a_closed_panel_reopens_from_the_menu_view(editor):
    dock = editor.window.findChild(QDockWidget, "curvesDock")
    dock.raise_()
    editor.settle()
    button = dock.findChild(QAbstractButton, "curvesDockClose")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert dock.isHidden()
    menu = panels_menu(editor)
    assert [plain(action.text()) for action in menu.actions() if not action.isChecked()] == [
        "Curves", "Transform", "Lab", "Wiggle", "Hodograph", "Fewer Points", "Image", "Document", "Lessons",
    ]  # fmt: skip
    choose(menu, "Curves")
    assert dock.isVisible()
    assert not dock.visibleRegion().isEmpty()


def test_the_panels_menu_has_every_dock(editor):
    docks = editor.window.findChildren(QDockWidget)
    actions = panels_menu(editor).actions()
    assert {dock.toggleViewAction() for dock in docks} == set(actions)
    for action in actions:
        assert action.isCheckable()
        assert action.statusTip()
        assert action.objectName()


class ShowOrder(QObject):
    """Notes who is shown, in order."""

    def __init__(self, *watched):
        super().__init__()
        self.shown = []
        for each in watched:
            each.installEventFilter(self)

    def eventFilter(self, watched, event):
        if event.type() == QEvent.Type.Show:
            self.shown.append(watched.objectName())
        return False


@pytest.mark.parametrize("name", ["pointsDock", "historyDock", "styleDock"])
def test_an_undocked_panel_appears_after_the_window_at_the_next_start(qtbot, tmp_path, name):
    preferences = tmp_path / "settings.ini"
    first = MainWindow(Session(), Preferences(preferences))
    first.setObjectName("mainWindow")
    qtbot.addWidget(first)
    with qtbot.waitExposed(first):
        first.show()
    dock = first.findChild(QDockWidget, name)
    dock.setFloating(True)
    first.close()
    assert not dock.isVisible()
    second = MainWindow(Session(), Preferences(preferences))
    second.setObjectName("mainWindow")
    qtbot.addWidget(second)
    dock = second.findChild(QDockWidget, name)
    order = ShowOrder(second, dock)
    with qtbot.waitExposed(second):
        second.show()
    until(lambda: order.shown[-1:] == [name])
    assert dock.isFloating()
    assert dock.isVisible()


class FakeScreen:
    """A screen of another size than the one here."""

    def __init__(self, width, height):
        self._size = QSize(width, height)

    def availableSize(self):
        return self._size


@pytest.mark.parametrize(("screen", "most"), [((1024, 768), (1008, 720)), ((3840, 2160), (1280, 860))])
def test_the_first_window_fits_the_screen_with_its_frame(screen, most):
    size = first_size(FakeScreen(*screen))
    assert (size.width(), size.height()) == most


def test_an_invalid_window_geometry_is_ignored_without_a_message(qtbot, tmp_path):
    preferences = Preferences(tmp_path / "settings.ini")
    tiny = MainWindow(Session(), preferences)
    qtbot.addWidget(tiny)
    usual = tiny.size()
    preferences.window_geometry = QByteArray(b"none")
    window = MainWindow(Session(), preferences)
    qtbot.addWidget(window)
    assert preferences.complaint == ""
    assert window.size() == usual
    assert QApplication.activeModalWidget() is None


@pytest.fixture
def row_menu(waves):
    """Return what opens the menu of a row by the right button."""
    editor = waves("ABC")

    def open_it(row):
        open_row_menu(editor, row)
        return QApplication.activePopupWidget()

    yield open_it
    if (menu := QApplication.activePopupWidget()) is not None:
        menu.close()


def test_the_menu_of_a_row_has_only_enabled_actions(row_menu):
    """It had 26 entries, most of them grey."""
    menu = row_menu(1)
    entries = [each for each in menu.actions() if not each.isSeparator()]
    assert len(entries) < 19
    names = {each.objectName() for each in entries}
    assert {"renameCurve", "curveLocked", "duplicateCurve", "deleteCurve"} <= names
    assert names.isdisjoint({"showAll", "unlockAll", "ungroupCurves", "combineCurves"})
    submenus = [each.menu() for each in entries if each.menu() is not None]
    assert all(each.isEnabled() for part in (menu, *submenus) for each in part.actions())


def test_the_menu_of_a_row_has_the_actions_on_shapes(row_menu, editor):
    editor.session.selected.select_whole((0, 1))
    editor.trigger("combineCurves")
    menu = row_menu(1)
    (shape,) = [each.menu() for each in menu.actions() if plain(each.text()) == "Shape"]
    assert {"breakApart", "simplify"} <= {each.objectName() for each in shape.actions()}


def test_the_menu_of_a_row_shows_hidden_curves(row_menu, editor):
    assert not editor.action("showAll").isEnabled()
    editor.trigger("curveVisible")
    editor.settle()
    row_menu(0)
    editor.choose("showAll")
    assert all(curve.visible for curve in editor.session.document.curves)
    editor.key(Qt.Key.Key_H, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier)
    assert editor.status == "No curve is hidden."
