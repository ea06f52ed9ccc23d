"""SVG for the clipboard: of true size, and in pixels where there is no unit of length."""

from __future__ import annotations

from ...document.model import Document
from ...tasks.progress import Report, silent
from ..formats import Written
from ..options import Options
from ..rescaled import in_unit
from ..units import known_unit
from .writer import svg_of


def svg_for_clipboard(document: Document, report: Report = silent) -> Written:
    """Return a document as SVG of true size; without a unit of length, one is a pixel.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    return svg_of(document, Options(unit=known_unit(document.unit) or "px", report=report))


def svg_for_inkscape(document: Document) -> Written:
    """Return the same in pixels: Inkscape 1.2 pastes coordinates as such, whatever the view box.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    return svg_for_clipboard(in_unit(document, "px"))
