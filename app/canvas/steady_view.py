"""What the canvas shows when it gets another size: the drawing stays where it is on the screen."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF
from PySide6.QtWidgets import QWidget

from ..plotting.camera import Camera
from .fitting import Framing


class SteadyView:
    """Keeps scale and place of the drawing while panels and borders beside the canvas move.

    Only with a window of another size it is fitted again, as long as nobody has zoomed, panned or drawn since
    it was fitted.
    """

    def __init__(self, canvas: QWidget, camera: Camera, framing: Framing) -> None:
        self._canvas, self._camera, self._framing = canvas, camera, framing
        self._window_size = canvas.window().size()
        self._remember()
        camera.changed.connect(self._remember)
        camera.resized = self._follow_size

    def _remember(self) -> None:
        self._seen, self._corner = self._camera.pixel_map, self._corner_now()

    def _corner_now(self) -> QPointF:
        """Return where the drawing begins in the window."""
        return self._camera.origin + QPointF(self._canvas.mapTo(self._canvas.window(), QPoint()))

    def _follow_size(self) -> None:
        size = self._canvas.window().size()
        is_new, self._window_size = size != self._window_size, size
        if is_new and self._framing.is_as_fitted:
            self._framing.fit()
        else:
            moved = self._corner_now() - self._corner
            self._camera.keep(self._seen, (moved.x(), moved.y()))
        self._remember()
