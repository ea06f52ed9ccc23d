"""One curve made two, with its shape kept."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore import chebyshev
from curvecore.parametrization import spread

from .. import view_model
from ..document.derivatives import DERIVATIVES
from ..document.edits import EditError
from ..document.model import Curve, ParametrizationKind, Point
from ..document.words import number
from ..families import HERMITE
from .curve_view import CurveView, view_of
from .measure import dense, is_kept, largest_distance, outcome
from .reshape import baked, refuse_without_curve, through, with_point_inserted

MOST_POINTS_SPLIT = 40
"""Points up to which a polynomial is split: each half goes through as many, and rounding grows with them."""

_BETWEEN_ENDS = "The curve can be split between its ends, not at them."


class Split(msgspec.Struct, frozen=True):
    """The result of a cut: two curves, or one that is open where a closed one was cut.

    Attributes
    ----------
    curves
        The parts, in order.
    residual
        The largest distance by which a point of the curve moved, measured on dense samples.
    """

    curves: tuple[Curve, ...]
    residual: float

    @property
    def sentence(self) -> str:
        """The outcome for the shape."""
        return outcome(self.residual, self.curves)


def split(view: CurveView, t: float) -> Split:
    """Cut the curve at `t`, at a joint or between two; a closed curve becomes an open one that begins there.

    A Hermite curve is cut exactly: the parts have manual parameters and explicit derivatives; and so is a
    curve over control points, by subdivision. Of one polynomial each half goes through as many points as the
    whole, at Chebyshev points of its part of t, and is thereby the same polynomial.

    Raises
    ------
    EditError
        If there is no curve, `t` is at its ends, one polynomial has too many points, or the parts would not
        have the shape of the whole.
    """
    refuse_without_curve(view)
    family = view.source.family
    parts = _restricted(view, t)
    if parts is None:
        parts = _split_polynomial(view, t) if family.curve_class.is_one_polynomial else _split_pieces(view, t)
    made = Split(parts, residual_of_parts(view, parts))
    if not family.curve_class.is_one_polynomial and not is_kept(made.residual, parts):
        within = view_model.convert.outlook(view, HERMITE).within
        kept = f"within {number(within, 1)}" if within else "keeping the shape"
        raise EditError(
            f"{family.subject} cannot be split: its parts would be other curves, up to "
            f"{number(made.residual, 2)} away. Convert it to {HERMITE.title} first, {kept}."
        )
    return made


def _restricted(view: CurveView, t: float) -> tuple[Curve, ...] | None:
    """Return both parts as curves over their own control points; None of a family without such."""
    assert view.curve is not None
    start, end = view.curve.domain
    if not start < t < end:
        return None
    parts = []
    for half, name in zip(((start, t), (t, end)), _names_of_parts(view.source.name), strict=True):
        part = view.curve.restricted(*half)
        if part is None:
            return None
        parts.append(replace(through(view, part), name=name))
    return tuple(parts)


def _split_polynomial(view: CurveView, t: float) -> tuple[Curve, ...]:
    count = len(view.source.points)
    if count > MOST_POINTS_SPLIT:
        raise EditError(
            f"{view.source.family.subject} of {count} points cannot be split well: each half needs as "
            f"many points, and beyond {MOST_POINTS_SPLIT} rounding shows. Choose {HERMITE.title} first."
        )
    start, end = view.parameters[[0, -1]].tolist()
    if not start < t < end:
        raise EditError(_BETWEEN_ENDS)
    halves = ((start, t), (t, end))
    return tuple(
        part_of(view.source, _on_polynomial(view, *half), half[1], name)
        for half, name in zip(halves, _names_of_parts(view.source.name), strict=True)
    )


def _on_polynomial(view: CurveView, start: float, end: float) -> list[Point]:
    assert view.curve is not None
    t = spread(chebyshev(len(view.source.points)), start, end)
    points = view.curve.evaluate(t)
    return [Point(x, y, t=each) for (x, y), each in zip(points.tolist(), t.tolist(), strict=True)]


def _split_pieces(view: CurveView, t: float) -> tuple[Curve, ...]:
    whole = view_of(baked(view))
    knots = whole.parameters
    span = knots[-1] - knots[0]
    nearest = int(np.argmin(np.abs(knots - t)))
    if abs(knots[nearest] - t) > 1e-9 * span:
        whole = view_of(with_point_inserted(whole, t).curve)
        nearest = int(np.searchsorted(whole.parameters, t))
    if whole.source.is_closed:
        return (_opened(whole, whole.owner(nearest)),)
    points = whole.source.points
    if not 0 < nearest < len(points) - 1:
        raise EditError(_BETWEEN_ENDS)
    first, second = _names_of_parts(view.source.name)
    end, start = points[nearest].without_corner(), beginning(points[nearest])
    return (
        part_of(whole.source, [*points[:nearest], end], end.t or 0.0, first),
        part_of(whole.source, [start, *points[nearest + 1 :]], points[-1].t or 0.0, second),
    )


def _opened(whole: CurveView, at: int) -> Curve:
    """Return a baked closed curve as an open one from point `at` once round to it."""
    points = whole.source.points
    period = float(whole.parameters[-1] - whole.parameters[0])
    later = [replace(point, t=(point.t or 0.0) + period) for point in points[: at + 1]]
    around = [beginning(points[at]), *points[at + 1 :], *later[:-1], later[-1].without_corner()]
    return part_of(whole.source, around, around[-1].t or 0.0, whole.source.name)


def beginning(point: Point) -> Point:
    """Return `point` as the first of a curve: with what it has after it."""
    after = [point.explicit_sides(each.order)[1] for each in DERIVATIVES]
    return point.without_corner().with_derivatives(after, ())


def part_of(curve: Curve, points: Sequence[Point], end: float, name: str) -> Curve:
    """Return an open curve like another through points with parameters of their own, which go on to `end`."""
    rule = replace(curve.parametrization, kind=ParametrizationKind.MANUAL, start=points[0].t or 0.0, end=end)
    return replace(curve, name=name, points=tuple(points), parametrization=rule, closed=False)


def _names_of_parts(name: str) -> tuple[str, str]:
    return f"{name} a", f"{name} b"


def residual_of_parts(view: CurveView, parts: Sequence[Curve]) -> float:
    """Return how far parts of a curve are from it; beyond its end it goes on from its start."""
    start, end = view.parameters[[0, -1]].tolist()
    residual = 0.0
    for part in map(view_of, parts):
        refuse_without_curve(part)
        t = dense(part.parameters)
        residual = max(residual, largest_distance(view, np.where(t > end, t - (end - start), t), part, t))
    return residual
