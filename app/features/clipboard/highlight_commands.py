"""Duplicate and delete: of what is highlighted."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.needs import HIGHLIGHTED
from ...actions.sections import EDIT_CLIPBOARD, EDIT_DELETE
from ...actions.strips import POINT_MENU
from ...document.words import count_of
from ...view_model.arrivals import with_part
from ...view_model.pasting import part_of
from ...workbench.context import WindowContext
from ...workbench.highlight import highlighted, remove


class HighlightCommands:
    """Duplicate and delete."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action("duplicateSelection", "Duplicate", EDIT_CLIPBOARD, "Ctrl+D", "duplicate", needs=HIGHLIGHTED)
    @also(POINT_MENU(34))
    def _duplicate(self) -> None:
        """Add a copy of the part with the selected points, or else of the curve or all chosen ones."""
        session, what = self._session, highlighted(self._context)
        part = part_of(session.active_view, what.points)
        if part is None:
            # One point is no curve, and all of them are the curve itself.
            self._context.actions["duplicateCurve"].trigger()
            return
        arrival = with_part(session.document, part, session.active_index)
        words = count_of(len(what.points), "point")
        if session.change(f"Duplicate {words}", lambda _: arrival.document, active=arrival.places.start):
            session.selected.set_points(range(len(part.points)))
            session.say(
                f"{words} as “{session.active_curve.name}”, which lies on the original; drag one to move it."
            )

    @action("deleteSelection", "Delete", EDIT_DELETE, "Del, Backspace", "delete", needs=HIGHLIGHTED)
    @also(POINT_MENU(40))
    def _delete(self) -> None:
        """Delete the selected points, or else the curve or all chosen ones."""
        session, what = self._session, highlighted(self._context)
        words = what.said(session.document)
        if remove(session, what, "Delete") and not what.points:
            session.say(f"Deleted {words}.")
