"""A line to type t into, at the tick it belongs to."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from ...appearance.theme import Theme
from ...document.expression import ExpressionError
from ...qt.labels import Label
from ...qt.overrides import ENTER, PASSING, SafeOverrides
from ...widgets.boxes import column_of
from ...widgets.controls import named
from ...widgets.fields import read_number
from ...widgets.frames import OverlayFrame
from ...widgets.number_text import decimal_mark, exact_text

_WIDTH, _WIDEST_REASON = 150, 320


class TickEdit(OverlayFrame):
    """Takes a number or an expression; Enter sets it, Escape or a click elsewhere gives it up.

    What cannot be set is explained above the line, and stays there to be mended.

    Signals
    -------
    typed
        (knot, t) was typed and confirmed; who hears it answers with `close_and_return` or `refuse`.
    """

    typed = Signal(int, float)

    def __init__(self, parent: QWidget) -> None:
        super().__init__("tickEdit", parent)
        self._knot = -1
        self._tick = QPointF()
        self._reason = named(Label(), "tickProblem")
        self._reason.setWordWrap(True)
        self.line = _TickLine(self)
        self._rows = column_of(self._reason, self.line, margins=6, spacing=4, parent=self)
        self.follow_theme()
        self.hide()

    @property
    def problem(self) -> str:
        """Why the number typed cannot be set; empty where it can."""
        return self._reason.text()

    def open(self, knot: int, t: float, tick: QPointF) -> None:
        """Type the parameter of `knot`, now `t`, above its tick, which points at a pixel of the parent."""
        self._knot, self._tick = knot, tick
        self.line.setText(exact_text(t, decimal_mark()))
        self.line.selectAll()
        self.refuse("")

    def confirm(self) -> None:
        """Read what was typed and report it."""
        try:
            t = read_number(self.line.text())
        except ExpressionError as reason:
            self.refuse(str(reason))
            return
        self.refuse("")
        self.typed.emit(self._knot, t)

    def refuse(self, reason: str) -> None:
        """Say why the number cannot be set; it stays to be mended."""
        self._reason.setText(reason)
        self._reason.setVisible(bool(reason))
        self.place()
        self.show()
        self.raise_()
        self.line.setFocus(Qt.FocusReason.PopupFocusReason)

    def close_and_return(self) -> None:
        """Put the line away and give the focus to the panel."""
        self.below.setFocus(Qt.FocusReason.PopupFocusReason)
        self.hide()

    def place(self) -> None:
        parent = self.below
        width = min(_WIDEST_REASON if self.problem else _WIDTH, parent.width())
        self._rows.activate()
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        left = min(max(int(self._tick.x()) - width // 2, 0), parent.width() - width)
        self.setGeometry(left, max(int(self._tick.y()) - height - 4, 0), width, height)

    def set_theme(self, theme: Theme) -> None:
        self.set_sheet(f"#tickProblem {{ color: {theme.warning.name()} }}")


class _TickLine(SafeOverrides, QLineEdit):
    def __init__(self, owner: TickEdit) -> None:
        super().__init__(owner)
        self._owner = owner
        tip = "A number or an expression such as 1/3; Enter sets it, Escape leaves it"
        named(self, "tickValue", "Parameter t", tip)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in ENTER:
            self._owner.confirm()
        elif event.key() == Qt.Key.Key_Escape:
            self._owner.close_and_return()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() not in PASSING:
            self._owner.hide()
