"""Field on the canvas for the position of a guide."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtWidgets import QWidget

from ...appearance.theme import Theme
from ...document.expression import ExpressionError
from ...document.model import Axis, Guide
from ...qt.labels import WARNING, Label
from ...widgets.boxes import column_of, row_of
from ...widgets.fields import PopupLine
from ...widgets.frames import OverlayFrame
from ...widgets.number_text import read_length, typed_text

_TIP = "Position of the guide: a number or an expression, with an optional unit, such as 20, 1/3 or 1 in"
_WIDTH = 110


class GuideField(OverlayFrame):
    """Frame beside a ruler with a field for the position of a guide.

    Attributes
    ----------
    edit
        The line to type into.

    Signals
    -------
    entered
        A guide at this position is requested.
    closed
        The field is closed, after input or not.
    """

    entered = Signal(object)
    closed = Signal()

    def __init__(self, below: QWidget) -> None:
        super().__init__("guideField", below)
        self.setAccessibleName("Guide")
        self._axis, self._unit = Axis.X, ""
        self._now = 0.0
        self._corner: Callable[[], QPoint] = lambda: QPoint(0, 0)
        self.edit = PopupLine("guidePlace", "Position of the guide", _TIP)
        self.edit.setFixedWidth(_WIDTH)
        self.edit.entered.connect(self._enter)
        for end in (self.edit.given_up, self.edit.left):
            end.connect(self.close_field)
        self.edit.textEdited.connect(lambda: self._say(""))
        self._label, self._suffix = Label(), Label()
        self._remark = Label(name="guideRemark", wordWrap=True, role=WARNING)
        row = row_of(self._label, self.edit, self._suffix, spacing=6)
        column_of(row, self._remark, margins=(8, 6, 8, 6), spacing=4, parent=self)
        self.hide()
        self.follow_theme()

    @property
    def remark(self) -> str:
        """Reason why the input cannot be used; empty where it can."""
        return "" if self._remark.isHidden() else self._remark.text()

    def open_for(
        self,
        axis: Axis,
        position: float | None,
        unit: str,
        corner: Callable[[], QPoint],
    ) -> None:
        """Ask for the position of a guide across an axis, at a corner of the canvas.

        `position` is the current position; None for a new guide.
        """
        self._axis, self._unit, self._corner = axis, unit, corner
        self._now = 0.0 if position is None else position
        self._label.setText(f"{axis.value} =")
        self._suffix.show_text(unit)
        self.edit.setText("" if position is None else typed_text(self._now))
        self._say("")
        self.show()
        self.raise_()
        self.edit.setFocus(Qt.FocusReason.OtherFocusReason)
        self.edit.selectAll()

    def close_field(self) -> None:
        """Hide the field, if it is visible."""
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

    def _enter(self) -> None:
        text = self.edit.text()
        if not text.strip():
            self.close_field()
            return
        try:
            typed = read_length(text, self._unit, self._now)
        except ExpressionError as reason:
            self._say(str(reason))
            self.edit.selectAll()
            return
        self.close_field()
        self.entered.emit(Guide(self._axis, typed))

    def _say(self, text: str) -> None:
        self._remark.show_problem(text)
        self.place()
