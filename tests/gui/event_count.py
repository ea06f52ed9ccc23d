"""Count of the events that a widget gets."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject


class EventCount(QObject):
    """Counts how often a widget gets an event of one type."""

    def __init__(self, widget, type_):
        super().__init__(widget)
        self.count, self._type = 0, type_
        widget.installEventFilter(self)

    def eventFilter(self, _watched, event):
        self.count += event.type() == self._type
        return False


def layouts_of(widget):
    """Return a count of how often `widget` lays out what it holds."""
    return EventCount(widget, QEvent.Type.LayoutRequest)


def paints_of(widget):
    """Return a count of how often `widget` is painted."""
    return EventCount(widget, QEvent.Type.Paint)
