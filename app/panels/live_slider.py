"""A slider whose drag can be cancelled."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QSlider


class LiveSlider(QSlider):
    """A slider whose drag can be cancelled with Escape.

    Signals
    -------
    cancelled
        Escape was pressed while the slider was dragged.
    """

    cancelled = Signal()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.isSliderDown():
            self.cancelled.emit()
            return
        super().keyPressEvent(event)
