"""Pictures: in pixels, as a drawing, which is also read, and as a page."""

from __future__ import annotations

from dataclasses import replace

from .. import corner, drawing, svg
from ..cubics_in import Imported
from ..options import DPI, PICTURE, SCALE, TOLERANCE, TRUE_SIZE, WIDTH
from ..svg.writer import svg_of
from . import ContentKind, Format


def read(data: bytes, tolerance: float | None) -> Imported:
    """Return the curves of a drawing on a page that stands on the origin; see `svg.reader.read_svg`."""
    found = svg.reader.read_svg(data, tolerance)
    return replace(found, document=corner.from_lower_left(found.document))


# Qt is slow to import, and everything else does without: the lambdas ask for `drawing.image` when needed.
# ruff: noqa: PLW0108
FORMATS = (
    Format(
        endings=(".png",),
        title="PNG picture",
        description="Pixels, for slides and pages.",
        place=10,
        options=(*PICTURE[:1], WIDTH, SCALE, DPI, *PICTURE[1:]),
        hidden=lambda values: (WIDTH, SCALE) if values[TRUE_SIZE.name] else (DPI,),
        write=lambda document, options: drawing.image.png_file(document, options),
        preview=lambda document, options, room: drawing.image.png_preview(document, options, room),
        shows_contents=True,
    ),
    Format(
        endings=(".svg",),
        title="SVG drawing",
        description="Bézier curves, a path for each shape, in groups; cubic Hermite curves are exact.",
        place=20,
        options=(*PICTURE, TOLERANCE),
        write=svg_of,
        preview=lambda document, options, room: drawing.image.svg_preview(document, options, room),
        shows_contents=True,
        kind=ContentKind.DRAWING,
        plural="SVG drawings",
        read=read,
        rewrite=lambda data, document, begun, report: svg.in_place.rewriting.rewritten(
            data, document, begun, report
        ),
    ),
    Format(
        endings=(".pdf",),
        title="PDF document",
        description="One page of outlines, sharp at every size but for gradients with transparency.",
        place=30,
        options=(*PICTURE, TOLERANCE),
        write=lambda document, options: drawing.image.pdf_file(document, options),
        preview=lambda document, options, room: drawing.image.pdf_preview(document, options, room),
        shows_contents=True,
    ),
)
