"""The curves that are selected beside the active one: in full colour, with halos, their points as rings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray

from ..appearance.theme import mix
from ..plotting.drawing import Stroke
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import RingStamps
from ..view_model.curve_view import CurveView
from .curve_layer import FAINT_WIDTH
from .looks import Shape, line_of, paint_line, printed_width
from .other_curves_layer import OtherCurvesLayer
from .point_layer import opacity_of

_WIDTH, _HALO, _OVER_PRINT = 2.0, 7.0, 1.0

_CASED, _WIDE = 2.5, 5.0
"""Pixels of the mark with paper on either side, and of the least line that shows its colour beside that."""

_HALO_SHARE = 0.28
_HALOS_UP_TO = 12
"""Curves from which on there are rings alone: wide lines would take half of the time of a drag of thirty."""

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
        """Paint halos, lines and rings into the picture; over a wide line, or an inside, a thin line."""
        views = [view for shape in shapes for view in shape]
        # No opacity: where the pieces of a line meet, their caps would be seen.
        halo = mix(self.theme.accent, self.theme.paper, _HALO_SHARE)
        stroke = Stroke()
        for view in views:
            painter.setOpacity(opacity_of(view))
            style, is_line = self.looks.style_of(view), self.looks.is_line(view)
            stroke.show(line_of(view, shown, style).points, shown)
            width = printed_width(style, shown, _WIDTH * self.scale) / self.scale
            has_halo = (is_line or 0 < width < _WIDE) and len(self._views) <= _HALOS_UP_TO
            if has_halo:
                painter.setPen(self._line(halo, max(_HALO, width + _HALO - _WIDTH)))
                stroke.draw(painter)
            painter.setOpacity(1.0)
            if is_line or not view.source.visible:
                is_seen = view.source.visible
                pens = [(self._colour(view), _WIDTH) if is_seen else (self.theme.handle, FAINT_WIDTH)]
            elif has_halo:
                # Over a fine line no other one would leave any of its colour.
                paint_line(painter, view, style, shown, self.theme, _WIDTH * self.scale)
                pens = []
            else:
                casing = [(self.theme.paper, _CASED)] if width >= _WIDE else []
                pens = [*casing, (self.theme.accent, _OVER_PRINT)]
            for pen in pens:
                painter.setPen(self._line(*pen))
                stroke.draw(painter)
        if self._has_rings:
            self._paint_rings(painter, shown, views)

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
