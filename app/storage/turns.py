"""One after the other: what must not happen twice at once in a folder."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

_PATIENCE = 2.0
"""Seconds to wait for one's turn: nobody takes longer for a look and a renaming."""

_STEP = 0.01


@contextmanager
def taking_turns(folder: Path) -> Iterator[None]:
    """Let no other Curvebench work in `folder` meanwhile, where the system can do that.

    Where it cannot (no locks on a network's file system, a folder that may not be read, Windows), the work
    goes on without; it is written so that even then no file is ever damaged. The system ends the turn of a
    process that dies.
    """
    descriptor = _begin(folder)
    try:
        yield
    finally:
        if descriptor is not None:
            os.close(descriptor)


def _begin(folder: Path) -> int | None:
    if fcntl is None:
        return None
    descriptor = None
    try:
        descriptor = os.open(folder, os.O_RDONLY)
        _wait_for(descriptor)
    except OSError:
        if descriptor is not None:
            with suppress(OSError):
                os.close(descriptor)
        return None
    return descriptor


def _wait_for(descriptor: int) -> None:
    until = time.monotonic() + _PATIENCE
    while True:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > until:
                raise
            time.sleep(_STEP)
        else:
            return
