"""Straight segments: found by their ends, and kept straight when an end goes elsewhere.

A segment is straight where the velocities in it are the same at both ends and go along its chord, with no
higher derivative: as the edits and imports that make one leave it. It is no property of its own, so that a
handle pulled out of it is all that it takes to bend it. No Qt, no arrays.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Iterator

import msgspec
from msgspec.structs import replace

from .derivatives import DERIVATIVES
from .limits import checked_vector
from .model import Curve, Point, Vector

_SAME = 1e-9
"""Share of a velocity by which the two in a segment, and its chord, may differ and be the same: what parsing
and rounding leave is 1e-12 of it, what a person drags some 1e-3."""


def ends_of(curve: Curve, segment: int) -> tuple[int, int]:
    """Return the points at which a segment begins and ends."""
    return segment, (segment + 1) % len(curve.points)


def chord_of(curve: Curve, segment: int) -> Vector:
    """Return the way from the beginning of a segment to its end."""
    p, q = (curve.points[index] for index in ends_of(curve, segment))
    return (q.x - p.x, q.y - p.y)


def velocity_in(curve: Curve, segment: int) -> Vector | None:
    """Return the velocity at both ends of a segment, within it, if it is the same; None where it is not.

    Only what belongs to this segment alone counts: of a corner, or of an end of an open curve.
    """
    start, end = ends_of(curve, segment)
    p, q, last = curve.points[start], curve.points[end], len(curve.points) - 1
    if not curve.is_closed and not 0 <= segment < last:
        return None
    if not (p.corner or (start == 0 and not curve.is_closed)):
        return None
    if not (q.corner or (end == last and not curve.is_closed)):
        return None
    (v, w), higher = _derivatives_in(p, q, 1), range(2, curve.family.derivatives + 1)
    if not v or not w or any(map(_may_bend, (each for k in higher for each in _derivatives_in(p, q, k)))):
        return None
    return v if math.dist(v, w) <= _SAME * math.hypot(*v) else None


def is_line(curve: Curve, segment: int) -> bool:
    """Whether a segment is straight, and run through at an even pace."""
    v = velocity_in(curve, segment)
    return v is not None and _goes_along(v, chord_of(curve, segment))


def line_beside(curve: Curve, index: int, *, ahead: bool) -> bool:
    """Whether the segment ahead of a point, or the one behind it, is straight."""
    segment = index if ahead else index - 1
    count = len(curve.points)
    if curve.is_closed:
        return is_line(curve, segment % count)
    return 0 <= segment < count - 1 and is_line(curve, segment)


class KeptLine(msgspec.Struct, frozen=True):
    """A straight segment that is to stay straight.

    Attributes
    ----------
    segment
        Which one.
    chord
        Its chord before an end went elsewhere.
    by_start
        Whether the speed at its start is still that along it; else the one at its end is.
    """

    segment: int
    chord: Vector
    by_start: bool


def lines_to_keep(before: Curve, after: Curve) -> list[KeptLine]:
    """Return the straight segments of `before` of which one end has gone elsewhere in `after`.

    Not those of which both velocities have been changed, too: they are bent, or mapped with their ends.
    """
    kept = []
    # Thousands of curves are mapped at once: what takes long is asked of few segments.
    for segment in _apart(before):
        chord = chord_of(before, segment)
        if chord == chord_of(after, segment):
            continue
        was, now = _ends_in(before, segment), _ends_in(after, segment)
        if (was[0] == now[0] or was[1] == now[1]) and is_line(before, segment):
            kept.append(KeptLine(segment, chord, by_start=was[0] == now[0]))
    return kept


def with_lines(curve: Curve, lines: Collection[KeptLine]) -> Curve:
    """Return a curve with these segments straight between where their ends are now."""
    points = list(curve.points)
    for each in lines:
        start, end = ends_of(curve, each.segment)
        (x, y), length = chord_of(curve, each.segment), math.hypot(*each.chord)
        ends = _derivatives_in(points[start], points[end], 1)
        speed = math.hypot(*(ends[0 if each.by_start else 1] or (0.0, 0.0)))
        along = checked_vector((x / length * speed, y / length * speed), "a derivative")
        points[start] = replace(points[start], **{_field(points[start], ahead=True): along})
        points[end] = replace(points[end], **{_field(points[end], ahead=False): along})
    return replace(curve, points=tuple(points))


def _field(point: Point, *, ahead: bool) -> str:
    return DERIVATIVES[0].after if point.corner and ahead else DERIVATIVES[0].name


def _apart(curve: Curve) -> Iterator[int]:
    """Yield the segments that have derivatives of their own at both ends: corners, ends of an open curve."""
    own = [point.corner for point in curve.points]
    if curve.is_closed:
        own += own[:1]
    elif own:
        own[0] = own[-1] = True
    return (segment for segment, (start, end) in enumerate(itertools.pairwise(own)) if start and end)


def _ends_in(curve: Curve, segment: int) -> tuple[Vector | None, Vector | None]:
    start, end = ends_of(curve, segment)
    return _derivatives_in(curve.points[start], curve.points[end], 1)


def _derivatives_in(start: Point, end: Point, order: int) -> tuple[Vector | None, Vector | None]:
    """Return the derivatives of an order that were set at the ends of a segment, within it."""
    return start.explicit_sides(order)[1], end.explicit_sides(order)[0]


def _may_bend(vector: Vector | None) -> bool:
    return vector is None or any(vector)


def _goes_along(v: Vector, chord: Vector) -> bool:
    cross, dot = v[0] * chord[1] - v[1] * chord[0], v[0] * chord[0] + v[1] * chord[1]
    return dot > 0.0 and abs(cross) <= _SAME * dot
