"""Display modes of the canvas: thin lines to edit, paper as it prints."""

from __future__ import annotations

from ...actions.declaration import action, switch
from ...actions.sections import VIEW_MODE
from ...appearance.theme import LIGHT, Theme
from ...canvas.looks import Looks
from ...state.window_state import WindowState
from ...workbench.context import WindowContext


class StyleViewCommands:
    """Switches of the canvas."""

    def __init__(self, context: WindowContext) -> None:
        self._store, self._canvas = context.store, context.central.canvas
        self._session, self._theme = context.session, LIGHT
        self._store.changed.connect(self._show_state)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`, unless the paper is as it prints."""
        self._theme = theme
        self._show_paper()

    def show_document(self) -> None:
        """Show paper and lines as the window has them."""
        self._show_paper()
        self._show_looks()

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.thin_lines != before.thin_lines:
            self._show_looks()
        self._show_paper()

    def _show_looks(self) -> None:
        self._canvas.drawing.curves.set_looks(Looks(self._store.state.thin_lines))

    def _show_paper(self) -> None:
        wanted, layers = self._store.state.paper(self._theme), self._canvas.layers
        if layers.theme is not wanted:
            self._canvas.set_paper(wanted)

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

    @action(
        "paperAsPrinted",
        "Paper as Printed",
        VIEW_MODE,
        checked=lambda now: now.state.as_printed,
        keywords="white light dark exact colours proof page",
    )
    def _switch_paper(self) -> None:
        """Show white paper and the very colours that were chosen."""
        self._store.change(as_printed=not self._store.state.as_printed)
