"""Whose style is meant: that of what is chosen, or of what is drawn next."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from ...document.several_curves import named
from ...document.shapes import whole_shapes
from ...document.style import Style
from ...session.session import Session


class Shown(msgspec.Struct, frozen=True):
    """Styles that are shown, and what they are of.

    Attributes
    ----------
    curves
        The curves that have them, with all of their shapes; none where they are of what is drawn next.
    styles
        The styles.
    is_next
        Whether they are of what is drawn next.
    words
        What they are of.
    """

    curves: Sequence[int]
    styles: Sequence[Style]
    is_next: bool
    words: str


class StyleSubject:
    """Finds what is meant now."""

    def __init__(self, session: Session) -> None:
        self._session = session

    @property
    def curves(self) -> frozenset[int]:
        """The curves whose style is meant; none where it is that of what is drawn next.

        An empty curve is what is drawn next.
        """
        session, selected = self._session, self._session.selected
        is_begun = bool(session.active_curve.points)
        if selected.next_style.is_of_active(selected.marked):
            return selected.marked
        return frozenset() if is_begun else frozenset({session.active_index})

    def now(self) -> Shown:
        """Return the styles that are meant now."""
        curves = sorted(whole_shapes(self._session.document, self.curves))
        chosen = [self._session.document.curves[place] for place in curves]
        is_next = not any(each.points for each in chosen)
        styles = [each.style for each in chosen] or [self._session.model.style]
        return Shown(curves, styles, is_next, self._words(curves, is_next=is_next))

    def _words(self, curves: Sequence[int], *, is_next: bool) -> str:
        return "What is drawn next" if is_next else named(self._session.document, curves)
