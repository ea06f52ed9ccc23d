"""Curves of few points near others: fitted to data, one segment for several, and curves simplified.

`fitted` gives the curve of a document that is near data. `segment_near` puts one segment in the place of a
piece of curve: the lengths of its handles, and derivatives of higher orders, are unknowns of a linear
least-squares problem for given parameters of positions along the piece; these move to the feet of their
perpendiculars, and so on, as in P. J. Schneider, "An algorithm for automatically fitting digitized curves",
Graphics Gems, Academic Press 1990, 612-626. `simplified` fits curves anew between their corners; corners stay
where they are, and so do straight lines between them.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import chain, pairwise
from math import ceil, cos, radians
from typing import NamedTuple

import msgspec
import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

import curvecore
from curvecore import CurveError, ParametricCurve
from curvecore.arrays import FloatArray, IntArray

from ..document.derivatives import DERIVATIVES
from ..document.limits import EditError
from ..document.model import Curve, Document, Parametrization, ParametrizationKind, Point, Vector
from ..document.words import count_of, number
from ..families import HERMITE, Family
from ..tasks.progress import Report, part, silent
from .cubics import CORNER, RELATIVE_TOLERANCE, points_of_cubics
from .curve.curve_view import CurveView
from .geometry import all_along, unit_tangents

SCATTERED = "The data scatter this much; more points would only follow the noise."

_MANY, _FEW = 1000, 300
"""Samples that are enough to describe a curve, and points from which on the points alone describe it.

Samples between points that have errors would make a smooth curve of the errors.
"""


class Fitted(NamedTuple):
    """A curve of the document near data.

    Attributes
    ----------
    curve
        The curve; its parameters are manual, so that it stays as it was fitted.
    core
        The same curve in the core.
    deviation, root_mean_square
        The largest distance of the data from it, and the root of the mean of the squares.
    farthest
        The datum that is farthest away.
    is_scattered
        Whether the deviation is due to errors of the data.
    """

    curve: Curve
    core: ParametricCurve
    deviation: float
    root_mean_square: float
    farthest: Vector
    is_scattered: bool

    @property
    def words(self) -> str:
        """The number of points, and their distance."""
        points, stays = count_of(len(self.curve.points), "point"), "stays at " if self.is_scattered else ""
        mean = number(self.root_mean_square, 2)
        text = f"{points}; largest deviation {stays}{number(self.deviation, 3)}, root mean square {mean}."
        return f"{text} {SCATTERED}" if stays else text


class Data(NamedTuple):
    """The data that a curve is fitted to.

    Attributes
    ----------
    points
        (m, 2).
    times
        Their parameters, (m,).
    """

    points: FloatArray
    times: FloatArray


def is_of_points_alone(view: CurveView) -> bool:
    """Whether the fit uses the points of a curve alone: of many, or where it may swing between them."""
    return not view.source.family.curve_class.is_local or len(view.parameters) >= _FEW


def data_of(view: CurveView) -> Data:
    """Return the points of a curve and, where these are few and it does not swing, samples between them.

    A curve whose functions reach far may swing between its points unintendedly.

    Raises
    ------
    EditError
        If there is no curve.
    """
    if not view.is_current:
        raise EditError(view.problem)
    t = view.parameters
    if not is_of_points_alone(view):
        t = all_along(t, ceil(_MANY / len(t)))
        return Data(view.present_curve.evaluate(t), t)
    return Data(view.at_knots, t)


def fitted_to_curve(
    view: CurveView,
    model: Curve,
    *,
    count: int | None = None,
    tolerance: float | None = None,
    keeps_times: bool = False,
    report: Report = silent,
) -> Fitted:
    """Return a curve of few points near another, over its interval, of the family and style of `model`.

    `keeps_times` keeps the t of every sample, so that a motion stays the same; else only the shape counts.

    Raises
    ------
    EditError
        If there is no such curve.
    """
    data = data_of(view)
    rule = replace(model.parametrization, start=float(data.times[0]), end=float(data.times[-1]))
    return fitted(
        replace(model, parametrization=rule),
        data.points,
        count=count,
        tolerance=tolerance,
        times=data.times if keeps_times else None,
        report=report,
    )


def fitted(
    model: Curve,
    points: npt.ArrayLike,
    *,
    count: int | None = None,
    tolerance: float | None = None,
    times: FloatArray | None = None,
    report: Report = silent,
) -> Fitted:
    """Return the curve of the family, style and interval of `model` that is near `points`, (m, 2).

    It is closed where the model is. `times` are parameters of the data, which are kept; see `curvecore.fit`
    for the rest.

    Raises
    ------
    EditError
        If there is no such curve.
    """
    data = np.asarray(points, dtype=np.float64)
    if model.family.is_missing:
        raise EditError(model.family.problem)
    is_closed = model.closed and model.family.curve_class.can_close
    fit = core_fit(model, data, count, tolerance, times, report, is_closed=is_closed)
    rule = model.parametrization
    span = (rule.start, rule.end) if times is None else fit.curve.domain
    new = points_of_fit(fit.curve, span, is_closed=is_closed)
    parametrization = Parametrization(ParametrizationKind.MANUAL, rule.alpha, *span)
    curve = replace(model, points=new, parametrization=parametrization, closed=is_closed)
    x, y = data[fit.worst].tolist()
    return Fitted(curve, fit.curve, fit.deviation, fit.root_mean_square, (x, y), fit.is_scattered)


def core_fit(
    model: Curve,
    data: FloatArray,
    count: int | None,
    tolerance: float | None,
    times: FloatArray | None,
    report: Report,
    *,
    is_closed: bool,
    end_directions: tuple[FloatArray | None, FloatArray | None] = (None, None),
) -> curvecore.Fit:
    """Return the core's fit; raise `EditError` with its reason where there is none."""
    family = model.family
    try:
        return curvecore.fit(
            data,
            family.curve_class,
            count,
            tolerance=tolerance,
            parameters=times,
            settings=family.settings.in_effect(model.settings, closed=is_closed),
            closed=is_closed,
            end_directions=end_directions,
            progress=lambda share: report(share, "Fitting"),
        )
    except CurveError as problem:
        text = str(problem)
        raise EditError(f"{text[:1].upper()}{text[1:]}.") from None


def points_of_fit(core: ParametricCurve, span: Vector, *, is_closed: bool) -> tuple[Point, ...]:
    """Return the points of a curve of the document, whose parameters begin and end at `span`."""
    (start, end), (first, last) = span, core.domain
    stretch = (end - start) / (last - first)
    jets = [piece.jets / stretch ** np.arange(float(piece.jets.shape[1]))[:, None] for piece in core.pieces]
    times = start + (core.parameters - first) * stretch
    times[-1] = end
    joints = {0: (jets[-1][-1], jets[0][0])} if is_closed else {}
    row = 0
    for before, after in pairwise(jets):
        row += len(before) - 1
        joints[row] = (before[-1], after[0])
    rows = list(chain(jets[0][:1], *(rows_of_piece[1:] for rows_of_piece in jets)))
    return tuple(
        _point(joints.get(index, (jet, jet)), float(t), may_turn=index in joints)
        for index, (jet, t) in enumerate(zip(rows, times, strict=True))
        if index < len(rows) - is_closed
    )


def _point(sides: tuple[FloatArray, FloatArray], t: float, *, may_turn: bool) -> Point:
    before, after = (derivative.tolist() for derivative in sides)
    is_corner = may_turn and before != after
    x, y = before[0]
    point = Point(x, y, t=t, corner=is_corner)
    given = {
        derivative.name: tuple(value) for derivative, value in zip(DERIVATIVES, before[1:], strict=False)
    }
    if is_corner:
        ahead = zip(DERIVATIVES, after[1:], strict=False)
        given |= {derivative.after: tuple(value) for derivative, value in ahead}
    return replace(point, **given)


# One segment for several

_ROUNDS = 24
_STEPS = 6
"""Steps of Newton's to the feet of perpendiculars."""

_FOLD = radians(30.0)
"""Angle by which a segment that turns more than the piece is folded."""

_LEAST = 1e-3
"""Share of the length below which a speed counts as none: the curve would stop there."""


def segment_near(family: Family, positions: FloatArray, directions: FloatArray) -> FloatArray:
    """Return the jets, (2, R, 2), of the segment over [0, 1] that is nearest to `positions` (m, 2).

    `directions` are those at its ends, (2, 2), of length one.
    """
    steps = np.hypot(*np.diff(positions, axis=0).T)
    length = float(steps.sum())
    u = np.concatenate([[0.0], np.cumsum(steps)]) / length
    best, least = _thirds(family, positions, directions, length), math.inf
    most = _turning(np.diff(positions, axis=0)) + _FOLD
    for _ in range(_ROUNDS):
        jets = _solved(family, positions, directions, u, length)
        curve = family.curve_class.from_jets(jets, np.array([0.0, 1.0]))
        u = _feet(curve, positions, u, 0.0, 1.0)
        away = _largest(curve.evaluate(u) - positions)
        if away < least and _turning(curve.evaluate(u, 1)) < most:
            best, least = jets, away
    return best


def farthest(curve: ParametricCurve, positions: FloatArray, u: FloatArray) -> float:
    """Return a bound of distances of positions (m, 2) from a curve; their feet are near parameters `u`."""
    least = np.full(len(u), math.inf)
    for _ in range(_STEPS):
        least = np.minimum(least, np.hypot(*(curve.evaluate(u) - positions).T))
        u = _feet(curve, positions, u, *curve.domain)
    return float(least.max())


def _turning(directions: FloatArray) -> float:
    """Return the sum of the angles between vectors (m, 2), each to the next."""
    (x, y), (along, across) = directions[:-1].T, directions[1:].T
    return float(np.abs(np.arctan2(x * across - y * along, x * along + y * across)).sum())


def _largest(offsets: FloatArray) -> float:
    return float(np.hypot(offsets[:, 0], offsets[:, 1]).max())


def _thirds(family: Family, positions: FloatArray, directions: FloatArray, length: float) -> FloatArray:
    """Return the jets of a segment that is passed at an even pace."""
    jets = np.zeros((2, family.derivatives + 1, 2))
    jets[:, 0], jets[:, 1] = positions[[0, -1]], length * directions
    return jets


def _solved(
    family: Family, positions: FloatArray, directions: FloatArray, u: FloatArray, length: float
) -> FloatArray:
    """Return the jets of the segment that is nearest to the positions at the parameters `u`."""
    jets = _thirds(family, positions, directions, length)
    functions = family.curve_class.from_jets(jets, np.array([0.0, 1.0])).basis(u)
    rest = positions - functions[:, :, 0] @ jets[:, 0]
    # Columns: the two speeds, then x and y of each higher derivative at each end; rows: x, then y.
    speeds = np.stack([np.outer(directions[end], functions[:, end, 1]).ravel() for end in (0, 1)], axis=1)
    higher = functions[:, :, 2:].reshape(len(u), -1)
    free = np.kron(np.eye(2), higher)
    solution = np.linalg.lstsq(np.hstack([speeds, free]), rest.T.ravel(), rcond=None)[0]
    if solution[:2].min() < _LEAST * length:
        return jets
    jets[:, 1] = solution[:2, None] * directions
    jets[:, 2:] = np.moveaxis(solution[2:].reshape(2, 2, -1), 0, -1)
    return jets


def _feet(
    curve: ParametricCurve, positions: FloatArray, u: FloatArray, start: float, end: float
) -> FloatArray:
    """Return parameters nearer to the feet of the perpendiculars from positions to a curve; the ends stay."""
    away, velocity, bend = curve.evaluate(u) - positions, curve.evaluate(u, 1), curve.evaluate(u, 2)
    slope = (away * velocity).sum(axis=1)
    rise = (velocity * velocity).sum(axis=1) + (away * bend).sum(axis=1)
    step = np.divide(slope, rise, out=np.zeros_like(u), where=rise > 0.0)
    furthest = 0.1 * (end - start)
    moved = np.clip(u - np.clip(step, -furthest, furthest), start, end)
    moved[[0, -1]] = start, end
    there = curve.evaluate(moved) - positions
    is_nearer = (there * there).sum(axis=1) < (away * away).sum(axis=1)
    return np.where(is_nearer, moved, u)


# Curves simplified

SHARE = 0.002
"""Largest deviation of a simplified curve, as a share of the size of all curves to simplify."""

_TURN = cos(radians(20.0))
"""Cosine of the angle from which a joint is a corner."""

_LONG = 4.0
"""Least length of the pieces at a corner, in tolerances: shorter ones are jitter."""

_STRAIGHT = 1e-9
"""Largest distance of a handle from the chord of a straight piece, as a share of its length."""

_NEARLY_ON = radians(0.1)
"""Largest angle by which handles of a smooth point are turned into one line, in radians."""

_ANY = "a"
"""Letter of a point whose handles decide its kind."""

_SAMPLES_A_PIECE = 16
"""Samples of a piece that describe it."""


class Simplified(msgspec.Struct, frozen=True):
    """A document in which curves have fewer points.

    Attributes
    ----------
    document
        The document.
    before, after
        The numbers of points of the changed curves, before and after.
    deviation
        The largest distance of these curves from the old ones.
    """

    document: Document
    before: int
    after: int
    deviation: float


def simplified(
    document: Document, views: Sequence[CurveView], curves: Collection[int], report: Report = silent
) -> Simplified:
    """Return the document with fewer points in the curves `curves`, where that is possible.

    Raises
    ------
    EditError
        If none of them can do with fewer points.
    """
    indices = sorted(
        index for index in curves if views[index].is_current and len(views[index].source.points) > 2
    )
    tolerance = SHARE * size_of([views[index] for index in indices])
    result, before, after, deviation = document, 0, 0, 0.0
    for done, index in enumerate(indices):
        share = part(report, done / len(indices), (done + 1) / len(indices))
        curve, off = _simpler(views[index], tolerance, share)
        count, left = len(document.curves[index].points), len(curve.points)
        if left < count and off <= tolerance:
            result = result.with_curve(index, curve)
            before, after, deviation = before + count, after + left, max(deviation, off)
    if not before:
        raise EditError("None of the curves keeps its shape with fewer points.")
    return Simplified(result, before, after, deviation)


def size_of(views: Sequence[CurveView]) -> float:
    """Return the longer side of the box around the points of curves; 1 where there are none."""
    points = [view.points for view in views if len(view.points)]
    return float(np.ptp(np.concatenate(points), axis=0).max()) if points else 1.0


def _simpler(view: CurveView, tolerance: float, report: Report) -> tuple[Curve, float]:
    """Return a simpler curve near another one, and its largest deviation."""
    closed = view.source.is_closed
    path = curvecore.cubic_path(view.present_curve, max(RELATIVE_TOLERANCE * size_of([view]), 1e-300))
    pieces, corners = path.control_points, _corners(path.control_points, tolerance, closed=closed)
    if closed and len(corners):
        # It begins at a corner.
        pieces, corners = np.roll(pieces, -corners[0], axis=0), corners - corners[0]
    cuts = [*(corners if closed and len(corners) else [0, *corners]), len(pieces)]
    runs, letters, off = list[FloatArray](), "", float(path.deviation)
    for index, (start, end) in enumerate(pairwise(cuts)):
        share = part(report, index / len(cuts), (index + 1) / len(cuts))
        run, deviation = _run(pieces[start:end], tolerance, share, closed=closed and not len(corners))
        runs.append(run)
        letters += (CORNER if len(corners) else _ANY) + _ANY * (len(run) - 1)
        off = max(off, path.deviation + deviation)
    letters += "" if closed else CORNER
    points = points_of_cubics(np.concatenate(runs), closed=closed, most_turned=_NEARLY_ON, letters=letters)
    rule = Parametrization(ParametrizationKind.MANUAL)
    simpler = replace(view.source.with_family(HERMITE), points=points.points, parametrization=rule)
    return simpler, off + points.moved


def _corners(pieces: FloatArray, tolerance: float, *, closed: bool) -> IntArray:
    """Return the pieces that begin at a corner; an end of an open curve is none."""
    ahead, behind = _directions(pieces), -_directions(pieces[:, ::-1])
    turned = (np.roll(behind, 1, axis=0) * ahead).sum(axis=1) < _TURN
    is_long = np.linalg.norm(pieces[:, 3] - pieces[:, 0], axis=1) > _LONG * tolerance
    turned &= is_long & np.roll(is_long, 1)
    turned[0] &= closed
    return np.flatnonzero(turned)


def _directions(pieces: FloatArray) -> FloatArray:
    """Return the directions in which pieces begin, of length 1; 0 for a piece without length."""
    steps = pieces[:, 1:] - pieces[:, :1]
    first = steps.any(axis=2).argmax(axis=1)
    return unit_tangents(steps[np.arange(len(steps)), first])


def _run(pieces: FloatArray, tolerance: float, report: Report, *, closed: bool) -> tuple[FloatArray, float]:
    """Return fewer pieces near those between two corners, and their largest deviation."""
    if not closed and _is_straight(pieces):
        return np.linspace(pieces[0, 0], pieces[-1, 3], 4)[None], 0.0
    if len(pieces) == 1:
        return pieces, 0.0
    data = np.concatenate(list(_sampled(pieces)))
    try:
        fitted_run = curvecore.fit(
            data,
            HERMITE.curve_class,
            tolerance=tolerance,
            closed=closed,
            with_corners=False,
            progress=lambda share: report(share, "Simplifying"),
        )
    except CurveError as problem:
        raise EditError(f"A curve could not be fitted: {problem}.") from problem
    segments = curvecore.bezier_segments(fitted_run.curve)
    is_better = len(segments) < len(pieces) and fitted_run.deviation <= tolerance
    return (segments, float(fitted_run.deviation)) if is_better else (pieces, 0.0)


def _sampled(pieces: FloatArray) -> Iterator[FloatArray]:
    """Yield samples of pieces, and the end of the last one."""
    s = np.arange(_SAMPLES_A_PIECE) / _SAMPLES_A_PIECE
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s * s * (1 - s), s**3], axis=1)
    yield np.einsum("mw,kwd->kmd", weights, pieces).reshape(-1, 2)
    yield pieces[-1:, 3]


def _is_straight(pieces: FloatArray) -> bool:
    """Whether pieces lie on one straight line in one direction."""
    positions = pieces.reshape(-1, 2)
    chord = positions[-1] - positions[0]
    length = float(np.hypot(*chord))
    if not length:
        return False
    off = (positions - positions[0]) @ np.array([-chord[1], chord[0]])
    along = (positions - positions[0]) @ chord
    return bool(np.abs(off).max() <= _STRAIGHT * length**2 and (np.diff(along) >= 0).all())
