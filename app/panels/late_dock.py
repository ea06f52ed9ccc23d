"""A dock whose content is built when it is first shown."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget


class LateDock(QDockWidget):
    """A dock that costs nothing until somebody looks at it."""

    def __init__(self, title: str, build: Callable[[], QWidget], window: QMainWindow) -> None:
        super().__init__(title, window)
        self._build = build
        self.visibilityChanged.connect(self._show_content)

    def _show_content(self, visible: bool) -> None:
        # Hidden behind another tab, a dock is not visible in this sense.
        if visible and self.widget() is None:
            self.setWidget(self._build())
