"""The polygon of the points themselves."""

from __future__ import annotations

from ...line_styles import LineStyle
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape

SIDES = LineStyle("muted", 0.8, dashes=(2.0, 4.0))


def polygon(data: OverlayInput) -> Figures:
    """Return the polygon through the points."""
    return Figures([Figure(SIDES, Shape.LINE, data.view.at_knots)])


POLYGON = Overlay(
    name="polygon",
    text="Polygon of the Points",
    tip="Join the points with straight lines",
    icon="polygon",
    group=Group.POLYGONS,
    rank=80,
    layer=30,
    draw=polygon,
    legend=lambda _view, _settings: [(SIDES, "Polygon of the points")],
)
