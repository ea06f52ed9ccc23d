"""Marks of a gesture over the drawing: rubber band, box with grips, snaps, a ruler, amounts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF, QTransform

from ..document.model import Vector
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.text import Halo, Surroundings, beyond, free_corner, size_of, write_on_plate
from ..tools.box import Grip, TransformBox, TransformKind
from ..tools.marks import Marks, Note, Ruler
from ..tools.snapping import Snap
from .other_curves_layer import BESIDE

_NOTHING = Marks()

_GRIP, _FAR = 3.5, 1e6
_SLANT = 0.8
"""Slant of the grips that skew, relative to their height."""

_CASING = 3.0
"""Width in pixels of the paper below a line over a drawing."""

_PIVOT_ARM = 6.5
"""Pixels from the pivot to the ends of its cross."""

_CROSS_ARM = 9
"""Length of the arms of the cross at a snap target, in pixels."""

_GRID_LINE, _NUMBER_ENDS = 60, 27
"""Half the length of a drawn piece of a grid line, and the reach of the number of a point, in pixels."""

_LABEL_GAP = (8.0, 7.0)
"""Pixels between a point and the label of its snap target."""

_READOUT_GAP = 18.0
"""Pixels between a readout and its position: a selected point with its ring, or a grip, stays free."""


class MarksLayer(Layer):
    """Layer of `Marks`, on top of everything.

    Attributes
    ----------
    marks
        The marks that are drawn.
    readout_rect, snap_label_rect
        Boxes of the last readout of a gesture, and of the last snap label, in pixels of the area.
    """

    z = 20.0

    def __init__(self, plot: PlotWidget, surroundings_of: Callable[[Vector], Surroundings]) -> None:
        super().__init__(plot)
        self.marks = _NOTHING
        # Returns the lines and numbers that a label beside a pixel should not cover.
        self._surroundings_of = surroundings_of
        self.readout_rect = self.snap_label_rect = QRectF()
        self._halo = Halo()
        self.set_visible(False)

    def render(self, marks: Marks) -> None:
        """Draw `marks` from the next paint on."""
        if marks != self.marks:
            self.marks = marks
            self.set_visible(marks != _NOTHING)
            self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the marks that are set."""
        marks = self.marks
        painter.setFont(self.fonts.times(0.95 * self.scale))
        if marks.box is not None:
            self._paint_box(painter, pixel_map, marks.box, has_grips=True)
        if marks.frame is not None:
            self._paint_box(painter, pixel_map, marks.frame, has_grips=False)
        if marks.pivot is not None and (marks.pivot_box is None or marks.pivot_box.is_roomy(pixel_map.sx)):
            self._paint_pivot(painter, *pixel_map.point(*marks.pivot))
        if marks.band is not None:
            self._paint_band(painter, pixel_map, *marks.band)
        if marks.axis is not None:
            self._paint_axis(painter, pixel_map, *marks.axis)
        if marks.ruler is not None:
            self._paint_ruler(painter, pixel_map, marks.ruler)
        if marks.snap is not None:
            self._paint_snap(painter, pixel_map, marks.snap)
        if marks.spot is not None:
            self._paint_spot(painter, *pixel_map.point(*marks.spot))
        if marks.note is not None:
            self._paint_note(painter, pixel_map, marks.note)

    def _pen(self, width: float = 1.0, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
        return QPen(self.theme.accent, width * self.scale, style)

    # Box and band

    def _paint_box(
        self, painter: QPainter, pixel_map: PixelMap, box: TransformBox, *, has_grips: bool
    ) -> None:
        frame = _rectangle(pixel_map, box.low, box.high)
        if not _is_drawable(frame.left(), frame.top(), frame.right(), frame.bottom()):
            return
        if box.is_whole:
            # Beside a straight stroke, and not on it, so that its colour stays visible.
            beside = BESIDE * self.scale
            frame = QRectF(frame.adjusted(-beside, -beside, beside, beside).toRect())
        painter.setBrush(Qt.BrushStyle.NoBrush)
        # On whole pixels, where dashes are sharp.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        # Paper between the dashes, no wider than these: visible on any colour, covering little.
        for pen in (QPen(self.theme.paper, self.scale), self._pen(style=Qt.PenStyle.DashLine)):
            painter.setPen(pen)
            painter.drawRect(frame)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        positions = box.grips(pixel_map.sx) if has_grips else ()
        grips = [(grip, QPointF(*pixel_map.point(*position))) for grip, position in positions]
        for grip, pixel in grips:
            if grip.does is TransformKind.ROTATE and not box.turns:
                # Below the grips, because the line passes one of them.
                for pen in (QPen(self.theme.paper, _CASING * self.scale), self._pen(1.2)):
                    painter.setPen(pen)
                    painter.drawLine(QPointF(pixel.x(), frame.top()), pixel)
        for grip, pixel in grips:
            self._paint_grip(painter, pixel, grip)

    def _paint_grip(self, painter: QPainter, pixel: QPointF, grip: Grip) -> None:
        size = _GRIP * self.scale
        painter.setPen(self._pen(1.2))
        painter.setBrush(self.theme.paper)
        square = QRectF(pixel.x() - size, pixel.y() - size, 2 * size, 2 * size)
        if grip.does is TransformKind.ROTATE:
            painter.drawEllipse(square.adjusted(-0.5, -0.5, 0.5, 0.5))
        elif grip.does is TransformKind.SKEW:
            # The square of the other grips, skewed.
            slant = QTransform().shear(-_SLANT, 0.0) if grip.y else QTransform().shear(0.0, -_SLANT)
            corners = QPolygonF(square.translated(-pixel))
            painter.drawPolygon(slant.map(corners).translated(pixel))
        else:
            painter.drawRect(square)

    def _paint_pivot(self, painter: QPainter, x: float, y: float) -> None:
        """Draw a cross in a ring, with paper below its lines because it often lies on a curve."""
        if not _is_drawable(x, y):
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        centre, arm = QPointF(x, y), _PIVOT_ARM * self.scale
        for pen in (QPen(self.theme.paper, 3.5 * self.scale), self._pen(1.2)):
            painter.setPen(pen)
            painter.drawEllipse(centre, 0.6 * arm, 0.6 * arm)
            painter.drawLine(centre - QPointF(arm, 0), centre + QPointF(arm, 0))
            painter.drawLine(centre - QPointF(0, arm), centre + QPointF(0, arm))

    def _paint_band(self, painter: QPainter, pixel_map: PixelMap, start: Vector, end: Vector) -> None:
        fill = QColor(self.theme.accent)
        fill.setAlphaF(0.10)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(self._pen())
        painter.setBrush(fill)
        edge = QRectF(-20, -20, pixel_map.width + 40, pixel_map.height + 40)
        painter.drawRect(_rectangle(pixel_map, start, end).intersected(edge))

    # Snapping, axis and ruler

    def _paint_axis(self, painter: QPainter, pixel_map: PixelMap, through: Vector, along: Vector) -> None:
        pixel = pixel_map.point(*through)
        direction = QPointF(along[0], -along[1]) / (math.hypot(*along) or 1.0)
        if not _is_drawable(*pixel):
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, all(along))
        painter.setPen(self._pen(style=Qt.PenStyle.DotLine))
        reach = direction * (math.dist(pixel, (0.0, 0.0)) + pixel_map.width + pixel_map.height)
        painter.drawLine(QPointF(*pixel) - reach, QPointF(*pixel) + reach)

    def _paint_snap(self, painter: QPainter, pixel_map: PixelMap, snap: Snap) -> None:
        target = pixel_map.point(*snap.position)
        if not _is_drawable(*target):
            return
        pixel = QPointF(*target)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(self._pen(style=Qt.PenStyle.DashLine))
        for guide in snap.guides:
            guide_pixel = pixel_map.point(*guide)
            if _is_drawable(*guide_pixel):
                painter.drawLine(QPointF(*guide_pixel), pixel)
        surroundings = self._surroundings_of(target)
        # A snapped x is shown by a piece of a vertical line, a snapped y by a horizontal one.
        for axis in snap.axes:
            along = QPointF(0, self.scale) if axis == 0 else QPointF(self.scale, 0)
            if axis == snap.grid_line:
                self._paint_grid_line(painter, pixel, along, surroundings.labels)
            else:
                painter.setPen(self._pen(1.5))
                painter.drawLine(pixel - along * _CROSS_ARM, pixel + along * _CROSS_ARM)
        self._paint_label(painter, pixel_map, pixel, snap.label, surroundings)

    def _paint_grid_line(
        self, painter: QPainter, pixel: QPointF, along: QPointF, labels: Sequence[QRectF]
    ) -> None:
        """Draw a piece of a line of the grid, long and dashed: a short one would look like a crossing."""
        painter.setPen(self._pen(style=Qt.PenStyle.DashLine))
        for direction in (along, -along):
            near = QRectF(pixel, pixel + direction * _NUMBER_ENDS).normalized().adjusted(-1, -1, 1, 1)
            has_number = any(near.intersects(label) for label in labels)
            painter.drawLine(
                pixel + direction * (_NUMBER_ENDS if has_number else 0), pixel + direction * _GRID_LINE
            )

    def _paint_ruler(self, painter: QPainter, pixel_map: PixelMap, ruler: Ruler) -> None:
        start, end = pixel_map.point(*ruler.start), pixel_map.point(*ruler.end)
        if not _is_drawable(*start, *end):
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        corner = QPointF(end[0], start[1])
        painter.setPen(self._pen(style=Qt.PenStyle.DotLine))
        painter.drawPolyline([QPointF(*start), corner, QPointF(*end)])
        painter.setPen(self._pen(1.5))
        painter.drawLine(QPointF(*start), QPointF(*end))
        for pixel in (start, end):
            painter.drawEllipse(QPointF(*pixel), 2.5 * self.scale, 2.5 * self.scale)
        dx, dy = end[0] - start[0], end[1] - start[1]
        # On the side away from the right angle, clear of the points at the ends.
        offset = QPointF(abs(dy) * (-1 if dx >= 0 else 1), abs(dx) * (-1 if dy <= 0 else 1))
        middle = QPointF((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        self._write_beyond(painter, pixel_map, middle, (offset, -offset), ruler.text)

    def _paint_spot(self, painter: QPainter, x: float, y: float) -> None:
        """Draw a ring where the pen would insert a point, or over the ring of another curve's point."""
        if _is_drawable(x, y):
            painter.setBrush(self.theme.paper)
            painter.setPen(self._pen(1.5))
            painter.drawEllipse(QPointF(x, y), 4 * self.scale, 4 * self.scale)
            painter.setBrush(Qt.BrushStyle.NoBrush)

    # Words

    def _paint_note(self, painter: QPainter, pixel_map: PixelMap, note: Note) -> None:
        position = pixel_map.point(*note.position)
        if _is_drawable(*position):
            offset = QPointF(*position) - QPointF(*pixel_map.point(*note.work))
            aside = QPointF(-offset.y(), offset.x())
            directions = (offset, aside, -aside, -offset)
            self._write_beyond(painter, pixel_map, QPointF(*position), directions, note.text)

    def _write_beyond(
        self,
        painter: QPainter,
        pixel_map: PixelMap,
        position: QPointF,
        directions: Sequence[QPointF],
        text: str,
    ) -> None:
        """Write beside a position, away from the points that are edited."""
        gap, size = _READOUT_GAP * self.scale, size_of(painter, text)
        plate = self.readout_rect = beyond(position, directions, gap, size, pixel_map)
        write_on_plate(painter, plate, text, self.theme.paper, self.theme.accent)

    def _paint_label(
        self, painter: QPainter, pixel_map: PixelMap, pixel: QPointF, text: str, surroundings: Surroundings
    ) -> None:
        """Write beside a point, in the corner where the label covers least of curve and numbers."""
        size, gap = size_of(painter, text), (_LABEL_GAP[0] * self.scale, _LABEL_GAP[1] * self.scale)
        self.snap_label_rect = free_corner(pixel, size, gap, surroundings, pixel_map)
        theme = self.theme
        self._halo.write(painter, self.snap_label_rect, text, theme.paper, theme.accent, 2 * self.scale)


def _rectangle(pixel_map: PixelMap, a: Vector, b: Vector) -> QRectF:
    return QRectF(QPointF(*pixel_map.point(*a)), QPointF(*pixel_map.point(*b))).normalized()


def _is_drawable(*pixels: float) -> bool:
    """Return whether Qt can draw at these pixels: finite and not absurdly far away."""
    return all(abs(pixel) < _FAR for pixel in pixels)
