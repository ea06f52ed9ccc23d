"""A line to type into that shows a value of the document."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget


class FieldEdit(QLineEdit):
    """Shows a text of the document; what is typed is reported when it is committed, and only if it differs.

    Who hears `committed` and cannot use the text leaves it there; it stays to be mended, and gives way to
    the document's when Escape is pressed or the focus leaves.

    Signals
    -------
    committed
        Another text was typed, and Enter pressed or the field left.
    left
        Typing begins, or was given up: what was said about the last text is out of date.
    """

    committed = Signal(str)
    left = Signal()

    def __init__(self, name: str, label: str, tip: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.setAccessibleName(label)
        self.setToolTip(tip)
        self._shown = ""
        self.editingFinished.connect(self._commit)
        self.textEdited.connect(self.left)

    def show_text(self, text: str) -> None:
        """Show the document's text, unless somebody is typing another."""
        self._shown = text
        if not self.isModified() and self.text() != text:
            self.setText(text)
            self.setCursorPosition(0)

    def revert(self) -> None:
        """Show the document's text again."""
        self.setModified(False)
        self.setText(self._shown)

    def _commit(self) -> None:
        if not self.isModified():
            return
        if self.text() == self._shown:
            self.setModified(False)
            return
        typed = self.text()
        self.setModified(False)  # so that the document's answer may be shown
        self.committed.emit(typed)

    def keep(self, typed: str) -> None:
        """Leave a text that was refused in the field, to be mended."""
        self.setText(typed)
        self.setModified(True)
        self.selectAll()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if self.isModified() and event.reason() != Qt.FocusReason.PopupFocusReason:
            self.revert()

    def event(self, event: QEvent) -> bool:
        # Escape is the window's key, too; while somebody types here it takes back what was typed.
        if (
            isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.ShortcutOverride
            and event.key() == Qt.Key.Key_Escape
            and self.isModified()
        ):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.isModified():
            self.revert()
            self.left.emit()
        else:
            super().keyPressEvent(event)
