"""Selecting with a rubber band."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from app.document.model import Vector
from app.tools import words
from app.tools.machine import CANCELLED, THRESHOLD, Host
from app.tools.pointer import Pointer


class Marquee:
    """Selects the points inside the band, live; while Shift is held, adds to what was selected before.

    Attributes
    ----------
    band
        Two opposite corners of the band; None until the pointer has travelled far enough for a drag.
    """

    def __init__(self, host: Host, pointer: Pointer, on_click: Callable[[], object] | None = None) -> None:
        self._host, self._press, self._on_click = host, pointer, on_click
        self._before = host.selection
        self.band: tuple[Vector, Vector] | None = None

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        if self.band is None and math.dist(pointer.pixel, self._press.pixel) < THRESHOLD:
            return
        self.band = (self._press.position, pointer.position)
        inside = self._inside(self.band)
        self._host.select(self._before | inside if pointer.shift else inside)

    def _inside(self, band: tuple[Vector, Vector]) -> frozenset[int]:
        low, high = np.min(band, axis=0), np.max(band, axis=0)
        points = self._host.active_view.points
        inside = np.all((points >= low) & (points <= high), axis=1)
        return frozenset(np.flatnonzero(inside).tolist())

    def release(self, pointer: Pointer) -> None:
        """End; a click beside everything deselects, with Shift it leaves the selection.

        With nothing to deselect, `on_click` is called.
        """
        self.move(pointer)
        if self.band is not None or pointer.shift:
            return
        if self._before:
            self._host.select([])
        elif self._on_click is not None:
            self._on_click()

    def cancel(self) -> None:
        """Bring back what was selected before."""
        self._host.select(self._before)
        if self.band is not None:
            self._host.say(CANCELLED)

    def progress(self) -> str:
        """Tell what is selected."""
        count = len(self._host.selection)
        chosen = f"{words.points(self._host.selection)} selected" if count else "No point selected"
        return f"{chosen[:1].upper()}{chosen[1:]} · Shift: add to what was selected · Escape cancels"
