"""The toolbar: the actions used most, the families as one toggle, and the rule for the parameters."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QToolBar, QToolButton, QWidget

from app.actions.qactions import Actions
from app.actions.strips import TOOLBAR, Place
from app.qt.overrides import Guarded
from app.widgets.toolbar_widget import ToolbarWidget

_BESIDE = Qt.ToolButtonStyle.ToolButtonTextBesideIcon


class Toolbar(Guarded, QToolBar):
    """Shortens its words in a narrow window, so that nothing is cut off at 1024 pixels."""

    def __init__(self, actions: Actions, parent: QWidget) -> None:
        super().__init__("Toolbar", parent)
        self.setObjectName("mainToolbar")
        self.setMovable(False)
        self.setIconSize(QSize(20, 20))
        self._actions = actions
        self._in_words: list[QToolButton] = []
        self._widgets: list[ToolbarWidget] = []
        self._full_width: int | None = None

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
                if self._actions.words_of(action, short=True):
                    self._in_words.append(self._button(action))
            if ten in at:
                self.addWidget(at[ten])
        self._fit_words()

    def _button(self, action: QAction) -> QToolButton:
        button = self.widgetForAction(action)
        assert isinstance(button, QToolButton)
        return button

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._full_width is None:
            # Not before: until the style has come, everything is thought to be wider.
            self._full_width = self.sizeHint().width()
            self._fit_words()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit_words()

    def _fit_words(self) -> None:
        compact = self._full_width is not None and self.width() < self._full_width
        for widget in self._widgets:
            widget.set_compact(compact)
        for button in self._in_words:
            action = button.defaultAction()
            action.setIconText(self._actions.words_of(action, short=compact))
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly if compact else _BESIDE)
