"""Fonts in the sizes that a drawing needs, found once: for a new one Qt seeks its glyphs anew."""

from __future__ import annotations

from PySide6.QtGui import QFont


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
        """Return the font smaller by so many points, but legible, at a scale."""
        return self.at(max(self._font.pointSizeF() - points, _LEAST) * scale)


_LEAST = 7.0
"""Points below which nothing can be read from the last row."""
