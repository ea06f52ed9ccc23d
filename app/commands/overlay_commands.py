"""What is drawn over the curve to show why it goes where it goes."""

from __future__ import annotations

from functools import partial

from app.commands.parts import Handlers, Parts
from app.view_model.analysis.settings import Overlay
from app.view_model.curve_view import CurveView

OVERLAYS = {"overlayComb": Overlay.COMB}
"""The overlay that each action switches."""


class OverlayCommands:
    """Switches overlays, and keeps the figures on the canvas in step with curve and settings."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        parts.analysis.changed.connect(self._render_settings)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {name: partial(self._switch, name) for name in OVERLAYS}

    def render(self, view: CurveView) -> None:
        """Overlays can be switched at any time."""

    def follow(self, view: CurveView) -> None:
        """Draw the figures of `view` that are switched on."""
        settings = self._parts.analysis.settings
        if not settings.overlays:
            self._parts.canvas.render_figures(())
            return
        # Imported when there is something to show: nobody waits for it at the start.
        from app.view_model.analysis.overlays import live_figures  # noqa: PLC0415

        self._parts.canvas.render_figures(live_figures(view, settings))

    def _switch(self, name: str) -> None:
        self._parts.analysis.show(OVERLAYS[name], self._parts.actions[name].isChecked())

    def _render_settings(self) -> None:
        shown = self._parts.analysis.settings.overlays
        for name, overlay in OVERLAYS.items():
            self._parts.actions[name].setChecked(overlay in shown)
        self.follow(self._parts.session.active_view)
