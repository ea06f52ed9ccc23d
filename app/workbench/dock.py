"""Docks, whose content is built when it is asked for or first shown."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget

from ..widgets.fitting import Scrolled

_IN_DOCK = QSize(350, 96)
"""Largest minimum size of the content of a dock: two of them, one on the other, fit a small screen."""


class Dock(QDockWidget):
    """A dock that is empty until it is filled; `build` makes its content in the parent that it gets."""

    def __init__(self, title: str, build: Callable[[QWidget], QWidget], window: QMainWindow) -> None:
        super().__init__(title, window)
        self._build = build

    def fill(self) -> None:
        """Build the content, if there is none."""
        if self.widget() is None:
            self.setWidget(Scrolled(self._build, _IN_DOCK, self))

    def bring_up(self) -> None:
        """Show it, in front of the other tabs."""
        self.show()
        self.raise_()


class LateDock(Dock):
    """A dock that costs nothing until somebody looks at it."""

    def __init__(self, title: str, build: Callable[[QWidget], QWidget], window: QMainWindow) -> None:
        super().__init__(title, build, window)
        self._scale = 1.0
        self.visibilityChanged.connect(self._show_content)

    def _show_content(self, visible: bool) -> None:
        # Hidden behind another tab, a dock is not visible in this sense.
        if visible:
            self.fill()

    def fill(self) -> None:
        """Build the content, if there is none, as large as it shall be."""
        super().fill()
        self.set_scale(self._scale)

    def set_scale(self, scale: float) -> None:
        """Enlarge the type of the content, for a projector."""
        self._scale = scale
        if self.widget() is not None:
            size = QApplication.font().pointSizeF() * scale
            # Beside the application's style sheet a font that is set does not reach what is inside.
            sheet = f"* {{ font-size: {size}pt; }}" if scale != 1.0 else ""
            if sheet != self.widget().styleSheet():
                self.widget().setStyleSheet(sheet)
