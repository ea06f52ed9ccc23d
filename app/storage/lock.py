"""Advisory lock files: a file that names its owner, locked by the system while the owner runs.

The lock of ``name.curve.json`` is ``.name.curve.json.lock``; snapshots have one too. It is made by the system
in one step, so that of two who come at once one gets it; one whose owner has ended is taken over. It is a
courtesy between people, not what keeps files whole: where no lock can be made, work goes on without.

Whether an owner still runs is told by the lock of the system that it holds on the file: it means the same in
every container, and a later process with the same number has it not. Where the file system knows no such
locks, the process that the file names is asked for.
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
"""Seconds after which an owner who cannot be asked may have forgotten the document."""

_READING = (
    os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
)
"""A pipe or a link in the place of a lock is nothing to wait for or to follow."""

_LONGEST = 4096
_LONGEST_NAME = 60
_BEING_WRITTEN = 10.0
"""Seconds that an empty lock file is taken for one that is just being written, where nobody can lock it."""


class Owner(msgspec.Struct, frozen=True):
    """The process that has a document open, and whose it is.

    Attributes
    ----------
    user, host
        Whom to ask, and where; as the lock file has them, for people.
    machine, pid, started
        The process, see `processes.Process`.
    since
        When it was opened, in seconds of Unix time.
    mark
        Tells this lock from every other; empty for a lock file that cannot be read.
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
        """The process that has it."""
        return Process(self.machine, self.pid, self.started)

    @property
    def is_this_process(self) -> bool:
        """Whether another window of this process has it."""
        return self.process == this_process()

    @property
    def is_same_person(self) -> bool:
        """Whether the person at this computer has it."""
        return self.machine == this_process().machine and self.user == _user()

    @property
    def may_have_forgotten(self) -> bool:
        """Whether the lock is so old that its owner may be gone without a trace."""
        return time.time() - self.since > OLD


class ProcessLock:
    """A lock file of this process; `release` gives it up, and so does the end of the process.

    Raises FileExistsError where there is one, OSError where none can be made.
    """

    def __init__(self, place: Path) -> None:
        self.place, self._owner = place, _new_owner()
        self._descriptors = [_create(place, self._owner)]
        self._finalizer = weakref.finalize(self, _release, place, self._owner, self._descriptors)

    def lost_to(self) -> Owner | None:
        """Return who has taken it over meanwhile; None while it is ours.

        One that somebody deleted is made anew.
        """
        with suppress(OSError):
            found = _read(self.place)
            if found is None:
                with folder_lock(self.place.parent):  # not while somebody takes it over
                    self._descriptors.append(_create(self.place, self._owner))
            elif found.mark != self._owner.mark:
                return found
        return None

    def release(self) -> None:
        """Give it up; the file goes."""
        self._finalizer()


class LockResult(msgspec.Struct, frozen=True):
    """Result of asking for a lock: one of the three is there.

    Attributes
    ----------
    lock
        The lock, if it is ours now.
    owner
        Who has it, if somebody has.
    problem
        Why there can be no lock in this folder; empty where there can.
    """

    lock: ProcessLock | None = None
    owner: Owner | None = None
    problem: str = ""

    def __str__(self) -> str:
        """Return what came of it without anybody's name."""
        if self.owner is None:
            return "ours" if self.lock is not None else f"impossible ({self.problem})"
        if self.owner.is_this_process:
            return "of another window"
        return "of another program of this person" if self.owner.is_same_person else "of somebody else"


def lock_path(target: Path) -> Path:
    """Return where the lock of the file `target`, whose links are resolved, lies."""
    return target.with_name(f".{target.name}.lock")


def acquire(place: Path, *, is_private: bool = False) -> LockResult:
    """Ask for the lock whose file is `place`.

    Parameters
    ----------
    is_private
        Only this person's programs on this computer come there: where it cannot be told whether the owner
        still runs, the lock is given. (A computer may have had another name, a power cut may have torn the
        file.) By default it is not.
    """
    try:
        with folder_lock(place.parent):
            found = _read(place)
            if found is not None:
                is_stale = _is_stale(place, found, is_private=is_private)
                if not is_stale or not _remove(place, found):
                    return LockResult(owner=_read(place) or found)
            return LockResult(lock=ProcessLock(place))
    except FileExistsError:
        # Somebody was quicker, in a folder that cannot be locked.
        return LockResult(owner=owner_of(place), problem="it is being opened elsewhere")
    except (OSError, ValueError) as problem:
        return LockResult(problem=reason_of(problem))


def take_over(place: Path) -> LockResult:
    """Take the lock whose file is `place`, whoever has it; they will notice.

    Windows removes no file that a running process holds: there that is the problem.
    """
    try:
        with folder_lock(place.parent):
            place.unlink(missing_ok=True)
            return LockResult(lock=ProcessLock(place))
    except (OSError, ValueError) as problem:
        return LockResult(problem=reason_of(problem))


def owner_of(place: Path) -> Owner | None:
    """Return whom the lock file at `place` names; None where nobody, or nobody who still runs."""
    try:
        found = _read(place)
        return None if found is None or _is_stale(place, found) else found
    except (OSError, ValueError):
        return None


def _is_stale(place: Path, owner: Owner, *, is_private: bool = False) -> bool:
    """Whether the owner of the lock at `place` has certainly ended."""
    is_free = _is_free(place)
    if is_free is False:
        return False
    if is_private:
        return bool(is_free and owner.is_held) or not is_alive(owner.process)
    if not owner.mark:
        # A process was killed between making and writing it, or is doing that right now.
        return owner.pid == 0 and (is_free is True or time.time() - owner.since > _BEING_WRITTEN)
    if is_free and owner.is_held and owner.machine == this_process().machine:
        return True
    return is_alive(owner.process) is False


def _is_free(place: Path) -> bool | None:
    """Whether nobody holds the file at `place`, as far as this computer's system knows."""
    descriptor = os.open(place, _READING)
    try:
        return try_lock(descriptor, shared=True)
    finally:
        os.close(descriptor)


def _remove(place: Path, stale: Owner) -> bool:
    """Remove the lock of `stale`; return False if by now there is another one, which stays."""
    found = _read(place)
    if found is not None and (found.mark, found.since) != (stale.mark, stale.since):
        return False
    place.unlink(missing_ok=True)
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


def _create(place: Path, owner: Owner) -> int | None:
    """Make the lock file and return what holds it, if it can be held.

    Raises FileExistsError where there is one.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    descriptor = os.open(place, flags, 0o644)
    try:
        held = msgspec.structs.replace(owner, is_held=try_lock(descriptor) is True)
        os.write(descriptor, msgspec.json.encode(held))
    except BaseException:
        os.close(descriptor)
        place.unlink(missing_ok=True)
        raise
    if held.is_held:
        return descriptor
    os.close(descriptor)
    return None


def _read(place: Path) -> Owner | None:
    """Return whom the lock file names, None where there is none; raises OSError where it cannot be read."""
    try:
        descriptor = os.open(place, _READING)
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
        # pid 0 marks an empty file, which a killed process leaves; anything else is somebody's.
        return Owner("", "", "", -1 if data else 0, "", status.st_mtime, "")
    return msgspec.structs.replace(owner, user=_shown(owner.user), host=_shown(owner.host))


def _shown(name: str) -> str:
    """Return a name from a file, fit for a sentence."""
    return "".join(character for character in name if character.isprintable())[:_LONGEST_NAME]


def _user() -> str:
    """Return the name under which the person is logged in."""
    if sys.platform == "win32":
        return os.environ.get("USERNAME", "")
    with suppress(KeyError, OSError):
        return pwd.getpwuid(os.geteuid()).pw_name
    return os.environ.get("USER", "")


def _release(place: Path, owner: Owner, descriptors: list[int | None]) -> None:
    """Remove the lock file if it is still the one of `owner`, and this the process that made it."""
    for descriptor in descriptors:
        if descriptor is not None:
            with suppress(OSError):
                os.close(descriptor)
    if owner.pid != os.getpid():
        return  # A fork that ends; the lock is its parent's.
    with suppress(OSError), folder_lock(place.parent):
        _remove(place, owner)
