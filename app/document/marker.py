"""Markers: arrowheads and dots at the ends of open lines."""

from __future__ import annotations

from typing import Final

from .forms import QUARTER
from .value import Vector
from .words import NamedEnum

Ring = tuple[Vector, ...]
"""The outline of a marker: its start, and three points for each cubic Bézier piece."""


class MarkerKind(NamedEnum):
    """What stands at an end of a line."""

    NONE = "none", "None"
    ARROW = "arrow", "Arrow"
    OPEN = "open", "Chevron"
    DOT = "dot", "Dot"
    SQUARE = "square", "Square"
    DIAMOND = "diamond", "Diamond"
    BAR = "bar", "Bar"


def _polygon(*corners: Vector) -> Ring:
    """Return straight sides."""
    places = [corners[0]]
    for (x, y), (end_x, end_y) in zip(corners, (*corners[1:], corners[0]), strict=True):
        way = (end_x - x) / 3, (end_y - y) / 3
        places += [(x + way[0], y + way[1]), (end_x - way[0], end_y - way[1]), (end_x, end_y)]
    return tuple(places)


def _disc(radius: float) -> Ring:
    """Return a circle about the end, of four quarters."""
    places: list[Vector] = [(radius, 0.0)]
    handle = QUARTER * radius
    x, y = 1.0, 0.0
    for _ in range(4):
        next_x, next_y = -y, x
        places += [
            (radius * x + handle * next_x, radius * y + handle * next_y),
            (radius * next_x + handle * x, radius * next_y + handle * y),
            (radius * next_x, radius * next_y),
        ]
        x, y = next_x, next_y
    return tuple(places)


RINGS: Final[dict[MarkerKind, Ring]] = {
    MarkerKind.ARROW: _polygon((3.0, 0.0), (-1.0, 2.0), (-1.0, -2.0)),
    # Arms one wide, at right angles to each other.
    MarkerKind.OPEN: _polygon(
        (1.0, 0.0),
        (-1.75, 2.75),
        (-1.75 - 0.5**0.5, 2.75 - 0.5**0.5),
        (1.0 - 2**0.5, 0.0),
        (-1.75 - 0.5**0.5, 0.5**0.5 - 2.75),
        (-1.75, -2.75),
    ),
    MarkerKind.DOT: _disc(1.75),
    MarkerKind.SQUARE: _polygon((1.5, 1.5), (-1.5, 1.5), (-1.5, -1.5), (1.5, -1.5)),
    MarkerKind.DIAMOND: _polygon((2.1, 0.0), (0.0, 2.1), (-2.1, 0.0), (0.0, -2.1)),
    MarkerKind.BAR: _polygon((0.5, 2.5), (-0.5, 2.5), (-0.5, -2.5), (0.5, -2.5)),
}
"""Outlines in widths of the line: the end is the origin, and x runs on as the line would.

Each covers the end of the line with its cap; they are the same above and below.
"""

FARTHEST: Final = max(max(map(abs, place)) * 2**0.5 for ring in RINGS.values() for place in ring)
"""Widths of the line that a marker reaches from the end, at most."""
