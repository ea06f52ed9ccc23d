"""Patterns of SVG as those of a document, in its plane.

Reference: Scalable Vector Graphics 2, section 14.3.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping

import numpy as np

from curvecore.arrays import FloatArray

from ...document.gradient import MOST_LETTERS, Gradient, GradientKind, Tile
from ...document.model import MAX_MAGNITUDE
from ...document.patterns import colouring
from ..errors import ExchangeError
from .elements import Elements
from .gradients import Ground, UnplacedError
from .lengths import Viewport, length
from .matrices import Box, box_of, combined, fitted_box, moved, transform_of
from .tiles import TileBody
from .xml_tree import tag_of

PATTERN = "pattern"
"""The element of a pattern."""

_LONGEST_CHAIN = 20
_BOX = "objectBoundingBox"


class Patterns:
    """The patterns of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def pattern(self, element: ET.Element, ground: Ground, colour: str) -> Gradient:
        """Return a pattern as it paints on a ground; a `colour` stands for it where there are none.

        Raises
        ------
        UnplacedError
            For one that shows nothing, hangs on a size that nobody knows, or that no document can hold.
        """
        chain = self._chain(element)
        said: dict[str, str] = {}
        for each in reversed(chain):
            said |= each.attrib
        holder = next((each for each in chain if len(each)), None)
        if holder is None:
            raise UnplacedError
        try:
            with np.errstate(all="ignore"):
                place = _place(said, ground)
                matrix = combined(ground.matrix, transform_of(said.get("patternTransform", "")))
                x, y, width, height = place
                corners = moved(np.array([(x, y), (x + width, y), (x, y + height)]), matrix)
                content = _content(said, ground, place)
        except (ExchangeError, TypeError):
            raise UnplacedError from None
        if not (np.abs(corners) <= MAX_MAGNITUDE).all():
            raise UnplacedError
        (across, _, right), (_, down, below) = content.tolist()
        view = (-right / across, -below / down, float(width / across), float(height / down))
        if not (np.abs(view) <= MAX_MAGNITUDE).all():
            raise UnplacedError
        body = TileBody(self._elements).of_pattern(element, holder)
        if len(body) > MOST_LETTERS:
            raise UnplacedError
        start, end, side = [(float(a), float(b)) for a, b in corners]
        return Gradient(
            colouring(colour),
            GradientKind.PATTERN,
            start,
            end,
            side,
            # Written and read again it is the same, without a zero that has a sign.
            tile=Tile(body, (view[0] + 0.0, view[1] + 0.0, view[2], view[3])),
        )

    def _chain(self, element: ET.Element) -> list[ET.Element]:
        """Return a pattern and those that it refers to, one by the other."""
        chain = [element]
        while len(chain) < _LONGEST_CHAIN:
            target = self._elements.used(chain[-1])
            if target is None or tag_of(target) != PATTERN or target in chain:
                break
            chain.append(target)
        return chain


def _place(said: Mapping[str, str], ground: Ground) -> Box:
    """Return the first tile in user units: left, top, width and height."""
    if said.get("patternUnits", _BOX) == _BOX:
        (left, top), (across, down) = _box(ground)
        x, y, width, height = (_length(said, name, Viewport(1.0, 1.0)) for name in _SIDES)
        place = (left + x * across, top + y * down, width * across, height * down)
    else:
        place = tuple(_length(said, name, ground.viewport) for name in _SIDES)  # type: ignore[assignment]
    if not (place[2] > 0 and place[3] > 0):
        raise UnplacedError
    return place


_SIDES = ("x", "y", "width", "height")


def _content(said: Mapping[str, str], ground: Ground, place: Box) -> FloatArray:
    """Return the matrix (2, 3) from the units of what a pattern shows to the tile, from (0, 0) on.

    The corner of the tile is the origin of these units, too, wherever that lies: all programs have it so.
    """
    _, _, width, height = place
    if view := box_of(said.get("viewBox", "")):
        return fitted_box(view, (0.0, 0.0, width, height), said.get("preserveAspectRatio", ""))
    if said.get("patternContentUnits") == _BOX:
        _, (across, down) = _box(ground)
        return np.array([[across, 0.0, 0.0], [0.0, down, 0.0]])
    return np.eye(2, 3)


def _box(ground: Ground) -> tuple[FloatArray, FloatArray]:
    """Return the upper left corner of a shape and its size."""
    box = ground.box
    size = np.ptp(box, axis=0)
    if not (size > 0).all():
        raise UnplacedError
    return box[0], size


def _length(said: Mapping[str, str], name: str, viewport: Viewport) -> float:
    value = length(said.get(name, "0"), viewport.side(name))
    if value is None:
        raise UnplacedError
    return value
