"""Places of guides as people type them."""

from __future__ import annotations

import re
from typing import NamedTuple

from ...document.model import Axis
from ...widgets.length_text import read_length

_AXIS = re.compile(r"\s*([xyXY])\s*=(.*)", re.DOTALL)


class TypedPlace(NamedTuple):
    """A place that was typed, and the axis where that was typed with it."""

    axis: Axis | None
    position: float


def read_place(text: str, unit: str = "", now: float = 0.0) -> TypedPlace:
    """Return what a text such as "20", "x = 1/3" or "y = 1 in" means, in a document of this unit.

    `now` is where the guide lies, for "+10%".

    Raises
    ------
    ExpressionError
        With the sentence for the person, where it is no place.
    """
    axis, rest = None, text
    if found := _AXIS.fullmatch(text):
        axis, rest = Axis(found[1].lower()), found[2]
    return TypedPlace(axis, read_length(rest, unit, now))
