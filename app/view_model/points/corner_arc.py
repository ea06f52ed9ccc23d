"""Circular arcs in place of corners, as cubic pieces, and those between two straight sides in closed form.

An arc has as many pieces as right angles begin in it, each within 2.8e-4 of the radius [1]_, and is of one
direction with the sides where it leaves them.

References
----------
.. [1] M. Goldapp, "Approximation of circular arcs by cubic polynomials", CAGD 8 (1991) 227-238.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np

from curvecore.arrays import FloatArray

from ...document.transforms import decimal_sum

FLAT = 1e-9
"""Share of a segment's length up to which its control points lie on a line, and nothing is left of a side."""


class ArcPiece(NamedTuple):
    """A cubic piece: where it ends, and its handles at both ends."""

    end: FloatArray
    leaving: FloatArray
    arriving: FloatArray


@dataclass(frozen=True, eq=False)
class Arc:
    """An arc that touches both sides of a corner.

    Attributes
    ----------
    start
        Where it leaves the side behind the corner.
    pieces
        Its pieces.
    radius
        Its radius.
    shares
        How much of the side behind the corner, and of that ahead, it takes the place of: of a straight one
        the share of its length, of another one that of its parameter.
    """

    start: FloatArray
    pieces: Sequence[ArcPiece]
    radius: float
    shares: tuple[float, float]


class Corner(Protocol):
    """A corner that can be made an arc."""

    def shares(self, radius: float) -> tuple[float, float]:
        """Return how much of both sides an arc would take; of one that does not fit, the largest."""

    def arc(self, radius: float, room: tuple[float, float]) -> Arc | None:
        """Return the arc, or the largest one within shares of both sides; None where none touches both."""


@dataclass(frozen=True, eq=False)
class StraightCorner:
    """A corner of straight sides: its place, the directions to it and on, and the lengths of the sides."""

    place: FloatArray
    towards: FloatArray
    onwards: FloatArray
    lengths: tuple[float, float]

    @cached_property
    def cross(self) -> float:
        """Sine of the angle by which the curve turns, above 0 to the left."""
        return float(self.towards[0] * self.onwards[1] - self.towards[1] * self.onwards[0])

    @cached_property
    def dot(self) -> float:
        """Its cosine."""
        return float(self.towards @ self.onwards)

    @cached_property
    def slope(self) -> float:
        """Tangent of half the angle: how far an arc of radius 1 reaches along the sides."""
        # Exactly 1 at a right angle, as math.tan is not.
        return abs(self.cross) / (1.0 + self.dot)

    def shares(self, radius: float) -> tuple[float, float]:
        """Return how much of both sides an arc would take, perhaps more than there is."""
        cut = radius * self.slope
        return cut / self.lengths[0], cut / self.lengths[1]

    def arc(self, radius: float, room: tuple[float, float]) -> Arc:
        """Return the arc, or the largest one within shares of both sides."""
        rooms = (share * length for share, length in zip(room, self.lengths, strict=True))
        cut = min(radius * self.slope, *rooms)
        end, handle = self._along(cut), self._handle(cut)
        if self._is_wide:
            place, half_way = self._middle(cut)
            pieces = [
                ArcPiece(place, self.towards * handle, half_way * handle),
                ArcPiece(end, half_way * handle, self.onwards * handle),
            ]
        else:
            pieces = [ArcPiece(end, self.towards * handle, self.onwards * handle)]
        shares = (cut / self.lengths[0], cut / self.lengths[1])
        return Arc(self._along(-cut), pieces, cut / self.slope, shares)

    def _along(self, way: float) -> FloatArray:
        """Return the place on a side: at −`way` before the corner, at `way` behind it."""
        by = (self.towards if way < 0 else self.onwards) * way
        # In decimals, so that a corner at 0.3 that is cut by 0.1 begins at 0.2.
        return np.array([decimal_sum(*each) for each in zip(self.place.tolist(), by.tolist(), strict=True)])

    def _middle(self, cut: float) -> tuple[FloatArray, FloatArray]:
        """Return the middle of the arc, and the direction there."""
        out = self.towards - self.onwards
        out /= math.hypot(*out)
        angle = math.atan2(abs(self.cross), self.dot)
        inwards = cut * math.tan(angle / 4)
        side = math.copysign(1.0, self.cross)
        return self.place - out * inwards, np.array([-out[1], out[0]]) * side

    def _handle(self, cut: float) -> float:
        """Return how far the Bézier handles of its pieces reach."""
        angle = math.atan2(abs(self.cross), self.dot)
        return 4 / 3 * math.tan(angle / (8 if self._is_wide else 4)) * cut / self.slope

    @property
    def _is_wide(self) -> bool:
        """Whether it turns by more than a right angle."""
        return self.dot < -FLAT


def pieces_about(
    centre: FloatArray, radius: float, start: FloatArray, end: FloatArray, turn: float
) -> list[ArcPiece]:
    """Return the pieces of an arc by its first and last direction; `turn` is above 0 to the left."""
    count = max(math.ceil(abs(turn) / (math.pi / 2) - FLAT), 1)
    handle, side = 4 / 3 * math.tan(abs(turn) / count / 4) * radius, math.copysign(1.0, turn)
    ways = [_turned(start, turn * at / count) for at in range(count)] + [end]
    # From the centre to the right of a curve that turns to the left.
    places = [centre + side * radius * np.array([way[1], -way[0]]) for way in ways]
    return [ArcPiece(places[at + 1], ways[at] * handle, ways[at + 1] * handle) for at in range(count)]


def _turned(way: FloatArray, angle: float) -> FloatArray:
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([way[0] * cos - way[1] * sin, way[0] * sin + way[1] * cos])
