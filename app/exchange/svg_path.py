"""SVG path data in: checked to the letter, then read by fontTools into cubic pieces."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np
from fontTools.svgLib.path.parser import parse_path

from app.exchange.arcs import arc_between
from app.exchange.cubics_in import lines
from app.exchange.drawing import Floats
from app.exchange.errors import ExchangeError

Pair = tuple[float, float]

_NUMBERS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_GAP = re.compile(r"[ \t\r\n\f]*,?[ \t\r\n\f]*")
_FLAGS = (3, 4)  # of the seven numbers of an arc
_LONGEST = 50_000_000


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

    start: Floats
    pieces: list[Floats] = field(default_factory=list)
    closed: bool = False
    deviation: float = 0.0

    @property
    def end(self) -> Floats:
        """Where the pen is."""
        return np.asarray(self.pieces[-1][-1, 3]) if self.pieces else self.start

    @property
    def controls(self) -> Floats:
        """All pieces, (k, 4, 2)."""
        return np.concatenate(self.pieces) if self.pieces else np.empty((0, 4, 2))


def read_path_data(data: str, tolerance: float | None = None) -> list[Subpath]:
    """Return the subpaths of path data.

    Lines and quadratics are raised to cubics, arcs become cubics within the tolerance.

    Raises
    ------
    ExchangeError
        With the character, from 1, at which the data are not path data.
    """
    pen = _Pen(tolerance)
    try:
        parse_path(_checked(data), pen)
        pen.end_line()
    except ValueError as problem:
        if isinstance(problem, ExchangeError):
            raise
        raise ExchangeError("its data are no path.") from problem
    return pen.subpaths


def _checked(data: str) -> str:
    """Return path data with every command and number apart, or raise ExchangeError.

    fontTools skips what it does not know, such as NaN, and stops reading numbers at "1.".
    """
    if len(data) > _LONGEST:
        raise ExchangeError("its data are too long.")
    words: list[str] = []
    place = _skip(data, 0, comma=False)
    command = ""
    while place < len(data):
        letter = data[place]
        if letter.upper() in _NUMBERS:
            if not command and letter.upper() != "M":
                raise ExchangeError("its data must begin with M.")
            command = letter
            words.append(letter)
            place = _skip(data, place + 1, comma=False)
            if letter.upper() == "Z":
                continue
        elif not command or command.upper() == "Z":
            raise _broken(data, place)
        for index in range(_NUMBERS[command.upper()]):
            number, place = _number(data, place, command.upper() == "A" and index in _FLAGS)
            words.append(number)
            place = _skip(data, place, comma=True)
    return " ".join(words)


def _skip(data: str, place: int, *, comma: bool) -> int:
    match = _GAP.match(data, place)
    end = match.end() if match else place
    if not comma and "," in data[place:end]:
        raise _broken(data, place + data[place:end].index(","))
    return end


def _number(data: str, place: int, flag: bool) -> tuple[str, int]:
    if flag:
        if data[place : place + 1] not in ("0", "1"):
            raise _broken(data, place)
        return data[place], place + 1
    match = _NUMBER.match(data, place)
    if match is None:
        raise _broken(data, place)
    value = float(match.group())
    if not math.isfinite(value):
        raise ExchangeError(f"a number at character {place + 1} of its data is beyond all numbers.")
    return repr(value), match.end()


def _broken(data: str, place: int) -> ExchangeError:
    if place >= len(data):
        return ExchangeError("its data end in the middle of a command.")
    return ExchangeError(f"its data are broken at character {place + 1}: “{data[place : place + 12]}”.")


class _Pen:
    """Takes what fontTools reads. The names are fontTools'."""

    def __init__(self, tolerance: float | None) -> None:
        self._tolerance = tolerance
        self.subpaths: list[Subpath] = []
        # Where a polyline goes from the end of the last piece: arrays of two points each would take most of
        # the time that a path of very many lines takes.
        self._corners: list[Pair] = []

    @property
    def _current(self) -> Subpath:
        """The subpath, with all its pieces so far."""
        self.end_line()
        return self.subpaths[-1]

    def end_line(self) -> None:
        """Add the polyline that was begun to the subpath."""
        if self._corners:
            current = self.subpaths[-1]
            current.pieces.append(lines(np.array([current.end, *self._corners])))
            self._corners = []

    def moveTo(self, point: Pair) -> None:  # noqa: N802
        self.end_line()
        self.subpaths.append(Subpath(np.array(point)))

    def lineTo(self, point: Pair) -> None:  # noqa: N802
        self._corners.append(point)

    def curveTo(self, *points: Pair) -> None:  # noqa: N802
        current = self._current
        current.pieces.append(np.array([[current.end, *points]]))

    def qCurveTo(self, control: Pair, end: Pair) -> None:  # noqa: N802
        current = self._current
        a, b, c = current.end, np.array(control), np.array(end)
        current.pieces.append(np.array([[a, a + 2 / 3 * (b - a), c + 2 / 3 * (b - c), c]]))

    def arcTo(self, rx: float, ry: float, rotation: float, large: bool, sweep: bool, end: Pair) -> None:  # noqa: N802
        current = self._current
        piece = arc_between(current.end, np.array(end), (rx, ry), rotation, large, sweep, self._tolerance)
        if piece is None:
            self.lineTo(end)
            return
        current.pieces.append(piece.pieces)
        current.deviation = max(current.deviation, piece.deviation)

    def closePath(self) -> None:  # noqa: N802
        self._current.closed = True

    def endPath(self) -> None:  # noqa: N802
        # A curve that ends exactly where it begins is meant to be closed; Z is only about line ends.
        current = self._current
        pieces = sum(map(len, current.pieces))
        current.closed = pieces > 1 and bool((current.end == current.start).all())
