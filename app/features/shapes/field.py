"""The field on the canvas into which the distance of an outset or inset is typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.tool_buttons import tool_button
from .distances import read_distance

_TIP = "How far the outlines move: a number or an expression, with a unit if you like, such as 2 mm or 1/8 in"


class OffsetField(EntryField):
    """A small frame beside the chosen shapes, in which a distance is typed.

    Signals
    -------
    entered
        Shapes shall grow, or shrink where it is False, by this `Distance`.
    """

    entered = Signal(bool, object)

    def __init__(self, below: QWidget) -> None:
        self._grows, self._unit = True, ""
        turn = tool_button(
            "offsetWay", "Outset or inset", "Larger (outset) or smaller (inset)", text="Outset"
        )
        super().__init__(
            "offsetField",
            "Outset or inset",
            below,
            turn,
            named(EntryEdit(), "offsetDistance", "Distance", _TIP),
        )

    def open_for(self, text: str, unit: str, corner: Callable[[], QPoint]) -> None:
        """Ask for a distance; a text to begin with that has no unit is in that of the document."""
        self._unit = unit
        self.ask(text, "", corner)

    def _kind(self) -> str:
        return "Outset" if self._grows else "Inset"

    def _other_kind(self) -> None:
        self._grows = not self._grows

    def _take(self, text: str) -> Callable[[], object]:
        distance = read_distance(text, self._unit)
        return lambda: self.entered.emit(self._grows, distance)
