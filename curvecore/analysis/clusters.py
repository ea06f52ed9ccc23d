"""Places that are near each other, and the things that pairs connect."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray, IntArray


def near_pairs(places: FloatArray, reach: FloatArray) -> tuple[IntArray, IntArray]:
    """Return the pairs of places (k, 2), ordered by the first parameter, that are within reach in both.

    Every step takes the pairs so many places apart: all pairs at once take many times the memory and time
    where a curve runs along itself and most of them are near in the first parameter alone.
    """
    ends = np.searchsorted(places[:, 0], places[:, 0] + reach[:, 0].max(initial=0.0), side="right")
    following = ends - np.arange(len(places)) - 1
    pairs = [np.empty((2, 0), dtype=np.intp)]
    for step in range(1, following.max(initial=0) + 1):
        way = np.abs(places[step:] - places[:-step])
        near = (way <= np.maximum(reach[step:], reach[:-step])).all(axis=1) & (following[:-step] >= step)
        one = np.flatnonzero(near)
        pairs.append(np.stack((one, one + step)))
    one, other = np.concatenate(pairs, axis=1)
    return one, other


def connected_labels(count: int, one: IntArray, other: IntArray) -> IntArray:
    """Return a label for each of so many things, the same for those that pairs connect."""
    # Every label is the number of a thing of the same component. Until none gets smaller, the least label
    # at either end of a pair goes to both ends and to the things whose numbers they have, and every thing
    # takes the label of the thing whose number it has.
    label = np.arange(count)
    while True:
        before = label.copy()
        least = np.minimum(before[one], before[other])
        for where in (one, other, before[one], before[other]):
            np.minimum.at(label, where, least)
        label = label[label]
        if (label == before).all():
            return label
