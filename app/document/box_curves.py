"""Curves that fill a box: a rectangle, an ellipse. No Qt, no arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from msgspec.structs import replace

from ..families import HERMITE
from .curve_edits import fresh_curve, replace_curve
from .edits import EditError
from .layers import front_of, in_front, without
from .model import Curve, Document, Parametrization, Point, Vector
from .style import Style


class BoxPoint(NamedTuple):
    """A point of a curve that fills the box from (0, 0) to (1, 1).

    Attributes
    ----------
    x, y
        Where it is.
    ahead, behind
        Ways from it to its Bézier handles. Where one is the other turned round, and the points on both sides
        are as far away as each other, the curve is smooth there; else it is a corner.
    """

    x: float
    y: float
    ahead: Vector
    behind: Vector

    @property
    def is_smooth(self) -> bool:
        """Whether it is no corner."""
        return self.behind == (-self.ahead[0], -self.ahead[1])


class Box(NamedTuple):
    """Two opposite corners."""

    start: Vector
    end: Vector

    @property
    def size(self) -> Vector:
        """Width and height."""
        return (abs(self.end[0] - self.start[0]), abs(self.end[1] - self.start[1]))


def box_curve_place(document: Document, active: int, layer: str = "") -> int:
    """Return the place of a curve drawn in a box: in front in a layer, an empty active one left out."""
    return front_of(_rest(document, active), layer).place


def with_box_curve(
    document: Document, active: int, points: Sequence[BoxPoint], box: Box, style: Style, layer: str = ""
) -> Document:
    """Return the document with a closed cubic curve that fills a box, at its place.

    It has a style and the rules of the active curve, or is that one where it is empty.
    """
    if not all(box.size):
        raise EditError("Drag to the side and up or down: the box has no area.")
    model, rest = document.curves[active], _rest(document, active)
    if rest is not document:
        curve = replace(model, parametrization=Parametrization(), visible=True)
    else:
        curve = fresh_curve(document, replace(model, style=style), Parametrization())
    curve, front = replace(curve.with_family(HERMITE), closed=True), front_of(rest, layer)
    made = in_front(rest, front, curve)
    return replace_curve(made, front.place, replace(made.curves[front.place], points=_in_box(points, box)))


def _rest(document: Document, active: int) -> Document:
    """Return the document without the curve that is edited where that becomes the one that is drawn."""
    return without(document, active) if _is_taken(document.curves[active]) else document


def _is_taken(active: Curve) -> bool:
    """Whether the curve that is edited becomes the one that is drawn: it is empty."""
    return not active.points and not active.locked


def _in_box(points: Sequence[BoxPoint], box: Box) -> tuple[Point, ...]:
    """Return the points of a curve whose parameters go from 0 to 1 by the lengths of the chords."""
    (left, right), (low, high) = (sorted(ends) for ends in zip(box.start, box.end, strict=True))
    # Not left + x · width, which would miss the right side by a rounding.
    places = [((1 - p.x) * left + p.x * right, (1 - p.y) * low + p.y * high) for p in points]
    chords = [math.dist(*ends) for ends in pairwise((*places, places[0]))]
    whole = sum(chords)
    return tuple(
        _point(each, places[i], box.size, (chords[i - 1] / whole, chords[i] / whole))
        for i, each in enumerate(points)
    )


def _point(unit: BoxPoint, place: Vector, size: Vector, spacings: Vector) -> Point:
    width, height = size
    # A handle is p ± h v / 3.
    h = spacings[1]
    ahead = (3.0 * unit.ahead[0] * width / h, 3.0 * unit.ahead[1] * height / h)
    if unit.is_smooth:
        return Point(*place, velocity=ahead)
    h = spacings[0]
    behind = (-3.0 * unit.behind[0] * width / h, -3.0 * unit.behind[1] * height / h)
    return Point(*place, velocity=behind, corner=True, velocity_after=ahead)


def polygon(*corners: Vector) -> tuple[BoxPoint, ...]:
    """Return the points of straight lines from corner to corner and back to the first."""
    count = len(corners)

    def third_of_way(index: int, to: int) -> Vector:
        (x, y), (to_x, to_y) = corners[index], corners[to % count]
        return ((to_x - x) / 3, (to_y - y) / 3)

    return tuple(
        BoxPoint(x, y, third_of_way(i, i + 1), third_of_way(i, i - 1)) for i, (x, y) in enumerate(corners)
    )


def quarter_turns(*middles: Vector) -> tuple[BoxPoint, ...]:
    """Return the points of the round curve through the middles of the four sides, counterclockwise."""
    k = 2 / 3 * (math.sqrt(2) - 1)
    turned = [(-(y - 0.5) * 2 * k, (x - 0.5) * 2 * k) for x, y in middles]
    return tuple(
        BoxPoint(x, y, (dx, dy), (-dx, -dy)) for (x, y), (dx, dy) in zip(middles, turned, strict=True)
    )
