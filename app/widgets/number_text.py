"""Numbers and lengths as text: exact, in columns, in fields."""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np
from PySide6.QtCore import QLocale

from curvecore.arrays import FloatArray

from ..document.lengths import typed_length
from ..document.words import NOTHING, number, typographic

NEGLIGIBLE = 1e-12
"""Share of the greatest number of a column below which a number is a rounding residue, shown as 0."""

EXACT = 1e-14
"""Such a share of numbers that were not computed: of positions, which a rotation may have rounded."""

_WHOLE_DIGITS = 4

_FIELD_DIGITS, _FIELD_DECIMALS, _LEAST_DECIMALS = 7, 4, 3
"""Digits of a number in a field without the focus, decimals among them, and decimals of a large number."""

_ANGLE_DECIMALS = 3

_MOST_DIGITS = 15
"""Digits that every float can show exactly."""

_ROUNDED_UP = 2e-4
"""Decades by which a number may be rounded up: 9.996 may become 10.00."""

_LEAST_DECADE = -324
_DECADES = 309 - _LEAST_DECADE
"""Number of decades of floats."""


def decimal_mark() -> str:
    """Return the decimal mark of the user's locale: a comma or a point."""
    return "," if QLocale().decimalPoint() == "," else "."


def exact_text(value: float, mark: str = ".") -> str:
    """Return the shortest text that reads back as the same float; empty for NaN."""
    return "" if math.isnan(value) else repr(float(value)).replace(".", mark)


def typed_text(value: float) -> str:
    """Return the shortest text for exactly this float, in the user's locale."""
    mark = decimal_mark()
    return exact_text(value, mark).removesuffix(f"{mark}0")


def field_text(value: float) -> str:
    """Return a number short enough for a field, in the user's locale: 80.6367, 1234.568, 0.001235."""
    whole = _whole_digits(abs(value)) if 1 <= abs(value) < math.inf else 0
    digits = max(min(whole + _FIELD_DECIMALS, _FIELD_DIGITS), whole + _LEAST_DECIMALS)
    return number(value, min(digits, _MOST_DIGITS), decimal_mark())


def angle_text(degrees: float) -> str:
    """Return an angle to a thousandth of a degree, in the user's locale."""
    return typed_text(round(degrees, _ANGLE_DECIMALS) + 0.0)


class Extent(msgspec.Struct, frozen=True):
    """Signs and decades of the numbers in a column, which determine the width of their texts.

    Attributes
    ----------
    numbers
        A number as wide as any for each sign and decade; 0 for numbers that are negligible beside the
        greatest.
    whole_digits
        Digits of the greatest number before the decimal mark.
    is_signed
        Whether any number is negative.
    """

    numbers: frozenset[float]
    whole_digits: int
    is_signed: bool


class ColumnNumbers(msgspec.Struct, frozen=True):
    """Greatest magnitude of the numbers in a column, 0 without any, and their extent.

    `distinguishing` is the number of digits that tell them apart.
    """

    greatest: float
    extent: Extent
    distinguishing: int

    @property
    def negligible(self) -> float:
        """Magnitude below which a number is shown as 0."""
        return NEGLIGIBLE * self.greatest


def numbers_of_columns(values: FloatArray, residues: Sequence[float] = ()) -> list[ColumnNumbers]:
    """Return the magnitude, extent and digits of each column of `values`, (n, columns).

    Numbers of a column that differ by less than its share in `residues` of the greatest count as equal.
    """
    magnitudes, are_finite = np.abs(values), np.isfinite(values)
    magnitudes[~are_finite] = 0.0
    greatest = magnitudes.max(axis=0, initial=0.0)
    minimum = values.min(axis=0, initial=math.inf, where=are_finite)
    spread = values.max(axis=0, initial=-math.inf, where=are_finite) - minimum
    is_visible = (magnitudes > 0) & (magnitudes >= NEGLIGIBLE * greatest)
    rows, columns = np.nonzero(is_visible)
    decades = np.floor(np.log10(magnitudes[rows, columns]) + _ROUNDED_UP).astype(np.intp)
    # Marked in a grid: ten thousand numbers have only a few signs and decades.
    grid = np.zeros((values.shape[1], 2, _DECADES), dtype=bool)
    grid[columns, (values[rows, columns] < 0).astype(np.intp), decades - _LEAST_DECADE] = True
    signs_and_decades: list[list[tuple[int, int]]] = [[] for _ in greatest]
    for column, sign, decade in zip(*(indices.tolist() for indices in np.nonzero(grid)), strict=True):
        signs_and_decades[column].append((-1 if sign else 1, decade + _LEAST_DECADE))
    is_signed = np.atleast_1d(np.any(values < 0, axis=0))
    with np.errstate(invalid="ignore", over="ignore"):
        between_rows = np.abs(np.diff(values, axis=0))
    tolerances = greatest * (residues or NEGLIGIBLE)
    differ = between_rows > tolerances
    steps = between_rows.min(axis=0, initial=math.inf, where=differ).tolist()
    return [
        ColumnNumbers(
            maximum,
            _extent_of(signs_and_decades[column], maximum, is_signed=bool(is_signed[column])),
            distinguishing_digits(spread[column], maximum, steps[column], tolerances[column]),
        )
        for column, maximum in enumerate(greatest.tolist())
    ]


def _extent_of(signs_and_decades: list[tuple[int, int]], greatest: float, *, is_signed: bool) -> Extent:
    """Return the extent of numbers with these signs and powers of ten."""
    # Digits other than 0, which would be omitted at the end.
    numbers = [sign * float(f"1.111111e{decade}") for sign, decade in signs_and_decades]
    relevant = (0.0 if abs(value) < NEGLIGIBLE * greatest else value for value in numbers)
    return Extent(frozenset(relevant), _whole_digits(greatest), is_signed)


def column_decimals(values: FloatArray, digits: int) -> int:
    """Return the number of decimals of a column, as few as possible.

    Enough for every number to be shown exactly if `digits` digits of the greatest one allow it.
    """
    finite = values[np.isfinite(values)]
    greatest = float(np.abs(finite).max(initial=0.0))
    maximum = most_decimals(_whole_digits(greatest), digits)
    slack = min(NEGLIGIBLE * greatest, 0.5 * 10.0**-maximum)
    # The algorithm of np.round, for all decimals at once.
    tens = 10.0 ** np.arange(maximum)[:, np.newaxis]
    are_exact = (np.abs(np.rint(finite * tens) / tens - finite) <= slack).all(axis=1)
    return next((decimals for decimals, is_exact in enumerate(are_exact.tolist()) if is_exact), maximum)


def distinguishing_digits(spread: float, greatest: float, step: float, tolerance: float) -> int:
    """Return the digits that tell numbers apart: 12 for 1700000000.04, of which three are of the spread.

    `step` is the least difference of two neighbours, which differ in the last digit at least. 0 without a
    spread above the `tolerance`, or with one beyond all floats.
    """
    if not tolerance < spread < math.inf:
        return 0
    decimals = max(2 - math.floor(math.log10(spread)), math.ceil(-math.log10(min(step, spread))), 0)
    return min(_whole_digits(greatest) + decimals, _MOST_DIGITS)


def most_decimals(whole_digits: int, digits: int) -> int:
    """Return the decimals that fit in `digits` digits beside `whole_digits`."""
    return max(digits - whole_digits, 0)


def _whole_digits(greatest: float) -> int:
    return math.floor(math.log10(greatest)) + 1 if greatest >= 1 else 1


def column_text(value: float, decimals: int, digits: int, mark: str = ".", *, negligible: float = 0.0) -> str:
    """Return `value` with `decimals` decimals, or with a power of ten if it is too large or too small.

    Below `negligible` it counts as zero. Whole numbers may have four digits where `digits` is less: −1043 is
    more precise than −1e3.
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
    """Return texts of which one is as wide as the widest `column_text` of a column.

    The length of a number depends on its sign and decade only: one number for each is enough.
    """
    decimals = most_decimals(extent.whole_digits, digits)
    return {column_text(number, decimals, digits) for number in extent.numbers}


def read_length(text: str, unit: str, now: float | None = None) -> float:
    """Return the length that was typed in the user's locale; see `typed_length`."""
    return typed_length(text, unit, now, decimal_mark())


def length_text(value: float, unit: str) -> str:
    """Return a length with its unit, if it has one."""
    return f"{number(value, 6, decimal_mark())} {unit}".rstrip()
