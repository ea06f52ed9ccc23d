"""Points deleted, with the shape kept as far as handles that are set can keep it.

Estimated points stay estimated: the rules draw through the rest. Between two handles that are set, one
segment replaces several, with their directions at its ends, and as near to them as lengths allow.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore import CurveError
from curvecore.arrays import FloatArray

from ..document.constraints import is_straight, tie_if_parallel
from ..document.model import Curve, Document, Point, Vector
from ..document.point_edits import delete_points
from .curve.curve_view import CurveView, view_of
from .curve.distances import dense
from .fit import farthest, segment_near

_SAME = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""

Derivatives = list[Vector]
"""Derivatives at one side of a point, by their orders from 1 on."""


def _alike(one: Sequence[float], other: Sequence[float]) -> bool:
    largest = max(map(abs, (*one, *other)))
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) <= _SAME * largest


def with_sides(point: Point, before: Derivatives | None, after: Derivatives | None) -> Point:
    """Return a point with derivatives set on its sides with curve; a smooth point stays smooth."""
    before, after = before or after or [], after or before or []
    if not point.corner and all(map(_alike, before, after)):
        return point.with_derivatives(before, ())
    was_corner = point.corner and not point.tied
    changed = replace(point.as_corner(), tied=False, even=False).with_derivatives(before, after)
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
        The largest distance of the curve before from the new one; None where one of them is none.
    is_fitted
        Whether handles were set to keep the shape.
    """

    curve: Curve
    residual: float | None
    is_fitted: bool


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
    after, segments = view_of(plain), list[_Segment]()
    if _can_keep(view, after):
        segments = [
            each for each in _segments(view, plain, indices) if each.is_new and all(_set_at(view, each))
        ]
    try:
        curve = _with_jets(view, after, segments, _fitted_jets)
    except (CurveError, np.linalg.LinAlgError):
        curve, segments = plain, []
    is_both = view.is_current and after.is_current
    residual = _largest_change(view, view_of(curve), indices) if is_both else None
    return Deletion(curve, residual, bool(segments))


def without_points_keeping_handles(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve of a view without the points `indices`, with the handles that are set unchanged.

    The derivatives there change, for they are per unit of t and the segment is longer.
    """
    plain = delete_points(Document((view.source,)), 0, indices).curves[0]
    after = view_of(plain)
    segments = list(_segments(view, plain, indices)) if _is_same_kind(view, after) else []
    return _with_jets(view, after, segments, _jets_at_ends)


_JetsOf = Callable[[CurveView, _Segment], FloatArray]
"""A function to the jets of a new segment at both ends, per unit of its own length, (2, R, 2)."""


def _with_jets(view: CurveView, after: CurveView, segments: Sequence[_Segment], new_jets: _JetsOf) -> Curve:
    """Return the new curve with these jets at the ends of segments, where they are set."""
    wanted, sides = dict[tuple[int, bool], Derivatives](), after.sides
    powers = np.arange(view.source.family.derivatives + 1.0)[:, None]
    for segment in segments:
        h = float(after.parameters[segment.index + 1] - after.parameters[segment.index])
        jets = new_jets(view, segment) * h**-powers
        ends = (segment.begins, True), (segment.ends, False)
        for end, jet, is_set in zip(ends, jets, _set_at(view, segment), strict=True):
            if is_set:
                wanted[end] = [(float(x), float(y)) for x, y in jet[1:]]
    points = list(after.source.points)
    for index in {index for index, _ in wanted}:
        for ahead in (False, True):
            if sides is not None and after.spacing(index, ahead=ahead) is not None:
                wanted.setdefault((index, ahead), [(float(x), float(y)) for x, y in sides[ahead][index, 1:]])
        points[index] = with_sides(points[index], wanted.get((index, False)), wanted.get((index, True)))
    return replace(after.source, points=tuple(points))


def _largest_change(before: CurveView, after: CurveView, indices: Collection[int]) -> float:
    """Return the largest distance of a curve from that without the points `indices`, between those left."""
    knots, count = before.parameters, len(before.source.points)
    (first, last), left = before.present_curve.domain, [i for i in range(count) if i not in indices]
    if after.source.is_closed:
        knots, left = np.append(knots[:-1], knots + (last - first)), [*left, left[0] + count]
    t = dense(knots[left[0] : left[-1] + 1])
    positions = before.present_curve.evaluate(np.where(t > last, t - (last - first), t))
    return farthest(after.present_curve, positions, np.interp(t, knots[left], after.parameters))


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


def _set_at(view: CurveView, segment: _Segment) -> tuple[bool, bool]:
    """Return whether the handles at the start and at the end of a segment, in the old curve, are set."""
    points = view.source.points
    start, end = points[segment.start % len(points)], points[segment.end % len(points)]
    return start.explicit_sides(1)[1] is not None, end.explicit_sides(1)[0] is not None


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
    handles = np.where((lengths > _SAME * size)[:, None], handles, chords)
    return np.asarray(handles / np.hypot(handles[:, 0], handles[:, 1])[:, None])
