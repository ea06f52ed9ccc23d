"""Drag handles: from the press on a handle, or with Alt on a point, to the undo step."""

from __future__ import annotations

import math
from functools import cached_property, partial

from msgspec.structs import replace

from ..document import point_edits, words
from ..document.curve_edits import replace_curve
from ..document.derivatives import DERIVATIVES
from ..document.model import Document, Vector
from ..document.transforms import polar_vector
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.handles import derivative_from_handle, derivative_of_offset, offset_of_handle
from ..view_model.point_kinds import is_breakable, with_corners, with_handle_retracted
from .drag_points import Click, hint_on_point, press_on_point, selecting, unless_locked
from .pointer import SNAP_KEY, STEP_KEYS, Hint, Hit, Part, Pointer, in_steps, plus
from .snapping import Snapper, stepped_from
from .tool import Gesture, GestureRow, ToolEvent, TypedDrag
from .typed_amount import TypedAmount

GESTURES = (
    GestureRow("Drag a point", "move it; Ctrl or Shift keeps to one axis"),
    GestureRow("Alt+drag a point", "pull out its velocity", needs_derivatives=True),
    GestureRow(
        "Drag a handle",
        "set velocity (square), acceleration (diamond), jerk (triangle); Ctrl or Shift: 15°, Alt: break",
        selected=True,
        needs_derivatives=True,
    ),
    GestureRow(
        "Digits, Tab while dragging a handle",
        "type its length, its angle",
        selected=True,
        needs_derivatives=True,
    ),
    GestureRow("Ctrl+click a handle", "retract it into its point", selected=True, needs_derivatives=True),
)
"""Rows of the sheet of keys and mouse."""


def press_on_part(event: ToolEvent, hit: Hit, on_click: Click | None = None) -> Gesture:
    """Start to drag the point or the handle that was hit, of the active curve; `on_click` is a click.

    Where it was of another edited curve, the Select tool has made that the active one (`activate_pressed`).
    """
    if hit.part is not Part.POINT:
        return press_on_handle(event, hit, on_click)
    if event.pointer.alt and event.view.source.family.derivatives:
        return pull_velocity(event, hit, on_click)
    return press_on_point(event, hit, on_click)


def press_on_handle(event: ToolEvent, hit: Hit, on_click: Click | None = None) -> Gesture:
    """Start to drag a handle. A click does nothing to it: it selects the point below, if there is one."""
    session, pointer = event.session, event.pointer
    on_click = selecting(event, hit.over) if hit.over >= 0 else on_click
    if pointer.ctrl and not (pointer.shift or pointer.alt) and hit.order == 1:
        on_click = partial(_retract, hit=hit)
    drag = DragHandle(
        document=session.document,
        curve=session.active_index,
        view=event.view,
        hit=hit,
        start=pointer.position,
        snapper=event.snapping.for_handle(hit.index),
        typed=_untyped(session.document),
        on_click=on_click,
    )
    return unless_locked(event, drag)


def _untyped(document: Document) -> TypedAmount:
    return TypedAmount(unit=document.unit, is_polar=True)


def _retract(event: ToolEvent, hit: Hit) -> None:
    """Retract the handle that was clicked into its point."""
    session, view, active = event.session, event.view, event.session.active_index
    before = session.document.curves

    def edit(document: Document) -> Document:
        return replace_curve(document, active, with_handle_retracted(view, hit.index, ahead=hit.ahead))

    if session.change(f"Retract handle of point {hit.index}", edit):
        done = f"Retracted the handle of point {hit.index}; Alt+drag the point to pull it out again."
        session.report(done, before, [view.source.points[hit.index].position])


class HandleDrag(TypedDrag, kw_only=True):
    """Drag of a handle to the pointer, or to a length and an angle that are typed meanwhile.

    Attributes
    ----------
    curve, view
        The curve and its view at the press.
    hit
        The handle.
    """

    curve: int
    view: CurveView
    hit: Hit
    snapper: Snapper

    def _free(self, tip: Vector) -> Vector:
        """Return the derivative whose handle ends at `tip`."""
        return derivative_from_handle(self.view, self.hit.index, self.hit.order, tip, ahead=self.hit.ahead)

    def _offset(self, derivative: Vector) -> Vector:
        hit = self.hit
        return offset_of_handle(self.view, hit.index, hit.order, derivative, ahead=hit.ahead)

    def _with_typed(self, derivative: Vector) -> Vector:
        """Return the derivative whose handle has the length and the angle that are typed."""
        if not self.typed.counts:
            return derivative
        self.snapper.reset()
        hit, (x, y) = self.hit, self._offset(derivative)
        polar = polar_vector(*self.typed.over((math.hypot(x, y), math.degrees(math.atan2(y, x)))))
        return derivative_of_offset(self.view, hit.index, hit.order, polar, ahead=hit.ahead)

    def _sizes(self, derivative: Vector) -> str:
        """Return length and angle of a derivative, and those of its handle, as far as typed."""
        offset = self._offset(derivative)
        length, angle = self.typed.texts((words.number(math.hypot(*offset)), words.direction(offset)))
        return f"{words.polar(derivative)}, handle {length} at {angle}"

    @property
    def _typing(self) -> str:
        """The numbers that can be typed."""
        return self.typed.keys if self.typed.counts else "digits: length, Tab: angle"


class DragHandle(HandleDrag, kw_only=True, dict=True):
    """Drag of the handle of a derivative; handles tied to it move along, unless Alt breaks the tie."""

    start: Vector

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the handle at the offset from the pointer that it had at the press."""
        index, order, document = self.hit.index, self.hit.order, self.document
        if self._breaks(pointer):
            document = self._broken
        derivative = self._derivative_at(pointer)
        return point_edits.set_derivative(
            document, self.curve, index, order, derivative, ahead=self.hit.ahead
        )

    def _breaks(self, pointer: Pointer) -> bool:
        """Return whether the handle moves alone, and the point becomes a corner."""
        return pointer.alt and not pointer.shift and is_breakable(self.view, self.hit.index)

    @cached_property
    def _broken(self) -> Document:
        """The document with a corner at the point."""
        return self.document.with_curve(self.curve, with_corners(self.view, [self.hit.index]))

    def _derivative_at(self, pointer: Pointer) -> Vector:
        free = self._free(self._snapped(plus(self.hit.position, pointer.offset_from(self.start)), pointer))
        before = self.view.derivative_of(self.hit.index, self.hit.order, ahead=self.hit.ahead)
        if pointer.alt and pointer.shift and before is not None and any(before):
            free = _along_direction(free, before)
        elif pointer.is_constrained:
            free = in_steps(free)
        return self._with_typed(free)

    def _snapped(self, tip: Vector, pointer: Pointer) -> Vector:
        if pointer.is_constrained:
            # While Ctrl or Shift holds an angle or a direction, nothing snaps.
            self.snapper.reset()
            return tip
        return self.snapper.snap(tip, pointer)

    def committed(self, event: ToolEvent) -> None:
        """Name other points that a broken handle has set to keep the shape."""
        super().committed(event)
        event.session.report("", self.document.curves, [self.view.source.points[self.hit.index].position])

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Set velocity of point 2", or with Alt "Break handles of point 2"."""
        if self._breaks(pointer):
            return f"Break handles of point {self.hit.index}"
        return f"Set {label_of_handle(self.hit, self.view)}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return f"{self._typing} · {handle_keys(self.hit, self.view)}"

    def amount(self, pointer: Pointer) -> str:
        """Return the derivative, and its handle, by length and direction."""
        label = label_of_handle(self.hit, self.view)
        broken = ", now a corner" if self._breaks(pointer) else ""
        return f"{label[0].upper()}{label[1:]}: {self._sizes(self._derivative_at(pointer))}{broken}"


def _along_direction(v: Vector, direction: Vector) -> Vector:
    """Return the part of `v` along `direction`."""
    length = math.hypot(*direction)
    unit = (direction[0] / length, direction[1] / length)
    share = v[0] * unit[0] + v[1] * unit[1]
    return (share * unit[0], share * unit[1])


def label_of_handle(hit: Hit, view: CurveView) -> str:
    """Return "velocity of point 2"; at a corner, which has two, the side as well."""
    return f"{DERIVATIVES[hit.order - 1].name} of {_label_of_side(view, hit.index, ahead=hit.ahead)}"


def _label_of_side(view: CurveView, index: int, *, ahead: bool) -> str:
    side = "" if index not in view.two_sided else ", ahead" if ahead else ", behind"
    return f"point {index}{side}"


def handle_keys(hit: Hit, view: CurveView) -> str:
    """Return the effects of modifiers on the drag of a handle."""
    breaks = "Alt: break the handles apart · " if is_breakable(view, hit.index) else ""
    return f"{STEP_KEYS} · {breaks}Shift+Alt: length only · {SNAP_KEY}"


# Alt: the velocity of a point, wherever its handle lay


def pull_velocity(event: ToolEvent, hit: Hit, on_click: Click | None = None) -> Gesture:
    """Start to pull the velocity handle out of the point that was hit, which is selected."""
    session = event.session
    on_click = on_click or selecting(event, hit.index)
    if hit.index not in session.selected.points:
        session.selected.set_points([hit.index])
    drag = PullVelocity(
        document=session.document,
        curve=session.active_index,
        view=event.view,
        sets_ahead=event.tool.shows_new_handle or event.view.spacing(hit.index, ahead=True) is not None,
        hit=replace(hit, order=1, ahead=True),
        snapper=event.snapping.for_handle(hit.index),
        typed=_untyped(session.document),
        on_click=on_click,
    )
    return unless_locked(event, drag)


class PullVelocity(HandleDrag, kw_only=True):
    """Drag that pulls the velocity handle out of a point. Ctrl or Shift turns it in steps of 15°.

    Of a corner `sets_ahead` sets the velocity after it, also where the next segment is still to be drawn.
    """

    sets_ahead: bool

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return f"{self._typing} · {STEP_KEYS} · {SNAP_KEY}"

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the handle ahead of the point under the pointer."""
        velocity, index = self._velocity_at(pointer), self.hit.index
        return point_edits.set_velocity(self.document, self.curve, index, velocity, ahead=self.sets_ahead)

    def _velocity_at(self, pointer: Pointer) -> Vector:
        point = self.view.source.points[self.hit.index].position
        return self._with_typed(self._free(stepped_from(point, pointer, self.snapper)))

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Set velocity of point 2"."""
        return f"Set velocity of {_label_of_side(self.view, self.hit.index, ahead=True)}"

    def amount(self, pointer: Pointer) -> str:
        """Return the velocity, and its handle, by length and direction."""
        side = _label_of_side(self.view, self.hit.index, ahead=True)
        return f"Velocity of {side}: {self._sizes(self._velocity_at(pointer))}"


# What a press would do


def hint_on_part(hit: Hit, view: CurveView, moves: str, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint over a point, of which a drag `moves` something, or over a handle."""
    if hit.part is not Part.POINT:
        retracts = " · Ctrl+click: retract it" if hit.order == 1 else ""
        text = f"Drag to set the {label_of_handle(hit, view)} · {handle_keys(hit, view)}{retracts}"
        return Hint(text, grab=True)
    if pointer.alt and view.source.family.derivatives:
        steps = " in steps of 15°" if pointer.is_constrained else ""
        return Hint(f"Drag to pull out the velocity of point {hit.index}{steps}", grab=True)
    return hint_on_point(hit, view, moves, pointer, snaps=snaps)
