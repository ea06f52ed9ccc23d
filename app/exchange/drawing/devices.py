"""What the devices of painters show of brushes."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QPaintEngine, QPainter


def has_alpha(brush: QBrush) -> bool:
    """Whether a gradient lets something through, or a pattern may."""
    return brush.style() is Qt.BrushStyle.TexturePattern or (
        brush.gradient() is not None and not brush.isOpaque()
    )


def is_raster(painter: QPainter) -> bool:
    """Whether it paints pixels."""
    engine = painter.paintEngine()
    return engine is not None and engine.type() == QPaintEngine.Type.Raster
