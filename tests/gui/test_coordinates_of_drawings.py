"""Coordinates of drawings are those of SVG: told down from the upper left corner, to the last digit."""

from __future__ import annotations

import re
import shutil
import subprocess

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QLineEdit, QWidget

from app.document.guide_edits import place_words
from app.document.model import Document, Page, ReferenceImage, make_curve
from app.document.readings import readings_of
from app.exchange.corner import shifted
from app.exchange.options import Options
from app.exchange.svg.writer import svg_of
from app.families import HERMITE
from app.tools.snapping import SnapKind

Key = Qt.Key
SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="77mm" viewBox="0 0 100 77">'
    '<rect id="r" x="20.1" y="30.3" width="40" height="10" fill="#c04000"/>{more}</svg>'
)
MILLIMETRES_OF_A_PIXEL = 25.4 / 96


@pytest.fixture
def drawing(editor, point_locale):
    """A page of 100 × 77 mm with a line of two points, told at (20.1, 30.3) and (60, 45)."""
    line = make_curve([(20.1, 46.7), (60.0, 32.0)], name="Line", family=HERMITE)
    editor.session.files.begin(Document((line,), page=Page(0.0, 0.0, 100.0, 77.0), unit="mm"))
    editor.trigger("fitPage")
    editor.window.canvas.setFocus()
    return editor


def transform_field(editor, name):
    return editor.window.findChild(QLineEdit, f"transform{name}")


def enter(editor, edit, text):
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)
    QTest.keyClick(edit, Key.Key_Return)
    editor.settle()


def x_and_y(editor):
    editor.session.selected.choose({0})
    editor.trigger("openTransform")
    return tuple(float(transform_field(editor, name).text().replace("−", "-")) for name in "XY")


def saved(editor):
    return svg_of(editor.session.document, Options(unit="mm"))


def start_of_path(text):
    """Return where the first path of an SVG begins, or where its first rectangle lies."""
    number = r"(-?[\d.e-]+)"
    found = re.search(rf'<rect[^>]* x="{number}" y="{number}"', text)
    found = found or re.search(rf' d="M ?{number}[ ,]{number}', text)
    return tuple(map(float, found.groups()))


# The numbers of files


def test_x_and_y_of_an_opened_svg_are_those_of_the_file(open_drawing, point_locale):
    """The page of 77 mm told y as 36.7, up from its lower edge, where the file says 30.3."""
    editor = open_drawing(SVG.format(more=""))
    assert x_and_y(editor) == (20.1, 30.3)
    enter(editor, transform_field(editor, "Y"), "12.4")
    enter(editor, transform_field(editor, "X"), "1 cm")
    assert x_and_y(editor) == (10.0, 12.4)
    assert start_of_path(saved(editor).text) == (10.0, 12.4)


@pytest.mark.parametrize("corner", [(0.0, 0.0), (-30.5, 12.25), (0.0, -77.0)])
def test_x_and_y_are_those_of_the_svg_that_is_written_wherever_the_page_lies(
    editor, open_drawing, point_locale, corner
):
    page = Page(*corner, 100.0, 77.0)
    opened = open_drawing(SVG.format(more="")).session.document
    by = (corner[0] - opened.page.x, corner[1] - opened.page.y)
    editor.session.files.begin(shifted(opened, by))
    editor.settle()
    assert editor.session.document.page == page
    assert x_and_y(editor) == (20.1, 30.3)
    assert start_of_path(saved(editor).text) == (20.1, 30.3)


@pytest.mark.skipif(shutil.which("inkscape") is None, reason="Inkscape is not installed")
def test_x_and_y_are_what_inkscape_says(open_drawing, tmp_path, point_locale):
    editor = open_drawing(SVG.format(more=""))
    enter_place = {"X": "7.3", "Y": "55.1"}
    x_and_y(editor)
    for name, text in enter_place.items():
        enter(editor, transform_field(editor, name), text)
    path = tmp_path / "out.svg"
    path.write_bytes(saved(editor).data)
    name = re.search(r'<(?:rect|path)[^>]*id="([^"]+)"', path.read_text())
    answer = subprocess.run(
        ["inkscape", f"--query-id={name[1]}" if name else "--query-all", "--query-x", "--query-y", str(path)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    told = [float(line) * MILLIMETRES_OF_A_PIXEL for line in answer.stdout.split()]
    # It prints six digits.
    assert told == pytest.approx(x_and_y(editor), abs=1e-4)
    assert x_and_y(editor) == (7.3, 55.1)


def test_guides_are_told_where_inkscape_tells_them(open_drawing):
    """In files of Inkscape guides count from the lower left corner, in its window from the upper one."""
    view = (
        '<sodipodi:namedview xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd">'
        '<sodipodi:guide position="0,57" orientation="0,1"/></sodipodi:namedview>'
    )
    document = open_drawing(SVG.format(more=view)).session.document
    assert [place_words(each, readings_of(document), "mm") for each in document.guides] == ["y = 20 mm"]


# On the canvas


def test_rulers_and_the_status_line_count_down_from_the_corner(drawing):
    shown = drawing.window.canvas.pixel_map
    for side, origin, sign in (("left", 77.0, -1.0), ("bottom", 0.0, 1.0)):
        labels = drawing.window.canvas.getAxis(side).ticks_in(shown).labels
        assert len(labels) >= 3
        assert [origin + sign * float(text.replace("−", "-")) for _, text in labels] == [
            pytest.approx(place, abs=1e-12) for place, _ in labels
        ]
        assert "0" in [text for _, text in labels]
    drawing.hover((60.0, 57.0))
    drawing.wait_for_rest()
    said = drawing.window.findChild(QWidget, "pointerPlace").text()
    x, y = (float(each) for each in re.findall(r"[\d.]+", said))
    assert (x, y) == pytest.approx((60.0, 20.0), abs=drawing.pixel)


def test_lines_of_the_grid_begin_at_the_corner_and_are_snapped_to(drawing):
    """A grid of 10 lay at multiples of 10 from the lower edge of the page: told 7, 17 …"""
    drawing.set_grid(10.0)
    drawing.window.store.change(page_snap_on=True, page_snap_kinds=frozenset({SnapKind.GRID}))
    drawing.trigger("addTool")
    drawing.click((70.0 + 2 * drawing.pixel, 27.0 - 2 * drawing.pixel))
    assert drawing.session.active_curve.points[-1].position == (70.0, 27.0)
    drawing.window.store.change(page_snap_on=False, page_snap_kinds=frozenset())


def test_what_is_typed_goes_down(drawing):
    drawing.session.selected.choose({0})
    before = [point.position for point in drawing.session.document.curves[0].points]
    for key in (Key.Key_G, Key.Key_2, Key.Key_Tab, Key.Key_3, Key.Key_Return):
        QTest.keyClick(drawing.window.canvas, key)
    drawing.settle()
    after = [point.position for point in drawing.session.document.curves[0].points]
    assert after == [(x + 2.0, pytest.approx(y - 3.0, abs=1e-12)) for x, y in before]
    drawing.trigger("copiesInGrid")
    QTest.keyClick(drawing.window.focusWidget(), Key.Key_Return)
    drawing.settle()
    starts = [curve.points[0].y for curve in drawing.session.document.curves]
    assert max(starts) == pytest.approx(after[0][1])
    assert min(starts) < after[0][1] - 10.0


def test_points_are_typed_copied_and_pasted_as_told(drawing):
    drawing.session.selected.edit_chosen()
    drawing.session.selected.set_points([0, 1])
    drawing.settle()
    drawing.trigger("copyPoints")
    assert QGuiApplication.clipboard().text() == "20.1\t30.3\n60.0\t45.0"
    drawing.paste_text("x\ty\n20.1\t30.3\n60\t45")
    drawing.trigger("pasteAsCurve")
    first, second = drawing.session.document.curves
    assert [each.position for each in second.points] == [each.position for each in first.points]
    table = drawing.window.point_table.model()
    assert [table.index(row, 2).data(Qt.ItemDataRole.EditRole) for row in (0, 1)] == [30.3, 45.0]
    assert table.setData(table.index(1, 2), "30.3 + 1/4")
    assert drawing.session.active_curve.points[1].y == 77.0 - 30.55


def test_the_picture_to_trace_lies_where_its_upper_left_corner_is_told(drawing):
    drawing.session.change(
        "Image", lambda now: replace(now, image=ReferenceImage("none.png", 10.0, 20.0, 40.0, 30.0))
    )
    drawing.show_dock("imageDock")
    x, y, width = (drawing.window.findChild(QLineEdit, f"image{name}") for name in ("X", "Y", "Width"))
    assert (x.text(), y.text()) == ("10", "27")
    enter(drawing, y, "5.5")
    assert drawing.session.document.image.y == 77.0 - 5.5 - 30.0
    enter(drawing, width, "20")
    image = drawing.session.document.image
    assert (y.text(), image.height, image.y) == ("5.5", 15.0, 77.0 - 5.5 - 15.0)


# Either way


def test_a_box_of_the_document_turns_y_round_and_nothing_moves(drawing):
    drawing.trigger("documentSettings")
    box = drawing.window.findChild(QCheckBox, "yDown")
    assert (box.isChecked(), box.isEnabled()) == (True, True)
    before = drawing.session.document
    lowest = x_and_y(drawing)
    QTest.mouseClick(box, Qt.MouseButton.LeftButton)
    drawing.settle()
    after = drawing.session.document
    assert after == replace(before, y_up=True)
    assert drawing.session.undo_stack.undoText() == "Y Axis Points Up"
    labels = drawing.window.canvas.getAxis("left").ticks_in(drawing.window.canvas.pixel_map).labels
    assert all(float(text.replace("−", "-")) == place for place, text in labels)
    # Then the lower left corner is told, as Inkscape does.
    height = float(transform_field(drawing, "Height").text())
    assert x_and_y(drawing) == (lowest[0], pytest.approx(77.0 - lowest[1] - height, abs=1e-3))
    drawing.trigger("undo")
    assert box.isChecked()
    assert x_and_y(drawing) == lowest
    drawing.trigger("newSketch")
    assert (box.isChecked(), box.isEnabled()) == (False, False)


def test_who_prefers_it_has_y_up_in_new_and_in_opened_drawings(editor, open_drawing):
    preferences = editor.window.context.preferences
    preferences.y_down = False
    try:
        assert not readings_of(open_drawing(SVG.format(more="")).session.document).is_down
        editor.session.files.give_up_changes()
        editor.trigger("newDrawing")
        assert not readings_of(editor.session.document).is_down
    finally:
        preferences.y_down = True
    editor.session.files.give_up_changes()
    editor.trigger("newDrawing")
    assert readings_of(editor.session.document).is_down


def test_sketches_count_up(editor, point_locale):
    editor.session.commit(Document((make_curve([(1.0, 2.0), (3.0, 5.0)], family=HERMITE),)), "Begin")
    editor.trigger("toggleRulers")
    editor.fit()
    for side in ("left", "bottom"):
        labels = editor.window.canvas.getAxis(side).ticks_in(editor.window.canvas.pixel_map).labels
        assert [float(text.replace("−", "-")) for _, text in labels] == [place for place, _ in labels]
    assert editor.window.point_table.model().index(1, 2).data() == "5"
    editor.trigger("toggleRulers")
