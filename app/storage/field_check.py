"""Check of what the fields of the document's values hold, by what `fields` says of each."""

from __future__ import annotations

from functools import cache

from ..document.fields import Field, Value, fields_of
from ..document.limits import MAX_MAGNITUDE
from ..document.model import Curve, Point
from .format_error import RANGE, FormatError, quoted, shortened


def check_fields(values: Value, place: str = "", before: Value | None = None) -> None:
    """Raise FormatError, with the place, unless a document may hold what a value holds.

    Curves and points are looked at elsewhere, and nothing that is the same object as in `before`.
    """
    for field in _checked_fields(type(values)):
        content = getattr(values, field.name)
        # Most hold what they do from the start: of thousands of curves all styles are looked at.
        if content is field.default or (content is None and field.is_optional):
            continue
        if content is getattr(before, field.name, field):
            continue
        where = f"{place}.{field.name}" if place else field.name
        if not field.is_many:
            _check_one(field, content, where)
            continue
        for index, each in enumerate(content):
            _check_one(field, each, f"{where}[{index}]")
        _require(field, content, where, of_all=True)


def check_number(value: object, place: str) -> None:
    """Raise FormatError, with the place, unless a document may hold a number."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormatError(f"{place} must be a number, not {value!r}")
    # Written so that NaN fails.
    if not -MAX_MAGNITUDE <= value <= MAX_MAGNITUDE:
        raise FormatError(f"{place} {RANGE}, not {_short(value)}")


@cache
def _checked_fields(kind: type[Value]) -> tuple[Field, ...]:
    found = (field for field in fields_of(kind) if field.kind not in (Curve, Point))
    return tuple(
        field for field in found if field.requirements or field.kind in (float, str) or field.holds_values
    )


def _check_one(field: Field, value: object, place: str) -> None:
    if isinstance(value, Value):
        check_fields(value, place)
        return
    if field.kind is float:
        check_number(value, place)
    _require(field, value, place, of_all=False)
    if isinstance(value, str) and not _is_utf8(value):
        raise FormatError(f"{place} holds a character that UTF-8 cannot carry")


def _require(field: Field, value: object, place: str, *, of_all: bool) -> None:
    for each in field.requirements:
        if each.of_all == of_all and not each.is_met(value):
            shown = each.shown(value)
            text = quoted(shown) if isinstance(shown, str) else shortened(repr(shown))
            raise FormatError(f"{place} must {each.words}, not {text}")


def _is_utf8(text: str) -> bool:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return True


def _short(value: object) -> str:
    """Return a number that may be an int of a million digits."""
    return repr(value) if isinstance(value, float) else "a larger one"
