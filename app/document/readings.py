"""Coordinates as people read and type them: up from the origin, or down from the upper edge of a page.

The plane of a document counts y upwards, in files and in all that computes. What shows a coordinate, a way,
an angle or a derivative, or reads a typed one, asks the `Readings` of the document.
"""

from __future__ import annotations

import math
from typing import Final, overload

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from . import words
from .model import Document
from .value import Vector

_DIGITS = 15
"""Decimal digits that any float keeps: those of a difference beyond them are rounding."""

_EXACT = 22
"""Powers of ten up to this one are floats without rounding."""


class Readings(msgspec.Struct, frozen=True):
    """Where coordinates are counted from, and which way y goes.

    Attributes
    ----------
    origin
        The place of the plane that is told as 0, 0.
    is_down
        Whether y is counted downwards; angles are then clockwise.
    """

    origin: Vector = (0.0, 0.0)
    is_down: bool = False

    # Places

    def shown_at(self, axis: int, value: float) -> float:
        """Return what is told of a coordinate of the plane, x (axis 0) or y."""
        start = self.origin[axis]
        return _difference(start, value) if axis and self.is_down else _difference(value, start)

    def meant_at(self, axis: int, shown: float) -> float:
        """Return the coordinate of the plane that is told as this."""
        start = self.origin[axis]
        return _difference(start, shown) if axis and self.is_down else _difference(shown, -start)

    def shown(self, place: Vector) -> Vector:
        """Return what is told of a place of the plane."""
        return (self.shown_at(0, place[0]), self.shown_at(1, place[1]))

    def meant(self, shown: Vector) -> Vector:
        """Return the place of the plane that is told as this."""
        return (self.meant_at(0, shown[0]), self.meant_at(1, shown[1]))

    def all_shown_at(self, axis: int, values: FloatArray) -> FloatArray:
        """Return what is told of coordinates (n,)."""
        start = self.origin[axis]
        return _difference(start, values) if axis and self.is_down else _difference(values, start)

    def all_meant_at(self, axis: int, shown: FloatArray) -> FloatArray:
        """Return the coordinates (n,) that are told as these."""
        start = self.origin[axis]
        return _difference(start, shown) if axis and self.is_down else _difference(shown, -start)

    # Ways, derivatives and angles: what is told of one told is what it was

    def sign(self, axis: int) -> float:
        """Return what a way along x (axis 0) or y is told times."""
        return -1.0 if axis and self.is_down else 1.0

    def way_along(self, axis: int, length: float) -> float:
        """Return what is told of a way along an axis, or the way that is told so."""
        return self.sign(axis) * length + 0.0

    def way(self, way: Vector) -> Vector:
        """Return what is told of a way or a derivative, or which is told so."""
        return (way[0] + 0.0, self.way_along(1, way[1]))

    def turn(self, degrees: float) -> float:
        """Return what is told of a turn that is counterclockwise, or the turn that is told so."""
        return self.sign(1) * degrees + 0.0

    @property
    def of_ways(self) -> Readings:
        """How ways and derivatives are told, which begin nowhere."""
        return Readings(is_down=self.is_down)

    # Words

    def place_words(self, place: Vector) -> str:
        """Return both coordinates of a place."""
        return words.pair(self.shown(place))

    def point_words(self, index: int, place: Vector) -> str:
        """Return "Point 3 at 2.4, 5.158"."""
        return f"Point {index} at {self.place_words(place)}"

    def way_words(self, way: Vector) -> str:
        """Return both components of a way."""
        return words.pair(self.way(way))

    def angle_words(self, degrees: float) -> str:
        """Return an angle to a tenth of a degree."""
        return words.angle(self.turn(degrees))

    def direction_words(self, way: Vector) -> str:
        """Return the direction of a way."""
        x, y = self.way(way)
        return words.angle(math.degrees(math.atan2(y, x)))

    def polar_words(self, way: Vector) -> str:
        """Return length and direction, "3.2 at 45°"."""
        return f"{words.number(math.hypot(*way))} at {self.direction_words(way)}"

    @property
    def sense(self) -> str:
        """Which way angles are counted: a word of tips."""
        return "clockwise" if self.is_down else "counterclockwise"


PLAIN: Final = Readings()
"""Those of the plane itself, and of sketches."""


def readings_of(document: Document) -> Readings:
    """Return how coordinates of a document are told."""
    return PLAIN


@overload
def _difference(a: float, b: float) -> float: ...
@overload
def _difference(a: FloatArray, b: float) -> FloatArray: ...
@overload
def _difference(a: float, b: FloatArray) -> FloatArray: ...
def _difference(a: float | FloatArray, b: float | FloatArray) -> float | FloatArray:
    """Return a − b as the decimal numbers that they are written as: 297 − 276.9 is 20.1.

    Without a start that is another than 0 no digit changes.
    """
    plain = np.asarray(a, dtype=float) - np.asarray(b, dtype=float) + 0.0
    if not (np.ndim(a) == 0 and a == 0.0) and not (np.ndim(b) == 0 and b == 0.0):
        largest = np.maximum(np.maximum(np.abs(a), np.abs(b)), 1e-300)
        decimals = _DIGITS - np.ceil(np.log10(largest))
        scale = 10.0 ** np.minimum(decimals, _EXACT)
        plain = np.where(decimals > _EXACT, plain, np.rint(plain * scale) / scale) + 0.0
    return float(plain) if plain.ndim == 0 else plain
