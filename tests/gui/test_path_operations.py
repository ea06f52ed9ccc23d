"""Boolean operations on shapes, larger and smaller ones, lines that become shapes; real clicks and keys."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.document.lines import is_line
from app.document.style import LineCap, LineJoin, Style
from app.exchange.svg.reader import read_svg
from app.features.shapes.offset_commands import OffsetCommands
from app.view_model.analysis.teaching import NARROW, Topic, warnings_of
from app.view_model.curve.curve_view import view_of
from app.view_model.shapes.regions import PATH_OPERATIONS

ORANGE, BROWN = "#ff8800", "#663300"
CTRL = Qt.KeyboardModifier.ControlModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier

# The disc is about (0, 0); the frame from −1 to 9 has a hole from 2 to 6, and in between lies something else.
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20" viewBox="-10 -10 20 20">
<circle id="Disc" r="4" fill="#ff8800"/>
<path id="Speck" d="M-9 -9h1v1h-1z" fill="#222222"/>
<path id="Frame" d="M-1 -1H9V9H-1Z M2 2V6H6V2Z" fill="#0088ff"/>
<path id="Arch" d="M-9 5C-9 -1 -5 -1 -5 5" fill="#0088ff"/></svg>"""

DISC, FRAME, IN_BOTH, IN_HOLE, OUTSIDE = (-2.0, 1.3), (7.5, -1.3), (0.4, -1.7), (2.2, -2.2), (6.3, 7.2)


@pytest.fixture
def drawing(editor):
    """The drawing, y up, with the disc and the frame chosen by clicks."""
    document = read_svg(DRAWING.encode(), None).document
    editor.session.commit(document, "Begin", active=0)
    editor.session.selected.choose([])
    editor.window.canvas.camera.show_box((-11, 11), (-11, 11))
    editor.settle()
    editor.click(DISC)
    editor.click(FRAME, keys=SHIFT)
    return editor


def names(editor):
    return [curve.name for curve in editor.session.document.curves]


def chosen(editor):
    return {editor.session.document.curves[place].name for place in editor.session.selected.chosen}


def is_painted(editor, *places, colour=ORANGE):
    """Whether the canvas has a colour, that of the disc, at places of the plane."""
    canvas = editor.window.canvas
    editor.settle()
    image = canvas.viewport().grab().toImage()
    return [QColor(image.pixel(canvas.to_pixel(*place))).name() == colour for place in places]


def press(editor, operation):
    """Press the first of the keys of an operation."""
    QTest.keySequence(editor.window, QKeySequence(operation.key.split(", ")[0]))
    editor.wait_for_work()
    editor.settle()


INSIDE = {
    "pathUnion": [True, True, True, True],
    "pathDifference": [True, False, False, True],
    "pathIntersection": [False, False, True, False],
    "pathExclusion": [True, True, False, True],
    "pathDivision": [True, False, True, True],
}


@pytest.mark.parametrize("operation", PATH_OPERATIONS, ids=lambda each: each.name)
def test_its_key_puts_the_outcome_in_the_place_of_the_hindmost_with_its_style(drawing, operation):
    """What is seen is what the operation says; one step takes it back."""
    before, operands = drawing.session.document, chosen(drawing)
    press(drawing, operation)
    assert drawing.session.undo_stack.undoText() == f"{operation.title} of Disc and Frame"
    # The whole frame is one shape: its hole is none of the outcome, but where the disc is.
    assert is_painted(drawing, DISC, FRAME, IN_BOTH, IN_HOLE) == INSIDE[operation.name]
    made = names(drawing)
    assert made[-2:] == ["Speck", "Arch"]
    assert all(name.startswith("Disc") for name in made[:-2])
    assert chosen(drawing) == set(made[:-2])
    assert drawing.status.startswith(f"{operation.title} of Disc and Frame: ")
    drawing.trigger("undo")
    assert drawing.session.document == before
    assert chosen(drawing) == operands


# "o" has a hole by its own rule, and "l" crosses "i"; the disc covers a part of "o" and of "i".
WORD = """<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20" viewBox="-10 -10 20 20">
<g id="Word" fill="#ff8800"><path id="o" fill-rule="evenodd" d="M-8 -4h6v8h-6z M-6 -2h2v4h-2z"/>
<path id="i" d="M0 -4h4v8h-4z"/><path id="l" d="M3 -2h6v4h-6z"/></g>
<circle id="Disc" r="3" cx="-1" fill="#ff8800"/></svg>"""

IN_WORD = {"o": (-7.5, 0.0), "hole": (-5.0, 0.0), "i": (2.5, 1.0), "i and l": (3.5, 0.0), "l": (8.0, 0.0)}
UNDER_DISC = {"o": (-2.5, 0.0), "i": (1.0, 0.0)}


@pytest.mark.parametrize("operation", PATH_OPERATIONS[:3], ids=lambda each: each.name)
def test_a_group_is_one_operand(editor, operation):
    """A disc punched a whole word away: letters were cut from one another."""
    editor.session.commit(read_svg(WORD.encode(), None).document, "Begin", active=0)
    editor.session.selected.choose([])
    editor.window.canvas.camera.show_box((-11, 11), (-11, 11))
    editor.settle()
    before = editor.session.document
    editor.click(IN_WORD["l"])
    press(editor, PATH_OPERATIONS[0])
    assert editor.status.startswith("Union of o, i and l: 1 shape")
    editor.trigger("undo")
    editor.click(OUTSIDE)
    editor.click(IN_WORD["l"])
    editor.click((-1.0, 0.0), keys=SHIFT)
    assert chosen(editor) == set(names(editor))
    press(editor, operation)
    assert editor.status.startswith(f"{operation.title} of Word and Disc: 1 shape")
    is_left = operation.name != "pathIntersection"
    of_word = [is_left, False, is_left, is_left, is_left]
    assert is_painted(editor, *IN_WORD.values()) == of_word
    assert is_painted(editor, *UNDER_DISC.values()) == 2 * [operation.name != "pathDifference"]
    # What was the group is a shape now.
    assert {(curve.shape, curve.groups) for curve in editor.session.document.curves} == {("Word", ())}
    editor.trigger("undo")
    assert editor.session.document == before


def test_points_keep_their_kind_and_lines_stay_straight(drawing):
    """The outcome has the handles of the disc and the lines of the frame, to the last digits."""
    press(drawing, PATH_OPERATIONS[0])
    (outer,) = [curve for curve in drawing.session.document.curves if curve.name == "Disc (1)"]
    positions = [point.position for point in outer.points]
    corners = {(9.0, 1.0), (9.0, -9.0), (-1.0, -9.0)}
    assert corners <= set(positions)
    lines = sum(is_line(outer, segment) for segment in range(len(positions)))
    assert lines == 4
    for place in ((-4.0, 0.0), (0.0, 4.0)):
        point = min(outer.points, key=lambda each: math.dist(each.position, place))
        assert point.position == pytest.approx(place, abs=1e-14)
        assert point.tied or not point.corner
    assert [point.corner and not point.tied for point in outer.points].count(True) == 5


def test_an_open_curve_is_closed_by_a_straight_line(drawing):
    drawing.click(OUTSIDE)
    drawing.click((-7.0, -1.0))
    press(drawing, PATH_OPERATIONS[0])
    (arch,) = [curve for curve in drawing.session.document.curves if curve.name == "Arch"]
    assert arch.closed
    assert [is_line(arch, segment) for segment in range(2)].count(True) == 1


def test_why_nothing_happens_is_said(drawing):
    before = drawing.session.document
    drawing.click(OUTSIDE)
    drawing.click(DISC)
    press(drawing, PATH_OPERATIONS[1])
    assert drawing.status == "“Difference of Shapes” needs two chosen shapes or more."
    drawing.click((-8.5, 8.5), keys=SHIFT)
    press(drawing, PATH_OPERATIONS[2])
    assert drawing.status == "Nothing would be left: intersection of “Disc” and “Speck” is empty."
    assert drawing.session.document is before


def extent(editor, name):
    """The box of a curve that is called so, (2, 2)."""
    (view,) = [view for view in editor.session.views if view.source.name == name]
    return view.drawn_box


@pytest.mark.parametrize(("key", "way"), [("Ctrl+)", 1.0), ("Ctrl+(", -1.0)])
def test_shapes_grow_and_shrink_by_a_clean_length_of_the_unit_of_the_document(drawing, key, way):
    """At first by 1 mm; the disc stays a disc of four smooth points, the frame one of straight lines."""
    drawing.set_unit("mm")
    step = way
    QTest.keySequence(drawing.window, QKeySequence(key))
    drawing.wait_for_work()
    assert extent(drawing, "Disc") == pytest.approx(np.array([[-4, -4], [4, 4]]) * (1 + step / 4), abs=4e-3)
    outer = np.array([[-1.0 - step, -9.0 - step], [9.0 + step, 1.0 + step]])
    assert extent(drawing, "Frame (1)") == pytest.approx(outer, abs=1e-12)
    hole = np.array([[2.0 + step, -6.0 + step], [6.0 - step, -2.0 - step]])
    assert extent(drawing, "Frame (2)") == pytest.approx(hole, abs=1e-12)
    counts = {curve.name: len(curve.points) for curve in drawing.session.document.curves}
    assert (counts["Disc"], counts["Frame (1)"], counts["Frame (2)"]) == (4, 4, 4)
    assert chosen(drawing) == {"Disc", "Frame (1)", "Frame (2)"}
    name = "Outset" if way > 0 else "Inset"
    assert drawing.session.undo_stack.undoText() == f"{name} by 1 mm of Disc and Frame"


def test_a_short_edge_is_no_reason_for_a_warning(drawing):
    """Its parameters were "almost equal" beside long ones: the curve takes its time there."""
    notched = "M0 0H8V8H4.05V7.98H4V8H0Z"
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path id="Notch" d="{notched}"/></svg>'
    drawing.session.commit(read_svg(text.encode(), None).document, "Begin", active=0)
    drawing.session.selected.choose([0])
    drawing.trigger("pathUnion")
    drawing.wait_for_work()
    view = drawing.session.active_view
    gaps = np.diff(view.parameters)
    assert (gaps[1:] / gaps[:-1]).min() < NARROW
    assert warnings_of(view, 1.0) == []
    # Where the points are not as near, the curve is in haste.
    near = replace(view.source.points[1], t=view.parameters[0] + 1e-6)
    points = (view.source.points[0], near, *view.source.points[2:])
    hasty = view_of(replace(view.source, points=points))
    assert [each.topic for each in warnings_of(hasty, 1.0)] == [Topic.GAP]
    assert warnings_of(hasty, 1.0)[0].sentence.endswith("get from one to the other in no time.")


def field_of(editor):
    return editor.window.commands[OffsetCommands].field


def enter(editor, text):
    field = field_of(editor)
    field.edit.selectAll()
    QTest.keyClicks(field.edit, text)
    QTest.keyClick(field.edit, Qt.Key.Key_Return)
    editor.wait_for_work()


def test_a_distance_is_typed_and_used_again(drawing):
    """Outset by exactly 1 mm, and as far back; the next time it is asked for, that is what stands there."""
    drawing.set_unit("mm")
    drawing.click(OUTSIDE)
    drawing.click(DISC)
    for unit, first in {"px": "2 px", "in": "0.05 in", "mm": "1 mm"}.items():
        drawing.set_unit(unit)
        drawing.trigger("pathOffsetBy")
        field = field_of(drawing)
        assert (field.isVisible(), field.edit.text(), field.edit.selectedText()) == (True, first, first)
    enter(drawing, "0.1 cm")
    assert (field.isVisible(), drawing.window.canvas.hasFocus()) == (False, True)
    assert drawing.session.undo_stack.undoText() == "Outset by 0.1 cm of Disc"
    assert extent(drawing, "Disc") == pytest.approx(np.array([[-5, -5], [5, 5]]), abs=2e-3)
    QTest.keySequence(drawing.window, QKeySequence("Ctrl+)"))
    drawing.wait_for_work()
    assert extent(drawing, "Disc") == pytest.approx(np.array([[-6, -6], [6, 6]]), abs=4e-3)
    QTest.keySequence(drawing.window, QKeySequence("Alt+Shift+O"))
    assert field.edit.text() == "0.1 cm"
    QTest.mouseClick(field.findChild(QToolButton, "offsetWay"), Qt.MouseButton.LeftButton)
    enter(drawing, "2")
    assert drawing.session.undo_stack.undoText() == "Inset by 2 mm of Disc"
    assert extent(drawing, "Disc") == pytest.approx(np.array([[-4, -4], [4, 4]]), abs=6e-3)


def test_what_is_no_distance_is_said_beside_it(drawing):
    drawing.set_unit("")
    before = drawing.session.document
    drawing.trigger("pathOffsetBy")
    enter(drawing, "2 mm")
    field = field_of(drawing)
    assert field.remark == "⚠ The document has no unit of length; type a number without “mm”."
    enter(drawing, "0")
    assert field.remark == "⚠ Type a distance other than 0; below 0 it goes the other way."
    QTest.keyClick(field.edit, Qt.Key.Key_Escape)
    assert (field.isVisible(), drawing.session.document is before) == (False, True)


def test_a_line_becomes_a_shape_in_front_of_the_fill(drawing):
    """What is painted stays the same: the line of the frame, 1 wide, and its fill behind it."""
    session = drawing.session
    lined = Style(stroke=BROWN, width=1.0, fill="#0088ff", join=LineJoin.MITER)
    session.change("Line", lambda document: restyled(document, "Frame", lined))
    places = ((-1.3, -7.3), (-0.7, -7.3), (-1.7, -7.3), (0.3, -7.3), (1.7, -5.2), (2.3, -5.2))
    before = is_painted(drawing, *places, colour=BROWN)
    assert before == [True, True, False, False, True, True]
    drawing.click(OUTSIDE)
    drawing.click(FRAME)
    QTest.keySequence(drawing.window, QKeySequence("Ctrl+Shift+O"))
    drawing.wait_for_work()
    drawing.settle()
    frames = [curve for curve in session.document.curves if "Frame" in curve.shape]
    assert [curve.style.has_stroke for curve in frames] == [False] * 6
    assert {curve.style.fill for curve in frames[:2]} == {"#0088ff"}
    assert {curve.style.fill for curve in frames[2:]} == {BROWN}
    drawing.click(OUTSIDE)
    assert is_painted(drawing, *places, colour=BROWN) == before


def test_how_near_an_outline_was_followed_is_told_in_the_unit_of_the_document(drawing):
    drawing.session.change("Unit", lambda document: replace(document, unit="mm"))
    drawing.session.selected.choose([0])
    drawing.trigger("pathOutset")
    drawing.wait_for_work()
    assert re.search(r"; followed within 0\.0*[1-9] mm\.$", drawing.status), drawing.status


def restyled(document, shape, style):
    curves = tuple(
        replace(curve, style=style) if shape in (curve.shape, curve.name) else curve
        for curve in document.curves
    )
    return replace(document, curves=curves)


@pytest.mark.parametrize(
    ("style", "words"),
    [
        (Style(stroke="none", fill=ORANGE), "“Disc” has no line."),
        (Style(width=0.0), "The line of “Disc” has no width."),
    ],
)
def test_lines_that_make_no_shape(drawing, style, words):
    drawing.session.change("Style", lambda document: restyled(document, "Disc", style))
    before = drawing.session.document
    drawing.trigger("strokeToPath")
    assert drawing.status == words
    assert drawing.session.document is before


def test_a_line_of_automatic_width_is_as_wide_as_it_prints_or_is_seen(drawing):
    """The page of 20 makes lines of 0.06; without one it is 2 px of the screen."""
    drawing.session.change("Style", lambda document: restyled(document, "Disc", Style()))
    before = drawing.session.document
    for page, width in ((before.page, 0.06), (None, 2.0 * drawing.pixel)):
        drawing.session.change("Page", lambda _, page=page: replace(before, page=page))
        drawing.session.selected.choose([0])
        drawing.trigger("strokeToPath")
        drawing.wait_for_work()
        outer = extent(drawing, "Disc (1)")
        assert outer == pytest.approx(np.array([[-4, -4], [4, 4]]) * (1 + width / 8), abs=1e-4)


def test_each_dash_becomes_a_contour(drawing):
    """What is painted stays as it is: dashes of 2 and gaps of 1 widths around a circle of 8 pi widths."""
    dashed = Style(stroke=BROWN, width=1.0, dash=(2.0, 1.0), cap=LineCap.BUTT)
    drawing.session.change("Style", lambda document: restyled(document, "Disc", dashed))
    # The circle begins at the right and runs clockwise; the frame leaves its left half free.
    along = (9.2, 10.8, 11.2, 11.8, 12.2, 13.8, 14.2, 14.8)
    places = [(4 * math.cos(s / 4), -4 * math.sin(s / 4)) for s in along]
    drawing.session.selected.choose([])
    before = is_painted(drawing, *places, colour=BROWN)
    assert before == [True, True, False, False, True, True, False, False]
    drawing.session.selected.choose([0])
    drawing.trigger("strokeToPath")
    drawing.wait_for_work()
    assert drawing.status.startswith("Stroke to path of Disc: 1 shape, 8 outlines")
    dashes = chosen(drawing)
    drawing.trigger("undo")
    assert chosen(drawing) == {"Disc"}, "one came back for eight"
    drawing.trigger("redo")
    assert chosen(drawing) == dashes
    drawing.click(OUTSIDE)
    assert is_painted(drawing, *places, colour=BROWN) == before


@pytest.fixture
def tangle(editor):
    """A star whose line crosses itself three thousand times."""
    angles = 2 * np.pi * np.arange(81) * 40 / 81
    corners = " ".join(f"{10 * np.cos(each):.9f},{10 * np.sin(each):.9f}" for each in angles)
    text = f'<svg xmlns="http://www.w3.org/2000/svg"><polygon id="Star" points="{corners}" fill="red"/></svg>'
    editor.session.commit(read_svg(text.encode(), None).document, "Begin", active=0)
    editor.session.selected.choose([0])
    return editor


def test_what_takes_long_leaves_the_window_free_and_can_be_stopped(tangle):
    """The key returns at once; the star goes on to be edited, or Ctrl+. ends the work."""
    before, jobs = tangle.session.document, tangle.window.context.work.jobs
    QTest.keySequence(tangle.window, QKeySequence("Alt+Shift+U"))
    assert jobs.is_busy
    assert jobs.title == "Union of Star"
    assert tangle.action("cancelWork").isEnabled(), "from its begin on, not only when it is shown"
    tangle.key(Qt.Key.Key_Period, CTRL)
    # What runs beside the window hears of it at its next step.
    tangle.wait_for_work()
    assert tangle.status == "Union of Star was stopped; nothing has changed."
    assert tangle.session.document is before


def test_what_was_changed_meanwhile_is_left_alone(tangle):
    tangle.trigger("pathUnion")
    tangle.session.change("Rename", lambda document: read_svg(DRAWING.encode(), None).document)
    tangle.wait_for_work(60.0)
    assert tangle.status == "Union of Star was dropped: the drawing was changed meanwhile."
    assert names(tangle)[0] == "Disc"


def test_cut_path_leaves_open_parts_of_the_hindmost_line_and_takes_the_knife_away(editor):
    drawing = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20" viewBox="-10 -10 20 20">'
        '<circle id="Ring" r="5" fill="none" stroke="#ff8800"/>'
        '<path id="Knife" d="M-8 3H8" stroke="#000"/></svg>'
    )
    document = read_svg(drawing.encode(), None).document
    editor.session.commit(document, "Begin", active=0)
    editor.session.selected.choose([])
    editor.window.canvas.camera.show_box((-11, 11), (-11, 11))
    editor.settle()
    editor.click((-5.0, 0.0))
    editor.click((7.0, -3.0), keys=SHIFT)
    editor.trigger("cutPath")
    editor.wait_for_work()
    parts = editor.session.document.curves
    assert [curve.name for curve in parts] == ["Ring", "Ring 2"]
    assert not any(curve.is_closed for curve in parts)
    assert {curve.style.stroke for curve in parts} == {ORANGE}
    ends = {
        (round(abs(point.x), 9), point.y) for curve in parts for point in (curve.points[0], curve.points[-1])
    }
    # y is upwards here; x² + y² is that of the circle but for what four cubic pieces are off.
    ((x, y),) = ends
    assert y == pytest.approx(-3.0, abs=1e-9)
    assert x == pytest.approx(4.0, abs=2e-3)
    assert editor.session.selected.chosen == {0, 1}
    editor.trigger("undo")
    assert names(editor) == ["Ring", "Knife"]


def test_cut_path_says_where_nothing_crosses(drawing):
    drawing.session.selected.choose([])
    before = drawing.session.document
    drawing.click(DISC)
    drawing.click((-9.0, 8.5), keys=SHIFT)
    drawing.trigger("cutPath")
    drawing.wait_for_work()
    assert drawing.session.document is before
    assert drawing.status == "Nothing in front crosses the hindmost path."
