"""Lengths of SVG, in user units, font sizes, and the sizes of files.

Reference: Scalable Vector Graphics 2, section 8.9; CSS Values and Units 4, section 6.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

from ...document.model import MAX_MAGNITUDE
from ...document.units import MILLIMETRES
from ..errors import ExchangeError

NUMBER = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
"""Regular expression of a number."""

_LENGTH = re.compile(rf"({NUMBER})\s*(px|in|cm|mm|pt|pc|q|em|ex|ch|rem|%)?", re.IGNORECASE)
_IN_FONTS = re.compile(rf"(?<![\w.]){NUMBER}(?:em|ex|ch|rem)\b", re.IGNORECASE)
_PIXELS = {"": 1.0, "q": 96 / 101.6} | {
    unit: MILLIMETRES[unit] / MILLIMETRES["px"] for unit in ("px", "in", "cm", "mm", "pt", "pc")
}
_FONT_SHARES = {"em": 1.0, "ex": 0.5, "ch": 0.5}
"""Units of a font as parts of its size. Of a font that is not there CSS takes half for x and for 0."""

_UNKNOWN = ("vw", "vh", "vi", "vb", "vmin", "vmax", "cap", "ic", "lh", "auto", ")")
_MEDIUM = 16.0
_FONT_SIZES = {
    "xx-small": 9.0,
    "x-small": 10.0,
    "small": 13.0,
    "medium": _MEDIUM,
    "initial": _MEDIUM,
    "large": 18.0,
    "x-large": 24.0,
    "xx-large": 32.0,
    "xxx-large": 48.0,
}
"""Pixels, as browsers have them."""

_STEPS = {"smaller": "0.8333333333333334em", "larger": "1.2em"}


@dataclass(frozen=True)
class Viewport:
    """Lengths that others are parts of, in user units; None where nobody says.

    Attributes
    ----------
    width, height
        Those that lengths in percent are parts of.
    em, rem
        The font size of the element, and of the root.
    """

    width: float | None = None
    height: float | None = None
    em: float = _MEDIUM
    rem: float = _MEDIUM

    def side(self, name: str) -> float | None:
        """Return what a length of this name is a part of."""
        if name in ("x", "width", "cx", "x1", "x2", "rx"):
            return self.width
        if name in ("y", "height", "cy", "y1", "y2", "ry"):
            return self.height
        if self.width is None or self.height is None:
            return None
        return math.hypot(self.width, self.height) / math.sqrt(2)

    def length(self, text: str, name: str = "") -> float | None:
        """Return the length of an attribute or a property, in user units; see `length`."""
        return length(text, self.side(name), self.em, self.rem)

    def sized(self, width: float, height: float) -> Viewport:
        """Return another one of the same fonts."""
        return replace(self, width=width, height=height)

    def with_font(self, size: str) -> Viewport:
        """Return the one within an element that declares this font size; an invalid one counts as none."""
        word = _STEPS.get(size.lower(), size.lower())
        try:
            em = _FONT_SIZES[word] if word in _FONT_SIZES else length(word, self.em, self.em, self.rem)
        except ExchangeError:
            return self
        return replace(self, em=em) if em is not None and 0 <= em <= MAX_MAGNITUDE else self

    def in_pixels(self, text: str) -> str:
        """Return lengths with those in units of a font as numbers."""
        return _IN_FONTS.sub(lambda match: repr(length(match[0], None, self.em, self.rem)), text)


def length(text: str, of: float | None = None, em: float | None = None, rem: float = _MEDIUM) -> float | None:
    """Return a length in user units; None where it is a part of something that nobody says.

    Raises
    ------
    ExchangeError
        If it is no length.
    """
    if text.strip().lower().endswith(_UNKNOWN):
        return None
    match = _LENGTH.fullmatch(text.strip())
    if match is None or not math.isfinite(float(match[1])):
        raise ExchangeError(f"“{text[:20]}” is not a length.")
    value, unit = float(match[1]), (match[2] or "").lower()
    if unit == "%":
        return None if of is None else of * value / 100
    if unit == "rem":
        return value * rem
    if unit in _FONT_SHARES:
        return None if em is None else value * em * _FONT_SHARES[unit]
    return value * _PIXELS[unit]


def with_unit(text: str, em: float) -> tuple[float, str] | None:
    """Return a positive length as a number and its unit; None for every other, and for shares.

    Parameters
    ----------
    text
        The length.
    em
        The font size of the root: lengths in units of its font are pixels.
    """
    match = _LENGTH.fullmatch(text.strip())
    if match is None or (match[2] or "").lower() == "%":
        return None
    value, unit = float(match[1]), (match[2] or "px").lower()
    if unit == "q":
        value, unit = value / 4, "mm"
    elif unit == "rem" or unit in _FONT_SHARES:
        value, unit = value * em * _FONT_SHARES.get(unit, 1.0), "px"
    return (value, unit) if 0 < value < math.inf else None
