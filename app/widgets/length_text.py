"""Lengths as people type them: with a unit of their own, or in that of the document."""

from __future__ import annotations

from ..document.lengths import typed_length
from ..document.words import number
from .number_text import decimal_mark


def read_length(text: str, unit: str, now: float | None = None) -> float:
    """Return the length that was typed in the person's locale; see `typed_length`."""
    return typed_length(text, unit, now, decimal_mark())


def length_text(value: float, unit: str) -> str:
    """Return a length with its unit, if it has one."""
    return f"{number(value, 6, decimal_mark())} {unit}".rstrip()
