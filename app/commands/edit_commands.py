"""History, points, family and parameters."""

from __future__ import annotations

from functools import partial

from PySide6.QtGui import QAction

from app.commands.parts import Handlers, Parts
from app.controllers.parametrization import use_parametrization
from app.document import edits
from app.document.model import ParametrizationKind
from app.families import FAMILIES, Family
from app.keymap import call_alone
from app.labels import menu_text
from app.view_model.curve_view import CurveView


class EditCommands:
    """What changes the document, or takes a change back."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._actions = parts.actions
        self._fill_parameters_menu()
        self._session.history_changed.connect(self._render_history)
        self._render_history()

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "undo": self._undo,
            "goBack": self._go_back,
            "redo": self._redo,
            "selectAll": self._select_all,
            "deleteSelection": self._delete_selection,
            **{family.action_name: partial(self._use_family, family) for family in FAMILIES},
            "freezeParameters": self._freeze_parameters,
            "useUniform": lambda: use_parametrization(self._session, ParametrizationKind.UNIFORM),
            "resetVelocities": self._reset_derivatives,
        }

    def render(self, view: CurveView) -> None:
        """Check and enable the actions."""
        chosen = self._session.selection
        for family in FAMILIES:
            self._actions[family.action_name].setChecked(family == view.source.family)
        has_curves = len(self._session.chosen_curves) > 1
        self._actions["deleteSelection"].setEnabled(bool(chosen) or has_curves)
        has_explicit = any(
            view.is_explicit(index, order, ahead=ahead)
            for index in chosen
            for order in (1, 2)
            for ahead in (False, True)
        )
        self._actions["resetVelocities"].setEnabled(has_explicit)
        self._actions["freezeParameters"].setEnabled(view.is_current and not view.source.is_manual)
        is_uniform = view.source.parametrization.kind is ParametrizationKind.UNIFORM
        self._actions["useUniform"].setEnabled(not is_uniform)

    def _fill_parameters_menu(self) -> None:
        menu = self._parts.parameters_menu
        below = menu.insertSeparator(menu.actions()[0])
        for kind in ParametrizationKind:
            action = QAction(kind.label, menu)
            action.setObjectName(f"parameters_{kind}")
            call_alone(action, f"{kind.label} Parameters")
            menu.insertAction(below, action)
            action.triggered.connect(
                lambda _checked=False, kind=kind: use_parametrization(self._session, kind)
            )

    def _render_history(self) -> None:
        stack = self._session.undo_stack
        for name, can, text in (
            ("undo", stack.canUndo(), stack.undoText()),
            ("redo", stack.canRedo(), stack.redoText()),
        ):
            verb = name.capitalize()
            self._actions[name].setEnabled(can)
            self._actions[name].setText(f"{verb}: {menu_text(text)}" if text else verb)
        self._actions["goBack"].setEnabled(self._session.beginning.before is not None)

    def _undo(self) -> None:
        # Undo in the middle of a drag takes the drag back, not the step before it.
        stack = self._session.undo_stack
        if not self._parts.cancel_gesture() and stack.canUndo():
            text = stack.undoText()
            stack.undo()
            self._session.say(f"Undone: {text}.")

    def _go_back(self) -> None:
        self._session.go_back()
        self._session.say("This is as you left it; Redo goes on.")

    def _redo(self) -> None:
        stack = self._session.undo_stack
        if stack.canRedo():
            text = stack.redoText()
            stack.redo()
            self._session.say(f"Redone: {text}.")

    def _use_family(self, family: Family) -> None:
        session = self._session
        was_closed = session.active_curve.is_closed
        session.change(
            f"Switch to {family.title}",
            lambda document: edits.set_family(document, session.active_index, family),
        )
        if was_closed and not session.active_curve.is_closed:
            closes = next(each.title for each in FAMILIES if each.can_close)
            session.say(
                f"A {family.title} curve cannot close smoothly; it is shown open, "
                f"and closes again as {closes}."
            )
        # The toggle shows what is, also where nothing changed.
        self.render(session.active_view)

    def _freeze_parameters(self) -> None:
        session = self._session
        parameters = session.active_view.parameters.tolist()
        session.change(
            "Freeze parameters",
            lambda document: edits.freeze_parameters(document, session.active_index, parameters),
        )

    def _select_all(self) -> None:
        self._session.select(range(len(self._session.active_curve.nodes)))

    def _delete_selection(self) -> None:
        session, chosen = self._session, self._session.selection
        if not chosen:
            if len(session.chosen_curves) > 1:
                self._actions["deleteCurve"].trigger()
            return
        what = f"point {next(iter(chosen))}" if len(chosen) == 1 else f"{len(chosen)} points"
        if session.change(
            f"Delete {what}", lambda document: edits.delete_nodes(document, session.active_index, chosen)
        ):
            session.select([])

    def _reset_derivatives(self) -> None:
        session, chosen = self._session, self._session.selection
        session.change(
            "Reset derivatives",
            lambda document: edits.estimate_derivatives(document, session.active_index, chosen),
        )
