"""Groups of an SVG file as those of a document."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...document.style import PLAIN_STYLE
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
    """

    number: int
    name: str


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


def settled(drawn: Sequence[Drawn]) -> list[ImportedPath]:
    """Return paths with the names of their groups, another one for each.

    A group without a name, around a single shape, is none.
    """
    held = _held(drawn)
    kept = {group for group, elements in held.items() if group.name or len(elements) > 1}
    names = _Given()
    return [names.given(each, [group for group in each.groups if group in kept]) for each in drawn]


class _Given:
    """Names that were given to groups and to shapes."""

    def __init__(self) -> None:
        self._of_group: dict[Group, str] = {}
        self._of_shape: dict[int, str] = {}
        self._groups, self._shapes = Names(), Names()

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
                self._of_group[group] = self._groups.different(group.name or "Group")
        return tuple(self._of_group[group] for group in groups)
