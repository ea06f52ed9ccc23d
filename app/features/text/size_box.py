"""The size of letters, in the unit of the document or in points."""

from __future__ import annotations

import math

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QSizePolicy, QWidget

from ...document.transforms import decimal_sum
from ...exchange.units import known_unit
from ...widgets.boxes import row_of
from ...widgets.controls import named
from ...widgets.field_edit import NumberEdit
from ...widgets.length_text import points_text, read_length

_TIP = "Size of the text, the length of an em: a number or an expression, with a unit if you like, “12 pt”"
_LONGEST = "00000.000"
_LEAST = 1e-9
_POINTS = "pt"


class SizeBox(QWidget):
    """A line to type a size into, and the unit that it is in there.

    Attributes
    ----------
    em
        What an em is long, in the unit of the document.
    edit, unit_box
        The widgets.

    Signals
    -------
    sized
        Another size is asked for.
    switched
        Sizes are to be in points from now on, or no longer.
    refused
        Why what was typed cannot be used.
    left
        That is out of date.
    """

    sized = Signal(float)
    switched = Signal(bool)
    refused = Signal(str)
    left = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.em, self._unit = 1.0, ""
        self.edit = NumberEdit("textSize", "Size", _TIP, self._read, self._stepped)
        self.edit.setFixedWidth(self.fontMetrics().horizontalAdvance(_LONGEST))
        for taken in (self.edit.entered, self.edit.stepped):
            taken.connect(self._take)
        self.edit.refused.connect(self.refused)
        self.edit.left.connect(self.left)
        self.unit_box = named(QComboBox(), "textSizeUnit", "Unit", "What the size is told and typed in")
        self.unit_box.activated.connect(lambda at: self._switch(is_other=bool(at)))
        self.unit_box.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row_of(self.edit, self.unit_box, margins=0, spacing=3, parent=self)

    def show_unit(self, unit: str, *, wants_points: bool) -> None:
        """Have sizes of a document in a unit, told in points where that is a length."""
        self._unit = unit
        others = [_POINTS] if known_unit(unit) and unit != _POINTS else []
        self.unit_box.clear()
        self.unit_box.addItems([unit, *others])
        self.unit_box.setCurrentIndex(int(wants_points and bool(others)))
        self.unit_box.setVisible(bool(unit))
        self.unit_box.setEnabled(bool(others))

    def _switch(self, *, is_other: bool) -> None:
        self.show_size(self.em)
        self.switched.emit(is_other)

    @property
    def _shown_unit(self) -> str:
        return self.unit_box.currentText()

    @property
    def _shown_length(self) -> float:
        """How long the unit is that is shown, in that of the document."""
        shown = self._shown_unit
        return 1.0 if shown == self._unit else read_length(f"1 {shown}", self._unit)

    def show_size(self, size: float) -> None:
        """Show what an em is long."""
        self.em = size
        self.edit.show_number(_clean(size / self._shown_length), 6)
        points = points_text(size, self._unit)
        self.edit.setToolTip(f"{_TIP}. Now {points}" if points else _TIP)

    def _read(self, text: str) -> float:
        long = self._shown_length
        return read_length(text, self._shown_unit, self.em / long) * long

    def _stepped(self, size: float, count: int) -> float:
        """Return a size so many steps larger, of which the one that is shown has 10 to 99."""
        long = self._shown_length
        shown = _clean(size / long)
        step = 10.0 ** (math.floor(math.log10(shown)) - 1) if shown > 0 else 1.0
        return decimal_sum(shown, count * step) * long if shown + count * step > 0 else size

    def _take(self, size: float) -> None:
        if size < _LEAST:
            self.edit.keep()
            self.refused.emit("A size is greater than 0.")
        else:
            self.sized.emit(size)


def _clean(size: float) -> float:
    """Return a size without what a change of its unit has left in its last digits."""
    return float(f"{size:.12g}")
