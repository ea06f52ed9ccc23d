"""Edits of shapes and groups: made, taken apart, named, and moved in the order with all that is in them.

Pure functions like those of ``edits``; `tidy_shapes` gives what they leave its final form.
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
        Where they are in it.
    order
        Where each of its curves was before.
    """

    document: Document
    indices: range
    order: tuple[int, ...]


# Order


def gather(document: Document, curves: Mapping[int, Curve], at: int) -> Gathered:
    """Put `curves`, by their places now, one after the other before place `at`."""
    before = [place for place in range(at) if place not in curves]
    behind = [place for place in range(at, len(document.curves)) if place not in curves]
    order = (*before, *sorted(curves), *behind)
    new = tuple(curves.get(place, document.curves[place]) for place in order)
    return Gathered(replace(document, curves=new), range(len(before), len(before) + len(curves)), order)


def move_into(
    document: Document,
    curves: Collection[int],
    at: int,
    container: Container = OUTSIDE,
    left: Collection[str] = (),
) -> Gathered:
    """Bring curves together before place `at`, in a shape or group; shapes and groups of them stay whole.

    Of the groups that are `left` comes what is in them.
    """
    return gather(document, as_contained(document.curves, curves, container, left), at)


def as_contained(
    curves: Sequence[Curve], chosen: Collection[int], container: Container, left: Collection[str] = ()
) -> dict[int, Curve]:
    """Return the chosen curves as they are in a shape or group, by their places; of groups `left` the parts.

    Raises
    ------
    EditError
        If nothing would be left there to go to.
    """
    chosen = frozenset(chosen)
    there = [curve for place, curve in enumerate(curves) if container.holds(curve) and place not in chosen]
    nodes = whole_nodes(curves, chosen, left)
    if not there and any(node.name in (container.shape, *container.groups) for node in _holders(nodes)):
        raise EditError("A shape or a group cannot go into itself.")
    of_shape = {name: getattr(there[0], name) for name in SHARED} if there and container.shape else {}
    found = {}
    for node in nodes:
        for place in node.indices:
            own = curves[place]
            groups = (*container.groups, *own.groups[len(node.container.groups) :])
            shape = "" if node.kind is NodeKind.CURVE else own.shape
            values = of_shape | {"shape": container.shape} if of_shape else {"shape": shape, "groups": groups}
            found[place] = with_field_values(own, values)
    return found


def _holders(nodes: Iterable[Node]) -> Iterator[Node]:
    return (node for node in nodes if node.kind is not NodeKind.CURVE)


def order_after_step(document: Document, curves: Collection[int], step: int) -> list[int]:
    """Return the order of places in which shapes and groups are one step to the front (1) or back (−1).

    Each goes past the next thing beside it in the group that it is in, as far as there is one.
    """
    chosen = expand_to_shapes(document, curves)
    return list(_arranged(curve_tree(document.curves), chosen, partial(_a_step, step=step)))


def order_at_end(document: Document, curves: Collection[int], end: int) -> list[int]:
    """Return the order of places in which shapes and groups are in front (1) or behind (−1) all else.

    Each stays in the group that it is in, and they keep their order among each other.
    """
    chosen = expand_to_shapes(document, curves)
    return list(_arranged(curve_tree(document.curves), chosen, partial(_to_end, end=end)))


_Order = list[tuple[Node, bool]]
"""Nodes beside each other, from the back to the front, and whether each is chosen."""


def _a_step(order: _Order, step: int) -> None:
    for at in range(len(order) - 1, -1, -1) if step > 0 else range(len(order)):
        to = at + step
        if order[at][1] and 0 <= to < len(order) and not order[to][1]:
            order[at], order[to] = order[to], order[at]


def _to_end(order: _Order, end: int) -> None:
    order.sort(key=lambda each: end * each[1])


def _arranged(
    nodes: Sequence[Node], chosen: frozenset[int], arrange: Callable[[_Order], None]
) -> Iterator[int]:
    """Yield the places of nodes, those that are chosen put elsewhere beside those around them."""
    order = [(node, all(place in chosen for place in node.indices)) for node in nodes]
    arrange(order)
    for node, is_chosen in order:
        if is_chosen or node.kind is not NodeKind.GROUP:
            yield from node.indices
        else:
            yield from _arranged(node.children, chosen, arrange)


# Shapes


def combine(document: Document, curves: Collection[int], *, alternate: bool = False) -> Gathered:
    """Make one shape of curves, where the topmost is.

    It has the style of the hindmost that is filled, or else of the hindmost. `alternate` says that one of
    them lies in another and runs the same way: the even-odd rule then makes a hole of it.
    """
    chosen = sorted(expand_to_shapes(document, curves))
    if len(chosen) < 2:
        raise EditError("Choose two curves or more to combine them.")
    parts = [document.curves[place] for place in chosen]
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
    new = {place: replace(document.curves[place], **shared) for place in chosen}
    return gather(document, new, chosen[-1] + 1)


def break_apart(document: Document, curves: Collection[int]) -> Document:
    """Make a curve of its own of each curve of the shapes."""
    chosen = expand_to_shapes(document, curves)
    if not any(document.curves[place].shape for place in chosen):
        raise EditError("Choose a shape of several curves to break it apart.")
    return map_curves(document, chosen, lambda curve: replace(curve, shape=""))


# Groups


def nodes_of(document: Document, curves: Collection[int]) -> list[Node]:
    """Return the whole groups and whole shapes that some curves are."""
    return whole_nodes(document.curves, expand_to_shapes(document, curves))


def group_curves(document: Document, curves: Collection[int]) -> Gathered:
    """Make a group of curves, shapes and groups where the topmost is, in the group that holds all of them."""
    chosen = expand_to_shapes(document, curves)
    nodes, top = whole_nodes(document.curves, chosen), max(chosen)
    around = common_prefix(*(node.container.groups for node in nodes))
    own, name = document.curves[top].groups, unused_group_name(document, "Group")
    is_deeper = len(own) > len(around)
    at = group_around(document.curves, top, len(around)).stop if is_deeper else top + 1
    inside = {
        place: replace(curve, groups=(*around, name, *curve.groups[len(around) :]))
        for place, curve in as_contained(document.curves, chosen, Container(around)).items()
    }
    return gather(document, inside, at)


def are_in_groups(document: Document, curves: Collection[int]) -> bool:
    """Whether any of some curves are in a group."""
    return any(document.curves[place].groups for place in curves)


def groups_to_ungroup(document: Document, curves: Collection[int]) -> list[Node]:
    """Return the groups all of whose curves are chosen, the outermost; or else those right around curves."""
    nodes = whole_nodes(document.curves, curves)
    whole = [node for node in nodes if node.kind is NodeKind.GROUP]
    if whole:
        return whole
    found = {}
    for place in sorted(curves):
        if groups := document.curves[place].groups:
            places = group_around(document.curves, place, len(groups) - 1)
            found[places] = Node(NodeKind.GROUP, groups[-1], places, Container(groups[:-1]))
    return list(found.values())


def ungroup(document: Document, curves: Collection[int]) -> Document:
    """Take groups apart by one level; see `groups_to_ungroup`."""
    nodes = groups_to_ungroup(document, curves)
    if not nodes:
        raise EditError("Choose a group to take it apart.")
    depths = {place: node.depth for node in nodes for place in node.indices}
    return replace(
        document,
        curves=tuple(
            _without_group(curve, depths[place]) if place in depths else curve
            for place, curve in enumerate(document.curves)
        ),
    )


def _without_group(curve: Curve, depth: int) -> Curve:
    return replace(curve, groups=(*curve.groups[:depth], *curve.groups[depth + 1 :]))


def pressed_curves(document: Document, curve: int, choice: SelectionState) -> frozenset[int]:
    """Return the curves that a press on one of them means: its outermost group, or else its shape.

    A group is entered, and what is in it meant, while a curve of it is edited, or chosen but not all of them.
    """
    chosen = choice.chosen
    here = choice.active if choice.is_editing or choice.active in chosen else -1
    for depth in range(len(document.curves[curve].groups)):
        around = group_around(document.curves, curve, depth)
        if here not in around or all(place in chosen for place in around):
            return frozenset(around)
    return frozenset(shape_of(document, curve))


# Names


def unused_group_name(document: Document, stem: str) -> str:
    """Return a name "Shape 1" that no shape and no group has."""
    taken = group_names(document.curves)
    return next(name for number in count(1) if (name := f"{stem} {number}") not in taken)


def group_names(curves: Iterable[Curve]) -> set[str]:
    """Return the names of shapes and groups."""
    return {name for curve in curves for name in (curve.shape, *curve.groups)}


def rename_node(document: Document, node: Node, name: str) -> Document:
    """Give a shape or a group another name, without the blanks around it."""
    name = name.strip()
    kind = node.kind.name.lower()
    if not name:
        raise EditError(f"A {kind} needs a name.")
    if name == node.name:
        return document
    if name in group_names(document.curves):
        raise EditError(f"“{name}” is the name of another shape or group.")
    if node.kind is NodeKind.SHAPE:
        return map_curves(document, node.indices, lambda curve: replace(curve, shape=name))
    at = node.depth
    return map_curves(
        document,
        node.indices,
        lambda curve: replace(curve, groups=(*curve.groups[:at], name, *curve.groups[at + 1 :])),
    )


def with_unused_group_names(
    curves: Sequence[Curve], document: Document, container: Container = OUTSIDE
) -> list[Curve]:
    """Return curves for a place of a document, their shapes and groups under names that none has there.

    That of the `container` which they come into stays.
    """
    taken = group_names(document.curves)
    fresh = {name: name for name in ("", container.shape, *container.groups)}
    for name in (each for curve in curves for each in (curve.shape, *curve.groups)):
        if name not in fresh:
            fresh[name] = unused_copy_name(name, taken)
            taken.add(fresh[name])
    return [
        replace(curve, shape=fresh[curve.shape], groups=tuple(fresh[name] for name in curve.groups))
        if curve.shape or curve.groups
        else curve
        for curve in curves
    ]
