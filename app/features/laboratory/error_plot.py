"""The errors of the laboratory's methods, plotted over t below the basis functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.panels.plot_panel import PlotPanel
from app.view_model import analysis

if TYPE_CHECKING:
    from app.view_model.analysis.laboratory import Trial

TITLE = "Errors of the methods"


class ErrorPlot:
    """Plots what the laboratory has found out."""

    def __init__(self, panel: PlotPanel) -> None:
        self._panel = panel
        self._shown: Trial | None = None

    def show(self, trial: Trial | None) -> None:
        """Plot the errors of a trial, or put the plot away."""
        if trial is self._shown:
            return
        self._shown = trial
        if trial is None:
            self._panel.hide_lines(TITLE)
            return
        lines = [
            analysis.plot_lines.PlotLine(each.calculation.label, trial.t, each.errors, each.calculation.style)
            for each in trial.outcomes
        ]
        self._panel.show_lines(lines, analysis.plot_lines.Scale.LOG, TITLE)
