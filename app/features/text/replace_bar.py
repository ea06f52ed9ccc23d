"""What is asked to replace words of texts: which, and by what."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...qt.keys import ENTER, ClaimsKeys
from ...qt.labels import Label
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import named, push_button
from ...widgets.overlay_frame import OverlayFrame
from ...widgets.tool_buttons import tool_button

_ABOVE, _WIDTH = 12, 150
"""Pixels between it and the upper side of what it lies over; and those of a field."""


class ReplaceBar(ClaimsKeys, OverlayFrame):
    """A small frame above the canvas: the words that are sought, and those that replace them.

    Signals
    -------
    asked
        All shall be replaced: the words, and by what.
    sought
        Other words are sought.
    closed
        It is not wanted any more.
    """

    asked = Signal(str, str)
    sought = Signal(str)
    closed = Signal()

    def __init__(self, below: QWidget) -> None:
        super().__init__("replaceBar", below)
        self.setAccessibleName("Replace words")
        self.words = named(QLineEdit(), "replaceSought", "Words", "Words to be replaced, in capitals or not")
        self.by = named(QLineEdit(), "replaceBy", "By", "What stands in their place; nothing takes them out")
        for edit in (self.words, self.by):
            edit.setFixedWidth(_WIDTH)
        self.button = push_button("replaceAll", "Replace All", "Replace them wherever they are (Enter)")
        self.button.clicked.connect(self._ask)
        self.words.textChanged.connect(self.sought)
        self._told = Label(name="replaceTold")
        self._close = tool_button("closeReplace", "Close", "Put this bar away (Escape)", flat=True)
        self._close.clicked.connect(self.closed)
        row = row_of("Replace", self.words, "by", self.by, self.button, self._close, spacing=6)
        column_of(row, self._told, margins=(10, 6, 6, 6), spacing=4, parent=self)
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self.hide()
        self.follow_theme()

    def begin(self) -> None:
        """Show it, ready to be typed in."""
        self.show()
        self.raise_()
        self.words.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.words.selectAll()

    def tell(self, text: str, *, can_be: bool) -> None:
        """Say what is found, and whether it can be replaced."""
        self._told.setText(text)
        self.button.setEnabled(can_be)
        self.place()

    def _ask(self) -> None:
        if self.button.isEnabled():
            self.asked.emit(self.words.text(), self.by.text())

    def place(self) -> None:
        if self.isHidden():
            return
        if (layout := self.layout()) is not None:
            layout.activate()
        below, hint = self.below.size(), self.sizeHint()
        width = min(hint.width(), below.width())
        self.setGeometry((below.width() - width) // 2, _ABOVE, width, hint.height())

    def claims(self, event: QKeyEvent) -> bool:
        return event.key() in (*ENTER, Qt.Key.Key_Escape)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
        elif event.key() in ENTER:
            self._ask()
        else:
            super().keyPressEvent(event)

    def set_theme(self, theme: Theme) -> None:
        self._close.setIcon(icon("close", theme))
        self.set_sheet()
