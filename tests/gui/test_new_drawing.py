"""A page to draw on, and a second window: New Drawing and New Window; real keys."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QMessageBox

from app.cli.lifecycle import Lifecycle
from app.document.model import Document, Page
from app.document.style import Style
from app.families import HERMITE, LAGRANGE
from app.testing import Editor
from app.window.main_window import MainWindow
from app.workbench.document_files import DocumentFiles
from tests.gui.curve_rows import view_of

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier


@pytest.fixture
def usual(editor):
    """The editor, and what new documents begin with, as it was before afterwards."""
    preferences = editor.window.preferences
    before = preferences.new_page, preferences.unit_name, preferences.new_style
    yield editor
    preferences.new_page, preferences.unit_name, preferences.new_style = before


def draw(editor):
    editor.key(Qt.Key.Key_N, CTRL | ALT | SHIFT)
    return editor.session.document


def test_a_drawing_is_a_page_of_millimetres_in_sight_with_corners_for_the_pen(usual):
    usual.session.new()
    document = draw(usual)
    page = Page(0.0, 0.0, 210.0, 297.0)
    assert (document.unit, document.page, usual.curve.family) == ("mm", page, HERMITE)
    assert not usual.session.files.is_modified
    assert usual.action("addTool").isChecked()
    usual.click((10, 10))
    usual.click((200, 287))
    usual.click((10, 200))
    points = usual.curve.points
    assert [(each.x, each.y) for each in points] == [
        pytest.approx(place, abs=usual.pixel) for place in ((10, 10), (200, 287), (10, 200))
    ]
    assert points[1].corner


def test_its_page_and_style_are_those_of_new_documents_where_these_have_a_page(usual):
    usual.session.new()
    red, page = Style(stroke="#ff0000"), Page(0.0, 0.0, 64.0, 32.0)
    usual.session.commit(
        Document((replace(usual.curve, family=LAGRANGE, style=red),), unit="px", page=page), "Begin"
    )
    usual.show_dock("documentDock")
    usual.window.findChild(object, "useForNew").click()
    usual.session.files.give_up_changes()
    document = draw(usual)
    assert (document.unit, document.page, usual.curve.family) == ("px", page, HERMITE)
    # A line of no width of its own gets one on paper.
    assert usual.curve.style == replace(red, width=1.0)


def test_it_asks_about_changes_first(editor):
    editor.drag_point(1, to=(0.5, 0.2))
    before = editor.session.document
    QTimer.singleShot(
        0,
        lambda: (
            editor.window.findChild(QMessageBox, "saveChanges")
            .button(QMessageBox.StandardButton.Cancel)
            .click()
        ),
    )
    draw(editor)
    assert editor.session.document is before


@pytest.mark.parametrize("page", [None, Page(0.0, 0.0, 210.0, 297.0)])
def test_a_second_window_has_an_empty_document_of_its_kind_and_is_kept_as_the_first(editor, qapp, page):
    editor.session.commit(replace(editor.session.document, page=page), "Begin")
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
        assert other.session.document.page == page
        assert other in lifecycle._autosaves
        assert other.pos() != editor.window.pos()
        assert len(editor.curve.points) > 1
        other.close()
        other.deleteLater()
    finally:
        lifecycle.stop()


def test_close_closes_its_window_and_quit_all_of_them_unless_one_is_kept(qtbot, qapp, monkeypatch):
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


def test_a_drawing_lists_nothing_before_something_is_drawn_and_opens_with_nothing_edited(usual, tmp_path):
    """It listed a “Curve 1” that nobody had drawn; opened again its first curve was edited."""
    usual.session.new()
    draw(usual)
    usual.show_dock("curvesDock")
    usual.settle()
    view = view_of(usual)

    def seen():
        return [row for row in range(view.curves.rowCount()) if not view.isRowHidden(row)]

    assert seen() == []
    usual.trigger("rectangleTool")
    usual.drag((20, 20), (90, 90))
    assert [view.curves.index(row).data() for row in seen()] == ["Rectangle 1"]
    path = tmp_path / "one.curve.json"
    usual.session.save(path)
    usual.trigger("undo")
    assert seen() == []
    usual.session.open(path)
    usual.settle()
    selected = usual.session.selected
    assert (seen(), selected.is_editing, selected.marked) == ([0], False, frozenset())
