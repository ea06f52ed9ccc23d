"""Bend the curve: from the press on its line to the undo step; clicks select a segment or insert a point."""

from __future__ import annotations

from functools import partial

import msgspec

from ..document import words
from ..document.curve_edits import replace_curve
from ..document.model import Document, Vector
from ..document.point_group import NO_POINTS, PointGroup, points_of
from ..view_model.bend import Bend, BendWith, has_handles
from ..view_model.curve.curve_view import CurveView
from ..view_model.geometry import segment_at
from ..view_model.reshape import Reshaped, inserted_index, with_point_inserted
from .drag_points import unless_locked
from .editing_session import EditingSession
from .pointer import Cursor, Hint, Hit, Pointer, plus, selection_text
from .tool import Drag, Gesture, ToolEvent

_TOLERANCE = 0.05
"""Pixels that the grabbed point may be off, where the parameters answer to the points."""


def press_on_line(event: ToolEvent, hit: Hit, *, is_second: bool = False) -> Gesture:
    """Start to bend the curve. A click selects both ends of the segment, the second one inserts a point."""
    session, pointer = event.session, event.pointer
    click = partial(click_segment, hit=hit, is_added=pointer.shift)
    drag = BendCurve(
        document=session.document,
        curve=session.active_index,
        view=event.view,
        hit=hit,
        start=pointer.position,
        on_click=(lambda click: insert_at(click.session, hit.t)) if is_second else click,
    )
    return unless_locked(event, drag)


class BendCurve(Drag, kw_only=True):
    """Drag of a point of the line: the least change of the handles by which it follows; the points stay.

    With Alt they come along, with Ctrl they alone move, and where there are no handles they do in any case.
    """

    curve: int
    view: CurveView
    hit: Hit
    start: Vector
    bends: dict[BendWith, Bend] = msgspec.field(default_factory=dict)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the grabbed point at its distance to the pointer."""
        curve = self._bend(pointer).bent(self._target(pointer), _TOLERANCE / pointer.scale)
        return self.document.with_curve(self.curve, curve)

    def _target(self, pointer: Pointer) -> Vector:
        return plus(self.hit.position, pointer.offset_from(self.start))

    def _bend(self, pointer: Pointer) -> Bend:
        """Return the bend of the data that change with the keys that are held."""
        using = bend_with(self.view, pointer)
        if using not in self.bends:
            self.bends[using] = Bend(self.view, self.hit.t, using)
        return self.bends[using]

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Bend curve at t = 0.5"."""
        return f"Bend curve at t = {self.view.t_text(self.hit.t)}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys."""
        return _keys(self.view)

    def amount(self, pointer: Pointer) -> str:
        """Return the parameter of the grabbed point, and the effect."""
        # Which data change most is decided by weights; the grabbed point follows exactly.
        is_weighted = self.view.linearised and bend_with(self.view, pointer) is BendWith.POINTS
        weights = f", by weights {self.view.linearised}" if is_weighted else ""
        is_limited = self._bend(pointer).is_limited(self._target(pointer))
        limit = ", handles are limited so close to one" if is_limited else ""
        return f"Bend at t = {self.view.t_text(self.hit.t)}: {_effect(self.view, pointer)}{weights}{limit}"


def bend_with(view: CurveView, pointer: Pointer) -> BendWith:
    """Return the data that a bend changes with the keys that are held."""
    if pointer.ctrl or not has_handles(view):
        return BendWith.POINTS
    return BendWith.ALL if pointer.alt else BendWith.DERIVATIVES


def _effect(view: CurveView, pointer: Pointer) -> str:
    """Return the effect of a bend on the points."""
    if not has_handles(view):
        return f"this family has no handles: the {view.source.family.point}s move"
    return bend_with(view, pointer).value


def _keys(view: CurveView) -> str:
    return "Alt: move the points as well · Ctrl: move only the points" if has_handles(view) else ""


# Clicks


def click_segment(event: ToolEvent, hit: Hit, *, is_added: bool) -> None:
    """Select the ends of the segment hit, alone or added to the selection; say the value of c(t)."""
    session, selected = event.session, event.session.selected
    ends = _ends_of(session.active_view, session.active_index, hit.t)
    if ends.parts:
        selected.set_group(_toggled(selected.group, ends) if is_added else ends)
    position = words.pair_text(hit.position, event.pointer.pixel_size)
    value = f"t = {event.session.active_view.t_text(hit.t)} · c(t) = ({position})"
    session.say(f"{selection_text(selected.group)} · {value}" if ends.parts else value)


def _ends_of(view: CurveView, curve: int, t: float) -> PointGroup:
    """Return both ends of the segment at `t`; none where the curve does not interpolate its points."""
    if not view.source.family.interpolates:
        return NO_POINTS
    start, count = segment_at(view.parameters, t), len(view.source.points)
    return points_of(curve, {start, (start + 1) % count})


def _toggled(before: PointGroup, ends: PointGroup) -> PointGroup:
    """Return the points selected with both ends, or without them where both are already."""
    both = before.joined(ends)
    return before.toggled(ends) if both == before else both


def insert_at(session: EditingSession, t: float) -> None:
    """Insert a point on the active curve at `t`, and select it alone."""
    view, active, results = session.active_view, session.active_index, list[Reshaped]()
    before = session.document.curves

    def edit(document: Document) -> Document:
        results.append(with_point_inserted(view, t))
        return replace_curve(document, active, results[0].curve)

    index = inserted_index(view, t)
    if session.change(f"Insert point {index}", edit):
        session.selected.set_points([index])
        session.report(results[0].sentence, before)


# What a press would do


def hint_on_line(view: CurveView, pointer: Pointer) -> Hint:
    """Return the hint over the curve, with the keys that are held."""
    text = f"Drag to bend; {_effect(view, pointer)}"
    more = [] if pointer.alt or pointer.ctrl else [_keys(view), _clicks(view, pointer)]
    return Hint(" · ".join(filter(None, (text, *more))), cursor=Cursor.BEND)


def _clicks(view: CurveView, pointer: Pointer) -> str:
    """Return the effects of a click on the line, and of a second one."""
    selects = view.source.family.interpolates
    if pointer.shift:
        return "Click: add both ends to the selection" if selects else ""
    return f"{'Click: select both ends · ' if selects else ''}Double click: insert a point"
