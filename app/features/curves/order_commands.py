"""Order of curves: raised and lowered, and walked through."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from ...actions.declaration import action
from ...actions.menus import ARRANGE_ORDER, ARRANGE_WALK
from ...actions.needs import SECOND_CURVE, Need
from ...document.group_edits import at_end, stepped
from ...document.model import Document
from ...document.several_curves import in_order, named, place_in
from ...workbench.context import WindowContext

Arrange = Callable[[Document, Collection[int], int], Sequence[int]]
"""Returns the order of curves in which some are elsewhere, towards the front (1) or the back (−1)."""

_CURVE_IN_FRONT = Need(
    "a curve in front of this one",
    lambda state: state.has_curve_in_front,
    why=lambda _state: "Nothing is in front of it: it is at the top already.",
    is_so=True,
)
_CURVE_BEHIND = Need(
    "a curve behind this one",
    lambda state: state.has_curve_behind,
    why=lambda _state: "Nothing is behind it: it is at the bottom already.",
    is_so=True,
)


class OrderCommands:
    """Puts what is chosen elsewhere in the order, and goes through it."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "raiseCurve",
        "Raise",
        ARRANGE_ORDER,
        "Ctrl+Shift+PgUp",
        "move-up",
        full_name="Raise Curve",
        needs=_CURVE_IN_FRONT,
    )
    def _raise(self) -> None:
        """Move the curve up in the list: it is drawn in front of the next one."""
        self._put("Raise {}", stepped, 1, "one step to the front")

    @action(
        "lowerCurve",
        "Lower",
        ARRANGE_ORDER,
        "Ctrl+Shift+PgDown",
        "move-down",
        full_name="Lower Curve",
        needs=_CURVE_BEHIND,
    )
    def _lower(self) -> None:
        """Move the curve down in the list: it is drawn behind the next one."""
        self._put("Lower {}", stepped, -1, "one step to the back")

    @action(
        "raiseToTop",
        "Raise to Top",
        ARRANGE_ORDER,
        "Ctrl+Shift+Home",
        "move-to-top",
        full_name="Raise Curve to Top",
        needs=_CURVE_IN_FRONT,
        keywords="bring to front order",
    )
    def _raise_to_top(self) -> None:
        """Move the curve to the top of the list, or of its group: it is drawn in front of all there."""
        self._put("Raise {} to top", at_end, 1, "at the top")

    @action(
        "lowerToBottom",
        "Lower to Bottom",
        ARRANGE_ORDER,
        "Ctrl+Shift+End",
        "move-to-bottom",
        full_name="Lower Curve to Bottom",
        needs=_CURVE_BEHIND,
        keywords="send to back order",
    )
    def _lower_to_bottom(self) -> None:
        """Move the curve to the bottom of the list, or of its group: it is drawn behind all there."""
        self._put("Lower {} to bottom", at_end, -1, "at the bottom")

    def _put(self, name: str, arrange: Arrange, way: int, where: str) -> None:
        """Put what is chosen elsewhere in the order, as one step."""
        session, what = self._session, named(self._session.document, self._session.selected.whole)
        document = in_order(session.document, arrange(session.document, session.selected.curves, way))
        active = place_in(document, session.active_curve)
        if session.change(name.format(what), lambda _: document, active=active):
            session.say(f"{what}: {where}.")

    @action(
        "nextCurve",
        "Next Curve",
        ARRANGE_WALK,
        "Ctrl+PgDown",
        needs=SECOND_CURVE,
    )
    def _go_on(self) -> None:
        """Edit the next curve down the list."""
        self._walk(-1)

    @action(
        "previousCurve",
        "Previous Curve",
        ARRANGE_WALK,
        "Ctrl+PgUp",
        needs=SECOND_CURVE,
    )
    def _go_back(self) -> None:
        """Edit the next curve up the list."""
        self._walk(1)

    def _walk(self, step: int) -> None:
        # The next one is the one below in the list, hence behind.
        session = self._session
        session.selected.activate((session.active_index + step) % len(session.document.curves))
        session.say(f"Editing “{session.active_curve.seen_name}”.")
