"""Places of a gradient that are dragged on the canvas, and the gradient when one of them is elsewhere."""

from __future__ import annotations

import math
from enum import Enum
from typing import NamedTuple

from msgspec.structs import replace

from ..document.gradient import Gradient, GradientKind, with_stop_at
from ..document.model import Vector


class Grip(Enum):
    """Kind of place of a gradient.

    Attributes
    ----------
    words
        What it is called.
    """

    START = "start"
    END = "end"
    SIDE = "side"
    FOCUS = "focus"
    STOP = "stop"

    @property
    def words(self) -> str:
        """What it is called."""
        return self.value


class GradientPlace(NamedTuple):
    """A place of a gradient that can be dragged, with the stop that lies there, if one does."""

    grip: Grip
    place: Vector
    stop: int | None = None


def places_of(gradient: Gradient) -> list[GradientPlace]:
    """Return the places of a gradient, what is on top first."""
    has_stops, last, (along, _) = gradient.tile is None, len(gradient.stops) - 1, gradient.axes
    found = [GradientPlace(Grip.END, gradient.end, last if has_stops else None)]
    if gradient.kind is not GradientKind.LINEAR:
        found.append(GradientPlace(Grip.SIDE, gradient.side))
    if gradient.focus is not None:
        found.append(GradientPlace(Grip.FOCUS, gradient.focus))
    for index, stop in enumerate(gradient.stops[1:-1] if has_stops else (), start=1):
        x, y = (gradient.start[axis] + stop.offset * along[axis] for axis in (0, 1))
        found.append(GradientPlace(Grip.STOP, (x, y), index))
    return [*found, GradientPlace(Grip.START, gradient.start, 0 if has_stops else None)]


def with_place(gradient: Gradient, at: GradientPlace, to: Vector, *, both: bool = False) -> Gradient:
    """Return the gradient with one of its places elsewhere.

    The other axis turns along with the one that is dragged; that of others than linear ones keeps its length,
    unless `both` shall grow.
    """
    if at.grip is Grip.STOP and at.stop is not None:
        return replace(gradient, stops=with_stop_at(gradient.stops, at.stop, _offset_at(gradient, to)))
    if at.grip is Grip.FOCUS:
        return replace(gradient, focus=to)
    if gradient.kind is GradientKind.LINEAR:
        ends = (to, gradient.end) if at.grip is Grip.START else (gradient.start, to)
        return laid(gradient, *ends, both=True)
    if at.grip is Grip.START:
        by = (to[0] - gradient.start[0], to[1] - gradient.start[1])
        return gradient.mapped(lambda place: (place[0] + by[0], place[1] + by[1]))
    if at.grip is Grip.END:
        return laid(gradient, gradient.start, to, both=both)
    turned = laid(
        replace(gradient, end=gradient.side, side=gradient.end, focus=None), gradient.start, to, both=both
    )
    return _with_focus_of(gradient, replace(turned, end=turned.side, side=turned.end))


def laid(gradient: Gradient, start: Vector, end: Vector, *, both: bool = True) -> Gradient:
    """Return the gradient with another start and end, the side turned along, and as much longer if `both`."""
    (along, aside), now = (complex(*axis) for axis in gradient.axes), complex(*end) - complex(*start)
    if not along or not now:
        turn = 1.0 + 0.0j
        aside = 1j * now if now else aside
    else:
        turn = now / along if both else (now / abs(now)) / (along / abs(along))
    side = complex(*start) + turn * aside
    return _with_focus_of(
        gradient, replace(gradient, start=start, end=end, side=(side.real, side.imag), focus=None)
    )


def _with_focus_of(before: Gradient, after: Gradient) -> Gradient:
    """Return a gradient whose focus lies as it did in that before, as far as that says where."""
    if before.focus is None or before.is_flat:
        return after
    u, v = before.coordinates(before.focus)
    (a, b), (c, d) = after.axes
    x, y = after.start
    return replace(after, focus=(x + u * a + v * c, y + u * b + v * d))


def offset_on_line(gradient: Gradient, pointer: Vector, reach: float) -> float | None:
    """Return the offset of the place on the line within reach of the pointer; None where it is too far."""
    offset, (start, along) = _offset_at(gradient, pointer), (gradient.start, gradient.axes[0])
    place = (start[0] + offset * along[0], start[1] + offset * along[1])
    return offset if math.dist(place, pointer) <= reach else None


def _offset_at(gradient: Gradient, place: Vector) -> float:
    """Return the offset of the nearest place on the line from the start to the end."""
    (x, y), (a, b) = gradient.start, gradient.axes[0]
    square = a * a + b * b
    offset = ((place[0] - x) * a + (place[1] - y) * b) / square if square else 0.0
    return round(min(max(offset, 0.0), 1.0), 4)


def place_at(gradient: Gradient, pointer: Vector, reach: float) -> GradientPlace | None:
    """Return the place within reach of the pointer, the nearest; None where none is."""
    found = [(math.dist(each.place, pointer), each) for each in places_of(gradient)]
    near = [(distance, each) for distance, each in found if distance <= reach]
    return min(near, key=lambda pair: pair[0])[1] if near else None
