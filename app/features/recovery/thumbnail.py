"""A document as a small picture."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from ...appearance.theme import Theme
from ...document.model import Curve, Document
from ...document.style import Style
from ...exchange.drawing.drawing import Drawing, drawing_of
from ...exchange.drawing.painting import Painting
from ...exchange.drawing.styles import PictureStyle
from ...exchange.errors import ExchangeError
from ...tasks.progress import silent

_LINE, _POINT = 1.5, 2.0

_LEAST = 0.3
"""Pixels of a line, at least: a finer one is to scale, but nobody sees it."""

_MARGIN = 3.0

_MOST_NODES = 200
"""Of a larger document every so manieth point is joined by straight lines: its curves would take too long."""


def thumbnail(document: Document, width: int, height: int, theme: Theme, ratio: float = 1.0) -> QImage:
    """Return a picture of `width` × `height` pixels of a window with this device pixel ratio.

    Where nothing can be drawn it is empty paper.
    """
    image = QImage(round(width * ratio), round(height * ratio), QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(ratio)
    image.fill(theme.paper)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    try:
        if sum(len(curve.points) for curve in document.curves) <= _MOST_NODES:
            _paint_curves(painter, drawing_of(document), theme, (width, height))
        else:
            _paint_points(painter, document, QRectF(0, 0, width, height), theme)
    except ExchangeError:
        pass  # a single point, for instance
    finally:
        painter.end()
    return image


def _paint_curves(painter: QPainter, drawing: Drawing, theme: Theme, size: tuple[int, int]) -> None:
    """Paint a drawing with lines as on the canvas, and points."""
    drawing = drawing.fitted(*size)
    usual = (replace(each, style=_with_line(each.style)) for each in drawing.outlines)
    ink = PictureStyle(theme.curve.name(), theme.paper.name(), theme.name)
    Painting(replace(drawing, outlines=tuple(usual)), painter, ink).paint(points=False, report=silent)
    painter.setPen(Qt.PenStyle.NoPen)
    for outline in drawing.outlines:
        painter.setBrush(QColor(ink.seen(outline.colour)))
        for x, y in outline.points.tolist():
            painter.drawEllipse(QPointF(x, drawing.frame.height - y), _POINT, _POINT)


def _with_line(style: Style) -> Style:
    """Return a style whose line, if there is one, can be seen as small as this."""
    width = _LINE if style.width is None else style.width
    return replace(style, width=max(width, _LEAST) if width else 0.0)


def _paint_points(painter: QPainter, document: Document, frame: QRectF, theme: Theme) -> None:
    curves = [curve for curve in document.curves if curve.visible and curve.points]
    if not curves:
        return
    places = np.array([point.position for curve in curves for point in curve.points])
    low = places.min(axis=0)
    size = np.maximum(places.max(axis=0) - low, np.finfo(float).tiny)
    room = frame.adjusted(_MARGIN, _MARGIN, -_MARGIN, -_MARGIN)
    scale = min(room.width() / size[0], room.height() / size[1])
    corner = np.array([room.center().x(), room.center().y()]) - scale * size / 2
    for curve in curves:
        flat = (_thinned(curve, len(places)) - low) * scale
        flat[:, 1] = scale * size[1] - flat[:, 1]
        style = curve.style
        width = _LINE if style.width is None else max(style.width * scale, _LEAST)
        painter.setPen(QPen(QColor(style.colour) if style.colour else theme.curve, width))
        painter.drawPolyline([QPointF(x, y) for x, y in (flat + corner).tolist()])


def _thinned(curve: Curve, total: int) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    step = max(1, total // _MOST_NODES)
    points = [*curve.points[::step], curve.points[-1]]
    return np.array([point.position for point in points])
