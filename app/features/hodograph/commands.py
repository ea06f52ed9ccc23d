"""The hodograph: built when its dock is first opened, and in step with the curve while visible."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from ...actions.declaration import action
from ...actions.menus import PLOTS_IN_PLANE
from ...tasks.task import DebouncedTask
from ...tools.parameters import SCRUB_ALONG
from ...tools.toolbox import Toolbox
from ...view_model import analysis
from ...view_model.curve.curve_view import CurveView
from ...widgets.number_text import decimal_mark
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from .. import hodograph

if TYPE_CHECKING:
    from ...view_model.analysis.hodograph import Hodograph
    from .panel import HodographPanel


class HodographCommands:
    """Keeps the hodograph in step with curve and scrub line."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._panel: HodographPanel | None = None
        self._task = DebouncedTask(context.window)
        self._task.ready.connect(self._show)
        context.session.scrub_changed.connect(self._show_scrub)

    @Panel("hodographDock", "Hodograph", on_demand=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the panel; called when its dock is first shown."""
        self._panel = hodograph.panel.HodographPanel(Toolbox(self._context.session, SCRUB_ALONG), parent)
        self._panel.changed.connect(lambda: self.follow_drag(self._context.session.active_view))
        return self._panel

    @action("plotHodograph", "Hodograph…", PLOTS_IN_PLANE, icon="hodograph", full_name="Plot Hodograph…")
    def _bring_up(self) -> None:
        """Draw the velocity c′ as a curve in the plane, with the origin."""
        self._context.docks["hodographDock"].bring_up()

    @property
    def _visible_panel(self) -> HodographPanel | None:
        return self._panel if self._panel is not None and self._panel.isVisible() else None

    def follow_drag(self, view: CurveView) -> bool:
        """Draw the hodograph of `view` if its panel is visible."""
        panel = self._visible_panel
        if panel is not None:
            self._draw(panel, view)
        return panel is not None

    def _draw(self, panel: HodographPanel, view: CurveView) -> None:
        if not view.is_current:
            self._task.give_up()
            panel.plot.say(view.problem)
            return
        compute = partial(analysis.hodograph.hodograph_of, view, panel.order)
        if analysis.plot_samples.is_slow(view):
            panel.plot.waits = True
            panel.plot.refresh()
            self._task.ask(lambda _report: compute())
            return
        self._task.give_up()
        self._show(compute())

    def _show(self, hodograph: Hodograph) -> None:
        panel, session = self._visible_panel, self._context.session
        if panel is not None:
            owners = len(session.active_curve.points)
            panel.plot.render_hodograph(hodograph, owners, calm=session.is_previewing)
            self._show_scrub(session.scrub.t)

    def _show_scrub(self, t: float | None) -> None:
        panel, view = self._visible_panel, self._context.session.active_view
        if panel is None:
            return
        if t is None or not view.is_current:
            panel.show_value(t, None)
            return
        value = analysis.hodograph.derivative_at(view, t, panel.order)
        panel.show_value(t, value, view.t_text(t, decimal_mark()))


COMMAND_SETS = (HodographCommands,)
