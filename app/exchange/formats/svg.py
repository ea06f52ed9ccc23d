"""SVG drawings, out and in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.document.model import Document
from app.exchange import drawing, svg
from app.exchange.cubics_in import Imported
from app.exchange.formats import Format, Kind, Written
from app.exchange.options import PICTURE, TOLERANCE, Options
from app.exchange.svg.writer import picture_of, svg_text
from app.tasks.progress import part

if TYPE_CHECKING:
    from app.exchange.drawing.image import PicturePreview


def _write(document: Document, options: Options) -> Written:
    style, report = options.vector_style, part(options.report, 0.0, 0.7)
    drawing = picture_of(document, options.tolerance, options.extras, style, report)
    text = svg_text(
        drawing,
        style=style,
        points=options.points,
        width=options.width,
        unit=options.unit,
        report=part(options.report, 0.7, 1.0),
    )
    return Written(text, drawing.deviation, drawing.remarks)


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
        write=_write,
        preview=_preview,
        kind=Kind.DRAWING,
        plural="SVG drawings",
        read=read,
    ),
)
