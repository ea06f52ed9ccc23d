"""The active curve: its line, the shape in its style, its control polygon, and the preview of the pen."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QAbstractAnimation, Qt, QVariantAnimation
from PySide6.QtGui import QColor, QPainter, QPen

from curvecore.arrays import FloatArray

from ..appearance.colours import curve_colour
from ..appearance.theme import Theme, mix
from ..document.model import Vector
from ..document.words import number
from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.text import inside, size_of, write_on_plate
from ..plotting.wide_line import RoundLine, WideLine
from ..view_model.curve.curve_view import CurveView, Polyline
from .point_layer import opacity_of
from .shape_painting import Shape, is_plain, line_of, paint_shape

CASING = 1.0
"""Pixels of paper on either side of a line over a picture: grey on grey would be invisible."""

FAINT_WIDTH = 1.5
"""Width in pixels of a faint curve: thinner rather than dimmer, so that it stays visible."""

DEVIATION_TO_REPORT = 1.0
"""Deviation in pixels of a line above which the canvas reports it."""

_GHOST_MS, _GHOST_STEPS, _WIDTH, _EDIT_WIDTH = 900, 16, 2.0, 1.0


class EditedShapeLayer(Layer):
    """Layer of the edited shape in its style; plain and faint lines are drawn by the `CurveLayer`."""

    z = -0.9

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._shape: Shape = ()
        self._line = RoundLine()
        self.set_visible(False)

    def render(self, shape: Shape) -> None:
        """Draw the curves of the shape from the next paint on; () draws nothing."""
        if shape != self._shape:
            self._shape = shape
            self.set_visible(bool(shape))
            self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the shape."""
        if self._shape:
            width = _WIDTH * self.scale
            paint_shape(painter, self._shape, pixel_map, self.theme, width, self._line)


class CurveLayer(Layer):
    """Layer of the active curve: exact to a tenth of a pixel, or with a note about its deviation.

    Attributes
    ----------
    error
        Bound of the distance between the curve and the line drawn last, in pixels.
    """

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.error = 0.0
        self._error_of: tuple[FloatArray | None, PixelMap | None] = (None, None)
        self._view: CurveView | None = None
        self._line, self._ghost_stroke = WideLine(), Stroke()
        self._ghost: FloatArray | None = None
        self._ghost_held = self._is_cased = self._is_covered = False
        # The pen of the last frame, and its key: all that it depends on.
        self._pen_key: tuple[object, ...] = ()
        self._cached_pen = QPen()
        # In steps too small to be seen: the drawing is painted at each step, not sixty times a second.
        self._fade = QVariantAnimation(plot, startValue=_GHOST_STEPS, endValue=0, duration=_GHOST_MS)
        self._fade.valueChanged.connect(lambda _value: self.update())
        self._fade.finished.connect(self.drop_ghost)

    def render(self, view: CurveView) -> None:
        """Draw `view` from the next paint on."""
        self._view = view
        self.update()

    def show_ghost(self, pixel_map: PixelMap, *, held: bool = False) -> None:
        """Show the present curve behind its successor: as a fading ghost, or held until `release_ghost`.

        A held ghost is not replaced by another one.
        """
        polyline = self.polyline(pixel_map)
        if polyline is not None and not self._ghost_held:
            self._ghost, self._ghost_held = polyline.points, held
            self._fade.stop()
            if not held:
                self._fade.start()

    @property
    def ghost_opacity(self) -> float:
        """The opacity of the ghost, from 0 to 1."""
        if self._ghost_held:
            return 1.0
        fading = self._fade.state() == QAbstractAnimation.State.Running
        return self._fade.currentValue() / _GHOST_STEPS if fading and self._ghost is not None else 0.0

    def release_ghost(self) -> None:
        """Let a held ghost fade."""
        if self._ghost_held:
            self._ghost_held = False
            self._fade.start()

    def drop_ghost(self) -> None:
        """Show no ghost any more."""
        self._ghost = None
        self.update()

    def polyline(self, pixel_map: PixelMap) -> Polyline | None:
        """Return the polyline that is drawn, None without a curve."""
        if self._view is None or not self._view.has_curve:
            return None
        return line_of(self._view, pixel_map, self._view.source.style)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw ghost and curve."""
        if self._ghost is not None and self.ghost_opacity > 0:
            self._paint_ghost(painter, pixel_map, self._ghost)
        view, polyline = self._view, self.polyline(pixel_map)
        if view is None or polyline is None:
            self.error = 0.0
            return
        if self._error_of[0] is not polyline.deviation or self._error_of[1] is not pixel_map:
            self._error_of = (polyline.deviation, pixel_map)
            self.error = polyline.reached * max(pixel_map.sx, pixel_map.sy)
        for pen in self._pens(view):
            self._line.show(polyline.points, pixel_map, _WIDTH * self.scale)
            painter.setPen(pen)
            self._line.draw(painter)
        if self.deviation_text:
            self._paint_deviation(painter, pixel_map)

    @property
    def deviation_text(self) -> str:
        """The sentence about the deviation of the line; empty where it is negligible."""
        return f"Drawn to within {number(self.error, 2)} pixels" if self.error > DEVIATION_TO_REPORT else ""

    def _paint_deviation(self, painter: QPainter, pixel_map: PixelMap) -> None:
        plate = inside(0.0, pixel_map.height, size_of(painter, self.deviation_text, 12.0, 6.0), pixel_map)
        write_on_plate(painter, plate, self.deviation_text, self.theme.paper, self.theme.ink)

    def set_cased(self, cased: bool) -> None:
        """Draw the line with a casing of paper over a picture to trace, or without."""
        self._is_cased = cased
        self.update()

    def set_covered(self, covered: bool) -> None:
        """Draw a thin line over a curve that other shapes cover, or not."""
        self._is_covered = covered
        self.update()

    def _pens(self, view: CurveView) -> Sequence[QPen]:
        """Return the pens of the line, from the bottom to the top."""
        if is_faint(view) or is_plain(view):
            casing = [self._pen_of(self.theme.paper, _WIDTH + 2 * CASING)] if self._is_cased else []
            return (*casing, self._pen(view))
        if self._is_covered or not view.source.style.has_stroke:
            return (self._pen_of(self.theme.accent, _EDIT_WIDTH),)
        return ()

    def _pen(self, view: CurveView) -> QPen:
        faint = is_faint(view)
        key = (faint, view.source.style.colour, self.theme, self.scale)
        if key != self._pen_key:
            self._pen_key = key
            colour = self.theme.handle if faint else curve_colour(view.source.style.colour, self.theme)
            self._cached_pen = self._pen_of(colour, FAINT_WIDTH if faint else _WIDTH)
        return self._cached_pen

    def _pen_of(self, colour: QColor, width: float) -> QPen:
        return QPen(colour, width * self.scale, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap)

    def _paint_ghost(self, painter: QPainter, pixel_map: PixelMap, points: FloatArray) -> None:
        self._ghost_stroke.show(points, pixel_map)
        colour = QColor(self.theme.ghost)
        colour.setAlphaF(self.ghost_opacity)
        painter.setPen(QPen(colour, self.scale))
        self._ghost_stroke.draw(painter)


def is_faint(view: CurveView) -> bool:
    """Whether a curve is drawn faintly: it is hidden, or the last one that could be computed."""
    return not (view.is_current and view.source.visible)


_POLYGON_WIDTH = 1.0


class ControlPolygonLayer(Layer):
    """Layer of the control polygon below the active curve; a curve through its points has none."""

    z = -0.25

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._view: CurveView | None = None
        self._stroke = Stroke()
        # The pen of the last frame, and its key: all that it depends on.
        self._pen_key: tuple[Theme, float] | None = None
        self._cached_pen = QPen()
        self.set_visible(False)

    def render(self, view: CurveView) -> None:
        """Draw the polygon of `view` from the next paint on."""
        self._view = view
        self.set_visible(view.source.family.has_control_points)
        if self.is_visible:
            self.set_opacity(opacity_of(view))
            self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw thin lines behind the curve."""
        if self._view is None or len(self._view.points) < 2:
            return
        self._stroke.show(self._view.points, pixel_map)
        if self._pen_key != (self.theme, self.scale):
            self._pen_key = (self.theme, self.scale)
            self._cached_pen = QPen(self.theme.handle, _POLYGON_WIDTH * self.scale)
        painter.setPen(self._cached_pen)
        self._stroke.draw(painter)


class PenLayer(Layer):
    """Layer of a thin preview line below the curve, so that only changes are visible."""

    z = -0.5

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._preview: CurveView | None = None
        self._lines: tuple[tuple[Vector, ...], ...] = ()
        self._replaced: tuple[Vector, ...] = ()
        self._stroke = Stroke()
        self.set_visible(False)

    def render(
        self,
        preview: CurveView | None,
        lines: tuple[tuple[Vector, ...], ...],
        replaced: tuple[Vector, ...] = (),
    ) -> None:
        """Draw a curve, lines, and a part that lines replace, from the next paint on; None, () for none."""
        if preview is not self._preview or (lines, replaced) != (self._lines, self._replaced):
            self._preview, self._lines, self._replaced = preview, lines, replaced
            self.set_visible(preview is not None or bool(lines))
            self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the curve or the lines."""
        if self._preview is not None:
            self._stroke.show(line_of(self._preview, pixel_map).points, pixel_map)
            painter.setPen(QPen(self.theme.ghost, 1.3 * self.scale))
            self._stroke.draw(painter)
            return
        if self._replaced:
            painter.setPen(QPen(mix(self.theme.warning, self.theme.paper, 0.4), 7.0 * self.scale))
            self._stroke.show(np.array(self._replaced), pixel_map)
            self._stroke.draw(painter)
        painter.setPen(QPen(self.theme.accent, 1.5 * self.scale))
        for line in self._lines:
            self._stroke.show(np.array(line), pixel_map)
            self._stroke.draw(painter)
