"""Snapping, and how far arrow keys go, as the window's state has it."""

from __future__ import annotations

from msgspec.structs import replace

from ...actions.declaration import Action, action, action_for_each, also
from ...actions.menus import CANVAS_MENU, SNAP_MENU, TOOLBAR, VIEW_SNAP, VIEW_SNAP_TO
from ...state.window_state import WindowState
from ...tools.snapping import SnapKind
from ...workbench.context import WindowContext


class SnapCommands:
    """Keeps the canvas in step with what was chosen about snapping."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)

    def _show_state(self, before: WindowState | None, state: WindowState) -> None:
        # Nobody would understand a snap to what is not seen.
        shown = {SnapKind.GRID: state.grid, SnapKind.GUIDES: state.guides_shown}
        hidden = {kind for kind, is_shown in shown.items() if not is_shown}
        snapping = replace(state.snapping, kinds=state.snapping.kinds - hidden)
        canvas = self._context.central.canvas
        canvas.change_tool_settings(snapping=snapping)
        if before is not None and before.snapping != state.snapping:
            # What is dragged goes where it snaps to now.
            canvas.move_again()

    @action(
        "toggleSnap",
        "Snap",
        VIEW_SNAP,
        "%",
        "magnet",
        checked=lambda state: state.window.snapping.on,
        choices=SNAP_MENU,
    )
    @also(TOOLBAR(62), CANVAS_MENU(32))
    def _toggle(self) -> None:
        """Snap to grid, guides, points and curves, or not; also in mid-drag."""
        store = self._context.store
        # Another window may have remembered other kinds meanwhile.
        store.read_preferences()
        on = not store.state.snapping.on
        store.change(snap_on=on)
        self._context.session.say(
            "Points snap now; % again: they move freely."
            if on
            else "Points move freely now; % again: they snap."
        )

    @action_for_each(
        tuple(SnapKind),
        lambda kind: Action(
            f"snapTo{kind.value.capitalize()}",
            kind.label,
            VIEW_SNAP_TO,
            tip=f"What snaps is drawn to this: {kind.label.lower()}",
            full_name=f"Snap To: {kind.label}",
            checked=lambda state: kind in state.window.snapping.kinds,
            keywords="magnet",
        ),
    )
    @also(SNAP_MENU(10))
    def _toggle_kind(self, kind: SnapKind) -> None:
        store = self._context.store
        store.read_preferences()
        kinds = store.state.snapping.kinds ^ {kind}
        store.change(snap_kinds=kinds)
        is_on, what = kind in kinds, kind.label.lower()
        does = f"Points snap to this now: {what}." if is_on else f"Points snap to this no longer: {what}."
        self._context.session.say(does if store.state.snapping.on else f"{does} % turns snapping on.")


COMMAND_SETS = (SnapCommands,)
