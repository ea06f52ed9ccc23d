"""The list of curves, and changes of all selected curves: duplicate, delete, rename, show, lock, colour."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QWidget

from ...actions.declaration import action, also
from ...actions.menus import (
    CANVAS_MENU,
    CURVE_ALL_FREE,
    CURVE_COLOUR,
    CURVE_LIST_BUTTONS,
    CURVE_LIST_MENU,
    CURVE_MENU,
    CURVE_NAME,
    CURVE_NUMBER,
    CURVE_PROPERTIES,
    EDIT_SELECT,
    WHOLES_MENU,
)
from ...actions.needs import SOME_CURVE, Need
from ...document.curve_edits import rename_curve
from ...document.group_edits import move_into, rename_node
from ...document.groups import Node, NodeKind, expand_to_shapes
from ...document.limits import EditError
from ...document.model import Document
from ...document.selection import NONE_SELECTABLE, selectable_curves
from ...document.several_curves import (
    active_after_removal,
    common_name,
    count_label,
    duplicate_curves,
    locked_remark,
    name_or_count,
    remove_curves,
    set_appearance,
    set_style,
    show_all,
    unlock_all,
    unlocked_curves,
)
from ...session import Session
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext, bar_menu
from ...workbench.docks import UPPER, Panel
from ...workbench.form_edits import cancel_preview
from ...workbench.highlight import highlighted_curves
from .model import RowMarks
from .panel import CurveList
from .row_drag import Drop

_HIDDEN = Need("", lambda state: state.is_any_hidden, "No curve is hidden.", is_redundant=True)
_LOCKED = Need("", lambda state: state.is_any_locked, "No curve is locked.", is_redundant=True)


class CurveListCommands:
    """Actions on all selected curves, and the list of curves.

    Attributes
    ----------
    panel
        The list with its buttons, once the docks are built.
    """

    panel: CurveList

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session, self._actions = context, context.session, context.actions
        self._dock, self._rows = context.docks["curvesDock"], RowEdits(context.session)

    @Panel("curvesDock", "Curves", UPPER, built_at_start=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the list."""
        self.panel = CurveList(parent)
        self.panel.add_buttons(self._actions.in_bar(CURVE_LIST_BUTTONS)[1])
        self.panel.view.deletion_wanted.connect(self._delete_all)
        self.panel.view.all_wanted.connect(self._select_all)
        self.panel.menu_requested.connect(self._open_menu)
        self._rows.listen(self.panel)
        session = self._session
        session.gesture_ended.connect(self.panel.abandon)
        session.selected_curves_changed.connect(self._render)
        return self.panel

    def _open_menu(self, position: QPoint) -> None:
        bar_menu(self._context, CURVE_LIST_MENU, is_short=True).popup(position)

    def render_panel(self, view: CurveView) -> None:
        """Show the curves of the document."""
        self._render()

    def _render(self) -> None:
        session, selected = self._session, self._session.selected
        marks = RowMarks(session.active_index, selected.is_editing, selected.marked)
        self.panel.render_document(session.document, marks)

    # Number

    @action(
        "duplicateCurve",
        "Duplicate Curve",
        CURVE_NUMBER,
        icon="duplicate",
        title=lambda state: f"Duplicate {state.highlighted}",
    )
    @also(CURVE_MENU(13), WHOLES_MENU(13), CURVE_LIST_MENU(31), CURVE_LIST_BUTTONS(11))
    def _duplicate(self) -> None:
        """Add a copy of each selected curve in the same position."""
        session, order = self._session, sorted(highlighted_curves(self._context))
        document = session.document
        added = duplicate_curves(document, order)
        active = order.index(session.active_index) if session.active_index in order else -1
        with session.batch:
            if not session.change(
                f"Duplicate {name_or_count(document, order)}",
                lambda _: added.document,
                active=added.indices[active],
            ):
                return
            if is_editing := len(order) == 1 and session.selected.is_editing:
                session.selected.set_points(range(len(session.active_curve.points)))
            else:
                session.selected.set_curves(added.indices)
        if is_editing:
            copy = session.active_curve.name
            session.say(f"“{copy}” lies on the original, with all points selected. Drag one to move it.")
            return
        name = common_name(session.document, added.indices)
        if name is not None:
            session.say(f"“{name}” lies on the original and is selected. Drag it to move it.")
        else:
            copies = f"Copies of {count_label(document, order)}"
            session.say(f"{copies} lie on the originals and are selected. Drag one to move them.")

    @action(
        "deleteCurve",
        "Delete Curve",
        CURVE_NUMBER,
        "Shift+Del",
        "delete",
        title=lambda state: f"Delete {state.highlighted}",
    )
    @also(CURVE_MENU(30), WHOLES_MENU(15), CURVE_LIST_MENU(40), CURVE_LIST_BUTTONS(12))
    def _delete(self) -> None:
        """Delete the selected curves."""
        self._delete_all(highlighted_curves(self._context))

    def _delete_all(self, curves: frozenset[int]) -> None:
        session, document = self._session, self._session.document
        free, stays = unlocked_curves(document, curves), locked_remark(document, curves)
        is_done = session.change(
            f"Delete {name_or_count(document, free)}",
            lambda document: remove_curves(document, free),
            active=active_after_removal(document, free, session.active_index, session.selected.active_curves),
        )
        if is_done and stays:
            session.say(f"{stays}.")

    # Names and appearance

    @action("renameCurve", "Rename…", CURVE_NAME, full_name="Rename Curve…")
    @also(CURVE_LIST_MENU(10))
    def _rename(self) -> None:
        """Rename the curve in the list."""
        self._dock.bring_up()
        self.panel.view.edit_name(self.panel.view.current)

    @action(
        "curveVisible",
        "Visible",
        CURVE_PROPERTIES,
        "Ctrl+H",
        "eye",
        full_name="Curve Visible",
        checked=lambda state: state.is_visible,
    )
    @also(CURVE_MENU(21), WHOLES_MENU(50), CURVE_LIST_MENU(12))
    def _switch_visible(self) -> None:
        """Show or hide the selected curves."""
        self._rows.switch_visible_of(frozenset({self._session.active_index}))

    @action(
        "curveLocked",
        "Locked",
        CURVE_PROPERTIES,
        "Ctrl+L",
        "lock",
        full_name="Curve Locked",
        checked=lambda state: state.is_locked,
    )
    @also(CURVE_MENU(22), WHOLES_MENU(51), CURVE_LIST_MENU(13))
    def _switch_locked(self) -> None:
        """Lock or unlock the selected curves: locked curves cannot be changed."""
        self._rows.switch_locked_of(frozenset({self._session.active_index}))

    @action(
        "showAll",
        "Show All",
        CURVE_ALL_FREE,
        "Ctrl+Alt+H",
        "eye",
        full_name="Show All Hidden",
        keywords="unhide hidden visible reveal",
        needs=_HIDDEN,
    )
    @also(CURVE_LIST_MENU(16))
    def _show_all(self) -> None:
        """Show all hidden curves."""
        self._session.change("Show all", show_all)

    @action(
        "unlockAll",
        "Unlock All",
        CURVE_ALL_FREE,
        icon="unlock",
        full_name="Unlock All Locked",
        keywords="free locked protect",
        needs=_LOCKED,
    )
    @also(CURVE_LIST_MENU(17))
    def _unlock_all(self) -> None:
        """Unlock all locked curves."""
        self._session.change("Unlock all", unlock_all)

    @action("curveColour", "Colour…", CURVE_COLOUR, icon="palette", full_name="Curve Colour…")
    @also(CURVE_MENU(20), CURVE_LIST_MENU(11))
    def _choose_colour(self) -> None:
        """Set the colour of the selected curves."""
        self.panel.choose_colour(frozenset({self._session.active_index}))

    # Choosing

    @action(
        "selectAllCurves",
        "Select All Curves",
        EDIT_SELECT,
        "Ctrl+Shift+A",
        needs=SOME_CURVE,
    )
    @also(CANVAS_MENU(12))
    def _select_all(self) -> None:
        """Select all visible, unlocked curves, to move, scale, colour or delete them together."""
        session, document = self._session, self._session.document
        free, count = selectable_curves(document), len(document.curves)
        if not free:
            session.refuse(NONE_SELECTABLE)
            return
        session.selected.set_curves(free)
        if len(free) < count:
            session.say(f"{count_label(document, free)} selected. Hidden and locked curves are not selected.")
        else:
            name = common_name(document, free)
            what = f"All {count_label(document, free)} are" if name is None else f"“{name}” is"
            session.say(f"{what} selected.")


class RowEdits:
    """Selection and edits by rows of the list; each acts on a node, or on some curves."""

    def __init__(self, session: Session) -> None:
        self._session = session

    def listen(self, panel: CurveList) -> None:
        """Connect the signals of the panel."""
        panel.view.entry_clicked.connect(self._select_entry)
        panel.view.rows_selected.connect(self._select_rows)
        panel.view.moved.connect(self._move)
        panel.row_targeted.connect(self._select_row)
        panel.model.name_typed.connect(self._set_name)
        panel.visible_switched.connect(lambda node: self.switch_visible_of(frozenset(node.indices)))
        panel.locked_switched.connect(lambda node: self.switch_locked_of(frozenset(node.indices)))
        panel.colour_picked.connect(self._paint)
        panel.fill_picked.connect(self._fill)
        panel.colour_previewed.connect(self._preview)
        panel.preview_cancelled.connect(partial(cancel_preview, self._session))

    def _with_selected(self, indices: frozenset[int]) -> frozenset[int]:
        """Return all selected curves where these are among them, or else these."""
        selected = self._session.selected.curves
        return selected if indices <= selected else indices

    def _select_entry(self, node: Node) -> None:
        """Select the curves of a row; while a curve is edited, edit the curve of the row.

        A curve of an opened shape is selected alone: the shape was opened to select a part of it.
        """
        selected = self._session.selected
        if node.kind is NodeKind.CURVE and selected.is_editing:
            selected.activate(node.indices.start)
        elif node.kind is NodeKind.CURVE:
            selected.set_curves(node.indices)
        else:
            selected.select_whole(node.indices)

    def _select_rows(self, indices: frozenset[int]) -> None:
        """Select these curves together; an empty selection keeps an edited curve."""
        selected = self._session.selected
        if indices or selected.is_editing:
            selected.set_curves(indices)
        else:
            selected.select_whole(())

    def _select_row(self, node: Node) -> None:
        session, indices = self._session, frozenset(node.indices)
        active = session.active_index if session.active_index in indices else max(indices)
        session.selected.set_curves(self._with_selected(indices), active)

    def switch_visible_of(self, indices: frozenset[int]) -> None:
        """Hide curves and those selected with them, or show them where all are hidden."""
        visible = not any(self._session.committed.curves[index].visible for index in indices)
        self._change_looks("Show" if visible else "Hide", indices, partial(set_appearance, visible=visible))

    def switch_locked_of(self, indices: frozenset[int]) -> None:
        """Lock curves and those selected with them, or unlock them where all are locked."""
        locked = not all(self._session.committed.curves[index].locked for index in indices)
        self._change_looks("Lock" if locked else "Unlock", indices, partial(set_appearance, locked=locked))

    def _paint(self, indices: frozenset[int], code: str) -> None:
        self._change_looks("Colour", indices, partial(set_appearance, colour=code))

    def _fill(self, indices: frozenset[int], paint: str) -> None:
        self._change_looks("Fill", indices, partial(set_style, fill=paint))

    def _preview(self, indices: frozenset[int], code: str) -> None:
        session = self._session
        session.preview(set_appearance(session.committed, self._with_selected(indices), colour=code))

    def _change_looks(
        self, verb: str, indices: frozenset[int], edit: Callable[[Document, frozenset[int]], Document]
    ) -> None:
        session = self._session
        curves = expand_to_shapes(session.committed, self._with_selected(indices))
        session.change(
            f"{verb} {name_or_count(session.committed, curves)}", lambda document: edit(document, curves)
        )

    def _move(self, node: Node, drop: Drop) -> None:
        session, before = self._session, self._session.committed
        curves = self._with_selected(frozenset(node.indices))
        try:
            moved = move_into(before, curves, drop.at, drop.container, node.container.groups)
        except EditError as reason:
            session.refuse(str(reason))
            return
        selected = [moved.order.index(index) for index in session.selected.marked]
        active = moved.order.index(session.active_index)
        if (
            session.change(
                f"Reorder {name_or_count(before, curves)}", lambda _: moved.document, active=active
            )
            and selected
        ):
            session.selected.set_curves(selected, active)

    def _set_name(self, node: Node, name: str) -> None:
        def edit(document: Document) -> Document:
            if node.kind is NodeKind.CURVE:
                return rename_curve(document, node.indices.start, name)
            return rename_node(document, node, name)

        self._session.change(f"Rename {node.kind.name.lower()}", edit)


COMMAND_SETS = (CurveListCommands,)
