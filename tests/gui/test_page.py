"""The page: seen on the canvas, put around the curves, taken away, and what pictures show of it."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QLineEdit, QListView, QToolButton

from app.appearance.colours import point_colours
from app.appearance.theme import DARK, LIGHT, PRINTED, PRINTED_IN_DARK, ThemeMode
from app.document.model import Axis, Document, Guide, Page, make_curve
from app.document.paper import DocumentKind, kind_of
from app.document.style import INK, Style
from app.document.style_edits import with_style
from app.families import HERMITE
from app.features.curve_list.row_parts import Spot, spot_rect
from app.features.import_export.export_commands import ExportCommands
from app.tools.snapping import SnapKind
from app.widgets.paint_field import PaintField
from tests.gui.test_theme import contrast

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]


@pytest.fixture
def drawn(editor):
    line = replace(make_curve([(0.0, 0.0), (8.0, 4.0)], family=HERMITE), style=Style(width=1.0))
    editor.session.change("Draw", lambda _: Document((line,), unit="mm"))
    editor.trigger("fitView")
    return editor


def edge_colour(editor, x, y):
    """The colour of the canvas where the edge of a page may be."""
    image = editor.window.canvas.grab().toImage()
    pixel = editor.window.canvas.to_pixel(x, y)
    ratio = image.devicePixelRatio()
    return {
        image.pixelColor(round(pixel.x() * ratio) + i, round(pixel.y() * ratio) + j).name()
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    }


def test_a_page_around_the_curves_holds_their_strokes(drawn):
    drawn.trigger("pageAroundCurves")
    page = drawn.session.document.page
    assert (page.x, page.y) == pytest.approx((-0.5, -0.5))
    assert (page.width, page.height) == pytest.approx((9.0, 5.0))
    assert drawn.status == "The page is 9 × 5 mm; pictures show what lies on it."
    muted = drawn.window.canvas.drawing.page.theme.muted.name()
    assert muted in edge_colour(drawn, page.x + 1.0, page.y + page.height)
    drawn.trigger("undo")
    assert drawn.session.document.page is None
    assert muted not in edge_colour(drawn, page.x + 1.0, page.y + page.height)


def test_pictures_show_the_page_until_it_is_taken_away(drawn, tmp_path):
    drawn.session.change("Page", lambda document: replace(document, page=Page(0.0, 0.0, 4.0, 4.0)))
    export = drawn.window.commands[ExportCommands].export
    export(tmp_path / "page.svg")
    drawn.wait_for_work()
    text = (tmp_path / "page.svg").read_text(encoding="utf-8")
    assert 'width="4mm" height="4mm" viewBox="0 0 4 4"' in text
    assert "reaches beyond the page" in drawn.message
    drawn.trigger("noPage")
    assert drawn.session.document.page is None
    export(tmp_path / "all.svg")
    drawn.wait_for_work()
    assert 'viewBox="0 0 4 4"' not in (tmp_path / "all.svg").read_text(encoding="utf-8")


def test_the_actions_wait_for_what_they_need(editor):
    editor.session.new()
    editor.settle()
    assert not editor.window.actions_by_name["noPage"].isEnabled()
    assert not editor.window.actions_by_name["pageAroundCurves"].isEnabled()


def test_fit_page_shows_all_of_it_and_little_else(drawn):
    assert not drawn.window.actions_by_name["fitPage"].isEnabled()
    drawn.session.change("Page", lambda document: replace(document, page=Page(100.0, -50.0, 24.0, 24.0)))
    drawn.key(Qt.Key.Key_4, Qt.KeyboardModifier.ControlModifier)
    drawn.settle()
    left, bottom, right, top = drawn.window.canvas.pixel_map.box
    assert (left < 100.0, right > 124.0, bottom < -50.0) == (True, True, True)
    assert -26.0 < top < -14.0
    drawn.trigger("previousView")
    assert drawn.window.canvas.pixel_map.box[0] < 8.0


def test_points_and_guides_snap_to_its_edges_corners_and_centre(drawn):
    drawn.session.change("Page", lambda document: replace(document, page=Page(0.1, -0.7, 6.2, 3.4)))
    drawn.window.preferences.snap_kinds = {SnapKind.PAGE}
    drawn.trigger("toggleSnap")
    off = 4 * drawn.pixel
    drawn.drag_point(1, (6.3 + off, 2.7 - off))
    # 0.1 + 6.2 is no 6.3 of floats.
    assert drawn.point(1) == (6.3, 2.7)
    drawn.press((6.3, 2.7))
    drawn.move((3.2 - off, 1.0 + off))
    assert drawn.status.endswith("snapped to: page centre")
    # Near one of its middles alone a point is left where it is traced: that is the width of the page away.
    drawn.move((3.2 - off, 2.0))
    assert "snapped" not in drawn.status
    drawn.move((3.2 - off, 1.0 + off))
    drawn.release((3.2 - off, 1.0 + off))
    assert drawn.point(1) == (3.2, 1.0)
    canvas = drawn.window.canvas
    ruler = QPoint(int(canvas.camera.origin.x()) - 20, canvas.to_pixel(0.0, 1.0).y())
    drawn.drag_pixels(canvas, ruler, canvas.to_pixel(0.1 + off, 0.0))
    assert drawn.session.document.guides == (Guide(Axis.X, 0.1),)
    # A point snaps to it no more where that is not wanted.
    drawn.window.preferences.snap_kinds = frozenset(SnapKind) - {SnapKind.PAGE, SnapKind.GRID}
    drawn.trigger("toggleSnap")
    drawn.trigger("toggleSnap")
    drawn.drag((3.2, 1.0), (6.3 + off, 2.7 - off))
    assert drawn.point(1) != (6.3, 2.7)
    drawn.trigger("toggleSnap")
    drawn.window.preferences.snap_kinds = frozenset(SnapKind)
    drawn.window.store.read_preferences()


def line(editor, name):
    return editor.window.findChild(QLineEdit, name)


def type_into_focus(editor, text, key):
    focused = QApplication.focusWidget()
    editor.type_text(focused, text)
    QTest.keyClick(focused, key)
    editor.settle()


def size(editor):
    page = editor.session.document.page
    return page.width, page.height


def test_an_artboard_is_typed_and_exported(editor, tmp_path):
    """An icon of 24 × 24: two numbers, one step, and the file has that size."""
    editor.trigger("pageSize")
    type_into_focus(editor, "24", Qt.Key.Key_Tab)
    assert QApplication.focusWidget() is line(editor, "pageHeight")
    type_into_focus(editor, "24", Qt.Key.Key_Return)
    assert editor.session.document.page == Page(0.0, 0.0, 24.0, 24.0)
    assert editor.window.canvas.drawing.page.page == editor.session.document.page
    assert editor.session.undo_stack.undoText() == "Page 24 × 24"
    left, low, right, high = editor.window.canvas.pixel_map.box
    # All of the page, as large as it can be.
    assert max(left, low) < 0
    assert min(right, high) > 24
    assert high < 40
    assert editor.window.findChild(QComboBox, "pageUsual").currentText() == "24 × 24 px"
    editor.window.commands[ExportCommands].export(tmp_path / "icon.svg")
    editor.wait_for_work()
    assert 'viewBox="0 0 24 24"' in (tmp_path / "icon.svg").read_text(encoding="utf-8")
    editor.trigger("undo")
    assert editor.session.document.page is None
    assert line(editor, "pageWidth").text() == ""


def test_a_page_keeps_its_corner_and_takes_units(drawn):
    drawn.session.change("Page", lambda document: replace(document, page=Page(-1.0, 2.0, 4.0, 4.0)))
    drawn.trigger("pageSize")
    type_into_focus(drawn, "1in", Qt.Key.Key_Return)
    assert drawn.session.document.page == Page(-1.0, 2.0, 25.4, 4.0)
    drawn.trigger("pageSize")
    type_into_focus(drawn, "0", Qt.Key.Key_Return)
    problem = drawn.window.findChild(QLabel, "documentProblem").text()
    assert problem == "⚠ The width of the page must be greater than 0."
    assert size(drawn) == (25.4, 4.0)
    # And not that the page is out of sight.
    assert drawn.status == "The width of the page must be greater than 0."
    drawn.trigger("pageSize")
    type_into_focus(drawn, "5 apples", Qt.Key.Key_Return)
    problem = drawn.window.findChild(QLabel, "documentProblem").text()
    assert problem == "⚠ “apples” is no unit of length known here, such as mm, cm, in, pt and px."


def test_usual_sizes_are_chosen_and_turned(drawn):
    drawn.trigger("pageSize")
    usual = drawn.window.findChild(QComboBox, "pageUsual")
    for name, expected in (("A4", (210.0, 297.0)), ("Letter", (215.9, 279.4)), ("24 × 24 px", (6.35, 6.35))):
        choose(drawn, usual, name)
        assert size(drawn) == expected
    choose(drawn, usual, "A4")
    QTest.mouseClick(drawn.window.findChild(QToolButton, "pageTurn"), Qt.MouseButton.LeftButton)
    assert (size(drawn), usual.currentText()) == ((297.0, 210.0), "A4")
    assert drawn.session.undo_stack.undoText() == "Page 297 × 210 mm"
    choose(drawn, usual, "none")
    assert drawn.session.document.page is None
    drawn.session.change("Unit", lambda document: replace(document, unit="s"))
    drawn.settle()
    assert usual.findText("A4") == -1, "a sheet has no size where there is no length"


def choose(editor, box, name):
    """Choose an entry of a box by its keys."""
    box.setFocus()
    while box.currentText() != name:
        before = box.currentIndex()
        QTest.keyClick(box, Qt.Key.Key_Down if box.findText(name) > before else Qt.Key.Key_Up)
        assert box.currentIndex() != before
    editor.settle()


def colour_at(editor, x, y):
    image = editor.window.canvas.grab().toImage()
    pixel, ratio = editor.window.canvas.to_pixel(x, y), image.devicePixelRatio()
    return image.pixelColor(round(pixel.x() * ratio), round(pixel.y() * ratio))


def test_a_tall_page_is_shown_as_wide_as_there_is_room_for(drawn):
    assert not drawn.action("fitPageWidth").isEnabled()
    drawn.session.change("Page", lambda document: replace(document, page=Page(0.0, 0.0, 8.0, 80.0)))
    drawn.trigger("fitPage")
    whole = drawn.window.canvas.pixel_map
    drawn.trigger("fitPageWidth")
    shown = drawn.window.canvas.pixel_map
    assert 8 * whole.sx < shown.width / 4
    assert 0.7 * shown.width < 8 * shown.sx < shown.width
    assert shown.plane(shown.width / 2, shown.height / 2) == pytest.approx((4.0, 40.0), abs=0.05)


@pytest.mark.parametrize("mode", [ThemeMode.LIGHT, ThemeMode.DARK])
def test_a_page_is_seen_as_it_prints_until_the_person_chooses_otherwise(drawn, mode):
    """In the dark the page was black, and ink on it white; in the light it was as grey as all around it."""
    drawn.window.store.change(theme_mode=mode, grid=False)
    drawn.settle()
    without = colour_at(drawn, 6.0, 1.0).name()
    assert without == (LIGHT if mode is ThemeMode.LIGHT else DARK).paper.name()
    drawn.session.change("Page", lambda document: replace(document, page=Page(0.0, 0.0, 8.0, 4.0)))
    drawn.trigger("fitPage")
    drawn.trigger("zoomOut")
    drawn.settle()
    page, around = colour_at(drawn, 6.0, 1.0), colour_at(drawn, 6.0, -0.3)
    assert (page.name(), colour_at(drawn, 4.0, 2.0).name()) == ("#ffffff", LIGHT.ink.name())
    assert drawn.action("paperAsPrinted").isChecked()
    printed = PRINTED if mode is ThemeMode.LIGHT else PRINTED_IN_DARK
    assert around.name() == printed.desk.name()
    assert page.lightness() - around.lightness() > 20
    drawn.trigger("paperAsPrinted")
    drawn.settle()
    assert colour_at(drawn, 6.0, 1.0).name() == without
    assert abs(colour_at(drawn, 6.0, -0.3).lightness() - colour_at(drawn, 6.0, 1.0).lightness()) > 20
    assert not drawn.window.context.preferences.page_as_printed
    drawn.trigger("noPage")
    drawn.settle()
    assert not drawn.action("paperAsPrinted").isChecked()
    drawn.window.store.change(theme_mode=ThemeMode.SYSTEM, page_as_printed=True, grid=True)


def test_drawings_snap_when_asked_and_remember_their_own_choice(drawn):
    """Traced points went to the page's middle and to each other before anyone had asked for snapping."""
    page = replace(drawn.session.document, page=Page(0.0, 0.0, 10.0, 8.0), guides=(Guide(Axis.X, 5.123),))
    store = drawn.window.store
    assert not drawn.action("toggleSnap").isChecked()
    store.change(kind=kind_of(page))
    drawn.session.commit(page, "Begin")
    assert not drawn.action("toggleSnap").isChecked()
    drawn.drag_point(1, (5.123 + 4 * drawn.pixel, 1.377))
    assert drawn.point(1)[0] != 5.123
    drawn.trigger("toggleSnap")
    assert store.state.snapping.kinds == {*SnapKind} - {SnapKind.LEVEL}
    drawn.drag_point(1, (5.123 + 4 * drawn.pixel, 1.733))
    assert drawn.point(1)[0] == 5.123
    store.change(kind=DocumentKind.SKETCH)
    assert not drawn.action("toggleSnap").isChecked()
    assert drawn.window.preferences.page_snap_on
    store.change(kind=DocumentKind.DRAWING)
    assert drawn.action("toggleSnap").isChecked()
    drawn.trigger("toggleSnap")
    store.change(kind=DocumentKind.SKETCH)


def test_in_the_dark_only_the_paper_is_light_and_ink_is_black_wherever_it_is_shown(editor):
    editor.session.new()
    editor.trigger("newDrawing")
    store = editor.window.context.store
    store.change(theme_mode=ThemeMode.DARK, grid=False)
    try:
        editor.trigger("rectangleTool")
        editor.drag((50, 200), (90, 240))
        editor.session.change("Ink", lambda document: with_style(document, [0], stroke=INK))
        editor.settle()
        canvas = editor.window.canvas
        picture, corner = canvas.grab().toImage(), canvas.camera.origin.toPoint()
        ratio = picture.devicePixelRatio()

        def seen(x, y):
            return picture.pixelColor(round(x * ratio), round(y * ratio))

        # Ticks and numbers stand nearer to the drawing and to the middle of each ruler.
        assert seen(3, 3) == seen(3, corner.y() + 3) == DARK.surface
        assert contrast(DARK.muted, DARK.surface) >= 4.5
        assert colour_at(editor, 105.0, 100.0) == QColor("white")
        assert colour_at(editor, 105.0, -3.0).name() == PRINTED_IN_DARK.desk.name()
        editor.show_dock("styleDock")
        field = editor.window.findChild(PaintField, "strokePaint")
        icon = field.findChild(QToolButton, "strokePaintButton").icon().pixmap(14).toImage()
        assert icon.pixelColor(icon.rect().center()) == PRINTED.curve
        editor.show_dock("curvesDock")
        rows = editor.window.findChild(QListView, "curveList")
        place = spot_rect(rows.parts.entry_rect(0), Spot.SWATCH).center()
        drawn = rows.viewport().grab().toImage()
        assert drawn.pixelColor(place * drawn.devicePixelRatio()) == PRINTED.curve
        store.change(page_as_printed=False)
        editor.settle()
        drawn = rows.viewport().grab().toImage()
        assert drawn.pixelColor(place * drawn.devicePixelRatio()) == DARK.curve
    finally:
        store.change(theme_mode=ThemeMode.SYSTEM, page_as_printed=True, grid=True)


def test_dark_shapes_beside_the_page_have_an_outline_on_a_dark_desk_alone(editor):
    """A line in ink had a contrast of 1.5 with the desk."""
    editor.session.new()
    editor.trigger("newDrawing")
    store, theme = editor.window.context.store, PRINTED_IN_DARK
    block = replace(make_curve([(220, 60), (250, 60), (250, 90), (220, 90)], family=HERMITE), closed=True)
    ink, yellow = (make_curve([(150, y), (250, y)], family=HERMITE) for y in (150.0, 200.0))
    curves = (
        replace(ink, style=Style(width=3.0)),
        replace(block, style=Style(stroke="none", fill="#101010")),
        replace(yellow, style=Style(stroke="#f0e442", width=3.0)),
    )
    editor.session.change("Draw", lambda document: replace(document, curves=curves))
    editor.session.selected.choose(())
    editor.window.canvas.camera.show_box((140, 260), (50, 220))
    editor.hover((200.0, 100.0))

    def across(x, y):
        picture, middle = editor.window.canvas.grab().toImage(), editor.window.canvas.to_pixel(x, y)
        ratio = picture.devicePixelRatio()
        steps = [round((middle.y() + step) * ratio) for step in range(-4, 5)]
        return [picture.pixelColor(round(middle.x() * ratio), row) for row in steps]

    def outside(x, y, own):
        """The colours across an edge, but for a colour of its own and those between that and the desk."""
        dark, light = sorted([QColor(own).lightness(), editor.window.canvas.layers.theme.desk.lightness()])
        return [each for each in across(x, y) if not dark - 2 <= each.lightness() <= light + 2]

    def block_edge():
        return editor.session.views[1].drawn_box[1][1]

    try:
        store.change(theme_mode=ThemeMode.DARK, grid=False)
        editor.wait_for_rest()
        edges = [(151.5, theme.ink), (148.5, theme.ink), (block_edge(), "#101010")]
        for y, own in edges:
            assert max(contrast(each, theme.desk) for each in outside(235.0, y, own)) >= 3.0
        # On the page it is as it prints, and what is seen needs no outline.
        on_page = across(180.0, 151.5)
        assert outside(235.0, 201.5, "#f0e442") == []
        store.change(theme_mode=ThemeMode.LIGHT)
        editor.wait_for_rest()
        assert outside(235.0, 151.5, theme.ink) == []
        assert across(180.0, 151.5) == on_page
    finally:
        store.change(theme_mode=ThemeMode.SYSTEM, grid=True)


def test_points_of_a_drawing_are_plain_on_the_page_and_on_the_desk_until_numbers_are_wanted(editor):
    editor.session.new()
    editor.trigger("newDrawing")
    store, layer = editor.window.context.store, editor.window.canvas.drawing.points
    store.change(theme_mode=ThemeMode.DARK, grid=False)
    points = [(150.0, 100.0), (195.0, 150.0), (225.0, 110.0), (240.0, 160.0)]
    line = replace(make_curve(points, family=HERMITE), style=Style(width=0.3))
    editor.session.change("Draw", lambda document: replace(document, curves=(line,)))
    editor.trigger("fitPage")
    editor.session.selected.choose({0})
    editor.session.selected.edit_chosen()
    editor.click(points[1])
    editor.hover((20.0, 20.0))
    editor.wait_for_rest()

    def seen(index):
        canvas = editor.window.canvas
        picture, middle = canvas.grab().toImage(), canvas.to_pixel(*points[index])
        ratio, around = picture.devicePixelRatio(), range(-6, 7)
        return {
            picture.pixelColor(round((middle.x() + x) * ratio), round((middle.y() + y) * ratio)).name()
            for x in around
            for y in around
        }

    def middle_of(index):
        return colour_at(editor, *points[index])

    try:
        own = [each.name() for each in point_colours(4, PRINTED_IN_DARK)]
        theme = PRINTED_IN_DARK
        for index in (0, 2, 3):  # on the page, and on the desk
            assert theme.accent.name() in seen(index)
            assert own[index] not in seen(index)
            assert middle_of(index) == theme.paper
        assert middle_of(1) == theme.accent
        assert layer.numbers == []
        editor.trigger("numberPoints")
        editor.settle()
        assert own[2] in seen(2)
        assert len(layer.numbers) == 4
        assert store.state.drawings.numbered
        assert store.state.sketches.numbered
    finally:
        editor.trigger("numberPoints")
        store.change(theme_mode=ThemeMode.SYSTEM, grid=True)


def test_what_a_sketch_calls_a_velocity_is_a_handle_on_a_page(drawn):
    session = drawn.session
    session.selected.activate(0)
    drawn.click((8.0, 4.0))

    def told():
        """The hint over the handle, and what its drag says and is called."""
        at = drawn.handle(ahead=False).position
        drawn.hover(at)
        hint = drawn.window.status_line.hint
        drawn.press(at)
        drawn.move((at[0] + 1.0, at[1] + 1.0))
        readout = drawn.status
        drawn.release((at[0] + 1.0, at[1] + 1.0))
        return hint, readout, session.undo_stack.undoText()

    for page, word in ((None, "velocity"), (Page(0.0, 0.0, 20.0, 20.0), "handle")):
        session.change("Page", lambda document, page=page: replace(document, page=page))
        hint, readout, step = told()
        assert hint.startswith(f"Drag to set the {word} of point 1")
        assert readout.startswith(f"{word.capitalize()} of point 1: ")
        assert step == f"Set {word} of point 1"
