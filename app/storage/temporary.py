"""Names of temporary files, and the removal of those that a crash or a power cut left behind."""

from __future__ import annotations

import os
import re
import stat
import time
from contextlib import suppress
from pathlib import Path

from .processes import is_number_alive, machine

TEMPORARY_PREFIX = ".curvebench-"
"""Begins the name of every temporary file, so that what a power cut left behind can be recognised."""

LEFT_BEHIND = 600.0
"""Seconds after which a temporary file of a process that has ended is removed."""

_NAME = re.compile(re.escape(TEMPORARY_PREFIX) + r"([0-9a-f]{8})-([1-9][0-9]{0,9})-[0-9a-f]{16}\.tmp")
_COMPUTER_DIGITS = 8


def temporary_name() -> str:
    """Return a new name for a temporary file, which tells whose it is."""
    return f"{TEMPORARY_PREFIX}{machine()[:_COMPUTER_DIGITS]}-{os.getpid()}-{os.urandom(8).hex()}.tmp"


def remove_stale(folder: Path, older_than: float = LEFT_BEHIND) -> int:
    """Remove the temporary files in `folder` whose process has ended; return how many there were.

    Only ordinary files with a name of ours, of this person, made on this computer, and not touched for
    `older_than` seconds. What cannot be removed stays: nobody is waiting for the room.
    """
    removed = 0
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith(TEMPORARY_PREFIX) and _is_left_behind(entry, older_than):
                with suppress(OSError):
                    Path(entry.path).unlink()
                    removed += 1
    return removed


def _is_left_behind(entry: os.DirEntry[str], older_than: float) -> bool:
    match = _NAME.fullmatch(entry.name)
    if match is None or match[1] != machine()[:_COMPUTER_DIGITS]:
        return False
    try:
        status = entry.stat(follow_symlinks=False)
    except OSError:
        return False
    is_own = not hasattr(os, "geteuid") or status.st_uid == os.geteuid()
    is_old = time.time() - status.st_mtime > older_than
    return stat.S_ISREG(status.st_mode) and is_own and is_old and is_number_alive(int(match[2])) is False
