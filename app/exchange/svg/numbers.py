"""Numbers as text, with all digits but those that rounding left."""

from __future__ import annotations

import sys

_DIGITS = 12
_NOISE = 8 * sys.float_info.epsilon
_SHORT = 16
"""Characters of a number that has no noise."""


def number(value: float) -> str:
    """Return the shortest text that reads back as the same float; adding zero turns -0.0 into 0.0.

    One that is a decimal of up to 12 digits but for rounding is that: 32.3, and not 32.29999999999999.
    """
    text = repr(value + 0.0).removesuffix(".0")
    if len(text) < _SHORT:
        return text
    plain = float(f"{value:.{_DIGITS}g}")
    return repr(plain).removesuffix(".0") if abs(plain - value) <= _NOISE * abs(value) else text
