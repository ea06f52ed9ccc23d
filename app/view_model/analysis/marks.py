"""Where the curve bends otherwise, bends most, bends least, and crosses itself."""

from __future__ import annotations

import numpy as np

from app.tasks.progress import Report
from app.view_model.analysis.figures import Figure, Floats, Shape, Style
from app.view_model.analysis.scene import Scene
from curvecore import curvature_extrema, inflections, self_intersections

_TOLERANCE = 1e-6
"""Share of the size within which two places of the curve are one."""

NAMES = {
    Style.INFLECTION: ("inflection", "inflections"),
    Style.SHARPEST: ("sharpest bend", "sharpest bends"),
    Style.FLATTEST: ("flattest place", "flattest places"),
    Style.CROSSING: ("crossing", "crossings"),
}


def marks(scene: Scene, report: Report) -> tuple[list[Figure], str]:
    """Return the marks and how many there are, in words; heavy."""
    curve = scene.view.curve
    if curve is None:
        return [], ""
    places: dict[Style, Floats] = {Style.INFLECTION: curve.evaluate(inflections(curve))}
    report(0.0, "Computing")
    bends = curvature_extrema(curve)
    # The largest signed curvature is the sharpest bend to the left, and the flattest to the right.
    is_sharp = bends.is_maximum == (bends.curvatures > 0)
    places[Style.SHARPEST] = curve.evaluate(bends.parameters[is_sharp])
    places[Style.FLATTEST] = curve.evaluate(bends.parameters[~is_sharp])
    report(0.0, "Computing")
    complete = True
    if scene.size > 0:
        crossings = self_intersections(curve, _TOLERANCE * scene.size)
        places[Style.CROSSING] = _distinct(crossings.points, 10 * _TOLERANCE * scene.size)
        complete = crossings.is_complete
    figures = [
        Figure(style, Shape.MARKS, points.reshape(-1, 2))
        for style, points in places.items()
        if np.size(points)
    ]
    return figures, _words(places, complete=complete)


def _distinct(points: Floats, tolerance: float) -> Floats:
    """Leave out points at the place of an earlier one: of three branches, each two cross there."""
    kept = np.empty_like(points)
    count = 0
    for point in points:
        if not count or np.abs(kept[:count] - point).max(axis=1).min() > tolerance:
            kept[count] = point
            count += 1
    return kept[:count]


def _words(places: dict[Style, Floats], *, complete: bool) -> str:
    counts = [f"{len(found)} {NAMES[style][len(found) != 1]}" for style, found in places.items()]
    text = ", ".join(counts) + "."
    return text if complete else f"{text} There may be more crossings: it runs along itself, or has too many."
