"""Shapes larger or smaller by a distance, and strokes as shapes of their own.

Corners and ends are those that the style says; outlines are followed within a share of the size of the
drawing, which is told.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import partial

import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore import CurveError, Region, StrokeCap, StrokeJoin

from ..document.edits import EditError
from ..document.model import Curve, Document
from ..document.style import NO_PAINT, LineCap, LineJoin, Style
from ..tasks.progress import Report, part, silent
from .curve_view import CurveView
from .regions import (
    Combined,
    Names,
    chosen_shapes,
    curves_of,
    name_of_shape,
    outlines_of,
    regions_of,
    replaced,
    taken_names,
)

_FOLLOWED = 1e-4
"""Share of a shape's size within which its outline is followed."""

_JOINS = {
    LineJoin.MITER: StrokeJoin.MITER,
    LineJoin.ROUND: StrokeJoin.ROUND,
    LineJoin.BEVEL: StrokeJoin.BEVEL,
}
_CAPS = {LineCap.BUTT: StrokeCap.BUTT, LineCap.ROUND: StrokeCap.ROUND, LineCap.SQUARE: StrokeCap.SQUARE}


def offset_by(
    document: Document,
    views: Sequence[CurveView],
    curves: Collection[int],
    distance: float,
    report: Report = silent,
) -> Combined:
    """Return the document with the shapes of some curves larger by a distance, or smaller if it is negative.

    Raises
    ------
    EditError
        If one has no outline, or if nothing would be left of one.
    """
    made, off, chosen = dict[range, list[Curve]](), 0.0, chosen_shapes(document, curves)
    for number, places in enumerate(chosen):
        told = part(report, number / len(chosen), (number + 1) / len(chosen))
        model = document.curves[places.start]
        (region,), deviation = regions_of(document, views, [places])
        tolerance = _tolerance([views[place] for place in places])
        found = _computed(
            partial(
                curvecore.offset,
                region,
                distance,
                tolerance=tolerance,
                join=_corners(model.style),
                miter_limit=model.style.miter_limit,
                progress=_heard(told, "Offset"),
            )
        )
        name = name_of_shape(document, places)
        if not found.contours:
            raise EditError(f"Nothing would be left of “{name}”: it is narrower than that.")
        made[places] = curves_of(found, model, name)
        off = max(off, deviation + tolerance)
    return Combined(*replaced(document, made), len(chosen), off)


def strokes_as_shapes(
    document: Document, views: Sequence[CurveView], curves: Collection[int], report: Report = silent
) -> Combined:
    """Return the document with the strokes of shapes as shapes in front of their fills, if they have any.

    Raises
    ------
    EditError
        If one has no line, dashes, or a line whose width follows the zoom.
    """
    made, off, chosen = dict[range, list[Curve]](), 0.0, chosen_shapes(document, curves)
    taken = taken_names(document)
    for number, places in enumerate(chosen):
        told = part(report, number / len(chosen), (number + 1) / len(chosen))
        own, name = document.curves[places.start : places.stop], name_of_shape(document, places)
        style = own[0].style
        width = _width(name, style)
        lines, deviation = outlines_of([views[place] for place in places])
        tolerance = min(_tolerance([views[place] for place in places]), width / 100.0)
        found = _computed(
            partial(
                curvecore.stroked,
                lines,
                width,
                tolerance=tolerance,
                join=_JOINS[style.join],
                cap=_CAPS[style.cap],
                miter_limit=style.miter_limit,
                closed=[curve.is_closed for curve in own],
                progress=_heard(told, "Stroke"),
            )
        )
        painted = Style(
            stroke=NO_PAINT, fill=style.stroke, fill_opacity=style.stroke_opacity, opacity=style.opacity
        )
        names = Names(name, taken)
        if style.has_fill:
            filled = [replace(curve, style=replace(style, stroke=NO_PAINT)) for curve in own]
            names.next()
        else:
            filled = []
        made[places] = [*filled, *curves_of(found, replace(own[0], style=painted), names.next())]
        off = max(off, deviation + tolerance)
    return Combined(*replaced(document, made), len(chosen), off)


def _corners(style: Style) -> StrokeJoin:
    """Return the corners of larger shapes: those of the line, or pointed ones where there is none."""
    return _JOINS[style.join] if style.has_stroke else StrokeJoin.MITER


def _width(name: str, style: Style) -> float:
    if not style.has_stroke:
        raise EditError(f"“{name}” has no line.")
    if style.dash:
        raise EditError(f"“{name}” has dashes; a shape is made of whole lines only.")
    if not style.width:
        raise EditError(f"The line of “{name}” is as wide at every zoom; give it a width first.")
    return style.width


def _heard(report: Report, word: str) -> Callable[[float], object]:
    return lambda share: report(share, word)


def _tolerance(views: Sequence[CurveView]) -> float:
    points = np.concatenate([view.points for view in views])
    return max(_FOLLOWED * float(np.ptp(points, axis=0).max()), 1e-300)


def _computed(compute: partial[Region]) -> Region:
    try:
        return compute()
    except CurveError as problem:
        raise EditError(f"This could not be computed: {problem}.") from problem
