"""The errors of the laboratory's methods, plotted over t below the basis functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...view_model import analysis

if TYPE_CHECKING:
    from ...view_model.analysis.laboratory import Trial
    from ...view_model.analysis.plot import PlotData

TITLE = "Errors of the methods"


def error_plot(trial: Trial) -> PlotData:
    """Return a plot of the errors of a trial."""
    lines = [
        analysis.plot.PlotLine(each.calculation.label, trial.t, each.errors, each.calculation.style)
        for each in trial.outcomes
    ]
    return analysis.plot.plot_of(TITLE, lines, analysis.plot.Scale.LOG)
