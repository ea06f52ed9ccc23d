"""Names, paths and messages are displayed literally: no HTML, no mnemonic, nothing left out."""

from __future__ import annotations

import gc
import re
from itertools import product
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QHelpEvent, QTextDocument
from PySide6.QtGui import Qt as QtText
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QDialog,
    QLabel,
    QMenu,
    QMessageBox,
    QToolTip,
)

from app.actions.keymap import plain
from app.document.curve_edits import rename_curve
from app.document.model import Document, ReferenceImage, make_curve
from app.families import HERMITE
from app.features.curve_list.commands import CurveListCommands
from app.features.import_export.commands import ImportCommands
from app.features.point_table.commands import PointTableCommands
from app.features.recovery.bar import RecoveryBar, UnsavedWork
from app.storage.files import save
from tests.waiting import until

NAME = "<b>x</b> & \"y\" 'z'"
"""As HTML this shows three characters of its markup fewer; with an “&” a menu underlines the blank."""

FILE = "<b>x< & 'z'"
"""The same for the name of a file, which can hold no slash."""

SHORT = "<b>x</b>"
"""The same for the name of an element of a drawing and for a cell."""

pytestmark = pytest.mark.usefixtures("only_new_garbage")

APP = Path(__file__).parents[2] / "app"


def as_html(text):
    document = QTextDocument()
    document.setHtml(text)
    return document.toPlainText()


def label_shows(label):
    """What a label shows; a label that guesses shows HTML where Qt takes the text for it."""
    text, form = label.text(), label.textFormat()
    is_html = form == Qt.TextFormat.RichText or (
        form == Qt.TextFormat.AutoText and QtText.mightBeRichText(text)
    )
    return as_html(text) if is_html else text


def tip_shows(tip):
    return as_html(tip) if QtText.mightBeRichText(tip) else tip


def menu_shows(text):
    return text.replace("&&", "\0").replace("&", "").replace("\0", "&")


def tips_of_items(view):
    model = view.model()
    if model is None:
        return
    for row, column in product(range(4), range(8)):
        index = model.index(row, column)
        tip = model.data(index, Qt.ItemDataRole.ToolTipRole) if index.isValid() else None
        if isinstance(tip, str):
            yield tip


def widget_texts():
    """Every text that is on a widget now: where, as it was given, as it is seen."""
    # Shiboken wraps all of them one by one, and a collection meanwhile would take some away.
    gc.collect()
    for widget in QApplication.allWidgets():
        where = f"{type(widget).__name__} {widget.objectName()}"
        yield f"tip of {where}", widget.toolTip(), tip_shows(widget.toolTip())
        if isinstance(widget, QLabel):
            yield where, widget.text(), label_shows(widget)
        elif isinstance(widget, QAbstractButton):
            yield where, widget.text(), menu_shows(widget.text())
        elif isinstance(widget, QMenu):
            for action in widget.actions():
                yield f"action in {where}", action.text(), menu_shows(action.text())
                yield f"tip of action in {where}", action.toolTip(), tip_shows(action.toolTip())
        elif isinstance(widget, QAbstractItemView):
            for tip in tips_of_items(widget):
                yield f"item of {where}", tip, tip_shows(tip)


def check(*expected):
    """Hold every text that has what was planted to show it as it is; `expected` name places that have it."""
    wrong, found = [], set()
    for where, given, seen in widget_texts():
        if "x<" in given or "x&lt;" in given:
            found.add(where)
            if not any(each in seen for each in (NAME, FILE, SHORT)):
                wrong.append(f"{where}: {seen!r}")
    assert wrong == []
    assert set(expected) <= found, sorted(found)


@pytest.fixture
def planted(editor, tmp_path):
    path = tmp_path / f"{FILE}.curve.json"
    points = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]
    image = ReferenceImage(str(tmp_path / f"{FILE}.png"), 0.0, 0.0, 1.0, 1.0)
    curves = (make_curve(points, name=NAME, family=HERMITE), make_curve(points, name=NAME))
    save(path, Document(curves, image=image))
    editor.session.open(path)
    editor.window.actions_by_name["fitView"].trigger()
    editor.settle()
    return editor


def test_every_label_of_the_sources_is_one_of_ours():
    """`app.qt.labels.Label` does; whoever takes Qt's own lets it guess."""
    imported = re.compile(r"^from PySide6\.QtWidgets import (?:[^(\n]*|\([^)]*)\bQLabel\b", re.MULTILINE)
    takers = [path.name for path in APP.rglob("*.py") if imported.search(path.read_text(encoding="utf-8"))]
    assert takers == ["labels.py"]


def test_names_and_messages_are_displayed_as_plain_text(planted):
    window, session = planted.window, planted.session
    for name in ("curvesDock", "pointsDock", "imageDock", "historyDock", "styleDock", "transformDock"):
        planted.show_dock(name)
    window.message_bar.warn(f"{NAME} cannot be done.")
    session.say(f"Did {NAME}.")
    planted.settle()
    check("Label messageText")
    check("Label imageFile", "tip of Label imageFile")
    table = window.commands[PointTableCommands].panel
    table.model.refused.emit(f"{NAME} is no number.")
    check("Label pointTableMessage")
    rows = window.commands[CurveListCommands].panel.view
    place = rows.parts.row_rect(0).center()
    QApplication.sendEvent(rows.viewport(), QHelpEvent(QEvent.Type.ToolTip, place, rows.mapToGlobal(place)))
    assert f"“{NAME}”" in tip_shows(QToolTip.text())


def test_a_step_is_called_in_the_menu_as_in_the_history(planted):
    session = planted.session
    session.commit(rename_curve(session.document, 0, "x"), f"Rename {NAME}")
    planted.settle()
    assert menu_shows(planted.action("undo").text()) == f"Undo: Rename {NAME}"
    menus = planted.window.findChildren(QMenu)
    recent = next(menu for menu in menus if plain(menu.title()) == "Open Recent")
    recent.aboutToShow.emit()
    planted.show_dock("imageDock")
    check("tip of Label imageProblem")


def test_the_name_of_unsaved_work_is_displayed_as_plain_text(planted, tmp_path):
    offer = UnsavedWork(NAME, NAME, str(tmp_path / NAME), planted.session.document)
    bar = RecoveryBar(planted.window.canvas)
    bar.render([offer], NAME)
    check("Label recoveryNote", "ElidedLabel recoveryTold")
    bar.deleteLater()


@pytest.mark.usefixtures("drawings_read_here")
def test_the_import_dialogs_display_text_of_the_file_as_plain_text(planted, tmp_path):
    """A remark that began with "<style>" used to be invisible: the label took it for a style sheet."""
    drawing = tmp_path / f"{FILE}.svg"
    drawing.write_text(
        '<svg><style>@media print{}</style><text/><path id="&lt;b>x&lt;/b>" stroke="red" filter="url(#f)" '
        'd="M0 0L1 1"/></svg>',
        encoding="utf-8",
    )
    planted.window.commands[ImportCommands].import_files([drawing])
    planted.wait_for_work()
    dialog = planted.window.findChild(QDialog, "importDrawingDialog")
    assert dialog.remarks.text().splitlines() == [
        "1 style rule ignored: @media.",
        "1 text left out.",
        "1 filter not applied: <b>x</b>.",
    ]
    check("Label importRemarks")
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    table = tmp_path / "a.csv"
    table.write_text(f"x;y\n1;2\n3;{SHORT} is too long for its cell\n", encoding="utf-8")
    planted.window.commands[ImportCommands].import_files([table])
    planted.wait_for_work()
    dialog = planted.window.findChild(QDialog, "importTableDialog")
    until(lambda: not dialog.jobs.is_busy)
    check(
        "Label tableProblem",
        "tip of QPushButton importTable",
        "item of TablePreview tablePreview",
    )
    dialog.close()


def test_the_question_about_changes_names_the_file(planted, monkeypatch):
    asked = []

    def answer(box):
        asked.append(label_shows(box.findChild(QLabel, "qt_msgbox_label")))
        return QMessageBox.StandardButton.Cancel

    monkeypatch.setattr(QMessageBox, "exec", answer)
    planted.drag_point(1, to=(1.2, 1.4))
    planted.action("newDocument").trigger()
    assert asked == [f"Save the changes to {FILE}.curve.json?"]
