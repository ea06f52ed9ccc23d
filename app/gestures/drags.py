"""What each drag makes of the document at its press and the pointer's position now."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from app.document import edits
from app.document.curve_edits import replace_curve
from app.document.model import Document, Node, Vector
from app.gestures.pointer import Hit, Part, Pointer
from app.view_model.curve_view import CurveView, appended_parameter, appended_squeeze, view_of
from app.view_model.handles import acceleration_from_handle, velocity_from_handle
from app.view_model.reshape import Reshaped, with_point_inserted


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1])


def _plus(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1])


def _axis_locked(by: Vector, *, locked: bool) -> Vector:
    if not locked:
        return by
    return (by[0], 0.0) if abs(by[0]) >= abs(by[1]) else (0.0, by[1])


@dataclass(frozen=True)
class MovePoints:
    """Move nodes with the pointer; Shift keeps to one axis."""

    document: Document
    curve: int
    indices: frozenset[int]
    start: Vector

    @property
    def name(self) -> str:
        """The name of the step."""
        if len(self.indices) == 1:
            return f"Move point {next(iter(self.indices))}"
        return f"Move {len(self.indices)} points"

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        by = _axis_locked(_minus(pointer.position, self.start), locked=pointer.shift)
        return edits.move_nodes(self.document, self.curve, self.indices, by)


@dataclass(frozen=True)
class DragHandle:
    """Set a velocity or an acceleration by its handle."""

    document: Document
    curve: int
    view: CurveView
    hit: Hit
    start: Vector

    @property
    def name(self) -> str:
        """The name of the step."""
        what = "velocity" if self.hit.part is Part.VELOCITY_HANDLE else "acceleration"
        return f"Set {what} of point {self.hit.index}"

    def document_at(self, pointer: Pointer) -> Document:
        """Keep the offset between pointer and handle that the press had."""
        tip = _plus(self.hit.position, _minus(pointer.position, self.start))
        index, ahead = self.hit.index, self.hit.ahead
        if self.hit.part is Part.VELOCITY_HANDLE:
            velocity = velocity_from_handle(self.view, index, tip, ahead=ahead)
            return edits.set_velocity(self.document, self.curve, index, velocity, ahead=ahead)
        acceleration = acceleration_from_handle(self.view, index, tip, ahead=ahead)
        return edits.set_acceleration(self.document, self.curve, index, acceleration, ahead=ahead)


@dataclass(frozen=True)
class PullVelocity:
    """Pull the velocity handle out of a node, wherever the handle lay before."""

    document: Document
    curve: int
    view: CurveView
    index: int

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Set velocity of point {self.index}"

    def document_at(self, pointer: Pointer) -> Document:
        """Put the handle ahead of the node (behind it at the last node, mirrored) under the pointer."""
        velocity = _velocity_pointing_at(self.view, self.index, pointer.position)
        return edits.set_velocity(self.document, self.curve, self.index, velocity)


@dataclass(frozen=True)
class AppendPoint:
    """Put a new last point at the press; dragging sets its velocity, or moves it where there is none."""

    document: Document
    curve: int
    view: CurveView
    press: Pointer

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Add point {len(self.view.source.nodes)}"

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point."""
        dragged = max(map(abs, _minus(pointer.pixel, self.press.pixel))) >= 3
        has_velocity = self.view.source.family.derivatives > 0
        x, y = self.press.position if has_velocity or not dragged else pointer.position
        document = self._with_point(Node(x, y))
        if not (dragged and has_velocity):
            return document
        index = len(self.view.source.nodes)
        view = view_of(document.curves[self.curve])
        velocity = _velocity_pointing_at(view, index, pointer.position)
        return edits.set_velocity(document, self.curve, index, velocity)

    def _with_point(self, node: Node) -> Document:
        if self.view.source.is_manual:
            node = Node(node.x, node.y, t=appended_parameter(self.view, node))
        squeeze = appended_squeeze(self.view, [node])
        return edits.append_node(self.document, self.curve, node, squeeze=squeeze)


def _velocity_pointing_at(view: CurveView, index: int, target: Vector) -> Vector:
    """Return the velocity whose handle ahead of the node, or the mirror of the one behind, is at `target`."""
    if view.spacing(index, ahead=True) is not None or view.spacing(index, ahead=False) is None:
        return velocity_from_handle(view, index, target, ahead=True)
    mirrored = velocity_from_handle(view, index, target, ahead=False)
    return (-mirrored[0], -mirrored[1])


@dataclass(frozen=True)
class InsertPoint:
    """Insert a point on the curve where it was pressed, the shape kept if possible; dragging moves it."""

    document: Document
    curve: int
    view: CurveView
    hit: Hit
    press: Pointer

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Insert point {self.hit.index}"

    @cached_property
    def on_curve(self) -> Reshaped:
        """The curve with the point where it was pressed."""
        return with_point_inserted(self.view, self.hit.t)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point."""
        if max(map(abs, _minus(pointer.pixel, self.press.pixel))) < 3:
            return replace_curve(self.document, self.curve, self.on_curve.curve)
        is_manual = self.document.curves[self.curve].is_manual
        node = Node(*pointer.position, t=self.hit.t if is_manual else None)
        return edits.insert_nodes(self.document, self.curve, self.hit.index, [node])


@dataclass(frozen=True)
class DragTick:
    """Drag the parameter of a node along the t-rail; the order of the parameters is kept."""

    document: Document
    curve: int
    parameters: Sequence[float]
    index: int
    node: int
    start: float

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Change t of point {self.node}"

    def document_at(self, pointer: Pointer) -> Document:
        """Move t by the whole way from the press, as far as the neighbours let it."""
        t = self.parameters[self.index] + pointer.position[0] - self.start
        return edits.set_parameter(
            self.document, self.curve, self.index, self._between_neighbours(t), self.parameters
        )

    def _between_neighbours(self, t: float) -> float:
        """Keep a distance that can still be seen, and from which the curve can still be computed well."""
        own, margin = self.parameters[self.index], 1e-3 * (self.parameters[-1] - self.parameters[0])
        if self.index > 0:
            before = self.parameters[self.index - 1]
            t = max(t, before + min(margin, (own - before) / 2))
        if self.index < len(self.parameters) - 1:
            after = self.parameters[self.index + 1]
            t = min(t, after - min(margin, (after - own) / 2))
        return t
