"""Drags of points, handles and the curve itself: the document at a place of the pointer."""

from __future__ import annotations

import math

import msgspec

from ..document import limits, point_edits, words
from ..document.derivatives import DERIVATIVES
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.several_curves import move_group, step_group
from ..view_model.bend import Bend, BendWith, has_handles
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.handles import derivative_from_handle
from ..view_model.point_kinds import is_breakable, with_corners
from .drag import CurveDrag, Drag, along_axis, axis_held, minus, plus
from .pointer import AXIS_KEYS, SNAP_KEY, STEP_KEYS, Hit, Pointer
from .snapping import Snapper

_TOLERANCE = 0.05
"""Pixels that the grabbed point may be off, where the parameters answer to the points."""


class MovePoints(Drag, frozen=True):
    """Drag of points, or whole curves, with the pointer; Ctrl or Shift keeps to one axis.

    Attributes
    ----------
    grip
        The curve and the point that snaps.
    axis
        0 or 1 where an axis is locked from the start.
    """

    group: PointGroup
    start: Vector
    snapper: Snapper
    grip: tuple[int, int]
    axis: int | None = None

    @property
    def keys(self) -> str:
        """Effects of the keys."""
        return f"{AXIS_KEYS} · {SNAP_KEY}"

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Move {self.group.label}"

    @property
    def remark(self) -> str:
        """What of the group is locked."""
        return self.group.remark

    def readout(self, pointer: Pointer) -> str:
        """Return where one point is and how far it came; of several, how far they came."""
        way, one = words.pair_text(self.displacement(pointer)), self.group.only_point
        if one is None:
            return f"{self.name} by {way}"
        return f"{words.point_at(one[1], self.place_at(pointer))} · moved {way}"

    def place_at(self, pointer: Pointer) -> Vector:
        """Return where the point is that is held, to the last bit where it snapped to."""
        by, caught = self.displacement(pointer), self.snapper.caught
        return plus(self._held, by) if caught is None else caught.position

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        document = move_group(self.document, self.group, self.displacement(pointer))
        if self.snapper.caught is not None:
            # To the last bit where it snapped to: p + (q − p) may miss q by a rounding.
            document = point_edits.set_position(document, *self.grip, self.snapper.caught.position)
        return document

    @property
    def _held(self) -> Vector:
        curve, index = self.grip
        return self.document.curves[curve].points[index].position

    def displacement(self, pointer: Pointer) -> Vector:
        """Return how far the points go, so that the grip snaps."""
        way = pointer.offset_from(self.start)
        axis = axis_held(way, pointer) if self.axis is None else self.axis
        way = along_axis(way, axis)
        target = self.snapper.snap(plus(self._held, way), pointer, axis)
        return way if self.snapper.caught is None else minus(target, self._held)


class NudgePoints(Drag, frozen=True):
    """Move of points by a key, wherever the pointer is.

    Attributes
    ----------
    step
        How far; it is added in decimal numbers.
    """

    group: PointGroup
    step: Vector

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Nudge {self.group.label}"

    @property
    def remark(self) -> str:
        """What of the group is locked."""
        return self.group.remark

    def readout(self, pointer: Pointer) -> str:
        """Return where one point is now, or how many went, and the step."""
        one, step = self.group.only_point, words.pair_text(self.step)
        if one is None:
            return f"{self.group.label} nudged · step {step}"
        curve, index = one
        place = self.document_at(pointer).curves[curve].points[index].position
        return f"{words.point_at(index, place)} · step {step}"

    def document_at(self, _pointer: Pointer) -> Document:
        """Move by the step."""
        return step_group(self.document, self.group, self.step)


def what_handle_sets(hit: Hit, view: CurveView) -> str:
    """Return "velocity of point 2"; at a corner, which has two, the side as well."""
    return f"{DERIVATIVES[hit.kind - 1].name} of {_side_of(view, hit.index, ahead=hit.ahead)}"


def _side_of(view: CurveView, index: int, *, ahead: bool) -> str:
    side = "" if index not in view.two_sided else ", ahead" if ahead else ", behind"
    return f"point {index}{side}"


def handle_keys(hit: Hit, view: CurveView) -> str:
    """Return what modifiers change of the drag of a handle."""
    breaks = "Alt: break the handles apart · " if is_breakable(view, hit.index) else ""
    return f"{STEP_KEYS} · {breaks}Shift+Alt: length only · {SNAP_KEY}"


class DragHandle(CurveDrag, frozen=True):
    """Drag of the handle of a derivative; what is tied to it goes along, unless Alt breaks the tie."""

    hit: Hit
    start: Vector
    snapper: Snapper
    # The document with a corner at the point, once Alt has been held.
    _broken: list[Document] = msgspec.field(default_factory=list)

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Set {what_handle_sets(self.hit, self.view)}"

    def name_at(self, pointer: Pointer) -> str:
        """Return the name of the step with the keys that are held."""
        return f"Break handles of point {self.hit.index}" if self._breaks(pointer) else self.name

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return handle_keys(self.hit, self.view)

    def readout(self, pointer: Pointer) -> str:
        """Return the derivative by its length and direction."""
        what = what_handle_sets(self.hit, self.view)
        broken = ", a corner now" if self._breaks(pointer) else ""
        return f"{what[0].upper()}{what[1:]}: {words.polar(self._derivative_at(pointer))}{broken}"

    def document_at(self, pointer: Pointer) -> Document:
        """Keep the offset between pointer and handle that the press had."""
        which, document = (self.hit.index, self.hit.kind), self.document
        if self._breaks(pointer):
            if not self._broken:
                cornered = with_corners(self.view, [self.hit.index])
                self._broken.append(document.with_curve(self.curve, cornered))
            document = self._broken[0]
        derivative = self._derivative_at(pointer)
        return point_edits.set_derivative(document, self.curve, *which, derivative, ahead=self.hit.ahead)

    def _breaks(self, pointer: Pointer) -> bool:
        """Whether the handle goes its own way, and the point becomes a corner."""
        return pointer.alt and not pointer.shift and is_breakable(self.view, self.hit.index)

    def _derivative_at(self, pointer: Pointer) -> Vector:
        tip = self._snapped(plus(self.hit.position, pointer.offset_from(self.start)), pointer)
        which = self.hit.index, self.hit.kind
        free = derivative_from_handle(self.view, *which, tip, ahead=self.hit.ahead)
        before = self.view.derivative_of(*which, ahead=self.hit.ahead)
        if pointer.alt and pointer.shift and before is not None and any(before):
            return _along_direction(free, before)
        return in_steps(free) if pointer.holds_line else free

    def _snapped(self, tip: Vector, pointer: Pointer) -> Vector:
        if pointer.holds_line:
            # An angle or a direction that is held leaves nothing to be drawn elsewhere.
            self.snapper.reset()
            return tip
        return self.snapper.snap(tip, pointer)


def _along_direction(v: Vector, direction: Vector) -> Vector:
    """Return the part of `v` along `direction`."""
    length = math.hypot(*direction)
    unit = (direction[0] / length, direction[1] / length)
    share = v[0] * unit[0] + v[1] * unit[1]
    return (share * unit[0], share * unit[1])


def in_steps(v: Vector) -> Vector:
    """Turn `v` to the nearest multiple of 15 degrees; along the axes exactly."""
    steps = round(math.degrees(math.atan2(v[1], v[0])) / 15)
    length = math.hypot(*v)
    if steps % 6 == 0:
        x, y = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[steps // 6 % 4]
    else:
        x, y = math.cos(math.radians(15 * steps)), math.sin(math.radians(15 * steps))
    return (length * x, length * y)


def stepped_from(fixed: Vector, pointer: Pointer, snapper: Snapper) -> Vector:
    """Return where a line from a place that stays ends: with Ctrl or Shift its angle goes in steps of 15°."""
    if not pointer.holds_line:
        return snapper.at(pointer)
    # An angle that is held leaves nothing to be drawn elsewhere.
    snapper.reset()
    return plus(fixed, in_steps(pointer.offset_from(fixed)))


class PullVelocity(CurveDrag, frozen=True):
    """Drag that pulls the velocity handle out of a point, wherever the handle lay before.

    Ctrl or Shift turns it in steps of 15°.
    """

    index: int
    snapper: Snapper

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Set velocity of {_side_of(self.view, self.index, ahead=True)}"

    keys = f"{STEP_KEYS} · {SNAP_KEY}"

    def readout(self, pointer: Pointer) -> str:
        """Return the velocity by its length and direction."""
        what, velocity = "velocity", words.polar(self._velocity_at(pointer))
        return f"{what.capitalize()} of {_side_of(self.view, self.index, ahead=True)}: {velocity}"

    def _velocity_at(self, pointer: Pointer) -> Vector:
        tip = stepped_from(self.view.source.points[self.index].position, pointer, self.snapper)
        return derivative_from_handle(self.view, self.index, 1, tip, ahead=True)

    def document_at(self, pointer: Pointer) -> Document:
        """Put the handle ahead of the point under the pointer."""
        velocity = self._velocity_at(pointer)
        ahead = self.view.spacing(self.index, ahead=True) is not None
        return point_edits.set_velocity(self.document, self.curve, self.index, velocity, ahead=ahead)


class BendCurve(CurveDrag, frozen=True):
    """Bend: the least change of the handles by which the grabbed point follows; the points stay.

    With Alt they come along, with Ctrl they alone move, and where there are no handles they do in any case.
    """

    hit: Hit
    start: Vector
    _bends: dict[BendWith, Bend] = msgspec.field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Bend curve at t = {words.number(self.hit.t)}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return bend_keys(self.view)

    def readout(self, pointer: Pointer) -> str:
        """Return where it is held, and what changes."""
        # Which data change most is decided by weights; the grabbed point follows exactly.
        is_weighted = self.view.linearised and bend_with(self.view, pointer) is BendWith.POINTS
        weights = f", by weights {self.view.linearised}" if is_weighted else ""
        return f"Bend at t = {words.number(self.hit.t)}: {what_bends(self.view, pointer)}{weights}"

    def document_at(self, pointer: Pointer) -> Document:
        """Let the grabbed point keep its distance to the pointer."""
        target = plus(self.hit.position, pointer.offset_from(self.start))
        using = bend_with(self.view, pointer)
        curve = self._grabbed(using).bent(target, _TOLERANCE / pointer.scale)
        return self.document.with_curve(self.curve, curve)

    def _grabbed(self, using: BendWith) -> Bend:
        if using not in self._bends:
            self._bends[using] = Bend(self.view, self.hit.t, using)
        return self._bends[using]


def bend_with(view: CurveView, pointer: Pointer) -> BendWith:
    """Return which data a bend changes with the keys that are held."""
    if pointer.ctrl or not has_handles(view):
        return BendWith.POINTS
    return BendWith.ALL if pointer.alt else BendWith.DERIVATIVES


def what_bends(view: CurveView, pointer: Pointer) -> str:
    """Return in words what a bend does to the points."""
    if not has_handles(view):
        return f"this family has no handles: the {view.source.family.point}s move"
    return bend_with(view, pointer).value


def bend_keys(view: CurveView) -> str:
    """Return what modifiers change of a bend."""
    return "Alt: points come along · Ctrl: points alone" if has_handles(view) else ""


class Refuse(Drag, frozen=True):
    """A drag of what cannot be changed: it says why."""

    reason: str
    name = ""

    def document_at(self, _pointer: Pointer) -> Document:
        """Make nothing of it."""
        raise limits.EditError(self.reason)
