"""The window's state is one value with one owner; actions and preferences follow it."""

from __future__ import annotations

import ast
from pathlib import Path

from msgspec.structs import replace

from app.appearance.theme import ThemeMode
from app.settings.kinds import Setting
from app.settings.preferences import Preferences
from app.state.window_state import WindowState, WindowStore
from app.tools.canvas.add import ADD
from app.tools.canvas.select import SELECT

APP = Path(__file__).resolve().parent.parent.parent / "app"
SHOWN = {"controls"}
"""Modules with what shows an action: buttons that mirror one."""


def store_of(tmp_path):
    return WindowStore(Preferences(tmp_path / "settings.ini"))


def test_a_change_is_announced_once_with_the_previous_state(qapp, tmp_path):
    store, told = store_of(tmp_path), []
    store.changed.connect(lambda before, after: told.append((before, after)))
    before = store.state
    store.change(grid=False, tool=ADD)
    assert told == [(before, replace(before, grid=False, tool=ADD))]
    store.change(grid=False)
    assert len(told) == 1


def test_later_receivers_get_changes_in_order(qapp, tmp_path):
    """A change by one who hears of another one would else be told before that one, and undone after it."""
    store, seen = store_of(tmp_path), []

    def hide_basis(_before, after):
        if not after.grid:
            store.change(basis=False)

    store.changed.connect(hide_basis)
    store.changed.connect(
        lambda before, after: seen.append((before.grid, after.grid, before.basis, after.basis))
    )
    store.change(grid=False)
    assert seen == [(True, False, True, True), (False, False, True, False)]
    assert not store.state.basis


REMEMBERED = {
    "snap_on",
    "snap_kinds",
    "tool_settings",
    "transform_box",
    "rulers",
    "keep_proportions",
    "handle_columns",
    "with_estimates",
    "theme_mode",
    "basis",
    "numbered",
}


def test_fields_that_preferences_of_the_same_name_remember_are_remembered(qapp, tmp_path):
    fields = set(WindowState.__struct_fields__)
    remembered = {name for name, each in vars(Preferences).items() if isinstance(each, Setting | property)}
    assert remembered & fields == REMEMBERED
    store = store_of(tmp_path)
    store.change(snap_on=True, rulers=False, theme_mode=ThemeMode.DARK, grid=False)
    again = store_of(tmp_path).state
    assert (again.snap_on, again.rulers, again.theme_mode) == (True, False, ThemeMode.DARK)
    assert again.grid


def test_preferences_of_another_window_are_read_on_request(qapp, tmp_path):
    store = store_of(tmp_path)
    other = store_of(tmp_path)
    other.change(snap_on=True)
    assert not store.state.snap_on
    store._preferences.file._settings.sync()
    store.read_preferences()
    assert store.state.snap_on


SWITCHES = [
    ("toggleGrid", "grid"),
    ("toggleBasis", "basis"),
    ("toggleSidePanel", "side_panel"),
    ("toggleSnap", "snap_on"),
    ("toggleTransformBox", "transform_box"),
    ("toggleEstimates", "with_estimates"),
]


def test_a_switch_shows_the_state_and_requests_a_change(editor):
    editor.trigger("familyHermite")
    for name, field in SWITCHES:
        store, action = editor.window.store, editor.action(name)
        was_on = getattr(store.state, field)
        assert action.isChecked() == was_on, name
        editor.trigger(name)
        assert getattr(store.state, field) != was_on, name
        assert action.isChecked() != was_on, name
        store.change(**{field: was_on})
        assert action.isChecked() == was_on, name


def test_while_the_mouse_moves_the_image_no_tool_for_points_looks_as_if_in_use(editor):
    store = editor.window.store
    assert store.state.uses(SELECT)
    store.change(moves_image=True)
    assert not store.state.uses(SELECT)
    assert store.state.tool is SELECT
    store.change(moves_image=False)
    assert editor.action("selectTool").isChecked()


def test_no_code_reads_is_checked_of_an_action():
    """A box of a dialog is asked: until the dialog is answered its value is nowhere else."""
    asked = {
        path.stem
        for path in APP.rglob("*.py")
        # Only modules that have the name are parsed.
        if "isChecked" in (text := path.read_text(encoding="utf-8"))
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Attribute)
        and node.attr == "isChecked"
        and "action" in ast.unparse(node.value)
    }
    assert asked == SHOWN
