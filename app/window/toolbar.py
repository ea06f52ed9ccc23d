"""The toolbar: the actions used most, the families as one toggle, and the rule for the parameters."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent, QShowEvent
from PySide6.QtWidgets import QToolBar, QToolButton, QWidget

from app.actions.qactions import Actions
from app.families import FAMILIES
from app.panels.parametrization_bar import ParametrizationBar
from app.qt.overrides import Guarded

_SEPARATOR, _FAMILIES, _PARAMETERS = "", "FAMILIES", "PARAMETERS"
_ORDER = (
    "newDocument", "openDocument", "saveDocument", _SEPARATOR,
    "undo", "redo", _SEPARATOR,
    "selectTool", "addTool", "measureTool", _SEPARATOR,
    _FAMILIES, _SEPARATOR,
    _PARAMETERS, _SEPARATOR,
    "fitView", "toggleGrid", "toggleSnap", "toggleScrub", "playMotion",
)  # fmt: skip
_BESIDE = Qt.ToolButtonStyle.ToolButtonTextBesideIcon


class Toolbar(Guarded, QToolBar):
    """Shortens its words in a narrow window, so that nothing is cut off at 1024 pixels."""

    def __init__(self, actions: Actions, parameters: ParametrizationBar, parent: QWidget) -> None:
        super().__init__("Toolbar", parent)
        self.setObjectName("mainToolbar")
        self.setMovable(False)
        self.setIconSize(QSize(20, 20))
        self._actions, self._parameters = actions, parameters
        for name in _ORDER:
            self._add(name)
        self._full_width: int | None = None

    def _add(self, name: str) -> None:
        if name == _SEPARATOR:
            self.addSeparator()
        elif name == _PARAMETERS:
            self.addWidget(self._parameters)
        elif name == _FAMILIES:
            for family in FAMILIES:
                self.addAction(self._actions[family.action_name])
                self._button(family.action_name).setToolButtonStyle(_BESIDE)
        else:
            self.addAction(self._actions[name])

    def _button(self, name: str) -> QToolButton:
        button = self.widgetForAction(self._actions[name])
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
        self._parameters.set_compact(compact)
        for family in FAMILIES:
            self._actions[family.action_name].setIconText(family.short if compact else family.label)
            self._button(family.action_name).setToolButtonStyle(
                Qt.ToolButtonStyle.ToolButtonTextOnly if compact else _BESIDE
            )
