"""The tool that adds points: appended, inserted on the curve, or the first of another curve."""

from __future__ import annotations

import math
from functools import partial

from msgspec.structs import replace

from ...document.curve_edits import begun, fresh_curve, reverse_curve, without_last_point
from ...document.edits import EditError
from ...document.model import Curve, Document, Vector
from ...document.point_group import NO_POINTS, points_of
from ...view_model.curve.curve_view import CurveView, view_of
from ...view_model.fitting.reshape import inserted_index
from ...view_model.points.appending import (
    Appending,
    closed_by_pen,
    is_quick,
    view_with_point,
    with_point_appended,
)
from ...view_model.points.straight import closed_by_line, with_line_appended
from .. import hints
from ..drag_machine import EditingHost
from ..marks import GestureMarks
from ..parts import GESTURES, dragged_with, press_on_part
from ..pen_drags import AppendPoint, BeginCurve, InsertPoint, PenAct, pen_act, place_in_steps
from ..pen_session import PenSession, key_of
from ..pointer import Hint, Hit
from ..tool import GestureRow, Tool, ToolContext, ToolRecord

_TAKING_BACK = ("backspace", "delete")
"""Keys that take back the last point."""


class AddTool(Tool):
    """Tool that adds points, and begins another curve beside one that is closed or finished.

    Which curves are finished is neither in the document nor in its history: it only says what the next press
    means.
    """

    shows_new_handle = True

    def __init__(self) -> None:
        self._pen = PenSession()
        # What a press would make of the curve that `_seen` shows.
        self._seen: CurveView | None = None
        self._preview: CurveView | None = None
        self._spot: Vector | None = None

    def reset(self) -> None:
        """Forget which curves are finished; another document is open."""
        self._pen.reset()

    def pick_up(self) -> None:
        """Draw nothing yet."""
        self._pen.begin()

    def end(self) -> None:
        """Show nothing of what a press would do."""
        self._seen = self._preview = self._spot = None

    def take_over(self, context: ToolContext) -> None:
        """Leave the active curve as it is: nobody was editing it."""
        if hints.can_finish(context.view):
            self._pen.finish(context.host)

    # Finished curves

    def claims(self, context: ToolContext, key: str) -> bool:
        """Whether a key takes back what the pen has drawn: unless the person has selected something else."""
        if key not in _TAKING_BACK or context.drags.is_pressed or not self._pen.has_drawn:
            return False
        last = len(context.view.source.points) - 1
        return context.host.selected.group in (NO_POINTS, points_of(context.host.active_index, [last]))

    def key(self, context: ToolContext, key: str) -> bool:
        """Finish the curve that is edited with Enter, or say why not; take back its last point."""
        host = context.host
        if self.claims(context, key):
            self._take_back(context)
            return True
        if key != "enter" or context.drags.is_pressed or context.view.source.is_closed:
            return False
        if not hints.can_finish(context.view):
            host.refuse("A curve needs two points before it can be finished.")
        else:
            self._finish(host)
        return True

    def _finish(self, host: EditingHost) -> None:
        """Finish the curve that is edited: the next press begins another one."""
        self._pen.finish(host)
        host.selected.set_points([])
        host.say(f"“{host.active_view.source.name}” is finished; the next press begins another curve.")

    def _take_back(self, context: ToolContext) -> None:
        """Take back the last point that was drawn, and with the first of all the curve."""
        host = context.host
        place, last = host.active_index, len(host.active_view.source.points) - 1

        if not self._pen.own_points(host):
            host.say("There is nothing to take back; a click draws, V selects.")
        elif host.change(f"Take back point {last}", lambda document: without_last_point(document, place)):
            if last:
                host.selected.set_points([last - 1])
            host.say(f"Took back point {last}." if last else "Took back the curve; a click begins another.")

    def _ends_at(self, hit: Hit, host: EditingHost) -> bool:
        """Whether a double click on what is hit finishes the curve: on the point that it has added."""
        view = host.active_view
        return hints.is_end(hit, view) and hints.can_finish(view) and not self._pen.is_finished(host)

    def _go_on(self, host: EditingHost, index: int) -> None:
        """Go on with a curve from its end at point `index`; from the first it runs the other way."""
        curve, view = host.active_index, host.active_view
        last = len(view.source.points) - 1
        if index != last:
            way = f"Go on from point {index}"
            parameters = view.parameters.tolist()
            if not host.change(way, lambda document: reverse_curve(document, curve, parameters)):
                return
        self._pen.draw(key_of(host), last + 1)
        host.selected.set_points([last])
        host.say(f"Going on with “{view.source.name}”; the next press adds point {last + 1}.")

    # Presses

    def press(self, context: ToolContext) -> None:
        """Begin what a press here does."""
        host, hit = context.host, context.hit
        if (part := self._part(context)) is not None:
            self._press_on_part(context, part)
            return
        act = self._act(context)
        if act is PenAct.BEGIN:
            self._begin(context)
        elif context.view.source.locked:
            host.refuse(hints.LOCKED.format(context.view.source.seen_name))
        elif act is PenAct.INSERT and hit is not None:
            _insert(context, hit)
        else:
            self._append(context)

    def _part(self, context: ToolContext) -> Hit | None:
        """Return the point or handle that a press is about; None for none."""
        host, hit = context.host, context.hit
        if hit is None or hints.is_no_part(hit) or _begins_anew(host):
            return None
        return hit

    def _press_on_part(self, context: ToolContext, hit: Hit) -> None:
        if self._pen.goes_on_at(hit, context.host):
            press_on_part(context, hit, partial(self._go_on, context.host, hit.index))
        elif hints.can_end_at(hit, context.view):
            press_on_part(context, hit, partial(self._close, context))
        elif context.pointer.is_double and self._ends_at(hit, context.host):
            press_on_part(context, hit, partial(self._finish, context.host))
        else:
            press_on_part(context, hit)

    def _act(self, context: ToolContext) -> PenAct:
        if _begins_anew(context.host):
            return PenAct.BEGIN
        finished = self._pen.is_finished(context.host)
        return pen_act(context.hit, context.view, shift=context.pointer.shift, finished=finished)

    def _append(self, context: ToolContext) -> None:
        host = context.host
        index, key = len(context.view.source.points), key_of(host)
        snapper, (document, view) = context.snappers.for_new(index), self._start(context)
        append = AppendPoint(
            document,
            host.active_index,
            view,
            context.pointer,
            snapper,
            _appending(context),
        )
        # Only when it is done: Escape leaves a finished curve finished.
        done = partial(self._pen.draw, key, index)
        context.drags.press_at_once(context.pointer, append, on_done=done, makes=index)

    def _close(self, context: ToolContext) -> None:
        """Close the curve that is edited, or say why it cannot be closed."""
        host = context.host
        host.change(f"Close {host.active_view.source.name}", lambda _document: self._closed(context))

    def _closed(self, context: ToolContext) -> Document:
        document, view = self._start(context)
        close = closed_by_line if context.pointer.alt else closed_by_pen
        return close(document, context.host.active_index, view)

    def _start(self, context: ToolContext) -> tuple[Document, CurveView]:
        """Return the document, and the view of the curve that is edited, that a press goes on from."""
        host = context.host
        document = host.document
        if not context.view.source.points:
            document = begun(document, host.active_index, _fresh(context)).document
        if document is host.document:
            return document, context.view
        return document, view_of(document.curves[host.active_index], context.view)

    def _begin(self, context: ToolContext) -> None:
        """Begin another curve, or the empty one; it is edited from the press on."""
        host = context.host
        document, place = begun(host.document, host.active_index, _fresh(context))
        begun_curve = document.curves[place]
        done = partial(self._pen.draw, (place, begun_curve.name), 0)
        view, snapper = view_of(begun_curve), context.snappers.for_new(-1)
        begin = BeginCurve(document, place, view, context.pointer, snapper, _appending(context))
        context.drags.press_at_once(context.pointer, begin, on_done=done, active=place, makes=0)

    # What a press would do

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do, and show it."""
        view = context.view
        part = self._part(context)
        act = self._act(context) if part is None else None
        place = len(view.source.points) if act is PenAct.APPEND else -1 if act is PenAct.BEGIN else None
        in_steps = act is PenAct.APPEND and place_in_steps(view, context.pointer) is not None
        if place is not None and not in_steps:
            context.preview_snap(place)
        self._update_preview(context, act)
        snaps = context.settings.snapping.on
        if view.source.locked and act is not PenAct.BEGIN:
            return Hint(hints.LOCKED.format(view.source.seen_name))
        if part is None:
            act, goes_on = act or PenAct.APPEND, not _begins_anew(context.host)
            return hints.to_add(act, view, _fresh(context), snaps=snaps, goes_on=goes_on)
        pointer = context.pointer
        dragged, goes_on = dragged_with(context, part), self._pen.goes_on_at(part, context.host)
        return hints.to_add_on_part(part, view, dragged, pointer, snaps=snaps, goes_on=goes_on)

    def _update_preview(self, context: ToolContext, act: PenAct | None) -> None:
        """Find out what a press here would make of the curve."""
        host, view, hit, caught = context.host, context.view, context.hit, context.snappers.caught
        is_here = math.isfinite(context.pointer.position[0]) and not view.source.locked
        self._spot = hit.position if is_here and act is PenAct.INSERT and hit is not None else None
        self._seen = view
        if is_here and act is None and self._pen.is_drawn(host) and hints.can_end_at(hit, view):
            self._preview = self._view_closed(context)
            return
        if not is_here or act is not PenAct.APPEND:
            self._preview = None
            return
        pointer = context.pointer
        free = caught.position if caught is not None else pointer.position
        place = place_in_steps(view, pointer) or free
        document, start = self._start(context)
        self._preview = view_with_point(
            document, host.active_index, start, place, self._preview, append=_appending(context)
        )

    def _view_closed(self, context: ToolContext) -> CurveView | None:
        """Return the view of the curve as a click here closes it; None where that is none, or takes long."""
        if not is_quick(context.view):
            return None
        try:
            closed = view_of(self._closed(context).curves[context.host.active_index], self._preview)
        except EditError:
            return None
        return closed if closed.is_current else None

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the curve with one point more, or the spot to insert one at."""
        is_shown = self._seen is context.view and not context.drags.is_pressed
        return GestureMarks(
            snap=context.snappers.caught,
            preview_curve=self._preview if is_shown else None,
            spot=self._spot if is_shown else None,
        )


def _appending(context: ToolContext) -> Appending:
    """Return what a click makes: with Alt a point after a straight line."""
    return with_line_appended if context.pointer.alt else with_point_appended


def _fresh(context: ToolContext) -> Curve:
    """Return another curve to begin, as the one that is edited."""
    model = context.host.model
    return fresh_curve(context.host.document, model, model.parametrization)


def _begins_anew(host: EditingHost) -> bool:
    """Whether no curve is edited that a press could go on with: the one that was is gone."""
    return not host.selected.is_editing and bool(host.document.curves[host.active_index].points)


def _insert(context: ToolContext, hit: Hit) -> None:
    host, hit = context.host, replace(hit, index=inserted_index(context.view, hit.t))
    place = (host.active_index, hit.index)
    snapper = context.snappers.for_group(points_of(place[0], [place[1]]), place)
    insert = InsertPoint(host.document, host.active_index, context.view, hit, context.pointer, snapper)
    context.drags.press_at_once(
        context.pointer, insert, on_done=lambda: _say_outcome(host, insert), makes=hit.index
    )


def _say_outcome(host: EditingHost, insert: InsertPoint) -> None:
    made = insert.on_curve
    # Dragged off the curve: the change is what was wanted.
    if host.active_view.source == made.curve:
        host.say(made.sentence)


ADD = ToolRecord(
    name="add",
    make=AddTool,
    hint="Click to add points; Enter or a double click ends the curve; V or Escape goes back to selecting.",
    beginning="Click on the canvas to add points; two of them make a curve.",
    doing="adding points",
    gestures=(
        GestureRow("Click", "add a point"),
        GestureRow(
            "Press and drag",
            "add a point and set its velocity; Ctrl or Shift: 15° steps, Alt: ahead alone",
            needs_derivatives=True,
        ),
        GestureRow("Ctrl+click", "add a point at a step of 15°, seen from the last one"),
        GestureRow("Alt+click", "a corner after a straight line", needs_derivatives=True),
        GestureRow("Click the curve", "insert a point between its neighbours"),
        GestureRow("Shift+click", "add a point at the end, also on the curve or a closed one"),
        GestureRow("Enter, double click", "finish the curve; a click on either end goes on from there"),
        GestureRow("Backspace, Delete", "take back the last point"),
        GestureRow("Click the first point", "close the curve"),
        GestureRow("Click beside a closed or finished curve", "begin another curve"),
        *GESTURES,
    ),
    rank=20,
    action="addTool",
    title="Add Points",
    key="P",
    icon="add",
    tip="Click to add points; drag to pull out their handles",
    in_menu=True,
)
