"""Fields on the canvas into which one value is typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QApplication, QLineEdit, QToolButton, QWidget

from ..appearance.theme import Theme
from ..document.expression import ExpressionError
from ..qt.keys import ENTER, PASSING, ClaimsKeys
from ..qt.labels import Label
from .boxes import column_of, row_of
from .overlay_frame import OverlayFrame

_WIDTH = 110


class EntryEdit(ClaimsKeys, QLineEdit):
    """A line to type into that is done with Enter and given up with Escape.

    Signals
    -------
    entered
        The text is to be taken.
    given_up
        It is not: Escape, or a click elsewhere.
    """

    entered = Signal()
    given_up = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setFixedWidth(_WIDTH)

    def claims(self, event: QKeyEvent) -> bool:
        return event.key() in (*ENTER, Qt.Key.Key_Escape)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in ENTER:
            self.entered.emit()
        elif event.key() == Qt.Key.Key_Escape:
            self.given_up.emit()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        # Nor where another part of the field has it now.
        frame, now = self.parentWidget(), QApplication.focusWidget()
        goes_on = frame is not None and now is not None and frame.isAncestorOf(now)
        if event.reason() not in PASSING and not goes_on:
            self.given_up.emit()


class EntryField(OverlayFrame):
    """A small frame on the canvas: words for a value, and the value, which is typed.

    Where there are two kinds of it, a button for one of them is what the words are on. `more` stands behind
    the value: lines among it are done with as that is.

    Attributes
    ----------
    edit
        The line to type into.

    Signals
    -------
    closed
        It is done, or given up.
    """

    closed = Signal()

    def __init__(
        self,
        name: str,
        title: str,
        below: QWidget,
        kind: Label | QToolButton,
        edit: EntryEdit,
        *more: QWidget,
    ) -> None:
        super().__init__(name, below)
        self.setAccessibleName(title)
        self._corner: Callable[[], QPoint] = lambda: QPoint(0, 0)
        self._turn, self.edit = kind, edit
        if isinstance(kind, QToolButton):
            # Else a click on it would give the focus to the canvas.
            kind.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            kind.clicked.connect(self._change_kind)
        for line in (edit, *(each for each in more if isinstance(each, EntryEdit))):
            line.entered.connect(self._enter)
            line.given_up.connect(self.close_field)
            line.textEdited.connect(lambda: self._say(""))
        self._suffix = Label()
        self._remark = Label(name=f"{name.removesuffix('Field')}Remark", wordWrap=True)
        row = row_of(kind, edit, self._suffix, *more, spacing=6)
        column_of(row, self._remark, margins=(8, 6, 8, 6), spacing=4, parent=self)
        self.hide()
        self.follow_theme()

    @property
    def remark(self) -> str:
        """Why what was typed cannot be used; empty where it can."""
        return "" if self._remark.isHidden() else self._remark.text()

    def ask(self, text: str, unit: str, corner: Callable[[], QPoint]) -> None:
        """Show a text to begin with, at a corner of the canvas."""
        self._corner = corner
        self._suffix.setText(unit)
        self._suffix.setVisible(bool(unit))
        self.edit.setText(text)
        self._show_kind()
        self._say("")
        self.show()
        self.raise_()
        self.edit.setFocus(Qt.FocusReason.OtherFocusReason)
        self.edit.selectAll()

    def close_field(self) -> None:
        """Put it away, if it is there."""
        if not self.isHidden():
            self.hide()
            self.closed.emit()

    def place(self) -> None:
        if (layout := self.layout()) is not None:
            layout.activate()
        size, below, corner = self.sizeHint(), self.below.size(), self._corner()
        x = max(min(corner.x(), below.width() - size.width()), 0)
        y = max(min(corner.y(), below.height() - size.height()), 0)
        self.setGeometry(x, y, size.width(), size.height())

    def set_theme(self, theme: Theme) -> None:
        self.set_sheet()
        self._remark.setStyleSheet(f"color: {theme.warning.name()}")

    def _kind(self) -> str:
        """Return the words for the value."""
        raise NotImplementedError

    def _other_kind(self) -> None:
        """Go over to the other kind of value, where there is one."""

    def _take(self, text: str) -> Callable[[], object]:
        """Return what tells others of the value; raise ExpressionError with why the text is none."""
        raise NotImplementedError

    def _change_kind(self) -> None:
        self._other_kind()
        self._show_kind()
        self.edit.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_kind(self) -> None:
        self._turn.setText(self._kind())
        self.place()

    def _enter(self) -> None:
        if not self.edit.text().strip():
            self.close_field()
            return
        try:
            tell = self._take(self.edit.text())
        except ExpressionError as reason:
            self._say(f"⚠ {reason}")
            self.edit.selectAll()
            return
        self.close_field()
        tell()

    def _say(self, text: str) -> None:
        self._remark.setText(text)
        self._remark.setVisible(bool(text))
        self.place()
