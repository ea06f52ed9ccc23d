"""Groups of an SVG file as those of a document."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

from ..cubics_in import ImportedPath
from ..naming import Names

if TYPE_CHECKING:
    from .state import State


@dataclass(frozen=True, eq=False)
class Anchor:
    """What in a file shows something: its element, or the outermost `use` of it; with the state around."""

    element: ET.Element
    around: State


@dataclass(frozen=True)
class Group:
    """A group around shapes.

    Attributes
    ----------
    number
        Another one for each, however they are called.
    name
        What the file calls it; empty where it does not.
    is_layer
        Whether it is a layer of Inkscape's, in nothing but layers.
    anchor
        What it is in the file.
    """

    number: int
    name: str
    is_layer: bool = False
    anchor: Anchor | None = field(default=None, compare=False)


@dataclass(frozen=True, eq=False)
class Drawn:
    """A path as it is drawn.

    Attributes
    ----------
    path
        The path.
    element
        The number of its element, another one each time that this is drawn.
    groups
        Those around it.
    anchor
        What shows it.
    state
        That of its element.
    scale
        By how much its stroke is enlarged.
    """

    path: ImportedPath
    element: int
    groups: tuple[Group, ...]
    anchor: Anchor
    state: State
    scale: float = 1.0


class Settled(NamedTuple):
    """Paths with the names of their groups, which of these are layers, and the name of each group."""

    paths: list[ImportedPath]
    layers: tuple[str, ...]
    names: Mapping[Group, str]


def settled(drawn: Sequence[Drawn]) -> Settled:
    """Return paths with the names of their groups, another one for each.

    A group without a name, around a single shape, is none.
    """
    held: dict[Group, set[int]] = {}
    for each in drawn:
        for group in each.groups:
            held.setdefault(group, set()).add(each.element)
    kept = {group for group, elements in held.items() if group.name or group.is_layer or len(elements) > 1}
    names = _Given()
    paths = [names.given(each, [group for group in each.groups if group in kept]) for each in drawn]
    return Settled(paths, names.layers, names.of_group)


class _Given:
    """Names that were given to groups, in `of_group`, and to shapes."""

    def __init__(self) -> None:
        self.of_group: dict[Group, str] = {}
        self._of_shape: dict[int, str] = {}
        self._groups, self._shapes = Names(), Names()

    @property
    def layers(self) -> tuple[str, ...]:
        """The names of the groups that are layers."""
        return tuple(name for group, name in self.of_group.items() if group.is_layer)

    def given(self, drawn: Drawn, groups: Sequence[Group]) -> ImportedPath:
        """Return a path with names of its groups, and one of its shape, that no others have."""
        look = drawn.path.look
        return replace(drawn.path, look=replace(look, shape=self._shape(drawn), groups=self._chain(groups)))

    def _shape(self, drawn: Drawn) -> str:
        wanted = drawn.path.look.shape
        if wanted and drawn.element not in self._of_shape:
            self._of_shape[drawn.element] = self._shapes.different(wanted)
        return self._of_shape.get(drawn.element, "")

    def _chain(self, groups: Sequence[Group]) -> tuple[str, ...]:
        """Return the names of groups within each other."""
        for group in groups:
            if group not in self.of_group:
                usual = "Layer" if group.is_layer else "Group"
                self.of_group[group] = self._groups.different(group.name or usual)
        return tuple(self.of_group[group] for group in groups)
