"""The curves of the document's file, dashed, while they differ from those that are edited."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPixmap

from app.canvas.curve_layer import TOLERANCE
from app.plotting.layers import Layer
from app.plotting.pens import draw_line, pen_of
from app.plotting.pixel_map import PixelMap
from app.plotting.plot_widget import PlotWidget
from app.view_model.curve_view import CurveView
from app.view_model.line_styles import FILE_STYLE


class FileLayer(Layer):
    """Draws the curves of the file behind those of the document, out of the reach of the mouse."""

    z = -2.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._views: Sequence[CurveView] = ()
        self._name = ""
        self._picture: QPixmap | None = None
        self._key: tuple[object, ...] = ()
        self.set_visible(False)

    @property
    def name(self) -> str:
        """The name of the curves; empty while there are none."""
        return self._name if self._views else ""

    def render(self, views: Sequence[CurveView], name: str) -> None:
        """Draw these curves from the next paint on; none: nothing."""
        self._views = [view for view in views if view.source.visible and view.curve is not None]
        self._name, self._picture = name, None
        self.set_visible(bool(self._views))
        self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the curves, from a picture that is kept: dashes are slow to make."""
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
        painter.setPen(pen_of(FILE_STYLE, self.theme, self.scale))
        for view in self._views:
            points = view.flattened(TOLERANCE / max(shown.sx, shown.sy), shown.box).points
            draw_line(painter, shown.points(points), FILE_STYLE.dashes, shown)
        painter.end()
        return picture
