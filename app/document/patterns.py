"""Patterns that every document can use, and how they are laid."""

from __future__ import annotations

from typing import Final, NamedTuple

from .gradient import Box, Gradient, GradientKind, Stop, Tile, size_of

_TILES_ACROSS: Final = 8
"""How often a pattern repeats along the longer side of the shape that it is laid across."""


class Pattern(NamedTuple):
    """A pattern to choose.

    Attributes
    ----------
    name, title
        Its name inside the program, and what people call it.
    tile
        What repeats, as wide as it is high.
    """

    name: str
    title: str
    tile: Tile


def _pattern(name: str, title: str, body: str) -> Pattern:
    return Pattern(name, title, Tile(body, (0.0, 0.0, 8.0, 8.0)))


PATTERNS: Final = (
    _pattern("stripes", "Stripes", '<path d="M0 0H8V4H0Z" fill="currentColor"></path>'),
    _pattern("upright", "Upright stripes", '<path d="M0 0H4V8H0Z" fill="currentColor"></path>'),
    _pattern(
        "slanted",
        "Slanted stripes",
        '<path d="M0 8L8 0H4L0 4ZM8 8V4L4 8Z" fill="currentColor"></path>',
    ),
    _pattern("checks", "Checks", '<path d="M0 0H4V8H8V4H0Z" fill="currentColor"></path>'),
    _pattern("dots", "Dots", '<circle cx="4" cy="4" r="2.5" fill="currentColor"></circle>'),
    _pattern(
        "grid",
        "Grid",
        '<path d="M0 0H8V1H0ZM0 1H1V8H0Z" fill="currentColor"></path>',
    ),
)
"""The patterns, in the order in which they are shown; written as a file is read."""


def colouring(colour: str) -> tuple[Stop, Stop]:
    """Return the stops of a pattern in a colour: what lies between is clear."""
    return Stop(0.0, colour), Stop(1.0, colour, 0.0)


def laid_across(box: Box, tile: Tile, colour: str) -> Gradient:
    """Return a pattern that repeats some times across a box, from its upper left corner on."""
    left, top = box[0][0], box[1][1]
    _, _, width, height = tile.view
    step = max(size_of(box)) / _TILES_ACROSS
    size = (step * min(width / height, 1.0), step * min(height / width, 1.0))
    return Gradient(
        colouring(colour),
        GradientKind.PATTERN,
        (left, top),
        (left + size[0], top),
        (left, top - size[1]),
        tile=tile,
    )
