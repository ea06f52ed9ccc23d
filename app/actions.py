"""The QActions of a window, made from the registry."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QWidget

from app.action_specs import SPECS, ActionSpec
from app.icons import icon
from app.keymap import Binding, Keymap, call_alone, keys_text, name_alone, say_needs, tool_tip
from app.theme import Theme


class Actions:
    """The QActions of one window, by name."""

    def __init__(self, window: QWidget) -> None:
        self._actions: dict[str, QAction] = {}
        self._groups: dict[str, QActionGroup] = {}
        self.keymap = Keymap(window)
        for spec in SPECS:
            action = self._actions[spec.name] = self._make(spec, window)
            keys = _sequences(spec.shortcut)
            self.keymap.add(Binding(action, name_alone(action).removesuffix("…"), spec.menu, keys))

    def _make(self, spec: ActionSpec, window: QWidget) -> QAction:
        action = QAction(spec.text, window)
        action.setObjectName(spec.name)
        if spec.alone:
            call_alone(action, spec.alone)
        if spec.needs:
            say_needs(action, spec.needs)
            action.enabledChanged.connect(lambda _on: action.setToolTip(tool_tip(action)))
        action.setStatusTip(spec.tip or spec.text)
        action.setCheckable(spec.checkable or bool(spec.group))
        if spec.group:
            if spec.group not in self._groups:
                self._groups[spec.group] = QActionGroup(window)
            self._groups[spec.group].addAction(action)
        return action

    def attach(self, window: QWidget) -> None:
        """Let the window hear the keys: of actions in menus alone they are dead while the menu bar is hidden.

        Late: from then on every change of an action is an event for the window.
        """
        window.addActions(list(self._actions.values()))

    def __getitem__(self, name: str) -> QAction:
        return self._actions[name]

    def __contains__(self, name: str) -> bool:
        return name in self._actions

    def of_menu(self, menu: str) -> Iterator[tuple[ActionSpec, QAction]]:
        """Yield the actions that stand in `menu`."""
        for spec in SPECS:
            if spec.menu == menu:
                yield spec, self._actions[spec.name]

    def shortcuts(self, menu: str) -> list[tuple[str, str]]:
        """Return (keys, what they do) of the actions of `menu` that can be used now."""
        rows = []
        for spec, action in self.of_menu(menu):
            keys = keys_text(action.shortcuts())
            if keys and action.isEnabled():
                rows.append((keys, spec.tip or spec.text))
        return rows

    def set_theme(self, theme: Theme) -> None:
        """Tint the icons for `theme`."""
        for spec in SPECS:
            if spec.icon:
                self._actions[spec.name].setIcon(icon(spec.icon, theme))


@cache
def _sequences(shortcut: str) -> tuple[QKeySequence, ...]:
    return tuple(QKeySequence(part) for part in shortcut.split(", ")) if shortcut else ()
