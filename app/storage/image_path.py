"""Path of a reference image: relative in a document's file, absolute while it is open.

So a document and its picture can be moved together, and saving elsewhere never loses the picture.
"""

from __future__ import annotations

import os.path
from contextlib import suppress
from pathlib import Path

from msgspec.structs import replace

from ..document.model import Document

PICTURE_SUFFIXES = (".png", ".jpg", ".jpeg")
"""Endings of the files that are pictures to trace."""
PICTURES = " ".join(f"*{suffix}" for suffix in PICTURE_SUFFIXES)
"""They, for a dialog that asks for a file."""


def resolved(document: Document, folder: str) -> Document:
    """Return `document`, read from a file in `folder`, with the absolute path of its image."""
    if document.image is None:
        return document
    path = os.path.normpath(Path(folder) / document.image.path)
    return replace(document, image=replace(document.image, path=path))


def relative_to(document: Document, folder: str) -> Document:
    """Return `document` as it is written to a file in `folder`."""
    if document.image is None:
        return document
    path = document.image.path
    if Path(path).is_absolute():
        with suppress(ValueError):  # another drive of Windows: only the absolute path leads there
            path = os.path.relpath(path, folder)
    if os.sep != "/":
        path = path.replace(os.sep, "/")
    return replace(document, image=replace(document.image, path=path))
