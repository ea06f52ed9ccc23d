"""What can be drawn over a curve: geometry in the plane, and what it means."""

from __future__ import annotations

import enum

import msgspec
import numpy as np
import numpy.typing as npt

from app.document.words import with_minus

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]


class Style(enum.Enum):
    """What a figure means; the canvas has a pen for each."""

    COMB_TEETH = enum.auto()
    COMB_EDGE = enum.auto()
    VELOCITY = enum.auto()
    ACCELERATION = enum.auto()
    CIRCLE = enum.auto()
    CIRCLE_CENTRE = enum.auto()
    BEZIER = enum.auto()
    BEZIER_POINT = enum.auto()
    POLYGON = enum.auto()
    TICK = enum.auto()
    INFLECTION = enum.auto()
    SHARPEST = enum.auto()
    FLATTEST = enum.auto()
    CROSSING = enum.auto()
    BAND = enum.auto()
    ENSEMBLE = enum.auto()


class Shape(enum.Enum):
    """How the points of a figure belong together."""

    LINE = enum.auto()
    """A polyline; a row of NaN ends one and begins the next."""
    SEGMENTS = enum.auto()
    """Point 2k and point 2k + 1 are the ends of a segment."""
    ARROWS = enum.auto()
    """As segments, with a head at the second end."""
    TICKS = enum.auto()
    """At point 2k, a short stroke of fixed length in the direction of point 2k + 1."""
    AREA = enum.auto()
    """Polygons that turn to the left, each ended by a row of NaN; all together are one area."""
    MARKS = enum.auto()
    """Separate marks."""


class Figure(msgspec.Struct, frozen=True, eq=False):
    """Points (k, 2) of the plane, how they belong together and what they mean.

    Attributes
    ----------
    label
        A word beside the last point; empty for none.
    """

    style: Style
    shape: Shape
    points: Floats
    label: str = ""


def number(value: float) -> str:
    """Return a number as a label has it: three digits, a real minus."""
    mantissa, _, exponent = f"{value:.3g}".partition("e")
    return with_minus(f"{mantissa}·10^{int(exponent)}" if exponent else mantissa)
