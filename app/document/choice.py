"""Chosen curves and selected nodes: where they are after a change, and which came back with it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from app.document.model import Curve, Node, Vector


def followed_curves(
    chosen: Collection[int], before: Sequence[Curve], after: Sequence[Curve]
) -> frozenset[int]:
    """Return where chosen curves are after a change: the same values, or else the same places.

    An edit hands on what it does not change, so that a curve elsewhere in the order is the same object. One
    that was changed is looked for in its place, where the number of curves is what it was.
    """
    if before is after:
        return frozenset(chosen)
    places = {id(curve): place for place, curve in enumerate(after)}
    same_number = len(before) == len(after)
    found = set()
    for place in chosen:
        if same_number and after[place] is before[place]:
            found.add(place)
        elif id(before[place]) in places:
            found.add(places[id(before[place])])
        elif same_number:
            found.add(place)
    return frozenset(found)


def followed_nodes(chosen: Collection[int], before: Sequence[Node], after: Sequence[Node]) -> frozenset[int]:
    """Return where chosen nodes are after a change; those of which nothing is left are left out.

    As many nodes as before are the same ones, wherever they went. Otherwise a node is where it was in the
    plane: of several at one place the first stays the first.
    """
    if len(before) == len(after):
        return frozenset(chosen)
    places: dict[Vector, list[int]] = {}
    for index, node in enumerate(after):
        places.setdefault(node.position, []).append(index)
    found = set()
    # Every old node takes the first place left where it is, so that one walk over the points will do.
    left = {position: iter(indices) for position, indices in places.items()}
    for index, node in enumerate(before):
        place = next(left[node.position], None) if node.position in left else None
        if place is not None and index in chosen:
            found.add(place)
    return frozenset(found)


def returned_nodes(before: Sequence[Node], after: Sequence[Node]) -> frozenset[int]:
    """Return which nodes of `after` are at no place of `before`; none unless there are more of them."""
    if len(after) <= len(before):
        return frozenset()
    places = {node.position for node in before}
    return frozenset(index for index, node in enumerate(after) if node.position not in places)


def returned_curves(before: Sequence[Curve], after: Sequence[Curve]) -> frozenset[int]:
    """Return which curves of `after` are not among `before`; none unless there are more of them."""
    if len(after) <= len(before):
        return frozenset()
    known = {id(curve) for curve in before}
    return frozenset(place for place, curve in enumerate(after) if id(curve) not in known)
