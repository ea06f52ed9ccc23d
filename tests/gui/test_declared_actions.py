"""An action that is declared on its handler is everywhere; nothing else has to be written."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QLabel

from app.actions.declaration import Action, PositionAction, action, action_for_each, all_declared
from app.actions.keymap import plain
from app.actions.menus import ANALYSIS, CURVE_SHAPE, PLOTS_IN_PLANE
from app.actions.needs import Need
from app.document.limits import EditError
from app.features.help.shortcut_sheet import ShortcutSheet
from app.session import Session
from app.testing import Editor
from app.window import MainWindow
from app.window.connect import COMMAND_SETS, all_actions
from app.window.preferences_dialog import ShortcutEditor
from app.workbench.docks import Panel

TIP = "Count the selected points aloud"


class CountingCommands:
    """All that a new action takes: a command set with one decorated method."""

    def __init__(self, context):
        self._context = context
        self.counted = []
        self.refuses = False

    @action(
        "countPoints",
        "Count Aloud",
        PLOTS_IN_PLANE,
        "Ctrl+Alt+F7",
        "measure",
        full_name="Count Points Aloud",
        needs=Need("one selected point", lambda state: state.selected_count == 1),
    )
    def _count(self):
        """Count the selected points aloud."""
        if self.refuses:
            raise EditError("These points are not counted.")
        self.counted.append(len(self._context.session.selection))

    @PositionAction("countHere", "Count Here", like="countPoints")
    def count_at(self, t):
        self.counted.append(t)

    @Panel("countDock", "Count", on_demand=True)
    def build_panel(self, parent):
        return QLabel("Counted")


class SwitchCommands:
    """An action for each of some records, which are read when a window is made."""

    records: list[str]

    def __init__(self, context):
        self._context = context

    @action_for_each(
        lambda: SwitchCommands.records,
        lambda name: Action(
            f"title{name}",
            name,
            CURVE_SHAPE,
            tip=f"Call it {name}",
            checked=lambda state: state.curve_name == name,
            title=lambda state: f"{name} of {state.curve_count}",
        ),
    )
    def _switch(self, name):
        self._context.session.say(name)


@pytest.fixture
def counting(qtbot):
    """An editor whose window has one command set more."""
    window = MainWindow(Session(), command_sets=(*COMMAND_SETS, CountingCommands))
    qtbot.addWidget(window)
    with qtbot.waitExposed(window):
        window.show()
    window.asks_before_closing = False
    editor = Editor.on(window)
    editor.fit()
    return editor


def entries(menu):
    return [each.objectName() for each in menu.actions() if not each.isSeparator()]


def submenu(window, *titles):
    menu = window.menuBar()
    for title in titles:
        (menu,) = (each.menu() for each in menu.actions() if plain(each.text()) == title)
    return menu


def test_an_action_is_in_its_menu_with_its_tip(counting):
    shown = counting.action("countPoints")
    assert entries(submenu(counting.window, "Analysis", "Plots"))[-2:] == ["plotHodograph", "countPoints"]
    assert shown.text() == "Count Aloud"
    assert shown.statusTip() == TIP
    assert shown.toolTip().splitlines() == [f"{TIP} (Ctrl+Alt+F7)", "Needs one selected point"]
    assert not shown.icon().isNull()


def test_an_action_is_enabled_by_its_need_and_triggered_by_its_key(counting, qtbot):
    commands = counting.window.commands[CountingCommands]
    held = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier
    qtbot.keyClick(counting.window.canvas, Qt.Key.Key_F7, held)
    assert commands.counted == []
    assert counting.window.status_line.text == "“Count Points Aloud” needs one selected point."
    counting.select([1])
    assert counting.action("countPoints").isEnabled()
    assert counting.action("countPoints").toolTip() == f"{TIP} (Ctrl+Alt+F7)"
    qtbot.keyClick(counting.window.canvas, Qt.Key.Key_F7, held)
    assert commands.counted == [1]
    counting.select([0, 1])
    assert not counting.action("countPoints").isEnabled()


def test_an_error_of_a_handler_is_in_the_status_line(counting):
    counting.window.commands[CountingCommands].refuses = True
    counting.select([1])
    counting.trigger("countPoints")
    assert counting.window.status_line.text == "These points are not counted."
    assert counting.window.status_line.is_refusal


def test_a_switch_is_checked_as_declared(counting):
    actions = counting.window.actions_by_name
    assert actions.is_on("toggleGrid")
    assert not actions.is_on("toggleScrub")
    assert not actions.is_on("countPoints")


def test_the_menu_of_a_position_on_the_curve_has_the_declared_entry(counting):
    counting.select([1])
    at = tuple(counting.session.active_view.curve.evaluate(0.43))
    counting.open_menu(at)
    counting.choose("countHere")
    (t,) = counting.window.commands[CountingCommands].counted
    assert t == pytest.approx(0.43, abs=0.02)


def test_a_panel_is_declared_on_the_method_that_builds_it(counting):
    dock = counting.window.findChild(QDockWidget, "countDock")
    assert dock.windowTitle() == "Count"
    assert dock.isHidden()
    assert dock.widget() is None
    assert "countDockShown" in entries(submenu(counting.window, "View", "Panels"))
    counting.show_dock("countDock")
    assert [label.text() for label in dock.widget().findChildren(QLabel)] == ["Counted"]


def test_palette_shortcuts_and_help_list_the_action(counting):
    assert counting.find_command("count aloud")[0] == "Count Points Aloud"
    keys = ShortcutEditor(counting.window.actions_by_name.keymap, counting.window)
    names = [keys.table.item(row, 0).data(Qt.ItemDataRole.UserRole) for row in range(keys.table.rowCount())]
    assert "countPoints" in names
    counting.select([1])
    assert ("Ctrl+Alt+F7", TIP) in counting.window.actions_by_name.shortcuts(ANALYSIS)
    counting.trigger("showShortcuts")
    sheet = counting.window.findChild(ShortcutSheet)
    assert sheet.isVisible()
    assert TIP in [label.text() for label in sheet.findChildren(QLabel)]


def test_records_added_later_have_actions_in_the_next_window(qtbot):
    SwitchCommands.records = ["Curve 1", "Sketch"]
    assert [each.action.name for each in all_declared([SwitchCommands])] == ["titleCurve 1", "titleSketch"]
    SwitchCommands.records = ["Curve 1", "Sketch", "Arch"]
    window = MainWindow(Session(), command_sets=(*COMMAND_SETS, SwitchCommands))
    qtbot.addWidget(window)
    window.asks_before_closing = False
    shown = entries(submenu(window, "Curve"))
    assert shown.index("titleArch") == shown.index("titleSketch") + 1
    assert window.findChild(QAction, "titleArch").text() == "Arch of 1"
    window.findChild(QAction, "titleArch").trigger()
    # A click does not check it: only what is so does.
    assert not window.findChild(QAction, "titleArch").isChecked()


def test_every_declared_action_has_one_name_and_one_handler():
    """By construction each has a handler: one without could not be declared."""
    declared = all_declared(COMMAND_SETS)
    names = [each.action.name for each in declared]
    assert names == [each.name for each in all_actions()]
    assert len(set(names)) == len(names) > 150
    assert all(callable(each.handler) for each in declared)
