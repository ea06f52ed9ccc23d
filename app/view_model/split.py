"""One curve made two or more, with its shape kept: at given t, or at intersections. Segments cut out."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from itertools import combinations_with_replacement, pairwise
from string import ascii_lowercase
from typing import TYPE_CHECKING, NamedTuple

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore import chebyshev
from curvecore.arithmetic import cross, vector_lengths
from curvecore.parametrization import spread

from ..document.derivatives import DERIVATIVES
from ..document.limits import EditError
from ..document.model import Curve, ParametrizationKind, Point, Vector
from ..document.straight_edits import straight_refusal
from ..document.words import number
from ..families import HERMITE
from .curve.curve_view import CurveView, view_of
from .curve.distances import dense, keeps_shape, largest_distance, outcome
from .geometry import size_of
from .reshape import (
    SAME_PARAMETER,
    convert_first,
    frozen,
    refuse_without_curve,
    through,
    with_jets,
    with_point_inserted,
    with_sides_kept,
)

if TYPE_CHECKING:
    from curvecore import Intersections, SelfIntersections

MOST_POINTS_SPLIT = 40
"""Points up to which a polynomial is split: each half goes through as many, and rounding grows with them."""

_BETWEEN_ENDS = "The curve can be split between its ends, not at them."


class Split(msgspec.Struct, frozen=True):
    """The result of cuts: two curves or more, or one open curve where a closed one was cut once.

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
    def cuts(self) -> set[Vector]:
        """The positions of the ends of the curves."""
        return {curve.points[end].position for curve in self.curves for end in (0, -1)}

    @property
    def sentence(self) -> str:
        """The outcome for the shape."""
        return outcome(self.residual, self.curves)


def split(view: CurveView, *cuts: float) -> Split:
    """Cut the curve at some t, at joints or between them; a closed curve becomes open where it is cut first.

    A Hermite curve is cut exactly: the parts have manual parameters, and explicit derivatives where they are
    cut; and so is a curve over control points, by subdivision. Of one polynomial each part goes through as
    many points as the whole, at Chebyshev points of its part of t, and is thereby the same polynomial.

    Raises
    ------
    EditError
        If there is no curve, a cut is at an end, one polynomial has too many points, or the parts would not
        have the shape of the whole.
    """
    refuse_without_curve(view)
    family = view.source.family
    cuts = tuple(sorted(set(cuts)))
    parts = _restricted(view, cuts)
    if parts is None:
        of_one = family.curve_class.is_one_polynomial
        parts = _split_polynomial(view, cuts) if of_one else _split_pieces(view, cuts)
    result = Split(parts, residual_of_parts(view, parts))
    if not family.curve_class.is_one_polynomial and not keeps_shape(result.residual, parts):
        raise EditError(
            f"{family.subject} cannot be split: the parts would be off by up to "
            f"{number(result.residual, 2)}. {convert_first(view)}"
        )
    return result


def parameters_between_ends(view: CurveView, indices: Collection[int]) -> list[float]:
    """Return the parameters of points, in order, without those at the ends of an open curve."""
    knots = view.curve.nodes if view.curve is not None else view.parameters
    last = len(view.source.points) - 1
    return [float(knots[index]) for index in sorted(indices) if view.source.is_closed or 0 < index < last]


def _restricted(view: CurveView, cuts: Sequence[float]) -> tuple[Curve, ...] | None:
    """Return the parts as curves over their own control points; None of a family without control points."""
    start, end = view.present_curve.domain
    if not all(start < t < end for t in cuts):
        return None
    parts = []
    for (low, high), name in zip(
        pairwise((start, *cuts, end)), names_of_parts(view.source.name, len(cuts) + 1), strict=True
    ):
        part = view.present_curve.restricted(low, high)
        if part is None:
            return None
        parts.append(replace(through(view, part), name=name))
    return tuple(parts)


def _split_polynomial(view: CurveView, cuts: Sequence[float]) -> tuple[Curve, ...]:
    count = len(view.source.points)
    if count > MOST_POINTS_SPLIT:
        raise EditError(
            f"{view.source.family.subject} of {count} points cannot be split: each half needs as many "
            f"points, and beyond {MOST_POINTS_SPLIT} rounding shows. Choose {HERMITE.title} first."
        )
    start, end = view.parameters[[0, -1]].tolist()
    if not all(start < t < end for t in cuts):
        raise EditError(_BETWEEN_ENDS)
    names = names_of_parts(view.source.name, len(cuts) + 1)
    return tuple(
        part_of(view.source, _on_polynomial(view, low, high), high, name)
        for (low, high), name in zip(pairwise((start, *cuts, end)), names, strict=True)
    )


def _on_polynomial(view: CurveView, start: float, end: float) -> list[Point]:
    t = spread(chebyshev(len(view.source.points)), start, end)
    points = view.present_curve.evaluate(t)
    return [Point(x, y, t=parameter) for (x, y), parameter in zip(points.tolist(), t.tolist(), strict=True)]


def _split_pieces(view: CurveView, cuts: Sequence[float]) -> tuple[Curve, ...]:
    whole = frozen(view)
    span = whole.parameters[-1] - whole.parameters[0]
    for t in cuts:
        if np.abs(whole.parameters - t).min() > SAME_PARAMETER * span:
            whole = view_of(with_point_inserted(whole, t).curve)
    at = sorted({whole.owner(int(np.argmin(np.abs(whole.parameters - t)))) for t in cuts})
    count = len(whole.source.points)
    if not whole.source.is_closed and not all(0 < index < count - 1 for index in at):
        raise EditError(_BETWEEN_ENDS)
    knots = [*at, at[0] + count] if whole.source.is_closed else [0, *at, count - 1]
    names = names_of_parts(view.source.name, len(knots) - 1)
    return tuple(_cut(whole, *ends, name) for ends, name in zip(pairwise(knots), names, strict=True))


def _cut(whole: CurveView, start: int, end: int, name: str) -> Curve:
    """Return the part between two knots of a curve with manual parameters; a closed one goes on at its end.

    Where it was cut its derivatives become explicit, and beside that those whose estimates would change.
    """
    source, count = whole.source, len(whole.source.points)
    period = float(whole.parameters[-1] - whole.parameters[0])
    rows = np.arange(start, end + 1)
    points = [
        replace(source.points[row % count], t=(source.points[row % count].t or 0.0) + row // count * period)
        for row in rows.tolist()
    ]
    if whole.sides is not None:
        for end_index, knot, open_end in ((0, start, 0), (-1, end, count - 1)):
            if source.is_closed or knot != open_end:
                points[end_index] = with_jets(points[end_index], whole.sides, knot % count)
    points[0], points[-1] = beginning(points[0]), points[-1].without_corner()
    part = part_of(source, points, points[-1].t or 0.0, name)
    return part if whole.sides is None else with_sides_kept(whole.sides, part, rows % count, rows - start)


def beginning(point: Point) -> Point:
    """Return `point` as the first of a curve, with the derivatives that it has after it."""
    after = [point.explicit_sides(derivative.order)[1] for derivative in DERIVATIVES]
    return point.without_corner().with_derivatives(after, ())


def part_of(curve: Curve, points: Sequence[Point], end: float, name: str) -> Curve:
    """Return an open curve like another through points with manual parameters, which go on to `end`."""
    rule = replace(curve.parametrization, kind=ParametrizationKind.MANUAL, start=points[0].t or 0.0, end=end)
    return replace(curve, name=name, points=tuple(points), parametrization=rule, closed=False)


def names_of_parts(name: str, count: int) -> list[str]:
    """Return names for the parts of a curve: with letters, or numbers where there are many."""
    if count == 1:
        return [name]
    letters = ascii_lowercase if count <= len(ascii_lowercase) else map(str, range(1, count + 1))
    return [f"{name} {letter}" for _, letter in zip(range(count), letters, strict=False)]


def residual_of_parts(view: CurveView, parts: Sequence[Curve]) -> float:
    """Return the largest distance of parts from their curve; beyond its end it continues at its start."""
    start, end = view.parameters[[0, -1]].tolist()
    residual = 0.0
    for part in map(view_of, parts):
        refuse_without_curve(part)
        t = dense(part.parameters)
        residual = max(residual, largest_distance(view, np.where(t > end, t - (end - start), t), part, t))
    return residual


# At intersections

_MEET, _SAME_POSITION = 1e-10, 1e-8
"""Shares of the size of curves within which they meet, and within which two positions on one are the same."""

_PARALLEL = 1e-3
"""Angle in radians up to which curves that run along each other somewhere do so at a meeting."""

_NEAR = 1e-4
"""Share of the domain within which the parameters of two positions are that are the same."""


class Crossings(NamedTuple):
    """The parameters at which curves can be split where they meet, and whether that is everywhere."""

    cuts: dict[int, list[float]]
    is_complete: bool


def crossings_of(views: Mapping[int, CurveView]) -> Crossings:
    """Return the intersections of curves with each other and with themselves; an end of one is no cut of it.

    Where curves run along each other they meet everywhere, and the result is not complete.
    """
    curves = {index: view.curve for index, view in views.items() if view.curve is not None}
    boxes = {index: curvecore.bounding_box(curve) for index, curve in curves.items()}
    size = size_of(np.vstack([view.points for view in views.values()]))
    met, is_complete, reach = {index: list[float]() for index in curves}, True, _MEET * size
    for one, other in combinations_with_replacement(curves, 2):
        ends = ((boxes[one], boxes[other]), (boxes[other], boxes[one]))
        if any((low.minimum > high.maximum + reach).any() for low, high in ends):
            continue
        meetings: SelfIntersections | Intersections = (
            curvecore.self_intersections(curves[one], reach)
            if one == other
            else curvecore.intersections(curves[one], curves[other], reach)
        )
        parameters = meetings.parameters
        if not meetings.is_complete:
            # Where they run along each other there is a meeting at any of their points.
            v, w = curves[one].evaluate(parameters[:, 0], 1), curves[other].evaluate(parameters[:, 1], 1)
            is_crossing = np.abs(cross(v, w)) > _PARALLEL * vector_lengths(v) * vector_lengths(w)
            parameters, is_complete = parameters[is_crossing], False
        met[one] += parameters[:, 0].tolist()
        met[other] += parameters[:, 1].tolist()
    cuts = {index: _cuts(views[index], sorted(parameters), size) for index, parameters in met.items()}
    return Crossings({index: parameters for index, parameters in cuts.items() if parameters}, is_complete)


def _cuts(view: CurveView, parameters: Sequence[float], size: float) -> list[float]:
    """Return parameters in order without repetitions: joints in place of those beside them, but no ends."""
    knots, curve, cuts = view.parameters, view.present_curve, list[float]()

    def are_same(t: float, other: float) -> bool:
        away = curve.evaluate(np.array([t, other]))
        is_near = abs(t - other) <= _NEAR * (knots[-1] - knots[0])
        return is_near and math.dist(*away) <= _SAME_POSITION * size

    for parameter in parameters:
        knot = int(np.abs(knots - parameter).argmin())
        is_knot = are_same(parameter, float(knots[knot]))
        is_end = is_knot and not view.source.is_closed and knot in (0, len(knots) - 1)
        # A closed curve ends at its first point.
        t = float(knots[knot % (len(knots) - view.source.is_closed)]) if is_knot else parameter
        if not is_end and not any(are_same(t, cut) for cut in cuts):
            cuts.append(t)
    return sorted(cuts)


# Segments cut out


def without_segments(view: CurveView, segments: Collection[int]) -> Split:
    """Return the parts of a curve that remain without some segments; a closed curve becomes open.

    Parameters become manual, and derivatives at new ends explicit. A point without a segment is left out.

    Raises
    ------
    EditError
        If the curve has no segments of its own, or nothing would be left.
    """
    if reason := straight_refusal(view.source.family):
        raise EditError(reason)
    refuse_without_curve(view)
    whole, count = frozen(view), len(view.source.points)
    start = min(segments) + 1 if view.source.is_closed else 0
    last, runs = start + count - 1, list[tuple[int, int]]()
    for knot in range(start, last + 1):
        if knot == last or knot % count in segments:
            runs += [(start, knot)] if knot > start else []
            start = knot + 1
    if not runs:
        raise EditError("No segment of the curve would be left. Use Delete to remove the whole curve.")
    names = names_of_parts(view.source.name, len(runs))
    curves = tuple(_cut(whole, *run, part_name) for run, part_name in zip(runs, names, strict=True))
    return Split(curves, residual_of_parts(view, curves))
