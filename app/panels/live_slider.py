"""A slider whose drag can be cancelled."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QSlider, QWidget

from app.overrides import Guarded


class LiveSlider(Guarded, QSlider):
    """A slider whose drag can be cancelled with Escape.

    Signals
    -------
    cancelled
        Escape was pressed while the slider was dragged. The slider then counts as released: its owner shows
        the old value at once, and the rest of the drag does nothing.
    """

    cancelled = Signal()

    def __init__(self, orientation: Qt.Orientation, parent: QWidget | None = None) -> None:
        super().__init__(orientation, parent)
        self._is_over = False

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.isSliderDown():
            self.cancelled.emit()
            self.abandon()
            return
        super().keyPressEvent(event)

    def abandon(self) -> None:
        """End the drag here; what the mouse still does before its release means nothing."""
        self._is_over = True
        self.setSliderDown(False)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._is_over = False
        super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not self._is_over:
            super().mouseMoveEvent(event)
