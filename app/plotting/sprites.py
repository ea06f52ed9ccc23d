"""Marks of many looks, a few of each: every look is drawn once, then stamped in one call for all."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable
from typing import Generic, TypeAlias, TypeVar

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPixmap

from .segments import Fragments

_PLACES = 4
"""A mark is kept at so many places within a pixel, along x and y: an eye cannot tell it from one drawn where
it belongs."""

_CELLS = _PLACES * _PLACES

_LOOKS = 32
"""Looks that are kept; when there are more, all are drawn anew as they are asked for."""

Look = TypeVar("Look", bound=Hashable)

Mark: TypeAlias = tuple[Look, float, float]
"""A look, and the pixels x and y of its middle."""


class Sprites(Generic[Look]):
    """Marks that are stamped.

    Parameters
    ----------
    paint
        Draws the mark of a look around (0, 0).
    reach
        How far marks reach, in pixels.
    """

    def __init__(self, paint: Callable[[QPainter, Look], None], reach: float) -> None:
        self._paint, self._reach = paint, reach
        self._fragments = Fragments()
        self._sheet = QPixmap()
        self._ratio, self._side = 0.0, 0
        # The row of the sheet that each look has.
        self._rows: dict[Look, int] = {}

    def draw(self, painter: QPainter, marks: Iterable[Mark[Look]]) -> None:
        """Draw marks."""
        ratio = painter.device().devicePixelRatioF()
        if ratio != self._ratio:
            self._ratio, self._side = ratio, 2 * math.ceil(self._reach * ratio) + 4
            self._rows = {}
        side, finer, fragments = self._side, ratio * _PLACES, []
        for look, x, y in marks:
            row = self._rows.get(look)
            if row is None:
                row = self._add(look)
            left, across = divmod(math.floor(x * finer + 0.5), _PLACES)
            top, down = divmod(math.floor(y * finer + 0.5), _PLACES)
            cell = (down * _PLACES + across) * side
            fragments.append(
                (left / ratio, top / ratio, cell, row * side, side, side, 1 / ratio, 1 / ratio, 0, 1)
            )
        if fragments:
            self._fragments.room_for(len(fragments))[:] = fragments
            self._fragments.draw(painter, self._sheet)

    def _add(self, look: Look) -> int:
        """Draw a look on the sheet, at each place within a pixel; return its row."""
        if not self._rows or len(self._rows) == _LOOKS:
            self._rows = {}
            self._sheet = QPixmap(_CELLS * self._side, _LOOKS * self._side)
            self._sheet.fill(Qt.GlobalColor.transparent)
        row = self._rows[look] = len(self._rows)
        with QPainter(self._sheet) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            for cell in range(_CELLS):
                down, across = divmod(cell, _PLACES)
                corner = QPointF((cell + 0.5) * self._side, (row + 0.5) * self._side)
                painter.save()
                painter.translate(corner + QPointF(across, down) / _PLACES)
                painter.scale(self._ratio, self._ratio)
                self._paint(painter, look)
                painter.restore()
        return row
