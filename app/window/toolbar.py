"""The toolbar: the actions used most, the families as one toggle, and the rule for the parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QToolBar, QToolButton, QWidget

from ..actions.qactions import Actions
from ..actions.strips import TOOLBAR, Place
from ..qt.overrides import Guarded
from ..widgets.toolbar_widget import ToolbarWidget
from .menus import put_in

_Style = Qt.ToolButtonStyle


class _Step(NamedTuple):
    """Words on the buttons of families."""

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
"""From the widest to the narrowest."""


class Toolbar(Guarded, QToolBar):
    """Says less in a narrow window, so that as much as can be is not behind its arrow."""

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__("Toolbar", parent)
        self.setObjectName("mainToolbar")
        self.setMovable(False)
        self.setIconSize(QSize(20, 20))
        self._actions = actions
        self._in_words: list[QToolButton] = []
        self._widgets: list[ToolbarWidget] = []
        self._has_style = False
        self._widths: list[int] = []
        actions.redeclared.connect(self._follow_actions)
        actions.switched.connect(self._fit)

    def fill(self, widgets: Mapping[Place, ToolbarWidget]) -> None:
        """Add the actions of the strip, and `widgets` at their places."""
        entries = self._actions.in_strip(TOOLBAR)
        at = {place.number // 10: widget for place, widget in widgets.items()}
        self._widgets = list(at.values())
        for ten in sorted({*entries, *at}):
            if self.actions():
                self.addSeparator()
            for action in entries.get(ten, ()):
                self.addAction(action)
                self._follow(action)
            if ten in at:
                self.addWidget(at[ten])
        self._show_step(_STEPS[0])

    def _follow(self, action: QAction) -> None:
        if self._actions.words_of(action, short=True):
            self._in_words.append(self._button(action))

    def _follow_actions(self) -> None:
        """Put in what has come, and leave out what is gone."""
        self._in_words = [button for button in self._in_words if button.defaultAction().objectName()]
        for entries in self._actions.in_strip(TOOLBAR).values():
            new = [action for action in entries if action not in self.actions()]
            put_in(self, entries)
            for action in new:
                self._follow(action)
        self._widths.clear()
        self._fit()

    def _button(self, action: QAction) -> QToolButton:
        button = self.widgetForAction(action)
        assert isinstance(button, QToolButton)
        return button

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        # Not before: until the style has come, everything is thought to be wider.
        self._has_style = True
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Take the first step that has room, or the narrowest."""
        if self._has_style:
            self._show_step(next((step for step in _STEPS[:-1] if self._has_room(step)), _STEPS[-1]))

    def _has_room(self, step: _Step) -> bool:
        at = _STEPS.index(step)
        if at == len(self._widths):
            self._show_step(step)
            self._widths.append(self.sizeHint().width())
        return self._widths[at] <= self.width()

    def _show_step(self, step: _Step) -> None:
        for widget in self._widgets:
            widget.set_compact(
                step.short and (not widget.yields_late or step.others != _Style.ToolButtonTextBesideIcon)
            )
        for button in self._in_words:
            action = button.defaultAction()
            action.setIconText(self._actions.words_of(action, short=step.short))
            is_in_use = self._actions.is_on(action.objectName())
            button.setToolButtonStyle(step.in_use if is_in_use else step.others)
