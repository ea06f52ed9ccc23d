"""Many shapes drawn in one call, straight from an array."""

from __future__ import annotations

from collections.abc import Callable

from pyqtgraph.Qt.internals import PrimitiveArray
from PySide6.QtCore import QLineF, QRectF
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray


class _Batch:
    """Many shapes of four numbers each, drawn in one call with the painter's pen and brush."""

    def __init__(self, shape: type[QLineF | QRectF], draw: Callable[..., None]) -> None:
        self._shapes, self._draw = PrimitiveArray(shape, 4), draw

    def __len__(self) -> int:
        return len(self._shapes)

    def fill(self, shapes: FloatArray) -> None:
        """Take shapes (m, 4)."""
        self._shapes.resize(len(shapes))
        self._shapes.ndarray()[:] = shapes

    def draw(self, painter: QPainter) -> None:
        """Draw them."""
        if len(self._shapes):
            self._draw(painter, *self._shapes.drawargs())


class Segments(_Batch):
    """Many separate line segments, each x1, y1, x2, y2."""

    def __init__(self) -> None:
        super().__init__(QLineF, QPainter.drawLines)


class Bars(_Batch):
    """Many rectangles x, y, width, height: of lines on whole pixels the quickest way."""

    def __init__(self) -> None:
        super().__init__(QRectF, QPainter.drawRects)
