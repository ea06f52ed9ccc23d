"""Identity of a process, and whether another one still runs: for locks and for what a crash left behind."""

from __future__ import annotations

import os
import platform
import sys
from contextlib import suppress
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
