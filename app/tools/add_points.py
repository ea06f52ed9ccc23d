"""Add points with the pen: the curves it draws, the meaning of a press, and each drag to its undo step."""

from __future__ import annotations

import math
from enum import Enum, auto
from functools import cached_property

from msgspec.structs import replace

from ..document import point_edits, words
from ..document.curve_edits import delete_last_point, replace_curve
from ..document.model import Document, Point, Vector
from ..document.point_group import points_of
from ..document.selection import SelectionState
from ..document.several_curves import remove_curves
from ..view_model.append import (
    Appending,
    closed_by_pen,
    with_bare_corner,
    with_handles_pulled,
    with_point_appended,
)
from ..view_model.curve.curve_view import CurveView
from ..view_model.join import End, Joined, joined_by_pen
from ..view_model.reshape import Reshaped, with_point_inserted
from .editing_session import EditingSession
from .pointer import SNAP_KEY, STEP_KEYS, Hit, Part, Pointer, in_steps, plus
from .snapping import Snapper
from .tool import CANCELLED, Drag, ToolEvent

TAKING_BACK = ("backspace", "delete")
"""Keys that remove the last point."""

CurveKey = tuple[int, str]


class PenSession:
    """Curves that are finished, and those drawn since the pen was activated.

    Curves are known by their indices and names.

    Attributes
    ----------
    before
        The points of curves as they were before the last of them was drawn, by the points since.
    """

    def __init__(self) -> None:
        # From how many points on each is finished: undo of what has finished it leaves fewer.
        self._finished: dict[CurveKey, int] = {}
        # How many points each had when the pen began to draw it.
        self._drawn: dict[CurveKey, int] = {}
        self.before: dict[tuple[Point, ...], tuple[Point, ...]] = {}

    def reset(self) -> None:
        """Forget everything; another document is open."""
        self._finished.clear()
        self.begin()

    def begin(self) -> None:
        """Forget which curves are drawn: the pen is activated."""
        self._drawn.clear()
        self.before.clear()

    @property
    def has_drawn(self) -> bool:
        """Whether anything has been drawn since the pen was activated."""
        return bool(self._drawn)

    def is_finished(self, session: EditingSession) -> bool:
        """Return whether the active curve is finished: the next press begins another one."""
        view = session.active_view
        return can_finish(view) and len(view.source.points) >= self._finished.get(key_of(session), math.inf)

    def goes_on_at(self, hit: Hit, session: EditingSession) -> bool:
        """Return whether a click continues the curve: on either end of one that the pen is not drawing."""
        view = session.active_view
        is_either = is_end(hit, view) or is_beginning(hit, view)
        return is_either and not self.is_drawn(session) and not view.source.locked

    def is_drawn(self, session: EditingSession) -> bool:
        """Return whether the pen is drawing the active curve."""
        return (
            session.selected.is_editing and key_of(session) in self._drawn and not self.is_finished(session)
        )

    def joins(self, session: EditingSession) -> bool:
        """Return whether a click on an end of another curve joins the active one to it, being drawn."""
        source = session.active_view.source
        return self.is_drawn(session) and bool(source.points) and not (source.is_closed or source.locked)

    def finish(self, session: EditingSession, count: int = 0) -> None:
        """Finish the active curve, as long as it has `count` points or more."""
        self._finished[key_of(session)] = count

    def draw(self, key: CurveKey, count: int) -> None:
        """Begin to draw a curve, which has had `count` points before."""
        if self._finished.pop(key, None) is not None:
            self._drawn.pop(key, None)
        self._drawn.setdefault(key, count)

    def without_last(self, document: Document, curve: int) -> Document:
        """Return the document with the last point of a curve taken back, the others as before it was drawn.

        Where they have been changed since, it is deleted.
        """
        source = document.curves[curve]
        if before := self.before.get(source.points):
            return document.with_curve(curve, replace(source, points=before))
        return delete_last_point(document, curve)

    def drawn_points(self, session: EditingSession) -> int:
        """Return the number of points at the end of the active curve that the pen has drawn."""
        if not self.is_drawn(session) or session.active_view.source.is_closed:
            return 0
        return max(0, len(session.active_view.source.points) - self._drawn[key_of(session)])


def key_of(session: EditingSession) -> tuple[int, str]:
    """Return the index and the name of the active curve."""
    return session.active_index, session.active_view.source.name


# What a press means


def can_finish(view: CurveView) -> bool:
    """Return whether there is a curve with an end: the pen can finish it and begin another one."""
    return not view.source.is_closed and len(view.source.points) > 1


def can_end_at(hit: Hit | None, view: CurveView) -> bool:
    """Return whether the first point is hit, and there are others to close the curve around."""
    curve = view.source
    is_first = hit is not None and is_beginning(hit, view)
    return is_first and len(curve.points) >= curve.family.least_to_close


def is_beginning(hit: Hit, view: CurveView) -> bool:
    """Return whether the first point of an open curve is hit."""
    return hit.part is Part.POINT and hit.index == 0 and not view.source.is_closed


def is_end(hit: Hit, view: CurveView) -> bool:
    """Return whether the last point of an open curve is hit."""
    is_last = hit.part is Part.POINT and hit.index == len(view.source.points) - 1
    return is_last and not view.source.is_closed


def is_no_part(hit: Hit | None) -> bool:
    """Return whether neither a point nor a handle of the active curve is hit."""
    return hit is None or hit.part in (Part.CURVE, Part.OTHER_END)


class PenAct(Enum):
    """Act of the pen where there is no point and no handle."""

    APPEND = auto()
    INSERT = auto()
    BEGIN = auto()


def pen_act(hit: Hit | None, view: CurveView, *, shift: bool, finished: bool = False) -> PenAct:
    """Return the act of a press: on the curve insert, beside it append; with Shift append everywhere.

    A closed curve has no end to continue from, and a finished one is not continued: beside them another curve
    begins.
    """
    if shift:
        return PenAct.APPEND
    if hit is not None and hit.part is Part.CURVE:
        return PenAct.INSERT
    return PenAct.BEGIN if view.source.is_closed or finished else PenAct.APPEND


def position_in_steps(view: CurveView, pointer: Pointer) -> Vector | None:
    """Return the position of the next point with Ctrl: at a step of 15°, seen from the one before."""
    points = view.source.points
    if not (pointer.ctrl and points and pointer.is_there) or view.source.is_closed:
        return None
    before = points[-1].position
    return plus(before, in_steps(pointer.offset_from(before)))


def _is_away(pointer: Pointer, press: Pointer) -> bool:
    """Return whether the pointer has left the position of the press."""
    (x, y), (at_x, at_y) = pointer.pixel, press.pixel
    return max(abs(x - at_x), abs(y - at_y)) >= 3


# Drags


def selection_of(curve: int, index: int) -> SelectionState:
    """Return the selection of one point of a curve that is edited alone."""
    return SelectionState(curve, points_of(curve, [index]), frozenset({curve}), frozenset(), is_editing=True)


class AppendPoint(Drag, kw_only=True):
    """New last point at the press; dragging pulls out its handles, or moves it where there are none.

    With Alt the handle behind the point stays where it was, and only the one ahead of it follows.

    Attributes
    ----------
    curve, view
        The curve, and its view before the press.
    press
        The pointer at the press.
    append
        Makes the point of a press that does not become a drag.
    pen, key_of_curve
        What the pen knows of the curves that it draws, and this one.
    pulled_before_alt
        The offset of the handle ahead when Alt was not held.
    """

    starts_at_press = True
    curve: int
    view: CurveView
    press: Pointer
    snapper: Snapper
    pen: PenSession
    key_of_curve: CurveKey
    append: Appending = with_point_appended
    pulled_before_alt: Vector | None = None

    def move(self, event: ToolEvent) -> None:
        """Note the offset of the handle while Alt is not held, and preview."""
        super().move(event)
        if not event.pointer.alt and not self.refusal and self._sets_velocity(event.pointer):
            self.pulled_before_alt = self._pulled(event.pointer)

    def wants_key(self, key: str) -> bool:
        """Return whether a key takes back the point that is being drawn."""
        return key in TAKING_BACK

    def key(self, event: ToolEvent, key: str) -> bool:
        """Cancel the drag."""
        if self.wants_key(key):
            event.session.interrupt()
            event.session.say(CANCELLED)
        return False

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point, its handle drawn out to the pointer."""
        index = self._index
        document = self.append(self.document, self.curve, self.view, self._position(pointer))
        if not self._sets_velocity(pointer):
            return document
        ahead = self._pulled(pointer)
        behind = self.pulled_before_alt if pointer.alt else ahead
        document = with_handles_pulled(document, self.curve, index, behind, ahead)
        return with_bare_corner(document, self.curve, index - 1) if index else document

    @property
    def _index(self) -> int:
        return len(self.view.source.points)

    def _position(self, pointer: Pointer) -> Vector:
        moves = _is_away(pointer, self.press) and not self._sets_velocity(pointer)
        at = pointer if moves else self.press
        stepped = position_in_steps(self.view, at)
        if stepped is None:
            return self.snapper.at(at)
        self.snapper.reset()
        return stepped

    def _sets_velocity(self, pointer: Pointer) -> bool:
        return _is_away(pointer, self.press) and self.view.source.family.derivatives > 0

    def _pulled(self, pointer: Pointer) -> Vector:
        """Return the offset to which the handle is pulled out: with Ctrl or Shift in steps of 15°."""
        offset = pointer.offset_from(self._position(pointer))
        return in_steps(offset) if pointer.is_constrained else offset

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Add point 3"."""
        return f"Add point {self._index}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys while it is dragged."""
        # The position was decided at the press; only a velocity is still being set.
        if not self.view.source.family.derivatives:
            return SNAP_KEY
        return f"{STEP_KEYS} · Alt: only the handle ahead"

    def amount(self, pointer: Pointer) -> str:
        """Return the position of the new point and the direction of its velocity."""
        position = self._position(pointer)
        text = f"{self.undo_text(pointer)} at {words.pair_text(position, pointer.pixel_size)}"
        if not self._sets_velocity(pointer):
            return text
        text = f"{text}, velocity at {words.direction(self._pulled(pointer))}"
        if pointer.alt:
            return f"{text} · a corner"
        if self.view.source.is_closed:
            return text
        # What will hold when the next point comes.
        return f"{text} · {'both handles stay' if self.view.source.points else 'the handle stays here'}"

    def committed(self, event: ToolEvent) -> None:
        """Note that the pen draws the curve; not before: Escape leaves a finished curve finished."""
        self.pen.draw(self.key_of_curve, self._index)
        self.pen.before[event.session.document.curves[self.curve].points] = self.view.source.points
        super().committed(event)


class BeginCurve(AppendPoint, kw_only=True):
    """First point of another curve at the press; the document has the empty curve already."""

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Begin Curve 2"."""
        return f"Begin {self.view.source.name}"


class PressOnEnd(AppendPoint, kw_only=True):
    """Press on an end of another curve, out of which a drag pulls a handle."""

    keys = STEP_KEYS

    def amount(self, pointer: Pointer) -> str:
        """Return the direction of the handle that is pulled out."""
        text = self.undo_text(pointer)
        if not self._sets_velocity(pointer):
            return text
        return f"{text}, handle at {words.direction(self._pulled(pointer))}"


class GoOn(PressOnEnd, kw_only=True):
    """Press by which the pen goes on with a curve that it is not drawing, from the last point of `view`.

    The document has the curve reversed where that was its first point. The curve keeps its shape.
    """

    starts_at_press = False
    move = Drag.move

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the handle ahead under the pointer."""
        if not self._sets_velocity(pointer):
            return self.document
        return with_handles_pulled(self.document, self.curve, self._index, None, self._pulled(pointer))

    @property
    def _index(self) -> int:
        return len(self.view.source.points) - 1

    def _position(self, pointer: Pointer) -> Vector:
        return self.view.source.points[self._index].position

    def release(self, event: ToolEvent) -> None:
        """Set the handle; go on without one where none was pulled out."""
        if self._sets_velocity(event.pointer):
            super().release(event)
        else:
            self.click(event)

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Continue Curve 2"."""
        return f"Continue {self.view.source.name}"

    def committed(self, event: ToolEvent) -> None:
        """Note that the pen draws the curve."""
        self.pen.draw(self.key_of_curve, self._index + 1)


class CloseCurve(GoOn, kw_only=True):
    """Press on the first point, which closes the curve; a drag pulls the handle behind it out.

    The handle ahead of it stays where it was pulled, and with Alt in any case.
    """

    keys = f"{STEP_KEYS} · Alt: only the handle behind"
    committed = Drag.committed
    _index = 0

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the curve closed, the handle behind its first point by the pointer."""
        if not self._sets_velocity(pointer):
            return self.document
        document, pulled = closed_by_pen(self.document, self.curve, self.view), self._pulled(pointer)
        ahead = None if pointer.alt or document.curves[self.curve].points[0].corner else pulled
        document = with_handles_pulled(document, self.curve, 0, pulled, ahead)
        return with_bare_corner(document, self.curve, len(self.view.source.points) - 1)

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Close Curve 2"."""
        return f"Close {self.view.source.name}"


class JoinEnd(PressOnEnd, kw_only=True):
    """Last point at an end of another open curve: at the release both become one curve, in one step.

    The curve that is drawn keeps its name, its style and its rules, the other one its shape. The pen has then
    finished.
    """

    end: End

    def _position(self, pointer: Pointer) -> Vector:
        return self.document.curves[self.end.curve].points[-1 if self.end.is_last else 0].position

    def release(self, event: ToolEvent) -> None:
        """Join the curves, or say why they cannot be joined."""
        session, drawn, results = event.session, event.session.document, list[Joined]()
        if self.refusal:
            super().release(event)
            return

        def edit(_document: Document) -> Document:
            results.append(joined_by_pen(drawn, self.curve, self.end))
            return remove_curves(replace_curve(drawn, self.curve, results[0].curve), {self.end.curve})

        active, scroll = self.curve - (self.end.curve < self.curve), event.canvas.scroll_of_drag()
        if session.change(self.undo_text(event.pointer), edit, active=active, scroll=scroll):
            self.pen.finish(session, len(session.active_view.source.points))
            session.selected.set_points([])
            where = f"“{drawn.curves[self.end.curve].name}” at its {self.end.side}"
            kept = "it keeps its shape" if results[0].keeps_shape else results[0].outcome
            session.say(f"Joined with {where}: {kept}.")

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Join Curve 2 and Curve 1"."""
        return f"Join {self.view.source.name} and {self.document.curves[self.end.curve].name}"


class InsertPoint(Drag, kw_only=True, dict=True):
    """New point on the curve where it was pressed, the shape kept if possible; dragging moves it."""

    starts_at_press = True
    curve: int
    view: CurveView
    hit: Hit
    press: Pointer
    snapper: Snapper

    keys = SNAP_KEY

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the new point; dragged off the curve it takes its handles along."""
        document = replace_curve(self.document, self.curve, self._on_curve.curve)
        if not _is_away(pointer, self.press):
            return document
        position = self.snapper.at(pointer)
        if not self.view.source.family.interpolates:
            # The control point is not where the curve was pressed: it moves by the same offset.
            offset = (position[0] - self.hit.position[0], position[1] - self.hit.position[1])
            position = plus(self._on_curve.curve.points[self.hit.index].position, offset)
        return point_edits.set_position(document, self.curve, self.hit.index, position)

    @cached_property
    def _on_curve(self) -> Reshaped:
        """The curve with the point where it was pressed."""
        return with_point_inserted(self.view, self.hit.t)

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Insert point 2"."""
        return f"Insert point {self.hit.index}"

    def amount(self, pointer: Pointer) -> str:
        """Return the position of the new point, or its parameter on the curve."""
        if not _is_away(pointer, self.press):
            return f"{self.undo_text(pointer)} at t = {self.view.t_text(self.hit.t)}"
        return f"{self.undo_text(pointer)} at {words.pair_text(self.snapper.at(pointer), pointer.pixel_size)}"

    def committed(self, event: ToolEvent) -> None:
        """Say whether the shape was kept, unless the point was dragged off the curve."""
        if event.view.source == self._on_curve.curve:
            event.session.report(self._on_curve.sentence, self.document.curves)
