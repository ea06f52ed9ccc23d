"""Outlines of markers as Qt has them."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainterPath

from curvecore.arrays import FloatArray


def path_of(rings: Iterable[FloatArray]) -> QPainterPath:
    """Return closed outlines of cubic pieces, (k, 4, 2) each, as one path."""
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.WindingFill)
    for ring in rings:
        path.moveTo(*ring[0, 0].tolist())
        for _, (bx, by), (cx, cy), (dx, dy) in ring.tolist():
            path.cubicTo(bx, by, cx, cy, dx, dy)
        path.closeSubpath()
    return path
