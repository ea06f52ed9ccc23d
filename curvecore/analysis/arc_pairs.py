"""Pairs of arcs of plane curves that may meet: the search behind `self_intersections`.

Pairs whose boxes are apart, along the axes or along either chord, are
dropped; the rest are halved until both arcs are straight within a part of the
tolerance. An arc whose directions lie in an open half plane does not meet
itself, and two such neighbours, taken together, meet at their common end
only; these are dropped as well [1]_.

Boxes along the chord are as thin as the arc is straight: windings of a spiral,
side by side, come apart at once [2]_. For the same reason arcs that touch need
not be halved down to the tolerance, only to its square root.

References
----------
.. [1] T. W. Sederberg and R. J. Meyers, "Loop detection in surface patch
   intersections", Computer Aided Geometric Design 5 (1988) 161-171; for a
   curve with itself: D. Lasser, "Calculating the self-intersections of
   Bezier curves", Computers in Industry 12 (1989) 259-268.
.. [2] T. W. Sederberg and T. Nishita, "Curve intersection using Bezier
   clipping", Computer-Aided Design 22 (1990) 538-549, section 3: fat lines.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import SMALLEST, along_last, vector_lengths
from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.arcs import Arcs, joined_arcs
from curvecore.bezier.bernstein_algebra import derivative

_ROUNDS = 48
_ARCS = 1 << 11
_PAIRS = 1 << 14  # at a time; where a curve runs along itself, no number is enough
_WORK = 1 << 17  # pairs in all
_FEW = 64  # pairs, up to which a round takes as long for quarters as for halves
_AT_ONCE = 1 << 13  # pairs tested together
_STRAIGHT = 1 / 8  # of the tolerance


class Pairs(NamedTuple):
    """Pairs of arcs; the first comes first in t."""

    first: Arcs
    second: Arcs

    def taken(self, chosen: BoolArray | IntArray) -> Pairs:
        """Return some of the pairs."""
        return Pairs(self.first.taken(chosen), self.second.taken(chosen))

    def __len__(self) -> int:
        """Return how many pairs there are."""
        return len(self.first.start)


def simple_arcs(arcs: Arcs, small: float) -> tuple[Arcs, bool]:
    """Halve arcs until each keeps its direction within a half plane, or is small.

    Returns them in order, and whether that was reached within the bounds of the work.
    """
    done: list[Arcs] = []
    count = 0
    is_complete = True
    for step in range(_ROUNDS):
        fine = _within_half_plane(derivative(arcs.controls)) | (_extent(arcs.controls) <= small)
        count += int(fine.sum())
        if step == _ROUNDS - 1 or count + 2 * int((~fine).sum()) > max(_ARCS, 4 * len(arcs.start)):
            is_complete = bool(fine.all())
            fine[:] = True
        done.append(arcs.taken(fine))
        if fine.all():
            break
        arcs = arcs.taken(~fine).halved()
    together = joined_arcs(done)
    return together.taken(np.argsort(together.start, kind="stable")), is_complete


def close_pairs(arcs: Arcs, small: float, margin: float) -> tuple[Pairs, bool]:
    """Return pairs of straight arcs that may meet, and whether the search ended by itself.

    Parameters
    ----------
    arcs
        All of a curve, in order, from `simple_arcs`.
    small
        The tolerance, in the units of the control points.
    margin
        What the arcs may be off, each.
    """
    pairs, is_complete = _first_pairs(arcs, margin)
    done: list[Pairs] = []
    work = 0
    for _ in range(_ROUNDS):
        straight = _are_straight(pairs.first, small) & _are_straight(pairs.second, small)
        adjoining = _adjoining(pairs)
        # Two straight neighbours may still form the tip of a loop.
        tiny = np.maximum(_extent(pairs.first.controls), _extent(pairs.second.controls)) <= small
        fine = np.where(adjoining, tiny, straight)
        done.append(pairs.taken(fine & ~adjoining))
        pairs = pairs.taken(~fine)
        if not len(pairs):
            return _joined_pairs(done), is_complete
        work += len(pairs)
        if len(pairs) > _PAIRS or work > max(_WORK, 64 * len(arcs.start)):
            break
        pairs = _divided_pairs(pairs, margin)
    return _joined_pairs([*done, pairs.taken(~_adjoining(pairs))]), False


def _first_pairs(arcs: Arcs, margin: float) -> tuple[Pairs, bool]:
    """Return the pairs of arcs that may meet."""
    low, high = arcs.controls.min(axis=1) - margin, arcs.controls.max(axis=1) + margin
    most = max(_PAIRS, 4 * len(low))
    found: list[Pairs] = [
        Pairs(arcs.taken(np.zeros(0, dtype=np.intp)), arcs.taken(np.zeros(0, dtype=np.intp)))
    ]
    waiting: list[tuple[IntArray, IntArray]] = []
    count = total = 0
    last = len(low) - 2
    for i in range(last + 1):
        meet = ((low[i] <= high[i + 1 :]) & (low[i + 1 :] <= high[i])).all(axis=1)
        others = np.flatnonzero(meet) + (i + 1)
        waiting.append((np.full(len(others), i), others))
        count += len(others)
        if count > _AT_ONCE or i == last:
            first, second = (np.concatenate(column) for column in zip(*waiting, strict=True))
            pairs = Pairs(arcs.taken(first), arcs.taken(second))
            found.append(pairs.taken(_may_meet(pairs, margin)))
            waiting, count, total = [], 0, total + len(found[-1])
            if total > most:
                return _joined_pairs(found), i == last
    return _joined_pairs(found), True


def _divided_pairs(pairs: Pairs, margin: float) -> Pairs:
    """Return the pairs of parts that may meet: of halves, and while pairs are few of quarters."""
    count = 4 if len(pairs) <= _FEW else 2
    which = np.arange(count)
    parts = []
    for begin in range(0, len(pairs), _AT_ONCE):
        some = pairs.taken(np.arange(begin, min(begin + _AT_ONCE, len(pairs))))
        left, right = some.first.divided(count), some.second.divided(count)
        origin = count * np.repeat(np.arange(len(some)), count * count)
        each = Pairs(
            left.taken(origin + np.tile(np.repeat(which, count), len(some))),
            right.taken(origin + np.tile(which, count * len(some))),
        )
        parts.append(each.taken(_may_meet(each, margin)))
    return _joined_pairs(parts)


def _joined_pairs(parts: list[Pairs]) -> Pairs:
    """Return the pairs of all parts."""
    return Pairs(joined_arcs([part.first for part in parts]), joined_arcs([part.second for part in parts]))


def _extent(controls: FloatArray) -> FloatArray:
    extent: FloatArray = np.ptp(controls, axis=1).max(axis=1)
    return extent


def _are_straight(arcs: Arcs, small: float) -> BoolArray:
    """Tell which arcs stay within an eighth of a distance of their chords, run through evenly."""
    degree = arcs.controls.shape[1] - 1
    if degree < 2:
        return np.ones(len(arcs.start), dtype=bool)
    bend = vector_lengths(np.diff(arcs.controls, n=2, axis=1)).max(axis=1)
    straight: BoolArray = bend * (degree * (degree - 1) / 8.0) <= _STRAIGHT * small
    return straight


def _within_half_plane(slopes: FloatArray) -> BoolArray:
    size = vector_lengths(slopes)
    divisor = np.maximum(size, SMALLEST)
    x, y = slopes[..., 0], slopes[..., 1]
    mean_x, mean_y = (along_last(np.add, each / divisor)[:, None] for each in (x, y))
    # A slope of 0, at a point at rest, turns nowhere.
    ahead = (x * mean_x + y * mean_y > 0.0) | (size == 0.0)
    within: BoolArray = ahead.all(axis=1) & (size > 0.0).any(axis=1)
    return within


def _adjoining(pairs: Pairs) -> BoolArray:
    touching: BoolArray = (pairs.first.end == pairs.second.start) & (
        pairs.first.controls[:, -1] == pairs.second.controls[:, 0]
    ).all(axis=1)
    return touching


def _may_meet(pairs: Pairs, margin: float) -> BoolArray:
    """Tell of which pairs the arcs may come nearer than twice the margin; not where they only adjoin."""
    a, b = pairs.first.controls, pairs.second.controls
    meet = _overlap(a[..., 0], b[..., 0], 2.0 * margin) & _overlap(a[..., 1], b[..., 1], 2.0 * margin)
    for controls in (a, b):
        chord = controls[:, -1] - controls[:, 0]
        unit = chord / np.maximum(vector_lengths(chord), SMALLEST)[:, None]
        x, y = unit[:, :1], unit[:, 1:]
        meet &= _overlap_along(a, b, x, y, margin)
        meet &= _overlap_along(a, b, -y, x, margin)
    slopes = np.concatenate([derivative(a), derivative(b)], axis=1)
    return meet & ~(_adjoining(pairs) & _within_half_plane(slopes))


def _overlap_along(a: FloatArray, b: FloatArray, x: FloatArray, y: FloatArray, margin: float) -> BoolArray:
    """Tell which pairs of arcs overlap along the axis (x, y); a few roundings apart still counts."""
    one, other = (each[..., 0] * x + each[..., 1] * y for each in (a, b))
    largest = along_last(np.maximum, np.abs(one)) + along_last(np.maximum, np.abs(other))
    return _overlap(one, other, 2.0 * margin + 2.0**-50 * largest)


def _overlap(one: FloatArray, other: FloatArray, room: FloatArray | float) -> BoolArray:
    """Tell which rows of two arrays overlap as intervals, or are no farther apart than `room`."""
    low, high = along_last(np.minimum, one), along_last(np.maximum, one)
    overlap: BoolArray = (low - room <= along_last(np.maximum, other)) & (
        along_last(np.minimum, other) - room <= high
    )
    return overlap
