"""Numbers and text as SVG holds them: numbers with all digits but those that rounding left."""

from __future__ import annotations

import re
import sys

_DIGITS = 12
_NOISE = 8 * sys.float_info.epsilon
_SHORT = 16
"""Characters of a number that has no noise."""

# XML 1.0 has no way at all to write these.
_NOT_IN_XML = "[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"


def number(value: float) -> str:
    """Return the shortest text that reads back as the same float; adding zero turns -0.0 into 0.0.

    One that is a decimal of up to 12 digits but for rounding is that: 32.3, and not 32.29999999999999.
    """
    text = repr(value + 0.0).removesuffix(".0")
    if len(text) < _SHORT:
        return text
    plain = float(f"{value:.{_DIGITS}g}")
    return repr(plain).removesuffix(".0") if abs(plain - value) <= _NOISE * abs(value) else text


def quoted(text: str) -> str:
    """Return text as an attribute in quotation marks may hold it."""
    return escaped(" ".join(text.splitlines())).replace('"', "&quot;")


def escaped(text: str) -> str:
    """Return text as XML may hold it."""
    # Compiled here, and kept by `re`: that takes longer than importing this module.
    text = re.sub(_NOT_IN_XML, "\ufffd", text)
    # What xml.sax.saxutils does, without the network modules that it imports.
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
