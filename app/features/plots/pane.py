"""The plots over t with their header: which are shown, and their values at the scrub line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...document.words import number, uncertain
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import choice_style, mirror, named, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.number_text import decimal_mark
from .canvas import PlotCanvas

_HEIGHT_A_PLOT = 64
"""Pixels that a plot should have at least where there is room."""


class PlotPane(FollowsTheme, QWidget):
    """Header and plots.

    Signals
    -------
    close_asked
        All plots shall be put away.
    """

    close_asked = Signal()

    def __init__(self, canvas: PlotCanvas, choices: Sequence[tuple[str, QAction]]) -> None:
        super().__init__()
        self.setObjectName("plotPane")
        self.canvas = canvas
        self._values = named(ElidedLabel(), "plotValues", "Values at the scrub line")
        self._values.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._values.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._close = tool_button("closePlots", "Close the plots", "Put all plots away", flat=True)
        self._close.clicked.connect(self.close_asked)
        self._choices = QWidget()
        buttons = (_choice(symbol, action) for symbol, action in choices)
        row_of(*buttons, margins=0, spacing=4, parent=self._choices)
        header = row_of(self._choices, (self._values, 1), self._close, margins=(10, 4, 8, 4), spacing=4)
        header.insertSpacing(1, 6)
        column_of(header, (canvas, 1), margins=0, spacing=0, parent=self)
        self.follow_theme()

    def show_values(self, t: float | None, values: Mapping[str, tuple[float, float]]) -> None:
        """Write the values at the scrub line, with their errors, by their symbols; nothing without one."""
        if t is None:
            text = "T shows the values at a scrub line"
        else:
            mark = decimal_mark()
            shown = partial(number, mark=mark)
            known = [f"{name} {uncertain(*value, shown)}" for name, value in values.items()]
            text = "   ".join([f"t {number(t, 4, mark)}", *known])
        if text != self._values.text():
            self._values.setText(text)

    def wanted_height(self, count: int) -> int:
        """Return how high the pane should be at least for so many plots."""
        rest = self.height() - self.canvas.getViewBox().rect().height()
        return int(min(max(rest, 40), 90)) + count * _HEIGHT_A_PLOT

    def set_theme(self, theme: Theme) -> None:
        self.canvas.set_theme(theme)
        self._values.setStyleSheet(f"color: {theme.muted.name()}")
        self._choices.setStyleSheet(choice_style(theme))
        self._close.setIcon(icon("close", theme))


def _choice(symbol: str, action: QAction) -> QToolButton:
    button = tool_button(f"{action.objectName()}Choice", action.text(), action.toolTip(), text=symbol)
    mirror(button, action)
    return button
