"""Closed curves drawn into a box: rectangle and ellipse. No Qt, no arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from msgspec.structs import replace

from ..families import HERMITE
from .constraints import has_parallel_velocities, tie
from .curve_edits import (
    add_curve,
    has_default_name,
    new_curve_like,
    replace_curve,
    unused_name,
    without_curve,
)
from .limits import checked_vector
from .model import Document, Parametrization, ParametrizationKind, Point, Vector
from .style import Style

Piece = tuple[Vector, Vector, Vector, Vector]
"""Control points of a cubic piece."""

_QUARTER = 4 / 3 * (math.sqrt(2) - 1)
"""Length of the handles of a quarter circle, divided by its radius."""

_SMOOTH = 1e-12
"""Relative difference up to which two velocities at a point differ by rounding errors alone."""


def rectangle_in(low: Vector, high: Vector) -> Sequence[Piece]:
    """Return the sides of a box from its upper left corner on, clockwise, as in SVG."""
    (left, bottom), (right, top) = low, high
    corners = ((left, top), (right, top), (right, bottom), (left, bottom), (left, top))
    return [
        (start, _between(start, end, 1 / 3), _between(end, start, 1 / 3), end)
        for start, end in pairwise(corners)
    ]


def ellipse_in(low: Vector, high: Vector) -> Sequence[Piece]:
    """Return the quarters of the ellipse in a box from its right on, clockwise, as in SVG."""
    (left, bottom), (right, top) = low, high
    x, y = (left + right) / 2, (bottom + top) / 2
    points = ((right, y), (x, bottom), (left, y), (x, top), (right, y))
    corners = ((right, bottom), (left, bottom), (left, top), (right, top))
    return [
        (start, _between(start, corner, _QUARTER), _between(end, corner, _QUARTER), end)
        for (start, end), corner in zip(pairwise(points), corners, strict=True)
    ]


def _between(start: Vector, end: Vector, share: float) -> Vector:
    """Return the point at a share of the line from `start` to `end`."""
    return (start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share)


def drawn_index(document: Document, active: int) -> int:
    """Return the index of a new curve: in front, or that of an empty active curve moved to the front."""
    return len(_rest(document, active).curves)


def draw_closed_curve(
    document: Document, active: int, name: str, pieces: Sequence[Piece], style: Style
) -> Document:
    """Return the document with a closed cubic curve of connected pieces in front.

    It has `style` and the rules of the active curve. If the active curve is empty, it is replaced. The
    parameters are spaced by the chords of the pieces.
    """
    model, rest = document.curves[active], _rest(document, active)
    if rest is not document:
        curve = replace(model, parametrization=Parametrization(), visible=True)
    else:
        curve = new_curve_like(document, replace(model, style=style), Parametrization())
    if has_default_name(curve.name):
        curve = replace(curve, name=unused_name(rest, name))
    rule = curve.parametrization
    if rule.kind is not ParametrizationKind.CHORD_LENGTH:
        rule = Parametrization()
    curve = replace(curve.with_family(HERMITE), closed=True, parametrization=rule)
    index, drawn = len(rest.curves), replace(curve, points=_points(pieces, rule.end - rule.start))
    return replace_curve(add_curve(rest, index, curve), index, drawn)


def _rest(document: Document, active: int) -> Document:
    """Return the document without the active curve if that is empty and unlocked, to be replaced."""
    curve = document.curves[active]
    return document if curve.points or curve.locked else without_curve(document, active)


def _points(pieces: Sequence[Piece], span: float) -> tuple[Point, ...]:
    """Return the points of pieces whose parameters are spaced by the chords over an interval."""
    chords = [math.dist(piece[0], piece[3]) for piece in pieces]
    whole = sum(chords)
    # A handle is p ± h v / 3.
    factors = [3.0 * whole / (chord * span) for chord in chords]
    return tuple(
        _point(piece[0], _velocity(pieces[at - 1][2:], factors[at - 1]), _velocity(piece, factors[at]))
        for at, piece in enumerate(pieces)
    )


def _velocity(ends: Sequence[Vector], factor: float) -> Vector:
    (x, y), (to_x, to_y) = ends[:2]
    return checked_vector((factor * (to_x - x), factor * (to_y - y)), "a velocity")


def _point(position: Vector, before: Vector, after: Vector) -> Point:
    x, y = checked_vector(position, "a point")
    if math.dist(before, after) <= _SMOOTH * math.hypot(*after):
        return Point(x, y, velocity=after)
    corner = Point(x, y, velocity=before, corner=True, velocity_after=after)
    return tie(corner, before, after) if has_parallel_velocities(corner) else corner
