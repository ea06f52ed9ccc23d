"""Inflections, the sharpest and the flattest places of the curve, and its crossings with itself."""

from __future__ import annotations

import numpy as np

import curvecore
from curvecore.arrays import FloatArray

from ...line_styles import (
    GREEN,
    PURPLE,
    SKY,
    VERMILLION,
    LineStyle,
    Mark,
    Sign,
)
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape

INFLECTION = LineStyle(SKY, width=1.8, mark=Mark.RING, sign=Sign.MARK)
SHARPEST = LineStyle(VERMILLION, width=1.4, mark=Mark.DIAMOND, sign=Sign.MARK)
FLATTEST = LineStyle(GREEN, width=1.6, mark=Mark.SQUARE, sign=Sign.MARK)
CROSSING = LineStyle(PURPLE, width=2.0, mark=Mark.CROSS, sign=Sign.MARK)

_TOLERANCE = 1e-6
"""Share of the size within which two places of the curve are one."""

_MORE = " There may be more crossings: it runs along itself, or has too many."


def extrema(shown: OverlayInput) -> Figures:
    """Return the marks and how many there are, in words; heavy."""
    curve = shown.view.curve
    if curve is None:
        return Figures()
    found = [(INFLECTION, "inflection", curve.evaluate(curvecore.inflections(curve)))]
    shown.report(0.0, "Computing")
    bends = curvecore.curvature_extrema(curve)
    # The largest signed curvature is the sharpest bend to the left, and the flattest to the right.
    is_sharp = bends.is_maximum == (bends.curvatures > 0)
    found.append((SHARPEST, "sharpest bend", curve.evaluate(bends.parameters[is_sharp])))
    found.append((FLATTEST, "flattest place", curve.evaluate(bends.parameters[~is_sharp])))
    shown.report(0.0, "Computing")
    words = ""
    if shown.size > 0:
        crossings = curvecore.self_intersections(curve, _TOLERANCE * shown.size)
        found.append((CROSSING, "crossing", _distinct(crossings.points, 10 * _TOLERANCE * shown.size)))
        words = "" if crossings.is_complete else _MORE
    figures = [
        Figure(style, Shape.MARKS, points.reshape(-1, 2)) for style, _, points in found if np.size(points)
    ]
    counts = [f"{len(points)} {name}{'s' * (len(points) != 1)}" for _, name, points in found]
    return Figures(figures, f"{', '.join(counts)}.{words}")


def _distinct(points: FloatArray, tolerance: float) -> FloatArray:
    """Leave out points at the place of an earlier one: of three branches, each two cross there."""
    kept = np.empty_like(points)
    count = 0
    for point in points:
        if not count or np.abs(kept[:count] - point).max(axis=1).min() > tolerance:
            kept[count] = point
            count += 1
    return kept[:count]


EXTREMA = Overlay(
    name="marks",
    text="Inflections and Extrema",
    tip="Mark inflections, the sharpest and flattest places, and crossings of the curve with itself",
    key="Ctrl+Alt+6",
    icon="marks",
    group=Group.SHAPE,
    rank=60,
    layer=90,
    draw=extrema,
    settles=lambda _view: True,
    finds=(
        (INFLECTION, "Inflection"),
        (SHARPEST, "Sharpest bend"),
        (FLATTEST, "Flattest place"),
        (CROSSING, "Crossing"),
    ),
)
