"""Drags that transform what is selected, begun by a press or by a key, and the drag of their pivot."""

from __future__ import annotations

import math
from collections.abc import Callable

from msgspec.structs import replace

from ..document import words
from ..document.limits import EditError
from ..document.model import Vector
from ..document.point_group import PointGroup
from .drag import along_axis, axis_held, plus
from .drags import MovePoints
from .gesture import CANCELLED, THRESHOLD
from .marks import Marks
from .pointer import AXIS_KEYS, SNAP_KEY, Cursor, Hint, Pointer
from .snapping import with_snap
from .tool import OldGesture, Tool, ToolEvent
from .transform import Transform, TransformKind
from .transform_box import Grip, ScaleBox


def moving(event: ToolEvent, group: PointGroup) -> MovePoints:
    """Return the drag of a group from the pointer on; what snaps is its point that is nearest."""
    grip = _nearest(event, group)
    snapper = event.snapping.for_points(group, grip)
    return MovePoints(event.session.document, group, event.pointer.position, snapper, grip)


def transforming(event: ToolEvent, kind: TransformKind) -> Transform:
    """Return the transform that begins at the pointer; with nothing selected, of all points."""
    target = event.box
    group = target.for_keys
    grip = _nearest(event, group)
    return Transform(
        event.session.document,
        kind,
        group,
        target.centre,
        target.bounds.position(1, 1),
        event.pointer.position,
        event.snapping.for_points(group, grip),
        grip,
        typed=kind.amount(event.session.document),
        everything=target.group is None,
    )


def turning(event: ToolEvent, grip: Grip) -> Transform:
    """Return the drag of a grip of the box that rotates or skews."""
    drag, box = replace(transforming(event, grip.does), by_grip=True), event.box.rectangle
    if box is None or not box.turns:
        return drag
    hold, opposite = box.position(grip.x, grip.y), box.position(-grip.x, -grip.y)
    return replace(drag, hold=hold, opposite=opposite, axis=int(grip.y == 0))


def scaling(event: ToolEvent, grip: Grip) -> ScaleBox:
    """Return the drag of a grip of the box that scales."""
    session, target, settings = event.session, event.box, event.settings
    group, box = target.group, target.rectangle
    assert group is not None
    assert box is not None
    return ScaleBox(
        session.document,
        session.views,
        group,
        box,
        target.centre,
        grip,
        event.pointer.position,
        event.snapping.for_grip(grip, group),
        even=settings.keeps_proportions and bool(grip.x and grip.y),
    )


def _nearest(event: ToolEvent, group: PointGroup) -> tuple[int, int]:
    """Return the curve and the index of the point that is nearest to the pointer: it snaps."""
    curves, pointer = event.session.document.curves, event.pointer
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


class MovePivot(OldGesture):
    """Drag of the pivot; it changes nothing in the document. A double click or Shift+click puts it back.

    Parameters
    ----------
    on_click
        What a click does; None for nothing.
    """

    def __init__(self, event: ToolEvent, on_click: Callable[[], None] | None = None) -> None:
        self._on_click = on_click
        self._press, self._start = event.pointer, event.box.centre
        self._before = event.session.box.pivot
        self._snapper = event.snapping.for_pivot(event.box.bounds)
        self._is_moving = False
        if event.pointer.is_double:
            event.box.pivot = None

    def move(self, event: ToolEvent) -> None:
        """Follow the pointer."""
        pointer = event.pointer
        self._is_moving |= math.dist(pointer.pixel, self._press.pixel) >= THRESHOLD
        if self._is_moving:
            way = pointer.offset_from(self._press.position)
            axis = axis_held(way, pointer)
            to = plus(self._start, along_axis(way, axis))
            event.box.pivot = self._snapper.snap(to, pointer, axis)

    def release(self, event: ToolEvent) -> None:
        """Leave it here, or click."""
        self.move(event)
        if not self._is_moving and self._on_click is not None:
            self._on_click()
        elif not self._is_moving and self._press.shift:
            event.box.pivot = None

    def cancel(self, event: ToolEvent) -> None:
        """Put it where it was."""
        event.session.box.set_pivot(self._before)
        if self._is_moving:
            event.session.say(CANCELLED)

    def progress(self, event: ToolEvent) -> str:
        """Tell where it is."""
        if not self._is_moving:
            return ""
        place = words.pair_text(event.box.centre)
        text = f"Pivot {place} · {AXIS_KEYS} · {SNAP_KEY} · Escape cancels"
        return with_snap(text, self._snapper.caught)


_KEYS = frozenset("xygsrR") | {"tab", "enter"}


class TransformTool(Tool):
    """Tool in which selected points or curves, or else all points, follow the pointer until a key or a click.

    Parameters
    ----------
    kind
        The transform that it begins with.
    event
        That of the key that begins it.
    """

    cursor = Cursor.ARROW
    lasts_one_gesture = True

    def __init__(self, kind: TransformKind, event: ToolEvent) -> None:
        self._transform = transforming(event, kind)
        event.drags.press_at_once(event.pointer, self._transform)

    def press(self, event: ToolEvent) -> None:
        """Make it a step of the history."""
        event.drags.release(event.pointer)

    def hover(self, event: ToolEvent) -> Hint:
        """Follow the pointer."""
        self.move(event)
        return Hint()

    def claims(self, event: ToolEvent, key: str) -> bool:
        """Whether a key is for the transform: a digit, ".", "-", "x", "y" …."""
        return key in _KEYS or self._transform.typed.claims(key)

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a key of what is typed, "tab", "x", "y", "g", "s", "r", "R" or "enter"."""
        if key == "enter":
            if self._transform.refusal:
                raise EditError(self._transform.refusal)
            event.drags.release(event.pointer)
            return True
        changed = self._transform.with_key(key)
        if changed is None:
            return False
        self._transform = changed
        event.drags.exchange(event.pointer, changed)
        return True

    def marks(self, event: ToolEvent) -> Marks:
        """Return the amount, the axis that is locked, and what is snapped to."""
        target = event.box
        return Marks(
            frame=target.rectangle,
            pivot=target.pivot if self._transform.kind is TransformKind.MOVE else self._transform.centre,
            snap=event.snapping.caught,
            note=event.note(),
            axis=self._transform.locked_axis,
        )
