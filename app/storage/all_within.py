"""Check of all numbers of many points at once: one by one, a million take longer than reading them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain
from operator import attrgetter

from ..document.derivatives import VECTORS
from ..document.model import MAX_MAGNITUDE, Point


def all_within(points: tuple[Point, ...]) -> bool:
    """Whether all numbers of points are floats that may be saved; if not, somebody must look which is not."""
    return all(map(_are_plain, _columns(points)))


def _columns(points: tuple[Point, ...]) -> Iterator[list[float]]:
    yield list(map(attrgetter("x"), points))
    yield list(map(attrgetter("y"), points))
    yield [t for t in map(attrgetter("t"), points) if t is not None]
    for _, name in VECTORS:
        # A vector of two numbers is true, whatever they are.
        yield list(chain.from_iterable(filter(None, map(attrgetter(name), points))))


def _are_plain(values: list[float]) -> bool:
    if not values:
        return True
    # A sum is NaN if anything is, while min and max may pass it over.
    are_floats = set(map(type, values)) == {float} and not math.isnan(sum(values))
    return are_floats and min(values) >= -MAX_MAGNITUDE and max(values) <= MAX_MAGNITUDE
