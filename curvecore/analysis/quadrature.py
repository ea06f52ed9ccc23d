"""Arcs of curves whose lengths a quadrature gives within a bound: the arithmetic behind `lengths`.

Arcs of many curves are worked on together, because what a small curve costs is the number of calls to NumPy,
not the arithmetic. `lengths` has the mathematics and the literature.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import SMALLEST, UNIT_ROUNDOFF
from curvecore.arrays import BoolArray, FloatArray, IntArray, read_only
from curvecore.bezier.bernstein_algebra import halves, weights
from curvecore.bezier.chebyshev import to_chebyshev
from curvecore.bezier.pieces import BezierPieces
from curvecore.parametrization import chebyshev

_GAUSS_POINTS = 16
_ROUNDS = 60
_MOST = 1 << 14  # arcs, or 8 a piece; a curve that needs more gets a larger error bound
_AT_ONCE = 1 << 12  # quadratures, of 16 sets of weights each: a few megabytes
_RHO = np.array([1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 12.0, 24.0, 64.0, 1024.0])


class SpeedArcs(NamedTuple):
    """Stretches of curves, of each in order, with what is known of their lengths.

    Attributes
    ----------
    slopes : ndarray, shape (k, d, dim)
        Bezier control points of dc/ds, s in [0, 1] on the stretch.
    start, end : ndarray, shape (k,)
        In t.
    slack : ndarray, shape (k,)
        What the length may be off because `slopes` is.
    curve : ndarray of int, shape (k,)
        Which curve each belongs to; ascending.
    """

    slopes: FloatArray
    start: FloatArray
    end: FloatArray
    slack: FloatArray
    curve: IntArray

    def taken(self, chosen: BoolArray | IntArray) -> SpeedArcs:
        """Return some of the arcs."""
        return SpeedArcs._make(each[chosen] for each in self)


def arcs_of(parts: Sequence[BezierPieces], shifts: Sequence[int]) -> SpeedArcs:
    """Return the pieces of curves as arcs, those of curve i in units of 2**shifts[i].

    All have one degree and dim.
    """
    counts = [len(part.starts) for part in parts]
    up = np.repeat([part.exponent - shift for part, shift in zip(parts, shifts, strict=True)], counts)
    slopes = np.concatenate([part.slopes for part in parts])
    error = np.concatenate([part.error for part in parts])
    slope_error = np.concatenate([part.slope_error for part in parts])
    return SpeedArcs(
        np.ldexp(slopes, up[:, None, None]),
        np.concatenate([part.starts for part in parts]),
        np.concatenate([part.ends for part in parts]),
        np.ldexp(_slack(slopes, error, slope_error), up),
        np.repeat(np.arange(len(parts)), counts),
    )


def _slack(slopes: FloatArray, error: FloatArray, slope_error: FloatArray) -> FloatArray:
    """Bound what errors of the pieces make of their lengths, (k,), in the units of their control points.

    An error e of c makes |c' + e'| - |c'| of the speed: at most |e'|, and between T . e' and that plus
    |e'|**2 / (2 |c'|), with the tangent T. The integral of T . e' is, by parts, at most |e| times the angle
    by which the piece turns; what is left at its ends goes with its neighbours', where the curve has no
    corner, and is 0 at the ends of the curve and of exact pieces. The control polygon turns as far, at least.
    """
    fast = slopes / np.maximum(np.linalg.norm(slopes, axis=2, keepdims=True), SMALLEST)
    ahead = fast.sum(axis=1)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    slowest = (slopes @ ahead[:, :, None]).min(axis=(1, 2))
    # Chords of the unit circle, pi / 2 times at most as long in angles.
    turn = 0.5 * np.pi * np.linalg.norm(np.diff(fast, axis=1), axis=2).sum(axis=1)
    smooth = error * (turn + 4.0 * UNIT_ROUNDOFF) + 0.5 * slope_error**2 / slowest
    return np.where(slowest > slope_error, np.minimum(smooth, slope_error), slope_error)


def made_accurate(arcs: SpeedArcs, tolerances: FloatArray) -> tuple[SpeedArcs, FloatArray]:
    """Halve arcs until the lengths of all curves are accurate; return them in order with their error bounds.

    Each curve has its own tolerance, in its own units, and its own limit of how many arcs it may be cut into.
    """
    curves = len(tolerances)
    done: list[SpeedArcs] = []
    errors: list[FloatArray] = []
    own = np.bincount(arcs.curve, minlength=curves)
    after = np.cumsum(own)
    span = (arcs.end[after - 1] - arcs.start[after - own])[arcs.curve]
    share = (0.5 * tolerances / own)[arcs.curve]
    count, most = np.zeros(curves, dtype=np.intp), np.maximum(_MOST, 8 * own)
    for step in range(_ROUNDS):
        bound, polygon = _bounds(arcs.slopes)
        # Both halves of an arc together get what it had: the shares of all add up to the tolerance.
        fine = (bound <= share) | (bound <= 2.0 * UNIT_ROUNDOFF * polygon)
        fine |= arcs.end - arcs.start <= 4.0 * UNIT_ROUNDOFF * span
        count += np.bincount(arcs.curve[fine], minlength=curves)
        wanted = count + 2 * np.bincount(arcs.curve[~fine], minlength=curves)
        fine |= (wanted > most)[arcs.curve] | (step == _ROUNDS - 1)
        done.append(arcs.taken(fine))
        errors.append(bound[fine])
        if fine.all():
            break
        arcs, span = _halved(arcs.taken(~fine)), np.tile(span[~fine], 2)
        share = np.tile(0.5 * share[~fine], 2)
    together = SpeedArcs(*(np.concatenate(column) for column in zip(*done, strict=True)))
    order = np.lexsort((together.start, together.curve))
    return together.taken(order), np.concatenate(errors)[order]


def _halved(arcs: SpeedArcs) -> SpeedArcs:
    left, right = halves(0.5 * arcs.slopes)
    middle = 0.5 * arcs.start + 0.5 * arcs.end
    return SpeedArcs(
        np.concatenate([left, right]),
        np.concatenate([arcs.start, middle]),
        np.concatenate([middle, arcs.end]),
        np.tile(0.5 * arcs.slack, 2),
        np.tile(arcs.curve, 2),
    )


def _bounds(slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return bounds of the errors of the quadrature, and the control polygons' lengths."""
    polygon = np.linalg.norm(slopes, axis=2).mean(axis=1)
    chord = np.linalg.norm(slopes.mean(axis=1), axis=1)
    rough = np.maximum(polygon - chord, 0.0)
    degree = slopes.shape[1] - 1
    evaluation, transform = _square_matrices(degree)
    q = np.square(evaluation @ slopes).sum(axis=2)
    coefficients = np.abs(q @ transform.T)
    k = np.arange(1, len(transform))
    growth = 0.5 * (_RHO[:, None] ** k + _RHO[:, None] ** -k)
    rest = coefficients[:, 1:] @ growth.T
    free = rest < coefficients[:, :1]
    largest = np.sqrt(coefficients[:, :1] + rest)
    factor = 64.0 * _RHO ** (-2.0 * _GAUSS_POINTS) / (15.0 * (1.0 - _RHO**-2.0))
    # Half, because s runs over an interval of length 1.
    proved = np.where(free, 0.5 * largest * factor, np.inf).min(axis=1)
    return np.minimum(proved, rough), polygon


def integrals(slopes: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the lengths between places of arcs, shape (k,)."""
    some = [slice(first, first + _AT_ONCE) for first in range(0, max(len(slopes), 1), _AT_ONCE)]
    return np.concatenate([_some_integrals(slopes[each], start[each], end[each]) for each in some])


def _some_integrals(slopes: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    places, gauss = _gauss()
    length = end - start
    s = start[:, None] + length[:, None] * places
    degree = slopes.shape[1] - 1
    bernstein = weights(s.ravel(), degree).reshape(*s.shape, degree + 1)
    speeds = np.linalg.norm(bernstein @ slopes, axis=2)
    result: FloatArray = length * (speeds @ gauss)
    return result


def places_of(slopes: FloatArray, wanted: FloatArray, whole: FloatArray) -> FloatArray:
    """Return where arcs have the wanted lengths: Newton's method within brackets."""
    low, high = np.zeros(len(wanted)), np.ones(len(wanted))
    place = np.clip(np.nan_to_num(wanted / whole), 0.0, 1.0)
    for _ in range(_ROUNDS):
        excess = integrals(slopes, np.zeros(len(place)), place) - wanted
        high, low = np.where(excess >= 0.0, place, high), np.where(excess <= 0.0, place, low)
        degree = slopes.shape[1] - 1
        fast = np.linalg.norm(np.einsum("kb,kbd->kd", weights(place, degree), slopes), axis=1)
        step = place - excess / fast
        inside = (step >= low) & (step <= high)
        following = np.where(inside, step, 0.5 * (low + high))
        moved = np.abs(following - place).max(initial=0.0)
        place = following
        if moved <= 4.0 * UNIT_ROUNDOFF:
            break
    return place


@cache
def _gauss() -> tuple[FloatArray, FloatArray]:
    places, gauss = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    return read_only(0.5 * (places + 1.0)), read_only(0.5 * gauss)


@cache
def _square_matrices(degree: int) -> tuple[FloatArray, FloatArray]:
    """Return matrices to values at Chebyshev points, and from values of a square to coefficients."""
    n = max(2 * degree, 1)
    return read_only(weights(chebyshev(n + 1), degree)), to_chebyshev(n)
