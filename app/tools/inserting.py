"""A point inserted on the curve that is edited."""

from __future__ import annotations

from ..document.curve_edits import replace_curve
from ..document.model import Document
from ..view_model.fitting.reshape import Reshaped, inserted_index, with_point_inserted
from .drag_machine import EditingHost


def insert_at(host: EditingHost, t: float) -> None:
    """Insert a point on the active curve at `t`, and select it alone."""
    view, active, made = host.active_view, host.active_index, list[Reshaped]()

    def edit(document: Document) -> Document:
        made.append(with_point_inserted(view, t))
        return replace_curve(document, active, made[0].curve)

    index = inserted_index(view, t)
    if host.change(f"Insert point {index}", edit):
        host.selected.set_points([index])
        host.say(made[0].sentence)
