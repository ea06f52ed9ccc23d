"""SVG path data in, as cubic pieces.

Reference: Scalable Vector Graphics 2, section 9.3, with the grammar of 9.3.9 and no recovery from errors.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from app.exchange.arcs import arc_between
from app.exchange.cubics_in import lines
from app.exchange.errors import ExchangeError
from curvecore.arrays import FloatArray

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

    start: FloatArray
    pieces: list[FloatArray] = field(default_factory=list)
    closed: bool = False
    deviation: float = 0.0

    @property
    def end(self) -> FloatArray:
        """The end of the last piece."""
        return np.asarray(self.pieces[-1][-1, 3]) if self.pieces else self.start

    @property
    def controls(self) -> FloatArray:
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
    for letter, numbers in _commands(data):
        pen.draw(letter, numbers)
    pen.end()
    return pen.subpaths


def _commands(data: str) -> Iterator[tuple[str, list[float]]]:
    """Yield every command with the numbers that it takes once, also where its letter is left out."""
    if len(data) > _LONGEST:
        raise ExchangeError("its data are too long.")
    place = _skip(data, 0, comma=False)
    command = ""
    while place < len(data):
        letter = data[place]
        if letter.upper() in _NUMBERS:
            if not command and letter.upper() != "M":
                raise ExchangeError("its data must begin with M.")
            command = letter
            place = _skip(data, place + 1, comma=False)
        elif not command or command in "Zz":
            raise _broken(data, place)
        numbers = []
        for index in range(_NUMBERS[command.upper()]):
            number, place = _number(data, place, command in "Aa" and index in _FLAGS)
            numbers.append(number)
            place = _skip(data, place, comma=True)
        yield command, numbers
        # Further points of a move are those of lines.
        command = {"M": "L", "m": "l"}.get(command, command)


def _skip(data: str, place: int, *, comma: bool) -> int:
    match = _GAP.match(data, place)
    end = match.end() if match else place
    if not comma and "," in data[place:end]:
        raise _broken(data, place + data[place:end].index(","))
    return end


def _number(data: str, place: int, flag: bool) -> tuple[float, int]:
    if flag:
        if data[place : place + 1] not in ("0", "1"):
            raise _broken(data, place)
        return float(data[place]), place + 1
    match = _NUMBER.match(data, place)
    if match is None:
        raise _broken(data, place)
    value = float(match.group())
    if not math.isfinite(value):
        raise ExchangeError(f"a number at character {place + 1} of its data is beyond all numbers.")
    return value, match.end()


def _broken(data: str, place: int) -> ExchangeError:
    if place >= len(data):
        return ExchangeError("its data end in the middle of a command.")
    return ExchangeError(f"its data are broken at character {place + 1}: “{data[place : place + 12]}”.")


class _Pen:
    """Draws commands; a point is a complex number.

    Attributes
    ----------
    subpaths
        What was drawn; complete after `end`.
    """

    def __init__(self, tolerance: float | None) -> None:
        self._tolerance = tolerance
        self.subpaths: list[Subpath] = []
        self._start = self._at = self._control = 0j
        self._is_open, self._before = False, ""
        # Where a polyline goes from the end of the last piece: arrays of two points each would take most of
        # the time that a path of very many lines takes.
        self._corners: list[complex] = []

    def draw(self, letter: str, numbers: list[float]) -> None:
        """Draw one command; with a small letter its points count from where the pen is."""
        kind, before, self._before = letter.upper(), self._before, letter.upper()
        base = 0j if letter == kind else self._at
        if kind == "Z":
            self._close()
            return
        if kind == "H":
            points = [complex(base.real + numbers[0], self._at.imag)]
        elif kind == "V":
            points = [complex(self._at.real, base.imag + numbers[0])]
        else:
            pairs = numbers[5:] if kind == "A" else numbers
            points = [base + complex(x, y) for x, y in zip(pairs[::2], pairs[1::2], strict=True)]
        if kind == "M":
            self._move(points[0])
            return
        if not self._is_open:
            self._move(self._start)
        if kind in "LHV":
            self._corners.append(points[0])
        elif kind == "A":
            self._arc(numbers, points[0])
        else:
            if kind in "ST":
                # The mirror image of the control point of a curve of the same degree, or else the pen.
                follows = before in ("CS" if kind == "S" else "QT")
                points.insert(0, 2 * self._at - self._control if follows else self._at)
            self._control = points[-2]
            self._curve(*points)
        self._at = points[-1]

    def end(self) -> None:
        """End an open subpath."""
        if self._is_open:
            # A curve that ends exactly where it begins is meant to be closed; Z is only about line ends.
            current = self._current
            pieces = sum(map(len, current.pieces))
            current.closed = pieces > 1 and bool((current.end == current.start).all())
        self._is_open = False

    @property
    def _current(self) -> Subpath:
        """The subpath, with all its pieces so far."""
        if self._corners:
            current = self.subpaths[-1]
            current.pieces.append(
                lines(np.array([complex(*current.end), *self._corners]).view(float).reshape(-1, 2))
            )
            self._corners = []
        return self.subpaths[-1]

    def _move(self, point: complex) -> None:
        self.end()
        self.subpaths.append(Subpath(_pair(point)))
        self._start = self._at = point
        self._is_open = True

    def _curve(self, *points: complex) -> None:
        current = self._current
        a, *controls, d = current.end, *map(_pair, points)
        if len(controls) == 1:
            (b,) = controls
            controls = [a + 2 / 3 * (b - a), d + 2 / 3 * (b - d)]
        current.pieces.append(np.array([[a, *controls, d]]))

    def _arc(self, numbers: list[float], end: complex) -> None:
        rx, ry, rotation, large, sweep = numbers[:5]
        current = self._current
        shape = ((rx, ry), rotation, large == 1, sweep == 1, self._tolerance)
        piece = arc_between(current.end, _pair(end), *shape)
        if piece is None:
            self._corners.append(end)
            return
        current.pieces.append(piece.pieces)
        current.deviation = max(current.deviation, piece.deviation)

    def _close(self) -> None:
        if self._is_open:
            if not cmath.isclose(self._at, self._start, rel_tol=1e-15, abs_tol=1e-15):
                self._corners.append(self._start)
            self._current.closed = True
            self._at = self._start
            self._is_open = False


def _pair(point: complex) -> FloatArray:
    return np.array([point.real, point.imag])
