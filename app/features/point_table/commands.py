"""The point table in the window, and changes of the document by numbers typed or pasted there."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import compress

import numpy as np
from PySide6.QtWidgets import QWidget

from ...actions.declaration import action, also, switch
from ...actions.menus import POINT_BUTTONS, POINT_MENU, POINTS_TYPED
from ...actions.needs import Need
from ...document.limits import EditError
from ...document.model import Document
from ...document.point_group import points_of, reset_message
from ...document.words import count_of
from ...session import Session
from ...state.window_state import WindowState
from ...view_model.curve.curve_view import CurveView
from ...view_model.point_columns import POSITION, Column
from ...workbench.context import CommandSet
from ...workbench.docks import UPPER, Panel
from .edits import (
    computed_note_of,
    explicit_orders,
    fill_cells,
    paste_block,
    points_with_kept_derivatives,
    reset_name,
)
from .panel import PointTable


class PointTableController:
    """Changes of the active curve by numbers that are typed or pasted into the table.

    Parameters
    ----------
    show_points
        Called after a paste, to fit points into the view that lie outside.
    """

    def __init__(self, session: Session, panel: PointTable, show_points: Callable[[], None]) -> None:
        self._session, self._panel, self._show_points = session, panel, show_points
        panel.rows_selected.connect(session.selected.set_points)
        panel.said.connect(session.say)
        panel.refused.connect(session.refuse)
        panel.model.number_entered.connect(self._set_number)
        panel.fill_requested.connect(self._fill)
        panel.paste_requested.connect(self._paste)
        panel.reset_requested.connect(self._reset)
        session.history_changed.connect(self._update_table)
        session.opened.connect(self._update_table)
        self._update_table()

    def _update_table(self) -> None:
        session = self._session
        self._panel.show_now(session.active_view, streaming=session.is_previewing)

    def _set_number(self, row: int, column: Column, number: float) -> None:
        session, label, set_number = self._session, column.at(row), column.set
        assert set_number is not None

        def edit(document: Document) -> Document:
            try:
                return set_number(document, session.active_index, session.active_view, row, number)
            except EditError as reason:
                text = str(reason)
                raise EditError(text if label in text else f"{label}: {text}") from reason

        self._report_refusal(session.change(f"Set {label}", edit).refusal)

    def _report_refusal(self, refusal: str) -> bool:
        if refusal:
            self._panel.refuse(refusal)
        return bool(refusal)

    def _fill(self, cells: Mapping[Column, Sequence[int]], value: float) -> None:
        """Set one number in all cells, given as the rows of each column."""
        session = self._session
        computed_note, numbers = computed_note_of(cells), dict.fromkeys(cells, value)
        cells = {column: rows for column, rows in cells.items() if column.set is not None} or cells
        amount = count_of(sum(map(len, cells.values())), "cell")
        change = session.change(
            f"Fill {amount}",
            lambda document: fill_cells(document, session.active_index, session.active_view, cells, numbers),
        )
        if not self._report_refusal(change.refusal):
            session.say(f"Filled {amount}{computed_note}.")
            self._show_points()

    def _paste(self, top: int, columns: Sequence[Column], numbers: np.ndarray) -> None:
        """Set a block of numbers in the rows from `top` on."""
        session, view = self._session, self._session.active_view
        computed_note, can_be_set = computed_note_of(columns), [column.set is not None for column in columns]
        if any(can_be_set):
            columns, numbers = list(compress(columns, can_be_set)), numbers[:, can_be_set]
        height, width = numbers.shape
        has_positions = [column.order for column in columns].count(POSITION) == 2
        amount = count_of(height, "point") if has_positions else count_of(height * width, "value")
        change = session.change(
            f"Paste {amount}",
            lambda document: paste_block(document, session.active_index, view, top, columns, numbers),
        )
        if self._report_refusal(change.refusal):
            return
        session.say(f"Pasted {amount}{computed_note}.")
        overwritten = range(top, min(top + height, len(view.source.points)))
        session.selected.set_points(range(top, top + height))
        self._panel.show_kept(session.document, *points_with_kept_derivatives(view, overwritten, columns))
        self._show_points()

    def _reset(self, rows: Collection[int], columns: Sequence[Column]) -> None:
        """Reset numbers to the estimates of the rules."""

        def edit(document: Document) -> Document:
            for column in columns:
                if column.reset is not None:
                    document = column.reset(document, self._session.active_index, rows)
            return document

        session, points = self._session, self._session.active_curve.points
        orders = {column.order for column in columns if column.is_derivative and column.order}
        rows = [row for row in rows if explicit_orders(points, [row], orders)] or rows
        if session.change(step := reset_name(rows, columns), edit):
            group = points_of(session.active_index, rows)
            session.say(reset_message(step, session.document.curves, group))


class PointTableCommands(CommandSet):
    """The point table of the active curve and its selection.

    Attributes
    ----------
    panel
        The table with its footer, as soon as the docks are filled.
    """

    panel: PointTable

    @Panel("pointsDock", "Points", UPPER, built_at_start=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the table."""
        self.panel = PointTable(parent)
        self.panel.add_buttons(self._context.actions.in_bar(POINT_BUTTONS)[1])
        self.panel.view.addAction(self._context.actions["resetAllPoints"])
        self._controller = PointTableController(self._session, self.panel, self._show_points)
        self._session.selection_changed.connect(self.panel.set_selection)
        self._context.store.changed.connect(self._show_state)
        self.panel.view.addAction(self._context.actions["toggleHandleColumns"])
        self.panel.show_handles(self._context.store.state.handle_columns)
        return self.panel

    def _show_state(self, _before: WindowState, state: WindowState) -> None:
        self.panel.show_handles(state.handle_columns)

    def follow_drag(self, view: CurveView) -> bool:
        """Show the points of `view`, at most every 100 ms."""
        self.panel.render_view(view, streaming=self._session.is_previewing)
        return True

    @action(
        "typePoint",
        "Type x and y…",
        POINTS_TYPED,
        full_name="Type x and y of the Point…",
        needs=Need("a selected point", lambda state: state.selected_count > 0),
        keywords="exact coordinates position place numbers node",
    )
    @also(POINT_MENU(18))
    def _enter_position(self) -> None:
        """Enter the position of the selected point in the point table; Tab moves from x to y."""
        self._context.docks["pointsDock"].bring_up()
        self.panel.edit_position(min(self._session.selection))

    @switch(
        "handle_columns",
        "toggleHandleColumns",
        "Lengths and Angles",
        POINTS_TYPED,
        full_name="Lengths and Angles of Handles",
        keywords="polar table columns tangent velocity degrees",
    )
    def _toggle_handles(self) -> None:
        """Show length and angle of each handle in the point table, where they can be typed."""

    def _show_points(self) -> None:
        """Fit the view where points of the active curve lie outside it."""
        central = self._context.central
        if not central.canvas.framing.shows_all_points:
            central.fit()


COMMAND_SETS = (PointTableCommands,)
