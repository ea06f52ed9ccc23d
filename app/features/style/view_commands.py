"""Display modes of the canvas: thin lines to edit, paper as it prints."""

from __future__ import annotations

from ...actions.declaration import switch
from ...actions.sections import VIEW_MODE
from ...appearance.theme import LIGHT, PRINTED, Theme
from ...state.window_state import WindowState
from ...workbench.context import WindowContext


class StyleViewCommands:
    """Switches of the canvas."""

    def __init__(self, context: WindowContext) -> None:
        self._store, self._canvas = context.store, context.central.canvas
        self._session, self._theme = context.session, LIGHT
        self._store.changed.connect(self._show_state)
        self._canvas.drawing.curves.set_thin(self._store.state.thin_lines)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`, unless the paper is as it prints."""
        self._theme = theme
        self._show_paper(self._store.state)

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.thin_lines != before.thin_lines:
            self._canvas.drawing.curves.set_thin(after.thin_lines)
        if after.as_printed != before.as_printed:
            self._show_paper(after)

    def _show_paper(self, state: WindowState) -> None:
        wanted = PRINTED if state.as_printed else self._theme
        if self._canvas.layers.theme is not wanted:
            self._canvas.set_theme(wanted)

    @switch(
        "thin_lines",
        "thinLines",
        "Thin Lines",
        VIEW_MODE,
        "Ctrl+5",
        keywords="outline wireframe mode without fills widths",
    )
    def _switch_thin_lines(self) -> None:
        """Show every curve as a thin line without its fill, to edit what lies below others."""
        thin = self._store.state.thin_lines
        self._session.say("Thin lines, without fills." if thin else "Lines and fills as they print.")

    @switch(
        "as_printed",
        "paperAsPrinted",
        "Paper as Printed",
        VIEW_MODE,
        keywords="white light exact colours proof page",
    )
    def _switch_paper(self) -> None:
        """Show light paper and the very colours that were chosen, also such as can hardly be seen."""
