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
"""Text in place of a missing number."""

_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_MOST_DIGITS = 15
"""Digits that every float can show exactly."""

_DWARFED = 1e-6
"""Share of a step below which a number is a rounding error."""

_THIN = "\N{NARROW NO-BREAK SPACE}"


class NamedEnum(StrEnum):
    """Enumeration of texts whose members have a label.

    Attributes
    ----------
    label
        The name in the window.
    """

    label: str

    def __new__(cls, value: str, *_words: object) -> Self:
        """Return a member whose text is the first of its arguments."""
        member = str.__new__(cls, value)
        member._value_ = value
        return member

    # With a default, because `Kind("value")` looks a member up by its value alone.
    def __init__(self, _value: str, label: str = "") -> None:
        self.label = label


def number(value: float, digits: int = 4, mark: str = ".", step: float = 0.0) -> str:
    """Return the text of a number: `digits` significant digits, a true minus, a short exponent.

    There are more digits where numbers a `step` apart would look alike, and 0 is what a step dwarfs.

    >>> number(1000000.25), number(1000000.25, step=0.01), number(1e-15, step=0.01)
    ('1e6', '1000000.25', '0')
    """
    if not math.isfinite(value):
        return NOTHING
    if abs(value) > step > 0.0:
        whole_digits = math.floor(math.log10(abs(value))) + 1
        digits = min(max(digits, whole_digits + math.ceil(-math.log10(step))), _MOST_DIGITS)
    elif abs(value) < _DWARFED * step:
        value = 0.0
    return typographic(f"{value:.{digits}g}", mark)


def rounded_up(value: float, digits: int) -> float:
    """Return a value ≥ 0 rounded up to `digits` significant digits, so that a bound stays a bound."""
    return float(Context(prec=digits, rounding=ROUND_UP).create_decimal_from_float(value))


def digits_of_range(low: float, high: float, least: int = 6) -> int:
    """Return the number of significant digits that shows two numbers exactly, where twelve are enough.

    Else their distance within 1 %.
    """

    def is_shown(digits: int, share: float) -> bool:
        return all(abs(float(f"{end:.{digits}g}") - end) <= share * (high - low) for end in (low, high))

    exact = next((n for n in range(least, 13) if is_shown(n, 0.0)), 0)
    return exact or next((n for n in range(least, 17) if is_shown(n, 0.005)), 17)


def distance_text(value: float, other: str, *, is_bound: bool = True) -> str:
    """Return "at most 0.01 from the curve", or "about …" where the distance is no bound."""
    if not value:
        return "exact"
    text = f"at most {number(rounded_up(value, 2), 2)}" if is_bound else f"about {number(value, 2)}"
    return f"{text} from {other}"


def with_error(value: float, error: float, text_of: Callable[[float], str] = number) -> str:
    """Return a number with its error, if that affects four digits; "uncertain" if the error is not finite."""
    if not error > 5e-5 * abs(value):
        return text_of(value)
    return f"{text_of(value)} ± {text_of(rounded_up(error, 1))}" if math.isfinite(error) else "uncertain"


def with_decimals(value: float, decimals: int) -> str:
    """Return the text of a number with a fixed number of decimals and a true minus sign."""
    return typographic(f"{value:.{decimals}f}") if math.isfinite(value) else NOTHING


def typographic(text: str, mark: str = ".") -> str:
    """Return the text of a number with decimal `mark`: "1e-05" becomes "1e−5", "-0.0" becomes "0.0"."""
    mantissa, _, exponent = text.partition("e")
    if exponent:
        text = f"{mantissa}e{int(exponent)}"
    elif float(text) == 0:
        text = text.removeprefix("-")
    return with_minus(text.replace(".", mark))


def with_minus(text: str) -> str:
    """Return text with true minus signs in place of hyphens, which must stand before numbers only."""
    return text.replace("-", "−")


def short(value: float) -> str:
    """Return a number as 0.034, −3.1, 10 987 or 1.2·10⁹."""
    if not math.isfinite(value):
        return "∞"
    size = abs(value)
    if size == 0:
        return "0"
    if size >= 999_999.5 or size < 0.000_95:
        mantissa, _, exponent = f"{value:.1e}".partition("e")
        text = f"{mantissa.removesuffix('.0')}·10{str(int(exponent)).translate(_SUPERSCRIPTS)}"
    elif size >= 99.5:
        text = f"{value:,.0f}".replace(",", _THIN if size >= 9_999.5 else "")
    else:
        text = f"{value:.2g}"
    return with_minus(text)


def power(exponent: float) -> str:
    """Return 10 with an integer exponent."""
    return f"10{str(round(exponent)).translate(_SUPERSCRIPTS)}"


def pair_text(value: tuple[float, float], step: float = 0.0) -> str:
    """Return the text of two numbers: coordinates of a position or components of a vector; see `number`."""
    return f"{number(value[0], step=step)}, {number(value[1], step=step)}"


def point_at(index: int, position: tuple[float, float], step: float = 0.0) -> str:
    """Return "Point 3 at 2.4, 5.158"; see `number`."""
    return f"Point {index} at {pair_text(position, step)}"


def direction(vector: tuple[float, float]) -> str:
    """Return the direction of a vector, "45°"."""
    return angle(math.degrees(math.atan2(vector[1], vector[0])))


def polar(vector: tuple[float, float]) -> str:
    """Return length and direction of a vector, "3.2 at 45°"."""
    return f"{number(math.hypot(*vector))} at {direction(vector)}"


def points_label(indices: Collection[int]) -> str:
    """Return "point 3" or "4 points"."""
    return f"point {next(iter(indices))}" if len(indices) == 1 else f"{len(indices)} points"


def capitalized(text: str) -> str:
    """Return a text with a capital at the beginning."""
    return text[:1].upper() + text[1:]


def angle(degrees: float) -> str:
    """Return an angle to a tenth of a degree."""
    return f"{number(round(degrees, 1), 6)}°"


def count_of(count: int, noun: str) -> str:
    """Return "1 point", "2 points"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def names_of(names: Sequence[str]) -> str:
    """Return the first three names, and the number of the others: "a, b, c and 2 more"."""
    first = list(names[:3])
    if len(names) > len(first):
        first.append(f"{len(names) - len(first)} more")
    return enumerated(first)


def enumerated(words: Sequence[str], conjunction: str = "and") -> str:
    """Return "a", "a and b", "a, b and c"."""
    *first, last = words
    return f"{', '.join(first)} {conjunction} {last}" if first else last


def names_with_verb(names: Sequence[str]) -> str:
    """Return "a was" or "a and b were", the beginning of a passive sentence."""
    return f"{names_of(names)} {'was' if len(names) == 1 else 'were'}"


def decimal_sum(a: float, b: float) -> float:
    """Return a + b as the decimal numbers that they are written as."""
    return float(Decimal(repr(a)) + Decimal(repr(b)))


def decimal_product(a: float, b: float) -> float:
    """Return a · b as the decimal numbers that they are written as."""
    return float(Decimal(repr(a)) * Decimal(repr(b)))
