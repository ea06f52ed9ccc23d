"""Docks, whose content is built when it is asked for or first shown."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize, QTimer, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget

from ..qt.overrides import SafeOverrides
from ..widgets.fitting import Scrolled
from .dock_title import DockTitle

_IN_DOCK = QSize(350, 96)
"""Largest minimum size of the content of a dock: two of them, one on the other, fit a small screen."""


class Dock(SafeOverrides, QDockWidget):
    """A dock that is empty until it is filled; `build` makes its content in the parent that it gets.

    Attributes
    ----------
    is_steady
        Whether what stands in it stays there when its scroll bar comes and goes.

    Signals
    -------
    closed
        The person has put it away.
    """

    closed = Signal()

    def __init__(self, title: str, build: Callable[[QWidget], QWidget], window: QMainWindow) -> None:
        super().__init__(title, window)
        self._build: Callable[[QWidget], QWidget] | None = build
        self._window = window
        self.is_steady = False
        # What it covered when it was brought up; that comes back when it goes.
        self._covered: list[QDockWidget] = []
        self.topLevelChanged.connect(self._follow_place)
        # Qt's own slot hides a dock that nobody sees behind another tab.
        self.toggleViewAction().triggered.disconnect()
        self.toggleViewAction().triggered.connect(self._toggle)

    def fill(self) -> None:
        """Build the title and the content, if there is none."""
        # One that floats is shown again, and would be filled again, as soon as it has a title.
        build, self._build = self._build, None
        if build is not None:
            self.setTitleBarWidget(DockTitle(self))
            self.setWidget(Scrolled(build, _IN_DOCK, self, is_steady=self.is_steady))

    def bring_up(self) -> None:
        """Show it, in front of the other tabs."""
        if self.visibleRegion().isEmpty():
            docks = self._window.findChildren(QDockWidget)
            self._covered = [each for each in docks if not each.visibleRegion().isEmpty()]
        self.show()
        self.raise_()

    def _toggle(self, shown: bool) -> None:
        """Bring it to the front of the tabs, or put it away where it is there already."""
        is_behind = not self.isHidden() and self._window.isVisible() and self.visibleRegion().isEmpty()
        if shown or is_behind:
            self.toggleViewAction().setChecked(True)
            self.bring_up()
        else:
            self.close()

    def _follow_place(self, floats: bool) -> None:
        """Come to the front of the tabs that it has been put among."""
        if not floats and not self.isHidden():
            # Only when it has its place is there a tab.
            QTimer.singleShot(0, self, self.raise_)

    def closeEvent(self, event: QCloseEvent) -> None:
        beside = [] if self.visibleRegion().isEmpty() else self._window.tabifiedDockWidgets(self)
        super().closeEvent(event)
        for each in beside:
            if each in self._covered and not each.isHidden():
                each.raise_()
        self._covered = []
        self.closed.emit()


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
