"""Saving when something fails: the old file or the new one, whole, and never less.

Each fault is the real one where that can be had: processes are killed, limits and small disks run full, and
folders are read-only for a user who is not root.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from app.document.model import Document, make_curve
from app.storage import system
from app.storage.files import ChangedOnDiskError, StorageError, load, save
from app.storage.format import encode
from app.storage.open_file import OpenFile

pytestmark = [
    pytest.mark.skipif(os.name == "nt", reason="signals, limits and permissions of POSIX"),
    # The children do one thing and end without cleaning up; what threads there are does not matter to them.
    pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning"),
]

ROOT = Path(__file__).parents[2]
NOBODY = 65534
OLD = Document((make_curve([(1.0, 0.0), (2.0, 0.0)]),))
LARGE = Document((make_curve([(index / 7, 0.0) for index in range(4000)]),))


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "drawing.curve.json"
    save(path, OLD)
    return path


def python(*arguments):
    """A Python that finds the program."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, *map(str, arguments)]
    return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)


def holds_old_alone(path):
    return path.read_bytes() == encode(OLD) and list(path.parent.iterdir()) == [path]


# kill -9


def test_a_save_killed_at_any_step_leaves_the_old_or_the_new_file(tmp_path):
    child = python(Path(__file__).with_name("kill_at_every_step.py"), tmp_path)
    results = json.loads(child.communicate()[0])
    for kind, steps in results.items():
        holds = [step["holds"] for step in steps]
        # At some step the old file is replaced, and from then on it is the new one.
        replaced = holds.index("new")
        assert holds == ["old"] * replaced + ["new"] * (len(steps) - replaced)
        assert replaced > 25
        assert all(step["killed"] for step in steps[:-1])
        assert not steps[-1]["killed"]
        # What is left over can be told, and goes.
        assert any(step["temporary"] for step in steps)
        assert all(step["swept"] == step["temporary"] for step in steps)
        known = {".drawing.curve.json.lock", *(["drawing.curve.json.v0.bak"] if kind == "older" else [])}
        assert all(set(step["others"]) <= known for step in steps)
    # The old file goes only after its copy is there, and whole.
    for step in results["older"]:
        assert step["whole_backups"]
        assert step["holds"] == "old" or "drawing.curve.json.v0.bak" in step["others"]


# A full disk


def in_child(work):
    """Do `work` in a fork and return what it says; nothing of it remains in this process."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            said = work() or ""
        except BaseException as problem:
            said = f"{type(problem).__name__}: {problem}"
        os.write(writing, said.encode())
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as answer:
        said = answer.read()
    os.waitpid(child, 0)
    return said


@pytest.mark.parametrize("limit", [0, 1, 4096, 65_536])
def test_a_limit_on_the_file_size_keeps_the_old_file(path, limit):
    import resource

    def work():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        save(path, LARGE)

    said = in_child(work)
    assert said.startswith("StorageError: ")
    reason = os.strerror(errno.EFBIG)
    assert said.endswith(f"was not written ({reason}). Choose another folder or disk.")
    assert holds_old_alone(path)


def test_a_document_opens_on_a_disk_without_room_for_a_lock(path):
    import resource

    def work():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
        file = OpenFile.open(path).file
        return f"{file.owner} {file.lock_problem}"

    assert in_child(work) == f"None {os.strerror(errno.EFBIG)}"
    assert holds_old_alone(path)


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 64 KB, where one may be mounted."""
    folder = tmp_path / "small"
    folder.mkdir()
    mount = shutil.which("mount")
    if os.geteuid() != 0 or mount is None:
        pytest.skip("only root may mount a small disk")
    done = subprocess.run(
        [mount, "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(folder)], capture_output=True, check=False
    )
    if done.returncode:
        pytest.skip(f"no disk can be mounted here: {done.stderr.decode().strip()}")
    yield folder
    subprocess.run([shutil.which("umount"), str(folder)], check=True)


def fill(file):
    while True:
        file.write(bytes(4096))


def test_a_full_disk_keeps_the_old_file(small_disk):
    path = small_disk / "drawing.curve.json"
    save(path, OLD)
    with pytest.raises(StorageError, match=r"The disk is full.*Free some space or choose another disk"):
        save(path, LARGE)
    assert holds_old_alone(path)
    filler = small_disk / "filler"
    with filler.open("wb", buffering=0) as file, pytest.raises(OSError, match=r"\[Errno 28\]"):
        fill(file)
    opened = OpenFile.open(path)
    assert opened.document == OLD
    with pytest.raises(StorageError, match="The disk is full"):
        OpenFile.saved(path, LARGE, opened.file)
    filler.unlink()
    OpenFile.saved(path, OLD, opened.file)
    opened.file.close()
    assert holds_old_alone(path)


# Disks that fail


def fail_at(number, code):
    """A function that fails when called the `number`-th time, and from then on."""
    calls = []

    def fail(*_arguments, **_keywords):
        calls.append(None)
        if len(calls) >= number:
            raise OSError(code, os.strerror(code))

    return fail


@pytest.mark.parametrize("code", [errno.EIO, errno.ENOSPC, errno.EDQUOT])
@pytest.mark.parametrize(("owner", "step"), [(os, "fsync"), (Path, "replace"), (os, "open"), (os, "fstat")])
def test_a_failing_step_keeps_the_old_file(path, monkeypatch, owner, step, code):
    opened = OpenFile.open(path)
    with monkeypatch.context() as faulty:
        faulty.setattr(owner, step, fail_at(1, code))
        with pytest.raises(StorageError, match=r"(was not written|cannot be read).*[Cc]hoose another"):
            OpenFile.saved(path, LARGE, opened.file)
    OpenFile.saved(path, OLD, opened.file)  # nothing was seen that was not there
    opened.file.close()
    assert holds_old_alone(path)


def test_an_unremovable_temporary_file_is_not_reported(path, monkeypatch):
    with monkeypatch.context() as faulty:
        faulty.setattr(Path, "replace", fail_at(1, errno.EIO))
        faulty.setattr(Path, "unlink", fail_at(1, errno.EIO))
        with pytest.raises(StorageError, match="was not written"):
            save(path, LARGE)
    assert load(path) == OLD


def test_a_missing_folder_is_reported(path):
    opened = OpenFile.open(path)
    shutil.rmtree(path.parent)
    with pytest.raises(StorageError, match=r"The folder of .* does not exist\. Choose another folder"):
        OpenFile.saved(path, LARGE, opened.file)
    opened.file.close()


def test_saving_works_on_a_file_system_without_locks(path, monkeypatch):
    """Some network file systems answer ENOLCK, some lock no folders."""
    import fcntl

    for code in (errno.ENOLCK, errno.EBADF, errno.ENOTSUP):
        with monkeypatch.context() as faulty:
            faulty.setattr(fcntl, "flock", fail_at(1, code))
            opened = OpenFile.open(path)
            OpenFile.saved(path, OLD, opened.file)
            opened.file.close()
    assert holds_old_alone(path)


def test_saving_does_not_wait_forever_for_a_locked_folder(path, monkeypatch):
    monkeypatch.setattr(system, "_PATIENCE", 0.05)
    with system.folder_lock(path.parent):
        save(path, LARGE)
    assert load(path) == LARGE


# Permissions


@pytest.fixture
def as_nobody():
    """A folder of an ordinary user, and a way to do something as that user."""
    folder = Path(tempfile.mkdtemp())
    is_root = os.geteuid() == 0
    if is_root:
        os.chown(folder, NOBODY, NOBODY)

    def run(work):
        def as_user():
            if is_root:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
            return work()

        return in_child(as_user)

    yield folder, run
    folder.chmod(0o700)
    shutil.rmtree(folder)


def test_saving_into_a_read_only_folder_is_refused(as_nobody):
    folder, run = as_nobody
    path = folder / "drawing.curve.json"
    assert run(lambda: save(path, OLD) and "") == ""
    folder.chmod(0o555)

    def work():
        opened = OpenFile.open(path)
        assert opened.document == OLD
        assert opened.file.owner is None
        assert opened.file.lock_problem == os.strerror(errno.EACCES)
        OpenFile.saved(path, LARGE, opened.file)

    said = run(work)
    assert said.endswith("cannot be written in that folder. Choose another folder.")
    assert holds_old_alone(path)


def test_saving_over_a_read_only_file_is_refused(as_nobody):
    """Its folder would let it be replaced; that is not what its owner meant."""
    folder, run = as_nobody
    path = folder / "drawing.curve.json"
    run(lambda: save(path, OLD) and "")
    path.chmod(0o444)
    said = run(lambda: save(path, LARGE) and "")
    assert said.endswith("is write-protected. Save under another name.")
    assert holds_old_alone(path)


def test_saving_works_in_an_unreadable_folder(as_nobody):
    folder, run = as_nobody
    path = folder / "drawing.curve.json"
    run(lambda: save(path, OLD) and "")
    folder.chmod(0o300)
    assert run(lambda: save(path, LARGE) and "") == ""
    folder.chmod(0o700)
    assert load(path) == LARGE


def test_saving_works_over_an_unreadable_file(as_nobody):
    folder, run = as_nobody
    path = folder / "drawing.curve.json"

    def work():
        save(path, OLD)
        file = OpenFile.open(path).file
        path.chmod(0o200)
        file = OpenFile.saved(path, LARGE, file)  # by what the folder says it is the one that was seen
        path.write_bytes(b"somebody else's")
        try:
            OpenFile.saved(path, OLD, file)
        except ChangedOnDiskError:
            file.close()
            return "noticed"
        return "not noticed"

    assert run(work) == "noticed"
    path.chmod(0o600)
    assert path.read_bytes() == b"somebody else's"


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="only root may give files away")
def test_saving_as_root_keeps_the_owner(path):
    os.chown(path, NOBODY, NOBODY)
    path.chmod(0o640)
    save(path, LARGE)
    status = path.stat()
    assert (status.st_uid, status.st_gid, status.st_mode & 0o7777) == (NOBODY, NOBODY, 0o640)


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="only root may give files away")
def test_a_changed_group_gets_the_permissions_of_everybody(as_nobody):
    """A group that cannot be kept must not give its rights to the group of whoever saves."""
    folder, run = as_nobody
    path = folder / "drawing.curve.json"
    save(path, OLD)
    os.chown(path, NOBODY, 0)
    path.chmod(0o664)
    assert run(lambda: save(path, LARGE) and "") == ""
    assert path.stat().st_mode & 0o7777 == 0o644
    assert path.stat().st_gid == NOBODY


@pytest.mark.skipif(not hasattr(os, "setxattr"), reason="attributes of Linux")
def test_extended_attributes_survive_a_save(path):
    try:
        os.setxattr(path, "user.tag", b"draft")
    except OSError as problem:
        pytest.skip(f"no attributes here: {problem}")
    save(path, LARGE)
    assert os.getxattr(path, "user.tag") == b"draft"


# Two at once


def test_two_processes_that_save_the_same_file_leave_a_complete_file(tmp_path):
    """Each save raises a number that was read before: if one were lost, the sum would not come out."""
    path, go = tmp_path / "drawing.curve.json", tmp_path / "go"
    save(path, Document((make_curve([(0.0, 0.0), (1.0, 0.0)]),)))
    writers = [python(Path(__file__).with_name("cas_writer.py"), path, go, 60) for _ in range(2)]
    go.touch()
    saved = [int(writer.communicate()[0]) for writer in writers]
    assert load(path).curves[0].points[0].x == sum(saved)
    assert sum(saved) >= 60
    assert sorted(each.name for each in tmp_path.iterdir()) == [path.name, go.name]


def test_a_change_just_before_replacing_is_detected(path, monkeypatch):
    """Somebody writes after the new file is on the disk and before it takes the place of the old one."""
    opened = OpenFile.open(path)
    real = os.fsync

    def fsync(descriptor):
        real(descriptor)
        path.write_bytes(encode(LARGE))

    with monkeypatch.context() as faulty:
        faulty.setattr(os, "fsync", fsync)
        with pytest.raises(ChangedOnDiskError):
            OpenFile.saved(path, OLD, opened.file)
    assert load(path) == LARGE
    opened.file.close()
