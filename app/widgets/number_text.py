"""Numbers and lengths as text: exact, in columns, in fields."""

from __future__ import annotations

import math

import msgspec
import numpy as np
from PySide6.QtCore import QLocale

from curvecore.arrays import FloatArray

from ..document.lengths import typed_length
from ..document.words import NOTHING, number, typographic

NEGLIGIBLE = 1e-12
"""Share of the greatest number beside it below which a number is a rounding residue, shown as 0."""

_WHOLE_DIGITS = 4

_FIELD_DIGITS, _FIELD_DECIMALS = 7, 4
"""Digits, and decimals among them, of a number in a field where nobody types."""

_ANGLE_DECIMALS = 3

_ROUNDED_UP = 2e-4
"""In powers of ten: 9.996 may be written 10.00."""

_LEAST_DECADE = -324
_DECADES = 309 - _LEAST_DECADE
"""Powers of ten of floats."""


def decimal_mark() -> str:
    """Return the decimal mark of the person's locale: a comma, or else a point."""
    return "," if QLocale().decimalPoint() == "," else "."


def exact_text(value: float, mark: str = ".") -> str:
    """Return the shortest text that reads back as the same float; empty for NaN."""
    return "" if math.isnan(value) else repr(float(value)).replace(".", mark)


def typed_text(value: float) -> str:
    """Return the shortest text that a person may type for just this float, in the person's locale."""
    mark = decimal_mark()
    return exact_text(value, mark).removesuffix(f"{mark}0")


def field_text(value: float) -> str:
    """Return a number short enough for a field, in the person's locale: 80.6367, 1234.568, 0.001235."""
    whole = _whole_digits(abs(value)) if 1 <= abs(value) < math.inf else 0
    return number(value, min(whole + _FIELD_DECIMALS, _FIELD_DIGITS), decimal_mark())


def angle_text(degrees: float) -> str:
    """Return an angle to a thousandth of a degree, as a person may type it."""
    return typed_text(round(degrees, _ANGLE_DECIMALS) + 0.0)


class Extent(msgspec.Struct, frozen=True):
    """The signs and powers of ten of the numbers in a column: all that decides how wide they are written.

    Attributes
    ----------
    numbers
        For each sign and power of ten among them a number as wide as any; 0 for those that are negligible
        beside the greatest.
    whole_digits
        How many digits the greatest has before the decimal mark.
    is_signed
        Whether any is negative.
    """

    numbers: frozenset[float]
    whole_digits: int
    is_signed: bool


class ColumnNumbers(msgspec.Struct, frozen=True):
    """Greatest magnitude of the numbers in a column, 0 where there is none, and their extent.

    `telling` are the digits that tell them apart.
    """

    greatest: float
    extent: Extent
    telling: int

    @property
    def negligible(self) -> float:
        """Magnitude below which a number is shown as 0."""
        return NEGLIGIBLE * self.greatest


def numbers_of_columns(values: FloatArray) -> list[ColumnNumbers]:
    """Return what is known of each column of `values`, (n, columns)."""
    magnitudes, are_finite = np.abs(values), np.isfinite(values)
    magnitudes[~are_finite] = 0.0
    greatest = magnitudes.max(axis=0, initial=0.0)
    least = values.min(axis=0, initial=math.inf, where=are_finite)
    spread = values.max(axis=0, initial=-math.inf, where=are_finite) - least
    shown = (magnitudes > 0) & (magnitudes >= NEGLIGIBLE * greatest)
    rows, columns = np.nonzero(shown)
    decades = np.floor(np.log10(magnitudes[rows, columns]) + _ROUNDED_UP).astype(np.intp)
    # Marked in a grid: of ten thousand numbers there are but a few signs and decades.
    grid = np.zeros((values.shape[1], 2, _DECADES), dtype=bool)
    grid[columns, (values[rows, columns] < 0).astype(np.intp), decades - _LEAST_DECADE] = True
    seen: list[list[tuple[int, int]]] = [[] for _ in greatest]
    for column, sign, place in zip(*(each.tolist() for each in np.nonzero(grid)), strict=True):
        seen[column].append((-1 if sign else 1, place + _LEAST_DECADE))
    is_signed = np.atleast_1d(np.any(values < 0, axis=0))
    return [
        ColumnNumbers(
            most,
            _extent_of(seen[column], most, is_signed=bool(is_signed[column])),
            telling_digits(spread[column], most),
        )
        for column, most in enumerate(greatest.tolist())
    ]


def _extent_of(seen: list[tuple[int, int]], greatest: float, *, is_signed: bool) -> Extent:
    """Return the extent of numbers with these signs and powers of ten."""
    # No digit of these is a 0 that is left out at the end.
    numbers = [sign * float(f"1.111111e{decade}") for sign, decade in seen]
    kept = (0.0 if abs(each) < NEGLIGIBLE * greatest else each for each in numbers)
    return Extent(frozenset(kept), _whole_digits(greatest), is_signed)


def column_decimals(values: FloatArray, digits: int) -> int:
    """Return how many decimals a column shows, so that its numbers are as short as they can be.

    Enough for every number to be shown exactly if `digits` digits of the greatest one allow it.
    """
    finite = values[np.isfinite(values)]
    greatest = float(np.abs(finite).max(initial=0.0))
    most, slack = most_decimals(_whole_digits(greatest), digits), NEGLIGIBLE * greatest
    # As np.round does it, for all decimals at once.
    tens = 10.0 ** np.arange(most)[:, np.newaxis]
    are_exact = (np.abs(np.rint(finite * tens) / tens - finite) <= slack).all(axis=1)
    return next((decimals for decimals, is_exact in enumerate(are_exact.tolist()) if is_exact), most)


def telling_digits(spread: float, greatest: float) -> int:
    """Return how many digits it takes to tell numbers apart, three of their spread: 12 of 1700000000.04.

    They are 0 where the spread is none, or beyond all floats.
    """
    if not NEGLIGIBLE * greatest < spread < math.inf:
        return 0
    return _whole_digits(greatest) + max(2 - math.floor(math.log10(spread)), 0)


def most_decimals(whole_digits: int, digits: int) -> int:
    """Return how many decimals there is room for if `digits` digits hold a number with so many whole ones."""
    return max(digits - whole_digits, 0)


def _whole_digits(greatest: float) -> int:
    return math.floor(math.log10(greatest)) + 1 if greatest >= 1 else 1


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
        return typographic(f"{value:.{max(digits - 3, 1)}g}", mark)
    return typographic(fixed, mark)


def widest_texts(extent: Extent, digits: int) -> set[str]:
    """Return texts of which one is as wide as any that `column_text` writes of a column at most.

    How many characters a number takes is a matter of its sign and its power of ten: one for each is enough.
    """
    decimals = most_decimals(extent.whole_digits, digits)
    return {column_text(number, decimals, digits) for number in extent.numbers}


def read_length(text: str, unit: str, now: float | None = None) -> float:
    """Return the length that was typed in the person's locale; see `typed_length`."""
    return typed_length(text, unit, now, decimal_mark())


def length_text(value: float, unit: str) -> str:
    """Return a length with its unit, if it has one."""
    return f"{number(value, 6, decimal_mark())} {unit}".rstrip()
