"""Gradients, colours that go over into each other along a line or from a middle; and patterns.

A pattern is a picture that is laid side by side over the plane of a gradient.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from itertools import pairwise
from typing import Annotated, Final

from msgspec.structs import replace

from .fields import LENGTH, SHARE, Requirement, few, matching
from .value import Value, Vector
from .words import NamedEnum

MOST_STOPS: Final = 256
"""Stops that a gradient may have."""

Box = tuple[Vector, Vector]
"""Lower left and upper right corner."""

_COLOUR = matching("#[0-9a-f]{6}|", 'be written as "#rrggbb" in lower case, or be empty for the ink')
_FEW = few(MOST_STOPS, f"hold at most {MOST_STOPS} stops")
_TWO = Requirement(lambda stops: len(stops) > 1, "hold at least 2 stops", of_all=True, shown=len)
_ASCENDING = Requirement(
    lambda stops: all(one.offset <= other.offset for one, other in pairwise(stops)),
    "hold stops in the order of their offsets",
    of_all=True,
    shown=lambda stops: [stop.offset for stop in stops],
)


MOST_LETTERS: Final = 400_000
"""Letters of the tile of a pattern."""

_SHORT = Requirement(
    lambda body: len(body) <= MOST_LETTERS, f"have at most {MOST_LETTERS:,} letters", shown=len
)
_OF_ITS_OWN = Requirement(
    # A reader of SVG would open the files of others.
    lambda body: re.search(r"""href\s*=\s*(?!["'](#|data:image/))|url\(\s*["']?(?!#)|<!|<\?""", body) is None,
    "refer to nothing but its own parts",
    shown=lambda _body: "another",
)
_SIZED = Requirement(
    lambda view: view[2] > 0 and view[3] > 0, "have a width and a height above 0", of_all=True, shown=list
)


class GradientKind(NamedEnum):
    """Shape of a gradient.

    Attributes
    ----------
    what
        What one of it is called.
    """

    LINEAR = "linear", "Linear"
    RADIAL = "radial", "Radial"
    PATTERN = "pattern", "Pattern"

    @property
    def what(self) -> str:
        """What one of it is called."""
        return "pattern" if self is GradientKind.PATTERN else "gradient"


class Spread(NamedEnum):
    """What lies beyond the first and the last stop of a gradient."""

    PAD = "pad", "Pad"
    REFLECT = "reflect", "Reflect"
    REPEAT = "repeat", "Repeat"


class Stop(Value, frozen=True):
    """A colour at a place of a gradient: from 0, its start, to 1; as `Style` writes it."""

    offset: Annotated[float, SHARE]
    colour: Annotated[str, _COLOUR] = ""
    opacity: Annotated[float, SHARE] = 1.0


class Tile(Value, frozen=True):
    """Picture of a pattern, which repeats.

    Attributes
    ----------
    body
        Elements of SVG; what they paint in ``currentColor`` has the colour of the pattern.
    view
        The part of their plane that is shown: left, top, width and height.
    """

    body: Annotated[str, _SHORT, _OF_ITS_OWN]
    view: Annotated[tuple[float, float, float, float], _SIZED] = (0.0, 0.0, 1.0, 1.0)


class Gradient(Value, frozen=True):
    """Colours over a plane whose origin and unit vectors lie at three places of the document's.

    With u and v as the coordinates there, a linear gradient has the stop of offset u at (u, v), and a radial
    one that of offset √(u² + v²): an affine map of the three places maps the gradient.

    Attributes
    ----------
    kind
        Linear or radial.
    stops
        Two or more, in the order of their offsets.
    start, end
        Where the offset is 0 and 1; the middle of an ellipse, and one end of its one axis.
    side
        The end of its other axis; all on a line through `start` and `side` has the same colour.
    focus
        Where the offset of a radial one is 0 if that is not the middle; rays go from there to the ellipse.
    spread
        What lies beyond.
    tile
        What a pattern has between start, end and side, and again beside that, in the colour of its stops.
    """

    stops: Annotated[tuple[Stop, ...], _FEW, _TWO, _ASCENDING]
    kind: GradientKind = GradientKind.LINEAR
    start: Annotated[Vector, LENGTH] = (0.0, 0.0)
    end: Annotated[Vector, LENGTH] = (1.0, 0.0)
    side: Annotated[Vector, LENGTH] = (0.0, 1.0)
    focus: Annotated[Vector | None, LENGTH] = None
    spread: Spread = Spread.PAD
    tile: Tile | None = None

    def mapped(self, place: Callable[[Vector], Vector]) -> Gradient:
        """Return the gradient with its places where an affine map puts them."""
        focus = None if self.focus is None else place(self.focus)
        return replace(self, start=place(self.start), end=place(self.end), side=place(self.side), focus=focus)

    @property
    def axes(self) -> tuple[Vector, Vector]:
        """The ways from the start to the end and to the side."""
        (x, y), (a, b), (c, d) = self.start, self.end, self.side
        return (a - x, b - y), (c - x, d - y)

    @property
    def is_flat(self) -> bool:
        """Whether it has no width or no height, so that nothing but its last colour is seen."""
        (a, b), (c, d) = self.axes
        return abs(a * d - b * c) <= _LEAST_AREA * math.hypot(a, b) * math.hypot(c, d)

    def coordinates(self, place: Vector) -> Vector:
        """Return u and v of a place; it must not be flat."""
        (a, b), (c, d) = self.axes
        x, y = place[0] - self.start[0], place[1] - self.start[1]
        area = a * d - b * c
        return (x * d - y * c) / area, (a * y - b * x) / area

    @property
    def mean(self) -> str:
        """The colour that stands for it where there are no gradients."""
        seen = [stop for stop in self.stops if stop.colour]
        if not seen:
            return ""
        weights = [stop.opacity for stop in seen]
        weights = weights if any(weights) else [1.0] * len(seen)
        levels = [bytes.fromhex(stop.colour[1:]) for stop in seen]
        mixed = (
            round(sum(w * level[i] for w, level in zip(weights, levels, strict=True)) / sum(weights))
            for i in range(3)
        )
        return "#" + "".join(f"{min(level, 255):02x}" for level in mixed)

    def at(self, offset: float) -> Stop:
        """Return the stop that would change nothing at an offset."""
        after = next((index for index, stop in enumerate(self.stops) if stop.offset >= offset), None)
        if not after:
            return replace(self.stops[0 if after == 0 else -1], offset=offset)
        one, other = self.stops[after - 1], self.stops[after]
        share = (offset - one.offset) / (other.offset - one.offset)
        opacity = one.opacity + share * (other.opacity - one.opacity)
        if not (one.colour and other.colour):
            # The ink is no colour that could be mixed.
            return Stop(offset, (one if share < 0.5 else other).colour, opacity)
        levels = zip(bytes.fromhex(one.colour[1:]), bytes.fromhex(other.colour[1:]), strict=True)
        mixed = (f"{round(a + share * (b - a)):02x}" for a, b in levels)
        return Stop(offset, f"#{''.join(mixed)}", opacity)


_LEAST_AREA = 1e-12
"""Share of the area of a square: axes that enclose less lie on a line."""


def size_of(box: Box) -> Vector:
    """Return width and height of a box; of one without either, the other, or 1."""
    (left, bottom), (right, top) = box
    width, height = right - left, top - bottom
    return width or height or 1.0, height or width or 1.0
