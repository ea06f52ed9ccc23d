"""What stands around the canvas in sketches, lessons and drawings: each as the person has left it."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDockWidget, QLabel, QScrollArea, QTabBar, QToolButton

from app.document.model import Page
from app.document.plane_edits import set_page
from app.features.lessons.commands import LessonCommands
from app.settings.preferences import Preferences
from app.storage.files import save
from app.testing import Editor

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier
SKETCH, DRAWING = ["pointsDock", "curveDock"], ["styleDock", "transformDock"]


def begin_drawing(editor):
    editor.key(Qt.Key.Key_N, CTRL | ALT | SHIFT)


def begin_lesson(editor):
    editor.window.commands[LessonCommands].open("01_basis_functions")
    editor.settle()


def in_front(editor):
    side = editor.window.context.docks.side
    return [dock.objectName() for dock in side if not dock.visibleRegion().isEmpty()]


def shows_functions(editor):
    return editor.window.central["basisPane"].isVisible()


def click_tab(editor, title):
    bars = [bar for bar in editor.window.findChildren(QTabBar) if bar.isVisible()]
    bar, place = next((bar, at) for bar in bars for at in range(bar.count()) if bar.tabText(at) == title)
    QTest.mouseClick(bar, Qt.MouseButton.LeftButton, pos=bar.tabRect(place).center())
    editor.settle()


@pytest.fixture
def fresh(qtbot, tmp_path):
    """Return what opens a window of its own, with what the one before has remembered."""
    return lambda: Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"))


class Sizes(QObject):
    """What is told of a widget's size."""

    def __init__(self, watched):
        super().__init__()
        self.seen, self._watched = [], watched
        watched.installEventFilter(self)

    def eventFilter(self, _watched, event):
        if event.type() == QEvent.Type.Resize:
            self.seen.append(self._watched.size())
        return False


def test_a_drawing_has_its_style_at_hand_and_no_functions_and_a_lesson_has_them_again(editor):
    assert in_front(editor) == SKETCH
    begin_drawing(editor)
    assert not shows_functions(editor)
    assert not editor.action("toggleBasis").isChecked()
    assert in_front(editor) == DRAWING
    begin_lesson(editor)
    assert shows_functions(editor)
    assert editor.action("toggleBasis").isChecked()
    assert in_front(editor) == SKETCH
    assert editor.window.context.docks["transformDock"].isHidden()


def test_new_is_of_the_kind_that_is_open_and_t_offers_the_functions_that_are_away(editor):
    begin_drawing(editor)
    page = editor.session.document.page
    editor.trigger("rectangleTool")
    editor.drag((20, 20), (80, 80))
    editor.key(Qt.Key.Key_T)
    assert "basis panel" not in editor.message
    buttons = editor.window.message_bar.findChildren(QToolButton)
    next(each for each in buttons if each.defaultAction() is editor.action("toggleBasis")).click()
    editor.settle()
    assert shows_functions(editor)
    editor.session.files.give_up_changes()
    editor.key(Qt.Key.Key_N, CTRL)
    assert (editor.session.document.page, editor.curve.points, editor.session.document.unit) == (
        page,
        (),
        "mm",
    )
    assert editor.action("addTool").isChecked()
    editor.trigger("newSketch")
    assert (editor.session.document.page, editor.session.document.unit) == (None, "")
    assert editor.action("addTool").isChecked()
    editor.key(Qt.Key.Key_N, CTRL)
    assert editor.session.document.page is None


def test_what_a_person_has_changed_in_either_kind_is_there_in_the_next_of_it(editor):
    editor.key(Qt.Key.Key_F8)
    click_tab(editor, "History")
    begin_drawing(editor)
    editor.key(Qt.Key.Key_F8)
    click_tab(editor, "Objects")
    click_tab(editor, "Joints")
    begin_lesson(editor)
    assert not shows_functions(editor)
    assert in_front(editor) == ["historyDock", "curveDock"]
    begin_drawing(editor)
    assert shows_functions(editor)
    assert in_front(editor) == ["curvesDock", "jointsDock"]
    # Behind the other, and not away.
    assert not editor.window.context.docks["transformDock"].isHidden()
    editor.window.context.docks["transformDock"].close()
    begin_lesson(editor)
    begin_drawing(editor)
    assert editor.window.context.docks["transformDock"].isHidden()


def test_the_window_is_arranged_at_once_and_the_page_lies_where_it_stays(editor):
    canvas = editor.window.canvas
    sizes = Sizes(canvas.viewport())
    page = Page(0.0, 0.0, 210.0, 297.0)
    editor.window.actions_by_name["newDrawing"].trigger()
    before, seen = canvas.pixel_map.box, list(sizes.seen)
    editor.settle()
    assert (len(seen), sizes.seen) == (1, seen)
    assert canvas.pixel_map.box == before
    x_min, y_min, x_max, y_max = before
    assert x_min + x_max == pytest.approx(page.width, abs=4 * editor.pixel)
    assert y_min < 0
    assert 0.7 * (y_max - y_min) < page.height < y_max


def test_a_page_that_a_document_gets_later_moves_nothing(editor):
    editor.session.change("Set the page", lambda document: set_page(document, Page(0.0, 0.0, 4.0, 4.0)))
    editor.settle()
    assert shows_functions(editor)
    assert in_front(editor) == SKETCH


def test_panels_that_were_folded_away_are_arranged_when_they_are_back(editor):
    editor.key(Qt.Key.Key_F9)
    begin_drawing(editor)
    assert in_front(editor) == []
    editor.key(Qt.Key.Key_F9)
    assert in_front(editor) == DRAWING


def test_it_is_remembered_from_window_to_window(fresh, tmp_path):
    first = fresh()
    begin_drawing(first)
    first.key(Qt.Key.Key_F8)
    click_tab(first, "Objects")
    path = tmp_path / "drawing.curve.json"
    save(path, first.session.document)
    first.window.close()
    second = fresh()
    assert shows_functions(second)
    assert in_front(second) == SKETCH
    assert second.window.context.docks["transformDock"].isHidden()
    second.key(Qt.Key.Key_F8)
    second.window.open_file(path)
    second.settle()
    assert shows_functions(second)
    assert in_front(second) == ["curvesDock", "transformDock"]
    begin_lesson(second)
    assert not shows_functions(second)
    assert in_front(second) == SKETCH


def test_growth_of_errors_is_told_where_functions_are_at_hand(editor):
    readout = editor.window.findChild(QLabel, "lebesgueConstant")
    editor.wait_for_rest()
    assert readout.text().startswith("Λ ")
    begin_drawing(editor)
    for x in (40, 80, 120):
        editor.click((x, 100))
    editor.wait_for_rest()
    assert not readout.text()
    editor.trigger("toggleBasis")
    editor.wait_for_rest()
    assert readout.text().startswith("Λ")
    editor.trigger("toggleBasis")
    begin_lesson(editor)
    assert readout.text().startswith("Λ ")


def test_the_panels_of_a_drawing_are_no_wider_than_their_docks(fresh):
    editor = fresh()
    begin_drawing(editor)
    editor.settle()
    docks = [dock for dock in editor.window.context.docks.side if dock.objectName() in DRAWING]
    assert len(docks) == 2
    for dock in docks:
        area = dock.findChild(QScrollArea)
        assert not area.horizontalScrollBar().isVisible(), dock.objectName()


def test_what_is_listed_are_objects_in_drawings_and_curves_elsewhere(editor):
    """It was called “Curves” where texts and pictures stand in it, too."""
    dock = editor.window.findChild(QDockWidget, "curvesDock")
    close, shown = dock.titleBarWidget().close_button, editor.action("curvesDockShown")
    assert (dock.windowTitle(), shown.text().replace("&", "")) == ("Curves", "Curves")
    begin_drawing(editor)
    assert (dock.windowTitle(), shown.text().replace("&", "")) == ("Objects", "Objects")
    assert close.accessibleName() == "Close Objects"
    assert "the panel Objects" in shown.statusTip()
    begin_lesson(editor)
    assert (dock.windowTitle(), close.accessibleName()) == ("Curves", "Close Curves")
