"""What each drag makes of the document at its press and the pointer's position now."""

from __future__ import annotations

import math
from functools import cached_property

import msgspec

from app.document import edits
from app.document.curve_edits import replace_curve
from app.document.model import Curve, Document, Node, Vector
from app.document.transforms import decimal_product, step_nodes
from app.gestures import words
from app.gestures.pointer import Hit, Part, Pointer
from app.gestures.snapping import Magnet
from app.view_model.curve_view import CurveView, appended_parameter, appended_squeeze, view_of
from app.view_model.handles import acceleration_from_handle, velocity_from_handle
from app.view_model.reshape import Reshaped, with_point_inserted


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1])


def _plus(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1])


def _along_axis(by: Vector, axis: int | None) -> Vector:
    return by if axis is None else (by[0], 0.0) if axis == 0 else (0.0, by[1])


class MovePoints(msgspec.Struct, frozen=True):
    """Move nodes with the pointer; Shift keeps to one axis.

    Attributes
    ----------
    grip
        The node that snaps, where there is a `magnet`.
    axis
        0 or 1 where an axis is locked from the start.
    """

    document: Document
    curve: int
    indices: frozenset[int]
    start: Vector
    magnet: Magnet | None = None
    grip: int = -1
    axis: int | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        if len(self.indices) == 1:
            return f"Move point {next(iter(self.indices))}"
        return f"Move {len(self.indices)} points"

    keys = "Shift: along one axis · Ctrl: snap, or not"

    def note_at(self, pointer: Pointer) -> str:
        """Tell where one point is and how far it came; of several, how far they came."""
        way, target = self.way_at(pointer)
        if len(self.indices) > 1:
            return f"{self.name} by {words.vector(way)}"
        return f"{words.point_at(self._held, self._place(way, target))} · moved {words.vector(way)}"

    @property
    def _held(self) -> int:
        return self.grip if self.grip >= 0 else next(iter(self.indices))

    def place_at(self, pointer: Pointer) -> Vector:
        """Return where the node is that is held, to the last bit where it snapped to."""
        return self._place(*self.way_at(pointer))

    def _place(self, by: Vector, target: Vector | None) -> Vector:
        held = self.document.curves[self.curve].nodes[self._held].position
        return target if target is not None else _plus(held, by)

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        by, target = self.way_at(pointer)
        document = edits.move_nodes(self.document, self.curve, self.indices, by)
        if target is not None:
            # To the last bit where it snapped to: p + (q − p) may miss q by a rounding.
            document = edits.set_position(document, self.curve, self.grip, target)
        return document

    def way_at(self, pointer: Pointer) -> tuple[Vector, Vector | None]:
        """Return how far the points go, and where exactly the grip ends if it snapped."""
        way = _minus(pointer.position, self.start)
        axis = self.axis
        if axis is None and pointer.shift:
            axis = 0 if abs(way[0]) >= abs(way[1]) else 1
        way = _along_axis(way, axis)
        if self.magnet is None:
            return way, None
        held = self.document.curves[self.curve].nodes[self.grip].position
        target = self.magnet.pull(_plus(held, way), pointer, axis)
        if self.magnet.caught is None:
            return way, None
        return _minus(target, held), target


class NudgePoints(MovePoints, frozen=True):
    """Move nodes by a key."""

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Nudge {words.points(self.indices)}"

    def note_at(self, pointer: Pointer) -> str:
        """Tell where one point is now, and the step."""
        return _nudged(self.indices, self.document_at(pointer).curves[self.curve], pointer.position)


class StepPoints(msgspec.Struct, frozen=True):
    """Move nodes by a step of the grid, in decimal numbers."""

    document: Document
    curve: int
    indices: frozenset[int]
    direction: Vector
    spacing: Vector
    factor: float

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Nudge {words.points(self.indices)}"

    keys = ""

    def note_at(self, pointer: Pointer) -> str:
        """Tell where one point is now, and the step."""
        return _nudged(self.indices, self.document_at(pointer).curves[self.curve], self._step)

    @property
    def _step(self) -> Vector:
        x, y = (
            way * decimal_product(spacing, self.factor)
            for way, spacing in zip(self.direction, self.spacing, strict=True)
        )
        return (x, y)

    def document_at(self, _pointer: Pointer) -> Document:
        """Move by the step, wherever the pointer is."""
        return step_nodes(self.document, self.curve, self.indices, self._step)


def _nudged(indices: frozenset[int], curve: Curve, step: Vector) -> str:
    """Tell what a key has moved: where one point is, or how many went, and the step."""
    if len(indices) > 1:
        return f"{len(indices)} points nudged · step {words.vector(step)}"
    index = next(iter(indices))
    return f"{words.point_at(index, curve.nodes[index].position)} · step {words.vector(step)}"


class DragHandle(msgspec.Struct, frozen=True):
    """Set a velocity or an acceleration by its handle."""

    document: Document
    curve: int
    view: CurveView
    hit: Hit
    start: Vector
    magnet: Magnet | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        what = "velocity" if self.hit.part is Part.VELOCITY_HANDLE else "acceleration"
        return f"Set {what} of point {self.hit.index}"

    keys = "Shift: steps of 15° · Alt: length only · Ctrl: snap, or not"

    def note_at(self, pointer: Pointer) -> str:
        """Tell the derivative by its length and direction."""
        what = "Velocity" if self.hit.part is Part.VELOCITY_HANDLE else "Acceleration"
        return f"{what} of point {self.hit.index}: {words.polar(self._derivative_at(pointer))}"

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
        return _in_steps(free) if pointer.shift else free

    def _snapped(self, tip: Vector, pointer: Pointer) -> Vector:
        if self.magnet is None:
            return tip
        if pointer.shift or pointer.alt:
            # An angle or a direction that is held leaves nothing to be drawn elsewhere.
            self.magnet.release()
            return tip
        return self.magnet.pull(tip, pointer)


def _along_direction(v: Vector, direction: Vector) -> Vector:
    """Return the part of `v` along `direction`."""
    length = math.hypot(*direction)
    unit = (direction[0] / length, direction[1] / length)
    share = v[0] * unit[0] + v[1] * unit[1]
    return (share * unit[0], share * unit[1])


def _in_steps(v: Vector) -> Vector:
    """Turn `v` to the nearest multiple of 15 degrees; along the axes exactly."""
    steps = round(math.degrees(math.atan2(v[1], v[0])) / 15)
    length = math.hypot(*v)
    if steps % 6 == 0:
        x, y = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[steps // 6 % 4]
    else:
        x, y = math.cos(math.radians(15 * steps)), math.sin(math.radians(15 * steps))
    return (length * x, length * y)


class PullVelocity(msgspec.Struct, frozen=True):
    """Pull the velocity handle out of a node, wherever the handle lay before."""

    document: Document
    curve: int
    view: CurveView
    index: int
    magnet: Magnet | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Set velocity of point {self.index}"

    keys = "Ctrl: snap, or not"

    def note_at(self, pointer: Pointer) -> str:
        """Tell the velocity by its length and direction."""
        return f"Velocity of point {self.index}: {words.polar(self._velocity_at(pointer))}"

    def _velocity_at(self, pointer: Pointer) -> Vector:
        return velocity_from_handle(self.view, self.index, _pulled(pointer, self.magnet), ahead=True)

    def document_at(self, pointer: Pointer) -> Document:
        """Put the handle ahead of the node under the pointer."""
        velocity = self._velocity_at(pointer)
        ahead = self.view.spacing(self.index, ahead=True) is not None
        return edits.set_velocity(self.document, self.curve, self.index, velocity, ahead=ahead)


def _pulled(pointer: Pointer, magnet: Magnet | None) -> Vector:
    return magnet.pull(pointer.position, pointer) if magnet is not None else pointer.position


class AppendPoint(msgspec.Struct, frozen=True):
    """Put a new last point at the press; dragging sets its velocity, or moves it where there is none."""

    document: Document
    curve: int
    view: CurveView
    press: Pointer
    magnet: Magnet | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Add point {len(self.view.source.nodes)}"

    keys = "Ctrl: snap, or not"

    def note_at(self, pointer: Pointer) -> str:
        """Tell where it goes, and where its velocity points."""
        place = self._place(pointer)
        note = f"{self.name} at {words.vector(place)}"
        if not self._sets_velocity(pointer):
            return note
        x, y = _minus(pointer.position, place)
        return f"{note}, velocity at {words.angle(math.degrees(math.atan2(y, x)))}"

    def _is_dragged(self, pointer: Pointer) -> bool:
        return max(map(abs, _minus(pointer.pixel, self.press.pixel))) >= 3

    def _sets_velocity(self, pointer: Pointer) -> bool:
        return self._is_dragged(pointer) and self.view.source.family.derivatives > 0

    def _place(self, pointer: Pointer) -> Vector:
        moves = self._is_dragged(pointer) and not self._sets_velocity(pointer)
        return _pulled(pointer if moves else self.press, self.magnet)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point."""
        document = self._with_point(Node(*self._place(pointer)))
        if not self._sets_velocity(pointer):
            return document
        index = len(self.view.source.nodes)
        view = view_of(document.curves[self.curve])
        velocity = velocity_from_handle(view, index, pointer.position, ahead=True)
        return edits.set_velocity(document, self.curve, index, velocity)

    def _with_point(self, node: Node) -> Document:
        if self.view.source.is_manual:
            node = Node(node.x, node.y, t=appended_parameter(self.view, node))
        squeeze = appended_squeeze(self.view, [node])
        return edits.append_node(self.document, self.curve, node, squeeze=squeeze)


class InsertPoint(msgspec.Struct, frozen=True, dict=True):
    """Insert a point on the curve where it was pressed, the shape kept if possible; dragging moves it."""

    document: Document
    curve: int
    view: CurveView
    hit: Hit
    press: Pointer
    magnet: Magnet | None = None

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Insert point {self.hit.index}"

    keys = "Ctrl: snap, or not"

    def note_at(self, pointer: Pointer) -> str:
        """Tell where it goes."""
        if self._is_on_curve(pointer):
            return f"{self.name} at t = {words.number(self.hit.t)}"
        return f"{self.name} at {words.vector(_pulled(pointer, self.magnet))}"

    def _is_on_curve(self, pointer: Pointer) -> bool:
        return max(map(abs, _minus(pointer.pixel, self.press.pixel))) < 3

    @cached_property
    def on_curve(self) -> Reshaped:
        """The curve with the point where it was pressed."""
        return with_point_inserted(self.view, self.hit.t)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point."""
        if self._is_on_curve(pointer):
            return replace_curve(self.document, self.curve, self.on_curve.curve)
        is_manual = self.document.curves[self.curve].is_manual
        node = Node(*_pulled(pointer, self.magnet), t=self.hit.t if is_manual else None)
        return edits.insert_nodes(self.document, self.curve, self.hit.index, [node])
