"""Shapes that are seen through masks on the canvas."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter

from ..document.contents import is_content
from ..document.style import Style
from ..plotting.pixel_map import PixelMap
from ..plotting.printed import to_pixels
from ..qt.masks import paint_masked
from ..view_model.curve.curve_view import CurveView
from .blurs import blurred_box


def paint_through(
    painter: QPainter,
    shape: Sequence[CurveView],
    style: Style,
    shown: PixelMap,
    width: float,
    paint: Callable[[QPainter], None],
) -> None:
    """Paint a shape in a style as far as its masks let it be seen; `paint` paints it whole.

    `width` is that of its line in pixels.
    """
    place = QRectF(0, 0, shown.width, shown.height)
    if not is_content(shape[0].source):
        (left, low), (right, high) = blurred_box(shape, style, width / shown.sx).tolist()
        box = QRectF(QPointF(*shown.point(left, high)), QPointF(*shown.point(right, low)))
        place = box.adjusted(-1, -1, 1, 1).intersected(place)
    ratio = painter.device().devicePixelRatioF()
    paint_masked(painter, style.masks, to_pixels(shown), place, ratio, paint)
