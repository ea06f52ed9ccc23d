"""Lengths of SVG, in user units, and the sizes of files."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from ...document.units import MILLIMETRES
from ..errors import ExchangeError

_LENGTH = re.compile(
    r"\s*([-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(px|in|cm|mm|pt|pc|q|%)?\s*",
    re.IGNORECASE,
)
_PIXELS = {"": 1.0, "q": 96 / 101.6} | {
    unit: MILLIMETRES[unit] / MILLIMETRES["px"] for unit in ("px", "in", "cm", "mm", "pt", "pc")
}
_FROM_FONTS = ("em", "ex", "ch", "rem", "vw", "vh", "auto")


@dataclass(frozen=True)
class Viewport:
    """Lengths that those in percent are parts of, in user units; None where nobody says."""

    width: float | None = None
    height: float | None = None

    def side(self, name: str) -> float | None:
        """Return what a length of this name is a part of."""
        if name in ("x", "width", "cx", "x1", "x2", "rx"):
            return self.width
        if name in ("y", "height", "cy", "y1", "y2", "ry"):
            return self.height
        if self.width is None or self.height is None:
            return None
        return math.hypot(self.width, self.height) / math.sqrt(2)


def length(text: str, of: float | None = None) -> float | None:
    """Return a length in user units; None where it hangs on a font, or on a size that nobody says.

    Raises
    ------
    ExchangeError
        If it is no length.
    """
    if text.strip().lower().endswith(_FROM_FONTS):
        return None
    match = _LENGTH.fullmatch(text)
    if match is None or not math.isfinite(float(match[1])):
        raise ExchangeError(f"“{text[:20]}” is not a length.")
    unit = (match[2] or "").lower()
    if unit == "%":
        return None if of is None else of * float(match[1]) / 100
    return float(match[1]) * _PIXELS[unit]


def with_unit(text: str) -> tuple[float, str] | None:
    """Return a positive length as a number and its unit; None for every other, and for shares."""
    match = _LENGTH.fullmatch(text)
    if match is None or (match[2] or "").lower() == "%":
        return None
    value, unit = float(match[1]), (match[2] or "px").lower()
    if unit == "q":
        value, unit = value / 4, "mm"
    return (value, unit) if 0 < value < math.inf else None
