"""Sections of shapes that lie one over the other: in sheets of a picture, or painted in every frame."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

_WORTH_A_SHEET, _MOST_SHEETS = 2, 8
"""Shapes that take as long to paint as to copy a sheet; sheets, at most: each is as large as the area."""


class Section(NamedTuple):
    """Shapes that lie one over the other: in a sheet of the picture, or painted in every frame."""

    places: range
    is_still: bool

    @property
    def span(self) -> slice:
        """The part of all shapes that it is."""
        return slice(self.places.start, self.places.stop)


def sections_of(changed: Sequence[int], count: int) -> tuple[Section, ...]:
    """Return the sections of `count` shapes, of which those at the places `changed`, ascending, change.

    What lies between two of these is a sheet where that is worth it.
    """
    gaps = [range(before + 1, after) for before, after in pairwise([-1, *changed, count])]
    worth = sorted((gap for gap in gaps if len(gap) >= _WORTH_A_SHEET or not changed), key=len)
    sections, begin = list[Section](), 0
    for gap in sorted(worth[-_MOST_SHEETS:], key=lambda gap: gap.start):
        sections += [Section(range(begin, gap.start), False), Section(gap, True)]
        begin = gap.stop
    sections.append(Section(range(begin, count), False))
    return tuple(section for section in sections if section.places)


def loose_places(sections: Sequence[Section]) -> frozenset[int]:
    """Return the places of the shapes that are in no sheet."""
    return frozenset(place for section in sections if not section.is_still for place in section.places)
