"""Hints: the sentence about what a press would do, and what a modifier would change."""

from __future__ import annotations

from ..document.point_group import PointGroup
from ..view_model.curve.curve_view import CurveView
from .pointer import Cursor, Hint, Hit, Part, Pointer
from .transform import TransformKind, grip_keys
from .transform_box import Grip, ScaleBox, TransformBox

LOCKED = "“{}” is locked. Unlock it in the list of curves to change it."


def selected(group: PointGroup) -> str:
    """Return how many points are selected: "Point 3 selected", "5 points in 2 curves selected"."""
    words = f"{group.label} selected" if group.parts else "no point selected"
    return f"{words[0].upper()}{words[1:]}"


def to_move(what: str, pointer: Pointer) -> str:
    """Return what a drag of points or curves does with the keys that are held."""
    axis = " along one axis" if pointer.holds_line else ""
    return f"Drag to move {what}{axis}"


def inside_box(group: PointGroup, pointer: Pointer, *, snaps: bool) -> Hint:
    """Return the hint inside the box around a group."""
    keys = f"Ctrl: one axis · Shift+drag: rubber band · {snap_key(snaps=snaps)} · A click lets go"
    return Hint(f"{to_move(group.quoted_label, pointer)} · {keys}", cursor=Cursor.MOVE)


def on_grip(grip: Grip, box: TransformBox, group: PointGroup, refusal: str) -> Hint:
    """Return the hint over a grip of the box around a group, or why it cannot be changed."""
    if refusal:
        return Hint(refusal)
    keys = ScaleBox.keys if grip.does is TransformKind.SCALE else grip_keys(grip.does, has_opposite=box.turns)
    return Hint(f"Drag to {grip.does.title.lower()} {group.label} · {keys}", cursor=grip.cursor)


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


def snap_key(*, snaps: bool) -> str:
    """Return what the key of snapping does now."""
    return f"%: {'no snap' if snaps else 'snap'}"
