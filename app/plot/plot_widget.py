"""A plot that hears mouse and keys: it pans and zooms, and hands everything else on as pointers.

pyqtgraph's own mouse layer is bypassed (it throttles moves and tests every item).
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent, QEnterEvent, QFocusEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from app.gestures.pointer import Pointer
from app.plot.layered_plot import LayeredPlot
from app.plot.panning import Panning

ZOOM_STEP = 1.2
"""Zoom factor of one notch of the wheel."""


class PlotWidget(LayeredPlot):
    """A plot with wheel zoom and panning, on which a subclass builds its gestures."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panning = Panning(self)
        self._menu_refused = False
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    # A subclass fills in these.

    def pressed(self, pointer: Pointer) -> None:
        """Handle a press of the left button."""

    def moved(self, pointer: Pointer) -> None:
        """Handle a move with the left button down."""

    def released(self, pointer: Pointer) -> None:
        """Handle the release of the left button."""

    def hovered_at(self, pointer: Pointer) -> None:
        """Handle a move with no button down."""

    def left(self) -> None:
        """Handle the pointer leaving the widget."""

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return False

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return False

    def menu_wanted(self, event: QContextMenuEvent) -> None:
        """Handle the wish for a menu, while no gesture is in flight."""

    # Events

    def pointer_at(self, event: QMouseEvent | QPointF) -> Pointer:
        """Return the record of a mouse event (or of a bare viewport position)."""
        position = event if isinstance(event, QPointF) else event.position()
        held = Qt.KeyboardModifier.NoModifier if isinstance(event, QPointF) else event.modifiers()
        pixel = self.area_pixel(position)
        return Pointer(
            position=self.pixel_map.plane(*pixel),
            pixel=pixel,
            shift=bool(held & Qt.KeyboardModifier.ShiftModifier),
            ctrl=bool(held & Qt.KeyboardModifier.ControlModifier),
            alt=bool(held & Qt.KeyboardModifier.AltModifier),
            scale=self.pixel_map.sx,
        )

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.RightButton:
            # It takes a gesture back, a drag as well as a transform; it must not open a menu as well.
            self._menu_refused = self._panning.is_active or (self.is_dragging and self.cancel_gesture())
            if self._menu_refused:
                event.accept()
                return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        if not self._panning.press(event) and event.button() == Qt.MouseButton.LeftButton:
            self.pressed(self.pointer_at(event))
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        event.accept()
        refused, self._menu_refused = self._menu_refused, False
        if not refused and not self.is_dragging:
            self.menu_wanted(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        # The second press of a double click is a press like any other: quick clicks must all count.
        self.mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not self._panning.move(event):
            if event.buttons() & Qt.MouseButton.LeftButton:
                self.moved(self.pointer_at(event))
            elif not event.buttons():
                self.hovered_at(self.pointer_at(event))
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if not self._panning.release() and event.button() == Qt.MouseButton.LeftButton:
            self.released(self.pointer_at(event))
        event.accept()

    def wheelEvent(self, event: QWheelEvent) -> None:
        notches = event.angleDelta().y() / 120
        if notches:
            self.zoom(ZOOM_STEP**notches, event.position())
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        self._panning.hear_key(event, down=True)
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        self._panning.hear_key(event, down=False)
        event.ignore()

    def enterEvent(self, event: QEnterEvent) -> None:
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        self.left()
        event.accept()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._panning.forget_key()
        super().focusOutEvent(event)
