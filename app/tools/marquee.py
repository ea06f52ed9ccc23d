"""Selecting with a rubber band."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ..document import words
from ..document.model import Vector
from ..view_model.curve_view import CurveView
from .drag_machine import CANCELLED, THRESHOLD
from .tool import Gesture, ToolContext


class Marquee(Gesture):
    """Rubber band: selects the points inside, live; with Shift held, adds to what was selected before.

    Attributes
    ----------
    band
        Two opposite corners of the band; None until the pointer has travelled far enough for a drag.
    """

    def __init__(self, context: ToolContext, on_click: Callable[[ToolContext], object]) -> None:
        self._press, self._on_click = context.pointer, on_click
        self._before = context.host.selected.points
        self.band: tuple[Vector, Vector] | None = None

    def move(self, context: ToolContext) -> None:
        """Follow the pointer."""
        pointer = context.pointer
        if self.band is None and math.dist(pointer.pixel, self._press.pixel) < THRESHOLD:
            return
        self.band = (self._press.position, pointer.position)
        inside = _inside(self.band, context.view)
        context.host.selected.set_points(self._before | inside if pointer.shift else inside)

    def release(self, context: ToolContext) -> None:
        """End; a click beside everything deselects, with Shift it leaves the selection.

        With nothing to deselect, `on_click` is called.
        """
        self.move(context)
        if self.band is not None or context.pointer.shift:
            return
        if self._before:
            context.host.selected.set_points([])
        else:
            self._on_click(context)

    def cancel(self, context: ToolContext) -> None:
        """Bring back what was selected before."""
        context.host.selected.set_points(self._before)
        if self.band is not None:
            context.host.say(CANCELLED)

    def progress(self, context: ToolContext) -> str:
        """Tell what is selected; nothing before there is a band."""
        if self.band is None:
            return ""
        selection = context.host.selected.points
        selected = f"{words.points(selection)} selected" if selection else "No point selected"
        return f"{selected[:1].upper()}{selected[1:]} · Shift: add to what was selected · Escape cancels"


def _inside(band: tuple[Vector, Vector], view: CurveView) -> frozenset[int]:
    low, high = np.min(band, axis=0), np.max(band, axis=0)
    inside = np.all((view.points >= low) & (view.points <= high), axis=1)
    return frozenset(np.flatnonzero(inside).tolist())
