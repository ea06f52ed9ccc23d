"""Drags that transform what is selected, begun by a press or by a key, and the drag of their pivot."""

from __future__ import annotations

import math
from collections.abc import Callable

from msgspec.structs import replace

from ..document import words
from ..document.edits import EditError
from ..document.model import Vector
from ..document.point_group import PointGroup
from .drag import along_axis, axis_held, plus
from .drag_machine import CANCELLED, THRESHOLD
from .drags import MovePoints
from .marks import GestureMarks
from .pointer import AXIS_KEYS, SNAP_KEY, Cursor, Hint, Pointer
from .snapping import with_snap
from .tool import Gesture, Tool, ToolContext
from .transform import Transform, TransformKind
from .transform_box import Grip, ScaleBox


def moving(context: ToolContext, group: PointGroup) -> MovePoints:
    """Return the drag of a group from the pointer on; what snaps is its point that is nearest."""
    grip = _nearest(context, group)
    snapper = context.snappers.for_group(group, grip)
    return MovePoints(context.host.document, group, context.pointer.position, snapper, grip)


def transforming(context: ToolContext, kind: TransformKind) -> Transform:
    """Return the transform that begins at the pointer; with nothing selected, of all points."""
    target = context.target
    group = target.for_keys
    grip = _nearest(context, group)
    return Transform(
        context.host.document,
        kind,
        group,
        target.centre,
        target.bounds.place(1, 1),
        context.pointer.position,
        context.snappers.for_group(group, grip),
        grip,
        typed=kind.amount(context.host.document),
        everything=target.group is None,
    )


def turning(context: ToolContext, grip: Grip) -> Transform:
    """Return the drag of a grip of the box that rotates or skews."""
    drag, box = replace(transforming(context, grip.does), by_grip=True), context.target.box
    if box is None or not box.turns:
        return drag
    hold, opposite = box.place(grip.x, grip.y), box.place(-grip.x, -grip.y)
    return replace(drag, hold=hold, opposite=opposite, axis=int(grip.y == 0))


def scaling(context: ToolContext, grip: Grip) -> ScaleBox:
    """Return the drag of a grip of the box that scales."""
    host, target, settings = context.host, context.target, context.settings
    group, box = target.group, target.box
    assert group is not None
    assert box is not None
    return ScaleBox(
        host.document,
        host.views,
        group,
        box,
        target.centre,
        grip,
        context.pointer.position,
        context.snappers.for_grip(grip, group),
        even=settings.keeps_proportions and bool(grip.x and grip.y),
    )


def _nearest(context: ToolContext, group: PointGroup) -> tuple[int, int]:
    """Return the curve and the index of the point that is nearest to the pointer: it snaps."""
    curves, pointer = context.host.document.curves, context.pointer
    places = [(curve, index) for curve, indices in group.parts for index in indices]
    return min(places, key=lambda at: math.dist(curves[at[0]].points[at[1]].position, pointer.position))


_REACH = 7.0
"""Pixels from the mark within which a press takes it."""

PIVOT_HINT = Hint(
    "Drag the pivot: what is turned, scaled and mirrored is so about it · Shift+click: back to the middle",
    cursor=Cursor.MOVE,
)


def is_on_pivot(place: Vector, pointer: Pointer) -> bool:
    """Whether a press would take the mark of a pivot at `place`."""
    return math.dist(place, pointer.position) * pointer.scale <= _REACH


class MovePivot(Gesture):
    """Drag of the pivot; it changes nothing in the document. A double click or Shift+click puts it back.

    Parameters
    ----------
    on_click
        What a click does; None for nothing.
    """

    def __init__(self, context: ToolContext, on_click: Callable[[], None] | None = None) -> None:
        self._on_click = on_click
        self._press, self._start = context.pointer, context.target.centre
        self._before = context.host.box.pivot
        self._snapper = context.snappers.for_pivot(context.target.bounds)
        self._is_moving = False
        if context.pointer.is_double:
            context.target.pivot = None

    def move(self, context: ToolContext) -> None:
        """Follow the pointer."""
        pointer = context.pointer
        self._is_moving |= math.dist(pointer.pixel, self._press.pixel) >= THRESHOLD
        if self._is_moving:
            way = pointer.way_from(self._press.position)
            axis = axis_held(way, pointer)
            to = plus(self._start, along_axis(way, axis))
            context.target.pivot = self._snapper.snap(to, pointer, axis)

    def release(self, context: ToolContext) -> None:
        """Leave it here, or click."""
        self.move(context)
        if not self._is_moving and self._on_click is not None:
            self._on_click()
        elif not self._is_moving and self._press.shift:
            context.target.pivot = None

    def cancel(self, context: ToolContext) -> None:
        """Put it where it was."""
        context.host.box.set_pivot(self._before)
        if self._is_moving:
            context.host.say(CANCELLED)

    def progress(self, context: ToolContext) -> str:
        """Tell where it is."""
        if not self._is_moving:
            return ""
        place = words.pair(context.target.centre)
        text = f"Pivot {place} · {AXIS_KEYS} · {SNAP_KEY} · Escape cancels"
        return with_snap(text, self._snapper.caught)


_KEYS = frozenset("xygsrR") | {"tab", "enter"}


class TransformTool(Tool):
    """Tool in which selected points or curves, or else all points, follow the pointer until a key or a click.

    Parameters
    ----------
    kind
        The transform that it begins with.
    context
        That of the key that begins it.
    """

    cursor = Cursor.ARROW
    lasts_one_gesture = True

    def __init__(self, kind: TransformKind, context: ToolContext) -> None:
        self._transform = transforming(context, kind)
        context.drags.press_at_once(context.pointer, self._transform)

    def press(self, context: ToolContext) -> None:
        """Make it a step of the history."""
        context.drags.release(context.pointer)

    def hover(self, context: ToolContext) -> Hint:
        """Follow the pointer."""
        self.move(context)
        return Hint()

    def claims(self, context: ToolContext, key: str) -> bool:
        """Whether a key is for the transform: a digit, ".", "-", "x", "y" …."""
        return key in _KEYS or self._transform.typed.claims(key)

    def key(self, context: ToolContext, key: str) -> bool:
        """Take a key of what is typed, "tab", "x", "y", "g", "s", "r", "R" or "enter"."""
        if key == "enter":
            if self._transform.refusal:
                raise EditError(self._transform.refusal)
            context.drags.release(context.pointer)
            return True
        changed = self._transform.with_key(key)
        if changed is None:
            return False
        self._transform = changed
        context.drags.exchange(context.pointer, changed)
        return True

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the amount, the axis that is locked, and what is snapped to."""
        target = context.target
        return GestureMarks(
            frame=target.box,
            pivot=target.pivot if self._transform.kind is TransformKind.MOVE else self._transform.centre,
            snap=context.snappers.caught,
            note=context.note(),
            axis=self._transform.locked_axis,
        )
