"""The history: every step that can be taken back, as a list."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize
from PySide6.QtGui import QPalette, QUndoStack
from PySide6.QtWidgets import QStyledItemDelegate, QStyleOptionViewItem, QUndoView, QWidget

from ...appearance.theme import mix, theme_of
from ...qt.overrides import SafeOverrides
from ...widgets.boxes import column_of
from ...widgets.controls import named

_MARGIN = 6
"""Pixels between the edge and the text of a row, besides what the style leaves."""


class _StepDelegate(SafeOverrides, QStyledItemDelegate):
    """Draws what was taken back in muted italics: it is there to be done again."""

    def __init__(self, view: QUndoView) -> None:
        super().__init__(view)
        self._view = view

    def initStyleOption(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().initStyleOption(option, index)
        theme = theme_of(self._view.palette())
        palette = QPalette(option.palette)
        palette.setColor(QPalette.ColorRole.Highlight, mix(theme.accent, theme.paper, 0.2))
        palette.setColor(QPalette.ColorRole.HighlightedText, theme.ink)
        if index.row() > self._view.stack().index():
            palette.setColor(QPalette.ColorRole.Text, theme.muted)
            option.font.setItalic(True)
        option.palette = palette
        # An empty sign before the text keeps it off the edge, and leaves the row's colour as wide as the row.
        option.features |= QStyleOptionViewItem.ViewItemFeature.HasDecoration
        option.decorationSize = QSize(_MARGIN, 1)

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        # As wide as the list is; the style would look at all that is drawn of the row.
        return QSize(0, option.fontMetrics.height() + 8)


class HistoryPanel(QWidget):
    """The undo stack; a click on a step goes there.

    Attributes
    ----------
    view
        The QUndoView.
    """

    def __init__(self, steps: QUndoStack, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("historyPanel")
        self.view = QUndoView(steps, self)
        named(self.view, "historyView", "History", "Click a step to go back or forward to it (↑ ↓)")
        self.view.setFrameShape(QUndoView.Shape.NoFrame)
        self.view.setUniformItemSizes(True)
        self._delegate = _StepDelegate(self.view)
        self.view.setItemDelegate(self._delegate)
        column_of(self.view, margins=0, parent=self)
        self.name_beginning("Start")

    def name_beginning(self, text: str) -> None:
        """Show `text` as what came before the first step."""
        if text != self.view.emptyLabel():
            self.view.setEmptyLabel(text)
