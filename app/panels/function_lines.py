"""Basis functions in pixels: each by itself, all spans together, or the envelope of them all."""

from __future__ import annotations

from enum import Enum, auto

import numpy as np
from pyqtgraph.functions import create_qpolygonf, ndarray_from_qpolygonf
from PySide6.QtGui import QPolygonF

from app.plot.drawing import Segments, polygon
from app.plot.pixel_map import Floats, PixelMap
from app.view_model.basis_view import BasisView

_MOST_EACH = 64
_LIMIT = 1e4


class Drawing(Enum):
    """How the functions of a curve are drawn."""

    EACH = auto()
    SPANS = auto()
    ENVELOPE = auto()


def way_to_draw(basis: BasisView) -> Drawing:
    """Return how to draw these functions: beyond some number, lines side by side say less than an outline."""
    if basis.count <= _MOST_EACH:
        return Drawing.EACH
    if basis.first is None or basis.is_coarse:
        return Drawing.ENVELOPE
    return Drawing.SPANS


def note_on_drawing(basis: BasisView) -> str:
    """Return what a person must know of a drawing that does not show every function; empty where it does."""
    match way_to_draw(basis):
        case Drawing.EACH:
            return ""
        case Drawing.SPANS:
            return f"{basis.count} functions: in colour those near the selection"
        case Drawing.ENVELOPE:
            return f"{basis.count} functions: their envelope, and those near the selection"


class FunctionLines:
    """The lines of one sampled basis on one part of the plane."""

    def __init__(self, basis: BasisView, shown: PixelMap) -> None:
        self._basis, self._shown = basis, shown
        self._x = np.clip(shown.x(basis.t), -_LIMIT, _LIMIT)
        self._y = np.clip(shown.y(basis.values), -_LIMIT, _LIMIT) if _needs_all(basis) else np.empty(0)
        self._polygons: dict[tuple[int, int], QPolygonF] = {}
        self._spans: dict[int, Segments] = {}
        self._edges: dict[tuple[int, bool], QPolygonF] = {}

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
            t, values = self._basis.function(index, kind)
            y = np.clip(self._shown.y(values), -_LIMIT, _LIMIT)
            return polygon(np.clip(self._shown.x(t), -_LIMIT, _LIMIT), y)
        if first is None:
            return polygon(self._x, self._y[:, index, kind])
        here = first[index]
        start, end = first[max(index - 1, 0)], first[min(index + 1, self._basis.count - 1)]
        result: QPolygonF = create_qpolygonf(int(end - start))
        view = ndarray_from_qpolygonf(result)
        view[:, 0] = self._x[start:end]
        view[: here - start, 1] = self._y[start:here, 1, kind]
        view[here - start :, 1] = self._y[here:end, 0, kind]
        return result

    def spans(self, kind: int) -> Segments:
        """Return all functions of one kind of a piecewise curve, where they are not zero."""
        if kind not in self._spans:
            segments = Segments()
            segments.fill(self._span_segments(kind))
            self._spans[kind] = segments
        return self._spans[kind]

    def _span_segments(self, kind: int) -> Floats:
        count = self._basis.count - 1
        x = self._x.reshape(count, -1)
        y = self._y[:, :, kind].reshape(count, -1, 2)
        ends = np.empty((count, x.shape[1] - 1, 2, 4))
        ends[..., 0], ends[..., 2] = x[:, :-1, None], x[:, 1:, None]
        ends[..., 1], ends[..., 3] = y[:, :-1], y[:, 1:]
        seen = (x[:, -1] >= 0) & (x[:, 0] <= self._shown.width)
        return ends[seen].reshape(-1, 4)

    def edge(self, kind: int, *, upper: bool) -> QPolygonF:
        """Return the upper or the lower edge of the envelope of one kind."""
        key = (kind, upper)
        if key not in self._edges:
            low, high = self._basis.envelope(kind)
            x, values = _by_column(self._x, high if upper else low, self._shown.width, upper=upper)
            self._edges[key] = polygon(x, np.clip(self._shown.y(values), -_LIMIT, _LIMIT))
        return self._edges[key]

    def band(self, kind: int) -> QPolygonF:
        """Return the area between the edges."""
        low = ndarray_from_qpolygonf(self.edge(kind, upper=False))
        high = ndarray_from_qpolygonf(self.edge(kind, upper=True))
        both = np.concatenate([low, high[::-1]])
        return polygon(both[:, 0], both[:, 1])


def _needs_all(basis: BasisView) -> bool:
    return way_to_draw(basis) is not Drawing.ENVELOPE


def _by_column(x: Floats, values: Floats, width: float, *, upper: bool) -> tuple[Floats, Floats]:
    """Reduce samples at ascending x to the extremes of each column of pixels, where there are many."""
    first, last = np.searchsorted(x, [-1.0, width + 1.0])
    x, values = x[max(first - 1, 0) : last + 1], values[max(first - 1, 0) : last + 1]
    if len(x) <= 2 * width:
        return x, values
    column = np.floor(x)
    starts = np.flatnonzero(np.diff(column, prepend=column[0] - 1))
    reduce = np.maximum if upper else np.minimum
    return x[starts], reduce.reduceat(values, starts)
