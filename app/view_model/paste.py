"""Points carried from one curve to another, with their derivatives and spacings in t, and curves added."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from itertools import pairwise

import msgspec
from msgspec.structs import replace

from ..document.constraints import rescaled
from ..document.curve_edits import without_curve
from ..document.groups import Container, shape_of
from ..document.limits import EditError
from ..document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
    Vector,
    make_curve,
)
from ..document.point_edits import insert_points, set_points
from ..document.point_group import PointGroup
from ..document.rule_edits import freeze_parameters, set_interval
from ..document.several_curves import add_curves, is_blank, move_group, whole_curves
from ..document.words import number
from .append import appended_parameter, with_points_appended
from .boxes import around
from .curve.curve_view import CurveView, view_of
from .curve.transformed import views_ahead
from .split import split


def copied(view: CurveView, indices: Collection[int]) -> Curve:
    """Return a curve of the points at `indices` alone; each has the parameter that is in force."""
    rules = view.source.parametrization
    t = view.parameters.tolist() if view.is_current else [None] * len(view.source.points)
    if view.source.is_manual and not view.is_current:
        rules = replace(rules, kind=ParametrizationKind.CHORD_LENGTH)
    points = tuple(replace(view.source.points[index], t=t[index]) for index in sorted(indices))
    return replace(
        view.source, points=points, parametrization=rules, closed=False, visible=True, locked=False
    )


def appended(view: CurveView, pasted: Sequence[Point]) -> Curve:
    """Return the curve of `view` with `pasted` appended.

    Of their parameters only the spacings count. Under a rule they get others, and the derivatives are
    rescaled so that the handles of the pasted points keep their proportions.
    """
    document, count = Document((view.source,)), len(view.source.points)
    if view.source.is_manual:
        return with_points_appended(document, 0, view, _later(view, pasted)).curves[0]
    document = with_points_appended(document, 0, view, [replace(point, t=None) for point in pasted])
    factor = _factor(pasted, view_of(document.curves[0]))
    points = document.curves[0].points
    new = (rescaled(point, factor) for point in points[count:])
    return set_points(document, 0, (*points[:count], *new)).curves[0]


def _later(view: CurveView, pasted: Sequence[Point]) -> list[Point]:
    """Return `pasted` with manual parameters after those of the curve, with the same spacings."""
    first = appended_parameter(view, pasted[0])
    parameters = [point.t for point in pasted]
    steps = [t - parameters[0] for t in parameters if t is not None and parameters[0] is not None]
    if len(steps) < len(pasted):
        last = view.source.points[-1].t if view.source.points else None
        step = first - last if last is not None else 1.0
        steps = [step * index for index in range(len(pasted))]
    return [replace(point, t=first + step) for point, step in zip(pasted, steps, strict=True)]


def _factor(pasted: Sequence[Point], after: CurveView) -> float:
    """Return the factor by which the pasted points span more of t than before."""
    first, last = pasted[0].t, pasted[-1].t
    if first is None or last is None or not last > first or not after.is_current:
        return 1.0
    end = len(after.source.points)
    new = after.parameters[end - len(pasted) : end]
    return float((new[-1] - new[0]) / (last - first))


def appended_with_parameters(view: CurveView, pasted: Sequence[Point], first_row: int) -> Curve:
    """Return the curve with `pasted` appended at their own parameters; all become manual.

    `first_row` is the number of the row of the first point in the text, for messages.
    """
    refuse_unordered(pasted, first_row)
    count = len(view.source.points)
    if count and not (view.source.is_manual or view.is_current):
        raise EditError(f"The curve has no parameters to continue from. {view.problem}")
    present = [point.t or 0.0 for point in view.source.points]
    if view.is_current:
        present = view.parameters[:count].tolist()
    new = [point.t or 0.0 for point in pasted]
    if present and not new[0] > present[-1]:
        raise EditError(
            f"Row {first_row}: t must be greater than {number(present[-1], 15)}, the t of the last point, "
            f"not {number(new[0], 15)}."
        )
    document = insert_points(Document((view.source,)), 0, count, pasted)
    return freeze_parameters(document, 0, [*present, *new]).curves[0]


def refuse_unordered(pasted: Sequence[Point], first_row: int) -> None:
    """Raise EditError unless the parameters of the rows increase."""
    for row, (before, t) in enumerate(pairwise(point.t or 0.0 for point in pasted), start=first_row + 1):
        if not t > before:
            raise EditError(
                f"Row {row}: t must be greater than {number(before, 15)}, the t of the row before it, "
                f"not {number(t, 15)}."
            )


def points_of_rows(rows: Sequence[Sequence[float]]) -> tuple[Point, ...]:
    """Return the points of rows with two columns, x y, or three, t x y.

    Raises
    ------
    EditError
        If there are more or fewer columns.
    """
    width = len(rows[0])
    if width == 2:
        return tuple(Point(x, y) for x, y in rows)
    if width == 3:
        return tuple(Point(x, y, t=t) for t, x, y in rows)
    columns = "this is one column" if width == 1 else f"these are {width} columns"
    raise EditError(
        f"Points have two columns, x y, or three, t x y; {columns}. Paste other columns into the point table."
    )


def as_new_curve(like: Curve, pasted: Sequence[Point], name: str) -> Curve:
    """Return a curve of `pasted` with the family and tangent rules of `like`; manual where they carry t.

    Otherwise it has the parameters of every new curve: interval and rule of another curve do not apply.
    """
    curve = replace(make_curve((), name=name, family=like.family), points=tuple(pasted))
    timed = all(point.t is not None for point in pasted)
    kind = ParametrizationKind.MANUAL if timed else ParametrizationKind.CHORD_LENGTH
    ruled = replace(curve, parametrization=Parametrization(kind), settings=like.settings)
    return ruled.with_rules_of(like)


def copied_as_new_curve(copy: Curve, name: str) -> Curve:
    """Return a curve of points that were copied with their rules; its parameters span 0 … 1.

    Under a rule the copied parameters are dropped; the rule gives others. Manual ones are mapped, and the
    derivatives with them: the shape is that of the copy.
    """
    if not copy.is_manual or len(copy.points) < 2:
        points = tuple(replace(point, t=None) for point in copy.points)
        kind = ParametrizationKind.CHORD_LENGTH if copy.is_manual else copy.parametrization.kind
        copy = replace(copy, points=points, parametrization=replace(copy.parametrization, kind=kind))
    return replace(set_interval(Document((copy,)), 0, 0.0, 1.0).curves[0], name=name)


def parts_of(views: Sequence[CurveView], group: PointGroup) -> list[Curve]:
    """Return curves of the points of a group alone; whole curves where all their points are in the group.

    A single point of a curve gives no curve.
    """
    curves = []
    for curve, indices in group.parts:
        view = views[curve]
        part = view.source if len(indices) == len(view.source.points) else part_of(view, indices)
        if part is not None:
            curves.append(part)
    return curves


def part_of(view: CurveView, indices: Collection[int]) -> Curve | None:
    """Return a curve of some points alone; None for fewer than two, and for all points.

    Neighbours on a piecewise curve keep the shape between them.
    """
    if not 1 < len(indices) < len(view.source.points):
        return None
    first, last = min(indices), max(indices)
    part = _cut_out(view, first, last) if last - first + 1 == len(indices) else None
    return copied_as_new_curve(replace(part or copied(view, indices), shape=""), view.source.name)


def _cut_out(view: CurveView, first: int, last: int) -> Curve | None:
    """Return the part of the curve from one point to another; None where it cannot be cut there."""
    kind = view.source.family.curve_class
    if view.source.is_closed or kind.is_one_polynomial or not kind.interpolates:
        return None
    try:
        if last < len(view.source.points) - 1:
            view = view_of(split(view, _parameter(view, last)).curves[0])
        if first > 0:
            view = view_of(split(view, _parameter(view, first)).curves[1])
    except EditError:
        return None
    return replace(view.source, visible=True, locked=False)


def _parameter(view: CurveView, index: int) -> float:
    knots = view.curve.nodes if view.curve is not None else view.parameters
    return float(knots[index])


# Curves added


class AddedCurves(msgspec.Struct, frozen=True):
    """A document with curves that were added to it.

    Attributes
    ----------
    document
        The document.
    places
        Where they are in it.
    views
        Their views, where these were made ahead.
    """

    document: Document
    indices: range
    views: tuple[CurveView, ...] = ()

    @property
    def curves(self) -> tuple[Curve, ...]:
        """The curves that were added."""
        return self.document.curves[self.indices.start : self.indices.stop]


def with_curves(document: Document, curves: Sequence[Curve]) -> AddedCurves:
    """Return the document with curves added in front, visible and unlocked, with unique names.

    The empty curve of a new document is replaced.
    """
    base = without_curve(document, 0) if is_blank(document) else document
    first = len(base.curves)
    return AddedCurves(add_curves(base, curves, first), range(first, first + len(curves)))


class PasteTarget(msgspec.Struct, frozen=True):
    """Destination of pasted curves.

    Attributes
    ----------
    document
        The document that gets them.
    position
        The new position of their middle; None leaves them where they are.
    pixel
        The length of a pixel, to which the position is rounded.
    views
        Views of curves that may be the originals: nothing is computed again of a copy.
    """

    document: Document
    position: Vector | None = None
    pixel: float = 1.0
    views: Sequence[CurveView] = ()

    def filled(
        self, curves: Sequence[Curve], progress: Callable[[float], object] | None = None
    ) -> AddedCurves:
        """Return the document with the curves; with `progress` it has views."""
        added = with_curves(self.document, curves)
        known = {id(view.source.points): view for view in self.views}
        originals = [known.get(id(curve.points)) for curve in added.curves]
        if self.position is not None:
            moved_there = centred_at(added, originals, self.position, self.pixel)
            added = replace(added, document=moved_there)
        if progress is None:
            return added
        return replace(added, views=tuple(views_ahead(added.curves, progress, originals)))


def with_parts(document: Document, parts: Sequence[Curve], active: int) -> AddedCurves:
    """Return the document with parts of curves in front of the active one and its shape, in its groups."""
    first, model = shape_of(document, active).stop, document.curves[active]
    alone = [replace(part, shape="", groups=model.groups) for part in parts]
    added = add_curves(document, alone, first, Container(model.groups))
    return AddedCurves(added, range(first, first + len(parts)))


def centred_at(
    added: AddedCurves, originals: Sequence[CurveView | None], position: Vector, pixel: float
) -> Document:
    """Return the document with the added curves moved so that their middle is at a position.

    The offset is rounded to a `pixel`, so that the coordinates get no invisible digits.
    """
    document, group = added.document, whole_curves(added.document, added.indices)
    views = [view or view_of(curve) for curve, view in zip(added.curves, originals, strict=True)]
    bounds = around([view.extent[1] for view in views if len(view.points)])
    if bounds is None or not all(map(math.isfinite, (*position, *bounds.centre))):
        return document
    decimals = -math.floor(math.log10(pixel))
    across, up = (round(to - at, decimals) for to, at in zip(position, bounds.centre, strict=True))
    return move_group(document, group, (across, up))
