"""A share from nothing to all: a slider, and its per cents to type."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from ...document.expression import ExpressionError
from ...document.words import decimal_sum, number
from ...widgets.boxes import row_of
from ...widgets.controls import named
from ...widgets.fields import NumberEdit, read_number
from ...widgets.sliders import LiveSlider

STEPS = 100
"""Positions of the slider from nothing to all."""

MIXED = "mixed"
"""Stands where what is shown has not one value."""

_FIELD_WIDTH = 60

_STEP = 0.05
"""Share by which an arrow key goes on."""


class PercentField(QWidget):
    """A slider from 0 to `STEPS`, and a field.

    Attributes
    ----------
    slider, edit
        What is dragged, and typed into; `edit` reports shares from 0 to 1.
    """

    def __init__(self, name: str, label: str, tip: str) -> None:
        super().__init__()
        self.slider = named(
            LiveSlider(), f"{name}Slider", f"{label}, slider", f"{tip}; Escape cancels a drag"
        )
        self.slider.setRange(0, STEPS)
        self.edit = NumberEdit(
            name, label, f"{tip}, in per cent (Enter to set; ↑ ↓ by 5 %)", read_percent, _step
        )
        self.edit.setFixedWidth(_FIELD_WIDTH)
        row_of((self.slider, 1), self.edit, margins=0, spacing=8, parent=self)
        self._value: object = None
        self.slider.drag_ended.connect(lambda: self.render_value(self._value))

    def render_value(self, value: object) -> None:
        """Show a share; anything but a number for several."""
        self._value = value
        self.edit.show_text(f"{number(100 * value, 4)} %" if isinstance(value, float) else MIXED)
        if isinstance(value, float) and not self.slider.isSliderDown():
            self.slider.setValue(round(value * STEPS))


def read_percent(text: str) -> float:
    """Return the share from 0 to 1 that a text such as "40 %" means; raise ExpressionError for others."""
    share = read_number(text.replace("%", " ")) / 100
    if not 0 <= share <= 1:
        raise ExpressionError("From 0 % to 100 %.")
    return share


def _step(share: float, count: int) -> float:
    return min(max(decimal_sum(share, count * _STEP), 0.0), 1.0)
