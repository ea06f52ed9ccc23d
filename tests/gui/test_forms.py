"""Rectangles and ellipses stay what they were drawn as: their handles and numbers, later too."""

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from app.document.forms import Ellipse, Rectangle, Star
from app.document.model import Document, make_curve
from app.document.point_group import points_of
from app.document.several_curves import mapped, whole_curves
from app.document.transforms import IDENTITY, flipping, rotation, scaling, skewing
from app.exchange.svg.writer import svg_of
from app.storage.format import decode, encode
from app.view_model.shapes.formed import Formed, formed

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def drawing(editor):
    """A document in mm with a grid of 0.5, which is snapped to; all between −1 and 7 is seen."""
    editor.session.commit(Document((make_curve(()),), unit="mm", grid_spacing=0.5), "Begin")
    editor.window.canvas.camera.show_box((-1, 9), (-2, 6))
    editor.trigger("toggleSnap")
    editor.settle()
    yield editor
    editor.trigger("toggleSnap")
    editor.new()
    editor.settle()


@pytest.fixture
def rectangle(drawing):
    """One of 6 × 4 from (1, 0) on, the Rectangle tool still in use."""
    drawing.trigger("rectangleTool")
    drawing.drag((1, 0), (7, 4))
    return drawing


def now(editor):
    return formed(editor.curve)


def steps(editor):
    return editor.session.undo_stack.count()


def change(editor, edit):
    group = whole_curves(editor.session.document, [editor.session.active_index])
    assert editor.session.change("Map", lambda document: edit(document, group))


def type_into(editor, name, text):
    edit = editor.window.findChild(QLineEdit, name)
    assert edit.isVisible()
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)
    editor.settle()


def test_a_rectangle_knows_what_it_was_drawn_as_also_in_a_file(rectangle):
    assert rectangle.curve.form == Rectangle(1, 0, 6, 4)
    assert now(rectangle).form is rectangle.curve.form
    document = rectangle.session.document
    assert decode(encode(document)) == document
    assert b'"form": {"kind": "rectangle", "x": 1.0' in encode(document)
    assert b'"form"' not in encode(Document((replace(rectangle.curve, form=None),)))


def test_the_radius_of_its_corners_is_dragged_live_and_is_one_step(rectangle):
    count, before = steps(rectangle), rectangle.session.document
    rectangle.press((7, 4))
    rectangle.move((6, 4))
    assert len(rectangle.curve.points) == 8  # live
    assert rectangle.status.startswith("W 6 · H 4 · Rx 1 · Ry 1 mm · Shift: across and up apart")
    rectangle.escape()
    rectangle.release((6, 4))
    assert (rectangle.session.document, steps(rectangle)) == (before, count)
    rectangle.drag((7, 4), (6, 4))
    assert rectangle.curve.form == Rectangle(1, 0, 6, 4, 1, 1)
    assert rectangle.session.undo_stack.undoText() == f"Change corner radius of “{rectangle.curve.name}”"
    assert steps(rectangle) == count + 1
    # The handle is where the arc begins now; beyond half a side it goes no further.
    rectangle.drag((6, 4), (3, 4))
    assert rectangle.curve.form == Rectangle(1, 0, 6, 4, 2, 2)
    assert len(rectangle.curve.points) == 6
    rectangle.drag((5, 4), (6, 4), keys=SHIFT)
    assert rectangle.curve.form == Rectangle(1, 0, 6, 4, 1, 2)
    rectangle.drag((6, 4), (7, 4))
    assert rectangle.curve.form == Rectangle(1, 0, 6, 4)
    assert len(rectangle.curve.points) == 4


def test_its_size_is_dragged_by_a_corner_and_the_radius_stays(rectangle):
    rectangle.drag((7, 4), (6.5, 4))
    rectangle.drag((7, 0), (8, -1))
    assert rectangle.curve.form == Rectangle(1, -1, 7, 5, 0.5, 0.5)
    rectangle.drag((1, 4), (2, 4))
    assert rectangle.curve.form == Rectangle(2, -1, 6, 5, 0.5, 0.5)
    assert len(rectangle.session.document.curves) == 1
    rectangle.drag((3, 1), (4, 2))
    assert len(rectangle.session.document.curves) == 2, "elsewhere another one is drawn"


def test_moved_turned_and_stretched_it_is_one_still(rectangle):
    rectangle.drag((7, 4), (6, 4))
    change(rectangle, lambda document, group: mapped(document, group, scaling(0.5, 2, (1, 0))))
    assert now(rectangle) == Formed(Rectangle(1, 0, 3, 8, 0.5, 2), IDENTITY)
    change(rectangle, lambda document, group: mapped(document, group, scaling(2, 0.5, (1, 0))))
    change(rectangle, lambda document, group: mapped(document, group, rotation(30, (1, 0))))
    turned = now(rectangle)
    assert turned.form == Rectangle(1, 0, 6, 4, 1, 1)
    assert turned.by.point((2, 0)) == pytest.approx(rotation(30, (1, 0)).point((2, 0)))
    change(rectangle, lambda document, group: mapped(document, group, rotation(60, (1, 0))))
    # It stands upright now, to the left of (1, 0): its upper right corner is at (−3, 6).
    rectangle.window.canvas.camera.show_box((-5, 5), (-1, 7))
    rectangle.drag((-3, 5), (-3, 4))
    assert now(rectangle).form == Rectangle(1, 0, 6, 4, 2, 2)
    places = sorted((round(point.x, 9), round(point.y, 9)) for point in rectangle.curve.points)
    assert places == [(-3, 2), (-3, 4), (-1, 0), (-1, 6), (1, 2), (1, 4)]
    change(rectangle, lambda document, group: mapped(document, group, flipping(0, (0, 0))))
    assert now(rectangle).form == Rectangle(-1, 0, 6, 4, 2, 2), "a mirror image is one, too"


def test_with_a_point_elsewhere_it_is_none_any_more(rectangle):
    group = points_of(rectangle.session.active_index, [0])
    rectangle.session.change(
        "Move", lambda document: mapped(document, group, replace(IDENTITY, shift=(0.1, 0)))
    )
    assert now(rectangle) is None
    curves = len(rectangle.session.document.curves)
    rectangle.drag((7, 4), (6, 3))
    assert len(rectangle.session.document.curves) == curves + 1, "no handle is there"
    rectangle.trigger("undo")
    rectangle.trigger("undo")
    assert now(rectangle) is not None


def test_an_ellipse_keeps_its_middle_and_may_be_a_circle(drawing):
    drawing.trigger("ellipseTool")
    drawing.drag((1, 0), (7, 4))
    assert drawing.curve.form == Ellipse(1, 0, 6, 4)
    drawing.drag((7, 2), (6, 2))
    assert drawing.curve.form == Ellipse(2, 0, 4, 4)
    drawing.drag((4, 4), (4, 5))
    drawing.drag((6, 2), (5, 2), keys=CTRL)
    assert drawing.curve.form == Ellipse(3, 1, 2, 2)
    change(drawing, lambda document, group: mapped(document, group, skewing(0, 20, (0, 0))))
    assert len(drawing.curve.points) == 4, "skewed it is at most an ellipse in a slanted frame"


def test_a_click_on_another_form_edits_it(rectangle):
    rectangle.drag((2, 1), (3, 2))
    inner = rectangle.session.active_index
    rectangle.press((4, 0))
    rectangle.release((4, 0))
    assert rectangle.session.active_index != inner
    assert now(rectangle).form == Rectangle(1, 0, 6, 4)
    assert [mark.place for mark in rectangle.window.canvas.marks.forms] == [(7, 4), (7, 4), (1, 4), (7, 0)]


def test_its_own_width_and_radii_are_typed_in_the_transform_panel(rectangle, point_locale):
    change(rectangle, lambda document, group: mapped(document, group, rotation(30, (1, 0))))
    rectangle.trigger("openTransform")
    rectangle.settle()

    assert rectangle.window.findChild(QLineEdit, "formRectangleWidth").text() == "6"
    type_into(rectangle, "formRectangleWidth", "0.5 cm")
    type_into(rectangle, "formRectangleRx", "1")
    assert now(rectangle).form == Rectangle(1, 0, 5, 4, 1, 1)
    assert now(rectangle).by is not IDENTITY
    assert rectangle.session.undo_stack.undoText() == "Set radius of its corners to 1 mm"
    type_into(rectangle, "formRectangleRy", "2")
    assert now(rectangle).form == Rectangle(1, 0, 5, 4, 1, 2)
    before = rectangle.session.document
    type_into(rectangle, "formRectangleHeight", "-1")
    assert rectangle.session.document is before
    assert "must be greater than 0" in rectangle.status
    rectangle.escape()
    rectangle.session.change(
        "Open", lambda document: replace(document, curves=(make_curve([(0, 0), (1, 1)]),))
    )
    rectangle.settle()
    assert not rectangle.window.findChild(QLineEdit, "formRectangleWidth").isVisible()


def test_a_turned_rectangle_says_its_angle_whenever_it_is_chosen_and_so_does_its_copy(
    rectangle, point_locale
):
    rectangle.trigger("openTransform")
    rectangle.escape()
    angle = rectangle.window.findChild(QLineEdit, "transformAngle")
    type_into(rectangle, "transformAngle", "10")
    rectangle.trigger("duplicateSelection")
    assert len(rectangle.session.document.curves) == 2
    assert angle.text() == "10"
    # Pasted beside, it is chosen whole, and not where it was.
    rectangle.session.selected.set_curves([0, 1])
    rectangle.trigger("copyPoints")
    rectangle.trigger("pastePoints")
    assert len(rectangle.session.document.curves) == 4
    rectangle.session.selected.activate(3)
    rectangle.settle()
    assert angle.text() == "10"
    before = now(rectangle).form
    type_into(rectangle, "transformAngle", "0")
    assert now(rectangle).by is IDENTITY
    assert now(rectangle).form.width == before.width
    type_into(rectangle, "transformAngle", "-100")
    assert now(rectangle).angle == -100
    assert angle.text().replace("−", "-") == "-100"


@pytest.mark.parametrize("flip", ["flipHorizontally", "flipVertically"])
def test_a_mirrored_rectangle_that_is_chosen_again_stands_at_no_angle(rectangle, flip):
    """Mirrored upside down it said 180°."""
    rectangle.trigger(flip)
    assert now(rectangle).angle == 0
    rectangle.trigger("rotateRight")
    assert now(rectangle).angle == -15


def test_the_numbers_of_several_rectangles_are_set_in_one_step(rectangle, point_locale):
    rectangle.trigger("openTransform")
    rectangle.trigger("rectangleTool")
    rectangle.drag((-0.5, -0.5), (0.5, 2))
    rectangle.session.selected.set_curves([0, 1])
    rectangle.settle()
    shown = {
        name: rectangle.window.findChild(QLineEdit, f"formRectangle{name}") for name in ("Width", "Rx", "Ry")
    }
    assert [edit.text() for edit in shown.values()] == ["mixed", "0", "0"]
    before = steps(rectangle)
    type_into(rectangle, "formRectangleRx", "0.25")
    forms = [formed(curve).form for curve in rectangle.session.document.curves]
    assert [(form.width, form.rx) for form in forms] == [(6, 0.25), (1, 0.25)]
    assert steps(rectangle) == before + 1
    assert rectangle.session.undo_stack.undoText() == "Set Rx of 2 rectangles to 0.25 mm"
    assert shown["Rx"].text() == "0.25"
    rectangle.trigger("ellipseTool")
    rectangle.drag((2, 1), (3, 2))
    rectangle.session.selected.set_curves([0, 1, 2])
    rectangle.settle()
    assert not shown["Rx"].isVisible()


def test_a_star_is_drawn_from_its_middle_and_stays_one(drawing):
    drawing.trigger("starTool")
    drawing.press((4, 2))
    drawing.move((4, 3))
    drawing.key(Qt.Key.Key_6)
    drawing.key(Qt.Key.Key_Tab)
    drawing.type_amount(".5")
    assert drawing.status.startswith("6 corners · ratio .5| · radius 1 mm")
    assert len(drawing.curve.points) == 12  # live
    drawing.move((6, 2))
    drawing.release((6, 2))
    assert drawing.curve.form == Star(4, 2, 2, 6, 0.5, 0)
    assert drawing.session.undo_stack.undoText() == "Draw star"
    assert [point.position for point in drawing.curve.points][::6] == [(6, 2), (2, pytest.approx(2))]
    drawing.drag((6, 2), (6, 4), keys=CTRL)
    assert now(drawing).form.angle == 45
    assert now(drawing).form.radius == pytest.approx(8**0.5)
    assert drawing.session.undo_stack.undoText() == f"Change radius and angle of “{drawing.curve.name}”"
    change(drawing, lambda document, group: mapped(document, group, rotation(-45, (4, 2))))
    change(drawing, lambda document, group: mapped(document, group, scaling(0.5, 0.5, (4, 2))))
    assert now(drawing).form.radius == pytest.approx(2**0.5)
    count = len(drawing.session.document.curves)
    drawing.drag((-0.5, 0), (0, 0))
    assert (drawing.curve.form.corners, drawing.curve.form.ratio) == (6, 0.5), "the next one is like it"
    assert len(drawing.session.document.curves) == count + 1


def test_corners_and_ratio_of_a_star_are_typed_later_and_a_ratio_of_1_is_a_polygon(drawing, point_locale):
    drawing.trigger("starTool")
    drawing.drag((4, 2), (4, 4))
    assert drawing.curve.form == Star(4, 2, 2, 5, 0.5, 90)
    drawing.trigger("openTransform")
    drawing.settle()
    type_into(drawing, "formStarCorners", "8")
    type_into(drawing, "formStarRatio", "1")
    assert now(drawing).form == Star(4, 2, 2, 8, 1.0, 90)
    assert len(drawing.curve.points) == 8
    before = drawing.session.document
    type_into(drawing, "formStarCorners", "2")
    assert drawing.session.document is before
    assert "from 3 to 1000" in drawing.status
    drawing.escape()
    text = svg_of(before).text
    assert "<path" in text
    assert decode(encode(before)) == before
