"""Every action can be found: in a menu, with a tooltip, and in toolbars with an icon."""

from __future__ import annotations

from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QMenu, QToolBar, QToolButton

from app.window.connect import all_actions


def in_menu(menu: QMenu):
    """The names of all actions of a menu and its submenus."""
    for action in menu.actions():
        if action.menu() is not None:
            yield from in_menu(action.menu())
        else:
            yield action.objectName()


def test_every_action_is_in_one_menu_once(editor, tmp_path):
    # With a recent file, which there is something to do about.
    path = tmp_path / "a.curve.json"
    path.touch()
    editor.window.preferences.add_recent_file(path)
    editor.window.menus.recent.aboutToShow.emit()
    bar = editor.window.menuBar()
    shown = [name for entry in bar.actions() for name in in_menu(entry.menu())]
    names = [each.name for each in all_actions()]
    assert len(set(names)) == len(names)
    assert {name: shown.count(name) for name in names} == dict.fromkeys(names, 1)


def test_every_action_has_a_tip(editor):
    for each in all_actions():
        action = editor.action(each.name)
        assert action.text(), each.name
        assert action.toolTip() not in {"", action.text()}, each.name
        assert action.statusTip() == each.tip, each.name


def test_actions_with_one_checked_member_are_in_one_group(editor):
    """Of the groups that were made for them most were empty."""
    groups = {
        frozenset(action.objectName() for action in group.actions())
        for group in editor.window.findChildren(QActionGroup)
    }
    actions = all_actions()
    wanted = {
        one.group: frozenset(each.name for each in actions if each.group == one.group) for one in actions
    }
    assert groups == {names for group, names in wanted.items() if group}


def test_every_action_in_a_toolbar_has_an_icon(editor):
    bars = editor.window.findChildren(QToolBar)
    buttons = [button for bar in bars for button in bar.findChildren(QToolButton) if button.defaultAction()]
    assert len(buttons) > 10
    for button in buttons:
        assert not button.icon().isNull(), button.defaultAction().objectName()
