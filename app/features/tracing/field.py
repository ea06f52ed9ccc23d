"""The field on the canvas into which is typed what of a picture counts as dark."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...qt.labels import Label
from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.percent_field import read_percent

_TIP = "What is darker than this becomes a shape: from 0 %, black, to 100 %, white. Enter traces the picture"


class DarknessField(EntryField):
    """A small frame beside the picture, in which the brightness is typed that parts dark and light.

    Signals
    -------
    entered
        The picture shall be traced at this brightness, between 0 and 1.
    """

    entered = Signal(float)

    def __init__(self, below: QWidget) -> None:
        edit = named(EntryEdit(), "traceBrightness", "Brightness", _TIP)
        super().__init__("traceField", "Trace picture", below, Label("Trace what is darker than"), edit)

    def open_for(self, brightness: float, corner: Callable[[], QPoint]) -> None:
        """Ask for a brightness, beginning with one."""
        self.ask(f"{100.0 * brightness:.0f}", "%", corner)

    def _kind(self) -> str:
        return "Trace what is darker than"

    def _take(self, text: str) -> Callable[[], object]:
        share = read_percent(text)
        return lambda: self.entered.emit(share)
