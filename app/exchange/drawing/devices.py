"""What the devices of painters show of brushes, and what is painted there side by side."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QPaintEngine, QPainter

_MOST_COMPARED = 200


def has_alpha(brush: QBrush) -> bool:
    """Whether a gradient lets something through, or a pattern may."""
    return brush.style() is Qt.BrushStyle.TexturePattern or (
        brush.gradient() is not None and not brush.isOpaque()
    )


def is_raster(painter: QPainter) -> bool:
    """Whether it paints pixels."""
    engine = painter.paintEngine()
    return engine is not None and engine.type() == QPaintEngine.Type.Raster


def do_any_meet(boxes: Sequence[QRectF]) -> bool:
    """Whether any of some boxes meet, or may where they are many."""
    return len(boxes) > _MOST_COMPARED or any(one.intersects(other) for one, other in combinations(boxes, 2))
