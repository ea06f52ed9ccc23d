"""Delegate of the point table: drawing and editing of a cell."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from PySide6.QtCore import (
    QAbstractItemModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QPoint,
    QRect,
    Qt,
    Signal,
)
from PySide6.QtGui import QFocusEvent, QFont, QFontMetrics, QKeyEvent, QPainter
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QLineEdit,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from ...appearance.theme import LIGHT, Theme, mix
from ...qt.overrides import ENTER, PASSING, SafeOverrides
from ...widgets.number_text import (
    ColumnNumbers,
    Extent,
    column_decimals,
    column_text,
    decimal_mark,
    exact_text,
    most_decimals,
    widest_texts,
)
from .model import PointTableModel

_MARK = 6
"""Pixels along the sides of the mark that a number has a second one, after the corner."""

# As plain numbers: Python's flags are slow, and all cells in sight are painted while points are dragged.
_SELECTED, _FOCUSED = QStyle.StateFlag.State_Selected.value, QStyle.StateFlag.State_HasFocus.value
_RIGHT = int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)

PADDING, LEFT_PADDING = 3, 6
"""Pixels right and left of a number: together the least gap between two columns."""

COMPACT_DIGITS = ((4, 4), (4, 3), (3, 3))
"""Digits that columns of places and those of derivatives hold in a narrow panel: the first that fit.

Numbers that almost touch are read as one; before that a derivative is shown with a digit less.
"""

_DIGITS = (6, 5, 4, 3)
_MOST_DIGITS = 15
"""Digits that every float has."""

_MOST_KNOWN = 1000
"""Widths that are kept: of the columns as they have been of late."""

_LEAVING = (*ENTER, Qt.Key.Key_Tab, Qt.Key.Key_Backtab)


class ColumnFormat(msgspec.Struct, frozen=True):
    """Format of the numbers of one column: all alike, so that they can be compared at a glance."""

    digits: int
    decimals: int
    negligible: float


def width_for(extent: Extent, digits: int, metrics: QFontMetrics) -> int:
    """Return how wide a column is at least that writes such numbers with so many digits, gap included.

    Also of a number that takes more than a sign, a point and `digits`: −1043 or 0.001 with three.
    """
    sign = "−" if extent.is_signed else ""
    texts = {sign + "0" * digits + ".", *widest_texts(extent, digits)}
    return max(map(metrics.horizontalAdvance, texts)) + PADDING + LEFT_PADDING


class ColumnWidths:
    """The widths of columns in one font: numbers of the same extent are measured once."""

    def __init__(self) -> None:
        self._metrics: QFontMetrics | None = None
        self._known: dict[tuple[Extent, int], int] = {}

    def of(self, extent: Extent, digits: int, metrics: QFontMetrics) -> int:
        """Return what `width_for` returns."""
        if metrics != self._metrics or len(self._known) > _MOST_KNOWN:
            self._metrics, self._known = metrics, {}
        width = self._known.get((extent, digits))
        if width is None:
            width = self._known[extent, digits] = width_for(extent, digits, metrics)
        return width


class CellEditor(QLineEdit):
    """The line in which a number is typed.

    Attributes
    ----------
    index
        The cell.
    opened_with
        The text that stands for the value in the document; committing this text is no edit.
    """

    def __init__(self, index: QModelIndex | QPersistentModelIndex, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("cellEditor")
        self.setFrame(False)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.index = QPersistentModelIndex(index)
        self.opened_with = ""


class PointTableDelegate(SafeOverrides, QStyledItemDelegate):
    """Draws numbers in columns and keeps an editor open until its text is a number or is given up.

    Only Enter and Tab set a number. An editor that is left by a click elsewhere gives up what was typed: a
    digit meant for a shortcut must never become a coordinate.

    Signals
    -------
    edit_began
        Somebody types, or begins to: what was said about the last number is out of date.
    entered
        A number was committed with Enter.
    given_up
        An editor was left with a number typed but not set; with what it holds, as "x of point 3".
    """

    edit_began = Signal()
    entered = Signal()
    given_up = Signal(str)

    def __init__(self, model: PointTableModel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._model = model
        self._theme = LIGHT
        self._streaming = False
        self._formats: list[ColumnFormat] = []
        self._upright, self._italic = QFont(), QFont()
        self._widths = ColumnWidths()

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme

    # Drawing

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        # Drawn here rather than by the style, which asks the model for a dozen roles of every cell.
        rect, theme, row, column = option.rect, self._theme, index.row(), index.column()
        estimated = bool(self._model.estimated[row, column])
        state = option.state.value
        if state & _SELECTED:
            painter.fillRect(rect, mix(theme.accent, theme.paper, 0.2))
        painter.setPen(theme.grid_fine)
        painter.drawLine(rect.bottomLeft(), rect.bottomRight())
        if self._model.shows_one_side(row, column):
            _paint_corner_mark(painter, rect, theme)
        text = self.text(row, column)
        painter.setFont(self._italic_of(option.font) if estimated else option.font)
        painter.setPen(theme.muted if estimated else theme.ink)
        painter.drawText(rect.adjusted(0, 0, -PADDING, 0), _RIGHT, text)
        if state & _FOCUSED:
            painter.setPen(theme.accent)
            painter.drawRect(rect.adjusted(0, 0, -1, -1))

    def _italic_of(self, font: QFont) -> QFont:
        """Return the font in italics: the last one again, for Qt seeks the glyphs of a new one anew."""
        if font != self._upright:
            self._upright, self._italic = QFont(font), QFont(font)
            self._italic.setItalic(True)
        return self._italic

    def text(self, row: int, column: int) -> str:
        """Return a number as its column writes it."""
        style = self._formats[column] if column < len(self._formats) else ColumnFormat(_DIGITS[0], 3, 0.0)
        value = float(self._model.values[row, column])
        return column_text(value, style.decimals, style.digits, decimal_mark(), negligible=style.negligible)

    def needed_widths(self, digits: int, of_derivatives: int, metrics: QFontMetrics) -> list[int]:
        """Return how wide the columns are at least that hold so many digits."""
        return [
            self._widths.of(numbers.extent, of_derivatives if column.derivatives else digits, metrics)
            for column, numbers in zip(self._model.columns, self._model.numbers_of_columns, strict=True)
        ]

    def telling_widths(self, metrics: QFontMetrics) -> list[int]:
        """Return how wide the columns are at least that tell numbers apart which are close together."""
        return [
            self._widths.of(numbers.extent, digits, metrics) if (digits := _telling(numbers)) else 0
            for numbers in self._model.numbers_of_columns
        ]

    def update_formats(self, widths: Sequence[int], metrics: QFontMetrics, *, streaming: bool) -> bool:
        """Fit the formats to columns of these widths; return whether any is another one now.

        At rest a column has as few decimals as show its numbers exactly, or as many as it has room for.
        While previews are `streaming` it keeps the decimals it has room for, and only ever gives some up
        to a number that outgrows it: digits that come and go with each move flicker.
        """
        old, was_streaming = self._formats, self._streaming
        self._streaming = streaming
        self._formats = [
            self._format(column, width, metrics, old if was_streaming else [])
            for column, width in enumerate(widths)
        ]
        return self._formats != old

    def _format(
        self, column: int, width: int, metrics: QFontMetrics, before: Sequence[ColumnFormat]
    ) -> ColumnFormat:
        numbers = self._model.numbers_of_columns[column]
        telling = 0 if self._streaming else _telling(numbers)
        tried = (telling, *_DIGITS) if telling else _DIGITS
        fitting = (each for each in tried if self._widths.of(numbers.extent, each, metrics) <= width)
        digits = next(fitting, _DIGITS[-1])
        if not self._streaming:
            decimals = column_decimals(self._model.values[:, column], digits)
            return ColumnFormat(digits, decimals, numbers.negligible)
        known = before[column] if column < len(before) else None
        decimals, negligible = most_decimals(numbers.extent.whole_digits, digits), numbers.negligible
        if known is None:
            return ColumnFormat(digits, decimals, negligible)
        return ColumnFormat(min(digits, known.digits), min(decimals, known.decimals), known.negligible)

    # Editing

    def createEditor(
        self, parent: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QWidget:
        editor = CellEditor(index, parent)
        label = self._model.label(index.row(), index.column())
        editor.setAccessibleName(label)
        editor.setToolTip(
            f"{label}: a number or an expression such as 1/3 or sqrt(2)/2 (Enter to set, Esc to leave)"
        )
        editor.textEdited.connect(self.edit_began)
        editor.textChanged.connect(lambda: self._fit(editor))
        self.edit_began.emit()
        return editor

    def setEditorData(self, editor: QWidget, index: QModelIndex | QPersistentModelIndex) -> None:
        assert isinstance(editor, CellEditor)
        if not editor.isModified():  # what is being typed stays when the curve changes below it
            value = float(self._model.values[index.row(), index.column()])
            editor.opened_with = exact_text(value, decimal_mark())
            editor.setText(editor.opened_with)

    def setModelData(
        self, editor: QWidget, model: QAbstractItemModel, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Do nothing: Qt also calls this when an editor is merely left; `_set_typed` hears Enter and Tab."""

    def _set_typed(self, editor: CellEditor) -> bool:
        """Set the number that was typed, if one was; return whether the editor may close."""
        text = editor.text()
        if text == editor.opened_with:
            return True
        if not self._model.setData(editor.index, text):
            return False
        editor.opened_with = text
        return True

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if isinstance(editor, CellEditor) and isinstance(event, QFocusEvent) and event.lostFocus():
            if event.reason() in PASSING:
                return False
            if editor.text() != editor.opened_with:
                self.given_up.emit(self._model.label(editor.index.row(), editor.index.column()))
        if (
            isinstance(editor, CellEditor)
            and isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and event.key() in _LEAVING
        ):
            if not self._set_typed(editor):
                editor.selectAll()
                return True  # it stays open, and the table says why
            if event.key() in ENTER:
                self.closeEditor.emit(editor, QAbstractItemDelegate.EndEditHint.NoHint)
                self.entered.emit()
                return True
        return super().eventFilter(editor, event)

    def updateEditorGeometry(
        self, editor: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        editor.setGeometry(option.rect)
        assert isinstance(editor, CellEditor)
        self._fit(editor)

    @staticmethod
    def _fit(editor: CellEditor) -> None:
        """Widen the editor to what is typed, to the left where there is no room at the right."""
        cell = editor.geometry()
        viewport = editor.parentWidget()
        assert viewport is not None
        wanted = editor.fontMetrics().horizontalAdvance(editor.text()) + 4 * PADDING + 4
        width = min(max(wanted, cell.width()), viewport.width())
        left = max(min(cell.right() + 1 - width, viewport.width() - width), 0)
        editor.setGeometry(QRect(left, cell.top(), width, cell.height()))


def _telling(numbers: ColumnNumbers) -> int:
    """Return the digits that it takes to tell numbers apart where the usual ones do not; else 0."""
    return min(numbers.telling, _MOST_DIGITS) if numbers.telling > _DIGITS[0] else 0


def _paint_corner_mark(painter: QPainter, rect: QRect, theme: Theme) -> None:
    """Fill the upper left corner of a cell, as spreadsheets mark a note: the tooltip has the rest."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.accent)
    x, y = rect.left() + 1, rect.top() + 1
    painter.drawPolygon([QPoint(x, y), QPoint(x + _MARK, y), QPoint(x, y + _MARK)])
    painter.restore()
