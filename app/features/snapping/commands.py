"""Snapping, and how far arrow keys go, as the window's state has it."""

from __future__ import annotations

from ...actions.declaration import also, switch
from ...actions.sections import VIEW_DRAWING
from ...actions.strips import CANVAS_MENU, TOOLBAR
from ...state.window_state import WindowState
from ...tools.snapping import SnapKind, Snapping
from ...workbench.context import WindowContext


class SnapCommands:
    """Keeps the canvas in step with what was chosen about snapping and arrow keys."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)

    def _show_state(self, before: WindowState | None, state: WindowState) -> None:
        # Nobody would understand a snap to what is not seen.
        hidden = frozenset() if state.guides_shown else {SnapKind.GUIDES}
        snapping = Snapping(state.snap_on, state.snap_kinds - hidden)
        canvas = self._context.central.canvas
        canvas.change_tool_settings(snapping=snapping, nudge=state.nudge)
        if before is not None and (before.snap_on, before.snap_kinds) != (state.snap_on, state.snap_kinds):
            # What is dragged goes where it snaps to now.
            canvas.move_again()

    @switch("snap_on", "toggleSnap", "Snap", VIEW_DRAWING, "%", "magnet")
    @also(TOOLBAR(62), CANVAS_MENU(32))
    def _toggle(self) -> None:
        """Snap to grid, guides, page, points and curves, or not; also in mid-drag."""
        store = self._context.store
        # Another window may have remembered other kinds meanwhile.
        store.read_preferences()
        self._context.session.say(
            "Points snap now; % again: they move freely."
            if store.state.snap_on
            else "Points move freely now; % again: they snap."
        )


COMMAND_SETS = (SnapCommands,)
