"""Curves of few points near many, as a document has them."""

from __future__ import annotations

from itertools import chain, pairwise
from math import ceil
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

import curvecore
from curvecore import CurveError, ParametricCurve
from curvecore.arrays import FloatArray

from ...document.derivatives import DERIVATIVES
from ...document.edits import EditError
from ...document.model import Curve, Parametrization, ParametrizationKind, Point, Vector
from ...document.words import count_of, number
from ...tasks.progress import Report, silent
from ..curve.curve_view import CurveView

SCATTERED = "The data scatter so far; more points would follow that alone."

_MANY, _FEW = 1000, 300
"""Places on a curve that are enough to say what it looks like; points of which it is not said by these alone.

Places between points that have errors would make a smooth curve of the errors.
"""


class Fitted(NamedTuple):
    """A curve of the document near data.

    Attributes
    ----------
    curve
        The curve; its parameters are its own, so that it stays as it was fitted.
    core
        The same as the core has it.
    deviation, root_mean_square
        The largest distance of the data from it, and the root of the mean of the squares.
    place
        The datum that is farthest away.
    is_scattered
        Whether it is so far off because the data have errors as large as that.
    """

    curve: Curve
    core: ParametricCurve
    deviation: float
    root_mean_square: float
    place: Vector
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
    """Whether the points of a curve are what is fitted: of many, or where it may swing between them."""
    return not view.source.family.curve_class.is_local or len(view.parameters) >= _FEW


def data_of(view: CurveView) -> Data:
    """Return what a curve shows: its points and, where these are few and the curve calm, places between.

    A curve whose functions reach far may swing between its points as nobody meant it to.

    Raises
    ------
    EditError
        If there is no curve.
    """
    if not view.is_current:
        raise EditError(view.problem)
    assert view.curve is not None
    t = view.parameters
    if not is_of_points_alone(view):
        share = np.arange(ceil(_MANY / len(t))) / ceil(_MANY / len(t))
        t = np.append((t[:-1, None] + share * np.diff(t)[:, None]).reshape(-1), t[-1])
        return Data(view.curve.evaluate(t), t)
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

    `keeps_times` leaves every place its t, so that a motion stays the same; else only the shape counts.

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

    Closed where the model is. `times` are parameters of the data, which are kept; see `curvecore.fit` for
    the rest.

    Raises
    ------
    EditError
        If there is no such curve.
    """
    data = np.asarray(points, dtype=np.float64)
    if model.family.is_missing:
        raise EditError(model.family.problem)
    is_closed = model.closed and model.family.curve_class.can_close
    found = _fit(model, data, count, tolerance, times, report, is_closed=is_closed)
    rule = model.parametrization
    span = (rule.start, rule.end) if times is None else found.curve.domain
    own = _points(found.curve, span, is_closed=is_closed)
    parametrization = Parametrization(ParametrizationKind.MANUAL, rule.alpha, *span)
    curve = replace(model, points=own, parametrization=parametrization, closed=is_closed)
    x, y = data[found.worst].tolist()
    return Fitted(curve, found.curve, found.deviation, found.root_mean_square, (x, y), found.is_scattered)


def _fit(
    model: Curve,
    data: FloatArray,
    count: int | None,
    tolerance: float | None,
    times: FloatArray | None,
    report: Report,
    *,
    is_closed: bool,
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
            progress=lambda share: report(share, "Fitting"),
        )
    except CurveError as problem:
        text = str(problem)
        raise EditError(f"{text[:1].upper()}{text[1:]}.") from None


def _points(core: ParametricCurve, span: Vector, *, is_closed: bool) -> tuple[Point, ...]:
    """Return the points of a curve of the document, whose parameters begin and end at `span`."""
    (start, end), (first, last) = span, core.domain
    stretch = (end - start) / (last - first)
    jets = [piece.jets / stretch ** np.arange(float(piece.jets.shape[1]))[:, None] for piece in core.pieces]
    times = start + (core.parameters - first) * stretch
    times[-1] = end
    joints = {0: (jets[-1][-1], jets[0][0])} if is_closed else {}
    place = 0
    for before, after in pairwise(jets):
        place += len(before) - 1
        joints[place] = (before[-1], after[0])
    rows = list(chain(jets[0][:1], *(each[1:] for each in jets)))
    return tuple(
        _point(joints.get(index, (jet, jet)), float(t), may_turn=index in joints)
        for index, (jet, t) in enumerate(zip(rows, times, strict=True))
        if index < len(rows) - is_closed
    )


def _point(sides: tuple[FloatArray, FloatArray], t: float, *, may_turn: bool) -> Point:
    before, after = (each.tolist() for each in sides)
    is_corner = may_turn and before != after
    x, y = before[0]
    point = Point(x, y, t=t, corner=is_corner)
    given = {each.name: tuple(value) for each, value in zip(DERIVATIVES, before[1:], strict=False)}
    if is_corner:
        ahead = zip(DERIVATIVES, after[1:], strict=False)
        given |= {each.after: tuple(value) for each, value in ahead}
    return replace(point, **given)
