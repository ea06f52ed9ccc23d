"""Groups of an SVG file as those of a document."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

from ...document.empty_layer import EmptyLayer
from ...document.style import PLAIN_STYLE
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
    visible, locked
        What it says of a layer in which there is nothing.
    anchor
        What it is in the file.
    """

    number: int
    name: str
    is_layer: bool = False
    visible: bool = True
    locked: bool = False
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
    source
        The element of its own that it is of, however often that is shown, and which path of it.
    """

    path: ImportedPath
    element: int
    groups: tuple[Group, ...]
    anchor: Anchor
    state: State
    scale: float = 1.0
    source: tuple[ET.Element, int] | None = None


def is_seen(drawn: Drawn) -> bool:
    """Whether a path has a paint, or is the frame of something."""
    style, form = drawn.path.look.style, drawn.path.form
    return style.has_stroke or style.has_fill or (form is not None and form.is_content)


def with_line(drawn: Drawn) -> Drawn:
    """Return a shape without any paint as a line."""
    return replace(drawn, path=replace(drawn.path, look=replace(drawn.path.look, style=PLAIN_STYLE)))


class Settled(NamedTuple):
    """Paths with the names of their groups, the layers, and the name of each group."""

    paths: list[ImportedPath]
    layers: tuple[str, ...]
    empty_layers: tuple[EmptyLayer, ...]
    names: Mapping[Group, str]


def settled(drawn: Sequence[Drawn], layers: Sequence[tuple[Group, ...]] = ()) -> Settled:
    """Return paths with the names of their groups, another one for each.

    A group without a name, around a single shape, is none. The `layers` of the file are there in any case,
    each with those around it.
    """
    held: dict[Group, set[int]] = {}
    for each in drawn:
        for group in each.groups:
            held.setdefault(group, set()).add(each.element)
    kept = {group for group, elements in held.items() if group.name or group.is_layer or len(elements) > 1}
    names = _Given()
    paths = [names.given(each, [group for group in each.groups if group in kept]) for each in drawn]
    empty = tuple(names.empty(each) for each in layers if each[-1] not in held)
    order = tuple(names.name(each[-1]) for each in layers)
    return Settled(paths, order, empty, names.of_group)


class _Given:
    """Names that were given to groups, in `of_group`, and to shapes."""

    def __init__(self) -> None:
        self.of_group: dict[Group, str] = {}
        self._of_shape: dict[int, str] = {}
        self._groups, self._shapes = Names(), Names()

    def name(self, group: Group) -> str:
        """Return the name of a group."""
        return self._chain([group])[0]

    def empty(self, layers: Sequence[Group]) -> EmptyLayer:
        """Return a layer without paths, the last of those within each other."""
        *around, own = self._chain(layers)
        return EmptyLayer(own, around[-1] if around else "", layers[-1].visible, layers[-1].locked)

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
