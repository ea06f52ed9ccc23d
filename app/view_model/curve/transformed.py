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
"""Curves from which on arrays of them all are the quicker way."""

_OFF = 1e-8
"""Distance of points from where a map puts them, as a share of the tolerance of the polyline, and of the
distances that parameters are made of. What is rounded is 1e-16 of where a curve lies."""

_FINEST = 1e-3
"""Largest tolerance of a polyline, as a share of the diagonal of the box of the points."""

_SAME, _NO_WAY = np.eye(2), np.zeros(2)

_besides_points = attrgetter(*(name for name in LINE if name != "points"))
_functions = attrgetter("family", "family.curve_class", *(each.rule_field for each in DERIVATIVES))


def views_after(
    curves: Sequence[Curve], before: Sequence[CurveView | None], *, are_moved: bool = False
) -> list[CurveView]:
    """Return the views of curves, which the views before them lend what did not change; see `view_of`.

    `are_moved` where it is known that nothing but places of points is another.
    """
    pairs = [
        (place, curve, old)
        for place, (curve, old) in enumerate(zip(curves, before, strict=True))
        if old is not None
        and (are_moved or _has_other_points_alone(curve, old))
        and _may_be_carried(curve, old)
    ]
    found: dict[int, CurveView] = {}
    if len(pairs) >= _FEWEST:
        places, changed, olds = zip(*pairs, strict=True)
        found = {places[row]: view for row, view in _carried(changed, olds, are_moved=are_moved)}
    return [
        found.get(place) or view_of(curve, old)
        for place, (curve, old) in enumerate(zip(curves, before, strict=True))
    ]


def _has_other_points_alone(curve: Curve, old: CurveView) -> bool:
    """Whether only points are others, as many as before."""
    return len(curve.points) == len(old.points) and all(
        map(is_, _besides_points(curve), _besides_points(old.source))
    )


def _may_be_carried(curve: Curve, old: CurveView) -> bool:
    """Whether a map of the points is one of the curve, whose line is known."""
    return (
        len(curve.points) > 1
        and old.whole_line is not None
        and _is_affine(*_functions(curve))
        and old.is_current
    )


@cache
def _is_affine(family: Family, curve_class: type[ParametricCurve], *rules: EstimateRule) -> bool:
    """Whether an affine map of the points is one of the curve, at the same parameters, but for roundings.

    Functions are to be small and add up to 1: those of a file need not, and one polynomial's are large.
    """
    is_small = family.is_built_in and (curve_class.is_local or not curve_class.interpolates)
    return is_small and all(rule.is_linear for rule in rules[: family.derivatives])


def _carried(
    curves: Sequence[Curve], olds: Sequence[CurveView], *, are_moved: bool
) -> Iterator[tuple[int, CurveView]]:
    """Yield views of those curves that were mapped, each with its place among these."""
    arrays = arrays_of_all(
        [curve.points for curve in curves], [old.arrays for old in olds], are_moved=are_moved
    )
    roots = [old.curve_map.root if old.curve_map else old for old in olds]
    moves = _Moves(curves, olds, roots, arrays)
    moved = moves.found()
    rows = np.flatnonzero(moved).tolist()
    if not rows:
        return
    linear, stretch = moves.linear, moves.stretch
    lines = [line for row in rows if (line := roots[row].whole_line)]
    spans = _Spans([len(line.points) for line, _ in lines])
    start, end = moves.roots[moves.spans.starts[rows]], moves.new[moves.spans.starts[rows]]
    vertices = np.concatenate([line.points for line, _ in lines]) - spans.each(start)
    vertices = _times(spans.each(linear[rows]), vertices) + spans.each(end)
    boxes = spans.boxes(vertices)
    points = moves.spans.boxes(moves.new)[rows]
    extents = np.stack([points, _around(points, boxes)], axis=1)
    shifts = end - _times(linear[rows], start)
    for place, row in enumerate(rows):
        (polyline, tolerance), old, by = lines[place], olds[row], float(stretch[row])
        view = CurveView(
            curves[row],
            arrays[row].positions,
            arrays[row],
            curve_map=CurveMap(roots[row], linear[row], shifts[place], by),
            _flattener=old._flattener,
            _cardinals=old._cardinals,
        )
        at = vertices[spans.starts[place] : spans.starts[place] + len(polyline.points)]
        deviation = polyline.deviation if by == 1.0 else polyline.deviation * by
        whole = Polyline(polyline.parameters, at, deviation)
        view.take_over(whole, tolerance * by, boxes[place], extents[place])
        yield row, view


class _Spans:
    """Parts of an array, one after the other."""

    def __init__(self, counts: Sequence[int]) -> None:
        self.counts = np.array(counts)
        self.starts: IntArray = np.concatenate([[0], np.cumsum(self.counts[:-1])])

    def each(self, values: FloatArray) -> FloatArray:
        """Return the value of its part for each row of the array."""
        repeated: FloatArray = np.repeat(values, self.counts, axis=0)
        return repeated

    def largest(self, values: FloatArray) -> FloatArray:
        """Return the largest value in each part."""
        found: FloatArray = np.maximum.reduceat(values, self.starts)
        return found

    def boxes(self, points: FloatArray) -> FloatArray:
        """Return lowest and highest corner of each part of points (m, 2), as (k, 2, 2)."""
        low, high = (ends.reduceat(points, self.starts, axis=0) for ends in (np.minimum, np.maximum))
        return np.stack([low, high], axis=1)


class _Moves:
    """Ways of points of curves from their roots to where they are, and what map it is."""

    def __init__(
        self,
        curves: Sequence[Curve],
        olds: Sequence[CurveView],
        roots: Sequence[CurveView],
        arrays: Sequence[PointArrays],
    ) -> None:
        self.spans = _Spans([len(each.points) for each in arrays])
        self._old, self.new, self.roots = (
            np.concatenate(each)
            for each in (
                [old.points for old in olds],
                [each.positions for each in arrays],
                [root.points for root in roots],
            )
        )
        self._vectors = _given([old.arrays.given for old in olds], [each.given for each in arrays])
        self._before = np.array([old.curve_map.matrix if old.curve_map else _SAME for old in olds])
        self._tolerances = np.array([line[1] for root in roots if (line := root.whole_line)])
        self._asks = np.array([curve.parametrization.kind.asks_where_points_are for curve in curves])
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
        """The maps of ways, (k, 2, 2)."""
        found: FloatArray = self._by @ self._before
        return found

    @property
    def stretch(self) -> FloatArray:
        """By how much each makes ways longer at most, (k,)."""
        linear = self.linear
        # Of most there is one, and each takes a while.
        own = linear[:1] if (linear == linear[0]).all() else linear
        found: FloatArray = np.linalg.norm(own, 2, axis=(1, 2))
        return np.broadcast_to(found, len(linear))

    def found(self) -> BoolArray:
        """Find the maps; return of which curves they are."""
        are_moved = self._hold()
        rest = ~are_moved & self._rest
        if rest.any():
            self._by[rest] = self._common(np.repeat(rest, self.spans.counts))
            are_moved |= rest & self._hold()
        return are_moved

    def _common(self, rows: BoolArray) -> FloatArray:
        """Return the one map that is nearest to what became of the ways within curves."""
        starts = self.spans.starts
        old, new = (each - self.spans.each(each[starts]) for each in (self._old, self.new))
        solution = np.linalg.lstsq(old[rows], new[rows], rcond=None)[0]
        return np.array(solution.T, dtype=float)

    def _hold(self) -> BoolArray:
        """Whether the maps take the points where they are, and what is tied to points with them."""
        linear, stretch, starts = self.linear, self.stretch, self.spans.starts
        ways = self.new - self.spans.each(self.new[starts])
        mapped = _times(self.spans.each(linear), self.roots - self.spans.each(self.roots[starts]))
        off = self.spans.largest(np.abs(ways - mapped).max(axis=1))
        tolerance = self._tolerances * stretch
        diagonal = np.linalg.norm(np.subtract(*self.spans.boxes(self.new).swapaxes(0, 1)), axis=1)
        close = np.where(self._asks, np.minimum(tolerance, self._shortest()), tolerance)
        found: BoolArray = (
            self._rest
            & (off <= _OFF * close)
            & (tolerance <= _FINEST * diagonal)
            & (~self._asks | _keeps_angles(linear))
        )
        return found & self._vectors_follow() if found.any() else found

    def _shortest(self) -> FloatArray:
        """Return the shortest way from a point of each curve to its next, (k,); around a closed one, too."""
        starts = self.spans.starts
        following = np.arange(1, len(self.new) + 1)
        following[starts + self.spans.counts - 1] = starts
        lengths = np.linalg.norm(self.new[following] - self.new, axis=1)
        found: FloatArray = np.minimum.reduceat(lengths, starts)
        return found

    def _vectors_follow(self) -> BoolArray:
        """Whether the derivatives that are set were mapped with the points."""
        old, new = self._vectors
        if not old.shape[1]:
            return np.ones(len(self._by), dtype=np.bool_)
        mapped = _times(self.spans.each(self._by)[:, None], old)
        same = (np.isnan(old) == np.isnan(new)).all(axis=(1, 2))
        off = np.nan_to_num(np.abs(mapped - new)).max(axis=(1, 2))
        size = np.nan_to_num(np.abs(new)).max(axis=(1, 2))
        found: BoolArray = (self.spans.largest(off) <= _OFF * self.spans.largest(size)) & (
            self.spans.largest(~same) == 0
        )
        return found


def _given(curves: Sequence[FloatArray], others: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return the derivatives of points, (m, k, 2) each, without those that none has, here and there."""
    here, there = (np.concatenate(each) for each in (curves, others))
    here, there = (each.reshape(len(here), -1, 2) for each in (here, there))
    is_used = ~(np.isnan(here[..., 0]) & np.isnan(there[..., 0])).all(axis=0)
    return here[:, is_used], there[:, is_used]


def _times(matrices: FloatArray, ways: FloatArray) -> FloatArray:
    """Return matrices (…, 2, 2) times ways (…, 2)."""
    # Not by einsum, nor by matmul: they take several times as long for matrices as small as these.
    found: FloatArray = matrices[..., 0] * ways[..., :1] + matrices[..., 1] * ways[..., 1:]
    return found


def _keeps_angles(linear: FloatArray) -> BoolArray:
    """Whether maps make all lengths longer by the same factor."""
    squares = linear.swapaxes(1, 2) @ linear
    size = squares.max(axis=(1, 2))
    uneven = np.abs(squares[:, 0, 0] - squares[:, 1, 1]) + np.abs(squares[:, 0, 1])
    found: BoolArray = uneven <= _OFF * size
    return found


def _around(boxes: FloatArray, others: FloatArray) -> FloatArray:
    """Return the boxes around two each, (k, 2, 2)."""
    return np.stack([np.minimum(boxes, others)[:, 0], np.maximum(boxes, others)[:, 1]], axis=1)


def views_ahead(
    curves: Sequence[Curve],
    told: Callable[[float], object],
    originals: Sequence[CurveView | None] = (),
) -> list[CurveView]:
    """Return the views of curves, with what every one of them is asked for when it is first shown.

    Parameters
    ----------
    curves
        The document's values.
    told
        Hears the share that is done; what it raises ends the work.
    originals
        The views of what curves are copies of, moved perhaps; None for those that are none.
    """
    places = [place for place, view in enumerate(originals) if view is not None]
    lent = views_after([curves[place] for place in places], [originals[place] for place in places])
    copies = dict(zip(places, lent, strict=True))
    views = []
    for place, curve in enumerate(curves):
        told(place / len(curves))
        view = copies.get(place) or view_of(curve)
        if len(view.points):
            _ = view.extent  # kept by the view, and with it the polyline that it is made of
        views.append(view)
    return views
