"""Dashes of lines: the stretches of a pattern that runs along them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.quadrature import integrals, places_of
from curvecore.arrays import FloatArray, IntArray, contour_array, finite_number, number_array
from curvecore.bezier.bernstein_algebra import derivative
from curvecore.errors import CurveError
from curvecore.regions.outlines import monotone_arcs, stretch_of

_PARTS = 4
"""Parts of an arc that turns by a right angle at most: their lengths are exact to the last digits."""

_MOST = 20_000
"""Dashes of a line; more of them are a mistake."""


def dashed(
    line: ArrayLike, lengths: ArrayLike, *, start: float = 0.0, closed: bool = False
) -> list[FloatArray]:
    """Return the dashes of a line.

    Parameters
    ----------
    line : array_like, shape (k, 4, 2)
        Control points of cubic pieces, each of which begins where the one before it ends.
    lengths : array_like, shape (m,)
        Of dashes and gaps in turn, along the line, none below 0. Of an odd number, dashes and gaps change
        their roles each time around.
    start : float, optional
        The place in the pattern where the line begins.
    closed : bool, optional
        Whether a dash that reaches the end of the line goes on at its beginning.

    Returns
    -------
    list of ndarray, each of shape (k, 4, 2)
        Lines, in order; of a dash of length 0 none.

    Raises
    ------
    CurveError
        If the line has another shape or a gap, if a length is negative or none is above 0, or if there
        would be more than 20,000 dashes.

    See Also
    --------
    stroked : What a stroke along them covers.

    Examples
    --------
    >>> from curvecore import dashed
    >>> bar = [[[0, 0], [1, 0], [2, 0], [3, 0]]]
    >>> [dash[[0, -1], [0, 3], 0].round(9).tolist() for dash in dashed(bar, [1, 0.5])]
    [[0.0, 1.0], [1.5, 2.5]]
    """
    pieces = contour_array(line, "line")
    pieces = pieces[(pieces != pieces[:, :1]).any(axis=(1, 2))]
    pattern = _pattern(lengths)
    if not len(pieces):
        return []
    arcs = monotone_arcs(pieces).divided(_PARTS)
    slopes = derivative(arcs.controls)
    whole = integrals(slopes, np.zeros(len(slopes)), np.ones(len(slopes)))
    ends = np.cumsum(whole)
    bounds = _bounds(pattern, finite_number(start, "start"), float(ends[-1]))
    part: IntArray = np.minimum(np.searchsorted(ends, bounds.ravel()), len(ends) - 1)
    # Where the line is at rest Newton's method gives way to halving.
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = places_of(slopes[part], bounds.ravel() - (ends - whole)[part], whole[part])
    # In pieces from the beginning of the line, as the arcs are.
    places = ((1.0 - inner) * arcs.start[part] + inner * arcs.end[part]).reshape(-1, 2)
    places[bounds <= 0.0], places[bounds >= ends[-1]] = 0.0, float(len(pieces))
    dashes = [stretch_of(pieces, *each) for each in places.tolist() if each[0] < each[1]]
    if closed and len(dashes) > 1 and places[0, 0] == 0.0 and places[-1, 1] == len(pieces):
        dashes[0] = np.concatenate([dashes.pop(), dashes[0]])
    return dashes


def _pattern(lengths: ArrayLike) -> FloatArray:
    pattern = number_array(lengths, "lengths")
    if pattern.ndim != 1 or not np.isfinite(pattern).all() or (pattern < 0.0).any() or not pattern.any():
        raise CurveError("lengths must be a row of numbers, none below 0 and one of them above")
    return pattern if len(pattern) % 2 == 0 else np.tile(pattern, 2)


def _bounds(pattern: FloatArray, start: float, length: float) -> FloatArray:
    """Return where dashes begin and end, (k, 2), along a line of a length."""
    period = float(pattern.sum())
    before = start % period
    count = int(np.ceil(min((length + before) / period, float(_MOST)))) * (len(pattern) // 2)
    if count >= _MOST:
        raise CurveError(f"lengths must be larger: the line would have {_MOST:,} dashes or more")
    edges = np.cumsum(pattern) - pattern
    within = np.stack([edges[::2], edges[1::2]], axis=1)
    times = np.arange(count // len(within)) * period - before
    bounds = (times[:, None, None] + within).reshape(-1, 2)
    bounds = np.clip(bounds, 0.0, length)
    return bounds[bounds[:, 0] < bounds[:, 1]]
