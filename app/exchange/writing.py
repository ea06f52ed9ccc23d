"""Writing a document in the format that the name of a file ends in."""

from __future__ import annotations

import os

from msgspec.structs import replace

from ..document.model import Document
from ..storage.files import write
from ..tasks.progress import FINAL
from .errors import ExchangeError
from .formats import FORMATS, Written, format_of
from .options import DEFAULT, Options


def export(document: Document, path: str | os.PathLike[str], options: Options = DEFAULT) -> Written:
    """Write a document with at least one curve that can be drawn.

    Raises
    ------
    ExchangeError
        For an unknown ending, or if the document cannot be written in that format.
    StorageError
        If the file cannot be written; an old one stays as it was.
    """
    options = replace(options, path=os.fspath(path))
    if options.width is not None and options.width < 1:
        raise ExchangeError("The width must be at least 1.")
    form = format_of(path, FORMATS.written)
    options.report(0.0, "Writing")
    assert form.write is not None
    written = form.write(document, options)
    options.report(FINAL, "Writing")
    write(path, written.data)
    return written
