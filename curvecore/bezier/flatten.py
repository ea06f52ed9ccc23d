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
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LIMIT, UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, IntArray, box_edges, end_to_end, require_plane, tolerance_value
from curvecore.bezier.arcs import Arcs
from curvecore.bezier.bernstein import evaluate_inside, weighted_columns
from curvecore.bezier.control_points import drawable_pieces, equal_parts
from curvecore.bezier.flatten_samples import sampled_pieces
from curvecore.bezier.polylines import MAX_VERTICES, Pieces, chord_bound, may_enter, merged_pieces, points_at
from curvecore.families.curve import ParametricCurve

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
    return pieces.reached <= 64.0 * UNIT_ROUNDOFF * float(np.abs(pieces.points).max())


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
    parts = [drawable_pieces(piece) for piece in curve.pieces]
    controls = [part for part in parts if part is not None]
    widths = {part.shape[1] for part in controls}
    if len(controls) < len(parts) or len(widths) > 1 or max(widths) > _WIDEST:
        return None
    together, breaks = np.concatenate(controls), curve.breaks
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
        arcs = arcs.taken(~fine).halved().halved().halved()
    together = _Division(*(np.concatenate(column) for column in zip(*done, strict=True)))
    order = np.argsort(together.start, kind="stable")
    return _Division(*(each[order] for each in together))


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
