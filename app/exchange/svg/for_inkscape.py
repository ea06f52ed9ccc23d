"""SVG for the clipboard of Inkscape 1.2, which takes coordinates there for pixels, whatever the view box."""

from __future__ import annotations

from msgspec.structs import replace

from ...document.model import Document
from ..formats import Written
from ..options import Options
from ..rescaled import enlarged, in_unit
from ..units import known_unit
from .writer import NOMINAL_SIDE, svg_of

_ICON = 16.0
"""Pixels of the smallest icon: without a unit, what is smaller is no drawing in pixels."""


def svg_for_inkscape(document: Document) -> Written:
    """Return a document as SVG in pixels: at true size where it has a unit.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    if known_unit(document.unit):
        return svg_of(in_unit(document, "px"), Options(unit="px"))
    side = _side(document)
    factor = NOMINAL_SIDE / side if 0 < side < _ICON else 1.0
    return svg_of(replace(enlarged(document, factor), unit="px"), Options(unit="px"))


def _side(document: Document) -> float:
    """Return the longer side of the box around all points."""
    points = [point for curve in document.curves for point in curve.points]
    across, up = [point.x for point in points], [point.y for point in points]
    return max(max(across) - min(across), max(up) - min(up))
