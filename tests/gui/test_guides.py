"""Rulers and guides: drawn out of a ruler, dragged, typed, snapped to, hidden, locked, cleared, saved."""

from __future__ import annotations

import re

import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton

from app.appearance.theme import DARK, LIGHT
from app.document.expression import ExpressionError
from app.document.guide_edits import add_guide
from app.document.model import Axis, Document, Guide, make_curve
from app.exchange.options import Options
from app.exchange.svg.writer import svg_of
from app.families import HERMITE
from app.features.guides.commands import GuideCommands
from app.features.guides.places import TypedPlace, read_place
from app.storage.files import load, save
from app.tools.canvas.add import ADD

LINE = Document((make_curve(((0.0, 0.0), (1.03, 2.04), (3.07, 2.11), (4.0, 0.0))),))


@pytest.fixture
def drawing(editor):
    """A curve, with rulers along the canvas."""
    editor.session.commit(LINE, "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.settle()
    return editor


def guides(editor):
    return [(guide.axis.value, guide.position) for guide in editor.session.document.guides]


def above(editor, x=1.0):
    """A pixel on the upper ruler."""
    canvas = editor.window.canvas
    return QPoint(canvas.to_pixel(x, 0.0).x(), int(canvas.camera.origin.y()) - 10)


def beside(editor, y=1.0):
    """A pixel on the left ruler."""
    canvas = editor.window.canvas
    return QPoint(int(canvas.camera.origin.x()) - 20, canvas.to_pixel(0.0, y).y())


def draw(editor, start, to):
    """Drag from a pixel to a place of the plane."""
    editor.drag_pixels(editor.window.canvas, start, editor.window.canvas.to_pixel(*to))


def begin(editor, start, to):
    """Press at a pixel and drag to another, and hold."""
    canvas = editor.window.canvas
    editor.send(canvas, QEvent.Type.MouseMove, start, held=False)
    editor.send(canvas, QEvent.Type.MouseButtonPress, start)
    for step in range(1, 5):
        editor.send(canvas, QEvent.Type.MouseMove, start + (to - start) * step / 4)
    editor.settle()


def let_go(editor, pixel):
    editor.send(editor.window.canvas, QEvent.Type.MouseButtonRelease, pixel, held=False)
    editor.settle()


def with_guides(editor, *places):
    editor.session.change("Guides", lambda now: guided(now, places))
    editor.settle()


def guided(document, places):
    for axis, position in places:
        document = add_guide(document, Axis(axis), position)
    return document


# Out of the ruler


def test_a_guide_is_drawn_out_of_the_upper_ruler_live_and_in_one_step(drawing):
    canvas, steps = drawing.window.canvas, drawing.session.undo_stack.count()
    end = canvas.to_pixel(1.0, 3.0)
    begin(drawing, above(drawing), end)
    (guide,) = drawing.session.document.guides
    assert guide.axis is Axis.Y
    assert guide.position == pytest.approx(3.0, abs=drawing.pixel)
    assert len(str(guide.position)) <= 5
    assert f"Guide y = {guide.position:g}" in drawing.status
    assert drawing.session.undo_stack.count() == steps
    let_go(drawing, end)
    assert guides(drawing) == [("y", guide.position)]
    assert drawing.session.undo_stack.count() == steps + 1
    assert drawing.session.undo_stack.undoText() == f"Guide at y = {guide.position:g}"
    drawing.trigger("undo")
    assert guides(drawing) == []


def test_one_is_drawn_out_of_the_left_ruler_whatever_tool_is_in_use(drawing):
    for tool in ("addTool", "pencilTool", "measureTool", "selectTool"):
        drawing.trigger(tool)
        before = drawing.session.document
        draw(drawing, beside(drawing), (2.0, 1.0))
        assert guides(drawing) == [("x", pytest.approx(2.0, abs=drawing.pixel))]
        assert drawing.session.document.curves == before.curves
        assert drawing.window.store.state.tool.action == tool
        drawing.trigger("undo")


def test_escape_a_click_and_the_way_back_draw_none(drawing):
    canvas, steps = drawing.window.canvas, drawing.session.undo_stack.count()
    end = canvas.to_pixel(1.0, 3.0)
    begin(drawing, above(drawing), end)
    drawing.escape()
    assert guides(drawing) == []
    let_go(drawing, end)
    drawing.drag_pixels(canvas, above(drawing), above(drawing))
    drawing.drag_pixels(canvas, above(drawing, 0.0), above(drawing, 3.0))
    begin(drawing, above(drawing), end)
    ruler = above(drawing)
    drawing.send(canvas, QEvent.Type.MouseMove, ruler)
    drawing.settle()
    assert guides(drawing) == []
    let_go(drawing, ruler)
    assert guides(drawing) == []
    assert drawing.session.undo_stack.count() == steps
    assert not canvas.is_dragging


def test_the_ruler_says_what_a_press_does_and_shows_it(drawing):
    canvas = drawing.window.canvas
    drawing.send(canvas, QEvent.Type.MouseMove, above(drawing), held=False)
    drawing.settle()
    assert drawing.window.status_line.hint.startswith("Drag onto the drawing for a guide")
    assert canvas.viewport().cursor().shape() == Qt.CursorShape.SizeVerCursor
    drawing.send(canvas, QEvent.Type.MouseMove, beside(drawing), held=False)
    assert canvas.viewport().cursor().shape() == Qt.CursorShape.SizeHorCursor


def test_a_new_guide_snaps_to_points_and_says_so(drawing):
    drawing.trigger("toggleSnap")
    near = drawing.window.canvas.to_pixel(3.07 + 3 * drawing.pixel, 1.0)
    begin(drawing, beside(drawing), near)
    assert "snapped to: straight below point 2" in drawing.status
    let_go(drawing, near)
    assert guides(drawing) == [("x", 3.07)]
    drawing.trigger("toggleSnap")


# A guide in hand


def test_a_guide_is_dragged_elsewhere_and_escape_brings_it_back(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    steps = drawing.session.undo_stack.count()
    drawing.drag((-1.0, 1.0), (-2.0, 0.0))
    assert guides(drawing) == [("x", pytest.approx(-2.0, abs=drawing.pixel)), ("y", 4.0)]
    assert drawing.session.undo_stack.count() == steps + 1
    assert drawing.session.undo_stack.undoText().startswith("Move guide to x = −")
    before = guides(drawing)
    drawing.press((6.0, 4.0))
    drawing.move((6.0, 3.0))
    assert guides(drawing) != before
    drawing.escape()
    assert guides(drawing) == before
    drawing.release((6.0, 3.0))
    assert drawing.session.undo_stack.count() == steps + 1


def test_dragged_back_to_the_ruler_it_is_gone(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    canvas = drawing.window.canvas
    begin(drawing, canvas.to_pixel(-1.0, 1.0), beside(drawing))
    assert drawing.status.startswith("Let go to remove the guide")
    let_go(drawing, beside(drawing))
    assert guides(drawing) == [("y", 4.0)]
    assert drawing.session.undo_stack.undoText() == "Remove guide at x = −1"
    draw_back = canvas.to_pixel(6.0, 4.0)
    drawing.drag_pixels(canvas, draw_back, above(drawing))
    assert guides(drawing) == []


def test_delete_removes_the_guide_under_the_pointer_while_no_point_is_selected(drawing):
    with_guides(drawing, ("x", -1.0))
    drawing.select([1])
    drawing.hover((-1.0, 1.0))
    assert "Del" not in drawing.window.status_line.hint
    drawing.key(Qt.Key.Key_Delete)
    assert guides(drawing) == [("x", -1.0)]
    assert len(drawing.curve.points) == 3
    drawing.hover((-1.5, 1.0))
    drawing.hover((-1.0, 1.0))
    assert "Del: remove it" in drawing.window.status_line.hint
    drawing.key(Qt.Key.Key_Delete)
    assert guides(drawing) == []
    assert len(drawing.curve.points) == 3
    assert drawing.session.undo_stack.undoText() == "Remove guide at x = −1"


def test_points_and_the_curve_come_before_a_guide(drawing):
    with_guides(drawing, ("x", 1.03))
    drawing.drag((1.03, 2.04), (1.5, 3.0))
    assert guides(drawing) == [("x", 1.03)]
    assert drawing.point(1) == pytest.approx((1.5, 3.0), abs=drawing.pixel)


def test_arrow_keys_move_the_guide_that_was_clicked_by_clean_numbers_in_one_step(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.25))
    drawing.select([1])
    points, steps = drawing.curve.points, drawing.session.undo_stack.count()
    drawing.click((6.0, 4.25))
    assert "Arrow keys: move it" in drawing.status
    drawing.hover((6.0, 0.0))
    assert drawing.window.canvas.drawing.guides.lit == 1
    for _ in range(3):
        drawing.key(Qt.Key.Key_Up)
    step = (guides(drawing)[1][1] - 4.25) / 3
    assert step == pytest.approx(float(f"{step:.1g}"), rel=1e-9)
    drawing.key(Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    drawing.key(Qt.Key.Key_Left)
    assert guides(drawing) == [("x", -1.0), ("y", float(f"{4.25 + 13 * step:.6g}"))]
    assert drawing.curve.points == points
    assert drawing.session.undo_stack.count() == steps + 1
    drawing.trigger("undo")
    assert guides(drawing)[1] == ("y", 4.25)
    drawing.escape()
    drawing.select([1])
    drawing.key(Qt.Key.Key_Up)
    assert guides(drawing)[1] == ("y", 4.25)
    assert drawing.curve.points != points


def test_delete_removes_the_guide_that_was_clicked_though_points_are_selected(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    drawing.select([1])
    drawing.click((6.0, 4.0))
    drawing.hover((6.0, 0.0))
    drawing.trigger("lockGuides")
    drawing.key(Qt.Key.Key_Up)
    assert guides(drawing) == [("x", -1.0), ("y", 4.0)]
    drawing.trigger("lockGuides")
    drawing.select([1])
    drawing.click((6.0, 4.0))
    drawing.hover((6.0, 0.0))
    drawing.key(Qt.Key.Key_Delete)
    assert guides(drawing) == [("x", -1.0)]
    assert len(drawing.curve.points) == 4
    # A press elsewhere lets go of it: then keys mean what is selected.
    drawing.click((-1.0, 0.0))
    drawing.click(drawing.point(1))
    drawing.key(Qt.Key.Key_Delete)
    assert guides(drawing) == [("x", -1.0)]
    assert len(drawing.curve.points) == 3


# The field


def field(editor):
    return editor.window.commands[GuideCommands].field


def type_place(editor, text, key=Qt.Key.Key_Return):
    assert field(editor).edit.hasFocus()
    field(editor).edit.selectAll()
    editor.type_text(field(editor).edit, text)
    QTest.keyClick(field(editor).edit, key)
    editor.settle()


def double_click(editor, pixel):
    canvas = editor.window.canvas
    for kind in (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonRelease):
        editor.send(canvas, kind, pixel, held=kind == QEvent.Type.MouseButtonPress)
    place = pixel.toPointF()
    left, nothing = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    event = QMouseEvent(
        QEvent.Type.MouseButtonDblClick, place, canvas.viewport().mapToGlobal(place), left, left, nothing
    )
    QApplication.sendEvent(canvas.viewport(), event)
    editor.send(canvas, QEvent.Type.MouseButtonRelease, pixel, held=False)
    editor.settle()


def test_a_guide_is_added_by_typing_without_a_dialog(drawing):
    drawing.trigger("addGuide")
    assert field(drawing).isVisible()
    assert QApplication.activeModalWidget() is None
    type_place(drawing, "20/8")
    assert guides(drawing) == [("x", 2.5)]
    assert drawing.session.undo_stack.undoText() == "Guide at x = 2.5"
    assert drawing.window.canvas.hasFocus()
    assert field(drawing).isHidden()
    drawing.trigger("addGuide")
    type_place(drawing, "y = 1.25")
    assert guides(drawing) == [("x", 2.5), ("y", 1.25)]
    drawing.trigger("addGuide")
    QTest.mouseClick(drawing.window.findChild(QToolButton, "guideAxis"), Qt.MouseButton.LeftButton)
    type_place(drawing, "-1")
    assert guides(drawing)[-1] == ("y", -1.0)


def test_what_cannot_be_a_place_is_said_in_the_field_and_escape_puts_it_away(drawing):
    steps = drawing.session.undo_stack.count()
    drawing.trigger("addGuide")
    type_place(drawing, "far")
    assert "“far” is not a number" in field(drawing).remark
    assert field(drawing).edit.text() == "far"
    QTest.keyClick(field(drawing).edit, Qt.Key.Key_Escape)
    assert field(drawing).isHidden()
    drawing.trigger("addGuide")
    assert field(drawing).remark == ""
    drawing.click((6.0, -2.0))
    assert field(drawing).isHidden()
    assert drawing.session.undo_stack.count() == steps


def test_a_guide_that_is_there_already_is_not_added_again(drawing):
    with_guides(drawing, ("x", 2.5))
    drawing.trigger("addGuide")
    type_place(drawing, "2.5")
    assert drawing.status == "There is a guide at x = 2.5 already."
    assert guides(drawing) == [("x", 2.5)]


def test_a_double_click_types_its_place(drawing):
    with_guides(drawing, ("x", -1.0))
    double_click(drawing, drawing.window.canvas.to_pixel(-1.0, 1.0))
    assert field(drawing).edit.text() == "-1"
    type_place(drawing, "y = 3")
    assert "This guide holds x" in field(drawing).remark
    type_place(drawing, "-2.25")
    assert guides(drawing) == [("x", -2.25)]
    assert drawing.session.undo_stack.undoText() == "Move guide to x = −2.25"


def test_the_pen_of_a_new_drawing_gives_way_to_a_double_click_on_a_guide(editor):
    """It began a curve there. A single press on a guide draws with the pen, snapped to it, as in Inkscape.

    Two that would leave a lone point behind mean the guide.
    """
    editor.trigger("newDrawing")
    editor.settle()
    assert editor.window.store.state.uses(ADD)
    with_guides(editor, ("x", 50.0))
    before = editor.session.document
    double_click(editor, editor.window.canvas.to_pixel(50.0, 100.0))
    assert field(editor).isVisible()
    assert editor.session.document == before
    type_place(editor, "60")
    assert guides(editor) == [("x", 60.0)]
    # While a path is drawn, a double click on a guide ends it there.
    editor.click((20, 40))
    double_click(editor, editor.window.canvas.to_pixel(60.0, 100.0))
    assert len(editor.curve.points) == 2
    assert not field(editor).isVisible()
    assert "finished" in editor.status


def test_the_key_that_enters_a_place_chooses_nothing(drawing):
    with_guides(drawing, ("x", -1.0))
    for _ in range(2):
        drawing.key(Qt.Key.Key_Escape)
    chosen = drawing.session.selected.choice
    assert not chosen.chosen
    double_click(drawing, drawing.window.canvas.to_pixel(-1.0, 1.0))
    type_place(drawing, "-2.25")
    assert guides(drawing) == [("x", -2.25)]
    assert drawing.session.selected.choice == chosen
    assert drawing.window.canvas.hasFocus()


def test_a_double_click_on_a_ruler_types_a_new_one_along_it(drawing):
    double_click(drawing, above(drawing))
    type_place(drawing, "1")
    double_click(drawing, beside(drawing))
    type_place(drawing, "2")
    assert guides(drawing) == [("y", 1.0), ("x", 2.0)]


def test_places_are_typed_with_units(point_locale):
    assert read_place("1/4") == TypedPlace(None, 0.25)
    assert read_place("X=3", "mm") == TypedPlace(Axis.X, 3.0)
    assert read_place("y = 1 in", "mm").position == pytest.approx(25.4)
    assert read_place("2cm", "in").position == pytest.approx(2 / 2.54)
    assert read_place("1in", "in").position == 1.0
    assert read_place("sqrt(4) mm", "cm").position == pytest.approx(0.2)
    for text, unit in (("1 in", ""), ("1 parsec", "mm"), ("", "mm"), ("x =", "")):
        with pytest.raises(ExpressionError):
            read_place(text, unit)


# Snapping


def snap_at(editor, index, place):
    """Drag a point near a place, snapping, and return what it has snapped to."""
    editor.trigger("toggleSnap")
    editor.press(editor.point(index))
    editor.move(place)
    found = editor.window.canvas.marks.snap
    editor.release(place)
    editor.trigger("toggleSnap")
    return found.label if found is not None else None


def test_points_snap_to_guides_and_their_crossings_exactly(drawing):
    with_guides(drawing, ("x", 5.123), ("y", -1.377))
    off = 4 * drawing.pixel
    assert snap_at(drawing, 1, (5.123 + off, -1.377 - off)) == "guide x = 5.123 · guide y = −1.377"
    assert drawing.point(1) == (5.123, -1.377)


def test_hidden_guides_catch_nothing_and_are_not_hit(drawing):
    with_guides(drawing, ("x", 5.123))
    drawing.trigger("toggleGuides")
    drawing.hover((5.123, -2.0))
    assert not drawing.window.status_line.hint.startswith("Guide")
    label = snap_at(drawing, 1, (5.123 + 2 * drawing.pixel, -1.377))
    assert label is None or "guide" not in label
    assert not drawing.window.canvas.drawing.guides.is_visible
    # A new one shows them again.
    draw(drawing, above(drawing), (1.0, 4.0))
    assert drawing.window.store.state.guides_shown


def test_snapping_to_guides_is_a_choice_of_its_own(drawing):
    with_guides(drawing, ("x", 5.123))
    preferences = drawing.window.preferences
    preferences.snap_kinds = frozenset(each for each in preferences.snap_kinds if each.value != "guides")
    drawing.window.store.read_preferences()
    label = snap_at(drawing, 1, (5.123 + 2 * drawing.pixel, -1.377))
    assert label is None or "guide" not in label


def test_a_side_of_the_box_snaps_to_guides(drawing):
    with_guides(drawing, ("x", 5.123))
    drawing.trigger("toggleSnap")
    drawing.select([1, 2])
    grip, off = drawing.grip(1, 0), 3 * drawing.pixel
    side = drawing.window.canvas.marks.box.high[0]
    drawing.press(grip)
    drawing.move((grip[0] + 5.123 - side + off, grip[1]))
    assert drawing.window.canvas.marks.snap.label == "guide x = 5.123"
    drawing.escape()


def test_a_curve_that_is_dragged_and_the_end_of_a_handle_snap_to_guides(drawing):
    curves = (
        make_curve(((0.0, 0.0), (1.0, 2.0), (3.0, 2.0)), family=HERMITE),
        make_curve(((0.0, -2.0), (2.0, -2.0))),
    )
    drawing.session.commit(Document(curves), "Curves")
    with_guides(drawing, ("y", -1.123), ("x", 5.123))
    drawing.trigger("toggleSnap")
    off = 3 * drawing.pixel
    drawing.press((1.0, -2.0))
    drawing.move((1.05, -1.123 + off))
    assert "guide y = −1.123" in drawing.window.canvas.marks.snap.label
    drawing.release((1.05, -1.123 + off))
    assert drawing.session.document.curves[1].points[0].y == -1.123
    drawing.session.selected.activate(0)
    drawing.select([1])
    drawing.press(drawing.handle().position)
    drawing.move((5.123 + off, 2.6))
    assert "guide x = 5.123" in drawing.window.canvas.marks.snap.label
    drawing.escape()
    drawing.escape()


# Shown, locked, cleared


def test_locked_guides_stay_and_a_press_goes_to_what_is_behind(drawing):
    with_guides(drawing, ("x", -1.0))
    drawing.trigger("lockGuides")
    drawing.drag((-1.0, 1.0), (-2.0, 0.0))
    assert guides(drawing) == [("x", -1.0)]
    drawing.trigger("lockGuides")


def test_one_guide_is_locked_and_unlocked_by_its_menu_and_nothing_moves_it_meanwhile(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.25))
    drawing.click((-1.0, 1.0))
    menu = drawing.open_menu((-1.0, 1.0))
    assert [each.text() for each in menu.actions() if each.objectName() == "lockGuide"] == ["Lock Guide"]
    drawing.choose("lockGuide")
    assert [each.locked for each in drawing.session.document.guides] == [True, False]
    assert drawing.session.undo_stack.undoText() == "Lock guide at x = −1"
    # Neither a drag, nor keys while it is the one that was clicked, nor a double click.
    drawing.hover((-1.0, 0.0))
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Delete):
        drawing.key(key)
        assert "The guide at x = −1 is locked." in drawing.status
    drawing.drag((-1.0, 1.0), (-2.0, 0.0))
    double_click(drawing, drawing.window.canvas.to_pixel(-1.0, 1.0))
    drawing.trigger("clearGuides")
    assert guides(drawing) == [("x", -1.0)]
    locked = drawing.session.document
    assert locked.curves == LINE.curves
    assert 'inkscape:locked="true"' in svg_of(locked, Options()).content
    # Its menu alone lets it go.
    menu = drawing.open_menu((-1.0, 1.0))
    assert menu.objectName() == "guideMenu"
    assert not drawing.action("removeGuide").isEnabled()
    assert [each.text() for each in menu.actions() if each.objectName() == "lockGuide"] == ["Unlock Guide"]
    drawing.choose("lockGuide")
    drawing.drag((-1.0, 1.0), (-2.0, 0.0))
    assert guides(drawing) == [("x", pytest.approx(-2.0, abs=drawing.pixel))]


def test_all_guides_are_cleared_in_one_step(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    drawing.trigger("clearGuides")
    assert guides(drawing) == []
    assert not drawing.action("clearGuides").isEnabled()
    drawing.trigger("undo")
    assert len(guides(drawing)) == 2


def test_the_menu_of_a_guide_is_about_that_one(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    drawing.hover((-1.0, 1.0))
    menu = drawing.open_menu((-1.0, 1.0))
    assert menu.objectName() == "guideMenu"
    drawing.choose("removeGuide")
    assert guides(drawing) == [("y", 4.0)]


def test_guides_are_saved_and_are_no_part_of_a_picture(drawing, tmp_path):
    bare = svg_of(drawing.session.document, Options()).content
    with_guides(drawing, ("x", -1.5), ("y", 1 / 3))
    guided = svg_of(drawing.session.document, Options()).content
    # For other programs they stand beside the picture.
    view = re.compile(r" *<sodipodi:namedview.*</sodipodi:namedview>\n", re.DOTALL)
    assert guided != bare
    assert view.sub("", guided) == view.sub("", bare)
    save(tmp_path / "guided.curve.json", drawing.session.document)
    assert load(tmp_path / "guided.curve.json").guides == (
        Guide(Axis.X, -1.5),
        Guide(Axis.Y, 1 / 3),
    )


@pytest.mark.parametrize(("name", "theme"), [("themeLight", LIGHT), ("themeDark", DARK)])
def test_a_guide_is_a_dashed_line_that_is_seen(drawing, name, theme):
    drawing.trigger(name)
    with_guides(drawing, ("x", -2.0))
    drawing.wait_for_rest()
    canvas = drawing.window.canvas
    image = canvas.grab().toImage()
    x = canvas.to_pixel(-2.0, 0.0).x()
    top = int(canvas.camera.origin.y())
    ratio = image.devicePixelRatio()

    def column(at):
        rows = range(top + 5, top + 5 + int(canvas.pixel_map.height) - 10)
        return [image.pixelColor(round(at * ratio), round(y * ratio)) for y in rows]

    share = max(
        sum(each == theme.accent for each in column(at)) / len(column(at)) for at in (x - 1, x, x + 1)
    )
    assert 0.4 < share < 0.85
    drawing.trigger("themeSystem")


# At an angle


def type_angle(editor, text):
    edit = field(editor).angle
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)
    editor.settle()


def test_an_angle_is_typed_and_the_guide_drawn_dragged_and_snapped_to_at_it(drawing):
    canvas, session = drawing.window.canvas, drawing.session
    with_guides(drawing, ("y", -1.0), ("x", 5.0))
    double_click(drawing, canvas.to_pixel(-1.0, -1.0))
    assert field(drawing).angle.text() == "0"
    assert field(drawing).edit.text() == "-1"
    type_angle(drawing, "30")
    (guide, _) = session.document.guides
    middle = canvas.to_plane(canvas.camera.centre().toPoint())
    assert (guide.angle, guide.point) == (30.0, (middle[0], -1.0))
    assert session.undo_stack.undoText().startswith("Move guide to 30° through (")

    def on_it(x):
        return (x, -1.0 + (x - guide.across) / 3**0.5)

    # Seen there, and grabbed there.
    drawing.wait_for_rest()
    image, colour = canvas.grab().toImage(), LIGHT.accent

    def is_seen(x, y):
        pixel = canvas.to_pixel(x, y)
        near = [image.pixelColor(pixel.x(), pixel.y() + step) for step in (-1, 0, 1)]
        return any(abs(each.red() - colour.red()) + abs(each.blue() - colour.blue()) < 60 for each in near)

    places = [on_it(0.5 + step / 50) for step in range(100)]
    assert sum(is_seen(*place) for place in places) > 40
    assert sum(is_seen(x, y + 0.3) for x, y in places) < 10
    drawing.hover(on_it(1.0))
    assert drawing.window.status_line.hint.startswith("Guide 30° through")
    # A point snaps to it, and to where it meets another one.
    off = 4 * drawing.pixel
    x, y = on_it(5.0)
    assert "guide x = 5" in snap_at(drawing, 1, (x + off, y - off))
    assert drawing.point(1) == pytest.approx((x, y), abs=1e-12)
    assert drawing.point(1)[0] == 5.0
    x, y = on_it(0.234)
    assert snap_at(drawing, 1, (x, y - off)).startswith("guide 30° through")
    assert guide.distance(drawing.point(1)) < 1e-12
    # A drag keeps the angle.
    session.selected.set_points([])
    drawing.drag(on_it(-0.5), (-2.0, 2.0))
    moved = session.document.guides[0]
    assert moved.angle == 30.0
    assert moved.distance((-2.0, 2.0)) < 2 * drawing.pixel
    drawing.trigger("undo")
    assert session.document.guides[0] == guide


def test_guides_at_an_angle_are_saved_and_typed_level_again(drawing, tmp_path):
    drawing.session.change("Guide", lambda now: add_guide(now, Axis.X, 2.0, 0.1 + 0.2, 1.0))
    (guide,) = drawing.session.document.guides
    assert guide.angle == pytest.approx(90.3)
    save(tmp_path / "a.curve.json", drawing.session.document)
    assert load(tmp_path / "a.curve.json").guides == (guide,)
    drawing.settle()
    double_click(drawing, drawing.window.canvas.to_pixel(2.0, 1.0))
    type_angle(drawing, "90")
    assert drawing.session.document.guides == (Guide(Axis.X, 2.0),)


# Rulers


def test_rulers_are_switched_to_plain_axes_and_remembered(drawing):
    canvas = drawing.window.canvas
    with_rulers = canvas.camera.origin.y()
    assert with_rulers > 15
    size = (canvas.pixel_map.width, canvas.pixel_map.height)
    drawing.trigger("toggleRulers")
    assert canvas.camera.origin.y() < 5
    assert (canvas.pixel_map.width, canvas.pixel_map.height) == size
    assert not drawing.window.preferences.rulers
    # What lies there then is no ruler.
    draw(drawing, beside(drawing), (2.0, 1.0))
    assert guides(drawing) == []
    drawing.trigger("toggleRulers")
    assert canvas.camera.origin.y() == with_rulers
    assert canvas.to_plane(canvas.to_pixel(1.0, 2.0)) == pytest.approx((1.0, 2.0), abs=2 * drawing.pixel)


def test_a_presentation_has_plain_axes(drawing):
    canvas = drawing.window.canvas
    drawing.trigger("presentation")
    assert not canvas.rulers.are_shown
    drawing.trigger("presentation")
    assert canvas.rulers.are_shown


def strip(editor, first, last):
    """The colours along the lower edge of the upper ruler, between two places of the plane."""
    canvas = editor.window.canvas
    image = canvas.grab().toImage()
    y = int(canvas.camera.origin.y()) - 3
    pixels = range(canvas.to_pixel(first, 0).x(), canvas.to_pixel(last, 0).x())
    ratio = image.devicePixelRatio()
    return [image.pixelColor(round(x * ratio), round(y * ratio)).name() for x in pixels]


class _Painted(QObject):
    """The rectangles of each paint of a widget."""

    def __init__(self, widget):
        super().__init__(widget)
        self.counts = []
        widget.installEventFilter(self)

    def eventFilter(self, _widget, event):
        if event.type() == QEvent.Type.Paint:
            self.counts.append(event.region().rectCount())
        return False


def test_a_frame_of_a_drag_is_one_rectangle_with_the_marks_on_the_rulers(drawing):
    """Of three, the plot area and two strips beside it, Qt clips every line to each."""
    drawing.hover((2.0, -1.0))
    drawing.settle()
    painted = _Painted(drawing.window.canvas.viewport())
    drawing.hover((3.0, -1.5))
    assert painted.counts == [2], "the strips alone, while nothing is dragged"
    painted.counts.clear()
    drawing.drag_point(1, to=(1.5, 0.7))
    assert set(painted.counts) == {1}


def test_the_rulers_show_where_the_pointer_is_and_how_far_the_selection_reaches(drawing):
    canvas = drawing.window.canvas
    canvas._left()
    drawing.settle()
    bare = strip(drawing, -2.5, 6.5)
    drawing.hover((5.0, -1.0))
    marked = strip(drawing, -2.5, 6.5)
    changed = [x for x, (one, other) in enumerate(zip(bare, marked, strict=True)) if one != other]
    place = canvas.to_pixel(5.0, 0).x() - canvas.to_pixel(-2.5, 0).x()
    assert changed
    assert all(abs(each - place) <= 6 for each in changed)
    canvas._left()
    drawing.select([1, 2])
    banded = strip(drawing, -2.5, 6.5)
    changed = [x for x, (one, other) in enumerate(zip(bare, banded, strict=True)) if one != other]
    ends = [canvas.to_pixel(x, 0).x() - canvas.to_pixel(-2.5, 0).x() for x in (1.03, 3.07)]
    assert changed[0] == pytest.approx(ends[0], abs=1)
    assert changed[-1] == pytest.approx(ends[1], abs=1)
    assert len(changed) > 0.9 * (ends[1] - ends[0])


def test_messages_stand_below_the_ruler(drawing):
    canvas, bar = drawing.window.canvas, drawing.window.message_bar
    bar.tell("Hello.")
    drawing.settle()
    assert bar.geometry().top() >= canvas.camera.origin.y()
    bar.close_button.click()


def test_a_long_angle_is_shown_short_and_stays_whole_where_another_place_is_typed(drawing):
    drawing.session.change("Guide", lambda now: add_guide(now, Axis.X, 2.0, 0.3692597, 1.0))
    drawing.settle()
    double_click(drawing, drawing.window.canvas.to_pixel(2.0, 1.0))
    assert field(drawing).angle.text() == "90.369"
    field(drawing).edit.selectAll()
    drawing.type_text(field(drawing).edit, "3")
    QTest.keyClick(field(drawing).edit, Qt.Key.Key_Return)
    drawing.settle()
    (guide,) = drawing.session.document.guides
    assert guide.angle == pytest.approx(90.3692597, abs=1e-9)
    assert guide.position == 3.0


def test_edges_of_the_page_and_objects_become_guides(editor, open_drawing):
    open_drawing(
        '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">'
        '<circle cx="20" cy="20" r="5" fill="#00aa00"/><path d="M30 10L40 20" stroke="#000"/></svg>'
    )
    session, before = editor.session, editor.session.document
    editor.trigger("guidesAroundPage")
    assert guides(editor) == [("x", 0.0), ("x", 60.0), ("y", 0.0), ("y", 40.0)]
    editor.trigger("guidesAroundPage")
    assert editor.status == "There are guides there already."
    editor.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    editor.trigger("objectsToGuides")
    assert editor.status == "5 guides drawn."
    *round_circle, along = session.document.guides[4:]
    edges = [(guide.axis.value, round(guide.position, 9)) for guide in round_circle]
    assert edges == [("x", 15.0), ("x", 25.0), ("y", 15.0), ("y", 25.0)]
    # y is upwards here: the line falls from (30, 30) to (40, 20).
    assert along.angle == pytest.approx(135.0)
    assert along.distance((40.0, 20.0)) == pytest.approx(0.0, abs=1e-9)
    assert not any(curve.points for curve in session.document.curves)
    editor.trigger("undo")
    editor.trigger("undo")
    assert session.document == before
