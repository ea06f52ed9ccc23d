"""Where a caret stands between the letters of a text as they are drawn, and before which one a place is."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property, lru_cache
from itertools import chain
from typing import NamedTuple, cast

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPolygonF, QTextLayout, QTextOption, QTransform

from ..document.along_path import Along
from ..document.content import Lettering, TextLine, TextRun
from ..document.wrapping import laid_out
from .contents import placed_runs
from .letters_along import standing_letters
from .run_fonts import EM, font_of

_WIDE = 1e7
"""Width of a line that no text reaches."""


class Piece(NamedTuple):
    """Letters side by side: those of a run in a line, or one that stands along a course.

    Attributes
    ----------
    start
        The place of the first among all letters.
    stops
        Where a caret stands before each of them, and behind the last.
    top, bottom
        What their font takes above and below that, y downwards.
    way
        From there to where they are seen.
    """

    start: int
    stops: tuple[float, ...]
    top: float
    bottom: float
    way: QTransform

    @property
    def end(self) -> int:
        """The place behind its last letter."""
        return self.start + len(self.stops) - 1

    def line(self, place: int) -> QLineF:
        """Return the caret at a place, from its upper end down."""
        x = self.stops[place - self.start]
        return self.way.map(QLineF(x, self.top, x, self.bottom))

    def box(self, start: int, end: int, margin: float = 0.0) -> QPolygonF:
        """Return what letters take, and so much more around them where they are seen."""
        stops = self.stops[max(start - self.start, 0) : end - self.start + 1]
        across = margin / (math.hypot(self.way.m11(), self.way.m12()) or 1.0)
        down = margin / (math.hypot(self.way.m21(), self.way.m22()) or 1.0)
        box = QRectF(min(stops), self.top, max(stops) - min(stops), self.bottom - self.top)
        return self.way.map(QPolygonF(box.adjusted(-across, -down, across, down)))

    def nearest(self, there: QPointF) -> tuple[float, float, int]:
        """Return how far a place lies above or below, how far beside, and before which letter."""
        back, is_flat = self.way.inverted()
        if not is_flat:
            return math.inf, math.inf, self.start
        here = back.map(there)
        above = max(self.top - here.y(), here.y() - self.bottom, 0.0)
        beside = max(min(self.stops) - here.x(), here.x() - max(self.stops), 0.0)
        at = min(range(len(self.stops)), key=lambda index: abs(self.stops[index] - here.x()))
        return above, beside, self.start + at


Row = tuple[Piece, ...]
"""A line as it is seen."""


class CaretPlaces:
    """The places of a text that is typed, counted as Qt counts letters, and those at its ends.

    Attributes
    ----------
    rows
        Its lines as they are seen, from the first to the last; there is one.
    """

    def __init__(self, rows: Sequence[Row], *, is_bent: bool = False) -> None:
        self.rows, self._is_bent = tuple(rows), is_bent

    @cached_property
    def _pieces(self) -> tuple[Piece, ...]:
        return tuple(chain.from_iterable(self.rows))

    def mapped(self, way: QTransform) -> CaretPlaces:
        """Return them where a way leads."""
        rows = [tuple(each._replace(way=each.way * way) for each in row) for row in self.rows]
        return CaretPlaces(rows, is_bent=self._is_bent)

    def row_at(self, place: int) -> int:
        """Return which line a place is in: at the end of one that is wrapped in the next."""
        found = [number for number, row in enumerate(self.rows) if row[0].start <= place]
        return found[-1] if found else 0

    def ends_of(self, number: int) -> tuple[int, int]:
        """Return the first and the last place of a line."""
        row = self.rows[number]
        end = row[-1].end
        is_wrapped = number + 1 < len(self.rows) and self.rows[number + 1][0].start == end
        return row[0].start, max(end - is_wrapped, row[0].start)

    def line(self, place: int) -> QLineF:
        """Return the caret at a place, from its upper end down: as high as the letter before."""
        row = self.rows[self.row_at(place)]
        before = [each for each in row if each.start < place]
        piece = before[-1] if before else row[0]
        return piece.line(min(max(place, piece.start), piece.end))

    def place_at(self, there: QPointF, row: int | None = None) -> int:
        """Return the place nearest to where something is seen, in one of the lines or in any."""
        if row is None and not self._is_bent:
            # Beside a line it is that one which counts, however near the end of another one is.
            row = min(
                range(len(self.rows)), key=lambda n: min(one.nearest(there)[:2] for one in self.rows[n])
            )
        pieces = self._pieces if row is None else self.rows[row]
        place = min((each.nearest(there) for each in pieces), key=lambda far: math.hypot(*far[:2]))[2]
        return place if row is None else min(place, self.ends_of(row)[1])

    def boxes(self, start: int | None = None, end: int | None = None, margin: float = 0.0) -> list[QPolygonF]:
        """Return what letters take from a place up to another one, or all of them."""
        if start is None or end is None:
            return [each.box(each.start, each.end, margin) for each in self._pieces]
        return [
            each.box(max(start, each.start), min(end, each.end), margin)
            for each in self._pieces
            if max(start, each.start) < min(end, each.end)
        ]


def places_of(text: Lettering, way: QTransform) -> CaretPlaces:
    """Return the places of a text whose units a way leads from; its lines may be without letters."""
    if text.along is not None:
        return CaretPlaces(list(_rows_along(text.lines, text.along, way)), is_bent=True)
    lines, ends, seen = text.lines, (True,) * len(text.lines), len(text.lines)
    if text.flow is not None:
        laid = laid_out(text)
        lines, ends, seen = laid.lines, laid.ends, laid.seen
    rows, start = list[Row](), 0
    for at, (line, is_end) in enumerate(zip(lines, ends, strict=True)):
        row = tuple(_pieces(line, start, way))
        rows.append(row if at < max(seen, 1) else tuple(_hidden(row, rows[-1][-1])))
        start = rows[-1][-1].end + is_end
    return CaretPlaces(rows)


def _hidden(row: Row, last: Piece) -> Iterator[Piece]:
    """Yield a line that has no room: a caret in it stands where what is seen ends."""
    for piece in row:
        yield last._replace(start=piece.start, stops=(last.stops[-1],) * len(piece.stops))


def _pieces(line: TextLine, start: int, way: QTransform) -> Iterator[Piece]:
    for run, (x, y) in placed_runs(line):
        top, bottom = _reach(run)
        stops = tuple(x + each for each in _stops(run))
        yield Piece(start, stops, y + top, y + bottom, way)
        start += len(stops) - 1


def _rows_along(lines: Iterable[TextLine], along: Along, way: QTransform) -> Iterator[Row]:
    start = 0
    for line in lines:
        row = list[Piece]()
        at = start
        for run, cluster, own in standing_letters((line,), along, font_of):
            many = _count(cluster.letters)
            metrics = QFontMetricsF(font_of(run))
            stops = tuple(cluster.x + cluster.width * each / max(many, 1) for each in range(many + 1))
            row.append(Piece(at, stops, -metrics.ascent(), metrics.descent(), own * way))
            at += many
        if not row:
            top, bottom = _reach(line.runs[0])
            row.append(Piece(start, (0.0,), top, bottom, way))
        yield tuple(row)
        start = at + 1


def _reach(run: TextRun) -> tuple[float, float]:
    """Return how far the font of a run reaches above and below its baseline, y downwards."""
    metrics, scale = QFontMetricsF(font_of(run)), run.size / EM
    return -metrics.ascent() * scale, metrics.descent() * scale


def _count(words: str) -> int:
    """Return how many letters there are as Qt counts, in words of 16 bits."""
    return len(words.encode("utf-16-le", "surrogatepass")) // 2


@lru_cache(maxsize=2000)
def _stops(run: TextRun) -> tuple[float, ...]:
    """Return where a caret stands before each letter of a run, and behind the last one."""
    layout, option = QTextLayout(run.words, font_of(run)), QTextOption()
    option.setUseDesignMetrics(True)
    option.setWrapMode(QTextOption.WrapMode.NoWrap)
    option.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignAbsolute)
    layout.setTextOption(option)
    layout.beginLayout()
    line = layout.createLine()
    if not line.isValid():
        return (0.0,)
    line.setLineWidth(_WIDE)
    layout.endLayout()
    scale = run.size / EM
    return tuple(_x(line.cursorToX(place)) * scale for place in range(_count(run.words) + 1))


def _x(found: object) -> float:
    # PySide6 returns the place with it, which may be another one.
    x, _ = cast("tuple[float, int]", found)
    return x
