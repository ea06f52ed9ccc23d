"""Axes of a plot, beside the view box."""

from __future__ import annotations

from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtGui import QColor, QFont
from PySide6.QtWidgets import QGraphicsGridLayout, QGraphicsWidget

from ..appearance.theme import Theme
from ..document.words import with_minus

_WIDTH = 46


class _Axis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
    """An axis with a true minus, and without a label: pyqtgraph would lay it out for every pen and range."""

    def labelString(self) -> str:  # noqa: N802
        return ""

    def tickStrings(self, values: Sequence[float], scale: float, spacing: float) -> list[str]:  # noqa: N802
        return [with_minus(text) for text in super().tickStrings(values, scale, spacing)]


class Axes:
    """The left and the lower axis of a view box.

    pyqtgraph's PlotItem has them too, and half of the time it takes to build goes into menus, a title
    and two more axes that are never shown.

    Attributes
    ----------
    frame
        Holds axes and view box.
    """

    def __init__(self, box: pg.ViewBox) -> None:
        self._by_side = {side: _Axis(side) for side in ("left", "bottom")}
        self.frame = QGraphicsWidget()
        grid = QGraphicsGridLayout(self.frame)
        grid.setContentsMargins(1, 1, 1, 1)
        grid.setSpacing(0)
        grid.addItem(self._by_side["left"], 0, 0)
        grid.addItem(box, 0, 1)
        grid.addItem(self._by_side["bottom"], 1, 1)
        grid.setRowStretchFactor(0, 1)
        grid.setColumnStretchFactor(1, 1)
        for axis in self._by_side.values():
            axis.linkToView(box)
            # Above what the view box paints.
            axis.setZValue(0.5)
            # There is no unit to put a prefix to, but pyqtgraph would lay its label out at every new range.
            axis.enableAutoSIPrefix(False)
            axis.setStyle(tickLength=5, tickTextOffset=4, hideOverlappingLabels=True)

    def __getitem__(self, side: str) -> pg.AxisItem:
        """Return the axis "left" or "bottom"."""
        return self._by_side[side]

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        for axis in self._by_side.values():
            axis.setPen(QColor(theme.grid_coarse))
            axis.setTextPen(QColor(theme.muted))

    def set_scale(self, font: QFont, scale: float) -> None:
        """Write numbers a little smaller than in `font`, times `scale`."""
        small = QFont(font)
        small.setPointSizeF(max(font.pointSizeF() - 1.5, 7.0) * scale)
        for axis in self._by_side.values():
            axis.setTickFont(small)
        # The left axes of all plots have one width: they stay aligned, and nothing jumps when numbers grow.
        self._by_side["left"].setWidth(_WIDTH * scale)
