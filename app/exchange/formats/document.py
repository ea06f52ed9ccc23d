"""Curvebench's own documents."""

from __future__ import annotations

from ...document.model import Document
from ...storage.files import folder_of, with_relative_image_path
from ...storage.format import encode
from ...storage.format_error import FormatError
from ..errors import ExchangeError
from ..options import Options
from . import DOCUMENT_ENDING, ContentKind, ExportResult, Format, is_document


def _write(document: Document, options: Options) -> ExportResult:
    # The path of the reference image is relative to the file.
    try:
        return ExportResult(encode(with_relative_image_path(document, folder_of(options.path))))
    except FormatError as problem:
        raise ExchangeError(f"The document cannot be written: {problem}.") from problem


DOCUMENT = Format(
    endings=(DOCUMENT_ENDING,),
    title="Curvebench document",
    rank=0,
    write=_write,
    kind=ContentKind.DOCUMENT,
    recognises=is_document,
)
