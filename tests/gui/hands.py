"""Keys and clicks of a person, counted: what a task costs beside Inkscape."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

LEFT, NO_KEYS = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


class Hands:
    """Keys and clicks, each done by a real event and counted; one with modifiers is one, a drag is one.

    Attributes
    ----------
    clicks, keys
        As many as were done.
    """

    def __init__(self, editor):
        self._editor, self.clicks, self.keys = editor, 0, 0

    @property
    def count(self):
        """All of them."""
        return self.clicks + self.keys

    def click(self, at, held=NO_KEYS):
        self.clicks += 1
        self._editor.click(at, keys=held)

    def drag(self, start, to, held=NO_KEYS):
        self.clicks += 1
        self._editor.drag(start, to, keys=held)

    def click_on(self, kind, name, held=NO_KEYS):
        self.clicks += 1
        widget = self._editor.window.findChild(kind, name)
        assert widget is not None, name
        assert widget.isVisible(), name
        QTest.mouseClick(widget, LEFT, held)
        self._editor.settle()

    def press(self, key, held=NO_KEYS):
        self.keys += 1
        QTest.keyClick(QApplication.focusWidget(), key, held)
        self._editor.settle()

    def type(self, text):
        for letter in text:
            self.keys += 1
            QTest.keyClicks(QApplication.focusWidget(), letter)
