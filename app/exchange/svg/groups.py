"""Groups of an SVG file as those of a document."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from ...document.empty_layer import EmptyLayer
from ...document.style import PLAIN_STYLE
from ..cubics_in import ImportedPath
from ..naming import Names
from .state import Group


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
    """

    path: ImportedPath
    element: int
    groups: tuple[Group, ...]


def is_seen(drawn: Drawn) -> bool:
    """Whether a path has a paint."""
    style = drawn.path.look.style
    return style.has_stroke or style.has_fill


def with_line(drawn: Drawn) -> Drawn:
    """Return a shape without any paint as a line."""
    return replace(drawn, path=replace(drawn.path, look=replace(drawn.path.look, style=PLAIN_STYLE)))


def _held(drawn: Sequence[Drawn]) -> dict[Group, set[int]]:
    """Return which elements are in each group."""
    held: dict[Group, set[int]] = {}
    for each in drawn:
        for group in each.groups:
            held.setdefault(group, set()).add(each.element)
    return held


def _is_one(group: Group, elements: Collection[int]) -> bool:
    return bool(group.name) or group.is_layer or len(elements) > 1


class Settled(NamedTuple):
    """Paths with the names of their groups, and the layers."""

    paths: list[ImportedPath]
    layers: tuple[str, ...]
    empty_layers: tuple[EmptyLayer, ...]


def settled(drawn: Sequence[Drawn], layers: Sequence[tuple[Group, ...]] = ()) -> Settled:
    """Return paths with the names of their groups, another one for each.

    A group without a name, around a single shape, is none. The `layers` of the file are there in any case,
    each with those around it.
    """
    held = _held(drawn)
    kept = {group for group, elements in held.items() if _is_one(group, elements)}
    names = _Given()
    paths = [names.given(each, [group for group in each.groups if group in kept]) for each in drawn]
    empty = tuple(names.empty(each) for each in layers if each[-1] not in held)
    order = tuple(names.name(each[-1]) for each in layers)
    return Settled(paths, order, empty)


class _Given:
    """Names that were given to groups and to shapes."""

    def __init__(self) -> None:
        self._of_group: dict[Group, str] = {}
        self._of_shape: dict[int, str] = {}
        self._groups, self._shapes = Names(), Names()

    def name(self, group: Group) -> str:
        """Return the name of a group."""
        return self._chain([group])[0]

    def empty(self, layers: Sequence[Group]) -> EmptyLayer:
        """Return a layer without paths, the last of those within each other."""
        *around, own = self._chain(layers)
        last = layers[-1]
        return EmptyLayer(own, around[-1] if around else "", last.visible, last.locked)

    def given(self, drawn: Drawn, groups: Sequence[Group]) -> ImportedPath:
        """Return a path with names of its groups, and one of its shape, that no others have."""
        chain = self._chain(groups)
        look = replace(drawn.path.look, shape=self._shape(drawn), groups=chain)
        return replace(drawn.path, look=look)

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
