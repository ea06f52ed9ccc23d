"""Forms that fill a box."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Annotated, Self

from msgspec.structs import replace

from .decimals import decimal_sum
from .fields import LENGTH, above
from .form import Form, Piece
from .value import Vector

Size = Annotated[float, LENGTH, above(0)]


class InBox(Form, frozen=True):
    """What fills a box; its place is the lower left corner of that.

    Attributes
    ----------
    width, height
        Of the box.
    """

    width: Size
    height: Size

    @property
    def right(self) -> float:
        """Where its box ends."""
        return decimal_sum(self.x, self.width)

    @property
    def top(self) -> float:
        """Where it ends above."""
        return decimal_sum(self.y, self.height)

    @property
    def middle(self) -> Vector:
        """The middle of the box."""
        return (self.x / 2 + self.right / 2, self.y / 2 + self.top / 2)

    @property
    def sides(self) -> Sequence[Piece]:
        """The sides of its box: from its upper left corner along the upper one, and on clockwise."""
        left, low, right, top = self.x, self.y, self.right, self.top
        corners = ((left, top), (right, top), (right, low), (left, low), (left, top))
        return [line(*each) for each in pairwise(corners)]

    def scaled(self, across: float, up: float) -> Self:
        """Return the form so many times as wide and high, about its place."""
        return replace(self, width=self.width * across, height=self.height * up)

    def _sized(self, fixed: Vector, to: Vector, *, even: bool) -> Self:
        """Return the form in the box from a corner that stays to another place."""
        way = [decimal_sum(end, -start) for start, end in zip(fixed, to, strict=True)]
        if even:
            grow = max(abs(way[0]) / self.width, abs(way[1]) / self.height)
            way = [math.copysign(grow * self.width, way[0]), math.copysign(grow * self.height, way[1])]
        x, y = (
            start if along >= 0 else decimal_sum(start, along)
            for start, along in zip(fixed, way, strict=True)
        )
        if not all(way):
            return self
        return replace(self, x=x, y=y, width=abs(way[0]), height=abs(way[1]))


def line(start: Vector, end: Vector) -> Piece:
    """Return a straight piece."""
    (x, y), (to_x, to_y) = start, end
    across, up = (to_x - x) / 3, (to_y - y) / 3
    return (start, (x + across, y + up), (to_x - across, to_y - up), end)


def on_the_way(start: Vector, end: Vector, share: float) -> Vector:
    """Return the place that is a share of the way from one to another."""
    return (start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share)
