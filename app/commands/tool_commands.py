"""Command palette, preferences and shortcuts: what works on the program itself."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from app.commands.parts import Handlers, Parts
from app.mnemonics import plain
from app.theme import ThemeMode
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from app.panels.command_palette import Command, CommandPalette
    from app.panels.preferences_dialog import PreferencesDialog


class ToolCommands:
    """Finds every action of the window; preferences and keys."""

    def __init__(self, parts: Parts, apply_preferences: Callable[[], None]) -> None:
        self._parts = parts
        self._apply_preferences = apply_preferences
        self._keymap = parts.actions.keymap
        self._palette: CommandPalette | None = None
        self._dialog: PreferencesDialog | None = None
        self._keymap.load(parts.preferences.shortcuts)
        self._keymap.changed.connect(self._remember_keys)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "commandPalette": self._toggle_palette,
            "editShortcuts": self._edit_shortcuts,
            "preferences": self._show_preferences,
        }

    def render(self, view: CurveView) -> None:
        """Do nothing: these can always be used."""

    # Palette

    def _toggle_palette(self) -> None:
        if self._palette is None:
            # Nobody waits for it at the start.
            from app.panels.command_palette import CommandPalette  # noqa: PLC0415

            self._palette = CommandPalette(self._parts.canvas, self._commands)
        if self._palette.isVisible():
            self._palette.close_and_return()
        else:
            self._palette.open()

    def _commands(self) -> list[Command]:
        """Return everything with a name: what the menus hold, then what only other places offer."""
        from app.panels.command_palette import Command  # noqa: PLC0415 - as the palette itself

        window, found = self._parts.window, dict[QAction, str]()
        for entry in window.menuBar().actions():
            menu = _menu_of(entry)
            if menu is not None:
                found.update(_entries(menu, plain(menu.title())))
        for action in window.findChildren(QAction):
            if action.objectName() and action.isVisible() and _menu_of(action) is None and _is_named(action):
                found.setdefault(action, "")
        own = self._parts.actions["commandPalette"]
        return [Command(action, path) for action, path in found.items() if action is not own]

    # Preferences

    def _show_preferences(self) -> None:
        self._open_dialog().tabs.setCurrentIndex(0)

    def _edit_shortcuts(self) -> None:
        self._open_dialog().show_shortcuts()

    def _open_dialog(self) -> PreferencesDialog:
        if self._dialog is None:
            # Nobody waits for it at the start.
            from app.panels.preferences_dialog import PreferencesDialog  # noqa: PLC0415

            parts = self._parts
            self._dialog = PreferencesDialog(parts.preferences, self._keymap, parts.window)
            self._dialog.theme_chosen.connect(self._use_theme)
            self._dialog.changed.connect(self._apply_preferences)
        self._dialog.show_values()
        self._dialog.show()
        self._dialog.raise_()
        self._dialog.activateWindow()
        return self._dialog

    def _use_theme(self, mode: ThemeMode) -> None:
        self._parts.set_theme_mode(mode)

    def _remember_keys(self) -> None:
        self._parts.preferences.shortcuts = self._keymap.overrides


def _entries(menu: QMenu, path: str) -> Iterator[tuple[QAction, str]]:
    """Yield the actions of a menu and of those within it, with the path that leads there."""
    # Some menus are filled when they are about to be shown.
    menu.aboutToShow.emit()
    menu.aboutToHide.emit()
    for action in menu.actions():
        inner = _menu_of(action)
        if inner is not None:
            yield from _entries(inner, f"{path} › {plain(inner.title())}")
        elif _is_named(action) and action.isVisible():
            yield action, path


def _menu_of(action: QAction) -> QMenu | None:
    menu = action.menu()
    return menu if isinstance(menu, QMenu) else None


def _is_named(action: QAction) -> bool:
    return bool(action.text()) and not action.isSeparator()
