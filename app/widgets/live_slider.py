"""A slider whose drag can be cancelled."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QAbstractSlider, QSlider

from ..qt.overrides import SafeOverrides

_MOVE = QAbstractSlider.SliderAction.SliderMove.value


class LiveSlider(SafeOverrides, QSlider):
    """A slider whose drag can be cancelled with Escape.

    Signals
    -------
    dragged
        The handle is being dragged, to this position.
    dropped
        A drag has ended at this position.
    chosen
        A key, the wheel or a click has set this position.
    cancelled
        Escape was pressed while the slider was dragged. The slider then counts as released: its owner shows
        the old value at once, and the rest of the drag does nothing.
    drag_ended
        A drag has ended, one way or the other: what is, is to be shown.
    """

    dragged = Signal(int)
    dropped = Signal(int)
    chosen = Signal(int)
    cancelled = Signal()
    drag_ended = Signal()

    def __init__(self) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._is_over = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.sliderPressed.connect(self._begin)
        self.actionTriggered.connect(self._report)
        self.sliderReleased.connect(self._end)

    def _report(self, action: int) -> None:
        if action != _MOVE or not self.isSliderDown():
            self.chosen.emit(self.sliderPosition())
        elif not self._is_over:
            self.dragged.emit(self.sliderPosition())

    def _end(self) -> None:
        if not self._is_over:
            self.dropped.emit(self.sliderPosition())
        self.drag_ended.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.isSliderDown():
            self.cancelled.emit()
            self.abandon()
            return
        super().keyPressEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            # Whatever lies around it scrolls.
            event.ignore()

    def abandon(self) -> None:
        """End a drag here; what the mouse still does before its release means nothing."""
        if self.isSliderDown():
            self._is_over = True
            self.setSliderDown(False)

    def _begin(self) -> None:
        self._is_over = False

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._begin()
        super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not self._is_over:
            super().mouseMoveEvent(event)
