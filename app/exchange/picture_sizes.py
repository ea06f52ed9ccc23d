"""Sizes of PNG and JPEG files in pixels, by their heads."""

from __future__ import annotations

import struct

from ..document.content import MOST_PIXELS

_PNG, _JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8"
_FRAMES = {*range(0xC0, 0xD0)} - {0xC4, 0xC8, 0xCC}
"""Markers in a JPEG file behind which its size stands."""


def size_of(data: bytes) -> tuple[float, float] | None:
    """Return width and height in pixels of a PNG or JPEG file; None of every other, and of a huge one."""
    try:
        if data.startswith(_PNG):
            width, height = struct.unpack(">II", data[16:24])
        elif data.startswith(_JPEG):
            height, width = _size_in_jpeg(data)
        else:
            return None
    except struct.error:
        return None
    return (float(width), float(height)) if 0 < width * height <= MOST_PIXELS else None


def _size_in_jpeg(data: bytes) -> tuple[int, int]:
    place = 2
    while True:
        mark, kind, length = struct.unpack(">BBH", data[place : place + 4])
        if mark != 0xFF or length < 2:
            raise struct.error
        if kind in _FRAMES:
            height, width = struct.unpack(">HH", data[place + 5 : place + 9])
            return height, width
        place += 2 + length
