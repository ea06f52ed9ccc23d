"""Points deleted from curves whose velocities are set, with the shape kept as far as possible.

Segments between points that stay do not change; where points were deleted, one segment replaces several: with
their directions at its ends, and as near to them as lengths allow. Where rules estimate all derivatives, they
estimate those of the remaining points.
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
"""The same for estimates: a derivative stays an estimate where it changes by less."""

Derivatives = list[Vector]
"""Derivatives at one side of a point, by their orders from 1 on."""


Wanted = Mapping[tuple[int, bool], Derivatives]
"""Derivatives of points, before (False) and after (True) each, that a curve shall have."""


def with_wanted(curve: Curve, wanted: Wanted, first: Collection[int]) -> Curve:
    """Return a curve with these derivatives, set where needed.

    Points that are set already, and those of `first`, hold the estimates beyond them where a spline
    estimates; of others, the nearest come next.
    """
    done = set[int]()
    while off := [index for index in _off(view_of(curve), wanted) if index not in done]:
        points, count = list(curve.points), len(curve.points)
        is_set = [any(derivatives_of(point)) for point in points]
        now = [index for index in off if is_set[index] or index in first]
        now = now or [index for index in off if is_set[index - 1] or is_set[(index + 1) % count]] or off
        for index in now:
            points[index] = with_sides(points[index], wanted.get((index, False)), wanted.get((index, True)))
        curve, done = replace(curve, points=tuple(points)), done | set(now)
    return curve


def _off(view: CurveView, wanted: Wanted) -> list[int]:
    """Return the points that do not have the wanted derivatives, in order."""
    return sorted({key[0] for key, side in wanted.items() if not _has(view, *key, side)})


def _has(view: CurveView, index: int, ahead: bool, side: Derivatives) -> bool:
    """Whether a point has these derivatives on a side."""
    now = [view.derivative_of(index, order, ahead=ahead) for order in range(1, len(side) + 1)]
    within = SAME if any(derivatives_of(view.source.points[index])) else _UNSEEN
    return all(value is not None and _alike(value, aim, within) for value, aim in zip(now, side, strict=True))


def _alike(one: Sequence[float], other: Sequence[float], within: float = SAME) -> bool:
    largest = max(map(abs, (*one, *other)))
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) <= within * largest


def with_sides(point: Point, before: Derivatives | None, after: Derivatives | None) -> Point:
    """Return a point with derivatives set on its sides with curve; a smooth point stays smooth."""
    before, after = before or after or [], after or before or []
    if not point.corner and all(map(_alike, before, after)):
        return point.with_derivatives(before, ())
    was_corner = point.corner and not point.tied
    changed = replace(point.as_corner(), tied=False).with_derivatives(before, after)
    return changed if was_corner else tie_if_parallel(changed)


# Points deleted

_SAMPLES = 24
"""Samples of a segment that the new one is fitted to."""


class Deletion(msgspec.Struct, frozen=True):
    """A curve without some of its points.

    Attributes
    ----------
    curve
        The curve.
    residual
        The largest distance of the curve before from the new segments; None where nothing was fitted.
    """

    curve: Curve
    residual: float | None = None


class _Segment(msgspec.Struct, frozen=True):
    """A segment of the new curve, by its points, and the segments of the old curve that it replaces.

    `start` and `end` are knots of the old curve, `end` after `start`: on a closed curve beyond the last.
    """

    index: int
    begins: int
    ends: int
    start: int
    end: int

    @property
    def is_new(self) -> bool:
        """Whether the new segment replaces several."""
        return self.end > self.start + 1


def without_points(view: CurveView, indices: Collection[int]) -> Deletion:
    """Return the curve of a view without the points `indices`."""
    plain = delete_points(Document((view.source,)), 0, indices).curves[0]
    after = view_of(plain)
    segments = list(_segments(view, plain, indices)) if _can_keep(view, after) else []
    if not any(segment.is_new and _is_set(view, segment) for segment in segments):
        return Deletion(plain)
    try:
        fitted = _with_jets(view, after, segments, _fitted_jets)
    except (CurveError, np.linalg.LinAlgError):
        return Deletion(plain)
    return Deletion(fitted, _largest_change(view, view_of(fitted), segments))


def without_points_keeping_handles(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve of a view without the points `indices`, with the handles beside them unchanged.

    The derivatives there change, for they are per unit of t and the segment is longer. Where rules estimate
    all derivatives there is no handle to keep.
    """
    plain = delete_points(Document((view.source,)), 0, indices).curves[0]
    after = view_of(plain)
    segments = list(_segments(view, plain, indices)) if _is_same_kind(view, after) else []
    if not any(_is_set(view, segment) for segment in segments):
        return plain
    return _with_jets(view, after, segments, _jets_at_ends)


_JetsOf = Callable[[CurveView, _Segment], FloatArray]
"""A function to the jets of a new segment at both ends, per unit of its own length, (2, R, 2)."""


def _with_jets(view: CurveView, after: CurveView, segments: Sequence[_Segment], new_jets: _JetsOf) -> Curve:
    """Return the new curve with unchanged segments as they were, and these jets at the ends of new ones."""
    wanted = dict[tuple[int, bool], Derivatives]()
    powers = np.arange(view.source.family.derivatives + 1.0)[:, None]
    for segment in segments:
        if segment.is_new and not _is_set(view, segment):
            continue
        h = float(after.parameters[segment.index + 1] - after.parameters[segment.index])
        jets = (new_jets if segment.is_new else _jets_at_ends)(view, segment) * h**-powers
        for point, ahead, jet in ((segment.begins, True, jets[0]), (segment.ends, False, jets[1])):
            wanted[point, ahead] = [(float(x), float(y)) for x, y in jet[1:]]
    ends = {
        point
        for segment in segments
        if segment.is_new and _is_set(view, segment)
        for point in (segment.begins, segment.ends)
    }
    return with_wanted(after.source, wanted, ends)


def _largest_change(before: CurveView, after: CurveView, segments: Sequence[_Segment]) -> float:
    """Return the largest distance of two curves, segment by segment."""
    same = [(segment.start, segment.index) for segment in segments if not segment.is_new]
    moved = 0.0
    if same:
        old, new = (
            np.linspace(view.parameters[which], view.parameters[which + 1], _SAMPLES + 1).ravel()
            for view, which in zip((before, after), np.array(same).T, strict=True)
        )
        away = before.present_curve.evaluate(old) - after.present_curve.evaluate(new)
        moved = float(np.hypot(*away.T).max())
    for segment in segments:
        if segment.is_new:
            between = after.parameters[segment.index : segment.index + 2]
            samples = _samples_along(before, segment)
            moved = max(moved, farthest(after.present_curve, samples, *between.tolist()))
    return moved


def _can_keep(view: CurveView, after: CurveView) -> bool:
    """Whether the shape of the rest can be kept: velocities can be set, and parameters scale with it."""
    source = view.source
    return _is_same_kind(view, after) and (source.is_manual or source.parametrization.exponent is not None)


def _is_same_kind(view: CurveView, after: CurveView) -> bool:
    """Whether velocities can be set, in a curve that is closed if it was closed before."""
    is_as_closed = view.source.is_closed == after.source.is_closed
    return bool(view.source.family.derivatives) and view.is_current and after.is_current and is_as_closed


def _segments(view: CurveView, after: Curve, indices: Collection[int]) -> Iterator[_Segment]:
    """Yield the segments of the new curve."""
    count = len(view.source.points)
    remaining = [index for index in range(count) if index not in indices]
    ends = [*remaining[1:], remaining[0] + count] if after.is_closed else remaining[1:]
    for index, (start, end) in enumerate(zip(remaining, ends, strict=False)):
        yield _Segment(index, index, (index + 1) % len(remaining), start, end)


def _is_set(view: CurveView, segment: _Segment) -> bool:
    """Whether any derivative in the segments that a new one replaces was set by hand."""
    points = view.source.points
    between = [points[index % len(points)] for index in range(segment.start, segment.end + 1)]
    is_set = any(between[0].explicit_sides(1)[1:]) or any(between[-1].explicit_sides(1)[:1])
    return is_set or any(any(derivatives_of(index)) for index in between[1:-1])


def _jets_at_ends(view: CurveView, segment: _Segment) -> FloatArray:
    """Return jets with the handles that the old curve has at both ends."""
    powers = np.arange(view.source.family.derivatives + 1.0)[:, None]
    count = len(view.source.points)
    start, end = _side(view, segment.start, ahead=True), _side(view, segment.end, ahead=False)
    spacings = _spacing(view, segment.start % count), _spacing(view, (segment.end - 1) % count)
    return np.stack([jet * h**powers for jet, h in zip((start, end), spacings, strict=True)])


def _fitted_jets(view: CurveView, segment: _Segment) -> FloatArray:
    """Return the jets of the segment that is nearest to several."""
    orders = view.source.family.derivatives + 1
    samples = _samples_along(view, segment)
    count = len(view.source.points)
    if all(is_straight(view.source, knot % count) for knot in range(segment.start, segment.end)):
        jets = np.zeros((2, orders, 2))
        jets[:, 0], jets[:, 1] = samples[[0, -1]], samples[-1] - samples[0]
        return jets
    return segment_near(view.source.family, samples, _directions(view, segment, samples))


def _side(view: CurveView, knot: int, *, ahead: bool) -> FloatArray:
    """Return the jet on one side of a knot of the old curve, (R, 2)."""
    assert view.sides is not None
    return np.asarray(view.sides[ahead][knot % len(view.source.points)])


def _spacing(view: CurveView, segment: int) -> float:
    return float(view.parameters[segment + 1] - view.parameters[segment])


def _samples_along(view: CurveView, segment: _Segment) -> FloatArray:
    """Return samples along the old segments, as many on each, (m, 2)."""
    count, samples = len(view.source.points), []
    for index in range(segment.start, segment.end):
        start, end = view.parameters[index % count : index % count + 2]
        samples.append(view.present_curve.evaluate(np.linspace(start, end, _SAMPLES + 1))[:-1])
    return np.vstack([*samples, view.points[segment.end % count]])


def _directions(view: CurveView, segment: _Segment, samples: FloatArray) -> FloatArray:
    """Return the directions at the ends of the old segments, (2, 2); without a handle that of the curve."""
    handles = np.array([_side(view, segment.start, ahead=True)[1], _side(view, segment.end, ahead=False)[1]])
    lengths = np.hypot(handles[:, 0], handles[:, 1])
    size = float(np.ptp(samples, axis=0).max())
    chords = np.array([samples[1] - samples[0], samples[-1] - samples[-2]])
    handles = np.where((lengths > SAME * size)[:, None], handles, chords)
    return np.asarray(handles / np.hypot(handles[:, 0], handles[:, 1])[:, None])
