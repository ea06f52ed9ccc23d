"""A file that a running process holds: the system lets go of it when the process ends, however it ends.

Better than a process id in a file: an id is used again after a restart, means nothing in another container
or on another computer that shares the folder, and has to be judged; a lock of the system is there or not.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl


class Claim:
    """The right to what a file stands for, held until it is released or the process ends."""

    def __init__(self, path: Path, descriptor: int) -> None:
        self._path, self._descriptor = path, descriptor

    @classmethod
    def take(cls, path: Path) -> Claim | None:
        """Claim `path`, which is created, or return None where a running process holds it.

        Where the file system knows no locks, everybody gets the claim.

        Raises
        ------
        OSError
            If the file cannot be made.
        """
        while True:
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
            if not _lock(descriptor):
                os.close(descriptor)
                return None
            if _is_at(path, descriptor):
                return cls(path, descriptor)
            # Its last holder has removed the file between the two steps; a lock on it holds nothing.
            os.close(descriptor)

    def release(self) -> None:
        """Let go; the file goes away."""
        if sys.platform == "win32":  # where an open file cannot be removed
            self.leave()
            _remove(self._path)
        else:
            # While the lock is held, so that nobody else's file is removed.
            _remove(self._path)
            self.leave()

    def leave(self) -> None:
        """Let go as the end of the process does: the file stays."""
        os.close(self._descriptor)


def _lock(descriptor: int) -> bool:
    """Lock the open file; return whether nobody else has."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:  # no locks on this file system
        return True
    return True


def _is_at(path: Path, descriptor: int) -> bool:
    """Whether the open file is still the one that `path` names."""
    try:
        return os.path.samestat(path.stat(), os.fstat(descriptor))
    except FileNotFoundError:
        return False


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError:
        # It holds nothing any more; the next start sweeps it.
        return
