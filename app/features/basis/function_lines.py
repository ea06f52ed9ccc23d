"""Basis functions in pixels: their lines, and a number at each crest."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QSizeF
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPixmap, QPolygonF

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...appearance.colours import point_colours
from ...appearance.theme import Theme
from ...plotting.drawing import Segments, polygon, thinned
from ...plotting.graphs import pg
from ...plotting.pixel_map import PixelMap
from ...plotting.plot_widget import PlotWidget
from ...plotting.text import with_halo
from ...plotting.wide_line import RoundLine
from ...tasks.task import DelayedCall
from ...view_model.basis import BasisView

_MOST_EACH = 64
_LIMIT = 1e4
_MOST_CHORDS = 256
"""Largest number of chords of a segment, however far the values are zoomed."""

_OFF = 0.25
"""Largest distance in pixels between the chords of a segment and its functions."""

_THINNED = 0.05
"""Largest distance in pixels between a wide line and the samples: it takes time for each vertex."""


class FunctionDrawing(Enum):
    """Way to draw the functions of a curve; the value is the word for it."""

    EACH = ""
    SPANS = "outlines"
    ENVELOPE = "envelope"


def drawing_of(basis: BasisView) -> FunctionDrawing:
    """Return the way to draw these functions: outlines where single lines are too many."""
    if basis.count <= _MOST_EACH:
        return FunctionDrawing.EACH
    if basis.first is None or basis.is_coarse:
        return FunctionDrawing.ENVELOPE
    return FunctionDrawing.SPANS


def note_on_drawing(basis: BasisView) -> str:
    """Return the note on a drawing that does not show every function; empty if it does."""
    drawing = drawing_of(basis)
    if drawing is FunctionDrawing.EACH:
        return ""
    return f"{basis.point_count} functions: {drawing.value} + selection"


class FunctionLines:
    """The lines of one sampled basis on one part of the plane.

    Polygons of the previous lines are reused: filling one takes a third of the time of making one.
    """

    def __init__(self, basis: BasisView, pixel_map: PixelMap, before: FunctionLines | None = None) -> None:
        self._basis, self._pixel_map = basis, pixel_map
        drawing = drawing_of(basis)
        needs_all = drawing is not FunctionDrawing.ENVELOPE
        self._x, self._y = self._pixels(basis.t, basis.values if needs_all else np.empty(0))
        # The vertices of each function where it is not zero: copying a stretch takes a quarter of the time of
        # picking x and y.
        self._stretches = self._all_stretches() if drawing is FunctionDrawing.EACH else None
        self._polygons: dict[tuple[int, int], QPolygonF] = {}
        self._cached: dict[tuple[int, int], tuple[QPolygonF, FloatArray]] = (
            before._cached if before is not None else {}
        )
        self._strokes: dict[tuple[int, int], RoundLine] = before._strokes if before is not None else {}
        # The widths of the lines that are filled with functions of this basis.
        self._widths: dict[tuple[int, int], float] = {}
        self._refined = self._refine() if drawing is FunctionDrawing.SPANS else {}
        self._fine: dict[int, tuple[FloatArray, FloatArray]] = {}
        self._spans: dict[int, Segments] = {}
        self._envelopes: dict[int, tuple[FloatArray, FloatArray, FloatArray]] = {}

    def _pixels(self, t: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return t and values in pixels, limited to the range that Qt can draw."""
        # Functions of a polynomial through 2000 points reach 1e306.
        with np.errstate(over="ignore"):
            x, y = self._pixel_map.x(t), self._pixel_map.y(values)
        return np.clip(x, -_LIMIT, _LIMIT), np.clip(y, -_LIMIT, _LIMIT)

    def _refine(self) -> dict[int, tuple[FloatArray, FloatArray]]:
        """Return x (m,) and y (m, 2, R) of each visible segment whose samples would show as a polygon.

        All segments have equally many samples, though one may be a hundred times as long as another.
        """
        basis, pixel_map = self._basis, self._pixel_map
        assert basis.first is not None
        knots = pixel_map.x(basis.curve.parameters)
        chords = math.ceil(math.sqrt(basis.most_bent * pixel_map.sy / (8 * _OFF)))
        samples = basis.first[1] - basis.first[0] - 1
        # With a chord for every pixel, more of them would be invisible.
        is_coarse = np.diff(knots) > samples if chords > samples else np.zeros(len(knots) - 1, dtype=bool)
        segments = np.flatnonzero(is_coarse & (knots[1:] >= 0) & (knots[:-1] <= pixel_map.width))
        if not len(segments):
            return {}
        t, values = basis.fine_segments(segments, min(chords, _MOST_CHORDS))
        x, y = self._pixels(t, values)
        return {int(segment): (x[row], y[row]) for row, segment in enumerate(segments)}

    def are_of(self, basis: BasisView, pixel_map: PixelMap) -> bool:
        """Return whether these are the lines of `basis` in `pixel_map`."""
        return self._basis.values is basis.values and self._pixel_map is pixel_map

    def _all_stretches(self) -> list[list[FloatArray]]:
        """Return the vertices (R, m, 2) of each function in stretches: on each side of its knot, or one."""
        basis = self._basis
        _m, rows, kinds = self._y.shape
        vertices = np.empty((rows, kinds, len(self._x), 2))
        vertices[..., 0] = self._x
        vertices[..., 1] = self._y.transpose(1, 2, 0)
        if basis.first is None:
            return [[vertices[knot, :, part]] for knot, part in enumerate(basis.supports)]
        ends = basis.first.tolist()
        segments = [slice(*between) for between in pairwise(ends)]
        before, after = ([vertices[side, :, part] for part in segments] for side in (1, 0))
        return [[*before[max(knot - 1, 0) : knot], *after[knot : knot + 1]] for knot in range(basis.count)]

    def function(self, index: int, kind: int) -> QPolygonF:
        """Return the polygon of one function."""
        key = (index, kind)
        if key not in self._polygons:
            pieces = self._pieces(index, kind)
            size = sum(map(len, pieces))
            cached = self._cached.get(key)
            if cached is None or len(cached[1]) != size:
                new_polygon: QPolygonF = pg.functions.create_qpolygonf(size)
                cached = self._cached[key] = (new_polygon, pg.functions.ndarray_from_qpolygonf(new_polygon))
            end = 0
            for vertices in pieces:
                start, end = end, end + len(vertices)
                cached[1][start:end] = vertices
            self._polygons[key] = cached[0]
        return self._polygons[key]

    def _pieces(self, index: int, kind: int) -> list[FloatArray]:
        """Return the stretches of vertices (m, 2) of one function: one on each side of its knot, or one."""
        if self._stretches is not None:
            return [stretch[kind] for stretch in self._stretches[index]]
        basis = self._basis
        if len(self._y):
            sides = [(index - 1, 1), (index, 0)]
            return [self._piece(*side, kind) for side in sides if 0 <= side[0] < basis.count - 1]
        if not basis.is_coarse:
            part = basis.inside_support(index)
            return [np.column_stack(self._pixels(basis.t[part], basis.values[part, index, kind]))]
        if index not in self._fine:
            self._fine[index] = self._pixels(*basis.fine_functions(index))
        x, all_kinds = self._fine[index]
        return [np.column_stack([x, all_kinds[:, kind]])]

    def _piece(self, segment: int, side: int, kind: int) -> FloatArray:
        """Return the vertices of the function of the point before (0) or after (1) a segment."""
        if segment in self._refined:
            x, y = self._refined[segment]
            return np.column_stack([x, y[:, side, kind]])
        assert self._basis.first is not None
        part = slice(*self._basis.first[segment : segment + 2])
        return np.column_stack([self._x[part], self._y[part, side, kind]])

    def wide(self, index: int, kind: int, width: float) -> RoundLine:
        """Return the line of one function, wide and solid."""
        key = (index, kind)
        if self._widths.get(key) == width:
            return self._strokes[key]
        if len(self._strokes) > _MOST_EACH:
            self._strokes.clear()
            self._widths.clear()
        line = self._strokes.get(key)
        if line is None:
            line = self._strokes[key] = RoundLine()
        self._widths[key] = width
        line.fill(thinned(np.concatenate(self._pieces(index, kind)), _THINNED), self._pixel_map, width)
        return line

    def spans(self, kind: int) -> Segments:
        """Return all functions of one kind of a piecewise curve where they are not zero."""
        if kind not in self._spans:
            segments = Segments()
            segments.fill(self._span_segments(kind))
            self._spans[kind] = segments
        return self._spans[kind]

    def _span_segments(self, kind: int) -> FloatArray:
        count = self._basis.count - 1
        x = self._x.reshape(count, -1)
        y = self._y[:, :, kind].reshape(count, -1, 2)
        visible = (x[:, -1] >= 0) & (x[:, 0] <= self._pixel_map.width)
        visible[list(self._refined)] = False
        chords = _chords(x, y)[visible].reshape(-1, 4)
        if not self._refined:
            return chords
        fine_x, fine_y = zip(*self._refined.values(), strict=True)
        fine = _chords(np.stack(fine_x), np.stack(fine_y)[..., kind])
        return np.concatenate([chords, fine.reshape(-1, 4)])

    def edge(self, kind: int, *, upper: bool) -> QPolygonF:
        """Return the upper or the lower edge of the envelope of one kind."""
        x, *edges = self._envelope(kind)
        return polygon(x, edges[1 if upper else 0])

    def band(self, kind: int) -> Segments:
        """Return the area between the edges as upright lines, one in each column of pixels."""
        x, low, high = self._envelope(kind)
        band = Segments()
        middle = np.floor(x) + 0.5
        band.fill(np.column_stack([middle, low, middle, high]))
        return band

    def _envelope(self, kind: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the columns of pixels, and the lower and upper edge at each."""
        if kind not in self._envelopes:
            t, low, high = self._basis.envelope(kind)
            x = self._pixel_map.x(t)
            columns = np.arange(max(x[0], 0.0), min(x[-1], self._pixel_map.width), 1.0)
            edges = [
                self._pixels(t, _at_columns(x, values, columns, reduce))[1]
                for values, reduce in ((low, np.minimum), (high, np.maximum))
            ]
            self._envelopes[kind] = (columns, edges[0], edges[1])
        return self._envelopes[kind]


def _chords(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the chords (k, m − 1, 2, 4) between samples: x (k, m) and y (k, m, 2)."""
    ends = np.empty((len(x), x.shape[1] - 1, 2, 4))
    ends[..., 0], ends[..., 2] = x[:, :-1, None], x[:, 1:, None]
    ends[..., 1], ends[..., 3] = y[:, :-1], y[:, 1:]
    return ends


def _at_columns(x: FloatArray, values: FloatArray, columns: FloatArray, reduce: np.ufunc) -> FloatArray:
    """Return the extremes of samples at ascending x around each column; between samples, interpolated."""
    result: FloatArray = np.interp(columns, x, values)
    edges = np.searchsorted(x, np.append(columns - 0.5, columns[-1:] + 0.5))
    filled = np.flatnonzero(edges[1:] > edges[:-1])
    if len(filled):
        # Up to the next filled column there are no other samples.
        extremes = reduce.reduceat(values[: edges[-1]], edges[filled])
        result[filled] = reduce(result[filled], extremes)
    return result


MOST = 24
"""Largest number of functions with numbers, of all kinds: more numbers would lie on other lines."""

_GAP = 1.0
"""Pixels between a crest and its number."""

_RIM = 2.0
"""Pixels of paper around a number."""

_KEEP_SIDE_MS = 200
"""Milliseconds for which a number keeps its side of a moving crest."""


class Crest(NamedTuple):
    """Crest of a function: its greatest value, or its value at t_i for a point on the curve."""

    owner: int
    kind: int
    t: float
    value: float


def crests_of(basis: BasisView, kinds: list[int]) -> list[Crest]:
    """Return the crests of the functions of these kinds; crests of derivatives lie ahead of their knots."""
    knots, last = basis.curve.parameters.tolist(), basis.count - 1
    crests = _crests_of_points(basis) if 0 in kinds else []
    for kind in kinds:
        if kind == 0:
            continue
        for knot, t_knot in enumerate(knots):
            t, values = basis.function(knot, kind)
            sizes = np.abs(values) if knot == last else np.where(t >= t_knot, np.abs(values), 0.0)
            top = int(np.argmax(sizes))
            crests.append(Crest(basis.owners[knot], kind, float(t[top]), float(values[top])))
    return crests


def _crests_of_points(basis: BasisView) -> list[Crest]:
    """Return the crests of the position functions: 1 at their parameters; of control points, the maxima."""
    if basis.curve.interpolates:
        tops = [(t, 1.0) for t in basis.curve.parameters.tolist()]
    elif basis.first is None:
        rows = basis.values[:, :, 0].argmax(axis=0)
        highest = basis.values[rows, np.arange(basis.count), 0]
        tops = list(zip(basis.t[rows].tolist(), highest.tolist(), strict=True))
    else:
        functions = [basis.function(knot, 0) for knot in range(basis.count)]
        tops = [(float(t[values.argmax()]), float(values.max())) for t, values in functions]
    return [Crest(owner, 0, *top) for owner, top in zip(basis.owners, tops, strict=True)]


class Room(NamedTuple):
    """Room for numbers at crests; below `floor`, in pixels, there is none."""

    pixel_map: PixelMap
    basis: BasisView
    kinds: list[int]
    floor: float
    scale: float


def room_above(font: QFont, scale: float) -> float:
    """Return the height in pixels of a number above its crest."""
    return _size_of_number(font, scale).height() + _GAP


def _size_of_number(font: QFont, scale: float) -> QSizeF:
    """Return the size of a number of two digits with its halo of paper."""
    metrics, rim = QFontMetricsF(font), _RIM * scale
    # Even numbers of pixels: the centres are whole pixels, and letters are sharp.
    width, height = metrics.horizontalAdvance("00") + 2 * rim, metrics.ascent() + 2 * rim
    return QSizeF(2 * math.ceil(width / 2), 2 * math.ceil(height / 2))


class CrestNames:
    """Numbers of points at the crests of their functions.

    Parameters
    ----------
    plot
        The plot of the functions.
    again
        Called for another paint when changing functions have come to rest.
    """

    def __init__(self, plot: PlotWidget, again: Callable[[], None]) -> None:
        # By point and colour: the colour of a point depends on the number of points.
        self._pictures: dict[tuple[int, int], QPixmap] = {}
        self._pictures_key: tuple[object, ...] = ()
        self._measured: tuple[object, ...] = ()
        self._cell = QSizeF()
        self._centres = np.empty((0, 2))
        self._crests_of: tuple[BasisView, list[int]] | None = None
        self._owners, self._positions = np.empty(0, dtype=np.intp), np.empty((0, 2))
        # Offsets of the numbers from their crests in pixels, and which of them are drawn.
        self._offsets, self._is_clear = np.empty((0, 2)), np.empty(0, dtype=np.bool_)
        self._sides_key: tuple[object, ...] = ()
        self._sides_basis: BasisView | None = None
        self._choose_timer = DelayedCall(plot, _KEEP_SIDE_MS, self._choose_again)
        self._again = again

    def paint(
        self,
        painter: QPainter,
        pixel_map: PixelMap,
        basis: BasisView,
        kinds: list[int],
        theme: Theme,
        scale: float,
    ) -> None:
        """Write a number at each crest, unless it would overlap another number or a function."""
        if basis.count * len(kinds) > MOST:
            return
        self._find_crests(basis, kinds)
        self._measure(painter, scale)
        crests = np.column_stack([pixel_map.x(self._positions[:, 0]), pixel_map.y(self._positions[:, 1])])
        self._choose_sides(crests, Room(pixel_map, basis, kinds, painter.clipBoundingRect().bottom(), scale))
        centres, clear = crests + self._offsets, np.flatnonzero(self._is_clear)
        numbered = clear[apart(centres[clear], self._cell)]
        self._centres = np.round(centres[numbered])
        self._write(painter, self._owners[numbered].tolist(), basis.point_count, theme, scale)

    def _write(self, painter: QPainter, owners: list[int], count: int, theme: Theme, scale: float) -> None:
        """Write the numbers of `owners`, of `count` points, at their centres."""
        key = (self._measured, theme, painter.device().devicePixelRatioF())
        if key != self._pictures_key:
            self._pictures_key = key
            self._pictures.clear()
        left, top = self._cell.width() / 2, self._cell.height() / 2
        inks, rim = point_colours(count, theme), _RIM * scale
        for owner, (x, y) in zip(owners, self._centres.tolist(), strict=True):
            ink = inks[owner]
            if (name := (owner, ink.rgba())) not in self._pictures:
                self._pictures[name] = with_halo(painter, self._cell, str(owner), theme.paper, ink, rim)
            # On whole pixels, where letters are sharp.
            painter.drawPixmap(int(x - left), int(y - top), self._pictures[name])

    def _find_crests(self, basis: BasisView, kinds: list[int]) -> None:
        cached = self._crests_of
        if cached is None or cached[0] is not basis or cached[1] != kinds:
            crests, self._crests_of = crests_of(basis, kinds), (basis, kinds)
            self._owners = np.array([crest.owner for crest in crests], dtype=np.intp)
            self._positions = np.array([(crest.t, crest.value) for crest in crests])

    def _choose_sides(self, crests: FloatArray, room: Room) -> None:
        """Choose the side of its crest for each number; while functions move it stays."""
        key = (room.basis.count, tuple(room.kinds), room.pixel_map, room.floor, room.scale)
        if key == self._sides_key and self._choose_timer.isActive():
            return
        if room.basis is not self._sides_basis:
            self._choose_timer.start()
        self._sides_key, self._sides_basis = key, room.basis
        centres, self._is_clear = self._boxes(crests, room)
        self._offsets = centres - crests

    def _choose_again(self) -> None:
        """Paint once more, unless the sides were chosen for the functions drawn last."""
        if self._crests_of is not None and self._crests_of[0] is not self._sides_basis:
            self._again()

    def _boxes(self, crests: FloatArray, room: Room) -> tuple[FloatArray, BoolArray]:
        """Return the centres of the numbers in pixels, and which of them are clear of functions.

        A number stands beyond its crest; if a function crosses it there, inside of it or a little aside.
        """
        pixel_map, basis, kinds, floor, scale = room
        x, y = crests.T
        width, height = self._cell.width(), self._cell.height()
        half = height / 2
        above, below = y - half - _GAP, y + half + _GAP
        is_below = np.where(self._positions[:, 1] < 0, below + half <= floor, above < half)
        beyond, inside = np.where(is_below, below, above), np.where(is_below, above, below)
        aside, rim = width / 2 + _GAP, 2 * _RIM * scale
        lines = Lines(pixel_map, basis, kinds, (width - rim, height - rim))
        centres = np.column_stack([x, beyond])
        is_clear = lines.leave_free(centres)
        for dx, side in ((0.0, inside), (-aside, beyond), (aside, beyond), (-aside, inside), (aside, inside)):
            candidates = np.column_stack([x + dx, side])
            is_level = (side >= half) & (side + half <= floor)
            fits = is_level & (x + dx >= width / 2) & (x + dx <= pixel_map.width - width / 2)
            better = np.flatnonzero(~is_clear & fits)
            better = better[lines.leave_free(candidates[better])]
            centres[better], is_clear[better] = candidates[better], True
        return centres, is_clear

    def _measure(self, painter: QPainter, scale: float) -> None:
        """Compute the size of a number with its halo of paper."""
        key = (painter.font().key(), scale)
        if key != self._measured:
            self._measured = key
            self._cell = _size_of_number(painter.font(), scale)


class Lines:
    """The functions and the zero line in pixels, for the test whether they cross a number.

    Parameters
    ----------
    size
        Width and height of a number.
    """

    def __init__(
        self, pixel_map: PixelMap, basis: BasisView, kinds: list[int], size: tuple[float, float]
    ) -> None:
        self._half = np.array(size) / 2
        self._x = pixel_map.x(basis.t)
        values = basis.values[:, :, kinds].reshape(len(basis.t), -1)
        y = pixel_map.y(np.column_stack([values, np.zeros(len(values))]))
        self._top, self._bottom = np.minimum(y[:-1], y[1:]), np.maximum(y[:-1], y[1:])
        if basis.first is not None:
            # Between two segments a column changes from one knot to another.
            self._top[basis.first[1:-1] - 1] = np.inf

    def leave_free(self, centres: FloatArray) -> BoolArray:
        """Return at which of the centres (k, 2) nothing crosses a number."""
        across, up = self._half
        starts = (np.searchsorted(self._x, centres[:, 0] - across) - 1).clip(0)
        ends = np.searchsorted(self._x, centres[:, 0] + across)
        result = np.ones(len(centres), dtype=np.bool_)
        for k, (start, end) in enumerate(zip(starts.tolist(), ends.tolist(), strict=True)):
            low, high = centres[k, 1] - up, centres[k, 1] + up
            result[k] = not ((self._top[start:end] < high) & (self._bottom[start:end] > low)).any()
        return result


def apart(centres: FloatArray, cell: QSizeF) -> IntArray:
    """Return the indices of numbers that do not overlap an earlier one."""
    order = np.argsort(centres[:, 0], kind="stable")
    if (np.diff(centres[order, 0]) >= cell.width()).all():
        return order
    result: list[int] = []
    for index in order.tolist():
        near = [k for k in result if abs(centres[k, 0] - centres[index, 0]) < cell.width()]
        if all(abs(centres[k, 1] - centres[index, 1]) >= cell.height() for k in near):
            result.append(index)
    return np.array(result, dtype=np.intp)
