"""Snapping, the grid's spacing and the unit, as the preferences have them."""

from __future__ import annotations

from app.commands.parts import Handlers, Parts
from app.tools.snapping import Snapping
from app.view_model.curve_view import CurveView


class SnapCommands:
    """Keeps the canvas in step with the preferences about grid and snapping."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self.apply_preferences()

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {"toggleSnap": self._toggle}

    def render(self, view: CurveView) -> None:
        """Snapping can be switched at any time."""

    def apply_preferences(self) -> None:
        """Take over what the preferences say now."""
        preferences, canvas = self._parts.preferences, self._parts.canvas
        snapping = Snapping(preferences.snap_on, preferences.snap_kinds)
        self._parts.actions["toggleSnap"].setChecked(snapping.on)
        canvas.set_snapping(snapping)
        canvas.grid.set_spacing(preferences.grid_spacing)
        canvas.set_unit(preferences.unit_name)
        self._parts.status_line.unit = preferences.unit_name

    def _toggle(self) -> None:
        on = self._parts.actions["toggleSnap"].isChecked()
        self._parts.preferences.snap_on = on
        self.apply_preferences()
        words = "Points snap; hold Ctrl not to." if on else "Points move freely; hold Ctrl to snap."
        self._parts.session.say(words)
