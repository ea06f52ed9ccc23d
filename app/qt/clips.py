"""Clips of a document's styles as paths of Qt: the same on the screen and in print."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from itertools import pairwise

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPolygonF, QTransform

from ..document.clip import Clip

_MOST_KEPT = 256
_FARTHEST = 20_000.0
"""Pixels up to which Qt is given a path as it is; of one that reaches further, the part that is near."""


@contextmanager
def clipped(
    painter: QPainter, clips: Sequence[Clip], to_device: QTransform, area: QRectF | None = None
) -> Iterator[None]:
    """Let a painter show nothing beyond clips of the plane; `area` is all that is seen, if it is small."""
    painter.save()
    try:
        for clip in clips:
            path = to_device.map(path_of(clip))
            if area is not None and _is_far(path.controlPointRect()):
                path = _near(path, area)
            if path.isEmpty():
                # Qt takes an empty path for none at all.
                painter.setClipRect(QRectF(), Qt.ClipOperation.IntersectClip)
            else:
                painter.setClipPath(path, Qt.ClipOperation.IntersectClip)
        yield
    finally:
        painter.restore()


@lru_cache(_MOST_KEPT)
def path_of(clip: Clip) -> QPainterPath:
    """Return the outlines of a clip in the plane."""
    rings, path = [_ring(each.numbers) for each in clip.rings], QPainterPath()
    path.setFillRule(Qt.FillRule.OddEvenFill if clip.evenodd else Qt.FillRule.WindingFill)
    for ring in rings:
        if clip.evenodd:
            # Qt's PDF files (6.11) know the nonzero rule alone: holes run the other way round.
            start = ring.pointAtPercent(0.0)
            depth = sum(other.contains(start) for other in rings if other is not ring)
            ring = ring.toReversed() if depth % 2 == _runs_left(ring) else ring  # noqa: PLW2901
        path.addPath(ring)
    return path


def _ring(numbers: Sequence[float]) -> QPainterPath:
    ring = QPainterPath()
    ring.setFillRule(Qt.FillRule.WindingFill)
    ring.moveTo(*numbers[:2])
    for at in range(2, len(numbers), 6):
        ring.cubicTo(*numbers[at : at + 6])
    ring.closeSubpath()
    return ring


def _runs_left(ring: QPainterPath) -> bool:
    corners = [(each.x(), each.y()) for each in ring.toFillPolygon().toList()]
    return sum(x * v - u * y for (x, y), (u, v) in pairwise(corners)) > 0


def _is_far(box: QRectF) -> bool:
    return max(map(abs, (box.left(), box.top(), box.right(), box.bottom()))) > _FARTHEST


def _near(path: QPainterPath, area: QRectF) -> QPainterPath:
    """Return the part of a path that lies around an area."""
    around = QPainterPath()
    around.addPolygon(QPolygonF(area.adjusted(-2, -2, 2, 2)))
    return path.intersected(around)
