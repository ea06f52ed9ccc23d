"""Lengths as people type them: with a unit of their own, or in that of the document."""

from __future__ import annotations

import re

from ..document.expression import ExpressionError
from ..document.words import number
from ..exchange.units import MILLIMETRES, known_unit
from .field_edit import read_number
from .number_text import decimal_mark

_WITH_UNIT = re.compile(r"(.*[\d.)\s])([^\W\d_]+|[\"″′])\s*")


def read_length(text: str, unit: str) -> float:
    """Return in a unit what was typed, "0.5 mm" or "1/8 in" or "2"; raise `ExpressionError` if it is none."""
    found = _WITH_UNIT.fullmatch(text.strip())
    typed = known_unit(found[2]) if found else ""
    if not found or found[2] == unit or not typed:
        plain = found[1] if found and found[2] == unit else text
        return read_number(plain)
    known = known_unit(unit)
    if not known:
        now = f"It is “{unit}” now" if unit else "It has none now"
        raise ExpressionError(f"{typed} needs a document whose unit is a length. {now}; Document sets it.")
    return read_number(found[1]) * MILLIMETRES[typed] / MILLIMETRES[known]


def length_text(value: float, unit: str, digits: int = 6) -> str:
    """Return a length with its unit, if it has one."""
    return f"{number(value, digits, decimal_mark())} {unit}".rstrip()
