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
    QHeaderView,
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
from ...widgets.fields import end_editing
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
    return min(numbers.distinguishing, _MOST_DIGITS) if numbers.distinguishing > _DIGITS[0] else 0


def _paint_corner_mark(painter: QPainter, rect: QRect, theme: Theme) -> None:
    """Fill the upper left corner of a cell, as spreadsheets mark a note: the tooltip has the rest."""
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
        return bool(columns) and not any(self.numbers.columns[column].is_position for column in columns)

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
