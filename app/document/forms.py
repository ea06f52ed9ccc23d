"""The forms that there are: rectangle, ellipse, star."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Annotated, Self

from msgspec.structs import replace

from .box_form import InBox, Size, line, on_the_way
from .decimals import decimal_sum
from .fields import LENGTH, Requirement, at_least, between
from .form import Form, FormField, FormHandle, Piece
from .value import Vector

QUARTER = 4 / 3 * (math.sqrt(2) - 1)
"""How far the handles of a quarter of a circle reach, of its radius."""

_APART, _PROPORTIONS, _CIRCLE = "Shift: across and up apart", "Ctrl: keeps proportions", "Ctrl: a circle"
_STEPS = "Ctrl: steps of 15°"

CORNERS, RATIOS = (3, 1000), (0.01, 1.0)
"""How many corners a star can have, and how far its inner ones can be away."""

_WHOLE = Requirement(lambda value: value == round(value), "be a whole number")

Radius = Annotated[float, LENGTH, at_least(0)]


class Rectangle(InBox, frozen=True):
    """A rectangle, begun and run through as in SVG: from its upper left corner, clockwise.

    Attributes
    ----------
    rx, ry
        How far its round corners reach across and up; 0 for sharp ones.
    """

    rx: Radius = 0.0
    ry: Radius = 0.0

    noun = "rectangle"
    fields = (
        FormField("width", "W", "Width of the rectangle along its own side"),
        FormField("height", "H", "Height of the rectangle along its own side"),
        FormField("rx", "Rx", "Radius of its corners"),
        FormField("ry", "Ry", "Radius of its corners upwards"),
    )

    @property
    def radii(self) -> Vector:
        """The radii that its corners have: none is longer than half a side."""
        if not (self.rx and self.ry):
            return (0.0, 0.0)
        return (min(self.rx, self.width / 2), min(self.ry, self.height / 2))

    @property
    def pieces(self) -> Sequence[Piece]:
        """How it runs: along its upper side, and on clockwise."""
        rx, ry = self.radii
        if not rx:
            return self.sides
        left, low, right, top = self.x, self.y, self.right, self.top
        corners = ((right, top), (right, low), (left, low), (left, top))
        x_ends, y_ends = _inside(left, right, rx, self.width), _inside(low, top, ry, self.height)
        ends: list[tuple[Vector, Vector]] = [
            ((x_ends[1], top), (right, y_ends[1])),
            ((right, y_ends[0]), (x_ends[1], low)),
            ((x_ends[0], low), (left, y_ends[0])),
            ((left, y_ends[1]), (x_ends[0], top)),
        ]
        made, at = list[Piece](), ends[-1][1]
        for corner, (before, after) in zip(corners, ends, strict=True):
            if at != before:
                made.append(line(at, before))
            made.append(
                (before, on_the_way(before, corner, QUARTER), on_the_way(after, corner, QUARTER), after)
            )
            at = after
        return made

    @property
    def handles(self) -> Sequence[FormHandle]:
        """The radii at the upper right corner, and the two corners beside that."""
        rx, ry = self.radii
        return (
            FormHandle("rx", (decimal_sum(self.right, -rx), self.top), "corner radius", _APART, True),
            FormHandle("ry", (self.right, decimal_sum(self.top, -ry)), "corner radius", _APART, True),
            FormHandle("upper left", (self.x, self.top), "size", _PROPORTIONS),
            FormHandle("lower right", (self.right, self.y), "size", _PROPORTIONS),
        )

    def dragged(self, handle: str, to: Vector, *, ctrl: bool, shift: bool) -> Self:
        """Return the form with a handle somewhere else; with Shift each radius is another."""
        if handle == "upper left":
            return self._sized((self.right, self.y), to, even=ctrl)
        if handle == "lower right":
            return self._sized((self.x, self.top), to, even=ctrl)
        reach = (decimal_sum(self.right, -to[0]), decimal_sum(self.top, -to[1]))
        if not shift:
            radius = min(max(0.0, *reach), self.width / 2, self.height / 2)
            return replace(self, rx=radius, ry=radius)
        rx, ry = self.radii
        if handle == "rx":
            rx = min(max(0.0, reach[0]), self.width / 2)
            return replace(self, rx=rx, ry=ry or min(rx, self.height / 2))
        ry = min(max(0.0, reach[1]), self.height / 2)
        return replace(self, rx=rx or min(ry, self.width / 2), ry=ry)

    def scaled(self, across: float, up: float) -> Self:
        """Return the form so many times as wide and high, about its place."""
        sized = super().scaled(across, up)
        return replace(sized, rx=self.rx * across, ry=self.ry * up)

    def with_number(self, name: str, value: float) -> Self:
        """Return the form with a number that was typed: one radius is for both while they are one."""
        if name in ("rx", "ry"):
            other = "ry" if name == "rx" else "rx"
            now = getattr(self, other)
            is_one = self.rx == self.ry if name == "rx" else not now
            return replace(self, **{name: value, other: value if is_one else now})
        return replace(self, **{name: value})


class Ellipse(InBox, frozen=True):
    """An ellipse, begun and run through as in SVG: from its right, clockwise."""

    noun = "ellipse"
    fields = (
        FormField("width", "W", "Width of the ellipse along its own axis"),
        FormField("height", "H", "Height of the ellipse along its own axis"),
    )

    @property
    def pieces(self) -> Sequence[Piece]:
        """A quarter after the other."""
        (x, y), left, low, right, top = self.middle, self.x, self.y, self.right, self.top
        quarters = (
            ((right, y), (right, low), (x, low)),
            ((x, low), (left, low), (left, y)),
            ((left, y), (left, top), (x, top)),
            ((x, top), (right, top), (right, y)),
        )
        return [
            (start, on_the_way(start, corner, QUARTER), on_the_way(end, corner, QUARTER), end)
            for start, corner, end in quarters
        ]

    @property
    def handles(self) -> Sequence[FormHandle]:
        """Its right and its top: half of the axes."""
        x, y = self.middle
        return (
            FormHandle("right", (self.right, y), "width", _CIRCLE),
            FormHandle("top", (x, self.top), "height", _CIRCLE),
        )

    def dragged(self, handle: str, to: Vector, *, ctrl: bool, shift: bool) -> Self:
        """Return the form with a handle somewhere else, about its middle; with Ctrl it is a circle."""
        x, y = self.middle
        half = abs(to[0] - x) if handle == "right" else abs(to[1] - y)
        if not half:
            return self
        width, height = (2 * half if ctrl or handle == each else size for each, size in (
            ("right", self.width), ("top", self.height)
        ))  # fmt: skip
        return self._sized_about_middle(width, height)

    def with_number(self, name: str, value: float) -> Self:
        """Return the form with a number that was typed, about its middle."""
        sizes = {"width": self.width, "height": self.height, name: value}
        return self._sized_about_middle(sizes["width"], sizes["height"])

    def _sized_about_middle(self, width: float, height: float) -> Self:
        x, y = self.middle
        return replace(self, x=x - width / 2, y=y - height / 2, width=width, height=height)


class Star(Form, frozen=True):
    """A star about its place; with a ratio of 1 the polygon of its corners.

    Attributes
    ----------
    radius
        How far its corners are away.
    corners
        How many there are.
    ratio
        How far the inner ones are away, of that.
    angle
        Degrees from the x axis to the first, counterclockwise.
    """

    radius: Size
    corners: Annotated[float, between(*CORNERS), _WHOLE] = 5.0
    ratio: Annotated[float, between(*RATIOS)] = 0.5
    angle: float = 90.0

    noun = "star"
    stretches = False
    fields = (
        FormField("corners", "Corners", "Number of corners", is_length=False, limits=CORNERS),
        FormField(
            "ratio", "Ratio", "Inner radius by the outer one; 1 is a polygon", is_length=False, limits=RATIOS
        ),
        FormField("radius", "R", "Radius of the corners"),
    )

    @property
    def is_polygon(self) -> bool:
        """Whether it has no inner corners."""
        return self.ratio >= 1.0

    @property
    def word(self) -> str:
        """A polygon, where it has no inner corners."""
        return "polygon" if self.is_polygon else self.noun

    def _at(self, step: float, radius: float) -> Vector:
        """Return the place so many corners on, and so far away."""
        angle = math.radians(self.angle + 360.0 * step / self.corners)
        return (self.x + radius * math.cos(angle), self.y + radius * math.sin(angle))

    @property
    def pieces(self) -> Sequence[Piece]:
        """How it runs: from its first corner, counterclockwise."""
        places = list[Vector]()
        for step in range(round(self.corners)):
            places.append(self._at(step, self.radius))
            if not self.is_polygon:
                places.append(self._at(step + 0.5, self.radius * self.ratio))
        return [line(*each) for each in pairwise((*places, places[0]))]

    @property
    def handles(self) -> Sequence[FormHandle]:
        """Its first corner, and the inner one behind that."""
        return (
            FormHandle("corner", self._at(0, self.radius), "radius and angle", _STEPS),
            FormHandle("inner", self._at(0.5, self.radius * self.ratio), "ratio", "", True),
        )

    def dragged(self, handle: str, to: Vector, *, ctrl: bool, shift: bool) -> Self:
        """Return the form with a handle somewhere else; with Ctrl its angle goes in steps."""
        way = (to[0] - self.x, to[1] - self.y)
        far = math.hypot(*way)
        if not far:
            return self
        if handle == "inner":
            return replace(self, ratio=min(max(far / self.radius, RATIOS[0]), RATIOS[1]))
        angle = math.degrees(math.atan2(way[1], way[0]))
        return replace(self, radius=far, angle=15.0 * round(angle / 15.0) if ctrl else angle)

    def scaled(self, across: float, up: float) -> Self:
        """Return the form so many times as large, about its place."""
        return replace(self, radius=self.radius * math.sqrt(across * up))

    def with_number(self, name: str, value: float) -> Self:
        """Return the form with a number that was typed."""
        return replace(self, **{name: float(round(value)) if name == "corners" else value})


def _inside(start: float, end: float, radius: float, size: float) -> Vector:
    """Return where the straight part of a side begins and ends; in the middle where there is none."""
    if 2 * radius >= size:
        return ((start + end) / 2,) * 2
    return (decimal_sum(start, radius), decimal_sum(end, -radius))


AnyForm = Rectangle | Ellipse | Star
"""What a document may say of a curve."""
