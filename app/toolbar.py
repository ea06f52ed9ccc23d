"""The toolbar: the actions used most, the families as one toggle, and the rule for the parameters."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent, QShowEvent
from PySide6.QtWidgets import QToolBar, QToolButton, QWidget

from app.actions import Actions
from app.overrides import Guarded
from app.panels.parametrization_bar import ParametrizationBar

_SEPARATOR, _PARAMETERS = "", "PARAMETERS"
_ORDER = (
    "newDocument", "openDocument", "saveDocument", _SEPARATOR,
    "undo", "redo", _SEPARATOR,
    "selectTool", "addTool", "measureTool", _SEPARATOR,
    "familyLagrange", "familyHermite", "familyQuinticHermite", _SEPARATOR,
    _PARAMETERS, _SEPARATOR,
    "fitView", "toggleGrid", "toggleSnap", "toggleScrub", "playMotion",
)  # fmt: skip
_FAMILIES = {
    "familyLagrange": "Lagrange",
    "familyHermite": "Hermite",
    "familyQuinticHermite": "Quintic Hermite",
}
_SHORT = {**_FAMILIES, "familyQuinticHermite": "Quintic"}


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
        else:
            self.addAction(self._actions[name])
            if name in _FAMILIES:
                self._button(name).setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)

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
        style = Qt.ToolButtonStyle
        for name, text in (_SHORT if compact else _FAMILIES).items():
            self._actions[name].setIconText(text)
            self._button(name).setToolButtonStyle(
                style.ToolButtonTextOnly if compact else style.ToolButtonTextBesideIcon
            )
