"""Processes and locks, as the operating system knows them.

`Process` identifies a running process for locks and for files that a crash left behind. `try_lock` and
`folder_lock` are advisory locks of the system on an open file and on a folder; the system releases them when
the process ends, however it ends.
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import lru_cache
from pathlib import Path

import msgspec

from .. import storage

_PROC = Path("/proc")
_ENDED = frozenset("ZXx")
_START_FIELD = 19
"""Index of the start time after the name in ``/proc/PID/stat``: field 22 (proc_pid_stat(5))."""


class Process(msgspec.Struct, frozen=True):
    """Identity of a process, different from that of a later process with the same number.

    Attributes
    ----------
    machine
        The computer it runs on.
    pid
        Its number there.
    started
        Its start time as the system writes it; empty where the system does not tell.
    """

    machine: str
    pid: int
    started: str


def this_process() -> Process:
    """Return the identity of this process."""
    return _process(os.getpid())


# Cached by the number, because a fork is another process.
@lru_cache(maxsize=2)
def _process(pid: int) -> Process:
    return Process(machine(), pid, _started(pid) or "")


@lru_cache(maxsize=1)
def machine() -> str:
    """Return an identifier of this computer; its name alone, such as “localhost”, is not unique."""
    identity = ""
    with suppress(OSError, ValueError):
        identity = Path("/etc/machine-id").read_text(encoding="ascii").strip()
    return storage.digests.sha256(f"{identity}/{platform.node()}".encode()).hex()[:16]


def is_alive(process: Process) -> bool | None:
    """Return whether `process` still runs, or None if that is unknown here."""
    if process.machine != machine() or not process.started:
        return None
    if _elsewhere(process.started):
        return None
    started = _started(process.pid)
    return None if started == "" else started == process.started


def is_number_alive(pid: int) -> bool | None:
    """Return whether a process of this computer has the number `pid`, or None if that is unknown."""
    started = _started(pid)
    return None if started == "" else started is not None


def _elsewhere(started: str) -> bool:
    """Return whether a process has another numbering, as containers of one computer do."""
    boot, _, rest = started.partition("/")
    return bool(rest) and boot == _boot() and rest.partition("/")[0] != _numbering()


def _started(pid: int) -> str | None:
    """Return the start time of process `pid`; None if there is no such process, empty if it is unknown."""
    if sys.platform == "linux":
        return _started_on_linux(pid)
    if os.name == "posix":
        return _started_by_ps(pid)
    return ""  # On Windows, the signal that asks for a process would end it.


def _started_by_ps(pid: int) -> str | None:
    """Return the start time of process `pid`; None if there is no such process, empty if it is unknown."""
    try:
        done = subprocess.run(["ps", "-o", "lstart=", "-p", str(pid)], capture_output=True, check=False)
    except OSError:
        return ""
    if done.stderr:
        return ""  # This ps does not know the options.
    return " ".join(done.stdout.decode("ascii", "replace").split()) or None


def _started_on_linux(pid: int) -> str | None:
    if not (_PROC / "self").exists():
        return ""
    try:
        text = (_PROC / str(pid) / "stat").read_text(encoding="utf-8", errors="replace")
    except (FileNotFoundError, ProcessLookupError):
        return None
    except OSError:
        return ""
    # The name stands in parentheses, and may contain some itself.
    fields = text.rpartition(")")[2].split()
    if fields[0] in _ENDED:
        return None
    return f"{_boot()}/{_numbering()}/{fields[_START_FIELD]}"


@lru_cache(maxsize=1)
def _boot() -> str:
    """Return the identifier of the system start: after a restart, all earlier processes have ended."""
    with suppress(OSError):
        return (_PROC / "sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    return ""


@lru_cache(maxsize=1)
def _numbering() -> str:
    with suppress(OSError):
        return str((_PROC / "self/ns/pid").stat().st_ino)
    return ""


if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

# Locks

_PATIENCE = 10.0
"""Seconds to wait for the lock of a folder. Reading and renaming a file take less on a busy computer; a
suspended process may take longer, and then the work continues without the lock."""

_STEP = 0.01
_BEYOND_THE_TEXT = 2**30
"""Position of the locked byte: Windows forbids reading locked bytes, so it is beyond the end of any file."""


def try_lock(descriptor: int, *, shared: bool = False) -> bool | None:
    """Lock an open file until it is closed.

    Parameters
    ----------
    shared
        Whether others may share the lock: processes that only ask whether it is free do not block each other.

    Returns
    -------
    bool or None
        True if it is locked now; False if another process, or another open file of this process, holds it;
        None if the file system has no locks.
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
    """Keep other processes of Curvebench out of `folder` in a ``with`` block, where the system can.

    Where it cannot (a network file system without locks, an unreadable folder, Windows), the work continues
    without; it is written so that even then no file is damaged.
    """
    descriptor = None if sys.platform == "win32" else _locked_folder(folder)
    try:
        yield
    finally:
        if descriptor is not None:
            os.close(descriptor)


def _locked_folder(folder: Path) -> int | None:
    """Return the descriptor that holds the lock of a folder, or None if it cannot be locked."""
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
