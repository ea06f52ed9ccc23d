"""Lines cut where others cross them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, contour_array
from curvecore.errors import CurveError
from curvecore.regions.meetings import meetings
from curvecore.regions.outlines import FINEST, stretch_of

_TOLERANCE = 1e-9
"""Share of the size of all lines, within which two places are one."""

_SAME = 8.0
"""The same for places that were found, in tolerances."""


def cut_line(
    line: ArrayLike,
    others: Sequence[ArrayLike],
    *,
    closed: bool = False,
    progress: Callable[[float], object] = lambda _share: None,
) -> list[FloatArray]:
    """Return the parts of a line between the places where others cross or touch it.

    Parameters
    ----------
    line : array_like, shape (k, 4, 2)
        Control points of cubic pieces, each of which begins where the one before it ends.
    others : sequence of array_like, each of shape (m, 4, 2)
        The lines that cut it.
    closed : bool, optional
        Whether the line ends where it begins on purpose: the part that leads through there is one.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    list of ndarray, each of shape (k, 4, 2)
        The parts, in order; the line alone where nothing cuts it.

    Raises
    ------
    CurveError
        If a line has another shape or a gap, or if a closed one does not end where it begins.

    See Also
    --------
    division : What regions are cut into.

    Notes
    -----
    Where another line runs along it, it is cut at both ends of that stretch.

    Examples
    --------
    >>> from curvecore import cut_line
    >>> bar = [[[0, 0], [1, 0], [2, 0], [3, 0]]]
    >>> post = [[[1, -1], [1, 0], [1, 1], [1, 2]]]
    >>> [part[[0, -1], [0, 3], 0].round(9).tolist() for part in cut_line(bar, [post])]
    [[0.0, 1.0], [1.0, 3.0]]
    """
    pieces = contour_array(line, "line")
    knives = [contour_array(each, f"others[{place}]") for place, each in enumerate(others)]
    if closed and (pieces[0, 0] != pieces[-1, 3]).any():
        raise CurveError("line must end where it begins, for it is closed")
    cuts, reach = _cuts(pieces, knives, progress)
    if not closed:
        return _parts(pieces, [0.0, *cuts, float(len(pieces))], reach)
    if not cuts:
        return [pieces]
    return _parts(np.concatenate([pieces, pieces]), [*cuts, cuts[0] + len(pieces)], reach)


def _parts(pieces: FloatArray, ends: Sequence[float], reach: float) -> list[FloatArray]:
    """Return the stretches between some places, those as small as `reach` with the one before, or after."""
    kept = [ends[0]]
    for end in ends[1:-1]:
        if end > kept[-1] and not _is_small(stretch_of(pieces, kept[-1], end), reach):
            kept.append(end)
    if len(kept) > 1 and (kept[-1] >= ends[-1] or _is_small(stretch_of(pieces, kept[-1], ends[-1]), reach)):
        kept.pop()
    return [stretch_of(pieces, start, end) for start, end in pairwise([*kept, ends[-1]])]


def _is_small(part: FloatArray, reach: float) -> bool:
    return float(np.ptp(part.reshape(-1, 2), axis=0).max()) <= reach


def _cuts(
    pieces: FloatArray, knives: Sequence[FloatArray], progress: Callable[[float], object]
) -> tuple[list[float], float]:
    """Return where a line is cut, in pieces from its beginning, and how far such places are off at most.

    A place where pieces are joined may be told of several times.
    """
    controls = np.concatenate([pieces, *knives])
    flat = controls.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = float((high - low).max()) or 1.0
    tolerance = max(_TOLERANCE, FINEST * float(np.abs(flat).max()) / size)
    met = meetings((controls - (low + (high - low) / 2.0)) / size, tolerance, progress)
    is_own = met.piece < len(pieces)
    across = is_own[:, 0] != is_own[:, 1]
    column: IntArray = np.where(is_own[across, :1], 0, 1).astype(np.intp)
    piece, place = (np.take_along_axis(each[across], column, axis=1)[:, 0] for each in met)
    cuts: list[float] = np.unique(piece + place).tolist()
    return cuts, _SAME * tolerance * size
