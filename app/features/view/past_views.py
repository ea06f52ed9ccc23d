"""Parts of the plane that were seen before: what Previous View goes back to."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QObject, QTimer

from ...plotting.camera import Camera

_REST_MS: Final = 300
"""Milliseconds without a move of the view after which the next one is another."""

_MOST: Final = 100

Box = tuple[float, float, float, float]


class PastViews(QObject):
    """The views of one camera, in order; notches of the wheel one after the other are one move."""

    def __init__(self, camera: Camera, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._camera = camera
        self._before: list[Box] = []
        self._seen, self._size = camera.pixel_map.box, self._size_now()
        # Whether a view of before is being shown, which is no move.
        self._is_going = False
        self._moving = QTimer(self, singleShot=True, interval=_REST_MS)
        camera.changed.connect(self._note)

    def _size_now(self) -> tuple[float, float]:
        shown = self._camera.pixel_map
        return shown.width, shown.height

    def _note(self) -> None:
        """Remember what was seen before this move, unless the window has only got another size."""
        box, size = self._camera.pixel_map.box, self._size_now()
        if size == self._size and box != self._seen and not self._is_going:
            if not self._moving.isActive():
                self._before = [*self._before[-_MOST:], self._seen]
            self._moving.start()
        self._seen, self._size = box, size

    def begin_move(self) -> None:
        """Let what comes be a move of its own, however soon it follows the last."""
        self._moving.stop()

    def forget(self) -> None:
        """Forget the views: they were of another document."""
        self.begin_move()
        self._before.clear()

    def go_back(self) -> bool:
        """Show what was seen before; return whether there was something."""
        self._moving.stop()
        if not self._before:
            return False
        x_min, y_min, x_max, y_max = self._before.pop()
        self._is_going = True
        self._camera.show_box((x_min, x_max), (y_min, y_max))
        self._is_going = False
        return True
