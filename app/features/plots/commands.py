"""The plots over t: which are shown, and that they follow curve, scrub line and the visible part of t."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QTimer

from app import panels
from app.actions.declaration import Action, action_for_each
from app.actions.sections import PLOTS_OVER_T
from app.tasks.debounced_task import DebouncedTask
from app.tools.rail import SCRUB
from app.tools.toolbox import Toolbox
from app.view_model import analysis
from app.view_model.analysis.plot import PLOTS, Plot
from app.view_model.curve_view import CurveView
from app.view_model.growth import growth_of_points
from app.workbench.context import WindowContext

if TYPE_CHECKING:
    from app.view_model.analysis.plot_lines import PlotData


_CALM_MS = 300
"""How long after the last change of the visible part the scales fit again."""

_CANVAS_SHARE, _LEAST_BASIS = 0.4, 130
"""What plots leave to the canvas of the height, and to the basis functions in pixels."""


class PlotCommands:
    """Switches plots, and keeps them in step with the curve.

    Nothing of them is built or computed while none is switched on.
    """

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._task = DebouncedTask(context.window)
        self._task.ready.connect(self._show_settled)
        self._calm = QTimer(context.window, singleShot=True, interval=_CALM_MS)
        self._calm.timeout.connect(self._fit_values)
        self._own: list[PlotData] = []
        self._plotted: CurveView | None = None
        self._was_calm = False
        context.analysis.changed.connect(self._arrange)
        context.central.plot_panel.changed.connect(self._follow_added)
        context.session.scrub_changed.connect(self._show_scrub)
        context.session.interrupted.connect(self._abandon_gesture)
        context.central.basis_panel.camera.changed.connect(self._follow_range)

    def follow(self, view: CurveView) -> None:
        """Plot `view`; during a drag the scales only grow."""
        calm = self._context.session.is_previewing
        if self._is_on and not (self._shows_same(view) and calm == self._was_calm):
            self._plot(view, calm=calm)

    def _shows_same(self, view: CurveView) -> bool:
        """Whether only points have moved, and nothing but the Lebesgue function is plotted."""
        shown = self._context.analysis.settings.plots
        follow = any(plot.follows_points for plot in shown)
        if follow or self._plotted is None or not view.is_current:
            return False
        same = view.source.family == self._plotted.source.family
        same = same and np.array_equal(view.parameters, self._plotted.parameters)
        return same and (not view.source.family.derivatives or view.cardinal is self._plotted.cardinal)

    @property
    def _is_on(self) -> bool:
        return bool(self._context.analysis.settings.plots or self._context.central.plot_panel.added)

    # Which plots there are

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
            checked=lambda now: plot in now.state.analysis.plots,
        ),
    )
    def _switch(self, plot: Plot) -> None:
        analysis = self._context.analysis
        analysis.show_plot(plot, plot not in analysis.settings.plots)

    def _arrange(self) -> None:
        """Show or hide the panel, and plot."""
        panel = self._context.central.plot_panel
        if not self._is_on:
            self._task.give_up()
            panel.hide()
            if panel.pane is not None:
                # Else they would stand there when the panel is next opened, until others are computed.
                panel.pane.canvas.render_plots([], self._context.session.active_view.parameters, calm=False)
            return
        pane = panel.fill(self._build)
        # What it was before: on its way to the screen the panel gets other heights.
        kept = panel.kept_height if panel.isHidden() else 0
        panel.show()
        count = len(self._context.analysis.settings.plots) + len(panel.added)
        self._make_room(max(pane.wanted_height(count), kept))
        pane.canvas.camera.show_t(*self._context.central.basis_panel.camera.t_range)
        pane.canvas.set_scrub(self._context.session.scrub)
        self._plot(self._context.session.active_view, calm=self._context.session.is_previewing)

    def _follow_added(self) -> None:
        """Show what others have added; where only their values are other ones, the rest stays."""
        pane = self._context.central.plot_panel.pane
        count = len(self._context.analysis.settings.plots) + len(self._context.central.plot_panel.added)
        if self._is_on and pane is not None and count == len(pane.canvas.plots):
            self._show(self._own, calm=self._context.session.is_previewing)
        else:
            self._arrange()

    def _build(self) -> panels.plot_pane.PlotPane:
        context = self._context
        canvas = panels.plot_canvas.PlotCanvas(Toolbox(context.session, SCRUB))
        canvas.camera.range_asked.connect(context.central.basis_panel.camera.show_t)
        canvas.scrub_nudged.connect(self._nudge_scrub)
        canvas.hint_changed.connect(context.status_line.show_hint)
        canvas.pointed_at.connect(context.status_line.show_t)
        choices = [(plot.symbol, context.actions[plot.action_name]) for plot in PLOTS]
        pane = panels.plot_pane.PlotPane(canvas, choices)
        pane.close_asked.connect(lambda: context.analysis.change(plots=frozenset()))
        return pane

    def _make_room(self, height: int) -> None:
        """Give the plots that height, first of the canvas, then of the basis functions."""
        splitter = self._context.central.splitter
        canvas, basis, plots = splitter.sizes()
        total = canvas + basis + plots
        missing = max(height - plots, 0)
        if missing:
            of_canvas = min(missing, max(canvas - int(_CANVAS_SHARE * total), 0))
            of_basis = min(missing - of_canvas, max(basis - _LEAST_BASIS, 0))
            splitter.setSizes([canvas - of_canvas, basis - of_basis, plots + of_canvas + of_basis])

    # What they show

    def _plot(self, view: CurveView, *, calm: bool) -> None:
        pane, kinds = self._context.central.plot_panel.pane, self._context.analysis.settings.plots
        assert pane is not None
        self._plotted, self._was_calm = view if view.is_current else None, calm
        if not view.is_current:
            self._task.give_up()
            pane.canvas.say(view.problem)
            return
        basis = self._context.central.basis_panel.drawing.basis
        constant = growth_of_points(view, basis)
        compute = partial(
            analysis.plotted.plots_of, view, kinds, pane.canvas.camera.t_range, pane.canvas.columns, constant
        )
        if analysis.plotted.orders_of(kinds) and analysis.plot_samples.is_slow(view):
            pane.canvas.set_waiting()
            self._task.ask(lambda _report: compute())
            return
        self._task.give_up()
        self._show(compute(), calm=calm)

    def _show_settled(self, plots: list[PlotData]) -> None:
        if self._is_on:
            self._show(plots, calm=self._context.session.is_previewing)

    def _show(self, own: list[PlotData], *, calm: bool) -> None:
        pane = self._context.central.plot_panel.pane
        assert pane is not None
        self._own = own
        plots = [*own, *self._context.central.plot_panel.added]
        pane.canvas.render_plots(plots, self._context.session.active_view.parameters, calm=calm)
        self._show_values()

    def _fit_values(self) -> None:
        """Fit the scales again, after the visible part of t has changed."""
        if self._is_on and not self._context.session.is_previewing:
            self._plot(self._context.session.active_view, calm=False)

    def _follow_range(self) -> None:
        if self._is_on:
            pane = self._context.central.plot_panel.pane
            assert pane is not None
            pane.canvas.camera.show_t(*self._context.central.basis_panel.camera.t_range)
            self._plot(self._context.session.active_view, calm=True)
            self._calm.start()

    # The scrub line

    def _show_scrub(self, t: float | None) -> None:
        if self._is_on:
            pane = self._context.central.plot_panel.pane
            assert pane is not None
            pane.canvas.set_scrub(t)
            self._show_values()

    def _nudge_scrub(self, by: float) -> None:
        """Move the scrub line along t; without one, show it in the middle of what is visible."""
        session, pane = self._context.session, self._context.central.plot_panel.pane
        if session.active_view.curve is None or pane is None:
            return
        start, end = session.active_view.curve.domain
        t = sum(pane.canvas.camera.t_range) / 2 if session.scrub is None else session.scrub + by
        session.set_scrub(min(max(t, start), end))

    def _show_values(self) -> None:

        panel, t = self._context.central.plot_panel, self._context.session.scrub
        assert panel.pane is not None
        values: dict[str, float] = {}
        if t is not None:
            known = analysis.plotted.values_at(
                self._context.session.active_view, self._context.analysis.settings.plots, t
            )
            values |= {plot.symbol: value for plot, value in known.items()}
            for plot in panel.added:
                for line in plot.lines:
                    values[line.name or plot.symbol] = line.value_at(t)
        panel.pane.show_values(t, values)

    def _abandon_gesture(self) -> None:
        pane = self._context.central.plot_panel.pane
        if pane is not None:
            pane.canvas.abandon_gesture()


COMMAND_SETS = (PlotCommands,)
