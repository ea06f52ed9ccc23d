"""Gradients of SVG as those of a document, in its plane.

Reference: Scalable Vector Graphics 2, section 14.2.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.gradient import MOST_STOPS, Gradient, GradientKind, Spread, Stop
from ...document.model import MAX_MAGNITUDE, Vector
from ...view_model.geometry.extents import extent_of
from ..errors import ExchangeError
from .elements import Elements
from .lengths import Viewport, length
from .matrices import combined, moved, transform_of
from .xml_tree import tag_of

KINDS = {"linearGradient": GradientKind.LINEAR, "radialGradient": GradientKind.RADIAL}
"""The kinds of gradients by their elements."""

_LONGEST_CHAIN = 20
"""Gradients that take what they do not say from each other."""

_BOX = "objectBoundingBox"
_SIDES = {"fx": "cx", "fy": "cy"}
"""Lengths whose percentages are those of others."""


@dataclass(frozen=True, eq=False)
class Ground:
    """Place where something is painted.

    Attributes
    ----------
    matrix
        (2, 3), from its user units to the document's plane.
    viewport
        What percentages are parts of.
    outlines
        Of the shape in its user units, as cubic pieces.
    """

    matrix: FloatArray
    viewport: Viewport
    outlines: Sequence[FloatArray]

    @property
    def box(self) -> FloatArray:
        """The lower and the upper corner of the shape, (2, 2)."""
        return extent_of(np.concatenate(self.outlines))


class UnplacedError(Exception):
    """Nobody can say where a gradient lies."""


class Gradients:
    """The gradients of one file; `stop` reads a stop of them where `currentColor` is some colour."""

    def __init__(self, elements: Elements, stop: Callable[[ET.Element, str], Stop]) -> None:
        self._elements, self._stop = elements, stop

    def stops(self, element: ET.Element, current: str) -> tuple[Stop, ...]:
        """Return the stops of a gradient: its own, or else of that which it refers to."""
        for each in self._chain(element):
            if elements := [stop for stop in each if tag_of(stop) == "stop"]:
                return _ascending([self._stop(stop, current) for stop in elements])
        return ()

    def gradient(self, element: ET.Element, stops: Sequence[Stop], ground: Ground) -> Gradient:
        """Return a gradient as it paints on a ground.

        Raises
        ------
        UnplacedError
            For one that hangs on a size that nobody knows, or whose places no document can hold.
        """
        chain = self._chain(element)
        said: dict[str, str] = {}
        for each in reversed(chain):
            said |= each.attrib
        if len(stops) > MOST_STOPS:
            raise UnplacedError
        kind = KINDS[tag_of(element)]
        try:
            with np.errstate(all="ignore"):
                matrix, viewport = _units(said, ground)
                matrix = combined(matrix, transform_of(said.get("gradientTransform", "")))
                own = (_linear if kind is GradientKind.LINEAR else _radial)(said, viewport)
                places = moved(np.array(own), matrix)
        except (ExchangeError, TypeError):
            raise UnplacedError from None
        if not (np.abs(places) <= MAX_MAGNITUDE).all():
            raise UnplacedError
        start, end, side, *focus = [(float(x), float(y)) for x, y in places]
        spread = next((each for each in Spread if each.value == said.get("spreadMethod")), Spread.PAD)
        return Gradient(tuple(stops), kind, start, end, side, focus[0] if focus else None, spread)

    def begins_with_a_disc(self, element: ET.Element) -> bool:
        """Whether a gradient has its first colour all over a disc about its focus."""
        return any(each.get("fr", "0").rstrip("%") not in ("", "0") for each in self._chain(element))

    def _chain(self, element: ET.Element) -> list[ET.Element]:
        """Return a gradient and those that it refers to, one by the other."""
        chain = [element]
        while len(chain) < _LONGEST_CHAIN:
            target = self._elements.used(chain[-1])
            if target is None or tag_of(target) not in KINDS or target in chain:
                break
            chain.append(target)
        return chain


def _ascending(stops: Sequence[Stop]) -> tuple[Stop, ...]:
    """Return stops none of which lies before another that comes earlier."""
    found, least = list[Stop](), 0.0
    for stop in stops:
        least = max(least, stop.offset)
        found.append(replace(stop, offset=least))
    return tuple(found)


def _units(said: Mapping[str, str], ground: Ground) -> tuple[FloatArray, Viewport]:
    """Return the matrix from the units of a gradient to the plane, and what percentages are parts of."""
    if said.get("gradientUnits", _BOX) != _BOX:
        return ground.matrix, ground.viewport
    box = ground.box
    (x, y), (width, height) = box[0], np.ptp(box, axis=0)
    if not (width > 0 and height > 0):
        raise UnplacedError
    return combined(ground.matrix, np.array([[width, 0.0, x], [0.0, height, y]])), Viewport(1.0, 1.0)


def _linear(said: Mapping[str, str], viewport: Viewport) -> list[Vector]:
    """Return start, end and side in the units of the gradient."""
    defaults = {"x1": "0%", "y1": "0%", "x2": "100%", "y2": "0%"}
    x, y, end_x, end_y = (_length(said, name, text, viewport) for name, text in defaults.items())
    return [(x, y), (end_x, end_y), (x - (end_y - y), y + (end_x - x))]


def _radial(said: Mapping[str, str], viewport: Viewport) -> list[Vector]:
    """Return start, end, side and, where that is another place, the focus."""
    x, y, r = (_length(said, name, "50%", viewport) for name in ("cx", "cy", "r"))
    if r < 0:
        raise UnplacedError
    focus = tuple(
        _length(said, name, "", viewport) if name in said else middle
        for name, middle in (("fx", x), ("fy", y))
    )
    places = [(x, y), (x + r, y), (x, y + r)]
    return [*places, (focus[0], focus[1])] if math.dist(focus, (x, y)) > 0 else places


def _length(said: Mapping[str, str], name: str, default: str, viewport: Viewport) -> float:
    value = length(said.get(name, default), viewport.side(_SIDES.get(name, name)))
    if value is None:
        raise UnplacedError
    return value
