"""Constraints on derivatives: straight segments, ties, and handles that stay where they are.

An edit that moves points or turns a handle calls these functions to keep what the person made.

- *Straight segments.* A segment is straight where the velocities at both of its ends are equal and parallel
  to its chord, and no higher derivative is set: edits and imports that make straight segments leave it like
  that. It has no flag, so that dragging a handle out of it is enough to bend it.
- *Ties.* A tied point is a corner whose two velocities are parallel: the curve has a tangent there (G¹), and
  its two handles have different lengths or, at an even point, equal ones. Turning one velocity turns the
  other one, and a straight segment beside the point sets the direction of both.
- *Handles.* A velocity is per unit of t; the person sees and drags the handle, h v / 3. Where a rule spaces
  the parameters by distance, every h is a share of the whole length, so that one moved point changes all of
  them, and with them the handles of finished parts far away. The derivatives that the person set are rescaled
  for the new h: pieces between points that did not move keep their shape, and so do pieces that moved as a
  whole. Beside a distance that changed, handles keep their lengths where nothing else depends on them.

No Qt, no arrays.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

import msgspec
from msgspec.structs import replace

from .derivatives import DERIVATIVES, VECTORS
from .limits import checked_vector
from .model import Curve, Point, Vector

# Straight segments

_SAME = 1e-9
"""Relative difference up to which the velocities of a segment and its chord count as equal: parsing and
rounding leave 1e-12, a person who drags a handle 1e-3."""


def ends_of(curve: Curve, segment: int) -> tuple[int, int]:
    """Return the indices of the points at the start and the end of a segment."""
    return segment, (segment + 1) % len(curve.points)


def chord_of(curve: Curve, segment: int) -> Vector:
    """Return the vector from the start of a segment to its end."""
    p, q = (curve.points[index] for index in ends_of(curve, segment))
    return (q.x - p.x, q.y - p.y)


def velocity_in(curve: Curve, segment: int) -> Vector | None:
    """Return the common velocity at both ends of a segment, if nothing bends it; else None.

    Both ends must be corners, or ends of an open curve: there the velocities belong to this segment alone.
    Those of an even point are of its two handles, whatever line these are in.
    """
    start, end = ends_of(curve, segment)
    p, q, last = curve.points[start], curve.points[end], len(curve.points) - 1
    if (not curve.is_closed and not 0 <= segment < last) or p.even or q.even:
        return None
    if not (p.corner or (start == 0 and not curve.is_closed)):
        return None
    if not (q.corner or (end == last and not curve.is_closed)):
        return None
    (v, w), higher = _derivatives_in(p, q, 1), range(2, curve.family.derivatives + 1)
    if not v or not w or any(d is None or any(d) for k in higher for d in _derivatives_in(p, q, k)):
        return None
    return v if math.dist(v, w) <= _SAME * math.hypot(*v) else None


def is_straight(curve: Curve, segment: int) -> bool:
    """Return whether a segment is straight, with constant speed."""
    v = velocity_in(curve, segment)
    return v is not None and _goes_along(v, chord_of(curve, segment))


def is_straight_beside(curve: Curve, index: int, *, ahead: bool) -> bool:
    """Return whether the segment after a point, or the one before it, is straight."""
    segment = index if ahead else index - 1
    count = len(curve.points)
    if curve.is_closed:
        return is_straight(curve, segment % count)
    return 0 <= segment < count - 1 and is_straight(curve, segment)


class KeptSegment(msgspec.Struct, frozen=True):
    """Straight segment that must stay straight.

    Attributes
    ----------
    segment
        Its index.
    chord
        Its chord before an end moved.
    by_start
        Whether its speed is that of the velocity at its start; else that at its end.
    """

    segment: int
    chord: Vector
    by_start: bool


def straight_segments_to_keep(before: Curve, after: Curve) -> list[KeptSegment]:
    """Return the straight segments of `before` whose chords changed in `after`.

    Segments with two changed velocities are left out: they were bent, or transformed with their ends.
    """
    result = []
    # Thousands of curves are transformed at once: the expensive check comes last.
    for segment in _apart(before):
        chord = chord_of(before, segment)
        if chord == chord_of(after, segment):
            continue
        was, now = _ends_in(before, segment), _ends_in(after, segment)
        if (was[0] == now[0] or was[1] == now[1]) and is_straight(before, segment):
            result.append(KeptSegment(segment, chord, by_start=was[0] == now[0]))
    return result


def with_straight_segments(curve: Curve, segments: Collection[KeptSegment]) -> Curve:
    """Return a curve with these segments straight between the present positions of their ends."""
    points = list(curve.points)
    for line in segments:
        start, end = ends_of(curve, line.segment)
        (x, y), length = chord_of(curve, line.segment), math.hypot(*line.chord)
        ends = _derivatives_in(points[start], points[end], 1)
        speed = math.hypot(*(ends[0 if line.by_start else 1] or (0.0, 0.0)))
        along = checked_vector((x / length * speed, y / length * speed), "a derivative")
        points[start] = replace(points[start], **{_field(points[start], ahead=True): along})
        points[end] = replace(points[end], **{_field(points[end], ahead=False): along})
    return replace(curve, points=tuple(points))


def _field(point: Point, *, ahead: bool) -> str:
    return DERIVATIVES[0].after if point.corner and ahead else DERIVATIVES[0].name


def _apart(curve: Curve) -> Iterator[int]:
    """Yield the segments between corners or ends of an open curve, whose derivatives belong to them alone."""
    separates = [point.corner for point in curve.points]
    if curve.is_closed:
        separates += separates[:1]
    elif separates:
        separates[0] = separates[-1] = True
    return (segment for segment, (start, end) in enumerate(pairwise(separates)) if start and end)


def _ends_in(curve: Curve, segment: int) -> tuple[Vector | None, Vector | None]:
    start, end = ends_of(curve, segment)
    return _derivatives_in(curve.points[start], curve.points[end], 1)


def _derivatives_in(start: Point, end: Point, order: int) -> tuple[Vector | None, Vector | None]:
    """Return the explicit derivatives of an order at the ends of a segment, within it."""
    return start.explicit_sides(order)[1], end.explicit_sides(order)[0]


def _goes_along(v: Vector, chord: Vector) -> bool:
    cross, dot = v[0] * chord[1] - v[1] * chord[0], v[0] * chord[0] + v[1] * chord[1]
    return dot > 0.0 and abs(cross) <= _SAME * dot


# Ties

PARALLEL = 1e-9
"""Angle in radians up to which two velocities are parallel, as in the joint certificate; turning one velocity
to the other leaves about 1e-16."""


def angle_between(v: Vector, w: Vector) -> float:
    """Return the angle between two vectors, 0 to π; 0 if one of them is zero."""
    (a, b), (c, d) = unit_vector(v), unit_vector(w)
    return 2.0 * math.atan2(math.hypot(a - c, b - d), math.hypot(a + c, b + d)) if any(v) and any(w) else 0.0


def unit_vector(v: Vector) -> Vector:
    """Return the unit vector in the direction of `v`; zero for the zero vector."""
    largest = max(abs(v[0]), abs(v[1]))
    if not largest:
        return (0.0, 0.0)
    # Scaled first, because the squares of small numbers underflow.
    x, y = v[0] / largest, v[1] / largest
    length = math.hypot(x, y)
    return (x / length, y / length)


def turned_along(v: Vector, along: Vector) -> Vector:
    """Return a vector as long as `v` in the direction of `along`; `v` itself if `along` is zero."""
    if not any(along) or unit_vector(v) == unit_vector(along):
        return v
    (x, y), length = unit_vector(along), math.hypot(*v)
    return (length * x, length * y)


def has_parallel_velocities(point: Point) -> bool:
    """Return whether both velocities of a corner are explicit and parallel, as a tie requires."""
    before, after = point.velocity, point.velocity_after
    return (
        point.corner and before is not None and after is not None and angle_between(before, after) <= PARALLEL
    )


def tie(point: Point, before: Vector, after: Vector, h: tuple[float, float] = (1.0, 1.0)) -> Point:
    """Return a point with tied velocities: the shorter handle is turned to the longer one.

    `h` are the lengths in t of the segments before and after the point, to which handles are proportional.
    """
    if h[0] * math.hypot(*before) < h[1] * math.hypot(*after):
        before = turned_along(before, after)
    else:
        after = turned_along(after, before)
    return replace(point.as_corner(), tied=True, velocity=before, velocity_after=after)


def tie_if_parallel(point: Point) -> Point:
    """Return a corner with parallel velocities as a tied point, any other point untied; nothing is turned."""
    return replace(point, tied=True) if has_parallel_velocities(point) else untie(point)


def untie(point: Point) -> Point:
    """Return a point without a tie; its velocities stay."""
    return replace(point, tied=False, even=False) if point.tied else point


HAND_DRAWN_ANGLE = math.radians(5)
"""Largest angle to a straight line at which a handle drawn by hand is meant to continue the line."""


def tied_to_straight_segment(curve: Curve, index: int, angle: float = HAND_DRAWN_ANGLE) -> Point:
    """Return point `index` of a curve, tied if its handle continues a straight segment, up to an angle."""
    point = curve.points[index]
    before, after = point.velocity, point.velocity_after
    if before is None or after is None or angle_between(before, after) > angle:
        return point
    if not (any(before) and any(after)):
        # A retracted handle has no direction to continue the line in.
        return point
    behind, ahead = (is_straight_beside(curve, index, ahead=side) for side in (False, True))
    if behind is ahead:
        return point
    if behind:
        return replace(point, tied=True, velocity_after=turned_along(after, before))
    return replace(point, tied=True, velocity=turned_along(before, after))


def with_derivative(
    curve: Curve, index: int, order: int, vector: Vector | None, *, ahead: bool, point: Point | None = None
) -> Point:
    """Return point `index` of a curve with another derivative on one side; a tied velocity is turned as well.

    The velocity on the other side of a tied point keeps its length or, if the point is even, its ratio to the
    new one. If a straight segment is on the other side, it stays straight: only the part of `vector` along it
    is used. Leaving the velocity to the rules (None) ends the tie. `point` replaces the point of the curve
    where that has been changed already.
    """
    point, derivative = point or curve.points[index], DERIVATIVES[order - 1]
    sides = (derivative.name, derivative.after)
    name, other = sides[::-1] if point.corner and ahead else sides
    if not point.tied or order > 1:
        return replace(point, **{name: vector})
    if vector is None:
        return replace(untie(point), **{name: None})
    held: Vector = getattr(point, other)
    was: Vector = getattr(point, name)
    if is_straight_beside(curve, index, ahead=not ahead):
        x, y = unit_vector(held)
        far = max(vector[0] * x + vector[1] * y, 0.0)
        return replace(point, **{name: (far * x, far * y)})
    opposite = _in_step(held, was, vector) if point.even else turned_along(held, vector)
    return replace(point, **{name: vector, other: opposite})


def _in_step(held: Vector, was: Vector, vector: Vector) -> Vector:
    """Return the opposite velocity of an even point: along `vector`, with the former ratio of the two speeds.

    Equally long handles stay equally long, whatever the lengths of the segments are. A point that stands
    still does so on both sides, and leaves its rest with the same velocity on both.
    """
    length = math.hypot(*was)
    if not any(vector) or not (length or any(held)):
        return vector
    if not length or not any(held):
        return turned_along(held, vector)
    (x, y), far = unit_vector(vector), math.hypot(*vector) * (math.hypot(*held) / length)
    return (far * x, far * y)


def tied_to_straight_segments(curve: Curve, index: int) -> Point:
    """Return point `index` with its tie kept after straight segments beside it were turned.

    One straight segment sets the direction of the velocity on the other side; two of different directions end
    the tie.
    """
    point = curve.points[index]
    if not point.tied or point.velocity is None or point.velocity_after is None:
        return untie(point)
    if is_straight_beside(curve, index, ahead=True):
        if not is_straight_beside(curve, index, ahead=False):
            return replace(point, velocity=turned_along(point.velocity, point.velocity_after))
        return point if has_parallel_velocities(point) else untie(point)
    return replace(point, velocity_after=turned_along(point.velocity_after, point.velocity))


# Handles that stay where they are

_NOISE = 1e-12
"""Relative change of h that is a rounding error."""


def with_handles_kept(before: Curve, after: Curve, together: Collection[int] = ()) -> Curve:
    """Return `after`, in which points moved or are fewer, with explicit derivatives for the new spacing.

    Handles stay where they are; those of points that moved `together` moved with them. Straight segments stay
    straight.
    """
    if not before.has_derivatives:
        return after
    spaced = _for_new_spacing(before, after, together)
    lines = straight_segments_to_keep(before, after) if len(before.points) == len(after.points) else ()
    if not lines:
        return spaced
    straight = with_straight_segments(spaced, lines)
    points = list(straight.points)
    for index in {end for line in lines for end in ends_of(straight, line.segment)}:
        points[index] = tied_to_straight_segments(straight, index)
    return replace(straight, points=tuple(points))


def _for_new_spacing(before: Curve, after: Curve, together: Collection[int]) -> Curve:
    exponent = after.parametrization.exponent
    if exponent is None:
        return after
    old, new = _spacings(before, exponent), _spacings(after, exponent)
    if _are_alike(old, new):
        return after
    whole = sum(old), sum(new)
    if not all(0.0 < total < math.inf for total in whole):
        return after
    far = whole[0] / whole[1]
    factors = [(far, far)] * len(after.points)
    if len(old) == len(new):
        growth = _Growth(old, new, after.is_closed, _moved(before, after, together))
        for index in growth.points:
            behind, ahead = growth.beside(after.points[index], index)
            factors[index] = far * behind, far * ahead
    pairs = zip(after.points, factors, strict=True)
    return replace(after, points=tuple(rescaled_beside(point, *pair) for point, pair in pairs))


def _are_alike(old: Sequence[float], new: Sequence[float]) -> bool:
    """Return whether spacings differ by rounding errors alone, as after a rigid motion of all points."""
    if len(old) != len(new):
        return False
    return all(abs(now - was) <= 0.25 * _NOISE * was for was, now in zip(old, new, strict=True))


def _moved(before: Curve, after: Curve, together: Collection[int]) -> frozenset[int]:
    pairs = enumerate(zip(before.points, after.points, strict=True))
    return frozenset({*together, *(i for i, (a, b) in pairs if a is not b and a.position != b.position)})


class _Growth(msgspec.Struct, frozen=True):
    """Growth of segments from `old` to `new` spacings, as it applies to the handles at a point.

    A segment between points that stayed, or that moved together, decides for the handles at its ends, so that
    it keeps its shape. At any other point both segments decide, so that its handles together keep their
    lengths.
    """

    old: Sequence[float]
    new: Sequence[float]
    is_closed: bool
    moved: frozenset[int]

    @property
    def points(self) -> set[int]:
        """The points beside a segment that grows."""
        count = len(self.old) + (not self.is_closed)
        grown = [
            segment for segment, pair in enumerate(zip(self.old, self.new, strict=True)) if pair[0] != pair[1]
        ]
        return {point % count for segment in grown for point in (segment, segment + 1)}

    def beside(self, point: Point, index: int) -> tuple[float, float]:
        """Return the growth for the handles before and after a point: the same unless it is a corner."""
        count, last = len(self.old), index == len(self.old)
        behind = (index - 1) % count if index or self.is_closed else None
        ahead = None if last else index
        sides = [[side for side in (behind, ahead) if side is not None]]
        if point.corner:
            sides = [[side] for side in sides[0]]
        grown = [self._of(side, index) for side in sides]
        return grown[0], grown[-1]

    def _of(self, segments: Sequence[int], index: int) -> float:
        points = len(self.old) + (not self.is_closed)
        alike = [
            segment
            for segment in segments
            if (segment in self.moved) is ((segment + 1) % points in self.moved) is (index in self.moved)
        ]
        was, now = (sum(h[segment] for segment in alike or segments) for h in (self.old, self.new))
        return now / was if was > 0.0 and now > 0.0 else 1.0


def _spacings(curve: Curve, exponent: float) -> list[float]:
    """Return numbers that the spacings of the segments are proportional to."""
    points = (*curve.points, curve.points[0]) if curve.is_closed else curve.points
    return [math.dist(a.position, b.position) ** exponent for a, b in pairwise(points)]


def rescaled_beside(point: Point, behind: float, ahead: float) -> Point:
    """Return a point with derivatives rescaled for spacings that grow by factors before and after it."""
    behind, ahead = (1.0 if abs(factor - 1.0) < _NOISE else factor for factor in (behind, ahead))
    if behind == ahead:
        return rescaled(point, behind)
    after = rescaled(point, ahead)
    return replace(rescaled(point, behind), **{row.after: getattr(after, row.after) for row in DERIVATIVES})


def rescaled(point: Point, factor: float) -> Point:
    """Return a point with derivatives rescaled for an interval of t that is `factor` times as long."""
    if factor == 1:
        return point
    changed = {
        name: checked_vector(
            (_divided(vector[0], factor, order), _divided(vector[1], factor, order)), "a derivative"
        )
        for order, name in VECTORS
        if (vector := getattr(point, name)) is not None
    }
    return replace(point, **changed) if changed else point


def _divided(value: float, factor: float, times: int) -> float:
    """Divide by `factor` several times, because its power may overflow or underflow."""
    for _ in range(times):
        value /= factor
    return value
