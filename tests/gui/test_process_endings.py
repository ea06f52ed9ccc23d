"""The real program in a separate process, ended in every possible way."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from app.document.model import Document, make_curve
from app.features.recovery.autosave import snapshot_folder
from app.storage import files
from app.storage.format import decode, encode
from app.storage.recovery import SnapshotFile, SnapshotOrigin, list_snapshots

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs signals")

PROGRAM = """
import sys
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from app.cli import main
from app.cli.windows import Lifecycle
from app.storage.format import encode
from app.window import MainWindow
from app.features.recovery.bar import RecoveryBar
from app.testing import Editor

application = QApplication([])

def tell(*words):
    print(*words, flush=True)

def tell_document(word):
    text = encode(editor.session.document).decode().replace("\\n", " ")
    tell(word, 0, text)

def begin():
    global editor
    (window,) = [each for each in QApplication.topLevelWidgets() if isinstance(each, MainWindow)]
    editor = Editor.on(window)
    drive()

%s

# Begin when what was left over is offered: then the start is over.
offer = Lifecycle._offer

def offer_and_begin(lifecycle):
    offer(lifecycle)
    QTimer.singleShot(0, begin)

Lifecycle._offer = offer_and_begin
sys.exit(main(sys.argv[1:]))
"""

# Drags for as long as it lives, and tells every document before it is shown. It is kept a moment after a
# change: that this is a second, test_autosave asks.
DRAG = """
from itertools import count
from app.features.recovery.autosave import Autosave

Autosave.__init__.__kwdefaults__["delay"] = 50
numbers = count(1)

def drive():
    editor.drag_point(1, to=(2, 3))
    editor.press(editor.point(2))
    step()

def step():
    n = next(numbers)
    tell_document("shown")
    editor.move((1 + n % 7 / 10 + n / 1e5, 2 + n % 11 / 20))
    tell_document("shown")
    QTimer.singleShot(10, step)
"""

EDIT_AND_WAIT = """
def drive():
    editor.drag_point(1, to=(2, 3))
    tell_document("shown")
"""

# Tells when the question about the changes is on the screen.
EDIT_AND_CLOSE = (
    EDIT_AND_WAIT
    + """
    QTimer.singleShot(0, tell_of_question)
    QTimer.singleShot(0, editor.window.close)

def tell_of_question():
    if QApplication.activeModalWidget() is not None:
        tell("told", 0, "asks")
    else:
        QTimer.singleShot(1, tell_of_question)
"""
)

LOOK = """
def drive():
    bar = editor.window.findChild(RecoveryBar)
    tell("offered", bar.isVisible(), bar.text)
    bar.restore_asked.emit(0)
    tell_document("restored")
    tell("path", editor.session.files.path, editor.session.files.is_modified)
    bar.restore_asked.emit(0)
    windows = [each for each in QApplication.topLevelWidgets() if isinstance(each, MainWindow)]
    tell("windows", *(len(each.session.document.curves[0].points) for each in windows))
    for window in windows:
        window.session.files.give_up_changes()
        window.close()
"""


# What the offscreen platform says of every window.
CHATTER = "This plugin does not support propagateSizeHints()\n"


def start(drive, *arguments):
    # The environment holds the home of the test.
    return subprocess.Popen(
        [sys.executable, "-W", "error", "-c", PROGRAM % drive, *map(str, arguments)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
    )


def read_until(process, ready):
    """Read what the process tells until `ready`; return the documents that were shown."""
    shown = []
    for line in process.stdout:
        shown.append(line.split(" ", 2)[2])
        if ready():
            break
    return shown


def rest(process):
    """What it told before it died; the last line may be a torn one."""
    told, errors = process.communicate()
    lines = [line for line in told.splitlines(keepends=True) if line.endswith("\n")]
    return [line.split(" ", 2)[2] for line in lines], errors.replace(CHATTER, "")


def snapshots():
    """The files, each with the time of its writing."""
    return {(path, path.stat().st_mtime_ns) for path in snapshot_folder().glob("*.snapshot.json")}


def test_a_kill_while_dragging_loses_only_work_since_the_last_snapshot(tmp_path):
    path = tmp_path / "mine.curve.json"
    files.save(path, Document((make_curve([(0, 0), (1, 2), (3, 1 / 3), (4, 4)]),)))
    on_disk = path.read_bytes()
    older = SnapshotFile(snapshot_folder())
    older.write(Document((make_curve([(0, 0), (1, 2)]),)), SnapshotOrigin())
    older.leave()
    process = start(DRAG, path)
    shown = read_until(process, lambda: len(snapshots()) == 2)
    begun = len(shown)
    for _ in range(2):  # The first of these may be of a document before that.
        before = snapshots()
        shown += read_until(process, lambda before=before: snapshots() != before)
    assert list_snapshots(snapshot_folder()).snapshots == (), "the work of a running program is its own"
    process.kill()
    more, _errors = rest(process)
    assert process.returncode == -signal.SIGKILL
    snapshot, old = list_snapshots(snapshot_folder()).snapshots
    snapshot.leave()
    old.leave()
    since = (shown + more)[begun - 1 :]
    assert snapshot.document in [decode(text.encode()) for text in since], "what was on the screen since then"
    assert path.read_bytes() == on_disk
    told, errors = start(LOOK).communicate()
    assert errors.replace(CHATTER, "") == ""
    offered, restored, place, windows = told.splitlines()
    assert offered == "offered True 2 documents with unsaved work from the last session:"
    assert encode(decode(restored.split(" ", 2)[2].encode())) == encode(snapshot.document)
    assert place == f"path {path} True"
    assert sorted(windows.split()[1:]) == ["2", "4"], "the second one in a window of its own"
    assert snapshots() == set()


def test_a_signal_ends_the_program_without_a_question_and_without_loss():
    process = start(EDIT_AND_WAIT)
    (text,) = read_until(process, lambda: True)
    process.send_signal(signal.SIGINT)
    _, errors = rest(process)
    assert (process.returncode, errors) == (128 + signal.SIGINT, "")
    (snapshot,) = list_snapshots(snapshot_folder()).snapshots
    assert snapshot.document == decode(text.encode())
    snapshot.discard()


def test_a_signal_ends_the_program_while_a_dialog_is_open():
    process = start(EDIT_AND_CLOSE)
    read_until(process, lambda: True)
    assert read_until(process, lambda: True) == ["asks\n"]
    process.terminate()
    _, errors = rest(process)
    assert (process.returncode, errors) == (128 + signal.SIGTERM, "")
    assert len(snapshots()) == 1


def test_damaged_snapshots_do_not_stop_a_start_and_an_unchanged_document_leaves_no_snapshot():
    snapshot_folder().mkdir(parents=True)
    (snapshot_folder() / "x.snapshot.json").write_bytes(b"\xff\x00{")
    process = start('def drive():\n    tell("told", 0, editor.window.findChild(RecoveryBar).text)\n')
    (text,) = read_until(process, lambda: True)
    assert "renamed to" in text
    process.send_signal(signal.SIGHUP)
    _, errors = rest(process)
    assert (process.returncode, errors) == (128 + signal.SIGHUP, "")
    assert [path.name for path in snapshot_folder().iterdir()] == ["x.snapshot.json.damaged"]
