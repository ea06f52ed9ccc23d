"""SVG path data in, as cubic pieces.

svgelements reads the data: its reader stops at the first error, and knows where. The segments that it would
make are not used, as they mirror the control point of a C for a T, against section 9.3.7. The segments before
the one with the error are drawn, as section 9.5.4 says.

Reference: Scalable Vector Graphics 2, section 9.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from svgelements import SVGLexicalParser

from curvecore.arrays import FloatArray

from ..arcs import arc_between
from ..cubics_in import has_length, lines, put_end, rounding_of, without_roundings
from ..errors import ExchangeError

_GAP = r"[ \t\r\n\f]*"
_PASSED_OVER = re.compile(rf"(?:^|[A-Za-z,]){_GAP}(,)|[VAa]{_GAP}([A-Za-z]|\Z)")
"""Flaws that svgelements passes over: a comma that separates no numbers, and V and A without any."""
_BARE_POINT = re.compile(r"(?<![\d.eE])(\d+)\.(?![\deE.])")
"""The point of ``1.``, which SVG 1.1 allowed and programs still write."""
_NO_MOVE = re.compile(rf"{_GAP}[ZLHVCSQTAzlhvcsqta]")
_NO_COORDINATE = re.compile(r"[^-+.,\deE \t\r\n\f]")
_SEPARATORS = " \t\r\n\f,"
_LONGEST = 50_000_000
_SHOWN = 12
"""Characters that are shown of data with an error."""
_ROUNDING = 1e-6
"""Of the extent of a subpath: as short a last line comes of roundings, and is none to Inkscape either."""


@dataclass(eq=False)
class Subpath:
    """Part of a path from one M to the next.

    Attributes
    ----------
    pieces
        Cubic pieces (k, 4, 2), or groups of them.
    closed
        Whether it ends in Z, or exactly where it begins.
    deviation
        How far the pieces of arcs are from them.
    """

    start: FloatArray
    pieces: list[FloatArray] = field(default_factory=list)
    closed: bool = False
    deviation: float = 0.0

    @property
    def end(self) -> FloatArray:
        """The end of the last piece."""
        return np.asarray(self.pieces[-1][-1, 3]) if self.pieces else self.start

    @property
    def has_length(self) -> bool:
        """Whether it is more than a point."""
        return bool((self.controls != self.start).any())

    @property
    def is_line(self) -> bool:
        """Whether it is a line, be it one of no length: more than an M alone."""
        return self.closed or bool(self.pieces)

    @property
    def cleaned(self) -> FloatArray:
        """All pieces that are no roundings, (k, 4, 2); one of no length where there are none."""
        kept = without_roundings(self.controls, closed=self.closed)
        return kept if len(kept) else np.tile(self.start, (1, 4, 1))

    @property
    def controls(self) -> FloatArray:
        """All pieces, (k, 4, 2)."""
        return np.concatenate(self.pieces) if self.pieces else np.empty((0, 4, 2))


class ReadPath(NamedTuple):
    """Subpaths of an element, and the error that ends them early.

    Attributes
    ----------
    subpaths
        Those before the segment with the error.
    error
        Where it is: "at character 7, “L35”", from 1; empty where there is none.
    """

    subpaths: list[Subpath]
    error: str = ""


def read_path_data(data: str, tolerance: float | None = None) -> ReadPath:
    """Return the subpaths of path data, up to the first error.

    Lines and quadratics are raised to cubics, arcs become cubics within the tolerance.

    Raises
    ------
    ExchangeError
        If the data are longer than any drawing needs.
    """
    if len(data) > _LONGEST:
        raise ExchangeError("its data are too long.")
    pen = _Pen(tolerance)
    place = 0 if _NO_MOVE.match(data) else _drawn(data, pen)
    pen.end()
    return ReadPath(pen.subpaths, _error_at(place, data))


def read_points(data: str, *, closed: bool) -> ReadPath:
    """Return the polyline through a list of points, up to the first error: numbers in pairs, no letter."""
    stop = _NO_COORDINATE.search(data)
    listed = data[: stop.start()] if stop else data
    pen = _Pen(None)
    place = _drawn(f"M{listed}", pen) if listed.strip() else None
    if place is not None:
        place -= 1
    elif stop:
        place = stop.start()
    if closed:
        pen.closed()
    pen.end()
    return ReadPath(pen.subpaths, _error_at(place, data))


def _drawn(data: str, pen: _Pen) -> int | None:
    """Draw path data up to the first error, and return its place; None where there is none."""
    # Of the same length, for the places of errors.
    data = _BARE_POINT.sub(r"\1 ", data)
    flaw, reader = _PASSED_OVER.search(data), _Reader()
    try:
        reader.parse(pen, data[: flaw.start(flaw.lastindex or 0)] if flaw else data)
    except ExchangeError:
        return int(reader.pos) - len(data[reader.end_before : reader.pos].lstrip(_SEPARATORS))
    except ValueError:
        # A Z is complete before a number that follows it is an error.
        if reader.command in ("Z", "z"):
            pen.closed()
        return int(reader.pos)
    return None if flaw is None and reader.pos == len(data) else int(reader.pos)


def _error_at(place: int | None, data: str) -> str:
    if place is None:
        return ""
    return f"at character {place + 1}, “{data[place : place + _SHOWN]}”" if data[place:] else "at the end"


class _Reader(SVGLexicalParser):  # type: ignore[misc]  # that package has no types
    """Reads commands; a number or flag that is missing is an error, not None or the end of the path.

    Attributes
    ----------
    command
        The letter of the last command.
    end_before
        The place where the number before the last one ends.
    """

    command: str | None = None
    end_before = 0

    def _command(self) -> str | None:
        self.command = super()._command()
        return self.command

    def _number(self) -> float:
        self.end_before = self.pos
        number = super()._number()
        if number is None:
            raise ValueError
        if not math.isfinite(number):
            raise ExchangeError("A number is beyond all numbers.")
        return float(number)

    def _flag(self) -> bool:
        flag = super()._flag()
        if flag is None:
            raise ValueError
        return bool(flag)


class _Point(NamedTuple):
    x: float
    y: float


_Pair = tuple[float, float]


class _Pen:
    """Pen that draws the commands svgelements reads, whose names these are; points are absolute.

    Attributes
    ----------
    current_point
        Where the pen is.
    subpaths
        What was drawn; complete after `end`.
    """

    def __init__(self, tolerance: float | None) -> None:
        self._tolerance = tolerance
        self.subpaths: list[Subpath] = []
        self.current_point = self._start = _Point(0.0, 0.0)
        # The degree of the curve before, and its last control point.
        self._before: tuple[int, _Pair] = (1, self._start)
        self._is_open = False
        # Where a polyline goes from the end of the last piece: arrays of two points each would take most of
        # the time that a path of very many lines takes.
        self._corners: list[_Pair] = []

    def start(self) -> None:
        pass

    def move(self, point: _Pair, **_: bool) -> None:
        self.end()
        self.subpaths.append(Subpath(np.array(point)))
        self._start = self._go(point)
        self._is_open = True

    def line(self, end: _Pair, **_: bool) -> None:
        self._begin()
        self._corners.append(end)
        self._go(end)

    def horizontal(self, x: float, *, relative: bool) -> None:
        at = self.current_point
        self.line((at.x + x if relative else x, at.y))

    def vertical(self, y: float, *, relative: bool) -> None:
        at = self.current_point
        self.line((at.x, at.y + y if relative else y))

    def cubic(self, first: _Pair, second: _Pair, end: _Pair, **_: bool) -> None:
        self._begin()
        current = self._current
        current.pieces.append(np.array([[current.end, first, second, end]]))
        self._go(end)
        self._before = (3, second)

    def smooth_cubic(self, second: _Pair, end: _Pair, **_: bool) -> None:
        self.cubic(self._mirrored(3), second, end)

    def quad(self, control: _Pair, end: _Pair, **_: bool) -> None:
        self._begin()
        current = self._current
        a, b, c = current.end, np.array(control), np.array(end)
        current.pieces.append(np.array([[a, a + 2 / 3 * (b - a), c + 2 / 3 * (b - c), c]]))
        self._go(end)
        self._before = (2, control)

    def smooth_quad(self, end: _Pair, **_: bool) -> None:
        self.quad(self._mirrored(2), end)

    def arc(
        self, rx: float, ry: float, rotation: float, large: bool, sweep: bool, end: _Pair, **_: bool
    ) -> None:
        self._begin()
        current = self._current
        piece = arc_between(current.end, np.array(end), (rx, ry), rotation, large, sweep, self._tolerance)
        if piece is None:
            self._corners.append(end)
        else:
            current.pieces.append(piece.pieces)
            current.deviation = max(current.deviation, piece.deviation)
        self._go(end)

    def closed(self, **_: bool) -> None:
        if self._is_open:
            if self.current_point != self._start:
                self._go_home()
            self._current.closed = True
            self._go(self._start)
            self._is_open = False

    def end(self) -> None:
        if self._is_open:
            # A curve that ends exactly where it begins is meant to be closed; Z is only about line ends.
            current = self._current
            controls, gap = current.controls, np.abs(current.end - current.start).max()
            current.closed = len(controls) > 1 and bool(gap <= rounding_of(controls))
        self._is_open = False

    def _go_home(self) -> None:
        """Go to where the subpath begins; from nearby, for steps of few digits add up, without a line."""
        current = self._current
        controls, gap = current.controls, np.abs(current.end - current.start).max()
        if gap > _ROUNDING * float(np.ptp(controls.reshape(-1, 2), axis=0).max()):
            self._corners.append(self._start)
            return
        last = int(np.flatnonzero(has_length(controls))[-1])
        put_end(controls[last], current.start)
        current.pieces = [controls[: last + 1]]

    @property
    def _current(self) -> Subpath:
        """The subpath, with all its pieces so far."""
        current = self.subpaths[-1]
        if self._corners:
            current.pieces.append(lines(np.array([tuple(current.end), *self._corners])))
            self._corners = []
        return current

    def _begin(self) -> None:
        """Begin a subpath anew after a Z."""
        if not self._is_open:
            self.move(self._start)

    def _go(self, point: _Pair) -> _Point:
        self.current_point = at = _Point(*point)
        self._before = (1, at)
        return at

    def _mirrored(self, degree: int) -> _Pair:
        """Return the mirror image of the control point before, of a curve of the same degree, or the pen."""
        at = self.current_point
        before, control = self._before
        return (2 * at.x - control[0], 2 * at.y - control[1]) if before == degree else at
