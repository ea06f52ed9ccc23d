"""The points at rest, all in one call: in the colours of their indices, or plain."""

from __future__ import annotations

from typing import Final

import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray, IntArray

from ..appearance.theme import Theme
from ..plotting.stamps import RingStamps, Stamps
from ..view_model.points.point_kinds import POINT_KINDS
from .point_density import Discs
from .point_marks import REACH, paint_mark

PLAIN_RIM: Final = 1.5
"""Pixels of the line around a plain mark; small ones have a finer line."""

_FINE_RIM = 1.0
_KINDS: Final[IntArray] = np.arange(len(POINT_KINDS))


class PointStamps:
    """Marks of points by their kinds.

    Those of a plain look are paper in a rim of the accent: which point is which is nothing that a person who
    draws asks.
    """

    def __init__(self) -> None:
        self._theme: Theme | None = None
        self._coloured = Stamps(self._paint_coloured, REACH)
        self._plain = RingStamps(_paint_plain, REACH)

    def draw(
        self,
        painter: QPainter,
        pixels: FloatArray,
        calm: IntArray,
        kinds: IntArray,
        theme: Theme,
        discs: Discs,
        *,
        is_plain: bool,
    ) -> None:
        """Draw the `calm` ones of points at `pixels` (n, 2), of these `kinds` (n,)."""
        self._theme = theme
        if not is_plain:
            self._coloured.draw(
                painter, pixels[calm], calm, len(pixels), theme, discs.radius, discs.rim, kinds
            )
            return
        rim = PLAIN_RIM if discs.rim else _FINE_RIM
        self._plain.draw(
            painter, pixels[calm], kinds[calm], len(POINT_KINDS), theme, discs.radius, rim, _KINDS
        )

    def _paint_coloured(self, painter: QPainter, radius: float, kind: int) -> None:
        assert self._theme is not None
        paint_mark(painter, QPointF(0.0, 0.0), radius, kind, self._theme.paper)


def _paint_plain(painter: QPainter, radius: float, kind: int) -> None:
    paint_mark(painter, QPointF(0.0, 0.0), radius, kind)
