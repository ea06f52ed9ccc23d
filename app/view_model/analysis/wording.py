"""Numbers in sentences: short, with two digits."""

from __future__ import annotations

import math

from ...document.words import with_minus

_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_THIN = "\N{NARROW NO-BREAK SPACE}"


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
