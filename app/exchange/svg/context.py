"""Surroundings of a path: the groups that it lies in, and the boxes that cut it."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from curvecore.arrays import FloatArray

from ...document.style import PLAIN_STYLE
from ..cubics_in import ImportedPath
from ..errors import ExchangeError, Loss
from ..unique_names import UniqueNames
from .coordinates import Box, Viewport, transform_points
from .shapes import SHAPES, Subpath, outline_of
from .xml_tree import Elements, tag_of


@dataclass(frozen=True)
class Group:
    """A group around shapes.

    Attributes
    ----------
    number
        Unique number, whatever the name.
    name
        Name in the file; empty without one.
    """

    number: int
    name: str


@dataclass(frozen=True, eq=False)
class DrawnPath:
    """A path as it is drawn.

    Attributes
    ----------
    path
        The path.
    element
        Number of its element, another one each time that the element is drawn.
    groups
        Groups around the path.
    """

    path: ImportedPath
    element: int
    groups: tuple[Group, ...]


def is_painted(drawn: DrawnPath) -> bool:
    """Whether a path has a paint."""
    style = drawn.path.look.style
    return style.has_stroke or style.has_fill


def with_line(drawn: DrawnPath) -> DrawnPath:
    """Return a shape without any paint as a line."""
    return replace(drawn, path=replace(drawn.path, look=replace(drawn.path.look, style=PLAIN_STYLE)))


def _elements_of_groups(drawn: Sequence[DrawnPath]) -> dict[Group, set[int]]:
    """Return the elements in each group."""
    held: dict[Group, set[int]] = {}
    for path in drawn:
        for group in path.groups:
            held.setdefault(group, set()).add(path.element)
    return held


def with_group_names(drawn: Sequence[DrawnPath]) -> list[ImportedPath]:
    """Return paths with unique names for their groups.

    A group without a name around a single shape is dropped.
    """
    held = _elements_of_groups(drawn)
    groups_in_use = {group for group, elements in held.items() if group.name or len(elements) > 1}
    names = _GivenNames()
    return [names.given(path, [group for group in path.groups if group in groups_in_use]) for path in drawn]


class _GivenNames:
    """Names that were given to groups and to shapes."""

    def __init__(self) -> None:
        self._of_group: dict[Group, str] = {}
        self._of_shape: dict[int, str] = {}
        self._groups, self._shapes = UniqueNames(), UniqueNames()

    def given(self, drawn: DrawnPath, groups: Sequence[Group]) -> ImportedPath:
        """Return a path with unique names for its groups and its shape."""
        chain = self._chain(groups)
        look = replace(drawn.path.look, shape=self._shape(drawn), groups=chain)
        return replace(drawn.path, look=look)

    def _shape(self, drawn: DrawnPath) -> str:
        wanted = drawn.path.look.shape
        if wanted and drawn.element not in self._of_shape:
            self._of_shape[drawn.element] = self._shapes.unique(wanted)
        return self._of_shape.get(drawn.element, "")

    def _chain(self, groups: Sequence[Group]) -> tuple[str, ...]:
        """Return the names of groups within each other."""
        for group in groups:
            if group not in self._of_group:
                self._of_group[group] = self._groups.unique(group.name or "Group")
        return tuple(self._of_group[group] for group in groups)


# Boxes that cut


_ROUNDING = 1e-9
_DRAWS = (*SHAPES, "use", "g", "text", "image")


@dataclass(frozen=True, eq=False)
class ClipBox:
    """A box beyond which nothing is shown.

    Attributes
    ----------
    box
        Box in the units of `element`.
    matrix
        Matrix from those units to the document's plane.
    element
        Element with the box.
    loss
        Loss to note where a shape lies outside the box.
    """

    box: Box
    matrix: FloatArray
    element: ET.Element
    loss: Loss

    def holds(self, points: FloatArray, reach: float = 0.0) -> bool:
        """Whether points (n, 2) of the document lie in the box, with `reach` to spare on every side.

        Only valid for boxes with upright edges.
        """
        x, y, width, height = self.box
        corners = transform_points(np.array([(x, y), (x + width, y + height)]), self.matrix)
        room = _ROUNDING * float(np.ptp(corners, axis=0).max())
        low, high = corners.min(axis=0) - room, corners.max(axis=0) + room
        low, high = low + reach, high - reach
        return bool((points >= low).all() and (points <= high).all())


def clip_box(elements: Elements, declared: Mapping[str, str], viewport: Viewport) -> Box | None:
    """Return the upright rectangle of a `clip-path`, in the units of its element; None for other shapes.

    Programs put one around their whole drawing.
    """
    clip = elements.target_of_property(declared.get("clip-path", "none"))
    if clip is None or tag_of(clip) != "clipPath" or clip.get("clipPathUnits") == "objectBoundingBox":
        return None
    if "clip-path" in elements.declared(clip):
        return None
    parts = [child for child in clip if tag_of(child) in _DRAWS]
    if len(parts) != 1:
        return None
    part = parts[0]
    if tag_of(part) == "use" and not (part.get("x") or part.get("y")):
        # An element without others in it counts as false.
        target = elements.target_of(part)
        part = part if target is None else target
    if tag_of(part) not in SHAPES or any(element.get("transform") for element in (clip, parts[0], part)):
        return None
    try:
        return _rectangle(outline_of(part, viewport, None).subpaths)
    except ExchangeError:
        return None


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
