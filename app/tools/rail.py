"""The gestures of the basis panel: dragging ticks of the t-rail, and the scrub line."""

from __future__ import annotations

import math

from app.document.edits import freeze_parameters, set_parameter
from app.tools.machine import CANCELLED, THRESHOLD, DragMachine, Host
from app.tools.pointer import Hint, Hit, Part, Pointer
from app.tools.rail_drags import DragTicks


class RailTool:
    """What a press in the basis panel does: on a tick it changes t_i, elsewhere it scrubs."""

    def __init__(self, host: Host) -> None:
        self._host = host
        self._machine = DragMachine(host)
        self._scrubbing_from: float | None = None
        self._scrubbing = False
        self._function: tuple[Pointer, int] | None = None

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
        # A click on a function means its point; only a drag from there scrubs.
        self._function = (pointer, hit.index) if hit is not None and hit.part is Part.FUNCTION else None
        self._scrub_to(pointer)

    def _press_on_tick(self, pointer: Pointer, hit: Hit) -> None:
        host, before = self._host, self._host.selection
        if hit.index not in before:
            host.select(before | {hit.index} if pointer.shift else [hit.index])
        drag = self._drag(pointer.position[0], hit.knot, hit.index)
        self._machine.press(pointer, drag, on_click=lambda: self._click(pointer, hit, before))

    def _click(self, pointer: Pointer, hit: Hit, before: frozenset[int]) -> None:
        """Select the tick alone; with Shift add it, or take it out."""
        if not pointer.shift:
            self._host.select([hit.index])
        elif hit.index in before:
            self._host.select(before - {hit.index})

    def _drag(self, start: float, knot: int, node: int) -> DragTicks:
        host = self._host
        parameters = host.active_view.parameters.tolist()
        knots = {other for other in host.selection if other != node} | {knot}
        # Frozen once: in every step of the drag only the nodes whose ticks move are other values.
        frozen = freeze_parameters(host.document, host.active_index, parameters)
        return DragTicks(frozen, host.active_index, parameters, knot, frozenset(knots), node, start)

    def choose(self, node: int) -> None:
        """Select a tick, unless it is among those selected already."""
        if node not in self._host.selection:
            self._host.select([node])

    def nudge(self, by: float) -> bool:
        """Move the selected ticks by a little; return whether there are any."""
        host = self._host
        if not host.selection or not host.active_view.is_current or self.is_pressed:
            return False
        first = min(host.selection)
        moved = Pointer((by, 0.0), (0.0, 0.0))
        run = ("ticks", host.active_index, host.selection)
        self._machine.nudge(moved, self._drag(0.0, first, first), run)
        return True

    def set_value(self, knot: int, t: float) -> None:
        """Give one tick a parameter that was typed; raise `EditError` where the order forbids it."""
        host = self._host
        parameters = host.active_view.parameters.tolist()
        document = set_parameter(host.document, host.active_index, knot, t, parameters)
        node = host.active_view.owner(knot)
        host.commit(document, f"Change t of point {node}")

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        if self._scrubbing:
            self._scrub_to(pointer)
        else:
            self._machine.move(pointer)

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        if not self._scrubbing:
            self._machine.release(pointer)
            return
        self._scrub_to(pointer)
        self._scrubbing = False
        if self._function is not None:
            self._host.select([self._function[1]])

    def cancel(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        if self._scrubbing:
            self._scrubbing = False
            self._host.set_scrub(self._scrubbing_from)
            if self._function is None:
                self._host.say(CANCELLED)
            return True
        return self._machine.cancel()

    def forget(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._scrubbing = False
        self._machine.forget()

    def progress(self, pointer: Pointer) -> str:
        """Return how far the drag of a tick has come, as a sentence; empty without one."""
        return self._machine.progress_at(pointer)

    def _scrub_to(self, pointer: Pointer) -> None:
        if self._function is not None:
            if math.dist(self._function[0].pixel, pointer.pixel) < THRESHOLD:
                return
            self._function = None
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
            return Hint(self._tick_hint(hit.index), grab=True)
        kind = ("basis function", "velocity function", "acceleration function")[hit.kind]
        return Hint(f"The {kind} of point {hit.index} · Click to select the point")

    def _tick_hint(self, index: int) -> str:
        chosen = self._host.selection
        what = f"t of {len(chosen)} points" if index in chosen and len(chosen) > 1 else f"t of point {index}"
        return (
            f"Drag to change {what} · E: all ticks on the side you move to go along · "
            "Shift+click selects more · Double-click types t"
        )
