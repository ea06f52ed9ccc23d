"""Advisory lock file beside a document or a snapshot; it names its owner, who holds a system lock on it.

The lock file of ``name.curve.json`` is ``.name.curve.json.lock``. It is created in one step, so that only one
of two programs gets it; the lock of an owner that has ended is taken over. Lock files inform people, they do
not protect files: where no lock file can be made, work continues without.

An owner still runs if it holds its lock of the system: that works across containers, and a later process with
the same number does not hold the lock. Where the file system has no such locks, the process named in the file
is looked up.
"""

from __future__ import annotations

import os
import platform
import stat
import sys
import time
import weakref
from contextlib import suppress
from pathlib import Path

import msgspec

from .files import reason_of
from .system import Process, folder_lock, is_alive, this_process, try_lock

if sys.platform != "win32":
    import pwd

OLD = 24 * 3600.0
"""Seconds after which an owner that cannot be looked up may have left the document open by mistake."""

_READING = (
    os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
)
"""Flags that do not wait for a pipe or follow a link in path of a lock file."""

_LONGEST = 4096
_LONGEST_NAME = 60
_BEING_WRITTEN = 10.0
"""Seconds during which an empty lock file counts as being written, where the system has no locks."""


class Owner(msgspec.Struct, frozen=True):
    """Owner of a lock file: the process that has a document open, and its user.

    Attributes
    ----------
    user, host
        Names of the user and the computer, for messages.
    machine, pid, started
        The process, see `system.Process`.
    since
        Time at which the document was opened, in seconds of Unix time.
    mark
        Unique mark of the lock; empty for a lock file that cannot be read.
    is_held
        Whether the owner also holds a lock of the system on the file.
    """

    user: str
    host: str
    machine: str
    pid: int
    started: str
    since: float
    mark: str
    is_held: bool = False

    @property
    def process(self) -> Process:
        """The process of the owner."""
        return Process(self.machine, self.pid, self.started)

    @property
    def is_this_process(self) -> bool:
        """Whether the owner is this process, in another window."""
        return self.process == this_process()

    @property
    def is_same_person(self) -> bool:
        """Whether the owner is the same user on the same computer."""
        return self.machine == this_process().machine and self.user == _user()

    @property
    def may_have_forgotten(self) -> bool:
        """Whether the lock is so old that its owner may have left the document open by mistake."""
        return time.time() - self.since > OLD


class ProcessLock:
    """Lock file of this process, until `release` or the end of the process.

    Raises FileExistsError if the file exists, OSError if it cannot be created.
    """

    def __init__(self, path: Path) -> None:
        self.path, self._owner = path, _new_owner()
        self._descriptors = [_create(path, self._owner)]
        self._finalizer = weakref.finalize(self, _release, path, self._owner, self._descriptors)

    def lost_to(self) -> Owner | None:
        """Return the owner that has taken the lock over, or None while this process owns it.

        A deleted lock file is created again.
        """
        with suppress(OSError):
            owner = _read(self.path)
            if owner is None:
                with folder_lock(self.path.parent):  # not while another process takes it over
                    self._descriptors.append(_create(self.path, self._owner))
            elif owner.mark != self._owner.mark:
                return owner
        return None

    def release(self) -> None:
        """Release the lock and remove its file."""
        self._finalizer()


class LockResult(msgspec.Struct, frozen=True):
    """Result of a request for a lock: one of the three attributes is set.

    Attributes
    ----------
    lock
        The lock, if this process owns it now.
    owner
        The other owner, if there is one.
    problem
        Reason why no lock can be made in this folder.
    """

    lock: ProcessLock | None = None
    owner: Owner | None = None
    problem: str = ""

    def __str__(self) -> str:
        """Return the result for the log, without names."""
        if self.owner is None:
            return "ours" if self.lock is not None else f"impossible ({self.problem})"
        if self.owner.is_this_process:
            return "of another window"
        return "of another process of this user" if self.owner.is_same_person else "of another user"


def lock_path(target: Path) -> Path:
    """Return the path of the lock file of `target`, whose links are resolved."""
    return target.with_name(f".{target.name}.lock")


def acquire(path: Path, *, is_private: bool = False) -> LockResult:
    """Request the lock with the file `path`.

    Parameters
    ----------
    is_private
        Whether only programs of this user on this computer use the folder: the lock is then given even if it
        is unknown whether its owner still runs. (The computer may have been renamed, a power cut may have
        damaged the file.)
    """
    try:
        with folder_lock(path.parent):
            owner = _read(path)
            if owner is not None:
                is_stale = _is_stale(path, owner, is_private=is_private)
                if not is_stale or not _remove(path, owner):
                    return LockResult(owner=_read(path) or owner)
            return LockResult(lock=ProcessLock(path))
    except FileExistsError:
        # Another process was faster, in a folder that cannot be locked.
        return LockResult(owner=owner_of(path), problem="it is being opened elsewhere")
    except (OSError, ValueError) as problem:
        return LockResult(problem=reason_of(problem))


def take_over(path: Path) -> LockResult:
    """Take over the lock with the file `path` from any owner, who will notice.

    On Windows, a file that a running process holds cannot be removed: the result then has that problem.
    """
    try:
        with folder_lock(path.parent):
            path.unlink(missing_ok=True)
            return LockResult(lock=ProcessLock(path))
    except (OSError, ValueError) as problem:
        return LockResult(problem=reason_of(problem))


def owner_of(path: Path) -> Owner | None:
    """Return the owner of the lock file `path`, or None if there is none that still runs."""
    try:
        owner = _read(path)
        return None if owner is None or _is_stale(path, owner) else owner
    except (OSError, ValueError):
        return None


def _is_stale(path: Path, owner: Owner, *, is_private: bool = False) -> bool:
    """Return whether the owner of a lock file has certainly ended."""
    is_free = _is_free(path)
    if is_free is False:
        return False
    if is_private:
        return bool(is_free and owner.is_held) or not is_alive(owner.process)
    if not owner.mark:
        # A process was killed between creating and writing the file, or is doing that now.
        return owner.pid == 0 and (is_free is True or time.time() - owner.since > _BEING_WRITTEN)
    if is_free and owner.is_held and owner.machine == this_process().machine:
        return True
    return is_alive(owner.process) is False


def _is_free(path: Path) -> bool | None:
    """Return whether no process holds the file, as far as this system knows."""
    descriptor = os.open(path, _READING)
    try:
        return try_lock(descriptor, shared=True)
    finally:
        os.close(descriptor)


def _remove(path: Path, stale: Owner) -> bool:
    """Remove the lock file of a stale owner; return False if it has another owner by now."""
    owner = _read(path)
    if owner is not None and (owner.mark, owner.since) != (stale.mark, stale.since):
        return False
    path.unlink(missing_ok=True)
    return True


def _new_owner() -> Owner:
    process = this_process()
    return Owner(
        user=_user(),
        host=platform.node() or "this computer",
        machine=process.machine,
        pid=process.pid,
        started=process.started,
        since=time.time(),
        mark=os.urandom(12).hex(),
    )


def _create(path: Path, owner: Owner) -> int | None:
    """Create the lock file and return the descriptor that holds it, or None where the system has no locks.

    Raises FileExistsError if the file exists.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    descriptor = os.open(path, flags, 0o644)
    try:
        held = msgspec.structs.replace(owner, is_held=try_lock(descriptor) is True)
        os.write(descriptor, msgspec.json.encode(held))
    except BaseException:
        os.close(descriptor)
        path.unlink(missing_ok=True)
        raise
    if held.is_held:
        return descriptor
    os.close(descriptor)
    return None


def _read(path: Path) -> Owner | None:
    """Return the owner in a lock file, None if there is no file; raise OSError if it cannot be read."""
    try:
        descriptor = os.open(path, _READING)
    except FileNotFoundError:
        return None
    try:
        status = os.fstat(descriptor)
        data = os.read(descriptor, _LONGEST) if stat.S_ISREG(status.st_mode) else b"?"
    finally:
        os.close(descriptor)
    try:
        owner = msgspec.json.decode(data, type=Owner)
    except (msgspec.MsgspecError, UnicodeDecodeError):
        # pid 0 marks an empty file, which a killed process leaves; any other content belongs to an owner.
        return Owner("", "", "", -1 if data else 0, "", status.st_mtime, "")
    return msgspec.structs.replace(owner, user=_printable(owner.user), host=_printable(owner.host))


def _printable(name: str) -> str:
    """Return a name from a lock file, without unprintable characters and shortened."""
    return "".join(character for character in name if character.isprintable())[:_LONGEST_NAME]


def _user() -> str:
    """Return the login name of the user."""
    if sys.platform == "win32":
        return os.environ.get("USERNAME", "")
    with suppress(KeyError, OSError):
        return pwd.getpwuid(os.geteuid()).pw_name
    return os.environ.get("USER", "")


def _release(path: Path, owner: Owner, descriptors: list[int | None]) -> None:
    """Remove the lock file if it still belongs to `owner` and this process created it."""
    for descriptor in descriptors:
        if descriptor is not None:
            with suppress(OSError):
                os.close(descriptor)
    if owner.pid != os.getpid():
        return  # A forked process ends; the lock belongs to its parent.
    with suppress(OSError), folder_lock(path.parent):
        _remove(path, owner)
