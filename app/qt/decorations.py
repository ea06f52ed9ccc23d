"""Lines under and through letters, where their fonts want them; as thick as Inkscape has them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFont, QFontMetricsF, QPainterPath

from curvecore.arrays import FloatArray

from ..document.content import TextRun

_THICK: Final = (1 / 30, 1 / 10)
"""Shares of an em between which a line is thick."""


class Decoration(NamedTuple):
    """A line that goes with letters, in pixels of their font, y downwards from their baseline."""

    name: str
    box: QRectF

    @property
    def path(self) -> QPainterPath:
        """Its outline."""
        path = QPainterPath()
        path.addRect(self.box)
        return path

    @property
    def contour(self) -> FloatArray:
        """The same as cubic pieces (4, 4, 2), y upwards."""
        left, low, right, high = self.box.left(), -self.box.bottom(), self.box.right(), -self.box.top()
        corners = np.array([(left, low), (right, low), (right, high), (left, high), (left, low)])
        starts, ways = corners[:-1, None], np.diff(corners, axis=0)[:, None]
        made: FloatArray = starts + ways * np.linspace(0.0, 1.0, 4)[:, None]
        return made


def decorations_of(run: TextRun, font: QFont, left: float, width: float) -> Iterator[Decoration]:
    """Yield the lines that go with some of the letters of a run."""
    if not (run.underline or run.strike) or width <= 0:
        return
    metrics, em = QFontMetricsF(font), font.pixelSize()
    thick = min(max(metrics.lineWidth(), _THICK[0] * em), _THICK[1] * em)
    if run.underline:
        yield Decoration("underline", QRectF(left, metrics.underlinePos(), width, thick))
    if run.strike:
        yield Decoration("strike", QRectF(left, -metrics.strikeOutPos() - thick / 2, width, thick))
