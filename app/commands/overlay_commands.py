"""What is drawn over the curve to show why it goes where it goes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from app.commands.parts import Handlers, Parts
from app.tasks.debounced_task import DebouncedTask
from app.tasks.progress import Report
from app.view_model.analysis.settings import AnalysisSettings, Ghost, Overlay, all_ghosts
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from app.view_model.analysis.ghosts import GhostView
    from app.view_model.analysis.overlays import Picture

OVERLAYS = {
    "overlayComb": Overlay.COMB,
    "overlayVelocities": Overlay.VELOCITIES,
    "overlayAccelerations": Overlay.ACCELERATIONS,
    "overlayCircle": Overlay.CIRCLE,
    "overlayBezier": Overlay.BEZIER,
    "overlayPolygon": Overlay.POLYGON,
    "overlayTicks": Overlay.TICKS,
    "overlayMarks": Overlay.MARKS,
    "overlayBand": Overlay.BAND,
    "overlayEnsemble": Overlay.ENSEMBLE,
}
"""The overlay that each action switches."""

_GROUP = "overlays"
_AT_SCRUB = {Overlay.CIRCLE, Overlay.VELOCITIES, Overlay.ACCELERATIONS}
_WITH_ERRORS = {Overlay.BAND, Overlay.ENSEMBLE}


class OverlayCommands:
    """Switches overlays, and keeps the figures on the canvas in step with curve and settings."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._ghosts: dict[Ghost, GhostView] = {}
        self._task = DebouncedTask(parts.window)
        self._task.ready.connect(self._show_settled)
        self._asked: object = None
        self._settled: Picture | None = None
        self._is_drawn = False
        parts.analysis.changed.connect(self._render_settings)
        parts.analysis.ghost_chosen.connect(self._make_real)
        parts.canvas.annotations.ghost_chosen.connect(self._make_real)
        parts.canvas.annotations.ghost_hidden.connect(lambda ghost: parts.analysis.show_ghost(ghost, False))
        parts.session.scrub_changed.connect(self._follow_scrub)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            **{name: partial(self._switch, name) for name in OVERLAYS},
            **{ghost.action_name: partial(self._switch_ghost, ghost) for ghost in all_ghosts()},
            "newSeed": self._new_seed,
        }

    def render(self, view: CurveView) -> None:
        """Overlays can be switched at any time."""

    # What is shown

    def follow(self, view: CurveView) -> None:
        """Draw the figures of `view` that are switched on."""
        settings = self._parts.analysis.settings
        if settings.is_empty:
            self._clear()
            return
        # Imported when there is something to show: nobody waits for it at the start.
        from app.view_model.analysis.legend import legend_rows  # noqa: PLC0415
        from app.view_model.analysis.overlays import live_picture, settles  # noqa: PLC0415

        waits = settles(view, settings)
        self._settle(view, settings, waits)
        live = live_picture(view, settings, self._parts.session.scrub)
        self._ghosts = self._ghosts_of(view, settings)
        settled = self._settled
        figures = [*settled.figures, *live.figures] if settled is not None else live.figures
        ghosts = list(self._ghosts.values())
        busy = waits if settled is None else frozenset()
        self._parts.canvas.annotations.render_figures(figures, ghosts)
        rows = legend_rows(view, settings, ghosts, figures if settled is not None else (), busy)
        self._parts.canvas.annotations.render_legend(_GROUP, rows)
        notes = {**live.notes, **(settled.notes if settled is not None else {})}
        self._parts.analysis.note({**notes, **dict.fromkeys(busy, "…")}, view.problem)
        self._is_drawn = True

    def _ghosts_of(self, view: CurveView, settings: AnalysisSettings) -> dict[Ghost, GhostView]:
        if not (settings.ghosts and view.is_current):
            return {}
        from app.view_model.analysis.ghosts import ghost_views  # noqa: PLC0415 - as above

        in_drag = self._parts.session.is_previewing
        return ghost_views(view, settings.ghosts, self._ghosts, in_drag=in_drag)

    def _clear(self) -> None:
        if not self._is_drawn:
            return
        self._is_drawn = False
        self._ghosts, self._asked, self._settled = {}, None, None
        self._task.give_up()
        self._parts.canvas.annotations.render_figures(())
        self._parts.canvas.annotations.render_legend(_GROUP, ())
        self._parts.analysis.note({})

    def _settle(self, view: CurveView, settings: AnalysisSettings, waits: frozenset[Overlay]) -> None:
        """Ask for what is too heavy for a frame, unless the answer is there or on its way."""
        if not waits:
            self._asked, self._settled = None, None
            self._task.give_up()
            return
        from app.view_model.analysis.overlays import settled_picture, settling_key  # noqa: PLC0415

        scrub = self._parts.session.scrub
        asked = (view, settling_key(view, settings, scrub))
        if asked == self._asked:
            return
        self._asked, self._settled = asked, None

        def compute(report: Report) -> object:
            return asked, settled_picture(view, settings, scrub, report)

        self._task.ask(compute)

    def _show_settled(self, result: tuple[object, Picture]) -> None:
        asked, picture = result
        if asked == self._asked:
            self._settled = picture
            self.follow(self._parts.session.active_view)

    def _follow_scrub(self) -> None:
        if self._parts.analysis.settings.overlays & _AT_SCRUB:
            self.follow(self._parts.session.active_view)

    def _render_settings(self) -> None:
        analysis, session = self._parts.analysis, self._parts.session
        shown = analysis.settings.overlays
        if shown & _WITH_ERRORS and analysis.settings.point_error is None:
            from app.view_model.analysis.scene import usual_error  # noqa: PLC0415

            # Once: an error that followed the size would change during a drag.
            analysis.change(point_error=usual_error(session.active_view))
            return
        for name, overlay in OVERLAYS.items():
            self._parts.actions[name].setChecked(overlay in shown)
        for ghost in all_ghosts():
            self._parts.actions[ghost.action_name].setChecked(ghost in analysis.settings.ghosts)
        self.follow(session.active_view)

    # What the person does

    def _switch(self, name: str) -> None:
        overlay, shown = OVERLAYS[name], self._parts.actions[name].isChecked()
        session = self._parts.session
        view = session.active_view
        if overlay is Overlay.CIRCLE and shown and session.scrub is None and view.curve is not None:
            start, end = view.curve.domain
            session.set_scrub((start + end) / 2)
        self._parts.analysis.show(overlay, shown)

    def _switch_ghost(self, ghost: Ghost) -> None:
        self._parts.analysis.show_ghost(ghost, self._parts.actions[ghost.action_name].isChecked())

    def _new_seed(self) -> None:
        analysis = self._parts.analysis
        analysis.change(
            ensemble_seed=analysis.settings.ensemble_seed + 1,
            overlays=analysis.settings.overlays | {Overlay.ENSEMBLE},
        )

    def _make_real(self, ghost: Ghost) -> None:
        """Give the curve the rules of a ghost."""
        from app.view_model.analysis.ghosts import with_ghost_real  # noqa: PLC0415 - as above

        session = self._parts.session
        is_family = ghost.family is not None
        text = f"Switch to {ghost.title}" if is_family else f"Use {ghost.title.lower()} parameters"
        session.change(text, lambda document: with_ghost_real(document, session.active_index, ghost))
