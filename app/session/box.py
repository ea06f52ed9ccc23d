"""The box around what is selected: what it turns about, and what its grips do."""

from __future__ import annotations

from collections.abc import Callable

from ..view_model.pivot import Pivot


class BoxState:
    """What a person has chosen of the box around what is selected; neither saved nor undone.

    Parameters
    ----------
    pivot_changed, grips_changed
        Told when a pivot is elsewhere, and when the grips do something else.

    Attributes
    ----------
    pivot
        What was chosen to turn, scale and mirror about, with what it was chosen for; None for the middle.
    turns
        Whether its grips rotate and skew; until something else is selected.
    """

    def __init__(self, pivot_changed: Callable[[], None], grips_changed: Callable[[], None]) -> None:
        self._pivot_changed, self._grips_changed = pivot_changed, grips_changed
        self.pivot: Pivot | None = None
        self.turns = False

    def set_pivot(self, pivot: Pivot | None) -> None:
        """Turn, scale and mirror about another place; None for the middle."""
        before, self.pivot = self.pivot, pivot
        if (before and before.position) != (pivot and pivot.position):
            self._pivot_changed()

    def set_turns(self, turns: bool) -> None:
        """Have grips that rotate and skew, or such that scale."""
        before, self.turns = self.turns, turns
        if self.turns != before:
            self._grips_changed()
