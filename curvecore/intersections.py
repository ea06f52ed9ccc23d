"""Where a plane curve crosses itself.

Pairs of pieces whose boxes do not meet are dropped, the rest are halved. A
piece whose directions lie in an open half plane does not meet itself, and two
such neighbours, taken together, meet at their common end only; these are
dropped as well [1]_. What stays shrinks to the crossings, which Newton's
method then finishes.

References
----------
.. [1] T. W. Sederberg and R. J. Meyers, "Loop detection in surface patch
   intersections", Computer Aided Geometric Design 5 (1988) 161-171; for a
   curve with itself: D. Lasser, "Calculating the self-intersections of
   Bezier curves", Computers in Industry 12 (1989) 259-268.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray, tolerance_value
from curvecore.bernstein_algebra import derivative, subdivided
from curvecore.curve import Curve
from curvecore.errors import CurveError
from curvecore.geometry import lengths
from curvecore.pieces import bezier_pieces, size_of

__all__ = ["SelfIntersections", "self_intersections"]

_ROUNDS = 48
_ARCS = 1 << 11
_PAIRS = 1 << 12  # at a time; where a curve runs along itself, no number is enough
_WORK = 1 << 15  # pairs in all
_CANDIDATES = 1 << 9
_NEWTON = 12


class SelfIntersections(NamedTuple):
    """Where a curve crosses or touches itself.

    Attributes
    ----------
    parameters : ndarray, shape (k, 2)
        Pairs with c(a) = c(b), a < b, ascending in a.
    points : ndarray, shape (k, 2)
        c there.
    is_complete : bool
        Whether the search ended by itself. It does not where the curve runs
        along itself, which is a stretch of crossings and not one.
    """

    parameters: FloatArray
    points: FloatArray
    is_complete: bool


class _Arcs(NamedTuple):
    controls: FloatArray
    start: FloatArray
    end: FloatArray


def self_intersections(curve: Curve, tolerance: float) -> SelfIntersections:
    """Return the pairs of parameters at which a curve meets itself.

    Parameters
    ----------
    curve : Curve
        Plane (dim 2).
    tolerance : float
        Largest distance of c(a) and c(b), above 0, in units of the points.
        Loops smaller than this may be missed, near misses may be reported.

    Returns
    -------
    SelfIntersections
        The ends of a closed curve, which meet anyway, are left out.

    Raises
    ------
    CurveError
        If the curve is not plane or the tolerance not positive.

    Notes
    -----
    The work is bounded: at most 32768 pairs of pieces are looked at, and 512
    candidates finished.
    """
    limit = tolerance_value(tolerance)
    if curve.points.shape[1] != 2:
        raise CurveError(f"curve must be plane (dim 2) to cross itself, not of dim {curve.points.shape[1]}")
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        size = max(size_of(curve.points), float(np.finfo(float).tiny))
        pieces = bezier_pieces(curve, min(1e-3, 0.1 * limit / size))
        small = max(float(np.ldexp(limit, -pieces.exponent)), 2.0**-44)
        arcs, simple = _simple_arcs(_Arcs(pieces.controls, pieces.starts, pieces.ends), small)
        margin = min(4.0 * float(pieces.error.max()), small / 8.0)
        first, second, is_complete = _pairs(arcs, margin)
        pairs, ended = _shrunk(arcs, first, second, small, margin)
        ended &= len(pairs.first.start) <= _CANDIDATES
        found = _finished(curve, pairs, limit)
    points = curve.evaluate(found[:, 0]) if len(found) else np.zeros((0, 2))
    return SelfIntersections(found, points, simple and is_complete and ended)


def _halved(arcs: _Arcs) -> _Arcs:
    middle = 0.5 * arcs.start + 0.5 * arcs.end
    return _Arcs(
        subdivided(arcs.controls),
        np.stack((arcs.start, middle), axis=1).ravel(),
        np.stack((middle, arcs.end), axis=1).ravel(),
    )


def _take(arcs: _Arcs, chosen: BoolArray | IntArray) -> _Arcs:
    return _Arcs(arcs.controls[chosen], arcs.start[chosen], arcs.end[chosen])


def _extent(controls: FloatArray) -> FloatArray:
    extent: FloatArray = np.ptp(controls, axis=1).max(axis=1)
    return extent


def _within_half_plane(slopes: FloatArray) -> BoolArray:
    size = lengths(slopes)
    mean = (slopes / np.maximum(size, np.finfo(float).tiny)[..., None]).sum(axis=1, keepdims=True)
    # A slope of 0, at a point at rest, turns nowhere.
    ahead = ((slopes * mean).sum(axis=2) > 0.0) | (size == 0.0)
    within: BoolArray = ahead.all(axis=1) & (size > 0.0).any(axis=1)
    return within


def _simple_arcs(arcs: _Arcs, small: float) -> tuple[_Arcs, bool]:
    """Halve arcs until each keeps its direction within a half plane, or is small."""
    done: list[_Arcs] = []
    count = 0
    is_complete = True
    for step in range(_ROUNDS):
        fine = _within_half_plane(derivative(arcs.controls)) | (_extent(arcs.controls) <= small)
        count += int(fine.sum())
        if step == _ROUNDS - 1 or count + 2 * int((~fine).sum()) > max(_ARCS, 2 * len(arcs.start)):
            is_complete = bool(fine.all())
            fine[:] = True
        done.append(_take(arcs, fine))
        if fine.all():
            break
        arcs = _halved(_take(arcs, ~fine))
    order = np.argsort(np.concatenate([each.start for each in done]), kind="stable")
    together = _Arcs(*(np.concatenate(column) for column in zip(*done, strict=True)))
    return _take(together, order), is_complete


def _pairs(arcs: _Arcs, margin: float) -> tuple[IntArray, IntArray, bool]:
    """Return the pairs of arcs whose boxes meet or almost do, first < second."""
    low, high = arcs.controls.min(axis=1) - margin, arcs.controls.max(axis=1)
    firsts, seconds = [], []
    total = 0
    for i in range(len(low) - 1):
        meet = ((low[i] <= high[i + 1 :]) & (low[i + 1 :] <= high[i])).all(axis=1)
        others = np.flatnonzero(meet) + (i + 1)
        firsts.append(np.full(len(others), i))
        seconds.append(others)
        total += len(others)
        if total > _PAIRS:
            break
    if not firsts:
        return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp), True
    return np.concatenate(firsts), np.concatenate(seconds), total <= _PAIRS


class _Pairs(NamedTuple):
    first: _Arcs
    second: _Arcs


def _shrunk(
    arcs: _Arcs, first: IntArray, second: IntArray, small: float, margin: float
) -> tuple[_Pairs, bool]:
    """Halve pairs until both arcs are small."""
    pairs = _Pairs(_take(arcs, first), _take(arcs, second))
    done: list[_Pairs] = []
    work = 0
    for _ in range(_ROUNDS):
        pairs = _chosen(pairs, _may_meet(pairs, margin))
        extent = np.maximum(_extent(pairs.first.controls), _extent(pairs.second.controls))
        fine = extent <= small
        done.append(_chosen(pairs, fine & ~_adjoining(pairs)))
        pairs = _chosen(pairs, ~fine)
        if not len(pairs.first.start):
            return _together(done), True
        work += len(pairs.first.start)
        if len(pairs.first.start) > _PAIRS or work > _WORK:
            break
        left, right = _halved(pairs.first), _halved(pairs.second)
        first_half = 2 * np.repeat(np.arange(len(pairs.first.start)), 4)
        a = first_half + np.tile([0, 0, 1, 1], len(pairs.first.start))
        b = first_half + np.tile([0, 1, 0, 1], len(pairs.first.start))
        pairs = _Pairs(_take(left, a), _take(right, b))
    return _together([*done, _chosen(pairs, ~_adjoining(pairs))]), False


def _chosen(pairs: _Pairs, which: BoolArray) -> _Pairs:
    return _Pairs(_take(pairs.first, which), _take(pairs.second, which))


def _together(parts: list[_Pairs]) -> _Pairs:
    def joined(arcs: list[_Arcs]) -> _Arcs:
        return _Arcs(*(np.concatenate(column) for column in zip(*arcs, strict=True)))

    return _Pairs(joined([part.first for part in parts]), joined([part.second for part in parts]))


def _adjoining(pairs: _Pairs) -> BoolArray:
    touching: BoolArray = (pairs.first.end == pairs.second.start) & (
        pairs.first.controls[:, -1] == pairs.second.controls[:, 0]
    ).all(axis=1)
    return touching


def _may_meet(pairs: _Pairs, margin: float) -> BoolArray:
    a, b = pairs.first.controls, pairs.second.controls
    boxes = (a.min(axis=1) - margin <= b.max(axis=1)) & (b.min(axis=1) - margin <= a.max(axis=1))
    slopes = np.concatenate([derivative(a), derivative(b)], axis=1)
    meet: BoolArray = boxes.all(axis=1) & ~(_adjoining(pairs) & _within_half_plane(slopes))
    return meet


def _finished(curve: Curve, pairs: _Pairs, tolerance: float) -> FloatArray:
    """Polish candidates, keep those that meet, drop repetitions."""
    count = len(pairs.first.start)
    if count > _CANDIDATES:
        chosen = np.zeros(count, dtype=bool)
        chosen[np.linspace(0, count - 1, _CANDIDATES).astype(np.intp)] = True
        pairs = _chosen(pairs, chosen)
    a = 0.5 * pairs.first.start + 0.5 * pairs.first.end
    b = 0.5 * pairs.second.start + 0.5 * pairs.second.end
    if not len(a):
        return np.zeros((0, 2))
    domain = curve.domain
    best_a, best_b = a, b
    best = lengths(curve.evaluate(a) - curve.evaluate(b))
    for _ in range(_NEWTON):
        gap = curve.evaluate(b) - curve.evaluate(a)
        forward, backward = curve.evaluate(a, 1), curve.evaluate(b, 1)
        cross = forward[:, 0] * backward[:, 1] - forward[:, 1] * backward[:, 0]
        step_a = (gap[:, 0] * backward[:, 1] - gap[:, 1] * backward[:, 0]) / cross
        step_b = (gap[:, 0] * forward[:, 1] - gap[:, 1] * forward[:, 0]) / cross
        usable = np.isfinite(step_a) & np.isfinite(step_b)
        a = np.clip(np.where(usable, a + step_a, a), *domain)
        b = np.clip(np.where(usable, b + step_b, b), *domain)
        distance = lengths(curve.evaluate(a) - curve.evaluate(b))
        better = distance < best
        # A step that leaves the neighbourhood belongs to another crossing, which has a pair of its own.
        width = 64.0 * (pairs.first.end - pairs.first.start + pairs.second.end - pairs.second.start)
        better &= np.abs(a - best_a) + np.abs(b - best_b) <= width
        best_a, best_b = np.where(better, a, best_a), np.where(better, b, best_b)
        best = np.where(better, distance, best)
        if not better.any():
            break
    ordered = np.sort(np.stack((best_a, best_b), axis=1), axis=1)
    found = _Found(ordered, best, pairs.first.end - pairs.first.start)
    return _distinct(curve, found, tolerance)


class _Found(NamedTuple):
    """Candidates: parameters (k, 2), distances (k,) and how long their arcs were (k,)."""

    parameters: FloatArray
    gap: FloatArray
    width: FloatArray


def _distinct(curve: Curve, found: _Found, tolerance: float) -> FloatArray:
    """Keep the best of each cluster of candidates, and no ends of closed curves."""
    first, last = curve.domain
    span = last - first
    a, b = found.parameters.T
    middle = curve.evaluate(0.5 * a + 0.5 * b)
    # Two parameters with no loop between them are one place, and so are the ends of a closed curve.
    usable = (found.gap <= tolerance) & (lengths(middle - curve.evaluate(a)) > 2.0 * tolerance)
    usable &= (a - first > 1e-6 * span) | (last - b > 1e-6 * span)
    order = np.flatnonzero(usable)[np.argsort(a[usable], kind="stable")]
    clusters: list[list[int]] = []
    for i in order:
        reach = 4.0 * found.width[i] + 1e-9 * span
        for cluster in reversed(clusters[-16:]):
            if a[i] - a[cluster[-1]] <= reach and np.abs(b[cluster[-64:]] - b[i]).min() <= reach:
                cluster.append(int(i))
                break
        else:
            clusters.append([int(i)])
    best = [min(cluster, key=lambda i: float(found.gap[i])) for cluster in clusters]
    result: FloatArray = found.parameters[best].reshape(-1, 2)
    return result[np.lexsort((result[:, 1], result[:, 0]))]
