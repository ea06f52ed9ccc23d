"""Actions on layers: new, in front of each other, gone, and curves moved from one to the next."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.needs import SOME_LAYER, Need
from ...actions.sections import EDIT_LAYER_MOVES, EDIT_LAYERS, EDIT_SELECT
from ...actions.state import ActionState
from ...actions.strips import CURVE_LIST_MENU, LAYER_MENU
from ...document.layers import layer_of, layers_beside, moved_to_layer, neighbour_of, new_layer, stepped_layer
from ...document.selection import free_curves
from ...document.several_curves import counted, named, place_in
from ...document.shapes import whole_shapes
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.highlight import delete_layer

_LAYER_IN_FRONT = Need("a layer in front of this one", lambda now: _has_layer_beside(now, 1))
_LAYER_BEHIND = Need("a layer behind this one", lambda now: _has_layer_beside(now, -1))
_LAYER_ABOVE = Need("a chosen curve, and a layer above it", lambda now: _can_move(now, 1))
_LAYER_BELOW = Need("a chosen curve, and a layer below it", lambda now: _can_move(now, -1))


def _has_layer_beside(now: ActionState, step: int) -> bool:
    layer = now.session.selected.layer
    beside = layers_beside(now.session.document, layer) if layer else []
    return bool(beside) and beside[-1 if step > 0 else 0] != layer


def _can_move(now: ActionState, step: int) -> bool:
    return bool(neighbour_of(now.session.document, now.session.selected.marked, step))


class LayerCommands:
    """Actions on layers, and their share of the status line."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._session.layer_changed.connect(self._follow_layer)

    def render(self, view: CurveView) -> None:
        """Show the layer that new curves come into."""
        self._show_layer()

    def show_document(self) -> None:
        """Show the layer of the document."""
        self._show_layer()

    def _show_layer(self) -> None:
        session, readouts = self._session, self._context.status_line.readouts
        readouts.show_layer(session.selected.layer if session.document.layers else None)

    def _follow_layer(self) -> None:
        self._show_layer()
        self._context.actions.follow()

    @action("newLayer", "New Layer", EDIT_LAYERS, "Ctrl+Shift+L", "layers", keywords="add layer")
    @also(CURVE_LIST_MENU(60), LAYER_MENU(20))
    def _new(self) -> None:
        """Add an empty layer in front of the present one; new curves come into it, and its name is typed."""
        session, above = self._session, self._session.selected.layer
        document, name = new_layer(session.committed, above)
        if session.change(f"New {name}", lambda _: document):
            # Of what is chosen nothing is in it.
            session.selected.choose(())
            session.selected.set_layer(name)
            self._context.actions["renameLayer"].trigger()
            where = f"above “{above}”" if above else "in front"
            session.say(f"“{name}” is {where}; new curves come into it. Type its name; Enter keeps that.")

    @action(
        "raiseLayer", "Raise Layer", EDIT_LAYERS, icon="move-up", needs=_LAYER_IN_FRONT, keywords="order up"
    )
    @also(LAYER_MENU(21))
    def _raise(self) -> None:
        """Bring the layer in front of the next one."""
        self._step("Raise", 1, "in front of")

    @action(
        "lowerLayer",
        "Lower Layer",
        EDIT_LAYERS,
        icon="move-down",
        needs=_LAYER_BEHIND,
        keywords="order down",
    )
    @also(LAYER_MENU(22))
    def _lower(self) -> None:
        """Bring the layer behind the next one."""
        self._step("Lower", -1, "behind")

    def _step(self, verb: str, step: int, where: str) -> None:
        session, layer = self._session, self._session.selected.layer
        beside = layers_beside(session.committed, layer)
        other, document = beside[beside.index(layer) + step], stepped_layer(session.committed, layer, step)
        active = place_in(document, session.active_curve)
        if session.change(f"{verb} {layer}", lambda _: document, active=active):
            session.selected.set_layer(layer)
            session.say(f"“{layer}” is {where} “{other}”.")

    @action("selectAllInLayer", "Select All in Layer", EDIT_SELECT, icon="layers", needs=SOME_LAYER)
    @also(LAYER_MENU(25))
    def _choose_all(self) -> None:
        """Choose all curves of the layer that are seen and not locked."""
        session, layer = self._session, self._session.selected.layer
        document = session.document
        inside = {place for place in free_curves(document) if layer_of(document, place) == layer}
        if not inside:
            session.refuse(f"“{layer}” has no curve that is seen and not locked.")
            return
        session.selected.choose(inside)
        session.selected.set_layer(layer)
        session.say(f"{counted(document, inside)} of “{layer}” chosen.")

    @action("deleteLayer", "Delete Layer", EDIT_LAYERS, icon="delete", needs=SOME_LAYER)
    @also(LAYER_MENU(30))
    def _delete(self) -> None:
        """Delete the layer with all that is in it."""
        delete_layer(self._session, self._session.selected.layer)

    @action(
        "moveToLayerAbove",
        "Move to Layer Above",
        EDIT_LAYER_MOVES,
        "Shift+PgUp",
        needs=_LAYER_ABOVE,
        keywords="send selection to next layer",
    )
    def _move_up(self) -> None:
        """Bring what is chosen to the front of the layer above its own."""
        self._move(1)

    @action(
        "moveToLayerBelow",
        "Move to Layer Below",
        EDIT_LAYER_MOVES,
        "Shift+PgDown",
        needs=_LAYER_BELOW,
        keywords="send selection to previous layer",
    )
    def _move_down(self) -> None:
        """Bring what is chosen to the front of the layer below its own."""
        self._move(-1)

    def _move(self, step: int) -> None:
        session, selected = self._session, self._session.selected
        before, is_editing = session.active_index, selected.is_editing
        curves = whole_shapes(session.committed, selected.marked)
        what = named(session.committed, curves)
        moved, layer = moved_to_layer(session.committed, curves, step)
        marked = [moved.order.index(place) for place in selected.marked]
        active = moved.order.index(before)
        if not session.change(f"Move {what} to layer {layer}", lambda _: moved.document, active=active):
            return
        if is_editing:
            selected.set_curves(marked, active)
        else:
            selected.choose(marked)
        session.say(f"{what} is in “{layer}”." if len(curves) == 1 else f"{what}: in “{layer}” now.")


COMMAND_SETS = (LayerCommands,)
