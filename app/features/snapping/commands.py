"""Snapping, and how far arrow keys go, as the window's state has it."""

from __future__ import annotations

from msgspec.structs import replace

from ...actions.declaration import action, also
from ...actions.sections import VIEW_DRAWING
from ...actions.strips import CANVAS_MENU, TOOLBAR
from ...document.paper import DocumentKind
from ...state.window_state import WindowState
from ...tools.snapping import SnapKind
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
        snapping = replace(state.snapping, kinds=state.snapping.kinds - hidden)
        canvas = self._context.central.canvas
        canvas.change_tool_settings(snapping=snapping, nudge=state.nudge)
        if before is not None and before.snapping != state.snapping:
            # What is dragged goes where it snaps to now.
            canvas.move_again()

    @action(
        "toggleSnap",
        "Snap",
        VIEW_DRAWING,
        "%",
        "magnet",
        checked=lambda now: now.state.snapping.on,
    )
    @also(TOOLBAR(62), CANVAS_MENU(32))
    def _toggle(self) -> None:
        """Snap to grid, guides, page, points and curves, or not; also in mid-drag."""
        store = self._context.store
        # Another window may have remembered other kinds meanwhile.
        store.read_preferences()
        on = not store.state.snapping.on
        store.change(**{"page_snap_on" if store.state.kind is DocumentKind.DRAWING else "snap_on": on})
        self._context.session.say(
            "Points snap now; % again: they move freely."
            if on
            else "Points move freely now; % again: they snap."
        )


COMMAND_SETS = (SnapCommands,)
