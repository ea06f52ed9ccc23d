"""Affine maps, and edits of several points: transform, move by decimal steps, align, distribute.

Explicit handles are transformed with their points: a rigid motion of all points moves the whole curve, and
one of some points changes only the curve between them and the others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from decimal import Decimal
from enum import Enum
from operator import attrgetter
from typing import Self

import msgspec
from msgspec.structs import replace

from .constraints import tie
from .derivatives import VECTORS
from .limits import EditError, checked_vector
from .model import Document, Point, Vector, derivatives_of
from .point_edits import PointsChange, all_moved_to, change_points, with_moved_points
from .point_group import PointGroup
from .words import NamedEnum

_x, _y = attrgetter("x"), attrgetter("y")
_VECTOR_NAMES = tuple(name for _, name in VECTORS)


class Affine(msgspec.Struct, frozen=True):
    """An affine map, stored as its difference from the identity.

    So that fixed points stay where they are to the last bit.

    Attributes
    ----------
    xx, xy, yx, yy
        The matrix minus the identity, row by row.
    centre, shift
        A point, and how far the map moves it.
    """

    xx: float
    xy: float
    yx: float
    yy: float
    centre: Vector
    shift: Vector = (0.0, 0.0)

    def point(self, p: Vector) -> Vector:
        """Return the image of a point."""
        offset = (p[0] - self.centre[0], p[1] - self.centre[1])
        return self._applied((p[0] + self.shift[0], p[1] + self.shift[1]), offset)

    def columns(self, points: Iterable[Point]) -> tuple[list[float], list[float]]:
        """Return the x and the y of the images of points, each as `point` returns it."""
        xx, xy, yx, yy = map(float, (self.xx, self.xy, self.yx, self.yy))
        x0, y0, dx, dy = map(float, (*self.centre, *self.shift))
        positions = [(point.x, point.y) for point in points]
        return (
            [x + dx + xx * (x - x0) + xy * (y - y0) for x, y in positions],
            [y + dy + yx * (x - x0) + yy * (y - y0) for x, y in positions],
        )

    def vector(self, v: Vector) -> Vector:
        """Return the image of a derivative."""
        return self._applied(v, v)

    def _applied(self, start: Vector, v: Vector) -> Vector:
        return (start[0] + self.xx * v[0] + self.xy * v[1], start[1] + self.yx * v[0] + self.yy * v[1])


IDENTITY = Affine(0.0, 0.0, 0.0, 0.0, (0.0, 0.0))


def scaling(x: float, y: float, centre: Vector) -> Affine:
    """Return the map that scales by `x` and `y` about `centre`."""
    return Affine(x - 1.0, 0.0, 0.0, y - 1.0, centre)


def reflection(axis: int, centre: Vector) -> Affine:
    """Return the mirror image along x (axis 0: left and right are exchanged) or y, about `centre`."""
    return scaling(*((-1.0, 1.0) if axis == 0 else (1.0, -1.0)), centre)


def reflection_about(start: Vector, end: Vector) -> Affine:
    """Return the mirror image about the line through two positions; exact along the axes and at 45°.

    Raises
    ------
    EditError
        If they are the same.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    longer = max(abs(dx), abs(dy))
    if not longer:
        raise EditError("The mirror line needs two different positions.")
    # Scaled first, because the squares of small numbers underflow.
    dx, dy = dx / longer, dy / longer
    square = dx * dx + dy * dy
    across = 2.0 * dx * dy / square
    return Affine(-2.0 * dy * dy / square, across, across, -2.0 * dx * dx / square, start)


def rotation(degrees: float, centre: Vector) -> Affine:
    """Return the rotation by `degrees`, counterclockwise, about `centre`; exact for quarter turns."""
    quarters, rest = divmod(degrees, 90.0)
    if rest == 0.0:
        cos, sin = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters % 4)]
    else:
        cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return Affine(cos - 1.0, -sin, sin, cos - 1.0, centre)


def polar_vector(length: float, degrees: float) -> Vector:
    """Return the vector of this length at an angle, counterclockwise from x; exact for quarter turns."""
    return rotation(degrees, (0.0, 0.0)).vector((length, 0.0))


def is_mirrored(by: Affine) -> bool:
    """Return whether a map reverses orientation."""
    return (1.0 + by.xx) * (1.0 + by.yy) < by.xy * by.yx


def rotation_of(by: Affine) -> float:
    """Return the degrees of the rotation nearest to a map, from −180 to 180.

    A map that reverses orientation is taken as a rotation after a reflection along x; after a reflection
    along y the rotation would be half a turn more.
    """
    sideways = -1.0 if is_mirrored(by) else 1.0
    xx, yx = sideways * (1.0 + by.xx), sideways * by.yx
    return round(math.degrees(math.atan2(yx - by.xy, xx + 1.0 + by.yy)), 9) + 0.0


LARGEST_SKEW = 89.0
"""Largest angle of a skew, to either side; at 90° a shape would collapse."""


def skew(axis: int, degrees: float, centre: Vector) -> Affine:
    """Return the skew along x (axis 0: points above the centre go right) or y (points right of it go up).

    Raises
    ------
    EditError
        If it is by more than `LARGEST_SKEW`.
    """
    if abs(degrees) > LARGEST_SKEW:
        raise EditError(f"Enter a skew between −{LARGEST_SKEW:g}° and {LARGEST_SKEW:g}°.")
    shift = math.copysign(1.0, degrees) if abs(degrees) == 45.0 else math.tan(math.radians(degrees))
    return Affine(0.0, shift, 0.0, 0.0, centre) if axis == 0 else Affine(0.0, 0.0, shift, 0.0, centre)


def transform_points(document: Document, curve: int, indices: Collection[int], by: Affine) -> Document:
    """Transform the points at `indices` and their explicit handles."""
    return change_points(document, curve, indices, lambda points: _mapped(points, by))


def positions_mapped(by: Affine) -> PointsChange:
    """Return the change that moves points to their images under a map; their derivatives stay."""
    return lambda points: all_moved_to(points, *by.columns(points))


def _mapped(points: Sequence[Point], by: Affine) -> list[Point]:
    moved = all_moved_to(points, *by.columns(points))
    if not any(map(any, map(derivatives_of, points))):
        return moved
    return [_with_vectors_mapped(point, by) for point in moved]


def _with_vectors_mapped(point: Point, by: Affine) -> Point:
    vectors = {
        name: checked_vector(by.vector(vector), "a derivative")
        for name, vector in zip(_VECTOR_NAMES, derivatives_of(point), strict=True)
        if vector is not None
    }
    mapped = replace(point, **vectors) if vectors else point
    if mapped.tied and mapped.velocity and mapped.velocity_after:
        # The velocities are still parallel up to rounding errors, which many transforms would add up.
        return tie(mapped, mapped.velocity, mapped.velocity_after)
    return mapped


def decimal_translation(by: Vector) -> PointsChange:
    """Return the change that moves points by decimal steps: 0.1 + 0.2 is 0.3, not 0.30000000000000004."""
    across, up = map(_decimal_step, by)
    return lambda points: all_moved_to(points, across(list(map(_x, points))), up(list(map(_y, points))))


def _decimal_step(by: float) -> Callable[[list[float]], list[float]]:
    """Return the function that adds `by` to many numbers as `decimal_sum` does; `by` is often 0."""
    if not by:
        return lambda values: values
    step = Decimal(repr(by))
    return lambda values: [float(Decimal(repr(value)) + step) for value in values]


def round_step_above(least: float) -> float:
    """Return the smallest of 1, 2 and 5 times a power of ten that is not below `least`, which is positive."""
    power = math.floor(math.log10(least))
    steps = (float(f"{digit}e{power}") for digit in (1, 2, 5, 10))
    return next((step for step in steps if step >= least), float(f"2e{power + 1}"))


def round_step_below(most: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that is not above `most`, which is positive."""
    power = math.floor(math.log10(most))
    steps = (float(f"{digit}e{power}") for digit in (5, 2, 1))
    return next((step for step in steps if step <= most), float(f"5e{power - 1}"))


def _middle(values: Sequence[float]) -> float:
    return min(values) / 2 + max(values) / 2


class Edge(Enum):
    """Edge or centre line that points are aligned to.

    Attributes
    ----------
    axis
        The coordinate that is aligned: 0 for x, 1 for y.
    target
        Function that returns the common coordinate from those of the points.
    """

    axis: int
    target: Callable[[Sequence[float]], float]

    def __new__(cls, value: str, axis: int, target: Callable[[Sequence[float]], float]) -> Self:
        """Return a member whose value is its name within a sentence."""
        member = object.__new__(cls)
        member._value_, member.axis, member.target = value, axis, target
        return member

    LEFT = "left", 0, min
    CENTRE = "centre", 0, _middle
    RIGHT = "right", 0, max
    TOP = "top", 1, max
    MIDDLE = "middle", 1, _middle
    BOTTOM = "bottom", 1, min


class Reference(NamedEnum):
    """Reference that curves are aligned to.

    Attributes
    ----------
    tip
        Explanation of the reference.
    """

    def __init__(self, value: str, label: str = "", tip: str = "") -> None:
        super().__init__(value, label)
        self.tip = tip

    EACH_OTHER = "each_other", "Each other", "Align the selected curves to the box around them"
    FIRST = "first", "The first selected", "Align the selected curves to the edited or the first selected one"
    LAST = "last", "The last selected", "Align the selected curves to the last selected one"
    LARGEST = "largest", "The largest", "Align the selected curves to the largest one"
    SMALLEST = "smallest", "The smallest", "Align the selected curves to the smallest one"
    DRAWING = "drawing", "All curves", "Align the selected curves to the box around all curves"

    @property
    def is_around(self) -> bool:
        """Whether the reference is independent of the selection: a single curve can be aligned to it."""
        return self is Reference.DRAWING


class Spacing(NamedEnum):
    """Distance that becomes equal between neighbours when curves are distributed."""

    CENTRES = "centres", "Centres"
    GAPS = "gaps", "Gaps"


def align_points(document: Document, group: PointGroup, edge: Edge) -> Document:
    """Give the points of a group the same x (left, centre, right) or the same y (top, middle, bottom)."""
    if group.count < 2:
        raise EditError("Select at least two points to align them.")
    curves, axis = document.curves, edge.axis
    target = edge.target(
        [curves[curve].points[index].position[axis] for curve, indices in group.parts for index in indices]
    )
    return group.apply(
        document,
        lambda new, curve, indices: set_coordinates(new, curve, dict.fromkeys(indices, target), axis),
    )


def distribute_points(document: Document, group: PointGroup, axis: int) -> Document:
    """Space the points evenly between the outer two, along x (axis 0) or y (axis 1)."""
    if group.count < 3:
        raise EditError("Select at least three points to distribute them.")
    curves = document.curves
    order = sorted(
        (curves[curve].points[index].position[axis], curve, index)
        for curve, indices in group.parts
        for index in indices
    )
    first, last, count = order[0][0], order[-1][0], len(order) - 1
    values: dict[int, dict[int, float]] = {}
    for rank, (_, curve, index) in enumerate(order):
        values.setdefault(curve, {})[index] = first * ((count - rank) / count) + last * (rank / count)
    return group.apply(
        document, lambda new, curve, _indices: set_coordinates(new, curve, values[curve], axis)
    )


def set_coordinates(document: Document, curve: int, values: dict[int, float], axis: int) -> Document:
    """Set the x (axis 0) or the y (axis 1) of some points."""
    points, name = list(document.curves[curve].points), ("x", "y")[axis]
    for index, value in values.items():
        points[index] = replace(points[index], **{name: value})
    return with_moved_points(document, curve, points, values)
