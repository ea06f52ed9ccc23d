"""Crossings of a plane curve with itself, and of two curves.

Pairs of arcs whose boxes are apart, along the axes or along either chord, are dropped; the rest are halved
until both arcs are straight within a part of the tolerance (`close_pairs`). An arc whose directions lie in an
open half plane does not meet itself, and two such neighbours, taken together, meet at their common end only;
these are dropped as well [1]_. Boxes along the chord are as thin as the arc is straight: windings of a
spiral, side by side, come apart at once [2]_. For the same reason arcs that touch need not be halved down to
the tolerance, only to its square root.

Newton's method on (c(b) - c(a)) / (b - a), which is not zero where the curve merely passes once, finishes the
pairs [3]_; what belongs to one meeting is then one result. Two curves are searched as one over [0, 1] and
[2, 3], of which only pairs with an arc on each count.

References
----------
.. [1] T. W. Sederberg and R. J. Meyers, "Loop detection in surface patch
   intersections", Computer Aided Geometric Design 5 (1988) 161-171; for a
   curve with itself: D. Lasser, "Calculating the self-intersections of
   Bezier curves", Computers in Industry 12 (1989) 259-268.
.. [2] T. W. Sederberg and T. Nishita, "Curve intersection using Bezier
   clipping", Computer-Aided Design 22 (1990) 538-549, section 3: fat lines.
.. [3] K. M. Brown and W. B. Gearhart, "Deflation techniques for the
   calculation of further solutions of a nonlinear system", Numerische
   Mathematik 16 (1971) 334-342.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import LARGEST, SMALLEST, along_last, cross, vector_lengths
from curvecore.arrays import BoolArray, FloatArray, IntArray, require_plane, tolerance_value
from curvecore.bezier.bernstein import Arcs, derivative, joined_arcs
from curvecore.bezier.pieces import BezierPieces, bezier_pieces, joined_pieces, size_of
from curvecore.families.curve import ParametricCurve

_FINEST = 2.0**-44  # of the size: what roundings leave of a tolerance
_CUSP = 2.0**-33  # of the size: a cusp whose arms are a rounding apart is as long
_CANDIDATES = 1 << 12
_NEWTON = 20
_ALONG = (np.arange(15) + 0.5) / 15


class SelfIntersections(NamedTuple):
    """Pairs of parameters at which a curve crosses or touches itself.

    Attributes
    ----------
    parameters : ndarray, shape (k, 2)
        Pairs with c(a) = c(b), a < b, ascending in a. Where m branches go
        through one point, all m (m - 1) / 2 pairs.
    points : ndarray, shape (k, 2)
        c there.
    is_complete : bool
        Whether these are all: the search ended by itself, and nowhere does
        the curve run along itself, which is a stretch of crossings and not
        one.

    See Also
    --------
    self_intersections : The function that returns it.

    Examples
    --------
    >>> from curvecore import HermiteCurve, self_intersections
    >>> loop = HermiteCurve([[0, 0], [1, 0]], [[9, 9], [9, -9]], [0, 1])
    >>> found = self_intersections(loop, 1e-9)
    >>> found.parameters.round(6).tolist(), found.is_complete
    ([[0.066987, 0.933013]], True)
    """

    parameters: FloatArray
    points: FloatArray
    is_complete: bool


def self_intersections(curve: ParametricCurve, tolerance: float) -> SelfIntersections:
    """Return the pairs of parameters at which a curve meets itself.

    Parameters
    ----------
    curve : ParametricCurve
        Plane (dim 2).
    tolerance : float
        Largest distance of c(a) and c(b), above 0, in units of the points;
        2**-44 of the largest coordinate, if that is more. Loops smaller than
        a few times this, or than 2**-33 of the largest coordinate, may be
        missed, near misses may be reported.

    Returns
    -------
    SelfIntersections
        The ends of a closed curve, which meet anyway, are left out.

    Raises
    ------
    CurveError
        If the curve is not plane or the tolerance not positive.

    See Also
    --------
    SelfIntersections : What it returns.

    Notes
    -----
    The work is bounded: at most 2**14 pairs of arcs at a time, 2**17 in all
    (or 4 and 64 per arc) are looked at, and 2**12 candidates finished.

    Examples
    --------
    >>> from curvecore import HermiteCurve, self_intersections
    >>> loop = HermiteCurve([[0, 0], [1, 0]], [[9, 9], [9, -9]], [0, 1])
    >>> self_intersections(loop, 1e-9).parameters.round(6).tolist()
    [[0.066987, 0.933013]]
    """
    limit = tolerance_value(tolerance)
    require_plane(curve.points, "cross itself")
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        pieces = bezier_pieces(curve, min(1e-3, 0.02 * limit / size_of(curve.points)))
        small = max(float(np.ldexp(limit, -pieces.exponent)), _FINEST)
        margin = float(pieces.error.max())
        arcs, is_simple = simple_arcs(Arcs(pieces.controls, pieces.starts, pieces.ends), small)
        pairs, ended = close_pairs(arcs, small, margin)
        parameters, are_all = _finished(curve, pieces, small, pairs, ended, arcs.start)
    points = curve.evaluate(parameters[:, 0]) if len(parameters) else np.zeros((0, 2))
    return SelfIntersections(parameters, points, is_simple and are_all)


class Intersections(NamedTuple):
    """Parameters at which two curves cross or touch each other.

    Attributes
    ----------
    parameters : ndarray, shape (k, 2)
        Of the first and of the second curve, ascending in the first.
    points : ndarray, shape (k, 2)
        The positions.
    is_complete : bool
        As of `SelfIntersections`: false where the curves run along each other.

    See Also
    --------
    intersections : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, intersections
    >>> lines = LagrangeCurve([[0, 0], [2, 2]], [0, 1]), LagrangeCurve([[0, 1], [3, 1]], [0, 3])
    >>> found = intersections(*lines, 1e-9)
    >>> found.parameters.round(9).tolist(), found.points.round(9).tolist()
    ([[0.5, 1.0]], [[1.0, 1.0]])
    """

    parameters: FloatArray
    points: FloatArray
    is_complete: bool


def intersections(first: ParametricCurve, second: ParametricCurve, tolerance: float) -> Intersections:
    """Return the parameters at which two curves meet.

    Parameters
    ----------
    first, second : ParametricCurve
        Plane (dim 2), of any families.
    tolerance : float
        As of `self_intersections`.

    Returns
    -------
    Intersections
        A point at which they touch is one of them, and so is an end of one that lies on the other.

    Raises
    ------
    CurveError
        If a curve is not plane or the tolerance not positive.

    See Also
    --------
    self_intersections : Of one curve.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, intersections
    >>> parabola = LagrangeCurve([[-1, 1], [0, 0], [1, 1]], [-1, 0, 1])
    >>> line = LagrangeCurve([[-1, 0.25], [1, 0.25]], [0, 1])
    >>> intersections(parabola, line, 1e-9).parameters.round(9).tolist()
    [[-0.5, 0.25], [0.5, 0.75]]
    """
    limit = tolerance_value(tolerance)
    for curve in (first, second):
        require_plane(curve.points, "cross another")
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        share = min(1e-3, 0.02 * limit / max(size_of(curve.points) for curve in (first, second)))
        parts = [bezier_pieces(curve, share) for curve in (first, second)]
        pieces = joined_pieces([_from(start, part) for start, part in zip(_STARTS, parts, strict=True)])
        small = max(float(np.ldexp(limit, -pieces.exponent)), _FINEST)
        arcs, count = Arcs(pieces.controls, pieces.starts, pieces.ends), len(parts[0].starts)
        begun = _pairs_between(arcs, count, float(pieces.error.max()))
        pairs, ended = _narrowed(begun, small, float(pieces.error.max()), len(arcs.start))
        both = _TwoCurves(first, second)
        meetings, are_all = _finished(both, pieces, small, pairs, ended, arcs.start)
    parameters = np.column_stack([both.parameters(meetings[:, side], side) for side in (0, 1)])
    return Intersections(parameters, both.evaluate(meetings[:, 0]), are_all)


_STARTS = (0.0, 2.0)


class _TwoCurves:
    """Two curves over [0, 1] and [2, 3], each at rest beyond its ends, and far away between them."""

    # So far away that the beginning of the first and the end of the second do not count as a closed curve.
    domain = (-1e3, 1e3)

    def __init__(self, first: ParametricCurve, second: ParametricCurve) -> None:
        self._curves = (first, second)

    def parameters(self, u: FloatArray, side: int) -> FloatArray:
        """Return the parameters of one of the curves."""
        share, (start, end) = np.clip(u - _STARTS[side], 0.0, 1.0), self._curves[side].domain
        return (1.0 - share) * start + share * end

    def evaluate(self, t: FloatArray, order: int = 0) -> FloatArray:
        result = np.empty((*t.shape, 2))
        for side, curve in enumerate(self._curves):
            here, (start, end) = (t < 1.5) == (side == 0), curve.domain
            if here.any():
                result[here] = curve.evaluate(self.parameters(t[here], side), order) * (end - start) ** order
        result[np.abs(t - 1.5) < 0.25] = LARGEST
        return result


_Path = ParametricCurve | _TwoCurves


def _from(start: float, pieces: BezierPieces) -> BezierPieces:
    """Return pieces over an interval of length 1 from `start`."""
    first, last = pieces.starts[0], pieces.ends[-1]
    starts, ends = (start + (t - first) / (last - first) for t in (pieces.starts, pieces.ends))
    return pieces._replace(starts=starts, ends=ends)


def _finished(
    curve: _Path, pieces: BezierPieces, small: float, pairs: Pairs, ended: bool, joints: FloatArray
) -> tuple[FloatArray, bool]:
    """Return the parameters (k, 2) of the meetings in pairs of straight arcs, and whether these are all."""
    unit = float(np.ldexp(1.0, min(pieces.exponent, 1023)))
    scale = _Scale(small * unit, max(2.0 * small, _CUSP) * unit)
    # Arcs that a search left unfinished say little, and are many.
    most = _CANDIDATES if ended else _CANDIDATES // 8
    ended &= len(pairs) <= most
    if len(pairs) > most:
        pairs = pairs.selected(np.linspace(0, len(pairs) - 1, most).astype(np.intp))
    parameters, are_isolated = _meetings(curve, pairs, scale, joints)
    return parameters, ended and are_isolated and 4.0 * float(pieces.error.max()) <= max(small, 4.0 * _FINEST)


class _Scale(NamedTuple):
    """Distances in units of the points: the tolerance of a meeting, and the reach of the smallest loop."""

    tolerance: float
    loop: float


class _Meetings(NamedTuple):
    """Parameters (k, 2) before and after Newton's method, distances (k,), widths of arcs in t (k, 2)."""

    before: FloatArray
    parameters: FloatArray
    gap: FloatArray
    width: FloatArray

    def selected(self, rows: BoolArray | IntArray) -> _Meetings:
        return _Meetings(*(column[rows] for column in self))


def _meetings(curve: _Path, pairs: Pairs, scale: _Scale, joints: FloatArray) -> tuple[FloatArray, bool]:
    """Return one pair of parameters for each meeting, in order, and whether these are single meetings."""
    if not len(pairs):
        return np.zeros((0, 2)), True
    meetings = _polished(curve, *_starting_parameters(pairs))
    meetings = meetings.selected(
        (meetings.gap <= scale.tolerance) & _is_loop(curve, meetings.parameters, scale.loop, joints)
    )
    cluster = _clusters(curve, meetings, scale.tolerance)
    best, are_isolated = [], True
    for label in np.unique(cluster):
        members = np.flatnonzero(cluster == label)
        if _is_closing(curve, meetings.selected(members), scale.loop):
            continue
        are_isolated &= _is_one_point(curve, meetings.selected(members), scale)
        best.append(members[np.argmin(meetings.gap[members])])
    result = meetings.parameters[np.array(best, dtype=np.intp)]
    return result[np.lexsort((result[:, 1], result[:, 0]))], are_isolated


def _starting_parameters(pairs: Pairs) -> tuple[FloatArray, FloatArray]:
    """Return parameters (k, 2) where straight arcs cross or are near, and the widths of the arcs (k, 2).

    Arcs side by side are near along a stretch: each end gives one.
    """
    p, q = pairs.first.controls[:, 0], pairs.second.controls[:, 0]
    u, v = pairs.first.controls[:, -1] - p, pairs.second.controls[:, -1] - q
    w, across = q - p, cross(u, v)
    size = vector_lengths(u) * vector_lengths(v)
    s, r = (np.nan_to_num(cross(w, side) / across, posinf=0.5, neginf=0.5) for side in (v, u))
    flat = np.abs(across) <= 1e-2 * size
    k = np.flatnonzero(flat)
    zero, one = np.zeros(len(k)), np.ones(len(k))
    pair = np.concatenate([np.arange(len(s)), k, k, k, k])
    s = np.concatenate([s, zero, one, _foot(w[k], u[k]), _foot(w[k] + v[k], u[k])])
    r = np.concatenate([r, _foot(-w[k], v[k]), _foot(u[k] - w[k], v[k]), zero, one])
    shares = np.clip(np.stack((s, r), axis=1), 0.0, 1.0)
    start = np.stack((pairs.first.start, pairs.second.start), axis=1)[pair]
    width = np.stack((pairs.first.end, pairs.second.end), axis=1)[pair] - start
    return start + shares * width, width


def _foot(offset: FloatArray, along: FloatArray) -> FloatArray:
    return np.asarray(np.nan_to_num((offset * along).sum(axis=1) / np.square(along).sum(axis=1)))


def _polished(curve: _Path, parameters: FloatArray, width: FloatArray) -> _Meetings:
    """Polish candidates by Newton's method, each while it improves."""
    # A step that leaves the neighbourhood belongs to another crossing, which has a pair of its own.
    room = 64.0 * width.sum(axis=1)
    best = parameters.copy()
    least = vector_lengths(curve.evaluate(parameters[:, 1]) - curve.evaluate(parameters[:, 0]))
    still, at, idle = np.arange(len(parameters)), parameters, np.zeros(len(parameters))
    for _ in range(_NEWTON):
        at = _newton_step(curve, at)
        distance = vector_lengths(curve.evaluate(at[:, 1]) - curve.evaluate(at[:, 0]))
        better = (distance < least[still]) & (np.abs(at - parameters[still]).sum(axis=1) <= room[still])
        best[still[better]], least[still[better]] = at[better], distance[better]
        idle = np.where(better, 0, idle + 1)
        going = idle < 2
        still, at, idle = still[going], at[going], idle[going]
        if not len(still):
            break
    return _Meetings(parameters, np.sort(best, axis=1), least, width)


def _newton_step(curve: _Path, at: FloatArray) -> FloatArray:
    a, b = at.T
    gap = curve.evaluate(b) - curve.evaluate(a)
    slope = gap / (b - a)[:, None]
    forward, backward = curve.evaluate(a, 1) - slope, curve.evaluate(b, 1) - slope
    step = np.stack((cross(gap, backward), cross(gap, forward)), axis=1) / cross(forward, backward)[:, None]
    return np.clip(np.where(np.isfinite(step).all(axis=1, keepdims=True), at + step, at), *curve.domain)


def _is_loop(curve: _Path, pairs: FloatArray, reach: float, joints: FloatArray) -> BoolArray:
    """Tell whether the curve leaves c(a) between a and b: if not, they are one point and no meeting.

    Looked at on samples, and at the first and the last joint of the arcs between: what turns back has one.
    """
    if not len(pairs):
        return np.zeros(0, dtype=bool)
    a, b = pairs.T
    inner = a[:, None] + (b - a)[:, None] * _ALONG
    after = joints[np.minimum(np.searchsorted(joints, a, side="right"), len(joints) - 1)]
    before = joints[np.maximum(np.searchsorted(joints, b, side="left") - 1, 0)]
    inner = np.column_stack([inner, np.clip(after, a, b), np.clip(before, a, b)])
    away = curve.evaluate(inner.ravel()).reshape(*inner.shape, 2) - curve.evaluate(a)[:, None]
    return np.asarray(vector_lengths(away).max(axis=1) > reach)


def _clusters(curve: _Path, meetings: _Meetings, tolerance: float) -> IntArray:
    """Return a label for each candidate, (k,): the same for those of one meeting.

    Two belong together if they are a few arcs apart on either branch, and the branches stay within the
    tolerance of each other between them.
    """
    count = len(meetings.gap)
    order = np.argsort(meetings.parameters[:, 0], kind="stable")
    parameters = meetings.parameters[order]
    reach = 4.0 * np.maximum(meetings.width, np.spacing(np.abs(meetings.parameters)))[order]
    one, other = near_pairs(parameters, reach)
    offset = parameters[other] - parameters[one]
    between = parameters[one] + offset * np.array([0.25, 0.5, 0.75])[:, None, None]
    gap = curve.evaluate(between[:, :, 1].ravel()) - curve.evaluate(between[:, :, 0].ravel())
    joined = (vector_lengths(gap).reshape(3, -1) <= tolerance).all(axis=0)
    label = np.empty(count, dtype=np.intp)
    label[order] = connected_labels(count, one[joined], other[joined])
    return label


def _is_closing(curve: _Path, meetings: _Meetings, reach: float) -> bool:
    """Tell whether a meeting is that of the two ends of a closed curve."""
    first, last = curve.domain
    ends = curve.evaluate(np.array([first, last]))
    if vector_lengths(ends[1] - ends[0]) > reach:
        return False
    # The way from the beginning to any a, and from any b to the end, must not leave that point.
    a, b = meetings.parameters[:, 0].max(), meetings.parameters[:, 1].min()
    if a - first > meetings.width[:, 0].max() * 64.0 or last - b > meetings.width[:, 1].max() * 64.0:
        return False
    t = np.concatenate([first + (a - first) * _ALONG, b + (last - b) * _ALONG, [a, b]])
    return bool(vector_lengths(curve.evaluate(t) - ends[0]).max() <= reach)


def _is_one_point(curve: _Path, meetings: _Meetings, scale: _Scale) -> bool:
    """Tell whether Newton's method drew all candidates of a meeting together.

    Where the curve runs along itself they stay where they are.
    """
    after = np.ptp(curve.evaluate(meetings.parameters[:, 0]), axis=0).max()
    before = np.ptp(curve.evaluate(meetings.before[:, 0]), axis=0).max()
    return bool(after <= max(8.0 * scale.tolerance, before / 8.0))


# Pairs of arcs that may meet

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

    def selected(self, rows: BoolArray | IntArray) -> Pairs:
        """Return some of the pairs."""
        return Pairs(self.first.selected(rows), self.second.selected(rows))

    def __len__(self) -> int:
        """Return the number of pairs."""
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
        done.append(arcs.selected(fine))
        if fine.all():
            break
        arcs = arcs.selected(~fine).halved()
    together = joined_arcs(done)
    return together.selected(np.argsort(together.start, kind="stable")), is_complete


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
    pairs, ended = _narrowed(pairs, small, margin, len(arcs.start))
    return pairs, ended and is_complete


def _narrowed(pairs: Pairs, small: float, margin: float, count: int) -> tuple[Pairs, bool]:
    """Divide pairs of so many arcs until these are straight; return those that may meet, as `close_pairs`."""
    done: list[Pairs] = []
    work = 0
    for _ in range(_ROUNDS):
        straight = _are_straight(pairs.first, small) & _are_straight(pairs.second, small)
        adjoining = _adjoining(pairs)
        # Two straight neighbours may still form the tip of a loop.
        tiny = np.maximum(_extent(pairs.first.controls), _extent(pairs.second.controls)) <= small
        fine = np.where(adjoining, tiny, straight)
        done.append(pairs.selected(fine & ~adjoining))
        pairs = pairs.selected(~fine)
        if not len(pairs):
            return _joined_pairs(done), True
        work += len(pairs)
        if len(pairs) > _PAIRS or work > max(_WORK, 64 * count):
            break
        pairs = _divided_pairs(pairs, margin)
    return _joined_pairs([*done, pairs.selected(~_adjoining(pairs))]), False


def _first_pairs(arcs: Arcs, margin: float) -> tuple[Pairs, bool]:
    """Return the pairs of arcs that may meet."""
    low, high = arcs.controls.min(axis=1) - margin, arcs.controls.max(axis=1) + margin
    most = max(_PAIRS, 4 * len(low))
    parts: list[Pairs] = [
        Pairs(arcs.selected(np.zeros(0, dtype=np.intp)), arcs.selected(np.zeros(0, dtype=np.intp)))
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
            pairs = Pairs(arcs.selected(first), arcs.selected(second))
            parts.append(pairs.selected(_may_meet(pairs, margin)))
            waiting, count, total = [], 0, total + len(parts[-1])
            if total > most:
                return _joined_pairs(parts), i == last
    return _joined_pairs(parts), True


def _pairs_between(arcs: Arcs, count: int, margin: float) -> Pairs:
    """Return the pairs of one of the first `count` arcs and one of the others that may meet."""
    low, high = arcs.controls.min(axis=1) - margin, arcs.controls.max(axis=1) + margin
    meet = (low[:count, None] <= high[count:]) & (low[count:] <= high[:count, None])
    first, second = np.nonzero(meet.all(axis=2))
    pairs = Pairs(arcs.selected(first), arcs.selected(second + count))
    return pairs.selected(_may_meet(pairs, margin))


def _divided_pairs(pairs: Pairs, margin: float) -> Pairs:
    """Return the pairs of parts that may meet: of halves, and while pairs are few of quarters."""
    count = 4 if len(pairs) <= _FEW else 2
    which = np.arange(count)
    parts = []
    for begin in range(0, len(pairs), _AT_ONCE):
        some = pairs.selected(np.arange(begin, min(begin + _AT_ONCE, len(pairs))))
        left, right = some.first.divided(count), some.second.divided(count)
        origin = count * np.repeat(np.arange(len(some)), count * count)
        quarter = Pairs(
            left.selected(origin + np.tile(np.repeat(which, count), len(some))),
            right.selected(origin + np.tile(which, count * len(some))),
        )
        parts.append(quarter.selected(_may_meet(quarter, margin)))
    return _joined_pairs(parts)


def _joined_pairs(parts: list[Pairs]) -> Pairs:
    """Return the pairs of all parts."""
    return Pairs(joined_arcs([part.first for part in parts]), joined_arcs([part.second for part in parts]))


def _extent(controls: FloatArray) -> FloatArray:
    return np.asarray(np.ptp(controls, axis=1).max(axis=1))


def _are_straight(arcs: Arcs, small: float) -> BoolArray:
    """Tell which arcs stay within an eighth of a distance of their chords, run through evenly."""
    degree = arcs.controls.shape[1] - 1
    if degree < 2:
        return np.ones(len(arcs.start), dtype=bool)
    bend = vector_lengths(np.diff(arcs.controls, n=2, axis=1)).max(axis=1)
    return np.asarray(bend * (degree * (degree - 1) / 8.0) <= _STRAIGHT * small)


def _within_half_plane(slopes: FloatArray) -> BoolArray:
    size = vector_lengths(slopes)
    divisor = np.maximum(size, SMALLEST)
    x, y = slopes[..., 0], slopes[..., 1]
    mean_x, mean_y = (along_last(np.add, slope / divisor)[:, None] for slope in (x, y))
    # A slope of 0, at a point at rest, turns nowhere.
    ahead = (x * mean_x + y * mean_y > 0.0) | (size == 0.0)
    return np.asarray(ahead.all(axis=1) & (size > 0.0).any(axis=1))


def _adjoining(pairs: Pairs) -> BoolArray:
    is_next = pairs.first.end == pairs.second.start
    return np.asarray(is_next & (pairs.first.controls[:, -1] == pairs.second.controls[:, 0]).all(axis=1))


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
    one, other = (points[..., 0] * x + points[..., 1] * y for points in (a, b))
    largest = along_last(np.maximum, np.abs(one)) + along_last(np.maximum, np.abs(other))
    return _overlap(one, other, 2.0 * margin + 2.0**-50 * largest)


def _overlap(one: FloatArray, other: FloatArray, room: FloatArray | float) -> BoolArray:
    """Tell which rows of two arrays overlap as intervals, or are no farther apart than `room`."""
    low, high = along_last(np.minimum, one), along_last(np.maximum, one)
    return (low - room <= along_last(np.maximum, other)) & (along_last(np.minimum, other) - room <= high)


# Results that belong to one meeting


def near_pairs(parameters: FloatArray, reach: FloatArray) -> tuple[IntArray, IntArray]:
    """Return the pairs of rows (k, 2), ordered by the first parameter, that are within reach in both.

    Every step takes the pairs so many rows apart: all pairs at once take many times the memory and time
    where a curve runs along itself and most of them are near in the first parameter alone.
    """
    ends = np.searchsorted(parameters[:, 0], parameters[:, 0] + reach[:, 0].max(initial=0.0), side="right")
    following = ends - np.arange(len(parameters)) - 1
    pairs = [np.empty((2, 0), dtype=np.intp)]
    for step in range(1, following.max(initial=0) + 1):
        distance = np.abs(parameters[step:] - parameters[:-step])
        near = (distance <= np.maximum(reach[step:], reach[:-step])).all(axis=1) & (following[:-step] >= step)
        one = np.flatnonzero(near)
        pairs.append(np.stack((one, one + step)))
    one, other = np.concatenate(pairs, axis=1)
    return one, other


def connected_labels(count: int, one: IntArray, other: IntArray) -> IntArray:
    """Return a label for each of so many things, the same for those that pairs connect."""
    # Every label is the number of a thing of the same component. Until none gets smaller, the least label
    # at either end of a pair goes to both ends and to the things whose numbers they have, and every thing
    # takes the label of the thing whose number it has.
    label = np.arange(count)
    while True:
        before = label.copy()
        least = np.minimum(before[one], before[other])
        for where in (one, other, before[one], before[other]):
            np.minimum.at(label, where, least)
        label = label[label]
        if (label == before).all():
            return label
