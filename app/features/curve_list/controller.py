"""Edits by the list of curves."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from app.document.edits import rename_curve
from app.document.model import Document
from app.document.several_curves import move_curves, named, place_in, with_looks
from app.features.curve_list.panel import CurveList
from app.session import Session


class CurveListController:
    """Turns what is clicked, dragged and typed in the list into changes of the document."""

    def __init__(self, session: Session, panel: CurveList) -> None:
        self._session = session
        panel.view.activated_row.connect(session.selected.activate)
        panel.view.rows_selected.connect(session.selected.set_curves)
        panel.view.moved.connect(self._move)
        panel.model.name_edited.connect(self._rename)
        panel.visible_switched.connect(self.switch_visible)
        panel.locked_switched.connect(self.switch_locked)
        panel.colour_chosen.connect(self._paint)
        panel.row_meant.connect(lambda row: session.selected.set_curves(self._meant(row), row))

    def _meant(self, row: int) -> frozenset[int]:
        """Return the curves that a click on a part of a row is about: all selected ones, or another."""
        selected = self._session.selected.curves
        return selected if row in selected else frozenset({row})

    def switch_visible(self, row: int) -> None:
        """Show or hide a curve; where it is selected, all that are."""
        visible = not self._session.committed.curves[row].visible
        self._change("Show" if visible else "Hide", row, partial(with_looks, visible=visible))

    def switch_locked(self, row: int) -> None:
        """Lock a curve or free it; where it is selected, all that are."""
        locked = not self._session.committed.curves[row].locked
        self._change("Lock" if locked else "Unlock", row, partial(with_looks, locked=locked))

    def _paint(self, row: int, code: str) -> None:
        self._change("Colour", row, partial(with_looks, colour=code))

    def _change(self, verb: str, row: int, edit: Callable[[Document, frozenset[int]], Document]) -> None:
        session, curves = self._session, self._meant(row)
        session.change(f"{verb} {named(session.committed, curves)}", lambda document: edit(document, curves))

    def _move(self, row: int, to: int) -> None:
        session, curves = self._session, self._meant(row)
        document = move_curves(session.committed, curves, row, to)
        active = place_in(document, session.committed.curves[session.active_index])
        session.change(f"Reorder {named(session.committed, curves)}", lambda _: document, active=active)

    def _rename(self, row: int, name: str) -> None:
        self._session.change("Rename curve", lambda document: rename_curve(document, row, name))
