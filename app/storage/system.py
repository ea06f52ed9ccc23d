"""Processes and locks, as the operating system knows them.

`Process` identifies a running process for locks and for files that a crash left behind. `try_lock` and
`folder_lock` are advisory locks of the system on an open file and on a folder; the system releases them when
the process ends, however it ends.
"""

from __future__ import annotations

import os
import platform
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
    """A process, told apart from all others, also from a later one with the same number.

    Attributes
    ----------
    machine
        Which computer it runs on.
    pid
        Its number there.
    started
        When it began, as the system tells it; empty where the system does not.
    """

    machine: str
    pid: int
    started: str


def this_process() -> Process:
    """Return the process that asks."""
    return _process(os.getpid())


# By the number, because a fork is another process.
@lru_cache(maxsize=2)
def _process(pid: int) -> Process:
    return Process(machine(), pid, _started(pid) or "")


@lru_cache(maxsize=1)
def machine() -> str:
    """Return a name of this computer that others hardly have: computers named “localhost” are many."""
    identity = ""
    with suppress(OSError, ValueError):
        identity = Path("/etc/machine-id").read_text(encoding="ascii").strip()
    return storage.digests.sha256(f"{identity}/{platform.node()}".encode()).hex()[:16]


def is_alive(process: Process) -> bool | None:
    """Return whether `process` still runs; None where that cannot be known from here."""
    if process.machine != machine() or not process.started:
        return None
    if _elsewhere(process.started):
        return None
    started = _started(process.pid)
    return None if started == "" else started == process.started


def is_number_alive(pid: int) -> bool | None:
    """Return whether a process of this computer has the number `pid`; None where it cannot be known."""
    started = _started(pid)
    return None if started == "" else started is not None


def _elsewhere(started: str) -> bool:
    """Whether that process counts its numbers apart from ours, as containers of one computer do."""
    boot, _, rest = started.partition("/")
    return bool(rest) and boot == _boot() and rest.partition("/")[0] != _numbering()


def _started(pid: int) -> str | None:
    """Return when process `pid` began; None if there is none, empty if the system does not say."""
    if sys.platform == "linux":
        return _started_on_linux(pid)
    if os.name == "posix":
        return storage.ps.started(pid)
    return ""  # Windows: signals there end a process instead of asking for it.


def _started_on_linux(pid: int) -> str | None:
    if not (_PROC / "self").exists():
        return ""
    try:
        text = (_PROC / str(pid) / "stat").read_text(encoding="utf-8", errors="replace")
    except (FileNotFoundError, ProcessLookupError):
        return None
    except OSError:
        return ""
    # The name stands in brackets, and may hold some itself.
    fields = text.rpartition(")")[2].split()
    if fields[0] in _ENDED:
        return None
    return f"{_boot()}/{_numbering()}/{fields[_START_FIELD]}"


@lru_cache(maxsize=1)
def _boot() -> str:
    """Return which run of the system this is: after a restart, everything from before has ended."""
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
