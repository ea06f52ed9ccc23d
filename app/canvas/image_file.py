"""Reads a picture to trace: data from anywhere, so kind and size are checked before it is decoded."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QSize
from PySide6.QtGui import QImage, QImageReader

from ..storage.files import StorageError, read

MAX_PIXELS = 64_000_000
"""More pixels than this are not decoded."""

MAX_SIDE = 4096
"""Larger pictures are scaled down when they are read: 64 MB at most stay in memory."""

_KINDS = (b"png", b"jpeg", b"jpg")
_ALLOCATION_MB = 512
"""Enough for `MAX_PIXELS` of eight bytes each, a PNG of 16 bits."""


class ImageFileError(ValueError):
    """Refusal to show a picture; the message says why."""


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
    name = f"“{Path(path).name}”"
    QImageReader.setAllocationLimit(_ALLOCATION_MB)
    buffer = QBuffer()
    buffer.setData(QByteArray(data))
    buffer.open(QIODevice.OpenModeFlag.ReadOnly)
    # The content decides what it is, not the name.
    kind = bytes(QImageReader.imageFormat(buffer).data())
    if kind not in _KINDS:
        raise ImageFileError(f"{name} is no PNG or JPEG picture.")
    reader = QImageReader(buffer, QByteArray(kind))
    reader.setAutoTransform(True)
    return _read(reader, name)


def _read(reader: QImageReader, name: str) -> QImage:
    size = reader.size()
    if size.width() * size.height() > MAX_PIXELS:
        raise ImageFileError(
            f"{name} has {size.width()} × {size.height()} pixels; "
            f"{MAX_PIXELS // 1_000_000} million are read at most. Make it smaller first."
        )
    shrink = MAX_SIDE / max(size.width(), size.height(), 1)
    if shrink < 1:
        width, height = round(size.width() * shrink), round(size.height() * shrink)
        reader.setScaledSize(QSize(max(width, 1), max(height, 1)))
    image = reader.read()
    if image.isNull() or not image.width() or not image.height():
        raise ImageFileError(f"{name} is broken: it cannot be shown ({reader.errorString().rstrip('.')}).")
    return image.convertToFormat(QImage.Format.Format_ARGB32_Premultiplied)
