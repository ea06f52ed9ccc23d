"""SVG for the clipboard: of true size, and in pixels where there is no unit of length."""

from __future__ import annotations

from dataclasses import replace as with_fields

from msgspec.structs import replace

from ...document.layers import out_of_layers
from ...document.model import Document, Page
from ...tasks.progress import Report, silent
from ..formats import Written
from ..options import Options
from ..rescaled import in_unit
from ..units import known_unit
from .copied import place_element
from .writer import svg_of


def svg_for_clipboard(document: Document, report: Report = silent, *, in_group: bool = False) -> Written:
    """Return a document as SVG of true size; without a unit of length, one is a pixel. See `svg_of`.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    options = Options(unit=known_unit(document.unit) or "px", report=report)
    # Who pastes it has layers and guides of his own.
    return svg_of(replace(out_of_layers(document), guides=()), options, in_group=in_group)


def svg_for_inkscape(document: Document, page: Page | None = None) -> Written:
    """Return the same in pixels, in a group, with its place on a page, or its own: what Inkscape 1.2 pastes.

    It takes coordinates as such, whatever the view box. And it dissolves the outermost groups of what has
    its own MIME type, for it puts all that it copies into some.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    in_pixels = in_unit(replace(document, page=document.page or page), "px")
    written = svg_for_clipboard(replace(in_pixels, page=None), in_group=True)
    head, end = written.text.rsplit("</svg>", 1)
    place = place_element(in_pixels, in_pixels.page)
    return with_fields(written, content=f"{head}{place}\n</svg>{end}")
