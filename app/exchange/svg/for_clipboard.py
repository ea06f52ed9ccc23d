"""SVG for the clipboard: of true size, and in pixels where there is no unit of length."""

from __future__ import annotations

from msgspec.structs import replace

from ...document.model import Document
from ...tasks.progress import Report, silent
from ..formats import Written
from ..options import Options
from ..rescaled import in_unit
from ..units import known_unit
from .writer import svg_of


def svg_for_clipboard(document: Document, report: Report = silent, *, in_group: bool = False) -> Written:
    """Return a document as SVG of true size; without a unit of length, one is a pixel. See `svg_of`.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    options = Options(unit=known_unit(document.unit) or "px", report=report)
    # Who pastes it has guides of his own.
    return svg_of(replace(document, guides=(), layers=()), options, in_group=in_group)


def svg_for_inkscape(document: Document) -> Written:
    """Return the same in pixels, in a group: what Inkscape 1.2 pastes.

    It takes coordinates as such, whatever the view box. And it dissolves the outermost groups of what has
    its own MIME type, for it puts all that it copies into some.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    return svg_for_clipboard(in_unit(document, "px"), in_group=True)
