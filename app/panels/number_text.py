"""Numbers as the panels show them. What is shown is a view; the value behind it stays whole."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import QLocale

NOTHING = "–"
"""Stands where there is no number."""

NEGLIGIBLE = 1e-12
"""What is smaller than this share of the greatest number beside it is a rounding residue, shown as 0."""

_WHOLE_DIGITS = 4

_ROUNDED_UP = 2e-4
"""In powers of ten: 9.996 may be written 10.00."""


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
    finite, most = values[np.isfinite(values)], most_decimals(values, digits)
    slack = NEGLIGIBLE * greatest_of(values)
    for decimals in range(most):
        if bool((np.abs(np.round(finite, decimals) - finite) <= slack).all()):
            return decimals
    return most


def most_decimals(values: npt.NDArray[np.float64], digits: int) -> int:
    """Return how many decimals there is room for if `digits` digits hold the greatest number."""
    greatest = greatest_of(values)
    whole = math.floor(math.log10(greatest)) + 1 if greatest >= 1 else 1
    return max(digits - whole, 0)


def column_text(value: float, decimals: int, digits: int, mark: str = ".", *, negligible: float = 0.0) -> str:
    """Return `value` with `decimals` decimals, or with a power of ten where it has no place among them.

    Below `negligible` it counts as zero. Whole numbers may have four digits where `digits` are fewer: −1043
    says more than −1e3.
    """
    if not math.isfinite(value):
        return NOTHING
    fixed = f"{value:.{decimals}f}"
    if abs(value) < negligible:
        fixed = f"{0:.{decimals}f}"
    elif (value != 0 and float(fixed) == 0) or abs(value) >= 10.0 ** max(digits, _WHOLE_DIGITS):
        return _polished(f"{value:.{max(digits - 3, 1)}g}", mark)
    return _polished(fixed, mark)


def widest_texts(values: npt.NDArray[np.float64], digits: int) -> set[str]:
    """Return texts of which one is as wide as any that `column_text` writes of a column at most.

    How many characters a number takes is a matter of its sign and its power of ten: one for each is enough.
    """
    finite = values[np.isfinite(values) & (values != 0)]
    negligible, decimals = NEGLIGIBLE * greatest_of(values), most_decimals(values, digits)
    seen = finite[np.abs(finite) >= negligible]
    decades = np.unique(
        np.column_stack([np.sign(seen), np.floor(np.log10(np.abs(seen)) + _ROUNDED_UP)]), axis=0
    )
    # No digit of these is a 0 that is left out at the end.
    numbers = [sign * float(f"1.111111e{decade:.0f}") for sign, decade in decades.tolist()]
    return {column_text(number, decimals, digits, negligible=negligible) for number in numbers}


def greatest_of(values: npt.NDArray[np.float64]) -> float:
    """Return the greatest magnitude in a column, 0 where it holds no number."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def _polished(text: str, mark: str) -> str:
    """Write 1e-05 as 1e−5, with a real minus and the mark; no minus before a rounded zero."""
    mantissa, _, exponent = text.partition("e")
    if exponent:
        text = f"{mantissa}e{int(exponent)}"
    elif float(text) == 0:
        text = text.removeprefix("-")
    return text.replace(".", mark).replace("-", "−")
