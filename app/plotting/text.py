"""Text on a plot: fonts, plates of paper, letters with a halo, and free places beside a point."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import msgspec
import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPainterPath, QPen, QPixmap

from curvecore.arrays import FloatArray

from ..document.model import Vector
from .pixel_map import PixelMap
from .stamps import transparent


class Sizes:
    """A font in several sizes."""

    def __init__(self, font: QFont) -> None:
        self._font = QFont(font)
        self._known: dict[float, QFont] = {}

    def at(self, points: float) -> QFont:
        """Return the font in a size given in points."""
        if points not in self._known:
            font = QFont(self._font)
            font.setPointSizeF(points)
            self._known[points] = font
        return self._known[points]

    def times(self, factor: float) -> QFont:
        """Return the font larger by a factor."""
        return self.at(self._font.pointSizeF() * factor)

    def less(self, points: float, scale: float) -> QFont:
        """Return the font smaller by some points, but legible, times a scale."""
        return self.at(max(self._font.pointSizeF() - points, _SMALLEST) * scale)


_SMALLEST = 7.0
"""Smallest font size in points that can be read from the last row."""


_EDGE = 4.0

_GAP = 1.0
"""Pixels between plates that lie above one another."""


def size_of(painter: QPainter, text: str, across: float = 10.0, down: float = 4.0) -> QSizeF:
    """Return the size of a plate for text in the painter's font, with these pixels of padding in all."""
    metrics = QFontMetricsF(painter.font())
    return QSizeF(metrics.horizontalAdvance(text) + across, metrics.height() + down)


def inside(left: float, top: float, size: QSizeF, pixel_map: PixelMap) -> QRectF:
    """Return a box of some size at a position, moved so far that it lies in the drawing."""
    left = min(max(left, _EDGE), max(pixel_map.width - size.width() - _EDGE, _EDGE))
    top = min(max(top, _EDGE), max(pixel_map.height - size.height() - _EDGE, _EDGE))
    return QRectF(left, top, size.width(), size.height())


def clear_of(others: Sequence[QRectF], plate: QRectF) -> QRectF:
    """Return a plate moved up or down past the others that it would cover, away from the first of them."""
    plate, side = QRectF(plate), 0
    while covered := [other for other in others if plate.intersects(other)]:
        side = side or (1 if plate.center().y() >= covered[0].center().y() else -1)
        # Without a gap, rounding might make it cover the same plate again.
        plate.moveTop(
            max(other.bottom() for other in covered) + _GAP
            if side > 0
            else min(other.top() for other in covered) - plate.height() - _GAP
        )
    return plate


def beyond(
    position: QPointF, directions: Sequence[QPointF], gap: float, size: QSizeF, pixel_map: PixelMap
) -> QRectF:
    """Return a box of some size whose nearest side is `gap` pixels from a position.

    It lies in the first of the `directions` in which it does not leave the drawing.
    """
    for direction in directions:
        length = math.hypot(direction.x(), direction.y())
        dx, dy = (direction.x() / length, direction.y() / length) if length > 1 else (0.0, -1.0)
        distance = gap + abs(dx) * size.width() / 2 + abs(dy) * size.height() / 2
        box = QRectF(0, 0, size.width(), size.height())
        box.moveCenter(position + QPointF(dx * distance, dy * distance))
        if box == inside(box.left(), box.top(), size, pixel_map):
            return box
    return inside(position.x() + gap, position.y() + gap, size, pixel_map)


def write_on_plate(painter: QPainter, plate: QRectF, text: str, paper: QColor, ink: QColor) -> None:
    """Write text in the middle of a plate of translucent paper."""
    paper = QColor(paper)
    paper.setAlphaF(0.85)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(paper)
    painter.drawRoundedRect(plate, 4, 4)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(ink)
    painter.drawText(plate, int(Qt.AlignmentFlag.AlignCenter), text)


def write_in_corner(painter: QPainter, text: str, paper: QColor, ink: QColor) -> None:
    """Write text on a plate in the lower left corner of the painted area."""
    plate = QRectF(QPointF(0, 0), size_of(painter, text))
    plate.moveBottomLeft(painter.clipBoundingRect().bottomLeft() + QPointF(6, -6))
    write_on_plate(painter, plate, text, paper, ink)


class Halo:
    """Text with a halo; the last text is cached as a picture.

    Stroking the outlines of a few letters takes a millisecond, and a text stays the same for many frames.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._picture = QPixmap()

    def write(
        self, painter: QPainter, box: QRectF, text: str, paper: QColor, ink: QColor, width: float
    ) -> None:
        """Write text in the middle of a box, with `width` pixels of paper on either side of each line."""
        ratio = painter.device().devicePixelRatioF()
        key = (text, painter.font().key(), paper.rgba(), ink.rgba(), width, ratio, box.size())
        if key != self._key:
            self._key = key
            size = box.adjusted(-width, -width, width, width).size()
            self._picture = with_halo(painter, size, text, paper, ink, width)
        # On whole pixels, where letters are sharp.
        painter.drawPixmap(QPointF(round(box.left() - width), round(box.top() - width)), self._picture)


def with_halo(
    painter: QPainter, size: QSizeF, text: str, paper: QColor, ink: QColor, width: float
) -> QPixmap:
    """Return a picture of text with a halo, in the painter's font and for its device."""
    across, down = size.width(), size.height()
    picture = transparent(across, down, painter.device().devicePixelRatioF())
    metrics = QFontMetricsF(painter.font())
    start = QPointF(
        round((across - metrics.horizontalAdvance(text)) / 2),
        round((down + metrics.ascent() - metrics.descent()) / 2),
    )
    letters = QPainterPath()
    letters.addText(start, painter.font(), text)
    halo = QPen(paper, 2 * width)
    halo.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    drawing = QPainter(picture)
    drawing.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    drawing.strokePath(letters, halo)
    drawing.setFont(painter.font())
    drawing.setPen(ink)
    drawing.drawText(start, text)
    drawing.end()
    return picture


_CORNERS = ((1, 1), (-1, 1), (1, -1), (-1, -1))
"""Right and below first: of equally good corners the first is used, so that labels stay where they are."""

_NEAR = 200.0
"""Pixels around a point within which its label may lie."""

_COVERED_WORDS, _CUT_OFF = 200.0, 1000.0
"""Cost of a label over another label, and beyond the edge, in pixels of covered curve."""


class Surroundings(msgspec.Struct, frozen=True, eq=False):
    """Surroundings to keep free, in pixels: line segments (k, 4) = x1, y1, x2, y2, and other labels."""

    segments: FloatArray
    labels: Sequence[QRectF] = ()


NOTHING = Surroundings(np.empty((0, 4)))


def segments_near(points: FloatArray, pixel: Vector, pixel_map: PixelMap) -> FloatArray:
    """Return the segments (k, 4) in pixels of a polyline of the plane that come near a pixel."""
    (x, y), reach = pixel_map.plane(*pixel), (_NEAR / pixel_map.sx, _NEAR / pixel_map.sy)
    centre = np.array([x, y])
    starts, ends = points[:-1], points[1:]
    is_near = np.all(
        (np.minimum(starts, ends) < centre + reach) & (np.maximum(starts, ends) > centre - reach), axis=1
    )
    return np.hstack([pixel_map.points(starts[is_near]), pixel_map.points(ends[is_near])])


def number_box(centre: QPointF, length: int, scale: float) -> QRectF:
    """Return the box of a number of some characters."""
    box = QRectF(0, 0, (7 * length + 4) * scale, 15 * scale)
    box.moveCenter(centre)
    return box


def free_corner(
    position: QPointF, size: QSizeF, gap: tuple[float, float], surroundings: Surroundings, pixel_map: PixelMap
) -> QRectF:
    """Return a box of some size at the corner of `position` where it covers least of its surroundings.

    Parameters
    ----------
    gap
        Pixels to the right or left, and above or below, that stay free.
    """
    boxes = [_box_at_corner(position, size, gap, *corner) for corner in _CORNERS]
    covered = covered_lengths(surroundings.segments, boxes).tolist()
    for index, box in enumerate(boxes):
        covered[index] += _COVERED_WORDS * sum(box.intersects(label) for label in surroundings.labels)
        if box != inside(box.left(), box.top(), size, pixel_map):
            covered[index] += _CUT_OFF
    best = boxes[covered.index(min(covered))]
    return inside(best.left(), best.top(), size, pixel_map)


def _box_at_corner(
    position: QPointF, size: QSizeF, gap: tuple[float, float], right: int, down: int
) -> QRectF:
    centre = position + QPointF(right * (gap[0] + size.width() / 2), down * (gap[1] + size.height() / 2))
    box = QRectF(0, 0, size.width(), size.height())
    box.moveCenter(centre)
    return box


def covered_lengths(segments: FloatArray, boxes: Sequence[QRectF | QRect]) -> FloatArray:
    """Return the length of the segments (k, 4) inside each box, (len(boxes),), in pixels."""
    low = np.array([(box.left(), box.top()) for box in boxes])[:, None]
    high = np.array([(box.right(), box.bottom()) for box in boxes])[:, None]
    start, offset = segments[:, :2], segments[:, 2:] - segments[:, :2]
    # A segment along an axis is parallel to two sides, and meets them far away instead of at infinity.
    slope = np.where(offset == 0, 1e-12, offset)
    to_low, to_high = (low - start) / slope, (high - start) / slope
    enter = np.minimum(to_low, to_high).max(axis=2).clip(0.0, 1.0)
    leave = np.maximum(to_low, to_high).min(axis=2).clip(0.0, 1.0)
    lengths: FloatArray = np.maximum(leave - enter, 0.0) @ np.hypot(offset[:, 0], offset[:, 1])
    return lengths


def number_position(pixels: FloatArray, index: int, distance: float, beyond: float) -> QPointF:
    """Return the centre of the number of a point: on the outer side of the bend, clear of the curve."""
    last = len(pixels) - 1
    neighbours = [complex(*pixel) for pixel in pixels[max(index - 1, 0) : index + 2].tolist()]
    before, point, after = neighbours[0], neighbours[min(index, 1)], neighbours[-1]
    outward = point - (before + after) / 2
    if 0 < index < last and abs(outward) > 2:
        outward /= abs(outward)
    else:
        outward = _beside(after - before)
    centre = point + distance * outward
    return QPointF(centre.real + beyond * outward.real, centre.imag)


def _beside(direction: complex) -> complex:
    """Return the unit vector across `direction` (pixels) that points up; straight up without direction."""
    if direction == 0:
        return -1j
    across = direction * -1j / abs(direction)
    return -across if across.imag > 0 else across


class OccupiedRoom:
    """Boxes that labels occupy already."""

    def __init__(self) -> None:
        self._boxes: list[QRectF] = []

    def reserve(self, centres: Iterable[QPointF], size: QSizeF) -> QPointF | None:
        """Occupy the first free one of some centres and return it; None where none is free."""
        for centre in centres:
            box = QRectF(QPointF(), size)
            box.moveCenter(centre)
            if not any(map(box.intersects, self._boxes)):
                self._boxes.append(box)
                return centre
        return None
