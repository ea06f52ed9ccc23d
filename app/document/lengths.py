"""Units of length, and lengths as people type them: ``1in``, ``70 mm``, ``1/3``, ``2in + 3mm``, ``+10%``."""

from __future__ import annotations

import re
from typing import Final, NoReturn

from .expression import CONSTANTS, FUNCTIONS, ExpressionError, parse_number

MILLIMETRES: Final = {
    "µm": 1e-3,
    "mm": 1.0,
    "cm": 10.0,
    "m": 1e3,
    "km": 1e6,
    "in": 25.4,
    "ft": 304.8,
    "pt": 25.4 / 72,
    "pc": 25.4 / 6,
    "px": 25.4 / 96,
}
"""Millimetres in each unit of length; px is that of CSS."""

_OTHER_NAMES: Final = {"um": "µm", "μm": "µm", "inch": "in", "inches": "in", '"': "in", "″": "in", "′": "ft"}


def known_unit(name: str) -> str:
    """Return the key of `MILLIMETRES` for the name of a unit; empty where it is no length, such as "s"."""
    word = name.strip()
    word = _OTHER_NAMES.get(word.lower(), word)
    return next((name for name in (word, word.lower()) if name in MILLIMETRES), "")


# Typed lengths

_UNIT = re.compile(r"""(?<=[\d.,)\s])([^\W\d_]+|["″′])""")
"""Word after a number, or the mark of inches or feet."""

_ALONE = re.compile(r"""(.*?)\s*([^\W\d_]+|["″′])""", re.DOTALL)

_LETTERS = re.compile(r"[^\W\d_]*$")

_IN_NUMBERS = {*FUNCTIONS, *CONSTANTS, "e", "E"}
"""Words that belong to an expression, not to a unit."""

_PER_CENT = re.compile(r"([-+−]?)([^-+−%][^%]*)%\s*")


def typed_length(text: str, unit: str, now: float | None = None, locale_decimal: str = ".") -> float:
    """Return the value of a typed length, in the unit of the document.

    Parameters
    ----------
    text
        A number or an expression whose numbers may have units; or a percentage of the present length, "50%",
        or a change by one, "+10%".
    unit
        The unit of the document, which may be any word; numbers without a unit are in it. Empty for none.
    now
        The present length; None where percentages are refused.
    locale_decimal
        As for `parse_number`.

    Raises
    ------
    ExpressionError
        If the text is no length, or has a unit while the document has none.
    """
    share = _PER_CENT.fullmatch(text.strip())
    if share is not None and now is not None:
        sign, number = share.groups()
        part = now * parse_number(number, locale_decimal) / 100.0
        return part if not sign else now + part if sign == "+" else now - part
    alone = _ALONE.fullmatch(text.strip())
    if alone is not None and _is_unit(alone[2], unit) and not _UNIT.search(alone[1]):
        numerator, denominator = _factor(alone[2], unit)
        return parse_number(alone[1], locale_decimal) * numerator / denominator
    return parse_number(_UNIT.sub(lambda match: _converted(match, unit), text), locale_decimal)


def check_unit(text: str, unit: str) -> None:
    """Raise ExpressionError if the letters at the end of a text are not the beginning of an allowed unit."""
    word = _LETTERS.findall(text)[0]
    allowed = (*MILLIMETRES, unit) if known_unit(unit) else (unit,)
    if not any(name.lower().startswith(word.lower()) for name in allowed):
        _refuse_without_length(word, unit)
        _refuse_word(word)


def _refuse_word(word: str) -> NoReturn:
    raise ExpressionError(f"“{word}” is not a unit of length. Use mm, cm, in, pt or px.")


def _converted(match: re.Match[str], unit: str) -> str:
    """Return a factor in place of a unit; other words unchanged."""
    word = match.group()
    if not _is_unit(word, unit):
        is_after_number = match.string[: match.start()].rstrip()[-1:].isdigit()
        if is_after_number and word not in _IN_NUMBERS:
            _refuse_without_length(word, unit)
            _refuse_word(word)
        return word
    numerator, denominator = _factor(word, unit)
    return f"*{numerator}/{denominator}"


def _is_unit(word: str, unit: str) -> bool:
    """Return whether a word is a unit of length, or the unit of the document, which may be any word."""
    return bool(known_unit(word)) or (word == unit and word not in _IN_NUMBERS)


def _factor(word: str, unit: str) -> tuple[int, int]:
    """Return the size of a unit in the document's unit, as a fraction: a point has 127/360 mm."""
    if word == unit:
        return 1, 1
    _refuse_without_length(word, unit)
    # Late, because the first unit is typed long after the start.
    from fractions import Fraction  # noqa: PLC0415

    one, other = (Fraction(MILLIMETRES[known_unit(name)]).limit_denominator(10**6) for name in (word, unit))
    return (one / other).as_integer_ratio()


def _refuse_without_length(word: str, unit: str) -> None:
    """Raise ExpressionError if the document has no unit of length, so that a typed unit has no meaning."""
    if known_unit(unit):
        return
    reason = f"The unit “{unit}” is not a length" if unit else "The document has no unit of length"
    raise ExpressionError(f"{reason}. Type a number without “{word}”.")
