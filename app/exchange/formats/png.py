"""Pictures in pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.document.model import Document
from app.exchange import drawing
from app.exchange.formats import Format, Written
from app.exchange.options import PICTURE, SCALE, WIDTH, Options

if TYPE_CHECKING:
    from app.exchange.drawing.image import PicturePreview


# Qt is slow to import, and everything else does without.


def _write(document: Document, options: Options) -> Written:

    return drawing.image.png_file(document, options)


def _preview(document: Document, options: Options, room: tuple[int, int]) -> PicturePreview:

    return drawing.image.png_preview(document, options, room)


FORMATS = (
    Format(
        endings=(".png",),
        title="PNG picture",
        description="Pixels, for slides and pages.",
        place=10,
        options=(WIDTH, SCALE, *PICTURE),
        write=_write,
        preview=_preview,
    ),
)
