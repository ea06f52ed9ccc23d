"""Where the pieces of contours cross, touch or run along each other.

Pieces are cut where x or y turns back: such arcs are simple, and have one
foot for a place near them. Of two whose boxes meet, the ends near the other
arc are found first. Two arcs that are together between such ends coincide
there, and cross nowhere else, for polynomials that coincide on a stretch
coincide as far as both go. All others are halved until they are straight [1]_,
and Newton's method finishes what is left; where two only touch, it is the
least distance that is looked for, by the method of Levenberg and Marquardt.

References
----------
.. [1] T. W. Sederberg and T. Nishita, "Curve intersection using Bezier
   clipping", Computer-Aided Design 22 (1990) 538-549, section 3: fat lines.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from curvecore.analysis.arc_pairs import Pairs, are_straight, divided_pairs, joined_pairs, may_meet
from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.arcs import Arcs
from curvecore.bezier.bernstein_algebra import derivative, refined_roots, values
from curvecore.regions.outlines import is_small, monotone_arcs
from curvecore.scaling import SMALLEST
from curvecore.vectors import cross

_AT_ONCE = 1 << 11
_ROUNDS = 48
_MOST = 1 << 18  # pairs at a time, of which each is halved: what is beyond is as good as found
_NEWTON, _DAMPED = 10, 24
_ALONG = (np.arange(7) + 1.0) / 8.0


class Meetings(NamedTuple):
    """Places that two pieces have in common.

    Attributes
    ----------
    piece : ndarray of int, shape (k, 2)
        The pieces, perhaps one twice.
    place : ndarray, shape (k, 2)
        Where on each, in [0, 1].
    """

    piece: IntArray
    place: FloatArray

    def taken(self, chosen: BoolArray | IntArray) -> Meetings:
        """Return some of them."""
        return Meetings(self.piece[chosen], self.place[chosen])


_NONE = Meetings(np.zeros((0, 2), dtype=np.intp), np.zeros((0, 2)))


def meetings(
    controls: FloatArray, tolerance: float, progress: Callable[[float], object] = lambda _share: None
) -> Meetings:
    """Return where pieces (n, 4, 2) meet others or themselves, within a tolerance.

    Of what coincides the ends; neighbours meet in their joint, too.
    """
    arcs = monotone_arcs(controls)
    arcs = arcs.taken(~is_small(arcs.controls, tolerance))
    one, other = _boxes_that_meet(arcs, tolerance)
    found, single = [_NONE], [(_NONE, np.zeros(0))]
    for begin in range(0, len(one), _AT_ONCE):
        progress(begin / len(one))
        some = slice(begin, begin + _AT_ONCE)
        pairs = Pairs(arcs.taken(one[some]), arcs.taken(other[some]))
        touches, pair, coincide = _ends_beside(pairs, tolerance)
        found.append(touches.taken(coincide[pair]))
        single.append((touches.taken(~coincide[pair]), np.zeros(len(pair) - int(coincide[pair].sum()))))
        pairs = pairs.taken(~coincide)
        pairs = _straight_pairs(pairs.taken(may_meet(pairs, tolerance / 2.0)), tolerance)
        single.append(_crossings(controls, pairs, tolerance))
    met = Meetings(*(np.concatenate(column) for column in zip(*(each for each, _ in single), strict=True)))
    away = np.concatenate([each for _, each in single])
    found.append(_each_once(controls, met, away, tolerance))
    return Meetings(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _boxes_that_meet(arcs: Arcs, tolerance: float) -> tuple[IntArray, IntArray]:
    """Return the pairs of arcs, the earlier first, whose boxes are not farther apart than that."""
    low, high = arcs.controls.min(axis=1) - tolerance, arcs.controls.max(axis=1)
    order = np.argsort(low[:, 0], kind="stable")
    low, high = low[order], high[order]
    # Sorted by where they begin, those that an arc meets along x follow it without a gap.
    count = np.searchsorted(low[:, 0], high[:, 0], side="right") - np.arange(len(low)) - 1
    parts = [np.zeros((2, 0), dtype=np.intp)]
    for begin in range(0, len(low), _AT_ONCE):
        rows = np.arange(begin, min(begin + _AT_ONCE, len(low)))
        one = np.repeat(rows, count[rows])
        start = np.repeat(np.cumsum(count[rows]) - count[rows], count[rows])
        other = one + 1 + np.arange(len(one)) - start
        meet = (low[one, 1] <= high[other, 1]) & (low[other, 1] <= high[one, 1])
        parts.append(np.stack((one[meet], other[meet])))
    both = np.sort(order[np.concatenate(parts, axis=1)], axis=0)
    return both[0], both[1]


def _ends_beside(pairs: Pairs, tolerance: float) -> tuple[Meetings, IntArray, BoolArray]:
    """Return the ends of monotone arcs that lie on the other arc, and of which pair each is.

    And which pairs coincide between two such ends.
    """
    a, b = pairs.first.controls, pairs.second.controls
    count = len(a)
    ends = [(b, a[:, 0]), (b, a[:, -1]), (a, b[:, 0]), (a, b[:, -1])]
    place, away = np.zeros((4, count)), np.full((4, count), np.inf)
    for row, (arc, end) in enumerate(ends):
        outside = np.maximum(arc.min(axis=1) - end, end - arc.max(axis=1)).max(axis=1)
        near = np.flatnonzero(outside <= tolerance)
        place[row, near], away[row, near] = _feet(arc[near], end[near])
    on = away <= tolerance
    starts, stops = np.zeros(count), np.ones(count)
    on_first = np.stack([starts, stops, place[2], place[3]])
    on_second = np.stack([place[0], place[1], starts, stops])
    first, second = np.where(on, on_first, np.inf).min(axis=0), np.where(on, on_first, -np.inf).max(axis=0)
    coincide = np.zeros(count, dtype=bool)
    several = np.flatnonzero(on.sum(axis=0) > 1)
    coincide[several] = _are_together(a[several], b[several], first[several], second[several], tolerance)
    which, pair = np.nonzero(on)
    at = np.stack((on_first[which, pair], on_second[which, pair]), axis=1)
    return _meetings_of(pairs.taken(pair), at), pair, coincide


def _are_together(
    a: FloatArray, b: FloatArray, first: FloatArray, second: FloatArray, tolerance: float
) -> BoolArray:
    """Tell which arcs b follow arcs a from one place of these to another, on a stretch that has a length."""
    places = first + (second - first) * np.concatenate([[0.0], _ALONG, [1.0]])[:, None]
    way = np.stack([values(a, each) for each in places])
    together: BoolArray = np.ptp(way, axis=0).max(axis=1) > 4.0 * tolerance
    for each in way[1:-1]:
        left = np.flatnonzero(together)
        together[left] = _feet(b[left], each[left])[1] <= 2.0 * tolerance
    return together


def _feet(arcs: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return where on monotone arcs (k, 4, 2) the places next to points (k, 2) are, and how far away.

    Right where a point lies near its arc: the way along the chord only grows on it.
    """
    offset = arcs - points[:, None]
    chord = arcs[:, -1] - arcs[:, 0]
    along = (offset * chord[:, None]).sum(axis=2)
    place = refined_roots(along, np.ones(len(arcs), dtype=bool), 2.0**-36)
    away = np.hypot(*values(offset, place).T)
    slopes = derivative(offset)
    for _ in range(3):
        at, slope = values(offset, place), values(slopes, place)
        step = (at * slope).sum(axis=1) / np.maximum(np.square(slope).sum(axis=1), SMALLEST)
        nearer = np.clip(place - step, 0.0, 1.0)
        distance = np.hypot(*values(offset, nearer).T)
        better = distance < away
        place, away = np.where(better, nearer, place), np.where(better, distance, away)
    return place, away


def _straight_pairs(pairs: Pairs, tolerance: float) -> Pairs:
    """Halve arcs until they are straight; return those that may meet."""
    done = [pairs.taken(np.zeros(0, dtype=np.intp))]
    for _ in range(_ROUNDS):
        fine = are_straight(pairs.first, tolerance) & are_straight(pairs.second, tolerance)
        done.append(pairs.taken(fine))
        pairs = pairs.taken(~fine)
        if not len(pairs) or len(pairs) > _MOST:
            break
        pairs = divided_pairs(pairs, tolerance / 2.0)
    return joined_pairs([*done, pairs])


def _crossings(controls: FloatArray, pairs: Pairs, tolerance: float) -> tuple[Meetings, FloatArray]:
    """Return where straight arcs of pieces meet, as exactly as these say it, and how far they are apart."""
    p, q = pairs.first.controls[:, 0], pairs.second.controls[:, 0]
    u, v = pairs.first.controls[:, -1] - p, pairs.second.controls[:, -1] - q
    with np.errstate(all="ignore"):
        shares = np.stack((cross(q - p, v), cross(q - p, u)), axis=1) / cross(u, v)[:, None]
    shares = np.clip(np.nan_to_num(shares, nan=0.5, posinf=1.0, neginf=0.0), 0.0, 1.0)
    start = np.stack((pairs.first.start, pairs.second.start), axis=1)
    width = np.stack((pairs.first.end, pairs.second.end), axis=1) - start
    piece = np.floor(start).astype(np.intp)
    place = np.clip(start + shares * width - piece, 0.0, 1.0)
    place, away = _polished(controls[piece[:, 0]], controls[piece[:, 1]], place, width)
    met = Meetings(piece, place)
    true = away <= tolerance
    true[true] = ~_is_one_place(controls, met.taken(true), tolerance)
    return met.taken(true), away[true]


def _each_once(controls: FloatArray, met: Meetings, away: FloatArray, tolerance: float) -> Meetings:
    """Return one place of each meeting, the nearest: where pieces touch they are together for a while."""
    order = np.lexsort((away, met.place[:, 1], met.place[:, 0], met.piece[:, 1], met.piece[:, 0]))
    met, away = met.taken(order), away[order]
    one, other = met.taken(np.arange(len(away) - 1)), met.taken(np.arange(1, len(away)))
    same = np.flatnonzero((one.piece == other.piece).all(axis=1))
    (a, b), start = one.piece[same].T, one.place[same]
    way = other.place[same] - start
    joined = np.ones(len(same), dtype=bool)
    for share in _ALONG:
        place = start + share * way
        gap = values(controls[a], place[:, 0]) - values(controls[b], place[:, 1])
        joined &= np.hypot(*gap.T) <= 2.0 * tolerance
    begins = np.ones(len(away), dtype=bool)
    begins[same[joined] + 1] = False
    group = np.cumsum(begins)
    best = np.lexsort((away, group))
    return met.taken(best[np.unique(group[best], return_index=True)[1]])


def _meetings_of(pairs: Pairs, shares: FloatArray) -> Meetings:
    """Return what lies at shares (k, 2) of the arcs."""
    start = np.stack((pairs.first.start, pairs.second.start), axis=1)
    width = np.stack((pairs.first.end, pairs.second.end), axis=1) - start
    piece = np.floor(start).astype(np.intp)
    return Meetings(piece, np.clip(start - piece + shares * width, 0.0, 1.0))


def _is_one_place(controls: FloatArray, met: Meetings, tolerance: float) -> BoolArray:
    """Tell of which meetings of a piece with itself both places are the same one."""
    same = met.piece[:, 0] == met.piece[:, 1]
    low, high = met.place.min(axis=1)[same], met.place.max(axis=1)[same]
    way = np.stack([values(controls[met.piece[same, 0]], low + (high - low) * each) for each in _ALONG])
    result = np.zeros(len(same), dtype=bool)
    result[same] = np.abs(way - values(controls[met.piece[same, 0]], low)).max(axis=(0, 2), initial=0.0) <= (
        4.0 * tolerance
    )
    return result


def _polished(
    a: FloatArray, b: FloatArray, place: FloatArray, width: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return where pieces are together, or nearest to each other, and how far apart they are there."""
    # A step that leaves the neighbourhood belongs to another meeting, which has a pair of its own.
    low = np.clip(place - 64.0 * width, 0.0, 1.0)
    high = np.clip(place + 64.0 * width, 0.0, 1.0)
    slopes = derivative(a), derivative(b)
    gap = values(a, place[:, 0]) - values(b, place[:, 1])
    away, damping = np.hypot(*gap.T), np.full(len(a), 1e-3)
    for step in range(_NEWTON + _DAMPED):
        ahead, other = values(slopes[0], place[:, 0]), values(slopes[1], place[:, 1])
        if step < _NEWTON:
            turn = cross(ahead, other)[:, None]
            with np.errstate(all="ignore"):
                move = np.stack((cross(gap, other), cross(gap, ahead)), axis=1) / -turn
        else:
            move = _damped(gap, ahead, other, damping)
        moved = np.clip(place + np.nan_to_num(move, posinf=0.0, neginf=0.0), low, high)
        found = values(a, moved[:, 0]) - values(b, moved[:, 1])
        distance = np.hypot(*found.T)
        better = distance < away
        if not better.any() and step >= _NEWTON + 4:
            break
        place, gap = np.where(better[:, None], moved, place), np.where(better[:, None], found, gap)
        away, damping = np.where(better, distance, away), np.where(better, damping / 8.0, damping * 8.0)
    return place, away


def _damped(gap: FloatArray, ahead: FloatArray, other: FloatArray, damping: FloatArray) -> FloatArray:
    """Return a step of the method of Levenberg and Marquardt towards the least gap."""
    aa, bb, ab = ((x * y).sum(axis=1) for x, y in ((ahead, ahead), (other, other), (ahead, other)))
    ga, gb = (gap * ahead).sum(axis=1), (gap * other).sum(axis=1)
    aa, bb = aa * (1.0 + damping) + SMALLEST, bb * (1.0 + damping) + SMALLEST
    with np.errstate(all="ignore"):
        step: FloatArray = (
            np.stack((ab * gb - bb * ga, aa * gb - ab * ga), axis=1) / (aa * bb - ab * ab)[:, None]
        )
    return step
