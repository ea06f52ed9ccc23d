"""Documents in the files that the command line names."""

from __future__ import annotations

from pathlib import Path

from .. import exchange
from ..exchange.formats import can_import
from ..storage.files import load_counting
from ..storage.format import Decoded
from ..storage.format_error import FormatError
from .output import RefusalError, TerminalProgress, print_remarks


def load_document(path: str) -> Decoded:
    """Return the document at `path` with a record of the content left out; refuse it with its name."""
    try:
        return load_counting(path)
    except FormatError as problem:
        raise RefusalError(f"“{path}” cannot be read: {problem}") from None


def document_of(path: str) -> Decoded:
    """Return the document at `path`, which may be a file of another format.

    Remarks on content that is left out go to the standard error.
    """
    try:
        decoded = load_document(path)
    except RefusalError:
        if not can_import(Path(path)):
            raise
    else:
        if decoded.left_out:
            print_remarks([decoded.left_out.sentence(Path(path).name)])
        return decoded
    with TerminalProgress() as report:
        source = exchange.files.import_file(path, report=report)
    print_remarks(source.remarks)
    return Decoded(source.document)
