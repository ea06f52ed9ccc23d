"""Scrolling at the edge: under a drag there the view moves on, also while the mouse rests."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from ..document.model import Vector
from ..tools.drag_machine import THRESHOLD
from .camera import Camera

_ZONE = 10.0
"""Pixels inside the edge from which on it scrolls: beyond the edge of a screen no mouse can go."""

_TICK_MS = 16
_LEAST, _GAIN, _MOST = 1.5, 0.15, 30.0
"""Pixels of a tick: at least, more for every pixel further out, at most."""


class EdgeScroll(QObject):
    """Moves the view of a plot towards a pointer at its edge, the faster the further out it is.

    A press near the edge scrolls nothing until the pointer has moved outwards from there.

    Parameters
    ----------
    camera
        The camera that it moves.
    scrolled
        Called after each move: what is dragged is somewhere else now.
    """

    def __init__(self, camera: Camera, scrolled: Callable[[], None]) -> None:
        super().__init__(camera)
        self._camera, self._scrolled = camera, scrolled
        self._at_press = self._way = (0.0, 0.0)
        self._timer = QTimer(self, interval=_TICK_MS)
        self._timer.timeout.connect(self._scroll)

    def begin(self, pixel: Vector) -> None:
        """Take note of a press at a pixel of the plot area."""
        self.stop()
        self._at_press = self._overshoot(pixel)

    def follow(self, pixel: Vector) -> None:
        """Scroll from now on if the pointer is at the edge here, or no longer."""
        shown = self._camera.pixel_map
        is_inside = _ZONE <= pixel[0] <= shown.width - _ZONE and _ZONE <= pixel[1] <= shown.height - _ZONE
        if is_inside and self._way == (0.0, 0.0):
            return
        x, y = (
            _beyond(now, before) for now, before in zip(self._overshoot(pixel), self._at_press, strict=True)
        )
        self._way = (_step(x), _step(y))
        if not any(self._way):
            self._timer.stop()
        elif not self._timer.isActive():
            self._timer.start()

    def stop(self) -> None:
        """Scroll no longer: the drag has ended."""
        self._timer.stop()
        self._at_press = self._way = (0.0, 0.0)

    def _overshoot(self, pixel: Vector) -> Vector:
        """Return how far a pixel lies in the zone at the edges or beyond: to the right and down positive."""
        shown = self._camera.pixel_map
        x, y = (
            max(at - (size - _ZONE), 0.0) + min(at - _ZONE, 0.0)
            for at, size in zip(pixel, (shown.width, shown.height), strict=True)
        )
        return (x, y)

    def _scroll(self) -> None:
        self._camera.pan(-self._way[0], -self._way[1])
        self._scrolled()


def _beyond(now: float, before: float) -> float:
    """Return how much further out a coordinate is than it was at the press, 0 if it is not."""
    if before and now * before > 0 and abs(now) < abs(before) + THRESHOLD:
        return 0.0  # no drag yet
    return max(now - max(before, 0.0), 0.0) + min(now - min(before, 0.0), 0.0)


def _step(out: float) -> float:
    """Return by how many pixels to scroll in a tick."""
    if not out:
        return 0.0
    step = min(_LEAST + _GAIN * abs(out), _MOST)
    return step if out > 0 else -step
