"""The toolbar: the actions used most, and in its middle the families."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QAction, QActionEvent, QKeyEvent, QMouseEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QMenu, QToolBar, QToolButton, QWidget, QWidgetAction

from ..actions.menus import TOOLBAR, BarPosition
from ..actions.qactions import Actions
from ..qt.overrides import ENTER, SafeOverrides
from ..widgets.controls import ToolbarWidget, named
from .menus import put_in


class ChoicesMenu(SafeOverrides, QMenu):
    """Menu of switches that stays open after a click or Space on a switch."""

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if not self._switch(self.actionAt(event.position().toPoint())):
            super().mouseReleaseEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        activates = event.key() == Qt.Key.Key_Space or event.key() in ENTER
        if not (activates and self._switch(self.activeAction())):
            super().keyPressEvent(event)

    @staticmethod
    def _switch(action: QAction | None) -> bool:
        """Trigger a switch; return whether the action is one."""
        if action is None or not action.isCheckable():
            return False
        action.trigger()
        return True


_Style = Qt.ToolButtonStyle


class _Step(NamedTuple):
    """Style of the toolbar buttons with text, at one width of the window."""

    short: bool
    others: _Style
    in_use: _Style


_STEPS = (
    _Step(short=False, others=_Style.ToolButtonTextBesideIcon, in_use=_Style.ToolButtonTextBesideIcon),
    _Step(short=True, others=_Style.ToolButtonTextBesideIcon, in_use=_Style.ToolButtonTextBesideIcon),
    _Step(short=True, others=_Style.ToolButtonTextOnly, in_use=_Style.ToolButtonTextOnly),
    _Step(short=True, others=_Style.ToolButtonIconOnly, in_use=_Style.ToolButtonTextBesideIcon),
    _Step(short=True, others=_Style.ToolButtonIconOnly, in_use=_Style.ToolButtonIconOnly),
)
"""Styles from the widest to the narrowest."""


_ICON_SIZE = QSize(20, 20)


class Toolbar(SafeOverrides, QToolBar):
    """Toolbar that shortens its texts in a narrow window, to keep as many buttons visible as possible."""

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__("Toolbar", parent)
        self.setObjectName("mainToolbar")
        self.setMovable(False)
        self.setIconSize(_ICON_SIZE)
        self._actions = actions
        self._in_words: list[QAction] = []
        self._widgets: list[ToolbarWidget] = []
        self._has_style = False
        # By style and the names of the switches that are on.
        self._widths: dict[tuple[_Step, tuple[str, ...]], int] = {}
        self._rendered: tuple[_Step, tuple[str, ...]] | None = None
        actions.redeclared.connect(self._follow_actions)
        actions.switched.connect(self._fit)

    def fill(self, widgets: Mapping[BarPosition, ToolbarWidget]) -> None:
        """Add the actions of the bar, and `widgets` at their positions."""
        self._widgets = list(widgets.values())
        for _, group in sorted(self._groups(widgets).items()):
            self.addActions([_separator(self), *group] if self.actions() else group)
            self._follow(group)
        self._add_choices()
        self._show_step(_STEPS[0])

    def _add_choices(self) -> None:
        """Add a menu to each button whose action has choices."""
        for action in self.actions():
            button, bar = self.widgetForAction(action), self._actions.choices_of(action)
            if bar is not None and isinstance(button, QToolButton):
                menu = named(ChoicesMenu(button), f"{action.objectName()}Menu", bar.name)
                menu.setToolTipsVisible(True)
                for ten in self._actions.in_bar(bar).values():
                    menu.addActions(ten)
                button.setMenu(menu)
                button.setPopupMode(QToolButton.ToolButtonPopupMode.MenuButtonPopup)

    def _groups(self, widgets: Mapping[BarPosition, ToolbarWidget]) -> dict[int, list[QAction]]:
        """Return the entries of the bar grouped by the tens of their positions, widgets last."""
        groups = self._actions.in_bar(TOOLBAR)
        for position, widget in widgets.items():
            holder = QWidgetAction(self)
            holder.setDefaultWidget(widget)
            groups.setdefault(position.number // 10, []).append(holder)
        return groups

    def _follow(self, actions: Iterable[QAction]) -> None:
        self._in_words += [
            action
            for action in actions
            if action.objectName() and self._actions.button_text(action, short=True)
        ]

    def _follow_actions(self) -> None:
        """Insert the buttons of new actions, and forget removed ones."""
        self._in_words = [action for action in self._in_words if action.objectName()]
        known = set(self.actions())
        for entries in self._actions.in_bar(TOOLBAR).values():
            put_in(self, entries)
            self._follow(action for action in entries if action not in known)
        self._widths.clear()
        self._rendered = None
        self._hold_sizes()
        self._fit()

    def _hold_sizes(self) -> None:
        """Fix the sizes of buttons without text, because Qt lays out anew whenever their actions change."""
        for action in self.actions():
            button = self.widgetForAction(action)
            if isinstance(button, QToolButton) and action not in self._in_words:
                button.setFixedSize(button.sizeHint())

    def actionEvent(self, event: QActionEvent) -> None:
        # Qt lays out the window after each change, which takes longer than painting the drawing.
        # A button requests a layout itself where its text changes.
        action = event.action()
        button = self.widgetForAction(action)
        if event.type() != QEvent.Type.ActionChanged or button.isHidden() == action.isVisible():
            super().actionEvent(event)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        # Not before: without the style sheet all widths are too large.
        self._has_style = True
        self._hold_sizes()
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Use the first style that fits, or else the narrowest."""
        if self._has_style:
            self._show_step(next((step for step in _STEPS[:-1] if self._has_room(step)), _STEPS[-1]))

    def _has_room(self, step: _Step) -> bool:
        if (key := (step, self._in_use)) not in self._widths:
            self._show_step(step)
            if (layout := self.layout()) is not None:
                # New buttons invalidate it only later.
                layout.invalidate()
            self._widths[key] = self.sizeHint().width()
        return self._widths[key] <= self.width()

    @property
    def _in_use(self) -> tuple[str, ...]:
        return tuple(filter(self._actions.is_on, (action.objectName() for action in self._in_words)))

    def _show_step(self, step: _Step) -> None:
        in_use = self._in_use
        if self._rendered == (step, in_use):
            return
        before, self._rendered = self._rendered, (step, in_use)
        if before is None or before[0] != step:
            for widget in self._widgets:
                widget.set_compact(
                    step.short and (not widget.yields_late or step.others != _Style.ToolButtonTextBesideIcon)
                )
        for action in self._in_words:
            button = self.widgetForAction(action)
            if isinstance(button, QToolButton):
                action.setIconText(self._actions.button_text(action, short=step.short))
                button.setToolButtonStyle(step.in_use if action.objectName() in in_use else step.others)


def _separator(parent: QToolBar) -> QAction:
    separator = QAction(parent)
    separator.setSeparator(True)
    return separator
