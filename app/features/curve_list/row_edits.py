"""What is done to rows of the list: clicked, dragged and renamed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ...document.curve_edits import rename_curve
from ...document.group_edits import moved_into, named_anew
from ...document.groups import Node, NodeKind, whole_shapes
from ...document.limits import EditError
from ...document.model import Document
from ...document.several_curves import named, with_appearance
from ...document.style_edits import with_style
from ...session import Session
from ...tools.drag_machine import CANCELLED
from .dropping import Drop
from .panel import CurveList


class RowEdits:
    """Edits and choices that a person makes by rows of the list; each is about a node, or some curves."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def listen(self, panel: CurveList) -> None:
        """Do what the person means from now on."""
        panel.view.chosen_entry.connect(self._choose_entry)
        panel.view.rows_selected.connect(self._choose_rows)
        panel.view.moved.connect(self._move)
        panel.row_meant.connect(self._choose_meant)
        panel.model.name_edited.connect(self._set_name)
        panel.visible_switched.connect(lambda node: self.switch_visible_of(frozenset(node.places)))
        panel.locked_switched.connect(lambda node: self.switch_locked_of(frozenset(node.places)))
        panel.colour_chosen.connect(self._paint)
        panel.fill_chosen.connect(self._fill)
        panel.colour_looked_at.connect(self._look_at)
        panel.colour_given_up.connect(self._give_up)

    def _meant(self, places: frozenset[int]) -> frozenset[int]:
        """Return the curves that a click on a part of a row is about: all selected ones, or others."""
        selected = self._session.selected.curves
        return selected if places <= selected else places

    def _choose_entry(self, node: Node) -> None:
        """Choose what a row is about; while a curve is edited, edit that of the row, as the arrow does.

        A curve of an opened shape is chosen alone: whoever opened the shape wants a part of it.
        """
        selected = self._session.selected
        if node.kind is NodeKind.CURVE and selected.is_editing:
            selected.activate(node.places.start)
        elif node.kind is NodeKind.CURVE:
            selected.set_curves(node.places)
        else:
            selected.choose(node.places)

    def _choose_rows(self, places: frozenset[int]) -> None:
        """Choose these curves together; of none only those who edit one have to stay with it."""
        selected = self._session.selected
        if places or selected.is_editing:
            selected.set_curves(places)
        else:
            selected.choose(())

    def _choose_meant(self, node: Node) -> None:
        session, places = self._session, frozenset(node.places)
        active = session.active_index if session.active_index in places else max(places)
        session.selected.set_curves(self._meant(places), active)

    def switch_visible_of(self, places: frozenset[int]) -> None:
        """Hide curves with all that are selected with them, or show them where all are hidden."""
        visible = not any(self._session.committed.curves[place].visible for place in places)
        self._change_looks("Show" if visible else "Hide", places, partial(with_appearance, visible=visible))

    def switch_locked_of(self, places: frozenset[int]) -> None:
        """Lock curves with all that are selected with them, or free them where all are locked."""
        locked = not all(self._session.committed.curves[place].locked for place in places)
        self._change_looks("Lock" if locked else "Unlock", places, partial(with_appearance, locked=locked))

    def _paint(self, places: frozenset[int], code: str) -> None:
        self._change_looks("Colour", places, partial(with_appearance, colour=code))

    def _fill(self, places: frozenset[int], paint: str) -> None:
        self._change_looks("Fill", places, partial(with_style, fill=paint))

    def _look_at(self, places: frozenset[int], code: str) -> None:
        session = self._session
        session.preview(with_appearance(session.committed, self._meant(places), colour=code))

    def _give_up(self) -> None:
        if self._session.is_previewing:
            self._session.cancel()
            self._session.say(CANCELLED)

    def _change_looks(
        self, verb: str, places: frozenset[int], edit: Callable[[Document, frozenset[int]], Document]
    ) -> None:
        session = self._session
        curves = whole_shapes(session.committed, self._meant(places))
        session.change(f"{verb} {named(session.committed, curves)}", lambda document: edit(document, curves))

    def _move(self, node: Node, drop: Drop) -> None:
        session, before = self._session, self._session.committed
        curves = self._meant(frozenset(node.places))
        try:
            moved = moved_into(before, curves, drop.at, drop.container, node.around.groups)
        except EditError as reason:
            session.refuse(str(reason))
            return
        chosen = [moved.order.index(place) for place in session.selected.marked]
        active = moved.order.index(session.active_index)
        if (
            session.change(f"Reorder {named(before, curves)}", lambda _: moved.document, active=active)
            and chosen
        ):
            session.selected.set_curves(chosen, active)

    def _set_name(self, node: Node, name: str) -> None:
        def edit(document: Document) -> Document:
            if node.kind is NodeKind.CURVE:
                return rename_curve(document, node.places.start, name)
            return named_anew(document, node, name)

        self._session.change(f"Rename {node.kind.name.lower()}", edit)
