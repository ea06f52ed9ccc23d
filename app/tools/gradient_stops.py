"""The stop of a gradient that was chosen on the canvas: keys move and delete it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msgspec.structs import replace

from ..document import words
from ..document.gradient import Gradient, with_stop_at
from ..document.gradient_edits import gradient_of, with_gradient, without_stop
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


class _Choice(NamedTuple):
    """A stop, by the first curve of the shape, the paint, and its place among the others."""

    curve: int
    paint: str
    stop: int


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


class StopPicker:
    """The stop that was clicked, as long as its gradient is one of what is chosen and has it."""

    def __init__(self) -> None:
        self._choice: _Choice | None = None

    def choose(self, painted: PaintedGradient, stop: int) -> None:
        """Choose a stop."""
        self._choice = _Choice(painted.shape.start, painted.paint, stop)

    def let_go(self) -> bool:
        """Choose no stop any more; return whether one was chosen."""
        had, self._choice = self._choice is not None, None
        return had

    def marked(self, host: EditingHost) -> tuple[int, int] | None:
        """Return the gradient, by its place among `gradients_of`, and the stop of it that is chosen."""
        choice = self._choice
        if choice is not None:
            for at, (shape, paint, gradient) in enumerate(gradients_of(host)):
                if (shape.start, paint) == choice[:2] and choice.stop < len(gradient.stops):
                    return at, choice.stop
        return None

    def _chosen(self, host: EditingHost) -> tuple[PaintedGradient, int] | None:
        marked = self.marked(host)
        return (list(gradients_of(host))[marked[0]], marked[1]) if marked is not None else None

    def delete(self, host: EditingHost) -> bool:
        """Delete the stop, and choose the one before it; return whether there was one to delete."""
        chosen = self._chosen(host)
        if chosen is None:
            return False
        painted, stop = chosen
        what = named(host.document, painted.shape)
        if host.change(
            f"Delete stop of {what}", lambda now: without_stop(now, painted.shape, painted.paint, stop)
        ):
            left = len(painted.gradient.stops) - 1
            if left > 1:
                self.choose(painted, max(stop - 1, 0))
                host.say(f"Deleted a stop of {what}; {left} are left.")
            else:
                self._choice = None
                host.say(f"Deleted a stop of {what}; it has the colour of the other one now.")
        return True

    def nudge(self, context: ToolContext, direction: Vector, stride: Stride) -> bool:
        """Move the stop along its line, one at an end in any direction; return whether one is chosen."""
        host, chosen = context.host, self._chosen(context.host)
        if chosen is None:
            return False
        painted, stop = chosen
        moved = _nudged(painted.gradient, stop, direction, stride, context.step_of(stride))

        is_done = moved != painted.gradient and host.change(
            f"Nudge stop of {named(host.document, painted.shape)}",
            lambda now: with_gradient(now, painted.shape, painted.paint, lambda _: moved),
            run=("stop", self._choice),
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
