"""Sizes of PNG and JPEG files, in pixels and on paper, by their heads."""

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


_INCH = 0.0254
_PER_UNIT = {1: 1.0, 2: 100.0 * _INCH}
"""Factors to pixels per inch of the units of a JPEG file: per inch, and per centimetre."""
_LEAST_DENSITY, _MOST_DENSITY = 1.0, 20_000.0


def density_of(data: bytes) -> tuple[float, float] | None:
    """Return pixels per inch, across and up, of a PNG or JPEG file; None where it does not say."""
    try:
        found = _density_in_png(data) if data.startswith(_PNG) else _density_in_jpeg(data)
    except struct.error:
        return None
    is_meant = found is not None and all(_LEAST_DENSITY <= each <= _MOST_DENSITY for each in found)
    return found if is_meant else None


def _density_in_png(data: bytes) -> tuple[float, float] | None:
    place = len(_PNG)
    while True:
        length, kind = struct.unpack(">I4s", data[place : place + 8])
        if kind == b"pHYs":
            across, up, unit = struct.unpack(">IIB", data[place + 8 : place + 17])
            return (across * _INCH, up * _INCH) if unit == 1 else None
        if kind in (b"IDAT", b"IEND"):
            return None
        place += 12 + length


def _density_in_jpeg(data: bytes) -> tuple[float, float] | None:
    # The head of JFIF stands first, where there is one.
    start, kind, name, unit, across, up = struct.unpack(">2s2s2x5s2xBHH", data[:18])
    if (start, kind, name) != (_JPEG, b"\xff\xe0", b"JFIF\0") or unit not in _PER_UNIT:
        return None
    return across * _PER_UNIT[unit], up * _PER_UNIT[unit]
