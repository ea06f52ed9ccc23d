"""Locks: one owner at a time, and none that outlives its process."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import msgspec
import pytest

from app.storage import lock as lock_module
from app.storage import system
from app.storage.files import remove_stale_files, temporary_name
from app.storage.lock import OLD, Owner, acquire, lock_path, owner_of, take_over
from app.storage.system import Process, is_alive, is_number_alive, machine, this_process, try_lock

ROOT = Path(__file__).parents[2]
posix_only = pytest.mark.skipif(os.name == "nt", reason="processes are told apart on POSIX")


@pytest.fixture
def target(tmp_path):
    return tmp_path / "drawing.curve.json"


def ended_process():
    """A process of this computer that has ended."""
    child = subprocess.Popen([sys.executable, "-c", ""])
    child.wait()
    started = this_process().started.rpartition("/")[0] + "/1"
    return Process(machine(), child.pid, started)


def leave_lock(target, process, *, since=None, user="ada", host="engine", is_held=False):
    since = since or time.time()
    owner = Owner(user, host, process.machine, process.pid, process.started, since, "theirs", is_held)
    lock_path(target).write_bytes(msgspec.json.encode(owner))
    return owner


def without_system_locks(monkeypatch):
    """A network's file system without locks: `fcntl.flock` says ENOLCK."""
    import fcntl

    def fail(*_):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(fcntl, "flock", fail)


def test_the_lock_file_is_beside_the_document_until_release(target):
    result = acquire(lock_path(target))
    place = target.parent / ".drawing.curve.json.lock"
    content = json.loads(place.read_bytes())
    assert content["pid"] == os.getpid()
    assert set(content) == {"user", "host", "machine", "pid", "started", "since", "mark", "is_held"}
    result.lock.release()
    assert not place.exists()
    assert owner_of(lock_path(target)) is None


def test_a_second_request_returns_the_owner(target):
    first = acquire(lock_path(target))
    second = acquire(lock_path(target))
    assert second.lock is None
    assert second.owner.is_this_process
    assert second.owner.is_same_person
    assert owner_of(lock_path(target)) == second.owner
    first.lock.release()
    assert acquire(lock_path(target)).lock is not None


def test_a_lock_is_released_with_its_object(target):
    acquire(lock_path(target))
    assert not lock_path(target).exists()


def test_releasing_leaves_the_lock_of_another_owner(target):
    lock = acquire(lock_path(target)).lock
    other = leave_lock(target, Process("elsewhere", 7, "x"))
    assert lock.lost_to() == other
    lock.release()
    assert owner_of(lock_path(target)) == other


def test_a_deleted_lock_file_is_created_again(target):
    lock = acquire(lock_path(target)).lock
    lock_path(target).unlink()
    assert lock.lost_to() is None
    assert acquire(lock_path(target)).owner is not None


@posix_only
def test_the_lock_of_a_dead_process_is_reclaimed(target):
    leave_lock(target, ended_process())
    assert owner_of(lock_path(target)) is None
    result = acquire(lock_path(target))
    assert result.lock is not None
    assert sorted(path.name for path in target.parent.iterdir()) == [lock_path(target).name]


@posix_only
def test_a_later_process_with_the_same_id_is_not_the_owner(target):
    """Numbers come round again; the time of the start tells them apart."""
    parent = os.getppid()
    assert is_number_alive(parent)
    started = this_process().started.rpartition("/")[0] + "/1"
    leave_lock(target, Process(machine(), parent, started))
    assert acquire(lock_path(target)).lock is not None


@pytest.mark.skipif(sys.platform != "linux", reason="the boot's identity is Linux's")
def test_no_owner_survives_a_restart_of_the_computer(target):
    _, rest = this_process().started.split("/", 1)
    leave_lock(target, Process(machine(), os.getpid(), f"another-boot/{rest}"))
    assert acquire(lock_path(target)).lock is not None


@pytest.mark.skipif(sys.platform != "linux", reason="containers are Linux's")
def test_the_state_of_a_process_in_another_container_is_unknown():
    boot, _, start = this_process().started.split("/")
    assert is_alive(Process(machine(), 4_000_000, f"{boot}/another/{start}")) is None


@pytest.mark.skipif(shutil.which("ps") is None, reason="there is no ps")
def test_the_start_time_comes_from_ps_without_proc(monkeypatch):
    """As on macOS."""
    monkeypatch.setattr(system, "_started", system._started_by_ps)
    own = Process(machine(), os.getpid(), system._started(os.getpid()))
    assert own.started
    assert is_alive(own)
    assert is_alive(Process(machine(), os.getpid(), "another time")) is False
    assert is_alive(Process(machine(), ended_process().pid, own.started)) is False


@pytest.mark.skipif(sys.platform != "linux", reason="containers are Linux's")
def test_the_system_lock_shows_whether_an_owner_in_a_container_runs(target):
    """Each start of a Flatpak is a container of its own: after a kill, nobody could say that it had ended."""
    code = """\
        import sys
        from pathlib import Path
        from app.storage import system
        system._numbering = lambda: "another container"
        from app.storage.lock import acquire, lock_path
        result = acquire(lock_path(Path(sys.argv[1])))
        print(result.lock is not None, flush=True)
        sys.stdin.read()
    """
    command = [sys.executable, "-c", textwrap.dedent(code), str(target)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, cwd=ROOT, text=True, **pipes) as process:
        assert process.stdout.readline() == "True\n"
        owner = owner_of(lock_path(target))
        assert is_alive(owner.process) is None
        assert acquire(lock_path(target)).owner == owner
        assert owner_of(lock_path(target)) == owner  # looking took nothing away
        process.kill()
    assert lock_path(target).exists()
    assert owner_of(lock_path(target)) is None
    lock = acquire(lock_path(target)).lock
    assert lock is not None
    taken = take_over(lock_path(target)).lock
    lock.release()
    assert owner_of(lock_path(target)).mark != owner.mark
    taken.release()
    assert not lock_path(target).exists()


def test_an_unknown_process_is_not_considered_dead(target, monkeypatch):
    """As on Windows: the person decides."""
    dead = ended_process()
    monkeypatch.setattr(system, "_started", lambda _pid: "")
    assert is_alive(dead) is None
    assert is_number_alive(dead.pid) is None
    leave_lock(target, dead)
    assert acquire(lock_path(target)).owner is not None


def test_a_lock_of_another_computer_is_never_stale(target):
    owner = leave_lock(target, Process("elsewhere", 1, "x"), since=time.time() - OLD - 60)
    result = acquire(lock_path(target))
    assert result.owner == owner
    assert result.owner.may_have_forgotten
    assert not result.owner.is_same_person


def test_a_stale_lock_of_this_process_is_reclaimed(target):
    leave_lock(target, this_process(), is_held=True)
    assert acquire(lock_path(target)).lock is not None


@posix_only
def test_a_lock_without_a_holder_is_stale(target):
    """Whatever has its number now: here the process that started this one."""
    started = system._started(os.getppid())
    parent = Process(machine(), os.getppid(), started)
    assert is_alive(parent)
    leave_lock(target, parent, is_held=True)
    assert owner_of(lock_path(target)) is None
    assert acquire(lock_path(target)).lock is not None
    other = target.with_name("other")
    leave_lock(other, parent)  # made where nothing can be held: then the process counts
    assert acquire(lock_path(other)).owner is not None


@posix_only
@pytest.mark.parametrize("content", [b"", b"\0" * 300, b'{"user": "ad'], ids=["empty", "zeros", "torn"])
def test_in_a_private_folder_an_unheld_lock_is_free(target, content):
    """After a power cut, or under a name that the computer had elsewhere, work must not be lost."""
    place = lock_path(target)
    place.write_bytes(content)
    acquire(place, is_private=True).lock.release()
    leave_lock(target, Process("renamed", 1, "x"), is_held=True)
    first = acquire(place, is_private=True)
    assert first.lock is not None
    assert acquire(place, is_private=True).owner is not None
    first.lock.release()


@posix_only
def test_in_a_private_folder_without_system_locks_a_running_process_keeps_its_lock(target, monkeypatch):
    without_system_locks(monkeypatch)
    place = lock_path(target)
    first = acquire(place, is_private=True)
    assert acquire(place, is_private=True).owner.is_this_process
    first.lock.release()
    leave_lock(target, ended_process())
    assert acquire(place, is_private=True).lock is not None


def test_the_former_owner_notices_a_takeover(target):
    first = acquire(lock_path(target)).lock
    second = take_over(lock_path(target)).lock
    assert first.lost_to().mark == json.loads(lock_path(target).read_bytes())["mark"]
    first.release()
    assert second.lost_to() is None
    second.release()
    assert list(target.parent.iterdir()) == []


@posix_only
def test_an_empty_unheld_lock_is_stale(target):
    """Between making the file and writing it lies a moment in which a process can be killed."""
    place = lock_path(target)
    place.touch()
    with place.open("rb") as file:
        assert try_lock(file.fileno())
        assert acquire(place).owner is not None
    assert acquire(place).lock is not None


@posix_only
def test_without_system_locks_an_empty_lock_is_stale_after_ten_seconds(target, monkeypatch):
    without_system_locks(monkeypatch)
    place = lock_path(target)
    place.touch()
    touched = place.stat().st_mtime
    monkeypatch.setattr("app.storage.lock.time.time", lambda: touched + 9.9)
    assert acquire(place).owner is not None
    monkeypatch.setattr("app.storage.lock.time.time", lambda: touched + 10.1)
    assert acquire(place).lock is not None


@pytest.mark.parametrize(
    "content",
    [b"garbage", b"{}", b"\xff\xfe", b'{"pid": "x"}', b"[" * 5000, b"null"],
    ids=["text", "empty object", "bytes", "wrong type", "deep", "null"],
)
def test_an_unreadable_lock_has_an_owner(target, content):
    lock_path(target).write_bytes(content)
    assert acquire(lock_path(target)).owner.user == ""
    assert take_over(lock_path(target)).lock is not None


def test_names_from_a_lock_file_are_printable(target):
    leave_lock(target, Process("elsewhere", 1, "x"), user="a\n\x1b[31m" + "b" * 500, host="\u202eh")
    owner = acquire(lock_path(target)).owner
    assert owner.user.isprintable()
    assert len(owner.user) <= 60
    assert owner.host == "h"


@posix_only
def test_a_pipe_named_like_the_lock_file_does_not_block(target):
    os.mkfifo(lock_path(target))
    assert acquire(lock_path(target)).owner is not None


@posix_only
def test_a_link_named_like_the_lock_file_is_not_followed(target, tmp_path):
    (tmp_path / "secret").write_bytes(b"x")
    lock_path(target).symlink_to(tmp_path / "secret")
    result = acquire(lock_path(target))
    assert result.lock is None
    assert (tmp_path / "secret").read_bytes() == b"x"


@pytest.mark.parametrize("code", [errno.EROFS, errno.EACCES, errno.ENOLCK, errno.ENOSPC, errno.ENOTSUP])
def test_a_document_opens_without_a_lock(target, monkeypatch, code):
    def fail(*_):
        raise OSError(code, os.strerror(code))

    with monkeypatch.context() as faulty:
        faulty.setattr(lock_module, "_create", fail)
        result = acquire(lock_path(target))
        assert take_over(lock_path(target)).problem == os.strerror(code)
    assert result.lock is None
    assert result.owner is None
    assert result.problem == os.strerror(code)
    assert list(target.parent.iterdir()) == []


def test_a_name_too_long_for_a_lock_file_opens_without_a_lock(tmp_path):
    result = acquire(lock_path(tmp_path / ("n" * 252)))
    assert result.owner is None
    assert result.problem


@posix_only
def test_without_system_locks_a_lock_is_still_exclusive(target, monkeypatch):
    without_system_locks(monkeypatch)
    first = acquire(lock_path(target))
    assert first.lock is not None
    assert acquire(lock_path(target)).owner is not None
    first.lock.release()
    leave_lock(target, ended_process())
    assert acquire(lock_path(target)).lock is not None


@posix_only
def test_a_new_lock_stays_when_another_process_judges_the_old_lock_stale(target):
    """Two judge the same lock stale; what the slower one removes is the quicker one's new lock."""
    stale = leave_lock(target, ended_process())
    quick = acquire(lock_path(target))
    assert quick.lock is not None
    assert not lock_module._remove(lock_path(target), stale)
    assert quick.lock.lost_to() is None
    assert list(target.parent.iterdir()) == [lock_path(target)]


@posix_only
def test_without_system_locks_one_of_two_owners_notices_the_loss(target, monkeypatch):
    """There the slower one may be just so slow that it removes the new lock: then one of them is told."""
    without_system_locks(monkeypatch)
    leave_lock(target, ended_process())
    real, quick = Path.unlink, []

    def unlink(path, **_):
        real(path)
        if not quick:
            quick.append(acquire(path).lock)
            real(path)

    with monkeypatch.context() as slow:
        slow.setattr(Path, "unlink", unlink)
        second = acquire(lock_path(target)).lock
    assert second.lost_to() is None
    assert quick[0].lost_to() is not None


RACE = """
import os, sys, time
from pathlib import Path
from app.storage.lock import acquire, lock_path
print("ready", flush=True)
while not Path(sys.argv[2]).exists():
    time.sleep(0.001)
result = acquire(lock_path(Path(sys.argv[1])))
print("mine" if result.lock else "theirs", flush=True)
sys.stdin.read()
os._exit(0)
"""


@posix_only
def test_of_several_processes_one_gets_a_stale_lock(target, tmp_path):
    leave_lock(target, ended_process())
    signal = tmp_path / "go"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    racers = [
        subprocess.Popen(
            [sys.executable, "-c", textwrap.dedent(RACE), str(target), str(signal)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
        )
        for _ in range(4)
    ]
    assert [racer.stdout.readline().strip() for racer in racers] == [b"ready"] * 4
    signal.touch()
    answers = sorted(racer.stdout.readline().strip() for racer in racers)
    for racer in racers:
        racer.communicate(b"")
    assert answers == [b"mine", b"theirs", b"theirs", b"theirs"]


@posix_only
def test_a_process_that_ends_releases_its_locks(target):
    code = "import sys; from pathlib import Path; from app.storage.lock import acquire, lock_path\n"
    code += "kept = acquire(lock_path(Path(sys.argv[1]))); print(kept.lock.path.exists())"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", code, str(target)], env=environment, capture_output=True, check=True
    )
    assert done.stdout.strip() == b"True"
    assert not lock_path(target).exists()


# What a crash leaves behind


def old_file(path, seconds=3600.0):
    path.write_bytes(b"half")
    os.utime(path, (time.time() - seconds, time.time() - seconds))
    return path


def name_of(process):
    return f".curvebench-{process.machine[:8]}-{process.pid}-{'0' * 16}.tmp"


@posix_only
def test_temporary_files_of_ended_processes_are_removed(tmp_path):
    left = old_file(tmp_path / name_of(ended_process()))
    assert remove_stale_files(tmp_path) == 1
    assert not left.exists()


@posix_only
def test_other_temporary_files_are_not_removed(tmp_path):
    dead = ended_process()
    kept = [
        old_file(tmp_path / temporary_name()),  # a process that runs: this one
        old_file(tmp_path / name_of(dead), seconds=5.0),  # perhaps just being written
        old_file(tmp_path / name_of(Process("f" * 16, dead.pid, ""))),  # of another computer
        old_file(tmp_path / ".curvebench-notes.tmp"),
        old_file(tmp_path / (name_of(dead) + "~")),
        old_file(tmp_path / "drawing.curve.json"),
    ]
    folder = tmp_path / name_of(dead).replace("0" * 16, "1" * 16)
    folder.mkdir()
    link = tmp_path / name_of(dead).replace("0" * 16, "2" * 16)
    link.symlink_to(kept[0])
    assert remove_stale_files(tmp_path) == 0
    assert all(path.exists() for path in (*kept, folder, link))


def test_removing_stale_files_from_a_missing_folder_does_nothing(tmp_path):
    assert remove_stale_files(tmp_path / "gone") == 0
