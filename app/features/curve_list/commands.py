"""The list of curves, and what is done to all that are selected: duplicate, delete, show, lock, colour."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QWidget

from ...actions.declaration import action, also
from ...actions.needs import SOME_LAYER, Need
from ...actions.sections import (
    CURVE_COLOUR,
    CURVE_NAME,
    CURVE_NUMBER,
    CURVE_PROPERTIES,
    EDIT_LAYERS,
    EDIT_SELECT,
)
from ...actions.situation import Situation
from ...actions.strips import (
    CANVAS_MENU,
    CHOSEN_MENU,
    CURVE_LIST_BUTTONS,
    CURVE_LIST_MENU,
    CURVE_MENU,
    LAYER_MENU,
)
from ...document.curve_tree import Node, NodeKind, counted_nodes
from ...document.edits import EditError, rename_curve
from ...document.layers import begun_again, layer_node, looks_of, with_layer_looks
from ...document.model import Document
from ...document.selection import NONE_FREE, free_curves
from ...document.several_curves import (
    active_after_removal,
    add_copies,
    changeable,
    counted,
    name_of,
    named,
    remove_curves,
    what_stays,
    with_appearance,
)
from ...document.shape_edits import moved_into, named_anew, objects
from ...document.shapes import whole_shapes
from ...document.style_edits import with_style
from ...tools.drag_machine import CANCELLED
from ...view_model.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import UPPER, Panel
from ...workbench.highlight import delete_layer, highlighted_curves
from ...workbench.strip_menu import strip_menu
from .dropping import Drop
from .model import Marks
from .panel import CurveList


class CurveListCommands:
    """Actions on all selected curves, and the list where they are selected.

    Attributes
    ----------
    panel
        The list with its buttons, as soon as the docks are filled.
    """

    panel: CurveList

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session, self._actions = context, context.session, context.actions
        self._dock = context.docks["curvesDock"]

    @Panel("curvesDock", "Curves", UPPER)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the list."""
        self.panel = CurveList(parent)
        self.panel.add_buttons(self._actions.in_strip(CURVE_LIST_BUTTONS)[1])
        self.panel.view.deletion_wanted.connect(self._delete_all)
        self.panel.menu_requested.connect(self._open_menu)
        self._connect(self.panel)
        return self.panel

    def _open_menu(self, place: QPoint, node: Node | None) -> None:
        is_layer = node is not None and node.kind is NodeKind.LAYER
        strip_menu(self._context, LAYER_MENU if is_layer else CURVE_LIST_MENU).popup(place)

    def _connect(self, panel: CurveList) -> None:
        session = self._session
        panel.view.chosen_entry.connect(self._choose_entry)
        panel.view.rows_selected.connect(self._choose_rows)
        panel.view.all_wanted.connect(self._choose_all)
        panel.view.moved.connect(self._move)
        panel.model.name_edited.connect(self._set_name)
        panel.visible_switched.connect(self._switch_row_visible)
        panel.locked_switched.connect(self._switch_row_locked)
        panel.colour_chosen.connect(self._paint)
        panel.fill_chosen.connect(self._fill)
        panel.colour_looked_at.connect(self._look_at)
        panel.colour_given_up.connect(self._give_up)
        session.interrupted.connect(panel.abandon)
        panel.row_meant.connect(self._choose_meant)
        session.selected_curves_changed.connect(self._render)
        session.layer_changed.connect(self._render)

    def render(self, view: CurveView) -> None:
        """Show the curves of the document."""
        self._render()

    def _render(self) -> None:
        session, selected = self._session, self._session.selected
        marks = Marks(session.active_index, selected.is_editing, selected.marked, selected.layer)
        self.panel.render_document(session.document, marks)

    # Number

    @action(
        "duplicateCurve",
        "Duplicate Curve",
        CURVE_NUMBER,
        icon="duplicate",
        title=lambda now: f"Duplicate {_curves(now)}",
    )
    @also(CURVE_MENU(13), CHOSEN_MENU(12), CURVE_LIST_MENU(31), CURVE_LIST_BUTTONS(11))
    def _duplicate(self) -> None:
        """Add a copy of the curve, or of all that are selected, in the same place."""
        session, order = self._session, sorted(highlighted_curves(self._context))
        document = session.document
        added = add_copies(document, order)
        active = order.index(session.active_index) if session.active_index in order else -1
        if not session.change(
            f"Duplicate {named(document, order)}",
            lambda _: added.document,
            active=added.places[active],
        ):
            return
        if len(order) == 1 and session.selected.is_editing:
            copy = session.active_curve
            session.selected.set_points(range(len(copy.points)))
            session.say(
                f"“{copy.name}” lies on the original; all its points are selected, drag one to move it."
            )
            return
        session.selected.set_curves(added.places)
        name = name_of(session.document, added.places)
        if name is not None:
            session.say(f"“{name}” lies on the original and is chosen; a drag moves it.")
        else:
            copies = f"Copies of {counted(document, order)}"
            session.say(f"{copies} lie on the originals and are chosen; drag one, or G, moves them.")

    @action(
        "deleteCurve",
        "Delete Curve",
        CURVE_NUMBER,
        "Shift+Del",
        "delete",
        title=lambda now: f"Delete {_curves(now)}",
    )
    @also(CURVE_MENU(30), CHOSEN_MENU(13), CURVE_LIST_MENU(40), CURVE_LIST_BUTTONS(12))
    def _delete(self) -> None:
        """Delete the curve, or all that are selected."""
        self._delete_all(highlighted_curves(self._context))

    def _delete_all(self, curves: frozenset[int], layer: str = "") -> None:
        session, document = self._session, self._session.document
        if layer:
            delete_layer(session, layer)
            return
        free, stays = changeable(document, curves), what_stays(document, curves)
        layer = session.selected.layer
        is_done = session.change(
            f"Delete {named(document, free)}",
            lambda document: begun_again(remove_curves(document, free), document, layer),
            active=active_after_removal(document, free, session.active_index, session.selected.edited),
        )
        if is_done and stays:
            session.say(f"{stays}.")

    # How they are called and shown

    @action("renameCurve", "Rename…", CURVE_NAME, full_name="Rename Curve…")
    @also(CURVE_LIST_MENU(10))
    def _rename(self) -> None:
        """Give the curve another name."""
        self._dock.bring_up()
        self.panel.view.edit_name(self.panel.view.current)

    @action("renameLayer", "Rename Layer…", EDIT_LAYERS, needs=SOME_LAYER)
    @also(LAYER_MENU(10))
    def _rename_layer(self) -> None:
        """Give the layer that new curves come into another name."""
        self._dock.bring_up()
        self.panel.view.edit_name(self.panel.model.show_layer())

    @action("layerVisible", "Hide or Show Layer", EDIT_LAYERS, icon="eye", needs=SOME_LAYER)
    @also(LAYER_MENU(11))
    def _switch_layer_visible(self) -> None:
        """Hide the layer that new curves come into, or show it again."""
        self._switch_row_visible(self._layer_now)

    @action("layerLocked", "Lock or Unlock Layer", EDIT_LAYERS, icon="lock", needs=SOME_LAYER)
    @also(LAYER_MENU(12))
    def _switch_layer_locked(self) -> None:
        """Keep the layer that new curves come into safe from changes, or free it again."""
        self._switch_row_locked(self._layer_now)

    @property
    def _layer_now(self) -> Node:
        return layer_node(self._session.committed, self._session.selected.layer)

    @action(
        "curveVisible",
        "Visible",
        CURVE_PROPERTIES,
        "Ctrl+H",
        "eye",
        full_name="Curve Visible",
        checked=lambda now: now.view.source.visible,
    )
    @also(CURVE_MENU(21), CHOSEN_MENU(60), CURVE_LIST_MENU(12))
    def _switch_visible(self) -> None:
        """Show or hide the curve, or all that are selected."""
        self._switch_visible_of(frozenset({self._session.active_index}))

    @action(
        "curveLocked",
        "Locked",
        CURVE_PROPERTIES,
        "Ctrl+L",
        "lock",
        full_name="Curve Locked",
        checked=lambda now: now.view.source.locked,
    )
    @also(CURVE_MENU(22), CHOSEN_MENU(61), CURVE_LIST_MENU(13))
    def _switch_locked(self) -> None:
        """Keep the curve, or all that are selected, safe from changes."""
        self._switch_locked_of(frozenset({self._session.active_index}))

    @action("curveColour", "Colour…", CURVE_COLOUR, icon="palette", full_name="Curve Colour…")
    @also(CURVE_MENU(20), CURVE_LIST_MENU(11))
    def _choose_colour(self) -> None:
        """Choose the colour of the curve, or of all that are selected."""
        self.panel.choose_colour(frozenset({self._session.active_index}))

    # Choosing

    @action(
        "selectAllCurves",
        "Select All Curves",
        EDIT_SELECT,
        "Ctrl+Shift+A",
        needs=Need("a curve", lambda now: not now.is_blank),
    )
    @also(CANVAS_MENU(12), CURVE_LIST_MENU(24))
    def _choose_all(self) -> None:
        """Choose all curves that are seen and not locked, to move, scale, colour or delete them together."""
        session, document = self._session, self._session.document
        free, count = free_curves(document), len(document.curves)
        if not free:
            session.refuse(NONE_FREE)
            return
        session.selected.set_curves(free)
        if len(free) < count:
            session.say(f"{counted(document, free)} chosen; what is hidden or locked is not.")
        else:
            only = f"“{session.active_curve.name}” is chosen."
            session.say(f"All {count} curves are chosen." if count > 1 else only)

    @action(
        "onlyThisCurve",
        "Only This Curve",
        EDIT_SELECT,
        needs=Need("several chosen curves", lambda now: len(now.selected) > 1),
    )
    @also(CURVE_LIST_MENU(25))
    def _choose_one(self) -> None:
        """Choose the curve that is edited alone."""
        self._session.selected.set_curves((self._session.active_index,))

    # Clicked, dragged and typed in the list

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
        if not places:
            self._choose_entry(node)
            return
        active = session.active_index if session.active_index in places else max(places)
        session.selected.set_curves(self._meant(places), active)
        if node.kind is NodeKind.LAYER:
            session.selected.set_layer(node.name)

    def _switch_row_visible(self, node: Node) -> None:
        if node.kind is not NodeKind.LAYER:
            self._switch_visible_of(frozenset(node.places))
            return
        visible, _ = looks_of(self._session.committed, node)
        self._change_layer("Hide" if visible else "Show", node, visible=not visible)

    def _switch_row_locked(self, node: Node) -> None:
        if node.kind is not NodeKind.LAYER:
            self._switch_locked_of(frozenset(node.places))
            return
        _, locked = looks_of(self._session.committed, node)
        self._change_layer("Unlock" if locked else "Lock", node, locked=not locked)

    def _change_layer(self, verb: str, node: Node, **looks: bool) -> None:
        self._session.change(
            f"{verb} {node.name}", lambda document: with_layer_looks(document, node.name, **looks)
        )

    def _switch_visible_of(self, places: frozenset[int]) -> None:
        visible = not any(self._session.committed.curves[place].visible for place in places)
        self._change_looks("Show" if visible else "Hide", places, partial(with_appearance, visible=visible))

    def _switch_locked_of(self, places: frozenset[int]) -> None:
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
        session, curves = self._session, self._meant(frozenset(node.places))
        # All that is in a layer may go from it, and the layer stays.
        left = () if node.kind is NodeKind.LAYER else session.committed.layers
        try:
            moved = moved_into(
                session.committed, curves, drop.at, drop.container, {*left, *node.around.groups}
            )
        except EditError as reason:
            session.refuse(str(reason))
            return
        chosen = [moved.order.index(place) for place in session.selected.curves]
        active = moved.order.index(session.active_index)
        if session.change(
            f"Reorder {named(session.committed, curves)}", lambda _: moved.document, active=active
        ):
            session.selected.set_curves(chosen, active)

    def _set_name(self, node: Node, name: str) -> None:
        def edit(document: Document) -> Document:
            if node.kind is NodeKind.CURVE:
                return rename_curve(document, node.places.start, name)
            return named_anew(document, node, name)

        selected = self._session.selected
        is_layer_now = node.kind is NodeKind.LAYER and node.name == selected.layer
        if self._session.change(f"Rename {node.kind.name.lower()}", edit) and is_layer_now:
            selected.set_layer(name.strip())


def _curves(now: Situation) -> str:
    nodes = objects(now.session.document, now.selected)
    return counted_nodes(nodes).title() if len(nodes) > 1 else nodes[0].kind.name.title()


COMMAND_SETS = (CurveListCommands,)
