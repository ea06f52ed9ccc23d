"""Ticks on the curve at equal steps of t: far apart where it is fast."""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.comb import unit_tangents
from app.view_model.analysis.figures import Figure, Shape, Style
from app.view_model.analysis.scene import Scene


def ticks(scene: Scene) -> list[Figure]:
    """Return ticks across the curve."""
    curve = scene.view.curve
    if curve is None:
        return []
    t = np.linspace(*curve.domain, scene.settings.tick_count + 1)
    places, tangents = curve.evaluate(t), unit_tangents(curve.evaluate(t, 1))
    across = np.column_stack([-tangents[:, 1], tangents[:, 0]]) * scene.size
    points = np.hstack([places, places + across]).reshape(-1, 2)
    return [Figure(Style.TICK, Shape.TICKS, points)]
