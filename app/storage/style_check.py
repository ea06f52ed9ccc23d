"""Requirements of the style of a curve that go beyond types."""

from __future__ import annotations

import re

from ..document.style import LARGEST_DASHES, NO_PAINT, PLAIN_STYLE, Style
from .format_error import FormatError, quoted
from .number_check import check_number

_OPACITIES = ("stroke_opacity", "fill_opacity", "opacity")


def validate_style(style: Style, place: str) -> None:
    """Raise FormatError, with the place, unless a document may hold a style.

    A paint is empty, "none" or "#rrggbb". The width and the dashes are not negative, and not all dashes are
    zero. The limit of miters is 1 at least, opacities lie between 0 and 1.
    """
    if style is PLAIN_STYLE:
        return
    for key in ("stroke", "fill"):
        paint = getattr(style, key)
        if paint and paint != NO_PAINT and not re.fullmatch("#[0-9a-f]{6}", paint):
            raise FormatError(
                f'{place}.{key} must be written as "#rrggbb" in lower case, or "none", not {quoted(paint)}'
            )
    for key in _OPACITIES:
        check_number(getattr(style, key), f"{place}.{key}")
        if not 0 <= getattr(style, key) <= 1:
            raise FormatError(f"{place}.{key} must lie between 0 and 1, not {getattr(style, key)!r}")
    check_number(style.miter_limit, f"{place}.miter_limit")
    if style.miter_limit < 1:
        raise FormatError(f"{place}.miter_limit must be 1 or greater, not {style.miter_limit!r}")
    check_number(style.dash_offset, f"{place}.dash_offset")
    _validate_lengths(style, place)


def _validate_lengths(style: Style, place: str) -> None:
    if len(style.dash) > LARGEST_DASHES:
        raise FormatError(f"{place}.dash must hold at most {LARGEST_DASHES} numbers, not {len(style.dash)}")
    named = [(f"{place}.dash[{index}]", length) for index, length in enumerate(style.dash)]
    if style.width is not None:
        named.append((f"{place}.width", style.width))
    for where, value in named:
        check_number(value, where)
        if value < 0:
            raise FormatError(f"{where} must be 0 or greater, not {value!r}")
    if style.dash and not any(style.dash):
        raise FormatError(f"{place}.dash must hold a number greater than 0")
