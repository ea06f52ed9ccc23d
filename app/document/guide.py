"""Guides: level and upright lines to draw along."""

from __future__ import annotations

from typing import Annotated

from .fields import LENGTH
from .value import Value, Vector
from .words import NamedEnum

Length = Annotated[float, LENGTH]
"""A number that is twice as large in a drawing twice as large."""


class Axis(NamedEnum):
    """A coordinate of the plane."""

    X = "x", "x"
    Y = "y", "y"

    @property
    def coordinate(self) -> int:
        """Which coordinate it is: 0 or 1."""
        return int(self is Axis.Y)


class Guide(Value, frozen=True):
    """A line to draw along, all across the plane.

    Attributes
    ----------
    axis
        The coordinate that all of its points have in common: x of an upright line, y of a level one.
    position
        That coordinate.
    """

    axis: Axis
    position: Length

    def beside(self, place: Vector) -> Vector:
        """Return its point that is level with a place, or straight above or below it."""
        x, y = place
        return (self.position, y) if self.axis is Axis.X else (x, self.position)
