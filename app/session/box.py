"""The box around what is selected: what it turns about, and what its grips do."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ..view_model.boxes.pivot import Pivot

_MOST_PIVOTS = 24
"""Pivots that are remembered: each is taken along by every step."""


class SelectionBox:
    """What a person has chosen of the box around what is selected; neither saved nor undone.

    Parameters
    ----------
    pivot_changed, grips_changed
        Told when a pivot is elsewhere, and when the grips do something else.

    Attributes
    ----------
    pivots
        What was chosen to turn, scale and mirror about, each with what it was chosen for; the last one first.
    turns
        Whether its grips rotate and skew; until something else is selected.
    """

    def __init__(self, pivot_changed: Callable[[], None], grips_changed: Callable[[], None]) -> None:
        self._pivot_changed, self._grips_changed = pivot_changed, grips_changed
        self.pivots: tuple[Pivot, ...] = ()
        self.turns = False

    def set_pivots(self, pivots: Iterable[Pivot]) -> None:
        """Turn, scale and mirror about other places, the latest of them; what has none about its middle."""
        before, self.pivots = self.pivots, tuple(pivots)[:_MOST_PIVOTS]
        if [each.place for each in before] != [each.place for each in self.pivots]:
            self._pivot_changed()

    def set_turns(self, turns: bool) -> None:
        """Have grips that rotate and skew, or such that scale."""
        before, self.turns = self.turns, turns
        if self.turns != before:
            self._grips_changed()
