"""One curve made two, and two made one, with their shapes kept."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore import chebyshev
from curvecore.parametrization import spread

from .. import view_model
from ..document.derivatives import DERIVATIVES
from ..document.edits import EditError
from ..document.model import Curve, ParametrizationKind, Point, Vector
from ..document.ties import tied_if_parallel
from ..document.words import number
from ..families import HERMITE, titles_with_derivatives
from .curve_view import CurveView, view_of
from .measure import dense, is_kept, largest_distance, outcome
from .plane import polygon_length, size_of
from .reshape import Reshaped, baked, refuse_without_curve, through, with_point_inserted

MOST_POINTS_SPLIT = 40
"""Points up to which a polynomial is split: each half goes through as many, and rounding grows with them."""

_BETWEEN_ENDS = "The curve can be split between its ends, not at them."

_COINCIDE = 1e-9
"""Distance, relative to the size of two curves, up to which end and start are one point."""


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
    made = Split(parts, _residual_of_parts(view, parts))
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
        _part(view.source, _on_polynomial(view, *half), half[1], name)
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
    ending, beginning = points[nearest].without_corner(), _beginning(points[nearest])
    return (
        _part(whole.source, [*points[:nearest], ending], ending.t or 0.0, first),
        _part(whole.source, [beginning, *points[nearest + 1 :]], points[-1].t or 0.0, second),
    )


def _opened(whole: CurveView, at: int) -> Curve:
    """Return a baked closed curve as an open one from point `at` once round to it."""
    points = whole.source.points
    period = float(whole.parameters[-1] - whole.parameters[0])
    later = [replace(point, t=(point.t or 0.0) + period) for point in points[: at + 1]]
    around = [_beginning(points[at]), *points[at + 1 :], *later[:-1], later[-1].without_corner()]
    return _part(whole.source, around, around[-1].t or 0.0, whole.source.name)


def _beginning(point: Point) -> Point:
    """Return `point` as the first of a curve: with what it has after it."""
    after = [point.explicit_sides(each.order)[1] for each in DERIVATIVES]
    return point.without_corner().with_derivatives(after, ())


def _part(curve: Curve, points: Sequence[Point], end: float, name: str) -> Curve:
    rule = replace(curve.parametrization, kind=ParametrizationKind.MANUAL, start=points[0].t or 0.0, end=end)
    return replace(curve, name=name, points=tuple(points), parametrization=rule, closed=False)


def _names_of_parts(name: str) -> tuple[str, str]:
    return f"{name} a", f"{name} b"


def _residual_of_parts(view: CurveView, parts: Sequence[Curve]) -> float:
    start, end = view.parameters[[0, -1]].tolist()
    residual = 0.0
    for part in map(view_of, parts):
        refuse_without_curve(part)
        t = dense(part.parameters)
        residual = max(residual, largest_distance(view, np.where(t > end, t - (end - start), t), part, t))
    return residual


def joined(first: CurveView, second: CurveView) -> Reshaped:
    """Join the end of `first` to the start of `second`: one curve, its parameters one after the other.

    Both keep their shapes. Where end and start coincide they become one point, a corner if the derivatives
    there differ; else a segment leads from one to the other, at the mean of the speeds on both sides.

    Raises
    ------
    EditError
        If there is no curve to join, or the two cannot be one curve of a family.
    """
    _refuse_to_join(first, second)
    a, b = baked(first), baked(second)
    ending, beginning = a.points[-1].without_corner(), _beginning(b.points[0])
    gap = math.dist(first.points[-1], second.points[0])
    size = max(size_of(np.vstack([first.points, second.points])), 1e-300)
    if gap <= _COINCIDE * size:
        wait = 0.0
        seam, after = (_merged(ending, beginning),), b.points[1:]
    else:
        wait = gap / _speed_at_seam(first, second)
        seam, after = (ending,), (beginning, *b.points[1:])
    end = float(first.parameters[-1])
    start = float(second.parameters[0])
    later = tuple(replace(point, t=end + wait + ((point.t or 0.0) - start)) for point in after)
    points = (*a.points[:-1], *seam, *later)
    if any(not (y.t or 0.0) > (x.t or 0.0) for x, y in pairwise(points)):
        raise EditError("The parameters of the second curve lie too close together to follow the first's.")
    curve = _part(a, points, points[-1].t or 0.0, a.name)
    residual = _residual_of_join(first, second, view_of(curve), end + wait - start)
    if not is_kept(residual, (first.source, second.source)):
        other = f"Choose {titles_with_derivatives()} for both."
        if not a.family.interpolates:
            other = f"Convert both to {titles_with_derivatives()} first, keeping the shape."
        raise EditError(
            f"Two {a.family.title} curves cannot be joined: they would become another curve, up to "
            f"{number(residual, 2)} away. {other}"
        )
    return Reshaped(curve, residual)


def _refuse_to_join(first: CurveView, second: CurveView) -> None:
    for view in (first, second):
        if not view.is_current:
            raise EditError(f"“{view.source.name}” cannot be joined. {view.problem}")
        if view.source.is_closed:
            raise EditError(f"“{view.source.name}” is closed and has no end; open it first.")
    one, other = first.source.family, second.source.family
    if one.curve_class.is_one_polynomial or other.curve_class.is_one_polynomial:
        raise EditError(f"Two polynomials make no third; choose {titles_with_derivatives()} for both curves.")
    if one != other:
        first_kind, second_kind = (each.full_title.partition(" ")[0] for each in (one, other))
        raise EditError(f"One curve is {first_kind}, the other {second_kind}; choose one family for both.")


def _speed_at_seam(first: CurveView, second: CurveView) -> float:
    """Return the speed for the way from one curve to the other, positive."""
    assert first.curve is not None
    assert second.curve is not None
    velocities = [
        first.curve.evaluate(first.curve.domain[1], 1),
        second.curve.evaluate(second.curve.domain[0], 1),
    ]
    speeds = np.hypot(*np.array(velocities).T)
    mean = float(speeds.mean())
    if mean > 0:
        return mean
    chord = polygon_length(first.points)
    return max(chord, 1e-300) / float(first.parameters[-1] - first.parameters[0])


def _merged(end: Point, start: Point) -> Point:
    """Return the point where a curve ends and another starts: smooth where they go on in one direction.

    A corner where not, and a point like any other where all goes on alike.
    """
    before, after = ([getattr(point, each.name) for each in DERIVATIVES] for point in (end, start))
    if all(map(_alike, before, after)):
        return end
    return tied_if_parallel(end.as_corner().with_derivatives(before, after))


def _alike(x: Vector | None, y: Vector | None) -> bool:
    if x is None or y is None:
        return x is y
    scale = max(*map(abs, x), *map(abs, y))
    return max(abs(x[0] - y[0]), abs(x[1] - y[1])) <= 1e-12 * scale


def _residual_of_join(first: CurveView, second: CurveView, whole: CurveView, shift: float) -> float:
    refuse_without_curve(whole)
    residual = 0.0
    for view, by in ((first, 0.0), (second, shift)):
        t = dense(view.parameters)
        residual = max(residual, largest_distance(view, t, whole, t + by))
    return residual
