"""Settings of overlays, plots and laboratory, a part of the window's state, and what is said about them."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QObject, Signal

from ..view_model.analysis.ghost import Ghost
from ..view_model.analysis.overlay import Overlay
from ..view_model.analysis.overlay_settings import OverlaySetting
from ..view_model.analysis.plot import Plot
from ..view_model.analysis.plot_lines import PlotData
from ..view_model.analysis.settings import AnalysisSettings
from .window_state import WindowState, WindowStore


class Analysis(QObject):
    """The settings of overlays, plots and laboratory of one window.

    Signals
    -------
    changed
        The settings are other ones.
    noted
        Something else can be said about the overlays.
    ghost_chosen
        A ghost shall become the curve.
    added
        A plot was added to those of the curve, replaced or taken away.

    Attributes
    ----------
    added_plots
        Plots beside those of the curve, by their titles.
    notes
        A sentence to some of the overlays: what they measure, or why nothing is drawn.
    problem
        Why there is nothing to analyse; empty where there is a curve.
    """

    changed = Signal()
    noted = Signal()
    ghost_chosen = Signal(object)
    added = Signal()

    def __init__(self, store: WindowStore, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store = store
        store.changed.connect(self._follow_state)
        self.added_plots: dict[str, PlotData] = {}
        self.notes: Mapping[Overlay, str] = {}
        self.problem = ""

    @property
    def settings(self) -> AnalysisSettings:
        """The settings, a part of the window's state."""
        return self._store.state.analysis

    def _follow_state(self, before: WindowState, after: WindowState) -> None:
        if after.analysis != before.analysis:
            self.changed.emit()

    def change(self, **fields: object) -> None:
        """Take other values for some of the settings."""
        self._store.change(analysis=replace(self.settings, **fields))

    def set_value(self, setting: OverlaySetting, value: float) -> None:
        """Take another value for a setting of overlays."""
        self._store.change(analysis=self.settings.with_value(setting, value))

    def reset(self) -> None:
        """Take all settings back to what they are at the start."""
        self.change(**msgspec.structs.asdict(AnalysisSettings()))

    def show(self, overlay: Overlay, shown: bool) -> None:
        """Switch an overlay on or off."""
        others = self.settings.overlays - {overlay}
        self.change(overlays=others | {overlay} if shown else others)

    def show_plot(self, plot: Plot, shown: bool) -> None:
        """Switch a plot over t on or off."""
        others = self.settings.plots - {plot}
        self.change(plots=others | {plot} if shown else others)

    def add_plot(self, plot: PlotData) -> None:
        """Plot something else over the visible part of t; one of the same title gives way to it."""
        self.added_plots[plot.title] = plot
        self.added.emit()

    def remove_plot(self, title: str) -> None:
        """Take the added plot with this title away, if there is one."""
        if self.added_plots.pop(title, None) is not None:
            self.added.emit()

    def show_ghost(self, ghost: Ghost, shown: bool) -> None:
        """Switch a variant of the curve on or off."""
        others = self.settings.ghosts - {ghost}
        self.change(ghosts=others | {ghost} if shown else others)

    def note(self, notes: Mapping[Overlay, str], problem: str = "") -> None:
        """Say something about the overlays."""
        if (notes, problem) != (self.notes, self.problem):
            self.notes, self.problem = notes, problem
            self.noted.emit()
