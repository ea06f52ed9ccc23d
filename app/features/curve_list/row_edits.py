"""What is done to rows of the list: clicked, dragged and renamed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ...document.curve_tree import Node, NodeKind
from ...document.edits import EditError, rename_curve
from ...document.layers import layer_of, looks_of, moved_layers, whole_layers, with_layer_looks
from ...document.model import Document
from ...document.several_curves import named, with_appearance
from ...document.shape_edits import Gathered, moved_into, named_anew
from ...document.shapes import whole_shapes
from ...document.style_edits import with_style
from ...document.words import names_of
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
        panel.visible_switched.connect(self.switch_row_visible)
        panel.locked_switched.connect(self.switch_row_locked)
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

        A curve of an opened shape is chosen alone: whoever opened the shape wants a part of it. A layer
        becomes the present one, and nothing is chosen: whoever goes to a layer wants to draw in it.
        """
        selected = self._session.selected
        if node.kind is NodeKind.CURVE and selected.is_editing:
            selected.activate(node.places.start)
        elif node.kind is NodeKind.CURVE:
            selected.set_curves(node.places)
        else:
            selected.choose(() if node.kind is NodeKind.LAYER else node.places)
        if node.kind is NodeKind.LAYER:
            selected.set_layer(node.name)

    def _choose_rows(self, places: frozenset[int]) -> None:
        """Choose these curves together; of none only those who edit one have to stay with it."""
        selected = self._session.selected
        if places or selected.is_editing:
            selected.set_curves(places)
        else:
            selected.choose(())

    def _choose_meant(self, node: Node) -> None:
        session, places = self._session, frozenset(node.places)
        if node.kind is NodeKind.LAYER:
            self._choose_entry(node)
            return
        active = session.active_index if session.active_index in places else max(places)
        session.selected.set_curves(self._meant(places), active)

    def switch_row_visible(self, node: Node) -> None:
        """Hide what a row is about, or show it."""
        if node.kind is not NodeKind.LAYER:
            self.switch_visible_of(frozenset(node.places))
            return
        visible, _ = looks_of(self._session.committed, node)
        self._change_layer("Hide" if visible else "Show", node, visible=not visible)

    def switch_row_locked(self, node: Node) -> None:
        """Lock what a row is about, or free it."""
        if node.kind is not NodeKind.LAYER:
            self.switch_locked_of(frozenset(node.places))
            return
        _, locked = looks_of(self._session.committed, node)
        self._change_layer("Unlock" if locked else "Lock", node, locked=not locked)

    def _change_layer(self, verb: str, node: Node, **looks: bool) -> None:
        self._session.change(
            f"{verb} {node.name}", lambda document: with_layer_looks(document, node.name, **looks)
        )

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
        session, before, is_layer = self._session, self._session.committed, node.kind is NodeKind.LAYER
        curves = self._meant(frozenset(node.places)) if node.places else frozenset()
        # All that is in a layer may go from it, and the layer stays.
        left = () if is_layer else before.layers
        layers = (whole_layers(before, curves) or [node.name]) if is_layer else []
        try:
            moved = moved_into(before, curves, drop.at, drop.container, {*left, *node.around.groups})
            document = moved_layers(moved.document, layers, drop.container, drop.behind)
        except EditError as reason:
            session.refuse(str(reason))
            return
        chosen = [moved.order.index(place) for place in session.selected.marked]
        active = moved.order.index(session.active_index)
        what = names_of(layers) if is_layer else named(before, curves)
        if session.change(_words_for(before, document, moved, what), lambda _: document, active=active):
            if chosen:
                session.selected.set_curves(chosen, active)
            elif is_layer:
                session.selected.set_layer(node.name)

    def _set_name(self, node: Node, name: str) -> None:
        def edit(document: Document) -> Document:
            if node.kind is NodeKind.CURVE:
                return rename_curve(document, node.places.start, name)
            return named_anew(document, node, name)

        selected = self._session.selected
        is_layer_now = node.kind is NodeKind.LAYER and node.name == selected.layer
        if self._session.change(f"Rename {node.kind.name.lower()}", edit) and is_layer_now:
            selected.set_layer(name.strip())


def _words_for(before: Document, after: Document, moved: Gathered, what: str) -> str:
    """Return what a step is called that brought something to other places, and perhaps to another layer."""
    now = {layer_of(after, place) for place in moved.places}
    was = {layer_of(before, moved.order[place]) for place in moved.places}
    layer = next(iter(now), "")
    return f"Move {what} to layer {layer}" if layer and len(now) == 1 and was != now else f"Reorder {what}"
