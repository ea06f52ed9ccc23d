"""The field on the canvas into which the place of a guide is typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...document.expression import ExpressionError
from ...document.model import Axis, Guide
from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.number_text import typed_text
from ...widgets.tool_buttons import tool_button
from .places import read_place

_TIP = "Where the guide lies: a number or an expression, with a unit if you like, such as 20, 1/3 or 1 in"


class GuideField(EntryField):
    """A small frame beside a ruler, in which the place of one guide is typed.

    Signals
    -------
    entered
        A guide shall be there: its axis and its position.
    """

    entered = Signal(object, float)

    def __init__(self, below: QWidget) -> None:
        self._axis, self._unit = Axis.X, ""
        self._guide: Guide | None = None
        turn = tool_button("guideAxis", "Coordinate of the guide", "Upright (x) or level (y)", text="x =")
        edit = named(EntryEdit(), "guidePlace", "Place of the guide", _TIP)
        super().__init__("guideField", "Guide", below, turn, edit)

    def open_for(self, guide: Guide | None, axis: Axis, unit: str, corner: Callable[[Axis], QPoint]) -> None:
        """Ask for the place of a guide, or of a new one of this axis, at a corner of the canvas."""
        self._guide, self._axis, self._unit = guide, axis, unit
        self._turn.setEnabled(guide is None)
        self.ask(typed_text(guide.position) if guide is not None else "", unit, lambda: corner(self._axis))

    def _kind(self) -> str:
        return f"{self._axis.value} ="

    def _other_kind(self) -> None:
        self._axis = Axis.Y if self._axis is Axis.X else Axis.X

    def _take(self, text: str) -> Callable[[], object]:
        now = self._guide.position if self._guide is not None else 0.0
        typed = read_place(text, self._unit, now)
        if typed.axis not in (None, self._axis) and self._guide is not None:
            raise ExpressionError(f"This guide holds {self._axis.value}; type that.")
        return lambda: self.entered.emit(typed.axis or self._axis, typed.position)
