"""Documents that the command line names."""

from __future__ import annotations

from ..document.model import Document
from ..storage.files import load
from ..storage.format_error import FormatError
from .refusals import RefusalError


def load_document(path: str) -> Document:
    """Return the document at `path`, or refuse it with its name."""
    try:
        return load(path)
    except FormatError as problem:
        raise RefusalError(f"“{path}” cannot be read: {problem}") from None
