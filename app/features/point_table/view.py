"""The point table for Qt: how cells are painted and edited, and its mouse, keys and columns."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import msgspec
from PySide6.QtCore import (
    QAbstractItemModel,
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QItemSelectionRange,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QPoint,
    QRect,
    Qt,
    Signal,
    SignalInstance,
)
from PySide6.QtGui import QFocusEvent, QFont, QFontMetrics, QKeyEvent, QKeySequence, QPainter, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemDelegate,
    QAbstractItemView,
    QLineEdit,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from ...appearance.theme import LIGHT, Theme, mix
from ...qt.overrides import DELETE, ENTER, PASSING, ClaimsKeys, SafeOverrides
from ...widgets.controls import named
from ...widgets.fields import end_editing, fit_row_height, set_up_number_table
from ...widgets.number_text import (
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
"""Side in pixels of the mark of a number with a second value, after the corner."""

# As plain numbers: Python's flags are slow, and all visible cells are painted during a drag.
_SELECTED, _FOCUSED = QStyle.StateFlag.State_Selected.value, QStyle.StateFlag.State_HasFocus.value
_RIGHT = int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)

PADDING, LEFT_PADDING = 3, 6
"""Pixels right and left of a number: together the smallest gap between two columns."""

COMPACT_DIGITS = ((4, 4), (4, 3), (3, 3))
"""Digits of positions and of derivatives in a narrow panel: the first pair that fits is used.

Numbers that almost touch are read as one; before that, derivatives lose a digit.
"""

_DIGITS = (6, 5, 4, 3)
_MOST_CACHED = 1000
"""Largest number of cached widths."""

_COMMIT_KEYS = (*ENTER, Qt.Key.Key_Tab, Qt.Key.Key_Backtab)


class ColumnFormat(msgspec.Struct, frozen=True):
    """Format of the numbers of one column: the same for all, so that they can be compared at a glance."""

    digits: int
    decimals: int
    negligible: float


def width_for(extent: Extent, digits: int, metrics: QFontMetrics) -> int:
    """Return the smallest width of a column for such numbers with `digits` digits, gap included.

    It also fits numbers longer than a sign, a point and `digits`: −1043 or 0.001 with three.
    """
    sign = "−" if extent.is_signed else ""
    texts = {sign + "0" * digits + ".", *widest_texts(extent, digits)}
    return max(map(metrics.horizontalAdvance, texts)) + PADDING + LEFT_PADDING


class ColumnWidths:
    """Widths of columns in one font: numbers of the same extent are measured once."""

    def __init__(self) -> None:
        self._metrics: QFontMetrics | None = None
        self._cache: dict[tuple[Extent, int], int] = {}

    def of(self, extent: Extent, digits: int, metrics: QFontMetrics) -> int:
        """Return `width_for` these arguments."""
        if metrics != self._metrics or len(self._cache) > _MOST_CACHED:
            self._metrics, self._cache = metrics, {}
        width = self._cache.get((extent, digits))
        if width is None:
            width = self._cache[extent, digits] = width_for(extent, digits, metrics)
        return width


class CellEditor(QLineEdit):
    """The line in which a number is typed.

    Attributes
    ----------
    index
        The cell.
    opened_with
        The text of the value in the document; committing it unchanged is no edit.
    """

    def __init__(self, index: QModelIndex | QPersistentModelIndex, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("cellEditor")
        self.setFrame(False)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.index = QPersistentModelIndex(index)
        self.opened_with = ""


class PointTableDelegate(SafeOverrides, QStyledItemDelegate):
    """Delegate that draws numbers in columns, and keeps an editor open until its text is a number.

    Only Enter and Tab set a number. A click elsewhere discards the typed text: a digit that was meant as a
    shortcut must never become a coordinate.

    Signals
    -------
    edit_began
        Typing has begun: a message about the last number is out of date.
    number_set
        A typed number was committed: its column.
    entered
        A number was committed with Enter.
    given_up
        An editor was left with a number typed but not set; with its label, such as "x of point 3".
    """

    edit_began = Signal()
    number_set = Signal(int)
    entered = Signal()
    edit_discarded = Signal(str)

    def __init__(self, model: PointTableModel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._model = model
        self._theme = LIGHT
        self._streaming = False
        self._formats: list[ColumnFormat] = []
        self._upright, self._italic = QFont(), QFont()
        self._widths = ColumnWidths()

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self._theme = theme

    # Drawing

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        # Drawn here, not by the style, which asks the model for a dozen roles of every cell.
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
        """Return the font in italics, cached: Qt looks up the glyphs of a new font anew."""
        if font != self._upright:
            self._upright, self._italic = QFont(font), QFont(font)
            self._italic.setItalic(True)
        return self._italic

    def text(self, row: int, column: int) -> str:
        """Return a number in the format of its column."""
        style = self._formats[column] if column < len(self._formats) else ColumnFormat(_DIGITS[0], 3, 0.0)
        value = float(self._model.values[row, column])
        return column_text(value, style.decimals, style.digits, decimal_mark(), negligible=style.negligible)

    def needed_widths(self, digits: int, of_derivatives: int, metrics: QFontMetrics) -> list[int]:
        """Return the smallest widths of the columns for these digits."""
        return [
            self._widths.of(
                numbers.extent,
                (of_derivatives if column.derivatives else digits) + column.more_digits,
                metrics,
            )
            for column, numbers in zip(self._model.columns, self._model.numbers_of_columns, strict=True)
        ]

    def distinguishing_widths(self, metrics: QFontMetrics, usual: int) -> list[int]:
        """Return the smallest widths of columns that distinguish close numbers; 0 where `usual` digits do."""
        return [
            self._widths.of(numbers.extent, numbers.distinguishing, metrics)
            if numbers.distinguishing > usual
            else 0
            for numbers in self._model.numbers_of_columns
        ]

    def update_formats(self, widths: Sequence[int], metrics: QFontMetrics, *, streaming: bool) -> bool:
        """Fit the formats to columns of these widths; return whether one has changed.

        At rest a column has as few decimals as show its numbers exactly, or as many as it has room for.
        While previews are `streaming` it keeps its decimals, and only loses some to a number that outgrows
        the column: digits that appear and disappear at each move would flicker.
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
        old = before[column] if column < len(before) else None
        wanted = numbers.distinguishing if old is None else old.digits
        candidates = (wanted, *_DIGITS) if wanted > _DIGITS[0] else _DIGITS
        fitting = (count for count in candidates if self._widths.of(numbers.extent, count, metrics) <= width)
        digits = next(fitting, _DIGITS[-1])
        if not self._streaming:
            decimals = column_decimals(self._model.values[:, column], digits)
            return ColumnFormat(digits, decimals, numbers.negligible)
        decimals, negligible = most_decimals(numbers.extent.whole_digits, digits), numbers.negligible
        if old is None:
            return ColumnFormat(digits, decimals, negligible)
        return ColumnFormat(min(digits, old.digits), min(decimals, old.decimals), old.negligible)

    # Editing

    def createEditor(
        self, parent: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QWidget:
        editor = CellEditor(index, parent)
        label = self._model.label(index.row(), index.column())
        editor.setAccessibleName(label)
        editor.setToolTip(
            f"{label}: a number or an expression such as 1/3 or sqrt(2)/2 (Enter sets it, Escape cancels)"
        )
        editor.textEdited.connect(self.edit_began)
        editor.textChanged.connect(lambda: self._fit(editor))
        self.edit_began.emit()
        return editor

    def setEditorData(self, editor: QWidget, index: QModelIndex | QPersistentModelIndex) -> None:
        assert isinstance(editor, CellEditor)
        if not editor.isModified():  # a text being typed stays when the curve changes
            value = float(self._model.values[index.row(), index.column()])
            editor.opened_with = exact_text(value, decimal_mark())
            editor.setText(editor.opened_with)

    def setModelData(
        self, editor: QWidget, model: QAbstractItemModel, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Do nothing: Qt calls this for any loss of focus; `_set_typed` handles Enter and Tab."""

    def _set_typed(self, editor: CellEditor) -> bool:
        """Set the typed number, if any; return whether the editor may close."""
        text = editor.text()
        if text == editor.opened_with:
            return True
        if not self._model.setData(editor.index, text):
            return False
        editor.opened_with = text
        self.number_set.emit(editor.index.column())
        return True

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if isinstance(editor, CellEditor) and isinstance(event, QFocusEvent) and event.lostFocus():
            if event.reason() in PASSING:
                return False
            if editor.text() != editor.opened_with:
                self.edit_discarded.emit(self._model.label(editor.index.row(), editor.index.column()))
        if (
            isinstance(editor, CellEditor)
            and isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and event.key() in _COMMIT_KEYS
        ):
            if not self._set_typed(editor):
                editor.selectAll()
                return True  # the editor stays open, and the table shows the reason
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
        """Widen the editor to its text, to the left where there is no room at the right."""
        cell = editor.geometry()
        viewport = editor.parentWidget()
        assert viewport is not None
        needed = editor.fontMetrics().horizontalAdvance(editor.text()) + 4 * PADDING + 4
        width = min(max(needed, cell.width()), viewport.width())
        left = max(min(cell.right() + 1 - width, viewport.width() - width), 0)
        editor.setGeometry(QRect(left, cell.top(), width, cell.height()))


def _paint_corner_mark(painter: QPainter, rect: QRect, theme: Theme) -> None:
    """Fill the upper left corner of a cell, as spreadsheets mark a note, which is in the tooltip."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.accent)
    x, y = rect.left() + 1, rect.top() + 1
    painter.drawPolygon([QPoint(x, y), QPoint(x + _MARK, y), QPoint(x, y + _MARK)])
    painter.restore()


_PLAIN = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier

_EDGE = 8
"""Pixels to the right of the last column, if there is room."""


class PointTableView(ClaimsKeys, QTableView):
    """The table of points, edited like a spreadsheet.

    Signals
    -------
    reset_requested
        Delete was pressed while no position was selected.
    copy_requested, paste_requested
        The keys to copy or paste were pressed.
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
        # The column of the first number that was typed in the current row.
        self._first_typed: int | None = None
        self.cell_delegate.number_set.connect(self._remember_column)
        self.pressed.connect(self._forget_column)
        self.selectionModel().currentChanged.connect(self._follow_row)
        self._streaming = False
        self._set_up_behaviour()
        self._set_up_headers()

    def _set_up_behaviour(self) -> None:
        trigger = QAbstractItemView.EditTrigger
        self.setEditTriggers(trigger.DoubleClicked | trigger.EditKeyPressed | trigger.AnyKeyPressed)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setTabKeyNavigation(True)

    def _set_up_headers(self) -> None:
        set_up_number_table(self, PADDING)  # the delegate draws fine lines between the rows
        across, down = self.horizontalHeader(), self.verticalHeader()
        across.setObjectName("pointTableColumns")
        across.setMinimumSectionSize(20)
        down.setObjectName("pointTableRows")
        down.setHighlightSections(False)
        down.setStyleSheet("QHeaderView::section { padding: 0 6px 0 2px; border: none }")
        corner = self.findChild(QAbstractButton)
        if corner is not None:
            named(corner, "selectAllPoints", "Select all points", "Select all points")

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_first_typed"):
            fit_row_height(self)
            self.fit_columns(streaming=self._streaming)

    # Widths of columns

    def fit_columns(self, *, streaming: bool) -> None:
        """Set widths and formats of the columns for the present numbers.

        While previews are `streaming` the widths stay, because a change would move every row; only a number
        that would overlap its neighbour, such as one that gets a sign, has them computed anew.
        """
        self._streaming = streaming
        if not streaming or self._is_outgrown():
            self._share_width()
        self._fit_formats()

    def _fit_formats(self) -> None:
        """Fit the formats of numbers to the widths of the columns."""
        across, metrics = self.horizontalHeader(), self.fontMetrics()
        widths = [across.sectionSize(column) for column in range(across.count())]
        if self.cell_delegate.update_formats(widths, metrics, streaming=self._streaming):
            self.viewport().update()

    def _share_width(self) -> None:
        """Distribute the width among the columns, each wide enough for a few digits."""
        room, needed = self.viewport().width(), list[int]()
        for needed in self._candidate_widths():
            if sum(needed) + _EDGE // 2 <= room:
                break
        spare = max(room - sum(needed), 0)
        # Numbers at the very edge of the window are hard to read.
        spare, rest = divmod(spare - min(spare, _EDGE), max(len(needed), 1))
        for column, width in enumerate(needed):
            self.horizontalHeader().resizeSection(column, width + spare + (1 if column < rest else 0))

    def _candidate_widths(self) -> Iterator[list[int]]:
        """Yield candidates for the widths of all columns; the last ones are used where none fits."""
        # Numbers that differ look different, even if the table has to be scrolled: x from 1e6 to 1e6 + 1. The
        # last digits of others are left out where there is no room.
        for usual in (COMPACT_DIGITS[-1][0], _DIGITS[0]):
            least = self.cell_delegate.distinguishing_widths(self.fontMetrics(), usual)
            for digits in COMPACT_DIGITS:
                yield [max(both) for both in zip(least, self._needed(*digits), strict=True)]

    def _needed(self, digits: int, of_derivatives: int) -> list[int]:
        return self.cell_delegate.needed_widths(digits, of_derivatives, self.fontMetrics())

    def _is_outgrown(self) -> bool:
        """Return whether a number outgrows its column even with the fewest digits."""
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

    # Selection

    def selected_cells(self) -> set[tuple[int, int]]:
        """Return the selected cells as (row, column)."""
        return {(index.row(), index.column()) for index in self.selectionModel().selectedIndexes()}

    def selected_rows(self) -> frozenset[int]:
        """Return the rows that have a selected cell."""
        return frozenset(row for span in self._spans() for row in range(span.top(), span.bottom() + 1))

    def selected_columns(self) -> frozenset[int]:
        """Return the columns that have a selected cell."""
        return frozenset(column for span in self._spans() for column in range(span.left(), span.right() + 1))

    def _spans(self) -> list[QItemSelectionRange]:
        """Return the rectangles of cells that are selected: few, where the cells may be many."""
        ranges = self.selectionModel().selection()
        return [ranges.at(k) for k in range(ranges.count())]

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

    def no_position_selected(self) -> bool:
        """Return whether cells are selected, none of which belongs to a position."""
        columns = self.selected_columns()
        return bool(columns) and not any(self.numbers.columns[column].is_position for column in columns)

    # Keys

    def claims(self, event: QKeyEvent) -> bool:
        # Digits and letters are shortcuts of the window; here they begin a number. The keys to copy and paste
        # may be shortcuts as well, and Qt triggers nothing where window and widget have the same shortcut.
        return self._is_typing(event) or self._is_reset(event) or self._exchange(event) is not None

    def _exchange(self, event: QKeyEvent) -> SignalInstance | None:
        if event.matches(QKeySequence.StandardKey.Copy):
            return self.copy_requested
        return self.paste_requested if event.matches(QKeySequence.StandardKey.Paste) else None

    def _is_reset(self, event: QKeyEvent) -> bool:
        return event.key() in DELETE and self.no_position_selected()

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
        """Edit a cell; a cell that is being edited keeps its text."""
        field = self.viewport().findChild(CellEditor)
        if self.state() == QTableView.State.EditingState and field is not None and field.index == index:
            field.setFocus()
            return
        end_editing(self)
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
        self.scrollTo(index)
        self.edit(index)

    def _remember_column(self, column: int) -> None:
        self._first_typed = column if self._first_typed is None else self._first_typed

    def _forget_column(self) -> None:
        self._first_typed = None

    def _follow_row(self, current: QModelIndex, previous: QModelIndex) -> None:
        if current.row() != previous.row():
            self._forget_column()

    def _move_down(self) -> None:
        """Go on in the next row, in the column in which typing began."""
        current, first = self.currentIndex(), self._first_typed
        if current.row() + 1 < self.numbers.rowCount():
            column = current.column() if first is None else first
            self.setCurrentIndex(self.numbers.index(current.row() + 1, column))
            self._first_typed = first
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
