"""Curves drawn beside the curve: how each looks, here and in its row of a table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap

from app.colours import CURVE_COLOURS, curve_colour
from app.plot.drawing import polygon, visible_segments
from app.theme import Theme
from app.view_model.analysis.laboratory_settings import Calculation

Floats = npt.NDArray[np.float64]

_PIECE = 24


@dataclass(frozen=True)
class Look:
    """A colour and a dash.

    Attributes
    ----------
    colour
        One of `app.colours.CURVE_COLOURS`; empty for the accent of the theme.
    dashes
        Lengths of lines and gaps, in widths of the line; empty for a solid line.
    """

    colour: str
    dashes: tuple[float, ...] = ()

    def pen(self, theme: Theme, width: float, opacity: float = 1.0) -> QPen:
        """Return the pen that draws it."""
        colour = QColor(curve_colour(self.colour, theme) if self.colour else theme.accent)
        colour.setAlphaF(opacity)
        pen = QPen(colour, width)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        if self.dashes:
            pen.setDashPattern(self.dashes)
        return pen

    def swatch(self, theme: Theme) -> QIcon:
        """Return a short line of this look."""
        pixmap = QPixmap(52, 24)
        pixmap.setDevicePixelRatio(2)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setPen(self.pen(theme, 2.0))
        painter.drawLine(0, 6, 26, 6)
        painter.end()
        return QIcon(pixmap)


METHOD_NAMES = {
    Calculation.MONOMIAL: "Monomials",
    Calculation.NEWTON: "Newton",
    Calculation.LAGRANGE: "Lagrange",
    Calculation.BARYCENTRIC: "Barycentric",
    Calculation.BASIS: "Hermite basis",
}
METHOD_LOOKS = {
    Calculation.MONOMIAL: Look(CURVE_COLOURS["Vermillion"], (5, 2)),
    Calculation.NEWTON: Look(CURVE_COLOURS["Reddish purple"], (6, 2, 1, 2)),
    Calculation.LAGRANGE: Look(CURVE_COLOURS["Blue"], (2, 2)),
    Calculation.BARYCENTRIC: Look(CURVE_COLOURS["Bluish green"], (1, 1.5)),
    Calculation.BASIS: Look(CURVE_COLOURS["Blue"], (2, 2)),
}
CURE_LOOK = Look("", (4, 3))


@dataclass(frozen=True, eq=False)
class Trace:
    """A curve as polylines (k, 2), in the plane, with its look and its name."""

    pieces: Sequence[Floats]
    look: Look
    label: str


def draw_dashed(painter: QPainter, pen: QPen, pixels: Floats, width: float, height: float) -> None:
    """Draw a polyline (k, 2) in pixels, of which only what lies near the area is drawn.

    In short pieces, as `app.plot.drawing.Stroke` does, but the dashes run on from one to the next.
    """
    segments = visible_segments(pixels, width, height)
    if not len(segments):
        return
    run = np.concatenate(
        [[0.0], np.cumsum(np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]))]
    )
    breaks = np.flatnonzero(np.any(segments[1:, :2] != segments[:-1, 2:], axis=1)) + 1
    cuts = np.unique(np.concatenate([breaks, np.arange(0, len(segments), _PIECE), [len(segments)]])).tolist()
    for start, end in pairwise(cuts):
        pen.setDashOffset(float(run[start]) / pen.widthF())
        painter.setPen(pen)
        x = np.append(segments[start:end, 0], segments[end - 1, 2])
        y = np.append(segments[start:end, 1], segments[end - 1, 3])
        painter.drawPolyline(polygon(x, y))
