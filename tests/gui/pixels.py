"""Looks at all pixels of a picture at once: one by one, a window takes half a second."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QColor, QImage


def pixels_of(image: QImage) -> np.ndarray:
    """Return the pixels as numbers 0xrrggbb, (height, width)."""
    plain = image.convertToFormat(QImage.Format.Format_RGB32)
    rows = np.frombuffer(plain.constBits(), np.uint32).reshape(plain.height(), plain.bytesPerLine() // 4)
    return rows[:, : plain.width()] & 0xFFFFFF


def is_colour(image: QImage, colour: QColor) -> np.ndarray:
    """Return which pixels have exactly this colour, (height, width)."""
    return pixels_of(image) == colour.rgb() & 0xFFFFFF
