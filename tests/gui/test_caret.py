"""Typing on the page: the caret between the letters that are drawn, letters chosen, clicks and keys."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QFontDatabase, QInputMethodEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.features.text.commands import TextCommands

FONT = Path(__file__).parents[1] / "data" / "fonts" / "blocks.ttf"
"""Of which an em is 1000, "I" takes 400, "M" 900, ascent 900 and descent 300 of it."""

SHIFT, CONTROL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


def svg(text):
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
        f'<g font-family="Curvebench Blocks" font-size="10">{text}</g></svg>'
    )


@pytest.fixture
def opened(open_drawing):
    """Opens a drawing with the text tool in use."""
    QFontDatabase.addApplicationFont(str(FONT))
    editors = []

    def open_with(text):
        editor = open_drawing(svg(text))
        editor.window.activateWindow()
        editor.trigger("textTool")
        editors.append(editor)
        return editor

    yield open_with
    for editor in editors:
        if words(editor).isVisible():
            press(editor, Qt.Key.Key_Escape)


def words(editor):
    return editor.window.commands[TextCommands].field.words


def press(editor, key, keys=Qt.KeyboardModifier.NoModifier):
    QTest.keyClick(QApplication.focusWidget(), key, keys)
    editor.settle()


def plane(editor, line):
    """Return the ends of a line of the canvas in the plane, the upper one first."""
    canvas = editor.window.canvas
    return [tuple(canvas.to_plane(each)) for each in (line.p1(), line.p2())]


def caret(editor):
    return plane(editor, words(editor).caret)


def at(*ends):
    return [pytest.approx(each, abs=0.05) for each in ends]


def boxes(editor):
    """Return left, low, right and top of what chosen letters take in the plane."""
    found = []
    for box in words(editor).chosen_boxes:
        across, up = zip(*(editor.window.canvas.to_plane(box.at(n)) for n in range(4)), strict=True)
        found.append((min(across), min(up), max(across), max(up)))
    return found


def text_of(editor, place=0):
    return [line.words for line in editor.session.document.curves[place].form.lines]


def dark(editor, line):
    """Whether the canvas shows the caret on a line: it is dark there, and light beside it."""
    image = editor.window.canvas.viewport().grab().toImage()
    middle = line.center()
    return image.pixelColor(middle.toPoint()).lightness() < 100


def drag(editor, start, end):
    pixels = [editor.window.canvas.to_pixel(*each) for each in (start, end)]
    target = words(editor).viewport()
    QTest.mousePress(target, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, pixels[0])
    QTest.mouseMove(target, pixels[1])
    QTest.mouseRelease(target, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, pixels[1])
    editor.settle()


def test_words_are_typed_where_they_are_seen_with_a_caret_as_high_as_the_letters(opened):
    editor = opened('<text x="10" y="30">Io oI</text>')
    steps = editor.session.undo_stack.index()
    # Nearest to between the I, 4 wide less 1 for an o behind it, and that.
    editor.click((13.4, 33))
    assert (words(editor).textCursor().position(), words(editor).textCursor().hasSelection()) == (1, False)
    assert caret(editor) == at((13, 39), (13, 27))
    assert dark(editor, words(editor).caret)
    QTest.keyClicks(words(editor), "I")
    assert text_of(editor) == ["IIo oI"]
    assert caret(editor) == at((17, 39), (17, 27))
    # Keys go on from there; what is seen of it blinks, and goes with the focus.
    press(editor, Qt.Key.Key_End)
    assert caret(editor)[0][0] == pytest.approx(10 + 4 + 3 + 6 + 3 + 6 + 4, abs=0.05)
    press(editor, Qt.Key.Key_Left, CONTROL)
    assert caret(editor)[0][0] == pytest.approx(10 + 4 + 3 + 6 + 3, abs=0.05)
    line = QLineF(words(editor).caret)
    press(editor, Qt.Key.Key_Tab)
    assert not dark(editor, line)
    words(editor).setFocus()
    press(editor, Qt.Key.Key_Backspace)
    assert text_of(editor) == ["IIooI"]
    press(editor, Qt.Key.Key_Escape)
    assert editor.session.undo_stack.index() == steps + 1
    assert not words(editor).isVisible()
    # The first letter of a new one will be where the click was.
    editor.click((60, 20))
    x, y = editor.window.canvas.to_plane(editor.window.canvas.to_pixel(60, 20))
    (_, top), low = caret(editor)
    assert (low[0], top > y > low[1]) == (pytest.approx(x, abs=0.05), True)
    QTest.keyClicks(words(editor), "o")
    assert caret(editor)[0][0] > x + 1


def test_letters_are_chosen_by_drags_and_clicks_and_shown_where_they_are(opened):
    editor = opened('<text x="10" y="30">Io oI<tspan font-size="20">II</tspan></text>')
    editor.click((14, 33))
    drag(editor, (13, 33), (22, 33))
    assert words(editor).textCursor().selectedText() == "o "
    assert boxes(editor) == [pytest.approx((13, 27, 22, 39), abs=0.05)]
    assert editor.window.canvas.viewport().grab().toImage().pixelColor(
        words(editor).chosen_boxes[0].at(0).toPoint() + QPointF(8, 4).toPoint()
    ).blue() > 200  # fmt: skip
    # Shift chooses on from there, of letters of two sizes each as high as they are.
    target, there = words(editor).viewport(), editor.window.canvas.to_pixel(39.5, 33)
    QTest.mouseClick(target, Qt.MouseButton.LeftButton, SHIFT, there)
    assert boxes(editor) == [
        pytest.approx((13, 27, 32, 39), abs=0.05), pytest.approx((32, 24, 40, 48), abs=0.05)
    ]  # fmt: skip
    assert caret(editor) == at((40, 48), (40, 24))
    # Twice for a word, once more for the line.
    place = editor.window.canvas.to_pixel(15, 33)
    QTest.mouseClick(target, Qt.MouseButton.LeftButton, pos=place)
    QTest.mouseDClick(target, Qt.MouseButton.LeftButton, pos=place)
    assert words(editor).textCursor().selectedText() == "Io"
    QTest.mouseClick(target, Qt.MouseButton.LeftButton, pos=place)
    assert words(editor).textCursor().selectedText() == "Io oIII"
    press(editor, Qt.Key.Key_Home)
    press(editor, Qt.Key.Key_A, CONTROL)
    assert words(editor).textCursor().selectedText() == "Io oIII"
    # The clipboard has letters, not the object.
    press(editor, Qt.Key.Key_C, CONTROL)
    press(editor, Qt.Key.Key_End)
    press(editor, Qt.Key.Key_V, CONTROL)
    assert text_of(editor) == ["Io oIIIIo oIII"]


def test_up_and_down_home_and_end_go_by_the_lines_that_are_seen(opened):
    editor = opened('<text x="50" y="30" text-anchor="middle">Io<tspan x="50" dy="15">IIII</tspan></text>')
    # Beside a line it is that line.
    editor.click((57, 18))
    assert (words(editor).textCursor().position(), caret(editor)) == (7, at((58, 24), (58, 12)))
    press(editor, Qt.Key.Key_Up)
    assert words(editor).textCursor().position() == 2
    press(editor, Qt.Key.Key_Down, SHIFT)
    assert words(editor).textCursor().selectedText() == "\u2029IIII"
    assert boxes(editor) == [pytest.approx((42, 12, 58, 24), abs=0.05)]
    press(editor, Qt.Key.Key_Home)
    assert caret(editor) == at((42, 24), (42, 12))
    press(editor, Qt.Key.Key_Up)
    # A line without letters has a caret all the same, where its first will be.
    QTest.keyClick(words(editor), Qt.Key.Key_Return)
    QTest.keyClick(words(editor), Qt.Key.Key_Return)
    press(editor, Qt.Key.Key_Up)
    assert words(editor).textCursor().position() == 1
    x, _ = caret(editor)[0]
    assert x == pytest.approx(50, abs=0.05)
    QTest.keyClicks(words(editor), "I")
    assert caret(editor)[0][0] == pytest.approx(52, abs=0.05)
    assert text_of(editor) == ["I", "Io", "IIII"]


def test_the_words_of_a_frame_have_it_where_they_wrap(opened):
    editor = opened('<rect x="90" y="50" width="5" height="5"/>')
    editor.drag((10, 50), (30, 10))
    field = editor.window.commands[TextCommands].field
    field.restyle(lambda run: replace(run, font=("Curvebench Blocks",)))
    field.size_box.edit.setFocus()
    field.size_box.edit.selectAll()
    QTest.keyClicks(field.size_box.edit, "10")
    press(editor, Qt.Key.Key_Return)
    words(editor).setFocus()
    left = caret(editor)[0][0]
    assert left == pytest.approx(10, abs=0.3)
    QTest.keyClicks(words(editor), "II III")
    # Before the first letter of the next line, and not behind the blank at the end of the one before.
    first = caret(editor)
    press(editor, Qt.Key.Key_Home)
    second = caret(editor)
    assert words(editor).textCursor().position() == 3
    assert (second[0][0], second[0][1]) == (pytest.approx(left, abs=0.05), pytest.approx(first[0][1]))
    press(editor, Qt.Key.Key_Up)
    press(editor, Qt.Key.Key_End)
    assert words(editor).textCursor().position() == 2
    assert caret(editor)[0] == pytest.approx((left + 8, second[0][1] + (first[0][1] - first[1][1])), abs=0.5)
    # A press anywhere in the frame is one in its words.
    drag(editor, (13.5, 47), (18.5, 15))
    assert words(editor).textCursor().selectedText() == "I II"
    assert len(boxes(editor)) == 2


def test_it_stands_as_turned_and_mirrored_letters_do_and_along_a_path(opened):
    editor = opened(
        '<text x="0" y="0" transform="translate(30 50) rotate(-90)">II</text>'
        '<text x="0" y="0" transform="translate(95 30) scale(-1 1)">II</text>'
        '<path id="p" d="M 40 40 L 40 10" fill="none" stroke="#000000"/>'
        '<text><textPath href="#p">IIo</textPath></text>'
    )
    # Upwards: the letters lie on their backs.
    editor.click((28, 14.5))
    assert (words(editor).textCursor().position(), caret(editor)) == (1, at((21, 14), (33, 14)))
    press(editor, Qt.Key.Key_End)
    assert caret(editor) == at((21, 18), (33, 18))
    press(editor, Qt.Key.Key_Escape)
    editor.click((92, 33))
    assert (words(editor).textCursor().position(), caret(editor)) == (1, at((91, 39), (91, 27)))
    press(editor, Qt.Key.Key_End, SHIFT)
    assert boxes(editor) == [pytest.approx((87, 27, 91, 39), abs=0.05)]
    press(editor, Qt.Key.Key_Escape)
    editor.click((36.5, 24.5))
    assert (words(editor).textCursor().position(), caret(editor)) == (1, at((31, 24), (43, 24)))
    drag(editor, (36.5, 24.5), (36.5, 40))
    assert words(editor).textCursor().selectedText() == "Io"
    assert len(boxes(editor)) == 2
    QTest.keyClicks(words(editor), "I")
    assert text_of(editor, 3) == ["II"]
    assert caret(editor) == at((31, 28), (43, 28))


def test_what_is_composed_is_seen_among_the_letters_until_it_is_taken(opened):
    editor = opened('<text x="10" y="30">II</text>')
    steps = editor.session.undo_stack.index()
    editor.click((14, 33))
    # A dead key, and what it becomes.
    QApplication.sendEvent(words(editor), QInputMethodEvent("oo", []))
    assert text_of(editor) == ["IooI"]
    x = caret(editor)[0][0]
    assert x > 10 + 4 + 6
    found = words(editor).inputMethodQuery(Qt.InputMethodQuery.ImCursorRectangle)
    assert found.contains(words(editor).caret.center().toPoint())
    event = QInputMethodEvent("", [])
    event.setCommitString("o")
    QApplication.sendEvent(words(editor), event)
    assert text_of(editor) == ["IoI"]
    assert caret(editor)[0][0] < x
    press(editor, Qt.Key.Key_Escape)
    assert text_of(editor) == ["IoI"]
    assert editor.session.undo_stack.index() == steps + 1


def test_a_text_without_letters_is_gone_and_one_that_is_typed_anew_stands_where_it_was(opened):
    editor = opened('<text x="10" y="30" fill="#ff0000">II</text><rect x="60" y="5" width="9" height="9"/>')
    begun = editor.session.document
    editor.click((14, 33))
    press(editor, Qt.Key.Key_A, CONTROL)
    press(editor, Qt.Key.Key_Delete)
    assert len(editor.session.document.curves) == 1
    assert caret(editor) == at((10, 39), (10, 27))
    QTest.keyClicks(words(editor), "o")
    assert text_of(editor) == ["o"]
    press(editor, Qt.Key.Key_Backspace)
    press(editor, Qt.Key.Key_Escape)
    assert editor.session.undo_stack.undoText() == "Delete Text “II”"
    assert [curve.form.noun for curve in editor.session.document.curves] == ["rectangle"]
    editor.trigger("undo")
    assert editor.session.document == begun


def test_the_view_follows_the_caret_that_keys_lead_out_of_it(opened):
    editor = opened('<text x="10" y="30">Io oI</text>')
    canvas = editor.window.canvas
    canvas.camera.show_box((11, 25), (25, 40))
    editor.settle()
    editor.click((13.2, 33))
    seen = canvas.pixel_map.box
    press(editor, Qt.Key.Key_End)
    assert canvas.viewport().rect().contains(words(editor).caret.center().toPoint())
    assert canvas.pixel_map.box[0] > seen[0]
    # They are typed where they are seen, however near that is.
    high = words(editor).caret.length()
    canvas.camera.zoom(1.25, words(editor).caret.center())
    editor.settle()
    assert words(editor).caret.length() == pytest.approx(1.25 * high)
    assert caret(editor)[0][0] == pytest.approx(32, abs=0.05)
