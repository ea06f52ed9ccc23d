"""The curves that are selected beside the active one: with lines on them or boxes, their points as rings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import FloatArray

from ..appearance.theme import mix
from ..plotting.drawing import Stroke
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import RingStamps
from ..view_model.curve.curve_view import CurveView
from .curve_layer import FAINT_WIDTH
from .looks import Shape, is_plain, line_of, line_width
from .other_curves_layer import OtherCurvesLayer
from .point_layer import opacity_of

_WIDTH, _HALO, _ON_STYLE = 2.0, 7.0, 1.0

_CASED, _WIDE = 2.5, 5.0
"""Pixels of the mark with paper on either side, and of the least line that shows its colour beside that."""

_HALO_SHARE = 0.28
_HALOS_UP_TO = 12
"""Curves above which boxes mark them: wide lines would take half of the time of a drag of thirty."""

BESIDE, _BEYOND = 2.0, 8.0
"""Pixels from a painted shape to its box, and from the picture to the sides of a box that leaves it."""

_RADIUS, _RIM = 3.5, 1.5
_MOST_RINGS = 400
"""Points in sight of one curve above which only as many are ringed: more would be a band."""


class SelectedCurvesLayer(OtherCurvesLayer):
    """Layer that marks selected curves, painted like the others from a picture that is kept while they stay.

    Hidden ones are faint, as the active curve is: they are moved with the others. While no curve is edited
    no points are shown, and these have no rings.
    """

    z = -0.7

    shows_hidden = True
    radius, rim = _RADIUS, _RIM
    join = Qt.PenJoinStyle.RoundJoin

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._rings, self._has_rings = RingStamps(_ring), True

    def set_rings(self, has_rings: bool) -> None:
        """Draw rings around the points, or no points at all."""
        if has_rings != self._has_rings:
            self._has_rings, self._picture = has_rings, None
            self.update()

    def paint_shapes(self, painter: QPainter, shown: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint the marks of choice and rings into the picture: lines on curves, or boxes around shapes."""
        views = [view for shape in shapes for view in shape]
        is_many = len(self._views) > _HALOS_UP_TO
        stroke = Stroke()
        for view in views:
            if self._is_line(view):
                stroke.show(line_of(view, shown).points, shown)
                self._paint_line_of(painter, stroke, view, has_halo=not is_many)
            elif not is_many and not self._is_boxed(view, shown):
                self._paint_on_style(painter, stroke, view, shown)
        # Over a fine line, and on the colours beside it, any other one would hide them.
        boxed = views if is_many else [view for view in views if self._is_boxed(view, shown)]
        if boxed:
            self._paint_boxes(painter, shown, boxed)
        if self._has_rings:
            self._paint_rings(painter, shown, views)

    def _is_line(self, view: CurveView) -> bool:
        """Whether a curve is drawn here as a line, and not marked on what is painted."""
        return is_plain(view) or not view.source.visible

    def _paint_line_of(self, painter: QPainter, stroke: Stroke, view: CurveView, *, has_halo: bool) -> None:
        """Paint the line of a curve that has no looks of its own, or is hidden."""
        is_seen = view.source.visible
        if has_halo:
            self._paint_halo(painter, stroke, view)
        painter.setPen(
            self._line(self._colour(view), _WIDTH) if is_seen else self._line(self.theme.handle, FAINT_WIDTH)
        )
        stroke.draw(painter)

    def _is_boxed(self, view: CurveView, shown: PixelMap) -> bool:
        """Whether a box marks a curve: its line is too fine to be drawn on."""
        return not self._is_line(view) and 0 < self._line_width(view, shown) < _WIDE

    def _line_width(self, view: CurveView, shown: PixelMap) -> float:
        return line_width(view.source.style, shown, _WIDTH * self.scale) / self.scale

    def _paint_on_style(self, painter: QPainter, stroke: Stroke, view: CurveView, shown: PixelMap) -> None:
        """Mark a wide line or an inside by a thin line on it."""
        stroke.show(line_of(view, shown, view.source.style).points, shown)
        casing = [(self.theme.paper, _CASED)] if self._line_width(view, shown) else []
        for pen in [*casing, (self.theme.accent, _ON_STYLE)]:
            painter.setPen(self._line(*pen))
            stroke.draw(painter)

    def _paint_halo(self, painter: QPainter, stroke: Stroke, view: CurveView) -> None:
        # No opacity: where the pieces of a line meet, their caps would be seen.
        halo = mix(self.theme.accent, self.theme.paper, _HALO_SHARE)
        painter.setOpacity(opacity_of(view))
        painter.setPen(self._line(halo, _HALO))
        stroke.draw(painter)
        painter.setOpacity(1.0)

    def _paint_boxes(self, painter: QPainter, shown: PixelMap, views: Sequence[CurveView]) -> None:
        """Frame each painted shape, all in one call: it costs next to nothing, and hides no colour."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self.theme.accent, max(round(self.scale), 1)))
        painter.drawRects(_frames_of(views, shown, self.scale))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)

    def _paint_rings(self, painter: QPainter, shown: PixelMap, views: Sequence[CurveView]) -> None:
        """Ring the points of all curves over all lines: in one call for those of one opacity."""
        for opacity in {opacity_of(view) for view in views}:
            near = [self._near(view, shown) for view in views if opacity_of(view) == opacity]
            painter.setOpacity(opacity)
            self._rings.draw_rings(
                painter, np.concatenate(near), self.theme, self.radius * self.scale, self.rim * self.scale
            )

    def _near(self, view: CurveView, shown: PixelMap) -> FloatArray:
        """Return the pixels of the points in sight, (k, 2); of very many some."""
        pixels, margin = shown.points(view.points), 2 * _RADIUS * self.scale
        is_near = ((pixels > -margin) & (pixels < (shown.width + margin, shown.height + margin))).all(axis=1)
        near: FloatArray = pixels[is_near]
        return near[:: max(len(near) // _MOST_RINGS, 1)]


class SiblingCurvesLayer(SelectedCurvesLayer):
    """Layer of the points of the other curves of the shape that is edited: a press takes them, too."""

    radius, rim = 3.0, 1.2

    def paint_shapes(self, painter: QPainter, shown: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint small rings into the picture."""
        self._paint_rings(painter, shown, [view for shape in shapes for view in shape])


def _ring(painter: QPainter, radius: float, _form: int) -> None:
    painter.drawEllipse(QPointF(0.0, 0.0), radius, radius)


def _frames_of(views: Sequence[CurveView], shown: PixelMap, scale: float) -> list[QRect]:
    """Return a box around each painted shape, in pixels, as far as it is in or near the picture."""
    corners = shown.points(np.concatenate([view.drawn_box for view in views])).reshape(-1, 2, 2)
    widths = [line_width(view.source.style, shown, _WIDTH * scale) for view in views]
    pads = BESIDE * scale + np.array(widths)[:, None] / 2
    names = [view.source.shape for view in views]
    starts = [at for at, name in enumerate(names) if not name or at == 0 or names[at - 1] != name]
    lows = np.minimum.reduceat(corners.min(axis=1) - pads, starts)
    highs = np.maximum.reduceat(corners.max(axis=1) + pads, starts)
    lows = np.maximum(lows, -_BEYOND).round()
    highs = np.minimum(highs, (shown.width + _BEYOND, shown.height + _BEYOND)).round()
    boxes = np.hstack([lows, highs - lows])[(highs > lows).all(axis=1)]
    return [QRect(*box) for box in boxes.astype(int).tolist()]
