"""Bezier control points: exact for the Hermite families, cubic pieces for all.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 5.1 (derivatives at the ends) and 7.5, 7.6.
.. [2] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001,
   chapter IV, (6): the error h**4 max |c''''| / 384 of cubic Hermite
   interpolation.
.. [3] H. Ehlich and K. Zeller, "Schwankung von Polynomen zwischen Gitterpunkten", Mathematische Zeitschrift
   86 (1964) 41-44: max |p| <= max |p| at N Chebyshev points over cos(pi m / 2 N) for degree m < N.
.. [4] C. de Boor, K. Hollig and M. Sabin, "High accuracy geometric Hermite interpolation", Computer Aided
   Geometric Design 4 (1987) 269-278: free lengths of handles follow a shape with an error of order h**6.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import LIMIT, vector_lengths
from curvecore.arrays import FloatArray, IntArray, end_to_end, tolerance_value
from curvecore.bezier.bernstein import control_points, controls_between, elevated, weights
from curvecore.errors import CurveError
from curvecore.families.chain import joint_of_row
from curvecore.families.curve import ParametricCurve

MAX_PIECES = 1 << 12
"""`cubic_path` never returns more pieces than this, or one a segment if there are more segments."""

_SAMPLES = np.arange(1, 12) / 12.0  # where a cubic piece is compared with what is no polynomial
_MARGIN = 1.25  # on the measured deviation, for what lies between the samples
_HIGHEST_PROVED = 30  # degree up to which so many samples are taken that their margin is proved
_ROUNDING = 1e-12  # of the coordinates: differences below this are those of rounding, which has no degree
_ROUNDS = 24
_NODES = 0.5 - 0.5 * np.cos((np.arange(9) + 0.5) * (np.pi / 9))  # where lengths of handles are fitted
_WARP_DEGREE = 5  # of the polynomial that maps s of a cubic piece to t of the curve
_UNKNOWN_DEGREE = 12  # assumed of a piece where no degree is proved: 31 samples


class CubicPath(NamedTuple):
    """Cubic Bezier pieces that follow a curve.

    Attributes
    ----------
    control_points : ndarray, shape (k, 4, dim)
        Piece by piece; each begins where the one before ends.
    parameters : ndarray, shape (k + 1,)
        The curve's parameters at the ends of the pieces.
    deviation : float
        Distance between the pieces and the curve at equal parameters, at most or about: 0 for cubic pieces.
        Larger than the tolerance where `MAX_PIECES` did not suffice.
    is_bound : bool
        Whether it is proved that the distance is nowhere larger, but for rounding: for polynomials up to
        degree 30, and all pieces that have Bezier control points. Else it was measured at 11 parameters a
        piece and enlarged by a quarter, or is no more than rounding.

    See Also
    --------
    cubic_path : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, cubic_path
    >>> path = cubic_path(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), 1e-6)
    >>> path.control_points.shape, path.parameters.tolist(), path.deviation < 1e-6
    ((4, 4, 2), [0.0, 0.5, 1.0, 1.5, 2.0], True)
    """

    control_points: FloatArray
    parameters: FloatArray
    deviation: float
    is_bound: bool = True


def bezier_segments(curve: ParametricCurve) -> FloatArray:
    """Return the Bezier control points of every segment.

    Parameters
    ----------
    curve : ParametricCurve
        Of a family of piecewise polynomials. A `LagrangeCurve` has no segments; see `cubic_path`.

    Returns
    -------
    ndarray, shape (k, degree + 1, dim)
        Of the pieces between ``curve.breaks``, exact but for rounding; limited to +-1e300.

    Raises
    ------
    CurveError
        For a curve of another family.

    See Also
    --------
    bezier_stretch : Exact ones, of any stretch of any polynomial.
    cubic_path : Cubic pieces of any curve.

    Examples
    --------
    >>> from curvecore import HermiteCurve, bezier_segments
    >>> curve = HermiteCurve([[0, 0], [1, 0]], [[0, 3], [0, -3]], [0, 1])
    >>> bezier_segments(curve).tolist()
    [[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]]
    """
    controls = drawable_pieces(curve)
    if controls is None:
        raise CurveError("curve must be of a family of piecewise polynomials to have Bezier segments")
    return controls


def drawable_pieces(curve: ParametricCurve) -> FloatArray | None:
    """Return the Bezier control points of a curve, limited to +-1e300; None where it has none."""
    controls = curve.bezier_pieces()
    return None if controls is None else _limited(controls)


def drawable_chain(curve: ParametricCurve) -> FloatArray | None:
    """Return the Bezier control points of a chain, limited; None where jets do not give them."""
    if not curve.is_local or curve.degree != 2 * curve.jets.shape[1] - 1:
        return None
    # Such pieces are the polynomials through the jets at their ends: all are computed at once.
    h = np.diff(curve.parameters[joint_of_row(curve)])
    inside = h > 0.0
    return _limited(controls_between(curve.jets[:-1][inside], curve.jets[1:][inside], h[inside, None]))


def _limited(controls: FloatArray) -> FloatArray:
    if np.abs(controls).max() <= LIMIT:
        return controls
    np.nan_to_num(controls, copy=False, nan=LIMIT)
    return np.clip(controls, -LIMIT, LIMIT, out=controls)


def cubic_path(curve: ParametricCurve, tolerance: float) -> CubicPath:
    """Return cubic Bezier pieces within a tolerance of the curve.

    Each piece has the curve's points and velocities at its ends, so the path
    is as smooth in direction as the curve.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    tolerance : float
        Largest allowed distance at equal parameters, greater than 0.

    Returns
    -------
    CubicPath
        Its `deviation` says what was reached.

    Raises
    ------
    CurveError
        If the tolerance is not a positive number.

    See Also
    --------
    CubicPath : What it returns.
    bezier_segments : Exact pieces, where there are some.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, chebyshev, cubic_path
    >>> curve = LagrangeCurve([[0, 0], [1, 3], [2, -1], [3, 2], [4, 0], [5, 1]], chebyshev(6))
    >>> path = cubic_path(curve, 1e-3)
    >>> path.deviation <= 1e-3, path.control_points[0, 0].tolist()
    (True, [0.0, 0.0])
    """
    limit = tolerance_value(tolerance)
    if len(curve.pieces) > 1:
        return _joined_paths([cubic_path(piece, limit) for piece in curve.pieces])
    controls = drawable_pieces(curve)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        if controls is None:
            return _measured_path(curve, limit)
        if controls.shape[1] <= 4:
            return CubicPath(elevated(controls, 4 - controls.shape[1]), curve.breaks.copy(), 0.0)
        return _proved_path(curve, controls, limit)


def _joined_paths(paths: list[CubicPath]) -> CubicPath:
    """Return the path along curves, each of which begins where the one before it ends."""
    points, parameters, deviations, bounds = zip(*paths, strict=True)
    return CubicPath(np.concatenate(points), end_to_end(parameters), max(deviations), all(bounds))


def _pieces(curve: ParametricCurve, parameters: FloatArray) -> FloatArray:
    """Return the cubic pieces with the curve's points and velocities."""
    velocities = np.clip(np.nan_to_num(curve.evaluate(parameters, 1)), -LIMIT, LIMIT)
    controls = control_points(np.stack((curve.evaluate(parameters), velocities), axis=1), parameters)
    return _limited(controls)


def _proved_path(curve: ParametricCurve, controls: FloatArray, tolerance: float) -> CubicPath:
    degree = controls.shape[1] - 1
    # The fourth differences of the control points, times this, enclose h**4 c'''' on a segment.
    fourth = math.perm(degree, 4) * np.diff(controls, n=4, axis=1)
    bound = vector_lengths(fourth).max(axis=1) / 384.0
    count = np.clip(np.ceil((bound / tolerance) ** 0.25), 1, MAX_PIECES).astype(np.intp)
    if count.sum() > max(MAX_PIECES, len(count)):
        count = np.maximum(1, count * (MAX_PIECES - len(count)) // count.sum())
    parameters = spread(curve.breaks, count)
    return CubicPath(_pieces(curve, parameters), parameters, float((bound / count**4.0).max()))


def all_joints(curve: ParametricCurve) -> FloatArray:
    """Return the parameters and the breaks of a curve, ascending, each once."""
    return sorted_distinct(np.concatenate((curve.parameters, curve.breaks)))


def sorted_distinct(t: FloatArray) -> FloatArray:
    """Return parameters in order, each once; `numpy.unique` would import all of numpy.ma."""
    t = np.sort(t)
    return t[np.diff(t, prepend=-np.inf) > 0.0]


def equal_parts(count: IntArray) -> tuple[IntArray, IntArray]:
    """Return for all parts of segments, the i-th of count[i] parts, the segment and the number in it."""
    segment = np.repeat(np.arange(len(count)), count)
    return segment, np.arange(len(segment)) - (np.cumsum(count) - count)[segment]


def spread(joints: FloatArray, count: IntArray) -> FloatArray:
    """Divide segment i into count[i] equal pieces; drop parameters that are not distinct."""
    segment, step = equal_parts(count)
    inner = joints[segment] + (joints[segment + 1] - joints[segment]) * (step / count[segment])
    return sorted_distinct(np.append(np.minimum(inner, joints[-1]), joints[-1]))


def _measured_path(curve: ParametricCurve, tolerance: float) -> CubicPath:
    # Two pieces a segment: fewer could step over an oscillation.
    joints = all_joints(curve)
    parameters = spread(joints, np.full(len(joints) - 1, 2))
    is_bound = curve.degree is not None and curve.degree <= _HIGHEST_PROVED
    samples, margin = chebyshev_samples(max(curve.degree or 0, 3)) if is_bound else (_SAMPLES, _MARGIN)
    for _ in range(_ROUNDS):
        pieces = _pieces(curve, parameters)
        deviation = margin * _measured_deviation(curve, parameters, pieces, samples)
        count = np.clip(np.ceil((deviation / tolerance) ** 0.25), 1, 16).astype(np.intp)
        if count.max() == 1 or count.sum() > MAX_PIECES:
            break
        finer = spread(parameters, count)
        if finer.size == parameters.size:
            break
        parameters = finer
    worst = float(deviation.max())
    return CubicPath(pieces, parameters, worst, is_bound and worst > _ROUNDING * float(np.abs(pieces).max()))


def cubic_shape(curve: ParametricCurve, tolerance: float) -> CubicPath:
    """Return few cubic Bezier pieces that follow the shape of a curve within a tolerance.

    The pieces have the curve's directions at their ends, but handles of any length [4]_: they run through the
    shape at a speed of their own, and half as many and fewer follow it. Every point of the curve at which
    pieces of the curve itself meet stays the end of a piece; between two of them all pieces have about the
    same deviation, so that fewer would not do.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    tolerance : float
        Largest allowed distance between the shapes, greater than 0.

    Returns
    -------
    CubicPath
        Its `deviation` bounds the distance of each point of either shape from the other, and is proved as
        that of `cubic_path`; the parameters are those of the curve at the ends of the pieces.

    Raises
    ------
    CurveError
        If the tolerance is not a positive number.

    See Also
    --------
    cubic_path : Pieces that keep the curve's speed, too.

    Examples
    --------
    >>> from curvecore import QuinticHermiteCurve, cubic_path
    >>> from curvecore.bezier.control_points import cubic_shape
    >>> curve = QuinticHermiteCurve([[0, 0], [1, 0]], [[0, 3], [0, -3]], [[9, 0], [-9, 0]], [0, 1])
    >>> [len(path(curve, 1e-4).control_points) for path in (cubic_path, cubic_shape)]
    [10, 4]
    """
    limit = tolerance_value(tolerance)
    if len(curve.pieces) > 1:
        return _joined_paths([cubic_shape(piece, limit) for piece in curve.pieces])
    joints, is_cubic = all_joints(curve), curve.degree is not None and curve.degree <= 3
    if (is_cubic and curve.bezier_pieces() is not None) or len(joints) > MAX_PIECES:
        return cubic_path(curve, limit)
    with np.errstate(all="ignore"):
        return _shape_between(curve, joints, limit) or cubic_path(curve, limit)


def _shape_between(curve: ParametricCurve, joints: FloatArray, tolerance: float) -> CubicPath | None:
    """Return the fewest pieces found between all joints; None where these would be too many."""
    is_proved = curve.degree is not None and curve.degree <= _HIGHEST_PROVED
    degree = _WARP_DEGREE * (curve.degree or 0) if is_proved else _UNKNOWN_DEGREE
    samples, margin = chebyshev_samples(degree)
    parameters, count = joints, np.ones(len(joints) - 1, dtype=np.intp)
    is_spread = np.ones(len(count), dtype=bool)
    for _ in range(2 * _ROUNDS):
        pieces, deviation = _nearest_pieces(curve, parameters, samples, margin)
        first = np.cumsum(count) - count
        worst = np.maximum.reduceat(deviation, first)
        if (worst <= tolerance).all():
            size = float(np.abs(pieces).max())
            is_bound = is_proved and float(worst.max()) > _ROUNDING * size
            return CubicPath(pieces, parameters, float(worst.max()), is_bound)
        # As many pieces again with equal deviations, which are of order h**6; then more of them.
        expected = np.maximum(count + is_spread, np.floor(0.7 * count * (worst / tolerance) ** (1 / 6)))
        wanted = np.where(worst > tolerance, expected, count)
        if not wanted.sum() <= MAX_PIECES:
            return None
        is_spread, before = wanted == count, count
        count = wanted.astype(np.intp)
        share = np.maximum(deviation, 1e-3 * np.repeat(worst, before)) ** (1 / 6)
        share[np.repeat(worst <= tolerance, before)] = 1.0
        share *= np.repeat(count / np.add.reduceat(share, first), before)
        ends = np.append(0, np.cumsum(count))
        reached = np.append(0.0, np.cumsum(share))
        reached[np.append(first, len(share))] = ends
        parameters = np.interp(np.arange(ends[-1] + 1), reached, parameters)
        parameters[ends] = joints
        if not (np.diff(parameters) > 0.0).all():
            return None
    return None


def _nearest_pieces(
    curve: ParametricCurve, parameters: FloatArray, samples: FloatArray, margin: float
) -> tuple[FloatArray, FloatArray]:
    """Return a cubic piece for each stretch, the better of two, and how far it is from the curve at most.

    One has the curve's velocities. The handles of the other are lengthened so that it is nearest across the
    curve, by least squares at `_NODES`; a polynomial t(s) with the speeds of its ends, a "warp" of
    `_WARP_DEGREE`, says for each of its points which one of the curve is near. As t(s) takes all values of
    the stretch and no others, |piece(s) - curve(t(s))|, a polynomial again, bounds the distance of the
    shapes.
    """
    plain, steps = _pieces(curve, parameters), np.diff(parameters)[:, None]
    factors, warps = _longer_handles(curve, parameters, plain)
    pieces = _lengthened(plain, factors)
    worst = []
    for piece, factor, warp in ((plain, np.ones_like(factors), 0.0 * warps), (pieces, factors, warps)):
        share = _warped(np.broadcast_to(samples, (len(plain), len(samples))), factor, warp)
        t = parameters[:-1, None] + steps * np.clip(share, 0.0, 1.0)
        exact = np.clip(curve.evaluate(t.ravel()).reshape(*t.shape, -1), -LIMIT, LIMIT)
        distance = margin * vector_lengths(weights(samples, 3) @ piece - exact).max(axis=1)
        worst.append(np.where(np.abs(share - 0.5).max(axis=1) <= 0.5, distance, np.inf))
    is_plain = ~(worst[1] < worst[0])
    return np.where(is_plain[:, None, None], plain, pieces), np.where(is_plain, *worst)


def _longer_handles(
    curve: ParametricCurve, parameters: FloatArray, plain: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return factors of the handles of cubic pieces, (k, 2), and the two coefficients of their warps."""
    t = parameters[:-1, None] + np.diff(parameters)[:, None] * _NODES
    exact, along = (curve.evaluate(t.ravel(), order).reshape(*t.shape, -1) for order in (0, 1))
    along = along / np.maximum(vector_lengths(along), 1 / LIMIT)[..., None]
    handles = np.stack([plain[:, 1] - plain[:, 0], plain[:, 2] - plain[:, 3]], axis=1)
    # Where a length changes nothing, as on a straight line, it stays.
    least = 1e-9 * np.square(handles).sum(axis=(1, 2))[:, None, None] * np.eye(2) + np.eye(2) / LIMIT
    s, factors = np.broadcast_to(_NODES, t.shape), np.ones((len(plain), 2))
    for _ in range(3):
        bernstein = weights(s.ravel(), 3).reshape(*s.shape, 4)
        moves = bernstein[..., 1:3, None] * handles[:, None]
        off = np.concatenate([moves, (exact - bernstein @ plain)[..., None, :]], axis=2)
        off = off - np.einsum("kmid,kmd->kmi", off, along)[..., None] * along[..., None, :]
        moves, off = off[:, :, :2], off[:, :, 2]
        square = np.einsum("kmid,kmjd->kij", moves, moves) + least
        change = np.linalg.solve(square, np.einsum("kmid,kmd->ki", moves, off)[..., None])[..., 0]
        factors = np.clip(1.0 + change, 0.05, 5.0)
        pieces = _lengthened(plain, factors)
        velocities = weights(s.ravel(), 2).reshape(*s.shape, 3) @ (3.0 * np.diff(pieces, axis=1))
        ahead = np.einsum("kmd,kmd->km", exact - bernstein @ pieces, velocities)
        s = np.clip(s + ahead / np.maximum(np.square(velocities).sum(axis=2), 1 / LIMIT), 0.0, 1.0)
    bumps = np.stack([(s * (1 - s)) ** 2, s**3 * (1 - s) ** 2], axis=2)
    square = np.einsum("kmi,kmj->kij", bumps, bumps) + 1e-12 * np.eye(2)
    missing = _NODES - _warped(s, factors, np.zeros_like(factors))
    warps: FloatArray = np.linalg.solve(square, np.einsum("kmi,km->ki", bumps, missing)[..., None])[..., 0]
    return factors, warps


def _lengthened(pieces: FloatArray, factors: FloatArray) -> FloatArray:
    """Return cubic pieces (k, 4, dim) with handles as many times as long, (k, 2)."""
    ends = pieces[:, ::3]
    handles = ends + factors[:, :, None] * (pieces[:, 1:3] - ends)
    return np.concatenate([ends[:, :1], handles, ends[:, 1:]], axis=1)


def _warped(s: FloatArray, factors: FloatArray, warps: FloatArray) -> FloatArray:
    """Return t(s) on [0, 1] with these speeds at the ends; two coefficients weight terms that are 0 there."""
    r = 1.0 - s
    start, end, level, slope = (column[:, None] for column in (*factors.T, *warps.T))
    cubic = r * r * s * start + r * s * s * (3.0 - end) + s**3
    return np.asarray(cubic + (r * s) ** 2 * (level + slope * s))


def chebyshev_samples(degree: int) -> tuple[FloatArray, float]:
    """Return s in (0, 1), and how much larger polynomials of this degree can be between them [3]_."""
    count = math.ceil(2.4 * degree) + 2
    samples = 0.5 - 0.5 * np.cos((np.arange(count) + 0.5) * (np.pi / count))
    return samples, 1.0 / math.cos(degree * math.pi / (2.0 * count))


def _measured_deviation(
    curve: ParametricCurve, parameters: FloatArray, pieces: FloatArray, samples: FloatArray
) -> FloatArray:
    t = parameters[:-1, None] + np.diff(parameters)[:, None] * samples
    exact = curve.evaluate(t.ravel()).reshape(*t.shape, -1)
    approximate = weights(samples, 3) @ pieces
    return np.asarray(vector_lengths(approximate - np.clip(exact, -LIMIT, LIMIT)).max(axis=1))
