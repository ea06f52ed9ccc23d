"""The numbers of the active curve as a Qt table model."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec
import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QFont, QPixmap

from curvecore.arrays import FloatArray

from ...appearance.colours import point_colours
from ...appearance.theme import LIGHT, Theme
from ...canvas.point_marks import mark_picture
from ...document.expression import ExpressionError, parse_number
from ...document.limits import EditError, checked
from ...document.model import Point
from ...document.words import number, with_minus
from ...qt.overrides import SafeOverrides
from ...view_model.curve.curve_view import CurveView
from ...view_model.point_columns import Column, columns_of, sides_differ
from ...view_model.point_kinds import CORNER, POINT_KINDS, PointKind, kinds_of
from ...widgets.number_text import (
    EXACT,
    NEGLIGIBLE,
    ColumnNumbers,
    decimal_mark,
    exact_text,
    numbers_of_columns,
)

Index = QModelIndex | QPersistentModelIndex
_NO_INDEX = QModelIndex()
_SWATCH = 9
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter

# Combined once: Python's flags are slow, and Qt asks for the flags of cells again and again.
_SELECTABLE = Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemNeverHasChildren
_EDITABLE = _SELECTABLE | Qt.ItemFlag.ItemIsEditable


class TableValues(msgspec.Struct, frozen=True):
    """Values of the table: numbers (n, columns), NaN where there is none, and which are estimated."""

    values: FloatArray
    estimated: np.ndarray


def table_values(view: CurveView, columns: Sequence[Column]) -> TableValues:
    """Return the numbers of `view`; without a curve, only those that were set."""
    values = np.column_stack([column.get(view) for column in columns])
    return TableValues(values, np.column_stack([column.is_estimated(view) for column in columns]))


class PointTableModel(SafeOverrides, QAbstractTableModel):
    """Model of the point table: rows are points, columns are those of the family (`columns_of`).

    ``EditRole`` is the exact number, ``DisplayRole`` a rounded text. `setData` takes a number or the text of
    an expression, and changes nothing if that is refused.

    Signals
    -------
    number_entered
        Another number was entered: (row, column, number). A receiver that cannot use it calls `refuse`.
    refused
        The reason why an entered text is no number, as a sentence.

    Attributes
    ----------
    values
        The numbers of the table, (n, columns).
    estimated
        Which of the numbers are estimated by a rule.
    with_handles
        Whether lengths and angles of handles are among the columns.
    """

    number_entered = Signal(int, object, float)
    refused = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("pointTableModel")
        self._view: CurveView | None = None
        self.with_handles = False
        self.columns = columns_of(derivatives=0)
        shape = (0, len(self.columns))
        self._table_values = TableValues(np.empty(shape), np.empty(shape, dtype=bool))
        self._numbers: tuple[TableValues, list[ColumnNumbers]] | None = None
        self._kinds = np.empty(0, dtype=np.intp)
        self._is_refused = False
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
        return self._table_values.values

    @property
    def estimated(self) -> np.ndarray:
        return self._table_values.estimated

    @property
    def points(self) -> tuple[Point, ...]:
        """The points of the table."""
        return () if self._view is None else self._view.source.points

    @property
    def numbers_of_columns(self) -> list[ColumnNumbers]:
        """Magnitudes of the numbers in each column, computed once for each set of values."""
        if self._numbers is None or self._numbers[0] is not self._table_values:
            residues = [NEGLIGIBLE if column.derivatives else EXACT for column in self.columns]
            self._numbers = self._table_values, numbers_of_columns(self.values, residues)
        return self._numbers[1]

    # Values

    def show_view(self, view: CurveView) -> None:
        """Show the numbers of `view`; only changes are announced."""
        columns = columns_of(view.source.family.derivatives, with_handles=self.with_handles)
        if view is self._view and columns == self.columns:
            return
        self._view = view
        new = table_values(view, columns)
        if columns != self.columns:
            self.beginResetModel()
            self._kinds = kinds_of(view)
            self.columns, self._table_values = columns, new
            self.endResetModel()
            return
        other_kinds = self._rows_of_other_kinds(view)
        self._announce_rows(new)
        changed = other_kinds | self._changed_rows(new)
        changed = np.flatnonzero(changed)
        self._table_values = new
        if len(changed):
            last = self.index(int(changed[-1]), len(columns) - 1)
            self.dataChanged.emit(self.index(int(changed[0]), 0), last)

    def _announce_rows(self, new: TableValues) -> None:
        """Add or remove rows at the end until there are as many as in `new`."""
        old_count, count = len(self.values), len(new.values)
        if count > old_count:
            self.beginInsertRows(QModelIndex(), old_count, count - 1)
            grown = np.vstack([self.values, new.values[old_count:]])
            self._table_values = TableValues(grown, np.vstack([self.estimated, new.estimated[old_count:]]))
            self.endInsertRows()
        elif count < old_count:
            self.beginRemoveRows(QModelIndex(), count, old_count - 1)
            self._table_values = TableValues(self.values[:count], self.estimated[:count])
            self.endRemoveRows()
        if count != old_count:
            self.headerDataChanged.emit(Qt.Orientation.Vertical, 0, max(count - 1, 0))

    def _rows_of_other_kinds(self, view: CurveView) -> np.ndarray:
        """Store the kinds of the points, and return which rows have changed."""
        old, self._kinds = self._kinds, kinds_of(view)
        rows, both = np.zeros(len(self._kinds), dtype=bool), min(len(old), len(self._kinds))
        rows[:both] = old[:both] != self._kinds[:both]
        if rows.any():
            self.headerDataChanged.emit(Qt.Orientation.Vertical, 0, len(rows) - 1)
        return rows

    def shows_one_side(self, row: int, column: int) -> bool:
        """Return whether the point has two of these numbers, of which the cell shows one."""
        shown, view = self.columns[column], self._view
        return view is not None and shown.after is not None and sides_differ(view, row, shown.order or 0)

    def _changed_rows(self, new: TableValues) -> np.ndarray:
        same = (self.values == new.values) | (np.isnan(self.values) & np.isnan(new.values))
        return np.asarray(~(same & (self.estimated == new.estimated)).all(axis=1))

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self._theme = theme
        if self.rowCount():
            self.headerDataChanged.emit(Qt.Orientation.Vertical, 0, self.rowCount() - 1)

    # Qt's interface of a model

    def rowCount(self, parent: Index = _NO_INDEX) -> int:
        return 0 if parent.isValid() else len(self.values)

    def columnCount(self, parent: Index = _NO_INDEX) -> int:
        return 0 if parent.isValid() else len(self.columns)

    def flags(self, index: Index) -> Qt.ItemFlag:
        if not index.isValid():
            return Qt.ItemFlag.NoItemFlags
        return _SELECTABLE if self.columns[index.column()].set is None else _EDITABLE

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
                return self._mark(section)
            case Qt.ItemDataRole.TextAlignmentRole:
                return _RIGHT
            case Qt.ItemDataRole.ToolTipRole:
                kind = self._kind(section).one
                return f"Point {section}{f', {kind}' if kind else ''}; click to select it"
        return None

    @staticmethod
    def _column_header(column: Column, role: int) -> object:
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return column.name
            case Qt.ItemDataRole.TextAlignmentRole:
                return _RIGHT
            case Qt.ItemDataRole.ToolTipRole:
                return column.tip
        return None

    def setData(self, index: Index, value: object, role: int = Qt.ItemDataRole.EditRole) -> bool:
        if role != Qt.ItemDataRole.EditRole or not index.isValid():
            return False
        row, column = index.row(), index.column()
        try:
            number = _number(value)
        except (EditError, ExpressionError) as reason:
            self.refused.emit(f"{self.label(row, column)}: {reason}")
            return False
        if number == self.values[row, column] and not self.estimated[row, column]:
            return True
        self._is_refused = False
        self.number_entered.emit(row, self.columns[column], number)
        return not self._is_refused

    def refuse(self) -> None:
        """Record that the number entered last was refused."""
        self._is_refused = True

    # Texts and colours

    def label(self, row: int, column: int) -> str:
        """Return the label of a cell, such as "x of point 3"."""
        return self.columns[column].at(row)

    def _rounded(self, row: int, column: int) -> str:
        value = float(self.values[row, column])
        if abs(value) < self.numbers_of_columns[column].negligible:
            value = 0.0
        return number(value, max(6, self.numbers_of_columns[column].distinguishing), decimal_mark())

    def _read_aloud(self, row: int, column: int) -> str:
        return f"{self.label(row, column)}: {self._rounded(row, column)}{self._corner_note(row, column)}"

    def _describe(self, row: int, column: int) -> str:
        exact = with_minus(exact_text(float(self.values[row, column]), decimal_mark()))
        text = f"{self.label(row, column)} = {exact}" if exact else f"{self.label(row, column)}: no value"
        text += self._corner_note(row, column)
        return f"{text}\n{self._estimate(column)}" if self.estimated[row, column] else text

    def _corner_note(self, row: int, column: int) -> str:
        """Return the addition to a tooltip where a point has two numbers, of which the table shows one."""
        after, view = self.columns[column].after, self._view
        if view is None or after is None or not self.shows_one_side(row, column):
            return ""
        ahead = with_minus(exact_text(float(after(view, row)), decimal_mark()))
        point = "corner" if self._kind(row) is CORNER else "point"
        return f", before the {point}; {ahead} after it"

    def _estimate(self, column: int) -> str:
        estimate = self.columns[column].estimate
        return "estimated" if estimate is None or self._view is None else estimate(self._view.source)

    def _mark(self, row: int) -> QPixmap | None:
        if row >= len(self.values):
            return None
        colour = point_colours(len(self.values), self._theme)[row]
        kind = POINT_KINDS.index(self._kind(row))
        return mark_picture(colour.name(), self._theme.paper.name(), _SWATCH, kind)

    def _kind(self, row: int) -> PointKind:
        # Rows that are being removed have no kinds any more.
        return POINT_KINDS[self._kinds[row]] if row < len(self._kinds) else POINT_KINDS[-1]


def _number(value: object) -> float:
    if isinstance(value, str):
        return parse_number(value, decimal_mark())
    if isinstance(value, int | float | np.floating | np.integer) and not isinstance(value, bool):
        return checked(float(value), "It")
    raise ExpressionError("This is not a number.")
