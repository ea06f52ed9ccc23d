"""What is drawn over the curve to show why it goes where it goes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from PySide6.QtWidgets import QWidget

from app.actions.declaration import Action, action, action_for_each
from app.actions.sections import (
    GHOSTS_FAMILY,
    GHOSTS_RULE,
    OVERLAYS_ERRORS,
    OVERLAYS_POLYGONS,
    OVERLAYS_SHAPE,
    Section,
)
from app.commands.context import WindowContext
from app.docks import LatePanel
from app.keymap import action_name
from app.tasks.debounced_task import DebouncedTask
from app.tasks.progress import Report
from app.view_model import analysis
from app.view_model.analysis.settings import AnalysisSettings, Ghost, Overlay, all_ghosts
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from app.view_model.analysis.ghosts import GhostView
    from app.view_model.analysis.overlays import Picture


class _Switch(NamedTuple):
    """Something that can be drawn over the curve, and what its action says."""

    overlay: Overlay
    text: str
    section: Section
    tip: str
    key: str = ""
    icon: str = ""
    full_name: str = ""


_OVERLAYS = (
    _Switch(
        Overlay.COMB, "Curvature Comb", OVERLAYS_SHAPE,
        "Draw how the curve bends, at right angles to it", "Ctrl+Alt+1", "comb",
    ),
    _Switch(
        Overlay.VELOCITIES, "Velocities", OVERLAYS_SHAPE,
        "Draw c′ as arrows at the points and at the scrub line",
        "Ctrl+Alt+2", "velocity", "Velocities as Arrows",
    ),
    _Switch(
        Overlay.ACCELERATIONS, "Accelerations", OVERLAYS_SHAPE,
        "Draw c″ as arrows at the points and at the scrub line; two where it jumps",
        "Ctrl+Alt+3", "acceleration", "Accelerations as Arrows",
    ),
    _Switch(
        Overlay.CIRCLE, "Osculating Circle", OVERLAYS_SHAPE,
        "Draw the circle that the curve follows at the scrub line", "Ctrl+Alt+4", "circle",
    ),
    _Switch(
        Overlay.TICKS, "Ticks at Equal t", OVERLAYS_SHAPE,
        "Draw ticks at equal steps of t: far apart where the curve is fast", "Ctrl+Alt+5", "ticks",
    ),
    _Switch(
        Overlay.MARKS, "Inflections and Extrema", OVERLAYS_SHAPE,
        "Mark inflections, the sharpest and flattest places, and crossings of the curve with itself",
        "Ctrl+Alt+6", "marks",
    ),
    _Switch(
        Overlay.BEZIER, "Bézier Polygons", OVERLAYS_POLYGONS,
        "Draw the Bézier control polygon of every segment", "Ctrl+Alt+7", "bezier",
    ),
    _Switch(
        Overlay.POLYGON, "Polygon of the Points", OVERLAYS_POLYGONS,
        "Join the points by straight lines", "", "polygon",
    ),
    _Switch(
        Overlay.BAND, "Sensitivity Band", OVERLAYS_ERRORS,
        "Shade where errors of points and parameters can bring the curve, at worst", "Ctrl+Alt+8", "band",
    ),
    _Switch(
        Overlay.ENSEMBLE, "Disturbed Curves", OVERLAYS_ERRORS,
        "Draw curves through points and parameters with random errors", "Ctrl+Alt+9", "ensemble",
    ),
)  # fmt: skip

_GROUP = "overlays"
_AT_SCRUB = {Overlay.CIRCLE, Overlay.VELOCITIES, Overlay.ACCELERATIONS}
_WITH_ERRORS = {Overlay.BAND, Overlay.ENSEMBLE}


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
        context.analysis.ghost_chosen.connect(self._make_real)
        context.central.canvas.drawing.annotations.ghost_chosen.connect(self._make_real)
        context.central.canvas.drawing.annotations.ghost_hidden.connect(
            lambda ghost: context.analysis.show_ghost(ghost, False)
        )
        context.session.scrub_changed.connect(self._follow_scrub)

    @LatePanel("analysisDock", "Analysis")
    def build_panel(self) -> QWidget:
        """Return the panel; called when its dock is first shown."""
        # Imported when it is wanted: nobody waits for it at the start.
        from app.panels.analysis_panel import AnalysisPanel  # noqa: PLC0415

        return AnalysisPanel(self._context.analysis, self._context.actions.__getitem__)

    # What is shown

    def follow(self, view: CurveView) -> None:
        """Draw the figures of `view` that are switched on."""
        settings = self._context.analysis.settings
        if settings.is_empty:
            self._clear()
            return
        waits = analysis.overlays.settles(view, settings)
        self._settle(view, settings, waits)
        live = analysis.overlays.live_picture(view, settings, self._context.session.scrub)
        self._ghosts = self._ghosts_of(view, settings)
        settled = self._settled
        figures = [*settled.figures, *live.figures] if settled is not None else live.figures
        ghosts = list(self._ghosts.values())
        busy = waits if settled is None else frozenset()
        self._context.central.canvas.drawing.annotations.render_figures(figures, ghosts)
        rows = analysis.legend.legend_rows(
            view, settings, ghosts, figures if settled is not None else (), busy
        )
        self._context.central.canvas.drawing.annotations.render_legend(_GROUP, rows)
        notes = {**live.notes, **(settled.notes if settled is not None else {})}
        self._context.analysis.note({**notes, **dict.fromkeys(busy, "…")}, view.problem)
        self._is_drawn = True

    def _ghosts_of(self, view: CurveView, settings: AnalysisSettings) -> dict[Ghost, GhostView]:
        if not (settings.ghosts and view.is_current):
            return {}

        in_drag = self._context.session.is_previewing
        return analysis.ghosts.ghost_views(view, settings.ghosts, self._ghosts, in_drag=in_drag)

    def _clear(self) -> None:
        if not self._is_drawn:
            return
        self._is_drawn = False
        self._ghosts, self._asked, self._settled = {}, None, None
        self._task.give_up()
        self._context.central.canvas.drawing.annotations.render_figures(())
        self._context.central.canvas.drawing.annotations.render_legend(_GROUP, ())
        self._context.analysis.note({})

    def _settle(self, view: CurveView, settings: AnalysisSettings, waits: frozenset[Overlay]) -> None:
        """Ask for what is too heavy for a frame, unless the answer is there or on its way."""
        if not waits:
            self._asked, self._settled = None, None
            self._task.give_up()
            return

        scrub = self._context.session.scrub
        asked = (view, analysis.overlays.settling_key(view, settings, scrub))
        if asked == self._asked:
            return
        self._asked, self._settled = asked, None

        def compute(report: Report) -> object:
            return asked, analysis.overlays.settled_picture(view, settings, scrub, report)

        self._task.ask(compute)

    def _show_settled(self, result: tuple[object, Picture]) -> None:
        asked, picture = result
        if asked == self._asked:
            self._settled = picture
            self.follow(self._context.session.active_view)

    def _follow_scrub(self) -> None:
        if self._context.analysis.settings.overlays & _AT_SCRUB:
            self.follow(self._context.session.active_view)

    def _render_settings(self) -> None:
        settings, session = self._context.analysis.settings, self._context.session
        if settings.overlays & _WITH_ERRORS and settings.point_error is None:
            # Once: an error that followed the size would change during a drag.
            self._context.analysis.change(point_error=analysis.scene.usual_error(session.active_view))
            return
        self.follow(session.active_view)

    # What the person does

    @action_for_each(
        _OVERLAYS,
        lambda each: Action(
            action_name("overlay", each.overlay),
            each.text,
            each.section,
            each.key,
            each.icon,
            each.tip,
            each.full_name,
            checked=lambda now: each.overlay in now.state.analysis.overlays,
        ),
    )
    def _switch(self, switch: _Switch) -> None:
        overlay, analysis, session = switch.overlay, self._context.analysis, self._context.session
        shown = overlay not in analysis.settings.overlays
        view = session.active_view
        if overlay is Overlay.CIRCLE and shown and session.scrub is None and view.curve is not None:
            start, end = view.curve.domain
            session.set_scrub((start + end) / 2)
        analysis.show(overlay, shown)

    @action_for_each(
        all_ghosts,
        lambda ghost: Action(
            ghost.action_name,
            ghost.title.title(),
            GHOSTS_FAMILY if ghost.family is not None else GHOSTS_RULE,
            tip=ghost.tip,
            full_name=f"Ghost: {ghost.title.title()}",
            checked=lambda now: ghost in now.state.analysis.ghosts,
        ),
    )
    def _switch_ghost(self, ghost: Ghost) -> None:
        analysis = self._context.analysis
        analysis.show_ghost(ghost, ghost not in analysis.settings.ghosts)

    @action("newSeed", "New Seed", OVERLAYS_ERRORS, icon="seed", full_name="New Seed of Disturbed Curves")
    def _new_seed(self) -> None:
        """Draw other random errors."""
        analysis = self._context.analysis
        analysis.change(
            ensemble_seed=analysis.settings.ensemble_seed + 1,
            overlays=analysis.settings.overlays | {Overlay.ENSEMBLE},
        )

    def _make_real(self, ghost: Ghost) -> None:
        """Give the curve the rules of a ghost."""
        session = self._context.session
        is_family = ghost.family is not None
        text = f"Switch to {ghost.title}" if is_family else f"Use {ghost.title.lower()} parameters"
        session.change(
            text, lambda document: analysis.ghosts.with_ghost_real(document, session.active_index, ghost)
        )
