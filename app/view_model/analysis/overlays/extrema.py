"""Inflections, the sharpest and the flattest points of the curve, and its self-intersections."""

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
"""Share of the size within which two points of the curve are one."""

_MORE = " There may be more crossings: the curve runs along itself, or has too many."


def extrema(data: OverlayInput) -> Figures:
    """Return the marks, and their numbers in the note; heavy."""
    curve = data.view.curve
    if curve is None:
        return Figures()
    groups = [(INFLECTION, "inflection", curve.evaluate(curvecore.inflections(curve)))]
    data.report(0.0, "Computing")
    bends = curvecore.curvature_extrema(curve)
    # The largest signed curvature is the sharpest bend to the left, and the flattest to the right.
    is_sharp = bends.is_maximum == (bends.curvatures > 0)
    groups.append((SHARPEST, "sharpest bend", curve.evaluate(bends.parameters[is_sharp])))
    groups.append((FLATTEST, "flattest point", curve.evaluate(bends.parameters[~is_sharp])))
    data.report(0.0, "Computing")
    words = ""
    if data.size > 0:
        crossings = curvecore.self_intersections(curve, _TOLERANCE * data.size)
        groups.append((CROSSING, "crossing", _distinct(crossings.points, 10 * _TOLERANCE * data.size)))
        words = "" if crossings.is_complete else _MORE
    figures = [
        Figure(style, Shape.MARKS, points.reshape(-1, 2)) for style, _, points in groups if np.size(points)
    ]
    counts = [f"{len(points)} {name}{'s' * (len(points) != 1)}" for _, name, points in groups]
    return Figures(figures, f"{', '.join(counts)}.{words}")


def _distinct(points: FloatArray, tolerance: float) -> FloatArray:
    """Return the points without repetitions: where three branches meet, each two cross."""
    distinct = np.empty_like(points)
    count = 0
    for point in points:
        if not count or np.abs(distinct[:count] - point).max(axis=1).min() > tolerance:
            distinct[count] = point
            count += 1
    return distinct[:count]


EXTREMA = Overlay(
    name="marks",
    text="Inflections and Extrema",
    tip="Mark inflections, the sharpest and flattest points, and crossings of the curve with itself",
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
        (FLATTEST, "Flattest point"),
        (CROSSING, "Crossing"),
    ),
)
