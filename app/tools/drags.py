"""Drags of points and handles: the document at a place of the pointer, computed from the press."""

from __future__ import annotations

import math

import msgspec

from app.document import edits, words
from app.document.model import Document, Vector
from app.document.several_curves import PointGroup, moved
from app.document.transforms import decimal_product, step_points
from app.tools.pointer import Hit, Part, Pointer
from app.tools.snapping import Snapper
from app.view_model.curve_view import CurveView
from app.view_model.handles import acceleration_from_handle, velocity_from_handle


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1])


def _plus(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1])


def _along_axis(by: Vector, axis: int | None) -> Vector:
    return by if axis is None else (by[0], 0.0) if axis == 0 else (0.0, by[1])


class MovePoints(msgspec.Struct, frozen=True):
    """Move points, or whole curves, with the pointer; Shift keeps to one axis.

    Attributes
    ----------
    grip
        The curve and the point that snaps, where there is a `snapper`.
    axis
        0 or 1 where an axis is locked from the start.
    """

    document: Document
    group: PointGroup
    start: Vector
    snapper: Snapper | None = None
    grip: tuple[int, int] = (-1, -1)
    axis: int | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Move {words.group(self.group)}"

    keys = "Shift: along one axis · Ctrl: snap, or not"

    def readout_at(self, pointer: Pointer) -> str:
        """Tell where one point is and how far it came; of several, how far they came."""
        way, target = self.displacement_at(pointer)
        one = self.group.only_point
        if one is None:
            return f"{self.name} by {words.vector(way)}"
        return f"{words.point_at(one[1], self._place(way, target))} · moved {words.vector(way)}"

    def place_at(self, pointer: Pointer) -> Vector:
        """Return where the point is that is held, to the last bit where it snapped to."""
        return self._place(*self.displacement_at(pointer))

    def _place(self, by: Vector, target: Vector | None) -> Vector:
        curve, index = self.grip if self.grip[1] >= 0 else self.group.first_point
        held = self.document.curves[curve].points[index].position
        return target if target is not None else _plus(held, by)

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        by, target = self.displacement_at(pointer)
        document = moved(self.document, self.group, by)
        if target is not None:
            # To the last bit where it snapped to: p + (q − p) may miss q by a rounding.
            document = edits.set_position(document, *self.grip, target)
        return document

    def displacement_at(self, pointer: Pointer) -> tuple[Vector, Vector | None]:
        """Return how far the points go, and where exactly the grip ends if it snapped."""
        way = _minus(pointer.position, self.start)
        axis = self.axis
        if axis is None and pointer.shift:
            axis = 0 if abs(way[0]) >= abs(way[1]) else 1
        way = _along_axis(way, axis)
        curve, point = self.grip
        if self.snapper is None or point < 0:
            return way, None
        held = self.document.curves[curve].points[point].position
        target = self.snapper.snap(_plus(held, way), pointer, axis)
        if self.snapper.caught is None:
            return way, None
        return _minus(target, held), target


class NudgePoints(MovePoints, frozen=True):
    """Move points by a key."""

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Nudge {words.group(self.group)}"

    def readout_at(self, pointer: Pointer) -> str:
        """Tell where one point is now, and the step."""
        return _nudged(self.group, self.document_at(pointer), pointer.position)


class StepPoints(msgspec.Struct, frozen=True):
    """Move points by a step of the grid, in decimal numbers."""

    document: Document
    group: PointGroup
    direction: Vector
    spacing: Vector
    factor: float

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Nudge {words.group(self.group)}"

    keys = ""

    def readout_at(self, pointer: Pointer) -> str:
        """Tell where one point is now, and the step."""
        return _nudged(self.group, self.document_at(pointer), self._step)

    @property
    def _step(self) -> Vector:
        x, y = (
            way * decimal_product(spacing, self.factor)
            for way, spacing in zip(self.direction, self.spacing, strict=True)
        )
        return (x, y)

    def document_at(self, _pointer: Pointer) -> Document:
        """Move by the step, wherever the pointer is."""
        return self.group.changed(
            self.document, lambda each, curve, indices: step_points(each, curve, indices, self._step)
        )


def _nudged(group: PointGroup, document: Document, step: Vector) -> str:
    """Tell what a key has moved: where one point is, or how many went, and the step."""
    one = group.only_point
    if one is None:
        return f"{words.group(group)} nudged · step {words.vector(step)}"
    curve, index = one
    place = document.curves[curve].points[index].position
    return f"{words.point_at(index, place)} · step {words.vector(step)}"


def what_handle_sets(hit: Hit, view: CurveView) -> str:
    """Return "velocity of point 2"; at a corner, which has two, the side as well."""
    what = "velocity" if hit.part is Part.VELOCITY_HANDLE else "acceleration"
    return f"{what} of {_side_of(view, hit.index, ahead=hit.ahead)}"


def _side_of(view: CurveView, index: int, *, ahead: bool) -> str:
    side = "" if index not in view.corners else ", ahead" if ahead else ", behind"
    return f"point {index}{side}"


class DragHandle(msgspec.Struct, frozen=True):
    """Set a velocity or an acceleration by its handle."""

    document: Document
    curve: int
    view: CurveView
    hit: Hit
    start: Vector
    snapper: Snapper | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Set {what_handle_sets(self.hit, self.view)}"

    keys = "Shift: steps of 15° · Alt: length only · Ctrl: snap, or not"

    def readout_at(self, pointer: Pointer) -> str:
        """Tell the derivative by its length and direction."""
        what = what_handle_sets(self.hit, self.view)
        return f"{what[0].upper()}{what[1:]}: {words.polar(self._derivative_at(pointer))}"

    def document_at(self, pointer: Pointer) -> Document:
        """Keep the offset between pointer and handle that the press had."""
        derivative, index, ahead = self._derivative_at(pointer), self.hit.index, self.hit.ahead
        if self.hit.part is Part.VELOCITY_HANDLE:
            return edits.set_velocity(self.document, self.curve, index, derivative, ahead=ahead)
        return edits.set_acceleration(self.document, self.curve, index, derivative, ahead=ahead)

    def _derivative_at(self, pointer: Pointer) -> Vector:
        tip = self._snapped(_plus(self.hit.position, _minus(pointer.position, self.start)), pointer)
        index, ahead, view = self.hit.index, self.hit.ahead, self.view
        if self.hit.part is Part.VELOCITY_HANDLE:
            free = velocity_from_handle(view, index, tip, ahead=ahead)
            before = view.velocity_of(index, ahead=ahead)
        else:
            free = acceleration_from_handle(view, index, tip, ahead=ahead)
            before = view.acceleration_of(index, ahead=ahead)
        if pointer.alt and before is not None and any(before):
            return _along_direction(free, before)
        return in_steps(free) if pointer.shift else free

    def _snapped(self, tip: Vector, pointer: Pointer) -> Vector:
        if self.snapper is None:
            return tip
        if pointer.shift or pointer.alt:
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


class PullVelocity(msgspec.Struct, frozen=True):
    """Pull the velocity handle out of a point, wherever the handle lay before."""

    document: Document
    curve: int
    view: CurveView
    index: int
    snapper: Snapper | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Set velocity of {_side_of(self.view, self.index, ahead=True)}"

    keys = "Ctrl: snap, or not"

    def readout_at(self, pointer: Pointer) -> str:
        """Tell the velocity by its length and direction."""
        velocity = words.polar(self._velocity_at(pointer))
        return f"Velocity of {_side_of(self.view, self.index, ahead=True)}: {velocity}"

    def _velocity_at(self, pointer: Pointer) -> Vector:
        return velocity_from_handle(self.view, self.index, snapped(pointer, self.snapper), ahead=True)

    def document_at(self, pointer: Pointer) -> Document:
        """Put the handle ahead of the point under the pointer."""
        velocity = self._velocity_at(pointer)
        ahead = self.view.spacing(self.index, ahead=True) is not None
        return edits.set_velocity(self.document, self.curve, self.index, velocity, ahead=ahead)


class Refuse(msgspec.Struct, frozen=True):
    """A drag of what cannot be changed: it says why."""

    reason: str
    name: str = ""

    def document_at(self, _pointer: Pointer) -> Document:
        """Make nothing of it."""
        raise edits.EditError(self.reason)


def snapped(pointer: Pointer, snapper: Snapper | None) -> Vector:
    """Return where the pointer is, or what it snaps to."""
    return snapper.snap(pointer.position, pointer) if snapper is not None else pointer.position
