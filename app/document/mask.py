"""Masks: pictures whose light, or whose cover, says how much is seen of a curve."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Final

from msgspec.structs import replace

from .fields import LENGTH
from .gradient import Tile
from .value import Value, Vector

MOST_MASKS: Final = 16
"""Masks of a curve."""


class Mask(Value, frozen=True):
    """A picture in the plane: where it is white something is seen whole, where black or clear not at all.

    Attributes
    ----------
    tile
        The picture. Beyond the part of it that is shown nothing is seen.
    start, end, side
        Where the upper left, the upper right and the lower left corner of that part lie.
    is_alpha
        Whether what it covers is seen, whatever its colour.
    """

    tile: Tile
    start: Annotated[Vector, LENGTH] = (0.0, 0.0)
    end: Annotated[Vector, LENGTH] = (1.0, 0.0)
    side: Annotated[Vector, LENGTH] = (0.0, -1.0)
    is_alpha: bool = False

    def mapped(self, place: Callable[[Vector], Vector]) -> Mask:
        """Return the mask where an affine map puts it."""
        return replace(self, start=place(self.start), end=place(self.end), side=place(self.side))

    @property
    def matrix(self) -> tuple[float, float, float, float, float, float]:
        """The map from the plane of the picture to that of the mask, as SVG writes it."""
        (x, y), (a, b), (c, d), (left, top, width, height) = self.start, self.end, self.side, self.tile.view
        across = ((a - x) / width, (b - y) / width)
        down = ((c - x) / height, (d - y) / height)
        shift = (x - left * across[0] - top * down[0], y - left * across[1] - top * down[1])
        return (*across, *down, *shift)
