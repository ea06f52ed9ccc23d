"""Ticks at equal steps of t: far apart where the curve is fast."""

from __future__ import annotations

import numpy as np

from ...geometry import to_the_left, unit_tangents
from ...line_styles import LineStyle
from ...settings import Count
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape

TICK = LineStyle("accent", width=1.4)

COUNT = Count("tickCount", "Number of steps", 20, limits=(2, 100))


def ticks(data: OverlayInput) -> Figures:
    """Return short lines across the curve at equal steps of t."""
    curve = data.view.curve
    if curve is None:
        return Figures()
    t = np.linspace(*curve.domain, data.value(COUNT) + 1)
    positions, tangents = curve.evaluate(t), unit_tangents(curve.evaluate(t, 1))
    ends = positions + to_the_left(tangents) * data.size
    return Figures([Figure(TICK, Shape.TICKS, np.hstack([positions, ends]).reshape(-1, 2))])


TICKS = Overlay(
    name="ticks",
    text="Ticks at Equal t",
    tip="Draw ticks at equal steps of t: far apart where the curve is fast",
    key="Ctrl+Alt+5",
    icon="ticks",
    group=Group.SHAPE,
    rank=50,
    draw=ticks,
    settings=(COUNT,),
    legend=lambda _view, _settings: [(TICK, "Equal steps of t")],
)
