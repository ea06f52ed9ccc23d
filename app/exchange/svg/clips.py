"""Boxes beyond which nothing of a file is shown: view boxes, and clip paths that are upright rectangles."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from curvecore.arrays import FloatArray

from ..errors import ExchangeError, Flaw
from .lengths import Viewport
from .matrices import Box, moved
from .path_data import Subpath
from .shapes import SHAPES, outline_of
from .xml_tree import Elements, tag_of

_ROUNDING = 1e-9
_DRAWS = (*SHAPES, "use", "g", "text", "image")


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


def clip_box(elements: Elements, declared: Mapping[str, str], viewport: Viewport) -> Box | None:
    """Return the upright rectangle that a `clip-path` is, in the units of what has it; else None.

    Programs put one around all that they draw.
    """
    clip = elements.referred(declared.get("clip-path", "none"))
    if clip is None or tag_of(clip) != "clipPath" or _hangs_on_box(clip):
        return None
    if "clip-path" in elements.declared(clip):
        return None
    parts = [each for each in clip if tag_of(each) in _DRAWS]
    if len(parts) != 1:
        return None
    part = parts[0]
    if tag_of(part) == "use" and not (part.get("x") or part.get("y")):
        # An element without others in it counts as false.
        target = elements.used(part)
        part = part if target is None else target
    if tag_of(part) not in SHAPES or any(each.get("transform") for each in (clip, parts[0], part)):
        return None
    try:
        return _rectangle(outline_of(part, viewport, None).subpaths)
    except ExchangeError:
        return None


def _hangs_on_box(clip: ET.Element) -> bool:
    """Whether a clip is a share of the box around what has it."""
    return clip.get("clipPathUnits") == "objectBoundingBox"


def _rectangle(subpaths: list[Subpath]) -> Box | None:
    if len(subpaths) != 1:
        return None
    controls = subpaths[0].controls
    ends = [tuple(point) for point in controls[:, 0].tolist()]
    steps = controls[:, 3] - controls[:, 0]
    # Four sides, each along an axis, and straight: all control points of each lie on it.
    is_upright = len(ends) == 4 and bool((np.count_nonzero(np.ptp(controls, axis=1), axis=1) == 1).all())
    if not is_upright or not np.array_equal(steps[:2], -steps[2:]):
        return None
    low, high = controls.min(axis=(0, 1)).tolist(), controls.max(axis=(0, 1)).tolist()
    return (low[0], low[1], high[0] - low[0], high[1] - low[1])
