"""A drawing of another program that is open: names, the question about changes, the style of what is new."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QLabel, QLineEdit, QMessageBox, QUndoView

from app.document.model import Document, make_curve
from app.document.style import PLAIN_STYLE, LineCap, LineJoin, Style
from app.families import HERMITE

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 40 40">'
    '<path id="r1" d="M2 2L10 2L10 10Z" fill="#00ff00"/>'
    '<path id="r2" d="M20 20L30 20L30 30Z" fill="#ff0000" stroke="#0000ff" stroke-width="1"/></svg>'
)


@pytest.fixture
def drawing(open_drawing):
    """An SVG opened as a document; none of its two triangles is chosen."""
    editor = open_drawing(DRAWING)
    assert [curve.name for curve in editor.session.document.curves] == ["r1", "r2"]
    assert not editor.session.selected.marked
    return editor


def test_its_history_begins_with_the_name_of_its_file(drawing):
    model = drawing.window.findChild(QUndoView, "historyView").model()
    assert model.data(model.index(0, 0)) == "Opened in.svg"


def test_the_transform_panel_shows_names_as_they_are(drawing):
    drawing.show_dock("transformDock")
    label = drawing.window.findChild(QLabel, "transformWhat")
    drawing.session.selected.choose({0})
    assert label.text() == "r1"
    drawing.session.selected.choose({0, 1})
    assert label.text() == "2 objects"
    drawing.session.selected.activate(0)
    drawing.settle()
    assert label.text() == "All 3 points"


def test_the_question_about_changes_names_its_file(drawing):
    drawing.session.selected.choose({0})
    drawing.trigger("deleteSelection")
    asked = []

    def answer():
        box = drawing.window.findChild(QMessageBox, "saveChanges")
        asked.append((box.text(), box.informativeText()))
        box.button(QMessageBox.StandardButton.Cancel).click()

    QTimer.singleShot(0, answer)
    drawing.action("newDocument").trigger()
    assert asked == [("Save the changes to in.svg?", "Without saving they are lost.")]


# The style of what is drawn next


def drawn_with(editor, tool):
    """Return the style of a curve drawn with a tool."""
    editor.trigger(tool)
    if tool == "addTool":
        editor.click((6, 15))
    else:
        editor.drag((6, 15), (12, 20))
    editor.wait_for_rest()
    style = editor.session.document.curves[-1].style
    editor.session.undo_stack.undo()
    editor.trigger("selectTool")
    return style


LINE = Style(stroke="#000000", cap=LineCap.BUTT, join=LineJoin.MITER)
TOOLS = {"addTool": LINE, "pencilTool": LINE, "rectangleTool": None}
"""With the style that is a tool's own in drawings; None where it is the last one."""


@pytest.mark.parametrize(("tool", "own"), TOOLS.items())
def test_what_is_drawn_takes_no_colour_of_one_that_nobody_chose(drawing, tool, own):
    """It took that of the first object of the file."""
    before = drawing.session.document.curves
    assert drawn_with(drawing, tool) == replace(LINE, width=0.3)
    drawing.escape()
    drawing.escape()
    first, last = (replace(each.style, width=each.style.width or 0.3) for each in before)
    if own is not None:
        first = last = replace(own, width=0.3)
    # What was chosen last says how the next shape looks, also when it is let go, and gone.
    drawing.click((28, 17))
    assert drawing.session.selected.chosen == {1}
    drawing.escape()
    assert not drawing.session.selected.marked
    assert drawn_with(drawing, tool) == last
    drawing.session.selected.choose({1})
    drawing.trigger("deleteSelection")
    assert drawn_with(drawing, tool) == last
    drawing.session.selected.choose({0})
    assert drawn_with(drawing, tool) == first


def test_what_is_pasted_lends_its_look_to_nothing_until_it_is_chosen_or_given_one(drawing):
    """A pasted icon left its colours to all that was drawn after it."""
    red = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M1 1H4V4Z" fill="#ff0000" stroke="none"/></svg>'
    drawing.session.selected.choose({1})
    own = drawing.session.active_curve.style
    QGuiApplication.clipboard().setText(red)
    drawing.trigger("pastePoints")
    drawing.wait_for_rest()
    icon = drawing.session.document.curves[-1]
    assert icon.style.fill == "#ff0000"
    assert drawing.session.selected.chosen == {2}
    assert drawing.session.model.style == own
    # Nor where it is put.
    drawing.key(Qt.Key.Key_Right)
    assert drawing.session.document.curves[-1].points != icon.points
    assert drawing.session.model.style == own
    # What is set is meant, and nothing else of it.
    drawing.show_dock("styleDock")
    field = drawing.window.findChild(QLineEdit, "fillPaintHex")
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "#00aa00")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert drawing.session.document.curves[-1].style.fill == "#00aa00"
    assert drawing.session.model.style == replace(own, fill="#00aa00")
    drawing.session.selected.choose(())
    assert drawn_with(drawing, "rectangleTool") == replace(own, fill="#00aa00")
    drawing.session.selected.choose({2})
    assert drawing.session.model.style.stroke == "none"


@pytest.mark.parametrize("lets_go", [False, True])
def test_a_line_that_got_wider_under_scaling_makes_no_other_one_wider(drawing, lets_go):
    drawing.session.selected.choose({1})
    drawing.hover((25, 15))
    drawing.trigger("scaleSelection")
    drawing.type_amount("2")
    drawing.key(Qt.Key.Key_Return)
    assert drawing.session.document.curves[1].style.width == 2.0
    if lets_go:
        drawing.session.selected.choose(())
    assert drawing.session.model.style.width == 1.0
    assert drawn_with(drawing, "rectangleTool").width == 1.0


def test_nor_of_one_that_nobody_can_choose(editor):
    """The active curve of a document that begins is locked: it is let go before it says anything."""
    curve = make_curve([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)], family=HERMITE)
    locked = replace(curve, style=Style(fill="#1d3557"), locked=True, closed=True)
    editor.session.new()
    editor.session.selected.activate(0)
    editor.session.files.replace(Document((locked,)), None)
    assert not editor.session.selected.marked
    assert editor.session.model.style == PLAIN_STYLE


def test_all_of_the_page_is_in_sight_and_of_the_curves_and_fit_shows_the_curves_alone(drawing):
    def sees(x, y):
        left, low, right, high = drawing.window.canvas.pixel_map.box
        return left < x < right and low < y < high

    assert sees(0, 0)
    assert sees(40, 40)
    drawing.window.resize(drawing.window.width() - 120, drawing.window.height())
    drawing.settle()
    assert sees(0, 0)
    assert sees(40, 40)
    drawing.trigger("fitView")
    assert not sees(40, 0)


def test_saving_proposes_drawing_and_forms_are_named_by_what_they_are(drawing, monkeypatch):
    drawing.session.files.give_up_changes()
    drawing.trigger("newDrawing")
    for tool in ("rectangleTool", "rectangleTool", "starTool", "ellipseTool"):
        drawing.trigger(tool)
        drawing.drag((20, 20), (90, 90))
    names = [curve.name for curve in drawing.session.document.curves]
    assert names == ["Rectangle 1", "Rectangle 2", "Star 1", "Ellipse 1"]
    drawing.session.selected.choose({0, 1})
    drawing.trigger("combineCurves")
    shape = drawing.session.document.curves[0].shape
    drawing.session.selected.choose({0})
    drawing.trigger("newCurve")
    taken = {shape, *(curve.name for curve in drawing.session.document.curves[:-1])}
    assert drawing.session.document.curves[-1].name not in taken
    proposed = []

    def ask(_window, _title, start, _kinds, kind):
        proposed.append((Path(start).name, kind))
        return "", ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", ask)
    drawing.trigger("saveDocumentAs")
    assert proposed == [("Drawing.svg", "SVG drawings (*.svg)")]


def test_copied_points_are_a_path_of_their_own_and_one_point_is_none(drawing):
    """Appended to the curve that they came from, they left it without parameters."""
    drawing.window.canvas.setFocus()
    before = drawing.session.document
    drawing.session.selected.activate(0)
    drawing.select([2])
    drawing.trigger("copyPoints")
    drawing.trigger("pastePoints")
    assert drawing.session.document is before
    assert drawing.status == "One point is no path: copy two of a curve, or more, to paste them."
    drawing.select([0, 1])
    drawing.trigger("copyPoints")
    drawing.trigger("pasteInPlace")
    first, _, last = drawing.session.document.curves
    assert first == before.curves[0]
    assert [point.position for point in last.points] == [each.position for each in first.points[:2]]
    assert (last.is_closed, drawing.session.selected.chosen) == (False, {2})
    assert drawing.session.views[2].is_current
