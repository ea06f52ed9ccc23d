"""The field on the canvas into which the place of a guide is typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...document.guide import Axis, Guide
from ...document.readings import PLAIN, Readings
from ...qt.labels import Label
from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.length_text import read_length
from ...widgets.number_text import typed_text

_TIP = "Where the guide lies: a number or an expression, with a unit if you like, such as 20, 1/3 or 1 in"


class GuideField(EntryField):
    """A small frame beside a ruler, in which the place of one guide is typed.

    Signals
    -------
    entered
        A guide shall be there.
    """

    entered = Signal(object)

    def __init__(self, below: QWidget) -> None:
        self._axis, self._unit, self._readings = Axis.X, "", PLAIN
        self._now = 0.0
        edit = named(EntryEdit(), "guidePlace", "Place of the guide", _TIP)
        super().__init__("guideField", "Guide", below, Label(), edit)

    def open_for(
        self,
        axis: Axis,
        position: float | None,
        unit: str,
        readings: Readings,
        corner: Callable[[], QPoint],
    ) -> None:
        """Ask for the place of a guide of an axis at a corner of the canvas, typed as `readings` tell it.

        `position` is where it lies so far; None for a new one.
        """
        self._axis, self._unit, self._readings = axis, unit, readings
        self._now = 0.0 if position is None else readings.shown_at(axis.coordinate, position)
        self.ask("" if position is None else typed_text(self._now), unit, corner)

    def _kind(self) -> str:
        return f"{self._axis.value} ="

    def _take(self, text: str) -> Callable[[], object]:
        typed = read_length(text, self._unit, self._now)
        entered = Guide(self._axis, self._readings.meant_at(self._axis.coordinate, typed))
        return lambda: self.entered.emit(entered)
