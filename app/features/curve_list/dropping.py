"""Place where dragged curves would fall in the list: between rows, and in a shape or group."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from ...document.groups import OUTSIDE, Container, Node
from .entries import Entry


class Drop(msgspec.Struct, frozen=True):
    """Place for dragged curves.

    Attributes
    ----------
    gap
        The row that it is above, from the top; the number of rows for the end of the list.
    at
        The place of the document that it is before.
    container
        The shape or group that it is in.
    is_onto
        Whether it is on the row, hence in front in the shape or group of that, and not above it.
    """

    gap: int
    at: int
    container: Container
    is_onto: bool = False


def drop_at(entries: Sequence[Entry], gap: int, depth: int) -> Drop:
    """Return the place between two rows that is as deep in shapes and groups as wanted, if it can be.

    Below the last row of an open shape or group a place may be in that, or in what is around it.
    """
    above = entries[gap - 1] if gap > 0 else None
    below = entries[gap].node if gap < len(entries) else None
    outer = below.around if below is not None else OUTSIDE
    inner = _inner(above) if above is not None else outer
    way = [inner]
    while way[-1] != outer:
        way.append(way[-1].around)
    container = way[max(0, min(len(way) - 1, inner.depth - depth))]
    return Drop(gap, below.places.stop if below is not None else 0, container)


def drop_onto(entries: Sequence[Entry], row: int) -> Drop:
    """Return the place in the shape or group of a row, in front of what is there."""
    node = entries[row].node
    return Drop(row, node.places.stop, node.inside, is_onto=True)


def stays(drop: Drop, dragged: Node, row: int) -> bool:
    """Whether what is dragged, in a row, would be where it is."""
    return not drop.is_onto and drop.gap in (row, row + 1) and drop.container == dragged.around


def _inner(above: Entry) -> Container:
    return above.node.inside if above.is_open else above.node.around
