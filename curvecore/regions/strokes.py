"""Outlines of strokes, and regions that are larger or smaller by a distance.

A stroke is the union of simple parts: strips of a stretch of a piece between
its two offset curves, wedges at joints, and caps. Where a piece bends more tightly than half the width, its
strip folds over on one side; such strips count by themselves, so that what
lies in the fold is not taken away from others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, contour_array, finite_number, tolerance_value
from curvecore.regions.miters import are_pointed, miter_tips
from curvecore.regions.operations import Progress, difference, simplified, unheard, union
from curvecore.regions.outlines import monotone_arcs, straight_piece, with_whole_lines
from curvecore.regions.region import Region, contour_area, is_sliver
from curvecore.regions.strips import normals, strips_of
from curvecore.vectors import cross

_STRAIGHT_ON = 1e-9
"""Sine of the turn at a joint below which it is none."""


class StrokeJoin(Enum):
    """Corners of strokes.

    See Also
    --------
    stroked : Draws them.

    Examples
    --------
    >>> from curvecore import StrokeJoin
    >>> [join.name for join in StrokeJoin]
    ['MITER', 'ROUND', 'BEVEL']
    """

    MITER = "miter"
    ROUND = "round"
    BEVEL = "bevel"


class StrokeCap(Enum):
    """Ends of strokes.

    See Also
    --------
    stroked : Draws them.

    Examples
    --------
    >>> from curvecore import StrokeCap
    >>> [cap.name for cap in StrokeCap]
    ['BUTT', 'ROUND', 'SQUARE']
    """

    BUTT = "butt"
    ROUND = "round"
    SQUARE = "square"


class _Pen(NamedTuple):
    """Half the width of a stroke, its corners and ends, and how far its outline may be off."""

    half: float
    join: StrokeJoin
    cap: StrokeCap
    miter_limit: float
    tolerance: float


def stroked(
    lines: Sequence[ArrayLike],
    width: float,
    *,
    tolerance: float,
    join: StrokeJoin = StrokeJoin.ROUND,
    cap: StrokeCap = StrokeCap.ROUND,
    miter_limit: float = 4.0,
    closed: Sequence[bool] = (),
    progress: Progress = unheard,
) -> Region:
    """Return what a stroke along lines covers.

    Parameters
    ----------
    lines : sequence of array_like, each of shape (k, 4, 2)
        Control points of cubic pieces, each of which begins where the one before it ends.
    width : float
        Of the stroke, above 0.
    tolerance : float
        Largest distance of its outline from the true one, above 0.
    join, cap : StrokeJoin, StrokeCap, optional
        Its corners and ends.
    miter_limit : float, optional
        Corners that reach farther than this, in half widths, become bevels.
    closed : sequence of bool, optional
        Which lines have a joint where they end and begin, and no caps; none of those not said.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        As of `union`.

    Raises
    ------
    CurveError
        If a line has another shape or a gap, if a number is not positive, or if roundings hide how the
        outlines lie.

    See Also
    --------
    offset : A region made larger or smaller.

    Examples
    --------
    >>> from curvecore import StrokeCap, stroked
    >>> bar = [[[0, 0], [1, 0], [2, 0], [3, 0]]]
    >>> round(stroked([bar], 2, tolerance=1e-6, cap=StrokeCap.BUTT).area, 9)
    6.0
    >>> round(stroked([bar], 2, tolerance=1e-6).area - 6, 3)
    3.142
    """
    pen = _Pen(
        tolerance_value(width, "width") / 2.0,
        join,
        cap,
        finite_number(miter_limit, "miter_limit"),
        tolerance_value(tolerance),
    )
    runs, plain = list[FloatArray](), list[FloatArray]()
    for place, line in enumerate(lines):
        pieces = contour_array(line, f"lines[{place}]")
        pieces = pieces[(pieces != pieces[:, :1]).any(axis=(1, 2))]
        if not len(pieces):
            continue
        is_closed = place < len(closed) and closed[place]
        runs.append(pieces)
        plain += map(_to_the_left, _ends_and_joints(pieces, pen, is_closed=is_closed))
    if not runs:
        return Region([])
    every = np.concatenate(runs)
    strips, folded = strips_of(every, pen.half, pen.tolerance)
    plain += [*strips, *map(_to_the_left, _cusps(every, pen))]
    found = union([Region(plain), *(Region([each]) for each in folded)], progress=progress)
    # Beside a fold the parts may miss each other by what they are off.
    kept = [each for each in found.contours if not is_sliver(each, pen.tolerance)]
    return Region([with_whole_lines(each) for each in kept])


def offset(
    region: Region,
    distance: float,
    *,
    tolerance: float,
    join: StrokeJoin = StrokeJoin.ROUND,
    miter_limit: float = 4.0,
    progress: Progress = unheard,
) -> Region:
    """Return a region that reaches farther by a distance, or less far where that is negative.

    Parameters
    ----------
    region : Region
        Any.
    distance : float
        How far its outline moves outwards; not 0.
    tolerance : float
        Largest distance of the outline from the true one, above 0.
    join, miter_limit : StrokeJoin, float, optional
        As of `stroked`: what becomes of corners.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Region
        As of `union`.

    Raises
    ------
    CurveError
        If a number is none, or if roundings hide how the outlines lie.

    See Also
    --------
    stroked : What a stroke covers.

    Examples
    --------
    >>> from curvecore import Region, StrokeJoin, offset
    >>> box = Region.of_polygon([[0, 0], [2, 0], [2, 2], [0, 2]])
    >>> round(offset(box, 1, tolerance=1e-6, join=StrokeJoin.MITER).area, 9)
    16.0
    >>> round(offset(box, -0.5, tolerance=1e-6).area, 9)
    1.0
    """
    way = finite_number(distance, "distance")
    plain = simplified(region, progress=_part(progress, 0.0, 0.2))
    band = stroked(
        plain.contours,
        2.0 * abs(way),
        tolerance=tolerance,
        join=join,
        miter_limit=miter_limit,
        closed=[True] * len(plain.contours),
        progress=_part(progress, 0.2, 0.7),
    )
    told = _part(progress, 0.7, 1.0)
    found = union([plain, band], progress=told) if way > 0.0 else difference(plain, [band], progress=told)
    return Region([with_whole_lines(each) for each in found.contours])


def _part(progress: Progress, start: float, end: float) -> Callable[[float], object]:
    return lambda share: progress(start + (end - start) * share)


# Joints and ends


def _ends_and_joints(pieces: FloatArray, pen: _Pen, *, is_closed: bool) -> Iterator[FloatArray]:
    """Yield contours of the wedges at joints, and of the caps of an open line."""
    count = len(pieces)
    leaving, coming = normals(pieces, np.zeros(count)), normals(pieces, np.ones(count))
    out, arriving = (np.stack((each[:, 1], -each[:, 0]), axis=1) for each in (leaving, coming))
    for piece in range(count if is_closed else count - 1):
        following = (piece + 1) % count
        yield from _joint(pieces[piece, 3], arriving[piece], out[following], pen)
    if not is_closed:
        yield from _cap(pieces[0, 0], -out[0], pen)
        yield from _cap(pieces[-1, 3], arriving[-1], pen)


def _cusps(pieces: FloatArray, pen: _Pen) -> Iterator[FloatArray]:
    """Yield half discs at cusps within pieces, as the strips of curves that nearly have one sweep them."""
    arcs = monotone_arcs(pieces)
    inner = np.flatnonzero(arcs.end % 1.0 > 0.0)
    before, after = arcs.controls[inner], arcs.controls[inner + 1]
    coming, leaving = normals(before, np.ones(len(inner))), normals(after, np.zeros(len(inner)))
    for place in np.flatnonzero((coming * leaving).sum(axis=1) < 0.0).tolist():
        one, other = (np.array([each[place, 1], -each[place, 0]]) for each in (coming, leaving))
        yield from _joint(before[place, 3], one, other, pen._replace(join=StrokeJoin.ROUND))


def _joint(at: FloatArray, before: FloatArray, after: FloatArray, pen: _Pen) -> Iterator[FloatArray]:
    turn, on = float(cross(before, after)), float(before @ after)
    if on > 0.0 and abs(turn) <= _STRAIGHT_ON:
        return
    side = -1.0 if turn > 0.0 else 1.0
    first, last = (at + side * pen.half * np.array([-way[1], way[0]]) for way in (before, after))
    if pen.join is StrokeJoin.ROUND:
        yield _closed(
            [straight_piece(at, first), *_arc(at, first, -side * math.acos(max(-1.0, min(1.0, on)))), None]
        )
        return
    one, other = before[None], after[None]
    corners = [at, first, last]
    if (
        pen.join is StrokeJoin.MITER
        and abs(turn) > _STRAIGHT_ON
        and are_pointed(one, other, pen.miter_limit)[0]
    ):
        corners.insert(2, miter_tips(at[None], one, other, pen.half)[0])
    yield Region.of_polygon(corners).contours[0]


def _cap(at: FloatArray, out: FloatArray, pen: _Pen) -> Iterator[FloatArray]:
    aside = pen.half * np.array([-out[1], out[0]])
    if pen.cap is StrokeCap.SQUARE:
        ahead = pen.half * out
        yield Region.of_polygon([at - aside, at - aside + ahead, at + aside + ahead, at + aside]).contours[0]
    elif pen.cap is StrokeCap.ROUND:
        yield _closed([*_arc(at, at - aside, math.pi), None])


def _arc(centre: FloatArray, start: FloatArray, angle: float) -> list[FloatArray]:
    """Return cubic pieces of an arc about a centre; a quarter of a circle is 2.7e-4 of its radius off."""
    count = max(1, math.ceil(abs(angle) / (math.pi / 4.0) - 1e-9))
    step = angle / count
    reach = 4.0 / 3.0 * math.tan(step / 4.0)
    found, at = list[FloatArray](), start - centre
    for _ in range(count):
        turned = at @ np.array([[math.cos(step), math.sin(step)], [-math.sin(step), math.cos(step)]])
        ahead, behind = (reach * np.array([-each[1], each[0]]) for each in (at, turned))
        found.append(centre + np.stack([at, at + ahead, turned - behind, turned]))
        found[-1][0] = found[-2][3] if len(found) > 1 else start
        at = turned
    return found


def _closed(pieces: Sequence[FloatArray | None]) -> FloatArray:
    """Return a contour; the missing last piece is a straight line back."""
    own = [each for each in pieces if each is not None]
    return np.stack([*own, straight_piece(own[-1][3], own[0][0])])


def _to_the_left(contour: FloatArray) -> FloatArray:
    return contour if contour_area(contour) >= 0.0 else contour[::-1, ::-1]
