"""The colours of the points, made once."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtGui import QColor

from app.appearance.colours import point_colours
from app.appearance.theme import Theme


@lru_cache(maxsize=8)
def colours_of(count: int, theme: Theme) -> tuple[QColor, ...]:
    """Return the colours of `count` points; the same objects for the same arguments, not to be changed."""
    return tuple(point_colours(count, theme))
