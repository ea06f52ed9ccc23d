"""Room for a dock that needs more than its share of the side."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow

from ..widgets.fitting import Scrolled

_LEAST_ABOVE = 150
_LEAST_BESIDE = 480
"""Pixels that are left of the drawing; beside less of it a dock is scrolled."""


def make_room_once(window: QMainWindow, dock: QDockWidget, height: int) -> None:
    """Let a dock that is opened for the first time be so high, and as wide as its content needs.

    As far as the upper one and the drawing can spare it.

    Once for each dock: where the borders stand afterwards is the person's business.
    """
    if dock.property("hadRoom") or dock.isFloating():
        return
    dock.setProperty("hadRoom", True)
    # Only when the dock has its place is its height known.
    QTimer.singleShot(0, dock, lambda: _make_room(window, dock, height))
    QTimer.singleShot(0, dock, lambda: _make_width(window, dock))


def hide_idle_docks(window: QMainWindow) -> None:
    """Hide the docks that have nothing to show (they are disabled) after a layout was restored."""
    for dock in window.findChildren(QDockWidget):
        if not dock.isEnabled():
            dock.hide()


def _make_room(window: QMainWindow, dock: QDockWidget, height: int) -> None:
    above = next(
        (
            each
            for each in window.findChildren(QDockWidget)
            if each is not dock and each.isVisible() and not each.isFloating() and _is_above(each, dock)
        ),
        None,
    )
    missing = height - dock.height()
    if above is None or missing <= 0:
        return
    given = min(missing, above.height() - _LEAST_ABOVE)
    if given > 0:
        window.resizeDocks(
            [above, dock], [above.height() - given, dock.height() + given], Qt.Orientation.Vertical
        )


def _make_width(window: QMainWindow, dock: QDockWidget) -> None:
    area, drawing = dock.widget(), window.centralWidget()
    if not isinstance(area, Scrolled) or drawing is None:
        return
    missing = area.content.minimumSizeHint().width() - area.viewport().width()
    if 0 < missing <= drawing.width() - _LEAST_BESIDE:
        window.resizeDocks([dock], [dock.width() + missing], Qt.Orientation.Horizontal)


def _is_above(other: QDockWidget, dock: QDockWidget) -> bool:
    """Whether `other` shares the side with `dock`, in front and higher up."""
    return other.x() == dock.x() and other.y() < dock.y() and not other.visibleRegion().isEmpty()
