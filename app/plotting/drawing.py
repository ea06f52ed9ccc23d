"""Drawing straight from arrays.

Why not ``drawPath``: with antialiasing Qt strokes a long path wider than one pixel as a whole, which costs
many times the time of the same path in short pieces. Numbers reach Qt as arrays, never one by one.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath, QPen, QPixmap, QPolygonF

from curvecore.arrays import BoolArray, FloatArray

from .graphs import pg
from .pixel_map import PixelMap


class _Batch:
    """Many shapes, each of several numbers, drawn in one call."""

    def __init__(
        self,
        shape: type[QLineF | QPointF | QRectF | QPainter.PixmapFragment],
        draw: Callable[..., None],
        numbers: int = 4,
    ) -> None:
        self._shapes, self._draw = pg.Qt.internals.PrimitiveArray(shape, numbers), draw
        # The array of shapes, and its first shape as a pointer for Qt: both stay until the array grows.
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
        """Draw the shapes with the painter's pen and brush, or as parts of a sheet of pictures."""
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
    """Many rectangles x, y, width, height: the fastest way to draw lines on whole pixels."""

    def __init__(self) -> None:
        super().__init__(QRectF, QPainter.drawRects)


class Fragments(_Batch):
    """Many parts of a sheet of pictures, each of the ten numbers of Qt's `QPainter.PixmapFragment`."""

    def __init__(self) -> None:
        super().__init__(QPainter.PixmapFragment, QPainter.drawPixmapFragments, 10)


_NEIGHBOURS, _REACH = 2, 1.0
"""Neighbours on either side of a segment, and the pixels within which they hide the gaps between them."""

_LINES, _CROSSINGS = 24, 60_000
"""Lines across the area at which neighbours are searched, and the largest number of crossings."""


class Crowd:
    """Separate segments that fill an area: those at its edge are drawn smoothly, the others without."""

    def __init__(self) -> None:
        self._inner, self._edges = Segments(), Segments()

    def __len__(self) -> int:
        return len(self._inner) + len(self._edges)

    def fill(self, segments: FloatArray, width: float, height: float) -> None:
        """Take segments (m, 4) in pixels, cut to an area."""
        inner = covered(segments, width, height)
        self._inner.fill(segments[inner])
        self._edges.fill(segments[~inner])

    def draw(self, painter: QPainter) -> None:
        """Draw with the painter's pen, but with flat caps: with others Qt makes each segment a path."""
        if not len(self):
            return
        pen, hints = painter.pen(), painter.renderHints()
        blunt = QPen(pen)
        blunt.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(blunt)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        self._inner.draw(painter)
        painter.setRenderHints(hints)
        self._edges.draw(painter)
        painter.setPen(pen)


def covered(segments: FloatArray, width: float, height: float) -> BoolArray:
    """Return which of segments (m, 4) have neighbours on both sides, judged along lines across the area."""
    is_steep = np.abs(segments[:, 3] - segments[:, 1]) >= np.abs(segments[:, 2] - segments[:, 0])
    result = np.zeros(len(segments), dtype=np.bool_)
    result[is_steep] = _have_neighbours(segments[is_steep], height)
    result[~is_steep] = _have_neighbours(segments[~is_steep][:, [1, 0, 3, 2]], width)
    return result


def _have_neighbours(segments: FloatArray, height: float) -> BoolArray:
    """Return which steep segments have neighbours left and right wherever horizontal lines cross them."""
    if not len(segments):
        return np.zeros(0, dtype=np.bool_)
    lines = min(_LINES, _CROSSINGS // len(segments))
    level = ((np.arange(lines) + 0.5) * (height / max(lines, 1)))[:, None]
    x1, y1, x2, y2 = segments.T
    is_crossed = ((level - y1) * (level - y2) <= 0) & (y1 != y2)
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.where(is_crossed, x1 + (level - y1) * ((x2 - x1) / (y2 - y1)), np.inf)
        order = np.argsort(x, axis=1)
        x = np.take_along_axis(x, order, axis=1)
        touches = x[:, _NEIGHBOURS:] - x[:, :-_NEIGHBOURS] <= _REACH
    sorted_ones, between = np.zeros_like(is_crossed), np.zeros_like(is_crossed)
    sorted_ones[:, _NEIGHBOURS:-_NEIGHBOURS] = touches[:, :-_NEIGHBOURS] & touches[:, _NEIGHBOURS:]
    np.put_along_axis(between, order, sorted_ones, axis=1)
    result: BoolArray = is_crossed.any(axis=0) & (between | ~is_crossed).all(axis=0)
    return result


_PIECE = 24
"""Segments in one piece of a stroke."""

_CROWD_FROM = 400
"""Number of segments from which a stroke may be a crowd."""

_CROWDED = 50_000.0
"""Length in pixels from which a stroke is a crowd, in which no single joint is visible."""

_FAR = 1e5

MARGIN = 50.0
"""Pixels beyond the area at which lines are cut, so that no cap or joint shows at the edge."""


def visible_segments(points: FloatArray, width: float, height: float) -> FloatArray:
    """Cut a polyline (k, 2) in pixels to its segments (m, 4) = x1, y1, x2, y2 near the visible area.

    Curves may reach 1e300 pixels; what is passed to Qt stays within the area and a small margin.
    """
    return cut_segments(np.hstack([points[:-1], points[1:]]), width, height)


def cut_segments(segments: FloatArray, width: float, height: float, margin: float = MARGIN) -> FloatArray:
    """Cut segments (m, 4) = x1, y1, x2, y2 in pixels to the visible area and a margin."""
    starts, ends = segments[:, :2], segments[:, 2:]
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    limit = np.array([width + margin, height + margin])
    near = np.all((high >= -margin) & (low <= limit), axis=1)
    segments = segments[near]
    is_long = np.any((segments < -margin) | (segments > np.tile(limit, 2)), axis=1)
    if is_long.any():
        is_visible = np.ones(len(segments), dtype=bool)
        segments[is_long], is_visible[is_long] = _clipped(segments[is_long], -margin, limit)
        segments = segments[is_visible]
    return segments


def _clipped(segments: FloatArray, low: float, limit: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Cut segments (m, 4) to the box from `low` to `limit`; return also which of them meet it.

    Liang and Barsky, ACM Transactions on Graphics 3 (1984) 1–22, from the nearer end: seen from 1e20
    pixels, all of the box is at one position.
    """
    is_reversed = np.abs(segments[:, :2]).max(axis=1) > np.abs(segments[:, 2:]).max(axis=1)
    segments = np.where(is_reversed[:, None], _turned(segments), segments)
    start, end = segments[:, :2], segments[:, 2:]
    # Halved, because the difference of two huge numbers must not overflow.
    half = end / 2 - start / 2
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        to_low = (low - start) / half / 2
        to_high = (limit - start) / half / 2
    inside = (start >= low) & (start <= limit)
    parallel = half == 0
    enter = np.where(parallel, np.where(inside, 0.0, np.inf), np.minimum(to_low, to_high))
    leave = np.where(parallel, np.where(inside, 1.0, -np.inf), np.maximum(to_low, to_high))
    first = np.clip(enter.max(axis=1), 0.0, 1.0)
    last = np.clip(leave.min(axis=1), 0.0, 1.0)
    meets = enter.max(axis=1) <= np.minimum(leave.min(axis=1), 1.0)
    cut = np.hstack([start + 2 * first[:, None] * half, start + 2 * last[:, None] * half])
    # Rounding at 1e300 may leave the box; the result must not.
    cut = np.clip(cut, low, np.tile(limit, 2))
    return np.where(is_reversed[:, None], _turned(cut), cut), meets & (leave.min(axis=1) >= 0)


def _turned(segments: FloatArray) -> FloatArray:
    """Return segments (m, 4) with starts and ends exchanged."""
    return np.roll(segments, 2, axis=1)


def is_near(x: float, y: float) -> bool:
    """Whether a pixel is near enough to the area for Qt to draw a mark there."""
    return abs(x) < _FAR and abs(y) < _FAR


class Stroke:
    """A polyline drawn in pieces, wide and smooth.

    Within a piece Qt joins the segments, so that no joint shows; the pieces are short, because the time Qt's
    stroker takes for one polyline grows faster than its length. A crowd, such as a polynomial that crosses
    the area a thousand times, is drawn as separate segments: without joints Qt takes a sixth of the time.

    Parameters
    ----------
    margin
        Pixels beyond the area at which the line is cut. Wide lines, with joints that are visible, are cut
        farther away and are never drawn as a crowd.
    """

    def __init__(self, margin: float = MARGIN) -> None:
        self._margin = margin
        self._pieces: list[QPolygonF] = []
        self._crowd, self._is_crowd = Crowd(), False
        self._polygons: dict[int, tuple[QPolygonF, FloatArray]] = {}
        self._source: tuple[FloatArray | None, PixelMap | None] = (None, None)

    def show(self, points: FloatArray, pixel_map: PixelMap) -> None:
        """Take a polyline (k, 2) of the plane, unless it is the same array in the same map as before."""
        if self._source[0] is not points or self._source[1] is not pixel_map:
            self._source = (points, pixel_map)
            self.fill(pixel_map.points(points), pixel_map.width, pixel_map.height)

    def fill(self, points: FloatArray, width: float, height: float) -> None:
        """Take the polyline (k, 2) in pixels; only its part near the area is drawn."""
        runs, crowd = _near(points, width, height, self._margin)
        if self._is_crowd or len(crowd):
            self._is_crowd = bool(len(crowd))
            self._crowd.fill(crowd, width, height)
        pieces = [run[i : i + _PIECE + 1] for run in runs for i in range(0, len(run) - 1, _PIECE)]
        self._pieces = [self._polygon(number, piece) for number, piece in enumerate(pieces)]

    def _polygon(self, number: int, vertices: FloatArray) -> QPolygonF:
        """Return a polygon; filling a cached one takes a third of the time of making one."""
        cached = self._polygons.get(number)
        if cached is None or len(cached[1]) != len(vertices):
            new_polygon: QPolygonF = pg.functions.create_qpolygonf(len(vertices))
            cached = self._polygons[number] = (new_polygon, pg.functions.ndarray_from_qpolygonf(new_polygon))
        cached[1][:] = vertices
        return cached[0]

    def draw(self, painter: QPainter) -> None:
        """Draw with the painter's pen."""
        for piece in self._pieces:
            painter.drawPolyline(piece)
        if self._is_crowd:
            self._crowd.draw(painter)


_NO_SEGMENTS = np.empty((0, 4))


def _near(
    points: FloatArray, width: float, height: float, margin: float
) -> tuple[list[FloatArray], FloatArray]:
    """Return the part near the area: runs of vertices (k, 2), or the segments (m, 4) of a crowd."""
    if len(points) < 2:
        return [], _NO_SEGMENTS
    limit = np.array([width + margin, height + margin])
    is_inside = bool(((points >= -margin) & (points <= limit)).all())
    if is_inside and len(points) <= _CROWD_FROM:
        return [points], _NO_SEGMENTS
    segments = cut_segments(np.hstack([points[:-1], points[1:]]), width, height, margin)
    if margin == MARGIN and is_crowd(segments):
        return [], segments
    return [points] if is_inside else runs_of(segments), _NO_SEGMENTS


def is_crowd(segments: FloatArray) -> bool:
    """Whether segments (m, 4) in pixels fill the area so densely that no joint is visible."""
    if len(segments) <= _CROWD_FROM:
        return False
    lengths = np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1])
    return float(lengths.sum()) > _CROWDED


def runs_of(segments: FloatArray) -> list[FloatArray]:
    """Return the vertices of segments (m, 4), split where they do not continue each other."""
    if not len(segments):
        return []
    breaks = np.flatnonzero(np.any(segments[1:, :2] != segments[:-1, 2:], axis=1)) + 1
    return [np.concatenate([run[:, :2], run[-1:, 2:]]) for run in np.split(segments, breaks)]


def thinned(points: FloatArray, tolerance: float) -> FloatArray:
    """Remove every second vertex of a polyline (k, 2) that is close to the middle of its neighbours."""
    off = np.abs(points[1:-1:2] - 0.5 * (points[:-2:2] + points[2::2]))
    is_kept = np.ones(len(points), dtype=bool)
    is_kept[1:-1:2] = np.maximum(off[:, 0], off[:, 1]) > tolerance
    return points[is_kept]


def draw_segments(painter: QPainter, segments: FloatArray, pixel_map: PixelMap) -> None:
    """Draw the part of segments (m, 4) in pixels near the area, with the painter's pen."""
    batch = Segments()
    batch.fill(cut_segments(segments, pixel_map.width, pixel_map.height))
    batch.draw(painter)


def polygon(x: FloatArray, y: FloatArray) -> QPolygonF:
    """Return a QPolygonF with the given coordinates."""
    result: QPolygonF = pg.functions.create_qpolygonf(len(x))
    # The array of an empty polygon cannot be written to.
    if len(x):
        view = pg.functions.ndarray_from_qpolygonf(result)
        view[:, 0] = x
        view[:, 1] = y
    return result


_FARTHEST = 1e150
"""Pixels to which vertices are limited, so that no difference of two overflows."""


def ring_within(points: FloatArray, width: float, height: float, margin: float) -> FloatArray:
    """Return the part of a closed polyline (k, 2) in pixels that lies within an area and a margin around it.

    Parts outside run along the edges, so that the winding numbers inside stay the same:
    Sutherland and Hodgman, Communications of the ACM 17 (1974) 32–42.
    """
    low, high = -margin, (width + margin, height + margin)
    if bool(((points >= low) & (points <= high)).all()):
        return points
    ring = np.clip(points, -_FARTHEST, _FARTHEST)
    for axis in (0, 1):
        ring = _beyond(ring, axis, low, 1.0)
        ring = _beyond(ring, axis, high[axis], -1.0)
    return ring


def _beyond(ring: FloatArray, axis: int, limit: float, sign: float) -> FloatArray:
    """Return the part of a ring on the side of a limit to which `sign` points."""
    if not len(ring):
        return ring
    distance = sign * (ring[:, axis] - limit)
    is_inside = distance >= 0
    if is_inside.all():
        return ring
    following, after = np.roll(ring, -1, axis=0), np.roll(distance, -1)
    crosses = is_inside != (after >= 0)
    share = distance[crosses] / (distance[crosses] - after[crosses])
    cut = ring[crosses] + share[:, None] * (following[crosses] - ring[crosses])
    cut[:, axis] = limit
    # Each vertex inside, followed by the crossing of the edge after it with the limit.
    count = is_inside.astype(np.intp) + crosses
    ends = np.cumsum(count)
    result = np.empty((int(ends[-1]), 2))
    result[ends[crosses] - 1] = cut
    result[(ends - count)[is_inside]] = ring[is_inside]
    return result


class AreaFill:
    """A translucent area, filled without waiting for Qt's threads.

    Qt hands translucent spans to a pool of threads and waits for them, which takes ten times as long when
    the machine is busy. It fills opaque spans at once: so the area is painted opaque into a picture, which is
    laid over the drawing and reused in the next frame.
    """

    def __init__(self) -> None:
        self._picture = QImage()

    def fill(self, painter: QPainter, path: QPainterPath, colour: QColor, room: QRectF) -> None:
        """Fill the part of `path` inside `room` (pixels of the painter)."""
        box = path.controlPointRect().adjusted(-1, -1, 1, 1).intersected(room).toAlignedRect()
        if box.isEmpty():
            return
        ratio = painter.device().devicePixelRatio()
        size = QRect(0, 0, math.ceil(box.width() * ratio), math.ceil(box.height() * ratio))
        self._prepare(size, ratio)
        inner = QPainter(self._picture)
        inner.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        inner.translate(-box.topLeft())
        opaque = QColor(colour)
        opaque.setAlphaF(1.0)
        inner.fillPath(path, opaque)
        inner.end()
        before = painter.opacity()
        painter.setOpacity(before * colour.alphaF())
        painter.drawImage(QRectF(box), self._picture, QRectF(size))
        painter.setOpacity(before)

    def _prepare(self, size: QRect, ratio: float) -> None:
        """Prepare an empty picture of at least this size."""
        if self._picture.width() < size.width() or self._picture.height() < size.height():
            self._picture = QImage(size.size(), QImage.Format.Format_ARGB32_Premultiplied)
        self._picture.setDevicePixelRatio(ratio)
        self._picture.fill(0)
