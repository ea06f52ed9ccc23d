"""Zoom as people say it: in per cent of true size."""

from __future__ import annotations

from ... import exchange
from ...document.expression import ExpressionError
from ...document.words import number
from ...widgets.field_edit import read_number

PIXELS_WITHOUT_UNIT = 100.0
"""Pixels of a length of 1 at 100 %, where nobody has said how long that is."""

_MILLIMETRES_PER_INCH = 25.4
_PLAIN = (0.01, 1e6)
"""Per cents that are written without a power of ten."""


def pixels_at_full_size(unit: str, dots_per_inch: float) -> float:
    """Return how many pixels a length of 1 takes at 100 %: as many as on paper, if its unit is one."""
    known = _known_unit(unit)
    if not known:
        return PIXELS_WITHOUT_UNIT
    return exchange.units.MILLIMETRES[known] / _MILLIMETRES_PER_INCH * dots_per_inch


def _known_unit(name: str) -> str:
    """Return the unit of length that a name means; empty where it is none, or there is no name."""
    return exchange.units.known_unit(name) if name else ""


def words_about_full_size(unit: str, dots_per_inch: float) -> str:
    """Return what 100 % means here, as a sentence."""
    pixels = number(pixels_at_full_size(unit, dots_per_inch), 3)
    if known := _known_unit(unit):
        return f"100 % is true size on this screen: 1 {known} is {pixels} pixels."
    return f"Without a unit of length 100 % shows a length of 1 as {pixels} pixels."


def per_cent_text(share: float) -> str:
    """Return a zoom with three digits: 1.0 as "100 %"."""
    value = 100 * share
    if not _PLAIN[0] <= value < _PLAIN[1]:
        return f"{number(value, 3)} %"
    return f"{number(float(f'{value:.3g}'), 7)} %"


def read_zoom(text: str) -> float:
    """Return the share that was typed: of "250 %", "250" and "500/2" 2.5.

    Raises
    ------
    ExpressionError
        With the sentence for the person, where it is none.
    """
    value = read_number(text.replace("%", " "))
    if value <= 0:
        raise ExpressionError("A zoom is greater than 0, such as 250 %.")
    return value / 100
