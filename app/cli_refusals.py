"""What the command line refuses, and how it says so in one line."""

from __future__ import annotations

from app.document.format import FormatError
from app.document.model import Document
from app.document.storage import load


class RefusalError(Exception):
    """What was asked cannot be done; the text says why."""


def load_document(path: str) -> Document:
    """Return the document at `path`, or refuse it with its name."""
    try:
        return load(path)
    except FormatError as problem:
        raise RefusalError(f"“{path}” cannot be read: {problem}") from None


def one_line(text: str) -> str:
    """Return text on one line, without characters that would steer a terminal."""
    return "".join(character if character.isprintable() else " " for character in text)
