"""The tool that adds points: appended, inserted on the curve, or the first of another curve."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from msgspec.structs import replace

from ...document.curve_edits import (
    locked_message,
    new_curve_like,
    reverse_curve,
    with_new_curve,
)
from ...document.limits import EditError
from ...document.model import Curve, Document, Vector
from ...document.point_group import NO_POINTS, points_of
from ...view_model.append import (
    Appending,
    closed_by_pen,
    has_pulled_handle,
    is_quick,
    view_with_point,
    with_point_appended,
)
from ...view_model.curve.curve_view import CurveView, view_of
from ...view_model.join import End, joined_by_pen
from ...view_model.point_kinds import closed_by_corner, with_corner_appended
from ...view_model.reshape import inserted_index
from ..add_points import (
    TAKING_BACK,
    AppendPoint,
    BeginCurve,
    CloseCurve,
    GoOn,
    InsertPoint,
    JoinEnd,
    PenAct,
    PenSession,
    can_end_at,
    can_finish,
    is_end,
    is_no_part,
    key_of,
    pen_act,
    position_in_steps,
    selection_of,
)
from ..drag_handles import GESTURES, hint_on_part, press_on_part
from ..drag_points import label_of_moved
from ..editing_session import EditingSession
from ..marks import Marks
from ..pointer import Hint, Hit, Part, Pointer, snap_key_text
from ..tool import Gesture, GestureRow, Tool, ToolEvent, ToolRecord

_ENTER = "Enter, double click: finish the curve"


class AddTool(Tool):
    """Tool that adds points, and begins another curve beside one that is closed or finished.

    Which curves are finished is neither in the document nor in its history: it only says what the next press
    means.
    """

    hits = Tool.hits | {Part.OTHER_END}
    shows_new_handle = True

    def __init__(self) -> None:
        self._pen = PenSession()
        # What a press would make of the curve that `_previewed` shows.
        self._previewed: CurveView | None = None
        self._preview: CurveView | None = None
        self._spot: Vector | None = None

    def activate(self, event: ToolEvent) -> None:
        """Draw nothing yet; where no curve is edited, the active one stays as it is."""
        self._pen.begin()
        if not event.session.selected.is_editing and can_finish(event.view):
            self._pen.finish(event.session)

    # Finished curves

    def wants_key(self, event: ToolEvent, key: str) -> bool:
        """Return whether a key removes the last point drawn, and nothing else is selected."""
        if key not in TAKING_BACK or not self._pen.has_drawn:
            return False
        last = len(event.view.source.points) - 1
        return event.session.selected.group in (NO_POINTS, points_of(event.session.active_index, [last]))

    def key(self, event: ToolEvent, key: str) -> bool:
        """Finish the active curve with Enter, or say why not; remove its last point with Backspace."""
        session = event.session
        if self.wants_key(event, key):
            self._take_back(event)
            return True
        if key != "enter" or event.view.source.is_closed:
            return super().key(event, key)
        if not can_finish(event.view):
            session.refuse("A curve needs two points before it can be finished.")
        else:
            self._finish(event)
        return True

    def _finish(self, event: ToolEvent) -> None:
        """Finish the active curve: the next press begins another one."""
        session = event.session
        self._pen.finish(session)
        session.selected.set_points([])
        name = session.active_view.source.name
        session.say(f"“{name}” is finished; the next press begins another curve.", is_hint=True)

    def _take_back(self, event: ToolEvent) -> None:
        """Remove the last point that was drawn, and with the first point the curve."""
        session = event.session
        curve, last = session.active_index, len(session.active_view.source.points) - 1

        if not self._pen.drawn_points(session):
            session.say("There is nothing to remove; a click draws, V selects.", is_hint=True)
        elif session.change(f"Remove point {last}", lambda document: self._pen.without_last(document, curve)):
            if last:
                session.selected.set_points([last - 1])
            removed = f"Removed point {last}." if last else "Removed the curve; a click begins another."
            session.say(removed, is_hint=not last)

    def _ends_at(self, hit: Hit, session: EditingSession) -> bool:
        """Return whether a double click finishes the curve: on the point that it has added."""
        view = session.active_view
        return is_end(hit, view) and can_finish(view) and not self._pen.is_finished(session)

    def _go_on(self, event: ToolEvent, curve: int, index: int) -> None:
        """Continue a curve from its end at point `index`; from the first point it is reversed."""
        session = event.session
        if curve != session.active_index or not session.selected.is_editing:
            session.selected.activate(curve)
        view = session.active_view
        last = len(view.source.points) - 1
        if index != last:
            text = f"Continue from point {index}"
            parameters = view.parameters.tolist()
            if not session.change(text, lambda document: reverse_curve(document, curve, parameters)):
                return
        self._pen.draw(key_of(session), last + 1)
        session.selected.set_points([last])
        name = view.source.name
        session.say(f"Continuing “{name}”; the next press adds point {last + 1}.", is_hint=True)

    # Presses

    def press(self, event: ToolEvent) -> Gesture | None:
        """Return the gesture that begins here."""
        session, hit = event.session, event.hit
        if (part := self._part(event)) is not None:
            return self._press_on_part(event, part)
        if (end := _other_end(event)) is not None:
            return self._append(event, end) if self._pen.joins(session) else self._press_on_end(event, end)
        act = self._act(event)
        if act is PenAct.BEGIN:
            return self._begin(event)
        if event.view.source.locked:
            session.refuse(locked_message([event.view.source.display_name]))
            return None
        return _insert(event, hit) if act is PenAct.INSERT and hit is not None else self._append(event)

    def _part(self, event: ToolEvent) -> Hit | None:
        """Return the point or handle that a press acts on; None for none."""
        session, hit = event.session, event.hit
        if hit is None or is_no_part(hit) or _begins_anew(session):
            return None
        return hit

    def _press_on_part(self, event: ToolEvent, hit: Hit) -> Gesture:
        session, view = event.session, event.view
        if self._pen.goes_on_at(hit, session):
            return self._press_on_end(event, replace(hit, curve=session.active_index))
        if can_end_at(hit, view):
            close = partial(self._close, by_corner=event.pointer.alt)
            if not view.source.family.curve_class.can_close:
                return press_on_part(event, hit, close)
            kind = partial(CloseCurve, on_click=close)
            return self._drawn(kind, event, session.document, session.active_index, view, 0)
        on_click: Callable[[ToolEvent], object] | None = None
        if event.pointer.is_double and self._ends_at(hit, session):
            on_click = self._finish
        elif self._is_tip(hit, event):
            on_click = partial(self._add, event)
        return press_on_part(event, hit, on_click)

    def _is_tip(self, hit: Hit, event: ToolEvent) -> bool:
        """Return whether the handle ahead of the last point is hit, and a click there adds a point."""
        is_last = hit.index == len(event.view.source.points) - 1 and not event.view.source.is_closed
        return hit.part is Part.HANDLE and is_last and hit.ahead and self._pen.is_drawn(event.session)

    def _add(self, press: ToolEvent, release: ToolEvent) -> None:
        """Add the point of a click."""
        drag = self._append(press)
        drag.move(release)
        drag.release(release)

    def _press_on_end(self, event: ToolEvent, hit: Hit) -> Gesture:
        """Go on with a curve from the end that is pressed."""
        document, view = event.session.document, event.session.views[hit.curve]
        if hit.index == 0:
            document = reverse_curve(document, hit.curve, view.parameters.tolist())
            view = view_of(document.curves[hit.curve])
        go_on = partial(self._go_on, curve=hit.curve, index=hit.index)
        last = len(view.source.points) - 1
        return self._drawn(partial(GoOn, on_click=go_on), event, document, hit.curve, view, last)

    def _act(self, event: ToolEvent) -> PenAct:
        if _begins_anew(event.session):
            return PenAct.BEGIN
        finished = self._pen.is_finished(event.session)
        return pen_act(event.hit, event.view, shift=event.pointer.shift, finished=finished)

    def _append(self, event: ToolEvent, end: Hit | None = None) -> AppendPoint:
        """Add a point, or the one that joins the curve to an end of another."""
        index, (document, view) = len(event.view.source.points), self._start(event)
        kind = AppendPoint if end is None else partial(JoinEnd, end=_as_end(end))
        return self._drawn(kind, event, document, event.session.active_index, view, index, index)

    def _drawn(
        self,
        kind: Callable[..., AppendPoint],
        event: ToolEvent,
        document: Document,
        curve: int,
        view: CurveView,
        index: int,
        snapped: int = -1,
    ) -> AppendPoint:
        """Return a drag that draws point `index` of a curve; it snaps as the new point `snapped` does."""
        return kind(
            document=document,
            selects=selection_of(curve, index),
            curve=curve,
            view=view,
            press=event.pointer,
            snapper=event.snapping.for_new_point(snapped),
            append=_appending(event),
            pen=self._pen,
            key_of_curve=(curve, view.source.name),
        )

    def _close(self, event: ToolEvent, *, by_corner: bool) -> None:
        """Close the active curve, or say why it cannot be closed."""
        session, name = event.session, event.view.source.name
        session.change(f"Close {name}", lambda _document: self._closed(event, by_corner=by_corner))

    def _closed(self, event: ToolEvent, *, by_corner: bool) -> Document:
        document, view = self._start(event)
        close = closed_by_corner if by_corner else closed_by_pen
        return close(document, event.session.active_index, view)

    def _start(self, event: ToolEvent) -> tuple[Document, CurveView]:
        """Return the document, and the view of the active curve, that a press continues."""
        session = event.session
        document = session.document
        if not event.view.source.points:
            document = with_new_curve(document, session.active_index, _fresh(event)).document
        if document is session.document:
            return document, event.view
        return document, view_of(document.curves[session.active_index], event.view)

    def _begin(self, event: ToolEvent) -> Gesture:
        """Begin another curve, or the empty one; it is edited from the press on."""
        session = event.session
        document, curve = with_new_curve(session.document, session.active_index, _fresh(event))
        return self._drawn(BeginCurve, event, document, curve, view_of(document.curves[curve]), 0)

    # What a press would do

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint, and preview the curve with the point."""
        view = event.view
        if (end := _other_end(event)) is not None:
            return self._hint_on_end(event, end)
        part = self._part(event)
        act = self._act(event) if part is None else None
        index = len(view.source.points) if act is PenAct.APPEND else -1 if act is PenAct.BEGIN else None
        in_steps = act is PenAct.APPEND and position_in_steps(view, event.pointer) is not None
        if index is not None and not in_steps:
            event.preview_snap(index)
        self._update_preview(event, act)
        snaps = event.snapping.is_on
        if view.source.locked and act is not PenAct.BEGIN:
            return Hint(locked_message([view.source.display_name]))
        if part is None:
            act, goes_on = act or PenAct.APPEND, not _begins_anew(event.session)
            return _hint_beside(act, view, _fresh(event), snaps=snaps, goes_on=goes_on)
        pointer = event.pointer
        if self._is_tip(part, event):
            return Hint(f"Click to add point {len(view.source.points)} · Drag to move the handle", grab=True)
        dragged, goes_on = label_of_moved(event, part), self._pen.goes_on_at(part, event.session)
        return _hint_on_part(part, view, dragged, pointer, snaps=snaps, goes_on=goes_on)

    def _hint_on_end(self, event: ToolEvent, end: Hit) -> Hint:
        """Return the hint on an end of another curve; preview the curve that a click joins to it."""
        session, joins = event.session, self._pen.joins(event.session)
        other = session.views[end.curve]
        self._spot, self._previewed, self._preview = end.position, event.view, None
        name = other.source.display_name
        if not joins:
            start = "" if end.index else " from its first point"
            return Hint(f"Click to continue “{name}”{start}{_pull_words(other.source)}", grab=True)
        if is_quick(event.view) and is_quick(other):
            try:
                drag = self._append(event, end)
                joined = joined_by_pen(drag.document_at(event.pointer), drag.curve, _as_end(end))
            except EditError as reason:
                return Hint(str(reason))
            self._preview = view_of(joined.curve)
        alt = f" · Alt: {_alt_words(event.view.source)}" if event.view.source.family.derivatives else ""
        return Hint(f"Click to join with “{name}”{alt}", grab=True)

    def _update_preview(self, event: ToolEvent, act: PenAct | None) -> None:
        """Compute the curve as a press here would make it."""
        session, view, hit, caught = event.session, event.view, event.hit, event.snapping.caught
        is_here = math.isfinite(event.pointer.position[0]) and not view.source.locked
        self._spot = hit.position if is_here and act is PenAct.INSERT and hit is not None else None
        self._previewed = view
        if is_here and act is None and self._pen.is_drawn(session) and can_end_at(hit, view):
            self._preview = self._view_closed(event)
            return
        if not is_here or act is not PenAct.APPEND:
            self._preview = None
            return
        pointer = event.pointer
        free = caught.position if caught is not None else pointer.position
        position = position_in_steps(view, pointer) or free
        document, start = self._start(event)
        self._preview = view_with_point(
            document, session.active_index, start, position, self._preview, append=_appending(event)
        )

    def _view_closed(self, event: ToolEvent) -> CurveView | None:
        """Return the view of the curve closed by a click here; None where it is none, or takes long."""
        if not is_quick(event.view):
            return None
        try:
            document = self._closed(event, by_corner=event.pointer.alt)
            closed = view_of(document.curves[event.session.active_index], self._preview)
        except EditError:
            return None
        return closed if closed.is_current else None

    def marks(self, event: ToolEvent) -> Marks:
        """Return the curve with one point more, or the spot to insert one at."""
        is_current = self._previewed is event.view
        return Marks(
            snap=event.snapping.caught,
            preview_curve=self._preview if is_current else None,
            spot=self._spot if is_current else None,
        )


def _appending(event: ToolEvent) -> Appending:
    """Return the edit of a click: with Alt a point after a straight line."""
    return with_corner_appended if event.pointer.alt else with_point_appended


def _other_end(event: ToolEvent) -> Hit | None:
    """Return the end of another open curve that is hit; with Shift a point may be put over it."""
    hit = event.hit
    return hit if hit is not None and hit.part is Part.OTHER_END and not event.pointer.shift else None


def _as_end(hit: Hit) -> End:
    return End(hit.curve, is_last=hit.index > 0)


def _alt_words(curve: Curve) -> str:
    """Return the segment that a click with Alt makes."""
    return "corner by the handle" if has_pulled_handle(curve) else "straight line"


def _pull_words(curve: Curve) -> str:
    return " · Drag to pull out its handle" if curve.family.derivatives else ""


def _fresh(event: ToolEvent) -> Curve:
    """Return a new curve like the active one."""
    model = event.session.template_curve
    return new_curve_like(event.session.document, model, model.parametrization)


def _begins_anew(session: EditingSession) -> bool:
    """Return whether no curve is edited that a press could continue."""
    return not session.selected.is_editing and bool(session.document.curves[session.active_index].points)


def _insert(event: ToolEvent, hit: Hit) -> Gesture:
    session, hit = event.session, replace(hit, index=inserted_index(event.view, hit.t))
    point = (session.active_index, hit.index)
    return InsertPoint(
        document=session.document,
        selects=selection_of(*point),
        curve=session.active_index,
        view=event.view,
        hit=hit,
        press=event.pointer,
        snapper=event.snapping.for_points(points_of(point[0], [point[1]]), point),
    )


def _hint_on_part(
    hit: Hit,
    view: CurveView,
    dragged: str,
    pointer: Pointer,
    *,
    snaps: bool,
    goes_on: bool,
) -> Hint:
    """Return the hint over a point or a handle; `goes_on` where a click continues the curve."""
    if goes_on:
        end = "" if is_end(hit, view) else " from its first point"
        return Hint(f"Click to continue this curve{end}{_pull_words(view.source)}", grab=True)
    if can_end_at(hit, view):
        if not view.source.family.curve_class.can_close:
            # A click says why, and which families can.
            return Hint(f"Drag to move point 0 · {view.source.family.subject} cannot be closed", grab=True)
        corner = f" · Alt: {_alt_words(view.source)}" if view.source.family.derivatives else ""
        return Hint(f"Click to close the curve{corner}{_pull_words(view.source)}", grab=True)
    return hint_on_part(hit, view, dragged, pointer, snaps=snaps)


def _hint_beside(
    act: PenAct,
    view: CurveView,
    fresh: Curve,
    *,
    snaps: bool,
    goes_on: bool = True,
) -> Hint:
    """Return the hint on the curve or beside it.

    `fresh` is a curve that would be begun; `goes_on` tells whether Shift adds to the curve that is seen.
    """
    if act is PenAct.INSERT:
        return Hint("Click to insert a point here · Shift: add at the end")
    keys, index = snap_key_text(snaps=snaps), len(view.source.points)
    if act is PenAct.BEGIN:
        other = "" if fresh.family == view.source.family else f", {fresh.family.title}"
        shift = f" · Shift: add point {index} to this one" if goes_on else ""
        return Hint(f"Click to begin another curve{other}{shift} · {keys}")
    what, finish = f"Click to add point {index}", _ENTER if can_finish(view) else ""
    if not view.source.family.derivatives:
        drag = "On the curve: insert between neighbours"
    else:
        drag = f"Alt: {_alt_words(view.source)} · Drag to set its velocity"
    parts = (what, finish, drag, "Ctrl: steps of 15°" if index else "", keys)
    return Hint(" · ".join(part for part in parts if part))


ADD = ToolRecord(
    name="add",
    make=AddTool,
    hint="Click to add points; Enter or a double click ends the curve; V or Escape returns to Select.",
    empty_message="Click on the canvas to add points; two of them make a curve.",
    doing="adding points",
    gestures=(
        GestureRow("Click", "add a point"),
        GestureRow(
            "Press and drag",
            "add a point and set its velocity; Ctrl or Shift: 15° steps, Alt: only the handle ahead",
            needs_derivatives=True,
        ),
        GestureRow("Ctrl+click", "add a point at a multiple of 15° from the last one"),
        GestureRow(
            "Alt+click", "a corner, by the handle that was pulled or a straight line", needs_derivatives=True
        ),
        GestureRow("Click the curve", "insert a point between its neighbours"),
        GestureRow("Shift+click", "add a point at the end, even on the curve or if it is closed"),
        GestureRow("Enter, double click", "finish the curve"),
        GestureRow("Click an end of any open curve", "continue that curve; while drawing, join with it"),
        GestureRow("Backspace, Delete", "remove the last point"),
        GestureRow("Click the first point", "close the curve; drag: pull out its handle"),
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
    in_toolbar=True,
)
