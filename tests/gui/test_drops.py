"""Files dragged over the window, with the events that a file manager causes."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QTimer, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QLineEdit, QPushButton

from app.cli.windows import Lifecycle
from app.document.model import Document, make_curve
from app.storage.files import save
from app.window import MainWindow
from tests.gui.editor_facts import stop_beside
from tests.waiting import until

COPY, MOVE = Qt.DropAction.CopyAction, Qt.DropAction.MoveAction
LEFT, NO_KEYS = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


def carried(*paths):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    return data


def drop(editor, *paths):
    data = carried(*paths)
    for kind in (QDragEnterEvent, QDropEvent):
        send(editor, kind, data, COPY)
    editor.wait_for_work()


def send(editor, kind, data, actions):
    """Send an event that proposes to move, as a drag within one disk does."""
    place = QPointF(300, 300) if kind is QDropEvent else QPoint(300, 300)
    event = kind(place, actions, data, LEFT, NO_KEYS)
    if actions & MOVE:
        event.setDropAction(MOVE)
    QApplication.sendEvent(editor.window, event)
    return event


@pytest.fixture
def files(tmp_path):
    save(tmp_path / "a.curve.json", Document((make_curve([(0.0, 0.0), (5.0, 5.0)]),)))
    (tmp_path / "a.csv").write_text("1,2\n3,4\n", encoding="utf-8")
    image = QImage(4, 4, QImage.Format.Format_RGB32)
    image.fill(0)
    image.save(str(tmp_path / "a.png"))
    return tmp_path


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("a.curve.json", "Drop to open a.curve.json"),
        ("a.csv", "Drop to import a.csv"),
        ("a.png", "Drop to trace a.png"),
    ],
)
def test_a_drop_copies_and_announces_its_effect(editor, files, name, words):
    data = carried(files / name)
    for kind in (QDragEnterEvent, QDragMoveEvent):
        event = send(editor, kind, data, COPY | MOVE)
        assert event.isAccepted()
        assert event.dropAction() == COPY
        assert editor.status == words
    event = send(editor, QDropEvent, data, COPY | MOVE)
    assert event.isAccepted()
    assert event.dropAction() == COPY
    editor.wait_for_work()
    assert not editor.status.startswith("Drop to")
    session = editor.session
    dialog = editor.window.findChild(QDialog, "importTableDialog")
    assert {
        "a.curve.json": session.files.path == files / name,
        "a.csv": dialog is not None,
        "a.png": session.document.image is not None,
    }[name]
    if dialog is not None:
        dialog.close()


def test_a_drag_that_leaves_clears_its_message(editor, files):
    before = editor.status
    data = carried(files / "a.csv")
    send(editor, QDragEnterEvent, data, COPY | MOVE)
    assert editor.status == "Drop to import a.csv"
    QApplication.sendEvent(editor.window, QDragLeaveEvent())
    assert editor.status == before


def test_data_that_can_only_be_moved_are_not_accepted(editor, files):
    data, before = carried(files / "a.curve.json"), editor.session.document
    for kind in (QDragEnterEvent, QDragMoveEvent, QDropEvent):
        assert not send(editor, kind, data, MOVE).isAccepted()
    assert editor.session.document is before
    assert not editor.status.startswith("Drop to")


def test_text_alone_is_not_a_file(editor):
    data = QMimeData()
    data.setText("3, 4")
    assert not send(editor, QDragEnterEvent, data, COPY).isAccepted()


# Several at once


@pytest.fixture
def program(editor, qapp):
    """An editor whose program opens windows, as `curvebench` does; those it opened are closed in the end."""
    before = set(qapp.topLevelWidgets())
    lifecycle = Lifecycle(qapp, [editor.window])
    lifecycle.start()
    editor.others = lambda: [
        each for each in qapp.topLevelWidgets() if isinstance(each, MainWindow) and each not in before
    ]
    yield editor
    for window in editor.others():
        window.close()
        window.deleteLater()
    stop_beside(lifecycle)


def documents(folder, *names):
    curve = make_curve([(0.0, 0.0), (5.0, 5.0)])
    for name in names:
        save(folder / f"{name}.curve.json", Document((curve,)))
    return [folder / f"{name}.curve.json" for name in names]


def test_all_documents_of_a_drop_are_opened(program, tmp_path):
    """Of three the first was opened, and nothing was said of the others."""
    paths = documents(tmp_path, "a", "b", "c")
    send(program, QDragEnterEvent, carried(*paths), COPY)
    assert program.status == "Drop to open 3 documents"
    drop(program, *paths)
    opened = [program.session.files.path, *(window.session.files.path for window in program.others())]
    assert sorted(opened) == paths
    assert program.session.files.path == paths[0]
    assert program.status == "Opened b.curve.json and c.curve.json in new windows."
    assert program.message == ""


def test_a_drop_reports_files_that_cannot_be_opened(program, tmp_path):
    paths = documents(tmp_path, "a", "b")
    bad = tmp_path / "bad.curve.json"
    bad.write_text("{}", encoding="utf-8")
    drop(program, bad, paths[0], tmp_path, paths[1])
    assert program.session.files.path == paths[0]
    assert [window.session.files.path for window in program.others()] == [paths[1]]
    assert "bad.curve.json was not opened: " in program.message
    assert f"{tmp_path.name} was not opened. “{tmp_path}” is a folder" in program.message


def test_a_drop_opens_no_hundred_windows(program, tmp_path, monkeypatch):
    monkeypatch.setattr("app.window.drops.MOST_WINDOWS", 2)
    drop(program, *documents(tmp_path, "a", "b", "c", "d"))
    assert len(program.others()) == 1
    assert (
        program.message == "c.curve.json and d.curve.json were not opened: a drop opens at most 2 documents."
    )


def test_with_a_single_window_a_drop_names_the_other_files(editor, tmp_path):
    paths = documents(tmp_path, "a", "b")
    drop(editor, *paths)
    assert editor.session.files.path == paths[0]
    assert editor.message == "b.curve.json was not opened: there is only one window."


def test_a_mixed_drop_uses_all_supported_files(editor, files):
    for name in ("b.csv", "c.csv"):
        (files / name).write_text("1,2\n3,4\n", encoding="utf-8")
    (files / "b.png").write_bytes((files / "a.png").read_bytes())
    names = ("a.csv", "a.png", "b.csv", "a.curve.json", "b.png", "c.csv")
    data = carried(*(files / name for name in names))
    data.setUrls([*data.urls(), QUrl("https://example.org/a.png")])
    send(editor, QDragEnterEvent, data, COPY)
    assert editor.status == "Drop to open 1 document, import 3 files, trace 1 picture"
    send(editor, QDropEvent, data, COPY)
    for place, name in enumerate(("a.csv", "b.csv", "c.csv"), 1):
        dialog = only_dialog(editor)
        assert dialog.windowTitle() == f"Import {name} ({place} of 3)"
        press(editor, dialog, "cancelImport")
    assert dialogs(editor) == []
    assert editor.session.files.path == files / "a.curve.json"
    assert editor.session.document.image is not None
    assert editor.message == (
        "b.png was not traced: a document has one reference image. "
        "Skipped 1 link to files that are not on this computer."
    )


def test_a_slow_drop_adds_to_its_own_document(editor, files, monkeypatch):
    """The picture went with the document before, and the table was not imported, for another was opened."""
    monkeypatch.setattr("app.storage.open_file._LARGE", 1)
    drop(editor, files / "a.curve.json", files / "a.csv", files / "a.png")
    press(editor, only_dialog(editor), "importTable")
    session = editor.session
    assert session.files.path == files / "a.curve.json"
    assert len(session.document.curves) == 2
    assert session.document.image is not None


# Imports of a drop, one after the other


def dialogs(editor):
    editor.wait_for_work()
    found = editor.window.findChildren(QDialog, "importTableDialog")
    found += editor.window.findChildren(QDialog, "importDrawingDialog")
    return [each for each in found if each.isVisible()]


def only_dialog(editor):
    found = dialogs(editor)
    assert len(found) == 1
    if found[0].objectName() == "importTableDialog":
        until(lambda: not found[0].jobs.is_busy)
    return found[0]


def press(editor, dialog, name):
    button = dialog.findChild(QPushButton, name)
    assert button.isVisible()
    QTest.mouseClick(button, LEFT)
    editor.settle()


def tables(folder, *names):
    for name in names:
        (folder / name).write_text("1,2\n3,4\n", encoding="utf-8")
    return [folder / name for name in names]


@pytest.mark.usefixtures("drawings_read_here")
def test_tables_dropped_at_once_are_asked_about_one_after_the_other(editor, tmp_path):
    """Three dialogs lay on top of each other."""
    first, second = tables(tmp_path, "a.csv", "b.csv")
    bad = tmp_path / "bad.svg"
    bad.write_text("<svg", encoding="utf-8")
    (late,) = tables(tmp_path, "late.csv")
    editor.new()
    drop(editor, first, bad, second)
    dialog = only_dialog(editor)
    assert dialog.windowTitle() == "Import a.csv (1 of 3)"
    assert dialog.findChild(QPushButton, "cancelImport").text() == "Skip"
    assert dialog.findChild(QPushButton, "skipRest").toolTip() == "Skip this file and the 2 files after it"
    drop(editor, late)  # joins those that wait
    assert only_dialog(editor).windowTitle() == "Import a.csv (1 of 4)"
    press(editor, dialog, "importTable")
    dialog = only_dialog(editor)  # what could not be read was left out, and is told until the last one
    assert dialog.windowTitle() == "Import b.csv (3 of 4)"
    assert "bad.svg" in editor.message
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    editor.settle()
    dialog = only_dialog(editor)
    assert dialog.windowTitle() == "Import late.csv (4 of 4)"
    assert "ancel" in dialog.findChild(QPushButton, "cancelImport").text()
    assert not dialog.findChild(QPushButton, "skipRest").isVisible()
    press(editor, dialog, "importTable")
    assert dialogs(editor) == []
    assert [curve.name for curve in editor.session.document.curves] == ["a", "late"]
    assert "bad.svg" in editor.message
    drop(editor, second)
    dialog = only_dialog(editor)
    assert dialog.windowTitle() == "Import b.csv"
    dialog.close()


def test_the_rest_of_a_drop_is_skipped_or_given_up_with_its_document(editor, tmp_path):
    paths = tables(tmp_path, "a.csv", "b.csv", "c.csv")
    before = editor.session.document
    drop(editor, *paths)
    press(editor, only_dialog(editor), "skipRest")
    assert dialogs(editor) == []
    assert editor.session.document is before
    assert editor.status == "a.csv, b.csv and c.csv were skipped."
    drop(editor, *paths)
    press(editor, only_dialog(editor), "cancelImport")
    assert only_dialog(editor).windowTitle() == "Import b.csv (2 of 3)"
    editor.new()
    assert dialogs(editor) == []
    assert (
        editor.status
        == "b.csv and c.csv were not imported because another document was opened in the meantime."
    )
    drop(editor, *paths[:2])
    dialog = only_dialog(editor)
    assert dialog.windowTitle() == "Import a.csv (1 of 2)"
    dialog.into.setCurrentIndex(1)
    press(editor, dialog, "importTable")  # its new document is where the others go, too
    press(editor, only_dialog(editor), "importTable")
    assert [curve.name for curve in editor.session.document.curves] == ["a", "b"]
    editor.session.files.give_up_changes()


def test_several_files_of_the_import_dialog_are_imported_like_a_drop(editor, tmp_path):
    """Of three names the dialog gave one, and nothing was said of the others."""
    paths = tables(tmp_path, "a.csv", "b.csv", "c.csv")
    editor.window.preferences.last_folder = tmp_path

    def choose():
        dialog = editor.window.findChild(QFileDialog)
        dialog.findChild(QLineEdit).setText(" ".join(f'"{path.name}"' for path in paths))
        dialog.accept()
        if dialog.isVisible():
            dialog.reject()

    QTimer.singleShot(0, choose)
    editor.trigger("importFile")
    for place, path in enumerate(paths, 1):
        dialog = only_dialog(editor)
        assert dialog.windowTitle() == f"Import {path.name} ({place} of 3)"
        press(editor, dialog, "cancelImport")
    assert dialogs(editor) == []


# Drawings that are no files


LEAF = '<svg xmlns="http://www.w3.org/2000/svg"><path id="leaf" d="M0 0L4 0L2 3Z"/></svg>'


@pytest.mark.parametrize("kind", ["image/svg+xml", "text/plain"])
def test_a_drawing_dragged_from_another_program_is_added_at_the_pointer(editor, kind):
    data = QMimeData()
    data.setData(kind, LEAF.encode())
    corner = editor.window.canvas.viewport().mapFrom(editor.window, QPoint(300, 300))
    place = editor.window.canvas.to_plane(corner)
    entered = send(editor, QDragEnterEvent, data, COPY | MOVE)
    assert (entered.isAccepted(), entered.dropAction()) == (True, COPY)
    assert "Drop to add the drawing here" in editor.status
    assert send(editor, QDragMoveEvent, data, COPY | MOVE).dropAction() == COPY
    pixel = editor.pixel
    assert send(editor, QDropEvent, data, COPY | MOVE).isAccepted()
    editor.wait_for_work()
    assert editor.curve.name == "leaf"
    xs, ys = zip(*(point.position for point in editor.curve.points), strict=True)
    assert ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2) == pytest.approx(place, abs=pixel)


@pytest.mark.parametrize(("text", "actions"), [("only words", COPY), (LEAF, MOVE)])
def test_other_text_and_moves_are_not_accepted(editor, text, actions):
    data = QMimeData()
    data.setText(text)
    document = editor.session.document
    for kind in (QDragEnterEvent, QDropEvent):
        assert not send(editor, kind, data, actions).isAccepted()
    editor.wait_for_work()
    assert editor.session.document is document
