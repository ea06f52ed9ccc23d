"""The box around what is selected: what it turns about, and what its grips do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..view_model.pivot import Pivot

if TYPE_CHECKING:
    from .session import Session


class SelectionBox:
    """What a person has chosen of the box around what is selected; neither saved nor undone.

    `Session.pivot_changed` and `Session.grips_changed` tell of it.

    Attributes
    ----------
    pivot
        What was chosen to turn, scale and mirror about, with what it was chosen for; None for the middle.
    turns
        Whether its grips rotate and skew; until something else is selected.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self.pivot: Pivot | None = None
        self.turns = False

    def set_pivot(self, pivot: Pivot | None) -> None:
        """Turn, scale and mirror about another place, or about the middle (None)."""
        before, self.pivot = self.pivot, pivot
        if (before and before.place) != (pivot and pivot.place):
            self._session.pivot_changed.emit()

    def set_turns(self, turns: bool) -> None:
        """Have grips that rotate and skew, or such that scale."""
        before, self.turns = self.turns, turns
        if self.turns != before:
            self._session.grips_changed.emit()
