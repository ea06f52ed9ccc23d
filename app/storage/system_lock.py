"""Advisory locks of the operating system, on an open file and on a folder.

The system lets go of them when the process ends, however it ends.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_PATIENCE = 10.0
"""Seconds to wait for a folder. A look and a renaming take no longer beside busy programs; a process that was
suspended may, and then the work goes on without the lock.
"""

_STEP = 0.01
_BEYOND_THE_TEXT = 2**30
"""Windows lets nobody read bytes that are locked, so one is locked that no file has."""


def try_lock(descriptor: int, *, shared: bool = False) -> bool | None:
    """Lock an open file until it is closed.

    Parameters
    ----------
    shared
        Let others share the lock: whoever only asks whether it is free is in the way of nobody who asks too.

    Returns
    -------
    bool or None
        Whether it is locked now; False if somebody else, or another open file of this process, has it; None
        where the file system knows no locks.
    """
    try:
        if sys.platform == "win32":
            os.lseek(descriptor, _BEYOND_THE_TEXT, os.SEEK_SET)
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
            os.lseek(descriptor, 0, os.SEEK_SET)
        else:
            fcntl.flock(descriptor, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        return None
    return True


@contextmanager
def folder_lock(folder: Path) -> Iterator[None]:
    """Let no other Curvebench work in `folder` meanwhile, where the system can do that.

    Where it cannot (no locks on a network's file system, a folder that may not be read, Windows), the work
    goes on without; it is written so that even then no file is ever damaged.
    """
    descriptor = None if sys.platform == "win32" else _locked_folder(folder)
    try:
        yield
    finally:
        if descriptor is not None:
            os.close(descriptor)


def _locked_folder(folder: Path) -> int | None:
    """Return what holds the lock of the folder, None where it cannot be had."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:
        return None
    until = time.monotonic() + _PATIENCE
    while (is_locked := try_lock(descriptor)) is False and time.monotonic() < until:
        time.sleep(_STEP)
    if is_locked:
        return descriptor
    os.close(descriptor)
    return None
