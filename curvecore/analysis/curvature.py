"""Speed and curvature of a curve, its inflections, extrema of curvature and of coordinates.

Signs and extrema of the curvature do not depend on how fast t runs: they are roots of
polynomials in Bernstein form on the pieces of the curve, which are found by
subdivision, all of them and without starting values.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, section 11.5: curvature and its sign.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.sensitivity import sums_of_data
from curvecore.arithmetic import LARGEST, UNIT_ROUNDOFF, cross, vector_lengths
from curvecore.arrays import BoolArray, FloatArray, IntArray, parameter_row, parameter_values, require_plane
from curvecore.bezier.bernstein import (
    derivative,
    end_signs,
    product,
    sign_changes,
    squared_length,
)
from curvecore.bezier.pieces import BezierPieces, bezier_pieces, parameters_at
from curvecore.errors import CurveError
from curvecore.families.chain import joint_of_row
from curvecore.families.curve import ParametricCurve

_ROUNDINGS = 25.0 * UNIT_ROUNDOFF  # of derivatives, for each unit of the sizes of their terms
_KINK = 1e-6  # curvatures at a joint that differ by less, relatively, are one extremum and not a jump


class CurvatureExtrema(NamedTuple):
    """Local extrema of the curvature of a plane curve.

    Attributes
    ----------
    parameters : ndarray, shape (k,)
        Ascending.
    curvatures : ndarray, shape (k,)
        Signed.
    is_maximum : ndarray of bool, shape (k,)
        Whether the signed curvature is largest there, not smallest.

    See Also
    --------
    curvature_extrema : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, curvature_extrema
    >>> extrema = curvature_extrema(LagrangeCurve([[-1, 1], [0, 0], [1, 1]], [0, 1, 2]))
    >>> extrema.parameters.round(9).tolist(), extrema.curvatures.round(9).tolist()
    ([1.0], [2.0])
    """

    parameters: FloatArray
    curvatures: FloatArray
    is_maximum: BoolArray


def speed(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return |c'(t)|, in units of length per unit of t.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    t : float or array_like of any shape
        Finite, inside the domain or not.

    Returns
    -------
    ndarray, of the shape of t
        With the accuracy of `curvature`.

    See Also
    --------
    arc_length : Its integral.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, speed
    >>> float(speed(LagrangeCurve([[0, 0], [3, 4]], [0, 1]), 0.5))
    5.0
    """
    at = parameter_values(t)
    (velocity,) = curve.derivatives_at(at.values, (1,))
    return at.shaped(vector_lengths(velocity))


def curvature(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return the curvature, in units of 1 / length.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2 or more.
    t : float or array_like of any shape
        Finite, inside the domain or not; at a joint the segment to the right counts.

    Returns
    -------
    ndarray, of the shape of t
        In the plane signed, positive where the curve turns from x to y; in
        space not negative. NaN where c'(t) = 0: there is none at a point at
        rest. Limited to the largest finite number.

    Raises
    ------
    CurveError
        If the curve has dim 1, or t is unusable.

    See Also
    --------
    curvature_error : What rounding may make of it.
    curvature_of : From derivatives that are there already.
    curvature_extrema, inflections : Where it is special.

    Notes
    -----
    |c' x c''| / |c'|**3. Many
    parameters of one `LagrangeCurve` take a short cut: derivatives at the t_i
    and interpolation of these, with errors up to the Lebesgue function
    times larger, and only where that is below 1e5.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, curvature
    >>> curve = LagrangeCurve([[-1, 1], [0, 0], [1, 1]], [-1, 0, 1])
    >>> round(float(curvature(curve, 0)), 9)
    2.0
    >>> curvature(curve, [-1, 1]).round(6).tolist()
    [0.178885, 0.178885]
    """
    at = parameter_values(t)
    velocity, acceleration = curve.derivatives_at(at.values, (1, 2))
    return at.shaped(curvature_of(velocity, acceleration))


@np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore")
def curvature_error(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return a bound of the rounding errors of `curvature`, in units of 1 / length.

    Parameters
    ----------
    curve : ParametricCurve
        Of dim 2 or more.
    t : float or array_like, shape (m,)
        Finite; a scalar counts as m = 1.

    Returns
    -------
    ndarray, shape (m,)
        A bound for the points as they are stored; infinity where rounding may bring the curve to rest, as at
        a cusp.

    See Also
    --------
    curvature : The value.

    Notes
    -----
    The derivatives are off by 25 u sum |B_ir^(order)(t)| |d_ir| at most, velocities counting no less than the
    chords beside them, and by what is lost where they are differences; |grad| of the curvature is at most
    1 / |c'|**2 by c'' and 2 |c''| / |c'|**3 by c'.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, curvature_error
    >>> curve = LagrangeCurve([[-1, 1], [0, 0], [1, 1]], [-1, 0, 1])
    >>> bool(curvature_error(curve, 0)[0] < 1e-13)
    True
    """
    at, sizes = parameter_row(t), vector_lengths(curve.jets)
    if sizes.shape[1] > 1:
        # Velocities that a rule estimates are off as slopes of chords are, which may cancel in them.
        steps = vector_lengths(np.diff(curve.jets[:, 0], axis=0))
        slopes = np.nan_to_num(steps / np.diff(curve.parameters[joint_of_row(curve)]))
        sizes[:, 1] = np.maximum(sizes[:, 1], np.maximum(np.append(slopes, 0.0), np.append(0.0, slopes)))
    velocity, acceleration = map(vector_lengths, curve.derivatives_at(at, (1, 2)))
    shares = (_ROUNDINGS + 10.0**-digits for digits in curve.difference_digits or (np.inf, np.inf))
    pairs = zip(shares, (1, 2), strict=False)
    off_velocity, off_acceleration = (share * sums_of_data(curve, at, sizes, order) for share, order in pairs)
    slowest = velocity - off_velocity
    off_turn = off_acceleration + 2.0 * (acceleration + off_acceleration) * off_velocity / slowest
    return np.where(slowest > 0.0, off_turn / slowest**2, np.inf)


def curvature_of(velocities: FloatArray, accelerations: FloatArray) -> FloatArray:
    """Return curvatures from derivatives that the caller has already.

    Parameters
    ----------
    velocities, accelerations : ndarray, shape (m, dim)
        c' and c'', dim >= 2.

    Returns
    -------
    ndarray, shape (m,)
        As `curvature`.

    See Also
    --------
    curvature : Of a curve at t.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import curvature_of
    >>> curvature_of(np.array([[1.0, 0.0]]), np.array([[0.0, 2.0]])).tolist()
    [2.0]
    """
    if velocities.shape[1] < 2:
        raise CurveError("curve must have dim 2 or more to have a curvature")
    largest = np.abs(velocities).max(axis=1, keepdims=True)
    with np.errstate(all="ignore"):
        # Dividing by the largest entry twice keeps squares in range and cancels in the end.
        direction, change = velocities / largest, accelerations / largest
        length = vector_lengths(direction)
        if velocities.shape[1] == 2:
            turn = cross(direction, change)
        else:
            unit = direction / length[:, None]
            across = change - (change * unit).sum(axis=1)[:, None] * unit
            turn = length * vector_lengths(across)
        result: FloatArray = turn / length**3 / largest[:, 0]
    return np.where(largest[:, 0] > 0.0, np.clip(result, -LARGEST, LARGEST), np.nan)


@np.errstate(under="ignore")
def inflections(curve: ParametricCurve) -> FloatArray:
    """Return the parameters where the curvature changes its sign.

    Parameters
    ----------
    curve : ParametricCurve
        Plane (dim 2).

    Returns
    -------
    ndarray, shape (k,)
        Ascending, inside the domain. A joint where the curvature jumps from
        one sign to the other is one; a straight part between opposite bends
        counts once, at its end.

    Raises
    ------
    CurveError
        If the curve is not plane.

    See Also
    --------
    curvature : Its values.
    curvature_extrema : Where it is largest or least.

    Notes
    -----
    Roots of c' x c''. Where that is below some 50 roundings of |c'| |c''|
    the curve counts as straight.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, inflections
    >>> curve = LagrangeCurve([[-2, -8], [-1, -1], [1, 1], [2, 8]], [0, 1, 3, 4])
    >>> inflections(curve).round(9).tolist()
    [2.0]
    """
    require_plane(curve.points, "have inflections")
    pieces = bezier_pieces(curve)
    return _crossings(pieces, *_turn(pieces)).parameters


@np.errstate(under="ignore")
def curvature_extrema(curve: ParametricCurve) -> CurvatureExtrema:
    """Return the local maxima and minima of the signed curvature of a plane curve, inside the domain.

    At joints where the curvature jumps there is none, nor on arcs of circles
    and straight parts.

    Parameters
    ----------
    curve : ParametricCurve
        Plane, of any family.

    Returns
    -------
    CurvatureExtrema
        Ascending in t.

    Raises
    ------
    CurveError
        If the curve is not plane.

    See Also
    --------
    curvature : Its values.
    inflections : Where it changes its sign.

    Notes
    -----
    With N = c' x c'' and q = |c'|**2 the curvature is N / q**(3/2), and its
    derivative has the sign of 2 N' q - 3 N q', a polynomial of degree 14 for
    a quintic piece.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, curvature_extrema
    >>> extrema = curvature_extrema(LagrangeCurve([[-1, 1], [0, 0], [1, 1]], [0, 1, 2]))
    >>> extrema.parameters.round(9).tolist(), extrema.is_maximum.tolist()
    ([1.0], [True])
    """
    require_plane(curve.points, "have extrema of curvature")
    pieces = bezier_pieces(curve)
    turn, turn_noise = _turn(pieces)
    square = squared_length(pieces.slopes)
    rising, falling = product(derivative(turn), square), product(turn, derivative(square))
    degree = pieces.controls.shape[1]
    scale = np.abs(rising).max(axis=1) + np.abs(falling).max(axis=1)
    noise = 64.0 * UNIT_ROUNDOFF * scale + 4.0 * degree * turn_noise * square.max(axis=1)
    crossings = _crossings(pieces, 2.0 * rising - 3.0 * falling, noise)
    steady = crossings.piece < 0
    ends = np.maximum(crossings.piece, 1)
    second = derivative(pieces.slopes)
    before, after = (curvature_of(pieces.slopes[:, side], second[:, side]) for side in (-1, 0))
    with np.errstate(invalid="ignore"):
        jump = np.abs(before[ends - 1] - after[ends % len(after)])
        steady |= jump <= _KINK * np.abs(after[ends % len(after)])
    t = crossings.parameters[steady]
    return CurvatureExtrema(t, curvature(curve, t), ~crossings.rising[steady])


@np.errstate(under="ignore")
def coordinate_extrema(curve: ParametricCurve, axis: int) -> FloatArray:
    """Return the parameters where a coordinate has a local maximum or minimum, inside the domain.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    axis : int
        The coordinate: 0 for x, 1 for y.

    Returns
    -------
    ndarray, shape (k,)
        Ascending. A corner at which the coordinate turns back is one; a stretch on which it is constant
        between a rise and a fall counts once, at its end.

    See Also
    --------
    bounding_box : The box that the extrema of all coordinates define.

    Notes
    -----
    Roots of the derivative of the coordinate; what rounding may have left of a 0 counts as 0.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, coordinate_extrema
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> coordinate_extrema(curve, 0).tolist(), coordinate_extrema(curve, 1).tolist()
    ([], [1.0])
    """
    pieces = bezier_pieces(curve)
    return _crossings(pieces, pieces.slopes[..., axis], pieces.slope_error).parameters


def _turn(pieces: BezierPieces) -> tuple[FloatArray, FloatArray]:
    """Return c' x c'' for every piece, and the size below which it says nothing."""
    velocity = pieces.slopes
    acceleration = derivative(velocity)
    (vx, vy), (ax, ay) = (vectors.transpose(2, 0, 1) for vectors in (velocity, acceleration))
    turn = product(vx, ay) - product(vy, ax)
    degree = velocity.shape[1]
    fast, bent = (np.abs(vectors).max(axis=(1, 2)) for vectors in (velocity, acceleration))
    # An error of c' grows by twice the degree squared at most when it is differentiated (Markov).
    noise = pieces.slope_error * (bent + 2.0 * degree**2 * fast)
    return turn, noise + 8.0 * UNIT_ROUNDOFF * fast * bent


class _Crossings(NamedTuple):
    """Changes of sign of a piecewise polynomial.

    Attributes
    ----------
    parameters : ndarray, shape (k,)
        Ascending.
    rising : ndarray of bool, shape (k,)
        Whether it is positive afterwards.
    piece : ndarray of int, shape (k,)
        The piece that begins there, -1 inside a piece.
    """

    parameters: FloatArray
    rising: BoolArray
    piece: IntArray


def _crossings(pieces: BezierPieces, coefficients: FloatArray, noise: FloatArray) -> _Crossings:
    roots = sign_changes(coefficients, noise)
    inner = parameters_at(pieces, roots.piece, roots.s)
    first, last = end_signs(coefficients, noise, 1), end_signs(coefficients, noise, -1)
    rows: list[tuple[float, bool, int]] = []
    bounds = np.searchsorted(roots.piece, np.arange(len(coefficients) + 1))
    before = 0.0
    for piece in np.flatnonzero(first):
        if before * first[piece] < 0.0:
            rows.append((float(pieces.starts[piece]), bool(first[piece] > 0.0), int(piece)))
        rising = bool(first[piece] > 0.0)
        for t in inner[bounds[piece] : bounds[piece + 1]]:
            rising = not rising
            rows.append((float(t), rising, -1))
        before = last[piece]
    table = np.array(rows, dtype=np.float64).reshape(-1, 3)
    return _Crossings(table[:, 0], table[:, 1] > 0.0, table[:, 2].astype(np.intp))
