"""The first rows of a table, nearly as they stand in the file, and the row that is wrong."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import isfinite

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import QAbstractItemView, QTableWidget, QTableWidgetItem

from app.labels import tip_of
from app.panels.role_header import RoleHeader
from app.theme import mix, theme_of

_FITTING = 12
"""Characters that a cell has room for, as many as a number with six digits and a power of ten."""

_NUMBER = re.compile(r"[+-]?\d+((?P<mark>[.,])\d+)?(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)


class TablePreview(QTableWidget):
    """Cells as text, not to be edited; a box above every column says what it is."""

    def __init__(self, roles: Sequence[str]) -> None:
        super().__init__()
        self.setObjectName("tablePreview")
        self.setAccessibleName("First rows of the table")
        self.setToolTip("The first rows of the file; of long numbers the first six digits")
        # What is no number is told by its end as much as by its beginning.
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
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
    shown = _short(text)
    item = QTableWidgetItem(shown)
    if shown != text or len(text) > _FITTING:
        item.setToolTip(tip_of(text))
    item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    return item


def _short(text: str) -> str:
    """Return a long number with six digits, so that its power of ten is not cut off; all else as it is."""
    found = _NUMBER.fullmatch(text.strip()) if len(text) > _FITTING else None
    if found is None:
        return text
    mark = found["mark"] or "."
    value = float(text.replace(mark, "."))
    return f"{value:.6g}".replace(".", mark) if isfinite(value) else text
