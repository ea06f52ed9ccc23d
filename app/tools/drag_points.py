"""Drag points: from the press on a point to the undo step.

In order of time: the press decides which points move and what a click selects; every move computes the
document anew from the press; the release makes one undo step (`Drag.release`); Escape restores document and
selection (`Toolbox.cancel`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from ..document import point_edits, words
from ..document.curve_edits import locked_message, replace_curve
from ..document.model import Document, Vector
from ..document.point_group import PointGroup, points_of
from ..document.selection import SelectionState
from ..document.several_curves import move_group
from ..view_model.curve.curve_view import CurveView
from ..view_model.point_kinds import inner_points, toggled
from .pointer import (
    AXIS_KEYS,
    SNAP_KEY,
    Hint,
    Hit,
    Part,
    Pointer,
    along_axis,
    axis_held,
    drag_to_move,
    minus,
    plus,
    selection_text,
    snap_key_text,
)
from .snapping import Snapper
from .tool import Drag, Gesture, Refusal, ToolEvent

Click = Callable[[ToolEvent], object]
"""The effect of a click: called at the release of a press that was no drag, with the event of the release."""


def press_on_point(event: ToolEvent, hit: Hit, on_click: Click | None = None) -> Gesture:
    """Start to drag the point that was hit, together with all selected points if it is one of them.

    The press selects the point if it was not selected. A click selects it alone; with Shift it is added to
    the selection, or removed; `on_click` replaces that.
    """
    session, selected = event.session, event.session.selected
    on_click = on_click or selecting(event, hit.index)
    if hit.index not in selected.points:
        # Alone: a drag with Shift moves this point along an axis; only a click adds it to the selection.
        selected.set_points([hit.index])
    drag = press_on_group(event, selected.group, on_click, grabbed=(session.active_index, hit.index))
    return unless_locked(event, drag)


def press_on_group(
    event: ToolEvent,
    group: PointGroup,
    on_click: Click,
    selects: SelectionState | None = None,
    grabbed: tuple[int, int] | None = None,
) -> MovePoints:
    """Start to move a group; the grabbed point snaps, or else the one nearest to the pointer."""
    grabbed = grabbed or nearest_point(event, group)
    return MovePoints(
        document=event.session.document,
        group=group,
        grabbed=grabbed,
        start=event.pointer.position,
        snapper=event.snapping.for_points(group, grabbed),
        selects=selects,
        on_click=on_click,
    )


def nearest_point(event: ToolEvent, group: PointGroup) -> tuple[int, int]:
    """Return the curve and the index of the point of a group that is nearest to the pointer."""
    curves, pointer = event.session.document.curves, event.pointer
    points = [(curve, index) for curve, indices in group.parts for index in indices]
    return min(points, key=lambda at: math.dist(curves[at[0]].points[at[1]].position, pointer.position))


def unless_locked(event: ToolEvent, drag: Drag) -> Gesture:
    """Return the drag, or a refusal where the curve is locked."""
    source = event.view.source
    if not source.locked:
        return drag
    return Refusal(reason=locked_message([source.display_name]), on_click=drag.on_click)


def selecting(event: ToolEvent, index: int) -> Click:
    """Return the click that selects a point alone, or with Shift adds or removes it."""
    before, point = event.session.selected.group, points_of(event.session.active_index, [index])
    if not event.pointer.shift:
        return lambda click: click.session.selected.set_group(point)

    def toggle(click: ToolEvent) -> None:
        selected = click.session.selected
        selected.set_group(before.toggled(point))
        click.session.say(f"{selection_text(selected.group)}.")

    return toggle


def toggling_kind(event: ToolEvent, hit: Hit) -> Click | None:
    """Return the click that toggles corner and smooth: the second of a double click; None for any other."""
    pointer = event.pointer
    is_plain = pointer.is_double and not (pointer.shift or pointer.ctrl or pointer.alt)
    if hit.part is not Part.POINT or not is_plain or not event.view.source.family.derivatives:
        return None
    return partial(_toggle_kind, index=hit.index)


def _toggle_kind(event: ToolEvent, index: int) -> None:
    """Make a corner smooth, and any other point a corner."""
    session, view, active = event.session, event.view, event.session.active_index
    kind, before = toggled(view, index), session.document.curves

    def edit(document: Document) -> Document:
        return replace_curve(document, active, kind.apply(view, [index]))

    if session.change(f"{kind.step} point {index}", edit):
        done = f"{kind.title} at point {index}; a double click toggles corner and smooth."
        session.report(done, before, [view.source.points[index].position])


class MovePoints(Drag, kw_only=True):
    """Drag of points, or of whole curves. Ctrl or Shift keeps to one axis; % turns snapping on and off.

    Attributes
    ----------
    grabbed
        The curve and the index of the point under the pointer: this one snaps.
    start
        The position of the press.
    snapper
        Snaps the grabbed point; the others keep their offsets from it.
    axis
        0 or 1 where an axis is locked from the start.
    """

    grabbed: tuple[int, int]
    start: Vector
    snapper: Snapper
    axis: int | None = None

    keys = f"{AXIS_KEYS} · {SNAP_KEY}"

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the points moved by the whole offset from the press."""
        document = move_group(self.document, self.group, self.offset(pointer))
        if self.snapper.caught is not None:
            # p + (q − p) may miss q by a rounding: a snapped point lies exactly on its target.
            document = point_edits.set_position(document, *self.grabbed, self.snapper.caught.position)
        return document

    def offset(self, pointer: Pointer) -> Vector:
        """Return the offset of the points, with the grabbed one snapped."""
        offset = pointer.offset_from(self.start)
        axis = axis_held(offset, pointer) if self.axis is None else self.axis
        offset = along_axis(offset, axis)
        target = self.snapper.snap(plus(self._grabbed_position, offset), pointer, axis)
        return offset if self.snapper.caught is None else minus(target, self._grabbed_position)

    @property
    def _grabbed_position(self) -> Vector:
        curve, index = self.grabbed
        return self.document.curves[curve].points[index].position

    def position_at(self, pointer: Pointer) -> Vector:
        """Return the position of the grabbed point, exact where it has snapped."""
        offset, caught = self.offset(pointer), self.snapper.caught
        return plus(self._grabbed_position, offset) if caught is None else caught.position

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Move point 2", "Move 4 points"."""
        return f"Move {self.group.label}"

    def amount(self, pointer: Pointer) -> str:
        """Return "Point 2: (1.7, 1.1) · moved (−0.3, 0.1)"; of several points their offset."""
        offset, one = words.pair_text(self.offset(pointer), pointer.pixel_size), self.group.only_point
        if one is None:
            return f"Move {self.group.label} by {offset}"
        return f"{words.point_at(one[1], self.position_at(pointer), pointer.pixel_size)} · moved {offset}"


# What a press would do


def label_of_moved(event: ToolEvent, hit: Hit) -> str:
    """Return the label of the points that a drag moves: "point 2", or "4 points" if it is one of them."""
    session = event.session
    curve, group = hit.curve if hit.part is Part.OTHER_POINT else session.active_index, session.selected.group
    if hit.index in group.of(curve) and group.count > 1:
        return group.label
    source = session.views[curve].source
    of = f" of “{source.name}”" if curve != session.active_index else ""
    return f"{source.family.point} {hit.index}{of}"


def hint_on_point(hit: Hit, view: CurveView, moves: str, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint over a point of which a drag `moves` something, such as "4 points"."""
    text = f"{drag_to_move(moves, pointer)} · {AXIS_KEYS} · Shift+click: add to or remove from the selection"
    text += f" · {snap_key_text(snaps=snaps)}"
    if view.source.family.derivatives:
        text += " · Alt: pull out its velocity"
    return Hint(text, grab=True)


def kind_on_double_click(hit: Hit, view: CurveView, pointer: Pointer) -> str:
    """Return the effect of a double click on the point hit, to follow a hint; empty for none."""
    has_kind = view.source.family.derivatives and hit.part is Part.POINT
    if not has_kind or pointer.alt or not inner_points(view.source, [hit.index]):
        return ""
    return f" · Double click: {toggled(view, hit.index).title.lower()}"
