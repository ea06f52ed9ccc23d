"""Window and dialogs on 960 × 540 pixels (a usual screen at 200 %), also in type twice as large."""

from __future__ import annotations

import importlib
import pkgutil

import pytest
from PySide6.QtCore import QSize, QTimer
from PySide6.QtWidgets import QDialog, QLabel, QMessageBox, QPushButton

import app.diagnostics
import app.features
import app.widgets
import app.window
import app.workbench
from app.diagnostics.crash_dialog import CrashDialog
from app.document.model import Document, make_curve
from app.document.point_edits import set_position
from app.exchange.cubics_in import ImportResult
from app.exchange.export_choice import ExportChoice
from app.exchange.formats import FORMATS
from app.exchange.table.source import TableSource
from app.exchange.table.text import preview_table
from app.features.help.manual import ManualWindow
from app.features.import_export.export_dialog import ExportDialog
from app.features.import_export.import_drawing_dialog import ImportDrawingDialog
from app.features.import_export.import_table_dialog import ImportTableDialog
from app.features.import_export.work_dialog import Verb
from app.features.lessons.commands import LessonCommands
from app.features.motion.export import MotionDialog
from app.session import Session
from app.storage.files import save
from app.testing import Editor
from app.widgets.frames import FRAME, FittedDialog
from app.window.preferences_dialog import PreferencesDialog

ROOM = QSize(960, 540) - FRAME
LINE = Document((make_curve(((0.0, 0.0), (4.0, 1.0))),))
MEASURED = Document(LINE.curves, unit="mm")


@pytest.fixture(params=[1.0, 2.0], ids=["usual type", "type at 200 %"])
def type_size(request, qapp):
    usual = qapp.font()
    large = qapp.font()
    large.setPointSizeF(usual.pointSizeF() * request.param)
    qapp.setFont(large)
    yield request.param
    qapp.setFont(usual)


def fits(size):
    return size.width() <= ROOM.width() and size.height() <= ROOM.height()


def test_the_window_fits_with_every_panel_and_bar(qtbot, type_size):
    editor = Editor(qtbot, size=(ROOM.width(), ROOM.height()))
    window = editor.window
    # It was 632 high, with type at 200 % 883.
    assert window.size() == ROOM
    # The basis functions' header has the most to say of it.
    editor.choose_family("quintic_hermite")
    for dock in (*window.context.docks.side, window.context.docks["lessonsDock"]):
        editor.show_dock(dock.objectName())
        window.layout().activate()
        assert fits(window.minimumSizeHint()), dock.objectName()
    window.context.docks["lessonsDock"].hide()
    editor.trigger("playMotion")
    window.layout().activate()
    assert fits(window.minimumSizeHint())
    assert window.size() == ROOM


def dialogs(window):
    """One of each dialog of the program, with as much in it as there can be."""
    for each in FORMATS.offered:
        export = ExportDialog(ExportChoice(each.ending), window)
        export.show_document(MEASURED, 0)
        yield export
    yield MotionDialog(window)
    yield CrashDialog(window, "Traceback\n" * 40, is_safe=False)
    many = tuple(f"Element {number} holds text, which has no curves to take." for number in range(30))
    rest = "Its page, its unit mm and 2 guides are left out."
    yield ImportDrawingDialog(
        Verb.OPEN, "drawing.svg", ImportResult(LINE, 0.0, many), lambda _anew: rest, window
    )
    data = b"t,x,y,vx,vy,ax,ay\n" + b"0,1,2,3,4,5,6\n1,2,4,5,6,7,8\n" * 20
    yield ImportTableDialog(Verb.IMPORT, "a.csv", "a", TableSource(data), preview_table(data), window)
    yield PreferencesDialog(window.preferences, window.actions_by_name.keymap, window)
    yield ManualWindow(window)


def test_every_dialog_fits_on_the_screen_with_visible_buttons(qtbot, type_size, monkeypatch):
    editor = Editor(qtbot)
    monkeypatch.setattr("app.widgets.frames.room_on", lambda _screen: ROOM)
    shown = set()
    for dialog in dialogs(editor.window):
        dialog.show()
        editor.settle()
        shown.add(type(dialog))
        assert fits(dialog.size()), dialog
        assert fits(dialog.minimumSizeHint()), dialog
        buttons = [each for each in dialog.findChildren(QPushButton) if not dialog.body.isAncestorOf(each)]
        assert buttons
        for button in buttons:
            if button.isVisible():
                corner = button.mapTo(dialog, button.rect().bottomRight())
                assert dialog.rect().contains(corner), button.text()
        dialog.close()
    assert shown == every_dialog()


def test_a_question_about_a_long_name_fits_on_the_screen(qtbot, type_size, tmp_path):
    """A name of 200 letters went out of the box at the right, and with it the question mark."""
    path = tmp_path / f"{'n' * 200}.curve.json"
    save(path, LINE)
    session = Session()
    session.open(path)
    editor = Editor(qtbot, session)
    session.commit(set_position(LINE, 0, 0, (3.0, 3.0)), "Move")
    seen = []

    def look():
        box = editor.window.findChild(QMessageBox, "saveChanges")
        label = box.findChild(QLabel, "qt_msgbox_label")
        seen.append((box.size(), label.size(), label.minimumSizeHint(), label.heightForWidth(label.width())))
        box.reject()

    QTimer.singleShot(0, look)
    editor.trigger("newDocument")
    ((box, label, needed, height),) = seen
    assert fits(box)
    assert needed.width() <= label.width()
    assert height <= label.height()


def every_dialog():
    for package in (app.widgets, app.workbench, app.features, app.window, app.diagnostics):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            importlib.import_module(module.name)

    def heirs(kind):
        return {kind, *(each for heir in kind.__subclasses__() for each in heirs(heir))}

    ours = {kind for kind in heirs(QDialog) if kind.__module__.startswith("app.")}
    assert ours == heirs(FittedDialog)
    return {kind for kind in ours if not kind.__subclasses__()}


def test_a_lesson_is_read_without_scrolling_sideways(qtbot):
    """A dock used to take its width from what it held before the lesson was in it: 190 pixels of 256."""
    editor = Editor(qtbot, size=(1280, 800))
    editor.show_dock("lessonsDock")
    editor.window.commands[LessonCommands].open("03_chord_length")
    editor.settle()
    area = editor.window.context.docks["lessonsDock"].widget()
    assert area.horizontalScrollBar().maximum() == 0
