"""Command palette, preferences and shortcuts: what works on the program itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from .. import window
from ..actions.declaration import action
from ..actions.keymap import plain
from ..actions.menus import EDIT_PROGRAM, HELP_ALL
from ..workbench.context import WindowContext

if TYPE_CHECKING:
    from .command_palette import CommandPalette
    from .preferences_dialog import PreferencesDialog


class ProgramCommands:
    """Finds every action of the window; preferences and keys."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._keymap = context.actions.keymap
        self._palette: CommandPalette | None = None
        self._dialog: PreferencesDialog | None = None
        self._keymap.load(context.preferences.shortcuts)
        self._keymap.changed.connect(self._remember_keys)

    # Palette

    @action("commandPalette", "Command Palette…", HELP_ALL, "Ctrl+Shift+P", "search", during_gesture=True)
    def _toggle_palette(self) -> None:
        """Find anything that can be done, by a few letters of its name."""
        if self._palette is None:
            self._palette = window.command_palette.CommandPalette(
                self._context.central.canvas, self._commands
            )
        if self._palette.isVisible():
            self._palette.close_and_return()
        else:
            self._palette.open()

    def _commands(self) -> list[window.command_palette.Command]:
        """Return everything with a name: what the menus hold, then what only other places offer."""
        host, found = self._context.window, dict[QAction, str]()
        for entry in host.menuBar().actions():
            menu = _menu_of(entry)
            if menu is not None:
                found.update(_entries(menu, plain(menu.title())))
        for each in host.findChildren(QAction):
            if each.objectName() and each.isVisible() and _menu_of(each) is None and _is_named(each):
                found.setdefault(each, "")
        own = self._context.actions["commandPalette"]
        docks = {dock.toggleViewAction() for dock in self._context.docks.all if not dock.isHidden()}
        return [
            window.command_palette.Command(
                action, path, action in docks or self._context.actions.is_on(action.objectName())
            )
            for action, path in found.items()
            if action is not own
        ]

    # Preferences

    @action("editShortcuts", "Keyboard Shortcuts…", HELP_ALL, icon="keyboard")
    def _edit_shortcuts(self) -> None:
        """Choose which keys do what."""
        self._open_dialog().show_shortcuts()

    @action("preferences", "Preferences…", EDIT_PROGRAM, "Ctrl+,", "settings")
    def _show_preferences(self) -> None:
        """Theme, unit, grid, snapping and keys."""
        self._open_dialog().tabs.setCurrentIndex(0)

    def _open_dialog(self) -> window.preferences_dialog.PreferencesDialog:
        if self._dialog is None:
            context = self._context
            self._dialog = window.preferences_dialog.PreferencesDialog(
                context.preferences, self._keymap, context.window
            )
            self._dialog.changed.connect(context.store.read_preferences)
        self._dialog.show_values()
        self._dialog.bring_up()
        return self._dialog

    def _remember_keys(self) -> None:
        self._context.preferences.shortcuts = self._keymap.overrides


def _entries(menu: QMenu, path: str) -> Iterator[tuple[QAction, str]]:
    """Yield the actions of a menu and of those within it, with the path that leads there."""
    # Some menus are filled when they are about to be shown.
    menu.aboutToShow.emit()
    menu.aboutToHide.emit()
    for each in menu.actions():
        inner = _menu_of(each)
        if inner is not None:
            yield from _entries(inner, f"{path} › {plain(inner.title())}")
        elif _is_named(each) and each.isVisible():
            yield each, path


def _menu_of(action: QAction) -> QMenu | None:
    menu = action.menu()
    return menu if isinstance(menu, QMenu) else None


def _is_named(action: QAction) -> bool:
    return bool(action.text()) and not action.isSeparator()
