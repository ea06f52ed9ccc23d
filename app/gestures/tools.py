"""The tools of the canvas: which drag a press begins, and what a press here would do."""

from __future__ import annotations

from enum import Enum

from app.document.model import Vector
from app.gestures.drags import AppendPoint, DragHandle, InsertPoint, MovePoints, PullVelocity
from app.gestures.machine import DragMachine, Host
from app.gestures.pointer import Hint, Hit, Part, Pointer

_LOCKED = "“{}” is locked; unlock it in the list of curves to change it."


class ToolKind(Enum):
    """What a press on the canvas means."""

    SELECT = "select"
    ADD = "add"


class CanvasTool:
    """The canvas's gestures, Select or Add points."""

    def __init__(self, host: Host) -> None:
        self._host = host
        self._machine = DragMachine(host)
        self.kind = ToolKind.SELECT

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._machine.is_pressed

    def press(self, pointer: Pointer) -> None:
        """Begin a gesture."""
        hit = pointer.hit
        if hit is not None and hit.part is Part.OTHER_CURVE:
            self._machine.press(pointer, None, on_click=lambda: self._host.activate(hit.index))
        elif hit is not None and hit.part is not Part.CURVE:
            self._press_on_part(pointer, hit)
        elif self.kind is ToolKind.ADD:
            self._press_to_add(pointer, hit)
        else:
            self._machine.press(pointer, None, on_click=lambda: self._click_beside(hit))

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        self._machine.move(pointer)

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        self._machine.release(pointer)

    def cancel(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return self._machine.cancel()

    def forget(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._machine.forget()

    def walk(self, step: int) -> bool:
        """Select the next (1) or previous (−1) point; return whether there is one."""
        host = self._host
        count = len(host.active_view.source.nodes)
        here = max(host.selection) if host.selection and step > 0 else min(host.selection, default=count)
        index = here + step if host.selection or step < 0 else 0
        if not 0 <= index < count:
            return False
        host.select([index])
        return True

    def nudge(self, by: Vector) -> None:
        """Move the selected points."""
        host = self._host
        if not host.selection:
            return
        moved = Pointer(by, (0.0, 0.0))
        drag = MovePoints(host.document, host.active_index, host.selection, (0.0, 0.0))
        self._machine.press_at_once(moved, drag)
        self._machine.release(moved)

    def hover(self, pointer: Pointer) -> Hint:
        """Return what a press here would do."""
        hit = pointer.hit
        self._host.set_hovered(hit.index if hit is not None and hit.part is Part.POINT else -1)
        if hit is not None and hit.part is Part.OTHER_CURVE:
            return Hint(f"Click to edit “{self._host.document.curves[hit.index].name}”", grab=True)
        if self._host.active_view.source.locked and (hit is not None or self.kind is ToolKind.ADD):
            return Hint(_LOCKED.format(self._host.active_view.source.name))
        if hit is not None and hit.part is not Part.CURVE:
            return self._hint_for(hit)
        if self.kind is ToolKind.ADD:
            return self._hint_to_add(hit)
        return Hint("Press P to add points · Wheel zooms · Space or middle button pans · F fits")

    def _press_on_part(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        if hit.part is Part.POINT:
            if hit.index not in host.selection:
                host.select([hit.index])
            self._machine.press(pointer, self._point_drag(pointer, hit))
            return
        drag = DragHandle(host.document, host.active_index, host.active_view, hit, pointer.position)
        self._machine.press(pointer, drag)

    def _point_drag(self, pointer: Pointer, hit: Hit) -> MovePoints | PullVelocity:
        host = self._host
        if pointer.alt and host.active_view.source.family.derivatives:
            return PullVelocity(host.document, host.active_index, host.active_view, hit.index)
        return MovePoints(host.document, host.active_index, host.selection, pointer.position)

    def _press_to_add(self, pointer: Pointer, hit: Hit | None) -> None:
        host = self._host
        if host.active_view.source.locked:
            host.say(_LOCKED.format(host.active_view.source.name))
            return
        if hit is not None:
            self._insert(pointer, hit)
            return
        index = len(host.active_view.source.nodes)
        append = AppendPoint(host.document, host.active_index, host.active_view, pointer)
        self._machine.press_at_once(pointer, append)
        host.select([index])

    def _insert(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        insert = InsertPoint(host.document, host.active_index, host.active_view, hit, pointer)
        count = len(host.active_view.source.nodes)
        self._machine.press_at_once(pointer, insert, on_done=lambda: self._say_outcome(insert))
        if len(host.active_view.source.nodes) > count:
            host.select([hit.index])

    def _say_outcome(self, insert: InsertPoint) -> None:
        made = insert.on_curve
        if self._host.active_view.source != made.curve:
            return  # dragged off the curve: the change is what was wanted
        if made.parameters_moved:
            self._host.offer(made.sentence, "keepShape", insert.hit.t)
        else:
            self._host.say(made.sentence)

    def _click_beside(self, hit: Hit | None) -> None:
        if hit is None:
            self._host.select([])

    def _hint_for(self, hit: Hit) -> Hint:
        if hit.part is Part.POINT:
            text = f"Drag to move point {hit.index} · Shift: along one axis"
            if self._host.active_view.source.family.derivatives:
                text += " · Alt: pull out its velocity"
            return Hint(text, grab=True)
        what = "velocity" if hit.part is Part.VELOCITY_HANDLE else "acceleration"
        return Hint(f"Drag to set the {what} of point {hit.index} · Escape cancels", grab=True)

    def _hint_to_add(self, hit: Hit | None) -> Hint:
        if hit is not None:
            return Hint(f"Click to insert point {hit.index} on the curve at t = {hit.t:.4g}")
        index = len(self._host.active_view.source.nodes)
        if self._host.active_view.source.family.derivatives:
            return Hint(f"Click to add point {index} · Press and drag to set its velocity")
        return Hint(f"Click to add point {index} · On the curve: insert between neighbours")
