"""Pictures placed in a drawing as objects: imported, dropped, pasted; a sketch has one to trace."""

from __future__ import annotations

import base64

import msgspec
import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QIODevice, QMimeData, QPoint, Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QLabel

from app.document.content import Picture
from app.document.contents import corners_of
from app.document.style import NO_PAINT
from app.exchange.svg.reader import read_svg
from app.features.import_export.export_commands import ExportCommands
from app.features.style.panel import StylePanel
from app.workbench import placed_pictures
from app.workbench.clipboard import put_on_clipboard
from tests.gui.pixels import is_colour
from tests.gui.test_drops import drop

INCH = 25.4
RED = QColor("#ff0000")


def picture(path, width=96, height=48, dots_per_inch=None):
    image = QImage(width, height, QImage.Format.Format_RGB32)
    image.fill(RED)
    if dots_per_inch is not None:
        image.setDotsPerMeterX(round(dots_per_inch / 0.0254))
        image.setDotsPerMeterY(round(dots_per_inch / 0.0254))
    assert image.save(str(path))
    return path


@pytest.fixture
def sheet(editor):
    """A new drawing on a page in millimetres."""
    editor.trigger("newDrawing")
    editor.settle()
    return editor


@pytest.fixture
def imported(sheet, monkeypatch):
    """Import files by the dialog's answer."""

    def choose(*paths):
        monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (list(map(str, paths)), ""))
        sheet.trigger("importFile")
        sheet.wait_for_work()

    return choose


def box(curve):
    corners = np.array(corners_of(curve))
    return [*corners.min(axis=0), *corners.max(axis=0)]


def size(curve):
    left, bottom, right, top = box(curve)
    return right - left, top - bottom


def pictures(editor):
    return [each for each in editor.session.document.curves if isinstance(each.form, Picture)]


def test_one_that_is_imported_is_an_object_as_large_as_it_is_on_paper(sheet, imported, tmp_path):
    """It was one to trace: behind everything, no object, and gone from the SVG."""
    session = sheet.session
    steps = session.undo_stack.count()
    for dots, name in ((72, "a.png"), (300, "b.jpg")):
        path = picture(tmp_path / name, dots_per_inch=dots)
        imported(path)
        placed = session.document.curves[-1]
        assert size(placed) == pytest.approx((96 / dots * INCH, 48 / dots * INCH))
        assert (placed.style.fill, placed.style.stroke) == (NO_PAINT, NO_PAINT)
        assert base64.b64decode(placed.form.data) == path.read_bytes()
        assert session.selected.curves == {len(session.document.curves) - 1}
        assert session.undo_stack.undoText() == f"Import {name}"
    assert session.undo_stack.count() == steps + 2
    assert [each.name for each in session.document.curves] == ["a", "b"]
    assert session.document.image is None
    page, (left, bottom, right, top) = session.document.page, box(placed)
    assert (left + right, bottom + top) == pytest.approx((page.width, page.height), abs=2 * sheet.pixel)
    assert is_colour(sheet.window.canvas.viewport().grab().toImage(), RED).any()
    sheet.trigger("undo")
    sheet.trigger("undo")
    assert pictures(sheet) == []


def test_a_large_one_fits_the_page_and_those_that_cannot_be_placed_are_told(
    sheet, imported, tmp_path, monkeypatch
):
    wide = picture(tmp_path / "wide.png", 3000, 1000)
    (tmp_path / "bad.png").write_bytes(b"no picture")
    imported(wide, tmp_path / "bad.png")
    (placed,), page = pictures(sheet), sheet.session.document.page
    assert size(placed) == pytest.approx((page.width, page.width / 3))
    assert box(placed)[0] == pytest.approx(0)
    assert sheet.message == "bad.png was not imported. “bad.png” is no PNG or JPEG picture."
    monkeypatch.setattr(placed_pictures, "MOST_DATA", len(placed.form.data) + 8)
    imported(picture(tmp_path / "more.png"))
    assert len(pictures(sheet)) == 1
    assert "more.png was not imported. “more.png” takes " in sheet.message
    assert "a drawing holds" in sheet.message


def test_one_that_a_camera_left_lying_stands_upright_for_every_program(sheet, imported, tmp_path):
    path = picture(tmp_path / "phone.jpg", 60, 20)
    data = path.read_bytes()
    # Exif: one entry, the orientation 6, a quarter turn.
    tiff = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"
    exif = b"Exif\0\0" + tiff
    path.write_bytes(data[:2] + b"\xff\xe1" + (len(exif) + 2).to_bytes(2, "big") + exif + data[2:])
    imported(path)
    width, height = size(pictures(sheet)[0])
    assert height == pytest.approx(3 * width)
    held = QImage.fromData(base64.b64decode(pictures(sheet)[0].form.data))
    assert (held.width(), held.height()) == (20, 60)


def test_those_dropped_on_a_drawing_are_placed_there_and_a_sketch_traces_one(sheet, tmp_path):
    paths = [picture(tmp_path / "a.png"), picture(tmp_path / "b.png")]
    canvas = sheet.window.canvas
    place = canvas.to_plane(canvas.viewport().mapFrom(sheet.window, QPoint(300, 300)))
    drop(sheet, *paths)
    assert sheet.session.undo_stack.undoText() == "Import 2 pictures"
    assert sheet.session.selected.curves == {0, 1}
    for placed in pictures(sheet):
        left, bottom, right, top = box(placed)
        assert ((left + right) / 2, (bottom + top) / 2) == pytest.approx(place, abs=2 * sheet.pixel)
    sheet.session.files.give_up_changes()
    sheet.trigger("newSketch")
    drop(sheet, *paths)
    assert pictures(sheet) == []
    assert sheet.session.document.image.path == str(paths[0])


def test_one_on_the_clipboard_is_pasted(sheet, tmp_path):
    """“There are no numbers on the clipboard.”"""
    session, image = sheet.session, QImage(str(picture(tmp_path / "a.png", 192, 96)))
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")
    as_file, as_image, beside_numbers = QMimeData(), QMimeData(), QMimeData()
    as_file.setData("image/png", buffer.data())
    as_file.setHtml("<img src='https://example.org/a.png'>")
    as_image.setImageData(image)
    for count, data in enumerate((as_file, as_image), 1):
        put_on_clipboard(data)
        sheet.hover((60, 80))
        sheet.key(Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
        assert len(pictures(sheet)) == count
        left, bottom, right, top = box(pictures(sheet)[-1])
        assert ((left + right) / 2, (bottom + top) / 2) == pytest.approx((60, 80), abs=2 * sheet.pixel)
        assert right - left == pytest.approx(2 * INCH)
        assert session.undo_stack.undoText() == f"Paste {pictures(sheet)[-1].name}"
        assert session.selected.curves == {count - 1}
    # A spreadsheet offers a picture of its cells.
    beside_numbers.setImageData(image)
    beside_numbers.setText("1\t2\n3\t4\n")
    put_on_clipboard(beside_numbers)
    sheet.trigger("pasteAsCurve")
    assert len(pictures(sheet)) == 2
    assert len(session.document.curves) == 3
    session.files.give_up_changes()
    sheet.trigger("newSketch")
    again = QMimeData()
    again.setImageData(image)
    put_on_clipboard(again)
    sheet.trigger("pastePoints")
    assert "A picture is pasted into a drawing, which has a page." in sheet.status
    assert pictures(sheet) == []


def test_one_that_is_placed_is_clipped_cloned_written_and_read_again(sheet, imported, tmp_path):
    imported(picture(tmp_path / "a.png"))
    session = sheet.session
    sheet.key(Qt.Key.Key_D, Qt.KeyboardModifier.AltModifier)
    assert session.document.curves[1].clone is not None
    sheet.key(Qt.Key.Key_Delete)
    left, bottom, right, top = box(pictures(sheet)[0])
    sheet.trigger("ellipseTool")
    sheet.drag((left + 2, bottom + 2), (right - 2, top - 2))
    session.selected.choose({0, 1})
    sheet.trigger("setClip")
    (cut,) = session.document.curves
    assert len(cut.style.clips) == 1
    for name in ("a.svg", "a.pdf", "out.png"):
        sheet.window.commands[ExportCommands].export(tmp_path / name)
        sheet.wait_for_work()
    (back,) = read_svg((tmp_path / "a.svg").read_bytes()).document.curves
    assert (back.form.data, len(back.style.clips)) == (cut.form.data, 1)
    assert size(back) == pytest.approx(size(cut))
    assert b"/Image" in (tmp_path / "a.pdf").read_bytes()
    assert is_colour(QImage(str(tmp_path / "out.png")), RED).any()


def test_it_takes_no_paint_that_nothing_would_show(sheet, imported, tmp_path):
    session, window = sheet.session, sheet.window
    imported(picture(tmp_path / "a.png"))
    sheet.trigger("rectangleTool")
    sheet.drag((20, 20), (60, 40))
    sheet.show_dock("styleDock")
    place = next(at for at, curve in enumerate(session.document.curves) if isinstance(curve.form, Picture))
    shape = 1 - place
    begun = session.document.curves[place].style
    panel = window.findChild(StylePanel, "stylePanel")
    session.selected.choose({place})
    sheet.settle()
    assert [panel.fill.isEnabled(), panel.stroke.isEnabled()] == [False, False]
    assert not any(field.isEnabled() for field in panel.gradients.values())
    assert panel.opacities["opacity"].isEnabled()
    assert panel.findChild(QLabel, "styleNote").text() == "A picture has neither fill nor stroke."
    sheet.trigger("swapFillAndStroke")
    assert sheet.status == "A picture has neither fill nor stroke."
    assert session.document.curves[place].style == begun
    session.selected.choose({place, shape})
    sheet.settle()
    assert panel.fill.isEnabled()
    panel.choose_colour("fill", "#123456")
    assert session.document.curves[shape].style.fill == "#123456"
    assert session.document.curves[place].style == begun
    assert panel.fill.edit.text() == "#123456"
    edit = panel.opacities["opacity"].edit
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "40")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    assert {curve.style.opacity for curve in session.document.curves} == {0.4}
    session.selected.choose({shape})
    sheet.trigger("copyStyle")
    session.selected.choose({place})
    sheet.trigger("pasteStyle")
    assert session.document.curves[place].style == msgspec.structs.replace(begun, opacity=0.4)


def test_a_style_that_is_pasted_to_a_picture_is_told_to_be_none(imported, sheet, tmp_path):
    """Nothing happened, and nothing was said."""
    sheet.trigger("rectangleTool")
    sheet.drag((20, 200), (60, 240))
    sheet.trigger("selectTool")
    sheet.trigger("copyStyle")
    imported(picture(tmp_path / "a.png"))
    document = sheet.session.document
    sheet.trigger("pasteStyle")
    assert sheet.session.document is document
    assert sheet.status == "A picture has neither fill nor stroke."
