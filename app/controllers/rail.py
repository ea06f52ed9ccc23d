"""Edits by typing at the t-rail, and selection by its menu."""

from __future__ import annotations

from app.document.edits import set_parameter
from app.panels.basis_panel import BasisPanel
from app.session import Session


class RailController:
    """Turns a t that was typed at a tick into a change of the active curve."""

    def __init__(self, session: Session, panel: BasisPanel) -> None:
        self._session, self._panel = session, panel
        panel.tick_edit.typed.connect(self._set_parameter)
        panel.tick_pointed.connect(self._select)

    def _set_parameter(self, knot: int, t: float) -> None:
        session, view = self._session, self._session.active_view
        if knot < len(view.parameters):
            change = session.change(
                f"Change t of point {view.owner(knot)}",
                lambda document: set_parameter(
                    document, session.active_index, knot, t, session.active_view.parameters.tolist()
                ),
            )
            if change.refusal:
                self._panel.tick_edit.refuse(change.refusal)
                return
        self._panel.tick_edit.close_and_return()

    def _select(self, point: int) -> None:
        """Select a point whose tick the menu is about, unless it is among those selected already."""
        if point not in self._session.selection:
            self._session.selected.set_points([point])
