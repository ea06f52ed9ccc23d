"""Rulers and guides: drawn out of a ruler, dragged, typed, snapped to, hidden, cleared, saved."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.appearance.theme import DARK, LIGHT
from app.document.model import Axis, Document, Guide, make_curve
from app.document.plane_edits import add_guide
from app.exchange.options import Options
from app.exchange.svg.writer import svg_of
from app.families import HERMITE
from app.features.snapping.commands import GuideCommands
from app.storage.files import load, save

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


def test_a_guide_is_drawn_out_of_the_left_ruler_with_any_tool(drawing):
    for tool in ("addTool", "pencilTool", "measureTool", "selectTool"):
        drawing.trigger(tool)
        before = drawing.session.document
        draw(drawing, beside(drawing), (2.0, 1.0))
        assert guides(drawing) == [("x", pytest.approx(2.0, abs=drawing.pixel))]
        assert drawing.session.document.curves == before.curves
        assert drawing.window.store.state.tool.action == tool
        drawing.trigger("undo")


def test_escape_a_click_and_a_drag_back_to_the_ruler_create_no_guide(drawing):
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


def test_hint_and_cursor_over_a_ruler_announce_a_guide(drawing):
    canvas = drawing.window.canvas
    drawing.send(canvas, QEvent.Type.MouseMove, above(drawing), held=False)
    drawing.settle()
    assert drawing.window.status_line.hint.startswith("Drag onto the drawing to add a guide")
    assert canvas.viewport().cursor().shape() == Qt.CursorShape.SizeVerCursor
    drawing.send(canvas, QEvent.Type.MouseMove, beside(drawing), held=False)
    assert canvas.viewport().cursor().shape() == Qt.CursorShape.SizeHorCursor


def test_a_new_guide_snaps_to_points_with_a_label(drawing):
    drawing.trigger("toggleSnap")
    near = drawing.window.canvas.to_pixel(3.07 + 3 * drawing.pixel, 1.0)
    begin(drawing, beside(drawing), near)
    assert "snapped to: straight below point 2" in drawing.status
    let_go(drawing, near)
    assert guides(drawing) == [("x", 3.07)]
    drawing.trigger("toggleSnap")


# A guide in hand


def test_a_guide_is_dragged_and_escape_restores_its_position(drawing):
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


def test_a_guide_dragged_back_to_the_ruler_is_removed(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    canvas = drawing.window.canvas
    begin(drawing, canvas.to_pixel(-1.0, 1.0), beside(drawing))
    assert drawing.status.startswith("Release to remove the guide")
    let_go(drawing, beside(drawing))
    assert guides(drawing) == [("y", 4.0)]
    assert drawing.session.undo_stack.undoText() == "Remove guide at x = −1"
    draw_back = canvas.to_pixel(6.0, 4.0)
    drawing.drag_pixels(canvas, draw_back, above(drawing))
    assert guides(drawing) == []


def test_points_and_the_curve_take_precedence_over_a_guide(drawing):
    with_guides(drawing, ("x", 1.03))
    drawing.drag((1.03, 2.04), (1.5, 3.0))
    assert guides(drawing) == [("x", 1.03)]
    assert drawing.point(1) == pytest.approx((1.5, 3.0), abs=drawing.pixel)


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


def test_a_double_click_on_a_ruler_opens_a_field_for_a_new_guide_with_optional_unit(drawing):
    double_click(drawing, beside(drawing))
    assert field(drawing).isVisible()
    assert QApplication.activeModalWidget() is None
    type_place(drawing, "20/8")
    assert guides(drawing) == [("x", 2.5)]
    assert drawing.session.undo_stack.undoText() == "Guide at x = 2.5"
    assert drawing.window.canvas.hasFocus()
    assert field(drawing).isHidden()
    drawing.set_unit("mm")
    double_click(drawing, above(drawing))
    type_place(drawing, "1 in")
    assert guides(drawing) == [("x", 2.5), ("y", pytest.approx(25.4))]


def test_the_field_of_a_guide_explains_an_invalid_position_and_escape_closes_the_field(drawing):
    steps = drawing.session.undo_stack.count()
    double_click(drawing, beside(drawing))
    type_place(drawing, "far")
    assert "“far” is not a number" in field(drawing).remark
    assert field(drawing).edit.text() == "far"
    QTest.keyClick(field(drawing).edit, Qt.Key.Key_Escape)
    assert field(drawing).isHidden()
    double_click(drawing, beside(drawing))
    assert field(drawing).remark == ""
    drawing.click((6.0, -2.0))
    assert field(drawing).isHidden()
    assert drawing.session.undo_stack.count() == steps


def test_an_existing_guide_is_not_added_again(drawing):
    with_guides(drawing, ("x", 2.5))
    double_click(drawing, beside(drawing))
    type_place(drawing, "2.5")
    assert drawing.status == "There is already a guide at x = 2.5."
    assert guides(drawing) == [("x", 2.5)]


def test_a_double_click_on_a_guide_opens_its_field(drawing):
    with_guides(drawing, ("x", -1.0))
    double_click(drawing, drawing.window.canvas.to_pixel(-1.0, 1.0))
    assert field(drawing).edit.text() == "-1"
    type_place(drawing, "-2.25")
    assert guides(drawing) == [("x", -2.25)]
    assert drawing.session.undo_stack.undoText() == "Move guide to x = −2.25"


def test_entering_the_position_of_a_guide_selects_nothing(drawing):
    with_guides(drawing, ("x", -1.0))
    for _ in range(2):
        drawing.key(Qt.Key.Key_Escape)
    chosen = drawing.session.selected.state
    assert not chosen.whole_curves
    double_click(drawing, drawing.window.canvas.to_pixel(-1.0, 1.0))
    type_place(drawing, "-2.25")
    assert guides(drawing) == [("x", -2.25)]
    assert drawing.session.selected.state == chosen
    assert drawing.window.canvas.hasFocus()


def test_a_double_click_on_a_ruler_types_a_new_guide(drawing):
    double_click(drawing, above(drawing))
    type_place(drawing, "1")
    double_click(drawing, beside(drawing))
    type_place(drawing, "2")
    assert guides(drawing) == [("y", 1.0), ("x", 2.0)]


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


def test_hidden_guides_do_not_snap_and_are_not_hit(drawing):
    with_guides(drawing, ("x", 5.123))
    drawing.trigger("toggleGuides")
    drawing.hover((5.123, -2.0))
    assert not drawing.window.status_line.hint.startswith("Guide")
    label = snap_at(drawing, 1, (5.123 + 2 * drawing.pixel, -1.377))
    assert label is None or "guide" not in label
    assert not drawing.window.canvas.drawing.guides.is_visible
    # A new one shows them again.
    draw(drawing, above(drawing), (1.0, 4.0))
    assert drawing.window.store.state.guides_visible


def test_snapping_to_guides_has_its_own_switch(drawing):
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


# Shown, cleared


def test_all_guides_are_cleared_in_one_step(drawing):
    with_guides(drawing, ("x", -1.0), ("y", 4.0))
    drawing.trigger("clearGuides")
    assert guides(drawing) == []
    assert not drawing.action("clearGuides").isEnabled()
    drawing.trigger("undo")
    assert len(guides(drawing)) == 2


def test_guides_are_saved_and_not_exported(drawing, tmp_path):
    bare = svg_of(drawing.session.document, Options()).content
    with_guides(drawing, ("x", -1.5), ("y", 1 / 3))
    assert svg_of(drawing.session.document, Options()).content == bare
    save(tmp_path / "guided.curve.json", drawing.session.document)
    assert load(tmp_path / "guided.curve.json").guides == (
        Guide(Axis.X, -1.5),
        Guide(Axis.Y, 1 / 3),
    )


@pytest.mark.parametrize(("name", "theme"), [("themeLight", LIGHT), ("themeDark", DARK)])
def test_a_guide_is_painted_as_a_dashed_line(drawing, name, theme):
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
    assert not canvas.rulers.are_visible
    drawing.trigger("presentation")
    assert canvas.rulers.are_visible


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


def test_messages_are_below_the_ruler(drawing):
    canvas, bar = drawing.window.canvas, drawing.window.message_bar
    bar.tell("Hello.")
    drawing.settle()
    assert bar.geometry().top() >= canvas.camera.origin.y()
    bar.close_button.click()
