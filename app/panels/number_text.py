"""Numbers as the panels show them. What is shown is a view; the value behind it stays whole."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import QLocale

NOTHING = "–"
"""Stands where there is no number."""


def decimal_mark() -> str:
    """Return the decimal mark of the person's locale: a comma, or else a point."""
    return "," if QLocale().decimalPoint() == "," else "."


def exact_text(value: float, mark: str = ".") -> str:
    """Return the shortest text that reads back as the same float; empty for NaN."""
    return "" if math.isnan(value) else repr(float(value)).replace(".", mark)


def rounded_text(value: float, mark: str = ".", digits: int = 6) -> str:
    """Return `value` with at most `digits` significant digits and a real minus sign."""
    return _polished(f"{value:.{digits}g}", mark) if math.isfinite(value) else NOTHING


def column_decimals(values: npt.NDArray[np.float64], digits: int) -> int:
    """Return how many decimals a column shows, so that its numbers are as short as they can be.

    Enough for every number to be shown exactly if `digits` digits of the greatest one allow it.
    """
    finite = values[np.isfinite(values)]
    greatest = float(np.abs(finite).max(initial=0.0))
    whole = math.floor(math.log10(greatest)) + 1 if greatest >= 1 else 1
    most = max(digits - whole, 0)
    for decimals in range(most):
        if bool((np.round(finite, decimals) == finite).all()):
            return decimals
    return most


def column_text(value: float, decimals: int, digits: int, mark: str = ".") -> str:
    """Return `value` with `decimals` decimals, or with a power of ten where it has no place among them."""
    if not math.isfinite(value):
        return NOTHING
    fixed = f"{value:.{decimals}f}"
    too_small = value != 0 and abs(value) < 10.0 ** (1 - decimals) and float(fixed) != value
    if too_small or abs(value) >= 10.0**digits:
        return _polished(f"{value:.{max(digits - 3, 1)}g}", mark)
    return _polished(fixed, mark)


def _polished(text: str, mark: str) -> str:
    """Write 1e-05 as 1e−5, with a real minus and the mark; no minus before a rounded zero."""
    mantissa, _, exponent = text.partition("e")
    if exponent:
        text = f"{mantissa}e{int(exponent)}"
    elif float(text) == 0:
        text = text.removeprefix("-")
    return text.replace(".", mark).replace("-", "−")
