"""Maps of clones: from their originals to where they are."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from operator import attrgetter

from msgspec.structs import replace

from .clone import Clone
from .derivatives import VECTORS
from .edits import EditError
from .model import Curve, Document, Point, Vector
from .shapes import with_values
from .transforms import Affine, transform_points

RULES = (
    *("family", "parametrization", "velocity_rule", "acceleration_rule", "jerk_rule"),
    *("closed", "settings", "form"),
)
"""What of a curve beside its points says how it runs, which a clone has as its original does."""

rules_of = attrgetter(*RULES)
"""Returns that of a curve."""

_OFF = 1e-9
"""Share of its size by which a clone may be off a map of its original: roundings."""


def map_of(clone: Clone) -> Affine:
    """Return the map of a clone."""
    return Affine(clone.xx, clone.xy, clone.yx, clone.yy, (0.0, 0.0), clone.shift)


def clone_by(of: str, by: Affine) -> Clone:
    """Return the clone by a map."""
    x, y = by.point((0.0, 0.0))
    return Clone(of, by.xx, by.xy, by.yx, by.yy, x, y)


def clone_shifted(clone: Clone, by: Vector) -> Clone:
    """Return the clone in a plane that was shifted with the original and all."""
    x, y = by
    return replace(clone, x=clone.x - clone.xx * x - clone.xy * y, y=clone.y - clone.yx * x - clone.yy * y)


def as_cloned(curve: Curve, original: Curve) -> Curve:
    """Return a clone where its map takes an original, and as that is; no clone where none can be there."""
    assert curve.clone is not None
    by = map_of(curve.clone)
    try:
        points = mapped_points(original, by)
    except EditError:
        return replace(curve, clone=None)
    if not is_image(original, by):
        return replace(curve, clone=None)
    values = {name: getattr(original, name) for name in RULES}
    return replace(with_values(curve, values), points=points)


def mapped_points(original: Curve, by: Affine) -> tuple[Point, ...]:
    """Return the points that an original has where it is mapped as by hand."""
    return transform_points(Document((original,)), 0, range(len(original.points)), by).curves[0].points


def is_image(original: Curve, by: Affine) -> bool:
    """Whether the curve through mapped points is the mapped curve.

    What is estimated, or spaced by distances, is so under some maps only; handles are taken along by all.
    """
    x, y = by.xx + 1.0, by.yy + 1.0
    if not (by.xx or by.xy or by.yx or by.yy) and original.family.is_built_in:
        return True
    if _is_all_given(original):
        return original.family.is_built_in
    most = max(abs(each) for each in (x, y, by.xy, by.yx))
    is_even = any(math.dist((x, by.xy), (sign * y, -sign * by.yx)) <= _OFF * most for sign in (1.0, -1.0))
    asks = original.parametrization.kind.asks_where_points_are
    return (
        original.family.is_built_in
        and all(rule.is_linear for rule in original.rules)
        and (is_even or not asks)
    )


def _is_all_given(curve: Curve) -> bool:
    """Whether the person set all derivatives that the curve has, of each joint on both sides."""
    joints = curve.points if curve.is_closed else curve.points[1:-1]
    if not all(point.corner for point in joints):
        return False
    for order in range(1, curve.family.derivatives + 1):
        sides = [side for point in curve.points for side in point.explicit_sides(order)]
        if None in (sides if curve.is_closed else sides[1:-1]):
            return False
    return curve.family.derivatives > 0


def _sites(points: Sequence[Point]) -> Iterator[Vector]:
    """Yield the places of points, and where the derivatives that are set there lead."""
    for point in points:
        yield point.position
        for _, name in VECTORS:
            if (vector := getattr(point, name)) is not None:
                yield point.x + vector[0], point.y + vector[1]


def runs_as(original: Curve, points: Sequence[Point], by: Affine) -> bool:
    """Whether a map takes an original to other points, but for roundings."""
    try:
        mapped = mapped_points(original, by)
    except EditError:
        return False
    pairs = list(zip(mapped, points, strict=False))
    if len(mapped) != len(points) or any(_kind(one) != _kind(other) for one, other in pairs):
        return False
    here, there = list(_sites(mapped)), list(_sites(points))
    room = _OFF * max((abs(value) for place in (*here, *there) for value in place), default=0.0)
    return all(math.dist(a, b) <= room for a, b in zip(here, there, strict=True))


def _kind(point: Point) -> tuple[object, ...]:
    vectors = (getattr(point, name) is not None for _, name in VECTORS)
    return (point.corner, point.tied, point.even, point.t, *vectors)


def map_between(original: Curve, points: Sequence[Point]) -> Affine | None:
    """Return the affine map that takes an original to other points; None where there is none."""
    here, there = ([point.position for point in each] for each in (original.points, points))
    if len(here) != len(there) or not here:
        return None
    return next((by for by in _guesses(here, there) if runs_as(original, points, by)), None)


def _guesses(here: Sequence[Vector], there: Sequence[Vector]) -> Iterator[Affine]:
    """Yield maps that take some places where they should be: a shift, a similarity, any other."""
    start, to = here[0], there[0]
    shift = (to[0] - start[0], to[1] - start[1])
    yield Affine(0.0, 0.0, 0.0, 0.0, start, shift)
    far = max(range(len(here)), key=lambda at: math.dist(start, here[at]))
    a, c = _way(start, here[far]), _way(to, there[far])
    length = a[0] ** 2 + a[1] ** 2
    if not length:
        return
    cos, sin = (a[0] * c[0] + a[1] * c[1]) / length, (a[0] * c[1] - a[1] * c[0]) / length
    yield Affine(cos - 1.0, -sin, sin, cos - 1.0, start, shift)
    off = max(range(len(here)), key=lambda at: abs(_cross(a, _way(start, here[at]))))
    b, d = _way(start, here[off]), _way(to, there[off])
    size = _cross(a, b)
    if abs(size) <= _OFF * length:
        return
    xx, xy = (c[0] * b[1] - d[0] * a[1]) / size, (d[0] * a[0] - c[0] * b[0]) / size
    yx, yy = (c[1] * b[1] - d[1] * a[1]) / size, (d[1] * a[0] - c[1] * b[0]) / size
    yield Affine(xx - 1.0, xy, yx, yy - 1.0, start, shift)


def _way(start: Vector, end: Vector) -> Vector:
    return end[0] - start[0], end[1] - start[1]


def _cross(a: Vector, b: Vector) -> float:
    return a[0] * b[1] - a[1] * b[0]
