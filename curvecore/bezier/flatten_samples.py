"""Polylines of curves without Bezier pieces: sampled, and refined where they leave their chords."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.control_points import all_joints, equal_parts, sorted_distinct, spread
from curvecore.bezier.polylines import MAX_VERTICES, Pieces, may_enter, points_at
from curvecore.families.curve import ParametricCurve
from curvecore.parametrization import chebyshev

_MOST_WORK = 1 << 22  # vertices times points of a polynomial: a curve too wild to be followed is done in time
_ROUNDS = 20
_FIRST = 8  # pieces between neighbouring points of what is no polynomial
_SAMPLES = np.array([0.25, 0.5, 0.75])
_WILD = 1e6  # tolerances: the bend of a piece that needs thousands of vertices
_MARGIN = 1.25  # on a measured distance, for what lies between the samples


def sampled_pieces(curve: ParametricCurve, tolerance: float, box: FloatArray | None) -> Pieces:
    """Sample for the degree, then refine the pieces that leave their chords."""
    n = len(curve.parameters)
    most = min(MAX_VERTICES, max(4 * n, _MOST_WORK // n))
    t = _first_samples(curve)
    points = points_at(curve, t)
    bend, enters = _bends(t, points), _enters(points, box)
    if int(np.count_nonzero(enters & (bend > _WILD * tolerance))) > most - t.size:
        # There is not one vertex for each: what would be measured between the samples would change none.
        return Pieces(t, points, np.where(enters, _MARGIN * 0.25 * bend, np.inf))
    deviation = np.zeros(t.size - 1)
    todo = np.arange(t.size - 1)
    for _ in range(_ROUNDS):
        count = np.ones(t.size - 1, dtype=np.intp)
        deviation[todo], count[todo] = _measure(curve, t, points, todo, tolerance, box)
        wanted, room = int((count - 1).sum()), most - t.size
        if wanted > room:
            count = 1 + (count - 1) * max(room, 0) // wanted
        if count.max() == 1:
            break
        t, points, deviation, todo = _refine(curve, t, points, deviation, count)
        if wanted > room:
            # What was reached with what there is.
            deviation[todo], _ = _measure(curve, t, points, todo, tolerance, box)
            break
    return Pieces(t, points, deviation)


def _first_samples(curve: ParametricCurve) -> FloatArray:
    """Joints, and Chebyshev-like parameters that resolve any polynomial of the degree.

    Of what is no polynomial, a few between neighbouring joints.
    """
    first, last = curve.domain
    joints = all_joints(curve)
    if curve.degree is None:
        return spread(joints, np.full(len(joints) - 1, _FIRST))
    count = 2 * curve.degree
    s = first + (last - first) * chebyshev(count + 1)[1:-1]
    # What all but coincides with a joint tells nothing that the joint does not.
    after = np.clip(np.searchsorted(joints, s), 1, len(joints) - 1)
    away = np.minimum(np.abs(s - joints[after - 1]), np.abs(s - joints[after]))
    room = np.diff(np.concatenate(([first], s, [last])))
    s = s[away > 0.05 * np.minimum(room[:-1], room[1:])]
    return sorted_distinct(np.concatenate((joints, s)))


def _bends(t: FloatArray, points: FloatArray) -> FloatArray:
    """Return how far pieces are from going on as their neighbours do, (k,)."""
    step, h = np.diff(points, axis=0), np.diff(t)
    quotient = (h[1:] / h[:-1])[:, None]
    change = np.hypot(*(step[1:] / np.maximum(quotient, 1.0) - step[:-1] * np.minimum(quotient, 1.0)).T)
    bends: FloatArray = np.maximum(np.append(change, 0.0), np.insert(change, 0, 0.0))
    return bends


def _enters(points: FloatArray, box: FloatArray | None) -> BoolArray:
    """Tell which pieces have an end in the box, (k,)."""
    if box is None:
        return np.ones(len(points) - 1, dtype=np.bool_)
    x, y = ((points >= box[:2]) & (points <= box[2:])).T
    inside: BoolArray = x & y
    return inside[1:] | inside[:-1]


class _ChordDistances(NamedTuple):
    """Bounds of the distances of pieces from their chords by samples, and pieces needed."""

    deviation: FloatArray
    pieces: IntArray


def _measure(
    curve: ParametricCurve,
    t: FloatArray,
    points: FloatArray,
    todo: IntArray,
    tolerance: float,
    box: FloatArray | None,
) -> _ChordDistances:
    """Compare the pieces `todo` with their chords."""
    start, end = t[todo], t[todo + 1]
    inner = start[:, None] + (end - start)[:, None] * _SAMPLES
    samples = points_at(curve, inner.ravel()).reshape(-1, _SAMPLES.size, 2)
    before, after = points[todo], points[todo + 1]
    deviation = _MARGIN * _chord_distance(samples, before, after)
    need = np.clip(np.ceil(np.sqrt(deviation / tolerance)), 1.0, 16.0)
    # No parameter fits between: the piece is as short as it can be.
    need[(inner[:, 0] <= start) | (inner[:, -1] >= end)] = 1.0
    if box is not None:
        outside = ~may_enter(
            _inflated(np.concatenate((before[:, None], samples, after[:, None]), axis=1)), box
        )
        need[outside] = 1.0
        deviation[outside] = np.inf
    return _ChordDistances(deviation, need.astype(np.intp))


def _chord_distance(samples: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Estimate how far pieces leave their chords, (k,), from samples at their quarters, (k, 3, 2).

    The distances of the samples say nothing of what happens along a chord between them. Where a piece may
    turn beside one of its ends, by its speed there against the change of speed from sample to sample, it
    passes what was sampled by at most an eighth of the second difference.
    """
    chord = end - start
    length = np.hypot(chord[:, 0], chord[:, 1])
    is_chord = length > 0.0
    ux, uy = np.where(is_chord, chord.T / np.where(is_chord, length, 1.0), np.array([[1.0], [0.0]]))
    x, y = (samples - start[:, None]).transpose(2, 1, 0)
    along, across = x * ux + y * uy, x * uy - y * ux
    beyond = np.maximum(np.maximum(along - length, -along), 0.0)
    one, two, three = along
    change = np.stack((two - 2.0 * one, one - 2.0 * two + three, two - 2.0 * three + length))
    bend = np.abs(change).max(axis=0)
    turns = np.minimum(one, length - three) < bend
    distance: FloatArray = np.hypot(across, beyond).max(axis=0) + np.where(turns, 0.125 * bend, 0.0)
    return distance


def _inflated(shape: FloatArray) -> FloatArray:
    """Points whose hull holds a piece: its samples, and as far again as they bend."""
    bend = np.abs(shape[:, 2:] - 2.0 * shape[:, 1:-1] + shape[:, :-2]).max(axis=1, keepdims=True)
    return np.concatenate((shape - 2.0 * bend, shape + 2.0 * bend), axis=1)


class _RefinedPieces(NamedTuple):
    """Pieces as in `Pieces`, and the indices of those that are new."""

    parameters: FloatArray
    points: FloatArray
    deviation: FloatArray
    todo: IntArray


def _refine(
    curve: ParametricCurve, t: FloatArray, points: FloatArray, deviation: FloatArray, count: IntArray
) -> _RefinedPieces:
    """Divide piece i into count[i] equal ones."""
    piece, step = equal_parts(count)
    finer = np.append(t[piece] + (t[piece + 1] - t[piece]) * (step / count[piece]), t[-1])
    distinct = finer[1:] > finer[:-1]
    finer, piece, step = np.append(finer[:-1][distinct], t[-1]), piece[distinct], step[distinct]
    fresh = step > 0
    located = np.append(points[piece], points[-1:], axis=0)
    located[:-1][fresh] = points_at(curve, finer[:-1][fresh])
    return _RefinedPieces(finer, located, deviation[piece], np.flatnonzero(count[piece] > 1))
