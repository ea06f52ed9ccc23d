"""Documents that the command line names."""

from __future__ import annotations

from app.cli.refusals import RefusalError
from app.document.model import Document
from app.storage.files import load
from app.storage.format import FormatError


def load_document(path: str) -> Document:
    """Return the document at `path`, or refuse it with its name."""
    try:
        return load(path)
    except FormatError as problem:
        raise RefusalError(f"“{path}” cannot be read: {problem}") from None
