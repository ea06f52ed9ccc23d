"""SVG on the clipboard, in both directions; curves at the pointer and in place."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtTest import QTest

from app import exchange
from app.document.model import Document, make_curve
from app.exchange import reader_process
from app.exchange.svg.coordinates import length
from app.exchange.svg.fragments import SMALL, fragment_in
from app.exchange.svg.reader import read_svg
from app.families import HERMITE
from app.features.import_export.export_commands import ExportCommands
from tests.gui.editor_facts import undo_text

CTRL = Qt.KeyboardModifier.ControlModifier
ALT = Qt.KeyboardModifier.AltModifier
SVG = "http://www.w3.org/2000/svg"
LEAF = f'<svg xmlns="{SVG}"><path id="leaf" d="M0 0C1 2 3 2 4 0C3 -2 1 -2 0 0Z" stroke="#d55e00"/></svg>'


@pytest.fixture
def three(waves):
    editor = waves("ABC")
    editor.window.canvas.setFocus()
    return editor


def offer(**kinds):
    """Put data on the clipboard as another program would, by their MIME types."""
    data = QMimeData()
    for kind, content in kinds.items():
        data.setData(kind.replace("__", "/").replace("_plus_", "+").replace("_", "-"), content.encode())
    QGuiApplication.clipboard().setMimeData(data)


def paste(editor, keys=CTRL):
    editor.key(Qt.Key.Key_V, keys)
    editor.wait_for_work()


def selected_names(editor):
    curves = editor.session.document.curves
    return [curves[place].name for place in sorted(editor.session.selected.curves)]


def middle(curves):
    xs, ys = zip(*(point.position for curve in curves for point in curve.points), strict=True)
    return ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)


def pasted(editor):
    curves = editor.session.document.curves
    return [curves[place] for place in sorted(editor.session.selected.curves)]


# In


@pytest.mark.parametrize("kind", ["image__svg_plus_xml", "text__plain"])
def test_svg_of_another_program_becomes_a_selected_curve(three, kind):
    offer(**{kind: LEAF})
    paste(three)
    assert [each.name for each in three.session.document.curves] == ["A", "B", "C", "leaf"]
    assert selected_names(three) == ["leaf"]
    assert three.curve.style.stroke == "#d55e00"
    assert three.status == "Pasted “leaf”; it is selected."
    assert undo_text(three) == "Paste leaf"
    three.trigger("undo")
    assert [each.name for each in three.session.document.curves] == ["A", "B", "C"]


PATHS = [
    ("M 10 10 C 10 12 12 14 14 14", [(10, -10), (14, -14)]),
    ("m10,10 5-5", [(10, -10), (15, -5)]),
    ('d="M 10 10\nL 30 30"', [(10, -10), (30, -30)]),
]


def test_path_data_alone_become_a_line_in_ink(three):
    for text, places in PATHS:
        three.paste_text(text)
        paste(three, CTRL | ALT)
        assert [point.position for point in three.curve.points] == places, text
        assert three.curve.style == make_curve(()).style, text


def test_elements_out_of_a_file_are_a_drawing(three):
    three.paste_text('<path d="M0 0L4 4" stroke="red"/>\n<g><path d="M0 4L4 0"/></g>')
    paste(three)
    assert len(selected_names(three)) == 2
    assert undo_text(three) == "Paste 2 curves"


def test_svg_without_declared_name_spaces_is_pasted(three):
    three.paste_text('<svg viewBox="0 0 9 9"><use xlink:href="#a"/><path id="a" d="M0 0L4 4"/></svg>')
    paste(three)
    assert len(selected_names(three)) == 2


def test_a_file_with_declarations_is_a_drawing(three):
    three.paste_text('<!DOCTYPE svg [\n<!ENTITY end "0 0Z">\n] >' + LEAF.replace("0 0Z", "&end;"))
    paste(three)
    assert selected_names(three) == ["leaf"]


@pytest.mark.parametrize("text", ["M", "Mean 5", "<html><svg/></html>", "1 2\n3 4", "<svgs/>", ""])
def test_text_without_svg_is_not_pasted_as_a_drawing(text):
    assert fragment_in(text) is None


def test_many_blanks_are_read_at_once():
    """Blanks that two parts of a pattern may take make it try every division between them."""
    assert fragment_in("M 1 1" + " " * 500_000 + "!") is None


def test_clipboard_content_without_curves_is_refused(three):
    three.paste_text(
        f'<svg xmlns="{SVG}"><flowRoot>Leaf</flowRoot><text>Tree</text><path d="M0 0L4 4"/></svg>'
    )
    paste(three)
    assert three.message == "2 texts left out: Leaf and Tree."
    assert len(three.session.document.curves) == 4


def test_a_picture_is_refused_as_a_curve(three):
    """“There are no numbers on the clipboard.”"""
    image = QImage(4, 4, QImage.Format.Format_RGB32)
    image.fill(0)
    before, data = three.session.document, QMimeData()
    data.setImageData(image)
    QGuiApplication.clipboard().setMimeData(data)
    three.trigger("pastePoints")
    assert three.session.document is before
    assert three.status == "A picture is not a curve. To trace it, use File › Reference Image."
    # A spreadsheet offers a picture of its cells, too.
    beside_numbers = QMimeData()
    beside_numbers.setImageData(image)
    beside_numbers.setText("1\t2\n3\t4\n")
    QGuiApplication.clipboard().setMimeData(beside_numbers)
    three.trigger("pasteAsCurve")
    assert len(three.session.document.curves) == len(before.curves) + 1


def test_a_faulty_drawing_is_refused_and_leaves_the_document_unchanged(three):
    document = three.session.document
    three.paste_text(f'<svg xmlns="{SVG}"><path d="M0 0L4"/></svg>')
    paste(three)
    assert three.session.document is document
    assert "The drawing was not pasted." in three.message
    assert "1 path imported only up to an error in the data: Path 2 at the end." in three.message


def test_a_large_drawing_is_read_in_a_process_of_its_own(three, monkeypatch):
    asked = []
    read = reader_process.read_in_process

    def read_and_note(*given, **named):
        asked.append(1)
        return read(*given, **named)

    monkeypatch.setattr(reader_process, "read_in_process", read_and_note)
    # Large, though of few points: many of them take long to draw.
    numbers = ((place % 97 + 0.125, place % 89) for place in range(400))
    data = "M0 0" + "".join(f"{f'L{x:.15f} {y}':>{SMALL // 390}}" for x, y in numbers)
    three.paste_text(f'<svg xmlns="{SVG}"><path d="{data}"/></svg>')
    three.key(Qt.Key.Key_V, CTRL)
    assert three.window.context.work.jobs.is_busy
    three.wait_for_work()
    assert asked
    assert len(three.curve.points) == 401


def test_curves_read_for_a_closed_document_are_not_pasted(three):
    three.paste_text(LEAF)
    three.key(Qt.Key.Key_V, CTRL)
    three.new()
    three.wait_for_work()
    assert [each.points for each in three.session.document.curves] == [()]


def test_curves_pasted_into_an_empty_document_replace_the_empty_curve(editor):
    editor.new()
    editor.window.canvas.setFocus()
    editor.paste_text(LEAF)
    paste(editor)
    assert [each.name for each in editor.session.document.curves] == ["leaf"]


# Where


def test_curves_are_pasted_at_the_pointer(three):
    three.paste_text(LEAF)
    three.hover((2.5, 6.0))
    paste(three)
    assert middle(pasted(three)) == pytest.approx((2.5, 6.0), abs=three.pixel)


def test_coordinates_get_only_visible_digits(three):
    three.paste_text("M 0 0 L 4 4")
    three.hover((2.5, 6.0))
    paste(three)
    assert all(len(repr(value)) <= 6 for point in three.curve.points for value in point.position)


def test_without_a_pointer_curves_are_pasted_in_the_middle_of_the_view(three):
    three.paste_text(LEAF)
    three.leave()
    paste(three)
    left, bottom, right, top = three.window.canvas.pixel_map.box
    assert middle(pasted(three)) == pytest.approx(((left + right) / 2, (bottom + top) / 2), abs=three.pixel)


def test_the_context_menu_pastes_curves_at_the_position_of_its_opening(three):
    three.paste_text(LEAF)
    three.open_menu((0.5, 7.0)).close()
    three.leave()
    three.trigger("pastePoints")
    three.wait_for_work()
    assert middle(pasted(three)) == pytest.approx((0.5, 7.0), abs=three.pixel)


def test_paste_in_place_keeps_the_position(three):
    three.session.selected.set_curves({0, 2})
    before = [three.session.document.curves[place].points for place in (0, 2)]
    three.key(Qt.Key.Key_C, CTRL)
    three.hover((2.5, 6.0))
    paste(three, CTRL | ALT)
    assert [each.points for each in pasted(three)] == before


def test_copied_curves_are_pasted_at_the_pointer_with_their_style(three):
    document = three.session.document
    look = replace(document.curves[1].style, stroke="#0072b2", width=0.2, fill="#ffcc00")
    three.session.commit(document.with_curve(1, replace(document.curves[1], style=look)), "Paint")
    three.key(Qt.Key.Key_C, CTRL)
    three.hover((1.0, 1.0))
    paste(three)
    assert middle(pasted(three)) == pytest.approx((1.0, 1.0), abs=three.pixel)
    assert three.curve.style == look


def test_pasted_curves_keep_their_size_in_another_unit(editor):
    editor.session.commit(Document((make_curve([(0, 0), (10, 0)], name="A"),), unit="mm"), "Begin")
    editor.key(Qt.Key.Key_C, CTRL)
    editor.session.commit(Document((make_curve([(0, 0), (1, 1)], name="B"),), unit="cm"), "Other")
    paste(editor, CTRL | ALT)
    assert [point.position for point in editor.curve.points] == [(0, 0), (1, 0)]


@pytest.mark.parametrize(
    ("text", "width"),
    [
        (f'<svg xmlns="{SVG}"><path d="M0 0L96 0"/></svg>', 25.4),
        (f'<svg xmlns="{SVG}" width="1in" height="1in" viewBox="0 0 1 1"><path d="M0 0L1 0"/></svg>', 25.4),
        ("M0 0L96 0", 96.0),
    ],
)
def test_svg_is_pasted_in_true_size_and_path_data_unchanged(editor, text, width):
    editor.session.commit(Document((make_curve([(0, 0), (10, 0)], name="A"),), unit="mm"), "Begin")
    editor.paste_text(text)
    paste(editor, CTRL | ALT)
    assert editor.curve.points[-1].x - editor.curve.points[0].x == pytest.approx(width)


def test_pasted_curves_outside_the_view_do_not_move_the_view_and_the_offered_key_does(editor):
    """A big thing pasted into a small view zoomed out."""
    editor.settle()
    before = editor.window.canvas.camera.pixel_map
    editor.paste_text(f'<svg xmlns="{SVG}"><path d="M 400 400 L 900 1200"/></svg>')
    paste(editor, CTRL | ALT)
    assert editor.window.canvas.camera.pixel_map == before
    assert editor.status.endswith(
        "; it is selected. Part of it is outside the view; Shift+F shows the selection."
    )
    editor.key(Qt.Key.Key_F, Qt.KeyboardModifier.ShiftModifier)
    assert editor.window.canvas.framing.shows_curves([editor.session.active_index])


@pytest.mark.parametrize("size", [24.0, 2000.0, 0.001])
@pytest.mark.parametrize("is_blank", [True, False])
def test_pasted_path_data_are_seen_whole_with_their_numbers(editor, size, is_blank):
    """A path of 2000 units was pasted into a view of 8, and what was seen of it was empty."""
    canvas = editor.window.canvas
    if is_blank:
        editor.new()
    editor.settle()
    canvas.setFocus()
    editor.hover((1.0, 1.0))
    before = canvas.camera.ranges
    editor.paste_text(f"M0 0C{size / 3} 0 {size} {size / 2} {size} {size}L0 {size}")
    paste(editor)
    editor.settle()
    points = editor.curve.points
    first = points[0].position
    if is_blank:
        assert [point.position for point in points] == [(0, 0), (size, -size), (0, -size)]
    for point, x, y in zip(points, (0, size, 0), (0, -size, -size), strict=True):
        assert (point.x - first[0], point.y - first[1]) == pytest.approx((x, y), rel=1e-9, abs=1e-12)
    assert canvas.framing.shows_curves([editor.session.active_index])
    left, bottom, right, top = canvas.pixel_map.box
    assert max(size / (right - left), size / (top - bottom)) > 0.3
    assert editor.status == "Pasted “Path”; it is selected. The view was changed to show all of it."
    after = canvas.camera.ranges
    editor.trigger("undo")
    assert "Path" not in [curve.name for curve in editor.session.document.curves]
    assert np.array(canvas.camera.ranges) == pytest.approx(np.array(before), rel=1e-9), "the view comes back"
    editor.trigger("redo")
    assert np.array(canvas.camera.ranges) == pytest.approx(np.array(after), rel=1e-9)


def test_undo_of_pasted_points_brings_the_view_back_unless_it_was_moved(editor):
    canvas = editor.window.canvas
    canvas.setFocus()
    for is_moved in (False, True):
        before = canvas.camera.ranges
        editor.paste_text("100 200\n300 -500")
        paste(editor)
        editor.settle()
        assert canvas.framing.shows_all_points
        if is_moved:
            editor.trigger("zoomIn")
        shown = canvas.camera.ranges
        editor.trigger("undo")
        wanted = shown if is_moved else before
        assert np.array(canvas.camera.ranges) == pytest.approx(np.array(wanted), rel=1e-9)


def test_pasted_path_data_that_are_seen_whole_do_not_move_the_view(three):
    three.settle()
    before = three.window.canvas.camera.pixel_map
    three.hover((2.0, 2.0))
    three.paste_text("M0 0L1 1")
    paste(three)
    assert three.window.canvas.camera.pixel_map == before
    assert three.status == "Pasted “Path”; it is selected."


# Out


def test_copied_curves_are_svg_for_other_programs(three):
    three.session.selected.set_curves({0, 2})
    three.key(Qt.Key.Key_C, CTRL)
    data = QGuiApplication.clipboard().mimeData()
    root = ElementTree.fromstring(bytes(data.data("image/svg+xml").data()))
    assert len(list(root.iter(f"{{{SVG}}}path"))) == 2
    assert len(list(ElementTree.fromstring(data.text()).iter(f"{{{SVG}}}path"))) == 2
    image = QImage.fromData(data.data("image/png"))
    assert (image.width(), image.pixelColor(0, 0).alpha()) == (1600, 0)
    assert data.imageData() == image


TINY = 800 / 1.12
"""Length of a curve that fills a picture of 800 pixels but for a margin of 6 % of its length on each side."""

IN_PIXELS = [
    ("mm", 25.4, 96.0),
    ("in", 0.5, 48.0),
    ("", 400.0, 400.0),
    ("", 40.0, 40.0),
    ("", 9.0, TINY),
    ("s", 4.0, TINY),
]


@pytest.mark.parametrize(("unit", "side", "pixels"), IN_PIXELS)
def test_copied_and_exported_svg_have_the_same_size(editor, tmp_path, unit, side, pixels):
    """A curve of 9 units was pasted 9 pixels wide, and exported 800; one of 40 mm was pasted 10.58 mm wide
    into Inkscape 1.2, which passes over the view box."""
    curve = make_curve([(0.0, 0.0), (side / 2, side / 4), (side, 0.0)], family=HERMITE)
    editor.session.commit(Document((curve,), unit=unit), "Begin")
    editor.key(Qt.Key.Key_C, CTRL)
    data = QGuiApplication.clipboard().mimeData()
    editor.window.commands[ExportCommands].export(tmp_path / "a.svg")
    editor.wait_for_work()
    copied, as_text = bytes(data.data("image/svg+xml").data()), data.text().encode()
    roots = [ElementTree.fromstring(svg) for svg in (copied, as_text, (tmp_path / "a.svg").read_bytes())]
    for name in ("width", "height"):
        first, *others = (length(root.get(name)) for root in roots)
        assert others == pytest.approx([first] * 2, rel=1e-5)
    # Coordinates are pixels for Inkscape; without a unit the text and the file are the same.
    (back,) = read_svg(copied).document.curves
    assert back.points[-1].x - back.points[0].x == pytest.approx(pixels)
    assert length(roots[0].get("width")) == pytest.approx(float(roots[0].get("viewBox").split()[2]), rel=1e-5)
    assert unit in ("mm", "in") or roots[1].get("viewBox") == roots[2].get("viewBox")


def test_without_a_unit_numbers_stay_between_documents(editor):
    editor.session.commit(Document((make_curve([(0, 0), (4, 1)], name="A"),)), "Begin")
    editor.key(Qt.Key.Key_C, CTRL)
    editor.session.commit(Document((make_curve([(0, 0), (1, 1)], name="B"),), unit="mm"), "Other")
    paste(editor, CTRL | ALT)
    assert [point.position for point in editor.curve.points] == [(0, 0), (4, 1)]


def test_copied_points_are_svg_and_numbers_as_text(three):
    three.trigger("selectAll")
    three.key(Qt.Key.Key_C, CTRL)
    data = QGuiApplication.clipboard().mimeData()
    assert data.text().splitlines()[0] == "0.0\t3.0"
    (curve,) = read_svg(bytes(data.data("image/svg+xml").data())).document.curves
    assert len(curve.points) == 4


def test_the_svg_on_the_clipboard_is_created_on_request(three, monkeypatch):
    made = []
    monkeypatch.setattr(exchange, "svg_for_clipboard", lambda *_: made.append(1))
    three.key(Qt.Key.Key_C, CTRL)
    assert not made


def test_curves_that_no_picture_can_hold_are_copied_all_the_same(editor):
    editor.session.commit(Document((make_curve([(0, 0), (0, 0)], family=HERMITE),)), "Begin")
    editor.key(Qt.Key.Key_C, CTRL)
    data = QGuiApplication.clipboard().mimeData()
    assert not data.data("image/svg+xml")
    paste(editor, CTRL | ALT)
    assert len(editor.session.document.curves) == 2


def test_a_copied_svg_is_pasted_unchanged(three):
    before = three.curve
    three.key(Qt.Key.Key_C, CTRL)
    text = QGuiApplication.clipboard().text()
    three.paste_text(text)
    paste(three, CTRL | ALT)
    positions = [point.position for point in three.curve.points]
    assert positions == [point.position for point in before.points]


def test_the_point_table_still_pastes_numbers(three):
    three.paste_text("7 8")
    three.key(Qt.Key.Key_V, CTRL)
    assert three.curve.points[-1].position == (7, 8)
    QTest.keyClick(three.window.canvas, Qt.Key.Key_N, CTRL | ALT)
    assert len(three.session.document.curves) == 4


# Shapes and groups


RING = f"""<svg xmlns="{SVG}"><g id="logo">
<path id="ring" fill="#009e73" fill-rule="evenodd" d="M0 0h6v6h-6zM2 2h2v2h-2z"/>
<path id="stem" d="M3 6v4" stroke="#000"/></g></svg>"""


def looks(curves):
    return [(curve.name, curve.shape, curve.groups) for curve in curves]


def test_shapes_and_groups_are_pasted_under_unused_names(three):
    three.paste_text(RING)
    paste(three)
    first = pasted(three)
    assert len(first) == 3
    assert len({curve.groups for curve in first}) == 1
    assert first[0].shape == first[1].shape != ""
    paste(three)
    second = pasted(three)
    assert {curve.groups for curve in second}.isdisjoint({curve.groups for curve in first})
    assert second[0].shape != first[0].shape
    assert [curve.style for curve in second] == [curve.style for curve in first]


@pytest.mark.parametrize("keys", [Qt.Key.Key_C, Qt.Key.Key_X])
def test_a_shape_is_copied_as_a_whole(three, keys):
    three.paste_text(RING)
    paste(three)
    ring = pasted(three)[1]
    place = three.session.document.curves.index(ring)
    three.session.selected.activate(place)
    before = looks(three.session.document.curves)
    three.key(keys, CTRL)
    assert len(three.session.document.curves) == (6 if keys == Qt.Key.Key_C else 4)
    three.session.selected.activate(0)
    paste(three, CTRL | ALT)
    shape = pasted(three)
    assert len(shape) == 2
    assert shape[0].shape == shape[1].shape != ""
    assert (shape[0].shape == ring.shape) is (keys == Qt.Key.Key_X)
    three.trigger("undo")
    assert looks(three.session.document.curves) == (
        before if keys == Qt.Key.Key_C else [each for each in before if each[1] != ring.shape]
    )


def test_deleting_all_points_of_a_hole_keeps_the_shape(three):
    three.paste_text(RING)
    paste(three)
    three.session.selected.activate(three.session.document.curves.index(pasted(three)[1]))
    three.select(range(len(three.curve.points)))
    three.key(Qt.Key.Key_Delete)
    assert len(three.session.document.curves) == 5


def test_points_of_a_shape_are_copied_as_a_curve(three):
    three.paste_text(RING)
    paste(three)
    three.session.selected.activate(three.session.document.curves.index(pasted(three)[0]))
    three.select([0, 1, 2])
    three.key(Qt.Key.Key_C, CTRL)
    three.key(Qt.Key.Key_N, CTRL | ALT)
    assert three.curve.shape == ""
    assert len(three.curve.points) == 3
