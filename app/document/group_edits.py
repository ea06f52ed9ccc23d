"""Edits of shapes and groups: combine, break apart, group, ungroup, rename, and move in the order.

An edit may leave a shape or a group inconsistent; `groups.tidy_shapes` repairs the document afterwards.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import count
from typing import NamedTuple

from msgspec.structs import replace

from .curve_edits import map_curves, unused_copy_name
from .groups import (
    OUTSIDE,
    SHARED,
    Container,
    Node,
    NodeKind,
    common_prefix,
    curve_tree,
    expand_to_shapes,
    group_around,
    shape_of,
    whole_nodes,
    with_field_values,
)
from .limits import EditError
from .model import Curve, Document
from .selection import SelectionState
from .style import NO_PAINT, FillRule


class Gathered(NamedTuple):
    """A document in which some curves were brought together.

    Attributes
    ----------
    document
        The document.
    indices
        The indices of these curves in it.
    order
        The former index of each curve.
    """

    document: Document
    indices: range
    order: tuple[int, ...]


# Order


def gather(document: Document, curves: Mapping[int, Curve], at: int) -> Gathered:
    """Put `curves`, given by their indices, side by side before index `at`."""
    before = [index for index in range(at) if index not in curves]
    behind = [index for index in range(at, len(document.curves)) if index not in curves]
    order = (*before, *sorted(curves), *behind)
    new = tuple(curves.get(index, document.curves[index]) for index in order)
    return Gathered(replace(document, curves=new), range(len(before), len(before) + len(curves)), order)


def move_into(
    document: Document,
    curves: Collection[int],
    at: int,
    container: Container = OUTSIDE,
    open_groups: Collection[str] = (),
) -> Gathered:
    """Move curves before index `at`, into a shape or group; whole shapes and groups among them stay whole.

    Of the groups in `open_groups`, the children are moved.
    """
    return gather(document, as_contained(document.curves, curves, container, open_groups), at)


def as_contained(
    curves: Sequence[Curve],
    selected: Collection[int],
    container: Container,
    open_groups: Collection[str] = (),
) -> dict[int, Curve]:
    """Return the selected curves as they are in a shape or group, by their indices; see `move_into`.

    Raises
    ------
    EditError
        If the shape or group consists of the selected curves alone.
    """
    selected = frozenset(selected)
    others = [curve for index, curve in enumerate(curves) if container.holds(curve) and index not in selected]
    nodes = whole_nodes(curves, selected, open_groups)
    into = (container.shape, *container.groups)
    if not others and any(node.kind is not NodeKind.CURVE and node.name in into for node in nodes):
        raise EditError("A shape or group cannot be moved into itself.")
    of_shape = {name: getattr(others[0], name) for name in SHARED} if others and container.shape else {}
    result = {}
    for node in nodes:
        for index in node.indices:
            curve = curves[index]
            groups = (*container.groups, *curve.groups[len(node.container.groups) :])
            shape = "" if node.kind is NodeKind.CURVE else curve.shape
            values = of_shape | {"shape": container.shape} if of_shape else {"shape": shape, "groups": groups}
            result[index] = with_field_values(curve, values)
    return result


def order_after_step(document: Document, curves: Collection[int], step: int) -> list[int]:
    """Return the order of indices with shapes and groups one step to the front (1) or to the back (−1).

    Each steps over the next node in its own group, if there is one.
    """
    selected = expand_to_shapes(document, curves)
    return list(_arranged(curve_tree(document.curves), selected, partial(_move_by_step, step=step)))


def order_at_end(document: Document, curves: Collection[int], end: int) -> list[int]:
    """Return the order of indices with shapes and groups in front of (1) or behind (−1) all others.

    Each stays in its own group, and they keep their order among each other.
    """
    selected = expand_to_shapes(document, curves)
    return list(_arranged(curve_tree(document.curves), selected, partial(_move_to_end, end=end)))


_Order = list[tuple[Node, bool]]
"""Sibling nodes, from the back to the front, and whether each is selected."""


def _move_by_step(order: _Order, step: int) -> None:
    for index in range(len(order) - 1, -1, -1) if step > 0 else range(len(order)):
        target = index + step
        if order[index][1] and 0 <= target < len(order) and not order[target][1]:
            order[index], order[target] = order[target], order[index]


def _move_to_end(order: _Order, end: int) -> None:
    order.sort(key=lambda entry: end * entry[1])


def _arranged(
    nodes: Sequence[Node], selected: frozenset[int], arrange: Callable[[_Order], None]
) -> Iterator[int]:
    """Yield the indices of the curves in nodes, selected nodes rearranged among their siblings."""
    order = [(node, all(index in selected for index in node.indices)) for node in nodes]
    arrange(order)
    for node, is_selected in order:
        if is_selected or node.kind is not NodeKind.GROUP:
            yield from node.indices
        else:
            yield from _arranged(node.children, selected, arrange)


# Shapes


def combine(document: Document, curves: Collection[int], *, alternate: bool = False) -> Gathered:
    """Make one shape of curves, at the index of the topmost.

    Its style is that of the hindmost filled curve, or else of the hindmost curve. With `alternate`, it is
    filled by the even-odd rule: a curve inside another one that runs in the same direction becomes a hole.
    """
    selected = sorted(expand_to_shapes(document, curves))
    if len(selected) < 2:
        raise EditError("Select two or more curves to combine them.")
    parts = [document.curves[index] for index in selected]
    model = next((part for part in parts if part.style.fill != NO_PAINT), parts[0])
    style = replace(model.style, fill_rule=FillRule.EVENODD) if alternate else model.style
    name = next((part.shape for part in parts if part.shape), "") or unused_group_name(document, "Shape")
    shared = {
        "style": style,
        "shape": name,
        "groups": parts[-1].groups,
        "visible": any(part.visible for part in parts),
        "locked": any(part.locked for part in parts),
    }
    new = {index: replace(document.curves[index], **shared) for index in selected}
    return gather(document, new, selected[-1] + 1)


def break_apart(document: Document, curves: Collection[int]) -> Document:
    """Make each curve of the shapes a curve by itself."""
    selected = expand_to_shapes(document, curves)
    if not any(document.curves[index].shape for index in selected):
        raise EditError("Select a shape of several curves to break it apart.")
    return map_curves(document, selected, lambda curve: replace(curve, shape=""))


# Groups


def nodes_of(document: Document, curves: Collection[int]) -> list[Node]:
    """Return the nodes that some curves make up, shapes completed."""
    return whole_nodes(document.curves, expand_to_shapes(document, curves))


def group_curves(document: Document, curves: Collection[int]) -> Gathered:
    """Group curves, shapes and groups at the index of the topmost, in their innermost common group."""
    selected = expand_to_shapes(document, curves)
    nodes, top = whole_nodes(document.curves, selected), max(selected)
    common = common_prefix(*(node.container.groups for node in nodes))
    name = unused_group_name(document, "Group")
    is_deeper = len(document.curves[top].groups) > len(common)
    at = group_around(document.curves, top, len(common)).stop if is_deeper else top + 1
    grouped = {
        index: replace(curve, groups=(*common, name, *curve.groups[len(common) :]))
        for index, curve in as_contained(document.curves, selected, Container(common)).items()
    }
    return gather(document, grouped, at)


def are_in_groups(document: Document, curves: Collection[int]) -> bool:
    """Return whether any of some curves is in a group."""
    return any(document.curves[index].groups for index in curves)


def groups_to_ungroup(document: Document, curves: Collection[int]) -> list[Node]:
    """Return the outermost groups that are selected as wholes, or else the innermost groups of the curves."""
    groups = [node for node in whole_nodes(document.curves, curves) if node.kind is NodeKind.GROUP]
    if groups:
        return groups
    innermost = {}
    for index in sorted(curves):
        if path := document.curves[index].groups:
            indices = group_around(document.curves, index, len(path) - 1)
            innermost[indices] = Node(NodeKind.GROUP, path[-1], indices, Container(path[:-1]))
    return list(innermost.values())


def ungroup(document: Document, curves: Collection[int]) -> Document:
    """Take groups apart by one level; see `groups_to_ungroup`."""
    nodes = groups_to_ungroup(document, curves)
    if not nodes:
        raise EditError("Select a group to ungroup it.")
    depths = {index: node.depth for node in nodes for index in node.indices}
    new = list(document.curves)
    for index, depth in depths.items():
        new[index] = _with_group(new[index], depth)
    return replace(document, curves=tuple(new))


def _with_group(curve: Curve, depth: int, *name: str) -> Curve:
    """Return a curve with another name for its group at a depth, or without that group."""
    return replace(curve, groups=(*curve.groups[:depth], *name, *curve.groups[depth + 1 :]))


def pressed_curves(document: Document, curve: int, selection: SelectionState) -> frozenset[int]:
    """Return the curves that a press on one of them selects: its outermost group, or else its shape.

    A press selects inside a group while one of its curves is edited, or some but not all of them are
    selected.
    """
    selected = selection.whole_curves
    active = selection.active if selection.is_editing or selection.active in selected else -1
    for depth in range(len(document.curves[curve].groups)):
        group = group_around(document.curves, curve, depth)
        if active not in group or all(index in selected for index in group):
            return frozenset(group)
    return frozenset(shape_of(document, curve))


# Names


def unused_group_name(document: Document, stem: str) -> str:
    """Return a name like "Shape 1" that no shape and no group has."""
    used = group_names(document.curves)
    return next(name for number in count(1) if (name := f"{stem} {number}") not in used)


def group_names(curves: Iterable[Curve]) -> set[str]:
    """Return the names of shapes and groups."""
    return {name for curve in curves for name in (curve.shape, *curve.groups)}


def rename_node(document: Document, node: Node, name: str) -> Document:
    """Rename a shape or group; spaces around the name are removed."""
    name = name.strip()
    kind = node.kind.name.lower()
    if not name:
        raise EditError(f"A {kind} needs a name.")
    if name == node.name:
        return document
    if name in group_names(document.curves):
        raise EditError(f"Another shape or group is called “{name}”. Enter another name.")
    if node.kind is NodeKind.SHAPE:
        return map_curves(document, node.indices, lambda curve: replace(curve, shape=name))
    return map_curves(document, node.indices, lambda curve: _with_group(curve, node.depth, name))


def with_unused_group_names(
    curves: Sequence[Curve], document: Document, container: Container = OUTSIDE
) -> list[Curve]:
    """Return curves whose shapes and groups have names that are unused in a document.

    Names of the `container` that the curves are added to stay.
    """
    used = group_names(document.curves)
    names = {name: name for name in ("", container.shape, *container.groups)}
    for name in (name for curve in curves for name in (curve.shape, *curve.groups)):
        if name not in names:
            names[name] = unused_copy_name(name, used)
            used.add(names[name])
    return [
        replace(curve, shape=names[curve.shape], groups=tuple(names[name] for name in curve.groups))
        if curve.shape or curve.groups
        else curve
        for curve in curves
    ]
