"""The table itself: which cells and rows are selected, and what the keys do in it."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from PySide6.QtCore import QEvent, QItemSelection, QItemSelectionModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QFont, QKeyEvent
from PySide6.QtWidgets import QAbstractButton, QAbstractItemView, QHeaderView, QTableView, QWidget

from app.panels.point_table_delegate import PointTableDelegate
from app.panels.point_table_model import PointTableModel

_LEAST_COLUMN = 50
_ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
_DELETE = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)
_PLAIN = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier


class PointTableView(QTableView):
    """A table that is typed into like a spreadsheet.

    Signals
    -------
    reset_requested
        Delete was pressed while nothing but velocities and accelerations was selected.
    """

    reset_requested = Signal()

    def __init__(self, model: PointTableModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("pointTable")
        self.setAccessibleName("Points")
        self.numbers = model
        self.cell_delegate = PointTableDelegate(model, self)
        self.setModel(model)
        self.setItemDelegate(self.cell_delegate)
        self.cell_delegate.entered.connect(self._move_down)
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
        across.setMinimumSectionSize(_LEAST_COLUMN)
        across.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        across.setHighlightSections(False)
        down.setObjectName("pointTableRows")
        down.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        down.setDefaultSectionSize(self.fontMetrics().height() + 8)
        down.setHighlightSections(False)
        down.setStyleSheet("QHeaderView::section { padding: 0 6px 0 2px; border: none }")
        corner = self.findChild(QAbstractButton)
        if corner is not None:
            corner.setObjectName("selectAllPoints")
            corner.setAccessibleName("Select all points")
            corner.setToolTip("Select all points")

    # What is selected

    def selected_cells(self) -> set[tuple[int, int]]:
        """Return the selected cells as (row, column)."""
        return {(index.row(), index.column()) for index in self.selectionModel().selectedIndexes()}

    def selected_rows(self) -> frozenset[int]:
        """Return the rows that have a selected cell."""
        ranges = self.selectionModel().selection()
        spans = (ranges.at(each) for each in range(ranges.count()))
        return frozenset(row for span in spans for row in range(span.top(), span.bottom() + 1))

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

    def only_derivatives_selected(self) -> bool:
        """Whether the selected cells are velocities and accelerations and nothing else."""
        cells = self.selected_cells()
        return bool(cells) and all(self.numbers.columns[column].is_derivative for _, column in cells)

    # Keys

    def event(self, event: QEvent) -> bool:
        # Digits and letters are shortcuts of the window; here they begin a number.
        if (
            isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.ShortcutOverride
            and (self._is_typing(event) or self._is_reset(event))
        ):
            event.accept()
            return True
        return super().event(event)

    def _is_reset(self, event: QKeyEvent) -> bool:
        return event.key() in _DELETE and self.only_derivatives_selected()

    def _is_typing(self, event: QKeyEvent) -> bool:
        text = event.text()
        plain = not event.modifiers() & ~_PLAIN
        return self.currentIndex().isValid() and plain and text.isprintable() and bool(text.strip())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in _ENTER and self.currentIndex().isValid():
            self.edit(self.currentIndex())
        elif self._is_reset(event):
            self.reset_requested.emit()
        else:
            super().keyPressEvent(event)

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
