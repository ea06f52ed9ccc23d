"""Letters of a text along a course, each turned as a whole: between where it begins and where it ends.

Those whose middle lies before or behind the course are not shown, as Inkscape has it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache

import numpy as np
from PySide6.QtGui import QFont, QTransform

from curvecore.arrays import FloatArray

from ..document.along_path import Along
from ..document.content import TextLine, TextRun
from ..document.form import Piece
from ..document.model import Vector
from .glyphs import Cluster, clusters_of

_SAMPLES = 64
"""Of each piece, between which its length grows evenly."""


class Course:
    """Pieces, by the length along them.

    Attributes
    ----------
    length
        Of all of them.
    """

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self._pieces = np.array(pieces)
        shares = np.linspace(0.0, 1.0, _SAMPLES + 1)
        rows = [self._at(np.full(_SAMPLES + 1, at), shares) for at in range(len(pieces))]
        steps = [np.hypot(*np.diff(row, axis=0).T) for row in rows]
        # A gap between two pieces has no length.
        self._lengths = np.concatenate([[0.0], np.cumsum(np.concatenate(steps))])
        self.length = float(self._lengths[-1])

    def place(self, length: float) -> Vector:
        """Return the place so far along."""
        x, y = self._at(*self._found(length))[0].tolist()
        return (x, y)

    def heading(self, length: float) -> Vector:
        """Return the way that it runs there, one unit long."""
        room = self.length * 1e-4
        (x, y), (to_x, to_y) = (self.place(min(max(length + by, 0.0), self.length)) for by in (-room, room))
        return _unit(to_x - x, to_y - y)

    def _found(self, length: float) -> tuple[FloatArray, FloatArray]:
        along = np.interp(length, self._lengths, np.arange(len(self._lengths)) / _SAMPLES)
        piece = min(int(along), len(self._pieces) - 1)
        return np.array([piece]), np.array([along - piece])

    def _at(self, pieces: FloatArray, shares: FloatArray) -> FloatArray:
        a, b, c, d = np.moveaxis(self._pieces[pieces.astype(int)], 1, 0)
        t = shares[:, None]
        s = 1.0 - t
        found: FloatArray = s**3 * a + 3 * s * s * t * b + 3 * s * t * t * c + t**3 * d
        return found


def _unit(x: float, y: float) -> Vector:
    size = float(np.hypot(x, y))
    return (x / size, y / size) if size else (1.0, 0.0)


@lru_cache(maxsize=64)
def course_of(pieces: tuple[Piece, ...]) -> Course:
    """Return pieces, by the length along them."""
    return Course(pieces)


def length_of(along: Along) -> float:
    """Return how long the course of a text is, in its units."""
    return course_of(along.course).length


def start_of(along: Along) -> float:
    """Return how far along its course a text is anchored."""
    return along.start * length_of(along) if along.is_share else along.start


def placed_letters(
    lines: Sequence[TextLine], along: Along, font_of: Callable[[TextRun], QFont]
) -> Iterator[tuple[TextRun, Cluster, QTransform]]:
    """Yield the letters of a text along a course, and the way from the pixels of their font to there."""
    for run, cluster, way, is_shown in _stood(lines, along, font_of):
        if is_shown:
            yield run, cluster, way


def standing_letters(
    lines: Sequence[TextLine], along: Along, font_of: Callable[[TextRun], QFont]
) -> Iterator[tuple[TextRun, Cluster, QTransform]]:
    """Yield them with those before and behind the course, which have no width at its ends."""
    for run, cluster, way, is_shown in _stood(lines, along, font_of):
        yield run, cluster if is_shown else cluster._replace(x=0.0, width=0.0), way


def hidden_letters(lines: Sequence[TextLine], along: Along, font_of: Callable[[TextRun], QFont]) -> int:
    """Return how many letters the course has no room for."""
    stood = _stood(lines, along, font_of)
    return sum(bool(cluster.letters.strip()) for _, cluster, _, is_shown in stood if not is_shown)


def _stood(
    lines: Sequence[TextLine], along: Along, font_of: Callable[[TextRun], QFont]
) -> Iterator[tuple[TextRun, Cluster, QTransform, bool]]:
    """Yield letters with where they stand, and whether they are shown: others stand at the ends."""
    course = course_of(along.course)
    if not course.length:
        return
    for line in lines:
        rows, width = _rows(line, font_of)
        first = start_of(along) + line.x - width * line.anchor.share
        for run, cluster, right, down in rows:
            scale = run.size / font_of(run).pixelSize()
            start, width_here = first + right + cluster.x * scale, cluster.width * scale
            is_shown = 0.0 <= start + width_here / 2 <= course.length
            middle = cluster.x + cluster.width / 2
            if not is_shown:
                start, width_here, middle = min(max(start, 0.0), course.length), 0.0, 0.0
            way = _way(course, start, width_here, down)
            yield run, cluster, QTransform(scale, 0, 0, scale, -middle * scale, 0) * way, is_shown


def _rows(
    line: TextLine, font_of: Callable[[TextRun], QFont]
) -> tuple[list[tuple[TextRun, Cluster, float, float]], float]:
    """Return the letters of a line with where their run begins, and how long the line is."""
    found, x, y = list[tuple[TextRun, Cluster, float, float]](), 0.0, line.y
    for run in line.runs:
        x, y, font = x + run.right, y + run.down, font_of(run)
        clusters = clusters_of(run.words, font)
        found += [(run, each, x, y - run.raised) for each in clusters]
        if clusters:
            last = clusters[-1]
            x += (last.x + last.width + font.letterSpacing()) * run.size / font.pixelSize()
    x -= line.runs[-1].spacing if line.runs else 0.0
    return found, x


def _way(course: Course, start: float, width: float, down: float) -> QTransform:
    """Return the way to where the middle of a letter stands."""
    middle, end = start + width / 2, start + width
    x, y = course.place(middle)
    across = course.heading(middle)
    if width > 0 and start >= 0.0 and end <= course.length:
        (from_x, from_y), (to_x, to_y) = course.place(start), course.place(end)
        if (from_x, from_y) != (to_x, to_y):
            across = _unit(to_x - from_x, to_y - from_y)
    right, low = across
    return QTransform(right, low, -low, right, x - down * low, y + down * right)
