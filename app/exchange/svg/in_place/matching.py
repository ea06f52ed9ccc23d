"""Which shapes of a document are which of a file."""

from __future__ import annotations

from bisect import bisect
from collections import defaultdict
from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from ....document.content import Lettering
from .found import Found, Wanted

_Shape = Found | Wanted
_Key = Callable[[_Shape], Hashable]
_COARSE = 1e-5
"""Share of the drawing to which places are rounded."""


class Origins(NamedTuple):
    """Where the shapes of a document come from.

    Attributes
    ----------
    pairs
        For each that is one of the file, by its place, the place of that.
    taken
        The places of all of the file that came in.
    begun
        For each that the document began with, by its place, the place where it was.
    """

    pairs: Mapping[int, int]
    taken: Collection[int]
    begun: Mapping[int, int]


def origins(
    wanted: Sequence[Wanted], begun: Sequence[Wanted] | None, found: Sequence[Found], reach: float
) -> Origins:
    """Return where shapes come from; by way of those that the document began with, where these are known.

    Names hold within a document: a file numbers what has none anew each time that it is read.
    """
    if begun is None:
        return Origins(matched(wanted, found, reach), range(len(found)), {})
    came_in = matched(begun, found, reach, by_course=True)
    first = matched(wanted, begun, reach)
    pairs = {place: came_in[before] for place, before in first.items() if before in came_in}
    return Origins(pairs, set(came_in.values()), first)


def matched(
    wanted: Sequence[_Shape], found: Sequence[_Shape], reach: float, *, by_course: bool = False
) -> Mapping[int, int]:
    """Return the place of each shape among others.

    That of the same name, groups and course first. One that was renamed or put into another group is known by
    its course, and one that runs otherwise by its name: the likelier of both comes first. A text or a picture
    is known by what it shows, and a text that says something else by its font.
    """
    course = partial(_course, _COARSE * reach)
    of_course: tuple[_Key, ...] = (lambda shape: (shape.groups, course(shape)), course)
    of_name: tuple[_Key, ...] = (lambda shape: (shape.name, shape.groups), lambda shape: shape.name)
    keys: tuple[_Key, ...] = (
        lambda shape: (shape.name, shape.groups, course(shape)),
        lambda shape: (shape.name, course(shape)),
        _shown,
        *((*of_course, *of_name) if by_course else (*of_name, *of_course)),
        _lettered,
    )
    pairs: dict[int, int] = {}
    left = set(range(len(found)))
    for key in keys:
        known: defaultdict[Hashable, list[int]] = defaultdict(list)
        for place in sorted(left):
            known[key(found[place])].append(place)
        for place, shape in enumerate(wanted):
            if place not in pairs and (places := known.get(key(shape))):
                # Of several alike the one in front of that of the shape behind.
                at = bisect(places, pairs.get(place - 1, -1))
                pairs[place] = places.pop(at if at < len(places) else 0)
        left -= set(pairs.values())
        if not left:
            break
    return pairs


def _course(grain: float, shape: _Shape) -> Hashable:
    """Return how a shape runs: the number of its pieces and some of their points, in steps of a grain."""
    return tuple(
        (len(each), *np.round(each[[0, len(each) // 2, -1], 0] / grain).ravel().tolist())
        for each in shape.pieces
    )


def _shown(shape: _Shape) -> Hashable:
    """Return what a frame shows, by which it is known wherever it is; nothing else has the like."""
    content = shape.content
    if isinstance(content, Lettering):
        return shape.groups, content.lines
    return object() if content is None else (shape.groups, content.link or content.data)


def _lettered(shape: _Shape) -> Hashable:
    """Return the font that a text begins in, and the groups around it."""
    content = shape.content
    if not isinstance(content, Lettering):
        return object()
    return shape.groups, replace(content.lines[0].runs[0], words="", paint=None)
