"""The osculating circle at the scrub line; a straight line where the curve does not bend."""

from __future__ import annotations

import numpy as np

import curvecore

from ....document.words import with_error
from ...curve.rounded_parameters import curvature_error
from ...geometry import to_the_left, unit_tangents
from ...line_styles import PURPLE, LineStyle
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape, number

LINE = LineStyle(PURPLE, width=1.4)
CENTRE = LineStyle(PURPLE, 0.8)

_REACH = 10.0
"""The part of a large circle that is drawn to either side, in sizes of the curve."""

_STRAIGHT = 1e-6
"""Share of 1 / size below which a curvature counts as none."""

_CORNERS = 240

NO_SCRUB = "Show the scrub line (T), and move it to the position of the circle."
AT_REST = "c′ = 0 here: there is no circle."
NO_BEND = "Straight here: the circle is a line."
UNCERTAIN = "The curve is too slow here, or its parameters are too close, to compute the circle."


def circle(data: OverlayInput) -> Figures:
    """Return the circle with its centre, and its radius in the note."""
    curve, (here, velocity, acceleration) = data.view.curve, (data.at_scrub(order) for order in range(3))
    if here is None or velocity is None or acceleration is None or curve is None or data.scrub is None:
        return Figures(note=NO_SCRUB)
    curvature = float(curvecore.curvature_of(velocity[None], acceleration[None])[0])
    if np.isnan(curvature):
        return Figures(note=AT_REST)
    reach = _REACH * data.size
    tangents = unit_tangents(velocity[None])
    tangent, normal = tangents[0], to_the_left(tangents)[0]
    if abs(curvature) * data.size < _STRAIGHT:
        line = here + np.outer([-reach, reach], tangent)
        return Figures([Figure(LINE, Shape.LINE, line)], NO_BEND)
    error = curvature_error(data.view, np.clip([data.scrub], *curve.domain)).item()
    if not error < abs(curvature):
        return Figures(note=UNCERTAIN)
    radius = 1.0 / abs(curvature)
    # Along the arc from here, so that a huge circle is exact where it touches.
    angle = min(np.pi, reach / radius) * np.linspace(-1.0, 1.0, _CORNERS + 1)
    along, away = radius * np.sin(angle), np.sign(curvature) * 2 * radius * np.sin(angle / 2) ** 2
    arc = here + np.outer(along, tangent) + np.outer(away, normal)
    # The radius for the least curvature within the error.
    words = f"radius {with_error(radius, radius * error / (abs(curvature) - error), number)}"
    figures = [Figure(LINE, Shape.LINE, arc)]
    if radius < reach:
        centre = here + np.sign(curvature) * radius * normal
        figures.append(Figure(CENTRE, Shape.LINE, np.array([here, centre])))
        figures.append(Figure(CENTRE, Shape.MARKS, centre[None], words))
    note = f"{words[0].upper()}{words[1:]}, curvature {with_error(curvature, error, number)}."
    return Figures(figures, note)


CIRCLE = Overlay(
    name="circle",
    text="Osculating Circle",
    tip="Draw the osculating circle of the curve at the scrub line",
    key="Ctrl+Alt+4",
    icon="circle",
    group=Group.SHAPE,
    rank=40,
    layer=60,
    draw=circle,
    follows_scrub=True,
    brings_scrub=True,
)
