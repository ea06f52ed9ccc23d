"""What can be drawn over a curve: geometry in the plane, and what it means."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


class Style(enum.Enum):
    """What a figure means; the canvas has a pen for each."""

    COMB_TEETH = enum.auto()
    COMB_EDGE = enum.auto()


class Shape(enum.Enum):
    """How the points of a figure belong together."""

    LINE = enum.auto()
    """One polyline."""
    SEGMENTS = enum.auto()
    """Point 2k and point 2k + 1 are the ends of a segment."""
    ARROWS = enum.auto()
    """As segments, with a head at the second end."""
    AREA = enum.auto()
    """A filled polygon."""
    MARKS = enum.auto()
    """Separate marks."""


@dataclass(frozen=True, eq=False)
class Figure:
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
