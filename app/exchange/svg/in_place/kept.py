"""Texts and pictures of a file moved to where a document has them, or taken out."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from itertools import chain

import numpy as np

from curvecore.arrays import FloatArray

from ....document.kept import KeptPicture, KeptText
from ....document.kept_moves import whole_texts
from ....document.model import Document
from ..matrices import combined
from .courses import inverse_of, move_whole
from .found import KeptFound, Reading
from .source import Node

_Kept = KeptText | KeptPicture
_Block = Sequence[_Kept]
_ROUNDING = 1e-7


def blocks_of(document: Document) -> list[_Block]:
    """Return the texts of a document, each with all of its lines, and its pictures."""
    pictures = ((each,) for each in document.kept_pictures)
    return [*whole_texts(document.kept_texts), *pictures]


class KeptPlan:
    """What becomes of the texts and pictures of a file.

    Parameters
    ----------
    wanted, begun
        Those that the file shall show, and those that came in; None where that is not known.
    base
        The file as it is.
    reach
        How far the drawing reaches.

    Attributes
    ----------
    removed
        The places, among all elements of the file, of those that go.
    """

    def __init__(
        self, wanted: Sequence[_Block], begun: Sequence[_Block] | None, base: Reading, reach: float
    ) -> None:
        self._wanted, self._room = wanted, _ROUNDING * reach
        number = {node: place for place, node in enumerate(base.nodes)}
        found = [each.parts for each in base.kept]
        came_in = self._matched(wanted if begun is None else begun, found)
        first = {place: place for place in came_in} if begun is None else self._matched(wanted, begun)
        pairs = {place: came_in[before] for place, before in first.items() if before in came_in}
        self._numbers = {
            place: number[base.kept[at].node] for place, at in pairs.items() if base.kept[at].is_own
        }
        self._changed = {
            place
            for place, before in first.items()
            if begun is not None and not self._is_same(wanted[place], begun[before])
        }
        # What undo has brought back since it was taken out of the file.
        self._changed |= set(range(len(wanted))) - set(first) if begun is not None else set()
        gone = set(came_in.values()) - set(pairs.values())
        self.removed = tuple(sorted(number[base.kept[at].node] for at in gone if base.kept[at].is_own))

    def move(self, nodes: Sequence[Node], reading: Reading) -> None:
        """Move what lies elsewhere; `nodes` are all elements of the file as it was."""
        there = {each.node: each for each in reading.kept}
        for place, number in self._numbers.items():
            found = there.get(nodes[number])
            if found is not None and not self._is_there(found, place):
                by = combined(_plane(self._wanted[place][0]), inverse_of(_plane(found.parts[0])))
                move_whole(found.node, found.around, by)

    def is_done(self, nodes: Sequence[Node], reading: Reading) -> bool:
        """Whether all that was moved is where it should be."""
        there = {each.node: each for each in reading.kept}
        moved = {
            place: there.get(nodes[self._numbers[place]]) for place in self._changed & set(self._numbers)
        }
        return self._changed <= set(self._numbers) and all(
            found is not None and self._is_there(found, place) and self._is_seen_so(found, place)
            for place, found in moved.items()
        )

    def _is_there(self, found: KeptFound, place: int) -> bool:
        return self._is_same(found.parts, self._wanted[place])

    def _is_seen_so(self, found: KeptFound, place: int) -> bool:
        """Whether as much is seen of it: a clip of the group around stays where it is."""
        pairs = [
            (_seen(one), _seen(other)) for one, other in zip(found.parts, self._wanted[place], strict=True)
        ]
        return all(len(a) == len(b) and np.allclose(a, b, 0, self._room) for a, b in pairs)

    def _is_same(self, one: _Block, other: _Block) -> bool:
        """Whether both lie at the same place."""
        return len(one) == len(other) and all(
            bool((np.abs(_plane(a) - _plane(b)) <= self._room).all()) for a, b in zip(one, other, strict=True)
        )

    def _matched(self, blocks: Sequence[_Block], others: Sequence[_Block]) -> Mapping[int, int]:
        """Return for each the place of that among others which shows the same.

        First of one that lies there, and of several the one behind that of the block before.
        """
        alike: defaultdict[Hashable, list[int]] = defaultdict(list)
        for at, each in enumerate(others):
            alike[_content(each)].append(at)
        pairs: dict[int, int] = {}
        for is_there in (True, False):
            for place, block in enumerate(blocks):
                if place in pairs:
                    continue
                left = alike.get(_content(block), [])
                found = [at for at in left if not is_there or self._is_same(block, others[at])]
                if found:
                    before = pairs.get(place - 1, -1)
                    pairs[place] = next((at for at in found if at > before), found[0])
                    left.remove(pairs[place])
        return pairs


def _content(block: _Block) -> Hashable:
    """Return what a text or a picture shows, wherever it is."""
    return tuple(
        (each.runs, each.anchor) if isinstance(each, KeptText) else (each.data, each.opacity)
        for each in block
    )


def _plane(kept: _Kept) -> FloatArray:
    """Return the matrix (2, 3) from the units of a text, or the sides of a picture, to the plane."""
    return np.array([[kept.across[0], kept.down[0], kept.x], [kept.across[1], kept.down[1], kept.y]])


def _seen(kept: _Kept) -> list[float]:
    """Return the numbers of the areas that something is seen in, and of the part of it that is."""
    rings = chain.from_iterable(clip.rings for clip in kept.clips)
    part = kept.part if isinstance(kept, KeptPicture) else ()
    return [*part, *chain.from_iterable(ring.numbers for ring in rings)]
