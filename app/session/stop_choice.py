"""The stop of a gradient that is chosen, on the canvas or in the Style panel."""

from __future__ import annotations

from collections.abc import Callable

from ..document.gradient_edits import PaintedStop


class StopChoice:
    """One stop of one gradient, or none; neither saved nor undone.

    It may be of a gradient that is no longer there, or not among those chosen: whoever shows it looks.

    Parameters
    ----------
    changed
        Told of another one.

    Attributes
    ----------
    chosen
        The stop; None for none.
    """

    def __init__(self, changed: Callable[[], None]) -> None:
        self._changed = changed
        self.chosen: PaintedStop | None = None

    def choose(self, stop: PaintedStop | None) -> None:
        """Choose a stop, or none."""
        before, self.chosen = self.chosen, stop
        if stop != before:
            self._changed()
