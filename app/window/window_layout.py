"""Place, size and layout of a window, restored as far as they still make sense."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QSize, QTimer
from PySide6.QtGui import QScreen
from PySide6.QtWidgets import QDockWidget, QMainWindow, QSplitter

from ..qt.overrides import SafeOverrides
from ..settings.preferences import Preferences
from ..widgets.fitting import room_on
from ..workbench.docks import hide_idle_docks

_SIZE = QSize(1280, 860)
_LEAST = QSize(200, 150)
"""Smaller than any window that a person would have left."""


def restore_layout(window: QMainWindow, splitter: QSplitter, preferences: Preferences) -> None:
    """Lay the window out as the preferences remember it; what is no layout is refused, and said so.

    A place that is on no screen (any more) is not worth a word: the window opens at its usual size.
    """
    usual = first_size(window.screen())
    layout = window.layout()
    if layout is not None:
        # Else what the parts needed while they were put together is the least size of the whole.
        layout.activate()
    window.resize(usual)
    geometry, state = preferences.window_geometry, preferences.window_state
    if not geometry.isEmpty() and not (window.restoreGeometry(geometry) and _is_usable(window.size())):
        window.resize(usual)
    if not state.isEmpty() and not window.restoreState(state):
        preferences.refuse("window/state", "it is no layout")
    parts = preferences.splitter_state
    if not parts.isEmpty() and not splitter.restoreState(parts):
        preferences.refuse("window/splitter", "it is no layout")
    hide_idle_docks(window)
    if floating_docks(window):
        when_first_shown(window, lambda: _lift(window))


def first_size(screen: QScreen) -> QSize:
    """Return how large the first window is: with its frame it fits the screen."""
    return _SIZE.boundedTo(room_on(screen)).expandedTo(_LEAST)


def floating_docks(window: QMainWindow) -> list[QDockWidget]:
    """Return the docks that are windows of their own and not put away."""
    return [dock for dock in window.findChildren(QDockWidget) if dock.isFloating() and not dock.isHidden()]


def hide_floating(window: QMainWindow) -> None:
    """Let undocked docks go with their window; Qt leaves them on the screen while another one is open."""
    for dock in floating_docks(window):
        dock.hide()


def when_first_shown(window: QMainWindow, act: Callable[[], None]) -> None:
    """Do something when the window stands on the screen for the first time and has its size."""
    _FirstShow(window, act)


class _FirstShow(SafeOverrides, QObject):
    """Waits for a window to be shown."""

    def __init__(self, window: QMainWindow, act: Callable[[], None]) -> None:
        super().__init__(window)
        self._window, self._act = window, act
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._finish)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._window and event.type() == QEvent.Type.Show:
            self._window.removeEventFilter(self)
            self._soon.start()
        return False

    def _finish(self) -> None:
        self._act()
        self.deleteLater()


def _lift(window: QMainWindow) -> None:
    """Lift undocked docks over the window.

    Restored before the window is there, they come to lie behind it, where nobody finds them. Raising is not
    enough: only a dock that is shown after the window belongs to it.
    """
    for dock in floating_docks(window):
        dock.hide()
        dock.show()
        dock.raise_()


def _is_usable(size: QSize) -> bool:
    return size.width() >= _LEAST.width() and size.height() >= _LEAST.height()
