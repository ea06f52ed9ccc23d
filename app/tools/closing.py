"""The pen on the first point of an open curve: a click there closes the curve."""

from __future__ import annotations

from app.document.edits import LEAST_TO_CLOSE
from app.tools.drag_machine import EditingHost
from app.tools.pointer import Hit, Part
from app.view_model.appending import closed_by_pen
from app.view_model.curve_view import CurveView


def can_end_at(hit: Hit | None, view: CurveView) -> bool:
    """Whether the curve might end at what is hit: its first point, and there are others to go around."""
    curve = view.source
    is_first = hit is not None and hit.part is Part.POINT and hit.index == 0
    return is_first and not curve.is_closed and len(curve.points) >= LEAST_TO_CLOSE


def close_curve(host: EditingHost) -> None:
    """Close the curve that is edited, or say why it cannot be closed."""
    active, view = host.active_index, host.active_view
    host.change(f"Close {view.source.name}", lambda document: closed_by_pen(document, active, view))
