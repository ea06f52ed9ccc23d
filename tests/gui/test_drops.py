"""Files dragged over the window, with the events that a file manager causes."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent, QImage
from PySide6.QtWidgets import QApplication, QDialog

from app.document.model import Document, make_curve
from app.document.storage import save

COPY, MOVE = Qt.DropAction.CopyAction, Qt.DropAction.MoveAction
LEFT, NO_KEYS = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


def carried(path):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    return data


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
def test_a_drop_copies_and_says_beforehand_what_it_will_do(editor, files, name, words):
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
        "a.curve.json": session.path == files / name,
        "a.csv": dialog is not None,
        "a.png": session.document.image is not None,
    }[name]
    if dialog is not None:
        dialog.close()


def test_a_drag_that_leaves_takes_its_words_along(editor, files):
    before = editor.status
    data = carried(files / "a.csv")
    send(editor, QDragEnterEvent, data, COPY | MOVE)
    assert editor.status == "Drop to import a.csv"
    QApplication.sendEvent(editor.window, QDragLeaveEvent())
    assert editor.status == before


def test_what_can_only_be_moved_is_not_taken(editor, files):
    data, before = carried(files / "a.curve.json"), editor.session.document
    for kind in (QDragEnterEvent, QDragMoveEvent, QDropEvent):
        assert not send(editor, kind, data, MOVE).isAccepted()
    assert editor.session.document is before
    assert not editor.status.startswith("Drop to")


def test_words_alone_are_no_file(editor):
    data = QMimeData()
    data.setText("3, 4")
    assert not send(editor, QDragEnterEvent, data, COPY).isAccepted()
