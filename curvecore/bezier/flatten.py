"""Polylines within a tolerance of a plane curve.

Hermite families: the second differences of the Bezier control points bound
how far a piece leaves its chord, so the number of equal pieces of a segment
is known at once [1]_. Lagrange: one polynomial of high degree has no control
polygon that is worth having; the curve is sampled finely enough for its
degree and refined where the samples leave the chord.

References
----------
.. [1] G. Wang, "The subdivision method for finding the intersection between
   two Bezier curves or surfaces", Zhejiang University Journal 1984; quoted in
   R. Goldman, "Pyramid Algorithms", Morgan Kaufmann 2003, section 5.6.3.
"""

from __future__ import annotations

import warnings
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import BoolArray, FloatArray, IntArray, box_edges, read_only, tolerance_value
from curvecore.bezier.control_points import all_joints, drawable_pieces, spread
from curvecore.errors import CurveError
from curvecore.families.curve import Curve

MAX_VERTICES = 1 << 14
"""A polyline has at most this many vertices, or 4 per joint if that is more."""

_MOST_WORK = 1 << 22  # vertices times points of a polynomial: a curve too wild to be followed is done in time
_FINE = 64  # a segment with more pieces is split, so that what is outside the box is left out
_SPLIT = 8
_ROUNDS = 20
_LIMIT = 1e300
_UNIT = 2.0**-53
_FIRST = 8  # pieces between neighbouring points of what is no polynomial
_SAMPLES = np.array([0.25, 0.5, 0.75])
_MARGIN = 1.25  # on a measured distance, for what lies between the samples


class ToleranceWarning(UserWarning):
    """A polyline misses its tolerance, because it would need more vertices than it may have."""


class Pieces(NamedTuple):
    """Consecutive pieces of a curve.

    Attributes
    ----------
    parameters : ndarray, shape (k + 1,)
        Their ends.
    points : ndarray, shape (k + 1, 2)
        The curve there, limited to +-1e300.
    deviation : ndarray, shape (k,)
        Bounds of the distance from each to its chord; infinite for pieces
        outside the box, which must not be merged with others.
    """

    parameters: FloatArray
    points: FloatArray
    deviation: FloatArray

    @property
    def reached(self) -> float:
        """The bound of the distance between curve and polyline, as far as they enter the box.

        Greater than the tolerance where `MAX_VERTICES` or roundings do not allow better.
        """
        inside = self.deviation[self.deviation < np.inf]
        return float(inside.max(initial=0.0))


def flatten(curve: Curve, tolerance: float, box: ArrayLike | None = None) -> FloatArray:
    """Return a polyline that follows the curve: its points at `flatten_parameters`.

    Parameters
    ----------
    curve : Curve
        Of dim 2.
    tolerance : float
        Largest allowed distance from the curve to the polyline, above 0.
    box : (xmin, ymin, xmax, ymax), optional
        Where the tolerance matters; without it, everywhere.

    Returns
    -------
    ndarray, shape (k, 2)
        Finite.

    Raises
    ------
    CurveError
        If the curve is not plane, or tolerance or box are unusable.

    Warns
    -----
    ToleranceWarning
        As `flatten_parameters`.
    """
    return curve.evaluate(_parameters(curve, tolerance, box))


def flatten_parameters(curve: Curve, tolerance: float, box: ArrayLike | None = None) -> FloatArray:
    """Return parameters whose polyline is within a tolerance of the curve.

    Parameters
    ----------
    curve : Curve
        Of dim 2.
    tolerance : float
        Largest allowed distance from the curve to the polyline, above 0.
    box : (xmin, ymin, xmax, ymax), optional
        Where the tolerance matters. Parts of the curve that do not enter the
        box are followed by chords that do not enter it either, or not by
        more than the curve's own tolerance.

    Returns
    -------
    ndarray, shape (k,)
        Strictly increasing, from the first to the last parameter of the
        domain; joints between straight parts in line are left out.

    Raises
    ------
    CurveError
        If the curve is not plane, or tolerance or box are unusable.

    Warns
    -----
    ToleranceWarning
        Where the polyline misses the tolerance by more than roundings.

    Notes
    -----
    At most `MAX_VERTICES` vertices, or 4 per joint; for a polynomial through
    n > 256 points 2**22 / n of them, or 4 per point. A curve that needs more
    (values of 1e12 and no box) gets pieces in proportion to what it needs,
    and then misses the tolerance; `flatten_pieces` says by how much. Proved
    for the Hermite families, measured with a margin of a quarter for others.
    """
    return _parameters(curve, tolerance, box)


def _parameters(curve: Curve, tolerance: float, box: ArrayLike | None) -> FloatArray:
    """Flatten for those who get no bounds, and warn where the tolerance is missed."""
    pieces = flatten_pieces(curve, tolerance, box)
    if pieces.reached > tolerance and not _is_rounding(pieces):
        warnings.warn(
            f"the polyline leaves the curve by up to {pieces.reached:.3g}, not {tolerance:.3g}: "
            f"it may not have more than {len(pieces.parameters)} vertices",
            ToleranceWarning,
            stacklevel=3,
        )
    return pieces.parameters


def _is_rounding(pieces: Pieces) -> bool:
    """Whether what is missed is what no polyline of floating-point numbers can avoid."""
    return pieces.reached <= 64.0 * _UNIT * float(np.abs(pieces.points).max())


def flatten_pieces(curve: Curve, tolerance: float, box: ArrayLike | None = None) -> Pieces:
    """Return parameters and points of a polyline together, with no second evaluation.

    Parameters
    ----------
    curve, tolerance, box
        As for `flatten_parameters`.

    Returns
    -------
    Pieces
        With what `flatten_parameters` and `flatten` return, but for the last
        digits of the points, and limited to +-1e300. `Pieces.reached` says
        whether the tolerance was met; no warning does.

    Raises
    ------
    CurveError
        If the curve is not plane, or tolerance or box are unusable.
    """
    limit = tolerance_value(tolerance)
    if curve.points.shape[1] != 2:
        raise CurveError(f"curve must be plane (dim 2) to be flattened, not of dim {curve.points.shape[1]}")
    edges = None if box is None else box_edges(box)
    if len(curve.pieces) > 1:
        return _end_to_end([flatten_pieces(piece, tolerance, box) for piece in curve.pieces])
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        controls = drawable_pieces(curve)
        if controls is not None:
            pieces = _bezier_pieces(curve, controls, limit, edges)
        else:
            pieces = sampled_pieces(curve, limit, edges)
        return merged_pieces(pieces, limit)


def _end_to_end(parts: list[Pieces]) -> Pieces:
    """Join pieces, each of which begins where the one before ends."""
    first, *others = parts
    return Pieces(
        np.concatenate([first.parameters, *(part.parameters[1:] for part in others)]),
        np.concatenate([first.points, *(part.points[1:] for part in others)]),
        np.concatenate([part.deviation for part in parts]),
    )


class _Arcs(NamedTuple):
    """Bezier arcs on pieces of segments.

    Attributes
    ----------
    controls : ndarray, shape (k, degree + 1, 2)
        Their control points.
    start, length : ndarray, shape (k,)
        Where they begin, as segment index + local s, and how long they are in s.
    """

    controls: FloatArray
    start: FloatArray
    length: FloatArray


def _bezier_pieces(curve: Curve, controls: FloatArray, tolerance: float, box: FloatArray | None) -> Pieces:
    n = len(controls)
    arcs = _Arcs(controls, np.arange(n, dtype=np.float64), np.ones(n))
    done: list[tuple[FloatArray, FloatArray, FloatArray, FloatArray]] = []
    size = 0
    for level in range(_ROUNDS):
        bound = chord_bound(arcs.controls)
        outside = np.zeros(len(bound), dtype=bool) if box is None else ~may_enter(arcs.controls, box)
        need = np.where(outside, 1.0, np.maximum(1.0, np.ceil(np.sqrt(bound / tolerance))))
        fine = need <= _FINE
        active = int(fine.size - np.count_nonzero(fine))
        # Splitting pays only where a box may leave parts out.
        if box is None or level == _ROUNDS - 1 or size + fine.size + _SPLIT * active > MAX_VERTICES // 2:
            fine[:] = True
        bound = np.where(outside, np.inf, bound)
        done.append((arcs.start[fine], arcs.length[fine], need[fine], bound[fine]))
        size += int(np.count_nonzero(fine))
        if fine.all():
            if level == 0:
                return _uniform_pieces(curve, *done[0])
            break
        arcs = _split(_Arcs(arcs.controls[~fine], arcs.start[~fine], arcs.length[~fine]))
    start, length, need, bound = (np.concatenate(column) for column in zip(*done, strict=True))
    order = np.argsort(start, kind="stable")
    return _uniform_pieces(curve, start[order], length[order], need[order], bound[order])


def _uniform_pieces(
    curve: Curve, start: FloatArray, length: FloatArray, need: FloatArray, bound: FloatArray
) -> Pieces:
    """Divide each arc into as many equal pieces as it needs."""
    joints = curve.breaks
    room = max(MAX_VERTICES, 4 * len(joints)) - 1
    # Data that differ by hundreds of orders of magnitude may ask for more than any number, or for none.
    need = np.fmin(need, room)
    if need.sum() > room:
        need = np.maximum(1.0, np.floor(need * ((room - need.size) / need.sum())))
    count = need.astype(np.intp)
    arc = np.repeat(np.arange(count.size), count)
    step = np.arange(arc.size) - (np.cumsum(count) - count)[arc]
    position = start[arc] + length[arc] * (step / need[arc])
    segment = np.minimum(position.astype(np.intp), len(joints) - 2)
    local = position - segment
    t = joints[segment] + local * (joints[segment + 1] - joints[segment])
    t = np.append(np.minimum(t, joints[segment + 1]), joints[-1])
    deviation = (bound / need**2)[arc]
    distinct = t[1:] > t[:-1]
    if not distinct.all():
        t = np.append(t[:-1][distinct], t[-1])
        deviation = deviation[distinct]
    return Pieces(t, _points(curve, t), deviation)


def chord_bound(controls: FloatArray) -> FloatArray:
    """Bound the distance between arcs and their chords: max |c''| / 8 over s in [0, 1]."""
    degree = controls.shape[1] - 1
    second = controls[:, 2:] - 2.0 * controls[:, 1:-1] + controls[:, :-2]
    sizes = np.hypot(second[:, :, 0], second[:, :, 1])
    bound: FloatArray = _along_columns(np.maximum, sizes) * (degree * (degree - 1) / 8.0)
    return bound


def may_enter(points: FloatArray, box: FloatArray) -> BoolArray:
    """Tell whose hulls, from points of shape (k, j, 2), touch the box."""
    low, high = _along_columns(np.minimum, points), _along_columns(np.maximum, points)
    inside = (high >= box[:2]) & (low <= box[2:])
    return inside[:, 0] & inside[:, 1]


def _along_columns(combine: np.ufunc, values: FloatArray) -> FloatArray:
    """Reduce axis 1, which has a handful of entries: NumPy's reductions take ten times as long."""
    result: FloatArray = values[:, 0]
    for column in range(1, values.shape[1]):
        result = combine(result, values[:, column])
    return result


def _split(arcs: _Arcs) -> _Arcs:
    """Cut every arc into equal parts."""
    degree = arcs.controls.shape[1] - 1
    controls = np.einsum("pij,kjd->kpid", _split_weights(degree), arcs.controls).reshape(-1, degree + 1, 2)
    length = np.repeat(arcs.length / _SPLIT, _SPLIT)
    start = (arcs.start[:, None] + arcs.length[:, None] * (np.arange(_SPLIT) / _SPLIT)).ravel()
    return _Arcs(controls, start, length)


@cache
def _split_weights(degree: int) -> FloatArray:
    """Weights of the control points of the parts; all >= 0, so no digits are lost."""
    halves = np.zeros((2, degree + 1, degree + 1))
    row = np.ones(1)
    for i in range(degree + 1):
        halves[0, i, : i + 1] = row
        halves[1, degree - i, degree - i :] = row
        row = 0.5 * (np.append(row, 0.0) + np.append(0.0, row))
    weights = np.eye(degree + 1)[None]
    for _ in range(_SPLIT.bit_length() - 1):
        weights = np.einsum("hij,pjk->phik", halves, weights).reshape(-1, degree + 1, degree + 1)
    return read_only(weights)


def sampled_pieces(curve: Curve, tolerance: float, box: FloatArray | None) -> Pieces:
    """Sample for the degree, then refine the pieces that leave their chords."""
    n = len(curve.parameters)
    most = min(MAX_VERTICES, max(4 * n, _MOST_WORK // n))
    t = _first_samples(curve)
    points = _points(curve, t)
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


def _points(curve: Curve, t: FloatArray) -> FloatArray:
    """Return points of the curve whose differences are finite."""
    return np.clip(curve.evaluate(t), -_LIMIT, _LIMIT)


def _first_samples(curve: Curve) -> FloatArray:
    """Joints, and Chebyshev-like parameters that resolve any polynomial of the degree.

    Of what is no polynomial, a few between neighbouring joints.
    """
    first, last = curve.domain
    joints = all_joints(curve)
    if curve.degree is None:
        return spread(joints, np.full(len(joints) - 1, _FIRST))
    count = 2 * curve.degree
    s = first + (last - first) * np.sin(np.arange(1, count) * (np.pi / (2 * count))) ** 2
    # What all but coincides with a joint tells nothing that the joint does not.
    after = np.clip(np.searchsorted(joints, s), 1, len(joints) - 1)
    away = np.minimum(np.abs(s - joints[after - 1]), np.abs(s - joints[after]))
    room = np.diff(np.concatenate(([first], s, [last])))
    s = s[away > 0.05 * np.minimum(room[:-1], room[1:])]
    t = np.sort(np.concatenate((joints, s)))
    # numpy.unique would import all of numpy.ma.
    return t[np.diff(t, prepend=-np.inf) > 0.0]


class _Measured(NamedTuple):
    """What samples tell of pieces: bounds of the distance to the chord, and pieces needed."""

    deviation: FloatArray
    pieces: IntArray


def _measure(
    curve: Curve,
    t: FloatArray,
    points: FloatArray,
    todo: IntArray,
    tolerance: float,
    box: FloatArray | None,
) -> _Measured:
    """Compare the pieces `todo` with their chords."""
    start, end = t[todo], t[todo + 1]
    inner = start[:, None] + (end - start)[:, None] * _SAMPLES
    samples = _points(curve, inner.ravel()).reshape(-1, _SAMPLES.size, 2)
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
    return _Measured(deviation, need.astype(np.intp))


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


class _Refined(NamedTuple):
    """Pieces as in `Pieces`, and the indices of those that are new."""

    parameters: FloatArray
    points: FloatArray
    deviation: FloatArray
    todo: IntArray


def _refine(
    curve: Curve, t: FloatArray, points: FloatArray, deviation: FloatArray, count: IntArray
) -> _Refined:
    """Divide piece i into count[i] equal ones."""
    piece = np.repeat(np.arange(count.size), count)
    step = np.arange(piece.size) - (np.cumsum(count) - count)[piece]
    finer = np.append(t[piece] + (t[piece + 1] - t[piece]) * (step / count[piece]), t[-1])
    distinct = finer[1:] > finer[:-1]
    if not distinct.all():
        finer, piece, step = np.append(finer[:-1][distinct], t[-1]), piece[distinct], step[distinct]
    fresh = step > 0
    located = np.append(points[piece], points[-1:], axis=0)
    located[:-1][fresh] = _points(curve, finer[:-1][fresh])
    return _Refined(finer, located, deviation[piece], np.flatnonzero(count[piece] > 1))


def segment_distance(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the distances from points to line segments, free of overflow."""
    chord = end - start
    length = np.hypot(chord[..., 0], chord[..., 1])
    unit = chord / np.where(length > 0.0, length, 1.0)[..., None]
    offset = points - start
    along = np.clip(offset[..., 0] * unit[..., 0] + offset[..., 1] * unit[..., 1], 0.0, length)
    rest = offset - along[..., None] * unit
    return np.hypot(rest[..., 0], rest[..., 1])


def merged_pieces(pieces: Pieces, tolerance: float) -> Pieces:
    """Leave out the vertices that the tolerance does not need.

    A chord of two pieces is at most as far from the curve as the worse of
    their own chords is, plus the middle vertex's distance from it.
    """
    t, points = pieces.parameters, pieces.points
    deviation = pieces.deviation.copy()
    idle, offset = 0, 0
    while idle < 2 and t.size > 2:
        middle = np.arange(1 + offset, t.size - 1, 2)
        joined = np.maximum(deviation[middle - 1], deviation[middle])
        joined += segment_distance(points[middle], points[middle - 1], points[middle + 1])
        dropped = joined <= tolerance
        deviation[middle[dropped] - 1] = joined[dropped]
        # Straight parts halve in every round; a few vertices more are not worth another one.
        idle = 0 if 32 * np.count_nonzero(dropped) > t.size else idle + 1
        kept = np.ones(t.size, dtype=bool)
        kept[middle[dropped]] = False
        t, points, deviation = t[kept], points[kept], deviation[kept[:-1]]
        offset = 1 - offset
    return Pieces(t, points, deviation)
