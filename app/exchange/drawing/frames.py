"""The rectangles that pictures show."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..errors import ExchangeError
from .outlines import Outline, painted_extent

MARGIN = 0.06
"""Free space on every side of the drawing, against its larger side."""

SLIMMEST = 0.2
"""Least ratio of a frame's shorter to its longer side."""

LARGEST = 1e30
SMALLEST = 1e-30
"""Sizes that every reader of pictures can hold: many compute in single precision, 1e-38 to 1e38."""

_RESOLUTION = 1e-12


class Frame(msgspec.Struct, frozen=True):
    """The rectangle that a picture shows; y points up."""

    left: float
    bottom: float
    width: float
    height: float

    @property
    def top(self) -> float:
        """The upper edge."""
        return self.bottom + self.height

    @property
    def side(self) -> float:
        """The longer side."""
        return max(self.width, self.height)


def frame_with(outlines: Iterable[Outline], points: FloatArray | None = None) -> Frame:
    """Return the frame that shows curves with their points, and other points (n, 2).

    Raises
    ------
    ExchangeError
        If no picture can hold the coordinates.
    """
    parts = [np.vstack([painted_extent(each), each.points]) for each in outlines]
    return frame_around(parts if points is None else [*parts, points])


def frame_around(parts: list[FloatArray]) -> Frame:
    """Return the frame that shows all points, with a margin and not too slim.

    Raises
    ------
    ExchangeError
        If no picture can hold the coordinates.
    """
    points = np.vstack(parts)
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    reach = float(np.abs(points).max())
    if size == 0:
        raise ExchangeError("There is nothing to draw: all points coincide.")
    if not SMALLEST <= size <= LARGEST:
        raise ExchangeError(
            f"The drawing is {size:.2g} across; a picture can hold {SMALLEST:g} to {LARGEST:g}."
        )
    if size < _RESOLUTION * reach:
        raise ExchangeError(
            f"The drawing is {size:.2g} across at a distance of {reach:.2g} from the origin: "
            "too small for a picture."
        )
    outer = size * (1 + 2 * MARGIN)
    width, height = np.maximum(high - low + 2 * MARGIN * size, SLIMMEST * outer).tolist()
    middle = low + (high - low) / 2
    return Frame(float(middle[0]) - width / 2, float(middle[1]) - height / 2, width, height)
