"""Outlines, curves as the cubic Bézier pieces that pictures are made of, and the frames around them."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from operator import attrgetter

import msgspec
import numpy as np

from curvecore.arrays import BoolArray, FloatArray

from ...document.style import PLAIN_STYLE, Style
from ...view_model.extents import around_dot, extent_of, half_width, line_of, stroke_box, turns_within
from ..errors import ExchangeError


class Outline(msgspec.Struct, frozen=True):
    """One curve as cubic Bézier pieces.

    Attributes
    ----------
    name
        The curve's name.
    control_points
        (k, 4, 2); a piece begins where the one before it ends.
    points
        The points that the curve goes through, or control points beside it, (n, 2).
    deviation, is_bound
        Largest distance from the true curve, zero where the curve is a chain of cubics itself; and whether it
        is nowhere more.
    closed
        Whether the last piece ends where the first begins, and goes on there.
    style
        Stroke and fill; its width is in the unit of the control points.
    shape, groups, visible, locked
        As in `Curve`.
    letters
        Kinds of the points; see `letters_of`. Empty where pieces do not end at points.
    """

    name: str
    control_points: FloatArray
    points: FloatArray
    deviation: float
    closed: bool = False
    style: Style = PLAIN_STYLE
    shape: str = ""
    groups: tuple[str, ...] = ()
    visible: bool = True
    locked: bool = False
    letters: str = ""
    is_bound: bool = True

    @property
    def colour(self) -> str:
        """The paint that the curve is known by, "#rrggbb", or empty for the ink of the picture."""
        return self.style.colour

    @property
    def is_dot(self) -> bool:
        """Whether the curve has no length."""
        return bool((self.control_points == self.control_points[0, 0]).all())


def painted_extent(outline: Outline) -> FloatArray:
    """Return the corners, (2, 2), of the box of a curve with its stroke: with its caps, joins and miters."""
    controls = outline.control_points
    if half_width(outline.style) == 0.0:
        return extent_of(controls)
    line = line_of(controls, turns_within(controls), is_closed=outline.closed)
    return around_dot(controls[0, 0], outline.style) if line is None else stroke_box(line, outline.style)


def by_shape(outlines: Iterable[Outline]) -> list[tuple[Outline, ...]]:
    """Return outlines that follow each other in one shape together, and the others each by itself."""
    return [
        group
        for shape, together in groupby(outlines, attrgetter("shape"))
        for group in ([tuple(together)] if shape else [(outline,) for outline in together])
    ]


_STRAIGHT_ROUNDING = 4 * np.finfo(float).eps


def are_lines(pieces: FloatArray) -> BoolArray:
    """Whether each piece (k, 4, 2) runs straight and evenly from its start to its end, but for rounding.

    The length of a handle is velocity times parameters, which are rounded as parts of the whole length.
    """
    off = np.abs(pieces - straight_pieces(pieces)).max(axis=(1, 2))
    length = np.hypot(*(pieces[:, 3] - pieces[:, 0]).T).sum()
    return np.asarray(off <= _STRAIGHT_ROUNDING * (np.abs(pieces).max(axis=(1, 2)) + length))


def straight_pieces(pieces: FloatArray) -> FloatArray:
    """Return straight and even pieces with the ends of these, (k, 4, 2)."""
    start, end = pieces[:, 0], pieces[:, 3]
    third = (end - start) / 3
    return np.stack([start, start + third, end - third, end], axis=1)


def length_within(shape: Iterable[Outline]) -> float:
    """Return a length that no outline of a shape is longer than."""
    return float(sum(np.hypot(*np.diff(part.control_points, axis=1).T).sum() for part in shape))


# Frames


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
    parts = [np.vstack([painted_extent(outline), outline.points]) for outline in outlines]
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
        raise ExchangeError(f"The drawing is {size:.2g} across; pictures can be {SMALLEST:g} to {LARGEST:g}.")
    if size < _RESOLUTION * reach:
        raise ExchangeError(
            f"The drawing is {size:.2g} across at a distance of {reach:.2g} from the origin: "
            "too small for a picture."
        )
    outer = size * (1 + 2 * MARGIN)
    width, height = np.maximum(high - low + 2 * MARGIN * size, SLIMMEST * outer).tolist()
    middle = low + (high - low) / 2
    return Frame(float(middle[0]) - width / 2, float(middle[1]) - height / 2, width, height)
