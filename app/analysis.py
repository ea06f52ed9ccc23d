"""What is shown over the curve beside the curve itself: one owner, whoever switches it."""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtCore import QObject, Signal

from app.view_model.analysis.settings import AnalysisSettings, Overlay, Plot


class Analysis(QObject):
    """The settings of overlays, plots and laboratory of one window.

    Signals
    -------
    changed
        The settings are other ones.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.settings = AnalysisSettings()

    def change(self, **fields: object) -> None:
        """Take other values for some of the settings."""
        settings = replace(self.settings, **fields)
        if settings != self.settings:
            self.settings = settings
            self.changed.emit()

    def show(self, overlay: Overlay, shown: bool) -> None:
        """Switch an overlay on or off."""
        others = self.settings.overlays - {overlay}
        self.change(overlays=others | {overlay} if shown else others)

    def show_plot(self, plot: Plot, shown: bool) -> None:
        """Switch a plot over t on or off."""
        others = self.settings.plots - {plot}
        self.change(plots=others | {plot} if shown else others)
