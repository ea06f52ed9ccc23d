"""Pictures as a page of outlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.document.model import Document
from app.exchange import drawing
from app.exchange.formats import Format, Written
from app.exchange.options import PICTURE, TOLERANCE, Options

if TYPE_CHECKING:
    from app.exchange.drawing.image import PicturePreview


# Qt is slow to import, and everything else does without.


def _write(document: Document, options: Options) -> Written:

    return drawing.image.pdf_file(document, options)


def _preview(document: Document, options: Options, room: tuple[int, int]) -> PicturePreview:

    return drawing.image.pdf_preview(document, options, room)


FORMATS = (
    Format(
        endings=(".pdf",),
        title="PDF document",
        description="One page of outlines, sharp at every size.",
        place=30,
        options=(*PICTURE, TOLERANCE),
        write=_write,
        preview=_preview,
    ),
)
