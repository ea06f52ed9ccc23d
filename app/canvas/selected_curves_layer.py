"""The curves that are selected beside the active one: in full colour, with halos, their points as rings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPen

from ..appearance.theme import mix
from ..plotting.drawing import Stroke
from ..plotting.pixel_map import PixelMap
from ..view_model.curve_view import CurveView
from .curve_layer import FAINT_WIDTH, line_of
from .other_curves_layer import OtherCurvesLayer
from .point_layer import opacity_of

_WIDTH, _HALO = 2.0, 7.0
_HALO_SHARE = 0.28
_HALOS_UP_TO = 12
"""Curves from which on there are rings alone: wide lines would take half of the time of a drag of thirty."""

_RADIUS = 3.5
_MOST_RINGS = 400
"""Points in sight of one curve above which only as many are ringed: more would be a band."""


class SelectedCurvesLayer(OtherCurvesLayer):
    """Layer of selected curves, painted like the others from a picture that is kept while they stay.

    Hidden ones are faint, as the active curve is: they are moved with the others. While no curve is edited
    no points are shown, and these have no rings.
    """

    shows_hidden = True
    join = Qt.PenJoinStyle.RoundJoin
    _has_rings = True

    def set_rings(self, has_rings: bool) -> None:
        """Draw rings around the points, or no points at all."""
        if has_rings != self._has_rings:
            self._has_rings, self._picture = has_rings, None
            self.update()

    def paint_curves(self, painter: QPainter, shown: PixelMap, views: Sequence[CurveView]) -> None:
        """Paint halos, lines and rings into the picture."""
        # No opacity: where the pieces of a line meet, their caps would be seen.
        halo = mix(self.theme.accent, self.theme.paper, _HALO_SHARE)
        stroke = Stroke()
        for view in views:
            painter.setOpacity(opacity_of(view))
            stroke.show(line_of(view, shown).points, shown)
            if len(self._views) <= _HALOS_UP_TO:
                painter.setPen(self._line(halo, _HALO))
                stroke.draw(painter)
            painter.setOpacity(1.0)
            line = (self._colour(view), _WIDTH) if view.source.visible else (self.theme.handle, FAINT_WIDTH)
            painter.setPen(self._line(*line))
            stroke.draw(painter)
            if self._has_rings:
                painter.setOpacity(opacity_of(view))
                self._paint_rings(painter, shown, view)

    def _paint_rings(self, painter: QPainter, shown: PixelMap, view: CurveView) -> None:
        pixels, margin = shown.points(view.points), 2 * _RADIUS * self.scale
        is_near = np.all(
            (pixels > -margin) & (pixels < (shown.width + margin, shown.height + margin)), axis=1
        )
        near = pixels[is_near]
        near = near[:: max(len(near) // _MOST_RINGS, 1)]
        painter.setPen(QPen(self.theme.accent, 1.5 * self.scale))
        painter.setBrush(self.theme.paper)
        for x, y in near.tolist():
            painter.drawEllipse(QPointF(x, y), _RADIUS * self.scale, _RADIUS * self.scale)
