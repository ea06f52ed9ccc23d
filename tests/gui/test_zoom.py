"""Zoom: keys, the field in the status line, true size, fits and the way back."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu, QToolButton

from app.document.expression import ExpressionError
from app.document.model import Document, make_curve
from app.features.view.zoom import PastViews, ZoomCommands, per_cent_text, pixels_at_full_size, read_zoom
from app.plotting.scrolling import ZOOM_STEP

CTRL, SHIFT, ALT = (
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
FAR_APART = Document(
    (
        make_curve(((0.0, 0.0), (1.0, 2.0)), name="left"),
        make_curve(((90.0, 0.0), (91.0, 1.0), (92.0, 0.0)), name="right"),
    )
)


@pytest.fixture
def drawing(editor):
    editor.session.commit(FAR_APART, "Begin", active=0)
    editor.fit()
    return editor


def zoom_of(editor):
    return editor.window.canvas.pixel_map.sx


def field(editor):
    editor.wait_for_rest()
    return editor.window.commands[ZoomCommands].field.edit


def leave(editor):
    """Move the pointer off the canvas."""
    editor.window.canvas._left()


ZOOM_KEYS = [
    (Qt.Key.Key_Equal, CTRL, ZOOM_STEP),
    (Qt.Key.Key_Plus, CTRL, ZOOM_STEP),
    (Qt.Key.Key_Plus, Qt.KeyboardModifier.NoModifier, ZOOM_STEP),
    (Qt.Key.Key_Minus, CTRL, 1 / ZOOM_STEP),
    (Qt.Key.Key_Minus, Qt.KeyboardModifier.NoModifier, 1 / ZOOM_STEP),
]


def test_the_keys_of_the_platform_zoom(drawing):
    for key, keys, factor in ZOOM_KEYS:
        before = zoom_of(drawing)
        drawing.key(key, keys)
        assert zoom_of(drawing) == pytest.approx(before * factor), (key, keys)


def test_keys_zoom_about_the_pointer_or_the_middle(drawing):
    canvas = drawing.window.canvas
    place = canvas.to_plane(canvas.camera.centre().toPoint() + QPoint(120, 60))
    drawing.hover(place)
    pixel = canvas.to_pixel(*place)
    for _ in range(3):
        drawing.key(Qt.Key.Key_Equal, CTRL)
    assert (canvas.to_pixel(*place) - pixel).manhattanLength() <= 1
    leave(drawing)
    middle = canvas.to_plane(canvas.camera.centre())
    drawing.key(Qt.Key.Key_Minus, CTRL)
    assert canvas.to_plane(canvas.camera.centre()) == pytest.approx(middle)
    assert (canvas.to_pixel(*place) - pixel).manhattanLength() > 20


def test_the_scale_for_projectors_has_its_own_keys(drawing):
    before = zoom_of(drawing)
    for key, scale in ((Qt.Key.Key_Equal, 1.25), (Qt.Key.Key_Minus, 1.0), (Qt.Key.Key_Minus, 0.75)):
        drawing.key(key, CTRL | ALT)
        assert drawing.window.store.state.scale == scale
    drawing.key(Qt.Key.Key_0, CTRL | ALT)
    assert drawing.window.store.state.scale == 1.0
    assert zoom_of(drawing) == pytest.approx(before)


def test_true_size_is_that_of_the_unit_on_this_screen():
    assert pixels_at_full_size("mm", 96) == pytest.approx(3.7795, abs=1e-4)
    assert pixels_at_full_size("in", 96) == pytest.approx(96)
    assert pixels_at_full_size("px", 96) == pytest.approx(1)
    assert pixels_at_full_size("pt", 72) == pytest.approx(1)
    assert pixels_at_full_size("", 96) == pixels_at_full_size("s", 96) == 100


def test_ctrl_0_shows_a_millimetre_at_its_real_length(drawing):
    drawing.set_unit("mm")
    drawing.key(Qt.Key.Key_0, CTRL)
    canvas = drawing.window.canvas
    assert zoom_of(drawing) == pytest.approx(canvas.logicalDpiX() / 25.4)
    assert field(drawing).text() == "100 %"
    assert "1 mm is 3.78 pixels" in field(drawing).toolTip()
    drawing.set_unit("")
    assert field(drawing).text() == "3.78 %"
    assert "a length of 1 as 100 pixels" in field(drawing).toolTip()


@pytest.mark.parametrize(
    ("share", "text"),
    [
        (1.0, "100 %"),
        (2.5, "250 %"),
        (0.0033333, "0.333 %"),
        (123.456, "12300 %"),
        (1e-7, "1e−5 %"),
        (3e8, "3e10 %"),
    ],
)
def test_a_zoom_has_three_digits(share, text):
    assert per_cent_text(share) == text


@pytest.mark.parametrize("text", ["250 %", "250%", "250", " 500/2 ", "2,5*100"])
def test_a_zoom_is_typed_as_a_number_or_an_expression(text):
    assert read_zoom(text.replace(",", ".")) == pytest.approx(2.5)


@pytest.mark.parametrize("text", ["", "%", "0", "-5 %", "big", "1e13"])
def test_a_text_that_is_no_zoom_is_refused(text):
    with pytest.raises(ExpressionError):
        read_zoom(text)


def type_zoom(editor, text, key=Qt.Key.Key_Return):
    edit = field(editor)
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)
    QTest.keyClick(edit, key)
    editor.settle()


def test_a_typed_zoom_is_applied_and_the_focus_returns_to_the_canvas(drawing):
    leave(drawing)
    middle = drawing.window.canvas.to_plane(drawing.window.canvas.camera.centre())
    type_zoom(drawing, "250 %")
    assert zoom_of(drawing) == pytest.approx(250)
    assert drawing.window.canvas.hasFocus()
    assert drawing.window.canvas.to_plane(drawing.window.canvas.camera.centre()) == pytest.approx(middle)
    assert field(drawing).text() == "250 %"


def test_escape_and_invalid_texts_keep_the_zoom(drawing):
    before = zoom_of(drawing)
    type_zoom(drawing, "nonsense")
    assert "“nonsense” is not a number" in drawing.status
    assert field(drawing).text() == "nonsense"
    QTest.keyClick(field(drawing), Qt.Key.Key_Escape)
    assert field(drawing).text() == per_cent_text(before / 100)
    type_zoom(drawing, "77", Qt.Key.Key_Escape)
    assert zoom_of(drawing) == before
    type_zoom(drawing, "0")
    assert "greater than 0" in drawing.status
    QTest.keyClick(field(drawing), Qt.Key.Key_Escape)
    type_zoom(drawing, "1e12")
    type_zoom(drawing, "1e12")
    assert zoom_of(drawing) <= 1e12


def test_the_readout_follows_the_wheel(drawing):
    leave(drawing)
    before = zoom_of(drawing)
    drawing.wheel((0.0, 0.0), 2)
    assert field(drawing).text() == per_cent_text(before * ZOOM_STEP**2 / 100)


def test_a_click_beside_the_zoom_offers_usual_values(drawing):
    field(drawing)
    button = drawing.window.findChild(QToolButton, "zoomChoices")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    menu = drawing.menu()
    assert menu.objectName() == "zoomMenu"
    names = [each.objectName() for each in menu.actions() if each.objectName()]
    assert set(names) == {"zoom100", "fitView", "fitSelection", "previousView"}
    drawing.choose("zoom100")
    assert zoom_of(drawing) == pytest.approx(100)
    assert isinstance(menu, QMenu)


def test_selected_points_fill_the_canvas(drawing):
    canvas = drawing.window.canvas
    drawing.session.selected.activate(1)
    drawing.select([0, 1])
    drawing.key(Qt.Key.Key_3, CTRL)
    x_min, _, x_max, _ = canvas.pixel_map.box
    assert x_min < 90
    assert x_max > 91
    y_min, y_max = canvas.pixel_map.box[1::2]
    assert y_min < 0
    assert y_max > 1
    assert min(x_max - x_min, y_max - y_min) < 1.6
    # A single point comes to the middle.
    before = zoom_of(drawing)
    drawing.select([2])
    drawing.key(Qt.Key.Key_F, SHIFT)
    assert zoom_of(drawing) == pytest.approx(before)
    assert canvas.to_plane(canvas.camera.centre()) == pytest.approx((92, 0), abs=2 / before)


def test_selected_curves_fill_the_canvas_where_no_point_is_selected(drawing):
    drawing.key(Qt.Key.Key_3, CTRL)
    x_min, y_min, x_max, y_max = drawing.window.canvas.pixel_map.box
    assert x_max - x_min < 10
    assert y_min < 0
    assert y_max > 2
    drawing.session.selected.set_curves([0, 1])
    drawing.key(Qt.Key.Key_3, CTRL)
    x_min, _, x_max, _ = drawing.window.canvas.pixel_map.box
    assert x_min < 0
    assert x_max > 92


def test_previous_view_returns_step_by_step(drawing):
    camera = drawing.window.canvas.camera
    leave(drawing)
    boxes = [camera.pixel_map.box]
    for key in (Qt.Key.Key_3, Qt.Key.Key_0):
        drawing.key(key, CTRL)
        boxes.append(camera.pixel_map.box)
    for box in reversed(boxes[:-1]):
        drawing.key(Qt.Key.Key_QuoteLeft)
        assert camera.pixel_map.box == pytest.approx(box)


def test_notches_of_the_wheel_in_a_row_are_one_step_back(drawing):
    camera = drawing.window.canvas.camera
    drawing.wait_for_rest()
    before = camera.pixel_map.box
    # However slow the machine is, the notches come one after the other.
    moving = drawing.window.findChild(PastViews)._moving
    pace = moving.interval()
    moving.setInterval(600_000)
    for _ in range(5):
        drawing.wheel((1.0, 1.0), 1)
    moving.setInterval(pace)
    drawing.trigger("previousView")
    assert camera.pixel_map.box == pytest.approx(before)


def test_another_document_has_no_previous_views(drawing):
    drawing.key(Qt.Key.Key_0, CTRL)
    drawing.new()
    drawing.trigger("previousView")
    drawing.trigger("previousView")
    assert drawing.status == "There is no previous view."


def test_without_a_selection_there_is_nothing_to_zoom_to(drawing):
    drawing.session.selected.select_whole(())
    before = drawing.window.canvas.pixel_map.box
    assert not drawing.action("fitSelection").isEnabled()
    drawing.key(Qt.Key.Key_3, CTRL)
    assert drawing.window.canvas.pixel_map.box == before
    assert drawing.status == "No curve is selected. Click one, or press Ctrl+A to select all."
