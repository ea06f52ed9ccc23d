"""The first rows of a table as they stand in the file, and the row that is wrong."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem

from app.panels.role_header import RoleHeader
from app.theme import mix, theme_of


class TablePreview(QTableWidget):
    """Cells as text, not to be edited; a box above every column says what it is."""

    def __init__(self, roles: Sequence[str]) -> None:
        super().__init__()
        self.setObjectName("tablePreview")
        self.setAccessibleName("First rows of the table")
        self.setToolTip("The first rows, as they stand in the file")
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        # Tab goes on to the next widget; the arrows walk through the cells.
        self.setTabKeyNavigation(False)
        self.head = RoleHeader(roles, self)
        self.setHorizontalHeader(self.head)
        self.setCornerButtonEnabled(False)
        self.verticalHeader().setDefaultSectionSize(24)
        self._shown = 0

    def show_table(self, titles: Sequence[str], cells: Sequence[Sequence[str]], roles: Sequence[str]) -> None:
        """Show rows under their titles, with a role for each column."""
        self._shown = len(cells)
        self.setColumnCount(len(titles))
        self.setRowCount(len(cells))
        self.setHorizontalHeaderLabels(list(titles))
        self.setVerticalHeaderLabels([str(number) for number in range(1, len(cells) + 1)])
        for row, line in enumerate(cells):
            for column in range(len(titles)):
                self.setItem(row, column, _item(line[column] if column < len(line) else ""))
        self.head.show_roles(roles)

    def mark(self, line: int, column: int, cells: Sequence[str]) -> None:
        """Show the line of the file that is wrong, counted from 1, below the others; 0 for none."""
        self.setRowCount(self._shown)
        if not line:
            return
        self.setRowCount(self._shown + 1)
        self.setVerticalHeaderItem(self._shown, QTableWidgetItem(f"line {line}"))
        theme = theme_of(self.palette())
        colour = QBrush(mix(theme.warning, QColor(theme.paper), 0.25))
        for place in range(self.columnCount()):
            item = _item(cells[place] if place < len(cells) else "")
            if column in (0, place + 1):
                item.setBackground(colour)
            self.setItem(self._shown, place, item)
        self.scrollToBottom()


def _item(text: str) -> QTableWidgetItem:
    item = QTableWidgetItem(text)
    item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    return item
