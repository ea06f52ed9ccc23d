"""Views of many curves at once: after a map of them all, as by a drag of the selection, and made ahead.

An affine map of the points takes the curve along where its functions add up to 1, its estimates are linear in
the points, and its parameters ask for no length that the map changes. Then polylines and boxes are mapped,
those of all curves in one array, and no curve is made until somebody asks for it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from operator import attrgetter, is_

import numpy as np

from curvecore import ParametricCurve
from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...document.derivatives import DERIVATIVES, EstimateRule
from ...document.model import Curve
from ...families import Family
from .curve_view import LINE, CurveMap, CurveView, view_of
from .moving import Polyline
from .point_arrays import PointArrays, arrays_of_all

_FEWEST = 2
"""Curves from which on arrays of them all are faster."""

_OFF = 1e-8
"""Distance of points from their images, as a share of the tolerance of the polyline, and of the distances
that parameters depend on. Rounding is 1e-16 of the coordinates of a curve."""

_FINEST = 1e-3
"""Largest tolerance of a polyline, as a share of the diagonal of the box of the points."""

_SAME, _NO_OFFSET = np.eye(2), np.zeros(2)

_besides_points = attrgetter(*(name for name in LINE if name != "points"))
_functions = attrgetter(
    "family", "family.curve_class", *(derivative.rule_field for derivative in DERIVATIVES)
)


def views_after(
    curves: Sequence[Curve], before: Sequence[CurveView | None], *, are_moved: bool = False
) -> list[CurveView]:
    """Return the views of curves; the views before lend them unchanged results, see `view_of`.

    `are_moved` says that nothing but positions of points has changed.
    """
    pairs = [
        (index, curve, old)
        for index, (curve, old) in enumerate(zip(curves, before, strict=True))
        if old is not None
        and (are_moved or _has_other_points_alone(curve, old))
        and _may_be_carried(curve, old)
    ]
    mapped: dict[int, CurveView] = {}
    if len(pairs) >= _FEWEST:
        indices, changed, olds = zip(*pairs, strict=True)
        mapped = {indices[row]: view for row, view in _carried(changed, olds, are_moved=are_moved)}
    return [
        mapped.get(index) or view_of(curve, old)
        for index, (curve, old) in enumerate(zip(curves, before, strict=True))
    ]


def _has_other_points_alone(curve: Curve, old: CurveView) -> bool:
    """Whether only points have changed, and their number has not."""
    return len(curve.points) == len(old.points) and all(
        map(is_, _besides_points(curve), _besides_points(old.source))
    )


def _may_be_carried(curve: Curve, old: CurveView) -> bool:
    """Whether a map of the points maps the curve with them, and its polyline is known."""
    return (
        len(curve.points) > 1
        and old.whole_line is not None
        and _is_affine(*_functions(curve))
        and old.is_current
    )


@cache
def _is_affine(family: Family, curve_class: type[ParametricCurve], *rules: EstimateRule) -> bool:
    """Whether an affine map of the points maps the curve at the same parameters, but for roundings.

    Functions must be small and add up to 1: those of a file need not, and those of one polynomial are large.
    """
    is_small = family.is_built_in and (curve_class.is_local or not curve_class.interpolates)
    return is_small and all(rule.is_linear for rule in rules[: family.derivatives])


def _carried(
    curves: Sequence[Curve], olds: Sequence[CurveView], *, are_moved: bool
) -> Iterator[tuple[int, CurveView]]:
    """Yield the index and the view of each curve that was mapped."""
    arrays = arrays_of_all(
        [curve.points for curve in curves], [old.arrays for old in olds], are_moved=are_moved
    )
    roots = [old.curve_map.root if old.curve_map else old for old in olds]
    moves = _Moves(curves, olds, roots, arrays)
    moved = moves.find_maps()
    rows = np.flatnonzero(moved).tolist()
    if not rows:
        return
    linear, stretch = moves.linear, moves.stretch
    lines = [line for row in rows if (line := roots[row].whole_line)]
    spans = _Spans([len(line.points) for line, _ in lines])
    start, end = moves.roots[moves.spans.starts[rows]], moves.new[moves.spans.starts[rows]]
    vertices = np.concatenate([line.points for line, _ in lines]) - spans.repeated(start)
    vertices = _times(spans.repeated(linear[rows]), vertices) + spans.repeated(end)
    boxes = spans.boxes(vertices)
    points = moves.spans.boxes(moves.new)[rows]
    extents = np.stack([points, _around(points, boxes)], axis=1)
    shifts = end - _times(linear[rows], start)
    for number, row in enumerate(rows):
        (polyline, tolerance), old, by = lines[number], olds[row], float(stretch[row])
        view = CurveView(
            curves[row],
            arrays[row].positions,
            arrays[row],
            curve_map=CurveMap(roots[row], linear[row], shifts[number], by),
            _flattener=old._flattener,
            _cardinals=old._cardinals,
        )
        at = vertices[spans.starts[number] : spans.starts[number] + len(polyline.points)]
        deviation = polyline.deviation if by == 1.0 else polyline.deviation * by
        whole = Polyline(polyline.parameters, at, deviation)
        view.take_over(whole, tolerance * by, boxes[number], extents[number])
        yield row, view


class _Spans:
    """Parts of an array, one after the other."""

    def __init__(self, counts: Sequence[int]) -> None:
        self.counts = np.array(counts)
        self.starts: IntArray = np.concatenate([[0], np.cumsum(self.counts[:-1])])

    def repeated(self, values: FloatArray) -> FloatArray:
        """Return the value of its part for each row of the array."""
        return np.repeat(values, self.counts, axis=0)

    def largest(self, values: FloatArray) -> FloatArray:
        """Return the largest value in each part."""
        return np.maximum.reduceat(values, self.starts)

    def boxes(self, points: FloatArray) -> FloatArray:
        """Return lowest and highest corner of each part of points (m, 2), as (k, 2, 2)."""
        low, high = (ends.reduceat(points, self.starts, axis=0) for ends in (np.minimum, np.maximum))
        return np.stack([low, high], axis=1)


class _Moves:
    """Points of curves, before and now, and the affine maps from their roots."""

    def __init__(
        self,
        curves: Sequence[Curve],
        olds: Sequence[CurveView],
        roots: Sequence[CurveView],
        arrays: Sequence[PointArrays],
    ) -> None:
        self.spans = _Spans([len(values.points) for values in arrays])
        self._old, self.new, self.roots = (
            np.concatenate(values)
            for values in (
                [old.points for old in olds],
                [values.positions for values in arrays],
                [root.points for root in roots],
            )
        )
        self._vectors = _given([old.arrays.given for old in olds], [values.given for values in arrays])
        self._before = np.array([old.curve_map.matrix if old.curve_map else _SAME for old in olds])
        self._tolerances = np.array([line[1] for root in roots if (line := root.whole_line)])
        self._asks = np.array([curve.parametrization.kind.depends_on_points for curve in curves])
        self._rest: BoolArray = np.array(
            [
                now.times is old.arrays.times
                and now.corners is old.arrays.corners
                and now.ties is old.arrays.ties
                for now, old in zip(arrays, olds, strict=True)
            ]
        )
        self._by = np.broadcast_to(_SAME, self._before.shape).copy()

    @property
    def linear(self) -> FloatArray:
        """The linear parts of the maps, (k, 2, 2)."""
        return np.asarray(self._by @ self._before)

    @property
    def stretch(self) -> FloatArray:
        """The largest factor by which each map makes lengths longer, (k,)."""
        linear = self.linear
        # Mostly all are the same, and each norm takes a while.
        distinct = linear[:1] if (linear == linear[0]).all() else linear
        stretches: FloatArray = np.linalg.norm(distinct, 2, axis=(1, 2))
        return np.broadcast_to(stretches, len(linear))

    def find_maps(self) -> BoolArray:
        """Find the maps; return the mask of the curves that were mapped."""
        holds = self._hold()
        remaining = ~holds & self._rest
        if remaining.any():
            self._by[remaining] = self._common(np.repeat(remaining, self.spans.counts))
            holds |= remaining & self._hold()
        return holds

    def _common(self, rows: BoolArray) -> FloatArray:
        """Return the linear map that is nearest to the changes within these curves."""
        starts = self.spans.starts
        old, new = (positions - self.spans.repeated(positions[starts]) for positions in (self._old, self.new))
        solution = np.linalg.lstsq(old[rows], new[rows], rcond=None)[0]
        return np.array(solution.T, dtype=float)

    def _hold(self) -> BoolArray:
        """Return the mask of the curves whose points, and vectors at points, are where the maps put them."""
        linear, stretch, starts = self.linear, self.stretch, self.spans.starts
        offsets = self.new - self.spans.repeated(self.new[starts])
        mapped = _times(self.spans.repeated(linear), self.roots - self.spans.repeated(self.roots[starts]))
        off = self.spans.largest(np.abs(offsets - mapped).max(axis=1))
        tolerance = self._tolerances * stretch
        diagonal = np.linalg.norm(np.subtract(*self.spans.boxes(self.new).swapaxes(0, 1)), axis=1)
        close = np.where(self._asks, np.minimum(tolerance, self._shortest()), tolerance)
        holds: BoolArray = (
            self._rest
            & (off <= _OFF * close)
            & (tolerance <= _FINEST * diagonal)
            & (~self._asks | _keeps_angles(linear))
        )
        return holds & self._vectors_follow() if holds.any() else holds

    def _shortest(self) -> FloatArray:
        """Return the shortest side of the closed polygon through the points of each curve, (k,)."""
        starts = self.spans.starts
        following = np.arange(1, len(self.new) + 1)
        following[starts + self.spans.counts - 1] = starts
        lengths = np.linalg.norm(self.new[following] - self.new, axis=1)
        return np.minimum.reduceat(lengths, starts)

    def _vectors_follow(self) -> BoolArray:
        """Return the mask of the curves whose derivatives that are set were mapped with the points."""
        old, new = self._vectors
        if not old.shape[1]:
            return np.ones(len(self._by), dtype=np.bool_)
        mapped = _times(self.spans.repeated(self._by)[:, None], old)
        same = (np.isnan(old) == np.isnan(new)).all(axis=(1, 2))
        off = np.nan_to_num(np.abs(mapped - new)).max(axis=(1, 2))
        size = np.nan_to_num(np.abs(new)).max(axis=(1, 2))
        follows = self.spans.largest(off) <= _OFF * self.spans.largest(size)
        return np.asarray(follows & (self.spans.largest(~same) == 0))


def _given(curves: Sequence[FloatArray], others: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return the derivatives of points before and after, (m, k, 2) each, without those that no point has."""
    here, there = (np.concatenate(values) for values in (curves, others))
    here, there = (values.reshape(len(here), -1, 2) for values in (here, there))
    is_used = ~(np.isnan(here[..., 0]) & np.isnan(there[..., 0])).all(axis=0)
    return here[:, is_used], there[:, is_used]


def _times(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Return matrices (…, 2, 2) times vectors (…, 2)."""
    # Not by einsum, nor by matmul: they take several times as long for matrices as small as these.
    return matrices[..., 0] * vectors[..., :1] + matrices[..., 1] * vectors[..., 1:]


def _keeps_angles(linear: FloatArray) -> BoolArray:
    """Return the mask of the maps that scale all lengths by the same factor."""
    squares = linear.swapaxes(1, 2) @ linear
    size = squares.max(axis=(1, 2))
    uneven = np.abs(squares[:, 0, 0] - squares[:, 1, 1]) + np.abs(squares[:, 0, 1])
    return np.asarray(uneven <= _OFF * size)


def _around(boxes: FloatArray, others: FloatArray) -> FloatArray:
    """Return the boxes around pairs of boxes, (k, 2, 2)."""
    return np.stack([np.minimum(boxes, others)[:, 0], np.maximum(boxes, others)[:, 1]], axis=1)


# Views of new curves


def views_ahead(
    curves: Sequence[Curve],
    progress: Callable[[float], object],
    originals: Sequence[CurveView | None] = (),
) -> list[CurveView]:
    """Return the views of curves, with polyline and extent, so that drawing them need not wait.

    Parameters
    ----------
    curves
        The document's values.
    progress
        Called with the share of the work that is done; an exception that it raises ends the work.
    originals
        The views of the curves that these are copies of, moved perhaps; None for a curve that is no copy.
    """
    indices = [index for index, view in enumerate(originals) if view is not None]
    lent = views_after([curves[index] for index in indices], [originals[index] for index in indices])
    copies = dict(zip(indices, lent, strict=True))
    views = []
    for index, curve in enumerate(curves):
        progress(index / len(curves))
        view = copies.get(index) or view_of(curve)
        if len(view.points):
            _ = view.extent  # cached by the view, and with it the polyline
        views.append(view)
    return views
