"""The numbers of the active curve as a Qt table model."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRectF,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QFont, QPainter, QPixmap

from app.document import edits
from app.document.edits import EditError
from app.document.expression import ExpressionError, parse_number
from app.families import LAGRANGE
from app.overrides import Guarded
from app.panels.number_text import (
    ColumnNumbers,
    decimal_mark,
    exact_text,
    numbers_of_columns,
    rounded_text,
)
from app.panels.point_table_edits import Column, TableValues, columns_of, set_cell, table_values
from app.panels.words import ACCELERATION_ESTIMATES, VELOCITY_ESTIMATES
from app.plot.colours import colours_of
from app.session import Session
from app.theme import LIGHT, Theme
from app.view_model.curve_view import CurveView

Index = QModelIndex | QPersistentModelIndex
_NO_INDEX = QModelIndex()
_SWATCH, _SWATCH_CANVAS = 9, 16
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_EMPTY = TableValues(np.empty((0, 3)), np.empty((0, 3), dtype=bool))


class PointTableModel(Guarded, QAbstractTableModel):
    """Rows are points, columns what `columns_of` the family gives.

    ``EditRole`` is the exact number, ``DisplayRole`` a rounded text. `setData` takes a number or the text of
    an expression; what is refused changes nothing.

    Signals
    -------
    refused
        Why a number was not taken, as a sentence.

    Attributes
    ----------
    values
        The numbers shown, (n, columns).
    estimated
        Which of them a rule estimates.
    """

    refused = Signal(str)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("pointTableModel")
        self._session = session
        self._view: CurveView | None = None
        self._shown = _EMPTY
        self._numbers: tuple[TableValues, list[ColumnNumbers]] | None = None
        self.columns: tuple[Column, ...] = columns_of(LAGRANGE)
        self._corners: frozenset[int] = frozenset()
        self._theme = LIGHT
        self._answers: dict[int, Callable[[int, int], object]] = {
            Qt.ItemDataRole.DisplayRole: self._rounded,
            Qt.ItemDataRole.EditRole: lambda row, column: float(self.values[row, column]),
            Qt.ItemDataRole.ToolTipRole: self._describe,
            Qt.ItemDataRole.StatusTipRole: self._describe,
            Qt.ItemDataRole.AccessibleTextRole: self._read_aloud,
        }

    @property
    def values(self) -> np.ndarray:
        return self._shown.values

    @property
    def estimated(self) -> np.ndarray:
        return self._shown.estimated

    @property
    def numbers_of_columns(self) -> list[ColumnNumbers]:
        """What is known of the numbers in each column; found once for all that are shown."""
        if self._numbers is None or self._numbers[0] is not self._shown:
            self._numbers = self._shown, numbers_of_columns(self.values)
        return self._numbers[1]

    # What is shown

    def show_view(self, view: CurveView) -> None:
        """Show the numbers of `view`; only what changed is announced."""
        if view is self._view:
            return
        self._view = view
        columns, new = columns_of(view.source.family), table_values(view)
        if columns != self.columns:
            self.beginResetModel()
            self._corners = frozenset(view.corners)
            self.columns, self._shown = columns, new
            self.endResetModel()
            return
        self._announce_rows(new)
        changed = self._rows_with_other_corners(view) | self._changed_rows(new)
        changed = np.flatnonzero(changed)
        self._shown = new
        if len(changed):
            last = self.index(int(changed[-1]), len(columns) - 1)
            self.dataChanged.emit(self.index(int(changed[0]), 0), last)

    def _announce_rows(self, new: TableValues) -> None:
        """Add or take rows at the end until there are as many as in `new`."""
        old_count, count = len(self.values), len(new.values)
        if count > old_count:
            self.beginInsertRows(QModelIndex(), old_count, count - 1)
            grown = np.vstack([self.values, new.values[old_count:]])
            self._shown = TableValues(grown, np.vstack([self.estimated, new.estimated[old_count:]]))
            self.endInsertRows()
        elif count < old_count:
            self.beginRemoveRows(QModelIndex(), count, old_count - 1)
            self._shown = TableValues(self.values[:count], self.estimated[:count])
            self.endRemoveRows()
        if count != old_count:
            self.headerDataChanged.emit(Qt.Orientation.Vertical, 0, max(count - 1, 0))

    def _rows_with_other_corners(self, view: CurveView) -> np.ndarray:
        """Take over which points are corners, and return which rows that changes."""
        old, self._corners = self._corners, frozenset(view.corners)
        rows = np.zeros(len(view.source.nodes), dtype=bool)
        rows[[row for row in old ^ self._corners if row < len(rows)]] = True
        if rows.any():
            self.headerDataChanged.emit(Qt.Orientation.Vertical, 0, len(rows) - 1)
        return rows

    def shows_one_side(self, row: int, column: int) -> bool:
        """Whether the point has two of these derivatives, of which the cell shows one."""
        return row in self._corners and self.columns[column].is_derivative

    def _changed_rows(self, new: TableValues) -> np.ndarray:
        same = (self.values == new.values) | (np.isnan(self.values) & np.isnan(new.values))
        return np.asarray(~(same & (self.estimated == new.estimated)).all(axis=1))

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme
        if self.rowCount():
            self.headerDataChanged.emit(Qt.Orientation.Vertical, 0, self.rowCount() - 1)

    # What Qt asks

    def rowCount(self, parent: Index = _NO_INDEX) -> int:
        return 0 if parent.isValid() else len(self.values)

    def columnCount(self, parent: Index = _NO_INDEX) -> int:
        return 0 if parent.isValid() else len(self.columns)

    def flags(self, index: Index) -> Qt.ItemFlag:
        return super().flags(index) | Qt.ItemFlag.ItemIsEditable if index.isValid() else super().flags(index)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid():
            return None
        row, column = index.row(), index.column()
        answer = self._answers.get(role)
        if answer is not None:
            return answer(row, column)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _RIGHT
        return self._estimate_style(role) if self.estimated[row, column] else None

    def _estimate_style(self, role: int) -> object:
        if role == Qt.ItemDataRole.FontRole:
            font = QFont()
            font.setItalic(True)
            return font
        return self._theme.muted if role == Qt.ItemDataRole.ForegroundRole else None

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        if orientation == Qt.Orientation.Horizontal:
            return self._column_header(self.columns[section], role) if section < len(self.columns) else None
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return str(section)
            case Qt.ItemDataRole.DecorationRole:
                return self._swatch(section)
            case Qt.ItemDataRole.TextAlignmentRole:
                return _RIGHT
            case Qt.ItemDataRole.ToolTipRole:
                kind = ", a corner" if section in self._corners else ""
                return f"Point {section}{kind}; click to select it"
        return None

    @staticmethod
    def _column_header(column: Column, role: int) -> object:
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return column.name
            case Qt.ItemDataRole.TextAlignmentRole:
                return _RIGHT
            case Qt.ItemDataRole.ToolTipRole:
                return column.meaning
        return None

    def setData(self, index: Index, value: object, role: int = Qt.ItemDataRole.EditRole) -> bool:
        if role != Qt.ItemDataRole.EditRole or not index.isValid():
            return False
        try:
            self._set_number(index.row(), index.column(), value)
        except (EditError, ExpressionError) as reason:
            label, text = self.label(index.row(), index.column()), str(reason)
            self.refused.emit(text if label in text else f"{label}: {text}")
            return False
        return True

    # Words and colours

    def label(self, row: int, column: int) -> str:
        """Return what a cell holds, as "x of point 3"."""
        return f"{self.columns[column].name} of point {row}"

    def _rounded(self, row: int, column: int) -> str:
        value = float(self.values[row, column])
        if abs(value) < self.numbers_of_columns[column].negligible:
            value = 0.0
        return rounded_text(value, decimal_mark())

    def _read_aloud(self, row: int, column: int) -> str:
        return f"{self.label(row, column)}: {self._rounded(row, column)}{self._corner_note(row, column)}"

    def _describe(self, row: int, column: int) -> str:
        exact = exact_text(float(self.values[row, column]), decimal_mark()).replace("-", "−")
        text = f"{self.label(row, column)} = {exact}" if exact else f"{self.label(row, column)}: none now"
        text += self._corner_note(row, column)
        return f"{text}\n{self._estimate(column)}" if self.estimated[row, column] else text

    def _corner_note(self, row: int, column: int) -> str:
        """Return what the tooltip adds where a point has two derivatives, of which the table shows one."""
        what, view = self.columns[column], self._view
        if view is None or view.sides is None or not self.shows_one_side(row, column):
            return ""
        ahead = float(view.sides.after[row, what.order, what.component])
        return f", before the corner; {exact_text(ahead, decimal_mark()).replace('-', '−')} after it"

    def _estimate(self, column: int) -> str:
        curve = self._session.active_curve
        if self.columns[column].order == 1:
            return VELOCITY_ESTIMATES[curve.velocity_rule]
        return ACCELERATION_ESTIMATES[curve.acceleration_rule]

    def _swatch(self, row: int) -> QPixmap | None:
        if row >= len(self.values):
            return None
        colour = colours_of(len(self.values), self._theme)[row]
        return _swatch_of(colour.name(), square=row in self._corners)

    # Edits

    def _set_number(self, row: int, column: int, given: object) -> None:
        number = _number(given)
        if number == self.values[row, column] and not self.estimated[row, column]:
            return
        session = self._session
        session.interrupt()
        document = set_cell(
            session.document, session.active_index, session.active_view, row, self.columns[column], number
        )
        session.commit(document, f"Set {self.label(row, column)}")


def _number(given: object) -> float:
    if isinstance(given, str):
        return parse_number(given, decimal_mark())
    if isinstance(given, int | float | np.floating | np.integer) and not isinstance(given, bool):
        return edits.checked(float(given), "It")
    raise ExpressionError("This is not a number.")


@lru_cache(maxsize=512)
def _swatch_of(colour: str, *, square: bool) -> QPixmap:
    """Return a small disc, for a corner a square as on the canvas.

    The header scales what is smaller than its icons are.
    """
    pixmap = QPixmap(2 * _SWATCH_CANVAS, 2 * _SWATCH_CANVAS)
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colour))
    margin = (_SWATCH_CANVAS - _SWATCH) / 2
    box = QRectF(margin, margin, _SWATCH, _SWATCH)
    if square:
        painter.drawRect(box)
    else:
        painter.drawEllipse(box)
    painter.end()
    return pixmap
