"""Placing of a few words beside a point, where they cover least, and of numbers outside of the bend."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import msgspec
import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF

from curvecore.arrays import FloatArray

from ..document.model import Vector
from ..plotting.pixel_map import PixelMap
from ..plotting.plates import inside

_CORNERS = ((1, 1), (-1, 1), (1, -1), (-1, -1))
"""Right and below first; of corners that are as good as each other the first is taken, so that words rest."""

_NEAR = 200.0
"""Pixels around a point within which its words may lie."""

_COVERED_WORDS, _CUT_OFF = 200.0, 1000.0
"""Cost of words over other words, and of words beyond the edge, in pixels of curve covered."""


class Surroundings(msgspec.Struct, frozen=True, eq=False):
    """Surroundings to keep free, in pixels: line segments (k, 4) = x1, y1, x2, y2, and other words."""

    segments: FloatArray
    words: Sequence[QRectF] = ()


NOTHING = Surroundings(np.empty((0, 4)))


def segments_near(points: FloatArray, pixel: Vector, shown: PixelMap) -> FloatArray:
    """Return the segments (k, 4) in pixels of a polyline of the plane that come near a pixel."""
    (x, y), reach = shown.plane(*pixel), (_NEAR / shown.sx, _NEAR / shown.sy)
    here = np.array([x, y])
    starts, ends = points[:-1], points[1:]
    is_near = np.all(
        (np.minimum(starts, ends) < here + reach) & (np.maximum(starts, ends) > here - reach), axis=1
    )
    return np.hstack([shown.points(starts[is_near]), shown.points(ends[is_near])])


def number_box(centre: QPointF, length: int, scale: float) -> QRectF:
    """Return the room that a number of so many characters takes."""
    box = QRectF(0, 0, (7 * length + 4) * scale, 15 * scale)
    box.moveCenter(centre)
    return box


def free_corner(
    place: QPointF, size: QSizeF, gap: tuple[float, float], around: Surroundings, shown: PixelMap
) -> QRectF:
    """Return a box of some size on the corner of `place` where it covers least of what is around.

    Parameters
    ----------
    gap
        Pixels to the right or left, and above or below, that stay free.
    """
    boxes = [_on_corner(place, size, gap, *corner) for corner in _CORNERS]
    covered = covered_lengths(around.segments, boxes).tolist()
    for index, box in enumerate(boxes):
        covered[index] += _COVERED_WORDS * sum(box.intersects(each) for each in around.words)
        if box != inside(box.left(), box.top(), size, shown):
            covered[index] += _CUT_OFF
    best = boxes[covered.index(min(covered))]
    return inside(best.left(), best.top(), size, shown)


def _on_corner(place: QPointF, size: QSizeF, gap: tuple[float, float], right: int, down: int) -> QRectF:
    centre = place + QPointF(right * (gap[0] + size.width() / 2), down * (gap[1] + size.height() / 2))
    box = QRectF(0, 0, size.width(), size.height())
    box.moveCenter(centre)
    return box


def covered_lengths(segments: FloatArray, boxes: Sequence[QRectF | QRect]) -> FloatArray:
    """Return how many pixels of segments (k, 4) each of the boxes covers, (len(boxes),)."""
    low = np.array([(box.left(), box.top()) for box in boxes])[:, None]
    high = np.array([(box.right(), box.bottom()) for box in boxes])[:, None]
    start, way = segments[:, :2], segments[:, 2:] - segments[:, :2]
    # Along an axis a segment is parallel to two sides: it enters and leaves there as far away as can be.
    slope = np.where(way == 0, 1e-12, way)
    to_low, to_high = (low - start) / slope, (high - start) / slope
    enter = np.minimum(to_low, to_high).max(axis=2).clip(0.0, 1.0)
    leave = np.maximum(to_low, to_high).min(axis=2).clip(0.0, 1.0)
    lengths: FloatArray = np.maximum(leave - enter, 0.0) @ np.hypot(way[:, 0], way[:, 1])
    return lengths


def number_place(pixels: FloatArray, index: int, distance: float, beyond: float) -> QPointF:
    """Return the middle of a number: on the outer side of the bend, where the curve is not."""
    last = len(pixels) - 1
    around = [complex(*place) for place in pixels[max(index - 1, 0) : index + 2].tolist()]
    before, here, after = around[0], around[min(index, 1)], around[-1]
    outward = here - (before + after) / 2
    if 0 < index < last and abs(outward) > 2:
        outward /= abs(outward)
    else:
        outward = _beside(after - before)
    place = here + distance * outward
    return QPointF(place.real + beyond * outward.real, place.imag)


def _beside(direction: complex) -> complex:
    """Return the unit vector across `direction` (pixels) that points up; straight up without direction."""
    if direction == 0:
        return -1j
    across = direction * -1j / abs(direction)
    return -across if across.imag > 0 else across


class Taken:
    """Room that numbers take already."""

    def __init__(self) -> None:
        self._boxes: list[QRectF] = []

    def take(self, centres: Iterable[QPointF], size: QSizeF) -> QPointF | None:
        """Take the first of some places that is free, and return its middle; None where none is."""
        for centre in centres:
            box = QRectF(QPointF(), size)
            box.moveCenter(centre)
            if not any(map(box.intersects, self._boxes)):
                self._boxes.append(box)
                return centre
        return None
