"""Files on disk: written whole or not at all, and refused with a sentence that says what to do."""

import errno
import os
import shutil
import stat
import tempfile
from pathlib import Path

import pytest

from app.document.model import Document, empty_document, make_curve
from app.storage import files
from app.storage.files import StorageError, load, read, save, write
from app.storage.format_error import FormatError

posix_only = pytest.mark.skipif(os.name == "nt", reason="permissions and pipes of POSIX")
NOBODY = 65534


@pytest.fixture
def target(tmp_path):
    """An existing file with old content."""
    path = tmp_path / "drawing.curve.json"
    path.write_bytes(b"old")
    return path


@pytest.fixture
def ordinary_user():
    """A folder of an ordinary user, as whom the test runs: root may read and write everything."""
    folder = Path(tempfile.mkdtemp())
    is_root = os.geteuid() == 0
    if is_root:
        os.chown(folder, NOBODY, -1)
        os.seteuid(NOBODY)
    yield folder
    if is_root:
        os.seteuid(0)
    folder.chmod(0o700)
    shutil.rmtree(folder)


def only(path):
    """Whether the folder holds this file and nothing else."""
    return list(path.parent.iterdir()) == [path]


def test_a_saved_document_is_loaded(tmp_path):
    document = Document((make_curve([(0.1, 0.2), (1 / 3, 4.0)]),))
    path = tmp_path / "a.curve.json"
    save(path, document)
    assert load(path) == document
    assert only(path)


def test_an_invalid_document_is_not_written(target):
    curve = make_curve([(0.0, 0.0)])
    broken = Document((make_curve([(float("nan"), 0.0)]), curve))
    with pytest.raises(FormatError):
        save(target, broken)
    assert target.read_bytes() == b"old"


def test_loading_a_bad_file_names_the_field(target):
    target.write_bytes(b'{"format": "curvebench", "version": 4, "curves": []}')
    with pytest.raises(FormatError, match="curves must hold at least one curve"):
        load(target)


def test_large_content_is_written_completely(target):
    data = bytes(range(256)) * 40_000
    write(target, data)
    assert read(target) == data


@posix_only
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o755])
def test_permissions_of_the_old_file_survive_a_write(target, mode):
    target.chmod(mode)
    write(target, b"new")
    assert stat.S_IMODE(target.stat().st_mode) == mode


@posix_only
def test_a_new_file_gets_the_usual_permissions(tmp_path):
    old_mask = os.umask(0o027)
    try:
        write(tmp_path / "new", b"")
    finally:
        os.umask(old_mask)
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o640


@posix_only
def test_a_symbolic_link_is_followed_and_stays(tmp_path, target):
    folder = tmp_path / "links"
    folder.mkdir()
    link = folder / "link.curve.json"
    link.symlink_to(Path("..") / target.name)
    write(link, b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"
    assert only(link)


@posix_only
def test_saving_to_a_dangling_link_creates_its_target(tmp_path):
    link = tmp_path / "link"
    link.symlink_to(tmp_path / "file")
    write(link, b"new")
    assert link.is_symlink()
    assert (tmp_path / "file").read_bytes() == b"new"


def fail_with(code):
    def fail(*_args, **_keywords):
        raise OSError(code, os.strerror(code))

    return fail


@pytest.mark.parametrize(
    ("step", "code", "words"),
    [
        ("fsync", errno.EIO, "was not written ({reason}). Choose another folder or disk."),
        ("fsync", errno.ENOSPC, "The disk is full"),
        ("open", errno.EROFS, "cannot be written in that folder"),
        ("fdopen", errno.ENOSPC, "Free some space or choose another disk"),
    ],
)
def test_a_failing_step_leaves_the_old_file(target, monkeypatch, step, code, words):
    with monkeypatch.context() as faulty:
        faulty.setattr(os, step, fail_with(code))
        with pytest.raises(StorageError) as refusal:
            write(target, b"new")
    assert words.format(reason=os.strerror(code)) in str(refusal.value)
    assert target.name in str(refusal.value)
    assert target.read_bytes() == b"old"
    assert only(target)


@pytest.mark.parametrize("problem", [OSError(errno.EIO, "broken"), KeyboardInterrupt()])
def test_a_failing_replacement_leaves_the_old_file(target, monkeypatch, problem):
    def fail(*_):
        raise problem

    with monkeypatch.context() as faulty:
        faulty.setattr(Path, "replace", fail)
        with pytest.raises((StorageError, KeyboardInterrupt)):
            write(target, b"new")
    assert target.read_bytes() == b"old"
    assert only(target)


def fail_from_call(number, code):
    """An os.fsync that fails from its `number`-th call on."""
    calls = []
    real = os.fsync

    def fsync(descriptor):
        calls.append(descriptor)
        if len(calls) >= number:
            raise OSError(code, os.strerror(code))
        real(descriptor)

    return fsync


@posix_only
def test_a_folder_that_cannot_be_synced_is_reported(target, monkeypatch):
    monkeypatch.setattr(os, "fsync", fail_from_call(2, errno.EIO))
    with pytest.raises(StorageError, match="was written, but the disk did not confirm it"):
        write(target, b"new")
    assert target.read_bytes() == b"new"


@posix_only
def test_a_file_system_without_folder_sync_is_accepted(target, monkeypatch):
    monkeypatch.setattr(os, "fsync", fail_from_call(2, errno.EINVAL))
    write(target, b"new")
    assert target.read_bytes() == b"new"


@posix_only
def test_the_data_is_synced_before_the_old_file_is_replaced(target, monkeypatch):
    seen = []
    real = os.fsync

    def fsync(descriptor):
        seen.append(target.read_bytes())
        real(descriptor)

    monkeypatch.setattr(os, "fsync", fsync)
    write(target, b"new")
    assert seen == [b"old", b"new"]


@posix_only
def test_a_read_only_folder_is_refused(ordinary_user):
    target = ordinary_user / "a"
    write(target, b"old")
    ordinary_user.chmod(0o555)
    with pytest.raises(StorageError, match="cannot be written in that folder"):
        write(target, b"new")
    assert target.read_bytes() == b"old"
    assert only(target)


def test_a_write_protected_file_is_not_replaced(target, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(StorageError, match=r"is write-protected\. Save under another name"):
        write(target, b"new")
    assert target.read_bytes() == b"old"


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(StorageError, match=r"The folder of “.*” does not exist"):
        write(tmp_path / "a" / "b", b"")


def test_a_name_beyond_the_length_limit_is_refused(tmp_path):
    with pytest.raises(StorageError, match="is too long"):
        write(tmp_path / ("n" * 300), b"")
    assert list(tmp_path.iterdir()) == []


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(StorageError, match=r"There is no file “.*gone”"):
        read(tmp_path / "gone")


def is_refused(path, why):
    """Neither read nor written; the reason is told."""
    for use in (read, lambda place: write(place, b"")):
        with pytest.raises(StorageError, match=why):
            use(path)


def test_a_folder_is_neither_read_nor_written(tmp_path):
    is_refused(tmp_path, "is a folder")


@posix_only
def test_a_pipe_is_refused_without_waiting(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    is_refused(pipe, "is a pipe or a device")


@posix_only
def test_a_loop_of_links_is_refused(tmp_path):
    link = tmp_path / "loop"
    link.symlink_to(link)
    is_refused(link, "is a link to itself")


def test_an_impossible_name_is_refused():
    is_refused("a\0b", "null")


def test_a_message_can_contain_an_unprintable_name(tmp_path):
    with pytest.raises(StorageError) as refusal:
        read(tmp_path / "\udcff")
    str(refusal.value).encode()


@posix_only
def test_a_file_without_permission_is_refused(ordinary_user):
    target = ordinary_user / "a"
    write(target, b"")
    target.chmod(0)
    with pytest.raises(StorageError, match="no permission to read"):
        read(target)


def test_files_beyond_the_limit_are_refused(target, monkeypatch):
    monkeypatch.setattr(files, "MAX_BYTES", 2)
    with pytest.raises(StorageError, match="is larger than"):
        read(target)


def test_a_file_that_lies_about_its_size_is_refused(target, monkeypatch):
    monkeypatch.setattr(files, "MAX_BYTES", 2)
    monkeypatch.setattr(files, "_refuse_irregular", lambda *_: None)
    with pytest.raises(StorageError, match="is larger than"):
        read(target)


def test_an_empty_document_has_a_small_file(tmp_path):
    save(tmp_path / "a", empty_document())
    assert len(read(tmp_path / "a")) < 400
