"""The box around the selected points, or selected curves: its grips scale and rotate, or rotate and skew."""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec

from ..document import words
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.transforms import scaling, set_coordinates
from ..view_model.boxes import Bounds, bounds_of
from ..view_model.curve.curve_view import CurveView
from ..view_model.resize import stretched
from .drag import Drag, longer_axis, minus, plus
from .pointer import SNAP_KEY, Cursor, Pointer
from .snapping import Snapper
from .transform import TransformKind

_BESIDE_POINTS, _BESIDE_CURVES = 16.0, 10.0
"""Pixels from the box to its grips: a press there must mean neither points and handles, nor a line."""

_ARM = 26.0
"""Pixels from the box to the grip that rotates."""

_REACH = 8.0

_LEAST_BOX, _LEAST_TURNING_BOX = 60.0, 20.0
"""Pixels along a box with room for a pivot that nobody chose; fewer where its grips turn."""

_TOLERANCE = 0.05
"""Pixels that the box may be off where the curves answer to a stretch with another shape."""


class Grip(msgspec.Struct, frozen=True):
    """A grip: −1, 0 or 1 in each direction.

    Attributes
    ----------
    does
        What it does.
    """

    x: int
    y: int
    does: TransformKind = TransformKind.SCALE

    @property
    def cursor(self) -> Cursor:
        """The shape of the pointer over it."""
        if self.does is TransformKind.ROTATE:
            return Cursor.ROTATE
        if self.x == 0 or self.y == 0:
            goes_along_x = (self.y == 0) is (self.does is TransformKind.SCALE)
            return Cursor.WIDER if goes_along_x else Cursor.HIGHER
        return Cursor.RISING if self.x == self.y else Cursor.FALLING


_GRIPS = tuple(Grip(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y)
_TURNING_GRIPS = tuple(
    Grip(each.x, each.y, TransformKind.ROTATE if each.x and each.y else TransformKind.SKEW) for each in _GRIPS
)


class TransformBox(Bounds, frozen=True):
    """The bounds of selected points, or of selected curves; its grips stand around it.

    Attributes
    ----------
    turns
        Whether its grips rotate, at the corners, and skew, and do not scale.
    is_whole
        Whether it is that of whole curves.
    """

    turns: bool = False
    is_whole: bool = False

    @property
    def pad(self) -> float:
        """Pixels from it to its grips."""
        return _BESIDE_CURVES if self.is_whole else _BESIDE_POINTS

    def holds(self, pointer: Pointer) -> bool:
        """Whether a pointer lies inside; of a flat box, or a tiny one, as near to it as its grips."""
        least = self.pad / pointer.scale
        return all(
            abs(at - middle) <= max(size / 2, least)
            for at, middle, size in zip(pointer.position, self.centre, self.size, strict=True)
        )

    def is_roomy(self, scale: float) -> bool:
        """Whether its middle is a pivot to take: a press in a smaller one moves what is in it.

        So does one in whole curves before their grips turn: who clicks there means what lies there.
        """
        if self.turns:
            return max(self.size) * scale >= _LEAST_TURNING_BOX
        return not self.is_whole and max(self.size) * scale >= _LEAST_BOX

    def grips(self, scale: float) -> list[tuple[Grip, Vector]]:
        """Return the grips and where they lie; none that would scale or skew a side without length."""
        pad, (left, low), (right, high) = self.pad / scale, self.low, self.high
        middle, useful = self.centre, [length > 0.0 for length in self.size]
        columns, rows = (left - pad, middle[0], right + pad), (low - pad, middle[1], high + pad)
        grips = [
            (grip, (columns[grip.x + 1], rows[grip.y + 1]))
            for grip in (_TURNING_GRIPS if self.turns else _GRIPS)
            if grip.does is TransformKind.ROTATE or ((useful[0] or not grip.x) and (useful[1] or not grip.y))
        ]
        if self.turns:
            return grips
        return [*grips, (Grip(0, 1, TransformKind.ROTATE), (middle[0], high + pad + _ARM / scale))]

    def grip_at(self, pointer: Pointer) -> Grip | None:
        """Return the grip under the pointer."""
        away = [
            (math.dist(place, pointer.position) * pointer.scale, grip)
            for grip, place in self.grips(pointer.scale)
        ]
        distance, grip = min(away, key=lambda each: each[0])
        return grip if distance <= _REACH else None


def box_of(views: Sequence[CurveView], group: PointGroup, *, live: bool = False) -> TransformBox | None:
    """Return the box around two or more points, or curves, that are not all in one place.

    `live` while they are dragged: as they are drawn.
    """
    if sum(len(indices) for _, indices in group.parts) < 2:
        return None
    bounds = bounds_of(views, group, as_drawn=live)
    if bounds is None or not any(bounds.size):
        return None
    return TransformBox(bounds.low, bounds.high, is_whole=group.is_whole)


class ScaleBox(Drag, frozen=True):
    """Drag of a grip of the box: it scales the selected points, or selected curves.

    What snaps is the corner or the side of the box that the grip moves: the grip lies beside it.

    Attributes
    ----------
    views
        The views of the curves at the press.
    pivot
        What stays where it is with Shift.
    even
        Whether proportions are kept without a key, too.
    """

    views: Sequence[CurveView]
    group: PointGroup
    box: TransformBox
    pivot: Vector
    grip: Grip
    start: Vector
    snapper: Snapper
    even: bool = False

    keys = f"Shift: about the pivot · Ctrl: keep proportions · {SNAP_KEY}"

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Scale {self.group.label}"

    @property
    def remark(self) -> str:
        """What of the group is locked."""
        return self.group.remark

    def readout(self, pointer: Pointer) -> str:
        """Return the factors."""
        x, y = self._factors(self._displacement(pointer), pointer)
        return f"Scale {words.number(x)}" if x == y else f"Scale {words.number(x)} × {words.number(y)}"

    def document_at(self, pointer: Pointer) -> Document:
        """Scale about the opposite side, or about the pivot with Shift."""
        x, y = self._factors(self._displacement(pointer), pointer)
        about, caught = self._fixed(pointer), self.snapper.caught
        by = scaling(x, y, about)
        document = stretched(
            self.document,
            self.views,
            self.group,
            (by.point(self.box.low), by.point(self.box.high)),
            even=longer_axis(self._arm(pointer)) if self._is_even(pointer) else None,
            about=about,
            tolerance=0.0 if caught is not None else _TOLERANCE / pointer.scale,
        )
        if caught is not None:
            for axis in caught.axes:
                # To the last bit where it snapped to.
                document = self._with_side(document, axis, caught.position[axis])
        return document

    def _with_side(self, document: Document, axis: int, value: float) -> Document:
        side, curves = self._corner[axis], self.document.curves
        for curve, indices in self.group.parts:
            outermost = [index for index in indices if curves[curve].points[index].position[axis] == side]
            if outermost:
                document = set_coordinates(document, curve, dict.fromkeys(outermost, value), axis)
        return document

    @property
    def _corner(self) -> Vector:
        """The corner of the box that moves, or the middle of the side."""
        return self.box.position(self.grip.x, self.grip.y)

    def _fixed(self, pointer: Pointer) -> Vector:
        opposite, corner = self.box.position(-self.grip.x, -self.grip.y), self._corner
        if not pointer.shift:
            return opposite
        # Nothing can be scaled about the side that moves.
        x, y = (
            there if about == side else about
            for about, there, side in zip(self.pivot, opposite, corner, strict=True)
        )
        return (x, y)

    def _arm(self, pointer: Pointer) -> Vector:
        """Return the way from what stays to what moves."""
        x, y = minus(self._corner, self._fixed(pointer))
        return (x if self.grip.x else 0.0, y if self.grip.y else 0.0)

    def _is_even(self, pointer: Pointer) -> bool:
        return self.even or pointer.ctrl

    def _displacement(self, pointer: Pointer) -> Vector:
        """Return how far the corner goes, after snapping."""
        corner, arm = self._corner, self._arm(pointer)
        way = pointer.offset_from(self.start)
        axis = None if self.grip.x and self.grip.y else 0 if self.grip.x else 1
        if self._is_even(pointer):
            # As far as the way goes along the diagonal; only its longer side can snap without leaving it.
            # By directions, not by squares: that of a tiny box is nothing to divide by.
            length = math.hypot(*arm)
            across, up = arm[0] / length, arm[1] / length
            along = way[0] * across + way[1] * up
            way, axis = (along * across, along * up), longer_axis(arm)
        target = self.snapper.snap(plus(corner, way), pointer, axis)
        return way if self.snapper.caught is None else minus(target, corner)

    def _factors(self, way: Vector, pointer: Pointer) -> Vector:
        arm = self._arm(pointer)
        if self._is_even(pointer):
            axis = longer_axis(arm)
            factor = 1 + way[axis] / arm[axis]
            return (factor, factor)
        return (
            1 + way[0] / arm[0] if arm[0] else 1.0,
            1 + way[1] / arm[1] if arm[1] else 1.0,
        )
