"""The Gradient tool: a drag lays a gradient across what is chosen, and its places are dragged."""

from __future__ import annotations

import math
from typing import NamedTuple

from msgspec.structs import replace

from ...document import words
from ...document.gradient import Gradient, GradientKind, with_stop_between
from ...document.gradient_edits import fading, gradient_of, with_gradient, with_shape_styles, with_stops
from ...document.model import Document, Vector
from ...document.readings import Readings
from ...document.several_curves import named
from ...document.shapes import whole_shapes
from ...document.style import NO_PAINT, Style
from ..curve_picker import click_curve, meant_shapes
from ..drag import Drag
from ..drags import stepped_from
from ..gradient_places import GradientPlace, Grip, laid, offset_on_line, place_at, with_place
from ..gradient_stops import (
    STOP_KEYS,
    PaintedGradient,
    choose_stop,
    delete_stop,
    gradients_of,
    let_go,
    marked_stop,
    nudge_stop,
)
from ..marks import GestureMarks
from ..pointer import STEP_KEYS, Cursor, Hint, Part, Pointer, Stride
from ..snapping import Snapper
from ..tool import GestureRow, Tool, ToolContext, ToolRecord

_REACH = 8.0
"""Pixels from a place of a gradient within which a press means it."""

_LINE_REACH = 5.0
"""The same for its line, where there is no place."""

_ADD = "Double-click the line to add a stop"
_HOW = "Drag to lay a gradient across"
_NOTHING = "Choose a curve first: click one."
_KEYS = {Grip.END: "Shift: both axes", Grip.SIDE: "Shift: both axes", Grip.FOCUS: "in the middle: none"}
"""Effects of the modifier keys on the places of a radial gradient."""


class _Held(NamedTuple):
    """A place of a gradient."""

    painted: PaintedGradient
    at: GradientPlace


class _OnLine(NamedTuple):
    """An offset on the line of a gradient."""

    painted: PaintedGradient
    offset: float


class MovePlace(Drag, frozen=True):
    """A drag of a place of a gradient."""

    shape: range
    paint: str
    gradient: Gradient
    at: GradientPlace
    snapper: Snapper

    @property
    def name(self) -> str:
        """The name of the step."""
        what = "Stop" if self.at.grip is Grip.STOP else "Gradient"
        return f"{what} of {named(self.document, self.shape)}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        if self.gradient.kind is GradientKind.LINEAR:
            return "" if self.at.grip is Grip.STOP else STEP_KEYS
        return _KEYS.get(self.at.grip, "")

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the place at the pointer."""
        return with_gradient(self.document, self.shape, self.paint, lambda _: self._moved(pointer))

    def _moved(self, pointer: Pointer) -> Gradient:
        gradient, at = self.gradient, self.at
        if at.grip is Grip.STOP:
            return with_place(gradient, at, pointer.position)
        if gradient.kind is GradientKind.LINEAR:
            fixed = gradient.end if at.grip is Grip.START else gradient.start
            return with_place(gradient, at, stepped_from(fixed, pointer, self.snapper))
        to = self.snapper.at(pointer)
        if at.grip is Grip.FOCUS and math.dist(to, gradient.start) * pointer.scale <= _REACH:
            return replace(gradient, focus=None)
        return with_place(gradient, at, to, both=pointer.shift)

    def readout(self, pointer: Pointer) -> str:
        """Return the offset of a stop; of another place, how long and in which direction the axis is."""
        moved = self._moved(pointer)
        if self.at.grip is Grip.STOP and self.at.stop is not None:
            return f"Stop at {words.number(100 * moved.stops[self.at.stop].offset)} %"
        return _measure(moved, self.readings)


class LayGradient(Drag, frozen=True):
    """A drag that lays gradients from the press to the pointer."""

    curves: frozenset[int]
    start: Vector
    snapper: Snapper
    keys = STEP_KEYS

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Gradient of {named(self.document, self.curves)}"

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the gradients of these curves from the press to here."""
        end = stepped_from(self.start, pointer, self.snapper)

        def edit(_shape: range, style: Style) -> Style:
            paint = _paint_of(style)
            return style.with_gradient(paint, laid(_begun(style, paint), self.start, end))

        return with_shape_styles(self.document, self.curves, edit)

    def readout(self, pointer: Pointer) -> str:
        """Return how long it is, and its direction."""
        end = stepped_from(self.start, pointer, self.snapper)
        return _measure(Gradient(fading(""), start=self.start, end=end), self.readings)


def _paint_of(style: Style) -> str:
    """Return which paint of a style a new gradient is for: the fill, unless the stroke alone has one."""
    has_stroke_alone = not style.has_fill and style.stroke_gradient is not None
    return "stroke" if has_stroke_alone else "fill"


def _begun(style: Style, paint: str) -> Gradient:
    """Return a gradient with the stops of that which there is, or else of a colour that fades out."""
    before = gradient_of(style, paint)
    if before is not None:
        # At right angles, and a circle: what was slanted has nothing to do with the new line.
        return replace(before, start=(0.0, 0.0), end=(1.0, 0.0), side=(0.0, 1.0), focus=None)
    colour: str = getattr(style, paint)
    return Gradient(fading(style.colour if colour == NO_PAINT else colour))


def _measure(gradient: Gradient, readings: Readings) -> str:
    axis = gradient.axes[0]
    return f"{words.number(math.hypot(*axis))} · {readings.direction_words(axis)}"


class GradientTool(Tool):
    """Tool that lays gradients, and drags their places; a click chooses another curve."""

    finds_other_curves = True

    def press(self, context: ToolContext) -> None:
        """Begin to drag a place of a gradient, or to lay a new one."""
        held, pointer, host = _held_at(context), context.pointer, context.host
        let_go(host)
        if held is not None:
            self._press_on_place(context, held)
            return
        line = _line_at(context)
        if line is not None and pointer.is_double:
            self._add_stop(context, line)
            return
        hit, curves = context.hit, meant_shapes(context.host)
        is_other = hit is not None and hit.part is Part.OTHER_CURVE
        if not curves and hit is not None and is_other:
            curves = whole_shapes(host.document, (hit.index,))
        snapper = context.snappers.for_new(-1)
        drag = LayGradient(host.document, curves, snapper.at(pointer), snapper) if curves else None

        def click() -> None:
            if line is not None:
                host.say(f"{_ADD}.")
            elif hit is not None and is_other:
                click_curve(context, hit)
            elif curves:
                host.say(f"{_HOW}.")
            else:
                host.refuse(_NOTHING)

        context.drags.press(pointer, drag, click)

    def _press_on_place(self, context: ToolContext, held: _Held) -> None:
        """Begin to drag a place; the stop there is chosen, and with Ctrl and Alt deleted by a click."""
        host, pointer, (painted, at) = context.host, context.pointer, held
        if at.stop is not None:
            choose_stop(host, painted, at.stop)

        def click() -> None:
            if at.stop is None:
                return
            if pointer.ctrl and pointer.alt:
                delete_stop(host)
            else:
                offset = words.number(100 * painted.gradient.stops[at.stop].offset)
                host.say(f"Stop at {offset} % · {STOP_KEYS}")

        drag = MovePlace(host.document, *painted, at, context.snappers.for_new(-1))
        context.drags.press(pointer, drag, click)

    def _add_stop(self, context: ToolContext, line: _OnLine) -> None:
        """Add a stop of the colour that the gradient has there: to drag, or to colour in the Style panel."""
        host, ((shape, paint, gradient), offset) = context.host, line
        stops, index = with_stop_between(gradient.stops, offset)
        what = f"stop of {named(host.document, shape)}"
        if host.change(f"Add {what}", lambda document: with_stops(document, shape, paint, stops)):
            choose_stop(host, line.painted, index)
            host.say(f"A stop at {words.number(100 * offset)} %; drag it, or colour it in the Style panel.")

    def claims(self, context: ToolContext, key: str) -> bool:
        """Whether a key is for the stop that is chosen, and not for the curve."""
        return key in ("delete", "backspace") and marked_stop(context.host) is not None

    def key(self, context: ToolContext, key: str) -> bool:
        """Delete the stop that is chosen."""
        return self.claims(context, key) and delete_stop(context.host)

    def nudge(self, context: ToolContext, direction: Vector, stride: Stride) -> bool:
        """Move the stop that is chosen, or else the curves."""
        return nudge_stop(context, direction, stride) or super().nudge(context, direction, stride)

    def dismiss(self, context: ToolContext) -> bool:
        """Let go of the stop that is chosen."""
        return let_go(context.host)

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        held = _held_at(context)
        if held is not None:
            pulls = held.at.grip is Grip.START and held.painted.gradient.kind is GradientKind.RADIAL
            more = " · Shift: pull the focus out" if pulls else ""
            more += f" · Click: choose it · {STOP_KEYS}" if held.at.stop is not None else ""
            what = held.painted.gradient.kind.what
            return Hint(f"Drag the {held.at.grip.words} of the {what}{more}", cursor=Cursor.MOVE)
        hit, curves = context.hit, meant_shapes(context.host)
        if _line_at(context) is not None:
            return Hint(f"{_ADD} · {_HOW} · {STEP_KEYS}")
        is_other = hit is not None and hit.part is Part.OTHER_CURVE
        if not curves and not is_other:
            return Hint(_NOTHING)
        context.preview_snap(-1)
        what = named(context.host.document, curves) if curves else "this curve"
        click = " · Click: choose this one" if is_other else ""
        return Hint(f"{_HOW} {what} · {STEP_KEYS}{click} · V goes back to Select")

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the gradients of what is chosen, and what is snapped to."""
        host = context.host
        gradients = tuple(painted.gradient for painted in gradients_of(host))
        return GestureMarks(gradients=gradients, stop=marked_stop(host), snap=context.snappers.caught)


def _held_at(context: ToolContext) -> _Held | None:
    """Return the place of a gradient under the pointer; with Shift that of the focus in the middle."""
    pointer = context.pointer
    for painted in gradients_of(context.host):
        gradient = painted.gradient
        at = place_at(gradient, pointer.position, _REACH / pointer.scale)
        if at is not None:
            is_middle = at.grip is Grip.START and gradient.kind is GradientKind.RADIAL
            if is_middle and pointer.shift:
                at = GradientPlace(Grip.FOCUS, at.place)
            return _Held(painted, at)
    return None


def _line_at(context: ToolContext) -> _OnLine | None:
    """Return where the pointer is on the line of a gradient; None where it is on none."""
    pointer = context.pointer
    for painted in gradients_of(context.host):
        if painted.gradient.tile is not None:
            continue
        offset = offset_on_line(painted.gradient, pointer.position, _LINE_REACH / pointer.scale)
        if offset is not None:
            return _OnLine(painted, offset)
    return None


GRADIENT = ToolRecord(
    name="gradient",
    make=GradientTool,
    hint="Drag across a curve to lay a gradient; V or Escape goes back to selecting.",
    doing="laying gradients",
    gestures=(
        GestureRow("Drag", "lay a gradient across what is chosen; Ctrl or Shift: steps of 15°"),
        GestureRow("Drag a mark", "move the start, the end or a stop of a gradient"),
        GestureRow("Click a mark", "choose a stop: arrow keys move it, Del and Ctrl+Alt+click delete it"),
        GestureRow("Double-click the line", "add a stop of the colour that is there"),
        GestureRow("Shift+drag the middle", "pull the focus of a radial gradient out"),
        GestureRow("Click a curve", "choose it"),
    ),
    place=29,
    action="gradientTool",
    title="Gradient",
    full_name="Gradient Tool",
    key="Ctrl+F1",
    icon="gradient",
    tip="Lay a gradient across what is chosen, or drag the marks of one",
    in_menu=True,
    in_toolbar=False,
    keywords="colour fill linear radial blend fade",
)
