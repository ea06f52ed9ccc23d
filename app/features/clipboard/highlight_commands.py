"""Duplicate and delete: of what is highlighted."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.menus import EDIT_CLIPBOARD, EDIT_DELETE, POINT_MENU, POINTS_NUMBER
from ...actions.needs import HIGHLIGHTED, Need
from ...document.selection import all_points
from ...document.several_curves import named
from ...view_model.paste import parts_of, with_parts
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
        parts = parts_of(session.views, what.points)
        if all(part in session.document.curves for part in parts):
            # One point is no curve, and all of them are the curve itself.
            self._context.actions["duplicateCurve"].trigger()
            return
        arrival, words = with_parts(session.document, parts, session.active_index), what.points.counted
        if session.change(f"Duplicate {words}", lambda _: arrival.document, active=arrival.places.start):
            session.selected.set_curves(arrival.places)
            session.selected.set_group(all_points(session.document, session.selected.edited))
            name = named(session.document, arrival.places)
            it = f"“{name}”, which lies" if len(parts) == 1 else f"{name}, which lie"
            session.say(f"{words} as {it} on the original; drag one to move it.")

    @action("deleteSelection", "Delete", EDIT_DELETE, "Del, Backspace", "delete", needs=HIGHLIGHTED)
    @also(POINT_MENU(40))
    def _delete(self) -> None:
        """Delete the selected points, keeping the shape, or else the curve or all chosen ones."""
        session = self._session
        what = highlighted(self._context).changeable(session.document)
        words = what.told(session.document)
        if remove(self._context, what, "Delete") and not what.points.parts:
            session.say(f"Deleted {words}.")

    @action(
        "deleteLeavingHandles",
        "Delete, Leaving the Handles",
        POINTS_NUMBER,
        "Ctrl+Del",
        needs=Need("selected points", lambda state: state.selected_count > 0),
        keywords="nodes without keeping the shape",
    )
    def _delete_plainly(self) -> None:
        """Delete the selected points; the handles beside them stay as they are."""
        remove(self._context, self._session.selected.highlight(), "Delete", keeps_shape=False)
