"""The blur of what is chosen: a slider by its size, as Inkscape has it, and the deviation to type."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QWidget

from ...document.expression import ExpressionError
from ...widgets.boxes import row_of
from ...widgets.controls import named
from ...widgets.field_edit import NumberEdit
from ...widgets.length_text import read_length
from ...widgets.live_slider import LiveSlider
from ...widgets.percent_field import MIXED

STEPS = 100
"""Positions of the slider from sharp to a quarter of width and height together: Inkscape's 100 %."""

_FIELD_WIDTH = 84
_DIGITS = 3
_LEAST_STEP = 0.05
"""In the unit, by which an arrow key goes on from a sharp shape."""


class BlurField(QWidget):
    """A slider and a field.

    Attributes
    ----------
    slider, edit
        What is dragged, and typed into; `edit` reports standard deviations in the unit of the document.
    """

    def __init__(self) -> None:
        super().__init__()
        tip = "How soft it is"
        self.slider = named(
            LiveSlider(), "styleBlurSlider", "Blur, slider", f"{tip}, by its size; Escape cancels a drag"
        )
        self.slider.setRange(0, STEPS)
        self._unit, self._size = "", 0.0
        self.edit = NumberEdit(
            "styleBlur",
            "Blur",
            f"{tip}: standard deviation of a Gaussian, as 2 mm; 0 is sharp (Enter to set; ↑ ↓ by a tenth)",
            self._read,
            _step,
        )
        self.edit.setFixedWidth(_FIELD_WIDTH)
        row_of((self.slider, 1), self.edit, margins=0, spacing=8, parent=self)
        self._value: float | None = None
        self.slider.drag_ended.connect(lambda: self.render_value(self._value, self._unit, self._size))

    def render_value(self, value: float | None, unit: str, size: float) -> None:
        """Show a deviation, None for several; `size` is that of what has it, and 0 where nothing has one."""
        self._value, self._unit, self._size = value, unit, size
        if value is None:
            self.edit.show_text(MIXED)
            return
        self.edit.show_length(value, unit)
        if not self.slider.isSliderDown():
            share = math.sqrt(value / size) if size else 0.0
            self.slider.setValue(min(round(share * STEPS), STEPS))

    def _read(self, text: str) -> float:
        blur = read_length(text, self._unit)
        if blur < 0:
            raise ExpressionError("A blur is 0 or greater.")
        return blur


def blur_at(position: int, size: float) -> float:
    """Return the deviation at a position of the slider: finely told where it is small, in round numbers."""
    return float(f"{(position / STEPS) ** 2 * size:.{_DIGITS}g}")


def _step(blur: float, count: int) -> float:
    step = blur * 0.1 if blur else _LEAST_STEP
    return max(float(f"{blur + count * step:.{_DIGITS}g}"), 0.0)
