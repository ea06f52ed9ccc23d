"""The middle of the window: the canvas, below it the basis functions and the plots over t."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from app.canvas.canvas import Canvas
from app.panels.basis_pane import BasisPane
from app.panels.basis_panel import BasisPanel
from app.panels.plot_panel import PlotPanel
from app.session import Session
from app.tools.canvas.select import SELECT
from app.tools.rail import RAIL
from app.tools.toolbox import Toolbox
from app.workbench.message_bar import MessageBar


class CentralArea:
    """The plots of a window and what lies over them.

    Attributes
    ----------
    canvas, basis_panel
        The two plots.
    basis_pane, plot_panel
        The basis functions with their header; the plots over t.
    message_bar
        The line on the canvas.
    splitter, under_canvas
        What holds all of them; where bars stand under the canvas.
    """

    def __init__(self, session: Session, parent: QWidget) -> None:
        # Each in its parent from the start: what is moved gets its style anew, with all that is in it.
        self.splitter = QSplitter(Qt.Orientation.Vertical, parent)
        self.splitter.setObjectName("drawingSplitter")
        pane = QWidget(self.splitter)
        self.canvas = Canvas(Toolbox(session, SELECT), pane)
        self.message_bar = MessageBar(self.canvas.viewport())
        self.canvas.framing.covered_top = lambda: self.message_bar.covered
        self.basis_panel = BasisPanel(Toolbox(session, RAIL))
        self.basis_pane = BasisPane(self.basis_panel, self.splitter)
        self.under_canvas = QVBoxLayout(pane)
        self.under_canvas.setContentsMargins(0, 0, 0, 0)
        self.under_canvas.setSpacing(0)
        self.under_canvas.addWidget(self.canvas, 1)
        self.plot_panel = PlotPanel(self.splitter)
        self.splitter.setStretchFactor(0, 2)
        self.splitter.setStretchFactor(1, 1)
        self.splitter.setSizes([560, 280])
        self.splitter.setChildrenCollapsible(False)
        # Else what lies behind the window's middle is seen beside the thin line of a handle.
        self.splitter.setAutoFillBackground(True)

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return (
            self.canvas.cancel_gesture()
            or self.basis_panel.cancel_gesture()
            or self.plot_panel.cancel_gesture()
        )

    def fit(self) -> None:
        """Show all curves and all functions."""
        self.canvas.framing.fit()
        self.basis_pane.fit()
