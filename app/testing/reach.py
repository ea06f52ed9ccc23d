"""Checks that a person could do something in the window as it is, made before an event is sent.

Qt delivers an event to whatever widget it is sent to, hidden or not; a test that relies on it shows nothing
of what a person can do.
"""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QDialog, QWidget

_BRING_IT_IN = " Bring that pixel into view first: editor.fit() shows the whole curve, editor.wheel(…) zooms."


class ImpossibleError(RuntimeError):
    """Something that no person could do in the window as it is; the message says why."""


def named(widget: QWidget) -> str:
    """Return the name of a widget for a message: its objectName, or else its class."""
    return widget.objectName() or type(widget).__name__


def require_enabled(action: QAction) -> None:
    """Raise `ImpossibleError` unless a person could trigger `action` by its menu or its keys."""
    if not action.isEnabled():
        raise ImpossibleError(f"{action.objectName()!r} ({action.text()}) is disabled.")
    owner = action.parent()
    window = owner.window() if isinstance(owner, QWidget) else None
    _require_unblocked(window, f"{action.objectName()!r}")


def require_reachable(widget: QWidget) -> None:
    """Raise `ImpossibleError` unless `widget` is shown and enabled, and no dialog keeps a person from it."""
    name = named(widget)
    _require_unblocked(widget.window(), name)
    if not widget.isVisible():
        raise ImpossibleError(f"{name} is not shown.")
    if not widget.isEnabled():
        raise ImpossibleError(f"{name} is disabled.")


def require_under_mouse(widget: QWidget, pixel: QPoint | QPointF) -> None:
    """Raise `ImpossibleError` unless the mouse can be put on this pixel of `widget`, with nothing over it."""
    require_reachable(widget)
    position, name = QPointF(pixel).toPoint(), named(widget.parentWidget() or widget)
    where = f"({position.x()}, {position.y()})"
    if not widget.rect().contains(position):
        size = f"{widget.width()} × {widget.height()}"
        raise ImpossibleError(f"The pixel {where} lies outside {name}, which has {size}.{_BRING_IT_IN}")
    if not widget.visibleRegion().contains(position):
        raise ImpossibleError(f"The pixel {where} of {name} is covered, or cut off.")
    there = widget.childAt(position)
    if there is not None:
        raise ImpossibleError(f"At the pixel {where} of {name} lies {named(there)}.")


def require_within_drag(widget: QWidget, pixel: QPoint | QPointF) -> None:
    """Raise `ImpossibleError` unless a mouse that was pressed on `widget` can be moved to this pixel of it.

    It may leave the widget, and the window, but not by more than the screen, or a window larger than that:
    wherever the window stands, the screen ends there.
    """
    require_reachable(widget)
    position, name = QPointF(pixel).toPoint(), named(widget.parentWidget() or widget)
    room = widget.screen().virtualSize().expandedTo(widget.window().size())
    within = widget.rect().adjusted(-room.width(), -room.height(), room.width(), room.height())
    if not within.contains(position):
        where = f"({position.x()}, {position.y()})"
        raise ImpossibleError(f"The pixel {where} lies outside {name} by more than a screen.{_BRING_IT_IN}")


def _require_unblocked(window: QWidget | None, what: str) -> None:
    """Raise `ImpossibleError` where a dialog or a menu blocks `window`."""
    dialog = QApplication.activeModalWidget()
    if dialog is not None and dialog is not window and not (window and dialog.isAncestorOf(window)):
        title = dialog.windowTitle() if isinstance(dialog, QDialog) else ""
        raise ImpossibleError(f"{what} cannot be reached: {title or named(dialog)} waits for an answer.")
