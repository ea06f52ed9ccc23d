"""Parameters at which a coordinate of a curve has a value.

References
----------
.. [1] R. T. Farouki, "The Bernstein polynomial basis: a centennial
   retrospective", Computer Aided Geometric Design 29 (2012) 379-419: section
   3.2 (bounds, variation).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, finite_number, integer
from curvecore.bezier.bernstein_algebra import sign_changes
from curvecore.bezier.control_points import sorted_distinct
from curvecore.bezier.pieces import bezier_pieces, parameters_at
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.scaling import UNIT_ROUNDOFF

_TOLERANCE = 2.0**-44
_ROUNDING = 16.0  # of values, in units of UNIT_ROUNDOFF sum |B_ir d_ir|
_STEPS = 100
_AT_ONCE = 1 << 20  # numbers of basis functions at a time


class _Stretches(NamedTuple):
    """Intervals on which a coordinate is monotone, in order.

    Attributes
    ----------
    starts, ends : ndarray, shape (k,)
        Parameters.
    before, after : ndarray, shape (k,)
        Signs of the coordinate less the value at both ends, from inside; 0 for what rounding may have made.
    """

    starts: FloatArray
    ends: FloatArray
    before: FloatArray
    after: FloatArray


def solutions(curve: ParametricCurve, value: float, axis: int, discontinuity: bool) -> FloatArray:
    """Return where a coordinate has a value, ascending; see `ParametricCurve.solve`."""
    wanted, column = finite_number(value, "value"), integer(axis, "axis", 0)
    if column >= curve.jets.shape[2]:
        raise CurveError(f"axis must be less than {curve.jets.shape[2]}, the dim of the curve, not {column}")
    # A curve is linear in its data: its coordinate is the curve of theirs.
    coordinate = curve.with_jets(curve.jets[:, :, column : column + 1])
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        stretches = [_stretches(piece, wanted) for piece in coordinate.pieces]
        whole = _Stretches._make(np.concatenate(column) for column in zip(*stretches, strict=True))
        found = [_reached(whole), _crossed(coordinate, whole, wanted)]
        if discontinuity:
            found.append(whole.starts[1:][whole.after[:-1] * whole.before[1:] < 0.0])
    return sorted_distinct(np.concatenate(found))


def _stretches(curve: ParametricCurve, value: float) -> _Stretches:
    pieces = bezier_pieces(curve, _TOLERANCE)
    slopes = pieces.slopes[:, :, 0]
    turns = sign_changes(slopes, pieces.slope_error)
    knots = np.concatenate((pieces.starts, parameters_at(pieces, turns.piece, turns.place), pieces.ends[-1:]))
    knots = sorted_distinct(knots)
    starts, ends = knots[:-1], knots[1:]
    # From inside: at a break the piece to the right counts.
    inside = np.where(np.isin(ends, curve.breaks[1:-1]), np.nextafter(ends, -np.inf), ends)
    return _Stretches(starts, ends, _signs(curve, starts, value), _signs(curve, inside, value))


def _signs(curve: ParametricCurve, t: FloatArray, value: float) -> FloatArray:
    """Return the signs of c(t) - value, 0 where rounding may have changed them."""
    off = curve.evaluate(t)[:, 0] - value
    noise = UNIT_ROUNDOFF * (_ROUNDING * _sizes(curve, t) + 2.0 * abs(value))
    return np.where(np.abs(off) > noise, np.sign(off), 0.0)


def _sizes(curve: ParametricCurve, t: FloatArray) -> FloatArray:
    """Return sum |B_ir(t) d_ir|, (m,)."""
    data = np.abs(curve.jets[:, :, 0])
    if curve.is_local:
        segment, values = curve.local_basis(t)
        ends = np.stack((data[segment], data[segment + 1]), axis=1)
        result: FloatArray = (np.abs(values) * ends).sum(axis=(1, 2))
        return result
    step = max(_AT_ONCE // data.size, 1)
    parts = [np.abs(curve.basis(t[i : i + step])).reshape(-1, data.size) for i in range(0, len(t), step)]
    return np.concatenate([part @ data.ravel() for part in parts])


def _reached(whole: _Stretches) -> FloatArray:
    """Return the ends of stretches where the value is reached; of a run of constant ones its two ends."""
    knots = np.append(whole.starts, whole.ends[-1])
    hit = np.append(whole.before == 0.0, False) | np.append(False, whole.after == 0.0)
    is_constant = (whole.before == 0.0) & (whole.after == 0.0)
    hit[1:-1] &= ~(is_constant[:-1] & is_constant[1:])
    reached: FloatArray = knots[hit]
    return reached


def _crossed(curve: ParametricCurve, whole: _Stretches, value: float) -> FloatArray:
    """Return where the value is crossed inside stretches: Newton's method, halving where it is slow."""
    crossing = whole.before * whole.after < 0.0
    low, high, rising = whole.starts[crossing], whole.ends[crossing], whole.after[crossing] > 0.0
    t = 0.5 * (low + high)
    last = high - low
    for _ in range(_STEPS):
        off, slope = curve.evaluate(t)[:, 0] - value, curve.evaluate(t, 1)[:, 0]
        is_behind = (off > 0.0) == rising
        high, low = np.where(is_behind, t, high), np.where(is_behind, low, t)
        with np.errstate(divide="ignore"):
            following = t - off / slope
        is_good = (following >= low) & (following <= high) & (np.abs(following - t) < 0.5 * last)
        following = np.where(is_good, following, 0.5 * (low + high))
        following = np.where(off == 0.0, t, following)
        last = np.abs(following - t)
        t = following
        if (last <= np.spacing(np.abs(t))).all():
            break
    return t
