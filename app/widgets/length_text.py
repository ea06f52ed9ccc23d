"""Lengths as people type them: with a unit of their own, or in that of the document."""

from __future__ import annotations

from ..document.words import number
from ..exchange.lengths import typed_length
from ..exchange.units import known_unit
from .number_text import decimal_mark


def read_length(text: str, unit: str, now: float | None = None) -> float:
    """Return the length that was typed in the person's locale; see `typed_length`."""
    return typed_length(text, unit, now, decimal_mark())


def points_text(value: float, unit: str) -> str:
    """Return a length in points, as sizes of letters are told; nothing where the unit has no length."""
    if not known_unit(unit):
        return ""
    return f"{number(value / typed_length('1 pt', unit), 4, decimal_mark())} pt"


def length_text(value: float, unit: str, digits: int = 6) -> str:
    """Return a length with its unit, if it has one."""
    return f"{number(value, digits, decimal_mark())} {unit}".rstrip()
