"""Shapes of a drawing that are clones of others in it: what they follow, and by which map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray

from .outlines import Outline

_ROUNDING = 1e-9

Shape = tuple[Outline, ...]


class Cloned(NamedTuple):
    """The place of what a shape is a clone of, and the matrix (2, 3) from there, y up."""

    original: int
    by: FloatArray


def clones_among(shapes: Sequence[Shape]) -> Mapping[int, Cloned]:
    """Return those shapes that are as a whole the image of another one, by their places."""
    if not any(outline.clone is not None for shape in shapes for outline in shape):
        return {}
    places: dict[str, tuple[int, int]] = {}
    for place, shape in enumerate(shapes):
        for index, outline in enumerate(shape):
            if outline.identity:
                places.setdefault(outline.identity, (place, index))
    reach = max(float(np.abs(each.control_points).max()) for shape in shapes for each in shape)
    found: dict[int, Cloned] = {}
    for place, shape in enumerate(shapes):
        origins = [places.get(each.clone.of) if each.clone is not None else None for each in shape]
        if origins[0] is None or (original := origins[0][0]) == place:
            continue
        if origins == [(original, index) for index in range(len(shapes[original]))]:
            by = _map(shapes[original], shape, _ROUNDING * reach)
            if by is not None:
                found[place] = Cloned(original, by)
    return {place: each for place, each in found.items() if not _leads_back(place, found)}


def _map(original: Shape, shape: Shape, room: float) -> FloatArray | None:
    """Return the matrix that takes all of an original to a shape; None where there is none.

    The drawing may be shifted and enlarged: of the clone's own map the directions hold alone.
    """
    clone = shape[0].clone
    assert clone is not None
    linear = np.array([[1.0 + clone.xx, clone.xy], [clone.yx, 1.0 + clone.yy]])
    if [each.closed for each in original] != [each.closed for each in shape]:
        return None
    before, after = ([each.control_points for each in parts] for parts in (original, shape))
    if [len(each) for each in before] != [len(each) for each in after]:
        return None
    here, there = (np.concatenate(each).reshape(-1, 2) for each in (before, after))
    shift = there[0] - linear @ here[0]
    if (np.abs(here @ linear.T + shift - there) > room).any():
        return None
    return np.column_stack([linear, shift])


def _leads_back(place: int, found: Mapping[int, Cloned]) -> bool:
    """Whether a clone is by way of others one of itself."""
    met: set[int] = set()
    while place in found and place not in met:
        met.add(place)
        place = found[place].original
    return place in met
