"""Texts and pictures of other programs on the canvas: shown and hidden."""

from __future__ import annotations

from ...actions.declaration import switch
from ...actions.needs import Need
from ...actions.sections import VIEW_MODE
from ...document.kept_edits import seen_kept
from ...state.window_state import WindowState
from ...workbench.context import WindowContext

_KEPT = Need(
    "a text or a picture of another program",
    lambda now: bool(now.session.document.kept_texts or now.session.document.kept_pictures),
)


class KeptCommands:
    """Keeps the canvas in step with what the document shows and nobody edits here."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._store = context.session, context.store
        self._canvas = context.central.canvas
        self._store.changed.connect(self._show_state)
        self.show_document()

    def show_document(self) -> None:
        """Show the texts and pictures of the document."""
        self._canvas.drawing.set_kept(*seen_kept(self._session.document))

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.kept_shown != before.kept_shown:
            for layer in self._canvas.drawing.kept:
                layer.set_shown(after.kept_shown)

    @switch(
        "kept_shown",
        "toggleKept",
        "Texts and Pictures of the File",
        VIEW_MODE,
        icon="image",
        full_name="Show Texts and Pictures of the File",
        needs=_KEPT,
        keywords="svg inkscape kept text image hide",
    )
    def _toggle_kept(self) -> None:
        """Show or hide the texts and pictures that came with the file, and are edited elsewhere."""


COMMAND_SETS = (KeptCommands,)
