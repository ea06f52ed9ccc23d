"""The eyedroppers: the colour seen at a place becomes the fill, or the stroke, of what is chosen."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton, QWidget

from app.document.gradient import Gradient, Stop
from app.document.gradient_edits import PaintedStop
from app.document.model import Document, make_curve
from app.document.style import NO_PAINT, Style
from app.families import HERMITE
from app.features.reference_image.commands import ImageCommands

SHIFT = Qt.KeyboardModifier.ShiftModifier
BLUE, RED, WHITE = "#0072b2", "#d55e00", "#ffffff"


def square(x, y, side, name, style):
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    curve = make_curve(corners, name=name, family=HERMITE)
    points = tuple(replace(point, corner=True, velocity=None) for point in curve.points)
    return replace(curve, points=points, closed=True, style=style)


@pytest.fixture
def sheet(editor):
    """A blue square with a red line 0.5 wide, half covered by a veil of red; a square to colour, chosen."""
    fading = Gradient((Stop(0.0, "#000000"), Stop(1.0, WHITE)), start=(10, 0), end=(14, 0), side=(10, 4))
    curves = (
        square(0, 0, 4, "Leaf", Style(stroke=RED, width=0.5, fill=BLUE)),
        square(2, 0, 4, "Veil", Style(stroke=NO_PAINT, fill=RED, fill_opacity=0.5)),
        square(10, 0, 4, "Sky", Style(stroke=NO_PAINT, fill="#808080", fill_gradient=fading)),
        square(0, 6, 2, "Root", Style(stroke=NO_PAINT, fill="#009e73")),
    )
    editor.session.commit(Document(curves), "Begin")
    editor.window.canvas.camera.show_box((-2, 16), (-2, 10))
    editor.session.selected.choose([3])
    editor.settle()
    return editor


def root(editor):
    return editor.session.document.curves[3].style


@pytest.mark.parametrize(
    ("place", "colour"),
    [
        ((1, 2), BLUE),
        ((1, 0.1), RED),  # within its line, though a pixel beside the middle of it
        ((5, 2), "#eaae80"),  # red at one half over white
        ((3, 2), "#6b6859"),  # and over blue
        ((12, 2), "#808080"),
        ((7, 8), WHITE),
    ],
)
def test_a_click_takes_the_colour_seen_there_as_one_step(sheet, place, colour):
    before = sheet.session.document
    sheet.key(Qt.Key.Key_F7)
    sheet.hover(place)
    seen = sheet.window.status_line.hint
    assert seen.endswith(" · Click: fill of Root · Shift: its stroke · V goes back to Select")
    assert sheet.window.canvas.marks.note.text == seen[:7]
    sheet.click(place)
    got, wanted = QColor(root(sheet).fill), QColor(colour)
    assert root(sheet).fill == seen[:7]
    # Each of Qt's blends rounds a level.
    assert all(abs(a - b) <= 2 for a, b in zip(got.getRgb(), wanted.getRgb(), strict=True))
    assert sheet.session.undo_stack.undoText() == "Fill of Root"
    sheet.trigger("undo")
    assert sheet.session.document == before


def test_shift_and_the_other_tool_are_for_the_stroke(sheet):
    sheet.key(Qt.Key.Key_F7)
    sheet.click((1, 2), keys=SHIFT)
    assert (root(sheet).stroke, root(sheet).fill) == (BLUE, "#009e73")
    sheet.key(Qt.Key.Key_F7, SHIFT)
    sheet.click((1, 0.1))
    assert (root(sheet).stroke, root(sheet).fill) == (RED, "#009e73")
    sheet.click((1, 2), keys=SHIFT)
    assert root(sheet).fill == BLUE


def test_without_anything_chosen_it_says_what_is_missing(sheet):
    sheet.session.selected.choose([])
    before = sheet.session.document
    sheet.key(Qt.Key.Key_F7)
    sheet.hover((1, 2))
    assert sheet.window.status_line.hint == f"{BLUE} · Choose a curve first: it gets the colour."
    sheet.click((1, 2))
    assert sheet.session.document is before
    assert sheet.status == "Choose a curve first: it gets the colour."


def test_the_panel_has_a_button_beside_each_field_and_its_chosen_stop_gets_the_colour(sheet):
    sheet.show_dock("styleDock")
    panel = sheet.window.findChild(QWidget, "stylePanel")
    QTest.mouseClick(panel.findChild(QToolButton, "strokePaintDropperButton"), Qt.MouseButton.LeftButton)
    sheet.click((1, 2))
    assert root(sheet).stroke == BLUE
    sheet.session.selected.choose([2])
    sheet.settle()
    QTest.mouseClick(panel.findChild(QToolButton, "fillPaintDropperButton"), Qt.MouseButton.LeftButton)
    sheet.click((1, 2))
    sky = sheet.session.document.curves[2].style.fill_gradient
    assert [stop.colour for stop in sky.stops] == [BLUE, WHITE]


def test_beside_a_flat_fill_too_the_chosen_stop_gets_it_and_the_gradient_stays(sheet):
    session = sheet.session
    session.selected.choose([2, 3])
    session.selected.stop.choose(PaintedStop(2, "fill", 1))
    sheet.key(Qt.Key.Key_F7)
    sheet.click((1, 2))
    sky = session.document.curves[2].style
    assert [stop.colour for stop in sky.fill_gradient.stops] == ["#000000", BLUE]
    # What is flat gets the colour.
    assert (root(sheet).fill, root(sheet).fill_gradient) == (BLUE, None)
    assert session.undo_stack.undoText().startswith("Fill of ")


def test_a_hairline_need_not_be_met_exactly_and_a_picture_has_its_own_colours(sheet, tmp_path):
    style = Style(stroke=RED, width=1e-6, dash=(1.0, 9.0))
    line = replace(make_curve([(8.0, 6.0), (14.0, 6.0)], name="Hair"), style=style)
    document = sheet.session.document
    sheet.session.commit(replace(document, curves=(*document.curves, line)), "Add")
    sheet.session.selected.choose([3])
    sheet.key(Qt.Key.Key_F7)
    sheet.click((11.0, 6.0 + 2 * sheet.pixel))
    assert root(sheet).fill == RED
    image = QImage(60, 60, QImage.Format.Format_RGB32)
    image.fill(QColor("#123456"))
    assert image.save(str(tmp_path / "dark.png"))
    sheet.window.commands[ImageCommands].trace(tmp_path / "dark.png")
    picture = sheet.session.document.image
    at = (picture.x + picture.width / 2, picture.y + picture.height * 0.95)
    sheet.click(at)
    assert root(sheet).fill == "#123456"
