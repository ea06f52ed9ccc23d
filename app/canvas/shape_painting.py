"""Painting of curves: lines exact enough for the zoom, and shapes in their styles with fills and dashes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen

from curvecore.arrays import FloatArray

from ..appearance.colours import curve_colour, fill_colour
from ..appearance.theme import Theme
from ..document.style import NO_PAINT, PLAIN_STYLE, LineCap, LineJoin, Style
from ..plotting.drawing import MARGIN, Stroke, cut_segments, polygon, ring_within, runs_of
from ..plotting.pixel_map import PixelMap
from ..plotting.wide_line import RoundLine
from ..qt.strokes import FILL_RULES, dot_at, overhang_of, pen_of, with_opacity
from ..view_model.curve.curve_view import CurveView, Polyline

TOLERANCE = 0.1
"""Largest distance between the curve and its drawn polyline, in pixels; a quarter shows as corners."""

_WIDE = 8.0
"""Line width in pixels above which the edges show corners that the middle does not."""

_MOST_FINER = 8.0

Shape = tuple[CurveView, ...]
"""The curves of a shape, in order."""


def is_plain(view: CurveView) -> bool:
    """Whether a curve is a line of the same width at every zoom: its style is no more than a colour."""
    style = view.source.style
    return style is PLAIN_STYLE or (
        style.width is None
        and style.fill == NO_PAINT
        and style.stroke != NO_PAINT
        and not style.dash
        and style.cap is LineCap.ROUND
        and style.join is LineJoin.ROUND
        and style.stroke_opacity == 1.0
    )


def line_of(view: CurveView, pixel_map: PixelMap, style: Style | None = None) -> Polyline:
    """Return a curve as a polyline of the plane, exact enough for the width of its line, or of a `style`."""
    scale = max(pixel_map.sx, pixel_map.sy)
    width = (style or view.source.style).width or 0.0
    if width * scale <= _WIDE:
        return view.flattened(TOLERANCE / scale, pixel_map.box)
    # The edge of a wide line turns with a larger radius than its middle.
    finer = min(width * scale / _WIDE, _MOST_FINER)
    left, low, right, high = pixel_map.box
    box = (left - width, low - width, right + width, high + width)
    return view.flattened(TOLERANCE / finer / scale, box)


def line_width(style: Style, pixel_map: PixelMap, usual: float) -> float:
    """Return the width in pixels of a line in its style: 0 without a stroke, `usual` without a width."""
    if not style.has_stroke:
        return 0.0
    return usual if style.width is None else style.width * pixel_map.sx


_NARROW = 4.0
"""Line width in pixels up to which the line is cut at the usual margin."""

_FINE = (1.0, 8.0)
"""Range of widths in pixels for which `RoundLine` replaces Qt's slow stroker."""

_WIDEST = 1e7
"""Pixels of the widest pen that Qt is given: it covers every screen."""

_SHORTEST_DASHES = 0.5
"""Length in pixels of a dash pattern below which dashes merge into a paler line."""

_FARTHEST_DASH = 20_000.0
"""Pixels from the area at which a dashed line is cut: dashes are counted up to there."""


class _Part(NamedTuple):
    """One curve of a shape as a polyline, (k, 2) in the plane; a closed one ends where it begins."""

    points: FloatArray
    is_closed: bool

    @property
    def is_dot(self) -> bool:
        """Whether the polyline has no length."""
        return bool((self.points[0] == self.points[-1]).all() and (self.points == self.points[0]).all())


def paint_shape(
    painter: QPainter,
    shape: Sequence[CurveView],
    pixel_map: PixelMap,
    theme: Theme,
    usual: float,
    line: RoundLine,
) -> None:
    """Paint the fill and the line of a shape in its style.

    Parameters
    ----------
    usual
        Width in pixels of a line whose style has no width.
    line
        Draws fine lines; one serves for many shapes.
    """
    style = shape[0].source.style
    curves = (view for view in shape if view.has_curve)
    parts = [_Part(line_of(view, pixel_map, style).points, view.source.is_closed) for view in curves]
    if style.has_fill:
        area = _area(parts, pixel_map)
        area.setFillRule(FILL_RULES[style.fill_rule])
        painter.fillPath(area, with_opacity(fill_colour(style.fill, theme), style.fill_opacity))
    if (width := line_width(style, pixel_map, usual)) > 0:
        pen = _pen(style, curve_colour(style.stroke, theme), min(width, _WIDEST))
        _stroke(painter, [part for part in parts if not part.is_dot], style, pen, pixel_map, line)
        _paint_dots(painter, [part for part in parts if part.is_dot], style, pen, pixel_map)


def _area(parts: Sequence[_Part], pixel_map: PixelMap) -> QPainterPath:
    """Return the inside of a shape, cut to the visible area."""
    area = QPainterPath()
    for part in parts:
        ring = ring_within(pixel_map.points(part.points), pixel_map.width, pixel_map.height, MARGIN)
        if len(ring) > 2:
            area.addPolygon(polygon(ring[:, 0], ring[:, 1]))
            area.closeSubpath()
    return area


def _paint_dots(
    painter: QPainter, parts: Sequence[_Part], style: Style, pen: QPen, pixel_map: PixelMap
) -> None:
    reach = MARGIN + pen.widthF()
    for part in parts:
        x, y = pixel_map.points(part.points[:1])[0].tolist()
        if -reach <= x <= pixel_map.width + reach and -reach <= y <= pixel_map.height + reach:
            painter.fillPath(dot_at(x, y, style, pen.widthF()), pen.color())


def _stroke(
    painter: QPainter, parts: Sequence[_Part], style: Style, pen: QPen, pixel_map: PixelMap, line: RoundLine
) -> None:
    width, is_opaque = pen.widthF(), pen.color().alphaF() == 1.0
    reach = MARGIN + (overhang_of(pen) if width > _NARROW else 0.0)
    if pen.dashPattern():
        _stroke_dashed(painter, parts, pen, style.dash_offset, pixel_map, reach)
    elif is_opaque and style.cap is LineCap.ROUND and style.join is LineJoin.ROUND:
        painter.setPen(pen)
        minimum, maximum = _FINE
        for part in parts:
            if minimum < width <= maximum:
                line.show(part.points, pixel_map, width)
                line.draw(painter)
                continue
            stroke = Stroke(reach)
            stroke.fill(pixel_map.points(part.points), pixel_map.width, pixel_map.height)
            stroke.draw(painter)
    else:
        painter.strokePath(_line(parts, pixel_map, reach), pen)


def _line(parts: Sequence[_Part], pixel_map: PixelMap, reach: float) -> QPainterPath:
    """Return the line of a shape, cut to the visible area."""
    path = QPainterPath()
    for part in parts:
        _add_line(path, part, pixel_map, reach)
    return path


def _pen(style: Style, colour: QColor, width: float) -> QPen:
    """Return the pen of a line; dashes too short to be seen become a paler line."""
    opacity = style.stroke_opacity
    is_dashed = sum(style.dash) * width >= _SHORTEST_DASHES
    if style.dash and not is_dashed:
        opacity *= sum(style.dashes_and_gaps[::2]) / sum(style.dashes_and_gaps)
    return pen_of(style, with_opacity(colour, opacity), width, is_dashed=is_dashed)


def _add_line(line: QPainterPath, part: _Part, pixel_map: PixelMap, reach: float) -> None:
    """Add a polyline to a path, cut to the visible area; a closed one that lies inside has no ends."""
    pixels = pixel_map.points(part.points)
    runs = list(_runs(pixels, pixel_map, reach))
    is_whole = len(runs) == 1 and len(runs[0]) == len(pixels)
    if part.is_closed and not is_whole and len(runs) > 1 and (runs[-1][-1] == runs[0][0]).all():
        runs[0] = np.concatenate([runs.pop()[:-1], runs[0]])
    for run in runs:
        line.addPolygon(polygon(run[:, 0], run[:, 1]))
        if part.is_closed and is_whole:
            line.closeSubpath()


def _runs(pixels: FloatArray, pixel_map: PixelMap, reach: float) -> Iterator[FloatArray]:
    segments = np.hstack([pixels[:-1], pixels[1:]])
    yield from runs_of(cut_segments(segments, pixel_map.width, pixel_map.height, reach))


def _stroke_dashed(
    painter: QPainter, parts: Sequence[_Part], pen: QPen, offset: float, pixel_map: PixelMap, reach: float
) -> None:
    """Stroke with dashes counted from the start of each polyline, however little of it is visible."""
    for part in parts:
        pixels = np.clip(pixel_map.points(part.points), -1e15, 1e15)
        lengths = np.hypot(*np.diff(pixels, axis=0).T)
        starts = np.concatenate([[0.0], np.cumsum(lengths)])
        for first, end in _stretches(pixels, pixel_map, reach + _FARTHEST_DASH):
            pen.setDashOffset(offset + float(starts[first]) / pen.widthF())
            line, run = QPainterPath(), pixels[first:end]
            line.addPolygon(polygon(run[:, 0], run[:, 1]))
            painter.strokePath(line, pen)


def _stretches(pixels: FloatArray, pixel_map: PixelMap, reach: float) -> Iterator[tuple[int, int]]:
    """Yield the ranges (first, end) of consecutive vertices whose segments are near the area."""
    low, high = np.minimum(pixels[:-1], pixels[1:]), np.maximum(pixels[:-1], pixels[1:])
    is_near = ((high >= -reach) & (low <= (pixel_map.width + reach, pixel_map.height + reach))).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], is_near, [False]]).astype(np.int8)))
    for first, last in edges.reshape(-1, 2).tolist():
        yield first, last + 1
