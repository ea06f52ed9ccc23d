"""Where the window was, how large, and how its parts were laid out, as far as that still makes sense."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QMainWindow, QSplitter

from app.preferences import Preferences

_SIZE = QSize(1280, 860)
_LEAST = QSize(200, 150)
"""Smaller than any window that a person would have left."""


def restore_layout(window: QMainWindow, splitter: QSplitter, preferences: Preferences) -> None:
    """Lay the window out as the preferences remember it; what is not usable is refused, and said so."""
    window.resize(_SIZE)
    geometry, state = preferences.window_geometry, preferences.window_state
    if not geometry.isEmpty() and not (window.restoreGeometry(geometry) and _is_usable(window.size())):
        window.resize(_SIZE)
        preferences.refuse("window/geometry", "it is no place on a screen")
    if not state.isEmpty() and not window.restoreState(state):
        preferences.refuse("window/state", "it is no layout")
    parts = preferences.splitter_state
    if not parts.isEmpty() and not splitter.restoreState(parts):
        preferences.refuse("window/splitter", "it is no layout")


def _is_usable(size: QSize) -> bool:
    return size.width() >= _LEAST.width() and size.height() >= _LEAST.height()
