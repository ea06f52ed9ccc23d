"""Documents that the command line names."""

from __future__ import annotations

from ..storage.files import load_counting
from ..storage.format import Decoded
from ..storage.format_error import FormatError
from .refusals import RefusalError


def load_document(path: str) -> Decoded:
    """Return the document at `path`, and what is left out of it, or refuse it with its name."""
    try:
        return load_counting(path)
    except FormatError as problem:
        raise RefusalError(f"“{path}” cannot be read: {problem}") from None
