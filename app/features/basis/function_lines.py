"""Basis functions in pixels: each by itself, all spans together, or the envelope of them all."""

from __future__ import annotations

import math
from enum import Enum, auto

import numpy as np
from pyqtgraph.functions import create_qpolygonf, ndarray_from_qpolygonf
from PySide6.QtGui import QPolygonF

from app.plotting.drawing import Segments, Stroke, polygon, thinned
from app.plotting.pixel_map import PixelMap
from app.view_model.basis_view import BasisView
from curvecore.arrays import FloatArray

_MOST_EACH = 64
_LIMIT = 1e4
_MOST_CHORDS = 256
"""Of a segment, however far the values are zoomed."""

_OFF = 0.25
"""Pixels that the chords of a segment may leave its functions."""

_THINNED = 0.05
"""Pixels that a wide line may leave the samples: it costs by the vertex."""


class FunctionDrawing(Enum):
    """Drawing of the functions of a curve."""

    EACH = auto()
    SPANS = auto()
    ENVELOPE = auto()


def way_to_draw(basis: BasisView) -> FunctionDrawing:
    """Return how to draw these functions: beyond some number, lines side by side say less than an outline."""
    if basis.count <= _MOST_EACH:
        return FunctionDrawing.EACH
    if basis.first is None or basis.is_coarse:
        return FunctionDrawing.ENVELOPE
    return FunctionDrawing.SPANS


def note_on_drawing(basis: BasisView) -> str:
    """Return what a person must know of a drawing that does not show every function; empty where it does."""
    match way_to_draw(basis):
        case FunctionDrawing.EACH:
            return ""
        case FunctionDrawing.SPANS:
            return f"{basis.count} functions: outlines + selection"
        case FunctionDrawing.ENVELOPE:
            return f"{basis.count} functions: envelope + selection"


class FunctionLines:
    """The lines of one sampled basis on one part of the plane.

    Lines made for the basis before, which is not drawn any more, lend their polygons: filling one takes a
    third of the time of making one.
    """

    def __init__(self, basis: BasisView, shown: PixelMap, before: FunctionLines | None = None) -> None:
        self._basis, self._shown = basis, shown
        self._x = np.clip(shown.x(basis.t), -_LIMIT, _LIMIT)
        self._y = _rows(shown, basis.values) if _needs_all(basis) else np.empty(0)
        self._polygons: dict[tuple[int, int], QPolygonF] = {}
        self._made: dict[tuple[int, int], tuple[QPolygonF, FloatArray]] = (
            before._made if before is not None else {}
        )
        self._strokes: dict[tuple[int, int], Stroke] = before._strokes if before is not None else {}
        self._refined = self._refine() if way_to_draw(basis) is FunctionDrawing.SPANS else {}
        self._fine: dict[int, tuple[FloatArray, FloatArray]] = {}
        self._spans: dict[int, Segments] = {}
        self._envelopes: dict[int, tuple[FloatArray, FloatArray, FloatArray]] = {}

    def _refine(self) -> dict[int, tuple[FloatArray, FloatArray]]:
        """Return x (m,) and y (m, 2, R) of each segment in sight that its samples would show as a polygon.

        All segments have the same number of samples, though one may be a hundred times as long as another.
        """
        basis, shown = self._basis, self._shown
        assert basis.first is not None
        knots = shown.x(basis.curve.parameters)
        chords = math.ceil(math.sqrt(basis.most_bent * shown.sy / (8 * _OFF)))
        each = basis.first[1] - basis.first[0] - 1
        # Where there is a chord for every pixel, more of them would show nothing.
        is_coarse = np.diff(knots) > each if chords > each else np.zeros(len(knots) - 1, dtype=bool)
        wide = np.flatnonzero(is_coarse & (knots[1:] >= 0) & (knots[:-1] <= shown.width))
        if not len(wide):
            return {}
        t, values = basis.fine_segments(wide, min(chords, _MOST_CHORDS))
        x = np.clip(shown.x(t), -_LIMIT, _LIMIT)
        y = _rows(shown, values)
        return {int(segment): (x[place], y[place]) for place, segment in enumerate(wide)}

    def are_of(self, basis: BasisView, shown: PixelMap) -> bool:
        """Tell whether these are the lines of `basis` as `shown`."""
        return self._basis is basis and self._shown is shown

    def function(self, index: int, kind: int) -> QPolygonF:
        """Return one function."""
        key = (index, kind)
        if key not in self._polygons:
            self._polygons[key] = self._make(index, kind)
        return self._polygons[key]

    def _make(self, index: int, kind: int) -> QPolygonF:
        first = self._basis.first
        if not _needs_all(self._basis):
            return self._make_fine(index, kind)
        if first is None:
            result, view = self._empty(index, kind, len(self._x))
            view[:, 0] = self._x
            view[:, 1] = self._y[:, index, kind]
            return result
        if index - 1 in self._refined or index in self._refined:
            return self._make_refined(index, kind)
        here = first[index]
        start, end = first[max(index - 1, 0)], first[min(index + 1, self._basis.count - 1)]
        result, view = self._empty(index, kind, int(end - start))
        view[:, 0] = self._x[start:end]
        view[: here - start, 1] = self._y[start:here, 1, kind]
        view[here - start :, 1] = self._y[here:end, 0, kind]
        return result

    def _make_refined(self, index: int, kind: int) -> QPolygonF:
        """Return one function of which a piece is drawn with more chords than it has samples."""
        sides = [(index - 1, 1), (index, 0)]
        pieces = [self._piece(*side, kind) for side in sides if 0 <= side[0] < self._basis.count - 1]
        points = np.concatenate(pieces)
        result, view = self._empty(index, kind, len(points))
        view[:] = points
        return result

    def _piece(self, segment: int, side: int, kind: int) -> FloatArray:
        """Return the points (m, 2) of the function of the point before (0) or after (1) a segment."""
        if segment in self._refined:
            x, y = self._refined[segment]
            return np.column_stack([x, y[:, side, kind]])
        assert self._basis.first is not None
        here = slice(*self._basis.first[segment : segment + 2])
        return np.column_stack([self._x[here], self._y[here, side, kind]])

    def _empty(self, index: int, kind: int, size: int) -> tuple[QPolygonF, FloatArray]:
        """Return a polygon to fill, and its points (size, 2) as an array."""
        made = self._made.get((index, kind))
        if made is None or len(made[1]) != size:
            result: QPolygonF = create_qpolygonf(size)
            made = self._made[index, kind] = (result, ndarray_from_qpolygonf(result))
        return made

    def _make_fine(self, index: int, kind: int) -> QPolygonF:
        if self._basis.first is None and not self._basis.is_coarse:
            return polygon(self._x, _rows(self._shown, self._basis.values[:, index, kind]))
        if index not in self._fine:
            t, values = self._basis.fine_functions(index)
            x = np.clip(self._shown.x(t), -_LIMIT, _LIMIT)
            self._fine[index] = (x, _rows(self._shown, values))
        x, all_kinds = self._fine[index]
        return polygon(x, all_kinds[:, kind])

    def stroke(self, index: int, kind: int) -> Stroke:
        """Return one function to be drawn wide and solid."""
        if len(self._strokes) > _MOST_EACH:
            self._strokes.clear()
        stroke = self._strokes.setdefault((index, kind), Stroke())
        points = ndarray_from_qpolygonf(self.function(index, kind))
        stroke.fill(thinned(points, _THINNED), self._shown.width, self._shown.height)
        return stroke

    def spans(self, kind: int) -> Segments:
        """Return all functions of one kind of a piecewise curve, where they are not zero."""
        if kind not in self._spans:
            segments = Segments()
            segments.fill(self._span_segments(kind))
            self._spans[kind] = segments
        return self._spans[kind]

    def _span_segments(self, kind: int) -> FloatArray:
        count = self._basis.count - 1
        x = self._x.reshape(count, -1)
        y = self._y[:, :, kind].reshape(count, -1, 2)
        seen = (x[:, -1] >= 0) & (x[:, 0] <= self._shown.width)
        seen[list(self._refined)] = False
        chords = _chords(x, y)[seen].reshape(-1, 4)
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
        """Return what lies between the edges as upright lines, one on every column of pixels."""
        x, low, high = self._envelope(kind)
        band = Segments()
        middle = np.floor(x) + 0.5
        band.fill(np.column_stack([middle, low, middle, high]))
        return band

    def _envelope(self, kind: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the columns of pixels, and the lower and upper edge at each."""
        if kind not in self._envelopes:
            t, low, high = self._basis.envelope(kind)
            x = self._shown.x(t)
            columns = np.arange(max(x[0], 0.0), min(x[-1], self._shown.width), 1.0)
            edges = [
                _rows(self._shown, _at_columns(x, values, columns, reduce))
                for values, reduce in ((low, np.minimum), (high, np.maximum))
            ]
            self._envelopes[kind] = (columns, edges[0], edges[1])
        return self._envelopes[kind]


def _rows(shown: PixelMap, values: FloatArray) -> FloatArray:
    """Return the pixels of values, those far outside of what is shown moved to where Qt still draws."""
    # Functions of a polynomial through 2000 points reach 1e306.
    with np.errstate(over="ignore"):
        return np.clip(shown.y(values), -_LIMIT, _LIMIT)


def _chords(x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the chords (k, m − 1, 2, 4) between samples: x (k, m) and y (k, m, 2)."""
    ends = np.empty((len(x), x.shape[1] - 1, 2, 4))
    ends[..., 0], ends[..., 2] = x[:, :-1, None], x[:, 1:, None]
    ends[..., 1], ends[..., 3] = y[:, :-1], y[:, 1:]
    return ends


def _needs_all(basis: BasisView) -> bool:
    return way_to_draw(basis) is not FunctionDrawing.ENVELOPE


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
