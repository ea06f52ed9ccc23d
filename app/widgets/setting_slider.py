"""A slider with its value beside it."""

from __future__ import annotations

from collections.abc import Callable
from math import log10

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from ..qt.labels import Label
from ..view_model.analysis.overlay_settings import Count, Factor
from .boxes import row_of
from .controls import named
from .live_slider import LiveSlider

_PER_DECADE = 20
"""Steps of a factor."""

_NARROWEST = 64
"""Pixels below which a slider cannot be set."""


class SettingSlider(QWidget):
    """Sets a number live; Escape during a drag brings back the number at the press.

    Parameters
    ----------
    value_at, place_of
        The number at a step of the slider, and the way back.
    text_of
        The number as it is shown.

    Signals
    -------
    moved
        The person has set another number.
    """

    moved = Signal(object)

    def __init__(
        self,
        name: str,
        label: str,
        steps: tuple[int, int],
        value_at: Callable[[int], float],
        place_of: Callable[[float], int],
        text_of: Callable[[float], str],
    ) -> None:
        super().__init__()
        self._place_of, self._text_of = place_of, text_of
        self._value = self._at_press = value_at(steps[0])
        slider = LiveSlider()
        self.slider = named(slider, name, label, f"{label}; Escape cancels a drag")
        self.slider.setRange(*steps)
        self.slider.setMinimumWidth(_NARROWEST)
        self._label = Label(name=f"{name}Value")
        widest = max(self.fontMetrics().horizontalAdvance(text_of(value_at(step))) for step in steps)
        self._label.setMinimumWidth(widest + 4)
        row_of((self.slider, 1), self._label, margins=0, spacing=6, parent=self)
        # Emitted for whatever the person does with a slider, and for nothing else.
        self.slider.actionTriggered.connect(
            lambda _action: self.moved.emit(value_at(self.slider.sliderPosition()))
        )
        self.slider.sliderPressed.connect(self._remember)
        self.slider.cancelled.connect(lambda: self.moved.emit(self._at_press))

    def render_value(self, value: float) -> None:
        """Show `value`."""
        self._value = value
        self.slider.setValue(self._place_of(value))
        self._label.setText(self._text_of(value))

    def _remember(self) -> None:
        self._at_press = self._value


def slider_of(setting: Factor | Count) -> SettingSlider:
    """Return the slider of a setting."""
    if isinstance(setting, Count):
        steps = (setting.least, setting.most)
        return SettingSlider(
            setting.name, setting.label, steps, lambda step: step, round, lambda value: f"{value:.0f}"
        )
    return SettingSlider(
        setting.name,
        setting.label,
        (-_PER_DECADE, _PER_DECADE),
        lambda step: 10.0 ** (step / _PER_DECADE),
        lambda value: round(_PER_DECADE * log10(value)),
        lambda value: f"× {value:.2g}" if value < 9.95 else "× 10",
    )
