"""The field on the canvas into which the number of copies and the step between them are typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...document.expression import ExpressionError
from ...document.model import Vector
from ...document.words import number
from ...qt.labels import Label
from ...view_model.copies import MOST_COPIES, Copies
from ...view_model.last_transform import Move, Turn
from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.field_edit import read_number
from ...widgets.length_text import length_text, read_length
from ...widgets.number_text import decimal_mark
from ...widgets.tool_buttons import tool_button

_COUNT_TIP = "How many there are in all, the original among them"
_ANGLE_TIP = "Angle from one to the next, counterclockwise, such as 72 or 360/5"
_STEP_TIP = "Way from one to the next along {}, with a unit if you like, such as 10 mm"
_NARROW, _USUAL = 60, 5


class CopiesField(EntryField):
    """A small frame beside what is chosen: how many, in a circle or in a row, and how far apart.

    Signals
    -------
    looked_at
        These `Copies` are to be seen; None for none.
    entered
        They are to be made.
    """

    looked_at = Signal(object)
    entered = Signal(object)

    def __init__(self, below: QWidget) -> None:
        self._is_circle, self._unit = True, ""
        turn = tool_button(
            "copiesWay", "In a circle or in a row", "In a circle about the pivot, or in a row", text="Row"
        )
        count = named(EntryEdit(), "copiesCount", "In all", _COUNT_TIP)
        self._angle = named(EntryEdit(), "copiesAngle", "Angle", _ANGLE_TIP)
        self._ways = tuple(
            named(EntryEdit(), f"copies{axis}", f"Step along {axis.lower()}", _STEP_TIP.format(axis.lower()))
            for axis in "XY"
        )
        self._degrees = Label("°")
        for edit in (count, self._angle, *self._ways):
            edit.setFixedWidth(_NARROW)
        super().__init__(
            "copiesField",
            "Copies around",
            below,
            turn,
            count,
            Label("each by"),
            self._angle,
            self._degrees,
            *self._ways,
        )
        for edit in (count, self._angle, *self._ways):
            edit.textEdited.connect(self._look)

    def open_for(self, width: float, unit: str, corner: Callable[[], QPoint]) -> None:
        """Ask for copies of something so wide: five around, at first."""
        self._unit, self._is_circle = unit, True
        for edit, length in zip(self._ways, (width, 0.0), strict=True):
            edit.setText(length_text(length, unit, 4))
        self._angle.setText(self._even_angle(_USUAL))
        self.ask(str(_USUAL), "", corner)
        self._look()

    def _even_angle(self, count: int) -> str:
        return number(360.0 / count, 10, decimal_mark())

    def _kind(self) -> str:
        for edit in self._ways:
            edit.setVisible(not self._is_circle)
        self._angle.setVisible(self._is_circle)
        self._degrees.setVisible(self._is_circle)
        return "In a circle" if self._is_circle else "In a row"

    def _other_kind(self) -> None:
        self._is_circle = not self._is_circle
        self._look()

    def _look(self) -> None:
        """Have what is typed be seen, as far as it makes sense."""
        try:
            if not self._angle.isModified():
                # All around, until another one is typed.
                self._angle.setText(self._even_angle(self._count()))
            copies = self._copies()
        except ExpressionError:
            copies = None
        self.looked_at.emit(copies)

    def _count(self) -> int:
        count = read_number(self.edit.text())
        if not (count.is_integer() and 2 <= count <= MOST_COPIES):
            raise ExpressionError(
                f"Type a whole number from 2 to {MOST_COPIES}; the original is one of them."
            )
        return int(count)

    def _copies(self) -> Copies:
        count = self._count()
        if self._is_circle:
            return Copies(count, Turn(self._typed_angle(count)))
        x, y = self._typed_way()
        return Copies(count, Move((x, y)))

    def _typed_angle(self, count: int) -> float:
        if not self._angle.isModified():
            return 360.0 / count
        return read_number(self._angle.text().rstrip(" °"))

    def _typed_way(self) -> Vector:
        x, y = (read_length(edit.text(), self._unit) for edit in self._ways)
        return x, y

    def _take(self, text: str) -> Callable[[], object]:
        copies = self._copies()
        return lambda: self.entered.emit(copies)
