"""The document's file while it is open: changed, gone, open elsewhere, or not to be written."""

from __future__ import annotations

import errno
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import msgspec
import pytest
import shiboken6
from PySide6.QtCore import QFileSystemWatcher, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox, QToolButton, QWidget

from app.appearance.theme import ThemeMode
from app.document.model import Document, make_curve
from app.document.point_edits import move_points, set_position
from app.features.files.disk import DiskCommands, Ownership, lock_notice
from app.session import Session
from app.storage import files
from app.storage.files import ChangedOnDiskError, StorageError, load, save
from app.storage.format import encode
from app.storage.lock import OLD, Owner, lock_path
from app.storage.migration import MIGRATIONS
from app.storage.open_file import LockedError
from app.testing import Editor
from app.workbench.disk_watch import DiskWatch
from app.workbench.message_bar import NoticeBar
from tests import waiting

THEIRS = Document((make_curve([(0.0, 0.0), (1.0, 2.0), (3.0, 1.0)]),))
SOON_MS = 10
OTHERS = Document((make_curve([(0.0, 0.0), (5.0, 5.0)]),))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "drawing.curve.json"


@pytest.fixture
def saved(editor, path):
    """An editor with a document that is in a file."""
    editor.session.save(path)
    return editor


@pytest.fixture(autouse=True)
def look_soon(monkeypatch):
    """Have what watches files look soon after a sign: how long it waits for others is not the question."""
    monkeypatch.setattr("app.workbench.disk_watch._SETTLE_MS", SOON_MS)
    changed = {}

    def look_soon():
        for window in QApplication.topLevelWidgets():
            for watch in window.findChildren(DiskWatch):
                changed.setdefault(watch, watch._soon.interval())
                watch._soon.setInterval(SOON_MS)

    yield look_soon
    for watch, interval in changed.items():
        if shiboken6.isValid(watch):
            watch._soon.setInterval(interval)


@pytest.fixture
def until(look_soon):
    """Wait until something is so."""

    def wait(condition):
        look_soon()
        waiting.until(condition)

    return wait


@pytest.fixture
def save_loudly(qtbot):
    """Save, and wait until the system has told all who watch the folder."""

    def save_it(path, document):
        watcher = QFileSystemWatcher([str(path.parent)])
        with qtbot.waitSignal(watcher.directoryChanged):
            save(path, document)

    return save_it


def looks(editor):
    """How often the file was looked at since it was found gone or broken."""
    return editor.window.findChild(DiskCommands).checks


def edit(editor):
    """Make a step."""
    editor.session.commit(set_position(editor.session.document, 0, 2, (0.5, 4.2)), "Move point 2")
    editor.settle()
    assert editor.session.files.is_modified
    return editor.session.document


def answer_dialog(editor, path):
    """Type a name into the Save As dialog when it opens, and accept it."""
    seen = []

    def answer():
        dialog = editor.window.findChild(QFileDialog)
        seen.append(Path(dialog.selectedFiles()[0]).name)
        if path is None:
            dialog.reject()
            return
        dialog.selectFile(str(path))
        dialog.accept()

    QTimer.singleShot(0, answer)
    return seen


def offered(editor):
    return editor.window.findChild(NoticeBar, "fileBar").offered


# Changed by another program


def test_a_change_on_disk_can_be_reloaded_and_undone(saved, path, until):
    mine = edit(saved)
    save(path, THEIRS)
    until(lambda: saved.file_bar.text)
    words = "Another program changed “drawing.curve.json” on disk, and you have unsaved changes here."
    assert saved.file_bar.text == words
    assert offered(saved) == ["reloadFile", "keepMine", "compareWithFile"]
    assert saved.session.document is mine
    saved.file_bar.answer("reloadFile")
    assert saved.session.document == THEIRS
    assert not saved.session.files.is_modified
    assert saved.file_bar.text == ""
    assert saved.session.undo_stack.undoText() == "Reload"
    saved.trigger("undo")
    assert saved.session.document == mine
    assert saved.session.files.is_modified
    saved.trigger("saveDocument")
    assert load(path) == mine


def test_reloading_replaces_locked_curves(saved, path, until):
    """The lock of a curve is against slips of the hand, not against the file."""
    locked = msgspec.structs.replace(
        saved.session.document, curves=(msgspec.structs.replace(saved.curve, locked=True),)
    )
    saved.session.commit(locked, "Lock")
    saved.trigger("saveDocument")
    save(path, THEIRS)
    until(lambda: saved.file_bar.text)
    saved.file_bar.answer("reloadFile")
    assert saved.session.document == THEIRS


def test_repeatedly_replaced_files_are_detected(saved, path, until):
    """A file that is replaced by renaming loses its watch."""
    for document in (THEIRS, OTHERS, THEIRS):
        save(path, document)
        until(lambda: saved.file_bar.text)
        saved.file_bar.answer("reloadFile")
        assert saved.session.document == document
    path.write_bytes(encode(OTHERS))
    until(lambda: saved.file_bar.text)


def test_keep_mine_saves_over_the_changed_file(saved, path, until):
    mine = saved.session.document
    save(path, THEIRS)
    until(lambda: saved.file_bar.text)
    saved.file_bar.answer("keepMine")
    assert saved.file_bar.text == ""
    assert saved.session.files.is_modified
    saved.trigger("saveDocument")
    assert load(path) == mine
    assert not saved.session.files.is_modified


def test_reload_restores_the_file_and_can_be_undone(saved, path):
    on_disk = saved.session.document
    mine = edit(saved)
    saved.trigger("reloadFile")
    assert saved.session.document == on_disk
    assert not saved.session.files.is_modified
    assert saved.status == "Reloaded drawing.curve.json. Undo restores your document."
    count = saved.session.undo_stack.count()
    saved.trigger("reloadFile")  # the same again is no step
    assert saved.session.undo_stack.count() == count
    saved.trigger("undo")
    assert saved.session.document == mine


def test_reload_needs_a_file(editor):
    for name in ("reloadFile", "keepMine", "compareWithFile", "overwriteFile", "takeOver", "editAnyway"):
        assert not editor.action(name).isEnabled()


def test_compare_shows_the_file_dashed_and_named(saved, path, until):
    edit(saved)
    save(path, THEIRS)
    until(lambda: saved.file_bar.text)
    before = saved.screenshot()
    saved.file_bar.answer("compareWithFile")
    canvas = saved.window.canvas
    assert canvas.drawing.annotations.file_version == "drawing.curve.json on disk"
    assert [row.text for row in canvas.drawing.annotations.legend.rows] == ["drawing.curve.json on disk"]
    assert saved.screenshot() != before
    save(path, OTHERS)  # another one: the ghost goes with it
    until(lambda: saved.window.canvas.drawing.annotations._file_layer._views[0][1].points[-1, 0] == 5.0)
    saved.file_bar.answer("compareWithFile")
    assert canvas.drawing.annotations.file_version == ""
    assert canvas.drawing.annotations.legend.isHidden()
    assert saved.file_bar.text
    saved.file_bar.answer("compareWithFile")
    saved.file_bar.answer("keepMine")
    assert canvas.drawing.annotations.file_version == ""


def test_saving_over_an_unnoticed_change_asks(saved, path):
    """Before any watch has had the time to tell."""
    mine = edit(saved)
    save(path, THEIRS)
    saved.trigger("saveDocument")
    assert load(path) == THEIRS
    assert saved.session.files.is_modified
    assert saved.session.document is mine
    assert saved.file_bar.text.endswith("was not saved, because another program changed it.")
    assert offered(saved) == ["overwriteFile", "saveDocumentAs", "reloadFile", "compareWithFile"]
    saved.file_bar.answer("overwriteFile")
    assert load(path) == mine
    assert not saved.session.files.is_modified
    assert saved.file_bar.text == ""


def test_save_as_works_after_a_refused_save(saved, path, tmp_path):
    mine = edit(saved)
    save(path, THEIRS)
    saved.trigger("saveDocument")
    answer_dialog(saved, tmp_path / "mine.curve.json")
    saved.file_bar.answer("saveDocumentAs")
    assert load(tmp_path / "mine.curve.json") == mine
    assert load(path) == THEIRS
    assert saved.file_bar.text == ""
    assert saved.session.files.path == tmp_path / "mine.curve.json"


def test_a_cancelled_save_as_changes_nothing(saved, path):
    mine = edit(saved)
    save(path, THEIRS)
    saved.trigger("saveDocument")
    answer_dialog(saved, None)
    saved.file_bar.answer("saveDocumentAs")
    assert saved.session.files.path == path
    assert saved.session.document is mine
    assert saved.file_bar.text.endswith("was not saved, because another program changed it.")


def test_a_dismissed_notice_returns_with_the_next_save(saved, path):
    edit(saved)
    save(path, THEIRS)
    saved.trigger("saveDocument")
    close = saved.window.findChild(QToolButton, "closeFileBar")
    while saved.file_bar.text:
        QTest.mouseClick(close, Qt.MouseButton.LeftButton)
    assert load(path) == THEIRS
    saved.trigger("saveDocument")
    assert "overwriteFile" in offered(saved)


def test_closing_keeps_work_that_could_not_be_saved(saved, path):
    edit(saved)
    save(path, THEIRS)

    def answer():
        box = saved.window.findChild(QMessageBox, "saveChanges")
        box.button(QMessageBox.StandardButton.Save).click()

    QTimer.singleShot(0, answer)
    assert not saved.window.close()
    assert saved.window.isVisible()
    assert "overwriteFile" in offered(saved)
    assert load(path) == THEIRS


LOST = {
    "emptied": (lambda path: path.write_bytes(b""), "emptied or damaged the file."),
    "damaged": (lambda path: path.write_bytes(path.read_bytes()[:-9]), "emptied or damaged the file."),
    "replaced": (lambda path: save(path, THEIRS), "Another program has changed the file."),
    "deleted": (lambda path: path.unlink(), "The file is no longer in its folder."),
}


@pytest.mark.parametrize("how", LOST)
def test_closing_asks_about_a_document_that_its_file_no_longer_holds(saved, path, how):
    """Nobody was asked, and 0 bytes were left; before the watch has seen it, too."""
    lose, words = LOST[how]
    asked = []

    def answer(button):
        box = saved.window.findChild(QMessageBox, "saveChanges")
        asked.append((box.text(), box.informativeText()))
        box.button(button).click()

    lose(path)
    left = path.read_bytes() if path.exists() else None
    QTimer.singleShot(0, lambda: answer(QMessageBox.StandardButton.Cancel))
    assert not saved.window.close()
    assert asked[0][0] == "Save drawing.curve.json as shown here?"
    assert words in asked[0][1]
    # The window knows it now, without waiting for the watch.
    assert saved.file_bar.text
    assert saved.session.files.is_modified
    assert saved.window.isWindowModified()
    QTimer.singleShot(0, lambda: answer(QMessageBox.StandardButton.Save))
    if how == "deleted":
        assert saved.window.close()
        assert load(path) == saved.session.document
        return
    # What another program wrote is replaced only by who says so.
    assert not saved.window.close()
    assert path.read_bytes() == left
    assert "overwriteFile" in offered(saved)
    saved.file_bar.answer("overwriteFile")
    assert load(path) == saved.session.document
    # As it is asked when the window is closed, which puts an end to it.
    assert saved.window.context.files.may_discard()
    assert len(asked) == 2
    assert saved.window.findChild(QMessageBox, "saveChanges") is None


def test_closing_does_not_ask_after_the_file_is_restored(saved, path, until, monkeypatch):
    monkeypatch.setattr("app.features.files.disk._MOST_CHECKS", 1)
    monkeypatch.setattr("app.features.files.disk._RECHECK_MS", SOON_MS)
    content = path.read_bytes()
    path.write_bytes(b"")
    until(lambda: saved.session.files.is_modified)
    assert saved.file_bar.text
    path.write_bytes(content)
    until(lambda: not saved.session.files.is_modified)
    assert saved.file_bar.text == ""


def test_a_reader_is_not_asked_about_changes_saved_by_the_owner(saved, path, qtbot, until):
    second = second_window(qtbot, path)
    edit(saved)
    saved.trigger("saveDocument")
    until(lambda: second.file_bar.text.startswith("You saved changes"))
    assert not second.session.files.is_modified
    assert second.window.close()


def test_a_half_written_file_is_checked_again(saved, path, until):
    content = encode(THEIRS)
    path.write_bytes(content[: len(content) // 2])
    until(lambda: looks(saved) == 2)
    assert saved.file_bar.text == ""
    path.write_bytes(content)
    until(lambda: saved.file_bar.text)
    assert saved.file_bar.text.endswith("program changed “drawing.curve.json” on disk.")


@pytest.fixture
def few_checks(monkeypatch):
    monkeypatch.setattr("app.features.files.disk._MOST_CHECKS", 2)
    monkeypatch.setattr("app.features.files.disk._RECHECK_MS", SOON_MS)


def test_a_file_that_stays_damaged_is_reported(saved, path, until, few_checks):
    mine = saved.session.document
    path.write_bytes(b"not ours")
    until(lambda: saved.file_bar.text)
    assert "damaged “drawing.curve.json”. Your document is still open here." in saved.file_bar.text
    assert not saved.action("reloadFile").isEnabled()
    saved.file_bar.answer("keepMine")
    saved.trigger("saveDocument")
    assert load(path) == mine


def test_a_deleted_file_leaves_a_modified_document(saved, path, until, few_checks):
    path.rename(path.with_name("elsewhere"))
    until(lambda: saved.file_bar.text)
    assert "is no longer in its folder" in saved.file_bar.text
    assert saved.session.files.is_modified
    saved.file_bar.answer("saveDocument")
    assert load(path) == saved.session.document
    assert saved.file_bar.text == ""
    assert not saved.session.files.is_modified


@pytest.mark.parametrize("tries_to_save", [False, True])
def test_a_changed_and_then_deleted_file_is_reported_as_deleted(
    saved, path, until, few_checks, tries_to_save
):
    mine = edit(saved)
    save(path, THEIRS)
    until(lambda: saved.file_bar.text)
    if tries_to_save:
        saved.trigger("saveDocument")
        assert "was not saved, because another program" in saved.file_bar.text
    path.unlink()
    until(lambda: "is no longer in its folder" in saved.file_bar.text)
    assert offered(saved) == ["saveDocument", "saveDocumentAs"]
    saved.file_bar.answer("saveDocument")
    assert load(path) == mine
    assert saved.file_bar.text == ""


def test_a_file_restored_at_once_is_not_reported(saved, path, until):
    content = path.read_bytes()
    path.unlink()
    until(lambda: looks(saved) == 1)
    path.write_bytes(content)
    until(lambda: looks(saved) == 0)
    assert saved.file_bar.text == ""
    assert not saved.session.files.is_modified


def test_saving_is_not_reported_as_a_change(saved, qtbot, look_soon):
    edit(saved)
    look_soon()
    watch = saved.window.findChild(DiskWatch)
    for _ in range(3):
        with qtbot.waitSignal(watch.triggered):
            saved.trigger("saveDocument")
        assert saved.file_bar.text == ""


def test_a_new_document_ignores_changes_of_the_old_file(saved, path, save_loudly):
    saved.new()
    save_loudly(path, THEIRS)
    assert not saved.window.findChild(DiskWatch)._soon.isActive()
    assert saved.file_bar.text == ""
    assert not lock_path(path).exists()


def test_a_gesture_continues_while_the_file_changes(saved, path, until):
    document = saved.session.document
    saved.press(saved.point(2))
    saved.move((0.2, 4.0))
    save(path, THEIRS)
    until(lambda: saved.file_bar.text)
    assert saved.session.is_previewing
    saved.escape()
    assert saved.session.document is document


def test_the_file_is_checked_when_the_window_is_activated(saved, path, save_loudly, until, qtbot):
    """Some file systems of a network tell nothing of changes."""
    other = QWidget()
    qtbot.addWidget(other)
    other.show()
    other.activateWindow()
    until(other.isActiveWindow)
    watcher = saved.window.findChild(QFileSystemWatcher)
    watcher.removePaths([*watcher.files(), *watcher.directories()])
    save_loudly(path, THEIRS)
    assert not saved.window.findChild(DiskWatch)._soon.isActive()
    assert saved.file_bar.text == ""
    saved.window.activateWindow()
    until(lambda: saved.file_bar.text)


def test_the_target_of_a_link_is_watched(editor, path, tmp_path, until):
    save(path, THEIRS)
    folder = tmp_path / "links"
    folder.mkdir()
    link = folder / "link.curve.json"
    link.symlink_to(path)
    editor.window.open_file(link)
    save(path, OTHERS)
    until(lambda: editor.file_bar.text)
    editor.file_bar.answer("reloadFile")
    assert editor.session.document == OTHERS


# Open elsewhere


def second_window(qtbot, path):
    session = Session()
    session.open(path)
    return Editor(qtbot, session)


def foreign_lock(path, *, user="Ada", since=None):
    owner = Owner(user, "engine", "another computer", 7, "x", since or time.time(), "foreign")
    lock_path(path).write_bytes(msgspec.json.encode(owner))
    return owner


def test_a_second_window_opens_read_only(saved, path, qtbot):
    second = second_window(qtbot, path)
    assert second.session.files.is_read_only
    assert second.window.windowTitle() == "drawing.curve.json[*] (read-only) – Curvebench"
    assert second.file_bar.text.startswith("You have had “drawing.curve.json” open in another window since ")
    assert second.file_bar.text.endswith("; it is read-only here.")
    assert saved.window.windowTitle() == "drawing.curve.json[*] – Curvebench"
    assert saved.file_bar.text == ""


def test_the_owner_is_named(editor, path):
    save(path, THEIRS)
    foreign_lock(path)
    editor.window.open_file(path)
    assert editor.file_bar.text.startswith("Ada has had “drawing.curve.json” open on engine since ")
    assert offered(editor) == ["takeOver", "saveDocumentAs"]


def test_read_only_can_be_edited_and_saved_elsewhere(saved, path, qtbot, tmp_path):
    kept = load(path)
    second = second_window(qtbot, path)
    changed = edit(second)
    names = answer_dialog(second, tmp_path / "copy.curve.json")
    second.trigger("saveDocument")
    assert names == ["drawing copy.curve.json"]
    assert load(tmp_path / "copy.curve.json") == changed
    assert load(path) == kept
    assert not second.session.files.is_read_only
    assert "(read-only)" not in second.window.windowTitle()
    assert second.file_bar.text == ""


def test_a_reader_is_notified_when_the_owner_closes(saved, path, qtbot, until):
    second = second_window(qtbot, path)
    changed = edit(second)
    assert saved.window.close()
    until(lambda: "is no longer open elsewhere" in second.file_bar.text)
    assert offered(second) == ["takeOver"]
    second.file_bar.answer("takeOver")
    assert second.window.windowTitle() == "drawing.curve.json[*] – Curvebench"
    assert second.file_bar.text == ""
    second.trigger("saveDocument")
    assert load(path) == changed


def test_a_crashed_owner_is_detected(editor, path, until, monkeypatch):
    """A process that is killed removes no lock, so nothing tells; the reader looks from time to time."""
    monkeypatch.setattr("app.features.files.disk._OWNER_MS", 50)
    save(path, THEIRS)
    code = "import sys; from pathlib import Path; from app.storage.lock import acquire, lock_path\n"
    code += "kept = acquire(lock_path(Path(sys.argv[1]))); print(1, flush=True); sys.stdin.read()"
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    owner = subprocess.Popen(
        [sys.executable, "-c", code, str(path)],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    owner.stdout.readline()
    editor.window.open_file(path)
    assert "in another process since" in editor.file_bar.text
    owner.kill()
    owner.communicate()
    until(lambda: "is no longer open elsewhere" in editor.file_bar.text)
    editor.file_bar.answer("takeOver")
    assert not editor.session.files.is_read_only


def test_two_windows_of_one_start_share_one_owner(qtbot, path):
    """`curvebench FILE FILE`: the sessions are there before the windows."""
    save(path, THEIRS)
    sessions = [Session(), Session()]
    for session in sessions:
        session.open(path)
    editors = [Editor(qtbot, session) for session in sessions]
    assert [each.session.files.is_read_only for each in editors] == [False, True]
    assert "read-only here" in editors[1].file_bar.text


def test_a_reader_is_notified_when_the_owner_saves(saved, path, qtbot, until):
    second = second_window(qtbot, path)
    document = edit(saved)
    saved.trigger("saveDocument")
    until(lambda: "You saved changes to “drawing.curve.json” in another" in second.file_bar.text)
    second.file_bar.answer("reloadFile")
    assert second.session.document == document
    assert second.session.files.is_read_only


def test_taking_over_after_the_owner_saved_loses_nothing(saved, path, qtbot, until):
    second = second_window(qtbot, path)
    mine = edit(second)
    saved.session.commit(move_points(saved.session.document, 0, [5], (1.0, 0.0)), "Move")
    theirs = saved.session.document
    saved.trigger("saveDocument")
    assert saved.window.close()
    until(lambda: "is no longer open elsewhere" in second.file_bar.text)
    second.file_bar.answer("takeOver")
    assert offered(second) == ["reloadFile", "keepMine", "compareWithFile"]
    second.trigger("saveDocument")
    assert load(path) == theirs
    second.file_bar.answer("reloadFile")
    assert second.session.document == theirs
    second.trigger("undo")
    assert second.session.document == mine


def test_taking_over_asks_once_and_notifies_the_owner(saved, path, qtbot, until):
    second = second_window(qtbot, path)
    changed = edit(second)
    second.file_bar.answer("takeOver")
    assert "may still be editing" in second.file_bar.text
    assert second.session.files.is_read_only
    QTest.mouseClick(second.window.findChild(QToolButton, "closeFileBar"), Qt.MouseButton.LeftButton)
    assert second.session.files.is_read_only
    second.file_bar.answer("takeOver")
    second.file_bar.answer("editAnyway")
    assert not second.session.files.is_read_only
    until(lambda: "taken over “drawing.curve.json”" in saved.file_bar.text)
    assert saved.window.windowTitle().endswith("[*] (read-only) – Curvebench")
    second.trigger("saveDocument")
    assert load(path) == changed
    with pytest.raises(LockedError):
        saved.session.save()


def test_taking_over_an_old_lock_does_not_ask(editor, path):
    save(path, THEIRS)
    foreign_lock(path, since=time.time() - OLD - 60)
    editor.window.open_file(path)
    assert editor.file_bar.text.endswith("it is read-only here. It may have been left open by mistake.")
    editor.file_bar.answer("takeOver")
    assert not editor.session.files.is_read_only


def test_save_as_over_a_document_that_is_open_elsewhere_is_refused(saved, path, qtbot, tmp_path):
    kept = load(path)
    other = Editor(qtbot)
    other.session.save(tmp_path / "other.curve.json")
    document = edit(other)
    with pytest.raises(LockedError):
        other.session.save(path)
    answer_dialog(other, path)
    asked = confirm_replacing(other)
    other.trigger("saveDocumentAs")
    assert len(asked) == 1
    assert (
        "“drawing.curve.json” was not saved, because you have it open in another window."
        in other.file_bar.text
    )
    assert offered(other) == ["saveDocumentAs"]
    assert load(path) == kept
    assert other.session.document is document
    assert other.session.files.is_modified
    assert other.session.files.path == tmp_path / "other.curve.json"
    other.trigger("saveDocument")
    assert load(tmp_path / "other.curve.json") == document


def confirm_replacing(editor):
    """Answer the dialog's own question whether to replace the file; return the questions it asked."""
    asked = []
    timer = QTimer(editor.window, interval=20)

    def answer():
        dialog = editor.window.findChild(QFileDialog)
        box = dialog.findChild(QMessageBox) if dialog is not None else None
        if box is not None:
            timer.stop()
            asked.append(box.text())
            box.button(QMessageBox.StandardButton.Yes).click()

    timer.timeout.connect(answer)
    timer.start()
    return asked


def test_an_impossible_lock_is_reported_once(editor, path, monkeypatch):
    save(path, THEIRS)

    def fail(*_):
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr("app.storage.lock._create", fail)
    editor.window.open_file(path)
    assert editor.status.startswith("Others cannot see that drawing.curve.json is open here")
    assert not editor.session.files.is_read_only
    edit(editor)
    editor.trigger("saveDocument")
    assert load(path) == editor.session.document


def test_a_lock_file_with_odd_values_makes_a_readable_notice():
    owner = Owner("", "", "m", 7, "x", 1e300, "mark")
    text = lock_notice("a", Ownership.OPENED_ELSEWHERE, owner).text
    assert text.startswith("Another user has had “a” open since an unknown time; it is read-only here.")


# Saving that fails


def fail_with(code):
    def fail(*_arguments, **_keywords):
        raise OSError(code, os.strerror(code))

    return fail


FAULTS = {
    "disk full": (files.os, "fsync", errno.ENOSPC, "The disk is full"),
    "broken disk": (files.os, "fsync", errno.EIO, "was not written ({reason})"),
    "no replacing": (files.Path, "replace", errno.EIO, "was not written ({reason})"),
    "read-only": (files, "_write_temporary", errno.EROFS, "cannot be written in that folder"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_save_that_fails_keeps_everything_and_offers_save_as(saved, path, monkeypatch, tmp_path, fault):
    old = path.read_bytes()
    document = edit(saved)
    owner, step, code, words = FAULTS[fault]
    with monkeypatch.context() as faulty:
        faulty.setattr(owner, step, fail_with(code))
        saved.trigger("saveDocument")
    assert saved.file_bar.text.startswith("drawing.curve.json was not saved. ")
    assert words.format(reason=os.strerror(code)) in saved.file_bar.text
    assert offered(saved) == ["saveDocumentAs"]
    assert saved.session.files.is_modified
    assert saved.session.document is document
    assert path.read_bytes() == old
    answer_dialog(saved, tmp_path / "rescued.curve.json")
    saved.file_bar.answer("saveDocumentAs")
    assert load(tmp_path / "rescued.curve.json") == document
    assert not saved.session.files.is_modified
    assert saved.file_bar.text == ""


def test_saving_into_a_missing_folder_keeps_the_document(saved, tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    saved.session.save(folder / "a.curve.json")
    document = edit(saved)
    shutil.rmtree(folder)
    saved.trigger("saveDocument")
    assert "does not exist. Choose another folder." in saved.file_bar.text
    assert "saveDocumentAs" in offered(saved)
    assert saved.session.files.is_modified
    assert saved.session.document is document


def test_a_failed_save_does_not_hide_a_change_on_disk(saved, path, monkeypatch):
    edit(saved)
    with monkeypatch.context() as faulty:
        faulty.setattr(os, "fsync", fail_with(errno.EIO))
        saved.trigger("saveDocument")
    save(path, THEIRS)
    with pytest.raises(ChangedOnDiskError):
        saved.session.save()
    assert load(path) == THEIRS


def test_a_newer_version_on_disk_is_never_replaced(saved, path):
    document = edit(saved)
    newer = encode(THEIRS).replace(b'"version": 4', b'"version": 5')
    path.write_bytes(newer)
    saved.trigger("saveDocument")
    saved.file_bar.answer("overwriteFile")
    assert "was written by a newer version of Curvebench and was not replaced" in saved.file_bar.text
    assert "saveDocumentAs" in offered(saved)
    assert path.read_bytes() == newer
    assert saved.session.document is document
    assert saved.session.files.is_modified
    other = path.with_name("newer.curve.json")
    other.write_bytes(newer)
    saved.session.files.give_up_changes()
    saved.window.open_file(other)
    assert "newer.curve.json was not opened: it was written by a newer version" in saved.message
    assert saved.session.document is document


def test_an_older_version_is_reported_and_backed_up(editor, path, monkeypatch):
    monkeypatch.setitem(MIGRATIONS, 0, lambda values: values)
    old = encode(THEIRS).replace(b'"version": 4', b'"version": 0')
    path.write_bytes(old)
    editor.window.open_file(path)
    assert editor.session.document == THEIRS
    assert editor.status == (
        "drawing.curve.json was saved by an older version. The first save keeps a backup of it."
    )
    editor.session.commit(move_points(editor.session.document, 0, [0], (1.0, 0.0)), "Move")
    editor.trigger("saveDocument")
    assert editor.status == "Saved drawing.curve.json. The old version is kept in the same folder."
    assert path.with_name("drawing.curve.json.v0.bak").read_bytes() == old
    editor.trigger("saveDocument")
    assert editor.status == "Saved drawing.curve.json."


def test_features_left_out_of_an_older_version_are_reported_before_saving(editor, path):
    curves = encode(THEIRS).replace(b'"version": 4', b'"version": 2')
    old = curves.replace(b'"curves"', b'"kept_texts": [{}, {}], "kept_pictures": [{}], "curves"')
    path.write_bytes(old)
    editor.window.open_file(path)
    assert editor.session.document == THEIRS
    assert editor.file_bar.text == (
        "“drawing.curve.json” was made with a version that had more features: 2 texts and 1 picture were "
        "left out. Saving removes them from the file, and keeps a backup of the old file."
    )
    edit(editor)
    assert path.read_bytes() == old
    editor.trigger("saveDocument")
    assert editor.file_bar.text == ""
    assert path.with_name("drawing.curve.json.v2.bak").read_bytes() == old
    assert load(path) == editor.session.document


# The line itself


def test_the_notice_bar_fits_into_a_small_window(qtbot, path, until):
    editor = Editor(qtbot, size=(1024, 700))
    editor.session.save(path)
    edit(editor)
    save(path, THEIRS)
    editor.trigger("saveDocument")
    bar = editor.window.findChild(NoticeBar, "fileBar")
    canvas = editor.window.canvas
    for mode in (ThemeMode.LIGHT, ThemeMode.DARK):
        editor.window.store.change(theme_mode=mode)
        editor.settle()
        assert canvas.rect().contains(bar.geometry()), mode
        for name in bar.offered:
            button = bar.button(name)
            assert bar.rect().contains(button.geometry()), mode
            assert button.toolTip()
            assert button.accessibleName()
        editor.session.selected.set_points([])
        editor.window.message_bar.warn("Something else that has to be said at the same time.")
        editor.settle()
        assert not bar.geometry().intersects(editor.window.message_bar.geometry()), mode
        editor.window.message_bar.hide()
        editor.settle()
        assert bar.y() == 10 + round(canvas.rulers.thickness), mode
    editor.window.store.change(theme_mode=ThemeMode.SYSTEM)


def test_save_as_does_not_replace_the_file_with_the_added_suffix(saved, path, tmp_path):
    """The dialog asks about the name that was typed; the suffix that is added may make it another file."""
    edit(saved)
    save(tmp_path / "there.curve.json", THEIRS)
    answer_dialog(saved, tmp_path / "there")
    saved.trigger("saveDocumentAs")
    assert "“there.curve.json” already exists." in saved.file_bar.text
    assert load(tmp_path / "there.curve.json") == THEIRS
    assert saved.session.files.is_modified


def test_a_session_without_a_window_refuses_to_overwrite(tmp_path, qapp):
    path = tmp_path / "a.curve.json"
    first, second = Session(), Session()
    first.save(path)
    second.open(path)
    with pytest.raises(StorageError):
        second.save()
    first.new()
    second.save()
    second.files.file.close()
