"""What the document's file holds while it differs from what is edited: dashed, with its name."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPixmap, QPolygonF

from app.canvas.curve_layer import TOLERANCE
from app.plot.drawing import Floats, polygon, visible_segments
from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import Theme
from app.view_model.curve_view import CurveView

_DASHES = (6.0, 4.0)
_WIDTH = 1.5
_MARGIN = 8.0
_SAMPLE = 26.0


class FileLayer:
    """Draws the curves of the file behind those of the document, out of the reach of the mouse."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self.theme = theme
        self.scale = 1.0
        self._views: Sequence[CurveView] = ()
        self._name = ""
        self._picture: QPixmap | None = None
        self._key: tuple[object, ...] = ()
        self._layer = plot.add_layer(self.paint, z=-2)

    @property
    def name(self) -> str:
        """The name that stands beside the curves; empty while there are none."""
        return self._name if self._views else ""

    def render(self, views: Sequence[CurveView], name: str) -> None:
        """Draw these curves from the next paint on; none: nothing."""
        self._views = [view for view in views if view.source.visible and view.curve is not None]
        self._name, self._picture = name, None
        self._layer.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the curves and their name, from a picture that is kept: dashes are slow to make."""
        if not self._views:
            return
        device = painter.device()
        ratio = device.devicePixelRatio() if device is not None else 1.0
        key = (self._views, shown, self.theme, self.scale, ratio)
        if self._picture is None or any(new is not old for new, old in zip(key, self._key, strict=True)):
            self._picture, self._key = self._painted(shown, ratio), key
        painter.drawPixmap(0, 0, self._picture)

    def _painted(self, shown: PixelMap, ratio: float) -> QPixmap:
        picture = QPixmap(math.ceil(shown.width * ratio), math.ceil(shown.height * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        pen = QPen(self.theme.muted, _WIDTH * self.scale)
        pen.setDashPattern(_DASHES)
        painter.setPen(pen)
        for view in self._views:
            points = view.flattened(TOLERANCE / max(shown.sx, shown.sy), shown.box).points
            for run in _runs(visible_segments(shown.points(points), shown.width, shown.height)):
                painter.drawPolyline(run)
        self._paint_name(painter, shown)
        painter.end()
        return picture

    def _paint_name(self, painter: QPainter, shown: PixelMap) -> None:
        """Write the name into the lower left corner, beside a sample of the line."""
        metrics = QFontMetricsF(painter.font())
        size = metrics.size(0, self._name)
        place = QRectF(
            2 * _MARGIN + _SAMPLE, shown.height - size.height() - _MARGIN, size.width(), size.height()
        )
        paper = QColor(self.theme.paper)
        paper.setAlphaF(0.85)
        painter.fillRect(place.adjusted(-_SAMPLE - 2 * _MARGIN, -2, _MARGIN, 2), paper)
        middle = place.center().y()
        painter.drawLine(QPointF(_MARGIN, middle), QPointF(_MARGIN + _SAMPLE, middle))
        painter.drawText(place, int(Qt.AlignmentFlag.AlignCenter), self._name)


def _runs(segments: Floats) -> list[QPolygonF]:
    """Return segments (m, 4) that continue each other as polylines: dashes run on over their joints."""
    if not len(segments):
        return []
    breaks = np.flatnonzero(np.any(segments[1:, :2] != segments[:-1, 2:], axis=1)) + 1
    vertices = (np.vstack([run[:1, :2], run[:, 2:]]) for run in np.split(segments, breaks))
    return [polygon(each[:, 0], each[:, 1]) for each in vertices]
