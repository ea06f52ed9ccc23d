"""The errors of the laboratory's methods, plotted over t below the basis functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.commands.laboratory_commands import LaboratoryCommands
from app.commands.parts import Handlers, Parts
from app.view_model.curve_view import CurveView
from app.view_model.looks import METHOD_LOOKS

if TYPE_CHECKING:
    from app.view_model.analysis.laboratory import Trial

TITLE = "Errors of the methods"


class ErrorPlotCommands:
    """Keeps the plot in step with the laboratory, as long as it is switched on."""

    def __init__(self, parts: Parts, laboratory: LaboratoryCommands) -> None:
        self._parts, self._laboratory = parts, laboratory
        self._action = parts.actions["plotErrors"]
        laboratory.tried.connect(self._show)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {"plotErrors": self._switch}

    def render(self, view: CurveView) -> None:
        """Leave it: the plot can be switched at any time."""

    def _switch(self) -> None:
        if self._action.isChecked():
            # What it plots is computed there.
            self._laboratory.open()
        self._show(self._laboratory.trial)

    def _show(self, trial: Trial | None) -> None:
        panel = self._parts.plot_panel
        if trial is None or not self._action.isChecked():
            panel.hide_lines(TITLE)
            return
        # Imported with the first trial: nobody waits for them at the start.
        from app.view_model.analysis.laboratory import error_lines  # noqa: PLC0415
        from app.view_model.analysis.plot_lines import PlotLine, Scale  # noqa: PLC0415

        lines = [
            PlotLine(each.calculation.label, each.t, each.errors, METHOD_LOOKS[each.calculation])
            for each in error_lines(trial)
        ]
        panel.show_lines(lines, Scale.LOG, TITLE)
