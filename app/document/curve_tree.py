"""Shapes and groups of a document as a tree over its curves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from enum import Enum, auto

import msgspec

from .model import Curve
from .words import count_of, enumerated


class NodeKind(Enum):
    """A curve, or what holds several."""

    CURVE = auto()
    SHAPE = auto()
    GROUP = auto()


class Container(msgspec.Struct, frozen=True):
    """Surroundings of a curve: the groups that it is in, the outermost first, and the shape."""

    groups: tuple[str, ...] = ()
    shape: str = ""

    @property
    def depth(self) -> int:
        """The number of shapes and groups."""
        return len(self.groups) + bool(self.shape)

    @property
    def around(self) -> Container:
        """The surroundings of the innermost."""
        return Container(self.groups if self.shape else self.groups[:-1])

    def holds(self, curve: Curve) -> bool:
        """Whether a curve is in it."""
        is_in_groups = curve.groups[: len(self.groups)] == self.groups
        return is_in_groups and (not self.shape or curve.shape == self.shape)


OUTSIDE = Container()


class Node(msgspec.Struct, frozen=True):
    """A curve, or a shape or a group with what is in it.

    Attributes
    ----------
    kind, name
        What it is, and what it is called.
    places
        The places of its curves in the document, one after the other.
    around
        What it is in.
    parts
        What is in it, in the order of the document; nothing in a curve.
    """

    kind: NodeKind
    name: str
    places: range
    around: Container = OUTSIDE
    parts: tuple[Node, ...] = ()

    @property
    def depth(self) -> int:
        """The number of shapes and groups around it."""
        return self.around.depth

    @property
    def inside(self) -> Container:
        """The surroundings of what is in it."""
        groups = self.around.groups
        if self.kind is NodeKind.GROUP:
            return Container((*groups, self.name))
        return Container(groups, self.name)

    def walk(self) -> Iterator[Node]:
        """Yield it and all that is in it."""
        yield self
        for part in self.parts:
            yield from part.walk()


_last: tuple[Sequence[Curve], tuple[Node, ...]] = ((), ())


def tree_of(curves: Sequence[Curve]) -> tuple[Node, ...]:
    """Return the curves, shapes and groups that are in nothing else, in order.

    That of the last curves asked for is kept: all actions ask, at every step, what is chosen of them.
    """
    global _last  # noqa: PLW0603
    if _last[0] is not curves or not isinstance(curves, tuple):
        _last = curves, tuple(_nodes(curves, range(len(curves)), ()))
    return _last[1]


def _nodes(curves: Sequence[Curve], places: range, around: tuple[str, ...]) -> Iterator[Node]:
    depth, place, here = len(around), places.start, Container(around)
    while place < places.stop:
        curve, end = curves[place], place + 1
        if len(curve.groups) > depth:
            end = _run_end(curves, place, depth, places.stop)
            name = curve.groups[depth]
            parts = tuple(_nodes(curves, range(place, end), (*around, name)))
            yield Node(NodeKind.GROUP, name, range(place, end), here, parts)
        elif curve.shape:
            while end < places.stop and curves[end].shape == curve.shape:
                end += 1
            within = Container(around, curve.shape)
            leaves = (
                Node(NodeKind.CURVE, curves[i].name, range(i, i + 1), within) for i in range(place, end)
            )
            yield Node(NodeKind.SHAPE, curve.shape, range(place, end), here, tuple(leaves))
        else:
            yield Node(NodeKind.CURVE, curve.name, range(place, end), here)
        place = end


def _run_end(curves: Sequence[Curve], place: int, depth: int, stop: int) -> int:
    """Return where the group that a curve is in at a depth ends."""
    path, end = curves[place].groups[: depth + 1], place + 1
    while end < stop and curves[end].groups[: depth + 1] == path:
        end += 1
    return end


def counted_nodes(nodes: Sequence[Node], adjective: str = "") -> str:
    """Return "3 curves", or "1 group and 2 curves": how many there are of each kind."""
    counts = Counter(node.kind for node in nodes)
    found = [kind for kind in reversed(NodeKind) if counts[kind]]
    return enumerated([count_of(counts[kind], f"{adjective}{kind.name.lower()}") for kind in found])


def group_around(curves: Sequence[Curve], place: int, depth: int) -> range:
    """Return the places of the group that a curve is in at a depth, 0 for the outermost."""
    path, start = curves[place].groups[: depth + 1], place
    while start > 0 and curves[start - 1].groups[: depth + 1] == path:
        start -= 1
    return range(start, _run_end(curves, place, depth, len(curves)))


def whole_nodes(curves: Sequence[Curve], chosen: Collection[int], left: Collection[str] = ()) -> list[Node]:
    """Return the largest parts of the tree all of whose curves are chosen; of groups `left` their parts."""
    return list(_wholes(tree_of(curves), frozenset(chosen), frozenset(left)))


def _wholes(nodes: Sequence[Node], chosen: frozenset[int], left: frozenset[str]) -> Iterator[Node]:
    for node in nodes:
        is_left = node.kind is NodeKind.GROUP and node.name in left
        if not is_left and chosen.issuperset(node.places):
            yield node
        else:
            yield from _wholes(node.parts, chosen, left)
