"""Sizes of the marks of handles: as large as can be told apart."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from ..plotting.pixel_map import PixelMap
from ..view_model.handles import Handle

_SIZES = (4.0, 5.5, 5.5)
"""Half the sizes of marks in pixels, by the order of their derivatives."""

_LEAST = 2.0
_SHARE = 0.42
"""Part of the way to the next mark that half a mark takes at most: a gap is left between the two."""


def mark_sizes(handles: Sequence[Handle], shown: PixelMap, scale: float) -> dict[Handle, float]:
    """Return half the sizes of the marks of one point's handles, in pixels.

    On short segments the handles of a point lie within a few pixels of each other: the mark of each is small
    enough then to be seen beside the one that it hangs on, and the one that hangs on it.
    """
    ways = {each: math.dist(shown.point(*each.position), shown.point(*each.anchor)) for each in handles}
    rooms = dict(ways)
    for before, after in pairwise(handles):
        if after.anchor == before.position:
            rooms[before] = min(ways[before], ways[after])
    return {
        each: min(_SIZES[each.kind - 1] * scale, max(_SHARE * room, _LEAST * scale))
        for each, room in rooms.items()
    }
