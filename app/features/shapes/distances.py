"""Distances by which shapes grow or shrink, as people type them."""

from __future__ import annotations

from typing import NamedTuple

from ...document.expression import ExpressionError
from ...document.words import with_minus
from ...widgets.length_text import read_length


class Distance(NamedTuple):
    """A distance in the unit of the document, and the words for it: "2 mm"."""

    value: float
    words: str


def read_distance(text: str, unit: str) -> Distance:
    """Return what a text such as "2 mm", "1/8 in" or "−3" means in a document of this unit.

    Raises
    ------
    ExpressionError
        With the sentence for the person, where it is no distance.
    """
    text = text.strip()
    value = read_length(text, unit)
    if value == 0.0:
        raise ExpressionError("Type a distance other than 0; below 0 it goes the other way.")
    return Distance(value, with_minus(text if _has_unit(text) else f"{text} {unit}".rstrip()))


def _has_unit(text: str) -> bool:
    try:
        read_length(text, "")
    except ExpressionError:
        return True
    return False
