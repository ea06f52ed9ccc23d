"""Stability laboratory: trials beside the window, and their results on the canvas and in the panel."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QDockWidget, QWidget

from ...actions.declaration import action, switch
from ...actions.menus import ANALYSIS_EXPLAIN, PLOTS_OVER_T
from ...canvas.figure_layer import Trace
from ...document.words import number
from ...qt.overrides import SafeOverrides
from ...tasks.task import DebouncedTask
from ...view_model import analysis
from ...view_model.analysis.settings import LaboratorySettings, RoundedPart
from ...view_model.basis import growth_of_data
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel, make_room
from .. import laboratory

if TYPE_CHECKING:
    from ...view_model.analysis.laboratory import Digits, SolvingCost, Trial
    from ...view_model.analysis.plot import PlotData
    from .panel import LaboratoryPanel


TITLE = "Errors of the methods"
"""Title of the plot of errors."""

_GROUP = "laboratory"
_HEIGHT = 480
"""Height in pixels that the controls and the table need."""


class LaboratoryCommands(SafeOverrides, QObject):
    """The laboratory of one window: computes anew when the curve or the settings change, while it is on.

    It is on from the moment its dock is in front until the dock is closed: with another tab in front the
    computed curves stay on the canvas.

    Attributes
    ----------
    trial
        The last result; None before the first.
    """

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session, self._analysis = context, context.session, context.analysis
        self._panel: LaboratoryPanel | None = None
        self._asked: tuple[CurveView, LaboratorySettings] | None = None
        self.trial: Trial | None = None
        self._problem = ""
        self._cost: SolvingCost | None = None
        self._costed: CurveView | None = None
        self._task, self._digits_task, self._cost_task = (
            DebouncedTask(self), DebouncedTask(self, settle_ms=0), DebouncedTask(self)
        )  # fmt: skip
        self._dock = context.docks["laboratoryDock"]
        self._dock.installEventFilter(self)
        self._plotted: Trial | None = None
        self._connect()

    def _connect(self) -> None:
        # Behind another tab a dock is visible to Qt, but not in the sense of this signal.
        self._is_in_front = False
        self._dock.visibilityChanged.connect(self._follow_visibility)
        self._analysis.changed.connect(lambda: self.follow_drag(self._session.active_view))
        self._session.scrub_changed.connect(self._ask_digits)
        self._context.store.changed.connect(self._plot_errors)
        self._task.ready.connect(self._show_result)
        self._task.busy_changed.connect(lambda _busy: self._show())
        self._digits_task.ready.connect(self._show_digits)
        self._cost_task.ready.connect(self._show_measured)
        self._cost_task.busy_changed.connect(lambda _busy: self._show_cost())

    @Panel("laboratoryDock", "Lab", on_demand=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the content of the dock; called when the dock is first shown."""
        self._panel = laboratory.panel.LaboratoryPanel(
            self._analysis, self._context.actions["plotErrors"], parent
        )
        self._panel.cost_opened.connect(lambda: self._ask_cost(self._session.active_view))
        self._panel.render_view(self._session.active_view)
        return self._panel

    # On and off

    @property
    def _settings(self) -> LaboratorySettings:
        return self._analysis.settings.laboratory

    def _switch(self, on: bool) -> None:
        self._analysis.change(laboratory=replace(self._settings, on=on))

    @action(
        "toggleLaboratory",
        "Stability Laboratory",
        ANALYSIS_EXPLAIN,
        "Ctrl+Alt+L",
        "laboratory",
        checked=lambda state: state.window.analysis.laboratory.on,
    )
    def _toggle(self) -> None:
        """Compute the curve with few digits by several methods, to see which of them fail."""
        # In a presentation it may be on and hidden: then it is shown.
        if not (self._settings.on and self._dock.isVisible()):
            self._open()
        else:
            self._dock.close()

    def _open(self) -> None:
        self._dock.bring_up()
        self._switch(True)
        make_room(self._context.window, self._dock, _HEIGHT)

    @switch(
        "error_plot",
        "plotErrors",
        "Errors of the Methods",
        PLOTS_OVER_T,
        icon="plot-errors",
        full_name="Plot Errors of the Methods",
    )
    def _toggle_errors(self) -> None:
        """Plot the error of each method of the laboratory over t."""
        if self._context.store.state.error_plot:
            # The laboratory computes the plotted errors.
            self._open()

    def _follow_visibility(self, visible: bool) -> None:
        self._is_in_front = visible
        if visible and self._context.window.isVisible():
            self._switch(True)
            self._ask_cost(self._session.active_view)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Switch the laboratory off when its dock is closed, but not when the dock is hidden."""
        if event.type() == QEvent.Type.Close and isinstance(watched, QDockWidget):
            self._switch(False)
        return super().eventFilter(watched, event)

    # Computing

    def follow_drag(self, view: CurveView) -> bool:
        """Compute anew, after a pause, if curve or settings have changed; return whether it is on."""
        settings = self._settings
        if not settings.on:
            if self._asked is not None:
                self._reset()
        elif self._asked != (view, settings):
            self._try(view, settings)
        return settings.on

    def _try(self, view: CurveView, settings: LaboratorySettings) -> None:
        is_other_kind = self._asked is None or self._asked[0].source.family != view.source.family
        if self._panel is not None and (is_other_kind or self._asked is None or self._asked[1] != settings):
            self._panel.render_view(view)
        self._asked = (view, settings)
        self._task.ask(lambda report: analysis.laboratory.try_methods(view, settings, report))
        self._ask_cost(view)

    def _reset(self) -> None:
        self._asked = self.trial = None
        self._problem = ""
        for task in (self._task, self._digits_task, self._cost_task):
            task.give_up()
        self._context.central.canvas.drawing.annotations.render_traces(_GROUP, ())
        self._plot_errors()

    def _show_result(self, result: object) -> None:
        self.trial = result if isinstance(result, analysis.laboratory.Trial) else None
        self._problem = result if isinstance(result, str) else ""
        self._show()
        self._plot_errors()
        self._ask_digits()

    def _ask_digits(self) -> None:
        trial, t = self.trial, self._session.scrub.t
        if trial is None or not trial.outcomes or self._panel is None:
            if self._panel is not None:
                self._panel.render_digits(None)
            return
        if t is None:
            t = max(trial.outcomes, key=lambda outcome: outcome.worst[0]).worst[1]
        self._digits_task.ask(lambda _report: analysis.laboratory.digits_at(trial.view, trial.settings, t))

    def _show_digits(self, digits: Digits | None) -> None:
        if self._panel is not None:
            t = "" if digits is None else self._session.active_view.t_text(digits.t)
            self._panel.render_digits(digits, t)

    def _ask_cost(self, view: CurveView) -> None:
        """Measure for another number of points, if the page is in front: costs depend on nothing else."""
        if self._panel is None or not (self._is_in_front and self._panel.shows_cost) or not view.is_current:
            return
        if self._costed is None or _size(self._costed) != _size(view):
            self._costed = view
            self._cost_task.ask(lambda report: analysis.laboratory.cost_of(view, report))

    def _show_measured(self, cost: SolvingCost | None) -> None:
        self._cost = cost
        self._show_cost()

    # Showing

    def _show(self) -> None:
        busy, trial = self._task.is_busy, self.trial
        basis = self._context.central.basis
        if self._panel is not None:
            lebesgue = growth_of_data(self._session.active_view, basis) if basis is not None else None
            self._panel.render_trial(trial, lebesgue, busy=busy, problem=self._problem)
        traces: tuple[Trace, ...] = ()
        heading = ""
        if trial is not None and self._settings.on and trial.view.source.visible:
            traces = tuple(
                Trace(outcome.pieces, outcome.calculation.style, outcome.calculation.label)
                for outcome in trial.outcomes
            )
            heading = "computing…" if busy else _heading(trial.settings)
        self._context.central.canvas.drawing.annotations.render_traces(_GROUP, traces, heading, faded=busy)

    def _plot_errors(self) -> None:
        trial = self.trial if self._context.store.state.error_plot else None
        if trial is self._plotted:
            return
        self._plotted = trial
        if trial is None:
            self._analysis.remove_plot(TITLE)
        else:
            self._analysis.add_plot(error_plot(trial))

    def _show_cost(self) -> None:
        if self._panel is not None:
            self._panel.cost.render_cost(self._cost, busy=self._cost_task.is_busy)


def _heading(settings: LaboratorySettings) -> str:
    computed = {RoundedPart.COEFFICIENTS: "Coefficients", RoundedPart.DATA: "Data"}.get(
        settings.rounding, "Computed"
    )
    text = f"{computed} with {settings.digits} digits"
    if settings.decimals is not None:
        text += f", data to {settings.decimals} decimals"
    if settings.shift:
        text += f", t {'−' if settings.shift < 0 else '+'} {number(abs(settings.shift), 6)}"
    return text


def _size(view: CurveView) -> tuple[int, int]:
    return len(view.parameters), view.source.family.derivatives


def error_plot(trial: Trial) -> PlotData:
    """Return the plot of the errors of a trial over t."""
    lines = [
        analysis.plot.PlotLine(outcome.calculation.label, trial.t, outcome.errors, outcome.calculation.style)
        for outcome in trial.outcomes
    ]
    return analysis.plot.plot_of(TITLE, lines, analysis.plot.Scale.LOG)


COMMAND_SETS = (LaboratoryCommands,)
