"""Extents of what is painted along outlines."""

from __future__ import annotations

from curvecore.arrays import FloatArray

from ...view_model.geometry.extents import extent_of, turns_within
from ...view_model.geometry.stroked import half_width, line_of, stroke_box
from .outlines import Outline


def painted_extent(outline: Outline) -> FloatArray:
    """Return the corners, (2, 2), of the box of a curve with its stroke: with its caps, joins and miters."""
    controls, line = outline.control_points, None
    if half_width(outline.style) > 0.0:
        line = line_of(controls, turns_within(controls), is_closed=outline.closed)
    return extent_of(controls) if line is None else stroke_box(line, outline.style)
