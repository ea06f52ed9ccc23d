"""SHA-256; apart because its library takes milliseconds that a start without a file saves."""

from __future__ import annotations

import hashlib


def sha256(data: bytes) -> bytes:
    """Return the 32 bytes of the digest."""
    return hashlib.sha256(data).digest()
