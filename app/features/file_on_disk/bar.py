"""A line over the canvas about the document's file, with a button for everything that can be done."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QApplication,
    QBoxLayout,
    QFrame,
    QHBoxLayout,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from app.appearance.icons import icon
from app.appearance.theme import mix, theme_of
from app.qt.labels import Label
from app.qt.overrides import Guarded
from app.widgets.tool_buttons import action_button, tool_button

_TOP, _SIDE, _WIDEST = 10, 56, 720
_GAP = 8


class FileBar(Guarded, QFrame):
    """A sentence with buttons; hidden while there is nothing to say.

    It lies on top of its parent, below the bar `above` where that is shown.

    Signals
    -------
    closed
        The person has put the sentence away.
    """

    closed = Signal()

    def __init__(self, parent: QWidget, above: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("fileBar")
        self._below, self._above = parent, above
        self._is_warning = False
        self._sign, self._text = Label(), Label()
        self._text.setObjectName("fileText")
        self._text.setWordWrap(True)
        self._text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        words = "Put this message away"
        self._close = tool_button("closeFileBar", words, words, flat=True)
        self._close.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self._close.clicked.connect(self._put_away)
        self._buttons: list[QToolButton] = []
        self._lay_out()
        for watched in (parent, above):
            watched.installEventFilter(self)
        self.hide()

    def _lay_out(self) -> None:
        self._row = QHBoxLayout()
        self._row.setSpacing(_GAP)
        self._row.addStretch(1)
        self._middle = QBoxLayout(QBoxLayout.Direction.TopToBottom)
        self._middle.setSpacing(4)
        self._middle.addWidget(self._text, 1)
        self._middle.addLayout(self._row)
        whole = QHBoxLayout(self)
        whole.setContentsMargins(12, 6, 8, 6)
        whole.setSpacing(_GAP)
        whole.addWidget(self._sign)
        whole.addLayout(self._middle, 1)
        whole.addWidget(self._close)

    @property
    def text(self) -> str:
        """The sentence on screen, empty while the bar is hidden."""
        return "" if self.isHidden() else self._text.text()

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
        self._text.setText(text)
        self._is_warning = warns
        for button in self._buttons:
            self._row.removeWidget(button)
            button.hide()
            button.deleteLater()
        self._buttons = [self._button(action) for action in actions]
        for place, button in enumerate(self._buttons):
            self._row.insertWidget(place, button)
            button.show()
        self._apply_theme()
        self.show()
        self._place()
        self.raise_()

    def _button(self, action: QAction) -> QToolButton:
        button = action_button(action, self, icon_size=14, beside=True)
        # A pointer that moves on a button moves over nothing below it.
        button.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        return button

    def _place(self) -> None:
        """Lie at the top, in the middle; the buttons stand beside the sentence if they fit, else below."""
        room = min(self._below.width() - 2 * _SIDE, _WIDEST)
        sentence = self._text.fontMetrics().horizontalAdvance(self._text.text()) + 90
        buttons = sum(button.sizeHint().width() + _GAP for button in self._buttons)
        is_one_row = sentence + buttons <= room
        across, down = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
        self._middle.setDirection(across if is_one_row else down)
        width = sentence + buttons if is_one_row else max(sentence, buttons + 60)
        width = max(min(width, room), 120)
        layout = self.layout()
        assert layout is not None
        layout.activate()
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        top = _TOP
        if not self._above.isHidden():
            top = self._above.geometry().bottom() + 1 + _GAP
        self.setGeometry((self._below.width() - width) // 2, top, width, height)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        kinds = (QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.Show, QEvent.Type.Hide)
        if event.type() in kinds and not self.isHidden():
            self._place()
        return super().eventFilter(watched, event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and not self.isHidden():
            self._apply_theme()

    def _put_away(self) -> None:
        self.hide()
        self.closed.emit()

    def _apply_theme(self) -> None:
        """Take the colours of the theme."""
        theme = theme_of(QApplication.palette())
        self._close.setIcon(icon("close", theme))
        surface, line = theme.surface.name(), mix(theme.ink, theme.paper, 0.14).name()
        style = f"#fileBar {{ background: {surface}; border: 1px solid {line}; border-radius: 8px }}"
        if style != self.styleSheet():
            self.setStyleSheet(style)
        self._sign.setPixmap(icon("warning" if self._is_warning else "help", theme).pixmap(QSize(16, 16)))
        colour = (theme.warning if self._is_warning else theme.muted).name()
        self._text.setStyleSheet(f"color: {colour}")
