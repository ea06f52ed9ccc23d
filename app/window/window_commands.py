"""Actions on the program itself: command palette, preferences, keys, keyboard focus from panel to panel."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QDockWidget, QMenu, QWidget

from .. import window
from ..actions.declaration import action
from ..actions.keymap import plain
from ..actions.menus import EDIT_PROGRAM, HELP_ALL, VIEW_FOCUS
from ..widgets.fields import FieldEdit
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
        """Find any command by a few letters of its name."""
        if self._palette is None:
            self._palette = window.command_palette.CommandPalette(
                self._context.central.canvas, self._commands
            )
        if self._palette.isVisible():
            self._palette.close_and_return()
        else:
            self._palette.open()

    def _commands(self) -> list[window.command_palette.Command]:
        """Return all commands: those of the menus, then those of other widgets."""
        host, paths = self._context.window, dict[QAction, str]()
        for entry in host.menuBar().actions():
            menu = _menu_of(entry)
            if menu is not None:
                paths.update(_entries(menu, plain(menu.title())))
        for entry in host.findChildren(QAction):
            if entry.objectName() and entry.isVisible() and _menu_of(entry) is None and _is_named(entry):
                paths.setdefault(entry, "")
        palette = self._context.actions["commandPalette"]
        docks = {dock.toggleViewAction() for dock in self._context.docks.all if not dock.isHidden()}
        return [
            window.command_palette.Command(
                action, path, action in docks or self._context.actions.is_on(action.objectName())
            )
            for action, path in paths.items()
            if action is not palette
        ]

    # Preferences

    @action("editShortcuts", "Keyboard Shortcuts…", HELP_ALL, icon="keyboard")
    def _edit_shortcuts(self) -> None:
        """Change the keys of actions."""
        self._open_dialog().show_shortcuts()

    @action("preferences", "Preferences…", EDIT_PROGRAM, "Ctrl+,", "settings")
    def _show_preferences(self) -> None:
        """Set theme, unit, grid, snapping and keys."""
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
    for entry in menu.actions():
        inner = _menu_of(entry)
        if inner is not None:
            yield from _entries(inner, f"{path} › {plain(inner.title())}")
        elif _is_named(entry) and entry.isVisible():
            yield entry, path


def _menu_of(action: QAction) -> QMenu | None:
    menu = action.menu()
    return menu if isinstance(menu, QMenu) else None


def _is_named(action: QAction) -> bool:
    return bool(action.text()) and not action.isSeparator()


class FocusCommands:
    """Moves the focus between canvas, functions, plots, panels and toolbar."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._named = ""

    def back_to_canvas(self) -> bool:
        """Leave the panel that has the focus for the canvas; return whether one had it."""
        context, here = self._context, QApplication.focusWidget()
        panels = (*context.docks.all, context.toolbar)
        if here is None or not any(panel.isAncestorOf(here) for panel in panels):
            return False
        context.central.canvas.setFocus(Qt.FocusReason.ShortcutFocusReason)
        context.status_line.unsay(self._named)
        return True

    def leave_field(self) -> bool:
        """Leave a field of a panel whose text was entered; return whether one had the focus.

        A field with refused input keeps the focus, and so does one that acts with every Enter.
        """
        field = QApplication.focusWidget()
        is_done = isinstance(field, FieldEdit) and not (field.isModified() or field.is_pressed_again)
        return is_done and self.back_to_canvas()

    @action("nextPanel", "Next Panel", VIEW_FOCUS, "F6")
    def _go_on(self) -> None:
        """Move the keyboard focus to the next panel."""
        self._walk(1)

    @action("previousPanel", "Previous Panel", VIEW_FOCUS, "Shift+F6")
    def _go_back(self) -> None:
        """Move the keyboard focus to the previous panel."""
        self._walk(-1)

    def _walk(self, step: int) -> None:
        stops = list(self._stops())
        here = QApplication.focusWidget()
        indices = [index for index, (panel, _) in enumerate(stops) if _holds(panel, here)]
        start = indices[0] if indices else -1 if step > 0 else 0
        panel, target = stops[(start + step) % len(stops)]
        target.setFocus(Qt.FocusReason.TabFocusReason if step > 0 else Qt.FocusReason.BacktabFocusReason)
        self._named = f"{_title_of(panel)}."
        self._context.session.say(self._named)

    def _stops(self) -> Iterator[tuple[QWidget, QWidget]]:
        """Yield the visible panels with the widget of each that gets the focus."""
        context = self._context
        docks = sorted(context.docks.all, key=lambda dock: (dock.x(), dock.y()))
        panels: list[QWidget] = [*context.central.stops, *docks, context.toolbar]
        for panel in panels:
            target = first_in(panel) if _is_in_sight(panel) else None
            if target is not None:
                yield panel, target

    @action("openMenuBar", "Menu Bar", VIEW_FOCUS, "F10")
    def _open_menu_bar(self) -> None:
        """Open the first menu; arrow keys open the others."""
        bar = self._context.window.menuBar()
        if bar.isVisible():
            bar.setActiveAction(bar.actions()[0])


def _holds(panel: QWidget, widget: QWidget | None) -> bool:
    return widget is not None and (panel is widget or panel.isAncestorOf(widget))


def _is_in_sight(panel: QWidget) -> bool:
    """Whether a panel is shown, and not behind another tab."""
    if isinstance(panel, QDockWidget) and panel.visibleRegion().isEmpty():
        return False
    return panel.isVisible()


def first_in(panel: QWidget) -> QWidget | None:
    """Return the widget of a panel that had the focus last, or else its first tab stop."""
    if isinstance(panel, QDockWidget) and panel.widget() is not None:
        # Not the buttons of the title bar.
        return first_in(panel.widget())
    before = panel.focusWidget()
    if before is not None and _takes_focus(before):
        return before
    if _takes_focus(panel):
        return panel
    # Not by `nextInFocusChain`: PySide6 treats its result as a part of the widget that was asked, and
    # as deleted as soon as that one is.
    return next(filter(_takes_focus, panel.findChildren(QWidget)), None)


def _takes_focus(widget: QWidget) -> bool:
    by_tab = bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus)
    return by_tab and widget.isEnabled() and widget.isVisible()


def _title_of(panel: QWidget) -> str:
    if isinstance(panel, QDockWidget):
        return panel.windowTitle()
    return panel.accessibleName() or panel.windowTitle()
