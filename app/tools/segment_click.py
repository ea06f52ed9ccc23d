"""Clicks on the line of the edited curve: one selects the ends of its segment, two insert a point."""

from __future__ import annotations

from ..document import words
from ..document.curve_edits import replace_curve
from ..document.model import Document
from ..document.point_group import NO_POINTS, PointGroup, points_of
from ..view_model.curve.curve_view import CurveView
from ..view_model.geometry import segment_at
from ..view_model.reshape import Reshaped, inserted_index, with_point_inserted
from . import hints
from .drag_machine import EditingSession
from .pointer import Hit, Pointer


def click_segment(session: EditingSession, hit: Hit, pointer: Pointer) -> None:
    """Select the ends of the segment hit, alone, or with Shift too or no longer; say what c(t) is there."""
    selected, ends = session.selected, _ends_of(session.active_view, session.active_index, hit.t)
    if ends.parts:
        selected.set_group(_toggled(selected.group, ends) if pointer.shift else ends)
    said = f"t = {words.number(hit.t)} · c(t) = ({words.pair(hit.position)})"
    session.say(f"{hints.selected(selected.group)} · {said}" if ends.parts else said)


def _ends_of(view: CurveView, curve: int, t: float) -> PointGroup:
    """Return the points at both ends of the segment at `t`; none where the curve passes by its points."""
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
    view, active, made = session.active_view, session.active_index, list[Reshaped]()

    def edit(document: Document) -> Document:
        made.append(with_point_inserted(view, t))
        return replace_curve(document, active, made[0].curve)

    index = inserted_index(view, t)
    if session.change(f"Insert point {index}", edit):
        session.selected.set_points([index])
        session.say(made[0].sentence)
