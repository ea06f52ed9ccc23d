"""Other versions of the curve over the curve: computed with few digits, or with a cure tried out."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPixmap

from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.plot.traces import Trace, draw_dashed
from app.theme import Theme, mix

_WIDTH = 2.0
_FADED = 0.3
_ROW, _SAMPLE, _EDGE = 18.0, 28.0, 8.0


class TraceLayer:
    """Draws groups of traces, and in the lower right corner a legend with a row for each."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self.theme = theme
        self.scale = 1.0
        self.groups: dict[str, tuple[Sequence[Trace], str, bool]] = {}
        self._font = QFont(plot.font())
        self._picture: QPixmap | None = None
        self._drawn: object = None
        self._layer = plot.add_layer(self.paint, z=0.5)

    def render(self, group: str, traces: Sequence[Trace], heading: str, *, faded: bool) -> None:
        """Draw the traces of a group from the next paint on; none take the group away."""
        if not traces and group not in self.groups:
            return
        self._picture = None
        self.groups.pop(group, None)
        if traces:
            self.groups[group] = (traces, heading, faded)
        self._layer.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the traces and the legend.

        Dashes are dear, and during a drag they are old results that stay: drawn once, kept as a picture.
        """
        if not self.groups:
            return
        device = painter.device()
        ratio = device.devicePixelRatioF() if device is not None else 1.0
        state = (shown, self.theme, self.scale, ratio)
        if self._picture is None or self._drawn != state:
            self._picture, self._drawn = self._drawing(shown, ratio), state
        painter.drawPixmap(QPointF(0, 0), self._picture)

    def _drawing(self, shown: PixelMap, ratio: float) -> QPixmap:
        picture = QPixmap(QSize(ceil(shown.width * ratio), ceil(shown.height * ratio)))
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        rows: list[tuple[str, Trace | None, bool]] = []
        for traces, heading, faded in self.groups.values():
            rows.append((heading, None, faded))
            for trace in traces:
                pen = trace.look.pen(self.theme, _WIDTH * self.scale, _FADED if faded else 1.0)
                for points in trace.pieces:
                    draw_dashed(painter, pen, shown.points(points), shown.width, shown.height)
                rows.append((trace.label, trace, faded))
        self._paint_legend(painter, shown, rows)
        painter.end()
        return picture

    def _paint_legend(
        self, painter: QPainter, shown: PixelMap, rows: Sequence[tuple[str, Trace | None, bool]]
    ) -> None:
        font = QFont(self._font)
        font.setPointSizeF(self._font.pointSizeF() * self.scale)
        painter.setFont(font)
        row, sample, edge = _ROW * self.scale, _SAMPLE * self.scale, _EDGE * self.scale
        metrics = QFontMetricsF(font)
        widest = max(
            metrics.horizontalAdvance(text) + (sample + edge if trace else 0) for text, trace, _ in rows
        )
        box = QRectF(0, 0, widest + 2 * edge, len(rows) * row + edge)
        box.moveBottomRight(QPointF(shown.width - edge, shown.height - edge))
        surface = mix(self.theme.surface, self.theme.paper, 0.5)
        surface.setAlphaF(0.85)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(surface)
        painter.drawRoundedRect(box, 6, 6)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for place, (text, trace, faded) in enumerate(rows):
            line = QRectF(box.left() + edge, box.top() + edge / 2 + place * row, box.width() - 2 * edge, row)
            if trace is not None:
                painter.setPen(trace.look.pen(self.theme, _WIDTH * self.scale, _FADED if faded else 1.0))
                middle = line.center().y()
                painter.drawLine(QPointF(line.left(), middle), QPointF(line.left() + sample, middle))
                line.setLeft(line.left() + sample + edge)
            painter.setPen(self.theme.muted if trace is None or faded else self.theme.ink)
            painter.drawText(line, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft), text)
