"""Bars over the canvas: a sentence about the most urgent problem or hint, with buttons; no dialog."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import zip_longest

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QBoxLayout, QSizePolicy, QToolButton, QWidget

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..qt.labels import Label
from ..widgets.boxes import column_of, remove_widgets, row_of
from ..widgets.controls import action_button, tool_button
from ..widgets.frames import OverlayFrame

_TOP, _SIDE, _NARROWEST = 10, 56, 120
_WIDEST = 48
"""Largest width in heights of a line."""

_OFFERS = ("offeredAction", "secondOffer")
_AROUND_SENTENCE = 90
"""Pixels for the icon, the close button and the gaps."""

GAP = 8
"""Pixels between the parts of a bar."""


class SentenceBar(OverlayFrame):
    """Bar with an icon, a sentence and a close button; hidden without a sentence.

    Attributes
    ----------
    clear_top
        Function that returns the height to keep free at the top of the parent, in pixels.

    Signals
    -------
    closed
        The person has put this sentence away.
    """

    closed = Signal(str)

    def __init__(
        self, kind: str, close_name: str, below: QWidget, beside: QWidget | None = None, *buttons: QToolButton
    ) -> None:
        super().__init__(f"{kind}Bar", below, beside)
        self._beside = beside
        self.clear_top: Callable[[], float] = lambda: 0.0
        self._is_warning = False
        self.sign, self.sentence = Label(), Label(name=f"{kind}Text", wordWrap=True)
        self.sentence.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        words = "Dismiss this message"
        self.close_button = tool_button(close_name, words, words, flat=True)
        self.close_button.clicked.connect(self._put_away)
        keep_pointer(self.close_button)
        self._buttons = list(buttons)
        self._row = row_of(*buttons, 1, spacing=GAP)
        self._middle = column_of((self.sentence, 1), self._row, spacing=4)
        parts = (self.sign, (self._middle, 1), self.close_button)
        row_of(*parts, margins=(12, 6, 8, 6), spacing=GAP, parent=self)
        self.hide()

    @property
    def text(self) -> str:
        """The displayed sentence; empty while the bar is hidden."""
        return "" if self.isHidden() else self.sentence.text()

    def show_sentence(self, text: str, *, warns: bool) -> None:
        """Show a warning or a hint."""
        self.sentence.setText(text)
        if warns != self._is_warning:
            self._is_warning = warns
            self._paint_sign()
        self.show()
        self.place()
        self.raise_()

    def _put_away(self) -> None:
        self.hide()
        self.closed.emit(self.sentence.text())

    def place_buttons(self, room: int) -> int:
        """Put the buttons beside the sentence where they fit, else below; return the preferred width."""
        sentence = self.sentence.fontMetrics().horizontalAdvance(self.sentence.text()) + _AROUND_SENTENCE
        buttons = sum(button.sizeHint().width() + GAP for button in self._buttons if not button.isHidden())
        is_one_row = sentence + buttons <= room
        across, down = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
        self._middle.setDirection(across if is_one_row else down)
        return sentence + buttons if is_one_row else max(sentence, buttons + 60)

    def place(self) -> None:
        """Move to the top centre, as wide as the sentence needs."""
        widest = _WIDEST * self.sentence.fontMetrics().height()
        room = min(self.below.width() - 2 * _SIDE, widest)
        width = max(min(self.place_buttons(room), room), _NARROWEST)
        if (layout := self.layout()) is not None:
            layout.activate()
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        top = _TOP + round(self.clear_top())
        if self._beside is not None and not self._beside.isHidden():
            top = self._beside.geometry().bottom() + 1 + GAP
        self.setGeometry((self.below.width() - width) // 2, top, width, height)

    def set_theme(self, theme: Theme) -> None:
        self.close_button.setIcon(icon("close", theme))
        self.set_sheet()
        self._paint_sign()

    def _paint_sign(self) -> None:
        colour = (self.theme.warning if self._is_warning else self.theme.muted).name()
        self.sign.setPixmap(icon("warning" if self._is_warning else "help", self.theme).pixmap(QSize(16, 16)))
        self.sentence.setStyleSheet(f"color: {colour}")


def keep_pointer(button: QToolButton) -> None:
    """Keep mouse moves over a button from the widget below."""
    button.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)


class MessageBar(SentenceBar):
    """Message bar of the window, with up to two actions.

    The bar lies over the canvas, so that the drawing does not move when a message appears.
    A press on the bar, except on its buttons, is a press on the canvas.
    """

    def __init__(self, parent: QWidget) -> None:
        words = "Suggested action"
        buttons = [tool_button(name, words, words, icon_size=14) for name in _OFFERS]
        super().__init__("message", "closeMessage", parent, None, *buttons)
        for button in buttons:
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            button.hide()
            keep_pointer(button)
        for part in (self, self.sign, self.sentence):
            # Mouse moves reach the plot below, which shows the hint about a press.
            part.setMouseTracking(True)
        self.follow_theme()

    @property
    def covered(self) -> int:
        """Height that the bar covers at the top of its parent, in pixels."""
        return 0 if self.isHidden() else self.geometry().bottom() + 1

    def warn(self, text: str, action: QAction | None = None) -> None:
        """Show a problem, with a button for the action that solves it."""
        self._show(text, [action] if action is not None else [], warns=True)

    def tell(self, text: str, actions: Sequence[QAction] = ()) -> None:
        """Show a sentence with a button for each action."""
        self._show(text, actions, warns=False)

    def _show(self, text: str, actions: Sequence[QAction], *, warns: bool) -> None:
        if self.text == text and sum(not button.isHidden() for button in self._buttons) == len(actions):
            return
        for button, action in zip_longest(self._buttons, actions):
            if action is not None:
                button.setDefaultAction(action)
                button.setAccessibleName(action.text())
            button.setVisible(action is not None)
        self.show_sentence(text, warns=warns)


class NoticeBar(SentenceBar):
    """Sentence with buttons, below a visible bar `above`; its parts are named after `kind`."""

    def __init__(self, kind: str, parent: QWidget, above: QWidget | None = None) -> None:
        super().__init__(kind, f"close{kind.capitalize()}Bar", parent, above)
        self.follow_theme()

    @property
    def offered(self) -> list[str]:
        """Names of the actions of the buttons."""
        return [] if self.isHidden() else [button.defaultAction().objectName() for button in self._buttons]

    def button(self, name: str) -> QToolButton:
        """Return the button of an action."""
        return next(button for button in self._buttons if button.defaultAction().objectName() == name)

    def show_notice(self, text: str, actions: Sequence[QAction], *, warns: bool) -> None:
        """Show a sentence with a button for each action."""
        if self.text == text and self.offered == [action.objectName() for action in actions]:
            return
        remove_widgets(self._row, self._buttons)
        self._buttons = [action_button(action, self, icon_size=14, beside=True) for action in actions]
        for index, button in enumerate(self._buttons):
            keep_pointer(button)
            self._row.insertWidget(index, button)
            button.show()
        self.show_sentence(text, warns=warns)
