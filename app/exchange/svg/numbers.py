"""Numbers as text, with all digits."""

from __future__ import annotations


def number(value: float) -> str:
    """Return the shortest text that reads back as the same float; adding zero turns -0.0 into 0.0."""
    return repr(value + 0.0).removesuffix(".0")
