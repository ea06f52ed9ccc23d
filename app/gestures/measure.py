"""Measuring a distance and an angle; nothing in the document changes."""

from __future__ import annotations

import math

from app.gestures import words
from app.gestures.overlay import Ruler
from app.gestures.pointer import Pointer
from app.gestures.snapping import Magnet


class Measure:
    """A line from the press to the pointer, both snapping.

    Attributes
    ----------
    ruler
        What is measured.
    magnet
        What draws its ends.
    """

    def __init__(self, pointer: Pointer, magnet: Magnet, unit: str) -> None:
        self.magnet, self._unit = magnet, unit
        self._start = magnet.pull(pointer.position, pointer)
        self.ruler = Ruler(self._start, self._start, "")

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        end = self.magnet.pull(pointer.position, pointer)
        dx, dy = end[0] - self._start[0], end[1] - self._start[1]
        unit = f" {self._unit}" if self._unit else ""
        direction = words.angle(math.degrees(math.atan2(dy, dx)))
        length = f"{words.number(math.hypot(dx, dy))}{unit}"
        text = f"{length} · Δx {words.number(dx)} · Δy {words.number(dy)} · {direction}"
        self.ruler = Ruler(self._start, end, text)

    @property
    def is_something(self) -> bool:
        """Whether there is a distance to show."""
        return self.ruler.start != self.ruler.end
