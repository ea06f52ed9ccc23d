"""The first rows of a table, nearly as they stand in the file, and the row that is wrong."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import isfinite

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QPainter
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHeaderView,
    QTableView,
    QTableWidget,
    QTableWidgetItem,
)

from ...appearance.theme import mix, theme_of
from ...qt.labels import tip_of
from ...qt.overrides import SafeOverrides
from ...widgets.controls import choice_box, named

_FITTING = 12
"""Characters that a cell has room for, as many as a number with six digits and a power of ten."""

_NUMBER = re.compile(r"[+-]?\d+((?P<mark>[.,])\d+)?(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)

_GAP = 4


class TablePreview(QTableWidget):
    """Cells as text, not to be edited; a box above every column says what it is."""

    def __init__(self, roles: Sequence[str]) -> None:
        super().__init__()
        tip = "The first rows of the file; of long numbers the first six digits"
        named(self, "tablePreview", "First rows of the table", tip)
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
        self._numbers: Sequence[int] = ()

    def show_table(
        self,
        titles: Sequence[str],
        cells: Sequence[Sequence[str]],
        numbers: Sequence[int],
        roles: Sequence[str],
    ) -> None:
        """Show rows with their numbers in the file under their titles, with a role for each column."""
        self._numbers = numbers
        self.setColumnCount(len(titles))
        self.setRowCount(len(cells))
        self.setHorizontalHeaderLabels(list(titles))
        self.setVerticalHeaderLabels([str(number) for number in numbers])
        for row, line in enumerate(cells):
            self._fill(row, line)
        self.head.show_roles(roles)

    def _fill(self, row: int, cells: Sequence[str]) -> None:
        for column in range(self.columnCount()):
            self.setItem(row, column, _item(cells[column] if column < len(cells) else ""))

    def mark(self, number: int, column: int, cells: Sequence[str]) -> None:
        """Mark what is wrong: a column, from 1, or all of the row with this number; 0 for no row.

        A row that is none of the first ones is shown below them.
        """
        self.setRowCount(len(self._numbers))
        for row in range(self.rowCount()):
            self._colour(row, 0, QBrush())
        if not number:
            return
        if number in self._numbers:
            row = self._numbers.index(number)
        else:
            row = len(self._numbers)
            self.setRowCount(row + 1)
            self.setVerticalHeaderItem(row, QTableWidgetItem(str(number)))
            self._fill(row, cells)
        theme = theme_of(self.palette())
        self._colour(row, column, QBrush(mix(theme.warning, QColor(theme.paper), 0.25)))
        self.scrollTo(self.model().index(row, max(column - 1, 0)))

    def _colour(self, row: int, column: int, brush: QBrush) -> None:
        """Fill a cell, its column counted from 1, or the whole row for column 0."""
        places = [column - 1] if 0 < column <= self.columnCount() else range(self.columnCount())
        for place in places:
            item = self.item(row, place)
            if item is not None:
                item.setBackground(brush)


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


class RoleHeader(SafeOverrides, QHeaderView):
    """A horizontal head with titles, and a box above each.

    Signals
    -------
    chosen
        The person gave a column another role.
    """

    chosen = Signal()

    def __init__(self, roles: Sequence[str], parent: QTableView) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._roles = tuple(roles)
        self.boxes: list[QComboBox] = []
        self.setMinimumSectionSize(112)
        self.setDefaultSectionSize(118)
        self.sectionResized.connect(self._place)
        self.sectionCountChanged.connect(self._place)
        parent.horizontalScrollBar().valueChanged.connect(self._place)

    def show_roles(self, roles: Sequence[str]) -> None:
        """Show these roles, one for each column."""
        while len(self.boxes) > len(roles):
            self.boxes.pop().deleteLater()
        while len(self.boxes) < len(roles):
            self.boxes.append(self._box(len(self.boxes)))
        for box, role in zip(self.boxes, roles, strict=True):
            box.setCurrentIndex(self._roles.index(role))
        self._place()

    @property
    def roles(self) -> tuple[str, ...]:
        """The role of each column."""
        return tuple(self._roles[box.currentIndex()] for box in self.boxes)

    def _box(self, column: int) -> QComboBox:
        tip = "What this column is; each but “ignore” at most once"
        box = choice_box(f"columnRole{column}", f"What column {column + 1} is", tip, self._roles)
        box.setParent(self)
        box.activated.connect(lambda _index, box=box: self._choose(box))
        box.show()
        return box

    def _choose(self, box: QComboBox) -> None:
        """Take the role away from the column that had it: two cannot have the same."""
        for other in self.boxes:
            if other is not box and other.currentIndex() == box.currentIndex() != 0:
                other.setCurrentIndex(0)
        self.chosen.emit()

    def _place(self) -> None:
        height = self._box_height()
        for column, box in enumerate(self.boxes):
            left = self.sectionViewportPosition(column)
            box.setGeometry(left + 2, 2, max(self.sectionSize(column) - _GAP, 20), height)

    def _box_height(self) -> int:
        return self.boxes[0].sizeHint().height() if self.boxes else 0

    def sizeHint(self) -> QSize:
        hint = super().sizeHint()
        return QSize(hint.width(), hint.height() + self._box_height() + _GAP)

    def paintSection(  # noqa: N802
        self,
        painter: QPainter,
        rect: QRect,
        logicalIndex: int,  # noqa: N803
    ) -> None:
        """Paint the title of a column."""
        # The title has what the box leaves.
        super().paintSection(painter, rect.adjusted(0, self._box_height() + _GAP, 0, 0), logicalIndex)
