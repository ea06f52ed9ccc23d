"""Check of a number in a document."""

from __future__ import annotations

from ..document.model import MAX_MAGNITUDE
from .format_error import RANGE, FormatError


def check_number(value: float, place: str) -> None:
    """Raise FormatError, with the place, unless a document may hold a number."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormatError(f"{place} must be a number, not {value!r}")
    # Written so that NaN fails.
    if not -MAX_MAGNITUDE <= value <= MAX_MAGNITUDE:
        raise FormatError(f"{place} {RANGE}, not {_short(value)}")


def _short(value: float) -> str:
    """Return a number that may be an int of a million digits."""
    return repr(value) if isinstance(value, float) else "a larger one"
