"""What was left for a lesson: its backup lives as long as only the history holds it."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QCoreApplication

from app.document.model import Document, make_curve
from app.features.lessons.lesson import load_lesson
from app.features.recovery.autosave import SetAside
from app.session import MessageKind, Session
from app.storage.files import load
from app.storage.recovery import list_snapshots

POINTS = [(0.0, 0.0), (1.0, 2.0), (2.5, 1.0)]
LESSONS = [load_lesson(name).document for name in ("03_chord_length", "04_decimal_accuracy")]


@pytest.fixture
def session(qapp: QCoreApplication) -> Session:
    return Session()


def files(folder):
    return sorted(folder.glob("*.snapshot.json"))


def test_the_snapshot_of_a_document_is_deleted_when_the_document_opens_again(session, tmp_path):
    kept = SetAside(session, tmp_path)
    session.files.open_copy(LESSONS[0])
    assert session.undo_stack.count() == 0
    work = Document((make_curve(POINTS),))
    session.commit(work, "Work")
    session.files.open_copy(LESSONS[1], "Lesson 4")
    assert len(files(tmp_path)) == 1
    assert list_snapshots(tmp_path).snapshots == ()  # this window still has it
    session.undo_stack.undo()
    assert session.document is work
    assert files(tmp_path) == []
    session.undo_stack.redo()
    assert len(files(tmp_path)) == 1
    kept.leave()
    (found,) = list_snapshots(tmp_path).snapshots
    assert found.document == work
    found.discard()


@pytest.mark.parametrize(
    "leave", [Session.new, lambda session: session.files.restore(Document((make_curve(POINTS),)), None)]
)
def test_a_left_document_is_offered_when_the_history_has_ended(session, tmp_path, leave):
    kept = SetAside(session, tmp_path)
    session.commit(Document((make_curve(POINTS),)), "Work")
    session.files.open_copy(LESSONS[1], "Lesson 4")
    leave(session)
    (found,) = list_snapshots(tmp_path).snapshots
    assert found.document == Document((make_curve(POINTS),))
    found.discard()
    kept.leave()


def test_recovered_work_is_not_dropped_for_a_lesson(session, tmp_path):
    """It has no step in the history, but it is work all the same."""
    kept = SetAside(session, tmp_path)
    work = Document((make_curve(POINTS),))
    session.files.restore(work, None)
    session.files.open_copy(LESSONS[0], "Lesson 3")
    assert len(files(tmp_path)) == 1
    session.undo_stack.undo()
    assert session.document is work
    assert session.files.is_modified
    kept.leave()


def test_a_saved_lesson_is_never_overwritten_by_the_document_before(session, tmp_path):
    file = tmp_path / "mine.curve.json"
    session.commit(Document((make_curve(POINTS),)), "Work")
    session.files.open_copy(LESSONS[0], "Lesson 3")
    session.save(file)
    session.undo_stack.undo()
    assert session.files.path is None
    assert session.files.is_modified
    assert load(file).curves[0].name == "Uneven"
    session.undo_stack.redo()
    assert session.files.path is None
    # The lock is gone with the file.
    other = Session()
    other.open(file)
    assert not other.files.is_read_only
    other.new()


def test_a_failing_disk_is_reported(session, tmp_path):
    said: list[str] = []
    session.message.connect(
        lambda message: said.append(message.text) if message.kind is MessageKind.REFUSAL else None
    )
    (tmp_path / "file").write_text("")
    kept = SetAside(session, tmp_path / "file")
    session.commit(Document((make_curve(POINTS),)), "Work")
    session.files.open_copy(LESSONS[0], "Lesson 3")
    assert "cannot be backed up" in said[0]
    session.undo_stack.undo()
    assert session.document.curves[0].points[1].position == POINTS[1]
    kept.leave()
