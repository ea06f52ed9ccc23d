"""The pen: what the Add tool does where there is no point and no handle."""

from __future__ import annotations

import math

from app.document.curve_edits import add_curve, fresh_curve
from app.document.model import Vector
from app.tools import hints
from app.tools.machine import DragMachine, Host
from app.tools.magnets import Magnets
from app.tools.pen_drags import AppendPoint, BeginCurve, InsertPoint, PenAct, pen_act
from app.tools.pointer import Hit, Pointer
from app.tools.snapping import Magnet
from app.view_model.curve_view import CurveView, view_of
from app.view_model.pen_preview import view_with_point


class Pen:
    """Appends and inserts points, and begins another curve beside one that is closed or finished.

    What is finished is neither in the document nor in its history: it only says what the next press means.
    """

    def __init__(self, host: Host, machine: DragMachine, magnets: Magnets) -> None:
        self._host, self._machine, self._magnets = host, machine, magnets
        # The finished curves, by their places and names.
        self._finished: set[tuple[int, str]] = set()
        # What a press would make of the curve that `_seen` shows.
        self._seen: CurveView | None = None
        self._ahead: CurveView | None = None
        self._spot: Vector | None = None
        self._place: Vector | None = None

    @property
    def is_finished(self) -> bool:
        """Whether the person has finished the curve that is edited, so that the next press begins another."""
        return self._key in self._finished and hints.can_finish(self._host.active_view)

    @property
    def _key(self) -> tuple[int, str]:
        return self._host.active_index, self._host.active_view.source.name

    def finish(self) -> bool:
        """Finish the curve that is edited, or say why not; return whether the key was for it."""
        host = self._host
        if self._machine.is_pressed or host.active_view.source.is_closed:
            return False
        if not hints.can_finish(host.active_view):
            host.refuse("A curve needs two points before it can be finished.")
            return True
        self._finished.add(self._key)
        host.select([])
        host.say(f"“{host.active_view.source.name}” is finished; the next press begins another curve.")
        return True

    def goes_on_at(self, hit: Hit) -> bool:
        """Whether a click on what is hit goes on with a finished curve."""
        view = self._host.active_view
        return self.is_finished and hints.is_end(hit, view) and not view.source.locked

    def go_on(self) -> None:
        """Go on with the finished curve."""
        host = self._host
        self._finished.discard(self._key)
        count = len(host.active_view.source.nodes)
        host.select([count - 1])
        host.say(f"Going on with “{host.active_view.source.name}”; the next press adds point {count}.")

    def forget_finished(self) -> None:
        """Forget what was finished; the document is another one."""
        self._finished.clear()

    def press(self, pointer: Pointer) -> None:
        """Begin what a press here does."""
        host, hit = self._host, pointer.hit
        act = self._act(pointer)
        if act is PenAct.BEGIN:
            self._begin(pointer)
        elif host.active_view.source.locked:
            host.refuse(hints.LOCKED.format(host.active_view.source.name))
        elif act is PenAct.INSERT and hit is not None:
            self._insert(pointer, hit)
        else:
            self._append(pointer)

    def _act(self, pointer: Pointer) -> PenAct:
        view = self._host.active_view
        return pen_act(pointer.hit, view, shift=pointer.shift, finished=self.is_finished)

    def place_of_new(self, pointer: Pointer) -> int | None:
        """Return the index of a point that a press puts just here; −1 in another curve, None for none."""
        if not hints.is_no_part(pointer.hit):
            return None
        count = len(self._host.active_view.source.nodes)
        return {PenAct.APPEND: count, PenAct.BEGIN: -1}.get(self._act(pointer))

    # What a press would do, shown before it

    @property
    def ahead(self) -> CurveView | None:
        """The curve as it would be with a point added where the pointer is, None where none would be."""
        return self._ahead if self._seen is self._host.active_view else None

    @property
    def spot(self) -> Vector | None:
        """Where on the curve a point would be inserted, None where none would be."""
        return self._spot if self._seen is self._host.active_view else None

    def look_ahead(self, pointer: Pointer, magnet: Magnet | None) -> None:
        """Find out what a press at `pointer` would make of the curve; `magnet` draws a point there."""
        host, view, hit = self._host, self._host.active_view, pointer.hit
        is_here = math.isfinite(pointer.position[0]) and hints.is_no_part(hit)
        act = self._act(pointer) if is_here and not view.source.locked else PenAct.BEGIN
        self._spot = hit.position if act is PenAct.INSERT and hit is not None else None
        if act is not PenAct.APPEND:
            self._seen, self._ahead, self._place = view, None, None
            return
        place = (
            magnet.caught.position if magnet is not None and magnet.caught is not None else pointer.position
        )
        if place != self._place or view is not self._seen:
            self._ahead = view_with_point(host.document, host.active_index, view, place, self._ahead)
        self._seen, self._place = view, place

    def look_away(self) -> None:
        """Show nothing of what a press would do."""
        self._seen = self._ahead = self._spot = self._place = None

    def _append(self, pointer: Pointer) -> None:
        host = self._host
        index = len(host.active_view.source.nodes)
        magnet = self._magnets.for_new(index)
        key = self._key
        append = AppendPoint(host.document, host.active_index, host.active_view, pointer, magnet)
        # Only when it is done: Escape leaves a finished curve finished.
        self._machine.press_at_once(pointer, append, on_done=lambda: self._finished.discard(key), makes=index)

    def _begin(self, pointer: Pointer) -> None:
        """Begin another curve; it is the one that is edited from the press on."""
        host = self._host
        model, place = host.active_view.source, host.active_index + 1
        fresh = fresh_curve(host.document, model, model.parametrization)
        document = add_curve(host.document, place, fresh)
        self._finished.discard((place, fresh.name))
        begin = BeginCurve(document, place, view_of(fresh), pointer, self._magnets.for_new(-1))
        self._machine.press_at_once(pointer, begin, active=place, makes=0)

    def _insert(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        magnet = self._magnets.for_points((hit.index,), hit.index)
        insert = InsertPoint(host.document, host.active_index, host.active_view, hit, pointer, magnet)
        self._machine.press_at_once(
            pointer, insert, on_done=lambda: self._say_outcome(insert), makes=hit.index
        )

    def _say_outcome(self, insert: InsertPoint) -> None:
        made = insert.on_curve
        if self._host.active_view.source != made.curve:
            return  # dragged off the curve: the change is what was wanted
        if made.parameters_moved:
            self._host.offer(made.sentence, "keepShape", insert.hit.t)
        else:
            self._host.say(made.sentence)
