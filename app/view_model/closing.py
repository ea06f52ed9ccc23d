"""A curve closed, or opened again, so that what the person set stays where it is."""

from __future__ import annotations

from msgspec.structs import replace

from app.document.edits import set_closed
from app.document.model import Document
from app.view_model.curve_view import CurveView, scale_of


def with_closed(document: Document, index: int, view: CurveView, closed: bool) -> Document:
    """Return the document with its curve `index`, which `view` shows, closed or open.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    parameter_scale = 1.0
    if view.is_current and not view.source.is_manual:
        parameter_scale = scale_of(view, replace(view.source, closed=closed))
    return set_closed(document, index, closed, parameter_scale=parameter_scale)
