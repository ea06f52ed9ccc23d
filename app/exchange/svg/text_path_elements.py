"""Texts along a path as elements of SVG."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from msgspec.structs import replace

from ...document.along_path import UPSIDE_DOWN, Along, Ground, after, inverse_of
from ...document.content import Lettering, TextLine, TextRun
from ...document.contents import Plane
from .numbers import number

_NEAR = 1e-9


def along_shown(text: Lettering, plane: Plane, here: Ground = UPSIDE_DOWN) -> tuple[Lettering, Plane] | None:
    """Return a text, and where it lies, whose units are those that the path it lies along is written in.

    `here` leads from these to the plane. None where that would turn or stretch its letters.
    """
    along = text.along
    assert along is not None
    x, y, a, b, c, d = by = after(inverse_of(along.ground), here)
    size = math.hypot(a, b)
    if max(abs(a - d), abs(b + c), abs(b)) > _NEAR * size or a <= 0:
        return None
    if max(abs(a - 1.0), abs(x), abs(y)) <= _NEAR:
        return text, plane
    whole = after((plane.x, plane.y, *plane.across, *plane.down), by)
    lines = tuple(resized(line, 1.0 / size) for line in text.lines)
    start = along.start if along.is_share else along.start / size
    own = replace(text, lines=lines, along=replace(along, start=start))
    return own, Plane(whole[0], whole[1], (whole[2], whole[3]), (whole[4], whole[5]))


def resized(line: TextLine, by: float) -> TextLine:
    """Return a line so many times as large."""
    runs = tuple(_run(each, by) for each in line.runs)
    return replace(line, x=line.x * by, y=line.y * by, runs=runs)


def _run(run: TextRun, by: float) -> TextRun:
    paint = run.paint and replace(run.paint, width=run.paint.width * by)
    return replace(run.resized(by), paint=paint)


def course_data(along: Along) -> str:
    """Return a course in units of its text as path data."""
    parts, before = list[str](), None
    for a, b, c, d in along.pieces:
        if a != before:
            parts.append(f"M {_pair(a)}")
        parts.append(f"C {_pair(b)} {_pair(c)} {_pair(d)}")
        before = d
    return " ".join(parts)


def on_path(text: Lettering, href: str, run: Callable[[TextRun], str]) -> str:
    """Return the words of a text along the path of an id."""
    along = text.along
    assert along is not None
    start = f"{number(100 * along.start)}%" if along.is_share else number(along.start)
    said = f' startOffset="{start}"' if along.start else ""
    said += ' side="right"' if along.is_flipped else ""
    return f'<textPath xlink:href="#{href}"{said}>{_words(text.lines, run)}</textPath>'


def _words(lines: Sequence[TextLine], run: Callable[[TextRun], str]) -> str:
    """Return the words; what moves the line moves its first letters."""
    return "".join(
        run(replace(each, right=each.right + line.x, down=each.down + line.y) if not at else each)
        for line in lines
        for at, each in enumerate(line.runs)
    )


def _pair(place: tuple[float, float]) -> str:
    return " ".join(map(number, place))
