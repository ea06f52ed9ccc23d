"""Opacity of groups: set in the Style panel, drawn as one on the canvas, kept by what is done to groups."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QSlider

from app.document.group_opacity import opacities_of, with_overall_opacity
from app.document.model import Document, make_curve
from app.document.shapes import tidy_shapes
from app.document.style import Style
from app.families import HERMITE
from tests.effort import calls_of
from tests.gui.test_style import BLUE, CTRL, RED, begin, square

MANY = 40


def filled(x, colour, name, *groups):
    return replace(square(x, 0, 4, name, style=Style(stroke="none", fill=colour)), groups=groups)


@pytest.fixture
def pair(editor):
    """A red square over a blue one in a group, chosen by a click, and one beside it; the Style panel."""
    begin(editor, filled(0, BLUE, "Low", "Leaf"), filled(2, RED, "High", "Leaf"), filled(9, BLUE, "Alone"))
    editor.show_dock("styleDock")
    editor.session.selected.choose(())
    editor.click((1, 1))
    assert editor.session.selected.chosen == {0, 1}
    return editor


def shares(editor):
    document = editor.session.document
    looks = [[each.opacity for each in curve.group_looks] for curve in document.curves]
    return looks, [curve.style.opacity for curve in document.curves]


def colours(editor, *places):
    """The colours on the canvas."""
    editor.settle()
    picture = editor.window.canvas.grab().toImage()
    ratio = picture.devicePixelRatio()
    pixels = [editor.window.canvas.to_pixel(*place) for place in places]
    return [picture.pixelColor(round(at.x() * ratio), round(at.y() * ratio)).name() for at in pixels]


def enter(editor, text):
    edit = editor.window.findChild(QLineEdit, "styleOpacity")
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)
    return edit


def half(colour, paper):
    """A colour that half of is seen on paper."""
    return [(int(colour[i : i + 2], 16) + int(paper[i : i + 2], 16)) / 2 for i in (1, 3, 5)]


def is_near(colour, wanted):
    return [int(colour[i : i + 2], 16) for i in (1, 3, 5)] == pytest.approx(wanted, abs=2)


def test_a_typed_opacity_is_that_of_the_whole_group_in_one_step_and_nothing_shows_through(pair):
    steps = pair.session.undo_stack.count()
    edit = enter(pair, "50")
    assert shares(pair) == ([[0.5], [0.5], []], [1, 1, 1])
    assert pair.session.undo_stack.count() == steps + 1
    assert pair.session.undo_stack.undoText() == "Opacity of Leaf"
    pair.session.selected.choose(())
    low, both, high, alone, paper = colours(pair, (1, 1), (3, 1), (5, 1), (10, 1), (7.5, 2))
    assert is_near(low, half(BLUE, paper))
    assert is_near(both, half(RED, paper))
    assert is_near(high, half(RED, paper))
    assert alone == BLUE
    pair.click((1, 1))
    assert edit.text() == "50 %"
    pair.action("undo").trigger()
    assert shares(pair) == ([[], [], []], [1, 1, 1])
    assert edit.text() == "100 %"
    assert colours(pair, (3, 1)) != [both]


def test_the_slider_of_a_group_is_live_one_step_and_given_up_by_escape(pair):
    slider = pair.window.findChild(QSlider, "styleOpacitySlider")
    steps = pair.session.undo_stack.count()
    slider.setSliderDown(True)
    slider.setSliderPosition(30)
    assert shares(pair) == ([[0.3], [0.3], []], [1, 1, 1])
    assert pair.session.undo_stack.count() == steps
    slider.setSliderDown(False)
    assert pair.session.undo_stack.count() == steps + 1


def test_in_a_group_that_is_entered_the_opacity_is_that_of_the_shape(pair):
    pair.session.selected.choose([1])
    enter(pair, "25")
    assert shares(pair) == ([[], [], []], [1, 0.25, 1])
    pair.session.selected.choose([0, 1, 2])
    edit = enter(pair, "50")
    assert shares(pair) == ([[0.5], [0.5], []], [1, 0.25, 0.5])
    assert edit.text() == "50 %"


def test_copied_pasted_and_taken_apart_a_group_is_seen_as_much(pair):
    enter(pair, "50")
    pair.key(Qt.Key.Key_C, CTRL)
    pair.key(Qt.Key.Key_V, CTRL)
    pair.wait_for_work()
    assert shares(pair)[0] == [[0.5]] * 2 + [[]] + [[0.5]] * 2
    pair.action("ungroupCurves").trigger()
    assert shares(pair)[0] == [[0.5]] * 2 + [[]] * 3
    assert shares(pair)[1] == [1, 1, 1, 0.5, 0.5]


def many(editor, opacity):
    style = Style(stroke="none", fill=BLUE)
    rows = [
        make_curve([(k, 0), (k + 4, 0), (k + 2, 4)], name=f"Row {k}", family=HERMITE) for k in range(MANY)
    ]
    curves = [replace(row, style=style, groups=("Leaf",)) for row in rows]
    document = tidy_shapes(with_overall_opacity(Document(tuple(curves)), range(MANY), opacity))
    begin(editor, *document.curves)
    editor.session.selected.choose(())
    editor.settle()
    return editor


def test_of_a_group_of_many_only_what_is_dragged_is_painted_anew(editor):
    many(editor, 0.5)
    editor.double_click((20.5, 2))
    place = editor.session.active_index
    x, y = editor.session.document.curves[place].points[0].position
    drawn = editor.window.canvas.drawing.curves
    layers = [drawn.others.groups, drawn.edited.groups]
    editor.press((x, y))
    editor.move((x, y - 1))
    editor.move((x, y - 2))
    editor.settle()
    before = sum(each.painted for each in layers)
    for step in range(3, 8):
        editor.move((x, y - step))
        editor.settle()
    assert 0 < sum(each.painted for each in layers) - before <= 5
    editor.release((x, y - 7))
    assert opacities_of(editor.session.document, range(MANY)) == [0.5]


def test_a_group_of_many_that_is_dragged_is_moved_as_a_picture_and_painted_anew_where_it_rests(editor, qtbot):
    many(editor, 0.5)
    editor.click((20.5, 2))
    assert len(editor.session.selected.chosen) == MANY
    editor.settle()
    groups = editor.window.canvas.drawing.curves.others.groups
    editor.press((20.5, 2))
    editor.move((21, 3))
    editor.settle()
    before = groups.painted
    for step in range(1, 6):
        editor.move((21 + step, 3))
        editor.settle()
    assert groups.painted == before
    moved = colours(editor, (26, 3))
    editor.release((26, 3))
    qtbot.waitUntil(lambda: groups.painted >= before + MANY)
    assert colours(editor, (26, 3)) == moved


def test_groups_that_are_seen_whole_cost_no_call_more_than_none(editor):
    drawn = editor.window.canvas.drawing.curves

    def cost(*groups):
        begin(editor, *(filled(k, BLUE, f"Row {k}", *groups) for k in range(MANY)))
        drawn._render_all()
        return calls_of(drawn._render_all)

    assert cost("Leaf") == cost()
