"""Places of guides as people type them."""

from __future__ import annotations

import re
from typing import NamedTuple

from ... import exchange
from ...document.expression import ExpressionError
from ...document.model import Axis
from ...widgets.field_edit import read_number

_AXIS = re.compile(r"\s*([xyXY])\s*=(.*)", re.DOTALL)
_UNIT = re.compile(r"(.*[0-9.)\s])\s*([^\W\d_]+|[\"″′])\s*", re.DOTALL)


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
    return TypedPlace(axis, _length(rest, unit))


def _length(text: str, unit: str) -> float:
    found = _UNIT.fullmatch(text)
    typed = exchange.units.known_unit(found[2]) if found else ""
    if not found or not typed:
        return read_number(text)
    own = exchange.units.known_unit(unit)
    if not own:
        raise ExpressionError(f"The document has no unit of length; type a number without “{typed}”.")
    sizes = exchange.units.MILLIMETRES
    return read_number(found[1]) * sizes[typed] / sizes[own]
