"""New and Open: in this window where nothing was done yet, else in a window of their own."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QFileDialog, QMessageBox

from app.cli.windows import Lifecycle
from app.session import Session
from app.storage.files import load, save
from app.testing import Editor
from app.window.main_window import MainWindow
from app.workbench.document_files import DocumentFiles

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier
WHOLE = '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"><path id="a" d="M0 0L4 0"/></svg>'


@pytest.fixture
def windows(new_editor, qapp, monkeypatch):
    """Return what lists the windows that are kept beside the first; nobody is asked about changes."""
    monkeypatch.setattr(DocumentFiles, "_ask_about_changes", lambda _: pytest.fail("asked about changes"))
    lifecycle = Lifecycle(qapp, [new_editor.window])
    lifecycle.start()
    yield lambda: [each for each in lifecycle._autosaves if each is not new_editor.window]
    for window in list(lifecycle._autosaves):
        window.asks_before_closing = False
        if window is not new_editor.window:
            window.close()
    lifecycle.stop()


def change(editor):
    editor.drag_point(1, to=(0.5, 0.2))
    assert editor.session.files.is_modified


def open_by_dialog(editor, path, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    # Keys are for the window in front.
    editor.window.activateWindow()
    editor.settle()
    editor.key(Qt.Key.Key_O, CTRL)
    editor.wait_for_work()


def test_new_replaces_an_untouched_document_and_opens_another_window_beside_changes(new_editor, windows):
    editor = new_editor
    editor.window.resize(700, 600)
    editor.key(Qt.Key.Key_N, CTRL)
    assert windows() == []
    assert editor.session.active_curve.points == ()
    editor.add_point(0.2, 0.2)
    before = editor.session.document
    for _ in range(2):
        editor.trigger("newDocument")
        other = windows()[-1]
        assert other.isVisible()
        assert other.pos() != editor.window.pos()
        assert other.size() == editor.window.size()
        assert other.session.active_curve.points == ()
        assert other.actions_by_name["addTool"].isChecked()
    assert len(windows()) == 2
    assert editor.session.document is before
    assert editor.session.files.is_modified


def test_a_further_window_does_not_stick_out_of_the_screen_beside_a_large_one(new_editor, windows):
    """Its right and lower edges were out of sight beside one that filled the screen."""
    window, screen = new_editor.window, new_editor.window.screen().availableGeometry()
    margins = window.frameGeometry().size() - window.size()
    window.resize(screen.size() - margins)
    new_editor.settle()
    new_editor.add_point(0.2, 0.2)
    new_editor.trigger("newDocument")
    (other,) = windows()
    frame = other.frameGeometry()
    assert screen.contains(frame)
    assert frame.bottomRight() == screen.bottomRight()
    assert other.pos().toTuple() > window.pos().toTuple()


def test_open_does_not_replace_an_edited_document(new_editor, windows, tmp_path, monkeypatch):
    editor = new_editor
    own, second = tmp_path / "own.curve.json", tmp_path / "second.curve.json"
    for path in (own, second):
        save(path, Session().document)
    open_by_dialog(editor, own, monkeypatch)
    # The first sketch gives way, as before.
    assert windows() == []
    assert editor.session.files.path == own
    change(editor)
    open_by_dialog(editor, second, monkeypatch)
    (other,) = windows()
    assert other.session.files.path == second
    assert other.windowTitle().startswith("second.curve.json")
    assert other.preferences.recent_files[0] == second
    assert (editor.session.files.path, editor.session.files.is_modified) == (own, True)
    # What is open already is not opened twice.
    open_by_dialog(editor, second, monkeypatch)
    assert windows() == [other]
    # What cannot be opened is told here, with no window for it.
    second.with_name("bad.curve.json").write_text("{", encoding="utf-8")
    open_by_dialog(editor, second.with_name("bad.curve.json"), monkeypatch)
    assert editor.message.startswith("bad.curve.json was not opened")
    assert windows() == [other]
    # Each saves to its own file.
    Editor.on(other).trigger("saveDocument")
    assert load(second) == other.session.document


@pytest.mark.usefixtures("drawings_read_here")
def test_a_drawing_of_another_program_gets_its_own_window(new_editor, windows, tmp_path, monkeypatch):
    editor, path = new_editor, tmp_path / "badge.svg"
    path.write_text(WHOLE, encoding="utf-8")
    change(editor)
    before = editor.session.document
    open_by_dialog(editor, path, monkeypatch)
    (other,) = windows()
    assert (other.windowTitle(), other.session.document.curves[0].name) == ("badge[*] – Curvebench", "a")
    assert Editor.on(other).status == "Opened badge.svg: 1 curve, 2 points, exact."
    assert not other.session.files.is_modified
    # One with something to be told is asked about here; left alone it opens no window.
    path = tmp_path / "lossy.svg"
    path.write_text(WHOLE.replace("</svg>", "<foreignObject/></svg>"), encoding="utf-8")
    for answer, count in (("cancelImport", 1), ("importDrawing", 2)):
        open_by_dialog(editor, path, monkeypatch)
        dialog = editor.window.findChildren(QDialog, "importDrawingDialog")[-1]
        button = dialog.foot.ok if answer == "importDrawing" else dialog.foot._cancel
        button.click()
        editor.settle()
        assert len(windows()) == count
    assert windows()[-1].windowTitle() == "lossy[*] – Curvebench"
    assert editor.session.document is before


def test_a_second_window_has_an_empty_document_and_is_managed_like_the_first(new_editor, qapp):
    editor = new_editor
    lifecycle, before = Lifecycle(qapp, [editor.window]), set(qapp.topLevelWidgets())
    lifecycle.start()
    try:
        editor.key(Qt.Key.Key_N, ALT | SHIFT)
        (other,) = (
            each for each in qapp.topLevelWidgets() if isinstance(each, MainWindow) and each not in before
        )
        assert other.isVisible()
        assert other.session is not editor.session
        assert other.session.active_curve.points == ()
        assert other in lifecycle._autosaves
        assert other.pos() != editor.window.pos()
        assert len(editor.curve.points) > 1
        other.close()
        other.deleteLater()
    finally:
        lifecycle.stop()


def test_close_closes_its_window_and_quit_closes_all_windows_unless_cancelled(qtbot, qapp, monkeypatch):
    first, second = Editor(qtbot), Editor(qtbot)
    answers, asked = [QMessageBox.StandardButton.Cancel], []

    def ask(files):
        asked.append(files._window)
        return answers[0]

    monkeypatch.setattr(DocumentFiles, "_ask_about_changes", ask)
    second.drag_point(1, to=(0.5, 0.2))
    second.key(Qt.Key.Key_W, CTRL)
    assert asked == [second.window]
    assert first.window.isVisible()
    assert second.window.isVisible()
    first.window.activateWindow()
    first.settle()
    first.drag_point(1, to=(0.5, 0.2))
    answers[0] = QMessageBox.StandardButton.Discard
    first.key(Qt.Key.Key_W, CTRL)
    assert asked == [second.window, first.window]
    assert not first.window.isVisible()
    assert second.window.isVisible()
    third = Editor(qtbot)
    answers[0] = QMessageBox.StandardButton.Cancel
    third.key(Qt.Key.Key_Q, CTRL)
    assert (third.window.isVisible(), second.window.isVisible()) == (False, True)
    answers[0] = QMessageBox.StandardButton.Discard
    fourth = Editor(qtbot)
    fourth.key(Qt.Key.Key_Q, CTRL)
    assert (fourth.window.isVisible(), second.window.isVisible()) == (False, False)
