"""Colours of single places of the drawing, as it prints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace
from PySide6.QtGui import QColor, QImage, QPainter

from curvecore.arrays import FloatArray

from ..appearance.colours import curve_colour, fill_colour
from ..appearance.theme import PRINTED
from ..document.contents import is_content
from ..document.marker import FARTHEST
from ..document.model import Vector
from ..document.shapes import shapes
from ..document.style import Style
from ..plotting.pixel_map import PixelMap
from ..plotting.printed import Ink, paint_printed
from ..view_model.curve.curve_view import CurveView
from .blurs import blurred_box, paint_blurred
from .content_ink import paint_content
from .looks import Looks, Shape, parts_of
from .masked import paint_through

_LEAST = 5.0
"""Pixels of a line, at least: nobody points at a hairline exactly."""


class SeenColours:
    """Finds the colour at a place: what is painted there, one over the other, on white paper.

    Overlays, points and the grid are no part of the drawing.
    """

    def __init__(self) -> None:
        self._views: Sequence[CurveView] = ()
        self._shapes: list[Shape] = []
        self._looks = Looks()
        self._boxes = np.empty((0, 2, 2))

    def at(
        self, views: Sequence[CurveView], looks: Looks, pixel: Vector, shown: PixelMap, below: QColor | None
    ) -> str:
        """Return the colour at a pixel, "#rrggbb"; `below` is that of a picture there, None for none."""
        if views is not self._views or looks != self._looks:
            self._find(views, looks)
        # A picture of this pixel alone: all that is painted is cut to it.
        left, top = shown.plane(pixel[0] - 0.5, pixel[1] - 0.5)
        spot = PixelMap(left, top, shown.sx, shown.sy, 1.0, 1.0)
        picture = QImage(1, 1, QImage.Format.Format_ARGB32_Premultiplied)
        picture.fill(PRINTED.paper)
        with QPainter(picture) as painter:
            if below is not None:
                painter.fillRect(0, 0, 1, 1, below)
            for shape in self._near(pixel, shown):
                painter.save()
                _paint(painter, shape, looks.style_of(shape[0]), shown, spot)
                painter.restore()
        return picture.pixelColor(0, 0).name()

    def _find(self, views: Sequence[CurveView], looks: Looks) -> None:
        found = [
            tuple(views[place] for place in places if views[place].source.visible and views[place].has_curve)
            for places in shapes([view.source for view in views])
        ]
        self._views, self._looks, self._shapes = views, looks, [shape for shape in found if shape]
        boxes = [_box(shape, looks.style_of(shape[0])) for shape in self._shapes]
        self._boxes = np.array(boxes).reshape(-1, 2, 2)

    def _near(self, pixel: Vector, shown: PixelMap) -> list[Shape]:
        """Return the shapes that may cover a pixel, the hindmost first."""
        place, reach = np.array(shown.plane(*pixel)), _LEAST / min(shown.sx, shown.sy)
        is_near = ((self._boxes[:, 0] - reach <= place) & (place <= self._boxes[:, 1] + reach)).all(axis=1)
        return [self._shapes[number] for number in np.flatnonzero(is_near).tolist()]


def _box(shape: Shape, style: Style) -> FloatArray:
    """Return a box that a shape in a style does not leave, nor its line with its miters."""
    if style.blur:
        return blurred_box(shape, style, style.width or 0.0)
    lines = np.vstack([view.drawn_box for view in shape])
    overhang = (style.width or 0.0) * max(1.0, style.miter_limit, FARTHEST if style.has_markers else 0.0)
    return np.array([lines.min(axis=0) - overhang, lines.max(axis=0) + overhang])


def _paint(painter: QPainter, shape: Shape, style: Style, shown: PixelMap, spot: PixelMap) -> None:
    if style.masks:
        whole, width = replace(style, masks=()), (style.width or 0.0) * shown.sx
        paint_through(
            painter, shape, style, spot, width, lambda inner: _paint(inner, shape, whole, shown, spot)
        )
        return
    if style.blur:
        sharp, width = replace(style, blur=0.0, clips=()), (style.width or 0.0) * shown.sx

        def paint(inner: QPainter, part: PixelMap, _scale: float) -> None:
            _paint(inner, shape, sharp, part, part)

        paint_blurred(painter, shape, style, spot, width, (), paint)
        return
    if is_content(shape[0].source):
        paint_content(painter, shape[0].source, style, spot, PRINTED, (style.width or 0.0) * shown.sx)
        return
    width = _LEAST if style.width is None else style.width * shown.sx
    if 0.0 < width < _LEAST:
        # So near to each other nobody means one dash or the gap after it.
        style, width = replace(style, dash=()), _LEAST
    colours = curve_colour(style.stroke, PRINTED), fill_colour(style.fill, PRINTED)
    ink = Ink(*colours, width, PRINTED.curve)
    # The polylines that are on the screen: they are known.
    paint_printed(painter, parts_of(shape, shape[0].source.style, shown), style, ink, spot)
