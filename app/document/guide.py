"""Guides: straight lines to draw along, level, upright or at an angle."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec.structs import replace

from .fields import LENGTH, between
from .value import Value, Vector
from .words import NamedEnum

Length = Annotated[float, LENGTH]
"""A number that is twice as large in a drawing twice as large."""

MOST_LEAN = 45.0
"""Degrees from level or upright: what leans more is counted from the other of the two."""

_PARALLEL = 1e-9


class Axis(NamedEnum):
    """A coordinate of the plane."""

    X = "x", "x"
    Y = "y", "y"

    @property
    def coordinate(self) -> int:
        """Which coordinate it is: 0 or 1."""
        return int(self is Axis.Y)

    @property
    def other(self) -> Axis:
        """The other one."""
        return Axis.X if self is Axis.Y else Axis.Y


class Guide(Value, frozen=True):
    """A line to draw along, all across the plane.

    Attributes
    ----------
    axis
        The coordinate that all of its points have in common, about: x of an upright line.
    position
        That coordinate; of a line that leans, where the other one is `across`.
    lean
        Degrees by which it is turned from upright or level, counterclockwise.
    across
        The other coordinate of the point that it leans about; 0 where it does not.
    locked
        Whether it stays where it is.
    """

    axis: Axis
    position: Length
    lean: Annotated[float, between(-MOST_LEAN, MOST_LEAN)] = 0.0
    across: Length = 0.0
    locked: bool = False

    @property
    def point(self) -> Vector:
        """The point of it that it leans about."""
        return (self.position, self.across) if self.axis is Axis.X else (self.across, self.position)

    @property
    def angle(self) -> float:
        """Degrees from the x axis to it, counterclockwise, from 0 on and below 180."""
        angle = self.lean + (90.0 if self.axis is Axis.X else 0.0)
        return angle + 180.0 if angle < 0 else angle

    @property
    def way(self) -> Vector:
        """Its direction, of length 1."""
        if not self.lean:
            return (0.0, 1.0) if self.axis is Axis.X else (1.0, 0.0)
        return (math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle)))

    def at(self, across: float) -> float:
        """Return its coordinate where the other one is `across`."""
        if not self.lean:
            return self.position
        slope = math.tan(math.radians(self.lean))
        return self.position + (-slope if self.axis is Axis.X else slope) * (across - self.across)

    def through(self, position: float, across: float) -> Guide:
        """Return one as steep through the point with these coordinates."""
        return replace(self, position=position, across=across if self.lean else 0.0)

    def distance(self, place: Vector) -> float:
        """Return how far a place is away from it."""
        (x, y), (across, up) = self.point, self.way
        return abs((place[0] - x) * up - (place[1] - y) * across)

    def nearest(self, place: Vector) -> Vector:
        """Return its point that is nearest to a place."""
        (x, y), (across, up) = self.point, self.way
        along = (place[0] - x) * across + (place[1] - y) * up
        return (x + along * across, y + along * up)

    def meeting(self, other: Guide) -> Vector | None:
        """Return where it meets another one; None where they are as steep."""
        (x, y), (across, up) = self.point, self.way
        turn = across * other.way[1] - up * other.way[0]
        if abs(turn) < _PARALLEL:
            return None
        if not other.lean:
            # On that to the last digit.
            along = self.along(other)
            return (other.position, along) if other.axis is Axis.X else (along, other.position)
        way = (other.point[0] - x, other.point[1] - y)
        along = (way[0] * other.way[1] - way[1] * other.way[0]) / turn
        return (x + along * across, y + along * up)

    def along(self, other: Guide) -> float:
        """Return the coordinate along a level or upright guide at which it meets that."""
        if other.axis is not self.axis:
            return self.at(other.position)
        slope = math.tan(math.radians(self.lean)) * (-1.0 if self.axis is Axis.X else 1.0)
        return self.across + (other.position - self.position) / slope

    def beside(self, place: Vector) -> Vector:
        """Return its point that is level with a place, or straight above or below it."""
        x, y = place
        return (self.at(y), y) if self.axis is Axis.X else (x, self.at(x))


def guide_at(point: Vector, angle: float) -> Guide:
    """Return the guide through a point at some degrees from the x axis."""
    angle %= 180.0
    is_upright = MOST_LEAN < angle < 180.0 - MOST_LEAN
    lean = angle - 90.0 if is_upright else angle - 180.0 if angle > 90.0 else angle
    axis = Axis.X if is_upright else Axis.Y
    return Guide(axis, 0.0, lean).through(point[axis.coordinate], point[axis.other.coordinate])
