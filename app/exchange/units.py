"""Units of length as files write them."""

from __future__ import annotations

from typing import Final

from ..document.lengths import known_unit

POINTS_PER_MILLIMETRE: Final = 72 / 25.4

_IN_DXF: Final = {"in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6, "km": 7, "µm": 13}


def note_of_unknown(name: str) -> str:
    """Return what to know about a unit that no file knows; empty for a length, and for none at all."""
    if not name or known_unit(name):
        return ""
    return f"“{name}” is no length that files know; pictures and exported files have no true size with it."


def dxf_code(name: str) -> int:
    """Return what a DXF file writes for a unit, its $INSUNITS; 0 for none."""
    return _IN_DXF.get(known_unit(name), 0)


def unit_of_dxf(code: int) -> str:
    """Return the unit of a DXF file with this $INSUNITS; empty for none, and for those unknown here."""
    return next((unit for unit, each in _IN_DXF.items() if each == code), "")


def size_in_words(width: float, height: float, unit: str) -> str:
    """Return a size with three digits, and its unit."""
    return f"{width:.4g} × {height:.4g} {unit}"
