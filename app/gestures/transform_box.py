"""The box around the selected points: eight grips scale it, a ninth above it rotates."""

from __future__ import annotations

import math
from collections.abc import Collection

import msgspec

from app.document.model import Document, Vector
from app.document.transforms import scaling, transform_nodes
from app.gestures import words
from app.gestures.pointer import Cursor, Pointer
from app.view_model.curve_view import CurveView

PADDING = 16.0
"""Pixels between the points and the box: the grips must not lie on the points."""

_ARM = 26.0
"""Pixels from the box to the grip that rotates."""

_REACH = 8.0


class Grip(msgspec.Struct, frozen=True):
    """A grip: −1, 0 or 1 in each direction, or the one that rotates."""

    x: int
    y: int
    rotates: bool = False

    @property
    def cursor(self) -> Cursor:
        """The shape of the pointer over it."""
        if self.rotates:
            return Cursor.ROTATE
        if self.x == 0 or self.y == 0:
            return Cursor.WIDER if self.y == 0 else Cursor.HIGHER
        return Cursor.RISING if self.x == self.y else Cursor.FALLING


_GRIPS = tuple(Grip(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y)


class TransformBox(msgspec.Struct, frozen=True):
    """The bounding box of the selected points, without padding."""

    low: Vector
    high: Vector

    @property
    def centre(self) -> Vector:
        """Its middle: what is turned and scaled about."""
        return (self.low[0] / 2 + self.high[0] / 2, self.low[1] / 2 + self.high[1] / 2)

    def padded(self, scale: float) -> tuple[Vector, Vector]:
        """Return the corners as drawn, at `scale` pixels per unit."""
        pad = PADDING / scale
        return (self.low[0] - pad, self.low[1] - pad), (self.high[0] + pad, self.high[1] + pad)

    def grips(self, scale: float) -> list[tuple[Grip, Vector]]:
        """Return the grips and where they lie; none that would scale a side without length."""
        low, high = self.padded(scale)
        middle, useful = self.centre, tuple(b > a for a, b in zip(self.low, self.high, strict=True))
        columns, rows = (low[0], middle[0], high[0]), (low[1], middle[1], high[1])
        grips = [
            (grip, (columns[grip.x + 1], rows[grip.y + 1]))
            for grip in _GRIPS
            if (useful[0] or not grip.x) and (useful[1] or not grip.y)
        ]
        return [*grips, (Grip(0, 1, rotates=True), (middle[0], high[1] + _ARM / scale))]

    def grip_at(self, pointer: Pointer) -> Grip | None:
        """Return the grip under the pointer."""
        away = [
            (math.dist(place, pointer.position) * pointer.scale, grip)
            for grip, place in self.grips(pointer.scale)
        ]
        distance, grip = min(away, key=lambda each: each[0])
        return grip if distance <= _REACH else None


def box_of(view: CurveView, selection: Collection[int]) -> TransformBox | None:
    """Return the box around two or more points that do not all lie in one place."""
    chosen = [index for index in selection if index < len(view.points)]
    if len(chosen) < 2:
        return None
    points = view.points[chosen]
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return TransformBox((low[0], low[1]), (high[0], high[1])) if low != high else None


class ScaleBox(msgspec.Struct, frozen=True):
    """Scale the selected points by a grip of their box."""

    document: Document
    curve: int
    indices: frozenset[int]
    box: TransformBox
    grip: Grip
    start: Vector

    keys = "Shift: keep proportions · Alt: about the centre"

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Scale {words.points(self.indices)}"

    def note_at(self, pointer: Pointer) -> str:
        """Tell the factors."""
        x, y = self._factors(pointer)
        return f"Scale {words.number(x)}" if x == y else f"Scale {words.number(x)} × {words.number(y)}"

    def document_at(self, pointer: Pointer) -> Document:
        """Scale about the opposite side, or about the centre with Alt."""
        x, y = self._factors(pointer)
        by = scaling(x, y, self._fixed(pointer))
        return transform_nodes(self.document, self.curve, self.indices, by)

    def _fixed(self, pointer: Pointer) -> Vector:
        middle = self.box.centre
        if pointer.alt:
            return middle
        x = (self.box.high[0], middle[0], self.box.low[0])[self.grip.x + 1]
        y = (self.box.high[1], middle[1], self.box.low[1])[self.grip.y + 1]
        return (x, y)

    def _factors(self, pointer: Pointer) -> Vector:
        fixed = self._fixed(pointer)
        arm = (
            ((self.box.low[0], fixed[0], self.box.high[0])[self.grip.x + 1]) - fixed[0],
            ((self.box.low[1], fixed[1], self.box.high[1])[self.grip.y + 1]) - fixed[1],
        )
        way = (pointer.position[0] - self.start[0], pointer.position[1] - self.start[1])
        if pointer.shift:
            # As far as the way goes along the diagonal.
            factor = 1 + (way[0] * arm[0] + way[1] * arm[1]) / (arm[0] ** 2 + arm[1] ** 2)
            return (factor, factor)
        return (
            1 + way[0] / arm[0] if arm[0] else 1.0,
            1 + way[1] / arm[1] if arm[1] else 1.0,
        )
