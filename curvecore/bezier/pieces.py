"""Curves of any family as Bezier pieces of low degree.

The Hermite families have them exactly. One polynomial of high degree gets
pieces of degree at most 8, by interpolation at Chebyshev points of as many
intervals as the tolerance asks for; the decay of the Chebyshev coefficients
says what was left out [1]_. Everything geometric - lengths, distances,
crossings - then works on pieces, and on all of them at once.

References
----------
.. [1] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, chapters 3, 4 and 8.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import SMALLEST, UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, IntArray
from curvecore.bezier.bernstein import derivative, elevated, to_bernstein, to_chebyshev
from curvecore.bezier.control_points import MAX_PIECES, all_joints, spread
from curvecore.families.curve import ParametricCurve
from curvecore.parametrization import chebyshev

_DEGREE = 8
FINE = 2.0**-46
"""Share of the size of a curve within which pieces follow it where its shape is asked for."""
_POINTS = 2 * _DEGREE + 1
_ROUNDS = 12


class BezierPieces(NamedTuple):
    """Bezier pieces that follow a curve at equal parameters.

    Attributes
    ----------
    controls : ndarray, shape (k, degree + 1, dim)
        Control points times 2**-exponent: at most about 1 in size.
    slopes : ndarray, shape (k, degree, dim)
        Control points of the derivative with respect to the local s in
        [0, 1], in the same units; for the Hermite families from the data, so
        that their errors do not depend on how far away the origin is.
    starts, ends : ndarray, shape (k,)
        Where each piece begins and ends in t. Each piece begins where the one
        before ends.
    error : ndarray, shape (k,)
        What each may deviate, in the units of `controls`: rounding for the
        Hermite families, measured for `LagrangeCurve`.
    slope_error : ndarray, shape (k,)
        What `slopes` may be off.
    exponent : int
        See `controls`.
    """

    controls: FloatArray
    slopes: FloatArray
    starts: FloatArray
    ends: FloatArray
    error: FloatArray
    slope_error: FloatArray
    exponent: int


def bezier_pieces(curve: ParametricCurve, tolerance: float = FINE) -> BezierPieces:
    """Return pieces of a curve.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    tolerance : float, optional
        The deviation that is aimed at, relative to the curve's size; not
        reached where rounding or `MAX_PIECES` do not allow it.
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        if len(curve.pieces) > 1:
            return joined_pieces([bezier_pieces(piece, tolerance) for piece in curve.pieces])
        controls = curve.bezier_pieces()
        if controls is None:
            return _sampled(curve, tolerance)
        exact = np.zeros(len(controls))
        pieces = _scaled(controls, curve.breaks, exact, exact, 0)
        slopes = curve.bezier_slopes(pieces.exponent)
        return pieces if slopes is None else pieces._replace(slopes=slopes.values, slope_error=slopes.error)


def alike(parts: Sequence[BezierPieces]) -> list[IntArray]:
    """Return the indices of curves whose pieces have one degree and dim: their arrays can be joined."""
    shapes = [part.controls.shape[1:] for part in parts]
    return [
        np.array([index for index, shape in enumerate(shapes) if shape == wanted])
        for wanted in dict.fromkeys(shapes)
    ]


def size_of(controls: FloatArray) -> float:
    """Return the largest extent of control points along any axis, or the smallest double if it is 0."""
    flat = controls.reshape(-1, controls.shape[-1])
    return max(float((flat.max(axis=0) - flat.min(axis=0)).max()), SMALLEST)


def parameters_at(pieces: BezierPieces, piece: np.ndarray, s: FloatArray) -> FloatArray:
    """Return the parameters t of local parameters s in [0, 1] of pieces."""
    start, end = pieces.starts[piece], pieces.ends[piece]
    with np.errstate(under="ignore"):
        return np.asarray(np.minimum(start + s * (end - start), end))


def _scaled(
    controls: FloatArray, parameters: FloatArray, error: FloatArray, slope_error: FloatArray, base: int
) -> BezierPieces:
    """Scale pieces, whose controls are in units of 2**base, to a size of about 1."""
    _, exponent = np.frexp(np.abs(controls).max())
    scaled = np.ldexp(controls, -exponent)
    # Each control point is a sum of a few terms of the size of the largest one.
    noise = 8.0 * UNIT_ROUNDOFF * np.abs(scaled).max(axis=(1, 2))
    degree = controls.shape[1] - 1
    return BezierPieces(
        scaled,
        derivative(scaled),
        parameters[:-1],
        parameters[1:],
        np.ldexp(error, -exponent) + noise,
        np.ldexp(slope_error, -exponent) + 2.0 * degree * noise,
        int(exponent) + base,
    )


def joined_pieces(parts: list[BezierPieces]) -> BezierPieces:
    """Return all pieces of several parts, of the highest degree among them and in one unit."""
    degree = max(part.controls.shape[1] for part in parts)
    exponent = max(part.exponent for part in parts)
    columns = []
    for part in parts:
        shift, by = part.exponent - exponent, degree - part.controls.shape[1]
        shapes = (np.ldexp(elevated(numbers, by), shift) for numbers in (part.controls, part.slopes))
        errors = (np.ldexp(numbers, shift) for numbers in (part.error, part.slope_error))
        columns.append((*shapes, part.starts, part.ends, *errors))
    return BezierPieces._make([*map(np.concatenate, zip(*columns, strict=True)), exponent])


def _sampled(curve: ParametricCurve, tolerance: float) -> BezierPieces:
    degree = _DEGREE if curve.degree is None else min(curve.degree, _DEGREE)
    parameters = all_joints(curve)
    for step in range(_ROUNDS):
        coefficients, size, base = _chebyshev(curve, parameters)
        rest = np.linalg.norm(coefficients[:, degree + 1 :], axis=-1)
        error = rest.sum(axis=1)
        # Values are below 1, and no better than their roundings, however small the curve is.
        wanted = max(tolerance * size, 64.0 * UNIT_ROUNDOFF)
        # The coefficients of degree above 8 shrink at least as 2**-9 when an interval is halved.
        poor = (error > wanted) & (np.diff(parameters) > 1e-12 * (parameters[-1] - parameters[0]))
        if degree == curve.degree or not poor.any() or step == _ROUNDS - 1:
            break
        if len(error) + poor.sum() > MAX_PIECES:
            break
        need = np.clip(np.ceil((error / wanted) ** (1.0 / (_DEGREE + 1))), 2, 4)
        finer = spread(parameters, np.where(poor, need, 1).astype(np.intp))
        if finer.size == parameters.size:
            break
        parameters = finer
    controls = to_bernstein(degree) @ coefficients[:, : degree + 1]
    # Coefficients as small as rounding are none of the polynomial's own.
    noise = 8.0 * UNIT_ROUNDOFF * np.abs(coefficients[:, 0]).max(axis=1, initial=0.0)
    orders = np.arange(degree + 1, _POINTS, dtype=np.float64)
    # |T_k'| <= k**2 on an interval of length 2.
    slope_error = 2.0 * (np.maximum(rest - noise[:, None], 0.0) @ np.square(orders) + degree * noise)
    for column, ends in ((0, parameters[:-1]), (-1, _from_inside(curve, parameters[1:]))):
        controls[:, column] = np.ldexp(curve.evaluate(ends), -base)
    return _scaled(controls, parameters, 2.0 * error, 2.0 * slope_error, base)


def _from_inside(curve: ParametricCurve, ends: FloatArray) -> FloatArray:
    """Return ends of intervals at which to evaluate: where the curve may jump, the parameters before."""
    if curve.is_continuous:
        return ends
    return np.where(np.isin(ends, curve.breaks[1:-1]), np.nextafter(ends, -np.inf), ends)


def _chebyshev(curve: ParametricCurve, parameters: FloatArray) -> tuple[FloatArray, float, int]:
    """Return Chebyshev coefficients on every interval, shape (k, 17, dim), and the curve's size.

    Both are in units of a power of two, whose exponent is returned too.
    """
    t = parameters[:-1, None] + np.diff(parameters)[:, None] * chebyshev(_POINTS)
    t = np.minimum(t, _from_inside(curve, parameters[1:])[:, None])
    sampled = curve.evaluate(t.ravel()).reshape(*t.shape, -1)
    _, base = np.frexp(np.abs(sampled).max())
    sampled = np.ldexp(sampled, -base)
    return to_chebyshev(_POINTS - 1) @ sampled, size_of(sampled), int(base)
