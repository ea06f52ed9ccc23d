"""Points deleted from curves whose velocities are set, with the shape kept as far as can be.

What lies between points that stay is the same segment as before; where points went, one segment comes in the
place of several: with their directions at its ends, and as near to them as lengths allow. Where rules
estimate everything, they do so of the points that are left.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore import CurveError
from curvecore.arrays import FloatArray

from ..document.constraints import is_straight, tie_if_parallel
from ..document.model import Curve, Document, Point, Vector, derivatives_of
from ..document.point_edits import delete_points
from .curve.curve_view import CurveView, view_of
from .fit import farthest, segment_near

SAME = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""

_UNSEEN = 1e-4
"""The same for what a rule estimates: it stays an estimate where it changes by less."""

_ROUNDS = 3
"""Times that a look is taken at what rules estimate otherwise since something was set."""

Derivatives = list[Vector]
"""Derivatives at one side of a point, by their orders from 1 on."""


def with_wanted(curve: Curve, wanted: Mapping[tuple[int, bool], Derivatives]) -> Curve:
    """Return a curve with these derivatives of points, before (False) and after (True), set where needed."""
    for _ in range(_ROUNDS if wanted else 0):
        before, curve = curve, _a_round(view_of(curve), wanted)
        if curve.points == before.points:
            break
    return curve


def _a_round(view: CurveView, wanted: Mapping[tuple[int, bool], Derivatives]) -> Curve:
    points = list(view.source.points)
    for index, point in enumerate(points):
        sides = [wanted.get((index, ahead)) for ahead in (False, True)]
        is_off = [side is not None and not _has(view, index, side, ahead) for ahead, side in enumerate(sides)]
        if any(is_off):
            points[index] = with_sides(point, *sides)
    return replace(view.source, points=tuple(points))


def _has(view: CurveView, index: int, side: Derivatives, ahead: int) -> bool:
    """Whether a point has these derivatives on a side."""
    now = [view.derivative_of(index, order, ahead=bool(ahead)) for order in range(1, len(side) + 1)]
    within = SAME if any(derivatives_of(view.source.points[index])) else _UNSEEN
    return all(own is not None and _alike(own, each, within) for own, each in zip(now, side, strict=True))


def _alike(one: Sequence[float], other: Sequence[float], within: float = SAME) -> bool:
    largest = max(map(abs, (*one, *other)))
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) <= within * largest


def with_sides(point: Point, before: Derivatives | None, after: Derivatives | None) -> Point:
    """Return a point with derivatives set on the sides where there is curve; one that was smooth still is."""
    before, after = before or after or [], after or before or []
    if not point.corner and all(map(_alike, before, after)):
        return point.with_derivatives(before, ())
    was_corner = point.corner and not point.tied
    made = replace(point.as_corner(), tied=False).with_derivatives(before, after)
    return made if was_corner else tie_if_parallel(made)


_SAMPLES = 24
"""Places along a segment that its successor comes near to."""


class Deletion(msgspec.Struct, frozen=True):
    """A curve without some of its points.

    Attributes
    ----------
    curve
        The curve.
    residual
        The largest distance of the curve before from it, where points went; None where nothing was fitted.
    """

    curve: Curve
    residual: float | None = None


class _Segment(msgspec.Struct, frozen=True):
    """A segment of the curve afterwards, by its points there, and the segments before that it stands for.

    `start` and `end` are knots of the curve before, `end` after `start`: beyond the last, around.
    """

    index: int
    begins: int
    ends: int
    start: int
    end: int

    @property
    def is_new(self) -> bool:
        """Whether it stands for several."""
        return self.end > self.start + 1


def without_points(view: CurveView, indices: Collection[int]) -> Deletion:
    """Return the curve of a view without the points `indices`."""
    plain = delete_points(Document((view.source,)), 0, indices).curves[0]
    after = view_of(plain)
    segments = list(_segments(view, plain, indices)) if _can_keep(view, after) else []
    if not any(each.is_new and _is_set(view, each) for each in segments):
        return Deletion(plain)
    try:
        made = _with_jets(view, after, segments, _fitted_jets)
    except (CurveError, np.linalg.LinAlgError):
        return Deletion(plain)
    return Deletion(made, _largest_change(view, view_of(made), segments))


def without_points_but_handles(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve of a view without the points `indices`, with the handles beside them where they are.

    The derivatives there are others, for they are per unit of t and the segment is longer. Where rules
    estimate everything there is no handle to leave.
    """
    plain = delete_points(Document((view.source,)), 0, indices).curves[0]
    after = view_of(plain)
    segments = list(_segments(view, plain, indices)) if _is_same_kind(view, after) else []
    if not any(_is_set(view, each) for each in segments):
        return plain
    return _with_jets(view, after, segments, _jets_at_ends)


_JetsOf = Callable[[CurveView, _Segment], FloatArray]
"""The jets that a segment afterwards is to have at both ends, per unit of its own length, (2, R, 2)."""


def _with_jets(view: CurveView, after: CurveView, segments: Sequence[_Segment], new_jets: _JetsOf) -> Curve:
    """Return the curve afterwards with segments as they were, and these jets where points went."""
    wanted = dict[tuple[int, bool], Derivatives]()
    powers = np.arange(view.source.family.derivatives + 1.0)[:, None]
    for each in segments:
        if each.is_new and not _is_set(view, each):
            continue
        h = float(after.parameters[each.index + 1] - after.parameters[each.index])
        jets = (new_jets if each.is_new else _jets_at_ends)(view, each) * h**-powers
        for point, ahead, jet in ((each.begins, True, jets[0]), (each.ends, False, jets[1])):
            wanted[point, ahead] = [(float(x), float(y)) for x, y in jet[1:]]
    return with_wanted(after.source, wanted)


def _largest_change(before: CurveView, after: CurveView, segments: Sequence[_Segment]) -> float:
    """Return how far a curve is from what became of it, at most, segment by segment."""
    assert before.curve is not None
    assert after.curve is not None
    same = [(each.start, each.index) for each in segments if not each.is_new]
    moved = 0.0
    if same:
        old, new = (
            np.linspace(view.parameters[which], view.parameters[which + 1], _SAMPLES + 1).ravel()
            for view, which in zip((before, after), np.array(same).T, strict=True)
        )
        moved = float(np.hypot(*(before.curve.evaluate(old) - after.curve.evaluate(new)).T).max())
    for each in segments:
        if each.is_new:
            between = after.parameters[each.index : each.index + 2]
            moved = max(moved, farthest(after.curve, _places(before, each), *between.tolist()))
    return moved


def _can_keep(view: CurveView, after: CurveView) -> bool:
    """Whether the shape of what is left can be kept: velocities can be set, and parameters scale with it."""
    source = view.source
    return _is_same_kind(view, after) and (source.is_manual or source.parametrization.exponent is not None)


def _is_same_kind(view: CurveView, after: CurveView) -> bool:
    """Whether there are velocities to be set, in a curve that is as closed as before."""
    is_as_closed = view.source.is_closed == after.source.is_closed
    return bool(view.source.family.derivatives) and view.is_current and after.is_current and is_as_closed


def _segments(view: CurveView, after: Curve, indices: Collection[int]) -> Iterator[_Segment]:
    """Yield the segments of the curve afterwards."""
    count = len(view.source.points)
    kept = [index for index in range(count) if index not in indices]
    ends = [*kept[1:], kept[0] + count] if after.is_closed else kept[1:]
    for index, (start, end) in enumerate(zip(kept, ends, strict=False)):
        yield _Segment(index, index, (index + 1) % len(kept), start, end)


def _is_set(view: CurveView, segment: _Segment) -> bool:
    """Whether something of the segments was set by hand that a segment stands for."""
    points = view.source.points
    between = [points[each % len(points)] for each in range(segment.start, segment.end + 1)]
    is_set = any(between[0].explicit_sides(1)[1:]) or any(between[-1].explicit_sides(1)[:1])
    return is_set or any(any(derivatives_of(each)) for each in between[1:-1])


def _jets_at_ends(view: CurveView, segment: _Segment) -> FloatArray:
    """Return jets by which handles are where those at both ends were before."""
    powers = np.arange(view.source.family.derivatives + 1.0)[:, None]
    count = len(view.source.points)
    start, end = _side(view, segment.start, ahead=True), _side(view, segment.end, ahead=False)
    spacings = _spacing(view, segment.start % count), _spacing(view, (segment.end - 1) % count)
    return np.stack([jet * h**powers for jet, h in zip((start, end), spacings, strict=True)])


def _fitted_jets(view: CurveView, segment: _Segment) -> FloatArray:
    """Return jets by which one segment comes as near to several as it can."""
    orders = view.source.family.derivatives + 1
    places = _places(view, segment)
    lines = [
        is_straight(view.source, each % len(view.source.points)) for each in range(segment.start, segment.end)
    ]
    if all(lines):
        jets = np.zeros((2, orders, 2))
        jets[:, 0], jets[:, 1] = places[[0, -1]], places[-1] - places[0]
        return jets
    return segment_near(view.source.family, places, _directions(view, segment, places))


def _side(view: CurveView, knot: int, *, ahead: bool) -> FloatArray:
    """Return the jet on one side of a knot of the curve before, (R, 2)."""
    assert view.sides is not None
    jet: FloatArray = view.sides[ahead][knot % len(view.source.points)]
    return jet


def _spacing(view: CurveView, segment: int) -> float:
    return float(view.parameters[segment + 1] - view.parameters[segment])


def _places(view: CurveView, segment: _Segment) -> FloatArray:
    """Return places along the segments before, as many on each, (m, 2)."""
    count, found = len(view.source.points), []
    assert view.curve is not None
    for each in range(segment.start, segment.end):
        start, end = view.parameters[each % count : each % count + 2]
        found.append(view.curve.evaluate(np.linspace(start, end, _SAMPLES + 1))[:-1])
    last = view.points[segment.end % count]
    return np.vstack([*found, last])


def _directions(view: CurveView, segment: _Segment, places: FloatArray) -> FloatArray:
    """Return the directions at the ends of some segments, (2, 2); without a handle that of the curve."""
    ways = np.array([_side(view, segment.start, ahead=True)[1], _side(view, segment.end, ahead=False)[1]])
    lengths = np.hypot(ways[:, 0], ways[:, 1])
    size = float(np.ptp(places, axis=0).max())
    chords = np.array([places[1] - places[0], places[-1] - places[-2]])
    ways = np.where((lengths > SAME * size)[:, None], ways, chords)
    directions: FloatArray = ways / np.hypot(ways[:, 0], ways[:, 1])[:, None]
    return directions
