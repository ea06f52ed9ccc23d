"""The history: every step that can be taken back, as a list."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import (
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QUndoView,
    QVBoxLayout,
    QWidget,
)

from app.overrides import Guarded
from app.session import Session
from app.theme import mix, theme_of

_MARGIN = 6
"""Pixels between the edge and the text of a row, besides what the style leaves."""


class _StepDelegate(Guarded, QStyledItemDelegate):
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
        size = super().sizeHint(option, index)
        return QSize(size.width(), option.fontMetrics.height() + 8)


class HistoryPanel(QWidget):
    """The undo stack; a click on a step goes there.

    Attributes
    ----------
    view
        The QUndoView.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("historyPanel")
        self._session = session
        self.view = QUndoView(session.undo_stack, self)
        self.view.setObjectName("historyView")
        self.view.setAccessibleName("History")
        self.view.setToolTip("Click a step to go back or forward to it (↑ ↓)")
        self.view.setFrameShape(QUndoView.Shape.NoFrame)
        self.view.setUniformItemSizes(True)
        self._delegate = _StepDelegate(self.view)
        self.view.setItemDelegate(self._delegate)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.view)
        session.opened.connect(self._name_the_beginning)
        self.view.setEmptyLabel(_opened(session) if session.path is not None else "Start")

    def _name_the_beginning(self) -> None:
        if self._session.undo_stack.count():
            return  # a lesson or an example was opened as a step; it began with something else
        self.view.setEmptyLabel(_opened(self._session))


def _opened(session: Session) -> str:
    """Return what a history begins with after a document was opened or begun."""
    if session.path is not None:
        return f"Opened {session.path.name}"
    return f"Opened {session.active_curve.name}" if session.active_curve.nodes else "New document"
