"""Handles that stay where they are while points move.

A velocity is per unit of t; what a person sees and drags of it is the handle, h v / 3. Where a rule spaces
the parameters by distance, every h is a share of the whole length, so one moved point changes them all, and
with them the handles of finished parts far away. The derivatives that the person set are rescaled here for
the new h: what lies between points that stay keeps its shape, and so does what moves together; handles beside
a distance that changes stay as long as they were where nothing else hangs on them. Straight segments stay
straight, and what is tied to one at its ends turns with it.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from itertools import pairwise

import msgspec
from msgspec.structs import replace

from .derivatives import DERIVATIVES, VECTORS
from .limits import checked_vector
from .lines import ends_of, lines_to_keep, with_lines
from .model import Curve, Point
from .ties import along_lines

_NOISE = 1e-12
"""A change of h that is rounding."""


def with_handles_kept(before: Curve, after: Curve, together: Collection[int] = ()) -> Curve:
    """Return `after`, whose points are elsewhere or fewer, with derivatives set for the new spacing.

    Those of the points `together` went with them. Segments that were straight are so still.
    """
    if not before.has_derivatives:
        return after
    spaced = _for_new_spacing(before, after, together)
    lines = lines_to_keep(before, after) if len(before.points) == len(after.points) else ()
    if not lines:
        return spaced
    straight = with_lines(spaced, lines)
    points = list(straight.points)
    for index in {end for each in lines for end in ends_of(straight, each.segment)}:
        points[index] = along_lines(straight, index)
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
    return replace(after, points=tuple(stretched_beside(point, *each) for point, each in pairs))


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


def stretched_beside(point: Point, behind: float, ahead: float) -> Point:
    """Rescale derivatives for spacings that grow by these factors, those after a corner by the second."""
    behind, ahead = (1.0 if abs(factor - 1.0) < _NOISE else factor for factor in (behind, ahead))
    if behind == ahead:
        return stretched(point, behind)
    after = stretched(point, ahead)
    return replace(
        stretched(point, behind), **{each.after: getattr(after, each.after) for each in DERIVATIVES}
    )


def stretched(point: Point, factor: float) -> Point:
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
