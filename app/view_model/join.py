"""Several curves made one, end to start or by selected ends, with their shapes kept; a part redrawn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.constraints import PARALLEL, tie_if_parallel
from ..document.curve_edits import set_closed
from ..document.derivatives import DERIVATIVES
from ..document.limits import EditError
from ..document.model import Curve, Document, Point, Vector
from ..document.point_edits import set_position
from ..document.point_group import PointGroup
from ..document.words import number
from ..families import titles_with_derivatives
from ..tasks.progress import Report, silent
from .curve.core_curve import Sides
from .curve.curve_view import CurveView, view_of
from .curve.distances import dense, keeps_shape, largest_distance
from .fit import Fitted, core_fit, points_of_fit
from .geometry import polygon_length, size_of, unit_tangents
from .point_kinds import with_straight_segments
from .reshape import Reshaped, frozen, refuse_without_curve, reversed_curve, with_jets, with_sides_kept
from .split import beginning, part_of, split

MOST_JOINED = 1000
"""Curves that are joined at once: the distances of all of their ends are compared."""

_COINCIDE = 1e-9
"""Distance, relative to the size of two curves, up to which end and start are one point."""


class Joined(Reshaped, frozen=True):
    """One curve made of several, or closed.

    Attributes
    ----------
    seams
        The points at which they meet; both ends of a segment that connects two of them.
    ends
        Which ends of two curves are joined, such as "end to start"; empty for more.
    """

    seams: frozenset[int] = frozenset()
    ends: str = ""

    @property
    def outcome(self) -> str:
        """The outcome for the shapes, to follow a colon."""
        shapes = "shapes kept" if keeps_shape(self.residual, (self.curve,)) else "shapes changed"
        return f"{shapes}, largest change {number(self.residual, 2)}"


# End to start


def joined(*views: CurveView, model: int = 0, is_closed: bool = False) -> Joined:
    """Join the end of each curve to the start of the next: one curve, its parameters one after the other.

    All keep their shapes, and estimated points stay estimated unless their estimates would change. Where end
    and start coincide they become one point, a corner if the derivatives there differ; else a straight
    segment connects them, at the mean of the speeds on both sides, or a smooth one where the family has no
    derivatives to make corners with.

    Parameters
    ----------
    model
        The index of the curve that lends its name, its style and its rules.
    is_closed
        Whether the end of the last is joined to the start of the first.

    Raises
    ------
    EditError
        If there is no curve to join, or they cannot be one curve of a family.
    """
    for pair in pairwise((*views, views[0])):
        _refuse_to_join(*pair)
    waits = [_wait_between(*pair) for pair in pairwise((*views, *views[: int(is_closed)]))]
    shifts = _shifts(views, waits)
    wholes = [frozen(view) for view in views]
    parts, inner = [], len(views) - 1
    for k, whole in enumerate(wholes):
        parts.append(_with_ends_set(whole, start=is_closed or k > 0, end=is_closed or k < inner))
    points, seams = _one_after_the_other(parts, shifts, waits)
    last = points[-1].t or 0.0
    if is_closed:
        last += waits[-1]
        seams.add(0)
        points, seams = _met(points, waits[-1]), seams | ({len(points) - 1} if waits[-1] else set())
    if any(not (y.t or 0.0) > (x.t or 0.0) for x, y in pairwise(points)):
        raise EditError("The parameters of the second curve are too close together to follow the first.")
    curve = part_of(parts[model], points, last, parts[model].name)
    if is_closed:
        curve = set_closed(Document((curve,)), 0, closed=True).curves[0]
    curve = _with_same_jets(wholes, waits, curve)
    if curve.family.derivatives and (lines := [*_bridges(parts, waits)]):
        curve = with_straight_segments(view_of(curve), lines, PARALLEL)
    residual = _residual_of(views, view_of(curve), shifts)
    _refuse_another_shape(views, residual)
    return Joined(curve, residual, seams=frozenset(seams))


def _with_ends_set(view: CurveView, *, start: bool, end: bool) -> Curve:
    """Return an open curve with the derivatives at its start, or end, set."""
    points = list(view.source.points)
    for index, is_set in ((0, start), (len(points) - 1, end)):
        if view.sides is not None and is_set:
            points[index] = with_jets(points[index], view.sides, index)
    return replace(view.source, points=tuple(points))


def _with_same_jets(views: Sequence[CurveView], waits: Sequence[float], curve: Curve) -> Curve:
    """Return the joined curve with those estimates set that would change."""
    jets = [view.sides for view in views if view.sides is not None]
    if not jets:
        return curve
    was = Sides(*map(np.vstack, zip(*jets, strict=True)))
    # Where two curves meet, the start of the second is left out, and where a curve closes, its end.
    starts = np.cumsum([len(side) for side, _ in jets])[: len(waits)]
    merged = starts[np.array(waits) == 0.0].clip(max=len(was.before) - 1)
    rows = np.delete(np.arange(len(was.before)), merged)
    return with_sides_kept(was, curve, rows, np.arange(len(rows)))


def _shifts(views: Sequence[CurveView], waits: Sequence[float]) -> list[float]:
    """Return the shifts of the parameters that put each curve after the one before."""
    steps = (
        float(before.parameters[-1]) + wait - float(after.parameters[0])
        for (before, after), wait in zip(pairwise(views), waits, strict=False)
    )
    return list(accumulate(steps, initial=0.0))


def _wait_between(first: CurveView, second: CurveView) -> float:
    """Return the time from the end of a curve to the start of another; 0 where they are one point."""
    if _meet(first, second):
        return 0.0
    return math.dist(first.points[-1], second.points[0]) / _speed_at_seam(first, second)


def _meet(first: CurveView, second: CurveView) -> bool:
    """Whether the end of a curve is the start of another."""
    size = max(size_of(np.vstack([first.points, second.points])), 1e-300)
    return math.dist(first.points[-1], second.points[0]) <= _COINCIDE * size


def _one_after_the_other(
    parts: Sequence[Curve], shifts: Sequence[float], waits: Sequence[float]
) -> tuple[list[Point], set[int]]:
    """Return the points of curves with their parameters shifted, and the indices where the curves meet."""
    points, seams = list(parts[0].points), set[int]()
    for part, shift, wait in zip(parts[1:], shifts[1:], waits, strict=False):
        later = [replace(point, t=(point.t or 0.0) + shift) for point in part.points]
        seams |= {len(points) - 1, len(points)} if wait else {len(points) - 1}
        ending, start = points.pop().without_corner(), beginning(later[0])
        points += [ending, start] if wait else [_merged(ending, start)]
        points += later[1:]
    return points, seams


def _bridges(parts: Sequence[Curve], waits: Sequence[float]) -> Iterator[int]:
    """Yield the segments that connect one curve to the next."""
    last = -1
    for part, wait in zip(parts, waits, strict=False):
        last += len(part.points)
        if wait:
            yield last
        else:
            last -= 1


def _met(points: Sequence[Point], wait: float) -> list[Point]:
    """Return the points of a curve whose end continues at its start."""
    ending, start = points[-1].without_corner(), beginning(points[0])
    if wait:
        return [start, *points[1:-1], ending]
    return [replace(_merged(ending, start), t=start.t), *points[1:-1]]


def _refuse_to_join(first: CurveView, second: CurveView) -> None:
    for view in (first, second):
        if not view.is_current:
            raise EditError(f"“{view.source.name}” cannot be joined. {view.problem}")
        if view.source.is_closed:
            raise EditError(f"“{view.source.name}” is closed and has no ends. Open it first.")
    one, other = first.source.family, second.source.family
    if one.curve_class.is_one_polynomial or other.curve_class.is_one_polynomial:
        raise EditError(f"Two polynomials cannot be joined; choose {titles_with_derivatives()} for both.")
    if one != other:
        first_kind, second_kind = (member.full_title.partition(" ")[0] for member in (one, other))
        raise EditError(f"One curve is {first_kind}, the other {second_kind}; choose one family for both.")


def _speed_at_seam(first: CurveView, second: CurveView) -> float:
    """Return the speed of the segment from one curve to the other, positive."""
    velocities = [
        first.present_curve.evaluate(first.present_curve.domain[1], 1),
        second.present_curve.evaluate(second.present_curve.domain[0], 1),
    ]
    speeds = np.hypot(*np.array(velocities).T)
    mean = float(speeds.mean())
    if mean > 0:
        return mean
    chord = polygon_length(first.points)
    return max(chord, 1e-300) / float(first.parameters[-1] - first.parameters[0])


def _merged(end: Point, start: Point) -> Point:
    """Return the point where a curve ends and another starts: smooth where their directions agree.

    It is a corner where they differ, and an ordinary point where all derivatives agree.
    """
    names = [derivative.name for derivative in DERIVATIVES]
    before, after = ([getattr(point, name) for name in names] for point in (end, start))
    if all(map(_alike, before, after)):
        return end
    point = end.as_corner().with_derivatives(before, after)
    # A retracted handle has no direction.
    return tie_if_parallel(point) if any(before[0]) and any(after[0]) else point


def _alike(x: Vector | None, y: Vector | None) -> bool:
    if x is None or y is None:
        return x is y
    scale = max(*map(abs, x), *map(abs, y))
    return max(abs(x[0] - y[0]), abs(x[1] - y[1])) <= 1e-12 * scale


def _residual_of(views: Sequence[CurveView], whole: CurveView, shifts: Sequence[float]) -> float:
    refuse_without_curve(whole)
    residual = 0.0
    for view, by in zip(views, shifts, strict=True):
        t = dense(view.parameters)
        residual = max(residual, largest_distance(view, t, whole, t + by))
    return residual


def _refuse_another_shape(views: Sequence[CurveView], residual: float) -> None:
    if keeps_shape(residual, [view.source for view in views]):
        return
    family = views[0].source.family
    other = f"Choose {titles_with_derivatives()} for both."
    if not family.interpolates:
        other = f"Convert both to {titles_with_derivatives()} first, keeping the shape."
    raise EditError(
        f"Two {family.title} curves cannot be joined: the result would be off by up to "
        f"{number(residual, 2)}. {other}"
    )


# By chosen ends


class End(NamedTuple):
    """The first or the last point of an open curve of the document."""

    curve: int
    is_last: bool

    @property
    def side(self) -> str:
        """The words "start" or "end"."""
        return "end" if self.is_last else "start"

    @property
    def other(self) -> End:
        """The other end of the curve."""
        return End(self.curve, not self.is_last)


Link = tuple[End, End]
"""Two ends that become one point, or that a segment connects."""


def link_of(views: Sequence[CurveView], group: PointGroup) -> Link | None:
    """Return the two ends of open curves that a group consists of, None for any other group."""
    ends = []
    for curve, indices in group.parts if group.count == 2 else ():
        last = len(views[curve].points) - 1
        if views[curve].source.is_closed or not indices <= {0, last}:
            return None
        ends += [End(curve, index == last) for index in sorted(indices)]
    return (ends[0], ends[1]) if ends else None


def end_of(views: Sequence[CurveView], group: PointGroup) -> End | None:
    """Return the end of an open curve that is the only point of a group, None for any other group."""
    curve, index = group.only_point or (-1, -1)
    if curve < 0 or views[curve].source.is_closed or index not in (0, len(views[curve].points) - 1):
        return None
    return End(curve, index > 0)


def position_of(views: Sequence[CurveView], end: End) -> FloatArray:
    """Return the position of an end, (2,)."""
    return np.asarray(views[end.curve].points[-1 if end.is_last else 0])


def nearest_links(views: Sequence[CurveView], curves: Sequence[int], first: End | None = None) -> list[Link]:
    """Return the links that make one curve of several, that of the end `first` and then the nearest ends.

    Raises
    ------
    EditError
        If there are too many.
    """
    if len(curves) > MOST_JOINED:
        raise EditError(f"At most {MOST_JOINED} curves can be joined at once.")
    ends = [End(curve, is_last) for curve in curves for is_last in (False, True)]
    positions = np.array([position_of(views, end) for end in ends])
    one, other = np.triu_indices(len(ends), 1)
    first_index = ends.index(first) if first in ends else -1
    is_later = (one != first_index) & (other != first_index)
    nearest = np.lexsort((np.hypot(*(positions[one] - positions[other]).T), is_later))
    links, free = list[Link](), {end: end.other for end in ends}
    for a, b in zip(one[nearest].tolist(), other[nearest].tolist(), strict=True):
        # The two free ends of a chain refer to each other, so that it does not close.
        if ends[a] in free and ends[b] in free and free[ends[a]] != ends[b]:
            links.append((ends[a], ends[b]))
            far, further = free.pop(ends[a]), free.pop(ends[b])
            free[far], free[further] = further, far
            if len(links) == len(curves) - 1:
                break
    return links


def joined_by(
    views: Sequence[CurveView], links: Sequence[Link], model: int, *, is_ring: bool = False
) -> Joined:
    """Join curves by their ends; `model` lends its direction, its name, its style and its rules.

    Two ends of one curve close it; with `is_ring` the remaining ends are joined where they meet.

    Raises
    ------
    EditError
        As `joined`.
    """
    if len({end.curve for link in links for end in link}) == 1:
        return joined(views[model], is_closed=True)
    partners = {end: partner for a, b in links for end, partner in ((a, b), (b, a))}
    before, after = (list(_beyond(End(model, is_last), partners)) for is_last in (False, True))
    turned = [*((end, not end.is_last) for end in reversed(before)), (End(model, is_last=False), False)]
    turned += [(end, end.is_last) for end in after]
    runs = [_turned(views[end.curve]) if is_turned else (views[end.curve], 0.0) for end, is_turned in turned]
    chain = [view for view, _ in runs]
    whole = joined(*chain, model=len(before), is_closed=is_ring and _meet(chain[-1], chain[0]))
    residual = max(whole.residual, *(residual for _, residual in runs))
    _refuse_another_shape(chain, residual)
    words = ""
    if len(links) == 1:
        one, other = sorted(links[0], key=lambda end: end.curve != model)
        words = f"{one.side} to {other.side}"
    return replace(whole, residual=residual, ends=words)


def joined_by_pen(document: Document, curve: int, end: End) -> Joined:
    """Join a curve of a document whose last point lies at an end of another one, which keeps its shape.

    The other curve is reversed where that is its last point. A family without derivatives that cannot keep
    the shapes, such as one polynomial, joins them by its rule.

    Raises
    ------
    EditError
        As `joined`, for two families, or one with derivatives.
    """
    one, other = (view_of(document.curves[index]) for index in (curve, end.curve))
    if end.is_last:
        other, _ = _turned(other)
    family = one.source.family
    try:
        return joined(one, other)
    except EditError:
        if family != other.source.family or family.derivatives or not family.interpolates:
            raise
        return _joined_by_rule(one, other)


def _joined_by_rule(one: CurveView, other: CurveView) -> Joined:
    """Return one curve through the points of two that meet, whose shapes its rule changes."""
    seam, shift = len(one.points) - 1, float(one.parameters[-1] - other.parameters[0])
    later = [
        replace(point, t=t + shift if one.source.is_manual else None)
        for point, t in zip(other.source.points, other.parameters.tolist(), strict=True)
    ]
    curve = replace(one.source, points=(*one.source.points, *later[1:]))
    whole = view_of(curve)
    refuse_without_curve(whole)
    pieces = (one, whole.parameters[: seam + 1]), (other, whole.parameters[seam:])
    residual = max(largest_distance(view, dense(view.parameters), whole, dense(t)) for view, t in pieces)
    return Joined(curve, residual, seams=frozenset({seam}))


def brought_together(views: Sequence[CurveView], link: Link) -> tuple[list[CurveView], float]:
    """Return the views of all curves with two ends moved to the middle between them, and the distance.

    Handles move with the ends.
    """
    met = list(views)
    one, other = (views[end.curve].source.points[-1 if end.is_last else 0].position for end in link)
    middle = ((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)
    for end in link:
        curve = met[end.curve].source
        index = len(curve.points) - 1 if end.is_last else 0
        met[end.curve] = view_of(set_position(Document((curve,)), 0, index, middle).curves[0])
    return met, math.dist(one, other) / 2


def _beyond(end: End, partners: Mapping[End, End]) -> Iterator[End]:
    """Yield the ends at which the following curves begin, one after the other."""
    while (partner := partners.get(end)) is not None:
        yield partner
        end = partner.other


def _turned(view: CurveView) -> tuple[CurveView, float]:
    refuse_without_curve(view)
    result = reversed_curve(view)
    return view_of(result.curve), result.residual


# A part of a curve replaced by a stroke

_SMOOTH = math.cos(math.radians(30.0))
"""Cosine of the angle to the curve up to which a stroke goes on smoothly; beyond it makes a corner."""

_FASTER = 1.5
"""Times the mean speed that a stroke may have at its ends: one speed there is that of the curve."""

_SHARES = np.linspace(0.0, 1.0, 65)


class Stretch(NamedTuple):
    """A part of a curve, or a missing part at an end of it.

    Attributes
    ----------
    start, end
        Its parameters in the direction of the curve; None where the curve is to go on beyond that end. The
        end comes before the start where the part leads over the end of a closed curve, or closes an open one.
    is_against
        Whether the stroke for it begins at its end.
    title, done
        The name of the change in the history, and the words of its message.
    """

    start: float | None
    end: float | None
    is_against: bool
    title: str = "Redraw part"
    done: str = "Part redrawn"

    def positions(self, view: CurveView) -> FloatArray:
        """Return positions along the part, (m, 2); none where there is nothing of the curve yet."""
        first, last = view.present_curve.domain
        if self.start is None or self.end is None or (self.start > self.end and not view.source.is_closed):
            return np.empty((0, 2))
        t = self.start + _SHARES * (self.end - self.start + (last - first) * (self.end < self.start))
        return view.present_curve.evaluate(np.where(t > last, t - (last - first), t))


def stretch_along(
    view: CurveView, stroke: Sequence[Vector], begin: float, end: float | None
) -> Stretch | None:
    """Return the part of a curve that a stroke between two parameters is for; None if it is for none.

    Of a closed curve it is the part nearer to the stroke: position by position at equal shares of both
    lengths. From an end of an open curve the stroke goes on, without another parameter; between its ends
    it closes the curve.
    """
    (first, last), source = view.present_curve.domain, view.source
    if source.is_closed:
        if end is None or end == begin:
            return None
        both = (Stretch(begin, end, is_against=False), Stretch(end, begin, is_against=True))
        return min(both, key=lambda part: _distance(part.positions(view)[:: 1 - 2 * part.is_against], stroke))
    if end is None:
        ends = {last: (last, None), first: (None, first)}
        return (
            Stretch(*ends[begin], begin == first, "Extend curve", "Curve extended") if begin in ends else None
        )
    if end == begin:
        return None
    if {begin, end} == {first, last}:
        can_close = source.family.curve_class.can_close
        return Stretch(last, first, begin == first, "Close curve", "Curve closed") if can_close else None
    return Stretch(min(begin, end), max(begin, end), begin > end)


def _distance(positions: FloatArray, stroke: Sequence[Vector]) -> float:
    """Return the mean distance of two lines at equal shares of their lengths."""
    one, other = (_at_shares(np.asarray(line)) for line in (positions, stroke))
    return float(np.hypot(*(one - other).T).mean())


def _at_shares(line: FloatArray) -> FloatArray:
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    return np.column_stack([np.interp(_SHARES * along[-1], along, column) for column in line.T])


def redrawn(
    view: CurveView,
    stretch: Stretch,
    stroke: Sequence[Vector],
    *,
    tolerance: float,
    reach: float,
    report: Report = silent,
) -> Fitted:
    """Return the curve with a stroke in the place of a part of it; the rest keeps its shape.

    It is smooth where the stroke goes on in the direction of the curve, as far as `reach` shows, and has a
    corner where it does not. The parameters become manual.

    Raises
    ------
    EditError
        If there is no such curve.
    """
    source, (before, after) = view.source, _parts_beside(view, stretch)
    line = np.array(stroke[::-1] if stretch.is_against else stroke)
    for which, t in ((0, stretch.start), (-1, stretch.end)):
        line[which] = line[which] if t is None else view.present_curve.evaluate(t)
    velocities = _end_velocity(before, -1), _end_velocity(after, 0)
    speed = float(np.mean([np.hypot(*velocity) for velocity in velocities if velocity is not None])) or 1.0
    first, last = (
        None if velocity is None else _going_on(velocity / speed, line, which, reach)
        for which, velocity in zip((0, -1), velocities, strict=True)
    )
    fit = core_fit(source, line, None, tolerance, None, report, is_closed=False, end_directions=(first, last))
    t, held = (0.0, first) if first is not None else (1.0, last)
    duration = float(np.hypot(*fit.curve.evaluate(t, 1)) / (1.0 if held is None else np.hypot(*held))) / speed
    points = points_of_fit(fit.curve, (0.0, duration), is_closed=False)
    part = view_of(part_of(source, points, duration, source.name))
    parts = [view for view in (before, part, after) if view is not None]
    is_closed = before is not None and before is after
    whole = joined(*parts[: 2 if is_closed else 3], model=int(before is None), is_closed=is_closed)
    curve = _from_first(view, replace(whole.curve, name=source.name))
    x, y = line[fit.worst].tolist()
    return Fitted(curve, fit.curve, fit.deviation, fit.root_mean_square, (x, y), fit.is_scattered)


def _parts_beside(view: CurveView, stretch: Stretch) -> tuple[CurveView | None, CurveView | None]:
    """Return the parts of a curve before and after a stretch, None for none; the same one around it."""
    (first, last), (start, end, *_) = view.present_curve.domain, stretch
    if view.source.is_closed:
        assert start is not None
        assert end is not None
        parts = [*map(view_of, split(view, start, end).curves)]
        rest = parts[1] if start < end else parts[0]
        return rest, rest
    if start is None or end is None or start > end:
        return (None if start is None else view), (None if end is None else view)
    parts = [*map(view_of, split(view, *(t for t in (start, end) if first < t < last)).curves)]
    return (parts[0] if start > first else None), (parts[-1] if end < last else None)


def _end_velocity(part: CurveView | None, which: int) -> FloatArray | None:
    """Return the velocity at the end (-1) or the start (0) of a curve; None without one."""
    return None if part is None or part.curve is None else part.curve.evaluate(part.curve.domain[which], 1)


def _going_on(velocity: FloatArray, line: FloatArray, which: int, reach: float) -> FloatArray | None:
    """Return a velocity, neither short nor long, where a line begins (0) or ends (-1) along it; else None."""
    offsets = (line - line[0] if which == 0 else line[-1] - line)[:: 1 + 2 * which]
    far = np.hypot(*offsets.T) >= reach
    along, towards = unit_tangents(np.array([velocity, offsets[int(np.argmax(far)) if far.any() else -1]]))
    length = min(max(float(np.hypot(*velocity)), 1.0 / _FASTER), _FASTER)
    return length * along if float(towards @ along) >= _SMOOTH else None


def _from_first(view: CurveView, curve: Curve) -> Curve:
    """Return a closed curve from where the old one began, if that point is left; any other as it is."""
    first, rule = view.source.points[0].position, curve.parametrization
    positions = [point.position for point in curve.points]
    if not curve.is_closed or first not in positions:
        return curve
    at, (start, _), period = positions.index(first), view.source.interval, rule.end - rule.start
    shift = start - (curve.points[at].t or 0.0)
    later = [replace(point, t=(point.t or 0.0) + shift) for point in curve.points[at:]]
    earlier = [replace(point, t=(point.t or 0.0) + shift + period) for point in curve.points[:at]]
    rule = replace(rule, start=start, end=start + period)
    return replace(curve, points=(*later, *earlier), parametrization=rule)
