"""Curves of fewer points in the places of curves, so near that nobody sees the difference.

Between corners each curve is fitted anew; corners stay where they are, and so do straight lines between them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise
from math import cos, radians

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore import CurveError
from curvecore.arrays import FloatArray, IntArray

from ...document.edits import EditError
from ...document.model import Curve, Document, Parametrization, ParametrizationKind
from ...families import HERMITE
from ...tasks.progress import Report, part, silent
from ..curve.curve_view import CurveView
from .cubic_joints import CORNER
from .cubics import RELATIVE_TOLERANCE, points_of_cubics

SHARE = 0.002
"""How far a curve may be from what it was, as a share of the size of all that is simplified."""

_TURN = cos(radians(20.0))
"""Cosine of the angle from which a joint is a corner."""

_LONG = 4.0
"""Tolerances that the pieces at a corner are long, at least: else it is a tremble."""

_STRAIGHT = 1e-9
"""Of the length of a piece, by which its handles may be off the straight way."""

_NEARLY_ON = radians(0.1)
"""By how much handles of a point that is no corner are turned into one line, in radians."""

_ANY = "a"
"""Letter of a point that is what its handles make of it."""

_PLACES = 16
"""Places on a piece that say what it looks like."""


class Simplified(msgspec.Struct, frozen=True):
    """A document in which curves have fewer points.

    Attributes
    ----------
    document
        The document.
    before, after
        How many points the curves had that are changed, and have now.
    deviation
        How far these are from what they were at most.
    """

    document: Document
    before: int
    after: int
    deviation: float


def simplified(
    document: Document, views: Sequence[CurveView], curves: Collection[int], report: Report = silent
) -> Simplified:
    """Return the document with fewer points in those of some curves where that can be.

    Raises
    ------
    EditError
        If none of them has more points than it takes.
    """
    places = sorted(place for place in curves if _can_be_simpler(views[place]))
    tolerance = SHARE * size_of([views[place] for place in places])
    made, before, after, deviation = document, 0, 0, 0.0
    for done, place in enumerate(places):
        share = part(report, done / len(places), (done + 1) / len(places))
        curve, off = _simpler(views[place], tolerance, share)
        count, left = len(document.curves[place].points), len(curve.points)
        if left < count and off <= tolerance:
            made = made.with_curve(place, curve)
            before, after, deviation = before + count, after + left, max(deviation, off)
    if not before:
        raise EditError("No curve of these takes fewer points than it has.")
    return Simplified(made, before, after, deviation)


def size_of(views: Sequence[CurveView]) -> float:
    """Return the longer side of the box around the points of curves; 1 where there are none."""
    points = [view.points for view in views if len(view.points)]
    return float(np.ptp(np.concatenate(points), axis=0).max()) if points else 1.0


def _can_be_simpler(view: CurveView) -> bool:
    curve = view.source
    return view.is_current and len(curve.points) > 2


def _simpler(view: CurveView, tolerance: float, report: Report) -> tuple[Curve, float]:
    """Return a curve near another one, and how far off it is at most."""
    assert view.curve is not None
    closed = view.source.is_closed
    path = curvecore.cubic_path(view.curve, max(RELATIVE_TOLERANCE * size_of([view]), 1e-300))
    pieces, corners = path.control_points, _corners(path.control_points, tolerance, closed=closed)
    if closed and len(corners):
        # It begins at a corner.
        pieces, corners = np.roll(pieces, -corners[0], axis=0), corners - corners[0]
    cuts = [*(corners if closed and len(corners) else [0, *corners]), len(pieces)]
    found, letters, off = list[FloatArray](), "", float(path.deviation)
    for number, (start, end) in enumerate(pairwise(cuts)):
        share = part(report, number / len(cuts), (number + 1) / len(cuts))
        run, deviation = _run(pieces[start:end], tolerance, share, closed=closed and not len(corners))
        found.append(run)
        letters += (CORNER if len(corners) else _ANY) + _ANY * (len(run) - 1)
        off = max(off, path.deviation + deviation)
    letters += "" if closed else CORNER
    points = points_of_cubics(np.concatenate(found), closed=closed, most_turned=_NEARLY_ON, letters=letters)
    rule = Parametrization(ParametrizationKind.MANUAL)
    made = replace(view.source.with_family(HERMITE), points=points.points, parametrization=rule)
    return made, off + points.moved


def _corners(pieces: FloatArray, tolerance: float, *, closed: bool) -> IntArray:
    """Return the pieces that begin at a corner; an end of an open curve is none."""
    ahead, behind = _directions(pieces, 1), _directions(pieces[:, ::-1], -1)
    turned = (np.roll(behind, 1, axis=0) * ahead).sum(axis=1) < _TURN
    is_long = np.linalg.norm(pieces[:, 3] - pieces[:, 0], axis=1) > _LONG * tolerance
    turned &= is_long & np.roll(is_long, 1)
    turned[0] &= closed
    return np.flatnonzero(turned)


def _directions(pieces: FloatArray, sign: int) -> FloatArray:
    """Return the directions in which pieces begin, of length 1; 0 where they go nowhere."""
    ways, missing = np.zeros((len(pieces), 2)), np.ones(len(pieces), dtype=np.bool_)
    for number in range(1, 4):
        steps = sign * (pieces[:, number] - pieces[:, 0])
        lengths = np.linalg.norm(steps, axis=1)
        new = missing & (lengths > 0)
        ways[new] = steps[new] / lengths[new, None]
        missing &= ~new
    return ways


def _run(pieces: FloatArray, tolerance: float, report: Report, *, closed: bool) -> tuple[FloatArray, float]:
    """Return fewer pieces near those between two corners, and how far they are off at most."""
    if not closed and _is_straight(pieces):
        return np.linspace(pieces[0, 0], pieces[-1, 3], 4)[None], 0.0
    if len(pieces) == 1:
        return pieces, 0.0
    data = np.concatenate(list(_sampled(pieces)))
    try:
        found = curvecore.fit(
            data,
            HERMITE.curve_class,
            tolerance=tolerance,
            closed=closed,
            with_corners=False,
            progress=lambda share: report(share, "Simplifying"),
        )
    except CurveError as problem:
        raise EditError(f"A curve could not be fitted: {problem}.") from problem
    made = curvecore.bezier_segments(found.curve)
    is_better = len(made) < len(pieces) and found.deviation <= tolerance
    return (made, float(found.deviation)) if is_better else (pieces, 0.0)


def _sampled(pieces: FloatArray) -> Iterator[FloatArray]:
    """Yield places on pieces, the end of the last one too."""
    s = np.arange(_PLACES) / _PLACES
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s * s * (1 - s), s**3], axis=1)
    yield np.einsum("mw,kwd->kmd", weights, pieces).reshape(-1, 2)
    yield pieces[-1:, 3]


def _is_straight(pieces: FloatArray) -> bool:
    """Whether pieces lie on one straight line, each going on from the one before."""
    places = pieces.reshape(-1, 2)
    way = places[-1] - places[0]
    length = float(np.hypot(*way))
    if not length:
        return False
    off = (places - places[0]) @ np.array([-way[1], way[0]])
    along = (places - places[0]) @ way
    return bool(np.abs(off).max() <= _STRAIGHT * length**2 and (np.diff(along) >= 0).all())
