"""Clones of curves: made and unlinked."""

from __future__ import annotations

from uuid import uuid4

from ...actions.declaration import action, also
from ...actions.needs import HIGHLIGHTED, Need
from ...actions.sections import EDIT_CLONES
from ...actions.situation import Situation
from ...actions.strips import CHOSEN_MENU, CURVE_MENU
from ...document.clones import add_clones, original_of, unlinked
from ...document.several_curves import named
from ...workbench.context import WindowContext
from ...workbench.highlight import highlighted_curves


def _has_clone(now: Situation) -> bool:
    curves = now.session.document.curves
    return any(curves[place].clone is not None for place in now.session.selected.highlight().curves)


_CLONE = Need("a clone", _has_clone)


class CloneCommands:
    """Makes clones and unlinks them."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @property
    def _places(self) -> list[int]:
        return sorted(highlighted_curves(self._context))

    @property
    def _clones(self) -> list[int]:
        curves = self._session.document.curves
        return [place for place in self._places if curves[place].clone is not None]

    @action(
        "clone", "Clone", EDIT_CLONES, "Alt+D", "link", needs=HIGHLIGHTED, keywords="linked copy instance"
    )
    @also(CURVE_MENU(14), CHOSEN_MENU(14))
    def _clone(self) -> None:
        """Add a copy that follows every change of its original; moved and turned it goes its own way."""
        session, places = self._session, self._places
        document = session.document
        added = add_clones(document, places, lambda: uuid4().hex)
        words = named(document, places)
        if session.change(f"Clone {words}", lambda _: added.document, active=added.places[-1]):
            session.selected.choose(added.places)
            session.say(f"A clone of {words} lies on it and is chosen; a drag moves it.")

    @action("unlinkClone", "Unlink Clone", EDIT_CLONES, "Alt+Shift+D", needs=_CLONE, keywords="linked copy")
    def _unlink(self) -> None:
        """Make the chosen clones curves of their own, which stay as they are."""
        session, clones = self._session, self._clones
        session.change(
            f"Unlink {named(session.document, clones)}", lambda document: unlinked(document, clones)
        )

    @action(
        "chooseOriginal", "Choose Original", EDIT_CLONES, "Shift+D", needs=_CLONE, keywords="clone select"
    )
    def _choose_original(self) -> None:
        """Choose what the chosen clones are clones of."""
        session = self._session
        found = {original_of(session.document, place) for place in self._clones} - {-1}
        if found:
            session.selected.choose(found)
            session.say(f"{named(session.document, found)} chosen.")


COMMAND_SETS = (CloneCommands,)
