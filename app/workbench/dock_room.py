"""Room for a dock that needs more than its share of the side."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar, QWidget

from ..widgets.fitting import Scrolled
from .dock import Dock

_HAS_ROOM = "hasRoom"
"""Property of a dock that room was made for."""

_DIRECT = Qt.FindChildOption.FindDirectChildrenOnly

_MOVED = 2
"""Pixels up to which a border is where it was put."""

_LEAST_ABOVE = 150
_LEAST_BESIDE = 480
"""Pixels that are left of the drawing; beside less of it a dock is scrolled."""


def make_room(window: QMainWindow, dock: Dock, height: int) -> None:
    """Let a dock that is opened be as high and wide as its content needs, up to `height`, until it is closed.

    As far as the upper one and the drawing can spare it. Where a person has moved the border since, it stays.
    """
    if dock.property(_HAS_ROOM) or dock.isFloating():
        return
    dock.setProperty(_HAS_ROOM, True)
    # Only when the dock has its place is its height known.
    QTimer.singleShot(0, dock, lambda: _make_room(window, dock, height))
    QTimer.singleShot(0, dock, lambda: _make_width(window, dock))


def hide_idle_docks(window: QMainWindow) -> None:
    """Hide the docks that have nothing to show (they are disabled) after a layout was restored."""
    for dock in window.findChildren(QDockWidget):
        if not dock.isEnabled():
            dock.hide()


def _make_room(window: QMainWindow, dock: Dock, height: int) -> None:
    above = next((each for each in _in_front(window) if _is_above(each, dock)), None)
    missing = _needed(dock, height) - dock.height()
    given = min(missing, above.height() - _LEAST_ABOVE) if above is not None else 0
    if above is None or given <= 0:
        return
    border = above.height() - given
    _divide(window, (above, border), (dock, dock.height() + given))

    def give_back() -> None:
        dock.setProperty(_HAS_ROOM, False)
        # What it has covered is there again, and has its size.
        left = next((each for each in _in_front(window) if _is_above(above, each)), None)
        if left is not None and abs(above.height() - border) <= _MOVED:
            _divide(window, (above, above.height() + given), (left, left.height() - given))

    dock.closed.connect(lambda: QTimer.singleShot(0, dock, give_back), Qt.ConnectionType.SingleShotConnection)


def _divide(window: QMainWindow, *heights: tuple[QDockWidget, int]) -> None:
    """Give docks at one side these heights, all of them together."""
    # Qt divides the side in this proportion, the tabs of each dock included.
    tabs = max(
        (bar.height() for bar in window.findChildren(QTabBar, options=_DIRECT) if bar.isVisible()), default=0
    )
    docks = [dock for dock, _ in heights]
    with_tabs = [height + (tabs if window.tabifiedDockWidgets(dock) else 0) for dock, height in heights]
    window.resizeDocks(docks, with_tabs, Qt.Orientation.Vertical)


def _needed(dock: Dock, height: int) -> int:
    """Return the height with which nothing in a dock has to be scrolled, `height` at most."""
    area = dock.widget()
    if not isinstance(area, Scrolled):
        return height
    content: QWidget = area.content
    return min(height, dock.height() - area.viewport().height() + content.sizeHint().height())


def _in_front(window: QMainWindow) -> list[QDockWidget]:
    """Return the docks at the sides that are in sight."""
    docks = window.findChildren(QDockWidget)
    return [each for each in docks if not each.isFloating() and not each.visibleRegion().isEmpty()]


def _make_width(window: QMainWindow, dock: QDockWidget) -> None:
    area, drawing = dock.widget(), window.centralWidget()
    if not isinstance(area, Scrolled) or drawing is None:
        return
    missing = area.content.minimumSizeHint().width() - area.viewport().width()
    if 0 < missing <= drawing.width() - _LEAST_BESIDE:
        window.resizeDocks([dock], [dock.width() + missing], Qt.Orientation.Horizontal)


def _is_above(other: QDockWidget, dock: QDockWidget) -> bool:
    """Whether `other` shares the side with `dock`, higher up."""
    return other.x() == dock.x() and other.y() < dock.y()
