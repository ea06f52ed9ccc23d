"""Layers of the plots over t: plots below each other on their scales, and the scrub line through all."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import FloatArray

from ...document.words import number, with_minus
from ...plotting.drawing import Segments, Stroke, cut_segments
from ...plotting.layers import Layer
from ...plotting.pens import colour_of, line_in_pixels, with_dashes
from ...plotting.pixel_map import PixelMap
from ...plotting.plot_widget import PlotWidget
from ...view_model.analysis.plot import PlotData, PlotLine, Scale
from ...view_model.line_styles import DASHED

_MARGIN = 0.06
_LEAST_DECADES = math.log10(2)
_LARGEST, _SMALLEST = 1e300, 1e-300

_FAR_HEIGHTS = 50.0
"""Heights of the plot beyond which the position of a value does not matter."""

_PLAIN = (-3, 4)
"""Exponents of powers of ten that are written as decimals."""

_STEPS = (1, 2, 5, 10)


@dataclass(frozen=True)
class ValueScale:
    """The values at the foot and at the head of a plot.

    pyqtgraph loses ranges above 1e150; so it gets shares of the height, from 0 to 1.
    """

    low: float
    high: float
    scale: Scale

    @classmethod
    def of(cls, plot: PlotData) -> ValueScale:
        """Return a scale for the extent of a plot, with a little room above."""
        least, greatest = (float(np.clip(value, -_LARGEST, _LARGEST)) for value in plot.extent)
        if plot.scale is Scale.LOG:
            least, greatest = max(least, _SMALLEST), max(greatest, _SMALLEST)
            high = max(math.log10(greatest), math.log10(least) + _LEAST_DECADES)
            room = _MARGIN * (high - math.log10(least))
            return cls(least, 10 ** min(high + room, 307.0), plot.scale)
        low, high = min(least, 0.0), max(greatest, 0.0)
        if low == high:
            return cls(0.0, 1.0, plot.scale)
        room = _MARGIN * (high - low)
        return cls(low - room if low < 0 else 0.0, high + room if high > 0 else 0.0, plot.scale)

    def holding(self, other: ValueScale) -> ValueScale:
        """Return a scale for the values of both."""
        if other.scale is not self.scale:
            return other
        return ValueScale(min(self.low, other.low), max(self.high, other.high), self.scale)

    def shares(self, values: FloatArray) -> FloatArray:
        """Return the shares of the height of values: 0 at the foot, 1 at the head; NaN stays."""
        with np.errstate(all="ignore"):
            if self.scale is Scale.LOG:
                low, high = math.log10(self.low), math.log10(self.high)
                shares = (np.log10(np.where(values < 0, 0.0, values)) - low) / (high - low)
            else:
                # Halved, because the difference of two huge numbers must not overflow.
                shares = (values / 2 - self.low / 2) / (self.high / 2 - self.low / 2)
        return np.asarray(np.clip(shares, -_FAR_HEIGHTS, 1 + _FAR_HEIGHTS))

    def share(self, value: float) -> float:
        """Return the share of the height of one value."""
        return float(self.shares(np.array([value]))[0])

    def ticks(self, most: int) -> list[tuple[float, str]]:
        """Return (share, number) of at most `most` round values, and at least one."""
        values = self._powers(most) if self.scale is Scale.LOG else self._multiples(most)
        return [(share, text) for value, text in values if -1e-9 <= (share := self.share(value)) <= 1 + 1e-9]

    def _powers(self, most: int) -> list[tuple[float, str]]:
        first, last = math.ceil(math.log10(self.low) - 1e-9), math.floor(math.log10(self.high) + 1e-9)
        stride = max(-(-(last - first + 1) // max(most, 1)), 1)
        powers = range(first, last + 1, stride)
        ticks = [(10.0**power, _power_text(1, power)) for power in powers]
        if last - first <= 0 or 3 * (last - first + 1) <= most:
            # Hardly more than one power of ten: add 2 and 5 times the powers.
            around = range(first - 1, last + 1)
            ticks += [(f * 10.0**power, _power_text(f, power)) for power in around for f in (2, 5)]
        return ticks

    def _multiples(self, most: int) -> list[tuple[float, str]]:
        least = (self.high / 2 - self.low / 2) / max(most, 1) * 2
        power = math.floor(math.log10(least))
        steps = [step * 10.0**exponent for exponent in (power - 1, power) for step in _STEPS]
        unit = min((step for step in steps if step >= least * (1 - 1e-9)), default=steps[-1])
        # Zero alone would be no scale.
        smaller = (step for step in reversed(steps) if step <= unit and max(self.high, -self.low) >= step)
        unit = next(smaller, unit)
        first, last = math.ceil(self.low / unit - 1e-9), math.floor(self.high / unit + 1e-9)
        return [(count * unit, number(count * unit)) for count in range(first, last + 1)]


def _power_text(factor: int, power: int) -> str:
    if _PLAIN[0] <= power <= _PLAIN[1]:
        return number(factor * 10.0**power)
    return with_minus(f"{factor}e{power}")


_STRIP, _LARGEST_STRIP = 17.0, 0.4
"""Pixels above a plot for its title, and their largest share of the height."""

_FOOT = 5.0
_MOST_JUMPS = 200
_LEAST_SPACING = 6.0
"""Pixels between the marks of joints below which they would merge into a grey area."""

_MOST_A_COLUMN = 1.8
"""Samples for each column of pixels above which they are drawn by columns."""

_FAR = 1e5
_WIDTH = 1.5


class PlacedPlot(NamedTuple):
    """A plot in its band of the height: pixels of the top of its title, of its head and of its foot."""

    plot: PlotData
    scale: ValueScale
    top: float
    head: float
    foot: float

    @property
    def height(self) -> float:
        """The height of the plot without its title."""
        return self.foot - self.head

    def y(self, values: FloatArray) -> FloatArray:
        """Return the vertical pixels of values."""
        return self.foot - self.scale.shares(values) * self.height


class PlotLayer(Layer):
    """All plots, in one item."""

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.plots: Sequence[tuple[PlotData, ValueScale]] = ()
        self.knots: FloatArray = np.empty(0)
        self.note = ""
        self.waits = False
        self._strokes: list[list[Stroke | Segments]] = []
        self._strokes_of: tuple[object, object, float] = ((), None, 0.0)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw every plot: levels and joints, lines, title."""
        painter.setFont(self.fonts.less(1.0, self.scale))
        if self.note:
            painter.setPen(self.theme.muted)
            area = QRectF(0, 0, pixel_map.width, pixel_map.height)
            painter.drawText(area, int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap), self.note)
            return
        self._prepare(pixel_map)
        self._paint_joints(painter, pixel_map)
        for placed, strokes in zip(self.placed(pixel_map.height), self._strokes, strict=True):
            self._paint_ground(painter, placed, pixel_map.width)
            painter.save()
            painter.setClipRect(QRectF(0, placed.head - 1, pixel_map.width, placed.height + 2))
            self._paint_levels(painter, placed, pixel_map.width)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
            for line, stroke in zip(placed.plot.lines, strokes, strict=True):
                pen = self._pen(line)
                if len(line.t) > _MOST_A_COLUMN * pixel_map.width:
                    # Side by side, wider lines would merge into a bar.
                    pen.setWidthF(self.scale)
                painter.setPen(pen)
                stroke.draw(painter)
                self._paint_jumps(painter, line, placed, pixel_map)
            painter.restore()
            self._paint_title(painter, placed, pixel_map.width)

    def placed(self, height: float) -> list[PlacedPlot]:
        """Return the plots in their bands of a height."""
        band = height / max(len(self.plots), 1)
        strip = min(_STRIP * self.scale, _LARGEST_STRIP * band)
        foot = min(_FOOT, 0.1 * band)
        return [
            PlacedPlot(plot, scale, i * band, i * band + strip, (i + 1) * band - foot)
            for i, (plot, scale) in enumerate(self.plots)
        ]

    # Lines

    def _prepare(self, pixel_map: PixelMap) -> None:
        """Convert the values to pixels, unless that is done."""
        plots, where, scale = self._strokes_of
        if plots is self.plots and where is pixel_map and scale == self.scale:
            return
        self._strokes_of = (self.plots, pixel_map, self.scale)
        self._strokes = [
            [_stroke(line, placed, pixel_map, _WIDTH * self.scale) for line in placed.plot.lines]
            for placed in self.placed(pixel_map.height)
        ]

    def _pen(self, line: PlotLine) -> QPen:
        return QPen(colour_of(line.style, self.theme, 0.4 if self.waits else 1.0), _WIDTH * self.scale)

    def _paint_jumps(
        self, painter: QPainter, line: PlotLine, placed: PlacedPlot, pixel_map: PixelMap
    ) -> None:
        """Mark both ends of every jump."""
        gaps = np.flatnonzero(np.isnan(line.values[1:-1])) + 1
        if not 0 < len(gaps) <= _MOST_JUMPS:
            return
        ends = np.concatenate([gaps - 1, gaps + 1])
        x, y = pixel_map.x(line.t[ends]), placed.y(line.values[ends])
        near = (x > -9) & (x < pixel_map.width + 9) & (y > placed.top - 9) & (y < placed.foot + 9)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour_of(line.style, self.theme))
        for centre in np.column_stack([x, y])[near].tolist():
            painter.drawEllipse(QPointF(*centre), 2.2 * self.scale, 2.2 * self.scale)
        painter.setBrush(Qt.BrushStyle.NoBrush)

    # Background and titles

    def _paint_ground(self, painter: QPainter, placed: PlacedPlot, width: float) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.grid_coarse, 1))
        zero = 0.0 if placed.scale.low < 0 else placed.scale.low
        y = round(float(placed.y(np.array([zero]))[0]))
        painter.drawLine(0, y, int(width), y)
        if placed.top:
            painter.drawLine(0, round(placed.top), int(width), round(placed.top))

    def _paint_joints(self, painter: QPainter, pixel_map: PixelMap) -> None:
        x = pixel_map.x(self.knots)
        x = x[(x >= -1) & (x <= pixel_map.width + 1)]
        if len(x) > 1 and float(np.median(np.diff(x))) < _LEAST_SPACING:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.grid_fine, 1))
        for column in np.rint(x).astype(int).tolist():
            painter.drawLine(column, 0, column, int(pixel_map.height))

    def _paint_levels(self, painter: QPainter, placed: PlacedPlot, width: float) -> None:
        painter.setPen(with_dashes(QPen(self.theme.muted, 1), DASHED))
        for y in np.rint(placed.y(np.array([level.value for level in placed.plot.levels]))).tolist():
            painter.drawLine(QPointF(0, y), QPointF(width, y))

    def _paint_title(self, painter: QPainter, placed: PlacedPlot, width: float) -> None:
        """Draw the title; where the plot has several lines, a sample and the name of each."""
        plot = placed.plot
        strip = QRectF(4, placed.top, width - 8, max(placed.head - placed.top, 11.0))
        middle = int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft)
        title = f"{plot.title} …" if self.waits else plot.title
        painter.setPen(self.theme.ink)
        painter.drawText(strip, middle, title)
        left = strip.left() + painter.fontMetrics().horizontalAdvance(title) + 14
        if len(plot.lines) > 1:
            left = self._paint_legend(painter, plot, strip, left)
        remark = plot.note or "".join(level.name for level in plot.levels)
        if remark:
            painter.setPen(self.theme.warning if plot.note else self.theme.muted)
            room = strip.adjusted(left - strip.left(), 0, 0, 0)
            text = painter.fontMetrics().elidedText(remark, Qt.TextElideMode.ElideRight, int(room.width()))
            painter.drawText(room, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), text)

    def _paint_legend(self, painter: QPainter, plot: PlotData, strip: QRectF, left: float) -> float:
        for line in plot.lines:
            y = strip.center().y()
            painter.setPen(with_dashes(self._pen(line), line.style.dashes))
            painter.drawLine(QPointF(left, y), QPointF(left + 22, y))
            painter.setPen(self.theme.muted)
            painter.drawText(
                strip.adjusted(left + 26 - strip.left(), 0, 0, 0),
                int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft),
                line.name,
            )
            left += 26 + painter.fontMetrics().horizontalAdvance(line.name) + 14
        return left


def _stroke(line: PlotLine, placed: PlacedPlot, pixel_map: PixelMap, width: float) -> Stroke | Segments:
    with np.errstate(over="ignore"):
        x = np.clip(pixel_map.x(line.t), -_FAR, _FAR)
    y = placed.y(line.values)
    if len(x) > _MOST_A_COLUMN * pixel_map.width:
        return _by_columns(x, y, pixel_map)
    return line_in_pixels(np.column_stack([x, y]), line.style.dashes, width, pixel_map)


def _by_columns(x: FloatArray, y: FloatArray, pixel_map: PixelMap) -> Segments:
    """Return one upright line for each column of pixels: more samples would not be visible."""
    column = np.floor(x)
    is_visible = (column >= 0) & (column <= pixel_map.width) & ~np.isnan(y)
    column, y = column[is_visible], y[is_visible]
    upright = Segments()
    if len(column):
        first = np.flatnonzero(np.diff(column, prepend=-1.0))
        low, high = np.minimum.reduceat(y, first), np.maximum.reduceat(y, first)
        # Each line reaches to the one before it, as a line through all samples would.
        low[1:], high[1:] = np.minimum(low[1:], high[:-1]), np.maximum(high[1:], low[:-1])
        middle = column[first] + 0.5
        # A line without length would not be drawn.
        ends = np.column_stack([middle, low - 0.5, middle, high + 0.5])
        upright.fill(cut_segments(ends, pixel_map.width, pixel_map.height))
    return upright


class ScrubLayer(Layer):
    """The scrub line, and a dot on every line where it crosses."""

    z = 10.0

    def __init__(self, plot: PlotWidget, plots: PlotLayer) -> None:
        super().__init__(plot)
        self.scrub: float | None = None
        self._plots = plots

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the line through all plots, and the dots."""
        if self.scrub is None:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        x = pixel_map.point(self.scrub, 0.0)[0]
        painter.drawLine(QPointF(x, 0), QPointF(x, pixel_map.height))
        if self._plots.note:
            return
        painter.setPen(QPen(self.theme.paper, 1.5 * self.scale))
        for placed in self._plots.placed(pixel_map.height):
            for line in placed.plot.lines:
                share = placed.scale.share(line.value_at(self.scrub))
                if 0 <= share <= 1:
                    y = placed.foot - share * placed.height
                    painter.setBrush(colour_of(line.style, self.theme))
                    painter.drawEllipse(QPointF(x, y), 4 * self.scale, 4 * self.scale)
        painter.setBrush(Qt.BrushStyle.NoBrush)
