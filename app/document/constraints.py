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


def is_straight(curve: Curve, segment: int) -> bool:
    """Whether a segment is straight, and run through at an even pace."""
    v = velocity_in(curve, segment)
    return v is not None and _goes_along(v, chord_of(curve, segment))


def is_straight_beside(curve: Curve, index: int, *, ahead: bool) -> bool:
    """Whether the segment ahead of a point, or the one behind it, is straight."""
    segment = index if ahead else index - 1
    count = len(curve.points)
    if curve.is_closed:
        return is_straight(curve, segment % count)
    return 0 <= segment < count - 1 and is_straight(curve, segment)


class KeptSegment(msgspec.Struct, frozen=True):
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


def straight_segments_to_keep(before: Curve, after: Curve) -> list[KeptSegment]:
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
        if (was[0] == now[0] or was[1] == now[1]) and is_straight(before, segment):
            kept.append(KeptSegment(segment, chord, by_start=was[0] == now[0]))
    return kept


def with_straight_segments(curve: Curve, lines: Collection[KeptSegment]) -> Curve:
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
    return (segment for segment, (start, end) in enumerate(pairwise(own)) if start and end)


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


# Ties

PARALLEL = 1e-9
"""Angle in radians up to which two velocities go the same way: what the certificate of joints takes for
none. Turning one to the other leaves some 1e-16."""


def angle_between(v: Vector, w: Vector) -> float:
    """Return the angle between two vectors, 0 to π; 0 where one of them is zero and has no direction."""
    (a, b), (c, d) = unit_vector(v), unit_vector(w)
    return 2.0 * math.atan2(math.hypot(a - c, b - d), math.hypot(a + c, b + d)) if any(v) and any(w) else 0.0


def unit_vector(v: Vector) -> Vector:
    """Return the direction of a vector, zero where it has none."""
    largest = max(abs(v[0]), abs(v[1]))
    if not largest:
        return (0.0, 0.0)
    # Scaled first: the square of a small number vanishes.
    x, y = v[0] / largest, v[1] / largest
    length = math.hypot(x, y)
    return (x / length, y / length)


def turned_along(v: Vector, along: Vector) -> Vector:
    """Return a vector as long as `v` that goes the way of `along`; where that is zero, `v` itself."""
    if not any(along) or unit_vector(v) == unit_vector(along):
        return v
    (x, y), length = unit_vector(along), math.hypot(*v)
    return (length * x, length * y)


def has_parallel_velocities(point: Point) -> bool:
    """Whether the two velocities of a point are what a tie says: both set, and parallel."""
    before, after = point.velocity, point.velocity_after
    return (
        point.corner and before is not None and after is not None and angle_between(before, after) <= PARALLEL
    )


def tie(point: Point, before: Vector, after: Vector, h: tuple[float, float] = (1.0, 1.0)) -> Point:
    """Return a point whose velocities are tied: the shorter handle is turned to the longer.

    `h` are the lengths in t of the segments before and after it, which handles are in proportion to.
    """
    if h[0] * math.hypot(*before) < h[1] * math.hypot(*after):
        before = turned_along(before, after)
    else:
        after = turned_along(after, before)
    cornered = point if point.corner else point.as_corner()
    return replace(cornered, tied=True, velocity=before, velocity_after=after)


def tie_if_parallel(point: Point) -> Point:
    """Return a corner whose velocities go the same way as tied: nothing turns there. Others as they are."""
    return replace(point, tied=True) if has_parallel_velocities(point) else untie(point)


def untie(point: Point) -> Point:
    """Return a point whose velocities are free of each other, themselves what they are."""
    return replace(point, tied=False, even=False) if point.tied else point


HAND_DRAWN_ANGLE = math.radians(5)
"""Angle up to which a handle drawn by hand beside a straight line means the direction of the line."""


def tied_to_straight_segment(curve: Curve, index: int) -> Point:
    """Return point `index` of a curve, tied where a handle goes on from a line beside it, or nearly so."""
    point = curve.points[index]
    before, after = point.velocity, point.velocity_after
    if before is None or after is None or angle_between(before, after) > HAND_DRAWN_ANGLE:
        return point
    behind, ahead = (is_straight_beside(curve, index, ahead=each) for each in (False, True))
    if behind is ahead:
        return point
    if behind:
        return replace(point, tied=True, velocity_after=turned_along(after, before))
    return replace(point, tied=True, velocity=turned_along(before, after))


def with_derivative(
    curve: Curve,
    index: int,
    order: int,
    vector: Vector | None,
    *,
    ahead: bool,
    point: Point | None = None,
) -> Point:
    """Return point `index` of a curve with another derivative on one side, and what is tied to that.

    Of a tied point the velocity on the other side turns along and keeps its length, or where it is even, its
    share of the other's. Where a straight segment
    lies there, it stays straight: the velocity goes along it, as far as it did. One that is left to the rules
    (None) ends the tie. `point` stands for the one of the curve where that has been changed already.
    """
    point, each = point or curve.points[index], DERIVATIVES[order - 1]
    name, other = (each.after, each.name) if point.corner and ahead else (each.name, each.after)
    if not point.tied or order > 1:
        return replace(point, **{name: vector})
    if vector is None:
        return replace(untie(point), **{name: None})
    held: Vector = getattr(point, other)
    was: Vector = getattr(point, name)
    if is_straight_beside(curve, index, ahead=not ahead):
        x, y = unit_vector(held)
        far = max(vector[0] * x + vector[1] * y, 0.0)
        vector = (far * x, far * y)
        return replace(point, **{name: vector} | ({other: _in_step(held, was, vector)} if point.even else {}))
    other_way = _in_step(held, was, vector) if point.even else turned_along(held, vector)
    return replace(point, **{name: vector, other: other_way})


def _in_step(held: Vector, was: Vector, vector: Vector) -> Vector:
    """Return the velocity across an even point: along `vector`, at its speed by the ratio that there was.

    Handles that are equally long stay so, whatever the lengths of the segments are: speeds go by their ratio.
    """
    length = math.hypot(*was)
    if not length or not any(held) or not any(vector):
        return turned_along(held, vector)
    (x, y), far = unit_vector(vector), math.hypot(*vector) * (math.hypot(*held) / length)
    return (far * x, far * y)


def tied_to_straight_segments(curve: Curve, index: int) -> Point:
    """Return point `index` with its tie kept, where straight segments beside it may have turned.

    One line gives the velocity on its other side the direction; two of different directions end the tie.
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
"""A change of h that is rounding."""


def with_handles_kept(before: Curve, after: Curve, together: Collection[int] = ()) -> Curve:
    """Return `after`, whose points are elsewhere or fewer, with derivatives set for the new spacing.

    Those of the points `together` went with them. Segments that were straight are so still.
    """
    if not before.has_derivatives:
        return after
    spaced = _for_new_spacing(before, after, together)
    lines = straight_segments_to_keep(before, after) if len(before.points) == len(after.points) else ()
    if not lines:
        return spaced
    straight = with_straight_segments(spaced, lines)
    points = list(straight.points)
    for index in {end for each in lines for end in ends_of(straight, each.segment)}:
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
    return replace(after, points=tuple(rescaled_beside(point, *each) for point, each in pairs))


def _are_alike(old: Sequence[float], new: Sequence[float]) -> bool:
    """Whether spacings differ by roundings alone: of what was moved, turned or flipped as a whole."""
    if len(old) != len(new):
        return False
    return all(abs(now - was) <= 0.25 * _NOISE * was for was, now in zip(old, new, strict=True))


def _moved(before: Curve, after: Curve, together: Collection[int]) -> frozenset[int]:
    pairs = enumerate(zip(before.points, after.points, strict=True))
    return frozenset({*together, *(i for i, (a, b) in pairs if a is not b and a.position != b.position)})


class _Growth(msgspec.Struct, frozen=True):
    """By how much segments grow from `old` to `new` spacings, as the handles at a point count it.

    What lies between points that stay decides for those, and what lies between points that moved together for
    these: that keeps its shape. Else all that lies beside a point does, and its handles together stay as long
    as they were.
    """

    old: Sequence[float]
    new: Sequence[float]
    is_closed: bool
    moved: frozenset[int]

    @property
    def points(self) -> set[int]:
        """The points beside which there is a segment that grows."""
        count = len(self.old) + (not self.is_closed)
        grown = [
            segment for segment, pair in enumerate(zip(self.old, self.new, strict=True)) if pair[0] != pair[1]
        ]
        return {point % count for segment in grown for point in (segment, segment + 1)}

    def beside(self, point: Point, index: int) -> tuple[float, float]:
        """Return the growth for what point `index` has before and after a corner; elsewhere the same."""
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
        was, now = (sum(each[segment] for segment in alike or segments) for each in (self.old, self.new))
        return now / was if was > 0.0 and now > 0.0 else 1.0


def _spacings(curve: Curve, exponent: float) -> list[float]:
    """Return what the spacings are in proportion to, one for each segment."""
    points = (*curve.points, curve.points[0]) if curve.is_closed else curve.points
    return [math.dist(a.position, b.position) ** exponent for a, b in pairwise(points)]


def rescaled_beside(point: Point, behind: float, ahead: float) -> Point:
    """Rescale derivatives for spacings that grow by these factors, those after a corner by the second."""
    behind, ahead = (1.0 if abs(factor - 1.0) < _NOISE else factor for factor in (behind, ahead))
    if behind == ahead:
        return rescaled(point, behind)
    after = rescaled(point, ahead)
    return replace(
        rescaled(point, behind), **{each.after: getattr(after, each.after) for each in DERIVATIVES}
    )


def rescaled(point: Point, factor: float) -> Point:
    """Rescale derivatives for a time that runs `factor` times as long."""
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
    """Divide by `factor` several times: its powers may vanish, or be infinite, where it is not."""
    for _ in range(times):
        value /= factor
    return value
