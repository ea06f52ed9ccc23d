"""Looks at all numbers of many points at once: one by one, a million take longer than reading them."""

from __future__ import annotations

import math
from collections.abc import Iterator

from app.document.model import MAX_MAGNITUDE, Node


def all_within(nodes: tuple[Node, ...]) -> bool:
    """Whether all numbers of nodes are floats that may be saved; if not, somebody must look which is not."""
    return all(map(_are_plain, _columns(nodes)))


def _columns(nodes: tuple[Node, ...]) -> Iterator[list[float]]:
    yield [node.x for node in nodes]
    yield [node.y for node in nodes]
    yield [node.t for node in nodes if node.t is not None]
    for vectors in (
        (node.velocity for node in nodes),
        (node.acceleration for node in nodes),
        (node.velocity_after for node in nodes),
        (node.acceleration_after for node in nodes),
    ):
        yield [value for vector in vectors if vector is not None for value in vector]


def _are_plain(values: list[float]) -> bool:
    if not values:
        return True
    # A sum is NaN if anything is, while min and max may pass it over.
    are_floats = set(map(type, values)) == {float} and not math.isnan(sum(values))
    return are_floats and min(values) >= -MAX_MAGNITUDE and max(values) <= MAX_MAGNITUDE
