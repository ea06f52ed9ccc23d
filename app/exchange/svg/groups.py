"""Groups of an SVG file as those of a document."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from ..cubics_in import ImportedPath
from ..naming import Names


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
    """

    number: int
    name: str
    is_layer: bool = False


@dataclass(frozen=True, eq=False)
class Drawn:
    """A path, the number of its element, and the groups around it."""

    path: ImportedPath
    element: int
    groups: tuple[Group, ...]


class Settled(NamedTuple):
    """Paths with the names of their groups, and which of these are layers."""

    paths: list[ImportedPath]
    layers: tuple[str, ...]


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
    return Settled(paths, names.layers)


class _Given:
    """Names that were given to groups and shapes."""

    def __init__(self) -> None:
        self._of_group: dict[Group, str] = {}
        self._of_shape: dict[int, str] = {}
        self._groups, self._shapes = Names(), Names()

    @property
    def layers(self) -> tuple[str, ...]:
        """The names of the groups that are layers."""
        return tuple(name for group, name in self._of_group.items() if group.is_layer)

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
            if group not in self._of_group:
                usual = "Layer" if group.is_layer else "Group"
                self._of_group[group] = self._groups.different(group.name or usual)
        return tuple(self._of_group[group] for group in groups)
