"""Many marks in one call: one for each colour is drawn once, then stamped."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from pyqtgraph.Qt.internals import PrimitiveArray
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from curvecore.arrays import FloatArray, IntArray

from ..appearance.colours import point_colours
from ..appearance.theme import Theme

_COLOURS = 256
"""Colours that are told apart; with more points, neighbours on the ramp share one."""

_COLUMNS = 16

_FEW, _PLACES = 64, 4
"""Colours up to which each mark is kept at so many places within a pixel, along x and y: an eye cannot tell
it from one drawn where it belongs. Of more, on whole pixels."""


class Stamps:
    """Marks in the colours of the points.

    Parameters
    ----------
    shape
        Draws one mark of a given radius around (0, 0), with the painter's pen and brush.
    """

    def __init__(self, shape: Callable[[QPainter, float], None]) -> None:
        self._shape = shape
        self._made_of: tuple[object, ...] = ()
        self._sheet = QPixmap()
        self._cell = 0
        self._fragments = PrimitiveArray(QPainter.PixmapFragment, 10)
        self._arguments = self._fragments.drawargs()
        # What the fragments were made for: under a drag most points stay where they are.
        self._places, self._indices = np.empty((0, 2)), np.empty(0, dtype=np.intp)

    def draw(
        self,
        painter: QPainter,
        places: FloatArray,
        indices: IntArray,
        count: int,
        theme: Theme,
        radius: float,
        rim: float,
    ) -> None:
        """Draw the marks of points `indices` of `count` at `places` (k, 2), in pixels, rimmed like paper."""
        ratio = painter.device().devicePixelRatioF()
        is_new = self._prepare(count, theme, radius, rim, ratio)
        if is_new or not (
            (indices is self._indices or np.array_equal(indices, self._indices))
            and places.tobytes() == self._places.tobytes()
        ):
            self._places, self._indices = places, indices
            self._fill(places, indices, count, ratio)
        fragments, length = self._arguments
        painter.drawPixmapFragments(fragments, length, self._sheet)

    def _fill(self, places: FloatArray, indices: IntArray, count: int, ratio: float) -> None:
        finer = _places_within_a_pixel(count)
        steps = np.floor(places * (ratio * finer) + 0.5).astype(np.intp)
        whole, within = np.divmod(steps, finer)
        cells = (cells_of(indices, count) * finer + within[:, 1]) * finer + within[:, 0]
        self._fragments.resize(len(indices))
        data = self._fragments.ndarray()
        data[:, :2] = whole / ratio
        data[:, 2] = cells % _COLUMNS * self._cell
        data[:, 3] = cells // _COLUMNS * self._cell
        data[:, 4:6] = self._cell
        data[:, 6:8] = 1.0 / ratio
        data[:, 8] = 0.0
        data[:, 9] = 1.0
        self._arguments = self._fragments.drawargs()

    def _prepare(self, count: int, theme: Theme, radius: float, rim: float, ratio: float) -> bool:
        """Have a sheet of the marks; return whether it is another one than before."""
        wanted = (count, theme, radius, rim, ratio)
        if wanted == self._made_of:
            return False
        self._made_of = wanted
        self._draw_sheet(min(count, _COLOURS), theme, radius, rim, ratio)
        return True

    def _draw_sheet(self, colours: int, theme: Theme, radius: float, rim: float, ratio: float) -> None:
        finer = _places_within_a_pixel(colours)
        # Even, so that whole pixels lie on whole pixels.
        self._cell = 2 * math.ceil((radius + rim) * ratio) + 4
        rows = -(-colours * finer * finer // _COLUMNS)
        self._sheet = QPixmap(_COLUMNS * self._cell, rows * self._cell)
        self._sheet.fill(Qt.GlobalColor.transparent)
        painter = QPainter(self._sheet)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(QPen(self._rim(theme), rim * ratio) if rim else Qt.PenStyle.NoPen)
        within = [(x / finer, y / finer) for y in range(finer) for x in range(finer)]
        for number, colour in enumerate(self._colours(colours, theme)):
            painter.setBrush(colour)
            for cell, (x, y) in enumerate(within, number * len(within)):
                left, top = cell % _COLUMNS * self._cell, cell // _COLUMNS * self._cell
                centre = QPointF(left + self._cell / 2 + x, top + self._cell / 2 + y)
                painter.translate(centre)
                self._shape(painter, radius * ratio)
                painter.translate(-centre)
        painter.end()

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return point_colours(count, theme)

    def _rim(self, theme: Theme) -> QColor:
        return theme.paper


class RingStamps(Stamps):
    """Marks of paper within a rim of the accent, all alike."""

    def draw_rings(
        self, painter: QPainter, places: FloatArray, theme: Theme, radius: float, rim: float
    ) -> None:
        """Draw rings at `places` (k, 2), in pixels."""
        self.draw(painter, places, np.zeros(len(places), dtype=np.intp), 1, theme, radius, rim)

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return [theme.paper] * count

    def _rim(self, theme: Theme) -> QColor:
        return theme.accent


def _places_within_a_pixel(count: int) -> int:
    return _PLACES if count <= _FEW else 1


def cells_of(indices: IntArray, count: int) -> IntArray:
    """Return which of at most 256 colours each point has; the lightness still alternates."""
    if count <= _COLOURS:
        return indices
    return indices * (_COLOURS // 2) // count * 2 + indices % 2
