"""Texts on paths in whatever units, compared by the size of their letters."""

from __future__ import annotations

import numpy as np

from ....document.along_path import Along
from ....document.content import Lettering, TextLine
from ..text_path_elements import resized

_NEAR = 1e-9


def same_on_path(one: Lettering, other: Lettering, *, with_course: bool) -> bool:
    """Whether two texts on paths begin at the same place, in whatever units, wherever they lie."""
    here, there = one.along, other.along
    if here is None or there is None:
        return False
    size, other_size = size_of(one), size_of(other)
    starts = here.start / (1 if here.is_share else size), there.start / (1 if there.is_share else other_size)
    return (
        (here.is_share, here.is_flipped) == (there.is_share, there.is_flipped)
        and abs(starts[0] - starts[1]) <= _NEAR * max(1.0, abs(starts[0]))
        and (not with_course or _same_course(here, there, size, other_size))
    )


def _same_course(here: Along, there: Along, size: float, other_size: float) -> bool:
    if len(here.pieces) != len(there.pieces):
        return False
    one, other = ((a := np.array(each.pieces)) - a[0, 0] for each in (here, there))
    reach = float(np.abs(one).max()) / size
    return bool(np.abs(one / size - other / other_size).max() <= _NEAR * max(1.0, reach))


def size_of(text: Lettering) -> float:
    """Return how large the first letters of a text are."""
    return text.lines[0].runs[0].size


def in_one_size(text: Lettering) -> tuple[TextLine, ...]:
    """Return the lines of a text as if its first letters were of size one."""
    return tuple(resized(each, 1.0 / size_of(text)) for each in text.lines)


def in_size_of(text: Lettering, other: Lettering) -> tuple[TextLine, ...]:
    """Return the lines of a text in the units of another one whose first letters are as large."""
    by = size_of(other) / size_of(text)
    return tuple(resized(each, by) for each in text.lines)
