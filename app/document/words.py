"""Words for people: labels of members, numbers, amounts, lists; and sums of decimals as people write them.

Rounding happens here and nowhere else: a displayed number is a view, the value stays exact.

An enumeration that people see is a `NamedEnum`: each member has its label, `BESSEL = "bessel", "Bessel
(parabola)"`. Numbers on the screen have a true minus; files, the clipboard and typed fields a plain one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from decimal import ROUND_UP, Context, Decimal
from enum import StrEnum
from typing import Self

NOTHING = "–"
"""Stands where there is no number."""


class NamedEnum(StrEnum):
    """An enumeration whose members say, beside their value, what the window calls them.

    Attributes
    ----------
    label
        The name in the window.
    """

    label: str

    def __new__(cls, value: str, *_words: object) -> Self:
        """Return a member: text that is the first of its words."""
        member = str.__new__(cls, value)
        member._value_ = value
        return member

    # With defaults, because a member is found by its value alone, too.
    def __init__(self, _value: str, label: str = "") -> None:
        self.label = label


def number(value: float, digits: int = 4, mark: str = ".") -> str:
    """Return a number with at most so many significant digits, a true minus sign and a short exponent."""
    return typographic(f"{value:.{digits}g}", mark) if math.isfinite(value) else NOTHING


def rounded_up(value: float, digits: int) -> float:
    """Return a value of at least 0 with so many digits, never less than it is: a bound stays one."""
    return float(Context(prec=digits, rounding=ROUND_UP).create_decimal_from_float(value))


def digits_of_range(low: float, high: float, least: int = 6) -> int:
    """Return how many significant digits tell two numbers and their distance, `least` of them at least."""

    def shown(digits: int) -> float:
        return float(f"{high:.{digits}g}") - float(f"{low:.{digits}g}")

    apart = high - low
    return next((each for each in range(least, 17) if abs(shown(each) - apart) <= 0.01 * apart), 17)


def distance_text(value: float, other: str, *, is_bound: bool = True) -> str:
    """Say how far something is from another thing: at most where that is certain, else about."""
    if not value:
        return "exact"
    text = f"at most {number(rounded_up(value, 2), 2)}" if is_bound else f"about {number(value, 2)}"
    return f"{text} from {other}"


def with_error(value: float, error: float, shown: Callable[[float], str] = number) -> str:
    """Return a number, with its error where that shows in four digits; "uncertain" where it may be any."""
    if not error > 5e-5 * abs(value):
        return shown(value)
    return f"{shown(value)} ± {shown(rounded_up(error, 1))}" if math.isfinite(error) else "uncertain"


def with_decimals(value: float, decimals: int) -> str:
    """Return a number with so many decimals and a true minus sign."""
    return typographic(f"{value:.{decimals}f}") if math.isfinite(value) else NOTHING


def typographic(text: str, mark: str = ".") -> str:
    """Return a number that Python wrote as 1e-05 as 1e−5, with the mark; no minus before a rounded zero."""
    mantissa, _, exponent = text.partition("e")
    if exponent:
        text = f"{mantissa}e{int(exponent)}"
    elif float(text) == 0:
        text = text.removeprefix("-")
    return with_minus(text.replace(".", mark))


def with_minus(text: str) -> str:
    """Return text whose hyphens, which stand before numbers alone, are true minus signs."""
    return text.replace("-", "−")


def pair_text(value: tuple[float, float]) -> str:
    """Return two numbers, such as the coordinates of a place or the components of a way."""
    return f"{number(value[0])}, {number(value[1])}"


def point_at(index: int, place: tuple[float, float]) -> str:
    """Return "Point 3 at 2.4, 5.158"."""
    return f"Point {index} at {pair_text(place)}"


def direction(way: tuple[float, float]) -> str:
    """Return the direction of a way."""
    return angle(math.degrees(math.atan2(way[1], way[0])))


def polar(way: tuple[float, float]) -> str:
    """Return length and direction, "3.2 at 45°"."""
    return f"{number(math.hypot(*way))} at {direction(way)}"


def points_label(indices: Collection[int]) -> str:
    """Return "point 3" or "4 points"."""
    return f"point {next(iter(indices))}" if len(indices) == 1 else f"{len(indices)} points"


def angle(degrees: float) -> str:
    """Return an angle to a tenth of a degree."""
    return f"{number(round(degrees, 1), 6)}°"


def count_of(count: int, noun: str) -> str:
    """Return "1 point", "2 points"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def names_of(names: Sequence[str]) -> str:
    """Return the first names, and how many more there are."""
    shown = list(names[:3])
    if len(names) > len(shown):
        shown.append(f"{len(names) - len(shown)} more")
    return enumerated(shown)


def enumerated(words: Sequence[str], conjunction: str = "and") -> str:
    """Return "a", "a and b", "a, b and c"."""
    *first, last = words
    return f"{', '.join(first)} {conjunction} {last}" if first else last


def names_with_verb(names: Sequence[str]) -> str:
    """Return "a was", "a and b were": the beginning of a sentence that says what became of them."""
    return f"{names_of(names)} {'was' if len(names) == 1 else 'were'}"


def decimal_sum(a: float, b: float) -> float:
    """Return a + b as the decimal numbers that they are written as."""
    return float(Decimal(repr(a)) + Decimal(repr(b)))


def decimal_product(a: float, b: float) -> float:
    """Return a · b as the decimal numbers that they are written as."""
    return float(Decimal(repr(a)) * Decimal(repr(b)))
