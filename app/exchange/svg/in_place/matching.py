"""Which shapes of a document are which of a file."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Callable, Hashable, Mapping, Sequence

import numpy as np

from .found import Found, Wanted

_Shape = Found | Wanted
_COARSE = 1e-5
"""Share of the drawing to which places are rounded."""


def matched(wanted: Sequence[Wanted], found: Sequence[Found], reach: float) -> Mapping[int, int]:
    """Return the place of the shape of the file for each of a document's that comes from one.

    That of the same name and course first; one that was renamed or moved to another group is known by the
    one or the other.
    """

    def course(shape: _Shape) -> Hashable:
        grain = _COARSE * reach
        return tuple(
            (len(each), *np.round(each[[0, len(each) // 2, -1], 0] / grain).ravel().tolist())
            for each in shape.pieces
        )

    keys: tuple[Callable[[_Shape], Hashable], ...] = (
        lambda shape: (shape.name, shape.groups, course(shape)),
        lambda shape: (shape.name, course(shape)),
        lambda shape: (shape.name, shape.groups),
        lambda shape: shape.name,
        course,
    )
    pairs: dict[int, int] = {}
    left = set(range(len(found)))
    for key in keys:
        known: defaultdict[Hashable, deque[int]] = defaultdict(deque)
        for place in sorted(left):
            known[key(found[place])].append(place)
        for place, shape in enumerate(wanted):
            if place not in pairs and (places := known.get(key(shape))):
                pairs[place] = places.popleft()
        left -= set(pairs.values())
        if not left:
            break
    return pairs
