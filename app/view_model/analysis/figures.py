"""Figures over a curve: geometry in the plane, each in a style that has a meaning."""

from __future__ import annotations

import enum

import msgspec

from curvecore.arrays import FloatArray

from ...document.words import with_minus
from ..line_styles import LineStyle


class Shape(enum.Enum):
    """The ways in which the points of a figure belong together."""

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
    """Points (k, 2) of the plane, how they belong together and how they look.

    Attributes
    ----------
    style
        Its lines and marks; what the figure means is known by it.
    label
        A word beside the last point; empty for none.
    """

    style: LineStyle
    shape: Shape
    points: FloatArray
    label: str = ""


def number(value: float) -> str:
    """Return a number as a label has it: three digits, a real minus."""
    mantissa, _, exponent = f"{value:.3g}".partition("e")
    return with_minus(f"{mantissa}·10^{int(exponent)}" if exponent else mantissa)
