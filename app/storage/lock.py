"""Whose a document is while it is open: a small file beside it that names its owner.

The lock of ``name.curve.json`` is ``.name.curve.json.lock``. It is made by the system in one step, so that of
two who come at once one gets it; one whose owner has died is taken over. It is a courtesy between people, not
what keeps files whole: where no lock can be made, work goes on without.

Whether an owner still runs is told by its process. Where that cannot be asked (each start in a container of
its own, as Flatpak does it), a lock of the system tells, which the owner holds on the lock file and the
system lets go of with the process.
"""

from __future__ import annotations

import os
import platform
import stat
import time
import weakref
from contextlib import suppress
from pathlib import Path

import msgspec

from app.storage.leftovers import temporary_name
from app.storage.processes import Process, is_alive, this_process
from app.storage.turns import taking_turns

try:
    import fcntl
except ImportError:  # Windows, where a file that is held could not be taken over
    fcntl = None  # type: ignore[assignment]

OLD = 24 * 3600.0
"""Seconds after which an owner who cannot be asked may have forgotten the document."""

_LONGEST = 4096
_LONGEST_NAME = 60
_BEING_WRITTEN = 10.0
"""Seconds that an empty lock file is taken for one that is just being written."""

_held: set[str] = set()
"""The marks of the locks that this process has now; one of its own that is not here is a leftover."""


class Owner(msgspec.Struct, frozen=True):
    """Who has a document open.

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


class Lock:
    """A lock that is held; `release` gives it up, and so does the end of the process."""

    def __init__(self, place: Path, owner: Owner, descriptor: int | None) -> None:
        self.place, self._owner = place, owner
        _held.add(owner.mark)
        self._descriptors = [descriptor]
        self._finalizer = weakref.finalize(self, _release, place, owner, self._descriptors)

    def lost_to(self) -> Owner | None:
        """Return who has taken it over meanwhile; None while it is ours.

        One that somebody deleted is made anew.
        """
        with suppress(OSError):
            found = _read(self.place)
            if found is None:
                self._descriptors.append(_create(self.place, self._owner))
            elif found.mark != self._owner.mark:
                return found
        return None

    def release(self) -> None:
        """Give it up."""
        self._finalizer()


class Attempt(msgspec.Struct, frozen=True):
    """What came of asking for a lock: one of the three is there.

    Attributes
    ----------
    lock
        The lock, if it is ours now.
    owner
        Who has it, if somebody has.
    problem
        Why there can be no lock in this folder; empty where there can.
    """

    lock: Lock | None = None
    owner: Owner | None = None
    problem: str = ""


def lock_place(target: Path) -> Path:
    """Return where the lock of the file `target` lies."""
    return target.with_name(f".{target.name}.lock")


def acquire(target: Path) -> Attempt:
    """Ask for the lock of the file `target`, whose links are resolved."""
    place = lock_place(target)
    try:
        with taking_turns(place.parent):
            found = _read(place)
            if found is not None and not (_is_stale(found, place) and _set_aside(place, found)):
                return Attempt(owner=_read(place) or found)
            mine = _new_owner()
            return Attempt(lock=Lock(place, mine, _create(place, mine)))
    except FileExistsError:
        # Somebody was quicker, in a folder where turns cannot be taken.
        return Attempt(owner=owner_of(target), problem="it is being opened elsewhere")
    except (OSError, ValueError) as problem:
        return Attempt(problem=getattr(problem, "strerror", None) or str(problem))


def take_over(target: Path) -> Attempt:
    """Take the lock of the file `target`, whoever has it; they will notice."""
    place = lock_place(target)
    mine = _new_owner()
    aside = place.with_name(temporary_name())
    try:
        with taking_turns(place.parent):
            descriptor = _create(aside, mine)
            try:
                aside.replace(place)
            except BaseException:
                _let_go(descriptor)
                aside.unlink(missing_ok=True)
                raise
    except (OSError, ValueError) as problem:
        return Attempt(problem=getattr(problem, "strerror", None) or str(problem))
    return Attempt(lock=Lock(place, mine, descriptor))


def owner_of(target: Path) -> Owner | None:
    """Return who has the file `target` open; None where nobody has, or nobody who still runs."""
    place = lock_place(target)
    try:
        found = _read(place)
    except (OSError, ValueError):
        return None
    return None if found is None or _is_stale(found, place) else found


def _is_stale(owner: Owner, place: Path) -> bool:
    """Whether the owner of the lock at `place` has certainly ended."""
    if not owner.mark:
        # A process that was killed between making and writing it; a fresh one is being written.
        return owner.pid == 0 and time.time() - owner.since > _BEING_WRITTEN
    if owner.is_this_process:
        return owner.mark not in _held
    runs = is_alive(owner.process)
    if runs is None and owner.is_held and owner.machine == this_process().machine:
        return _is_free(place)
    return runs is False


def _is_free(place: Path) -> bool:
    """Whether nobody holds the lock file at `place`, as far as this computer's system knows."""
    with suppress(OSError):
        descriptor = os.open(place, os.O_RDONLY)
        try:
            return _hold(descriptor)
        finally:
            os.close(descriptor)
    return False


def _hold(descriptor: int) -> bool:
    """Hold the open file until it is closed; return whether that is possible."""
    if fcntl is None:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _let_go(descriptor: int | None) -> None:
    if descriptor is not None:
        os.close(descriptor)


def _set_aside(place: Path, stale: Owner) -> bool:
    """Remove the lock `stale`; return False if by now there is another one, which stays."""
    aside = place.with_name(temporary_name())
    try:
        place.rename(aside)
    except FileNotFoundError:
        return True
    # Only one process gets a file by renaming it; but it may be a new lock that was made since the look.
    found = _read(aside)
    if found is not None and found.mark != stale.mark:
        with suppress(FileExistsError):
            os.link(aside, place)
        aside.unlink(missing_ok=True)
        return False
    aside.unlink(missing_ok=True)
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
        held = msgspec.structs.replace(owner, is_held=_hold(descriptor))
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
    # A pipe or a link in its place is nothing to wait for or to follow.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0)
    try:
        descriptor = os.open(place, flags | getattr(os, "O_BINARY", 0))
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
    try:
        import pwd  # noqa: PLC0415 - not there on Windows
    except ImportError:
        return os.environ.get("USERNAME", "")
    with suppress(KeyError, OSError):
        return pwd.getpwuid(os.geteuid()).pw_name
    return os.environ.get("USER", "")


def _release(place: Path, owner: Owner, descriptors: list[int | None]) -> None:
    """Remove the lock file if it is still the one of `owner`, and this the process that made it."""
    _held.discard(owner.mark)
    for descriptor in descriptors:
        with suppress(OSError):
            _let_go(descriptor)
    if owner.pid != os.getpid():
        return  # A fork that ends; the lock is its parent's.
    with suppress(OSError), taking_turns(place.parent):
        found = _read(place)
        if found is not None and found.mark == owner.mark:
            place.unlink()
