"""Snapshots: whole or not there, nobody's but an ended process's, and never in the way of a start."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from msgspec.structs import replace

from app.document.model import Document, Point, ReferenceImage, make_curve
from app.storage.files import save
from app.storage.format import encode
from app.storage.format_error import FormatError
from app.storage.lock import acquire
from app.storage.recovery import DAMAGED, SUFFIX, SnapshotFile, SnapshotOrigin, list_snapshots
from app.storage.system import machine

ROOT = Path(__file__).resolve().parents[2]
THIRDS = Document((make_curve([(1 / 3, 2 / 3), (1e-300, -0.0), (1e12, 5.0)], name="Ü, “S”"),))
NOWHERE = SnapshotOrigin()
OTHER = Document((make_curve([(0, 0), (1, 1)]),))
BROKEN = Document((make_curve([(0, 0), (float("nan"), 1)]),))


def left_behind(folder, document=THIRDS, origin=NOWHERE):
    """What a process leaves that ends without a word."""
    file = SnapshotFile(folder)
    file.write(document, origin)
    file.leave()
    return next(path for path in folder.iterdir() if path.name.endswith(SUFFIX))


def test_a_snapshot_returns_the_document_bit_for_bit(tmp_path):
    before = time.time()
    left_behind(tmp_path / "new" / "folder")
    (snapshot,) = list_snapshots(tmp_path / "new" / "folder").snapshots
    assert encode(snapshot.document) == encode(THIRDS)
    assert before <= snapshot.written <= time.time()
    assert snapshot.origin == SnapshotOrigin()


def test_titles_are_restored_and_older_snapshots_have_no_title(tmp_path):
    named = SnapshotOrigin(title=os.fsdecode(b"no\xfftext"), file_stem="icon")
    file = left_behind(tmp_path, origin=named)
    (snapshot,) = list_snapshots(tmp_path).snapshots
    assert snapshot.origin == SnapshotOrigin(title="no?text", file_stem="icon")
    snapshot.leave()
    record = json.loads(file.read_bytes())
    del record["title"], record["file_stem"]
    file.write_text(json.dumps(record | {"version": 1}), encoding="utf-8")
    (snapshot,) = list_snapshots(tmp_path).snapshots
    assert (snapshot.document, snapshot.origin) == (THIRDS, SnapshotOrigin())


@pytest.mark.parametrize("name", ["a b, ü.curve.json", os.fsdecode(b"no\xfftext.curve.json")])
def test_a_snapshot_knows_its_file_and_whether_the_file_changed(tmp_path, name):
    path = tmp_path / name
    left_behind(tmp_path / "unsaved", origin=SnapshotOrigin(path, save(path, OTHER)))
    found = list_snapshots(tmp_path / "unsaved")
    assert found.snapshots[0].origin.path == path
    assert found.snapshots[0].origin.is_unchanged
    save(path, OTHER)
    assert found.snapshots[0].origin.is_unchanged
    save(path, THIRDS)
    assert not found.snapshots[0].origin.is_unchanged
    path.unlink()
    assert not found.snapshots[0].origin.is_unchanged


def test_a_saved_document_is_not_offered(tmp_path):
    path = tmp_path / "mine.curve.json"
    origin = SnapshotOrigin(path, save(path, OTHER))
    save(path, THIRDS)
    left_behind(tmp_path / "unsaved", THIRDS, origin)
    assert list_snapshots(tmp_path / "unsaved").snapshots == ()
    assert list((tmp_path / "unsaved").iterdir()) == []
    left_behind(tmp_path / "unsaved", OTHER, origin)
    path.write_text("no document")
    assert len(list_snapshots(tmp_path / "unsaved").snapshots) == 1


def test_the_latest_snapshot_comes_first(tmp_path, monkeypatch):
    began = time.time()
    for second, name in enumerate(("one", "two", "three")):
        with monkeypatch.context() as patch:
            patch.setattr("app.storage.recovery.time.time", lambda now=began + second: now)
            left_behind(tmp_path, Document((make_curve([(0, 0)], name=name),)))
    names = [each.document.curves[0].name for each in list_snapshots(tmp_path).snapshots]
    assert names == ["three", "two", "one"]


def test_a_snapshot_keeps_the_absolute_path_of_the_image(tmp_path):
    image = ReferenceImage(str(tmp_path / "photo.png"), 0, 0, 4, 3)
    left_behind(tmp_path / "unsaved", replace(OTHER, image=image))
    assert list_snapshots(tmp_path / "unsaved").snapshots[0].document.image == image


def test_a_missing_folder_has_no_snapshots(tmp_path):
    found = list_snapshots(tmp_path / "missing")
    assert found.snapshots == found.damaged == ()


def test_discarded_snapshots_are_deleted_and_left_ones_are_offered_again(tmp_path):
    left_behind(tmp_path)
    list_snapshots(tmp_path).snapshots[0].leave()
    list_snapshots(tmp_path).snapshots[0].discard()
    assert list(tmp_path.iterdir()) == []


def test_discarding_a_snapshot_file_leaves_nothing(tmp_path):
    file = SnapshotFile(tmp_path)
    file.discard()
    file.write(THIRDS, SnapshotOrigin())
    file.write(OTHER, SnapshotOrigin())
    file.discard()
    assert list(tmp_path.iterdir()) == []
    file.write(OTHER, SnapshotOrigin())
    file.leave()
    assert len(list_snapshots(tmp_path).snapshots) == 1


def test_the_snapshot_of_a_running_writer_is_not_offered(tmp_path):
    file = SnapshotFile(tmp_path)
    file.write(THIRDS, SnapshotOrigin())
    assert list_snapshots(tmp_path).snapshots == ()
    file.leave()
    assert len(list_snapshots(tmp_path).snapshots) == 1


def test_a_snapshot_is_offered_by_one_start_only(tmp_path):
    left_behind(tmp_path)
    first = list_snapshots(tmp_path)
    assert list_snapshots(tmp_path).snapshots == ()
    first.snapshots[0].leave()
    assert len(list_snapshots(tmp_path).snapshots) == 1


def test_an_invalid_preview_is_replaced_by_the_committed_document(tmp_path):
    file = SnapshotFile(tmp_path)
    file.write(BROKEN, SnapshotOrigin(), THIRDS)
    file.leave()
    assert list_snapshots(tmp_path).snapshots[0].document == THIRDS
    with pytest.raises(FormatError):
        file.write(BROKEN, SnapshotOrigin())


def damage(content, kind):
    record = json.loads(content)
    if kind == "digit":
        record["document"] = record["document"].replace("0.3333", "0.3334")
    elif kind == "document":
        record["document"] = "{}"
    elif kind == "checksum":
        record["checksum"] = "0" * 64
    elif kind == "newer":
        record["version"] = 3
    elif kind == "surrogate":
        return json.dumps(record | {"document": "\ud800"}).encode()
    elif kind == "path":
        record["path"] = "§"
    elif kind == "time":
        return content.replace(b'"written":', b'"written":1e999,"was":', 1)
    else:
        return {
            "empty": b"",
            "half": content[: len(content) // 2],
            "zeros": bytes(len(content)),
            "deep": b"[" * 100_000,
            "list": b"[]",
            "noise": bytes(range(256)) * 20,
        }[kind]
    return json.dumps(record).encode()


@pytest.mark.parametrize(
    "kind",
    [
        "digit",
        "document",
        "checksum",
        "newer",
        "surrogate",
        "path",
        "time",
        "empty",
        "half",
        "zeros",
        "deep",
        "list",
        "noise",
    ],
)
def test_a_damaged_snapshot_is_renamed_and_others_are_offered(tmp_path, kind):
    left_behind(tmp_path, OTHER)
    bad = tmp_path / f"0bad{SUFFIX}"
    bad.write_bytes(damage(left_behind(tmp_path / "source").read_bytes(), kind))
    content = bad.read_bytes()
    found = list_snapshots(tmp_path)
    assert [each.document for each in found.snapshots] == [OTHER]
    assert found.damaged == (tmp_path / f"0bad{SUFFIX}{DAMAGED}",)
    assert found.damaged[0].read_bytes() == content
    found.snapshots[0].leave()
    assert list_snapshots(tmp_path).damaged == ()


def test_a_folder_named_like_a_snapshot_is_ignored(tmp_path):
    (tmp_path / f"a{SUFFIX}").mkdir()
    found = list_snapshots(tmp_path)
    assert found.snapshots == ()
    assert len(found.damaged) == 1


def test_locks_and_temporary_files_of_ended_processes_are_removed(tmp_path):
    left_behind(tmp_path)
    (tmp_path / f"gone{SUFFIX}.claim").touch()
    child = subprocess.Popen([sys.executable, "-c", ""])
    child.wait()
    old, new = (tmp_path / f".curvebench-{machine()[:8]}-{child.pid}-{k * 16}.tmp" for k in "12")
    for path in (old, new):
        path.touch()
    os.utime(old, (0, 0))
    list_snapshots(tmp_path).snapshots[0].discard()
    assert list(tmp_path.iterdir()) == [new]


def test_a_lock_has_one_owner_until_release(tmp_path):
    path = tmp_path / "lock"
    first = acquire(path, is_private=True).lock
    assert first is not None
    assert acquire(path, is_private=True).lock is None
    first.release()
    assert not path.exists()
    second = acquire(path, is_private=True).lock
    assert second is not None
    second.release()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_lock_ends_with_its_process(tmp_path):
    path = tmp_path / "lock"
    code = "from app.storage.lock import acquire; from pathlib import Path; import os\n"
    code += f"kept = acquire(Path({str(path)!r})); assert kept.lock; os.kill(os.getpid(), 9)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False)
    assert done.returncode == -9
    assert path.exists()
    lock = acquire(path).lock
    assert lock is not None
    lock.release()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_only_snapshots_of_ended_processes_are_offered(tmp_path):
    code = """
import sys
from pathlib import Path
from app.document.model import Document, make_curve
from app.storage.recovery import SnapshotOrigin, SnapshotFile
file = SnapshotFile(Path(sys.argv[1]))
file.write(Document((make_curve([(0, 0)]),)), SnapshotOrigin())
print(flush=True)
sys.stdin.read()
"""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, "-c", code, str(tmp_path)], cwd=ROOT, **pipes) as process:
        process.stdout.readline()
        assert list_snapshots(tmp_path).snapshots == ()
        process.kill()
    assert len(list_snapshots(tmp_path).snapshots) == 1


# A child of its own for every step of writing, killed before it.
KILLED_AT_EVERY_STEP = """
import gc, os, sys
from pathlib import Path
from app.document.model import Document, make_curve
from app.storage.recovery import SnapshotOrigin, SnapshotFile, list_snapshots
from tests.storage.kill_at_every_step import be_killed_before

old, new = (Document((make_curve([(i, k / 3) for i in range(3)]),)) for k in (1, 2))

def run(folder, step, begin):
    file = SnapshotFile(folder)
    if begin == "again":
        file.write(old, SnapshotOrigin())
    sys.setprofile(be_killed_before(step))
    file.write(new, SnapshotOrigin())
    os._exit(0)

# What is imported when it is first wanted, each child would import again, or look through it for garbage.
warm = SnapshotFile(Path(sys.argv[1]) / "warm")
warm.write(old, SnapshotOrigin())
warm.leave()
gc.disable()
gc.freeze()
# What a killed process has written is there whether or not it is on the disk.
os.fsync = os.fstat

for begin in ("first", "again"):
    outcomes, step, ended = set(), -1, False
    while not ended:
        step += 1
        folder = Path(sys.argv[1]) / begin / str(step)
        child = os.fork()
        if child == 0:
            run(folder, step, begin)
        _, status = os.waitpid(child, 0)
        ended = not os.WIFSIGNALED(status)
        found = list_snapshots(folder)
        assert not found.damaged, (begin, step)
        documents = [each.document for each in found.snapshots]
        assert documents in ([], [old], [new]), (begin, step)
        outcomes.add({(): "none", (old,): "old", (new,): "new"}[tuple(documents)])
    print(begin, step > 10, *sorted(outcomes))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_kill_while_writing_leaves_the_old_or_the_new_snapshot(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", KILLED_AT_EVERY_STEP, str(tmp_path)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout.splitlines() == ["first True new none", "again True new old"]


def test_a_snapshot_of_ten_thousand_points_is_restored(tmp_path):
    points = tuple(Point(i / 3, -i / 7, velocity=(1 / 3, i / 11)) for i in range(10_000))
    document = Document((replace(make_curve([]), points=points),))
    left_behind(tmp_path, document)
    assert list_snapshots(tmp_path).snapshots[0].document == document
