"""The polygon of the points themselves."""

from __future__ import annotations

from ...line_styles import LineStyle
from ..figures import Figure, Shape
from ..overlay import Drawn, Group, Overlay
from ..scene import Scene

SIDES = LineStyle("muted", 0.8, dashes=(2.0, 4.0))


def _polygon(scene: Scene) -> Drawn:
    """Return the polygon through the points."""
    return [Figure(SIDES, Shape.LINE, scene.view.at_knots)], ""


POLYGON = Overlay(
    name="polygon",
    text="Polygon of the Points",
    tip="Join the points by straight lines",
    icon="polygon",
    group=Group.POLYGONS,
    rank=80,
    layer=30,
    draw=_polygon,
    legend=lambda _view, _settings: [(SIDES, "Polygon of the points")],
)
