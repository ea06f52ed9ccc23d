"""The history as a list that goes where it is clicked."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QUndoView

from app.appearance.theme import ThemeMode, apply_theme
from app.document import point_edits
from app.document.model import make_curve
from app.features.history.commands import HistoryPanel
from app.session import Session
from app.storage import files


@pytest.fixture
def history(qtbot):
    session = Session()
    panel = HistoryPanel(session.undo_stack)
    qtbot.addWidget(panel)
    for index in (1, 2, 3):
        document = point_edits.move_points(session.document, 0, [index], (0.5, 0.0))
        session.commit(document, f"Move point {index}")
    panel.resize(300, 240)
    with qtbot.waitExposed(panel):
        panel.show()
    return session, panel


def entries(view):
    model = view.model()
    return [model.data(model.index(row, 0)) for row in range(model.rowCount())]


def click(qtbot, view, row):
    place = view.visualRect(view.model().index(row, 0)).center()
    qtbot.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=place)


def test_the_text_of_a_row_has_a_margin(history):
    """It began three pixels from the edge of the panel."""
    _session, panel = history
    view = panel.view
    picture = view.viewport().grab().toImage()
    row = view.visualRect(view.model().index(1, 0))
    paper = picture.pixelColor(row.right() - 2, row.center().y())
    inked = [
        x
        for x in range(row.left(), row.right())
        if any(picture.pixelColor(x, y) != paper for y in range(row.top() + 2, row.bottom() - 1))
    ]
    assert 8 <= inked[0] <= 16


def test_the_history_lists_the_steps(history):
    _session, panel = history
    view = panel.view
    assert entries(view) == ["Start", "Move point 1", "Move point 2", "Move point 3"]
    assert view.currentIndex().row() == 3


def test_a_click_on_a_step_goes_back_and_forward(qtbot, history):
    session, panel = history
    view = panel.view
    last = session.document
    click(qtbot, view, 1)
    assert session.undo_stack.index() == 1
    assert session.undo_stack.undoText() == "Move point 1"
    assert session.document != last
    click(qtbot, view, 0)
    assert not session.undo_stack.canUndo()
    click(qtbot, view, 3)
    assert session.document is last


def test_arrow_keys_go_through_the_steps(qtbot, history):
    session, panel = history
    view = panel.view
    view.setFocus()
    qtbot.keyClick(view, Qt.Key.Key_Up)
    assert session.undo_stack.index() == 2
    qtbot.keyClick(view, Qt.Key.Key_Down)
    assert session.undo_stack.index() == 3


def test_the_history_follows_undo_and_redo(history):
    session, panel = history
    view = panel.view
    session.undo_stack.undo()
    assert view.currentIndex().row() == 2
    session.undo_stack.redo()
    assert view.currentIndex().row() == 3


def view_of(editor):
    editor.show_dock("historyDock")
    return editor.window.findChild(QUndoView, "historyView")


def test_the_first_entry_is_named_although_the_panel_opens_later(editor):
    session = editor.session
    session.new()
    editor.add_point(0, 0)
    editor.add_point(1, 1)
    assert entries(view_of(editor)) == ["New document", "Add point 0", "Add point 1"]


def test_the_first_entry_is_named_after_the_opened_document(editor, tmp_path):
    session, view = editor.session, view_of(editor)
    for index in (1, 2, 3):
        editor.drag_point(index, to=(0.5, 0.1 * index))
    path = tmp_path / "swan.curve.json"
    document = session.document.with_curve(0, make_curve([(0.0, 0.0), (1.0, 1.0)], name="Swan"))
    files.save(path, document)
    assert len(entries(view)) == 4
    session.open(path)
    assert entries(view) == ["Opened swan.curve.json"]
    session.files.open_copy(path)
    assert entries(view) == ["Opened Swan"]
    session.new()
    assert entries(view) == ["New document"]


@pytest.mark.parametrize("mode", [ThemeMode.DARK, ThemeMode.LIGHT])
def test_undone_steps_are_muted(history, qapp, mode):
    theme = apply_theme(qapp, mode)
    session, panel = history
    view = panel.view
    large = view.font()
    large.setPixelSize(36)  # strokes of any font cover whole pixels, which have the colour of the text
    large.setBold(True)
    view.setFont(large)
    session.undo_stack.setIndex(1)
    image = view.viewport().grab().toImage()

    def inks(row):
        place = view.visualRect(view.model().index(row, 0))
        return {
            image.pixel(x, y) for x in range(place.left(), 200) for y in range(place.top(), place.bottom())
        }

    assert theme.ink.rgb() in inks(0)
    assert theme.ink.rgb() not in inks(2)


def test_the_history_has_a_name_and_a_tooltip(history):
    view = history[1].view
    assert view.objectName() == "historyView"
    assert view.accessibleName()
    assert view.toolTip()
