"""The table itself: which cells and rows are selected, and what the keys do in it."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from PySide6.QtCore import (
    QItemSelection,
    QItemSelectionModel,
    QItemSelectionRange,
    QModelIndex,
    Qt,
    Signal,
    SignalInstance,
)
from PySide6.QtGui import QFont, QKeyEvent, QKeySequence, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QAbstractItemView, QHeaderView, QTableView, QWidget

from ...qt.overrides import DELETE, ENTER, ClaimsKeys
from ...widgets.controls import named
from ...widgets.fields import end_editing
from .delegate import COMPACT_DIGITS, PADDING, CellEditor, PointTableDelegate
from .model import PointTableModel

_PLAIN = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier

_EDGE = 8
"""Pixels to the right of the last column, if there is room."""


class PointTableView(ClaimsKeys, QTableView):
    """A table that is typed into like a spreadsheet.

    Signals
    -------
    reset_requested
        Delete was pressed while nothing was selected that says where a point is.
    copy_requested, paste_requested
        The keys for it were pressed.
    """

    reset_requested = Signal()
    copy_requested = Signal()
    paste_requested = Signal()

    def __init__(self, model: PointTableModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        named(self, "pointTable", "Points")
        self.numbers = model
        self.cell_delegate = PointTableDelegate(model, self)
        self.setModel(model)
        self.setItemDelegate(self.cell_delegate)
        self.cell_delegate.entered.connect(self._move_down)
        self._streaming = False
        self._set_up_behaviour()
        self._set_up_headers()

    def _set_up_behaviour(self) -> None:
        trigger = QAbstractItemView.EditTrigger
        self.setEditTriggers(trigger.DoubleClicked | trigger.EditKeyPressed | trigger.AnyKeyPressed)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setShowGrid(False)  # the delegate draws fine lines between the rows
        self.setWordWrap(False)
        self.setTabKeyNavigation(True)

    def _set_up_headers(self) -> None:
        font = QFont(self.font())
        font.setFeature(QFont.Tag("tnum"), 1)
        self.setFont(font)
        across, down = self.horizontalHeader(), self.verticalHeader()
        across.setObjectName("pointTableColumns")
        across.setMinimumSectionSize(20)
        across.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        across.setHighlightSections(False)
        across.setStyleSheet(f"QHeaderView::section {{ padding: 5px {PADDING}px }}")
        down.setObjectName("pointTableRows")
        down.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        down.setDefaultSectionSize(self.fontMetrics().height() + 8)
        down.setHighlightSections(False)
        down.setStyleSheet("QHeaderView::section { padding: 0 6px 0 2px; border: none }")
        corner = self.findChild(QAbstractButton)
        if corner is not None:
            named(corner, "selectAllPoints", "Select all points", "Select all points")

    # How the numbers are laid out

    def fit_columns(self, *, streaming: bool) -> None:
        """Give the columns of the numbers shown now their widths and formats.

        While previews are `streaming` the widths stay, for what changes is seen in every row at once; only a
        number that would run into its neighbour, as one that gets a sign, has them shared anew.
        """
        self._streaming = streaming
        if not streaming or self._outgrows():
            self._share_width()
        self._fit_formats()

    def _fit_formats(self) -> None:
        """Write the numbers as the columns have room for them."""
        across, metrics = self.horizontalHeader(), self.fontMetrics()
        widths = [across.sectionSize(column) for column in range(across.count())]
        if self.cell_delegate.update_formats(widths, metrics, streaming=self._streaming):
            self.viewport().update()

    def _share_width(self) -> None:
        """Share the width among the columns; none gets less than a few digits need."""
        room, needed = self.viewport().width(), list[int]()
        for needed in self._tried_widths():
            if sum(needed) + _EDGE // 2 <= room:
                break
        spare = max(room - sum(needed), 0)
        # Numbers at the very edge of the window are hard to read.
        spare, rest = divmod(spare - min(spare, _EDGE), max(len(needed), 1))
        for column, width in enumerate(needed):
            self.horizontalHeader().resizeSection(column, width + spare + (1 if column < rest else 0))

    def _tried_widths(self) -> Iterator[list[int]]:
        """Yield widths of all columns, the last of which are taken where none has room."""
        telling = self.cell_delegate.telling_widths(self.fontMetrics())
        if any(telling):
            yield [max(both) for both in zip(telling, self._needed(*COMPACT_DIGITS[-1]), strict=True)]
        for digits in COMPACT_DIGITS:
            yield self._needed(*digits)

    def _needed(self, digits: int, of_derivatives: int) -> list[int]:
        return self.cell_delegate.needed_widths(digits, of_derivatives, self.fontMetrics())

    def _outgrows(self) -> bool:
        """Whether some number takes more than its column has, however few digits it is written with."""
        across = self.horizontalHeader()
        return any(
            across.sectionSize(column) < width
            for column, width in enumerate(self._needed(*COMPACT_DIGITS[-1]))
        )

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._share_width()
            self._fit_formats()

    # What is selected

    def selected_cells(self) -> set[tuple[int, int]]:
        """Return the selected cells as (row, column)."""
        return {(index.row(), index.column()) for index in self.selectionModel().selectedIndexes()}

    def selected_rows(self) -> frozenset[int]:
        """Return the rows that have a selected cell."""
        return frozenset(row for span in self._spans() for row in range(span.top(), span.bottom() + 1))

    def selected_columns(self) -> frozenset[int]:
        """Return the columns that have a selected cell."""
        return frozenset(place for span in self._spans() for place in range(span.left(), span.right() + 1))

    def _spans(self) -> list[QItemSelectionRange]:
        """Return the rectangles of cells that are selected: few, where the cells may be many."""
        ranges = self.selectionModel().selection()
        return [ranges.at(each) for each in range(ranges.count())]

    def select_rows(self, rows: Collection[int]) -> None:
        """Select these rows, and no others; cells selected by hand in just these rows stay."""
        rows = frozenset(row for row in rows if row < self.numbers.rowCount())
        if rows == self.selected_rows():
            return
        last = self.numbers.columnCount() - 1
        selection = QItemSelection()
        for top, bottom in _runs(rows):
            selection.select(self.numbers.index(top, 0), self.numbers.index(bottom, last))
        flags = QItemSelectionModel.SelectionFlag
        self.selectionModel().select(selection, flags.ClearAndSelect)
        if rows and self.currentIndex().row() not in rows:
            current = self.numbers.index(min(rows), max(self.currentIndex().column(), 0))
            self.selectionModel().setCurrentIndex(current, flags.NoUpdate)
            self.scrollTo(current)

    def no_places_selected(self) -> bool:
        """Whether the selected cells are velocities and whatever else does not say where a point is."""
        columns = self.selected_columns()
        return bool(columns) and not any(self.numbers.columns[column].is_of_the_place for column in columns)

    # Keys

    def claims(self, event: QKeyEvent) -> bool:
        # Digits and letters are shortcuts of the window; here they begin a number. So may the keys for copy
        # and paste be, and Qt does nothing at all where a shortcut of the window is also one of the widget.
        return self._is_typing(event) or self._is_reset(event) or self._exchange(event) is not None

    def _exchange(self, event: QKeyEvent) -> SignalInstance | None:
        if event.matches(QKeySequence.StandardKey.Copy):
            return self.copy_requested
        return self.paste_requested if event.matches(QKeySequence.StandardKey.Paste) else None

    def _is_reset(self, event: QKeyEvent) -> bool:
        return event.key() in DELETE and self.no_places_selected()

    def _is_typing(self, event: QKeyEvent) -> bool:
        text = event.text()
        plain = not event.modifiers() & ~_PLAIN
        return self.currentIndex().isValid() and plain and text.isprintable() and bool(text.strip())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        exchange = self._exchange(event)
        if exchange is not None:
            exchange.emit()
        elif event.key() in ENTER and self.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable:
            self.edit(self.currentIndex())
        elif self._is_reset(event):
            self.reset_requested.emit()
        else:
            super().keyPressEvent(event)

    def edit_cell(self, index: QModelIndex) -> None:
        """Let the person type in a cell; one that is being typed in already keeps what was typed."""
        field = self.viewport().findChild(CellEditor)
        if self.state() == QTableView.State.EditingState and field is not None and field.index == index:
            field.setFocus()
            return
        end_editing(self)
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
        self.scrollTo(index)
        self.edit(index)

    def _move_down(self) -> None:
        current = self.currentIndex()
        below = self.numbers.index(min(current.row() + 1, self.numbers.rowCount() - 1), current.column())
        self.setCurrentIndex(QModelIndex(below))
        self.setFocus()


def _runs(rows: Collection[int]) -> Iterator[tuple[int, int]]:
    """Yield the first and last of every run of neighbouring rows."""
    start = previous = None
    for row in sorted(rows):
        if start is None or previous is None:
            start = row
        elif row != previous + 1:
            yield start, previous
            start = row
        previous = row
    if start is not None and previous is not None:
        yield start, previous
