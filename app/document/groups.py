"""Shapes and groups: their order in the document, their names, and the tree that they form.

A shape consists of neighbouring curves with the same `shape` name, drawn as one with one fill and one stroke;
a curve whose `shape` is empty is a shape by itself. A group consists of neighbouring curves whose `groups`
begin with the same names. Both are names in the curves, so that `tidy_shapes` makes a document consistent
again after any edit.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from enum import Enum, auto
from itertools import count, takewhile
from operator import attrgetter, is_

import msgspec
from msgspec.structs import replace

from .differences import reshaped_curves
from .model import Curve, Document
from .words import count_of, enumerated

# Shapes

SHARED = ("style", "groups", "visible", "locked")
"""Values that all curves of a shape have in common."""

_DEEPEST = 50
"""Groups that may be within each other."""

_looks = attrgetter(*SHARED, "shape")


def shape_of(document: Document, curve: int) -> range:
    """Return the places of the curves of the shape that a curve is a part of."""
    return shape_around(document.curves, curve)


def shape_around(curves: Sequence[Curve], curve: int) -> range:
    """Return the places of the curves of the shape that one of these curves is a part of."""
    name, first, end = curves[curve].shape, curve, curve + 1
    if name:
        while first > 0 and curves[first - 1].shape == name:
            first -= 1
        while end < len(curves) and curves[end].shape == name:
            end += 1
    return range(first, end)


def shape_ranges(curves: Sequence[Curve]) -> Iterator[range]:
    """Yield the places of the curves of each shape, in order."""
    first = 0
    for place in range(1, len(curves) + 1):
        name = curves[first].shape
        if place == len(curves) or not name or curves[place].shape != name:
            yield range(first, place)
            first = place


def shape_count_label(curves: Sequence[Curve]) -> str:
    """Return "3 curves", or "2 shapes" where some are of several curves."""
    shape_count = sum(1 for _ in shape_ranges(curves)) if curves else 0
    return count_of(shape_count, "curve" if shape_count == len(curves) else "shape")


def expand_to_shapes(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return curves with all others of their shapes."""
    found, values = set(curves), document.curves
    whole: set[int] = set()
    # Most of thousands are shapes by themselves.
    for curve in [each for each in found if values[each].shape]:
        if curve not in whole:
            whole.update(shape_of(document, curve))
    return frozenset(found | whole)


def tidy_shapes(document: Document, before: Document | None = None) -> Document:
    """Return the document with shapes that look the same all over, and all under names of their own.

    Edits may leave one curve of a shape, tear a shape or a group apart, or change how one of the curves of a
    shape looks; the first one of a shape then says what holds for all. `before` is tidy, and what is known of
    it is not looked for again.
    """
    if before is not None and (
        reshaped_curves(before, document) is not None or _look_the_same(before.curves, document.curves)
    ):
        return document
    if not any(curve.shape or curve.groups for curve in document.curves):
        return document
    curves = list(_with_own_groups(_with_whole_shapes(document)))
    if any(new is not old for new, old in zip(curves, document.curves, strict=True)):
        return replace(document, curves=tuple(curves))
    return document


def _look_the_same(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    """Whether nothing that shapes and groups are made of is another, nor at another place."""
    return len(before) == len(after) and all(
        new is old or all(map(is_, values := _looks(new), was := _looks(old))) or values == was
        for new, old in zip(after, before, strict=True)
    )


def _with_whole_shapes(document: Document) -> Iterator[Curve]:
    """Yield the curves, those of a shape with what its first one has, under a name that no other has."""
    used: set[str] = set()
    for places in shape_ranges(document.curves):
        parts = document.curves[places.start : places.stop]
        if not parts[0].shape and len(parts) == 1:
            yield parts[0]
            continue
        name = _free(parts[0].shape, used) if len(parts) > 1 else ""
        used.add(name)
        shared = {field: getattr(parts[0], field) for field in SHARED} | {"shape": name}
        for part in parts:
            yield with_field_values(part, shared)


def _with_own_groups(curves: Iterable[Curve]) -> Iterator[Curve]:
    """Yield the curves, those of each group in one that no others name, and in no more than there may be."""
    used: set[str] = set()
    before: tuple[str, ...] = ()
    names: list[str] = []
    for curve in curves:
        if not curve.groups:
            before, names = (), []
            yield curve
            continue
        groups = tuple(filter(None, curve.groups))[:_DEEPEST]
        if groups == before == curve.groups == tuple(names):
            yield curve
            continue
        names = names[: len(common_prefix(groups, before))]
        for name in groups[len(names) :]:
            names.append(_free(name, used))
            used.add(names[-1])
        before = groups
        yield with_field_values(curve, {"groups": tuple(names)})


def common_prefix(*groups: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names that all begin with."""
    pairs = takewhile(lambda names: len(set(names)) == 1, zip(*groups, strict=False))
    return tuple(names[0] for names in pairs)


def _free(name: str, used: Collection[str]) -> str:
    """Return the name, with a number where it is taken."""
    names = (f"{name} {number}" for number in count(2))
    return name if name not in used else next(each for each in names if each not in used)


def with_field_values(curve: Curve, values: Mapping[str, object]) -> Curve:
    """Return the curve with these values: itself where it has them."""
    is_so = all(getattr(curve, field) == value for field, value in values.items())
    return curve if is_so else replace(curve, **values)


def shape_problem(document: Document) -> str:
    """Return the first thing that is not as `tidy_shapes` leaves it, with its place; empty if none is."""
    tidy = tidy_shapes(document)
    if tidy is document:
        return ""
    if tidy.curves == document.curves:
        return ""
    place = next(
        i for i, pair in enumerate(zip(tidy.curves, document.curves, strict=True)) if pair[0] is not pair[1]
    )
    return f"curves[{place}].{_problem_at(place, tidy.curves, document.curves[place])}"


def _problem_at(place: int, tidy: Sequence[Curve], bad: Curve) -> str:
    """Return in what way a curve is not as it is in a tidy document."""
    good = tidy[place]
    if good.shape != bad.shape:
        return "shape must name two or more curves that follow each other, and no others"
    field = next(each for each in SHARED if getattr(good, each) != getattr(bad, each))
    if place and good.shape and good.shape == tidy[place - 1].shape:
        return f"{field} must be that of the curve before it, which is of the same shape"
    return f"groups must name {_DEEPEST} groups at most, each of curves that follow each other"


# Tree of shapes and groups


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
    def parent(self) -> Container:
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
    indices
        The places of its curves in the document, one after the other.
    container
        What it is in.
    children
        What is in it, in the order of the document; nothing in a curve.
    """

    kind: NodeKind
    name: str
    indices: range
    container: Container = OUTSIDE
    children: tuple[Node, ...] = ()

    @property
    def depth(self) -> int:
        """The number of shapes and groups around it."""
        return self.container.depth

    @property
    def as_container(self) -> Container:
        """The surroundings of what is in it."""
        groups = self.container.groups
        if self.kind is NodeKind.GROUP:
            return Container((*groups, self.name))
        return Container(groups, self.name)

    def walk(self) -> Iterator[Node]:
        """Yield it and all that is in it."""
        yield self
        for part in self.children:
            yield from part.walk()


_last: tuple[Sequence[Curve], tuple[Node, ...]] = ((), ())


def curve_tree(curves: Sequence[Curve]) -> tuple[Node, ...]:
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


def node_count_label(nodes: Sequence[Node], adjective: str = "") -> str:
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
    return list(_wholes(curve_tree(curves), frozenset(chosen), frozenset(left)))


def _wholes(nodes: Sequence[Node], chosen: frozenset[int], left: frozenset[str]) -> Iterator[Node]:
    for node in nodes:
        is_left = node.kind is NodeKind.GROUP and node.name in left
        if not is_left and chosen.issuperset(node.indices):
            yield node
        else:
            yield from _wholes(node.children, chosen, left)
