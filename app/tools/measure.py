"""Measuring a distance and an angle; nothing in the document changes."""

from __future__ import annotations

import math

from app.document.model import Vector
from app.tools import words
from app.tools.drags import in_steps
from app.tools.overlay import Ruler
from app.tools.pointer import Pointer
from app.tools.snapping import Magnet

KEYS = "Shift: steps of 15° · Ctrl: snap, or not"
"""What each modifier key changes while something is measured."""


class Measure:
    """A line from the press to the pointer, both snapping; with Shift its angle goes in steps of 15°.

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
        end = self._end(pointer)
        dx, dy = end[0] - self._start[0], end[1] - self._start[1]
        unit = f" {self._unit}" if self._unit else ""
        direction = words.angle(math.degrees(math.atan2(dy, dx)))
        length = f"{words.number(math.hypot(dx, dy))}{unit}"
        text = f"{length} · Δx {words.number(dx)} · Δy {words.number(dy)} · {direction}"
        self.ruler = Ruler(self._start, end, text)

    def _end(self, pointer: Pointer) -> Vector:
        if not pointer.shift:
            return self.magnet.pull(pointer.position, pointer)
        # An angle that is held leaves nothing to be drawn elsewhere.
        self.magnet.release()
        x, y = self._start
        dx, dy = in_steps((pointer.position[0] - x, pointer.position[1] - y))
        return (x + dx, y + dy)

    def progress(self) -> str:
        """Return what is measured, and what the keys would change."""
        return f"{self.ruler.text} · {KEYS}" if self.ruler.text else ""

    @property
    def is_something(self) -> bool:
        """Whether there is a distance to show."""
        return self.ruler.start != self.ruler.end
