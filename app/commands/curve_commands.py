"""Whole curves, one at a time: new, join, split, reverse, close, name and order."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from app.commands.parts import Handlers, Parts
from app.document import curve_edits, edits
from app.document.edits import EditError
from app.document.model import Curve, Document, Parametrization
from app.document.several_curves import named, place_in, step_curves
from app.view_model.closing import with_closed
from app.view_model.curve_view import CurveView, view_of
from app.view_model.measure import is_kept
from app.view_model.reshape import Reshaped, reversed_curve, with_point_inserted
from app.view_model.split_join import joined, split

CURVE_LIST_BUTTONS = (
    "newCurve", "duplicateCurve", "deleteCurve", "joinCurve", "splitCurve", "reverseCurve", "closeCurve",
)  # fmt: skip
"""The actions that stand as buttons under the list of curves."""


class CurveCommands:
    """What is done to a curve as a whole."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._actions = parts.actions
        # The step is known to the history only after the document has been shown.
        self._session.history_changed.connect(self._render_again)

    def _render_again(self) -> None:
        self.render(self._session.active_view)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "insertPoint": lambda: self._at_scrub(self.insert_at),
            "keepShape": self._keep_shape,
            "newCurve": self._new,
            "joinCurve": self._join,
            "splitCurve": self._split,
            "reverseCurve": self._reverse,
            "closeCurve": self._toggle_closed,
            "renameCurve": self._rename,
            "raiseCurve": lambda: self._step("Raise", 1),
            "lowerCurve": lambda: self._step("Lower", -1),
            "nextCurve": lambda: self._walk(-1),
            "previousCurve": lambda: self._walk(1),
        }

    def render(self, view: CurveView) -> None:
        """Check and enable the actions."""
        actions, curve = self._actions, view.source
        index, count = self._session.active_index, len(self._session.document.curves)
        actions["closeCurve"].setChecked(curve.is_closed)
        for name in ("splitCurve", "insertPoint"):
            actions[name].setEnabled(view.is_current and not curve.locked)
        actions["keepShape"].setEnabled(self._session.offered_at is not None)
        actions["joinCurve"].setEnabled(view.is_current and count > 1)
        actions["reverseCurve"].setEnabled(len(curve.nodes) > 1)
        chosen = len(self._session.chosen_curves)
        actions["raiseCurve"].setEnabled(1 < chosen < count or (chosen == 1 and index < count - 1))
        actions["lowerCurve"].setEnabled(1 < chosen < count or (chosen == 1 and index > 0))
        for name in ("nextCurve", "previousCurve"):
            actions[name].setEnabled(count > 1)

    # Number and order

    def _new(self) -> None:
        session = self._session
        model, place = session.active_curve, session.active_index + 1
        fresh = curve_edits.fresh_curve(session.document, model, Parametrization())
        if session.change(
            f"New {fresh.name}", lambda document: curve_edits.add_curve(document, place, fresh), active=place
        ):
            self._actions["addTool"].trigger()

    def _step(self, verb: str, step: int) -> None:
        session, what = self._session, named(self._session.document, self._session.chosen_curves)
        document = step_curves(session.document, session.chosen_curves, step)
        if session.change(
            f"{verb} {what}", lambda _: document, active=place_in(document, session.active_curve)
        ):
            where = "front" if step > 0 else "back"
            session.say(f"{what}: one step to the {where}.")

    def _walk(self, step: int) -> None:
        # The next one is the one below in the list, hence behind.
        session = self._session
        session.activate((session.active_index + step) % len(session.document.curves))
        session.say(f"Editing “{session.active_curve.name}”.")

    # Shape

    def insert_at(self, t: float) -> None:
        """Insert a point on the active curve at `t`."""
        view = self._session.active_view
        index = int(np.searchsorted(view.parameters, t))
        made = self._reshape(f"Insert point {index}", lambda: with_point_inserted(view, t))
        if made is not None:
            self._session.select([index])
            if made.parameters_moved:
                self._session.offer(made.sentence, "keepShape", t)

    def _keep_shape(self) -> None:
        """Do the insertion again that has just moved the parameters, with the parameters frozen before it."""
        session, t = self._session, self._session.offered_at
        if t is None:
            return
        session.undo_stack.undo()
        view, index = session.active_view, int(np.searchsorted(session.active_view.parameters, t))
        frozen = edits.freeze_parameters(session.document, session.active_index, view.parameters.tolist())
        fixed = view_of(frozen.curves[session.active_index])
        if self._reshape(f"Freeze and insert point {index}", lambda: with_point_inserted(fixed, t)):
            session.select([index])
        else:
            session.undo_stack.redo()

    def split_at(self, t: float) -> None:
        """Split the active curve at `t`."""
        session, index = self._session, self._session.active_index
        try:
            done = split(session.active_view, t)
        except EditError as reason:
            session.refuse(str(reason))
            return
        first, *others = done.curves
        self._say_if(
            session.change(
                f"Split {session.active_curve.name}",
                lambda document: _with_parts(document, index, first, others),
            ),
            f"{'Split' if others else 'Opened'} at t = {t:.4g}: {done.sentence}",
        )

    def _split(self) -> None:
        session, chosen = self._session, self._session.selected
        view = session.active_view
        if chosen is not None and (view.source.is_closed or 0 < chosen < len(view.source.nodes) - 1):
            self.split_at(float(view.parameters[chosen]))
        else:
            self._at_scrub(self.split_at)

    def _at_scrub(self, act: Callable[[float], None]) -> None:
        t = self._session.scrub
        if t is None:
            self._session.refuse(
                "Select an inner point, or put the scrub line (T) where on the curve it shall be."
            )
        else:
            act(t)

    def _join(self) -> None:
        session, index = self._session, self._session.active_index
        partner = self._nearest_start()
        if partner is None:
            session.refuse("There is no other open, visible curve whose start could follow.")
            return
        name = session.document.curves[partner].name
        made = self._reshape(
            f"Join {session.active_curve.name} and {name}",
            lambda: joined(session.active_view, session.views[partner]),
            lambda document: curve_edits.remove_curve(document, partner),
            active=index - (partner < index),
        )
        if made is not None:
            shapes = "shapes kept" if is_kept(made.residual, (made.curve,)) else "the shapes are others"
            session.say(f"Joined with “{name}”: {shapes}, largest change {made.residual:.2g}.")

    def _nearest_start(self) -> int | None:
        """Return the open visible curve whose start is nearest to the end of the active one."""
        views, active = self._session.views, self._session.active_index
        end = views[active].points[-1]
        others = [
            (float(np.hypot(*(view.points[0] - end))), place)
            for place, view in enumerate(views)
            if place != active and view.source.visible and view.is_current and not view.source.is_closed
        ]
        return min(others)[1] if others else None

    def _reverse(self) -> None:
        view = self._session.active_view
        if not view.is_current:
            self._session.refuse(f"There is no curve to reverse. {view.problem}")
            return
        if self._reshape(f"Reverse {view.source.name}", lambda: reversed_curve(view)) is not None:
            self._session.select([])

    def _toggle_closed(self) -> None:
        session, view = self._session, self._session.active_view
        closed = not view.source.is_closed
        session.change(
            f"{'Close' if closed else 'Open'} {view.source.name}",
            lambda document: with_closed(document, session.active_index, view, closed),
        )
        # The switch shows what is, also where nothing changed.
        self.render(session.active_view)

    def _reshape(
        self,
        text: str,
        make: Callable[[], Reshaped],
        then: Callable[[Document], Document] = lambda document: document,
        *,
        active: int | None = None,
    ) -> Reshaped | None:
        """Put what `make` returns in the place of the active curve, and say what that changed."""
        session = self._session
        try:
            made = make()
        except EditError as reason:
            session.refuse(str(reason))
            return None
        if not session.change(
            text,
            lambda document: then(curve_edits.replace_curve(document, session.active_index, made.curve)),
            active=active,
        ):
            return None
        session.say(made.sentence)
        return made

    def _rename(self) -> None:
        dock = next(each for each in self._parts.docks if each.objectName() == "curvesDock")
        dock.show()
        dock.raise_()
        self._parts.curve_list.view.edit_name(self._session.active_index)

    def _say_if(self, done: object, text: str) -> None:
        if done:
            self._session.say(text)


def _with_parts(document: Document, index: int, first: Curve, others: list[Curve]) -> Document:
    document = curve_edits.replace_curve(document, index, first)
    for offset, curve in enumerate(others, start=1):
        document = curve_edits.add_curve(document, index + offset, curve)
    return document
