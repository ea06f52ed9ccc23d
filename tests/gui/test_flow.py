"""Words that fill a frame: drawn with the text tool, wrapped live, its handles dragged, and lines again."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QToolButton

from app.canvas import content_ink
from app.document.content import Anchor
from app.document.contents import corners_of
from app.document.wrapping import is_overset, laid_out, words_without_room
from app.features.text.commands import TextCommands
from app.qt.contents import painted_letters
from app.qt.glyphs import weights_of
from app.view_model.shapes.formed import formed
from tests.gui.test_text import finish, press, type_size

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
    '<rect id="box" x="60" y="5" width="30" height="40" fill="#ffffee"/></svg>'
)
WORDS = "one two three four five six seven eight nine ten"


@pytest.fixture
def drawing(open_drawing):
    """A drawing with a rectangle; the text tool is in use."""
    editor = open_drawing(DRAWING)
    editor.window.activateWindow()
    editor.trigger("textTool")
    yield editor
    if field(editor).isVisible():
        press(editor, Qt.Key.Key_Escape)


def field(editor):
    return editor.window.commands[TextCommands].field


def text_of(editor, place=1):
    return editor.session.document.curves[place].form


def lines_of(editor, place=1):
    return [line.words for line in laid_out(text_of(editor, place)).lines]


def box_of(editor, place=1):
    across, up = zip(*corners_of(editor.session.document.curves[place]), strict=True)
    return min(across), min(up), max(across), max(up)


def write(editor, start=(5, 55), to=(45, 10), words=WORDS, size="4"):
    editor.drag(start, to)
    edit = field(editor).size_box.edit
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, size)
    press(editor, Qt.Key.Key_Return)
    field(editor).words.setFocus()
    QTest.keyClicks(field(editor).words, words)


def test_a_drag_draws_a_frame_and_what_is_typed_wraps_in_it_live(drawing):
    steps = drawing.session.undo_stack.index()
    write(drawing)
    # Seen while it is typed.
    shown = lines_of(drawing)
    assert len(shown) > 1
    assert "".join(shown) == WORDS
    assert box_of(drawing) == pytest.approx((5, 10, 45, 55), abs=0.5)
    finish(drawing)
    assert drawing.session.undo_stack.index() == steps + 1
    assert "Add Text “one two" in drawing.session.undo_stack.undoText()
    text = text_of(drawing)
    assert [line.words for line in text.lines] == [WORDS]
    long = max(len(line) for line in lines_of(drawing))
    # Its right side, further to the left: more lines of fewer letters.
    _, low, right, top = box_of(drawing)
    drawing.drag((right, (low + top) / 2), (25, (low + top) / 2))
    assert text_of(drawing).lines == text.lines
    assert "".join(lines_of(drawing)) == WORDS
    assert max(len(line) for line in lines_of(drawing)) < long
    assert box_of(drawing)[2] == pytest.approx(25, abs=0.5)
    assert "width" in drawing.session.undo_stack.undoText()
    drawing.trigger("undo")
    assert text_of(drawing) == text


def test_a_frame_is_seen_and_dragged_while_its_words_are_typed(drawing):
    """Opened again it was out of sight, and of its words the field showed the last line."""
    write(drawing, words=f"{WORDS} {WORDS}")
    finish(drawing)
    steps = drawing.session.undo_stack.index()
    x, y = drawing.session.document.curves[1].points[0].x, drawing.session.document.curves[1].points[0].y
    drawing.click((x + 3, y - 3))
    words = field(drawing).words
    assert words.isVisible()
    assert drawing.session.selected.chosen == {1}
    assert (words.textCursor().position(), words.textCursor().hasSelection()) == (1, False)
    _, low, right, top = box_of(drawing)
    drawing.drag((right, (low + top) / 2), (30, (low + top) / 2))
    assert not words.isVisible()
    assert box_of(drawing)[2] == pytest.approx(30, abs=0.5)
    assert drawing.session.undo_stack.index() == steps + 1


def test_escape_keeps_what_was_edited_and_undo_takes_it_back(drawing):
    write(drawing, words="one")
    finish(drawing)
    before, (_, _, _, top) = drawing.session.document, box_of(drawing)
    drawing.click((7, top - 2))
    # Where it was clicked, and not in place of all.
    QTest.keyClicks(field(drawing).words, "x")
    assert text_of(drawing).words == "oxne"
    press(drawing, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(field(drawing).words, "two")
    press(drawing, Qt.Key.Key_Escape)
    assert text_of(drawing).words == "two"
    drawing.trigger("undo")
    assert drawing.session.document == before


def test_a_first_text_is_as_large_as_is_read_on_its_page(drawing):
    drawing.click((5, 30))
    assert 60 / 30 <= field(drawing).size_box.em <= 60 / 6


def test_on_a_small_card_it_is_not_too_small_to_read(open_drawing):
    editor = open_drawing(
        '<svg xmlns="http://www.w3.org/2000/svg" width="85mm" height="55mm" viewBox="0 0 85 55">'
        '<rect width="5" height="5"/></svg>'
    )
    editor.trigger("textTool")
    editor.click((10, 20))
    size, way = field(editor).size_box.em, editor.window.canvas.to_pixel
    assert 20 <= abs(way(0, size).y() - way(0, 0).y()) <= 50
    press(editor, Qt.Key.Key_Escape)


def test_a_press_between_the_widgets_of_the_bar_leaves_one_typing(drawing):
    """It went through to the canvas, ended the text and began another one below."""
    drawing.click((5, 30))
    QTest.keyClicks(field(drawing).words, "ab")
    bar = field(drawing)
    gap = QPoint(bar.bold.geometry().right() + 2, bar.bold.geometry().center().y())
    assert bar.childAt(gap) is None
    for place in (gap, QPoint(2, 2)):
        global_place = bar.mapTo(drawing.window, place)
        QTest.mouseClick(drawing.window.windowHandle(), Qt.MouseButton.LeftButton, pos=global_place)
        assert field(drawing).words.hasFocus()
    QTest.keyClicks(field(drawing).words, "c")
    finish(drawing)
    assert [line.words for line in text_of(drawing).lines] == ["abc"]
    assert len(drawing.session.document.curves) == 2


def test_the_end_of_a_line_stays_one_and_an_empty_line_is_as_high(drawing):
    write(drawing, words="one")
    for _ in range(2):
        QTest.keyClick(field(drawing).words, Qt.Key.Key_Return)
    QTest.keyClicks(field(drawing).words, "two")
    finish(drawing)
    lines = laid_out(text_of(drawing)).lines
    assert [line.words for line in lines] == ["one", "", "two"]
    assert lines[2].y - lines[0].y == pytest.approx(2 * (lines[1].y - lines[0].y))


def test_words_without_room_are_kept_and_the_frame_tells(drawing, monkeypatch):
    told = []
    painted = content_ink._paint_overset
    monkeypatch.setattr(content_ink, "_paint_overset", lambda *each: (told.append(1), painted(*each)))
    write(drawing, to=(25, 45))
    finish(drawing)
    drawing.settle()
    drawing.window.context.central.canvas.viewport().grab()
    assert is_overset(text_of(drawing))
    assert "".join(lines_of(drawing)) == WORDS
    assert told
    many = words_without_room(text_of(drawing))
    assert 0 < many < len(WORDS.split())
    sentence = f"{many} words do not fit into the frame."
    assert sentence in drawing.window.status_line.text
    drawing.trigger("openTransform")
    problem = drawing.window.findChild(QLabel, "transformProblem")
    assert problem.text() == f"⚠ {sentence}"
    drawing.drag((25, 45), (58, 10))
    told.clear()
    drawing.window.context.central.canvas.viewport().grab()
    assert not is_overset(text_of(drawing))
    assert not told
    assert not problem.isVisible()


def test_lines_flow_into_a_frame_or_a_rectangle_and_back(drawing):
    drawing.click((5, 30))
    QTest.keyClicks(field(drawing).words, "one two three and more words that take room")
    QTest.keyClick(field(drawing).words, Qt.Key.Key_Return)
    QTest.keyClicks(field(drawing).words, "four")
    finish(drawing)
    lines = text_of(drawing).lines
    drawing.trigger("flowIntoFrame")
    assert (
        drawing.session.undo_stack.undoText() == "Flow into frame: one two three and more words that take …"
    )
    laid = laid_out(text_of(drawing))
    # Where they were.
    assert [line.words for line in laid.lines] == ["one two three and more words that take room", "four"]
    for here, there in zip(laid.lines, lines, strict=True):
        assert (here.x, here.y) == pytest.approx((there.x, there.y), abs=1e-6)
    assert not laid.is_overset
    drawing.trigger("unflowText")
    after = text_of(drawing)
    assert after.flow is None
    assert [(line.words, line.anchor) for line in after.lines] == [
        (line.words, line.anchor) for line in lines
    ]
    drawing.session.selected.choose({0, 1})
    drawing.trigger("flowIntoFrame")
    assert box_of(drawing) == pytest.approx(box_of(drawing, 0))
    assert len(lines_of(drawing)) > 2


def test_its_width_is_typed_and_its_words_and_alignment_are_edited(drawing):
    write(drawing)
    finish(drawing)
    drawing.trigger("editText")
    assert field(drawing).text == WORDS
    field(drawing).words.selectAll()
    QTest.keyClicks(field(drawing).words, "other words here that are many and long")
    left = [line.x for line in laid_out(text_of(drawing)).lines]
    QTest.mouseClick(field(drawing).findChild(QToolButton, "textAlign_right"), Qt.MouseButton.LeftButton)
    finish(drawing)
    assert min(line.x - x for line, x in zip(laid_out(text_of(drawing)).lines, left, strict=True)) > 0
    assert "".join(lines_of(drawing)) == "other words here that are many and long"
    before = laid_out(text_of(drawing))
    now = formed(drawing.session.document.curves[1])
    wide = now.form.with_number("width", now.form.width / 2)
    assert len(laid_out(wide).lines) > len(before.lines)
    assert wide.lines[0].anchor is Anchor.END


def test_lines_are_justified_as_they_are_typed_and_words_stand_apart_in_the_outlines(drawing):
    drawing.click((5, 30))
    justify = field(drawing).findChild(QToolButton, "textAlign_justify")
    # Lines that end where they do have nothing to fill.
    assert not justify.isEnabled()
    press(drawing, Qt.Key.Key_Escape)
    write(drawing)
    assert justify.isEnabled()
    QTest.mouseClick(justify, Qt.MouseButton.LeftButton)
    field(drawing).words.setFocus()
    QTest.keyClicks(field(drawing).words, " eleven twelve")
    text = text_of(drawing)
    assert text.flow.is_justified
    laid = laid_out(text)
    rights = [painted_right(line) for line in laid.lines]
    assert rights[:-1] == pytest.approx([text.box[2]] * (len(rights) - 1), abs=0.6)
    assert laid.stretches[-1] == 0.0 < min(laid.stretches[:-1])
    finish(drawing)
    assert text_of(drawing).flow.is_justified
    drawing.trigger("editText")
    assert justify.isChecked()
    QTest.mouseClick(field(drawing).findChild(QToolButton, "textAlign_left"), Qt.MouseButton.LeftButton)
    assert not any(laid_out(text_of(drawing)).stretches)
    QTest.mouseClick(justify, Qt.MouseButton.LeftButton)
    finish(drawing)
    right = box_of(drawing)[2]
    drawing.trigger("objectToPath")
    ends = {round(max(point.x for point in curve.points), 1) for curve in drawing.session.document.curves[1:]}
    assert max(ends) == pytest.approx(right, abs=0.6)


def painted_right(line):
    return max(path.boundingRect().right() for _, path in painted_letters((line,)))


def test_a_size_is_typed_in_points_and_told_in_them(drawing):
    write(drawing, size="12 pt", words="one")
    edit = field(drawing).size_box.edit
    # In the unit of the page, a point being the 72nd part of an inch.
    assert float(edit.text()) == pytest.approx(12 * 25.4 / 72, abs=1e-4)
    assert edit.toolTip().endswith("Now 12 pt")
    assert text_of(drawing).lines[0].runs[0].size == pytest.approx(12 * 25.4 / 72)


def test_sizes_are_told_and_typed_in_points_where_these_are_chosen(drawing):
    write(drawing, size="12 pt", words="one")
    box = field(drawing).size_box
    assert [box.unit_box.itemText(at) for at in range(box.unit_box.count())] == ["mm", "pt"]
    box.unit_box.setFocus()
    QTest.keyClick(box.unit_box, Qt.Key.Key_Down)
    assert box.edit.text() == "12"
    type_size(drawing, "18")
    assert text_of(drawing).lines[0].runs[0].size == pytest.approx(18 * 25.4 / 72)
    QTest.keyClick(box.edit, Qt.Key.Key_Up)
    assert box.edit.text() == "19"
    type_size(drawing, "5 mm")
    assert text_of(drawing).lines[0].runs[0].size == pytest.approx(5)
    finish(drawing)
    # The next text is told so, too.
    drawing.click((5, 8))
    assert float(box.edit.text()) == pytest.approx(5 * 72 / 25.4, abs=1e-3)
    box.unit_box.setFocus()
    QTest.keyClick(box.unit_box, Qt.Key.Key_Up)
    assert box.edit.text() == "5"


def test_a_weight_that_the_font_has_is_chosen_for_letters(drawing):
    write(drawing, words="one two")
    if field(drawing).bold.isChecked():
        # As the last text was, of whoever used the window before.
        QTest.mouseClick(field(drawing).bold, Qt.MouseButton.LeftButton)
    box, family = field(drawing).weight_box, field(drawing).font_box.family
    weights = weights_of(family)
    # More than bold is offered where there is more.
    assert box.isVisible() == (not {*weights} <= {400, 700})
    assert box.count() == len(weights)
    field(drawing).font_box.take("DejaVu Sans")
    field(drawing).font_box.picked.emit("DejaVu Sans")
    if 200 not in weights_of("DejaVu Sans"):
        pytest.skip("its light letters are not installed")
    assert (box.isVisible(), box.currentText()) == (True, "Regular")
    QTest.keyClick(field(drawing).words, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(box, Qt.Key.Key_Up)
    assert box.currentText() == "Extra Light"
    runs = text_of(drawing).lines[0].runs
    assert [(run.words, run.weight) for run in runs] == [("one tw", 400), ("o", 200)]
    QTest.mouseClick(field(drawing).bold, Qt.MouseButton.LeftButton)
    assert box.currentText() == "Bold"
    light, regular = (
        painted_right(replace(text_of(drawing).lines[0], runs=(replace(runs[0], weight=weight),)))
        for weight in (200.0, 400.0)
    )
    assert light != regular


def test_the_caret_stays_where_what_is_seen_ends_and_the_view_with_it(drawing):
    """It went on below the frame, and the view followed it to where nothing is."""
    write(drawing, to=(25, 45))
    words, shown = field(drawing).words, drawing.window.canvas.camera
    drawing.settle()
    seen = laid_out(text_of(drawing)).seen
    assert 0 < seen < len(lines_of(drawing))
    left, low, right, top = box_of(drawing)
    caret = words.caret
    (x, y), (_, lower) = map(shown.to_plane, (caret.p1(), caret.p2()))
    # A blank at the end of a line reaches beyond.
    assert left < x <= right + 2
    assert low - 1 < lower < y <= top + 1
    QTest.keyClick(words, Qt.Key.Key_Home, Qt.KeyboardModifier.ControlModifier)
    assert shown.to_plane(words.caret.p1())[0] == pytest.approx(left, abs=0.2)
    # What is typed there is in sight, and pushes others out.
    many = words_without_room(text_of(drawing))
    QTest.keyClicks(words, "more and more ")
    assert words_without_room(text_of(drawing)) > many
    assert lines_of(drawing)[0].startswith("more")
