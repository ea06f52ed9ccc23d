"""The curve as it would be with one point more, shown before the pen is pressed."""

from __future__ import annotations

from app.document.edits import EditError
from app.document.model import Document, Vector
from app.view_model.appending import with_point_appended
from app.view_model.curve_view import CurveView, view_of

_MOST_LOCAL, _MOST_GLOBAL = 200, 24
"""Points up to which it takes a millisecond at each move of the pointer.

Beyond some 40 points a Lagrange curve by the distances swings so wildly that flattening it takes 5 to 80 ms.
"""


def view_with_point(
    document: Document, curve: int, view: CurveView, position: Vector, previous: CurveView | None = None
) -> CurveView | None:
    """Return the view of curve `curve` of the document, which `view` shows, with a last point at `position`.

    None where there is no such curve, or where it would take too long. `previous` is the view that this
    returned last; it lends what did not change.
    """
    if not 0 < len(view.source.points) <= (_MOST_LOCAL if view.source.family.is_local else _MOST_GLOBAL):
        return None
    try:
        longer = with_point_appended(document, curve, view, position).curves[curve]
    except EditError:
        return None
    ahead = view_of(longer, previous)
    return ahead if ahead.is_current else None
