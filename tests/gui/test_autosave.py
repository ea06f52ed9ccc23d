"""Unsaved work is on the disk a second later, and the next start offers it."""

from __future__ import annotations

import os
import re
import sys
import threading
from pathlib import Path

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QLabel, QMessageBox, QPushButton, QScrollArea, QToolButton

from app.appearance.theme import ThemeMode
from app.document.model import Document, make_curve
from app.document.point_edits import move_points, set_position
from app.families import HERMITE
from app.features.recovery.autosave import DELAY_MS, Autosave, origin_of, snapshot_folder, state_folder
from app.features.recovery.bar import RecoveryBar, age_in_words
from app.features.recovery.commands import RecoveryCommands
from app.session import MessageKind, Session
from app.settings.preferences import Preferences
from app.storage.files import load, save
from app.storage.format import encode
from app.storage.recovery import SUFFIX, SnapshotFile, SnapshotOrigin, list_snapshots
from app.testing import Editor
from app.widgets.elided_label import ElidedLabel
from app.workbench.document_files import file_stem, title_of
from tests.waiting import LIMIT, until

SKETCH = Document((make_curve([(0, 0), (1, 2), (3, 1 / 3)], name="Left over"),))
SOON_MS = 20
NEVER_MS = 600_000


@pytest.fixture
def autosaved(editor, qtbot):
    """Editor with an autosave."""
    autosave = Autosave(editor.session, snapshot_folder(), delay=SOON_MS)
    opened = []

    def open_beside(document, path, beginning):
        session = Session()
        session.files.restore(document, path, beginning)
        other = Editor(qtbot, session, size=(800, 600))
        opened.append(other)
        other.autosave = Autosave(session, snapshot_folder(), delay=SOON_MS)
        return other.autosave

    editor.window.commands[RecoveryCommands].keep_with(autosave, open_beside)
    editor.opened, editor.autosave = opened, autosave
    yield editor
    for each in (autosave, *(other.autosave for other in opened)):
        each.finish()


def files():
    return sorted(snapshot_folder().glob(f"*{SUFFIX}")) if snapshot_folder().exists() else []


def is_backed_up():
    return bool(files())


def until_backed_up(document):
    """Wait until the next start would find this document: one of a step to it may come first."""
    until(lambda: is_backed_up() and document_kept() == document)


def wait_until_idle(autosaved):
    """Wait until nothing is to be written or deleted, and what was written is reported."""
    autosave = autosaved.autosave

    def is_idle():
        last = autosave._last
        return not autosave._soon.isActive() and (last is None or last not in last._keeper.running)

    until(is_idle)


def document_kept():
    """What the next start would find, read behind the back of the claim."""
    storage_of = snapshot_folder() / "look"
    storage_of.mkdir(exist_ok=True)
    (file,) = files()
    (storage_of / file.name).write_bytes(file.read_bytes())
    (snapshot,) = list_snapshots(storage_of).snapshots
    snapshot.discard()
    return snapshot.document


def move_point(editor, place):
    """Make a step."""
    editor.session.commit(set_position(editor.session.document, 0, 1, place), "Move point 1")


def leave_behind(document=SKETCH, origin=None):
    file = SnapshotFile(snapshot_folder())
    file.write(document, origin or SnapshotOrigin())
    file.leave()


def bar(editor):
    return editor.window.findChild(RecoveryBar)


def press(editor, name):
    button = editor.window.findChild(QPushButton, name) or editor.window.findChild(QToolButton, name)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor.settle()


def answer(monkeypatch, choice):
    monkeypatch.setattr(QMessageBox, "exec", lambda _box: choice)


# Keeping


def test_tests_write_into_a_separate_home(own_home):
    assert state_folder().is_relative_to(own_home)


def test_steps_without_a_pause_are_backed_up(editor):
    """A second after the first of them: a further step puts nothing off."""
    autosave = Autosave(editor.session, snapshot_folder())
    soon = autosave._soon

    def step():
        editor.session.commit(move_points(editor.session.document, 0, [0], (0.01, 0.01)), "Move")

    assert soon.interval() == DELAY_MS == 1000
    soon.setInterval(NEVER_MS)
    step()
    assert soon.isActive()
    until(lambda: soon.remainingTime() < NEVER_MS)
    left = soon.remainingTime()
    step()
    assert soon.remainingTime() <= left
    soon.start(1)  # it is due
    until(lambda: step() or is_backed_up())
    autosave.finish()


def test_a_step_is_backed_up(autosaved):
    autosaved.drag_point(1, to=(2, 3))
    until_backed_up(autosaved.session.document)


def test_a_running_drag_is_backed_up(autosaved):
    committed = autosaved.session.committed
    autosaved.press(autosaved.point(2))
    autosaved.move((1.0, 1.0))
    autosaved.move((0.7, 0.6))
    assert autosaved.session.document != committed
    until_backed_up(autosaved.session.document)
    autosaved.escape()
    autosaved.release((0.7, 0.6))
    until(lambda: not files())
    assert autosaved.session.document == committed


def test_without_a_change_nothing_is_written(autosaved):
    autosaved.settle()
    assert not autosaved.autosave._soon.isActive()
    assert autosaved.autosave._last is None
    assert not snapshot_folder().exists()


@pytest.mark.parametrize("how", ["save", "new", "open", "undo"])
def test_a_saved_discarded_or_undone_document_has_no_snapshot(autosaved, tmp_path, monkeypatch, how):
    answer(monkeypatch, QMessageBox.StandardButton.Discard)
    other = tmp_path / "other.curve.json"
    save(other, SKETCH)
    move_point(autosaved, (2.0, 3.0))
    until(is_backed_up)
    if how == "save":
        autosaved.session.save(tmp_path / "mine.curve.json")
    elif how == "open":
        autosaved.window.open_file(other)
    else:
        autosaved.trigger({"new": "newDocument", "undo": "undo"}[how])
    until(lambda: not files())
    wait_until_idle(autosaved)
    assert files() == []


def test_a_document_whose_file_was_emptied_is_backed_up(autosaved, tmp_path, monkeypatch):
    """There was no snapshot: to the program nothing was unsaved."""
    monkeypatch.setattr("app.features.files.disk._MOST_CHECKS", 1)
    path = tmp_path / "mine.curve.json"
    autosaved.session.save(path)
    path.write_bytes(b"")
    until(is_backed_up)
    assert document_kept() == autosaved.session.document
    save(path, autosaved.session.document)  # as good as before
    until(lambda: not files())


def test_a_snapshot_names_its_file_and_whether_the_file_changed(autosaved, tmp_path):
    path = tmp_path / "mine.curve.json"
    autosaved.session.save(path)
    move_point(autosaved, (2.0, 3.0))
    until(is_backed_up)
    record = files()[0].read_bytes()
    (snapshot_folder() / "copy").mkdir()
    (snapshot_folder() / "copy" / files()[0].name).write_bytes(record)
    (snapshot,) = list_snapshots(snapshot_folder() / "copy").snapshots
    assert snapshot.origin == SnapshotOrigin(path, autosaved.session.files.file.stamp)
    assert snapshot.origin.is_unchanged


def test_neither_a_large_document_nor_a_slow_disk_holds_up_the_window(autosaved, monkeypatch):
    threads, reached, answers = set(), threading.Event(), threading.Event()

    def fsync(_descriptor):
        threads.add(threading.current_thread())
        reached.set()
        answers.wait(LIMIT)

    def encode_aside(document):
        threads.add(threading.current_thread())
        return encode(document)

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr("app.storage.recovery.encode", encode_aside)
    points = [(i / 3, (i % 17) / 7) for i in range(500)]
    large = Document((make_curve(points, family=HERMITE),))
    autosaved.session.commit(large, "Many points")
    until(reached.is_set)
    # The disk does not answer; the window does.
    assert not files()
    autosaved.trigger("undo")
    autosaved.trigger("redo")
    assert autosaved.session.document == large
    answers.set()
    until(is_backed_up)
    wait_until_idle(autosaved)
    assert document_kept() == large
    assert threads
    assert threading.main_thread() not in threads


def test_an_impossible_folder_is_reported_once_and_editing_continues(autosaved):
    state_folder().parent.mkdir(parents=True, exist_ok=True)
    state_folder().write_text("in the way")
    sentences = []
    autosaved.session.message.connect(
        lambda message: sentences.append(message.text) if message.kind is MessageKind.REFUSAL else None
    )
    for place in ((2.0, 3.0), (1.0, 3.0)):
        move_point(autosaved, place)
        wait_until_idle(autosaved)
    backups = [each for each in sentences if "backed up" in each]
    assert len(backups) == 1
    assert "Save often" in backups[0]
    assert autosaved.point(1) == pytest.approx((1, 3), abs=autosaved.pixel)
    state_folder().unlink()
    move_point(autosaved, (2.0, 2.0))
    until(is_backed_up)


def test_a_failed_snapshot_is_tried_again_without_a_change(editor):
    state_folder().parent.mkdir(parents=True, exist_ok=True)
    state_folder().write_text("in the way")
    autosave = Autosave(editor.session, snapshot_folder(), delay=10, retry=50)
    move_point(editor, (2.0, 3.0))
    until(lambda: "backed up" in editor.status)
    state_folder().unlink()
    until(is_backed_up)
    autosave.finish()


@pytest.mark.skipif(sys.platform == "win32", reason="needs limits of POSIX")
def test_a_full_disk_keeps_the_old_snapshot_and_is_reported(autosaved):
    import resource

    move_point(autosaved, (2.0, 3.0))
    until(is_backed_up)
    before = document_kept()
    sentences = []
    autosaved.session.message.connect(
        lambda message: sentences.append(message.text) if message.kind is MessageKind.REFUSAL else None
    )
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, limits[1]))
    try:
        points = [(i / 3, (i % 17) / 7) for i in range(500)]
        autosaved.session.commit(Document((make_curve(points, family=HERMITE),)), "Large")
        until(lambda: any("backed up" in each for each in sentences))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert document_kept() == before
    assert [each.name for each in snapshot_folder().glob("*.tmp")] == []


def test_closing_after_a_question_leaves_nothing(editor, monkeypatch):
    answer(monkeypatch, QMessageBox.StandardButton.Discard)
    autosave = Autosave(editor.session, snapshot_folder(), delay=SOON_MS)
    editor.window.closed.connect(autosave.finish)
    move_point(editor, (2.0, 3.0))
    until(is_backed_up)
    editor.window.close()
    assert list(snapshot_folder().iterdir()) == []


def test_two_editors_do_not_offer_each_other_s_work(autosaved, qtbot, tmp_path):
    move_point(autosaved, (2.0, 3.0))
    until(is_backed_up)
    second = Editor(qtbot, Session(), Preferences(tmp_path / "settings.ini"))
    second.window.commands[RecoveryCommands].offer_unsaved_work()
    assert bar(second) is None
    second.trigger("recoverWork")
    assert second.status == "There is no unsaved work."


# Offering


def test_a_left_snapshot_is_offered_and_restored(autosaved, tmp_path):
    path = tmp_path / "mine.curve.json"
    stamp = save(path, Document((make_curve([(0, 0), (1, 1)]),)))
    leave_behind(origin=SnapshotOrigin(path, stamp))
    autosaved.window.commands[RecoveryCommands].offer_unsaved_work()
    assert bar(autosaved).isVisible()
    labels = [each.text() for each in bar(autosaved).findChildren(QLabel)]
    assert "mine.curve.json" in labels
    assert "a moment ago" in labels
    press(autosaved, "restoreWork0")
    assert autosaved.session.document == SKETCH
    assert autosaved.session.files.path == path
    assert autosaved.session.files.is_modified
    assert not bar(autosaved).isVisible()
    # The new snapshot is there before the old one goes.
    assert document_kept() == SKETCH
    autosaved.session.save()
    assert load(path) == SKETCH


def test_work_restored_into_the_window_of_its_file_can_be_saved(autosaved, tmp_path):
    """Killed, started with the same file, then Restore: it was read-only, owned by this very window."""
    path = tmp_path / "mine.curve.json"
    stamp = save(path, Document((make_curve([(0, 0), (1, 1)]),)))
    leave_behind(origin=SnapshotOrigin(path, stamp))
    autosaved.window.open_file(path)
    autosaved.window.commands[RecoveryCommands].offer_unsaved_work()
    press(autosaved, "restoreWork0")
    assert autosaved.session.document == SKETCH
    assert not autosaved.session.files.is_read_only
    assert autosaved.file_bar.text == ""
    autosaved.trigger("saveDocument")
    assert load(path) == SKETCH


@pytest.mark.parametrize(
    ("label", "message"),
    [("file changed since", "has changed since then."), ("file missing", "no longer exists.")],
)
def test_work_on_a_changed_or_missing_file_becomes_a_new_document(autosaved, tmp_path, label, message):
    path = tmp_path / "mine.curve.json"
    origin = SnapshotOrigin(path, save(path, Document((make_curve([(0, 0), (1, 1)]),))))
    if label == "file changed since":
        save(path, Document((make_curve([(5, 5), (6, 6), (7, 7)]),)))
    else:
        path.unlink()
    leave_behind(origin=origin)
    autosaved.window.commands[RecoveryCommands].offer_unsaved_work()
    assert any(label in each.text() for each in bar(autosaved).findChildren(QLabel))
    press(autosaved, "restoreWork0")
    assert autosaved.session.document == SKETCH
    assert autosaved.session.files.path is None
    assert message in autosaved.status
    assert (title_of(autosaved.session), file_stem(autosaved.session)) == ("mine", "mine")


def test_a_restored_document_without_a_file_keeps_its_name(autosaved):
    """A drawing that had been imported was called “Untitled” after a crash."""
    autosaved.session.files.begin_imported(SKETCH, "icon")
    move_point(autosaved, (2.0, 3.0))
    assert autosaved.autosave.write_now()
    leave_behind(origin=origin_of(autosaved.session))
    autosaved.session.files.begin(SKETCH)
    autosaved.window.commands[RecoveryCommands].offer_unsaved_work()
    assert "icon" in [each.text() for each in bar(autosaved).findChildren(QLabel)]
    press(autosaved, "restoreWork0")
    assert autosaved.window.windowTitle() == "icon[*] – Curvebench"
    assert (autosaved.session.files.path, file_stem(autosaved.session)) == (None, "icon")


@pytest.mark.parametrize("looks", [{"locked": True}, {"visible": False}])
def test_a_locked_or_hidden_curve_is_not_edited_after_restoring(editor, looks):
    leave_behind(replace(SKETCH, curves=tuple(replace(curve, **looks) for curve in SKETCH.curves)))
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    press(editor, "restoreWork0")
    selected = editor.session.selected
    assert (selected.is_editing, selected.whole_curves) == (False, frozenset())


def test_two_snapshots_of_one_file_are_distinguished(editor, tmp_path):
    """Both were called “mine.curve.json, a moment ago”."""
    path = tmp_path / "mine.curve.json"
    origin = SnapshotOrigin(path, save(path, Document((make_curve([(0, 0), (1, 1)]),))))
    line, arch = make_curve([(0, 0), (1, 1), (2, 2)]), make_curve([(0, 0), (1, 2), (2, 0), (3, 1)])
    for document in (Document((line,)), Document((line, arch))):
        leave_behind(document, origin)
    leave_behind()
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        other = tmp_path / folder / "other.curve.json"
        leave_behind(SKETCH, SnapshotOrigin(other, save(other, document)))
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    labels = [each.text() for each in bar(editor).findChildren(QLabel) if each.text()]
    assert [each for each in labels if "curve.json" in each] == [
        str(Path("two", "other.curve.json")),
        str(Path("one", "other.curve.json")),
        "mine.curve.json (1 of 2)",
        "mine.curve.json (2 of 2)",
    ]
    told = [re.sub("^[0-9:]{8} ", "hh:mm:ss ", each) for each in labels if "moment" in each]
    assert told[2:] == [
        "a moment ago · never saved",
        "hh:mm:ss · 2 curves, 7 points · a moment ago",
        "hh:mm:ss · 1 curve, 3 points · a moment ago",
    ]
    names = [each.accessibleName() for each in bar(editor).findChildren(QPushButton)]
    assert len(set(names)) == len(names) == 15


def test_discard_deletes_when_the_window_is_closed_and_later_keeps(editor):
    leave_behind()
    leave_behind()
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    assert bar(editor).text == "2 documents with unsaved work from the last session:"
    press(editor, "discardWork0")
    assert bar(editor).text == "A document with unsaved work from the last session:"
    press(editor, "laterWork0")
    assert not bar(editor).isVisible()
    editor.window.close()
    assert len(files()) == 1


@pytest.mark.parametrize("is_empty", [False, True])
def test_discard_can_be_undone(editor, is_empty):
    """The only copy of an hour of work was deleted by one click."""
    if is_empty:
        editor.new()
        editor.settle()
    leave_behind()
    leave_behind(Document((make_curve([(5, 5), (6, 6)]),)))
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    press(editor, "discardWork1")
    press(editor, "discardWork0")
    assert not bar(editor).isVisible()
    assert editor.message == "“Left over” and “Untitled sketch” were discarded."
    press(editor, "offeredAction")
    assert "discarded" not in editor.message
    assert bar(editor).text == "2 documents with unsaved work from the last session:"
    # So does Ctrl+Z, which said "Nothing to undo".
    press(editor, "discardWork0")
    editor.key(Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert bar(editor).text == "2 documents with unsaved work from the last session:"
    # Without the message the menu does it as well.
    press(editor, "discardWork0")
    editor.session.offer("")
    editor.trigger("recoverWork")
    assert bar(editor).text == "2 documents with unsaved work from the last session:"
    press(editor, "restoreWork1")
    assert editor.session.document == SKETCH
    assert bar(editor).text == "A document with unsaved work from the last session:"
    press(editor, "discardWork0")
    # Nobody else is offered what is discarded here; the snapshot of what is open now is of no use to it.
    (other,) = list_snapshots(snapshot_folder()).snapshots
    assert other.document == SKETCH
    other.leave()


@pytest.mark.parametrize("size", [(1440, 900), (960, 540)])
@pytest.mark.parametrize("number", [1, 2, 5])
def test_the_recovery_bar_covers_at_most_a_quarter_of_the_canvas(qtbot, tmp_path, size, number):
    editor = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"), size=size)
    for _ in range(number):
        leave_behind()
    (snapshot_folder() / f"x{SUFFIX}").write_bytes(b"damaged")
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    editor.settle()
    shown, canvas = bar(editor), editor.window.canvas
    assert 4 * shown.width() * shown.height() <= canvas.width() * canvas.height()
    assert canvas.rect().contains(shown.geometry())
    # What does not fit scrolls; one row is always seen.
    area = shown.findChild(QScrollArea, "recoveryRows")
    assert area.height() >= 36
    button = shown.findChild(QPushButton, f"discardWork{number - 1}")
    area.ensureWidgetVisible(button)
    editor.settle()
    assert area.viewport().rect().contains(button.mapTo(area.viewport(), button.rect().center()))


def test_a_discarded_row_leaves_scroll_focus_and_message(qtbot, tmp_path):
    """The list went to its top: the same place was then Discard of the first document."""
    editor = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"), size=(960, 540))
    for number in range(5):
        leave_behind(Document((make_curve([(0, 0), (1, number)], name=f"Sketch {number}"),)))
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    editor.settle()
    area = bar(editor).findChild(QScrollArea, "recoveryRows")
    area.verticalScrollBar().setValue(area.verticalScrollBar().maximum() // 2)
    before = area.verticalScrollBar().value()
    assert before > 0
    button = editor.window.findChild(QPushButton, "discardWork2")
    button.setFocus()
    name = button.accessibleName().rpartition(" on ")[2]
    before = area.verticalScrollBar().value()
    QTest.keyClick(button, Qt.Key.Key_Space)
    editor.settle()
    assert area.verticalScrollBar().value() == before
    assert editor.window.focusWidget() is editor.window.findChild(QPushButton, "discardWork2")
    assert editor.message == f"“{name}” was discarded."
    # At the end the last row takes the place.
    area.verticalScrollBar().setValue(area.verticalScrollBar().maximum())
    editor.window.findChild(QPushButton, "discardWork3").setFocus()
    QTest.keyClick(editor.window.focusWidget(), Qt.Key.Key_Space)
    editor.settle()
    assert area.verticalScrollBar().value() == area.verticalScrollBar().maximum() > 0
    assert editor.window.focusWidget() is editor.window.findChild(QPushButton, "discardWork2")
    # Another one is restored: what was discarded can still be recovered from the canvas.
    message = editor.message
    press(editor, "restoreWork0")
    assert editor.message == message
    press(editor, "offeredAction")
    labels = [each.text() for each in bar(editor).findChildren(QLabel)]
    assert set(re.findall("“(.*?)”", message)) <= set(labels)


@pytest.mark.parametrize("factor", [1, 2])
def test_recovered_documents_are_told_apart_in_any_size_of_type(qtbot, qapp, tmp_path, factor):
    """At twice the size both read "Untitled ske…", and 440 px of the canvas were free."""
    usual = qapp.font()
    font = qapp.font()
    font.setPointSizeF(factor * usual.pointSizeF())
    qapp.setFont(font)
    try:
        editor = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"), size=(1440, 900))
        untitled = Document((make_curve([(0, 0), (1, 2)], name=""),))
        leave_behind(replace(untitled, curves=(replace(untitled.curves[0], name="Untitled sketch"),)))
        leave_behind(replace(untitled, curves=(replace(untitled.curves[0], name="Untitled sketch"),)))
        editor.window.commands[RecoveryCommands].offer_unsaved_work()
        editor.settle()
        labels = [label for label in bar(editor).findChildren(ElidedLabel) if label.isVisible()]
        names = [label for label in labels if "of 2)" in label.text()]
        assert len(names) == 2
        for label in names if factor > 1 else labels:
            assert label.width() >= label.fontMetrics().horizontalAdvance(label.text()), label.text()
        press(editor, "discardWork0")
        message = editor.window.message_bar
        assert message.height() < 3 * message.sentence.fontMetrics().height()
        assert message.geometry().bottom() < bar(editor).geometry().top()
    finally:
        qapp.setFont(usual)


def test_the_recovery_bar_works_with_the_keyboard(editor):
    leave_behind()
    editor.trigger("recoverWork")
    assert editor.window.focusWidget().objectName() == "restoreWork0"
    QTest.keyClick(editor.window.focusWidget(), Qt.Key.Key_Escape)
    assert not bar(editor).isVisible()
    editor.trigger("recoverWork")
    QTest.keyClick(editor.window.focusWidget(), Qt.Key.Key_Space)
    assert editor.session.document == SKETCH


def test_restoring_asks_about_unsaved_changes_first(editor, monkeypatch):
    leave_behind()
    move_point(editor, (2.0, 3.0))
    present = editor.session.document
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    answer(monkeypatch, QMessageBox.StandardButton.Cancel)
    press(editor, "restoreWork0")
    assert editor.session.document == present
    assert bar(editor).isVisible()
    assert len(files()) == 1


def test_restoring_beside_unsaved_work_opens_another_window(autosaved):
    leave_behind()
    leave_behind(Document((make_curve([(5, 5), (6, 6)]),)))
    move_point(autosaved, (2.0, 3.0))
    present = autosaved.session.document
    autosaved.window.commands[RecoveryCommands].offer_unsaved_work()
    press(autosaved, "restoreWork1")
    assert autosaved.session.document == present
    (other,) = autosaved.opened
    assert other.session.document == SKETCH
    assert other.session.files.is_modified
    assert bar(autosaved).text == "A document with unsaved work from the last session:"
    until(lambda: len(files()) == 3)  # here, there, and the one not decided


def test_closing_the_window_keeps_undecided_snapshots(editor):
    leave_behind()
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    editor.window.close()
    (snapshot,) = list_snapshots(snapshot_folder()).snapshots
    snapshot.leave()


def test_a_damaged_snapshot_is_only_mentioned(editor):
    snapshot_folder().mkdir(parents=True)
    (snapshot_folder() / f"x{SUFFIX}").write_bytes(b"\x00" * 10)
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    assert "renamed to x.snapshot.json.damaged" in bar(editor).text
    press(editor, "closeRecovery")
    move_point(editor, (2.0, 3.0))
    assert editor.point(1) == pytest.approx((2, 3), abs=editor.pixel)


def test_editing_works_while_the_recovery_bar_is_visible(editor):
    leave_behind()
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    editor.click((2.95, 3.3))
    editor.drag_point(0, to=(3.3, 3.6))
    assert editor.point(0) == pytest.approx((3.3, 3.6), abs=editor.pixel)
    assert bar(editor).isVisible()


def test_the_recovery_bar_cuts_nothing_off_and_follows_the_theme(qtbot, tmp_path):
    editor = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"), size=(1024, 700))
    for _ in range(5):
        leave_behind()
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    for mode in (ThemeMode.DARK, ThemeMode.LIGHT):
        editor.window.store.change(theme_mode=mode)
        editor.settle()
        shown = bar(editor)
        assert editor.window.canvas.rect().contains(shown.geometry())
        button = shown.findChild(QPushButton, "laterWork0")
        assert shown.width() > button.mapTo(shown, button.rect().bottomRight()).x()
        paper = editor.window.grab().toImage().pixelColor(shown.mapTo(editor.window, shown.rect().center()))
        assert (paper.lightnessF() < 0.5) is (mode is ThemeMode.DARK)


def test_every_button_of_the_recovery_bar_has_a_tip(editor):
    leave_behind()
    editor.window.commands[RecoveryCommands].offer_unsaved_work()
    buttons = bar(editor).findChildren(QAbstractButton)
    names = {each.objectName() for each in buttons if each.isVisible()}
    assert names == {"restoreWork0", "discardWork0", "laterWork0", "closeRecovery"}
    assert all(each.toolTip() and each.accessibleName() for each in buttons if each.isVisible())


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (-5, "a moment ago"),
        (44, "a moment ago"),
        (50, "a minute ago"),
        (240, "4 minutes ago"),
        (44 * 60, "44 minutes ago"),
        (50 * 60, "an hour ago"),
        (5 * 3600, "5 hours ago"),
        (20 * 3600, "a day ago"),
        (3 * 86400, "3 days ago"),
    ],
)
def test_ages_are_written_in_words(seconds, words):
    assert age_in_words(seconds) == words


def test_the_age_of_an_old_snapshot_is_a_date():
    assert age_in_words(400 * 86400).startswith("on ")
