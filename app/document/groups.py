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
from itertools import chain, count, takewhile
from operator import attrgetter, is_

import msgspec
from msgspec.structs import replace

from .differences import reshaped_curves
from .model import Curve, Document
from .words import count_of, enumerated

# Shapes

SHARED = ("style", "groups", "visible", "locked")
"""Fields that all curves of a shape have in common."""

_DEEPEST = 50
"""Largest number of nested groups."""

_looks = attrgetter(*SHARED, "shape")


def shape_of(document: Document, curve: int) -> range:
    """Return the indices of the curves in the shape of a curve."""
    return shape_around(document.curves, curve)


def shape_around(curves: Sequence[Curve], curve: int) -> range:
    """Return the indices of the curves in the shape of one of these curves."""
    name, first, end = curves[curve].shape, curve, curve + 1
    if name:
        while first > 0 and curves[first - 1].shape == name:
            first -= 1
        while end < len(curves) and curves[end].shape == name:
            end += 1
    return range(first, end)


def shape_ranges(curves: Sequence[Curve]) -> Iterator[range]:
    """Yield the indices of the curves of each shape, in order."""
    first = 0
    for end in range(1, len(curves) + 1):
        name = curves[first].shape
        if end == len(curves) or not name or curves[end].shape != name:
            yield range(first, end)
            first = end


def shape_count_label(curves: Sequence[Curve]) -> str:
    """Return "3 curves", or "2 shapes" where a shape has several curves."""
    shape_count = sum(1 for _ in shape_ranges(curves)) if curves else 0
    return count_of(shape_count, "curve" if shape_count == len(curves) else "shape")


def expand_to_shapes(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return curves together with all other curves of their shapes."""
    indices, in_shapes = set(curves), set[int]()
    # Most of thousands of curves are shapes by themselves.
    for index in [index for index in indices if document.curves[index].shape]:
        if index not in in_shapes:
            in_shapes.update(shape_of(document, index))
    return frozenset(indices | in_shapes)


def tidy_shapes(document: Document, before: Document | None = None) -> Document:
    """Return the document with consistent shapes and groups, each under a name of its own.

    An edit may leave a shape with one curve, tear a shape or a group apart, or change the style of one curve
    of a shape; then the first curve of the shape decides for all. `before` is a consistent document; parts
    that did not change since are not checked again.
    """
    if before is not None and (
        reshaped_curves(before, document) is not None or _look_the_same(before.curves, document.curves)
    ):
        return document
    if not any(curve.shape or curve.groups for curve in document.curves):
        return document
    curves = list(_with_unused_group_names(_with_whole_shapes(document)))
    if any(new is not old for new, old in zip(curves, document.curves, strict=True)):
        return replace(document, curves=tuple(curves))
    return document


def _look_the_same(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    """Return whether names, order and shared fields of all curves are the same."""
    return len(before) == len(after) and all(
        new is old or all(map(is_, values := _looks(new), was := _looks(old))) or values == was
        for new, old in zip(after, before, strict=True)
    )


def _with_whole_shapes(document: Document) -> Iterator[Curve]:
    """Yield the curves; those of a shape get the shared fields of its first curve, and an unused name."""
    used: set[str] = set()
    for indices in shape_ranges(document.curves):
        parts = document.curves[indices.start : indices.stop]
        if not parts[0].shape and len(parts) == 1:
            yield parts[0]
            continue
        name = _free(parts[0].shape, used) if len(parts) > 1 else ""
        used.add(name)
        shared = {field: getattr(parts[0], field) for field in SHARED} | {"shape": name}
        for part in parts:
            yield with_field_values(part, shared)


def _with_unused_group_names(curves: Iterable[Curve]) -> Iterator[Curve]:
    """Yield the curves, each group under a name of its own, nested at most `_DEEPEST` deep."""
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
    """Return the names that all of these paths begin with."""
    pairs = takewhile(lambda names: len(set(names)) == 1, zip(*groups, strict=False))
    return tuple(names[0] for names in pairs)


def _free(name: str, used: Collection[str]) -> str:
    """Return the name, with a number where it is used already."""
    numbered = (f"{name} {number}" for number in count(2))
    return next(candidate for candidate in chain((name,), numbered) if candidate not in used)


def with_field_values(curve: Curve, values: Mapping[str, object]) -> Curve:
    """Return the curve with these values of fields: the same object where it has them already."""
    is_same = all(getattr(curve, field) == value for field, value in values.items())
    return curve if is_same else replace(curve, **values)


def shape_problem(document: Document) -> str:
    """Return the first inconsistency that `tidy_shapes` would repair, with its field; empty for none."""
    tidy = tidy_shapes(document)
    if tidy.curves == document.curves:
        return ""
    index = next(
        i for i, pair in enumerate(zip(tidy.curves, document.curves, strict=True)) if pair[0] is not pair[1]
    )
    return f"curves[{index}].{_problem_at(index, tidy.curves, document.curves[index])}"


def _problem_at(index: int, tidy: Sequence[Curve], bad: Curve) -> str:
    """Return the difference of a curve to that of the consistent document."""
    good = tidy[index]
    if good.shape != bad.shape:
        return "shape must name two or more curves that follow each other, and no others"
    field = next(field for field in SHARED if getattr(good, field) != getattr(bad, field))
    if index and good.shape and good.shape == tidy[index - 1].shape:
        return f"{field} must equal that of the curve before it, which belongs to the same shape"
    return f"groups must name {_DEEPEST} groups at most, each of curves that follow each other"


# Tree of shapes and groups


class NodeKind(Enum):
    """Kind of a node: a curve, a shape or a group."""

    CURVE = auto()
    SHAPE = auto()
    GROUP = auto()


class Container(msgspec.Struct, frozen=True):
    """Container of a curve: its groups, the outermost first, and its shape."""

    groups: tuple[str, ...] = ()
    shape: str = ""

    @property
    def depth(self) -> int:
        """The number of nested groups and shapes."""
        return len(self.groups) + bool(self.shape)

    @property
    def parent(self) -> Container:
        """The container of the innermost group or shape."""
        return Container(self.groups if self.shape else self.groups[:-1])

    def holds(self, curve: Curve) -> bool:
        """Return whether a curve is in the container."""
        is_in_groups = curve.groups[: len(self.groups)] == self.groups
        return is_in_groups and (not self.shape or curve.shape == self.shape)


OUTSIDE = Container()


class Node(msgspec.Struct, frozen=True):
    """Node of the tree: a curve, or a shape or group with its children.

    Attributes
    ----------
    kind, name
        Kind and name of the node.
    indices
        The indices of its curves in the document, without gaps.
    container
        The groups and the shape around the node.
    children
        The nodes in it, in the order of the document; empty for a curve.
    """

    kind: NodeKind
    name: str
    indices: range
    container: Container = OUTSIDE
    children: tuple[Node, ...] = ()

    @property
    def depth(self) -> int:
        """The number of groups and shapes around the node."""
        return self.container.depth

    @property
    def as_container(self) -> Container:
        """The container of the children."""
        groups = self.container.groups
        if self.kind is NodeKind.GROUP:
            return Container((*groups, self.name))
        return Container(groups, self.name)

    def walk(self) -> Iterator[Node]:
        """Yield the node and all nodes in it."""
        yield self
        for part in self.children:
            yield from part.walk()


_last: tuple[Sequence[Curve], tuple[Node, ...]] = ((), ())


def curve_tree(curves: Sequence[Curve]) -> tuple[Node, ...]:
    """Return the outermost curves, shapes and groups, in order.

    The tree of the last curves is remembered: many actions ask for it at every step.
    """
    global _last  # noqa: PLW0603
    if _last[0] is not curves or not isinstance(curves, tuple):
        _last = curves, tuple(_nodes(curves, range(len(curves)), ()))
    return _last[1]


def _nodes(curves: Sequence[Curve], indices: range, groups: tuple[str, ...]) -> Iterator[Node]:
    depth, index, container = len(groups), indices.start, Container(groups)
    while index < indices.stop:
        curve, end = curves[index], index + 1
        if len(curve.groups) > depth:
            end = _run_end(curves, index, depth, indices.stop)
            name = curve.groups[depth]
            parts = tuple(_nodes(curves, range(index, end), (*groups, name)))
            yield Node(NodeKind.GROUP, name, range(index, end), container, parts)
        elif curve.shape:
            while end < indices.stop and curves[end].shape == curve.shape:
                end += 1
            shape = Container(groups, curve.shape)
            leaves = (Node(NodeKind.CURVE, curves[i].name, range(i, i + 1), shape) for i in range(index, end))
            yield Node(NodeKind.SHAPE, curve.shape, range(index, end), container, tuple(leaves))
        else:
            yield Node(NodeKind.CURVE, curve.name, range(index, end), container)
        index = end


def _run_end(curves: Sequence[Curve], index: int, depth: int, stop: int) -> int:
    """Return the end of the group around a curve at a depth."""
    path, end = curves[index].groups[: depth + 1], index + 1
    while end < stop and curves[end].groups[: depth + 1] == path:
        end += 1
    return end


def node_count_label(nodes: Sequence[Node], adjective: str = "") -> str:
    """Return "3 curves" or "1 group and 2 curves"."""
    counts = Counter(node.kind for node in nodes)
    kinds = [kind for kind in reversed(NodeKind) if counts[kind]]
    return enumerated([count_of(counts[kind], f"{adjective}{kind.name.lower()}") for kind in kinds])


def group_around(curves: Sequence[Curve], index: int, depth: int) -> range:
    """Return the indices of the curves in the group around a curve at a depth, 0 for the outermost."""
    path, start = curves[index].groups[: depth + 1], index
    while start > 0 and curves[start - 1].groups[: depth + 1] == path:
        start -= 1
    return range(start, _run_end(curves, index, depth, len(curves)))


def whole_nodes(
    curves: Sequence[Curve], selected: Collection[int], open_groups: Collection[str] = ()
) -> list[Node]:
    """Return the largest nodes whose curves are all selected; open groups are replaced by their children."""
    return list(_whole_nodes(curve_tree(curves), frozenset(selected), frozenset(open_groups)))


def _whole_nodes(
    nodes: Sequence[Node], selected: frozenset[int], open_groups: frozenset[str]
) -> Iterator[Node]:
    for node in nodes:
        is_open = node.kind is NodeKind.GROUP and node.name in open_groups
        if not is_open and selected.issuperset(node.indices):
            yield node
        else:
            yield from _whole_nodes(node.children, selected, open_groups)
