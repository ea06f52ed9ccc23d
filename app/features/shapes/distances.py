"""Distances by which shapes grow or shrink, as people type them."""

from __future__ import annotations

from typing import NamedTuple

from ...document.expression import ExpressionError
from ...document.transforms import clean_step
from ...document.words import number, with_minus
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
    typed = _read(text, unit)
    if typed.value == 0.0:
        raise ExpressionError("Type a distance other than 0; below 0 it goes the other way.")
    return typed


def read_again(words: str, unit: str, pixel_size: float, pixels: float) -> Distance:
    """Return what was typed before; at first, or where the document has no such unit, a clean number.

    That is at least so many pixels of CSS, or of the screen where the document has no unit of length.
    """
    try:
        return _read(words, unit)
    except ExpressionError:
        step = clean_step(_pixels(pixels, unit, pixel_size))
        return Distance(step, f"{number(step, 3)} {unit}".rstrip())


def _pixels(pixels: float, unit: str, pixel_size: float) -> float:
    try:
        return read_length(f"{pixels} px", unit)
    except ExpressionError:
        return pixels * pixel_size


def _read(text: str, unit: str) -> Distance:
    text = text.strip()
    words = text if _has_unit(text) else f"{text} {unit}".rstrip()
    return Distance(read_length(text, unit), with_minus(words))


def _has_unit(text: str) -> bool:
    try:
        read_length(text, "")
    except ExpressionError:
        return True
    return False
