"""A line over the canvas about a file, with a button for everything that can be done."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QBoxLayout, QToolButton, QWidget

from ..widgets.boxes import column_of, row_of
from ..widgets.tool_buttons import action_button
from .message_bar import GAP, SentenceBar, keep_pointer


class NoticeBar(SentenceBar):
    """A sentence with buttons, below the bar `above` where that is shown; its parts are named by `kind`."""

    def __init__(self, kind: str, parent: QWidget, above: QWidget | None = None) -> None:
        super().__init__(kind, f"close{kind.capitalize()}Bar", parent, above)
        self._buttons: list[QToolButton] = []
        self._row = row_of(1, spacing=GAP)
        self._middle = column_of((self.sentence, 1), self._row, spacing=4)
        parts = (self.sign, (self._middle, 1), self.close_button)
        row_of(*parts, margins=(12, 6, 8, 6), spacing=GAP, parent=self)
        self.follow_theme()

    @property
    def offered(self) -> list[str]:
        """The names of the actions that the buttons stand for."""
        return [] if self.isHidden() else [button.defaultAction().objectName() for button in self._buttons]

    def button(self, name: str) -> QToolButton:
        """Return the button that stands for the action of this name."""
        return next(button for button in self._buttons if button.defaultAction().objectName() == name)

    def show_notice(self, text: str, actions: Sequence[QAction], *, warns: bool) -> None:
        """Show a sentence, and a button for each of the actions."""
        if self.text == text and self.offered == [action.objectName() for action in actions]:
            return
        for button in self._buttons:
            self._row.removeWidget(button)
            button.hide()
            button.deleteLater()
        self._buttons = [action_button(action, self, icon_size=14, beside=True) for action in actions]
        for place, button in enumerate(self._buttons):
            keep_pointer(button)
            self._row.insertWidget(place, button)
            button.show()
        self.show_sentence(text, warns=warns)

    def wanted_width(self, sentence: int, room: int) -> int:
        """Return how wide the bar is; the buttons stand beside the sentence if they fit, else below."""
        buttons = sum(button.sizeHint().width() + GAP for button in self._buttons)
        is_one_row = sentence + buttons <= room
        across, down = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
        self._middle.setDirection(across if is_one_row else down)
        return sentence + buttons if is_one_row else max(sentence, buttons + 60)
