"""Clips: outlines beyond which nothing is seen of a curve."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Annotated, Final

from .fields import LENGTH, Requirement, few
from .value import Value, Vector

MOST_NUMBERS: Final = 600_000
"""Coordinates that a ring of a clip may have."""

MOST_RINGS: Final = 10_000
"""Rings of a clip."""

MOST_CLIPS: Final = 64
"""Clips of a curve."""

_NUMBERS = few(MOST_NUMBERS, f"hold at most {MOST_NUMBERS} numbers")
_PIECES = Requirement(
    lambda numbers: len(numbers) >= 8 and len(numbers) % 6 == 2,
    "hold x and y of a start and of three points for each piece",
    of_all=True,
    shown=len,
)


class ClipRing(Value, frozen=True):
    """A closed chain of cubic Bézier pieces: x and y of its start, and of three points for each piece."""

    numbers: Annotated[tuple[float, ...], LENGTH, _NUMBERS, _PIECES]

    @property
    def places(self) -> tuple[Vector, ...]:
        """Its start, and three points for each piece."""
        return tuple(zip(self.numbers[::2], self.numbers[1::2], strict=True))

    def mapped(self, place: Callable[[Vector], Vector]) -> ClipRing:
        """Return the ring where an affine map puts it."""
        return ring_of(map(place, self.places))


class Clip(Value, frozen=True):
    """An area beyond which nothing is seen; one without rings shows nothing.

    Attributes
    ----------
    rings
        Its outlines; they are closed by straight lines.
    evenodd
        Whether what lies within two of them is outside.
    """

    rings: Annotated[tuple[ClipRing, ...], few(MOST_RINGS, f"hold at most {MOST_RINGS} rings")] = ()
    evenodd: bool = False

    def mapped(self, place: Callable[[Vector], Vector]) -> Clip:
        """Return the clip where an affine map puts it."""
        return Clip(tuple(ring.mapped(place) for ring in self.rings), self.evenodd)


def ring_of(places: Iterable[Vector]) -> ClipRing:
    """Return the ring of a start and three points for each piece."""
    return ClipRing(tuple(float(number) for place in places for number in place))
