"""Pictures in PNG and JPEG files: data from anywhere, so kind and size are checked before it is decoded."""

from __future__ import annotations

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QSize
from PySide6.QtGui import QImage, QImageIOHandler, QImageReader

from ..document.content import MOST_PIXELS

MAX_PIXELS = MOST_PIXELS
"""More pixels than this are not decoded."""

MAX_SIDE = 4096
"""Larger pictures are scaled down when they are read: 64 MB at most stay in memory."""

_KINDS = (b"png", b"jpeg", b"jpg")
_QUALITY = 95
"""Of JPEG files that are written, in percent."""
_ALLOCATION_MB = 512
"""Enough for `MAX_PIXELS` of eight bytes each, a PNG of 16 bits."""


class ImageFileError(ValueError):
    """Refusal to show a picture; the message says why."""


def decoded(data: bytes, name: str) -> QImage:
    """Return the picture in a PNG or JPEG file, its longer side at most `MAX_SIDE` pixels.

    Raises
    ------
    ImageFileError
        For what is no such picture, broken or too large, with the name.
    """
    return _decoded(data, name)[0]


def upright(data: bytes, name: str) -> bytes:
    """Return a PNG or JPEG file that shows a picture as it is meant to stand, whoever reads it.

    Cameras leave it lying and write how to turn it, which some programs do and others do not.

    Raises
    ------
    ImageFileError
        For what is no such picture, broken or too large, with the name.
    """
    image, is_turned = _decoded(data, name)
    kind = "PNG" if data.startswith(b"\x89PNG") else "JPEG"
    return _file(image, kind) if is_turned else data


def png_of(image: QImage) -> bytes:
    """Return a PNG file of a picture."""
    return _file(image, "PNG")


def _file(image: QImage, kind: str) -> bytes:
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    quality = _QUALITY if kind == "JPEG" else -1
    image.save(buffer, kind, quality)  # type: ignore[call-overload]  # its stub forgets devices
    return bytes(buffer.data().data())


def _decoded(data: bytes, name: str) -> tuple[QImage, bool]:
    """Return the picture in a file, and whether it was turned to stand upright."""
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
    is_turned = reader.transformation() != QImageIOHandler.Transformation.TransformationNone
    return _read(reader, name), is_turned


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
