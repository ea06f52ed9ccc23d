"""The points as numbers: a table to read, type into, copy from and paste into."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QAction, QGuiApplication, QKeySequence, QShowEvent
from PySide6.QtWidgets import QWidget

from ...actions.keymap import set_full_name
from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...document.limits import EditError
from ...document.model import Document
from ...document.words import count_of
from ...exchange.table.clipboard import TableTextError, read_titled_block, write_block
from ...qt.labels import MUTED, WARNING, Label, html_of
from ...qt.overrides import application
from ...view_model.curve.curve_view import CurveView
from ...view_model.point_columns import POSITION, Column, known_titles
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import ICON, action_button, tool_button
from ...widgets.number_text import decimal_mark, exact_text
from .edits import columns_of_block, explicit_orders, keeping_sentence
from .model import PointTableModel
from .view import PointTableView

INTERVAL_MS = 100
"""Milliseconds between two updates of the table during a drag, in which the user looks at the canvas."""


class PointTable(FollowsTheme, QWidget):
    """The panel with the point table.

    Signals
    -------
    rows_selected
        The user has selected other rows.
    fill_requested
        One number shall be set in cells: (rows by column, number). A receiver that cannot calls `refuse`.
    paste_requested
        A block of numbers shall be set in the table: (row, columns, numbers).
    reset_requested
        Numbers shall be estimated again: (rows, columns).
    said, refused
        A sentence for the status line: a result, or the reason of a refusal.

    Attributes
    ----------
    view
        The QTableView.
    model
        Its model.
    """

    rows_selected = Signal(object)
    fill_requested = Signal(object, float)
    paste_requested = Signal(int, object, object)
    reset_requested = Signal(object, object)
    said = Signal(str)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("pointTablePanel")
        self._selection: frozenset[int] = frozenset()
        # The view to be shown soon, and whether it is a preview.
        self._pending: tuple[CurveView, bool] | None = None
        self._rendering = False
        # The view shown last, and whether it was a preview.
        self._rendered: tuple[CurveView, bool] | None = None
        self._to_reset: tuple[list[int], list[Column]] = ([], [])
        self.model = PointTableModel(self)
        self.view = PointTableView(self.model, self)
        self._message = Label(name="pointTableMessage", wordWrap=True, is_html=True, role=WARNING)
        self._message.setTextInteractionFlags(Qt.TextInteractionFlag.LinksAccessibleByMouse)
        self._message.hide()
        self._message_text = ""
        self._legend = Label("<i>Italic</i>: estimated", name="pointTableLegend", is_html=True, role=MUTED)
        self._reset_button = tool_button(
            "resetToEstimated",
            "Reset to Estimate",
            "Reset the selected velocities and accelerations to estimates (Del)",
            text="Reset to Estimate",
            icon_size=ICON,
            flat=True,
        )
        self._timer = QTimer(self, singleShot=True)
        self._add_actions()
        self._lay_out()
        self._connect()
        self.follow_theme()

    # Building

    def _add_actions(self) -> None:
        self._copy = self._action("copyCells", "Copy", "Copy the selected cells", self.copy)
        self._copy.setShortcut(QKeySequence.StandardKey.Copy)
        self._paste = self._action("pasteCells", "Paste", "Paste numbers at the current cell", self.paste)
        self._paste.setShortcut(QKeySequence.StandardKey.Paste)
        for action in (self._copy, self._paste):
            set_full_name(action, f"{action.text()} Cells")
        tip = self._reset_button.toolTip()
        self._reset = self._action("resetCellsToEstimated", "Reset to Estimate", tip, self.reset_to_estimated)

    def _action(self, name: str, text: str, tip: str, handler: Callable[[], None]) -> QAction:
        action = QAction(text, self.view)
        action.setObjectName(name)
        action.setToolTip(tip)
        action.setStatusTip(tip)
        # The canvas and fields of other panels have the same keys for their own content.
        action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        action.triggered.connect(lambda _checked=False: handler())
        self.view.addAction(action)
        return action

    def _lay_out(self) -> None:
        self._message.setContentsMargins(10, 6, 10, 6)
        self._footer = QWidget()
        row_of((self._legend, 1), self._reset_button, margins=(10, 4, 6, 4), parent=self._footer)
        self._kinds = QWidget()
        self._kind_row = row_of(margins=(8, 0, 8, 4), spacing=2, parent=self._kinds)
        parts = (self._kinds, (self.view, 1), self._message, self._footer)
        column_of(*parts, margins=0, spacing=0, parent=self)

    def add_buttons(self, actions: Sequence[QAction]) -> None:
        """Add a small button for each action above the table, for points with handles."""
        for action in actions:
            button = action_button(action, name=f"{action.objectName()}Above", flat=True)
            # Icons are set later, with the theme; docks that are laid out anew then would lose their widths.
            button.setFixedSize(26, 26)
            self._kind_row.addWidget(button)
        self._kind_row.addStretch(1)

    def _connect(self) -> None:
        self._timer.timeout.connect(self._show_pending)
        self._reset_button.clicked.connect(self.reset_to_estimated)
        self.model.refused.connect(self._report_refusal)
        self.view.cell_delegate.edit_began.connect(self._clear_message)
        self.view.cell_delegate.closeEditor.connect(self._clear_message)
        self.view.cell_delegate.edit_discarded.connect(self._report_discarded)
        self.view.reset_requested.connect(self.reset_to_estimated)
        self.view.copy_requested.connect(self.copy)
        self.view.paste_requested.connect(self.paste)
        self.view.selectionModel().selectionChanged.connect(self._report_selection)
        self.view.selectionModel().currentChanged.connect(self._clear_message)
        self._message.linkActivated.connect(lambda: self.reset_requested.emit(*self._to_reset))
        application().focusChanged.connect(self._watch_focus)

    # Rendering: nothing here changes the document

    def render_view(self, view: CurveView, *, streaming: bool = False) -> None:
        """Show `view` at once, or after the delay of the last one, or when the panel becomes visible.

        While the previews of a gesture are `streaming`, the columns keep their widths.
        """
        self._pending = view, streaming
        if self._message_text:
            self._clear_message()
        if self._timer.isActive() or not self.isVisible():
            return
        if streaming:
            # The curve is painted first, and the table after it.
            self._timer.start(0)
        else:
            self._show_pending()

    def _show_pending(self) -> None:
        if self._pending is not None:
            self._timer.start(INTERVAL_MS)
            view, streaming = self._pending
            self.show_now(view, streaming=streaming)

    def show_now(self, view: CurveView, *, streaming: bool = False) -> None:
        """Show `view` at once, so that the table is up to date after a step of the history."""
        self._pending = None
        self._clear_message()
        rendered = view, streaming
        if rendered == self._rendered:
            return
        self._rendered = rendered
        self._rendering = True
        self.model.show_view(view)
        # Not after the next paint, which would paint the table twice.
        self.view.executeDelayedItemsLayout()
        self.view.fit_columns(streaming=streaming)
        self.view.select_rows(self._selection)
        self._rendering = False
        self._render_footer()

    def show_handles(self, visible: bool) -> None:
        """Show or hide the lengths and angles of handles."""
        if visible != self.model.with_handles and self._rendered is not None:
            (view, streaming), self._rendered = self._rendered, None
            self.model.with_handles = visible
            self.show_now(view, streaming=streaming)

    def set_selection(self, selection: frozenset[int]) -> None:
        """Select the rows of these points."""
        self._selection = selection
        self._rendering = True
        self.view.select_rows(selection)
        self._rendering = False
        self._render_footer()

    def edit_position(self, row: int) -> None:
        """Edit x of a point; Tab moves on to y."""
        index = next(k for k, column in enumerate(self.model.columns) if column.order == POSITION)
        self.view.edit_cell(self.model.index(row, index))

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self.model.set_theme(theme)
        self.view.cell_delegate.set_theme(theme)
        self._copy.setIcon(icon("copy", theme))
        self._paste.setIcon(icon("paste", theme))
        self._reset.setIcon(icon("reset", theme))
        self._reset_button.setIcon(icon("reset", theme))
        self.view.viewport().update()

    def _render_footer(self) -> None:
        has_derivatives = any(column.reset for column in self.model.columns)
        self._footer.setVisible(has_derivatives)
        self._kinds.setVisible(has_derivatives)
        self._reset.setVisible(has_derivatives)
        can_reset = has_derivatives and bool(self._columns_to_reset())
        self._reset_button.setEnabled(can_reset)
        self._reset.setEnabled(can_reset)

    def _show_message(self, text: str) -> None:
        if text != self._message_text:
            self._message_text = text
            self._message.show_text(text)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._show_pending()

    # Actions of the user

    def _report_selection(self) -> None:
        if not self._rendering:
            self.rows_selected.emit(self.view.selected_rows())
            self._render_footer()

    def _report_refusal(self, reason: str) -> None:
        self._show_message(f"⚠ {html_of(reason)}")
        self.refused.emit(reason)

    def refuse(self, reason: str) -> None:
        """Show why a change was refused; a typed number stays for correction."""
        self._show_message(f"⚠ {html_of(reason)}")
        self.model.refuse()

    def _clear_message(self) -> None:
        self._show_message("")

    def _report_discarded(self, label: str) -> None:
        self.refused.emit(
            f"{label[0].upper()}{label[1:]} was not changed. Press Enter or Tab to set a typed number."
        )

    def _watch_focus(self, old: QWidget | None, new: QWidget | None) -> None:
        # Without a new widget another window has the focus, perhaps the spreadsheet with the numbers.
        if new is not None and not self.isAncestorOf(new):
            self._clear_message()

    def _columns_to_reset(self) -> list[Column]:
        """Return the columns that a reset of the selected points would change.

        These are the columns of selected cells; without any that can be reset, all derivatives.
        """
        rows, columns = self.view.selected_rows(), self.model.columns
        selected = [columns[index] for index in sorted(self.view.selected_columns()) if columns[index].reset]
        return [
            column
            for column in selected or [column for column in columns if column.is_derivative]
            if self._is_set(column, rows)
        ]

    def _is_set(self, column: Column, rows: frozenset[int]) -> bool:
        """Return whether a number of the column was set, on either side of a corner."""
        if column.is_derivative and column.order is not None:
            return bool(explicit_orders(self.model.points, rows, (column.order,)))
        return not self.model.estimated[sorted(rows), self.model.columns.index(column)].all()

    def reset_to_estimated(self) -> None:
        """Request a reset of the selected numbers to the estimates of the rules."""
        if columns := self._columns_to_reset():
            self.reset_requested.emit(self.view.selected_rows(), columns)
            return
        selected = [self.model.columns[index] for index in sorted(self.view.selected_columns())]
        if not any(column.reset for column in selected):
            names = " and ".join(column.name for column in selected)
            self._report_refusal(f"No rule estimates {names}; Delete on t, x or y deletes the point.")

    def copy(self) -> None:
        """Copy the selected cells to the clipboard, exact and tab-separated."""
        cells = self.view.selected_cells()
        if not cells:
            return
        columns = sorted({column for _, column in cells})
        mark = decimal_mark()
        rows = [
            [exact_text(self.model.values[row, c], mark) if (row, c) in cells else "" for c in columns]
            for row in sorted({row for row, _ in cells})
        ]
        QGuiApplication.clipboard().setText(write_block(rows))
        self.said.emit(f"Copied {count_of(len(rows), 'row')}.")

    def paste(self) -> None:
        """Request a paste of the numbers on the clipboard from the current cell on; all or none."""
        try:
            text = QGuiApplication.clipboard().text()
            block = read_titled_block(text, decimal_mark(), known_titles(), may_be_empty=True)
            cells = self.view.selected_cells()
            if len(cells) > 1 and len(block.rows) == len(block.rows[0]) == 1:
                self._request_fill(cells, block.rows[0][0])
            else:
                columns = self.model.columns
                covered = columns_of_block(block, columns, self._paste_column(len(block.rows[0])))
                self.paste_requested.emit(self._paste_row(), *covered)
        except (TableTextError, EditError) as reason:
            self._report_refusal(str(reason))

    def _request_fill(self, cells: set[tuple[int, int]], value: float) -> None:
        rows: dict[Column, list[int]] = {}
        for row, column in sorted(cells):
            rows.setdefault(self.model.columns[column], []).append(row)
        self.fill_requested.emit(rows, value)

    def _paste_row(self) -> int:
        current = self.view.currentIndex()
        return current.row() if current.isValid() else self.model.rowCount()

    def _paste_column(self, width: int) -> int:
        current = self.view.currentIndex()
        if current.isValid():
            return current.column()
        # Two columns of numbers are positions.
        orders = [column.order for column in self.model.columns]
        return orders.index(POSITION) if width == 2 else 0

    def show_kept(self, document: Document, indices: list[int], orders: set[int]) -> None:
        """Show which points kept derivatives of their old positions, and offer a reset."""
        if not indices:
            return
        self._to_reset = indices, [column for column in self.model.columns if column.order in orders]
        sentence = keeping_sentence(indices, orders)
        self._show_message(f'⚠ {html_of(sentence)} · <a href="reset">Reset to Estimate</a>')
        self.said.emit(f"{sentence}; click “Reset to Estimate” to estimate again.")
