"""The list of curves, and what is done to all that are selected: duplicate, delete, show, lock, colour."""

from __future__ import annotations

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QWidget

from ...actions.declaration import action, also
from ...actions.menus import (
    CANVAS_MENU,
    CHOSEN_MENU,
    CURVE_ALL_FREE,
    CURVE_COLOUR,
    CURVE_LIST_BUTTONS,
    CURVE_LIST_MENU,
    CURVE_MENU,
    CURVE_NAME,
    CURVE_NUMBER,
    CURVE_PROPERTIES,
    EDIT_SELECT,
)
from ...actions.needs import SOME_CURVE, Need
from ...document.selection import NONE_FREE, free_curves
from ...document.several_curves import (
    active_after_removal,
    add_copies,
    all_shown,
    all_unlocked,
    changeable,
    counted,
    name_of,
    named,
    remove_curves,
    what_stays,
)
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext, bar_menu
from ...workbench.docks import UPPER, Panel
from ...workbench.highlight import highlighted_curves
from .entries import RowMarks
from .panel import CurveList
from .row_edits import RowEdits

_HIDDEN = Need("", lambda state: state.is_any_hidden, lambda _state: "Nothing is hidden.", is_so=True)
_LOCKED = Need("", lambda state: state.is_any_locked, lambda _state: "Nothing is locked.", is_so=True)


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
        self._dock, self._rows = context.docks["curvesDock"], RowEdits(context.session)

    @Panel("curvesDock", "Curves", UPPER, built_at_start=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the list."""
        self.panel = CurveList(parent)
        self.panel.add_buttons(self._actions.in_bar(CURVE_LIST_BUTTONS)[1])
        self.panel.view.deletion_wanted.connect(self._delete_all)
        self.panel.view.all_wanted.connect(self._choose_all)
        self.panel.menu_requested.connect(self._open_menu)
        self._rows.listen(self.panel)
        session = self._session
        session.interrupted.connect(self.panel.abandon)
        session.selected_curves_changed.connect(self._render)
        return self.panel

    def _open_menu(self, place: QPoint) -> None:
        bar_menu(self._context, CURVE_LIST_MENU, is_short=True).popup(place)

    def render(self, view: CurveView) -> None:
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
    @also(CURVE_MENU(13), CHOSEN_MENU(13), CURVE_LIST_MENU(31), CURVE_LIST_BUTTONS(11))
    def _duplicate(self) -> None:
        """Add a copy of the curve, or of all that are selected, in the same place."""
        session, order = self._session, sorted(highlighted_curves(self._context))
        document = session.document
        added = add_copies(document, order)
        active = order.index(session.active_index) if session.active_index in order else -1
        with session.batch:
            if not session.change(
                f"Duplicate {named(document, order)}", lambda _: added.document, active=added.places[active]
            ):
                return
            if is_edited := len(order) == 1 and session.selected.is_editing:
                session.selected.set_points(range(len(session.active_curve.points)))
            else:
                session.selected.set_curves(added.places)
        if is_edited:
            copy = session.active_curve.name
            session.say(f"“{copy}” lies on the original; all its points are selected, drag one to move it.")
            return
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
        title=lambda state: f"Delete {state.highlighted}",
    )
    @also(CURVE_MENU(30), CHOSEN_MENU(15), CURVE_LIST_MENU(40), CURVE_LIST_BUTTONS(12))
    def _delete(self) -> None:
        """Delete the curve, or all that are selected."""
        self._delete_all(highlighted_curves(self._context))

    def _delete_all(self, curves: frozenset[int]) -> None:
        session, document = self._session, self._session.document
        free, stays = changeable(document, curves), what_stays(document, curves)
        is_done = session.change(
            f"Delete {named(document, free)}",
            lambda document: remove_curves(document, free),
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

    @action(
        "curveVisible",
        "Visible",
        CURVE_PROPERTIES,
        "Ctrl+H",
        "eye",
        full_name="Curve Visible",
        checked=lambda state: state.is_visible,
    )
    @also(CURVE_MENU(21), CHOSEN_MENU(50), CURVE_LIST_MENU(12))
    def _switch_visible(self) -> None:
        """Show or hide the curve, or all that are selected."""
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
    @also(CURVE_MENU(22), CHOSEN_MENU(51), CURVE_LIST_MENU(13))
    def _switch_locked(self) -> None:
        """Keep the curve, or all that are selected, safe from changes."""
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
        """Show all curves that are hidden."""
        self._session.change("Show all", all_shown)

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
        """Free all curves that are locked."""
        self._session.change("Unlock all", all_unlocked)

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
        needs=SOME_CURVE,
    )
    @also(CANVAS_MENU(12))
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
            name = name_of(document, free)
            what = f"All {counted(document, free)} are" if name is None else f"“{name}” is"
            session.say(f"{what} chosen.")


COMMAND_SETS = (CurveListCommands,)
