"""Sliders that report while they move, and sliders for the settings of overlays."""

from __future__ import annotations

from collections.abc import Callable
from math import log10

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QAbstractSlider, QSlider, QWidget

from ..qt.labels import Label
from ..view_model.settings import Count, Factor
from .boxes import row_of
from .controls import WheelNeedsFocus, named

_MOVE = QAbstractSlider.SliderAction.SliderMove.value


class LiveSlider(WheelNeedsFocus, QSlider):
    """A slider whose drag can be cancelled with Escape.

    Signals
    -------
    dragged
        The handle is being dragged, to this position.
    dropped
        A drag has ended at this position.
    chosen
        A key, the wheel or a click has set this position.
    cancelled
        Escape was pressed while the slider was dragged. The slider then counts as released: its owner shows
        the old value at once, and the rest of the drag does nothing.
    drag_ended
        A drag has ended, dropped or cancelled: the owner shows the present value.
    """

    dragged = Signal(int)
    dropped = Signal(int)
    chosen = Signal(int)
    cancelled = Signal()
    drag_ended = Signal()

    def __init__(self) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._is_over = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.sliderPressed.connect(self._begin)
        self.actionTriggered.connect(self._report)
        self.sliderReleased.connect(self._end)

    def _report(self, action: int) -> None:
        if action != _MOVE or not self.isSliderDown():
            self.chosen.emit(self.sliderPosition())
        elif not self._is_over:
            self.dragged.emit(self.sliderPosition())

    def _end(self) -> None:
        if not self._is_over:
            self.dropped.emit(self.sliderPosition())
        self.drag_ended.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.isSliderDown():
            self.cancelled.emit()
            self.abandon()
            return
        super().keyPressEvent(event)

    def abandon(self) -> None:
        """End a drag; further moves of the mouse before its release are ignored."""
        if self.isSliderDown():
            self._is_over = True
            self.setSliderDown(False)

    def _begin(self) -> None:
        self._is_over = False

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._begin()
        super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not self._is_over:
            super().mouseMoveEvent(event)


_PER_DECADE = 20
"""Steps of a factor per power of ten."""

_NARROWEST = 64
"""Smallest width in pixels at which a slider can be used."""


class SettingSlider(QWidget):
    """A slider that sets a number live; Escape during a drag restores the number at the press.

    Parameters
    ----------
    value_at, step_at
        Return the number at a step of the slider, and the step of a number.
    text_of
        Returns the number as text.

    Signals
    -------
    moved
        The user has set another number.
    """

    moved = Signal(object)

    def __init__(
        self,
        name: str,
        label: str,
        steps: tuple[int, int],
        value_at: Callable[[int], float],
        step_at: Callable[[float], int],
        text_of: Callable[[float], str],
    ) -> None:
        super().__init__()
        self._step_at, self._text_of = step_at, text_of
        self._value = self._at_press = value_at(steps[0])
        slider = LiveSlider()
        self.slider = named(slider, name, label, f"{label}; Escape cancels a drag")
        self.slider.setRange(*steps)
        self.slider.setMinimumWidth(_NARROWEST)
        self._label = Label(name=f"{name}Value")
        widest = max(self.fontMetrics().horizontalAdvance(text_of(value_at(step))) for step in steps)
        self._label.setMinimumWidth(widest + 4)
        row_of((self.slider, 1), self._label, margins=0, spacing=6, parent=self)
        # Emitted for every action of the user, and for nothing else.
        self.slider.actionTriggered.connect(
            lambda _action: self.moved.emit(value_at(self.slider.sliderPosition()))
        )
        self.slider.sliderPressed.connect(self._remember)
        self.slider.cancelled.connect(lambda: self.moved.emit(self._at_press))

    def render_value(self, value: float) -> None:
        """Show `value`."""
        self._value = value
        self.slider.setValue(self._step_at(value))
        self._label.setText(self._text_of(value))

    def _remember(self) -> None:
        self._at_press = self._value


def slider_of(setting: Factor | Count) -> SettingSlider:
    """Return the slider of a setting."""
    if isinstance(setting, Count):
        return SettingSlider(
            setting.name,
            setting.label,
            setting.limits,
            lambda step: step,
            round,
            lambda value: f"{value:.0f}",
        )
    return SettingSlider(
        setting.name,
        setting.label,
        (-_PER_DECADE, _PER_DECADE),
        lambda step: 10.0 ** (step / _PER_DECADE),
        lambda value: round(_PER_DECADE * log10(value)),
        lambda value: f"× {value:.2g}" if value < 9.95 else "× 10",
    )
