"""Shapes larger or smaller by a distance, and strokes as shapes of their own.

Corners and ends are those that the style says; outlines are followed within a share of the size of the
drawing, which is told.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore.arrays import FloatArray

from ...document.contents import refuse_contents
from ...document.edits import EditError
from ...document.model import Curve, Document
from ...document.style import LEAST_DASH, NO_PAINT, LineJoin, Style
from ...tasks.progress import Report, part, silent
from ..curve.curve_view import CurveView
from .regions import (
    Combined,
    Names,
    chosen_shapes,
    computed,
    curves_of,
    name_of_shape,
    outlines_of,
    regions_of,
    replaced,
    size_of,
    taken_names,
)

if TYPE_CHECKING:
    from curvecore import Region

_FOLLOWED = 1e-4
"""Share of a shape's size within which its outline is followed."""


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
        found = computed(
            partial(
                curvecore.offset,
                region,
                distance,
                tolerance=tolerance,
                join=curvecore.StrokeJoin(_corners(model.style).value),
                miter_limit=model.style.miter_limit,
                progress=_heard(told, "Offset"),
            )
        )
        name = name_of_shape(document, places)
        if not found.contours:
            raise EditError(f"Nothing would be left of “{name}”: it is narrower than that.")
        made[places] = curves_of(found, model, name, tolerance)
        off = max(off, deviation + tolerance)
    return Combined(*replaced(document, made), len(chosen), off)


def strokes_as_shapes(
    document: Document,
    views: Sequence[CurveView],
    curves: Collection[int],
    usual: float,
    report: Report = silent,
) -> Combined:
    """Return the document with the strokes of shapes as shapes in front of their fills, if they have any.

    `usual` is the width of lines whose styles say none. Each dash is a contour of the shape.

    Raises
    ------
    EditError
        If one has no line, or more dashes than can be.
    """
    made, off, chosen = dict[range, list[Curve]](), 0.0, chosen_shapes(document, curves)
    taken = taken_names(document)
    for number, places in enumerate(chosen):
        told = part(report, number / len(chosen), (number + 1) / len(chosen))
        own, name = document.curves[places.start : places.stop], name_of_shape(document, places)
        width = _width_of_line(own, name, usual)
        outlines, deviation = outlines_of([views[place] for place in places])
        tolerance = min(_tolerance([views[place] for place in places]), width / 100.0)
        found = computed(partial(_stroked, own, outlines, width, tolerance, _heard(told, "Stroke")))
        names, filled, style = Names(name, taken), list[Curve](), own[0].style
        if style.has_fill:
            filled = [replace(curve, style=replace(style, stroke=NO_PAINT)) for curve in own]
            names.next()
        lines = curves_of(found, replace(own[0], style=_as_fill(style)), names.next(), tolerance)
        made[places] = [*filled, *lines]
        off = max(off, deviation + tolerance)
    return Combined(*replaced(document, made), len(chosen), off)


def _width_of_line(curves: Sequence[Curve], name: str, usual: float) -> float:
    """Return the width of the line of a shape; raise `EditError` where nothing of it is seen."""
    refuse_contents(curves)
    style = curves[0].style
    if not style.has_stroke:
        raise EditError(f"“{name}” has no line.")
    width = usual if style.width is None else style.width
    if not width:
        raise EditError(f"The line of “{name}” has no width.")
    return width


def _corners(style: Style) -> LineJoin:
    """Return the corners of larger shapes: those of the line, or pointed ones where there is none."""
    return style.join if style.has_stroke else LineJoin.MITER


def _as_fill(style: Style) -> Style:
    """Return the style of a shape that is painted as the line of this one."""
    return Style(
        stroke=NO_PAINT,
        fill=style.stroke,
        fill_gradient=style.stroke_gradient,
        fill_opacity=style.stroke_opacity,
        opacity=style.opacity,
        clips=style.clips,
    )


def _stroked(
    curves: Sequence[Curve],
    outlines: Sequence[FloatArray],
    width: float,
    tolerance: float,
    progress: Callable[[float], object],
) -> Region:
    """Return what the line of a shape covers, whole or in dashes."""
    style, lines, closed = curves[0].style, list(outlines), [curve.is_closed for curve in curves]
    if style.dash:
        lengths = np.maximum(style.dashes_and_gaps, LEAST_DASH) * width
        start = style.dash_offset * width
        lines = [
            dash
            for line, is_closed in zip(outlines, closed, strict=True)
            for dash in curvecore.dashed(line, lengths, start=start, closed=is_closed)
        ]
        closed = []
    return curvecore.stroked(
        lines,
        width,
        tolerance=tolerance,
        join=curvecore.StrokeJoin(style.join.value),
        cap=curvecore.StrokeCap(style.cap.value),
        miter_limit=style.miter_limit,
        closed=closed,
        progress=progress,
    )


def _heard(report: Report, word: str) -> Callable[[float], object]:
    return lambda share: report(share, word)


def _tolerance(views: Sequence[CurveView]) -> float:
    return max(_FOLLOWED * size_of(views), 1e-300)
