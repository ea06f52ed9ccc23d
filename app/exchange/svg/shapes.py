"""Outlines of the SVG elements that draw: basic shapes, and path data as cubic pieces.

svgelements reads path data: its reader stops at the first error, and knows where. The segments that it would
make are not used, as they mirror the control point of a C for a T, against section 9.3.7. The segments before
the one with the error are drawn, as section 9.5.4 says.

Reference: Scalable Vector Graphics 2, sections 9 and 10.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from math import tau
from typing import NamedTuple

import numpy as np
from svgelements import SVGLexicalParser

from curvecore.arrays import FloatArray

from ..cubics_in import arc, arc_between, has_length, lines, put_end, rounding_of, without_roundings
from ..errors import ExchangeError
from .coordinates import Viewport, length
from .xml_tree import tag_of

LENGTHS = {
    "rect": ("x", "y", "width", "height", "rx", "ry"),
    "circle": ("cx", "cy", "r"),
    "ellipse": ("cx", "cy", "rx", "ry"),
    "line": ("x1", "y1", "x2", "y2"),
}
"""The lengths of each shape that has some; those that are not said are None."""

SHAPES = ("path", "polyline", "polygon", *LENGTHS)
"""The elements that draw."""

_SIZES = ("width", "height", "rx", "ry", "r")
"""The lengths that are not negative."""


class UnknownLengthError(ExchangeError):
    """A length whose reference length is unknown."""


def outline_of(element: ET.Element, viewport: Viewport, tolerance: float | None) -> ReadPath:
    """Return the outline of one of `SHAPES`, in its own units, up to the first error in its data.

    Raises
    ------
    UnknownLengthError
        For lengths of unknown size.
    ExchangeError
        For an outline out of range.
    """
    tag = tag_of(element)
    if tag == "path":
        return read_path_data(element.get("d", ""), tolerance)
    if tag not in LENGTHS:
        return read_points(element.get("points", ""), closed=tag == "polygon")
    lengths = [length_of(element, name, viewport) for name in LENGTHS[tag]]
    return ReadPath(shape_of_lengths(tag, lengths, tolerance))


def length_of(element: ET.Element, name: str, viewport: Viewport) -> float | None:
    """Return the length of an attribute in user units; None without one, and for an invalid one.

    Raises
    ------
    UnknownLengthError
        For a length of unknown size.
    """
    text = element.get(name, "").strip()
    if text.lower() in ("", "auto") or not _is_length(name, text):
        return None
    if (value := viewport.length(text, name)) is None:
        raise UnknownLengthError
    return value


def invalid_lengths(element: ET.Element) -> list[str]:
    """Return the attributes of an element with invalid lengths or sizes: 'width “44mmx”'."""
    names = LENGTHS.get(tag_of(element), LENGTHS["rect"][:4])
    given = ((name, text) for name in names if (text := element.get(name, "").strip()))
    return [f"{name} “{text[:20]}”" for name, text in given if not _is_length(name, text)]


def _is_length(name: str, text: str) -> bool:
    """Whether a text is a valid length for an attribute of this name."""
    try:
        value = length(text, 1.0, 1.0)
    except ExchangeError:
        return False
    return value is None or value >= 0 or name not in _SIZES


def shape_of_lengths(tag: str, lengths: list[float | None], tolerance: float | None) -> list[Subpath]:
    """Return a shape of `LENGTHS`, its lengths in their order."""
    values = [0.0 if value is None else value for value in lengths]
    if tag == "line":
        points = np.array(values).reshape(2, 2)
        return [Subpath(points[0], [lines(points)])]
    if tag == "rect":
        x, y, width, height = values[:4]
        return _rectangle((x, y), (width, height), (lengths[4], lengths[5]), tolerance)
    rx, ry = lengths[2], lengths[-1]
    # An ellipse with one radius is a circle.
    return _ellipse(values[0], values[1], _first_given(rx, ry), _first_given(ry, rx), tolerance)


def _first_given(first: float | None, second: float | None) -> float:
    return first if first is not None else second or 0.0


def _rectangle(
    corner: tuple[float, float],
    size: tuple[float, float],
    radii: tuple[float | None, float | None],
    tolerance: float | None,
) -> list[Subpath]:
    (x, y), (width, height), (rx, ry) = corner, size, radii
    if width == 0 or height == 0:
        return []
    across = min(_first_given(rx, ry), width / 2)
    up = min(_first_given(ry, rx), height / 2)
    right, bottom = x + width, y + height
    if across == 0 or up == 0:
        return _complete(read_path_data(f"M{x!r} {y!r}H{right!r}V{bottom!r}H{x!r}Z"))
    bend = f"A{across!r} {up!r} 0 0 1"
    # Where two bends meet there is no line between them, not even one without length.
    top = f"H{right - across!r}" if 2 * across < width else ""
    bottom_line = f"H{x + across!r}" if 2 * across < width else ""
    side = f"V{bottom - up!r}" if 2 * up < height else ""
    other_side = f"V{y + up!r}" if 2 * up < height else ""
    data = (
        f"M{x + across!r} {y!r}{top}{bend} {right!r} {y + up!r}{side}"
        f"{bend} {right - across!r} {bottom!r}{bottom_line}{bend} {x!r} {bottom - up!r}{other_side}"
        f"{bend} {x + across!r} {y!r}Z"
    )
    return _complete(read_path_data(data, tolerance))


def _complete(read: ReadPath) -> list[Subpath]:
    if read.error:
        raise ExchangeError("A number is too large.")
    return read.subpaths


def _ellipse(x: float, y: float, rx: float, ry: float, tolerance: float | None) -> list[Subpath]:
    if rx == 0 or ry == 0:
        return []
    whole = arc(np.array([x, y]), np.diag([rx, ry]), 0.0, tau, tolerance)
    whole.pieces[-1, 3] = whole.pieces[0, 0]
    return [Subpath(whole.pieces[0, 0], [whole.pieces], closed=True, deviation=whole.deviation)]


# Path data


_GAP = r"[ \t\r\n\f]*"
_PASSED_OVER = re.compile(rf"(?:^|[A-Za-z,]){_GAP}(,)|[VAa]{_GAP}([A-Za-z]|\Z)")
"""Flaws that svgelements passes over: a comma that separates no numbers, and V and A without any."""
_BARE_POINT = re.compile(r"(?<![\d.eE])(\d+)\.(?![\deE.])")
"""The point of ``1.``, which SVG 1.1 allowed and programs still write."""
_NO_MOVE = re.compile(rf"{_GAP}[ZLHVCSQTAzlhvcsqta]")
_NO_COORDINATE = re.compile(r"[^-+.,\deE \t\r\n\f]")
_SEPARATORS = " \t\r\n\f,"
_LONGEST = 50_000_000
_EXCERPT = 12
"""Characters that are shown of data with an error."""
_ROUNDING = 1e-6
"""Share of the extent of a subpath: a shorter last line is a rounding, as in Inkscape."""


@dataclass(eq=False)
class Subpath:
    """Part of a path from one M to the next.

    Attributes
    ----------
    pieces
        Cubic pieces (k, 4, 2), or groups of them.
    closed
        Whether the subpath ends in Z, or exactly where it begins.
    deviation
        Distance of the pieces of arcs from the arcs.
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
        """Whether the subpath is more than a point."""
        return bool((self.controls != self.start).any())

    @property
    def is_line(self) -> bool:
        """Whether the subpath is a line, even one without length: more than an M alone."""
        return self.closed or bool(self.pieces)

    @property
    def pieces_with_length(self) -> FloatArray:
        """Pieces longer than roundings, (k, 4, 2); one without length where there are none."""
        pieces = without_roundings(self.controls, closed=self.closed)
        return pieces if len(pieces) else np.tile(self.start, (1, 4, 1))

    @property
    def controls(self) -> FloatArray:
        """All pieces, (k, 4, 2)."""
        return np.concatenate(self.pieces) if self.pieces else np.empty((0, 4, 2))


class ReadPath(NamedTuple):
    """Subpaths of an element, and the error that ends them early.

    Attributes
    ----------
    subpaths
        Subpaths before the segment with the error.
    error
        Position of the error, "at character 7, “L35”", from 1; empty without one.
    """

    subpaths: list[Subpath]
    error: str = ""


def read_path_data(data: str, tolerance: float | None = None) -> ReadPath:
    """Return the subpaths of path data, up to the first error.

    Lines and quadratics are raised to cubics, arcs become cubics within the tolerance.

    Raises
    ------
    ExchangeError
        If the data are too long.
    """
    if len(data) > _LONGEST:
        raise ExchangeError("its data are too long.")
    pen = _Pen(tolerance)
    position = 0 if _NO_MOVE.match(data) else _drawn(data, pen)
    pen.end()
    return ReadPath(pen.subpaths, _error_at(position, data))


def read_points(data: str, *, closed: bool) -> ReadPath:
    """Return the polyline through a list of points, up to the first error: numbers in pairs, no letter."""
    stop = _NO_COORDINATE.search(data)
    listed = data[: stop.start()] if stop else data
    pen = _Pen(None)
    position = _drawn(f"M{listed}", pen) if listed.strip() else None
    if position is not None:
        position -= 1
    elif stop:
        position = stop.start()
    if closed:
        pen.closed()
    pen.end()
    return ReadPath(pen.subpaths, _error_at(position, data))


def _drawn(data: str, pen: _Pen) -> int | None:
    """Draw path data up to the first error, and return its position; None without an error."""
    # The length stays the same, for the positions of errors.
    data = _BARE_POINT.sub(r"\1 ", data)
    loss, reader = _PASSED_OVER.search(data), _Reader()
    try:
        reader.parse(pen, data[: loss.start(loss.lastindex or 0)] if loss else data)
    except ExchangeError:
        return int(reader.pos) - len(data[reader.end_before : reader.pos].lstrip(_SEPARATORS))
    except ValueError:
        # A Z is complete before a number that follows it is an error.
        if reader.command in ("Z", "z"):
            pen.closed()
        return int(reader.pos)
    return None if loss is None and reader.pos == len(data) else int(reader.pos)


def _error_at(at: int | None, data: str) -> str:
    if at is None:
        return ""
    return f"at character {at + 1}, “{data[at : at + _EXCERPT]}”" if data[at:] else "at the end"


class _Reader(SVGLexicalParser):  # type: ignore[misc]  # that package has no types
    """Parser of commands; a missing number or flag is an error, not None or the end of the path.

    Attributes
    ----------
    command
        The letter of the last command.
    end_before
        Position after the number before the last one.
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
            raise ExchangeError("A number is too large.")
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
        Position of the pen.
    subpaths
        Subpaths drawn; complete after `end`.
    """

    def __init__(self, tolerance: float | None) -> None:
        self._tolerance = tolerance
        self.subpaths: list[Subpath] = []
        self.current_point = self._start = _Point(0.0, 0.0)
        # The degree of the curve before, and its last control point.
        self._before: tuple[int, _Pair] = (1, self._start)
        self._is_open = False
        # Vertices of a polyline from the end of the last piece: arrays of two points each would take most of
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
            # A curve that ends exactly at its start is meant to be closed; Z only joins the stroke.
            current = self._current
            controls, gap = current.controls, np.abs(current.end - current.start).max()
            current.closed = len(controls) > 1 and bool(gap <= rounding_of(controls))
        self._is_open = False

    def _go_home(self) -> None:
        """Return to the start of the subpath; without a line where the distance is a rounding."""
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
