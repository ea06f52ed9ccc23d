"""Files of other formats in, with real events: tables, drawings, and what is stopped half way."""

from __future__ import annotations

import math
import sys
import threading
from contextlib import contextmanager

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QTimer, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QDialog,
    QFileDialog,
    QLabel,
    QPushButton,
    QSpinBox,
)

from app.document.model import Document, make_curve
from app.exchange.files import export
from app.exchange.options import Options
from app.exchange.table import text, thinning
from app.exchange.table.source import TableSource
from app.families import HERMITE
from app.features.import_export.commands import ImportCommands
from app.features.import_export.export_commands import ExportCommands
from app.storage.files import save
from app.tasks.task import stopped_tasks
from app.view_model.curve.curve_view import view_of
from app.widgets.fields import FieldEdit
from tests.gui.editor_facts import retype
from tests.waiting import until

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg"><flowRoot>hi</flowRoot>'
    '<path id="a" stroke="#d55e00" d="M0 0C1 1 2 1 3 0"/><path id="b" d="M0 5H9"/></svg>'
)


@pytest.fixture(autouse=True)
def _no_pause_to_type_on(monkeypatch):
    """The preview waits until nothing is typed for a while; here nobody types on."""
    monkeypatch.setattr("app.features.import_export.import_table_dialog._SOON_MS", 10)


def write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def spiral(path, rows):
    t = np.linspace(0, 20, rows)
    values = np.column_stack([t, t * np.cos(t), np.sin(2 * t)])
    # All at once: row by row takes longer than reading them.
    return write(path, "t,x,y\n" + "%.6f,%.6f,%.6f\n" * rows % tuple(values.ravel().tolist()))


def dialog_of(editor, name):
    return editor.window.findChild(QDialog, name)


def opened(editor, path, name="importTableDialog"):
    """The dialog of an import, when nothing is going on any more."""
    editor.window.commands[ImportCommands].import_files([path])
    editor.wait_for_work()
    dialog = dialog_of(editor, name)
    assert dialog is not None, editor.message
    if name == "importTableDialog":
        settle(editor, dialog)
    return dialog


def settle(editor, dialog):
    # What a job has found is told a moment after it has ended.
    until(
        lambda: not (dialog.jobs.is_busy or dialog._soon.isActive()) and dialog.summary.text() != "Reading…"
    )
    editor.settle()


def choose(box, text):
    """Choose an item with the keyboard."""
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Home)
    for _ in range([box.itemText(i) for i in range(box.count())].index(text)):
        QTest.keyClick(box, Qt.Key.Key_Down)


def press(dialog, name):
    QTest.mouseClick(dialog.findChild(QPushButton, name), Qt.MouseButton.LeftButton)


def test_a_table_is_imported_as_one_step(editor, tmp_path):
    before = editor.session.document
    dialog = opened(editor, write(tmp_path / "pond.csv", "x;y\n0,5;1\n2;3,25\n4;0\n"))
    assert dialog.preview.head.roles == ("x", "y")
    assert dialog.summary.text() == "3 rows → 3 points"
    assert dialog.comma_check.isChecked()
    press(dialog, "importTable")
    editor.settle()
    curve = editor.curve
    assert (curve.name, curve.family) == ("pond", HERMITE)
    assert [point.position for point in curve.points] == [(0.5, 1), (2, 3.25), (4, 0)]
    assert len(editor.session.document.curves) == len(before.curves) + 1
    assert editor.status == "Imported pond.csv: 1 curve, 3 points, exact."
    assert editor.window.canvas.framing.shows_all_points
    assert editor.session.undo_stack.undoText() == "Import pond.csv"
    editor.trigger("undo")
    assert editor.session.document == before
    assert dialog_of(editor, "importTableDialog") is None


def test_an_import_into_an_empty_document_replaces_the_empty_curve(editor, tmp_path):
    editor.new()
    press(opened(editor, write(tmp_path / "a.tsv", "x\ty\n0\t0\n1\t1\n")), "importTable")
    assert [curve.name for curve in editor.session.document.curves] == ["a"]


def test_the_view_stays_where_all_of_an_import_is_in_sight(editor, tmp_path):
    canvas = editor.window.canvas
    editor.trigger("zoomOut")
    left, bottom, right, top = before = canvas.pixel_map.box
    x, y = (left + right) / 2, (bottom + top) / 2
    rows = f"{x},{y}\n{x + 0.1},{y + 0.1}\n{x},{y + 0.2}\n"
    press(opened(editor, write(tmp_path / "inside.csv", rows)), "importTable")
    editor.settle()
    assert editor.curve.name == "inside"
    assert canvas.pixel_map.box == before
    rows = f"{x},{y}\n{right + 5},{y}\n"
    press(opened(editor, write(tmp_path / "outside.csv", rows)), "importTable")
    editor.settle()
    assert canvas.pixel_map.box[2] > right + 5
    after = canvas.pixel_map.box
    editor.trigger("undo")
    assert canvas.pixel_map.box == after


def test_the_dialog_shows_the_roles_of_the_columns(editor, tmp_path):
    """A table of pandas used to come in as x = the index, y = the time, without a word."""
    text = ",time,pos_x,pos_y\n0,0.0,1,2\n1,0.1,2,3\n2,0.2,3,1\n"
    dialog = opened(editor, write(tmp_path / "pandas.csv", text))
    assert dialog.preview.head.roles == ("ignore", "t", "x", "y")
    said = "Columns: t = “time”, x = “pos_x”, y = “pos_y”. Left out: column 1."
    assert dialog.remark.text() == said
    choose(dialog.preview.head.boxes[1], "ignore")
    settle(editor, dialog)
    assert dialog.remark.text() == "Columns: x = “pos_x”, y = “pos_y”. Left out: column 1, “time”."
    dialog.close()
    dialog = opened(editor, write(tmp_path / "three.dat", "NACA 1\n0 1 2\n1 3 4\n"))
    assert dialog.remark.text() == (
        "Not read as numbers: “NACA 1”. Columns: t = column 1, x = column 2, y = column 3. "
        "This is a guess; check the roles above the columns."
    )
    dialog.close()


def test_the_dialog_offers_treatments_of_missing_numbers(editor, tmp_path):
    dialog = opened(editor, write(tmp_path / "gaps.csv", "x,y\n0,1\n1,2\nnan,nan\n3,4\n5,3\n"))
    assert dialog.problem.text() == "⚠ Row 4, column 1: “nan” is not a number."
    assert not dialog.ok.isEnabled()
    assert dialog.missing_box.isVisible()
    # The box had no label; nobody saw what it chose.
    label = dialog.findChild(QLabel, "tableMissingLabel")
    assert label.isVisible()
    assert (label.text(), label.buddy()) == ("Rows without numbers", dialog.missing_box)
    assert dialog.missing_box.accessibleName() == label.text()
    choose(dialog.missing_box, "End the curve there")
    settle(editor, dialog)
    assert dialog.summary.text() == "5 rows → 4 points in 2 curves"
    press(dialog, "importTable")
    editor.settle()
    assert [each.name for each in editor.session.document.curves[-2:]] == ["gaps (1)", "gaps (2)"]


def test_the_dialog_reports_repeated_points(editor, tmp_path):
    """Of four points two were one; they came in as "exact", and no curve was drawn."""
    dialog = opened(editor, write(tmp_path / "twice.csv", "0,0\n1,1\n1,1\n2,0\n"))
    said = "Row 3 repeats the point of the previous row; they were merged"
    assert dialog.problem.text().startswith(said)
    assert dialog.summary.text() == "4 rows → 3 points"
    press(dialog, "importTable")
    editor.settle()
    assert editor.session.active_view.problem == ""
    assert editor.status == "Imported twice.csv: 1 curve, 3 points, exact."


def test_an_array_and_points_in_json_are_imported_by_the_same_dialog(editor, tmp_path):
    np.save(tmp_path / "array.npy", np.array([[0.0, 1.0], [2.0, 3.0]]))
    write(tmp_path / "pairs.json", "[[0, 1], [2, 3]]")
    for name in ("array.npy", "pairs.json"):
        dialog = opened(editor, tmp_path / name)
        assert dialog.summary.text() == "2 rows → 2 points"
        assert not dialog.separator_box.isEnabled()
        assert dialog.preview.head.roles == ("x", "y")
        assert dialog.remark.text() == "Columns: x = column 1, y = column 2."
        press(dialog, "importTable")
        editor.settle()
        assert [point.position for point in editor.curve.points] == [(0, 1), (2, 3)]


@pytest.mark.usefixtures("drawings_read_here")
def test_a_file_is_read_by_its_content(editor, tmp_path):
    """PathWeaver's paths end as those of PathPlanner, and these may end as any JSON."""
    rows = "X,Y,Tangent X,Tangent Y\n1,2,2,0\n4,3.5,1.5,1.5\n"
    press(opened(editor, write(tmp_path / "left.path", rows)), "importTable")
    editor.settle()
    assert editor.status == "Imported left.path: 1 curve, 2 points, exact."
    assert [point.velocity for point in editor.curve.points] == [(2, 0), (1.5, 1.5)]
    first, second = '{"anchor":{"x":0,"y":0},"nextControl":{"x":1,"y":2}}', '{"anchor":{"x":3,"y":0},'
    path = write(tmp_path / "far.json", f'{{"waypoints":[{first},{second}"prevControl":{{"x":2,"y":1}}}}]}}')
    press(opened(editor, path, "importDrawingDialog"), "importDrawing")
    editor.settle()
    assert [point.velocity for point in editor.curve.points] == [(3, 6), (3, -3)]


def test_curves_are_imported_as_a_new_document(editor, tmp_path):
    dialog = opened(editor, write(tmp_path / "a.txt", "0 0\n1 1\n2 4\n"))
    choose(dialog.into, "A new document")
    press(dialog, "importTable")
    editor.settle()
    assert [curve.name for curve in editor.session.document.curves] == ["a"]
    assert editor.session.files.path is None
    assert not editor.session.files.is_modified, "its file still holds it"


def test_with_the_keyboard_alone(editor, tmp_path, monkeypatch):
    path = write(tmp_path / "a.csv", "1,2\n3,4\n5,9\n")
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([str(path)], ""))
    QTest.keyClick(editor.window, Qt.Key.Key_I, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()
    dialog = dialog_of(editor, "importTableDialog")
    settle(editor, dialog)
    choose(dialog.preview.head.boxes[0], "y")
    assert dialog.preview.head.roles == ("y", "ignore"), "a role is given away"
    assert dialog.problem.text() == "⚠ Choose the columns of x and y above the table."
    assert not dialog.ok.isEnabled()
    choose(dialog.preview.head.boxes[1], "x")
    settle(editor, dialog)
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    assert [point.position for point in editor.curve.points] == [(2, 1), (4, 3), (9, 5)]


def test_the_preview_keeps_the_power_of_ten_of_a_long_number(editor, tmp_path):
    long = "3.1400000000000000e-05"
    rows = f"{long};-0.12345678901234567;a note that goes on and on to its end\n2;1.5;b\n"
    dialog = opened(editor, write(tmp_path / "a.csv", rows))
    cell = [dialog.preview.item(0, column) for column in range(3)]
    assert [each.text() for each in cell[:2]] == ["3.14e-05", "-0.123457"]
    assert [each.toolTip() for each in cell[:2]] == [long, "-0.12345678901234567"]
    assert cell[2].text() == cell[2].toolTip() == "a note that goes on and on to its end"
    assert dialog.preview.textElideMode() == Qt.TextElideMode.ElideMiddle
    assert (dialog.preview.item(1, 1).text(), dialog.preview.item(1, 1).toolTip()) == ("1.5", "")
    metrics = dialog.preview.fontMetrics()
    wide = metrics.horizontalAdvance("-1.23457e-105")
    assert wide + 8 < min(dialog.preview.columnWidth(column) for column in range(3))
    dialog.close()
    dialog = opened(editor, write(tmp_path / "b.csv", "3,1400000000000000e-05;2\n1;2\n"))
    assert dialog.preview.item(0, 0).text() == "3,14e-05"
    dialog.close()
    dialog = opened(editor, write(tmp_path / "c.csv", f"{'9' * 400};1e99999999999;{'9' * 30_000}x\n"))
    assert dialog.preview.item(0, 0).text() == "9" * 400, "beyond all numbers it stays as it is"
    assert dialog.preview.item(0, 1).text() == "1e99999999999"


def test_tab_walks_through_the_dialog_in_reading_order(editor, tmp_path):
    dialog = opened(editor, write(tmp_path / "a.csv", "1,2\n3,4\n"))
    dialog.header_check.setFocus()
    walked = []
    for _ in range(4):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        walked.append(QApplication.focusWidget().objectName())
    assert walked == ["columnRole0", "columnRole1", "tablePreview", "tableThinning"]
    dialog.close()


@pytest.mark.usefixtures("drawings_read_here")
@pytest.mark.parametrize("name", ["importTableDialog", "importDrawingDialog", "exportDialog"])
def test_everything_to_press_or_type_into_has_a_name_and_a_tip(editor, tmp_path, name):
    if name == "exportDialog":
        editor.trigger("exportPicture")
        dialog = dialog_of(editor, name)
    else:
        content = SVG if name == "importDrawingDialog" else "1,2\n3,4\n"
        dialog = opened(editor, write(tmp_path / ("a.svg" if content == SVG else "a.csv"), content), name)
    found = [
        each
        for kind in (QAbstractButton, QComboBox, FieldEdit, QSpinBox)
        for each in dialog.findChildren(kind)
    ]
    # Parts of Qt's own widgets have no names.
    own = [each for each in found if not isinstance(each.parent(), QAbstractItemView)]
    assert len(own) > 2
    for each in own:
        assert each.objectName(), each
        assert each.toolTip(), each.objectName()
        assert each.accessibleName() or each.text(), each.objectName()
    dialog.close()


def test_escape_in_the_import_dialog_changes_nothing(editor, tmp_path):
    before, steps = editor.session.document, editor.session.undo_stack.count()
    dialog = opened(editor, write(tmp_path / "a.csv", "1,2\n3,4\n"))
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    editor.settle()
    assert editor.session.document is before
    assert editor.session.undo_stack.count() == steps
    assert dialog_of(editor, "importTableDialog") is None


def test_a_bad_row_is_marked_in_the_preview(editor, tmp_path):
    lines = [f"{i},{i * i}" for i in range(300)]
    lines[150] = "150,=cmd"
    dialog = opened(editor, write(tmp_path / "a.csv", "x,y\n" + "\n".join(lines)))
    assert dialog.problem.text() == "⚠ Row 152, column 2: “=cmd” is a formula; only numbers are read."
    assert not dialog.ok.isEnabled()
    table = dialog.preview
    last = table.rowCount() - 1
    assert table.verticalHeaderItem(last).text() == "152"
    assert table.item(last, 1).text() == "=cmd"
    assert table.item(last, 1).background().color() != table.item(last, 0).background().color()
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    assert dialog.isVisible(), "there is nothing to import"
    dialog.close()


def row_numbers(table):
    return [table.verticalHeaderItem(row).text() for row in range(table.rowCount())]


def marked(table):
    """Return the numbers of the rows with a coloured cell."""
    return [
        number
        for row, number in enumerate(row_numbers(table))
        if any(
            table.item(row, column).background().style() != Qt.BrushStyle.NoBrush
            for column in range(table.columnCount())
        )
    ]


def test_a_row_has_one_number_in_the_table_and_in_messages(editor, tmp_path):
    """Row 4 of the message was row 3 of the table, uncoloured, and once more "line 4" at its end."""
    text = "# made by hand\nx,y\n0,1\n\n1,2\nnan,3\n4,4\n4,4\n"
    dialog = opened(editor, write(tmp_path / "gap.csv", text))
    table = dialog.preview
    assert dialog.problem.text().startswith("⚠ Row 6, column 1: “nan”")
    assert row_numbers(table) == ["3", "5", "6", "7", "8"]
    assert marked(table) == ["6"]
    choose(dialog.missing_box, "Skip them")
    settle(editor, dialog)
    assert dialog.problem.text().startswith("Row 8 repeats the point of the previous row")
    assert row_numbers(table) == ["3", "5", "6", "7", "8"]
    assert marked(table) == []
    dialog.close()
    # Where the file has no lines, the rows of the table are counted.
    values = np.arange(200.0).reshape(100, 2)
    values[2, 1] = values[80, 1] = np.nan
    for first, shown in ((2, 50), (80, 51)):
        values[:first, 1] = 1.0
        np.save(tmp_path / "array.npy", values)
        dialog = opened(editor, tmp_path / "array.npy")
        table = dialog.preview
        assert dialog.problem.text().startswith(f"⚠ Row {first + 1}, column 2 is empty")
        assert table.rowCount() == shown
        assert marked(table) == [str(first + 1)]
        assert table.item(row_numbers(table).index(str(first + 1)), 0).text() == str(2 * first)
        dialog.close()


def test_a_lagrange_curve_through_thousands_of_rows_is_refused(editor, tmp_path):
    dialog = opened(editor, spiral(tmp_path / "spiral.csv", 900))
    choose(dialog.family_box, "Lagrange")
    settle(editor, dialog)
    assert dialog.problem.text().startswith(
        "⚠ A Lagrange curve can have at most 500 rows, not 900. Choose Hermite"
    )
    assert not dialog.ok.isEnabled()
    dialog.close()


def test_another_separator_is_read_anew(editor, tmp_path):
    dialog = opened(editor, write(tmp_path / "a.csv", "1,5\n2,5\n3,75\n"))
    assert dialog.preview.columnCount() == 2
    choose(dialog.separator_box, "Spaces")
    dialog.separator_box.activated.emit(3)
    settle(editor, dialog)
    assert dialog.preview.columnCount() == 1
    assert not dialog.ok.isEnabled()
    dialog.close()


def test_many_rows_are_thinned_out_unless_every_row_is_requested(editor, tmp_path):
    dialog = opened(editor, spiral(tmp_path / "spiral.csv", 5000))
    assert dialog.thinning_box.currentText() == "Fit a curve within"
    fitted = dialog._prepared
    assert fitted.points < 200
    assert fitted.deviation <= fitted.tolerance == pytest.approx(0.03, rel=0.5)
    assert f"5,000 rows → {fitted.points} points" in dialog.summary.text()
    edit = dialog.tolerance_edit
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "0.001")
    settle(editor, dialog)
    assert dialog._prepared.points > fitted.points
    assert dialog._prepared.tolerance == 0.001
    choose(dialog.thinning_box, "Keep corners within")
    settle(editor, dialog)
    choose(dialog.thinning_box, "Keep every row")
    settle(editor, dialog)
    assert dialog._prepared.points == 5000
    assert not dialog.tolerance_edit.isEnabled()
    dialog.close()


def test_noisy_rows_get_a_distance_that_leaves_few_enough(editor, tmp_path, monkeypatch):
    # The dialog first: its imports, should they be the first, must find the limit as it is.
    for name in (
        "features.import_export.import_table_dialog.MOST_POINTS",
        "exchange.table.thinning.MAX_POINTS",
    ):
        monkeypatch.setattr(f"app.{name}", 400)
    x, y = np.linspace(0, 1, 2_000), np.random.default_rng(3).uniform(-0.02, 0.02, 2_000)
    rows = "\n".join(map("{:.6f},{:.6f}".format, x.tolist(), y.tolist()))
    dialog = opened(editor, write(tmp_path / "noise.csv", rows))
    distance = dialog._prepared.tolerance
    assert distance > 0.001
    assert dialog.tolerance_edit.text() == f"{distance:g}"
    assert dialog.problem.text() == (
        f"The distance was increased to {distance:g}: 0.001 would leave more than 400 points."
    )
    assert dialog.ok.isEnabled()
    places = [each.pos() for each in (dialog.thinning_box, dialog.tolerance_edit, dialog.ok, dialog.preview)]
    choose(dialog.thinning_box, "Fit a curve within")
    edit = dialog.tolerance_edit
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "0.2")
    settle(editor, dialog)
    assert dialog.problem.text() == ""
    assert places == [
        each.pos() for each in (dialog.thinning_box, dialog.tolerance_edit, dialog.ok, dialog.preview)
    ]
    edit.selectAll()
    QTest.keyClicks(edit, "0.0001")
    settle(editor, dialog)
    assert "choose a larger distance than 0.0001" in dialog.problem.text(), "what was typed is not replaced"
    assert not dialog.ok.isEnabled()
    assert places[0] == dialog.thinning_box.pos()
    edit.selectAll()
    QTest.keyClick(edit, Qt.Key.Key_Delete)
    settle(editor, dialog)
    assert dialog._prepared.tolerance == distance
    press(dialog, "importTable")
    assert editor.curve.name == "noise"


@pytest.mark.parametrize("typed", ["0", "-1", "wide", "9**9**9"])
def test_an_invalid_distance_is_explained(editor, tmp_path, typed):
    dialog = opened(editor, spiral(tmp_path / "spiral.csv", 1500))
    edit = dialog.tolerance_edit
    retype(edit, typed)
    settle(editor, dialog)
    assert dialog.isVisible()
    assert dialog.problem.text()
    assert not dialog.ok.isEnabled()
    dialog.close()


def test_a_table_of_several_curves(editor, tmp_path):
    curves = (make_curve([(0, 0), (1, 2), (2, 0)], name="One"), make_curve([(5, 5), (6, 7)], name="Two"))
    export(Document(curves), tmp_path / "all.points.csv")
    dialog = opened(editor, tmp_path / "all.points.csv")
    assert dialog.preview.head.roles == ("curve", "family", "t", "x", "y")
    assert dialog.summary.text() == "5 rows → 5 points in 2 curves"
    press(dialog, "importTable")
    assert [curve.name for curve in editor.session.document.curves[-2:]] == ["One", "Two"]
    assert editor.session.active_index == len(editor.session.document.curves) - 2


@pytest.mark.usefixtures("drawings_read_here")
def test_the_dialog_shows_the_content_and_the_losses_of_a_drawing(editor, tmp_path):
    dialog = opened(editor, write(tmp_path / "a.svg", SVG), "importDrawingDialog")
    assert dialog.summary.text() == "2 curves with 4 points, exact."
    assert dialog.remarks.text() == "1 text left out: hi."
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    editor.settle()
    first, second = editor.session.document.curves[-2:]
    assert (first.name, first.style.stroke, second.name) == ("a", "#d55e00", "b")
    assert "Imported a.svg: 2 curves, 4 points, exact." in editor.status
    editor.trigger("undo")
    assert len(editor.session.document.curves) == 1


GROUPS = (
    '<svg xmlns="http://www.w3.org/2000/svg"><g id="figure_1"><g id="patch_1"><path d="M0 0H9V9Z"/></g>'
    '<g id="axes_1"><path d="M0 1H9"/><g id="axis"><defs><path id="tick" d="M0 0V1"/></defs>'
    '<use href="#tick" x="1"/><use href="#tick" x="2"/></g>'
    '<g id="line2d_1"><path d="M0 0C1 1 2 1 3 0"/></g></g></g></svg>'
)


def check_box(editor, tree, *names):
    """Click the box of a group."""
    item = None
    for name in names:
        around = [item.child(i) for i in range(item.childCount())] if item else []
        around = around or [tree.topLevelItem(i) for i in range(tree.topLevelItemCount())]
        (item,) = [each for each in around if each.text(0) == name]
    tree.scrollToItem(item)
    place = tree.visualItemRect(item)
    QTest.mouseClick(
        tree.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(place.left() + 10, place.center().y())
    )
    editor.settle()


@pytest.mark.usefixtures("drawings_read_here")
def test_groups_of_a_drawing_are_selected(editor, tmp_path):
    """All 167 curves of a plot came in, glyphs and ticks and all, with no choice."""
    path = write(tmp_path / "plot.svg", GROUPS)
    dialog = opened(editor, path, "importDrawingDialog")
    assert dialog.summary.text().startswith("5 curves with ")
    tree = dialog.groups
    assert tree.topLevelItem(0).text(1) == "5 curves"
    check_box(editor, tree, "figure_1")
    assert dialog.summary.text() == "Select at least one of 5 curves."
    assert not dialog.ok.isEnabled()
    check_box(editor, tree, "figure_1", "axes_1", "line2d_1")
    assert dialog.summary.text() == "1 of 5 curves with 2 points, exact."
    assert tree.topLevelItem(0).checkState(0) == Qt.CheckState.PartiallyChecked
    check_box(editor, tree, "figure_1", "axes_1", "Path 6")
    before = len(editor.session.document.curves)
    press(dialog, "importDrawing")
    editor.settle()
    assert [len(curve.points) for curve in editor.session.document.curves[before:]] == [2, 2]
    assert editor.status == "Imported plot.svg: 2 curves, 4 points, exact."
    dialog = opened(editor, write(tmp_path / "flat.svg", SVG), "importDrawingDialog")
    tree = dialog.groups
    names = [tree.topLevelItem(row).text(0) for row in range(tree.topLevelItemCount())]
    assert names == ["a", "b"]
    check_box(editor, tree, "a")
    assert dialog.summary.text() == "1 of 2 curves with 2 points, exact."
    dialog.close()
    alone = SVG.replace('<path id="b" d="M0 5H9"/>', "")
    dialog = opened(editor, write(tmp_path / "alone.svg", alone), "importDrawingDialog")
    assert dialog.groups is None
    dialog.close()


@pytest.mark.usefixtures("drawings_read_here")
def test_a_written_svg_is_imported_as_the_same_curves(editor, tmp_path):
    editor.window.commands[ExportCommands].export(tmp_path / "out.svg")
    editor.wait_for_work()
    press(opened(editor, tmp_path / "out.svg", "importDrawingDialog"), "importDrawing")
    original, copy = (view_of(curve).curve for curve in editor.session.document.curves)
    size = np.ptp(original.points, axis=0).max()
    ends = [curve.evaluate(np.array(curve.domain)) for curve in (original, copy)]
    assert np.abs(ends[0] - ends[1]).max() < 1e-5 * size


def test_another_document_is_imported(editor, tmp_path):
    save(tmp_path / "other.curve.json", Document((make_curve([(0, 0), (1, 1)], name="Guest"),)))
    dialog = opened(editor, tmp_path / "other.curve.json", "importDrawingDialog")
    press(dialog, "importDrawing")
    assert [curve.name for curve in editor.session.document.curves][-1] == "Guest"
    assert editor.session.files.path is None


UNREADABLE = (
    ("a.svg", "<!DOCTYPE svg [<!ENTITY a SYSTEM 'b'>]><svg/>", "delete everything from “<!DOCTYPE” to “]>”"),
    (
        "b.svg",
        '<?xml version="1.0"?>\n<!DOCTYPE svg [<!ENTITY % a "b">]>\n<svg/>',
        "delete everything from “<!DOCTYPE” to “]>” in a text editor",
    ),
    ("a.dxf", "  0\nSECTION\n", "it is incomplete"),
    ("a.csv", "", "The file is empty"),
    ("a.json", "{", "a.json was not imported. It is not JSON; the file ends too early."),
    (
        "a.PDF",
        "%PDF-1.5",
        "a.PDF was not imported. It is a PDF, which Curvebench cannot read; open it in Inkscape",
    ),
    ("a.ai", "%PDF-1.5", "It is an Illustrator drawing, which Curvebench cannot read; open it in Inkscape"),
    ("a.gif", "GIF89a", "has no known file extension"),
)
"""Names, contents and reasons."""


@pytest.mark.usefixtures("drawings_read_here")
def test_unreadable_files_are_explained(editor, tmp_path):
    before = editor.session.document
    for name, content, reason in UNREADABLE:
        editor.window.commands[ImportCommands].import_files([write(tmp_path / name, content)])
        editor.wait_for_work()
        assert editor.message.count(name) == 1, editor.message
        assert reason in editor.message
        assert editor.session.document is before, name


def test_a_missing_file_is_refused(editor, tmp_path):
    editor.window.commands[ImportCommands].import_files([tmp_path / "gone.csv"])
    editor.wait_for_work()
    assert "gone.csv" in editor.message


@pytest.mark.usefixtures("drawings_read_here")
@pytest.mark.parametrize("name", ["a.svg", "a.csv"])
def test_a_dropped_file_is_imported(editor, tmp_path, name):
    path = write(tmp_path / name, SVG if name == "a.svg" else "1,2\n3,4\n")
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    action, keys = Qt.DropAction.CopyAction, Qt.KeyboardModifier.NoModifier
    left = Qt.MouseButton.LeftButton
    QApplication.sendEvent(editor.window, QDragEnterEvent(QPoint(9, 9), action, data, left, keys))
    QApplication.sendEvent(editor.window, QDropEvent(QPointF(9, 9), action, data, left, keys))
    editor.wait_for_work()
    dialog = dialog_of(editor, "importDrawingDialog" if name == "a.svg" else "importTableDialog")
    assert dialog.isVisible()
    dialog.close()


@pytest.mark.usefixtures("drawings_read_here")
@pytest.mark.parametrize("name", ["a.svg", "a.csv"])
def test_a_document_opened_meanwhile_gets_no_imported_curves(editor, tmp_path, name):
    path = write(tmp_path / name, SVG if name == "a.svg" else "1,2\n3,4\n")
    kind = "importDrawingDialog" if name == "a.svg" else "importTableDialog"
    opened(editor, path, kind)
    editor.new()
    assert dialog_of(editor, kind) is None
    assert [len(curve.points) for curve in editor.session.document.curves] == [0]
    assert not editor.session.files.is_modified
    assert editor.status == f"{name} was not imported because another document was opened in the meantime."
    # And one that is read for a document that has gone.
    editor.window.commands[ImportCommands].import_files([path])
    editor.new()
    editor.wait_for_work()
    editor.settle()
    assert not [each for each in editor.window.findChildren(QDialog, kind) if each.isVisible()]
    dialog = opened(editor, path, kind)
    choose(dialog.into, "A new document")
    press(dialog, "importDrawing" if name == "a.svg" else "importTable")
    editor.settle()
    assert sum(len(curve.points) for curve in editor.session.document.curves) >= 2
    assert editor.status.startswith(f"Imported {name}")
    editor.session.files.give_up_changes()


# What takes long


@pytest.fixture
def busy(tmp_path):
    """A drawing that takes seconds to read."""
    return write(
        tmp_path / "busy.svg",
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0' + "C1 1 2 2 3 3" * 80_000 + '"/></svg>',
    )


def visible_bar(editor):
    def bar():
        return editor.window.findChild(object, "jobBar")

    until(lambda: bar() is not None and bar().isVisible())
    return bar()


def test_long_work_shows_its_progress_and_can_be_stopped(editor, busy):
    before, height = editor.session.document, editor.window.canvas.height()
    editor.window.commands[ImportCommands].import_files([busy])
    assert editor.window.context.work.jobs.is_busy
    bar = visible_bar(editor)
    assert bar.text == "Reading busy.svg"
    # It is no higher than what stands beside it: the drawing stays where it is (it lost two pixels).
    editor.settle()
    assert editor.window.canvas.height() == height
    until(lambda: bar.bar.value() > 0)
    # Meanwhile the window works on.
    editor.select_point(0)
    assert editor.session.selected.points == {0}
    QTest.mouseClick(bar.button, Qt.MouseButton.LeftButton)
    assert not editor.window.context.work.jobs.is_busy
    assert not bar.isVisible()
    assert editor.status == "Reading busy.svg was stopped. Nothing has changed."
    assert editor.session.document is before
    assert not editor.action("cancelWork").isEnabled()


def test_a_second_import_is_refused_while_one_runs(editor, busy, tmp_path, monkeypatch):
    editor.window.commands[ImportCommands].import_files([busy])
    chosen = [str(tmp_path / "other.csv")]
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (chosen, ""))
    editor.trigger("importFile")
    assert editor.status == "Reading busy.svg is still running. Stop it first."
    visible_bar(editor)
    QTest.keyClick(editor.window, Qt.Key.Key_Period, Qt.KeyboardModifier.ControlModifier)
    assert not editor.window.context.work.jobs.is_busy
    # And the next begins at once.
    write(tmp_path / "other.csv", "1,2\n3,4\n")
    opened(editor, tmp_path / "other.csv").close()


def test_an_export_that_is_stopped_leaves_the_old_file(editor, tmp_path):
    old = write(tmp_path / "out.csv", "mine")
    editor.window.commands[ExportCommands].export(old, Options(format_options={"samples": 100_000}))
    assert editor.window.context.work.jobs.is_busy
    visible_bar(editor)
    editor.trigger("cancelWork")
    assert not editor.window.context.work.jobs.is_busy
    assert "Nothing has changed" in editor.status
    until(lambda: not stopped_tasks())
    assert old.read_text(encoding="utf-8") == "mine"
    assert [each.name for each in tmp_path.iterdir()] == ["out.csv"]


def test_closing_the_window_drops_the_work(new_editor, busy):
    editor = new_editor
    editor.window.commands[ImportCommands].import_files([busy])
    visible_bar(editor)
    editor.session.files.give_up_changes()
    task = editor.window.context.work.jobs._task
    assert editor.window.close()
    assert not editor.window.context.work.jobs.is_busy
    until(lambda: not stopped_tasks())
    assert not task.thread.is_alive()
    assert task.result is task.problem is None


@contextmanager
def calls_in_turns():
    """Yield how many functions this thread calls between one turn of its event loop and the next."""
    turns = [0]

    def note(_frame, event, _argument):
        turns[-1] += event in ("call", "c_call")

    timer = QTimer(interval=0)
    timer.timeout.connect(lambda: turns.append(0))
    timer.start()
    sys.setprofile(note)
    yield turns
    sys.setprofile(None)
    timer.stop()


def test_closing_the_dialog_of_a_table_drops_the_work(editor, tmp_path):
    editor.window.commands[ImportCommands].import_files([spiral(tmp_path / "spiral.csv", 200_000)])
    editor.wait_for_work()
    dialog = dialog_of(editor, "importTableDialog")
    assert dialog.jobs.is_busy
    assert not dialog.ok.isEnabled()
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    editor.settle()
    assert dialog_of(editor, "importTableDialog") is None
    assert len(editor.session.document.curves) == 1


def test_very_many_rows_never_block_the_window(editor, tmp_path, monkeypatch):
    """What goes through all rows does so in another thread, and no turn of the window's own does as much."""
    rows, threads = 200_000, {}
    through_all = ((TableSource, "__init__"), (text._Collector, "add"), (thinning, "_distances"))
    for owner, name in through_all:
        work, threads[name] = getattr(owner, name), set()

        def recording(*arguments, work=work, seen=threads[name]):
            seen.add(threading.current_thread())
            return work(*arguments)

        monkeypatch.setattr(owner, name, recording)
    path = spiral(tmp_path / "many.csv", rows)
    with calls_in_turns() as turns:
        editor.window.commands[ImportCommands].import_files([path])
        editor.wait_for_work()
        dialog = dialog_of(editor, "importTableDialog")
        settle(editor, dialog)
        prepared = dialog._prepared
        press(dialog, "importTable")
        editor.settle()
    assert prepared.rows == rows
    assert len(editor.curve.points) == prepared.points < 1000
    assert math.isfinite(prepared.deviation)
    for name, used in threads.items():
        assert used, name
        assert threading.current_thread() not in used, name
    # The most is to show the curve, whatever it comes from.
    assert max(turns) < rows / 2
