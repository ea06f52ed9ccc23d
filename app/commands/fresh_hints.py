"""Keeps the hint true: what a press would do changes with every step, also under a pointer that rests."""

from __future__ import annotations

from PySide6.QtCore import QObject, Qt

from app.canvas.canvas import Canvas
from app.commands.parts import Parts
from app.panels.basis_panel import BasisPanel


class FreshHints(QObject):
    """Lets the plot under the pointer tell its hint anew after a step, or when another curve is edited."""

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._plot: Canvas | BasisPanel = parts.canvas
        for plot in (parts.canvas, parts.basis_panel):
            plot.hint_changed.connect(lambda _text, plot=plot: self._remember(plot))
        # Later, when everything has been drawn that has changed.
        later = Qt.ConnectionType.QueuedConnection
        parts.session.history_changed.connect(self._refresh, later)
        parts.session.active_changed.connect(self._refresh, later)

    def _remember(self, plot: Canvas | BasisPanel) -> None:
        self._plot = plot

    def _refresh(self) -> None:
        self._plot.hover_again()
