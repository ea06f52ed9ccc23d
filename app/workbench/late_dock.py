"""A dock whose content is built when it is first shown."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget

from app.widgets.fitting import Scrolled

IN_DOCK = QSize(350, 96)
"""Largest minimum size of the content of a dock: two of them, one on the other, fit a small screen."""


class LateDock(QDockWidget):
    """A dock that costs nothing until somebody looks at it."""

    def __init__(self, title: str, build: Callable[[], QWidget], window: QMainWindow) -> None:
        super().__init__(title, window)
        self._build = build
        self._scale = 1.0
        self.visibilityChanged.connect(self._show_content)

    def _show_content(self, visible: bool) -> None:
        # Hidden behind another tab, a dock is not visible in this sense.
        if visible:
            self.fill()

    def fill(self) -> None:
        """Build the content, if there is none; for who needs it before the dock is on the screen."""
        if self.widget() is None:
            self.setWidget(Scrolled(lambda _parent: self._build(), IN_DOCK, self))
            self._apply_scale()

    def set_scale(self, scale: float) -> None:
        """Enlarge the type of the content, for a projector."""
        self._scale = scale
        self._apply_scale()

    def _apply_scale(self) -> None:
        if self.widget() is not None:
            size = QApplication.font().pointSizeF() * self._scale
            # Beside the application's style sheet a font that is set does not reach what is inside.
            self.widget().setStyleSheet(f"* {{ font-size: {size}pt; }}" if self._scale != 1.0 else "")
