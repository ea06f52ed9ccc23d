"""How a cell of the point table is drawn and edited."""

from __future__ import annotations

from PySide6.QtCore import (
    QAbstractItemModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRect,
    Qt,
    Signal,
)
from PySide6.QtGui import QFont, QFontMetrics, QKeyEvent, QPainter
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QLineEdit,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from app.panels.number_text import column_decimals, column_text, decimal_mark, exact_text
from app.panels.point_table_model import PointTableModel
from app.theme import LIGHT, Theme, mix

_PADDING = 5
_LEAST_DIGITS, _MOST_DIGITS = 3, 6
_ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
_LEAVING = (*_ENTER, Qt.Key.Key_Tab, Qt.Key.Key_Backtab)


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


class PointTableDelegate(QStyledItemDelegate):
    """Draws numbers in columns and keeps an editor open until its text is a number or is given up.

    Signals
    -------
    edit_began
        Somebody types, or begins to: what was said about the last number is out of date.
    entered
        A number was committed with Enter.
    """

    edit_began = Signal()
    entered = Signal()

    def __init__(self, model: PointTableModel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._model = model
        self._theme = LIGHT
        self._formats: dict[int, tuple[tuple[int, int], int, int]] = {}

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme

    # Drawing

    def paint(
        self,
        painter: QPainter,
        option: QStyleOptionViewItem,
        index: QModelIndex | QPersistentModelIndex,
    ) -> None:
        # Drawn here rather than by the style, which asks the model for a dozen roles of every cell.
        rect, theme, row, column = option.rect, self._theme, index.row(), index.column()
        estimated = bool(self._model.estimated[row, column])
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(rect, mix(theme.accent, theme.paper, 0.2))
        painter.setPen(theme.grid_fine)
        painter.drawLine(rect.bottomLeft(), rect.bottomRight())
        digits, decimals = self._format(column, rect.width(), option.fontMetrics)
        text = column_text(float(self._model.values[row, column]), decimals, digits, decimal_mark())
        painter.setFont(_italic(option.font) if estimated else option.font)
        painter.setPen(theme.muted if estimated else theme.ink)
        painter.drawText(
            rect.adjusted(0, 0, -_PADDING, 0),
            int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter),
            text,
        )
        if option.state & QStyle.StateFlag.State_HasFocus:
            painter.setPen(theme.accent)
            painter.drawRect(rect.adjusted(0, 0, -1, -1))

    def _format(self, column: int, width: int, metrics: QFontMetrics) -> tuple[int, int]:
        """Return (digits, decimals) of a column: as many digits as its width has room for."""
        key = (self._model.version, width)
        known = self._formats.get(column)
        if known is None or known[0] != key:
            values = self._model.values[:, column]
            signs = metrics.horizontalAdvance("−." if (values < 0).any() else ".")
            room = (width - 2 * _PADDING - signs) // max(metrics.horizontalAdvance("0"), 1)
            digits = min(max(room, _LEAST_DIGITS), _MOST_DIGITS)
            known = (key, digits, column_decimals(values, digits))
            self._formats[column] = known
        return known[1], known[2]

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
        assert isinstance(editor, CellEditor)
        self._take(editor)

    def _take(self, editor: CellEditor) -> bool:
        """Set the number that was typed, if one was; return whether the editor may close."""
        text = editor.text()
        if text == editor.opened_with:
            return True
        if not self._model.setData(editor.index, text):
            return False
        editor.opened_with = text
        return True

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if (
            isinstance(editor, CellEditor)
            and isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and event.key() in _LEAVING
        ):
            if not self._take(editor):
                editor.selectAll()
                return True  # it stays open, and the table says why
            if event.key() in _ENTER:
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
        wanted = editor.fontMetrics().horizontalAdvance(editor.text()) + 4 * _PADDING
        width = min(max(wanted, cell.width()), viewport.width())
        left = max(min(cell.right() + 1 - width, viewport.width() - width), 0)
        editor.setGeometry(QRect(left, cell.top(), width, cell.height()))


def _italic(font: QFont) -> QFont:
    italic = QFont(font)
    italic.setItalic(True)
    return italic
