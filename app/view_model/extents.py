"""Extents of cubic Bézier pieces, and the box around a line with its stroke.

Of a stroke, width, caps, joins and miters count, dashes do not.

A stroke reaches half its width to both sides of every point of the line, and at joints and ends as far as
joins and caps do. So its extremes lie at joints, at ends, and beside the points where a coordinate of the
line turns. Cusps of the inner side, where a line bends more tightly than half the width, are ignored.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import msgspec
import numpy as np

from curvecore.arithmetic import cross
from curvecore.arrays import BoolArray, FloatArray

from ..document.style import LineCap, LineJoin, Style
from .geometry import to_the_left, unit_tangents

_LEAST = 1e-12
"""Share of the size of a piece below which the offset to a control point is no direction."""


# Cubic pieces


def extent_of(control_points: FloatArray) -> FloatArray:
    """Return the lower left and the upper right corner, (2, 2), of cubic Bézier pieces (k, 4, 2).

    Exact up to rounding: the extremes lie at the ends of the pieces and where a coordinate's derivative,
    a quadratic, is zero.
    """
    pieces = control_points.transpose(0, 2, 1).reshape(-1, 4)
    extremes = _cubic_values(pieces, _turning_points(pieces))
    extremes = extremes.reshape(-1, 2, 2).transpose(0, 2, 1).reshape(-1, 2)
    points = np.vstack([control_points[:, 0], control_points[:, 3], extremes])
    return np.array([points.min(axis=0), points.max(axis=0)])


def turns_within(control_points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the extreme values of x, and of y, within pieces."""
    pieces = control_points.transpose(0, 2, 1).reshape(-1, 4)
    parameters = _turning_points(pieces)
    values = np.where(parameters > 0.0, _cubic_values(pieces, parameters), np.nan).reshape(-1, 2, 2)
    xs, ys = values[:, 0].ravel(), values[:, 1].ravel()
    return xs[~np.isnan(xs)], ys[~np.isnan(ys)]


def _turning_points(pieces: FloatArray) -> FloatArray:
    """Return the parameters in [0, 1] of extremes of the cubics (k, 4), (k, 2); zero stands for none.

    The roots of a s² − 2 b s + c are taken as c / q and q / a with q = b ± √(b² − a c), the sign chosen
    so that nothing cancels.
    """
    first, second, third = np.diff(pieces, axis=1).T
    a, b, c = first - 2 * second + third, first - second, first
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        q = b + np.copysign(np.sqrt(b * b - a * c), b)
        roots = np.stack([c / q, q / a], axis=1)
    inside = (roots > 0) & (roots < 1)
    return np.where(inside, roots, 0.0)


def _cubic_values(pieces: FloatArray, s: FloatArray) -> FloatArray:
    """Return the values (k, m) of the cubics (k, 4) at s (k, m), by de Casteljau's scheme."""
    level = [pieces[:, [i]] for i in range(4)]
    while len(level) > 1:
        level = [(1 - s) * low + s * high for low, high in itertools.pairwise(level)]
    return level[0]


# Lines with strokes


class Line(msgspec.Struct, frozen=True, eq=False):
    """Joints of a line, with its directions there, unit vectors.

    Attributes
    ----------
    points
        The joints, (m, 2), of an open line with its ends.
    before, after
        The directions in which the line enters a joint and leaves it, (m, 2). Those of an open line before
        its first point, and after its last, have no meaning.
    turns
        The extreme values of x, and of y, within pieces.
    is_closed
        Whether the last joint is joined with the first.
    """

    points: FloatArray
    before: FloatArray
    after: FloatArray
    turns: tuple[FloatArray, FloatArray]
    is_closed: bool


def half_width(style: Style) -> float:
    """Return half the width of a stroke; 0 of one that is as wide at every zoom."""
    return (style.width or 0.0) / 2.0 if style.has_stroke else 0.0


def around_dot(position: FloatArray, style: Style) -> FloatArray:
    """Return the corners, (2, 2), of the box around a line of no length with its caps."""
    reach = half_width(style) if style.has_caps else 0.0
    return np.stack([position - reach, position + reach])


def line_of(controls: FloatArray, turns: tuple[FloatArray, FloatArray], *, is_closed: bool) -> Line | None:
    """Return the line of Bézier pieces (k, m, 2) with these extreme x and y; None of a single point."""
    leaving, is_long = _directions(controls)
    coming, _ = _directions(controls[:, ::-1])
    if not is_long.any():
        return None
    starts, end = controls[is_long, 0], controls[is_long, -1][-1:]
    after, before = leaving[is_long], -coming[is_long]
    if is_closed:
        return Line(starts, np.roll(before, 1, axis=0), after, turns, is_closed=True)
    before, after = np.vstack([before[:1], before]), np.vstack([after, after[-1:]])
    return Line(np.vstack([starts, end]), before, after, turns, is_closed=False)


def _directions(controls: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return the unit tangents at the starts of pieces (k, m, 2), and the mask of those with any length."""
    chords: FloatArray = controls[:, 1:] - controls[:, :1]
    lengths = np.hypot(chords[..., 0], chords[..., 1])
    longest = lengths.max(axis=1)
    first = (lengths > _LEAST * longest[:, None]).argmax(axis=1)
    return unit_tangents(chords[np.arange(len(chords)), first]), longest > 0.0


def stroke_box(line: Line, style: Style) -> FloatArray:
    """Return the lower left and the upper right corner, (2, 2), of a line with its stroke."""
    half = half_width(style)
    inner = slice(None) if line.is_closed else slice(1, -1)
    points, before, after = line.points[inner], line.before[inner], line.after[inner]
    reached = [*_sides(points, before, half), *_sides(points, after, half)]
    if style.join is LineJoin.MITER:
        reached.append(_miters(points, before, after, half, style.miter_limit))
    discs = [(points, before, -after)] if style.join is LineJoin.ROUND else []
    if not line.is_closed:
        ends, out = line.points[[0, -1]], np.stack([-line.after[0], line.before[-1]])
        reached += [*_sides(ends, out, half)]
        if style.cap is LineCap.SQUARE:
            reached += [*_sides(ends + half * out, out, half)]
        elif style.cap is LineCap.ROUND:
            discs.append((ends, out, out))
    spots = np.vstack(reached)
    return np.array([_along(axis, line, spots, discs, half) for axis in (0, 1)]).T


_Disc = tuple[FloatArray, FloatArray, FloatArray]
"""Centres (k, 2) of half discs, and for each two directions, (k, 2), between which it lies."""


def _along(axis: int, line: Line, spots: FloatArray, discs: list[_Disc], half: float) -> tuple[float, float]:
    """Return the least and the greatest coordinate along an axis."""
    values = [spots[:, axis], line.turns[axis] - half, line.turns[axis] + half]
    for centres, one, other in discs:
        for sign in (-1.0, 1.0):
            is_ahead = (sign * one[:, axis] >= 0.0) & (sign * other[:, axis] >= 0.0)
            values.append(centres[is_ahead, axis] + sign * half)
    reached = np.concatenate(values)
    return float(reached.min()), float(reached.max())


def _sides(points: FloatArray, directions: FloatArray, half: float) -> Iterator[FloatArray]:
    """Yield the points half a width to the left and to the right of points."""
    aside = half * to_the_left(directions)
    yield points + aside
    yield points - aside


def _miters(
    points: FloatArray, before: FloatArray, after: FloatArray, half: float, limit: float
) -> FloatArray:
    """Return the tips of miters at joints (m, 2) between directions, unit vectors, that are not too sharp."""
    is_pointed = (1.0 + (before * after).sum(axis=1)) * limit * limit >= 2.0
    points, before, after = points[is_pointed], before[is_pointed], after[is_pointed]
    cosine, aside = (before * after).sum(axis=1), before + after
    outwards = np.sign(cross(before, after))[:, None] * np.stack((aside[:, 1], -aside[:, 0]), axis=1)
    # The tip is 1 / cos(φ/2) as far away as the sides, φ being the turn.
    return np.asarray(points + half * outwards / (1.0 + cosine)[:, None])
