"""Drawings of other programs come into the window, and go out again, with all that makes their look."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog, QFileDialog

from app.document.model import Document, make_curve
from app.document.point_edits import set_position
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.import_export.commands import ImportCommands
from app.storage.files import load
from app.workbench.document_files import title_of
from tests.waiting import until

SVG = Path(__file__).parents[1] / "data" / "svg"
INCH = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="1in" height="1in" viewBox="0 0 4 4">'
    '<path id="a" d="M0 0L4 0L4 4Z" fill="#00ff00" stroke="#ff0000" stroke-width="1"/></svg>'
)

pytestmark = pytest.mark.usefixtures("drawings_read_here")


def opened(editor, path):
    editor.window.commands[ImportCommands].import_files([path])
    editor.wait_for_work()
    dialog = editor.window.findChild(QDialog, "importDrawingDialog")
    assert dialog is not None, editor.message
    drawn(editor, dialog)
    return dialog


def drawn(editor, dialog):
    """Wait until the picture of a dialog is there."""
    until(lambda: not dialog.jobs.is_busy)
    editor.settle()


def imported(editor, path):
    dialog = opened(editor, path)
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    return editor.session.document


def colours_in(dialog):
    image = dialog.picture.picture.pixmap().toImage()
    places = [(x, y) for x in range(0, image.width(), 2) for y in range(0, image.height(), 2)]
    return {image.pixelColor(x, y).name() for x, y in places}


def blank(editor):
    editor.session.new()
    editor.settle()


def test_the_dialog_shows_the_drawing_with_its_colours_and_its_size(editor):
    dialog = opened(editor, SVG / "inkscape_logo.svg")
    assert {"#2e7d32", "#c62828", "#0277bd"} <= colours_in(dialog)
    assert not dialog.remarks.isVisible()
    tree = dialog.groups
    names = [tree.topLevelItem(row).text(0) for row in range(tree.topLevelItemCount())]
    assert names == ["Leaves", "Ring", "Sketch"]
    # A group that is not taken is not shown.
    place = tree.visualItemRect(tree.topLevelItem(0))
    QTest.mouseClick(
        tree.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(place.left() + 10, place.center().y())
    )
    drawn(editor, dialog)
    assert "#2e7d32" not in colours_in(dialog)
    assert "#c62828" in colours_in(dialog)
    dialog.close()


def test_a_drawing_for_dark_paper_is_displayed_on_dark_paper(editor):
    dialog = opened(editor, SVG / "material_favorite.svg")
    assert {"#15181c", "#e8eaed"} <= colours_in(dialog)
    dialog.close()


def test_the_dialog_lists_the_losses(editor):
    dialog = opened(editor, SVG / "tabler_home.svg")
    assert dialog.remarks.text() == "1 shape without stroke and fill left out."
    assert dialog.remarks.isVisible()
    dialog.close()


def test_a_circle_of_four_arcs_is_imported_as_four_points(editor, tmp_path):
    """And neither as the pieces of its arcs, nor with the point where it closes twice."""
    arcs = "M80 30A15 15 0 0 1 65 45A15 15 0 0 1 50 30A15 15 0 0 1 65 15A15 15 0 0 1 80 30Z"
    (tmp_path / "ring.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80">'
        f'<path id="ring" d="{arcs}" stroke="#c62828"/>'
        '<rect width="9" height="9"/></svg>'
    )
    blank(editor)
    dialog = opened(editor, tmp_path / "ring.svg")
    row = dialog.groups.topLevelItem(0)
    assert [row.text(column) for column in range(2)] == ["ring", "4 points"]
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    ring = editor.session.document.curves[0]
    assert [point.position for point in ring.points] == [(80, 50), (65, 35), (50, 50), (65, 65)]
    assert ring.closed
    assert not any(point.corner for point in ring.points)


def test_a_new_document_has_the_unit_of_the_drawing(editor):
    blank(editor)
    document = imported(editor, SVG / "inkscape_logo.svg")
    assert document.unit == "mm"
    shown = {curve.name: curve for curve in document.curves}
    assert [curve.groups for curve in document.curves if curve.name == "Leaf"] == [
        ("Leaves", "Left pair"),
        ("Leaves", "use300"),
    ]
    assert shown["Leaf"].style.fill == "#2e7d32"
    assert {curve.shape for curve in document.curves if curve.style.fill == "#c62828"} == {"path400"}
    assert (shown["path600"].visible, shown["path600"].locked) == (False, True)
    editor.trigger("undo")
    assert editor.session.document.unit == ""


def test_a_drawing_replaces_the_first_sketch_unless_the_sketch_was_edited(editor):
    session, sketch = editor.session, editor.session.document
    session.files.begin(sketch)
    for _ in range(2):
        document = imported(editor, SVG / "inkscape_logo.svg")
        assert document.unit == "mm"
        assert "Sketch" not in {curve.name for curve in document.curves}
        assert (title_of(session), session.files.is_modified) == ("inkscape_logo", True)
        # Whole, as what comes to others: ready to be moved. What nobody may move stays out.
        free = {place for place, curve in enumerate(document.curves) if curve.is_selectable}
        assert session.selected.whole_curves == free < set(range(len(document.curves)))
        before = document.curves[min(free)].points[0].x
        editor.key(Qt.Key.Key_Right)
        assert session.document.curves[min(free)].points[0].x > before
        editor.trigger("undo")
        editor.trigger("undo")
        assert (session.document, title_of(session)) == (sketch, "Untitled")
    editor.drag_point(0, to=(0.0, 0.0))
    document = imported(editor, SVG / "inkscape_logo.svg")
    assert (document.curves[0].name, document.unit) == ("Sketch", "")


MEASURED = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="48mm" height="48mm" viewBox="0 0 48 48">'
    '<path d="M0 0L4 0" stroke="#ff0000"/></svg>'
)


@pytest.mark.parametrize(
    ("unit", "said"),
    [
        ("", "Its unit mm is left out."),
        ("in", "Lengths are converted from mm to in."),
    ],
)
def test_content_that_is_not_added_with_the_curves_is_reported(editor, tmp_path, unit, said):
    """The unit was dropped without a word."""
    blank(editor)
    path = tmp_path / "measured.svg"
    path.write_text(MEASURED, encoding="utf-8")
    dialog = opened(editor, path)
    # To a document without curves all of it comes along.
    assert dialog.rest.isHidden()
    dialog.close()
    curve = make_curve(((0, 0), (1, 1), (2, 0)))
    editor.session.commit(Document((curve,), unit=unit), "Begin")
    dialog = opened(editor, path)
    assert (dialog.rest.isVisible(), dialog.rest.text()) == (True, said)
    QTest.keyClick(dialog.into, Qt.Key.Key_Down)
    assert dialog.rest.isHidden()
    QTest.keyClick(dialog.into, Qt.Key.Key_Up)
    assert dialog.rest.isVisible()
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.status == f"Imported measured.svg: 1 curve, 2 points, exact. {said}"
    document = editor.session.document
    assert document.unit == unit


def test_open_begins_a_document_and_import_extends_the_document(editor, tmp_path, monkeypatch):
    """The dialog of Ctrl+O was titled “Import”; it comes where something is otherwise than drawn."""
    path = tmp_path / "poster.svg"
    path.write_text(INCH.replace("</svg>", "<foreignObject/></svg>"), encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    editor.key(Qt.Key.Key_O, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()
    dialog = editor.window.findChild(QDialog, "importDrawingDialog")
    drawn(editor, dialog)
    assert (dialog.windowTitle(), dialog.ok.text()) == ("Open poster.svg", "Open")
    QTest.keyClick(dialog.into, Qt.Key.Key_Up)
    assert dialog.ok.text() == "Import"
    QTest.keyClick(dialog.into, Qt.Key.Key_Down)
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.status.startswith("Opened poster.svg: 1 curve, ")


def test_a_drawing_without_losses_opens_without_a_dialog(editor, tmp_path, monkeypatch):
    """Every file of another program was asked about, also where there was nothing to say."""
    path = tmp_path / "poster.svg"
    path.write_text(INCH, encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    editor.key(Qt.Key.Key_O, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()
    assert editor.window.findChild(QDialog, "importDrawingDialog") is None
    assert editor.status == "Opened poster.svg: 1 curve, 3 points, exact."
    assert (title_of(editor.session), editor.session.files.path) == ("poster", None)
    assert not editor.session.undo_stack.canUndo()
    # What is imported may be put on either document, in part: that is asked.
    dialog = opened(editor, path)
    assert dialog.windowTitle() == "Import poster.svg"


def test_an_opened_drawing_is_among_the_recent_ones_and_opens_from_there(editor, tmp_path):
    path = tmp_path / "badge.svg"
    path.write_text(INCH.replace("</svg>", "<foreignObject/></svg>"), encoding="utf-8")
    open_as_document(editor, path)
    beginning, recent = editor.session.files.origin, editor.window.menus.recent
    recent.aboutToShow.emit()
    first = recent.actions()[0]
    assert first.text().replace("&", "") == "badge.svg"
    # What was open before is shown at once; what of it is otherwise is said.
    first.trigger()
    editor.wait_for_work()
    assert editor.window.findChild(QDialog, "importDrawingDialog") is None
    assert editor.status == "Opened badge.svg: 1 curve, 3 points, exact. 1 foreign object left out."
    assert editor.session.files.origin is not beginning
    assert (title_of(editor.session), editor.session.files.is_modified) == ("badge", False)


def open_as_document(editor, path):
    blank(editor)
    editor.window.commands[ImportCommands].import_files([path], opened=path)
    editor.wait_for_work()
    if dialog := editor.window.findChild(QDialog, "importDrawingDialog"):
        drawn(editor, dialog)
        QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()


def test_an_opened_drawing_is_saved_as_a_document_of_its_own(editor, tmp_path, monkeypatch):
    path, asked = tmp_path / "badge.svg", []
    path.write_text(INCH, encoding="utf-8")
    open_as_document(editor, path)
    session, own = editor.session, tmp_path / "badge.curve.json"
    session.change("Move", lambda document: set_position(document, 0, 0, (7.0, 0.0)))
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *words: asked.append(words[2]) or (str(own), "")
    )
    editor.trigger("saveDocument")
    assert [Path(each).name for each in asked] == ["badge.curve.json"]
    assert (session.files.path, session.files.is_modified) == (own, False)
    assert (load(own), path.read_text(encoding="utf-8")) == (session.document, INCH)


def test_very_many_shapes_without_a_group_are_one_entry_of_the_dialog(editor, tmp_path):
    """From 501 paths on, a file without groups ended in a KeyError in place of the dialog."""
    blank(editor)
    path = tmp_path / "many.svg"
    lines = "".join(f'<path d="M{k} 0V1"/>' for k in range(501))
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{lines}</svg>', encoding="utf-8")
    dialog = opened(editor, path)
    assert dialog.groups.topLevelItemCount() == 1
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.wait_for_work()
    assert len(editor.session.document.curves) == 501


def test_an_inch_is_converted_in_a_document_of_millimetres(editor, tmp_path):
    blank(editor)
    begun = Document((make_curve([(0.0, 0.0), (9.0, 9.0)]),), unit="mm")
    editor.session.change("Begin", lambda _: begun)
    path = tmp_path / "inch.svg"
    path.write_text(INCH, encoding="utf-8")
    document = imported(editor, path)
    assert (document.unit, len(document.curves)) == ("mm", 2)
    assert document.curves[1].points[1].x == pytest.approx(25.4)
    assert document.curves[1].style.width == pytest.approx(6.35)


def test_locked_and_hidden_curves_are_not_selected_after_an_import(editor, tmp_path):
    """All that was opened was chosen, with a hidden ellipse in its ghost: nobody could move anything."""
    blank(editor)
    path = tmp_path / "layers.svg"
    path.write_text(LAYERS)
    document = imported(editor, path)
    selected = editor.session.selected
    assert selected.whole_curves == {place for place in range(5) if document.curves[place].is_selectable}
    assert editor.session.active_curve.is_selectable
    document = imported(editor, path)
    assert selected.whole_curves == {place for place in range(5, 10) if document.curves[place].is_selectable}
    assert len(selected.whole_curves) == 4
    # In the same place.
    assert [curve.points for curve in document.curves[5:]] == [curve.points for curve in document.curves[:5]]


LAYERS = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    ' xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd">'
    '<g inkscape:groupmode="layer" inkscape:label="Back" id="a"'
    ' sodipodi:insensitive="true" style="display:none"><path id="ground" d="M0 0H60V40H0Z" fill="#eee"/></g>'
    '<g inkscape:groupmode="layer" inkscape:label="Art work" id="b"><path id="left" d="M5 5H20V20H5Z"'
    ' fill="#00aa00"/><path id="right" d="M40 5H55V20H40Z" fill="#aa0000"/><g id="pair"><path id="one"'
    ' d="M5 30H20V35H5Z" fill="#0000aa"/><path id="two" d="M40 30H55V35H40Z" fill="#0000aa"/></g></g></svg>'
)


def test_layers_of_inkscape_are_imported_as_groups(editor, tmp_path):
    blank(editor)
    path = tmp_path / "layers.svg"
    path.write_text(LAYERS)
    document = imported(editor, path)
    assert [curve.groups for curve in document.curves] == [
        ("Back",), ("Art work",), ("Art work",), ("Art work", "pair"), ("Art work", "pair"),
    ]  # fmt: skip
    assert [(each.locked, each.visible) for each in document.curves] == [(True, False)] + [(False, True)] * 4
    text = svg_of(document, Options(unit="mm")).text
    assert '<g id="Art_work" inkscape:label="Art work">' in text
    assert text.count("insensitive") == text.count("display") == 1
    again = read_svg(text.encode()).document
    assert [curve.groups for curve in again.curves] == [curve.groups for curve in document.curves]
    assert [(each.locked, each.visible) for each in again.curves] == [(True, False)] + [(False, True)] * 4


PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20" width="200" height="100">{}</svg>'


def test_a_page_without_a_curve_opens_as_an_empty_document_of_its_size(editor, tmp_path):
    """It was refused: “The file contains no curves.”"""
    path = tmp_path / "page.svg"
    path.write_text(PAGE.format('<g id="layer1"/>'), encoding="utf-8")
    open_as_document(editor, path)
    document = editor.session.document
    assert editor.status == "Opened page.svg: no curves."
    assert ([curve.points for curve in document.curves], document.unit) == ([()], "px")
    assert {(each.axis, each.position) for each in document.guides} == {
        ("x", 0.0), ("x", 200.0), ("y", 0.0), ("y", 100.0)
    }  # fmt: skip
    # The page fills the view.
    view, size = editor.window.canvas.camera.pixel_map, editor.window.canvas.viewport().size()
    (left, top), (right, bottom) = view.point(0.0, 100.0), view.point(200.0, 0.0)
    assert 0 < left < 0.2 * size.width() < 0.8 * size.width() < right < size.width()
    assert 0 < top < bottom < size.height()


def test_a_file_of_unsupported_content_adds_nothing_to_a_document(editor, tmp_path):
    path, before = tmp_path / "words.svg", editor.session.document
    path.write_text(PAGE.format('<text>hey</text><path id="a" d="L5 5"/>'), encoding="utf-8")
    dialog = opened(editor, path)
    assert dialog.summary.text() == "No curves."
    assert dialog.remarks.text() == (
        "1 text left out: hey.\n1 path imported only up to an error in the data: a at character 1, “L5 5”."
    )
    assert (dialog.into.currentText(), dialog.into.isEnabled()) == ("A new document", False)
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.session.document != before
    assert [curve.points for curve in editor.session.document.curves] == [()]
