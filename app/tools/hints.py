"""Hints: the sentence about what a press would do, and what a modifier would change."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.model import Curve
from ..document.point_group import PointGroup
from ..view_model.curve.curve_view import CurveView
from ..view_model.point_kinds import inner_points, toggled
from .drags import bend_keys, handle_keys, what_bends, what_handle_sets
from .pen_drags import PenAct
from .pointer import AXIS_KEYS, Cursor, Hint, Hit, Part, Pointer
from .transform import TransformKind, grip_keys
from .transform_box import Grip, ScaleBox, TransformBox

_ENTER = "Enter, double click: finish the curve"
_ON_EMPTY = (
    "Drag to select points, Shift adds · Escape: whole curves · P adds points · Wheel zooms, Space pans"
)
LOCKED = "“{}” is locked; unlock it in the list of curves to change it."


def selected(group: PointGroup) -> str:
    """Return how many points are selected: "Point 3 selected", "5 points in 2 curves selected"."""
    words = f"{group.words} selected" if group.parts else "no point selected"
    return f"{words[0].upper()}{words[1:]}"


def to_select(hit: Hit | None, view: CurveView, dragged: str, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint of the Select tool over what belongs to a curve edited, or beside them.

    `dragged` is what a drag of the point hit moves, in words.
    """
    if hit is None:
        return Hint(_ON_EMPTY)
    if view.source.locked:
        return Hint(LOCKED.format(view.source.seen_name))
    if hit.part is Part.CURVE:
        return to_bend(view, pointer)
    hint = on_part(hit, view, dragged, pointer, snaps=snaps)
    has_kind = view.source.family.derivatives and hit.part is Part.POINT
    if not has_kind or pointer.alt or not inner_points(view.source, [hit.index]):
        return hint
    return replace(hint, text=f"{hint.text} · Double click: {toggled(view, hit.index).title.lower()}")


def on_part(hit: Hit, view: CurveView, dragged: str, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint over a point or a handle; see `to_select`."""
    if hit.part is not Part.POINT:
        keys = handle_keys(hit, view)
        retracts = " · Ctrl+click: retract it" if hit.kind == 1 else ""
        return Hint(f"Drag to set the {what_handle_sets(hit, view)} · {keys}{retracts}", grab=True)
    if pointer.alt and view.source.family.derivatives:
        steps = " in steps of 15°" if pointer.holds_line else ""
        return Hint(f"Drag to pull out the velocity of point {hit.index}{steps}", grab=True)
    text = f"{to_move(dragged, pointer)} · {AXIS_KEYS} · Shift+click: select it too, or no longer"
    text += f" · {_snap_key(snaps=snaps)}"
    if view.source.family.derivatives:
        text += " · Alt: pull out its velocity"
    return Hint(text, grab=True)


def to_move(what: str, pointer: Pointer) -> str:
    """Return what a drag of points or curves does with the keys that are held."""
    axis = " along one axis" if pointer.holds_line else ""
    return f"Drag to move {what}{axis}"


def inside_box(group: PointGroup, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint inside the box around a group."""
    keys = f"Ctrl: one axis · Shift+drag: rubber band · {_snap_key(snaps=snaps)} · A click lets go"
    return Hint(f"{to_move(group.quoted, pointer)} · {keys}", cursor=Cursor.MOVE)


def on_grip(grip: Grip, box: TransformBox, group: PointGroup, refusal: str) -> Hint:
    """Return the hint over a grip of the box around a group, or why it cannot be changed."""
    if refusal:
        return Hint(refusal)
    keys = ScaleBox.keys if grip.does is TransformKind.SCALE else grip_keys(grip.does, has_opposite=box.turns)
    return Hint(f"Drag to {grip.does.title.lower()} {group.words} · {keys}", cursor=grip.cursor)


def to_bend(view: CurveView, pointer: Pointer) -> Hint:
    """Return the hint over the curve, selecting."""
    keys = "" if pointer.alt or pointer.ctrl else bend_keys(view)
    text = f"Drag to bend; {what_bends(view, pointer)}"
    click = "" if pointer.alt or pointer.ctrl else _clicks_on_line(view, pointer)
    return Hint(" · ".join(filter(None, (text, keys, click))), cursor=Cursor.BEND)


def _clicks_on_line(view: CurveView, pointer: Pointer) -> str:
    """Return what a click on the curve selects, and what a second one does."""
    selects = view.source.family.interpolates
    if pointer.shift:
        return "Click: select both ends, too" if selects else ""
    return f"{'Click: select both ends · ' if selects else ''}Double click: insert a point"


def to_add_on_part(
    hit: Hit,
    view: CurveView,
    dragged: str,
    pointer: Pointer,
    *,
    snaps: bool,
    goes_on: bool,
) -> Hint:
    """Return the hint of the Add tool over a point or a handle; `goes_on`: what a click on an end does."""
    if goes_on:
        end = "" if is_end(hit, view) else " from its first point"
        return Hint(f"Click to go on with this curve{end} · Drag to move point {hit.index}", grab=True)
    if can_end_at(hit, view):
        if not view.source.family.curve_class.can_close:
            # A click says why, and which families can.
            return Hint(f"Drag to move point 0 · {view.source.family.subject} cannot be closed", grab=True)
        line = " · Alt: by a straight line" if view.source.family.derivatives else ""
        return Hint(f"Click to close the curve{line} · Drag to move point 0", grab=True)
    return on_part(hit, view, dragged, pointer, snaps=snaps)


def to_add(
    act: PenAct,
    view: CurveView,
    fresh: Curve,
    *,
    snaps: bool,
    goes_on: bool = True,
) -> Hint:
    """Return the hint of the Add tool, on the curve or beside it.

    `fresh` is a curve that would be begun; `goes_on` tells whether Shift adds to the curve that is seen.
    """
    if act is PenAct.INSERT:
        return Hint("Click to insert a point here · Shift: add at the end")
    keys, index = _snap_key(snaps=snaps), len(view.source.points)
    if act is PenAct.BEGIN:
        other = "" if fresh.family == view.source.family else f", {fresh.family.title}"
        shift = f" · Shift: add point {index} to this one" if goes_on else ""
        return Hint(f"Click to begin another curve{other}{shift} · {keys}")
    what, finish = f"Click to add point {index}", _ENTER if can_finish(view) else ""
    if not view.source.family.derivatives:
        drag = "On the curve: insert between neighbours"
    else:
        drag = "Alt: after a straight line · Drag to set its velocity"
    parts = (what, finish, drag, "Ctrl: steps of 15°" if index else "", keys)
    return Hint(" · ".join(part for part in parts if part))


def can_finish(view: CurveView) -> bool:
    """Whether there is a curve with an end, so that the pen can finish it and begin another one."""
    return not view.source.is_closed and len(view.source.points) > 1


def can_end_at(hit: Hit | None, view: CurveView) -> bool:
    """Whether the curve might end at what is hit: its first point, and there are others to go around."""
    curve = view.source
    is_first = hit is not None and is_beginning(hit, view)
    return is_first and len(curve.points) >= curve.family.least_to_close


def is_beginning(hit: Hit, view: CurveView) -> bool:
    """Whether the first point of an open curve is hit."""
    return hit.part is Part.POINT and hit.index == 0 and not view.source.is_closed


def is_end(hit: Hit, view: CurveView) -> bool:
    """Whether the last point of an open curve is hit."""
    is_last = hit.part is Part.POINT and hit.index == len(view.source.points) - 1
    return is_last and not view.source.is_closed


def is_no_part(hit: Hit | None) -> bool:
    """Whether neither a point nor a handle is hit: the curve itself, or nothing."""
    return hit is None or hit.part is Part.CURVE


def _snap_key(*, snaps: bool) -> str:
    """Return what the key of snapping does now."""
    return f"%: {'no snap' if snaps else 'snap'}"
