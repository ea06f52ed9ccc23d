"""The gestures of the basis panel: dragging a tick of the t-rail, and the scrub line."""

from __future__ import annotations

from app.gestures.drags import DragTick
from app.gestures.machine import DragMachine, Host
from app.gestures.pointer import Hint, Hit, Part, Pointer


class RailTool:
    """What a press in the basis panel does: on a tick it changes t_i, elsewhere it scrubs."""

    def __init__(self, host: Host) -> None:
        self._host = host
        self._machine = DragMachine(host)
        self._scrubbing_from: float | None = None
        self._scrubbing = False

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._machine.is_pressed or self._scrubbing

    def press(self, pointer: Pointer, scrub: float | None) -> None:
        """Begin a gesture; `scrub` is where the scrub line stands now."""
        hit = pointer.hit
        if hit is not None and hit.part is Part.TICK:
            self._press_on_tick(pointer, hit)
            return
        self._scrubbing, self._scrubbing_from = True, scrub
        if hit is not None and hit.part is Part.FUNCTION:
            self._host.select([hit.index])
        self._scrub_to(pointer)

    def _press_on_tick(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        host.select([hit.index])
        parameters = host.active_view.parameters.tolist()
        drag = DragTick(
            host.document, host.active_index, parameters, hit.knot, hit.index, pointer.position[0]
        )
        self._machine.press(pointer, drag)

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        if self._scrubbing:
            self._scrub_to(pointer)
        else:
            self._machine.move(pointer)

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        if self._scrubbing:
            self._scrub_to(pointer)
            self._scrubbing = False
        else:
            self._machine.release(pointer)

    def cancel(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        if self._scrubbing:
            self._scrubbing = False
            self._host.set_scrub(self._scrubbing_from)
            return True
        return self._machine.cancel()

    def forget(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._scrubbing = False
        self._machine.forget()

    def _scrub_to(self, pointer: Pointer) -> None:
        view = self._host.active_view
        if view.curve is not None:
            start, end = view.curve.domain
            self._host.set_scrub(min(max(pointer.position[0], start), end))

    def hover(self, pointer: Pointer) -> Hint:
        """Return what a press here would do."""
        hit = pointer.hit
        self._host.set_hovered(hit.index if hit is not None and hit.part is not Part.SCRUB else -1)
        if hit is None or hit.part is Part.SCRUB:
            return Hint("Drag to scrub: each point shows its weight at t · Escape puts the line away")
        if hit.part is Part.TICK:
            return Hint(f"Drag to change t of point {hit.index}; the parameters become manual", grab=True)
        kind = ("basis function", "velocity function", "acceleration function")[hit.kind]
        return Hint(f"The {kind} of point {hit.index} · Click to select the point")
