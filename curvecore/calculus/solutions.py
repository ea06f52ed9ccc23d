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

from curvecore.arithmetic import UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, IntArray, finite_number, integer
from curvecore.bezier.bernstein import sign_changes, values
from curvecore.bezier.control_points import sorted_distinct
from curvecore.bezier.pieces import BezierPieces, bezier_pieces, parameters_at
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve

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
    """Return the parameters at which a coordinate has a value, ascending; see `ParametricCurve.solve`."""
    wanted, column = finite_number(value, "value"), integer(axis, "axis", 0)
    if column >= curve.jets.shape[2]:
        raise CurveError(f"axis must be less than {curve.jets.shape[2]}, the dim of the curve, not {column}")
    # A curve is linear in its data: its coordinate is the curve of theirs.
    coordinate = curve.with_jets(curve.jets[:, :, column : column + 1])
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        parts = [(piece, bezier_pieces(piece, _TOLERANCE)) for piece in coordinate.pieces]
        stretches = [_stretches(piece, pieces, wanted) for piece, pieces in parts]
        groups = [_crossed(*part, stretch, wanted) for part, stretch in zip(parts, stretches, strict=True)]
        whole = _Stretches._make(np.concatenate(column) for column in zip(*stretches, strict=True))
        groups.append(_reached(whole))
        if discontinuity:
            groups.append(whole.starts[1:][whole.after[:-1] * whole.before[1:] < 0.0])
    return sorted_distinct(np.concatenate(groups))


def _stretches(curve: ParametricCurve, pieces: BezierPieces, value: float) -> _Stretches:
    turns = sign_changes(pieces.slopes[:, :, 0], pieces.slope_error)
    knots = np.concatenate((pieces.starts, parameters_at(pieces, turns.piece, turns.s), pieces.ends[-1:]))
    knots = sorted_distinct(knots)
    starts, ends = knots[:-1], knots[1:]
    # From inside: at a break the piece to the right counts.
    inside = np.where(np.isin(ends, curve.breaks[1:-1]), np.nextafter(ends, -np.inf), ends)
    if curve.bezier_pieces() is None:
        sizes = _sizes(curve, starts), _sizes(curve, inside)
    else:
        # No function reaches further than the control points beside it.
        hull = np.ldexp(np.abs(pieces.controls[:, :, 0]).max(axis=1), pieces.exponent)
        sizes = (hull[_piece_of(pieces, starts)],) * 2
    before, after = (_signs(curve, t, value, size) for t, size in zip((starts, inside), sizes, strict=True))
    return _Stretches(starts, ends, before, after)


def _piece_of(pieces: BezierPieces, t: FloatArray) -> IntArray:
    return np.clip(np.searchsorted(pieces.starts, t, side="right") - 1, 0, None)


def _signs(curve: ParametricCurve, t: FloatArray, value: float, sizes: FloatArray) -> FloatArray:
    """Return the signs of c(t) - value, 0 where rounding may have changed them."""
    off = curve.evaluate(t)[:, 0] - value
    noise = UNIT_ROUNDOFF * (_ROUNDING * sizes + 2.0 * abs(value))
    return np.where(np.abs(off) > noise, np.sign(off), 0.0)


def _sizes(curve: ParametricCurve, t: FloatArray) -> FloatArray:
    """Return sum |B_ir(t) d_ir|, (m,)."""
    data = np.abs(curve.jets[:, :, 0])
    step = max(_AT_ONCE // data.size, 1)
    parts = [np.abs(curve.basis(t[i : i + step])).reshape(-1, data.size) for i in range(0, len(t), step)]
    return np.concatenate([part @ data.ravel() for part in parts])


def _reached(whole: _Stretches) -> FloatArray:
    """Return the ends of stretches where the value is reached; of a run of constant ones its two ends."""
    knots = np.append(whole.starts, whole.ends[-1])
    hit = np.append(whole.before == 0.0, False) | np.append(False, whole.after == 0.0)
    is_constant = (whole.before == 0.0) & (whole.after == 0.0)
    hit[1:-1] &= ~(is_constant[:-1] & is_constant[1:])
    return np.asarray(knots[hit])


def _crossed(curve: ParametricCurve, pieces: BezierPieces, stretches: _Stretches, value: float) -> FloatArray:
    """Return the parameters inside stretches at which the coordinate crosses the value.

    Newton's method with the slopes of the Bezier pieces, and halving where it is slow: behind the last small
    step nothing more is left than rounding.
    """
    crossing = stretches.before * stretches.after < 0.0
    low, high, rising = stretches.starts[crossing], stretches.ends[crossing], stretches.after[crossing] > 0.0
    piece = _piece_of(pieces, low)
    slopes = np.ldexp(pieces.slopes[piece, :, 0], pieces.exponent)
    start, length = pieces.starts[piece], (pieces.ends - pieces.starts)[piece]
    t = 0.5 * (low + high)
    last = high - low
    small = 8.0 * np.spacing(np.abs(curve.breaks[[0, -1]]).max())
    open_ = np.arange(len(t))
    for _ in range(_STEPS):
        if not open_.size:
            break
        at = t[open_]
        off = curve.evaluate(at)[:, 0] - value
        slope = values(slopes[open_], (at - start[open_]) / length[open_]) / length[open_]
        is_behind = (off > 0.0) == rising[open_]
        high[open_], low[open_] = np.where(is_behind, at, high[open_]), np.where(is_behind, low[open_], at)
        following = at - off / slope
        is_good = (following >= low[open_]) & (following <= high[open_])
        is_good &= np.abs(following - at) < 0.5 * last[open_]
        following = np.where(is_good, following, 0.5 * (low + high)[open_])
        following = np.where(off == 0.0, at, following)
        last[open_] = np.abs(following - at)
        t[open_] = following
        open_ = open_[last[open_] > small]
    return t
