"""SVG drawings, out and in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.document.model import Document
from app.exchange import drawing, svg
from app.exchange.cubics_in import Imported
from app.exchange.formats import ContentKind, Format
from app.exchange.options import PICTURE, TOLERANCE, Options
from app.exchange.svg.writer import svg_of

if TYPE_CHECKING:
    from app.exchange.drawing.image import PicturePreview


def _preview(document: Document, options: Options, room: tuple[int, int]) -> PicturePreview:

    return drawing.image.svg_preview(document, options, room)


def read(data: bytes, tolerance: float | None) -> Imported:
    """Return the curves of a drawing; see `svg.reader.read_svg`."""
    return svg.reader.read_svg(data, tolerance)


FORMATS = (
    Format(
        endings=(".svg",),
        title="SVG drawing",
        description="Bézier curves, a path for each curve; cubic Hermite curves are exact.",
        place=20,
        options=(*PICTURE, TOLERANCE),
        write=svg_of,
        preview=_preview,
        kind=ContentKind.DRAWING,
        plural="SVG drawings",
        read=read,
    ),
)
