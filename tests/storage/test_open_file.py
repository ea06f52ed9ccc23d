"""The file behind a document: what was seen of it, what others did to it, and older versions."""

from __future__ import annotations

import os
import time

import pytest

from app.document.model import Document, make_curve
from app.storage import files
from app.storage import format as format_module
from app.storage.files import (
    ChangedOnDiskError,
    NewerVersionError,
    StorageError,
    UnconfirmedError,
    load,
    save,
    write,
)
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from app.storage.lock import lock_path
from app.storage.migration import MIGRATIONS
from app.storage.open_file import FileChange, LockedError, OpenFile


def sketch(x):
    return Document((make_curve([(0.0, 0.0), (x, 1.0)]),))


MINE, THEIRS = sketch(1.0), sketch(2.0)


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "drawing.curve.json"
    save(path, MINE)
    return path


@pytest.fixture
def file(path):
    opened = OpenFile.open(path)
    yield opened.file
    opened.file.close()


# Looking


def test_an_unchanged_file_reports_no_change(file):
    assert file.check() is FileChange.SAME
    assert file.other_document is None


def test_another_document_in_the_file_is_detected(path, file):
    save(path, THEIRS)
    assert file.check() is FileChange.CHANGED
    assert file.other_document == THEIRS


def test_writing_in_place_is_detected(path, file):
    path.write_bytes(encode(THEIRS))
    assert file.check() is FileChange.CHANGED


def test_the_same_content_in_another_file_is_no_change(path, file):
    """As after `git checkout`, or a copy put back."""
    write(path, path.read_bytes())
    os.utime(path, (1, 1))
    assert file.check() is FileChange.SAME
    OpenFile.saved(path, THEIRS, file)
    assert load(path) == THEIRS


@pytest.mark.parametrize("content", [b"", b'{"format": "curvebench", "ver', b"\xff"])
def test_a_truncated_file_is_unreadable(path, file, content):
    path.write_bytes(content)
    assert file.check() is FileChange.UNREADABLE


def test_a_deleted_file_is_reported_as_missing(path, file):
    path.rename(path.with_name("moved"))
    assert file.check() is FileChange.GONE
    OpenFile.saved(path, THEIRS, file)
    assert file.check() is FileChange.SAME


# Saving


def test_an_unnoticed_change_is_not_overwritten(path, file):
    save(path, THEIRS)
    with pytest.raises(
        ChangedOnDiskError, match=r"changed by another program since .* Save under another name"
    ):
        OpenFile.saved(path, sketch(3.0), file)
    assert load(path) == THEIRS
    OpenFile.saved(path, sketch(3.0), file, overwrite=True)
    assert load(path) == sketch(3.0)
    assert file.check() is FileChange.SAME


def test_a_change_of_the_same_size_and_time_is_detected(path, file):
    """Some copying programs keep the time; the digest tells."""
    status = path.stat()
    content = encode(MINE).replace(b"1.0", b"9.0", 1)
    with path.open("r+b") as opened:
        opened.write(content)
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert file.check() is FileChange.SAME  # a quick look does not read
    with pytest.raises(ChangedOnDiskError):
        OpenFile.saved(path, THEIRS, file)
    assert path.read_bytes() == content


def test_an_accepted_change_may_be_replaced(path, file):
    save(path, THEIRS)
    file.accept()
    assert file.check() is FileChange.SAME
    OpenFile.saved(path, sketch(3.0), file)
    assert load(path) == sketch(3.0)


def test_a_change_after_accepting_is_not_replaced(path, file):
    save(path, THEIRS)
    file.accept()
    save(path, sketch(4.0))
    with pytest.raises(ChangedOnDiskError):
        OpenFile.saved(path, sketch(3.0), file)


def test_reading_again_returns_the_present_document(path, file):
    save(path, THEIRS)
    assert file.read_again() == THEIRS
    assert file.check() is FileChange.SAME


def test_an_unconfirmed_save_is_no_foreign_change(path, file, monkeypatch):
    """The next save must not take it for somebody else's change."""
    stamp = file.stamp

    def fail(path, _folder, written):
        raise UnconfirmedError("not confirmed", written)

    with monkeypatch.context() as faulty:
        faulty.setattr(files, "_confirm", fail)
        with pytest.raises(UnconfirmedError):
            OpenFile.saved(path, THEIRS, file)
    assert file.stamp != stamp
    assert file.check() is FileChange.SAME
    OpenFile.saved(path, MINE, file)


# Others


def test_a_second_window_may_read_but_not_save(path, file):
    second = OpenFile.open(path)
    assert second.document == MINE
    assert second.file.owner.is_this_process
    with pytest.raises(LockedError, match="Save under another name") as refusal:
        OpenFile.saved(path, THEIRS, second.file)
    assert refusal.value.owner == second.file.owner
    assert load(path) == MINE


def test_saving_over_a_file_that_is_open_elsewhere_is_refused(path, file, tmp_path):
    with pytest.raises(LockedError):
        OpenFile.saved(path, THEIRS)
    other = OpenFile.saved(tmp_path / "other", THEIRS)
    with pytest.raises(LockedError):
        OpenFile.saved(path, THEIRS, other)
    assert load(path) == MINE
    assert other.check() is FileChange.SAME
    other.close()
    assert not lock_path(tmp_path / "other").exists()


def test_a_link_leads_to_the_same_lock(path, file, tmp_path):
    link = tmp_path / "link"
    link.symlink_to(path)
    assert OpenFile.open(link).file.owner is not None


def test_saving_works_after_the_owner_has_closed(path, file):
    second = OpenFile.open(path).file
    file.close()
    assert second.check_lock() is None
    OpenFile.saved(path, THEIRS, second)
    assert second.owner is None
    second.close()


def test_a_reader_never_overwrites_the_owners_changes(path, file):
    second = OpenFile.open(path).file
    OpenFile.saved(path, THEIRS, file)
    file.close()
    with pytest.raises(ChangedOnDiskError):
        OpenFile.saved(path, sketch(3.0), second)
    second.close()


def test_the_former_owner_cannot_save_after_a_takeover(path, file):
    second = OpenFile.open(path).file
    second.take_over()
    OpenFile.saved(path, THEIRS, second)
    with pytest.raises(LockedError):
        OpenFile.saved(path, sketch(3.0), file)
    assert load(path) == THEIRS
    assert file.owner is not None
    second.close()


def test_reopening_a_file_in_the_same_window_keeps_the_lock(path, file):
    again = OpenFile.open(path, file)
    assert again.file.owner is None
    file.close()
    assert OpenFile.open(path).file.owner is not None
    again.file.close()


def test_a_failed_save_under_another_name_leaves_no_lock(file, tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    with pytest.raises(StorageError):
        OpenFile.saved(folder, MINE, file)
    assert [each.name for each in tmp_path.iterdir() if each.name.startswith(".folder")] == []


def test_a_recovered_document_accepts_the_present_content(path):
    file = OpenFile.adopt(path)
    save(path, THEIRS)
    assert file.check() is FileChange.CHANGED
    file.close()
    missing = OpenFile.adopt(path.with_name("missing"))
    assert missing.check() is FileChange.SAME
    missing.close()


def test_opening_a_document_removes_stale_files(path, tmp_path, monkeypatch):
    from app.storage import files

    left = tmp_path / files.temporary_name()
    left.write_bytes(b"half")
    os.utime(left, (time.time() - 3600, time.time() - 3600))
    monkeypatch.setattr(files, "is_number_alive", lambda _pid: False)
    OpenFile.open(path).file.close()
    assert not left.exists()


# Versions


def old_content(x=1.0, version=0):
    return b'{"format": "curvebench", "version": %d, "polylines": [[[0, 0], [%r, 1]]]}' % (version, x)


def from_draft(values):
    curves = [
        {
            "name": "Curve",
            "family": "lagrange",
            "parametrization": {"kind": "uniform", "alpha": 0.5, "start": 0, "end": 1},
            "points": [{"x": x, "y": y} for x, y in points],
        }
        for points in values["polylines"]
    ]
    return {"format": values["format"], "curves": curves}


@pytest.fixture
def draft(tmp_path, monkeypatch):
    """A file of a version before the first: there is none yet, but the way from it is the same."""
    monkeypatch.setitem(MIGRATIONS, 0, from_draft)
    path = tmp_path / "old.curve.json"
    path.write_bytes(old_content())
    return path


def test_without_a_migration_an_older_version_is_refused(tmp_path):
    with pytest.raises(FormatError, match="version must be 4, not 0"):
        decode(old_content())


def test_an_older_version_is_migrated(draft):
    document = load(draft)
    assert [point.position for point in document.curves[0].points] == [(0, 0), (1, 1)]
    assert draft.read_bytes() == old_content()


def test_migrations_run_version_by_version(monkeypatch):
    monkeypatch.setitem(MIGRATIONS, -1, lambda values: {**values, "polylines": values.pop("lines")})
    monkeypatch.setitem(MIGRATIONS, 0, from_draft)
    data = old_content(version=-1).replace(b"polylines", b"lines")
    assert decode(data) == decode(old_content())


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (old_content().replace(b"[0, 0]", b'["0", 0]'), r"curves\[0\]\.points\[0\]\.x must be a number"),
        (old_content(1e13), r"points\[1\]\.x must lie between"),
        (b'{"format": "curvebench", "version": 0}', "its content is not valid in that version"),
        (old_content().replace(b"[[[0, 0], [1.0, 1]]]", b"7"), "its content is not valid in that version"),
        (b'{"version": 0, ' + old_content()[1:], "version appears twice"),
    ],
)
def test_problems_in_an_old_file_are_reported(draft, data, words):
    with pytest.raises(FormatError, match=words):
        decode(data)


def test_the_first_save_keeps_the_old_file(draft):
    opened = OpenFile.open(draft)
    assert opened.file.is_older
    OpenFile.saved(draft, opened.document, opened.file)
    backup = draft.with_name("old.curve.json.v0.bak")
    assert backup.read_bytes() == old_content()
    assert load(draft) == opened.document
    assert not opened.file.is_older
    OpenFile.saved(draft, THEIRS, opened.file)
    assert backup.read_bytes() == old_content()
    opened.file.close()
    assert len(list(draft.parent.iterdir())) == 2


def test_a_backup_never_replaces_another(draft):
    first = draft.with_name("old.curve.json.v0.bak")
    first.write_bytes(b"of another day")
    save(draft, MINE)
    assert first.read_bytes() == b"of another day"
    assert draft.with_name("old.curve.json.v0.2.bak").read_bytes() == old_content()
    draft.write_bytes(old_content())
    save(draft, MINE)  # the same content again needs no third
    assert len(list(draft.parent.iterdir())) == 3


def test_a_backup_works_without_hard_links(draft, monkeypatch):
    def fail(*_):
        raise PermissionError(1, "no hard links here")

    monkeypatch.setattr(os, "link", fail)
    save(draft, MINE)
    assert draft.with_name("old.curve.json.v0.bak").read_bytes() == old_content()
    assert len(list(draft.parent.iterdir())) == 2


def test_an_old_file_is_not_replaced_without_a_backup(draft, monkeypatch):
    real = files._write_temporary

    def fail_for_the_backup(folder, data, like):
        if data == old_content():
            raise OSError(28, "No space left on device")
        return real(folder, data, like)

    monkeypatch.setattr(files, "_write_temporary", fail_for_the_backup)
    with pytest.raises(StorageError, match="The disk is full"):
        save(draft, MINE)
    assert draft.read_bytes() == old_content()
    assert list(draft.parent.iterdir()) == [draft]


def test_a_newer_version_is_neither_opened_nor_replaced(path, file):
    newer = encode(MINE).replace(b'"version": 4', b'"version": 5')
    path.write_bytes(newer)
    with pytest.raises(FormatError, match="newer version of Curvebench"):
        OpenFile.open(path)
    assert file.check() is FileChange.UNREADABLE
    for overwrite in (False, True):
        with pytest.raises((NewerVersionError, ChangedOnDiskError)):
            OpenFile.saved(path, THEIRS, file, overwrite=overwrite)
    with pytest.raises(NewerVersionError, match=r"was not replaced\. Save under another name"):
        save(path, THEIRS)
    assert path.read_bytes() == newer


def test_the_version_is_read_from_any_bytes():
    assert format_module.version_of(encode(MINE)) == format_module.VERSION
    for data in (b"", b"\xff", b"[" * 10**5, b'{"format": "other", "version": 9}', b"1"):
        assert format_module.version_of(data) is None
