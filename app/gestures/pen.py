"""The pen: what the Add tool does where there is no point and no handle."""

from __future__ import annotations

from app.document.curve_edits import add_curve, fresh_curve
from app.gestures import hints
from app.gestures.machine import DragMachine, Host
from app.gestures.magnets import Magnets
from app.gestures.pen_drags import AppendPoint, BeginCurve, InsertPoint, PenAct, pen_act
from app.gestures.pointer import Hit, Pointer
from app.view_model.curve_view import view_of


class Pen:
    """Appends and inserts points, and begins another curve beside a closed one."""

    def __init__(self, host: Host, machine: DragMachine, magnets: Magnets) -> None:
        self._host, self._machine, self._magnets = host, machine, magnets

    def press(self, pointer: Pointer) -> None:
        """Begin what a press here does."""
        host, hit = self._host, pointer.hit
        act = pen_act(hit, host.active_view, shift=pointer.shift)
        if act is PenAct.BEGIN:
            self._begin(pointer)
        elif host.active_view.source.locked:
            host.refuse(hints.LOCKED.format(host.active_view.source.name))
        elif act is PenAct.INSERT and hit is not None:
            self._insert(pointer, hit)
        else:
            self._append(pointer)

    def place_of_new(self, pointer: Pointer) -> int | None:
        """Return the index of a point that a press puts just here; −1 in another curve, None for none."""
        if not hints.is_no_part(pointer.hit):
            return None
        view = self._host.active_view
        act = pen_act(pointer.hit, view, shift=pointer.shift)
        return {PenAct.APPEND: len(view.source.nodes), PenAct.BEGIN: -1}.get(act)

    def _append(self, pointer: Pointer) -> None:
        host = self._host
        index = len(host.active_view.source.nodes)
        magnet = self._magnets.for_points((), index)
        append = AppendPoint(host.document, host.active_index, host.active_view, pointer, magnet)
        self._machine.press_at_once(pointer, append)
        host.select([index])

    def _begin(self, pointer: Pointer) -> None:
        """Begin another curve; it is the one that is edited from the press on."""
        host = self._host
        model, place = host.active_view.source, host.active_index + 1
        fresh = fresh_curve(host.document, model, model.parametrization)
        document = add_curve(host.document, place, fresh)
        begin = BeginCurve(document, place, view_of(fresh), pointer, self._magnets.for_points((), -1))
        self._machine.press_at_once(pointer, begin, active=place)
        if host.active_index == place:
            host.select([0])

    def _insert(self, pointer: Pointer, hit: Hit) -> None:
        host = self._host
        magnet = self._magnets.for_points((), hit.index)
        insert = InsertPoint(host.document, host.active_index, host.active_view, hit, pointer, magnet)
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
