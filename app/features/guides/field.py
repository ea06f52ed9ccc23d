"""The field on the canvas into which the place of a guide is typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget

from ...appearance.theme import Theme
from ...document.expression import ExpressionError, parse_number
from ...document.guide import Axis, Guide, guide_at
from ...document.value import Vector
from ...qt.keys import ENTER, PASSING, ClaimsKeys
from ...qt.labels import Label
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import named
from ...widgets.number_text import decimal_mark, field_text, typed_text
from ...widgets.overlay_frame import OverlayFrame
from ...widgets.tool_buttons import tool_button
from .places import read_place

_WIDTH = 110
_ANGLE_TIP = "Degrees from the x axis, counterclockwise: 0 is level, 90 upright"
_TIP = "Where the guide lies: a number or an expression, with a unit if you like, such as 20, 1/3 or 1 in"


class PlaceEdit(ClaimsKeys, QLineEdit):
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


class GuideField(OverlayFrame):
    """A small frame beside a ruler, in which the place of one guide is typed.

    Signals
    -------
    entered
        A guide shall be there.
    closed
        It is done, or given up.
    """

    entered = Signal(object)
    closed = Signal()

    def __init__(self, below: QWidget) -> None:
        super().__init__("guideField", below)
        self.setAccessibleName("Guide")
        self._axis, self._unit = Axis.X, ""
        self._guide: Guide | None = None
        self._middle: Vector = (0.0, 0.0)
        self._corner: Callable[[Axis], QPoint] = lambda _axis: QPoint(0, 0)
        self._turn = tool_button(
            "guideAxis", "Coordinate of the guide", "Upright (x) or level (y)", text="x ="
        )
        # Else a click on it would give the focus to the canvas.
        self._turn.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._turn.clicked.connect(self._change_axis)
        self.edit = self._line("guidePlace", "Place of the guide", _TIP, _WIDTH)
        self.angle = self._line("guideAngle", "Angle of the guide", _ANGLE_TIP, _WIDTH // 2)
        self._suffix, self._remark = Label(), Label(name="guideRemark", wordWrap=True)
        row = row_of(self._turn, self.edit, self._suffix, self.angle, Label("°"), spacing=6)
        column_of(row, self._remark, margins=(8, 6, 8, 6), spacing=4, parent=self)
        self.hide()
        self.follow_theme()

    def _line(self, name: str, title: str, tip: str, width: int) -> PlaceEdit:
        line = named(PlaceEdit(), name, title, tip)
        line.setFixedWidth(width)
        line.entered.connect(self._enter)
        line.given_up.connect(self.close_field)
        line.textEdited.connect(lambda: self._say(""))
        return line

    @property
    def remark(self) -> str:
        """Why what was typed cannot be used; empty where it can."""
        return "" if self._remark.isHidden() else self._remark.text()

    def open_for(
        self,
        guide: Guide | None,
        axis: Axis,
        unit: str,
        corner: Callable[[Axis], QPoint],
        middle: Vector,
    ) -> None:
        """Ask for the place of a guide, or of a new one of this axis, at a corner of the canvas.

        One that is level or upright so far is turned about its point beside the `middle`.
        """
        self._guide, self._unit, self._corner, self._middle = guide, unit, corner, middle
        about = f"at {guide.axis.other.value} = {field_text(guide.across)}" if guide and guide.lean else ""
        self._suffix.setText(f"{unit} {about}".strip())
        self._suffix.setVisible(bool(self._suffix.text()))
        self._turn.setEnabled(guide is None)
        self.edit.setText(typed_text(guide.position) if guide is not None else "")
        self.angle.setText(typed_text(guide.angle if guide is not None else _angle_of(axis)))
        self._show_axis(axis)
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
        size, below = self.sizeHint(), self.below.size()
        corner = self._corner(self._axis)
        x = max(min(corner.x(), below.width() - size.width()), 0)
        y = max(min(corner.y(), below.height() - size.height()), 0)
        self.setGeometry(x, y, size.width(), size.height())

    def set_theme(self, theme: Theme) -> None:
        self.set_sheet()
        self._remark.setStyleSheet(f"color: {theme.warning.name()}")

    def _change_axis(self) -> None:
        self._show_axis(self._axis.other)
        self.angle.setText(typed_text(_angle_of(self._axis)))
        self.edit.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_axis(self, axis: Axis) -> None:
        self._axis = axis
        self._turn.setText(f"{axis.value} =")
        self.place()

    def _enter(self) -> None:
        if not self.edit.text().strip():
            self.close_field()
            return
        try:
            guide = self._typed_guide()
        except ExpressionError as reason:
            self._say(f"⚠ {reason}")
            self.edit.selectAll()
            return
        self.close_field()
        self.entered.emit(guide)

    def _typed_guide(self) -> Guide:
        """Return the guide that was typed.

        Raises
        ------
        ExpressionError
            With the sentence for the person, where it is none.
        """
        now = self._guide.position if self._guide is not None else 0.0
        typed = read_place(self.edit.text(), self._unit, now)
        if typed.axis not in (None, self._axis) and self._guide is not None:
            raise ExpressionError(f"This guide holds {self._axis.value}; type that.")
        axis = typed.axis or self._axis
        plain = _angle_of(self._axis)
        angle = parse_number(self.angle.text(), decimal_mark()) if self.angle.text().strip() else plain
        if angle % 180.0 == plain:
            return Guide(axis, typed.position)
        across = self._middle[axis.other.coordinate]
        if self._guide is not None and self._guide.lean:
            across = self._guide.across
        point = (typed.position, across) if axis is Axis.X else (across, typed.position)
        return guide_at(point, angle)

    def _say(self, text: str) -> None:
        self._remark.setText(text)
        self._remark.setVisible(bool(text))
        self.place()


def _angle_of(axis: Axis) -> float:
    """Return the degrees from the x axis to a level or an upright guide."""
    return Guide(axis, 0.0).angle
