"""What a click of the pen makes, as the window's state has it."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.sections import EDIT_PEN
from ...actions.strips import CANVAS_MENU
from ...state.window_state import WindowState
from ...tools.pen_click import PenClick
from ...workbench.context import WindowContext


class PenCommands:
    """Keeps the pen in step with what was chosen about it."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._show_state(None, context.store.state)
        context.store.changed.connect(self._show_state)

    def _show_state(self, before: WindowState | None, state: WindowState) -> None:
        canvas = self._context.central.canvas
        canvas.change_tool_settings(pen=state.pen)
        if before is not None and before.pen is not state.pen:
            canvas.hover_again()

    @action(
        "togglePenCorners",
        "Pen Makes Corners",
        EDIT_PEN,
        "Shift+P",
        "point-corner",
        checked=lambda now: now.state.pen.makes_corners(now.session.document),
        keywords="click cusp straight lines polygon polyline smooth points bezier bézier",
    )
    @also(CANVAS_MENU(23))
    def _toggle(self) -> None:
        """Let clicks of the pen make corners with straight lines, or smooth points; Alt+click: the other."""
        session, store = self._context.session, self._context.store
        is_on = not store.state.pen.makes_corners(session.document)
        store.change(pen=PenClick.CORNERS if is_on else PenClick.SMOOTH)
        session.say(
            "The pen's clicks make corners with straight lines; drags pull handles out, Alt+click is smooth."
            if is_on
            else "The pen's clicks make smooth points with estimated tangents; Alt+click: a straight line."
        )


COMMAND_SETS = (PenCommands,)
