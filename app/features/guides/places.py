"""Places of guides as people type them."""

from __future__ import annotations

import re
from typing import NamedTuple

from ... import exchange
from ...document.model import Axis
from ...widgets.number_text import decimal_mark

_AXIS = re.compile(r"\s*([xyXY])\s*=(.*)", re.DOTALL)


class TypedPlace(NamedTuple):
    """A place that was typed, and the axis where that was typed with it."""

    axis: Axis | None
    position: float


def read_place(text: str, unit: str = "") -> TypedPlace:
    """Return what a text such as "20", "x = 1/3" or "y = 1 in" means, in a document of this unit.

    Raises
    ------
    ExpressionError
        With the sentence for the person, where it is no place.
    """
    axis, rest = None, text
    if found := _AXIS.fullmatch(text):
        axis, rest = Axis(found[1].lower()), found[2]
    return TypedPlace(axis, exchange.lengths.typed_length(rest, unit, locale_decimal=decimal_mark()))
