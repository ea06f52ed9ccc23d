"""Count of the layouts of a widget."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject


class Layouts(QObject):
    """Counts how often a widget lays out what it holds."""

    def __init__(self, widget):
        super().__init__(widget)
        self.count = 0
        widget.installEventFilter(self)

    def eventFilter(self, _watched, event):
        self.count += event.type() == QEvent.Type.LayoutRequest
        return False
