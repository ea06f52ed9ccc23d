"""Many shapes drawn in one call, straight from an array."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QPainter, QPixmap

from curvecore.arrays import FloatArray

from .graphs import pg


class _Batch:
    """Many shapes of some numbers each, drawn in one call."""

    def __init__(
        self,
        shape: type[QLineF | QPointF | QRectF | QPainter.PixmapFragment],
        draw: Callable[..., None],
        numbers: int = 4,
    ) -> None:
        self._shapes, self._draw = pg.Qt.internals.PrimitiveArray(shape, numbers), draw
        # The room for shapes, and the first of them as Qt takes it: both stay until there must be more room.
        self._room: FloatArray = self._shapes.ndarray()
        self._first, self._count = None, 0

    def __len__(self) -> int:
        return self._count

    def fill(self, shapes: FloatArray) -> None:
        """Take shapes (m, numbers)."""
        self.room_for(len(shapes))[:] = shapes

    def room_for(self, count: int) -> FloatArray:
        """Return the array (count, numbers) of the shapes, to be filled."""
        if count > len(self._room):
            self._shapes.resize(count)
            self._room = self._shapes.ndarray()
            self._first, _ = self._shapes.drawargs()
        self._count = count
        return self._room[:count]

    def draw(self, painter: QPainter, *drawn_with: QPixmap) -> None:
        """Draw them with the painter's pen and brush; pictures, out of a sheet of them."""
        if self._count:
            self._draw(painter, self._first, self._count, *drawn_with)


class Segments(_Batch):
    """Many separate line segments, each x1, y1, x2, y2."""

    def __init__(self) -> None:
        super().__init__(QLineF, QPainter.drawLines)


class Points(_Batch):
    """Many points x, y, as wide as the pen."""

    def __init__(self) -> None:
        super().__init__(QPointF, QPainter.drawPoints, 2)


class Bars(_Batch):
    """Many rectangles x, y, width, height: of lines on whole pixels the quickest way."""

    def __init__(self) -> None:
        super().__init__(QRectF, QPainter.drawRects)


class Fragments(_Batch):
    """Many parts of a sheet of pictures, each of the ten numbers of Qt's `QPainter.PixmapFragment`."""

    def __init__(self) -> None:
        super().__init__(QPainter.PixmapFragment, QPainter.drawPixmapFragments, 10)
