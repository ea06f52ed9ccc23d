"""Drawings painted with Qt: shapes with their styles, points and annotations."""

from __future__ import annotations

from collections.abc import Iterable

from msgspec.structs import replace
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QImage,
    QPainter,
    QPainterPath,
    QPainterPathStroker,
    QPen,
    QTransform,
)

from ...document.gradient import Gradient
from ...document.style import Style
from ...qt.clips import clipped
from ...qt.gradients import brush_of
from ...qt.strokes import FILL_RULES, pen_of, with_opacity
from ...tasks.progress import Report, told
from .annotation_painting import paint_annotations, paint_points
from .devices import has_alpha, is_raster
from .drawing import Drawing
from .outlines import Outline, length_within
from .styles import PictureStyle

_MOST_DASHES = 100_000
"""In a line: Qt makes a line of each, also where nothing is seen of them."""


_PICTURE = QImage.Format.Format_ARGB32_Premultiplied
_SMOOTHLY = QPainter.RenderHint.SmoothPixmapTransform | QPainter.RenderHint.LosslessImageRendering

FINEST = 1000
"""Pixels along the longer side of a gradient that goes into a PDF as a picture."""

FINEST_TILES = 4000
"""Those of a pattern, which has edges."""


class Painting:
    """Paints a drawing whose frame is the painter's whole device, from (0, 0) on.

    Parameters
    ----------
    drawing
        Fitted to the device.
    painter
        With nothing set but, perhaps, antialiasing.
    style
        The colours.
    """

    def __init__(self, drawing: Drawing, painter: QPainter, style: PictureStyle) -> None:
        self._drawing, self._painter, self._style = drawing, painter, style
        # Tiles of patterns do not lie on the grid of the pixels.
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        self._height = drawing.frame.height
        self._frame = QRectF(0, 0, drawing.frame.width, drawing.frame.height)
        self._way = QTransform(1, 0, 0, -1, 0, self._height)

    def paint(self, *, points: bool, report: Report) -> None:
        """Paint all of it, from the back to the front."""
        if self._style.paper:
            self._painter.fillRect(self._frame, QColor(self._style.paper))
        paint_annotations(self._painter, self._drawing, self._style, "grid")
        for shape in told(self._drawing.shapes, report, "Painting"):
            self._paint_shape(shape)
        paint_annotations(self._painter, self._drawing, self._style, "handles")
        if points:
            paint_points(self._painter, self._drawing, self._style)
        paint_annotations(self._painter, self._drawing, self._style, "basis")

    # Shapes

    def _paint_shape(self, shape: tuple[Outline, ...]) -> None:
        if clips := shape[0].style.clips:
            # Outlines of a shape have one style.
            whole = replace(shape[0], style=replace(shape[0].style, clips=()))
            with clipped(self._painter, clips, self._way):
                self._paint_shape((whole, *shape[1:]))
            return
        style, path = shape[0].style, self._path(shape)
        pen = self._pen(style, length_within(shape))
        brush = self._brush(style) if style.has_fill else None
        self._fill_and_stroke(self._painter, path, pen, brush)

    def _fill_and_stroke(
        self,
        painter: QPainter,
        path: QPainterPath,
        pen: QPen | None,
        brush: QBrush | QColor | None,
    ) -> None:
        if brush is not None:
            self._fill(painter, path, brush)
        if pen is not None:
            self._stroke(painter, path, pen)

    def _stroke(self, painter: QPainter, path: QPainterPath, pen: QPen) -> None:
        if has_alpha(pen.brush()) and not is_raster(painter):
            self._fill(painter, QPainterPathStroker(pen).createStroke(path), pen.brush())
        else:
            painter.strokePath(path, pen)

    def _fill(self, painter: QPainter, path: QPainterPath, brush: QBrush | QColor) -> None:
        """Fill an area; what a gradient lets through is lost in Qt's PDF files (6.11), of a picture not."""
        if isinstance(brush, QColor) or not has_alpha(brush) or is_raster(painter):
            painter.fillPath(path, brush)
            return
        place = path.boundingRect().intersected(self._frame)
        if place.isEmpty():
            return
        most = FINEST if brush.gradient() is not None else FINEST_TILES
        scale = min(1.0, most / max(place.width(), place.height()))
        picture = QImage((place.size() * scale).toSize().expandedTo(QSize(1, 1)), _PICTURE)
        picture.fill(Qt.GlobalColor.transparent)
        with QPainter(picture) as inner:
            inner.scale(picture.width() / place.width(), picture.height() / place.height())
            inner.translate(-place.topLeft())
            inner.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            inner.fillRect(place, brush)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering)
        painter.setClipPath(path, Qt.ClipOperation.IntersectClip)
        painter.drawImage(place, picture)
        painter.restore()

    def _path(self, shape: Iterable[Outline]) -> QPainterPath:
        path = QPainterPath()
        for outline in shape:
            pieces = (outline.control_points * (1, -1) + (0, self._height)).tolist()
            path.moveTo(*pieces[0][0])
            for _, (bx, by), (cx, cy), (dx, dy) in pieces:
                path.cubicTo(bx, by, cx, cy, dx, dy)
            if outline.closed:
                path.closeSubpath()
            path.setFillRule(FILL_RULES[outline.style.fill_rule])
        return path

    def _pen(self, style: Style, length: float) -> QPen | None:
        width = self._drawing.usual_width if style.width is None else style.width
        # A pen of no width would be one of a pixel.
        if not style.has_stroke or width <= 0:
            return None
        colour = with_opacity(QColor(self._style.stroke_of(style)), style.stroke_opacity)
        is_dashed = length <= _MOST_DASHES * sum(style.dash) * width
        pen = pen_of(style, colour, width, is_dashed=is_dashed)
        if style.stroke_gradient is not None:
            pen.setBrush(self._served(style.stroke_gradient, style.stroke_opacity))
        return pen

    def _brush(self, style: Style) -> QBrush | QColor:
        if style.fill_gradient is not None:
            return self._served(style.fill_gradient, style.fill_opacity)
        return with_opacity(QColor(self._style.fill_of(style)), style.fill_opacity)

    def _served(self, gradient: Gradient, opacity: float) -> QBrush | QColor:
        ink = QColor(self._style.ink)
        return brush_of(gradient, ink, opacity, lambda place: (place[0], self._height - place[1]))
