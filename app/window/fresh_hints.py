"""Keeps the hint true: what a press would do changes with every step, also under a pointer that rests."""

from __future__ import annotations

from PySide6.QtCore import QObject, Qt

from app.canvas.canvas import Canvas
from app.panels.basis_panel import BasisPanel
from app.workbench.context import WindowContext


class FreshHints(QObject):
    """Lets the plot under the pointer tell its hint anew after a step, or when another curve is edited."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._plot: Canvas | BasisPanel = context.central.canvas
        for plot in (context.central.canvas, context.central.basis_panel):
            plot.hint_changed.connect(lambda _text, plot=plot: self._remember(plot))
        # Later, when everything has been drawn that has changed.
        later = Qt.ConnectionType.QueuedConnection
        context.session.history_changed.connect(self._refresh, later)
        context.session.active_changed.connect(self._refresh, later)

    def _remember(self, plot: Canvas | BasisPanel) -> None:
        self._plot = plot

    def _refresh(self) -> None:
        self._plot.hover_again()
