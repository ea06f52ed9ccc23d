"""SVG for the clipboard: of true size, in pixels."""

from __future__ import annotations

from msgspec.structs import replace

from ...document.model import Document
from ...tasks.progress import Report, silent
from ..formats import Written
from ..options import Options
from ..rescaled import in_unit
from .writer import svg_of


def svg_for_clipboard(document: Document, report: Report = silent) -> Written:
    """Return a document as SVG whose coordinates are pixels; without a unit of length, one is a pixel.

    Inkscape 1.2 pastes the coordinates as they are, whatever the view box.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    # Who pastes it has guides of his own.
    plain = replace(document, guides=())
    return svg_of(in_unit(plain, "px"), Options(unit="px", report=report))
