"""The stop of a gradient that is chosen, as the canvas shows it: keys move and delete it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msgspec.structs import replace

from ..document import words
from ..document.gradient import Gradient, with_stop_at
from ..document.gradient_edits import PaintedStop, gradient_of, with_gradient, without_stop
from ..document.model import Vector
from ..document.several_curves import named
from ..document.shapes import shape_of
from ..document.style import GRADIENTS
from .curve_picker import meant_shapes
from .drag_machine import EditingHost
from .gradient_places import GradientPlace, Grip, places_of, with_place
from .pointer import Stride
from .tool import ToolContext

STOP_KEYS = "Arrow keys: move it · Del, Ctrl+Alt+click: delete it"

_STEP = 0.01
"""How far an arrow key moves a stop along the line of its gradient."""


class PaintedGradient(NamedTuple):
    """A gradient, and the shape and the paint, "fill" or "stroke", that it is of."""

    shape: range
    paint: str
    gradient: Gradient


def gradients_of(host: EditingHost) -> Iterator[PaintedGradient]:
    """Yield the gradients of what is chosen."""
    document = host.document
    for place in sorted(meant_shapes(host)):
        shape = shape_of(document, place)
        if place == shape.start:
            for paint in GRADIENTS:
                gradient = gradient_of(document.curves[place].style, paint)
                if gradient is not None:
                    yield PaintedGradient(shape, paint, gradient)


def choose_stop(host: EditingHost, painted: PaintedGradient, stop: int) -> None:
    """Choose a stop."""
    host.selected.stop.choose(PaintedStop(painted.shape.start, painted.paint, stop))


def let_go(host: EditingHost) -> bool:
    """Choose no stop any more; return whether one was chosen."""
    had = host.selected.stop.chosen is not None
    host.selected.stop.choose(None)
    return had


def marked_stop(host: EditingHost) -> tuple[int, int] | None:
    """Return the gradient, by its place among `gradients_of`, and the stop of it that is chosen.

    None where its gradient is not one of what is chosen, or does not have it.
    """
    chosen = host.selected.stop.chosen
    if chosen is not None:
        for at, (shape, paint, gradient) in enumerate(gradients_of(host)):
            if (shape.start, paint) == chosen[:2] and chosen.stop < len(gradient.stops):
                return at, chosen.stop
    return None


def _chosen(host: EditingHost) -> tuple[PaintedGradient, int] | None:
    marked = marked_stop(host)
    return (list(gradients_of(host))[marked[0]], marked[1]) if marked is not None else None


def delete_stop(host: EditingHost) -> bool:
    """Delete the stop, and choose the one before it; return whether there was one to delete."""
    chosen = _chosen(host)
    if chosen is None:
        return False
    painted, stop = chosen
    what = named(host.document, painted.shape)
    if host.change(
        f"Delete stop of {what}", lambda now: without_stop(now, painted.shape, painted.paint, stop)
    ):
        left = len(painted.gradient.stops) - 1
        if left > 1:
            choose_stop(host, painted, max(stop - 1, 0))
            host.say(f"Deleted a stop of {what}; {left} are left.")
        else:
            let_go(host)
            host.say(f"Deleted a stop of {what}; it has the colour of the other one now.")
    return True


def nudge_stop(context: ToolContext, direction: Vector, stride: Stride) -> bool:
    """Move the stop along its line, one at an end in any direction; return whether one is chosen."""
    host, chosen = context.host, _chosen(context.host)
    if chosen is None:
        return False
    painted, stop = chosen
    moved = _nudged(painted.gradient, stop, direction, stride, context.step_of(stride))

    is_done = moved != painted.gradient and host.change(
        f"Nudge stop of {named(host.document, painted.shape)}",
        lambda now: with_gradient(now, painted.shape, painted.paint, lambda _: moved),
        run=("stop", host.selected.stop.chosen),
    )
    if is_done:
        host.say(f"Stop at {words.number(100 * moved.stops[stop].offset)} %.")
    return True


def _nudged(gradient: Gradient, stop: int, direction: Vector, stride: Stride, step: float) -> Gradient:
    at = place_of_stop(gradient, stop)
    if at.grip is not Grip.STOP:
        x, y = at.place
        return with_place(gradient, at, (x + direction[0] * step, y + direction[1] * step))
    (a, b), (x, y) = gradient.axes[0], direction
    along = a * x + b * y
    way = (along > 0) - (along < 0)
    offset = round(gradient.stops[stop].offset + way * stride.length(_STEP), 6)
    return replace(gradient, stops=with_stop_at(gradient.stops, stop, offset))


def place_of_stop(gradient: Gradient, stop: int) -> GradientPlace:
    """Return the place of a gradient at which a stop is dragged."""
    return next(each for each in places_of(gradient) if each.stop == stop)
