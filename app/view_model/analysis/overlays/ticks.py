"""Ticks on the curve at equal steps of t: far apart where it is fast."""

from __future__ import annotations

import numpy as np

from ...geometry import to_the_left, unit_tangents
from ...line_styles import LineStyle
from ..figures import Figure, Shape
from ..overlay import Drawn, Group, Overlay
from ..overlay_settings import Count
from ..scene import Scene

TICK = LineStyle("accent", width=1.4)

COUNT = Count("tickCount", "Number of steps", 20, least=2, most=100)
"""Equal steps of t."""


def _ticks(scene: Scene) -> Drawn:
    """Return ticks across the curve."""
    curve = scene.view.curve
    if curve is None:
        return [], ""
    t = np.linspace(*curve.domain, int(scene.value(COUNT)) + 1)
    places, tangents = curve.evaluate(t), unit_tangents(curve.evaluate(t, 1))
    across = to_the_left(tangents) * scene.size
    points = np.hstack([places, places + across]).reshape(-1, 2)
    return [Figure(TICK, Shape.TICKS, points)], ""


TICKS = Overlay(
    name="ticks",
    text="Ticks at Equal t",
    tip="Draw ticks at equal steps of t: far apart where the curve is fast",
    key="Ctrl+Alt+5",
    icon="ticks",
    group=Group.SHAPE,
    rank=50,
    layer=50,
    draw=_ticks,
    settings=(COUNT,),
)
