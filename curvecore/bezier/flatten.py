"""Polylines within a tolerance of a plane curve.

Families with Bezier pieces: the second differences of the control points bound how far a piece leaves its
chord, so the number of equal pieces of a segment is known at once [1]_. Other families, among them
polynomials of high degree, whose control polygon is not worth having: the curve is sampled finely enough for
its degree and refined where the samples leave the chord (`sampled_pieces`).

References
----------
.. [1] G. Wang, "The subdivision method for finding the intersection between
   two Bezier curves or surfaces", Zhejiang University Journal 1984; quoted in
   R. Goldman, "Pyramid Algorithms", Morgan Kaufmann 2003, section 5.6.3.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LIMIT, UNIT_ROUNDOFF
from curvecore.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    box_edges,
    end_to_end,
    require_plane,
    tolerance_value,
)
from curvecore.bezier.bernstein import Arcs, evaluate_inside, weighted_columns
from curvecore.bezier.control_points import (
    all_joints,
    drawable_chain,
    drawable_pieces,
    equal_parts,
    sorted_distinct,
    spread,
)
from curvecore.families.curve import ParametricCurve
from curvecore.parametrization import chebyshev

_FINE = 64  # a segment with more pieces is split, so that what is outside the box is left out
_SPLIT = 8
_ROUNDS = 20
_WIDEST = 16  # control points of a segment, for which sums of powers are exact to some digits


class ToleranceWarning(UserWarning):
    """A polyline misses its tolerance, because it would need more vertices than it may have.

    See Also
    --------
    flatten_pieces : Says by how much, and warns of nothing.
    MAX_VERTICES : How many it may have.

    Examples
    --------
    >>> import warnings
    >>> from curvecore import HermiteCurve, ToleranceWarning, flatten
    >>> far = HermiteCurve([[0, 0], [1e12, 0]], [[0, 1e13], [0, -1e13]], [0, 1])
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     polyline = flatten(far, 1e-3)
    >>> told[0].category is ToleranceWarning
    True
    """


def flatten(curve: ParametricCurve, tolerance: float, box: ArrayLike | None = None) -> FloatArray:
    """Return a polyline that follows the curve: its points at `flatten_parameters`.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2.
    tolerance : float
        Largest allowed distance from the curve to the polyline, above 0.
    box : (xmin, ymin, xmax, ymax), optional
        Where the tolerance matters; see `flatten_parameters`.

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

    See Also
    --------
    flatten_parameters : The parameters of its vertices.
    flatten_pieces : Both, and what was reached.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, flatten
    >>> polyline = flatten(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), 0.5)
    >>> polyline[0].tolist(), polyline[-1].tolist()
    ([0.0, 0.0], [4.0, 0.0])
    """
    return curve.evaluate(_parameters(curve, tolerance, box))


def flatten_parameters(curve: ParametricCurve, tolerance: float, box: ArrayLike | None = None) -> FloatArray:
    """Return parameters whose polyline is within a tolerance of the curve.

    Parameters
    ----------
    curve : ParametricCurve
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

    See Also
    --------
    flatten : The points.
    flatten_pieces : Both, and what was reached.

    Notes
    -----
    At most `MAX_VERTICES` vertices, or 4 per joint; for a polynomial through
    n > 256 points 2**22 / n of them, or 4 per point. A curve that needs more
    (values of 1e12 and no box) gets pieces in proportion to what it needs,
    and then misses the tolerance; `flatten_pieces` says by how much. Proved
    for the Hermite families, measured with a margin of a quarter for others.

    Examples
    --------
    >>> from curvecore import HermiteCurve, flatten_parameters
    >>> line = HermiteCurve([[0, 0], [1, 1], [2, 2]], [[1, 1], [1, 1], [1, 1]], [0, 1, 2])
    >>> flatten_parameters(line, 0.01).tolist()
    [0.0, 2.0]
    """
    return _parameters(curve, tolerance, box)


def _parameters(curve: ParametricCurve, tolerance: float, box: ArrayLike | None) -> FloatArray:
    """Flatten, and warn where the tolerance is missed."""
    pieces = flatten_pieces(curve, tolerance, box)
    # No polyline of floating-point numbers comes closer than roundings.
    if pieces.reached > max(tolerance, 64.0 * UNIT_ROUNDOFF * float(np.abs(pieces.points).max())):
        warnings.warn(
            f"the polyline leaves the curve by up to {pieces.reached:.3g}, not {tolerance:.3g}: "
            f"it may not have more than {len(pieces.parameters)} vertices",
            ToleranceWarning,
            stacklevel=3,
        )
    return pieces.parameters


def flatten_pieces(curve: ParametricCurve, tolerance: float, box: ArrayLike | None = None) -> Pieces:
    """Return parameters and points of a polyline together, with no second evaluation.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2.
    tolerance : float
        Largest allowed distance from the curve to the polyline, above 0.
    box : (xmin, ymin, xmax, ymax), optional
        Where the tolerance matters; see `flatten_parameters`.

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

    See Also
    --------
    Pieces : What it returns.
    flatten : The points alone.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, flatten_pieces
    >>> pieces = flatten_pieces(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), 0.01)
    >>> pieces.reached <= 0.01, len(pieces.points) == len(pieces.parameters)
    (True, True)
    """
    limit = tolerance_value(tolerance)
    require_plane(curve.points, "be flattened")
    edges = None if box is None else box_edges(box)
    if len(curve.pieces) > 1:
        return _chained_pieces(curve, limit, edges) or _pieces_apart(curve, limit, edges)
    return _pieces_of_one(curve, limit, edges)


def _pieces_of_one(curve: ParametricCurve, limit: float, edges: FloatArray | None) -> Pieces:
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        controls = drawable_pieces(curve)
        if controls is not None:
            pieces = _bezier_pieces(curve, controls, limit, edges)
        else:
            pieces = sampled_pieces(curve, limit, edges)
        return merged_pieces(pieces, limit)


def _pieces_apart(curve: ParametricCurve, limit: float, edges: FloatArray | None) -> Pieces:
    """Flatten the curves of a chain one by one, each with as many vertices as a curve may have."""
    parts = [_pieces_of_one(piece, limit, edges) for piece in curve.pieces]
    parameters, points, deviations = zip(*parts, strict=True)
    return Pieces(end_to_end(parameters), end_to_end(points), np.concatenate(deviations))


def _chained_pieces(curve: ParametricCurve, limit: float, edges: FloatArray | None) -> Pieces | None:
    """Flatten a chain at once; its corners stay vertices. None where that is not possible.

    A drawing has thousands of paths with a corner at every other point: one by one, the curves between two
    corners take ten times as long.
    """
    together, breaks = drawable_chain(curve), curve.breaks
    if together is None or together.shape[1] > _WIDEST:
        return None
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        arcs = _divided(together, limit, edges)
        # What is too wild for the vertices of one curve gets those of each; so do bounds that are no numbers.
        if not arcs.need.sum() <= MAX_VERTICES:
            return None
        t, segment, deviation = _uniform_parameters(breaks, arcs)
        is_corner = np.zeros(len(t), dtype=np.bool_)
        is_corner[np.searchsorted(t, [piece.domain[0] for piece in curve.pieces[1:]])] = True
        # Where the point of a corner is not the same for both, that of the curve before it is drawn.
        segment[is_corner] -= 1
        points = np.clip(evaluate_inside(t, segment, breaks, weighted_columns(together)), -LIMIT, LIMIT)
        return merged_pieces(Pieces(t, points, deviation), limit, is_corner)


class _Division(NamedTuple):
    """Bezier arcs and how they are divided.

    Attributes
    ----------
    start, end : ndarray, shape (k,)
        Their ends, as segment index + local s.
    need : ndarray, shape (k,)
        Into how many equal pieces each is to be divided.
    bound : ndarray, shape (k,)
        Of their distances from their chords before that; infinite outside the box.
    """

    start: FloatArray
    end: FloatArray
    need: FloatArray
    bound: FloatArray


def _bezier_pieces(
    curve: ParametricCurve, controls: FloatArray, tolerance: float, box: FloatArray | None
) -> Pieces:
    t, _segment, deviation = _uniform_parameters(curve.breaks, _divided(controls, tolerance, box))
    return Pieces(t, points_at(curve, t), deviation)


def _divided(controls: FloatArray, tolerance: float, box: FloatArray | None) -> _Division:
    ends = np.arange(len(controls) + 1, dtype=np.float64)
    arcs = Arcs(controls, ends[:-1], ends[1:])
    done: list[_Division] = []
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
        done.append(_Division(arcs.start[fine], arcs.end[fine], need[fine], bound[fine]))
        size += int(np.count_nonzero(fine))
        if fine.all():
            break
        arcs = arcs.selected(~fine).halved().halved().halved()
    together = _Division(*(np.concatenate(column) for column in zip(*done, strict=True)))
    order = np.argsort(together.start, kind="stable")
    return _Division(*(column[order] for column in together))


def _uniform_parameters(breaks: FloatArray, arcs: _Division) -> tuple[FloatArray, IntArray, FloatArray]:
    """Return the vertices' parameters, the segments they are in, and bounds of the pieces between them."""
    room = max(MAX_VERTICES, 4 * len(breaks)) - 1
    # Data that differ by hundreds of orders of magnitude may ask for more than any number, or for none.
    need = np.fmin(arcs.need, room)
    if need.sum() > room:
        need = np.maximum(1.0, np.floor(need * ((room - need.size) / need.sum())))
    arc, step = equal_parts(need.astype(np.intp))
    position = arcs.start[arc] + (arcs.end - arcs.start)[arc] * (step / need[arc])
    segment = np.minimum(position.astype(np.intp), len(breaks) - 2)
    t = breaks[segment] + (position - segment) * (breaks[segment + 1] - breaks[segment])
    t = np.append(np.minimum(t, breaks[segment + 1]), breaks[-1])
    segment = np.append(segment, len(breaks) - 2)
    deviation = (arcs.bound / need**2)[arc]
    distinct = np.append(t[1:] > t[:-1], True)
    if not distinct.all():
        t, segment, deviation = t[distinct], segment[distinct], deviation[distinct[:-1]]
    return t, segment, deviation


# Curves without Bezier pieces: sampled, and refined where they leave their chords

_MOST_WORK = 1 << 22  # vertices times points of a polynomial: a curve too wild to be followed is done in time
_SAMPLE_ROUNDS = 20
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
    for _ in range(_SAMPLE_ROUNDS):
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
    """Return the differences between pieces and the continuation of their neighbours, (k,)."""
    step, h = np.diff(points, axis=0), np.diff(t)
    quotient = (h[1:] / h[:-1])[:, None]
    change = np.hypot(*(step[1:] / np.maximum(quotient, 1.0) - step[:-1] * np.minimum(quotient, 1.0)).T)
    return np.asarray(np.maximum(np.append(change, 0.0), np.insert(change, 0, 0.0)))


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
    return np.asarray(np.hypot(across, beyond).max(axis=0) + np.where(turns, 0.125 * bend, 0.0))


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


# Polylines, and bounds of how far they leave a curve

MAX_VERTICES = 1 << 14
"""A polyline has at most this many vertices, or 4 per joint if that is more."""


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

    See Also
    --------
    flatten_pieces : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, flatten_pieces
    >>> pieces = flatten_pieces(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), 0.01)
    >>> pieces.points[0].tolist(), pieces.reached <= 0.01
    ([0.0, 0.0], True)
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


def points_at(curve: ParametricCurve, t: FloatArray) -> FloatArray:
    """Return points of the curve, limited to +-1e300: their differences are finite."""
    return np.clip(curve.evaluate(t), -LIMIT, LIMIT)


def chord_bound(controls: FloatArray) -> FloatArray:
    """Bound the distance between arcs and their chords: max |c''| / 8 over s in [0, 1]."""
    degree = controls.shape[1] - 1
    if degree == 1:
        return np.zeros(len(controls))
    second = controls[:, 2:] - 2.0 * controls[:, 1:-1] + controls[:, :-2]
    sizes = np.hypot(second[:, :, 0], second[:, :, 1])
    return np.asarray(_along_columns(np.maximum, sizes) * (degree * (degree - 1) / 8.0))


def may_enter(points: FloatArray, box: FloatArray) -> BoolArray:
    """Return which hulls of points, of shape (k, j, 2), touch the box."""
    low, high = _along_columns(np.minimum, points), _along_columns(np.maximum, points)
    inside = (high >= box[:2]) & (low <= box[2:])
    return inside[:, 0] & inside[:, 1]


def _along_columns(combine: np.ufunc, values: FloatArray) -> FloatArray:
    """Reduce axis 1, which has a handful of entries: NumPy's reductions take ten times as long."""
    result: FloatArray = values[:, 0]
    for column in range(1, values.shape[1]):
        result = combine(result, values[:, column])
    return result


def segment_distance(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the distances from points to line segments, free of overflow."""
    chord = end - start
    length = np.hypot(chord[..., 0], chord[..., 1])
    unit = chord / np.where(length > 0.0, length, 1.0)[..., None]
    offset = points - start
    along = np.clip(offset[..., 0] * unit[..., 0] + offset[..., 1] * unit[..., 1], 0.0, length)
    rest = offset - along[..., None] * unit
    return np.hypot(rest[..., 0], rest[..., 1])


def merged_pieces(pieces: Pieces, tolerance: float, is_fixed: BoolArray | None = None) -> Pieces:
    """Leave out the vertices that the tolerance does not need, but those that are fixed, (k + 1,).

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
        if is_fixed is not None:
            dropped &= ~is_fixed[middle]
        deviation[middle[dropped] - 1] = joined[dropped]
        # Straight parts halve in every round; a few vertices more are not worth another one.
        idle = 0 if 32 * np.count_nonzero(dropped) > t.size else idle + 1
        stays = np.ones(t.size, dtype=bool)
        stays[middle[dropped]] = False
        t, points, deviation = t[stays], points[stays], deviation[stays[:-1]]
        is_fixed = None if is_fixed is None else is_fixed[stays]
        offset = 1 - offset
    return Pieces(t, points, deviation)
