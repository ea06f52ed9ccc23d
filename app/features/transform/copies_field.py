"""The field on the canvas into which the number of copies and the steps between them are typed."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...document.expression import ExpressionError
from ...document.model import Vector
from ...document.readings import PLAIN, Readings
from ...document.words import number
from ...qt.labels import Label
from ...view_model.boxes.copies import MOST_COPIES, Copies
from ...view_model.boxes.last_transform import Move, Turn
from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.field_edit import read_number
from ...widgets.length_text import length_text, read_length
from ...widgets.number_text import decimal_mark
from ...widgets.tool_buttons import tool_button

_COUNT_TIP = "How many there are in all, the original among them; in a grid, how many columns"
_ROWS_TIP = "How many rows"
_ANGLE_TIP = "Angle from one to the next, {}, such as 72 or 360/5"
_STEP_TIP = "Way from one to the next along {}, with a unit if you like, such as 10 mm"
_NARROW, _USUAL, _USUAL_ROWS = 60, 5, 3


class CopiesKind(Enum):
    """How copies lie; its value is what the field says of it."""

    CIRCLE = "In a circle"
    ROW = "In a row"
    GRID = "In rows and columns"

    @property
    def next(self) -> CopiesKind:
        """The one that the button goes over to."""
        kinds = list(CopiesKind)
        return kinds[(kinds.index(self) + 1) % len(kinds)]


class CopiesField(EntryField):
    """A small frame beside what is chosen: how many, in a circle, a row or a grid, and how far apart.

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
        self._way, self._unit, self._size = CopiesKind.CIRCLE, "", (0.0, 0.0)
        self._readings = PLAIN
        tip = "In a circle about the pivot, in a row, or in rows and columns"
        turn = tool_button("copiesWay", "In a circle, a row or a grid", tip, text="Row")
        count = named(EntryEdit(), "copiesCount", "In all", _COUNT_TIP)
        self._rows = named(EntryEdit(), "copiesRows", "Rows", _ROWS_TIP)
        self._angle = named(EntryEdit(), "copiesAngle", "Angle", _ANGLE_TIP.format(PLAIN.sense))
        self._ways = tuple(
            named(EntryEdit(), f"copies{axis}", f"Step along {axis.lower()}", _STEP_TIP.format(axis.lower()))
            for axis in "XY"
        )
        self._degrees, self._times = Label("°"), Label("×")
        edits = (count, self._rows, self._angle, *self._ways)
        for edit in edits:
            edit.setFixedWidth(_NARROW)
        super().__init__(
            "copiesField",
            "Copies around",
            below,
            turn,
            count,
            self._times,
            self._rows,
            Label("each by"),
            self._angle,
            self._degrees,
            *self._ways,
        )
        for edit in edits:
            edit.textEdited.connect(self._look)

    def open_for(
        self,
        size: Vector,
        unit: str,
        readings: Readings,
        corner: Callable[[], QPoint],
        kind: CopiesKind = CopiesKind.CIRCLE,
    ) -> None:
        """Ask for copies of something so large: five around, at first, or a grid of three by three.

        Steps and angles are typed as `readings` tell them.
        """
        self._unit, self._way, self._size, self._readings = unit, kind, size, readings
        self._angle.setToolTip(_ANGLE_TIP.format(readings.sense))
        for edit in self._ways:
            edit.setModified(False)
        self._show_steps()
        self._angle.setText(self._even_angle(_USUAL))
        self._rows.setText(str(_USUAL_ROWS))
        self.ask(str(_USUAL_ROWS if kind is CopiesKind.GRID else _USUAL), "", corner)
        self._look()

    def _show_steps(self) -> None:
        """Show how far apart copies are that touch, until other steps are typed."""
        if not any(edit.isModified() for edit in self._ways):
            steps = (self._size[0], self._size[1] if self._way is CopiesKind.GRID else 0.0)
            for edit, length in zip(self._ways, steps, strict=True):
                edit.setText(length_text(length, self._unit, 4))

    def _even_angle(self, count: int) -> str:
        return number(360.0 / count, 10, decimal_mark())

    def _kind(self) -> str:
        is_circle, is_grid = self._way is CopiesKind.CIRCLE, self._way is CopiesKind.GRID
        for edit in self._ways:
            edit.setVisible(not is_circle)
        for part in (self._angle, self._degrees):
            part.setVisible(is_circle)
        for part in (self._times, self._rows):
            part.setVisible(is_grid)
        return self._way.value

    def _other_kind(self) -> None:
        self._way = self._way.next
        self._show_steps()
        self._look()

    def _look(self) -> None:
        """Have what is typed be seen, as far as it makes sense."""
        try:
            if not self._angle.isModified():
                # All around, until another one is typed.
                self._angle.setText(self._even_angle(self._count(self.edit)))
            copies = self._copies()
        except ExpressionError:
            copies = None
        self.looked_at.emit(copies)

    def _count(self, edit: EntryEdit, least: int = 2) -> int:
        count = read_number(edit.text())
        if not (count.is_integer() and least <= count <= MOST_COPIES):
            raise ExpressionError(
                f"Type a whole number from {least} to {MOST_COPIES}; the original is one of them."
            )
        return int(count)

    def _copies(self) -> Copies:
        if self._way is CopiesKind.GRID:
            return self._grid()
        count = self._count(self.edit)
        if self._way is CopiesKind.CIRCLE:
            return Copies(count, Turn(self._typed_angle(count)))
        return Copies(count, Move(self._typed_way()))

    def _grid(self) -> Copies:
        columns, rows = self._count(self.edit, 1), self._count(self._rows, 1)
        if not 2 <= columns * rows <= MOST_COPIES:
            raise ExpressionError(f"There are 2 to {MOST_COPIES} in all, the original among them.")
        x, y = self._typed_way()
        return Copies(columns, Move((x, 0.0)), rows, Move((0.0, y)))

    def _typed_angle(self, count: int) -> float:
        if not self._angle.isModified():
            return self._readings.turn(360.0 / count)
        return self._readings.turn(read_number(self._angle.text().rstrip(" °")))

    def _typed_way(self) -> Vector:
        x, y = (read_length(edit.text(), self._unit) for edit in self._ways)
        return self._readings.way((x, y))

    def _take(self, text: str) -> Callable[[], object]:
        copies = self._copies()
        return lambda: self.entered.emit(copies)
