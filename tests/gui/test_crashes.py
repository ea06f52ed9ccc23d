"""What nobody caught: the work is kept, the person is told once, and the program goes on."""

from __future__ import annotations

import faulthandler
import json
import shutil
import sys
import threading
from pathlib import Path

import pytest
import shiboken6
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QLabel, QPlainTextEdit, QPushButton

from app.cli.windows import FaultFile, Lifecycle
from app.diagnostics.crash_handler import CrashHandler, report_of, versions
from app.features.recovery.autosave import snapshot_folder
from app.storage import files
from app.storage.recovery import list_snapshots
from tests.gui.editor_facts import stop_beside
from tests.waiting import until


@pytest.fixture
def guarded(qapp, editor):
    """The editor in a program that takes its exceptions itself, as `curvebench` does."""
    before = (sys.excepthook, threading.excepthook, sys.unraisablehook)
    editor.lifecycle = lifecycle = Lifecycle(qapp, [editor.window])
    lifecycle.start()
    yield editor
    stop_beside(lifecycle)
    assert (sys.excepthook, threading.excepthook, sys.unraisablehook) == before


def is_open(window):
    return shiboken6.isValid(window) and window.isVisible()


def dialogs():
    return [
        each
        for each in QApplication.topLevelWidgets()
        if each.objectName() == "crashDialog" and each.isVisible()
    ]


def has_reported(crashes):
    """Whether what was raised is shown, or waits only until the dialog before it is put away."""
    return not crashes._soon.isActive()


def raise_soon(guarded, problem, count=1):
    """Raise `problem` so often from within the event loop, and wait until the handler has told of it."""
    raised = []

    def fail():
        raised.append(problem)
        raise problem

    for _ in range(count):
        QTimer.singleShot(0, fail)
    until(lambda: len(raised) == count and has_reported(guarded.lifecycle.crashes))


def run(guarded, qapp, *steps):
    """Do `steps`, one after the other, in the event loop that `curvebench` runs, and return its code.

    Each begins when what the one before has raised is told. A loop that never ends is left to
    the time limit of tests: a timer that calls `exit` would outlive its test and end the loops of later ones.
    """
    to_do, crashes = list(steps), guarded.lifecycle.crashes

    def do_next():
        if not to_do:
            timer.stop()
        elif has_reported(crashes):
            to_do.pop(0)()

    timer = QTimer(interval=1)
    timer.timeout.connect(do_next)
    timer.start()
    try:
        return qapp.exec()
    finally:
        timer.stop()


def fail():
    raise ZeroDivisionError("a fault of ours")


def interrupt():
    raise KeyboardInterrupt


def press(name):
    (dialog,) = dialogs()
    QTest.mouseClick(dialog.findChild(QPushButton, name), Qt.MouseButton.LeftButton)


def report():
    (dialog,) = dialogs()
    return dialog.findChild(QPlainTextEdit, "crashReport").toPlainText()


def test_the_work_is_backed_up_before_the_dialog(guarded):
    guarded.drag_point(1, to=(2, 3))
    raise_soon(guarded, ZeroDivisionError("a fault of ours"))
    assert len(list(snapshot_folder().glob("*.snapshot.json"))) == 1
    (dialog,) = dialogs()
    assert any("Your work is safe" in each.text() for each in dialog.findChildren(QLabel))
    assert "ZeroDivisionError: a fault of ours" in report()
    press("goOn")
    assert dialogs() == []
    guarded.drag_point(1, to=(1, 3))
    assert guarded.point(1) == pytest.approx((1, 3), abs=guarded.pixel)


def test_without_a_backup_the_dialog_explains_the_risk(guarded):
    snapshot_folder().parent.mkdir(parents=True, exist_ok=True)
    snapshot_folder().write_text("in the way")
    guarded.drag_point(1, to=(2, 3))
    raise_soon(guarded, ZeroDivisionError())
    (dialog,) = dialogs()
    assert any("Save your work under another name" in each.text() for each in dialog.findChildren(QLabel))
    press("saveAndQuit")
    assert guarded.window.isVisible(), "there is no file to save it to, and no backup"
    guarded.session.files.give_up_changes()


def test_the_same_error_is_reported_once(guarded):
    raise_soon(guarded, ZeroDivisionError("again"), count=100)
    assert len(dialogs()) == 1
    press("goOn")
    raise_soon(guarded, ZeroDivisionError("again"), count=10)
    assert dialogs() == []


def test_an_error_that_keeps_the_window_open_is_reported_each_time(guarded, qapp, monkeypatch):
    """It was told once; from then on the × did nothing, without a word."""
    guarded.drag_point(1, to=(2, 3))
    monkeypatch.setattr(guarded.window.context.files, "may_discard", lambda: int("x"))
    crashes = guarded.lifecycle.crashes
    for _ in range(3):
        assert not guarded.window.close()
        assert not guarded.window.close()  # asked again before it was told: once is enough
        until(lambda: has_reported(crashes))
        assert len(list(snapshot_folder().glob("*.snapshot.json"))) == 1
        assert "closeEvent" in report()
        press("goOn")
        until(lambda: has_reported(crashes))
        assert dialogs() == []
    assert run(guarded, qapp, guarded.window.close, lambda: press("saveAndQuit")) == 0
    assert not is_open(guarded.window)
    assert len(list(snapshot_folder().glob("*.snapshot.json"))) == 1


def test_another_error_waits_until_the_dialog_is_closed(guarded):
    raise_soon(guarded, ZeroDivisionError("one"))
    sys.excepthook(*raised(KeyError("two")))
    assert "one" in report()
    press("goOn")
    until(lambda: len(dialogs()) == 1)
    assert "two" in report()
    press("goOn")


def test_escape_closes_the_dialog_and_the_program_continues(guarded):
    raise_soon(guarded, ZeroDivisionError())
    (dialog,) = dialogs()
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert dialogs() == []
    assert guarded.window.isVisible()


def test_an_error_while_painting_is_reported_and_painting_continues(guarded, monkeypatch):
    layer = next(
        layer for layer in guarded.window.canvas.layers._layers if layer.is_visible and not layer.is_still
    )
    failed = []

    def fail(*_arguments):
        failed.append(layer)
        raise RuntimeError("cannot paint")

    with monkeypatch.context() as patch:
        patch.setattr(layer, "paint", fail)
        for times in range(1, 6):
            guarded.window.canvas.viewport().update()
            until(lambda times=times: len(failed) >= times)
        until(lambda: has_reported(guarded.lifecycle.crashes))
    assert "cannot paint" in report()
    press("goOn")
    guarded.drag_point(1, to=(2, 3))
    assert dialogs() == []


def test_an_error_in_a_thread_is_reported_by_the_window(guarded):
    def fail():
        raise RuntimeError("in a thread")

    thread = threading.Thread(target=fail)
    thread.start()
    thread.join()
    until(lambda: len(dialogs()) == 1)
    assert "in a thread" in report()
    press("goOn")


def test_an_error_in_a_destructor_shows_no_dialog(guarded, capsys):
    class Bad:
        def __del__(self):
            raise RuntimeError("thrown away")

    Bad()
    assert has_reported(guarded.lifecycle.crashes)
    assert dialogs() == []
    assert "thrown away" in capsys.readouterr().err


def test_the_report_can_be_copied(guarded):
    raise_soon(guarded, ZeroDivisionError())
    shown = report()
    press("copyReport")
    assert QGuiApplication.clipboard().text() == shown
    assert len(dialogs()) == 1
    press("goOn")


def test_save_and_quit_saves_a_document_with_a_file(guarded, qapp, tmp_path):
    path = tmp_path / "mine.curve.json"
    guarded.session.save(path)
    guarded.drag_point(1, to=(2, 3))
    document = guarded.session.document
    assert run(guarded, qapp, fail, lambda: press("saveAndQuit")) == 0
    assert files.load(path) == document
    assert not is_open(guarded.window)
    assert list(snapshot_folder().iterdir()) == []


def kept_work():
    """The document of the only snapshot, which goes."""
    (snapshot,) = list_snapshots(snapshot_folder()).snapshots
    snapshot.discard()
    return snapshot.document


def test_save_and_quit_keeps_a_document_without_a_file_for_the_next_start(guarded, qapp):
    guarded.drag_point(1, to=(2, 3))
    document = guarded.session.document
    assert run(guarded, qapp, fail, lambda: press("saveAndQuit")) == 0
    assert not is_open(guarded.window)
    assert kept_work() == document


def test_save_and_quit_continues_if_saving_fails(guarded, tmp_path):
    path = tmp_path / "folder" / "mine.curve.json"
    path.parent.mkdir()
    guarded.session.save(path)
    guarded.drag_point(1, to=(2, 3))
    shutil.rmtree(path.parent)
    raise_soon(guarded, ZeroDivisionError())
    press("saveAndQuit")
    assert guarded.window.isVisible()
    assert "was not saved" in guarded.file_bar.text
    guarded.session.files.give_up_changes()


def test_ctrl_c_ends_the_program_and_keeps_the_work(guarded, qapp):
    guarded.drag_point(1, to=(2, 3))
    document = guarded.session.document
    assert run(guarded, qapp, interrupt) == 130
    assert dialogs() == []
    assert not is_open(guarded.window)
    assert kept_work() == document


def test_the_end_of_the_session_keeps_the_work_without_asking(guarded):
    guarded.drag_point(1, to=(2, 3))
    document = guarded.session.document
    guarded.lifecycle.prepare_for_end()
    guarded.window.close()
    assert not is_open(guarded.window)
    assert kept_work() == document


def test_the_end_of_the_session_asks_about_work_without_a_backup(guarded):
    snapshot_folder().parent.mkdir(parents=True, exist_ok=True)
    snapshot_folder().write_text("in the way")
    guarded.drag_point(1, to=(2, 3))
    guarded.lifecycle.prepare_for_end()
    assert guarded.window.asks_before_closing
    guarded.session.files.give_up_changes()


def test_a_cancelled_end_of_the_session_asks_again(guarded):
    guarded.drag_point(1, to=(2, 3))
    guarded.lifecycle.prepare_for_end()
    assert not guarded.window.asks_before_closing
    guarded.drag_point(1, to=(1, 3))
    assert guarded.window.asks_before_closing
    guarded.session.files.give_up_changes()


def test_at_most_five_different_errors_are_reported(qtbot):
    handler = CrashHandler(lambda: True, list)
    handler.install()
    try:
        shown = 0
        for number in range(8):
            sys.excepthook(*raised(type(f"Fault{number}", (Exception,), {})()))
            until(lambda: has_reported(handler))
            shown += len(dialogs())
            if dialogs():
                press("goOn")
    finally:
        handler.uninstall()
    assert shown == 5


# The report


def raised(problem):
    try:
        raise problem
    except Exception:
        return sys.exc_info()


def test_the_report_names_versions_and_the_line():
    problem = raised(ValueError("what it is"))[1]
    text = report_of(problem)
    for word in ("Curvebench", "Python", "PySide6", "Qt", "pyqtgraph", "numpy", "ValueError: what it is"):
        assert word in text
    assert 'File "tests/gui/test_crashes.py"' in text
    assert versions() in text


def test_the_report_holds_no_names_of_the_person(tmp_path, own_home):
    secret = own_home / "Love letters" / "to Eve.curve.json"
    texts = [
        f"[Errno 2] No such file: {str(secret)!r}",
        f"{secret} is gone",
        "“to Eve.curve.json” cannot be read",
        "to Eve.curve.json: points[3].x",
        "file:///srv/share/people/eve.png",
        r"C:\Users\eve\drawing.json",
    ]
    for text in texts:
        try:
            try:
                raise OSError(text)
            except OSError as cause:
                raise ValueError(text) from cause
        except ValueError as problem:
            told = report_of(problem, [str(secret), secret.name, "to Eve"]).lower()
        messages = [line for line in told.splitlines() if line.startswith(("oserror", "valueerror"))]
        assert len(messages) == 2
        for word in ("eve", str(own_home).lower(), "letters"):
            assert not any(word in line for line in messages), messages


def test_paths_in_the_report_begin_with_the_package():
    with pytest.raises(ValueError, match="Expecting") as caught:
        json.loads("{")
    text = report_of(caught.value)
    assert 'File "json/decoder.py"' in text
    for path in (Path.home(), Path(sys.prefix), Path(__file__).parents[2]):
        assert str(path) not in text


def test_endless_recursion_makes_a_short_report():
    def again(n):
        return again(n + 1) + 1

    with pytest.raises(RecursionError) as caught:
        again(0)
    assert len(report_of(caught.value)) < 21_000


def test_a_crash_is_written_to_a_file_without_a_terminal(own_home, monkeypatch):
    was_enabled = faulthandler.is_enabled()
    faulthandler.disable()
    monkeypatch.setattr(sys, "stderr", None)
    faults = FaultFile()
    try:
        faults.open()
        assert faulthandler.is_enabled()
        assert [path.name for path in own_home.rglob("faults.txt")] == ["faults.txt"]
    finally:
        faults.close()
        assert not faulthandler.is_enabled()
        if was_enabled:
            faulthandler.enable(sys.__stderr__)


def test_the_dialog_has_accessible_names(guarded):
    raise_soon(guarded, ZeroDivisionError())
    (dialog,) = dialogs()
    assert isinstance(dialog, QDialog)
    for name in ("goOn", "saveAndQuit", "copyReport"):
        button = dialog.findChild(QPushButton, name)
        assert button.toolTip()
        assert button.accessibleName()
    press("goOn")
