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
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import LIMIT, vector_lengths
from curvecore.arrays import FloatArray, IntArray, end_to_end, tolerance_value
from curvecore.bezier.bernstein import control_points, elevated, weights
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve

MAX_PIECES = 1 << 12
"""`cubic_path` never returns more pieces than this, or one a segment if there are more segments."""

_SAMPLES = np.arange(1, 12) / 12.0  # where a cubic piece is compared with what is no polynomial
_MARGIN = 1.25  # on the measured deviation, for what lies between the samples
_HIGHEST_PROVED = 30  # degree up to which so many samples are taken that their margin is proved
_ROUNDING = 1e-12  # of the coordinates: differences below this are those of rounding, which has no degree
_ROUNDS = 24


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
        paths = [cubic_path(piece, limit) for piece in curve.pieces]
        points, parameters, deviations, bounds = zip(*paths, strict=True)
        return CubicPath(np.concatenate(points), end_to_end(parameters), max(deviations), all(bounds))
    controls = drawable_pieces(curve)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        if controls is None:
            return _measured_path(curve, limit)
        if controls.shape[1] <= 4:
            return CubicPath(elevated(controls, 4 - controls.shape[1]), curve.breaks.copy(), 0.0)
        return _proved_path(curve, controls, limit)


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
    worst: FloatArray = vector_lengths(approximate - np.clip(exact, -LIMIT, LIMIT)).max(axis=1)
    return worst
