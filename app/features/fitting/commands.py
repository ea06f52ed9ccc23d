"""How near the pencil comes, and fewer points for a curve."""

from __future__ import annotations

from ...actions.declaration import Action, action_for_each
from ...actions.keymap import action_name
from ...actions.sections import EDIT_PENCIL
from ...state.window_state import WindowState
from ...tools.pencil_detail import PencilDetail
from ...workbench.context import WindowContext


class PencilCommands:
    """Keeps the pencil in step with what was chosen about it."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)

    def _show_state(self, _before: WindowState | None, state: WindowState) -> None:
        self._context.central.canvas.change_tool_settings(pencil=state.pencil)

    @action_for_each(
        tuple(PencilDetail),
        lambda detail: Action(
            action_name("pencil", detail),
            detail.label,
            EDIT_PENCIL,
            tip=f"The pencil's curves are at most {detail.pixels:g} pixels from the line that was drawn",
            full_name=f"Pencil: {detail.label}",
            checked=lambda now: now.state.pencil is detail,
            group="pencil",
        ),
    )
    def _choose_detail(self, detail: PencilDetail) -> None:
        self._context.store.change(pencil=detail)
        self._context.session.say(f"Pencil: {detail.label}.")


COMMAND_SETS = (PencilCommands,)
