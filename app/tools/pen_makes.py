"""What the pen makes, as the document and the person's settings have it."""

from __future__ import annotations

from ..document.curve_edits import fresh_curve
from ..document.model import Curve, Parametrization
from ..document.paper import DocumentKind, kind_of
from ..families import HERMITE
from ..view_model.points.appending import Appending, with_point_appended
from ..view_model.points.pen_corners import with_corner_appended
from ..view_model.points.straight import with_line_appended
from .tool import ToolContext


def is_drawing(context: ToolContext) -> bool:
    """Whether the document is a drawing on a page."""
    return kind_of(context.host.document) is DocumentKind.DRAWING


def makes_corners(context: ToolContext) -> bool:
    """Whether clicks make corners, where the curve has velocities."""
    return context.settings.pen.makes_corners(context.host.document)


def appending(context: ToolContext) -> Appending:
    """Return what a click makes; Alt makes the other."""
    if makes_corners(context):
        return with_point_appended if context.pointer.alt else with_corner_appended
    return with_line_appended if context.pointer.alt else with_point_appended


def fresh(context: ToolContext) -> Curve:
    """Return another curve to begin: as the one that is edited, with velocities where clicks make corners."""
    document, model = context.host.document, context.host.model
    if model.family.derivatives or not makes_corners(context):
        return fresh_curve(document, model, model.parametrization)
    return fresh_curve(document, model, Parametrization()).with_family(HERMITE)
