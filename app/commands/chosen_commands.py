"""What is done to all chosen curves: duplicate, delete, show, lock, colour; and choosing them."""

from __future__ import annotations

from app.colours import CURVE_COLOURS
from app.commands.parts import Handlers, Parts
from app.controllers.curve_list import CurveListController
from app.document.several_curves import active_after_removal, add_copies, named, remove_curves
from app.view_model.curve_view import CurveView

_VERBS = {"duplicateCurve": "Duplicate", "deleteCurve": "Delete"}


class ChosenCommands:
    """What works on several curves as on one."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._actions = parts.actions
        self._list = CurveListController(parts.session, parts.curve_list)
        parts.curve_list.view.deletion_wanted.connect(parts.actions["deleteCurve"].trigger)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        session, panel = self._session, self._parts.curve_list
        return {
            "duplicateCurve": self._duplicate,
            "deleteCurve": self._delete,
            "curveVisible": lambda: self._list.switch_visible(session.active_index),
            "curveLocked": lambda: self._list.switch_locked(session.active_index),
            "curveColour": lambda: panel.choose_colour(session.active_index),
            "selectAllCurves": self._choose_all,
            "onlyThisCurve": self._choose_one,
        }

    def render(self, view: CurveView) -> None:
        """Check and enable the actions, and say how many curves they are about."""
        actions, count = self._actions, len(self._session.chosen_curves)
        actions["curveVisible"].setChecked(view.source.visible)
        actions["curveLocked"].setChecked(view.source.locked)
        actions["selectAllCurves"].setEnabled(count < len(self._session.document.curves))
        actions["onlyThisCurve"].setEnabled(count > 1)
        for name, verb in _VERBS.items():
            actions[name].setText(f"{verb} {count} Curves" if count > 1 else f"{verb} Curve")

    # Choosing

    def _choose_all(self) -> None:
        session = self._session
        session.choose_curves(range(len(session.document.curves)))
        session.say(f"{named(session.document, session.chosen_curves)} chosen.")

    def _choose_one(self) -> None:
        self._session.choose_curves((self._session.active_index,))

    # Number

    def _duplicate(self) -> None:
        session, chosen = self._session, self._session.chosen_curves
        document, order = session.document, sorted(chosen)
        colours = self._next_colours([document.curves[place].colour for place in order])
        first, active = order[-1] + 1, order.index(session.active_index)
        if not session.change(
            f"Duplicate {named(document, chosen)}",
            lambda document: add_copies(document, order, colours),
            active=first + active,
        ):
            return
        if len(order) == 1:
            copy = session.active_curve
            session.select(range(len(copy.nodes)))
            session.say(
                f"“{copy.name}” lies on the original; all its points are selected, drag one to move it."
            )
            return
        session.choose_curves(range(first, first + len(order)))
        session.say(f"{len(order)} copies lie on the originals and are chosen; drag one, or G, moves them.")

    def _next_colours(self, colours: list[str]) -> list[str]:
        """Return for each the next colour of the palette that no curve has; what is in ink stays in ink."""
        codes = [code for code in CURVE_COLOURS.values() if code]
        used = {curve.colour for curve in self._session.document.curves}
        found = []
        for colour in colours:
            start = codes.index(colour) + 1 if colour in codes else 0
            others = [*codes[start:], *codes[:start]]
            free = next((code for code in others if code not in used), others[0])
            found.append(free if colour else colour)
            used.add(found[-1])
        return found

    def _delete(self) -> None:
        session, chosen = self._session, self._session.chosen_curves
        document = session.document
        session.change(
            f"Delete {named(document, chosen)}",
            lambda document: remove_curves(document, chosen),
            active=active_after_removal(document, chosen, session.active_index),
        )
