"""Texts and pictures of an opened drawing are objects among the curves: chosen, moved, recoloured."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit, QToolButton

from app.appearance.colours import CURVE_COLOURS
from app.document.contents import corners_of, is_content
from app.document.edits import move_points
from app.document.model import Parametrization
from app.document.several_curves import with_appearance
from app.document.style_edits import with_style
from app.features.text.commands import TextCommands
from app.qt import contents
from app.widgets.paint_field import PaintField
from tests.effort import noted_calls
from tests.gui.pixels import is_colour
from tests.gui.test_text import finish, press

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
    '<path id="area" d="M5 5H60V55H5Z" fill="#ffffee"/>'
    '<text id="t" x="10" y="30" font-size="20" font-weight="900" fill="#ff0000">MMM</text>'
    '<path id="line" d="M10 50L90 50" stroke="#0000ff"/></svg>'
)
AREA, TEXT, LINE = range(3)
RED = QColor("#ff0000")


@pytest.fixture
def drawing(open_drawing):
    """An SVG opened as a document."""
    return open_drawing(DRAWING)


def red(editor):
    """Return the box of what is red on the canvas, in the plane; None where nothing is."""
    canvas = editor.window.context.central.canvas
    viewport = canvas.viewport()
    found = is_colour(viewport.grab().toImage().scaled(viewport.size() * 1 or QSize()), RED)
    if not found.any():
        return None
    rows, columns = np.nonzero(found)
    origin, shown = canvas.camera.origin, canvas.pixel_map
    left, top = shown.plane(columns.min() - origin.x(), rows.min() - origin.y())
    right, bottom = shown.plane(columns.max() + 1 - origin.x(), rows.max() + 1 - origin.y())
    return np.array([left, bottom, right, top])


def frame(editor):
    """Return the box of the frame of the text."""
    corners = corners_of(editor.session.document.curves[TEXT])
    return np.array([*np.min(corners, axis=0), *np.max(corners, axis=0)])


def test_a_text_is_seen_in_its_frame_and_hidden_as_a_curve_is(drawing):
    before = red(drawing)
    shown = drawing.window.context.central.canvas.pixel_map
    # On the page, which hangs at the lower left: the baseline lies 30 mm above that.
    assert before[:2] == pytest.approx([11, 30], abs=1 + 2 / shown.sx)
    assert frame(drawing) == pytest.approx(before, abs=0.1 + 2 / shown.sx)
    drawing.session.change("Hide", lambda now: with_appearance(now, {TEXT}, visible=False))
    assert red(drawing) is None
    drawing.trigger("undo")
    assert red(drawing) == pytest.approx(before)


def test_a_drag_beside_it_measures_and_paints_no_letter(drawing, monkeypatch):
    drawing.session.selected.activate(LINE)
    drawing.settle()
    red(drawing)
    painted = noted_calls(monkeypatch, contents, "painted_letters")
    steps = [(10 + step, 12) for step in range(1, 6)]
    drawing.press((10, 10))
    for step in steps:
        drawing.move(step)
        red(drawing)
    drawing.release(steps[-1])
    assert drawing.session.document.curves[LINE].points[0].x != 10.0
    assert painted == []


def test_it_is_chosen_and_dragged_and_nudged_and_deleted_with_curves(drawing):
    session = drawing.session
    begun, home = session.document, frame(drawing)
    drawing.click((15, 35))
    assert session.selected.chosen == {TEXT}
    drawing.click((75, 10), keys=Qt.KeyboardModifier.ShiftModifier)
    assert session.selected.chosen == {TEXT, LINE}
    assert drawing.status == "2 objects chosen."
    drawing.press((15, 35))
    drawing.move((20, 39))
    assert frame(drawing)[:2] == pytest.approx(np.add(home[:2], (5, 4)), abs=0.3)
    assert red(drawing)[:2] == pytest.approx([16, 34], abs=1.5)
    drawing.key(Qt.Key.Key_Escape)
    drawing.release((20, 39))
    assert session.document is begun
    drawing.drag((15, 35), (20, 39))
    assert session.document.curves[LINE].points[0].x > begun.curves[LINE].points[0].x
    there = frame(drawing)
    drawing.key(Qt.Key.Key_Right)
    assert frame(drawing)[0] > there[0]
    drawing.trigger("deleteSelection")
    assert [each.name for each in session.document.curves] == ["area"]
    for _ in range(3):
        drawing.trigger("undo")
    assert session.document == begun
    assert not session.undo_stack.canUndo()


def test_it_is_copied_duplicated_cloned_grouped_and_put_behind(drawing):
    session = drawing.session
    session.selected.choose({TEXT})
    drawing.trigger("copyPoints")
    for action in ("pastePoints", "duplicateSelection", "clone"):
        count = len(session.document.curves)
        drawing.trigger(action)
        drawing.wait_for_work()
        assert len(session.document.curves) == count + 1, action
        session.selected.choose({TEXT})
    assert sum(map(is_content, session.document.curves)) == 4
    drawing.trigger("lowerToBottom")
    assert session.document.curves[0].name == "MMM"
    session.selected.choose({0, len(session.document.curves) - 1})
    drawing.trigger("groupCurves")
    assert len({curve.groups for curve in session.document.curves if curve.groups}) == 1


def test_its_points_are_not_edited_and_its_frame_stays_one(drawing):
    session = drawing.session
    begun = session.document
    session.selected.activate(TEXT)
    assert not session.selected.is_editing
    assert session.selected.chosen == {TEXT}
    session.selected.choose({TEXT, LINE})
    session.selected.edit_chosen()
    assert session.selected.curves == {LINE}
    torn = session.change("Open", lambda now: now.with_curve(TEXT, replace(now.curves[TEXT], closed=False)))
    assert torn.refusal == "“MMM” is a text: Object to Path makes outlines of it."
    assert not session.preview(move_points(begun, TEXT, [0], (1.0, 0.0)))
    assert session.document is begun


def test_a_style_is_that_of_its_letters(drawing):
    session = drawing.session
    session.selected.choose({TEXT})
    session.change("Blue", lambda now: with_style(now, {TEXT}, fill="#0000ff"))
    assert red(drawing) is None


def test_it_goes_and_comes_back_with_the_document(drawing, tmp_path):
    curves = drawing.session.document.curves
    drawing.session.save(tmp_path / "a.curve.json")
    drawing.session.new()
    drawing.settle()
    assert red(drawing) is None
    drawing.session.open(tmp_path / "a.curve.json")
    drawing.settle()
    assert drawing.session.document.curves == curves
    drawing.trigger("fitView")
    assert red(drawing) is not None


def test_object_to_path_makes_outlines_of_its_letters_where_they_are(drawing):
    session = drawing.session
    session.selected.choose({TEXT})
    before = red(drawing)
    drawing.trigger("objectToPath")
    assert [curve.form for curve in session.document.curves] == [None] * 5
    assert [curve.groups for curve in session.document.curves[1:4]] == [("MMM",)] * 3
    assert session.selected.chosen == {1, 2, 3}
    assert red(drawing) == pytest.approx(before, abs=0.3)
    # They are paths now, and can be combined.
    drawing.trigger("pathUnion")
    drawing.wait_for_work()
    drawing.trigger("undo")
    drawing.trigger("undo")
    assert session.document.curves[TEXT].form.noun == "text"


def test_what_wants_an_outline_says_that_it_has_none(drawing):
    session = drawing.session
    begun = session.document
    for action in ("pathUnion", "strokeToPath"):
        session.selected.choose({AREA, TEXT})
        drawing.trigger(action)
        drawing.wait_for_work()
        assert session.document is begun
    session.selected.choose({TEXT, LINE})
    drawing.trigger("combineCurves")
    assert session.document is begun


def test_a_double_click_edits_its_words_and_it_stays_a_text(drawing):
    """Letters keep their own fonts and colours, other lines their places."""
    session = drawing.session
    session.change("Runs", lambda now: with_style(now, {TEXT}, opacity=0.5))
    begun, before = session.document, frame(drawing)
    field = drawing.window.commands[TextCommands].field
    drawing.window.activateWindow()
    drawing.click((15, 35))
    drawing.double_click((15, 35))
    assert field.isVisible()
    assert field.text == "MMM"
    field.words.setPlainText("MM\nm")
    curve = session.document.curves[TEXT]
    assert [(line.words, line.x) for line in curve.form.lines] == [("MM", 10.0), ("m", 10.0)]
    assert curve.form.lines[1].runs[0].weight == 900.0
    assert curve.style == begun.curves[TEXT].style
    assert curve.name == "MM m"
    assert frame(drawing)[1] < before[1]
    assert frame(drawing)[2] < before[2]
    finish(drawing)
    assert session.undo_stack.undoText() == "Edit Text “MM m”"
    assert session.selected.chosen == {TEXT}
    drawing.trigger("undo")
    assert session.document == begun
    # With the tool for texts a click does so. Nothing changed, no step.
    drawing.trigger("textTool")
    drawing.click((15, 35))
    assert field.text == "MMM"
    press(drawing, Qt.Key.Key_Escape)
    drawing.trigger("selectTool")
    session.selected.choose({TEXT})
    count = session.undo_stack.index()
    drawing.trigger("editText")
    finish(drawing)
    assert session.undo_stack.index() == count
    assert session.document == begun


def test_what_is_drawn_next_is_not_like_a_text(drawing):
    """A line in the style of a picture would not be seen, and its rules are nobody's choice."""
    session = drawing.session
    session.selected.choose({LINE})
    session.selected.choose({TEXT})
    assert session.model.style.stroke == "#0000ff"
    assert session.model.form is None
    assert session.meant_view is None
    drawing.trigger("addTool")
    drawing.click((70, 50))
    new = session.active_curve
    assert new.parametrization == Parametrization()
    assert new.form is None


def runs_of(editor, place=TEXT):
    """Return words, weight, slant and size of each run of a text, line by line."""
    lines = editor.session.document.curves[place].form.lines
    return [[(run.words, run.weight, run.italic, run.size) for run in line.runs] for line in lines]


def choose_letters(field, start, count):
    """Choose letters with the keys."""
    field.words.setFocus()
    QTest.keyClick(field.words, Qt.Key.Key_Home, Qt.KeyboardModifier.ControlModifier)
    for _ in range(start):
        QTest.keyClick(field.words, Qt.Key.Key_Right)
    for _ in range(count):
        QTest.keyClick(field.words, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)


RUNS = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
    '<text id="t" x="10" y="30" font-size="10" font-family="Curvebench Blocks">plain '
    '<tspan dy="-4" font-weight="700" fill="#ff0000">raised</tspan> on</text></svg>'
)


@pytest.fixture
def writing(open_drawing):
    """A text of several runs, whose words are edited."""
    editor = open_drawing(RUNS)
    editor.window.activateWindow()
    editor.session.selected.choose({0})
    editor.trigger("editText")
    yield editor, editor.window.commands[TextCommands].field
    if editor.window.commands[TextCommands].field.isVisible():
        press(editor, Qt.Key.Key_Escape)


def test_bold_italic_and_size_are_of_the_chosen_letters_live_in_one_step(writing):
    editor, field = writing
    begun, steps = editor.session.document, editor.session.undo_stack.index()
    choose_letters(field, 8, 2)
    assert field.bold.isChecked()
    press(editor, Qt.Key.Key_I, Qt.KeyboardModifier.ControlModifier)
    assert runs_of(editor, 0) == [[
        ("plain ", 400, False, 10), ("ra", 700, False, 10), ("is", 700, True, 10), ("ed", 700, False, 10),
        (" on", 400, False, 10),
    ]]  # fmt: skip
    runs = editor.session.document.curves[0].form.lines[0].runs
    # It is raised once, and in one colour still.
    assert [run.down for run in runs] == [0, -4, 0, 0, 0]
    assert {run.paint and run.paint.fill for run in runs[1:4]} == {"#ff0000"}
    QTest.mouseClick(field.bold, Qt.MouseButton.LeftButton)
    assert runs_of(editor, 0)[0][2] == ("is", 400, True, 10)
    field.size_box.edit.setFocus()
    field.size_box.edit.selectAll()
    QTest.keyClicks(field.size_box.edit, "20")
    press(editor, Qt.Key.Key_Return)
    assert runs_of(editor, 0)[0][2] == ("is", 400, True, pytest.approx(20))
    assert field.words.textCursor().selectedText() == "is"
    # What is typed behind it is as it is.
    choose_letters(field, 10, 0)
    QTest.keyClicks(field.words, "X")
    assert runs_of(editor, 0)[0][2:4] == [("isX", 400, True, pytest.approx(20)), ("ed", 700, False, 10)]
    finish(editor)
    assert editor.session.undo_stack.index() == steps + 1
    editor.trigger("undo")
    assert editor.session.document == begun


def test_chosen_letters_are_underlined_by_a_key_and_struck_through_by_a_button(writing):
    editor, field = writing
    choose_letters(field, 6, 6)
    press(editor, Qt.Key.Key_U, Qt.KeyboardModifier.ControlModifier)
    QTest.mouseClick(field.strike, Qt.MouseButton.LeftButton)
    assert field.underline.isChecked()
    choose_letters(field, 9, 3)
    QTest.mouseClick(field.strike, Qt.MouseButton.LeftButton)
    runs = editor.session.document.curves[0].form.lines[0].runs
    assert [(run.words, run.underline, run.strike) for run in runs] == [
        ("plain ", False, False), ("rai", True, True), ("sed", True, False), (" on", False, False)
    ]  # fmt: skip
    choose_letters(field, 0, 3)
    assert not field.underline.isChecked()
    finish(editor)
    editor.trigger("objectToPath")
    names = [curve.name for curve in editor.session.document.curves]
    assert [name for name in names if name[:4] in ("unde", "stri")] == ["underline", "strike", "underline"]


def test_letters_are_kerned_by_keys_and_undo_keeps_what_is_chosen(writing):
    """The list had looked at a font unasked; to end that the next change took a kerning back."""
    editor, field = writing
    session = editor.session
    assert not field.words.document().isUndoAvailable()
    alt = Qt.KeyboardModifier.AltModifier
    placed = [(run.right, run.down) for run in begun_runs(editor)]
    choose_letters(field, 2, 0)
    for _ in range(2):
        press(editor, Qt.Key.Key_Right, alt)
    press(editor, Qt.Key.Key_Down, alt | Qt.KeyboardModifier.ShiftModifier)
    choose_letters(field, 3, 0)
    press(editor, Qt.Key.Key_Right, alt)
    runs = begun_runs(editor)
    assert [run.words for run in runs[:4]] == ["pl", "a", "i", "n "]
    pixel = 1 / editor.window.canvas.pixel_map.sx
    assert [(run.right, run.down) for run in runs[:4]] == [
        (0, 0), pytest.approx((2 * pixel, 10 * pixel)), pytest.approx((pixel, 0)), (0, 0)
    ]  # fmt: skip
    # What follows is moved along, and what was raised before still is, once.
    assert [run.down for run in runs[4:]] == [down for _, down in placed[1:]]
    choose_letters(field, 6, 6)
    QTest.mouseClick(field.bold, Qt.MouseButton.LeftButton)
    was = field.bold.isChecked()
    field.words.setFocus()
    press(editor, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert field.words.textCursor().selectedText() == "raised"
    assert field.bold.isChecked() != was
    finish(editor)
    assert begun_runs(editor) == runs
    assert session.undo_stack.undoText().startswith("Edit Text")


def begun_runs(editor):
    return editor.session.document.curves[0].form.lines[0].runs


def type_into(edit, text):
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)


def test_spaces_are_of_the_chosen_letters_and_those_of_lines_are_shown_as_they_are(writing):
    editor, field = writing
    letters, words, lines = field.setting_row.edits.values()
    before = editor.session.document.curves[0].points
    choose_letters(field, 6, 6)
    type_into(letters, "20")
    type_into(words, "50 %")
    runs = editor.session.document.curves[0].form.lines[0].runs
    assert [(run.spacing, run.word_spacing) for run in runs] == [(0, 0), (2, 5), (0, 0)]
    # The words behind are further to the right by as much.
    after = editor.session.document.curves[0].points
    assert max(each.x for each in after) - max(each.x for each in before) == pytest.approx(6 * 2, abs=1e-6)
    choose_letters(field, 0, 3)
    assert (letters.text(), words.text()) == ("0 %", "0 %")
    choose_letters(field, 7, 1)
    assert (letters.text(), words.text()) == ("20 %", "50 %")
    # Larger letters stand as far apart as they are larger.
    type_into(field.size_box.edit, "20")
    runs = editor.session.document.curves[0].form.lines[0].runs
    assert [run.spacing for run in runs] == pytest.approx([0, 2, 4, 2, 0])
    field.words.setFocus()
    press(editor, Qt.Key.Key_End, Qt.KeyboardModifier.ControlModifier)
    press(editor, Qt.Key.Key_Return)
    QTest.keyClicks(field.words, "below")
    type_into(lines, "150")
    first, second = editor.session.document.curves[0].form.lines
    apart = second.y - first.y
    field.words.setFocus()
    finish(editor)
    editor.trigger("editText")
    # And not as if nobody had set them.
    assert lines.text() == "150 %"
    type_into(lines, "300")
    first, second = editor.session.document.curves[0].form.lines
    assert second.y - first.y == pytest.approx(2 * apart)


def paints_of(editor, place=0):
    """Return words and fill of each run of a text in one line; None for that of the text."""
    (line,) = editor.session.document.curves[place].form.lines
    return [(run.words, run.paint and run.paint.fill) for run in line.runs]


def swatch(editor, name):
    editor.window.context.docks["styleDock"].bring_up()
    editor.settle()
    found = editor.window.findChild(QToolButton, name)
    assert found is not None
    return found


def test_a_swatch_and_a_typed_colour_are_for_the_chosen_letters_and_leave_the_field_open(writing):
    editor, field = writing
    begun, steps = editor.session.document, editor.session.undo_stack.index()
    blue = swatch(editor, "fillPaint_Blue")
    choose_letters(field, 8, 2)
    assert editor.window.findChild(QLabel, "styleSubject").text() == "2 letters"
    QTest.mouseClick(blue, Qt.MouseButton.LeftButton)
    assert paints_of(editor) == [
        ("plain ", None), ("ra", "#ff0000"), ("is", CURVE_COLOURS["Blue"]), ("ed", "#ff0000"), (" on", None)
    ]  # fmt: skip
    edit = editor.window.findChild(QLineEdit, "fillPaintHex")
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "teal")
    press(editor, Qt.Key.Key_Return)
    assert field.isVisible()
    assert field.words.textCursor().selectedText() == "is"
    assert paints_of(editor)[2] == ("is", "#008080")
    # A colour that is looked at is forgotten with the popup.
    popup = editor.window.findChild(PaintField, "fillPaint").open_popup()
    popup.colour_changed.emit("#123456")
    assert paints_of(editor)[2] == ("is", "#123456")
    popup.cancel()
    assert paints_of(editor)[2] == ("is", "#008080")
    field.words.setFocus()
    finish(editor)
    assert editor.session.undo_stack.index() == steps + 1
    assert paints_of(editor)[2] == ("is", "#008080")
    editor.trigger("undo")
    assert editor.session.document == begun


def test_without_chosen_letters_a_colour_and_an_opacity_are_of_the_text(writing):
    editor, field = writing
    blue = swatch(editor, "fillPaint_Blue")
    choose_letters(field, 1, 0)
    QTest.mouseClick(blue, Qt.MouseButton.LeftButton)
    edit = editor.window.findChild(QLineEdit, "styleOpacity")
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "50")
    press(editor, Qt.Key.Key_Return)
    assert field.isVisible()
    field.words.setFocus()
    finish(editor)
    (curve,) = editor.session.document.curves
    assert {paint for _, paint in paints_of(editor)} == {None}
    assert (curve.style.fill, curve.style.opacity) == (CURVE_COLOURS["Blue"], 0.5)
    # A click on the canvas still makes the text.
    editor.trigger("editText")
    editor.click((80, 5))
    assert not field.isVisible()


def test_without_chosen_letters_all_change_and_undo_in_the_field_takes_it_back(writing):
    editor, field = writing
    begun, steps = editor.session.document, editor.session.undo_stack.index()
    choose_letters(field, 2, 0)
    press(editor, Qt.Key.Key_B, Qt.KeyboardModifier.ControlModifier)
    assert [weight for _, weight, *_ in runs_of(editor, 0)[0]] == [700, 700, 700]
    press(editor, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert editor.session.document == begun
    finish(editor)
    assert (editor.session.document, editor.session.undo_stack.index()) == (begun, steps)


def test_a_font_that_is_pointed_at_is_seen_in_the_chosen_letters_and_forgotten(writing):
    editor, field = writing
    begun = editor.session.document
    choose_letters(field, 0, 5)
    field.font_box.setFocus()
    field.font_box.showPopup()
    QTest.keyClick(field.font_box.view(), Qt.Key.Key_Down)
    fonts = [run.font for run in editor.session.document.curves[0].form.lines[0].runs]
    assert fonts[0] != fonts[1] == fonts[3] == ("Curvebench Blocks",)
    QTest.keyClick(field.font_box.view(), Qt.Key.Key_Escape)
    editor.settle()
    assert editor.session.document == begun


def test_a_word_of_a_new_text_is_written_bold(open_drawing):
    editor = open_drawing(RUNS)
    editor.window.activateWindow()
    editor.trigger("textTool")
    editor.click((20, 10))
    field = editor.window.commands[TextCommands].field
    QTest.keyClicks(field.words, "two words")
    choose_letters(field, 4, 5)
    press(editor, Qt.Key.Key_B, Qt.KeyboardModifier.ControlModifier)
    field.words.setFocus()
    finish(editor)
    (runs,) = runs_of(editor, 1)
    assert [run[:2] for run in runs] == [("two ", 400), ("words", 700)]


def test_no_panel_takes_its_frame_for_a_curve(drawing):
    window, session = drawing.window, drawing.session
    drawing.trigger("toggleBasis")
    drawing.trigger("plotSpeed")
    basis, note = window.basis_panel.drawing, window.central["basisPane"].findChild(QLabel, "basisDrawing")
    session.selected.activate(LINE)
    drawing.settle()
    assert basis.basis is not None
    assert (len(basis.rail.parameters), note.text()) == (2, "")
    shown = window.central["plotPanel"].pane.canvas
    drawing.wait_for_work()
    assert shown.plots
    drawing.trigger("fitView")
    drawing.click((15, 35))
    assert session.selected.chosen == {TEXT}
    assert basis.basis is None
    assert (len(basis.rail.parameters), note.text()) == (0, "A text has no curve.")
    assert not shown.plots
    assert session.active_view.problem == "A text has no curve."
    # A pen begins a curve of its own beside it.
    drawing.trigger("addTool")
    drawing.click((70, 50))
    drawing.click((80, 55))
    assert session.document.curves[TEXT].form is not None
    assert len(session.document.curves) == 4


def test_circles_that_are_combined_become_a_path_as_one_circle_does(open_drawing):
    """They were refused: “Choose a text, or a shape such as a rectangle.”"""
    circle = '<circle cx="{}" cy="30" r="{}"/>'
    editor = open_drawing(
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
        f"{circle.format(30, 20)}{circle.format(45, 10)}{circle.format(80, 5)}</svg>"
    )
    session = editor.session
    session.selected.choose({0, 1})
    editor.trigger("combineCurves")
    before = session.document
    session.selected.choose({1})
    editor.trigger("objectToPath")
    assert editor.status == "Shape 1 is a path now."
    assert [curve.form is None for curve in session.document.curves] == [True, True, False]
    assert [curve.shape for curve in session.document.curves] == ["Shape 1", "Shape 1", ""]
    assert [curve.points for curve in session.document.curves] == [curve.points for curve in before.curves]
    editor.trigger("breakApart")
    assert [curve.form is None for curve in session.document.curves] == [True, True, False]
    session.selected.choose({2})
    editor.trigger("objectToPath")
    assert session.document.curves[2].form is None


def test_chosen_letters_become_superscripts_and_subscripts_and_are_letters_again(writing):
    editor, field = writing
    size = begun_runs(editor)[0].size
    choose_letters(field, 2, 1)
    QTest.mouseClick(field.superscript, Qt.MouseButton.LeftButton)
    small = begun_runs(editor)[1]
    assert (small.size, small.raised) == (pytest.approx(0.65 * size), pytest.approx(0.4 * size))
    assert {run.raised for run in begun_runs(editor) if run is not small} == {0.0}
    assert (field.superscript.isChecked(), field.subscript.isChecked()) == (True, False)
    QTest.mouseClick(field.subscript, Qt.MouseButton.LeftButton)
    small = begun_runs(editor)[1]
    assert (small.size, small.raised) == (pytest.approx(0.65 * size), pytest.approx(-0.2 * size))
    QTest.mouseClick(field.subscript, Qt.MouseButton.LeftButton)
    assert begun_runs(editor)[1].size == pytest.approx(size)
    assert {run.raised for run in begun_runs(editor)} == {0.0}
    choose_letters(field, 0, 1)
    assert not field.superscript.isChecked()
    finish(editor)
