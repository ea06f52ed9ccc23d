"""Drawings painted with Qt: shapes with their styles, points and annotations."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from msgspec.structs import replace
from PySide6.QtCore import QRect, QRectF, QSize, Qt
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
from ...document.group_look import GroupLook
from ...document.style import Style
from ...qt.clips import clipped
from ...qt.gradients import brush_of
from ...qt.strokes import FILL_RULES, overhang_of, pen_of, with_opacity
from ...tasks.progress import Report, told
from .annotation_painting import paint_annotations, paint_points
from .devices import do_any_meet, has_alpha, is_raster
from .drawing import Drawing
from .grouped import units_of
from .outlines import Outline, length_within
from .styles import PictureStyle

_MOST_DASHES = 100_000
"""In a line: Qt makes a line of each, also where nothing is seen of them."""


_PICTURE = QImage.Format.Format_ARGB32_Premultiplied
_SMOOTHLY = QPainter.RenderHint.SmoothPixmapTransform | QPainter.RenderHint.LosslessImageRendering

_MOST_PIXELS = 16_000_000

_GROUP_DPI = 300
"""Dots an inch of a group that is a picture in a PDF."""

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
        for look, run in told(units_of(self._drawing.shapes, 0), report, "Painting"):
            self._paint_unit(look, run, 0)
        paint_annotations(self._painter, self._drawing, self._style, "handles")
        if points:
            paint_points(self._painter, self._drawing, self._style)
        paint_annotations(self._painter, self._drawing, self._style, "basis")

    # Shapes

    def _paint_unit(self, look: GroupLook | None, shapes: Sequence[tuple[Outline, ...]], depth: int) -> None:
        """Paint a shape, or a group that is seen through, as a whole, in so many others."""
        if look is None:
            self._paint_shape(shapes[0])
        elif look.opacity > 0:
            self._paint_group(shapes, look.opacity, depth + 1)

    def _paint_group(self, shapes: Sequence[tuple[Outline, ...]], opacity: float, depth: int) -> None:
        """Paint what is in a group as a picture, which all formats have; what is by itself as such.

        A PDF of Qt's (6.11) has no groups.
        """
        painter = self._painter
        boxes = [self._reach(shape) for shape in shapes]
        if not is_raster(painter) and not do_any_meet(boxes):
            for shape in shapes:
                share = opacity * math.prod(each.opacity for each in shape[0].group_looks[depth:])
                style = replace(shape[0].style, opacity=shape[0].style.opacity * share)
                self._paint_shape(tuple(replace(each, style=style) for each in shape))
            return
        place = QRectF()
        for box in boxes:
            place = place.united(box.intersected(self._frame))
        if place.isEmpty():
            return
        fine = 1.0 if is_raster(painter) else _GROUP_DPI / 72
        place = QRectF(QRectF(place).toAlignedRect())

        def paint(inner: QPainter) -> None:
            within = Painting(self._drawing, inner, self._style)
            for look, run in units_of(shapes, depth):
                within._paint_unit(look, run, depth)

        picture = _beside(painter, place, fine, paint)
        painter.save()
        painter.setOpacity(opacity)
        painter.setRenderHints(_SMOOTHLY)
        painter.drawImage(place, picture)
        painter.restore()

    def _reach(self, shape: tuple[Outline, ...]) -> QRectF:
        """Return a box that a shape does not leave."""
        style = shape[0].style
        pen = self._pen(style, 0.0)
        box = self._path(shape).controlPointRect()
        reach = 1 + (overhang_of(pen) if pen is not None else 0.0)
        return box.adjusted(-reach, -reach, reach, reach)

    def _paint_shape(self, shape: tuple[Outline, ...]) -> None:
        if clips := shape[0].style.clips:
            # Outlines of a shape have one style.
            whole = replace(shape[0], style=replace(shape[0].style, clips=()))
            with clipped(self._painter, clips, self._way):
                self._paint_shape((whole, *shape[1:]))
            return
        style, path = shape[0].style, self._path(shape)
        is_together = style.opacity < 1 and style.has_fill and style.has_stroke
        if is_raster(self._painter) and is_together:
            self._paint_layer(path, replace(style, opacity=1.0), length_within(shape), style.opacity)
            return
        pen = self._pen(style, length_within(shape))
        brush = self._brush(style) if style.has_fill else None
        if is_together and pen is not None:
            self._paint_apart(path, pen, brush)
            return
        self._fill_and_stroke(self._painter, path, pen, brush)

    def _paint_apart(self, path: QPainterPath, pen: QPen, brush: QBrush | QColor | None) -> None:
        """Paint fill and stroke as outlines that do not overlap: both have one opacity."""
        painter, line = self._painter, QPainterPathStroker(pen).createStroke(path)
        if brush is not None:
            self._fill(painter, path.subtracted(line), brush)
        self._fill(painter, line, pen.brush())

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

    def _paint_layer(self, path: QPainterPath, style: Style, length: float, opacity: float) -> None:
        """Paint stroke and fill so that nothing of the fill is seen through the stroke."""
        painter, pen = self._painter, self._pen(style, length)
        place = self._bounds(path, pen or QPen(Qt.PenStyle.NoPen))
        if not place.isEmpty():
            brush = self._brush(style) if style.has_fill else None
            painter.save()
            painter.setOpacity(opacity)
            painter.drawImage(place.topLeft(), self._layer(place, path, pen, brush, style))
            painter.restore()

    def _bounds(self, path: QPainterPath, pen: QPen) -> QRect:
        """Return the pixels of the device that a shape can reach."""
        reach = 1 + overhang_of(pen)
        within = QRectF(0, 0, math.ceil(self._frame.width()), math.ceil(self._height))
        return (
            path.controlPointRect().adjusted(-reach, -reach, reach, reach).intersected(within).toAlignedRect()
        )

    def _layer(
        self,
        place: QRect,
        path: QPainterPath,
        pen: QPen | None,
        brush: QBrush | QColor | None,
        style: Style,
    ) -> QImage:
        """Return a picture of one shape in a part of the device."""
        layer = QImage(place.size(), _PICTURE)
        layer.fill(Qt.GlobalColor.transparent)
        with QPainter(layer) as painter:
            painter.setRenderHints(self._painter.renderHints())
            painter.translate(-place.topLeft())
            self._fill_and_stroke(painter, path, pen, brush)
        return layer

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
        colour = with_opacity(QColor(self._style.stroke_of(style)), style.stroke_opacity * style.opacity)
        is_dashed = length <= _MOST_DASHES * sum(style.dash) * width
        pen = pen_of(style, colour, width, is_dashed=is_dashed)
        if style.stroke_gradient is not None:
            pen.setBrush(self._served(style.stroke_gradient, style.stroke_opacity * style.opacity))
        return pen

    def _brush(self, style: Style) -> QBrush | QColor:
        # A painter's own opacity is nothing to the gradients of a PDF.
        opacity = style.fill_opacity * style.opacity
        if style.fill_gradient is not None:
            return self._served(style.fill_gradient, opacity)
        return with_opacity(QColor(self._style.fill_of(style)), opacity)

    def _served(self, gradient: Gradient, opacity: float) -> QBrush | QColor:
        ink = QColor(self._style.ink)
        return brush_of(gradient, ink, opacity, lambda place: (place[0], self._height - place[1]))


def _beside(painter: QPainter, place: QRectF, fine: float, paint: Callable[[QPainter], None]) -> QImage:
    """Return a picture of a place in the units of a painter, with so many pixels to each or fewer."""
    fine *= min(1.0, math.sqrt(_MOST_PIXELS / (place.width() * place.height() * fine * fine)))
    picture = QImage((place.size() * fine).toSize().expandedTo(QSize(1, 1)), _PICTURE)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as inner:
        inner.setRenderHints(painter.renderHints() | QPainter.RenderHint.Antialiasing)
        inner.scale(picture.width() / place.width(), picture.height() / place.height())
        inner.translate(-place.topLeft())
        paint(inner)
    return picture
