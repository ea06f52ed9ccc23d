"""The plots over t with their header: buttons that switch them, and their values at the scrub line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction, QKeyEvent
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from curvecore.arrays import FloatArray

from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...document.words import number, with_error
from ...plotting.camera import CameraOverT
from ...plotting.tool_plot import ToolPlot
from ...qt.labels import MUTED
from ...tools.toolbox import Toolbox
from ...view_model.analysis.plot import PlotData
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import choice_style, mirror, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.number_text import decimal_mark
from .layers import PlotLayer, ScrubLayer, ValueScale

_PIXELS_A_NUMBER = 24.0
_EDGE = 7.0
"""Pixels from the edge within which a number at the axis would be cut off."""

_DIRECTIONS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}


class PlotCanvas(ToolPlot):
    """Draws plots; x axis t. A drag scrubs, the wheel zooms along t.

    The view box's own y runs from 0 to 1 over the height; every plot has its scale within.

    Signals
    -------
    scrub_nudged
        An arrow key asks to move the scrub line along t by this much.
    """

    scrub_nudged = Signal(float)

    camera: CameraOverT
    camera_class = CameraOverT

    def __init__(self, tools: Toolbox) -> None:
        super().__init__(tools)
        # The basis panel decides about the visible part of the shared t axis.
        self.camera.led = True
        self.setObjectName("plotCanvas")
        self.setAccessibleName("Plots over t")
        self.setAccessibleDescription("Speed, curvature and other plots; drag to move the scrub line.")
        self._scales: dict[str, ValueScale] = {}
        self._ticks: list[tuple[float, str]] = []
        self._lines = PlotLayer(self)
        self._scrub = ScrubLayer(self, self._lines)
        self.getViewBox().setYRange(0.0, 1.0, padding=0)
        self.getViewBox().sigResized.connect(self._number_axis)
        self._number_axis()

    # Content

    @property
    def plots(self) -> Sequence[PlotData]:
        """Visible plots, from the top down."""
        return [plot for plot, _scale in self._lines.plots]

    @property
    def note(self) -> str:
        """Sentence in place of plots."""
        return self._lines.note

    @property
    def columns(self) -> int:
        """The width of the plots in pixels."""
        return int(self.pixel_map.width)

    def scale_of(self, title: str) -> ValueScale:
        """Return the values at the foot and at the head of a plot."""
        return self._scales[title]

    def render_plots(self, plots: Sequence[PlotData], knots: FloatArray, *, calm: bool) -> None:
        """Show plots, with marks at the knots; while `calm`, no scale shrinks."""
        scales = {}
        for plot in plots:
            fresh, old = ValueScale.of(plot), self._scales.get(plot.title)
            scales[plot.title] = fresh.holding(old) if calm and old is not None else fresh
        moved = scales != self._scales
        self._scales = scales
        layer = self._lines
        layer.plots, layer.knots = [(plot, scales[plot.title]) for plot in plots], knots
        layer.note, layer.waits = "", False
        if moved:
            self._number_axis()
        self._refresh()

    def say(self, note: str) -> None:
        """Show a sentence in place of plots."""
        layer = self._lines
        layer.plots, layer.knots, layer.note = (), np.empty(0), note
        self._scales = {}
        self._number_axis()
        self._refresh()

    def set_waiting(self) -> None:
        """Draw the plots pale while newer ones are being computed."""
        self._lines.waits = True
        self._refresh()

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line, or hide it (None)."""
        self._scrub.scrub = t
        self._scrub.update()

    def set_scale(self, scale: float) -> None:
        """Enlarge lines and numbers, for a projector."""
        super().set_scale(scale)
        self._number_axis()

    def _refresh(self) -> None:
        self._lines.update()
        self._scrub.update()

    def _number_axis(self) -> None:
        """Write the numbers of all plots at the common axis."""
        height, layer = max(self.getViewBox().rect().height(), 1.0), self._lines
        ticks = []
        for placed in layer.placed(height):
            most = max(int(placed.height / (_PIXELS_A_NUMBER * layer.scale)), 2)
            for share, text in placed.scale.ticks(most):
                y = placed.foot - share * placed.height
                ticks.append((1 - min(max(y, _EDGE), height - _EDGE) / height, text))
        if ticks != self._ticks:
            self._ticks = ticks
            self.getAxis("left").set_ticks(ticks)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in _DIRECTIONS:
            steps = 10 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1
            self.scrub_nudged.emit(_DIRECTIONS[Qt.Key(event.key())] * steps / self.pixel_map.sx)
            event.accept()
        else:
            super().keyPressEvent(event)


_HEIGHT_A_PLOT = 64
"""Least height of a plot in pixels where there is room."""


class PlotPane(FollowsTheme, QWidget):
    """Header and plots.

    Signals
    -------
    close_asked
        The person asks to hide all plots.
    """

    close_asked = Signal()

    def __init__(self, canvas: PlotCanvas, choices: Sequence[tuple[str, QAction]]) -> None:
        super().__init__()
        self.setObjectName("plotPane")
        self.canvas = canvas
        self._values = ElidedLabel("plotValues", "Values at the scrub line", MUTED)
        self._values.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._values.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._close = tool_button("closePlots", "Close the plots", "Hide all plots", flat=True)
        self._close.clicked.connect(self.close_asked)
        self._choices = QWidget()
        buttons = (_choice(symbol, action) for symbol, action in choices)
        row_of(*buttons, margins=0, spacing=4, parent=self._choices)
        header = row_of(self._choices, (self._values, 1), self._close, margins=(10, 4, 8, 4), spacing=4)
        header.insertSpacing(1, 6)
        column_of(header, (canvas, 1), margins=0, spacing=0, parent=self)
        self.follow_theme()

    def show_values(self, t: str, values: Mapping[str, tuple[float, float]]) -> None:
        """Write the values at the scrub line, with their errors, by their symbols; a hint without a line."""
        if not t:
            text = "Press T to show values at a scrub line"
        else:
            mark = decimal_mark()
            written = partial(number, mark=mark)
            known = [f"{name} {with_error(*value, written)}" for name, value in values.items()]
            text = "   ".join([f"t {t}", *known])
        if text != self._values.text():
            self._values.setText(text)

    def wanted_height(self, count: int) -> int:
        """Return the least height of the pane for a number of plots."""
        rest = self.height() - self.canvas.getViewBox().rect().height()
        return int(min(max(rest, 40), 90)) + count * _HEIGHT_A_PLOT

    def set_theme(self, theme: Theme) -> None:
        self.canvas.set_theme(theme)
        self._choices.setStyleSheet(choice_style(theme))
        self._close.setIcon(icon("close", theme))


def _choice(symbol: str, action: QAction) -> QToolButton:
    button = tool_button(f"{action.objectName()}Choice", action.text(), action.toolTip(), text=symbol)
    mirror(button, action)
    return button
