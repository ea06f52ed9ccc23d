"""SVG packed by gzip, as files ending in .svgz are."""

from __future__ import annotations

import gzip
import io
import zlib
from dataclasses import replace

from ..errors import ExchangeError
from ..formats import Written

MOST = 64 * 2**20
"""Bytes of the largest drawing that is unpacked: a packed file can hold a thousand times its size."""

_MARK = b"\x1f\x8b"
_GZIP = 16 + zlib.MAX_WBITS


def unpacked(data: bytes) -> bytes:
    """Return the content of a packed file, and what is not packed as it is.

    Raises
    ------
    ExchangeError
        If it is damaged or cut off, or holds more than `MOST` bytes.
    """
    content = b""
    while data.startswith(_MARK):
        stream = zlib.decompressobj(_GZIP)
        try:
            content += stream.decompress(data, MOST + 1 - len(content))
        except zlib.error:
            raise ExchangeError("The packed file is damaged.") from None
        if len(content) > MOST:
            raise ExchangeError(f"Unpacked, it holds more than {MOST // 2**20} MB; it was stopped.")
        if not stream.eof:
            raise ExchangeError("The packed file is cut off.")
        # The format allows several streams one after the other, and zeros behind them.
        data = stream.unused_data
    return content or data


def packed(written: Written) -> Written:
    """Return the same in a packed file, which is the same for the same content at any time."""
    file = io.BytesIO()
    with gzip.GzipFile("", "wb", fileobj=file, mtime=0) as stream:
        stream.write(written.data)
    return replace(written, content=file.getvalue())
