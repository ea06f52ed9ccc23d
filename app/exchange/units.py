"""Units of length: how large one is on paper, and what files call them."""

from __future__ import annotations

from typing import Final

from .svg.numbers import number

MILLIMETRES: Final = {
    "µm": 1e-3,
    "mm": 1.0,
    "cm": 10.0,
    "m": 1e3,
    "km": 1e6,
    "in": 25.4,
    "ft": 304.8,
    "pt": 25.4 / 72,
    "pc": 25.4 / 6,
    "px": 25.4 / 96,
}
"""Millimetres of each unit that a picture can be drawn in at true size; px is CSS's."""

POINTS_PER_MILLIMETRE: Final = 72 / 25.4

_IN_CSS: Final = ("mm", "cm", "in", "pt", "pc", "px")
_OTHER_NAMES: Final = {"um": "µm", "μm": "µm", "inch": "in", "inches": "in", '"': "in", "″": "in", "′": "ft"}
_IN_DXF: Final = {"in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6, "km": 7, "µm": 13}


def known_unit(name: str) -> str:
    """Return the key of `MILLIMETRES` that a name means; empty where it is none, such as "s"."""
    word = name.strip()
    word = _OTHER_NAMES.get(word.lower(), word)
    return next((each for each in (word, word.lower()) if each in MILLIMETRES), "")


def note_of_unknown(name: str) -> str:
    """Return what to know about a unit that no file knows; empty for a length, and for none at all."""
    if not name or known_unit(name):
        return ""
    return f"“{name}” is no length that files know; pictures and exported files have no true size with it."


def css_length(value: float, unit: str) -> str:
    """Return a length in one of the units as SVG takes it."""
    if unit not in _IN_CSS:
        value, unit = value * MILLIMETRES[unit], "mm"
    return f"{number(value)}{unit}"


def dxf_code(name: str) -> int:
    """Return what a DXF file writes for a unit, its $INSUNITS; 0 for none."""
    return _IN_DXF.get(known_unit(name), 0)


def unit_of_dxf(code: int) -> str:
    """Return the unit of a DXF file with this $INSUNITS; empty for none, and for those unknown here."""
    return next((unit for unit, each in _IN_DXF.items() if each == code), "")


def size_in_words(width: float, height: float, unit: str) -> str:
    """Return a size with three digits, and its unit."""
    return f"{width:.4g} × {height:.4g} {unit}"
