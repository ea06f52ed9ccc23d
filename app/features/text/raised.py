"""Letters above and below the line, small: as large and as far as Inkscape has them."""

from __future__ import annotations

import math
from typing import Final

from msgspec.structs import replace

from ...document.content import TextRun

SMALL: Final = 0.65
"""Of the size around them."""

ABOVE, BELOW = 0.4, -0.2
"""By which part of the size around them they lie higher."""


def raised(run: TextRun, share: float) -> TextRun:
    """Return a run above (`ABOVE`) or below the line, or on it (0)."""
    size = _size_on_line(run)
    small = SMALL if share else 1.0
    return replace(run.resized(small * size / run.size), raised=share * size)


def _size_on_line(run: TextRun) -> float:
    """Return how large the letters of a run are on the line: only ours are known to be smaller."""
    size = run.size / SMALL
    is_ours = any(math.isclose(run.raised, share * size, rel_tol=1e-6) for share in (ABOVE, BELOW))
    return size if is_ours else run.size
