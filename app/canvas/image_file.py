"""Reads a picture to trace."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtGui import QImage

from ..qt.picture_data import ImageFileError as ImageFileError  # noqa: PLC0414 - who reads has it from here
from ..qt.picture_data import decoded
from ..storage.files import StorageError, read


def read_image(path: str) -> QImage:
    """Return the picture in a PNG or JPEG file, its longer side at most `MAX_SIDE` pixels.

    Raises
    ------
    ImageFileError
        For files that are missing, no such picture, broken or too large.
    """
    try:
        data = read(path)
    except StorageError as problem:
        raise ImageFileError(str(problem)) from None
    return decoded(data, f"“{Path(path).name}”")
