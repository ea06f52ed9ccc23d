"""Signed weights as bars to the left and the right of zero, in the colours of the points."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from ...appearance.colours import point_colours
from ...appearance.theme import theme_of
from ...document.derivatives import DERIVATIVES
from ...qt.overrides import SafeOverrides
from ...view_model.analysis.wiggle import MOST_PULLS, Pull
from ...view_model.analysis.wording import short
from ...widgets.controls import named

_ROW = 19


class WeightBars(SafeOverrides, QWidget):
    """A bar for each datum that pulls, the strongest at the top."""

    def __init__(self) -> None:
        super().__init__()
        tip = "The weight of each point here: to the right it pulls, to the left it pushes away"
        named(self, "weightBars", "Weights of the points here", tip)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.pulls: Sequence[Pull] = ()
        self._count = 0

    def sizeHint(self) -> QSize:
        return QSize(260, _ROW * MOST_PULLS)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, _ROW * MOST_PULLS)

    def render_pulls(self, pulls: Sequence[Pull], count: int) -> None:
        """Show the weights of some of `count` points."""
        self.pulls, self._count = pulls, count
        self.setAccessibleDescription("; ".join(f"{_name(pull)}: {short(pull.weight)}" for pull in pulls))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        try:
            self._paint(painter)
        finally:
            painter.end()

    def _paint(self, painter: QPainter) -> None:
        if not self.pulls:
            return
        theme = theme_of(self.palette())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        metrics = self.fontMetrics()
        name = max(metrics.horizontalAdvance(_name(pull)) for pull in self.pulls) + 8.0
        value = max(metrics.horizontalAdvance(short(pull.weight)) for pull in self.pulls) + 8.0
        left, right = name, self.width() - value
        largest = max(abs(pull.weight) for pull in self.pulls) or 1.0
        low = min(0.0, *(pull.weight for pull in self.pulls)) / largest
        high = max(0.0, *(pull.weight for pull in self.pulls)) / largest
        unit = (right - left) / max(high - low, 1e-9)
        zero = left - low * unit
        colours = point_colours(max(self._count, 1), theme)
        for place, pull in enumerate(self.pulls):
            top = place * _ROW
            middle = Qt.AlignmentFlag.AlignVCenter
            painter.setPen(theme.ink)
            painter.drawText(
                QRectF(0, top, name, _ROW), int(middle | Qt.AlignmentFlag.AlignLeft), _name(pull)
            )
            painter.drawText(
                QRectF(right, top, value, _ROW), int(middle | Qt.AlignmentFlag.AlignRight), short(pull.weight)
            )
            end = zero + pull.weight / largest * unit
            painter.fillRect(
                QRectF(QPointF(zero, top + 4), QPointF(end, top + _ROW - 4)), colours[pull.point]
            )
        painter.setPen(QPen(theme.muted, 1.0))
        painter.drawLine(QPointF(zero, 0), QPointF(zero, len(self.pulls) * _ROW))


def _name(pull: Pull) -> str:
    return f"{DERIVATIVES[pull.order - 1].name if pull.order else 'point'} {pull.point}"
