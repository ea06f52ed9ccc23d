"""Lines of a text that Inkscape edits as lines: it lays them out by their height, and not by their places."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Final

from ...document.content import Lettering, TextLine
from ...document.flow import USUAL_LINE
from .numbers import number

ROLE: Final = "sodipodi:role"
"""The attribute that tells what a span is."""

_NEAR = 1e-6
"""Of a size by which a line may be elsewhere."""
_MOST_EMPTY = 100


def line_height(text: Lettering) -> float | None:
    """Return the way from line to line in sizes, where that says all; None where lines lie otherwise."""
    if text.flow is not None or text.along is not None:
        return None
    first, runs = text.lines[0], [run for line in text.lines for run in line.runs]
    size = first.runs[0].size
    # What is larger or raised would have a line of its own height.
    like = (size, runs[0].font, 0.0, 0.0)
    is_even = all((run.size, run.font, run.down, run.raised) == like for run in runs)
    if not is_even or any((line.x, line.anchor) != (first.x, first.anchor) for line in text.lines):
        return None
    steps = [after.y - before.y for before, after in pairwise(text.lines)]
    step = min(steps, default=USUAL_LINE * size)
    if step <= 0 or any(abs(_remainder(each, step)) > _NEAR * size for each in steps):
        return None
    return step / size if max(steps, default=0.0) <= _MOST_EMPTY * step else None


def _remainder(way: float, step: float) -> float:
    return way - round(way / step) * step


def lines_with_empty(text: Lettering, height: float) -> Iterator[TextLine]:
    """Yield the lines of a text of some height, and those without letters between them."""
    step = height * text.lines[0].runs[0].size
    for before, after in pairwise((None, *text.lines)):
        assert after is not None
        for missing in range(1, round((after.y - before.y) / step) if before is not None else 1):
            assert before is not None
            yield TextLine(before.x, before.y + missing * step, (), before.anchor)
        yield after


def place_and_height(text: Lettering, height: float) -> tuple[dict[str, str], dict[str, str]]:
    """Return where such lines begin, and the declaration of their height."""
    first = text.lines[0]
    return {"x": number(first.x), "y": number(first.y)}, {"line-height": number(height)}
