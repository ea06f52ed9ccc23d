"""Elements of a source put in the order and the groups of a document."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from ...naming import Names
from ..numbers import number
from ..tree import stem
from .courses import NEW_COURSE
from .looks import declare, declares
from .source import Node, Source

_NOTES = ("title", "desc", "metadata")
_REFERENCE = re.compile(r"""["'(]#([^"')]+)["')]""")
_HOLDERS = ("g", "a", "switch")


@dataclass(frozen=True)
class GroupWanted:
    """A group of the document.

    Attributes
    ----------
    name
        What it is called.
    number
        The place of its element among all of the file; None for a new one.
    is_layer
        Whether it is a layer.
    renamed, layer_changed
        Whether the file says something else.
    hides, locks
        Whether it is to be hidden, or locked, as a whole; None where it stays as it is.
    opacity
        The opacity that its element is to declare; None where it stays as it is.
    """

    name: str
    number: int | None = None
    is_layer: bool = False
    renamed: bool = False
    layer_changed: bool = False
    hides: bool | None = None
    locks: bool | None = None
    opacity: float | None = None


@dataclass(frozen=True)
class Entry:
    """What shows one or several shapes of the document.

    Attributes
    ----------
    shapes
        Their places in the document.
    groups
        The names of the groups around, from the outermost on: each stands for a group.
    number
        The place of the element among all of the file; None for a new one.
    identity
        Id of a new one; empty for one of the name.
    name
        What a new one is called; empty for one that is not called anything new.
    of
        The place in the document of what a new one, a clone, is to show; None for a path.
    """

    shapes: tuple[int, ...]
    groups: tuple[str, ...]
    number: int | None = None
    identity: str = ""
    name: str = ""
    of: int | None = None

    @property
    def key(self) -> int | None:
        """What it is known by where it is to be put there otherwise; None of what cannot be."""
        return -1 - self.shapes[0] if self.of is not None else self.number


class Placing:
    """Places the elements of one source.

    Attributes
    ----------
    nodes
        The element of each entry.
    groups, owners
        That of each group, by its name, and all elements that are groups, and the outermost one.
    """

    def __init__(
        self,
        source: Source,
        entries: Sequence[Entry],
        groups: Mapping[str, GroupWanted],
        removed: Sequence[int],
        dissolved: Sequence[int],
    ) -> None:
        self._source, self._groups = source, groups
        self._all = list(source.root.walk())
        self._number = {node: number for number, node in enumerate(self._all)}
        free = {each.identity for each in entries} & {self._all[each].get("id") or "" for each in removed}
        self._ids = Names(source.ids - free, between="_")
        self.groups = {name: self._group(each) for name, each in groups.items()}
        self._kept = {*self.groups.values(), source.root}
        self.owners = {*self._kept, *(self._all[each] for each in dissolved)}
        self._remove([self._all[each] for each in removed])
        self.nodes = [self._shape(each) for each in entries]
        self._refer(entries)
        self._arrange(source.root, list(zip(entries, self.nodes, strict=True)), 0)

    # Elements

    def _group(self, wanted: GroupWanted) -> Node:
        source = self._source
        if wanted.number is None:
            node = source.new("g")
            kind = "layer" if wanted.is_layer else "group"
            node.set("id", self._ids.different(stem(wanted.name, kind)))
        else:
            node = self._all[wanted.number]
        if wanted.number is None or wanted.layer_changed:
            if wanted.is_layer:
                node.set(source.inkscape("groupmode"), "layer")
            elif wanted.number is not None:
                node.drop(source.inkscape("groupmode"))
        if wanted.number is None or wanted.renamed:
            node.set(source.inkscape("label"), wanted.name)
        if wanted.hides is not None:
            show(node, not wanted.hides)
        if wanted.locks is not None:
            lock(source, node, wanted.locks)
        if wanted.opacity is not None:
            # It may have been a rule that said it.
            has_rules = wanted.number is not None and not declares(node, "opacity")
            declare(node, "opacity", number(wanted.opacity), has_rules=has_rules)
        return node

    def _shape(self, entry: Entry) -> Node:
        if entry.number is not None:
            node = self._all[entry.number]
        else:
            node = self._source.new("path" if entry.of is None else "use")
            node.set("id", self._ids.different(entry.identity or stem(entry.name, "curve")))
            if entry.of is None:
                node.set("d", NEW_COURSE)
        if entry.name and entry.name != node.get("id"):
            node.set(self._source.inkscape("label"), entry.name)
        return node

    def _refer(self, entries: Sequence[Entry]) -> None:
        """Let new clones show what they are of."""
        shown = {entry.shapes[0]: node for entry, node in zip(entries, self.nodes, strict=True)}
        for entry, node in zip(entries, self.nodes, strict=True):
            if entry.of is None:
                continue
            original = shown[entry.of]
            if not original.get("id"):
                original.set("id", self._ids.different("original"))
            node.set(self._source.xlink("href"), f"#{original.get('id')}")

    def _remove(self, nodes: Sequence[Node]) -> None:
        """Take elements out; one that something else refers to is only not shown any more."""
        out = [node for node in nodes if node.parent is not None]
        for node in out:
            self._take_away(node)
        while out:
            referred = set(_REFERENCE.findall(self._source.text))
            wanted = [node for node in out if any(each.get("id") in referred for each in node.walk())]
            if not wanted:
                return
            for node in wanted:
                node.put_last(definitions(self._source))
            out = [node for node in out if node.parent is None]

    def _take_away(self, node: Node) -> None:
        """Take an element out, and the groups around it that nothing is left in."""
        around = node.parent
        node.take_out()
        if around is not None:
            self._prune(around)

    def _prune(self, node: Node) -> None:
        """Take out groups that nothing is left in, but for layers and those that something comes to."""
        is_layer = any(name.endswith(":groupmode") for name in node.names)
        is_empty = all(each.tag in _NOTES for each in node.elements)
        if node.tag in _HOLDERS and is_empty and not is_layer and node not in self._kept and node.parent:
            self._take_away(node)

    # Order

    def _arrange(self, container: Node, entries: list[tuple[Entry, Node]], depth: int) -> None:
        """Put what is to be in a container into it, in this order, and that in groups into these."""
        items: list[tuple[Node, list[tuple[Entry, Node]]]] = []
        for name, run in groupby(entries, lambda pair: pair[0].groups[depth : depth + 1]):
            pairs = list(run)
            items += [(self.groups[name[0]], pairs)] if name else [(node, []) for _, node in pairs]
        nodes = [node for node, _ in items]
        staying = self._staying(container, nodes)
        for node in nodes:
            if node not in staying and node.parent is not None:
                self._take_away(node)
        self._put(container, nodes, staying)
        for node, inner in items:
            if inner:
                self._arrange(node, inner, depth + 1)

    def _staying(self, container: Node, nodes: list[Node]) -> set[Node]:
        """Return as many as may stay where they are."""
        here = [node for node in nodes if node in self._number and self._owner(node) is container]
        places = [self._number[node] for node in here]
        return {here[index] for index in longest_ascent(places)}

    def _owner(self, node: Node) -> Node | None:
        around = node.parent
        while around is not None and around not in self.owners:
            around = around.parent
        return around

    def _put(self, container: Node, nodes: list[Node], staying: set[Node]) -> None:
        last = max((index for index, node in enumerate(nodes) if node in staying), default=-1)
        before: Node | None = None
        for index, node in enumerate(nodes):
            if node in staying:
                before = node
            elif index > last:
                node.put_last(container)
            elif before is not None:
                node.put_behind(_child_of(container, before))
                before = node
            else:
                first = next(each for each in nodes if each in staying)
                node.put_before(_child_of(container, first))
                before = node


def _child_of(container: Node, node: Node) -> Node:
    """Return what in a container holds an element."""
    while node.parent is not None and node.parent is not container:
        node = node.parent
    return node


def longest_ascent(values: Sequence[int]) -> list[int]:
    """Return the places of a longest ascending part of different numbers."""
    ends: list[int] = []
    places: list[int] = []
    before: list[int] = []
    for place, value in enumerate(values):
        length = bisect_left(ends, value)
        before.append(places[length - 1] if length else -1)
        ends[length : length + 1] = [value]
        places[length : length + 1] = [place]
    found: list[int] = []
    place = places[-1] if places else -1
    while place >= 0:
        found.append(place)
        place = before[place]
    return found[::-1]


def definitions(source: Source) -> Node:
    """Return the element for what is not drawn in its place, which may be new."""
    found = next((each for each in source.root.elements if each.tag == "defs"), None)
    if found is None:
        found = source.new("defs")
        if source.root.elements:
            found.put_before(source.root.elements[0])
        else:
            found.put_last(source.root)
    return found


def show(node: Node, visible: bool) -> None:
    """Show or hide an element."""
    if not visible:
        # Not as an attribute: Inkscape would not show it again.
        declare(node, "display", "none", has_rules=True)
        return
    if declares(node, "display"):
        declare(node, "display", "inline")
    if declares(node, "visibility"):
        declare(node, "visibility", "visible")


def lock(source: Source, node: Node, locked: bool) -> None:
    """Lock an element for Inkscape, or let it be touched."""
    if locked:
        node.set(source.sodipodi("insensitive"), "true")
    else:
        node.drop(source.sodipodi("insensitive"))
