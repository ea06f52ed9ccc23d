"""Pictures beside the screen, which layers keep while what they show stays as it is."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt
from PySide6.QtGui import QPixmap


def transparent(width: float, height: float, ratio: float) -> QPixmap:
    """Return an empty picture of a size in pixels of a plot, for a screen with `ratio` of its own to each."""
    picture = QPixmap(math.ceil(width * ratio), math.ceil(height * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture
