"""State that an SVG element passes on to those in it."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

import numpy as np

from curvecore.arrays import FloatArray

from .flaw import Flaw
from .lengths import Viewport
from .matrices import Box, moved
from .properties import Properties

_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Window:
    """A box beyond which nothing is shown.

    Attributes
    ----------
    box
        In the units of some element.
    matrix
        From those to the document's plane.
    element
        What has it.
    flaw
        What is said of that where something lies beyond.
    """

    box: Box
    matrix: FloatArray
    element: ET.Element
    flaw: Flaw

    def holds(self, points: FloatArray, reach: float = 0.0) -> bool:
        """Whether points (n, 2) of the document, and what is in reach of them, lie in it.

        Only boxes with upright edges know that.
        """
        x, y, width, height = self.box
        corners = moved(np.array([(x, y), (x + width, y + height)]), self.matrix)
        room = _ROUNDING * float(np.ptp(corners, axis=0).max())
        low, high = corners.min(axis=0) - room, corners.max(axis=0) + room
        low, high = low + reach, high - reach
        return bool((points >= low).all() and (points <= high).all())


@dataclass(frozen=True)
class Group:
    """A group around shapes.

    Attributes
    ----------
    number
        Another one for each, however they are called.
    name
        What the file calls it; empty where it does not.
    """

    number: int
    name: str


@dataclass(frozen=True, eq=False)
class State:
    """Inherited state of an element.

    Attributes
    ----------
    matrix
        (2, 3), to the document's plane.
    viewport
        What percentages are parts of.
    inside
        The `use` elements that show it, each by way of the next.
    groups
        Those around it, the outermost first.
    windows
        The boxes that it is shown in, but for that of the file.
    is_locked
        Whether Inkscape keeps it from being touched.
    copied
        What the element is called that a `use` copies; empty for any other.
    """

    matrix: FloatArray
    viewport: Viewport
    properties: Properties = field(default_factory=Properties)
    inside: tuple[ET.Element, ...] = ()
    groups: tuple[Group, ...] = ()
    windows: tuple[Window, ...] = ()
    is_locked: bool = False
    copied: str = ""
