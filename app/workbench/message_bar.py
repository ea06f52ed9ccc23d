"""One line on top of the canvas for what the person must know now, instead of a dialog."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFrame, QHBoxLayout, QSizePolicy, QWidget

from app.appearance.icons import icon
from app.appearance.theme import LIGHT, Theme, mix
from app.qt.labels import Label
from app.qt.overrides import Guarded
from app.widgets.tool_buttons import tool_button

_TOP, _SIDE, _WIDEST = 10, 56, 720
_GAP = 8


class MessageBar(Guarded, QFrame):
    """A sentence with a sign; hidden while there is nothing to say.

    It lies on top of its parent and takes no room from it: a drawing that moved when a message appears would
    move under the hand. What is pressed on it, but for its buttons, is pressed on the parent.

    Signals
    -------
    closed
        The person has put this sentence away.
    """

    closed = Signal(str)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("messageBar")
        parent.installEventFilter(self)
        self._theme = LIGHT
        self._is_warning = False
        self._sign = Label()
        self._text = Label()
        self._text.setObjectName("messageText")
        self._text.setWordWrap(True)
        self._text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        words = "Put this message away"
        self._close = tool_button("closeMessage", words, words, flat=True)
        self._close.clicked.connect(self._put_away)
        words = "What can be done about it"
        self._offer = tool_button("offeredAction", words, words, icon_size=14)
        self._offer.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self._offer.hide()
        for button in (self._close, self._offer):
            # A pointer that moves on a button moves over nothing below it.
            button.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(12, 6, 8, 6)
        layout.setSpacing(_GAP)
        layout.addWidget(self._sign)
        layout.addWidget(self._text, 1)
        layout.addWidget(self._offer)
        layout.addWidget(self._close)
        for part in (self, self._sign, self._text):
            # What lies below hears of a pointer that only passes, too, and says what a press would do.
            part.setMouseTracking(True)
        self.hide()

    @property
    def _below(self) -> QWidget:
        """Parent widget, asked for anew: for PySide6 a viewport that was kept was once gone."""
        below = self.parentWidget()
        assert below is not None
        return below

    @property
    def text(self) -> str:
        """The sentence on screen, empty while the bar is hidden."""
        return "" if self.isHidden() else self._text.text()

    @property
    def covered(self) -> int:
        """How many pixels of its parent's height it takes at the top."""
        return 0 if self.isHidden() else self.geometry().bottom() + 1

    def warn(self, text: str, action: QAction | None = None) -> None:
        """Show what is wrong and what to do, with a button where one thing does it."""
        self._show(text, warning=True, action=action)

    def tell(self, text: str) -> None:
        """Show a hint."""
        self._show(text, warning=False)

    def offer(self, text: str, action: QAction) -> None:
        """Show a sentence, and a button for what can be done about it."""
        self._show(text, warning=False, action=action)

    def _show(self, text: str, *, warning: bool, action: QAction | None = None) -> None:
        if self.text == text and self._offer.isHidden() is (action is None):
            return
        if action is not None:
            self._offer.setDefaultAction(action)
            self._offer.setAccessibleName(action.text())
        self._offer.setVisible(action is not None)
        self._is_warning = warning
        self._text.setText(text)
        self._paint_sign()
        self._place()
        self.show()
        self.raise_()

    def _place(self) -> None:
        """Lie at the top, in the middle, as wide as the sentence needs."""
        room = self._below.width() - 2 * _SIDE
        needed = self._text.fontMetrics().horizontalAdvance(self._text.text()) + 90
        if not self._offer.isHidden():
            needed += self._offer.sizeHint().width() + _GAP
        width = max(min(needed, room, _WIDEST), 120)
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        self.setGeometry((self._below.width() - width) // 2, _TOP, width, height)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize and not self.isHidden():
            self._place()
        return super().eventFilter(watched, event)

    def _put_away(self) -> None:
        self.hide()
        self.closed.emit(self._text.text())

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme
        self._close.setIcon(icon("close", theme))
        surface, line = theme.surface.name(), mix(theme.ink, theme.paper, 0.14).name()
        self.setStyleSheet(
            f"#messageBar {{ background: {surface}; border: 1px solid {line}; border-radius: 8px }}"
        )
        self._paint_sign()

    def _paint_sign(self) -> None:
        colour = (self._theme.warning if self._is_warning else self._theme.muted).name()
        size = QSize(16, 16)
        self._sign.setPixmap(icon("warning" if self._is_warning else "help", self._theme).pixmap(size))
        self._text.setStyleSheet(f"color: {colour}")
