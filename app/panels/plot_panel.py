"""The place of the plots below the basis panel; empty, and free of cost, until one is switched on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.qt.overrides import Guarded
from app.view_model.analysis.plot_lines import PlotData, PlotLine, Scale, plot_of

if TYPE_CHECKING:
    from app.panels.plot_pane import PlotPane

USUAL_HEIGHT = 170


class PlotPanel(Guarded, QWidget):
    """Holds the pane once it is needed, and the plots that others add to those of the curve.

    Signals
    -------
    changed
        Plots were added, replaced or taken away.

    Attributes
    ----------
    pane
        Header and plots; None until one was shown.
    kept_height
        How high the panel was when it was last seen.
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("plotPanel")
        self.pane: PlotPane | None = None
        self.kept_height = USUAL_HEIGHT
        self._scale = 1.0
        self._added: dict[str, PlotData] = {}
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.hide()

    def show_lines(self, lines: Sequence[PlotLine], scale: Scale, title: str, symbol: str = "") -> None:
        """Plot these lines under a title; they stay, over the visible part of t, until they are hidden.

        Lines shown before under the same title go.
        """
        self._added[title] = plot_of(title, lines, scale, symbol)
        self.changed.emit()

    def hide_lines(self, title: str) -> None:
        """Take the plot with this title away, if there is one."""
        if self._added.pop(title, None) is not None:
            self.changed.emit()

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return self.pane is not None and self.pane.canvas.cancel_gesture()

    def set_scale(self, scale: float) -> None:
        """Enlarge lines and numbers, for a projector."""
        self._scale = scale
        if self.pane is not None:
            self.pane.canvas.set_scale(scale)

    @property
    def added(self) -> list[PlotData]:
        """The plots that others have added."""
        return list(self._added.values())

    def fill(self, build: Callable[[], PlotPane]) -> PlotPane:
        """Return the pane; it is built when it is first asked for."""
        if self.pane is None:
            self.pane = build()
            self.pane.canvas.set_scale(self._scale)
            layout = self.layout()
            assert layout is not None
            layout.addWidget(self.pane)
        return self.pane

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.isVisible():
            self.kept_height = self.height()
