"""Overlays and ghosts: the actions that switch them, and the figures on the canvas."""

from __future__ import annotations

from string import capwords
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from ...actions.declaration import Action, action, action_for_each
from ...actions.menus import GHOSTS_FAMILY, GHOSTS_RULE, OVERLAY_SECTIONS
from ...tasks.progress import Report
from ...tasks.task import DebouncedTask
from ...view_model import analysis
from ...view_model.analysis.ghost import Ghost, all_ghosts
from ...view_model.analysis.overlay import OVERLAYS, ErrorSize, Group, Overlay
from ...view_model.analysis.overlays.ensemble import ENSEMBLE, SEED
from ...view_model.analysis.settings import AnalysisSettings
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from .. import overlays

if TYPE_CHECKING:
    from ...view_model.analysis.ghost_views import GhostView
    from ...view_model.analysis.picture import Picture


_GROUP = "overlays"


class OverlayCommands:
    """Switches overlays, and keeps the figures on the canvas in step with curve and settings."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._ghosts: dict[Ghost, GhostView] = {}
        self._task = DebouncedTask(context.window)
        self._task.ready.connect(self._show_settled)
        self._asked: object = None
        self._settled: Picture | None = None
        self._is_drawn = False
        context.analysis.changed.connect(self._render_settings)
        context.analysis.ghost_adopted.connect(self._make_real)
        context.central.canvas.drawing.annotations.ghost_adopted.connect(self._make_real)
        context.central.canvas.drawing.annotations.ghost_hidden.connect(
            lambda ghost: context.analysis.show_ghost(ghost, False)
        )
        context.session.scrub_changed.connect(self._follow_scrub)

    @Panel("analysisDock", "Analysis")
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the panel; called when its dock is first shown."""
        actions = self._context.actions
        panel = overlays.panel.AnalysisPanel(self._context.analysis, actions.__getitem__, parent)
        actions.redeclared.connect(panel.follow_ghosts)
        return panel

    # What is shown

    def follow_drag(self, view: CurveView) -> bool:
        """Draw the figures of `view` that are switched on."""
        settings = self._context.analysis.settings
        if settings.is_empty:
            if self._is_drawn:
                self._clear()
            return False
        waits = analysis.picture.settling(view, settings)
        self._settle(view, settings, waits)
        live = analysis.picture.live_picture(view, settings, self._context.session.scrub.t)
        self._ghosts = self._ghosts_of(view, settings)
        settled = self._settled
        figures = [*settled.figures, *live.figures] if settled is not None else live.figures
        ghosts = list(self._ghosts.values())
        busy = waits if settled is None else frozenset()
        self._context.central.canvas.drawing.annotations.figure_layer.render(figures, ghosts)
        in_drag = self._context.session.is_previewing
        rows = analysis.legend.legend_rows(view, settings, ghosts, figures, busy, in_drag=in_drag)
        self._context.central.canvas.drawing.annotations.render_legend(_GROUP, rows)
        notes = {**live.notes, **(settled.notes if settled is not None else {})}
        self._context.analysis.note({**notes, **dict.fromkeys(busy, "…")}, view.problem)
        self._is_drawn = True
        return True

    def _ghosts_of(self, view: CurveView, settings: AnalysisSettings) -> dict[Ghost, GhostView]:
        if not (settings.ghosts and view.is_current):
            return {}

        in_drag = self._context.session.is_previewing
        return analysis.ghost_views.ghost_views(view, settings.ghosts, self._ghosts, in_drag=in_drag)

    def _clear(self) -> None:
        if not self._is_drawn:
            return
        self._is_drawn = False
        self._ghosts, self._asked, self._settled = {}, None, None
        self._task.give_up()
        self._context.central.canvas.drawing.annotations.figure_layer.render((), ())
        self._context.central.canvas.drawing.annotations.render_legend(_GROUP, ())
        self._context.analysis.note({})

    def _settle(self, view: CurveView, settings: AnalysisSettings, waits: frozenset[Overlay]) -> None:
        """Request overlays that are too heavy for a frame, unless the result is there or being computed."""
        if not waits:
            self._asked, self._settled = None, None
            self._task.give_up()
            return

        scrub = self._context.session.scrub.t
        asked = (view, analysis.picture.settling_key(view, settings, scrub))
        if asked == self._asked:
            return
        self._asked, self._settled = asked, None

        def compute(report: Report) -> object:
            return asked, analysis.picture.settled_picture(view, settings, scrub, report)

        self._task.ask(compute)

    def _show_settled(self, result: tuple[object, Picture]) -> None:
        asked, picture = result
        if asked == self._asked:
            self._settled = picture
            self.follow_drag(self._context.session.active_view)

    def _follow_scrub(self) -> None:
        if any(overlay.follows_scrub for overlay in self._context.analysis.settings.overlays):
            self.follow_drag(self._context.session.active_view)

    def _render_settings(self) -> None:
        view, settings = self._context.session.active_view, self._context.analysis.settings
        for setting in [setting for overlay in settings.overlays for setting in overlay.settings]:
            if isinstance(setting, ErrorSize) and setting.usual and not settings.has(setting):
                # Once: an error that depended on the size would change during a drag.
                self._context.analysis.set_value(setting, setting.usual(view))
                return
        self.follow_drag(view)

    # What the person does

    @action_for_each(
        OVERLAYS,
        lambda each: Action(
            each.action_name,
            each.text,
            OVERLAY_SECTIONS[each.group],
            each.key,
            each.icon,
            each.tip,
            each.full_name,
            checked=lambda state: each in state.window.analysis.overlays,
        ),
    )
    def _switch(self, overlay: Overlay) -> None:
        analysis, session = self._context.analysis, self._context.session
        is_shown = overlay not in analysis.settings.overlays
        view = session.active_view
        if overlay.brings_scrub and is_shown and session.scrub.t is None and view.curve is not None:
            start, end = view.curve.domain
            session.scrub.set((start + end) / 2)
        analysis.show(overlay, is_shown)

    @action_for_each(
        all_ghosts,
        lambda ghost: Action(
            ghost.action_name,
            capwords(ghost.title),
            GHOSTS_FAMILY if ghost.is_of_family else GHOSTS_RULE,
            tip=ghost.tip,
            full_name=f"Ghost: {capwords(ghost.title)}",
            checked=lambda state: ghost in state.window.analysis.ghosts,
        ),
    )
    def _switch_ghost(self, ghost: Ghost) -> None:
        analysis = self._context.analysis
        analysis.show_ghost(ghost, ghost not in analysis.settings.ghosts)

    @action(
        "ghostAllFamilies",
        "All Families",
        GHOSTS_FAMILY,
        full_name="Ghosts of All Families",
        checked=lambda state: _ghosts_of_families() <= state.window.analysis.ghosts,
    )
    def _switch_all_families(self) -> None:
        """Also draw the same points as a curve of every family, each with its Lebesgue constant."""
        analysis, families = self._context.analysis, _ghosts_of_families()
        drawn = analysis.settings.ghosts
        analysis.change(ghosts=drawn - families if families <= drawn else drawn | families)

    @action(
        "newSeed",
        "New Seed",
        OVERLAY_SECTIONS[Group.ERRORS],
        icon="seed",
        full_name="New Seed of Disturbed Curves",
    )
    def _new_seed(self) -> None:
        """Draw new random errors."""
        analysis = self._context.analysis
        analysis.set_value(SEED, analysis.settings.value(SEED) + 1)
        analysis.show(ENSEMBLE, True)

    def _make_real(self, ghost: Ghost) -> None:
        """Apply the rules of a ghost to the curve."""
        session = self._context.session
        session.change(
            ghost.step,
            lambda document: analysis.ghost_views.with_ghost_real(document, session.active_index, ghost),
        )


def _ghosts_of_families() -> frozenset[Ghost]:
    return frozenset(ghost for ghost in all_ghosts() if ghost.is_of_family)


COMMAND_SETS = (OverlayCommands,)
