"""The curves of the document's file, dashed, while they differ from those that are edited."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtGui import QPainter

from app.canvas.other_curves_layer import OtherCurvesLayer, pixels_of
from app.plotting.pens import draw_line, pen_of
from app.plotting.pixel_map import PixelMap
from app.view_model.curve_view import CurveView
from app.view_model.line_styles import FILE_STYLE


class FileLayer(OtherCurvesLayer):
    """Draws the curves of the file behind those of the document, out of the reach of the mouse."""

    z = -2.0

    def paint_curves(self, painter: QPainter, shown: PixelMap, views: Sequence[CurveView]) -> None:
        """Paint dashed lines into the picture that is kept: dashes are slow to make."""
        painter.setPen(pen_of(FILE_STYLE, self.theme, self.scale))
        for view in views:
            draw_line(painter, pixels_of(view, shown), FILE_STYLE.dashes, shown)
