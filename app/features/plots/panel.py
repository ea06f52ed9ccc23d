"""The place of the plots below the basis functions; empty, and free of cost, until one is switched on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from ...qt.overrides import SafeOverrides
from ...workbench.central_area import CentralPane

if TYPE_CHECKING:
    from .pane import PlotPane


USUAL_HEIGHT = 170


class PlotPanel(SafeOverrides, CentralPane):
    """Holds the plots with their header once they are wanted.

    Attributes
    ----------
    pane
        Header and plots; None until one was shown.
    kept_height
        How high the panel was when it was last seen.
    """

    def __init__(self, kept_height: int, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAccessibleName("Plots over t")
        self.kept_height = kept_height or USUAL_HEIGHT
        self.pane: PlotPane | None = None
        self._rows = QVBoxLayout(self)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self.hide()

    def hold(self, pane: PlotPane) -> None:
        """Show header and plots here from now on."""
        self.pane, self.plot = pane, pane.canvas
        self._rows.addWidget(pane)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.isVisible():
            self.kept_height = self.height()
