"""Lengths as people type them, each with its unit: ``1in``, ``70 mm``, ``1/3``, ``2in + 3mm``, ``+10%``."""

from __future__ import annotations

import re
from fractions import Fraction

from .expression import CONSTANTS, FUNCTIONS, ExpressionError, parse_number
from .units import MILLIMETRES, known_unit

_UNIT = re.compile(r"""(?<=[\d.,)\s])([^\W\d_]+|["″′])""")
"""A word after a number, or the mark of an inch or a foot."""

_ALONE = re.compile(r"""(.*?)\s*([^\W\d_]+|["″′])""", re.DOTALL)

_IN_NUMBERS = {*FUNCTIONS, *CONSTANTS, "e", "E"}
"""Words of numbers and expressions."""

_PER_CENT = re.compile(r"([-+−]?)([^-+−%][^%]*)%\s*")


def typed_length(text: str, unit: str, now: float | None = None, locale_decimal: str = ".") -> float:
    """Return the length that a text means, in the unit of the document.

    Parameters
    ----------
    text
        A number or an expression whose numbers may have units; or a share of the present length, "50%",
        or by how much it shall change, "+10%".
    unit
        The document's unit, whatever word that is; numbers without one are in it. Empty where there is none.
    now
        The present length; None where there is none, and a share of it is refused.
    locale_decimal
        As for `parse_number`.

    Raises
    ------
    ExpressionError
        If the text is no length, or has a unit where the document has none.
    """
    share = _PER_CENT.fullmatch(text.strip())
    if share is not None and now is not None:
        sign, number = share.groups()
        part = now * parse_number(number, locale_decimal) / 100.0
        return part if not sign else now + part if sign == "+" else now - part
    alone = _ALONE.fullmatch(text.strip())
    if alone is not None and _is_unit(alone[2], unit) and not _UNIT.search(alone[1]):
        factor = _factor(alone[2], unit)
        return parse_number(alone[1], locale_decimal) * factor.numerator / factor.denominator
    return parse_number(_UNIT.sub(lambda found: _converted(found, unit), text), locale_decimal)


def _converted(found: re.Match[str], unit: str) -> str:
    """Return what stands in an expression for a word: a factor where it is a unit."""
    word = found.group()
    if not _is_unit(word, unit):
        is_after_number = found.string[: found.start()].rstrip()[-1:].isdigit()
        if is_after_number and word not in _IN_NUMBERS:
            _refuse_without_length(word, unit)
            raise ExpressionError(f"“{word}” is no unit of length known here, such as mm, cm, in, pt and px.")
        return word
    factor = _factor(word, unit)
    return f"*{factor.numerator}/{factor.denominator}"


def _is_unit(word: str, unit: str) -> bool:
    """Whether a word is a unit of length, or the unit of the document, which may be any word."""
    return bool(known_unit(word)) or (word == unit and word not in _IN_NUMBERS)


def _factor(word: str, unit: str) -> Fraction:
    """Return how many of the document's unit one of another is."""
    if word == unit:
        return Fraction(1)
    _refuse_without_length(word, unit)
    return _exact(known_unit(word)) / _exact(known_unit(unit))


def _refuse_without_length(word: str, unit: str) -> None:
    """Raise ExpressionError where the unit of the document is none, so that a word has no place there."""
    if known_unit(unit):
        return
    why = (
        f"“{unit}”, the unit of the document, has no length" if unit else "The document has no unit of length"
    )
    raise ExpressionError(f"{why}; type a number without “{word}”.")


def _exact(unit: str) -> Fraction:
    """Return the millimetres of a unit as the fraction that they are: 127/360 of a point."""
    return Fraction(MILLIMETRES[unit]).limit_denominator(10**6)
