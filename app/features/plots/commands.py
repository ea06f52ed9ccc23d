"""The plots over t: their panel, the actions that switch them, and the updates that follow the curve."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from ...actions.declaration import Action, action_for_each
from ...actions.menus import PLOTS_OVER_T
from ...qt.overrides import SafeOverrides
from ...tasks.task import DebouncedTask, DelayedCall
from ...tools.parameters import SCRUB
from ...tools.toolbox import Toolbox
from ...view_model import analysis
from ...view_model.analysis.plot import PLOTS, Plot
from ...view_model.basis import growth_of_points
from ...view_model.curve.curve_view import CurveView
from ...widgets.number_text import decimal_mark
from ...workbench.central_area import CentralPane, Pane
from ...workbench.context import WindowContext
from .. import plots

if TYPE_CHECKING:
    from ...view_model.analysis.plot import PlotData
    from .pane import PlotPane

USUAL_HEIGHT = 170


class PlotPanel(SafeOverrides, CentralPane):
    """The place of the plots with their header, which are built when the first is switched on.

    Attributes
    ----------
    pane
        Header and plots; None until the first plot.
    last_height
        The height of the panel when it was last visible.
    """

    def __init__(self, last_height: int, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAccessibleName("Plots over t")
        self.last_height = last_height or USUAL_HEIGHT
        self.pane: PlotPane | None = None
        self._rows = QVBoxLayout(self)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self.hide()

    def hold(self, pane: PlotPane) -> None:
        """Insert header and plots."""
        self.pane, self.plot = pane, pane.canvas
        self._rows.addWidget(pane)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.isVisible():
            self.last_height = self.height()


_CALM_MS = 300
"""Time after the last change of the visible part until the scales fit again."""


class PlotCommands:
    """Switches plots, and keeps them in step with the curve.

    Nothing is built or computed while no plot is switched on.
    """

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session, self._analysis = context.session, context.analysis
        self._task = DebouncedTask(context.window)
        self._task.ready.connect(self._show_settled)
        self._calm = DelayedCall(context.window, _CALM_MS, self._fit_values)
        self._curve_plots: list[PlotData] = []
        self._plotted: CurveView | None = None
        self._was_calm = False

    @Pane("plotPanel")
    def build_panel(self, parent: QWidget) -> PlotPanel:
        """Return the panel of the plots."""
        self._panel = PlotPanel(self._context.preferences.plot_height, parent)
        self._analysis.changed.connect(self._arrange)
        self._analysis.added.connect(self._follow_added)
        self._session.scrub_changed.connect(self._show_scrub)
        self._context.central.t_camera.changed.connect(self._follow_range)
        return self._panel

    def close(self) -> None:
        """Store the height of the plots."""
        self._context.preferences.plot_height = self._panel.last_height

    def follow_drag(self, view: CurveView) -> bool:
        """Plot `view`; during a drag the scales only grow."""
        pane = self._visible_pane
        if pane is None:
            return False
        calm = self._session.is_previewing
        if not (self._shows_same(view) and calm == self._was_calm):
            self._plot(pane, view, calm=calm)
        return True

    def _shows_same(self, view: CurveView) -> bool:
        """Whether only points have moved, and no plot depends on them."""
        follow = any(plot.follows_points for plot in self._analysis.settings.plots)
        if follow or self._plotted is None or not view.is_current:
            return False
        same = view.pieces[0].functions_key == self._plotted.pieces[0].functions_key
        same = same and np.array_equal(view.parameters, self._plotted.parameters)
        return same and (not view.source.family.derivatives or view.cardinal is self._plotted.cardinal)

    @property
    def _count(self) -> int:
        """Number of plots."""
        return len(self._analysis.settings.plots) + len(self._analysis.added_plots)

    @property
    def _visible_pane(self) -> PlotPane | None:
        """Header and plots while there are any."""
        return self._panel.pane if self._count else None

    # Switching plots

    @action_for_each(
        PLOTS,
        lambda plot: Action(
            plot.action_name,
            plot.text,
            PLOTS_OVER_T,
            "",
            plot.icon,
            plot.tip,
            f"Plot {plot.text}",
            checked=lambda state: plot in state.window.analysis.plots,
        ),
    )
    def _switch(self, plot: Plot) -> None:
        self._analysis.show_plot(plot, plot not in self._analysis.settings.plots)

    def _arrange(self) -> None:
        """Show or hide the panel, and plot."""
        panel, view = self._panel, self._session.active_view
        if not self._count:
            self._task.give_up()
            panel.hide()
            if panel.pane is not None:
                # Else old plots would be visible when the panel is opened again, until new ones are computed.
                panel.pane.canvas.render_plots([], view.parameters, calm=False)
            return
        if panel.pane is None:
            panel.hold(self._build())
        assert panel.pane is not None
        # The height before: Qt gives the panel other heights while it is shown.
        last_height = panel.last_height if panel.isHidden() else 0
        panel.show()
        self._context.central.make_room(panel, max(panel.pane.wanted_height(self._count), last_height))
        panel.pane.canvas.camera.show_t(*self._context.central.t_camera.t_range)
        panel.pane.canvas.set_scrub(self._session.scrub.t)
        self._plot(panel.pane, view, calm=self._session.is_previewing)

    def _follow_added(self) -> None:
        """Show plots that other panels have added; where only their values changed, keep the rest."""
        pane = self._visible_pane
        if pane is not None and self._count == len(pane.canvas.plots):
            self._show(pane, self._curve_plots, calm=self._session.is_previewing)
        else:
            self._arrange()

    def _build(self) -> PlotPane:
        context = self._context
        canvas = plots.pane.PlotCanvas(Toolbox(self._session, SCRUB))
        canvas.set_scale(context.store.state.scale)
        canvas.camera.range_requested.connect(context.central.t_camera.show_t)
        canvas.scrub_nudged.connect(self._nudge_scrub)
        canvas.pointed_at.connect(context.status_line.readouts.show_t)
        context.connect_plot(canvas)
        choices = [(plot.symbol, context.actions[plot.action_name]) for plot in PLOTS]
        pane = plots.pane.PlotPane(canvas, choices)
        pane.close_asked.connect(lambda: self._analysis.change(plots=frozenset()))
        return pane

    # Drawing

    def _plot(self, pane: PlotPane, view: CurveView, *, calm: bool) -> None:
        kinds = self._analysis.settings.plots
        self._plotted, self._was_calm = view if view.is_current else None, calm
        if not view.is_current:
            self._task.give_up()
            pane.canvas.say(view.problem)
            return
        constant, canvas = growth_of_points(view, self._context.central.basis), pane.canvas
        compute = partial(
            analysis.plot_samples.plots_of, view, kinds, canvas.camera.t_range, canvas.columns, constant
        )
        if analysis.plot_samples.orders_of(kinds) and analysis.plot_samples.is_slow(view):
            pane.canvas.set_waiting()
            self._task.ask(lambda _report: compute())
            return
        self._task.give_up()
        self._show(pane, compute(), calm=calm)

    def _show_settled(self, plots: list[PlotData]) -> None:
        if (pane := self._visible_pane) is not None:
            self._show(pane, plots, calm=self._session.is_previewing)

    def _show(self, pane: PlotPane, curve_plots: list[PlotData], *, calm: bool) -> None:
        self._curve_plots = curve_plots
        added = self._analysis.added_plots.values()
        pane.canvas.render_plots([*curve_plots, *added], self._session.active_view.parameters, calm=calm)
        self._show_values(pane)

    def _fit_values(self) -> None:
        """Fit the scales after the visible part of t has changed."""
        if (pane := self._visible_pane) is not None and not self._session.is_previewing:
            self._plot(pane, self._session.active_view, calm=False)

    def _follow_range(self) -> None:
        if (pane := self._visible_pane) is not None:
            pane.canvas.camera.show_t(*self._context.central.t_camera.t_range)
            self._plot(pane, self._session.active_view, calm=True)
            self._calm.start()

    # The scrub line

    def _show_scrub(self, t: float | None) -> None:
        if (pane := self._visible_pane) is not None:
            pane.canvas.set_scrub(t)
            self._show_values(pane)

    def _nudge_scrub(self, by: float) -> None:
        """Move the scrub line along t; without one, show it in the middle of the visible part."""
        session = self._session
        if session.active_view.curve is None:
            return
        start, end = session.active_view.curve.domain
        middle = sum(self._context.central.t_camera.t_range) / 2
        session.scrub.set(min(max(middle if session.scrub.t is None else session.scrub.t + by, start), end))

    def _show_values(self, pane: PlotPane) -> None:
        t, view = self._session.scrub.t, self._session.active_view
        values: dict[str, tuple[float, float]] = {}
        if t is not None:
            known = analysis.plot_samples.uncertain_values_at(view, self._analysis.settings.plots, t)
            values |= {plot.symbol: value for plot, value in known.items()}
            for plot in self._analysis.added_plots.values():
                for line in plot.lines:
                    values[line.name or plot.symbol] = line.value_at(t), 0.0
        pane.show_values("" if t is None else view.t_text(t, decimal_mark()), values)


COMMAND_SETS = (PlotCommands,)
