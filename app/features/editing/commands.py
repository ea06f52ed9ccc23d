"""History, points, family and parameters."""

from __future__ import annotations

from app.actions.declaration import Action, action, action_for_each
from app.actions.needs import SELECTED_POINTS, Need
from app.actions.sections import (
    CURVE_FAMILY,
    CURVE_PARAMETERS,
    CURVE_RULES,
    CURVE_VELOCITIES,
    EDIT_DELETE,
    EDIT_HISTORY,
    EDIT_SELECT,
    FILE_BACK,
)
from app.actions.situation import Situation
from app.controllers.parametrization import use_parametrization
from app.document import edits
from app.document.model import ParametrizationKind
from app.families import FAMILIES, Family
from app.qt.labels import menu_text
from app.storage.resources import has_resource
from app.workbench.context import WindowContext

_MOST_KEYS = 10
"""One more than there are digits for."""


def _key_of(family: Family) -> str:
    """Return the digit of a family's place, for as many as there are digits."""
    place = list(FAMILIES).index(family) + 1
    return str(place) if place < _MOST_KEYS else ""


def _has_explicit(now: Situation) -> bool:
    """Whether a selected point has a derivative that was set by hand."""
    return any(
        now.view.is_explicit(index, order, ahead=ahead)
        for index in now.selection
        for order in (1, 2)
        for ahead in (False, True)
    )


def _titled(verb: str, step: str) -> str:
    return f"{verb}: {menu_text(step)}" if step else verb


class EditCommands:
    """What changes the document, or takes a change back."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session

    @action(
        "undo",
        "Undo",
        EDIT_HISTORY,
        "Ctrl+Z",
        "undo",
        needs=Need("a step to take back", lambda now: now.session.undo_stack.canUndo()),
        title=lambda now: _titled("Undo", now.session.undo_stack.undoText()),
        during_gesture=True,
    )
    def _undo(self) -> None:
        """Take the last step back."""
        # Undo in the middle of a drag takes the drag back, not the step before it.
        stack = self._session.undo_stack
        if not self._context.cancel_gesture() and stack.canUndo():
            text = stack.undoText()
            stack.undo()
            self._session.say(f"Undone: {text}.")

    @action(
        "goBack",
        "Go Back",
        FILE_BACK,
        icon="history",
        full_name="Go Back to What Was Before the Lesson",
        needs=Need(
            "work that was left for a lesson or an example",
            lambda now: now.session.files.beginning.before is not None,
        ),
    )
    def _go_back(self) -> None:
        """Go back to what was there before this lesson or example; Redo comes here again."""
        self._session.files.go_back()
        self._session.say("This is as you left it; Redo goes on.")

    @action(
        "redo",
        "Redo",
        EDIT_HISTORY,
        "Ctrl+Shift+Z, Ctrl+Y",
        "redo",
        needs=Need("a step that was taken back", lambda now: now.session.undo_stack.canRedo()),
        title=lambda now: _titled("Redo", now.session.undo_stack.redoText()),
    )
    def _redo(self) -> None:
        """Do the step again."""
        stack = self._session.undo_stack
        if stack.canRedo():
            text = stack.redoText()
            stack.redo()
            self._session.say(f"Redone: {text}.")

    @action_for_each(
        FAMILIES,
        lambda family: Action(
            family.action_name,
            family.label,
            CURVE_FAMILY,
            _key_of(family),
            family.icon if has_resource("icons", f"{family.icon}.svg") else "spline",
            family.tip,
            checked=lambda now: now.view.source.family == family,
            group="family",
        ),
    )
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
                f"{family.subject} cannot close smoothly; it is shown open, and closes again as {closes}."
            )

    @action_for_each(
        tuple(ParametrizationKind),
        lambda kind: Action(
            f"parameters_{kind}",
            kind.label,
            CURVE_RULES,
            tip=f"Use {kind.label.lower()} parameters",
            full_name=f"{kind.label} Parameters",
        ),
    )
    def _use_parametrization(self, kind: ParametrizationKind) -> None:
        use_parametrization(self._session, kind)

    @action(
        "freezeParameters",
        "Freeze Parameters",
        CURVE_PARAMETERS,
        icon="lock",
        needs=Need(
            "parameters that a rule gives", lambda now: now.view.is_current and not now.view.source.is_manual
        ),
    )
    def _freeze_parameters(self) -> None:
        """Keep the parameters as they are: make them manual."""
        session = self._session
        parameters = session.active_view.parameters.tolist()
        session.change(
            "Freeze parameters",
            lambda document: edits.freeze_parameters(document, session.active_index, parameters),
        )

    @action(
        "useUniform",
        "Use Uniform Parameters",
        CURVE_PARAMETERS,
        icon="spline",
        needs=Need(
            "parameters that are not uniform",
            lambda now: now.view.source.parametrization.kind is not ParametrizationKind.UNIFORM,
        ),
    )
    def _use_uniform(self) -> None:
        """Space the parameters evenly, wherever the points lie."""
        use_parametrization(self._session, ParametrizationKind.UNIFORM)

    @action("selectAll", "Select All", EDIT_SELECT, "Ctrl+A", "select-all", full_name="Select All Points")
    def _select_all(self) -> None:
        """Select all points."""
        self._session.selected.set_points(range(len(self._session.active_curve.points)))

    @action(
        "deleteSelection",
        "Delete",
        EDIT_DELETE,
        "Del, Backspace",
        "delete",
        full_name="Delete Points",
        needs=SELECTED_POINTS,
    )
    def _delete_selection(self) -> None:
        """Delete the selected points."""
        session, selected = self._session, self._session.selection
        if not selected:
            if len(session.selected.curves) > 1:
                self._context.actions["deleteCurve"].trigger()
            return
        what = f"point {next(iter(selected))}" if len(selected) == 1 else f"{len(selected)} points"
        if session.change(
            f"Delete {what}", lambda document: edits.delete_points(document, session.active_index, selected)
        ):
            session.selected.set_points([])

    @action(
        "resetVelocities",
        "Reset Derivatives to Estimated",
        CURVE_VELOCITIES,
        icon="reset",
        needs=Need("selected points with a velocity or an acceleration that was set", _has_explicit),
    )
    def _reset_derivatives(self) -> None:
        """Let the rules estimate the velocities and accelerations of the selected points again."""
        session, selected = self._session, self._session.selection
        session.change(
            "Reset derivatives",
            lambda document: edits.estimate_derivatives(document, session.active_index, selected),
        )


COMMAND_SETS = (EditCommands,)
