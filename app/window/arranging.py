"""What stands around the canvas follows the kind of document that is open."""

from __future__ import annotations

from PySide6.QtCore import QObject

from ..document.paper import DocumentKind, kind_of
from ..state.window_state import WindowState
from ..workbench.context import WindowContext


class Arranging(QObject):
    """Arranges the window for sketches and for drawings, each as the person has left it.

    Only when another document is opened: nothing is moved around the hands of one who gives it a page.
    """

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._store = context, context.store
        # The kind that the docks are arranged for; behind while nobody sees them.
        self._arranged: DocumentKind | None = None
        context.session.opened.connect(self._follow_document)
        self._store.changed.connect(self._show_state)

    def restore(self) -> None:
        """Arrange the docks as they were in documents of this kind, when the layout was restored."""
        state = self._store.state
        if state.arrangement.docks is None and state.drawings.docks is None and not self._is_drawing:
            # As long as there was no drawing, the layout is that of sketches.
            self._arranged = state.kind
            return
        self._arrange()

    def note(self) -> None:
        """Take note of the docks in front, for the next document of this kind."""
        docks = self._context.docks.brought_up if self._are_docks_seen else None
        if docks is not None and self._arranged is self._store.state.kind:
            self._store.change(docks=docks)

    @property
    def _is_drawing(self) -> bool:
        return self._store.state.kind is DocumentKind.DRAWING

    @property
    def _are_docks_seen(self) -> bool:
        state = self._store.state
        return state.side_panel and not state.presentation

    def _follow_document(self) -> None:
        kind = kind_of(self._context.session.document)
        if kind is not self._store.state.kind:
            self.note()
            self._store.change(kind=kind)
            # Now, and not when the event loop gets to it: what is shown is fitted to the room that there is.
            self._context.central.splitter.refresh()

    def _show_state(self, _before: WindowState, state: WindowState) -> None:
        if self._arranged is not state.kind and self._are_docks_seen:
            self._arrange()

    def _arrange(self) -> None:
        state = self._store.state
        self._arranged = state.kind
        self._context.docks.bring_up(state.arrangement.docks, state.kind)
