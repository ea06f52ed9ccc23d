"""Panning: the drawing follows the middle button, or the left one while Space is down."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from .camera import Camera


class Panning:
    """Panning of a plot with the mouse; the pointer's shape shows that it would.

    Every method takes an event that the plot received; what concerns other gestures is left alone.
    """

    def __init__(self, camera: Camera, viewport: QWidget) -> None:
        self._camera, self._viewport = camera, viewport
        self._from: QPointF | None = None
        self._button = Qt.MouseButton.MiddleButton
        self._space_down = False

    @property
    def is_active(self) -> bool:
        """Whether the drawing follows the mouse."""
        return self._from is not None

    @property
    def owns_cursor(self) -> bool:
        """Whether the shape of the pointer is that of panning."""
        return self._space_down or self.is_active

    def press(self, event: QMouseEvent) -> bool:
        """Begin, if this press means panning; return whether it does."""
        means_it = event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.LeftButton and self._space_down
        )
        if means_it and not self.is_active:
            self._from, self._button = event.position(), event.button()
            self._viewport.setCursor(Qt.CursorShape.ClosedHandCursor)
        return means_it

    def move(self, event: QMouseEvent) -> bool:
        """Let the drawing follow; return whether it does."""
        if self._from is None:
            return False
        moved = event.position() - self._from
        self._from = event.position()
        self._camera.pan(moved.x(), moved.y())
        return True

    def release(self, event: QMouseEvent) -> bool:
        """End, if the button that began it is let go; return whether it is."""
        ends = self.is_active and event.button() == self._button
        if ends:
            self.stop()
        return ends

    def stop(self) -> None:
        """End, if it is going on."""
        if self.is_active:
            self._from = None
            self._show_cursor()

    def hear_key(self, event: QKeyEvent, *, down: bool) -> None:
        """Note whether Space is down."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space_down = down
            self._show_cursor()

    def reset_key(self) -> None:
        """Count Space as released: in another window its release is never heard of."""
        self._space_down = False

    def _show_cursor(self) -> None:
        shape = Qt.CursorShape.OpenHandCursor if self._space_down else Qt.CursorShape.ArrowCursor
        self._viewport.setCursor(shape)
