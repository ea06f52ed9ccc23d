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


_NEIGHBOURS, _REACH = 2, 1.0
"""Neighbours on either side of a stroke that must lie within so many pixels: nothing is seen between them."""

_LINES, _CROSSINGS = 24, 60_000
"""Lines across the area at which neighbours are sought; crossings of lines and strokes, at most."""


class Crowd:
    """Separate segments in two calls: those at an edge of what they fill are smoothed, which takes longer."""

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
        """Draw with the painter's pen, but with blunt ends: with others each would be made a path."""
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
    """Return which of segments (m, 4) lie between others, as far as lines across the area show."""
    is_steep = np.abs(segments[:, 3] - segments[:, 1]) >= np.abs(segments[:, 2] - segments[:, 0])
    result = np.zeros(len(segments), dtype=np.bool_)
    result[is_steep] = _have_neighbours(segments[is_steep], height)
    result[~is_steep] = _have_neighbours(segments[~is_steep][:, [1, 0, 3, 2]], width)
    return result


def _have_neighbours(segments: FloatArray, height: float) -> BoolArray:
    """Return which steep segments have neighbours left and right wherever level lines cross them."""
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
"""Segments among which a stroke may be a crowd."""

_CROWDED = 50_000.0
"""Pixels of line that are a crowd: where they fill the area, one joint cannot be told from the next."""

_FAR = 1e5

MARGIN = 50.0
"""Pixels beyond the area to which lines are cut, so that no cap or joint shows at the edge."""


def visible_segments(points: FloatArray, width: float, height: float) -> FloatArray:
    """Cut a polyline (k, 2) in pixels to its segments (m, 4) = x1, y1, x2, y2 near the visible area.

    Curves may reach 1e300 pixels; what is passed to Qt stays within the area and a small margin.
    """
    return cut_segments(np.hstack([points[:-1], points[1:]]), width, height)


def cut_segments(segments: FloatArray, width: float, height: float, margin: float = MARGIN) -> FloatArray:
    """Cut segments (m, 4) = x1, y1, x2, y2 in pixels to what lies near the visible area, as above."""
    starts, ends = segments[:, :2], segments[:, 2:]
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    limit = np.array([width + margin, height + margin])
    near = np.all((high >= -margin) & (low <= limit), axis=1)
    segments = segments[near]
    is_long = np.any((segments < -margin) | (segments > np.tile(limit, 2)), axis=1)
    if is_long.any():
        kept = np.ones(len(segments), dtype=bool)
        segments[is_long], kept[is_long] = _clipped(segments[is_long], -margin, limit)
        segments = segments[kept]
    return segments


def _clipped(segments: FloatArray, low: float, limit: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Cut segments (m, 4) to the box from `low` to `limit`, and tell which of them meet it.

    Liang and Barsky, ACM Transactions on Graphics 3 (1984) 1–22, from the end that is nearer: seen from one
    at 1e20 pixels, all that lies in the box is at one place.
    """
    comes = np.abs(segments[:, :2]).max(axis=1) > np.abs(segments[:, 2:]).max(axis=1)
    segments = np.where(comes[:, None], _turned(segments), segments)
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
    # Rounding at 1e300 may leave the box; what is left of it must not.
    cut = np.clip(cut, low, np.tile(limit, 2))
    return np.where(comes[:, None], _turned(cut), cut), meets & (leave.min(axis=1) >= 0)


def _turned(segments: FloatArray) -> FloatArray:
    """Return segments (m, 4) from their ends to their starts."""
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
        Pixels beyond the area to which it is cut; one cut farther away is so wide that its joints are seen,
        and is never drawn as a crowd.
    """

    def __init__(self, margin: float = MARGIN) -> None:
        self._margin = margin
        self._pieces: list[QPolygonF] = []
        self._crowd, self._is_crowd = Crowd(), False
        self._made: dict[int, tuple[QPolygonF, FloatArray]] = {}
        self._shown: tuple[FloatArray | None, PixelMap | None] = (None, None)

    def show(self, points: FloatArray, pixel_map: PixelMap) -> None:
        """Take a polyline (k, 2) of the plane, unless it is the very one that was shown so before."""
        if self._shown[0] is not points or self._shown[1] is not pixel_map:
            self._shown = (points, pixel_map)
            self.fill(pixel_map.points(points), pixel_map.width, pixel_map.height)

    def fill(self, points: FloatArray, width: float, height: float) -> None:
        """Take the polyline (k, 2) in pixels, of which only what lies near the area will be drawn."""
        runs, crowd = _near(points, width, height, self._margin)
        if self._is_crowd or len(crowd):
            self._is_crowd = bool(len(crowd))
            self._crowd.fill(crowd, width, height)
        pieces = [run[i : i + _PIECE + 1] for run in runs for i in range(0, len(run) - 1, _PIECE)]
        self._pieces = [self._polygon(number, piece) for number, piece in enumerate(pieces)]

    def _polygon(self, number: int, vertices: FloatArray) -> QPolygonF:
        """Return a polygon; filling one that was made before takes a third of the time of making one."""
        made = self._made.get(number)
        if made is None or len(made[1]) != len(vertices):
            fresh: QPolygonF = pg.functions.create_qpolygonf(len(vertices))
            made = self._made[number] = (fresh, pg.functions.ndarray_from_qpolygonf(fresh))
        made[1][:] = vertices
        return made[0]

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
    """Return what lies near the area: vertices (k, 2) from end to end, or the segments (m, 4) of a crowd."""
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
    """Whether so many segments (m, 4), in pixels, fill the area that no joint can be told."""
    return len(segments) > _CROWD_FROM and _length(segments) > _CROWDED


def _length(segments: FloatArray) -> float:
    """Return the length of all segments (m, 4) together."""
    return float(np.hypot(segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]).sum())


def runs_of(segments: FloatArray) -> list[FloatArray]:
    """Return the vertices of segments (m, 4), split where they do not continue each other."""
    if not len(segments):
        return []
    breaks = np.flatnonzero(np.any(segments[1:, :2] != segments[:-1, 2:], axis=1)) + 1
    return [np.concatenate([run[:, :2], run[-1:, 2:]]) for run in np.split(segments, breaks)]


def thinned(points: FloatArray, tolerance: float) -> FloatArray:
    """Leave out every other vertex of a polyline (k, 2) that is so close to the middle of its neighbours."""
    off = np.abs(points[1:-1:2] - 0.5 * (points[:-2:2] + points[2::2]))
    kept = np.ones(len(points), dtype=bool)
    kept[1:-1:2] = np.maximum(off[:, 0], off[:, 1]) > tolerance
    return points[kept]


def draw_segments(painter: QPainter, segments: FloatArray, pixel_map: PixelMap) -> None:
    """Draw what lies near the area of segments (m, 4) in pixels, with the painter's pen."""
    drawn = Segments()
    drawn.fill(cut_segments(segments, pixel_map.width, pixel_map.height))
    drawn.draw(painter)


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
"""Pixels beyond which a vertex is drawn nearer, so that no difference of two overflows."""


def ring_within(points: FloatArray, width: float, height: float, margin: float) -> FloatArray:
    """Return the part of a closed polyline (k, 2) in pixels that lies within an area and a margin around it.

    What lies outside is led along the edges, so that inside everything is wound about as often as before:
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
    # Each vertex that is kept, and after it the place where the edge from it crosses the limit.
    count = is_inside.astype(np.intp) + crosses
    ends = np.cumsum(count)
    result = np.empty((int(ends[-1]), 2))
    result[ends[crosses] - 1] = cut
    result[(ends - count)[is_inside]] = ring[is_inside]
    return result


class AreaFill:
    """Filling of areas one after the other, in a picture that is kept for the next frame."""

    def __init__(self) -> None:
        self._picture = QImage()

    def fill(self, painter: QPainter, path: QPainterPath, colour: QColor, room: QRectF) -> None:
        """Fill what lies of `path` in `room` (pixels of the painter)."""
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
        """Have an empty picture of at least this size."""
        if self._picture.width() < size.width() or self._picture.height() < size.height():
            self._picture = QImage(size.size(), QImage.Format.Format_ARGB32_Premultiplied)
        self._picture.setDevicePixelRatio(ratio)
        self._picture.fill(0)
