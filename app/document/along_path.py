"""The course that a text lies along, and the curve that this is taken from."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise
from typing import Annotated, Final

from msgspec.structs import replace

from .clone import Identity
from .fields import LENGTH, Requirement, few
from .form import Piece
from .value import Value, Vector

_MOST_PIECES = 100_000
_SAMPLES = 32

Ground = tuple[float, ...]
"""An affine map: where it takes the origin, and where a unit across and one down lead."""

UPSIDE_DOWN: Final[Ground] = (0.0, 0.0, 1.0, 0.0, 0.0, -1.0)

_GROUND = Requirement(
    lambda ground: len(ground) == 6 and ground[2] * ground[5] != ground[3] * ground[4],
    "hold six numbers of a map that can be undone",
    of_all=True,
)


class Along(Value, frozen=True):
    """The course that a text lies along, in units of the text, y downwards.

    Attributes
    ----------
    pieces
        How it runs; a gap between two is jumped.
    of
        The identity of the curve that it is taken from; empty for a course of its own.
    ground
        The map from the units of the text to the plane, against which the course is taken from that curve.
    start
        Where on it the text is anchored: a length from its beginning, in units of the text.
    is_share
        Whether that is a share of its length.
    is_flipped
        Whether the text lies on the other side, and runs the other way.
    """

    pieces: Annotated[tuple[Piece, ...], few(_MOST_PIECES, f"be at most {_MOST_PIECES}")]
    of: Identity = ""
    ground: Annotated[tuple[float, ...], LENGTH, _GROUND] = UPSIDE_DOWN
    start: float = 0.0
    is_share: bool = False
    is_flipped: bool = False

    @property
    def course(self) -> tuple[Piece, ...]:
        """How it runs the way that the text does."""
        if not self.is_flipped:
            return self.pieces
        return tuple((d, c, b, a) for a, b, c, d in reversed(self.pieces))

    def anchored(self, share: float, before: float) -> Along:
        """Return it for another part of a line that is anchored, which stands at that part of the course.

        Where it stood at none before it stays where it is.
        """
        is_there = self.start == before and (self.is_share or not before)
        return replace(self, start=share, is_share=share > 0) if is_there else self

    @property
    def length(self) -> float:
        """How long the course is, about."""
        return _length(self.pieces)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """What its control points take."""
        xs, ys = zip(*(place for piece in self.pieces for place in piece), strict=True)
        return min(xs), min(ys), max(xs), max(ys)


@lru_cache(maxsize=16)
def _length(pieces: tuple[Piece, ...]) -> float:
    return sum(math.dist(here, there) for piece in pieces for here, there in pairwise(_samples(piece)))


def _samples(piece: Piece) -> list[Vector]:
    a, b, c, d = piece
    shares = [at / _SAMPLES for at in range(_SAMPLES + 1)]
    weights = [((1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t * t, t**3) for t in shares]
    return [
        (p * a[0] + q * b[0] + r * c[0] + s * d[0], p * a[1] + q * b[1] + r * c[1] + s * d[1])
        for p, q, r, s in weights
    ]


def place_by(ground: Ground, place: Vector) -> Vector:
    """Return where a map takes a place."""
    x, y, a, b, c, d = ground
    return (x + a * place[0] + c * place[1], y + b * place[0] + d * place[1])


def after(ground: Ground, before: Ground) -> Ground:
    """Return the map that is one after another one."""
    (x, y), (right, low) = place_by(ground, before[:2]), place_by(ground, (0.0, 0.0))  # type: ignore[arg-type]
    (a, b), (c, d) = place_by(ground, before[2:4]), place_by(ground, before[4:])  # type: ignore[arg-type]
    return (x, y, a - right, b - low, c - right, d - low)


def inverse_of(ground: Ground) -> Ground:
    """Return the map back."""
    x, y, a, b, c, d = ground
    area = a * d - b * c
    back = (0.0, 0.0, d / area, -b / area, -c / area, a / area)
    left, low = place_by(back, (x, y))
    return (-left, -low, *back[2:])


def course_shifted(along: Along, by: Vector) -> Along:
    """Return a course in a plane that was shifted with the curve that it is taken from."""
    x, y, *linear = along.ground
    return replace(along, ground=(x + by[0], y + by[1], *linear))
