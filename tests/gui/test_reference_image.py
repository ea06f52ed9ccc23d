"""The picture to trace, with real events; and files that are not what they should be."""

from __future__ import annotations

import struct
import zlib

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, QPoint, QPointF, QRect, QSize, Qt, QUrl
from PySide6.QtGui import QColor, QDragEnterEvent, QDropEvent, QImage, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QFileDialog, QLabel, QToolButton

from app.appearance.theme import ThemeMode, theme_of
from app.canvas import image_layer
from app.canvas.image_layer import ImageFileError, inverted_lightness, read_image
from app.document.model import Document, make_curve
from app.document.plane_edits import place_image, set_image
from app.document.transforms import round_step_above
from app.features.reference_image.commands import ImageCommands
from app.storage.files import load
from app.testing import Editor
from app.tools.pointer import Part
from tests.gui.editor_facts import picture, retype


@pytest.fixture
def traced(editor, tmp_path):
    """An editor with a red picture to trace."""
    editor.window.commands[ImageCommands].trace(picture(tmp_path / "red.png"))
    editor.settle()
    return editor


def image_of(editor):
    return editor.session.document.image


def panel_of(editor):
    return editor.window.commands[ImageCommands].panel


def strip_at(editor, place, reach=0):
    """The colours of the pixels above and below a place of the canvas, as the window shows them."""
    canvas = editor.window.canvas
    top = canvas.mapTo(editor.window, canvas.to_pixel(*place)) - QPoint(0, reach)
    editor.settle()
    shot = editor.window.grab(QRect(top, QSize(1, 2 * reach + 1))).toImage()
    return [shot.pixelColor(0, y) for y in range(shot.height())]


def colour_at(editor, place):
    (colour,) = strip_at(editor, place)
    return colour


def middle(image):
    return (image.x + image.width / 2, image.y + image.height / 2)


def test_an_image_is_added_in_the_middle_with_its_aspect_and_undone(traced):
    image = image_of(traced)
    assert image.width / image.height == pytest.approx(60 / 80)
    x_min, y_min, x_max, y_max = traced.window.canvas.pixel_map.box
    assert middle(image) == pytest.approx(((x_min + x_max) / 2, (y_min + y_max) / 2), abs=traced.pixel)
    assert traced.window.context.docks["imageDock"].isVisible()
    assert traced.session.undo_stack.undoText() == "Add image"
    traced.trigger("undo")
    assert image_of(traced) is None
    assert not traced.window.context.docks["imageDock"].isVisible()
    traced.trigger("redo")
    assert image_of(traced) == image
    assert traced.window.context.docks["imageDock"].isVisible()


@pytest.mark.parametrize("name", ["curveDock", "jointsDock", "analysisDock"])
def test_the_tab_in_front_returns_when_the_image_tab_is_hidden(editor, tmp_path, name):
    editor.show_dock(name)
    dock = editor.window.findChild(QDockWidget, name)
    editor.window.commands[ImageCommands].trace(picture(tmp_path / "red.png"))
    editor.settle()
    assert not editor.window.context.docks["imageDock"].visibleRegion().isEmpty()
    editor.trigger("undo")
    assert not dock.visibleRegion().isEmpty()
    editor.trigger("redo")
    editor.show_dock("imageDock")
    editor.trigger("removeImage")
    assert not dock.visibleRegion().isEmpty()


def test_an_image_is_drawn_under_the_grid_with_its_opacity(traced):
    # Just beside the curve and the lines of the grid.
    place = (image_of(traced).x + 0.07, image_of(traced).y + 0.07)
    faint = colour_at(traced, place)
    assert faint.red() > 240
    assert 110 < faint.green() < 140
    retype_opacity(traced, 100)
    strong = colour_at(traced, place)
    assert strong.green() < 10


def page(path):
    """A black and a red stroke on white paper."""
    image = QImage(80, 80, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.fillRect(20, 0, 10, 80, QColor("black"))
    painter.fillRect(60, 0, 10, 80, QColor("red"))
    painter.end()
    assert image.save(str(path))
    return path


def test_in_the_dark_a_page_is_dark_with_its_colours_and_a_photograph_stays(editor, tmp_path):
    editor.new()
    editor.window.commands[ImageCommands].trace(page(tmp_path / "page.png"))
    editor.trigger("toggleGrid")
    image = image_of(editor)

    def colours():
        at = [(image.x + share * image.width, image.y + 0.05 * image.height) for share in (0.1, 0.31, 0.81)]
        return [colour_at(editor, place) for place in at]

    paper, black, red = colours()
    assert paper.lightness() > 240
    assert black.lightness() < 140
    editor.trigger("themeDark")
    paper, black, red = colours()
    background = theme_of(editor.window.palette()).paper
    # Black ink on a sheet that cannot be told from the canvas; it was 138 on 138 grey.
    assert abs(paper.lightness() - background.lightness()) < 15
    assert black.lightness() > 120
    assert red.hue() % 360 in (*range(5), *range(355, 360))
    editor.window.commands[ImageCommands].trace(picture(tmp_path / "grey.png", colour="#808080"))
    place = (image_of(editor).x + 0.07, image_of(editor).y + 0.07)
    photograph = colour_at(editor, place).lightness()
    assert photograph == pytest.approx((128 + background.lightness()) / 2, abs=3)
    editor.trigger("undo")
    editor.trigger("themeLight")
    assert colours()[0].lightness() > 240


def test_lightness_is_turned_and_hue_and_saturation_stay():
    image = QImage(4, 1, QImage.Format.Format_ARGB32)
    for x, colour in enumerate(("#ffffff", "#000000", "#80ff2010", "#3060c0")):
        image.setPixelColor(x, 0, QColor(colour))
    turned = inverted_lightness(image)
    for x in range(4):
        before, after = image.pixelColor(x, 0), turned.pixelColor(x, 0)
        assert after.lightnessF() == pytest.approx(1 - before.lightnessF(), abs=0.005)
        assert after.hslHue() == pytest.approx(before.hslHue(), abs=1)
        assert after.hslSaturationF() == pytest.approx(before.hslSaturationF(), abs=0.01)
        assert after.alpha() == before.alpha()


def retype_opacity(editor, percent):
    slider = panel_of(editor).opacity
    slider.setFocus()
    slider.setSliderDown(True)
    slider.setSliderPosition(percent)
    slider.setSliderDown(False)


def test_fading_is_live_one_step_and_cancellable(traced):
    slider, document = panel_of(traced).opacity, traced.session.document
    count = traced.session.undo_stack.count()
    slider.setSliderDown(True)
    slider.setSliderPosition(80)
    assert image_of(traced).opacity == pytest.approx(0.8)
    QTest.keyClick(slider, Qt.Key.Key_Escape)
    slider.setSliderDown(False)
    assert traced.session.document is document
    assert slider.value() == 50
    retype_opacity(traced, 20)
    assert traced.session.undo_stack.count() == count + 1
    assert traced.session.undo_stack.undoText() == "Fade image to 20 %"


def test_the_image_is_not_hit_outside_of_move_mode(traced):
    image = image_of(traced)
    traced.drag(middle(image), (middle(image)[0] + 1, middle(image)[1]))
    assert image_of(traced) == image


def test_dragging_moves_the_image_and_no_point(traced):
    image, points = image_of(traced), traced.curve.points
    traced.trigger("moveImage")
    # Where a point lies, too.
    traced.drag_point(3, to=(traced.point(3)[0] + 0.5, traced.point(3)[1] + 0.25))
    moved = image_of(traced)
    assert (moved.x - image.x, moved.y - image.y) == pytest.approx((0.5, 0.25), abs=2 * traced.pixel)
    assert (moved.width, moved.height) == (image.width, image.height)
    assert traced.curve.points == points
    assert traced.session.undo_stack.undoText() == "Move image"
    traced.trigger("undo")
    assert image_of(traced) == image
    traced.escape()
    assert not traced.action("moveImage").isChecked()
    traced.drag_point(3, to=(1, 2.5))
    assert traced.curve.points != points


def test_shift_keeps_to_one_axis(traced):
    image = image_of(traced)
    traced.trigger("moveImage")
    start = middle(image)
    traced.drag(start, (start[0] + 0.6, start[1] + 0.2), keys=Qt.KeyboardModifier.ShiftModifier)
    assert image_of(traced).y == image.y
    assert image_of(traced).x > image.x


@pytest.mark.parametrize(("corner", "fixed"), [((0, 0), (1, 1)), ((1, 0), (0, 1)), ((1, 1), (0, 0))])
def test_a_corner_scales_the_image_about_the_opposite_corner(traced, corner, fixed):
    image = image_of(traced)

    def at(image, share):
        return (image.x + share[0] * image.width, image.y + share[1] * image.height)

    traced.trigger("moveImage")
    grip, anchor = at(image, corner), at(image, fixed)
    traced.drag(grip, ((grip[0] + anchor[0]) / 2, (grip[1] + anchor[1]) / 2))
    scaled = image_of(traced)
    assert scaled.width == pytest.approx(image.width / 2, abs=3 * traced.pixel)
    assert scaled.width / scaled.height == pytest.approx(image.width / image.height)
    assert at(scaled, fixed) == pytest.approx(anchor)
    assert traced.session.undo_stack.undoText() == "Scale image"


def test_escape_puts_a_moved_or_scaled_image_back(traced):
    document, image = traced.session.document, image_of(traced)
    traced.trigger("moveImage")
    for start in (middle(image), (image.x, image.y)):
        traced.press(start)
        traced.move((start[0] + 0.7, start[1] + 0.3))
        assert image_of(traced) != image
        traced.escape()
        traced.release((start[0] + 0.7, start[1] + 0.3))
        assert traced.session.document is document
        assert traced.action("moveImage").isChecked()
    traced.escape()
    assert not traced.action("moveImage").isChecked()


def test_arrow_keys_nudge_the_image(traced):
    """By as much as points: a pixel made 0.9134199134199135 of 0.9, and went on from there."""
    traced.session.history.clock = lambda: 0.0  # however slow the machine is, the keys are quick
    traced.session.change("Place", lambda document: place_image(document, (0.9, -0.3)))
    traced.trigger("moveImage")
    steps, step = traced.session.undo_stack.count(), round_step_above(2 * traced.pixel)
    for _ in range(3):
        traced.key(Qt.Key.Key_Right)
    traced.key(Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    image = image_of(traced)
    assert (image.x, image.y) == (round(0.9 + 3 * step, 6), round(-0.3 + 10 * step, 6))
    assert traced.session.undo_stack.count() == steps + 1


def test_the_hint_announces_the_effect_of_a_press(traced):
    image = image_of(traced)
    traced.trigger("moveImage")
    traced.hover(middle(image))
    assert "move the image" in traced.window.status_line.hint
    traced.hover((image.x, image.y))
    assert "scale the image" in traced.window.status_line.hint


@pytest.mark.parametrize("tool", ["addTool", "selectTool"])
def test_selecting_a_tool_ends_moving_the_image(traced, tool):
    traced.trigger("moveImage")
    traced.trigger(tool)
    assert Part.IMAGE not in traced.window.canvas.tools.tool.hits
    assert not traced.action("moveImage").isChecked()


def test_a_long_name_never_widens_the_window(qtbot, tmp_path):
    editor = Editor(qtbot, size=(1024, 700))
    path = picture(tmp_path / f"{'x' * 120}.png")
    editor.window.commands[ImageCommands].trace(path)
    editor.session.save(tmp_path / "a.curve.json")
    path.unlink()
    editor.window.open_file(tmp_path / "a.curve.json")
    editor.settle()
    assert editor.window.width() == 1024
    assert editor.window.context.docks["imageDock"].width() < 400


def test_a_locked_image_stays(traced):
    traced.trigger("moveImage")
    panel_of(traced).lock.click()
    image = image_of(traced)
    assert image.locked
    assert not traced.action("moveImage").isEnabled()
    assert Part.IMAGE not in traced.window.canvas.tools.tool.hits
    assert not panel_of(traced).x_edit.isEnabled()
    traced.drag(middle(image), (0, 0))
    assert image_of(traced) == image
    panel_of(traced).lock.click()
    assert traced.action("moveImage").isEnabled()


def test_positions_and_sizes_of_the_image_can_be_typed(traced):
    panel, image = panel_of(traced), image_of(traced)
    retype(panel.x_edit, "1/2")
    assert image_of(traced).x == 0.5
    assert image_of(traced).y == image.y
    retype(panel.width_edit, "6")
    assert (image_of(traced).width, image_of(traced).height) == pytest.approx((6, 8))
    retype(panel.height_edit, "4")
    assert (image_of(traced).width, image_of(traced).height) == pytest.approx((3, 4))


def test_an_impossible_number_is_explained(traced):
    panel, document = panel_of(traced), traced.session.document
    for typed in ("0", "-3", "wide", "1e15"):
        retype(panel.width_edit, typed)
        assert traced.session.document is document, typed
        problem = panel.findChild(QLabel, "imageProblem")
        assert not problem.isHidden(), typed
        assert problem.text().startswith("⚠"), typed
        QTest.keyClick(panel.width_edit, Qt.Key.Key_Escape)
        assert problem.isHidden(), typed


def test_untyped_numbers_are_not_rounded(traced):
    panel, document = panel_of(traced), traced.session.document
    panel.x_edit.setFocus()
    QTest.keyClick(panel.x_edit, Qt.Key.Key_Return)
    assert traced.session.document is document


def test_the_image_can_be_removed(traced):
    traced.trigger("moveImage")
    traced.trigger("removeImage")
    assert image_of(traced) is None
    assert not traced.window.context.docks["imageDock"].isVisible()
    assert Part.IMAGE not in traced.window.canvas.tools.tool.hits
    traced.trigger("undo")
    assert image_of(traced) is not None


def test_the_panel_follows_the_side_panel_and_the_presentation(traced):
    dock = traced.window.context.docks["imageDock"]
    traced.trigger("toggleSidePanel")
    assert not dock.isVisible()
    traced.trigger("toggleSidePanel")
    assert dock.isVisible()
    traced.trigger("presentation")
    assert not dock.isVisible()
    traced.trigger("presentation")
    assert dock.isVisible()
    traced.trigger("removeImage")
    traced.trigger("toggleSidePanel")
    traced.trigger("toggleSidePanel")
    assert not dock.isVisible()


def test_document_and_picture_can_be_moved_together(traced, tmp_path):
    here = tmp_path / "a.curve.json"
    traced.session.save(here)
    assert b'"path": "red.png"' in here.read_bytes()
    there = tmp_path / "elsewhere"
    there.mkdir()
    # A document whose file goes while it is open is asked about.
    traced.session.new()
    for name in ("a.curve.json", "red.png"):
        (tmp_path / name).rename(there / name)
    traced.window.open_file(there / "a.curve.json")
    assert image_of(traced).path == str(there / "red.png")
    assert traced.message == ""


def test_saving_elsewhere_keeps_the_picture(traced, tmp_path):
    folder = tmp_path / "deep"
    folder.mkdir()
    traced.session.save(folder / "b.curve.json")
    assert b'"path": "../red.png"' in (folder / "b.curve.json").read_bytes()
    assert load(folder / "b.curve.json") == traced.session.document
    assert not traced.session.files.is_modified


def test_a_missing_image_file_is_explained_and_can_be_located(traced, tmp_path):
    path = tmp_path / "a.curve.json"
    traced.session.save(path)
    (tmp_path / "red.png").unlink()
    picture(tmp_path / "moved.jpg", 100, 50)
    traced.window.open_file(path)
    image = image_of(traced)
    assert "There is no file" in traced.message
    offer = traced.window.message_bar.findChild(QToolButton, "offeredAction")
    assert offer.isVisible()
    assert offer.defaultAction() is traced.action("findImage")
    assert offer.text() == "Find Image"
    assert len(traced.curve.points) == 8
    assert panel_of(traced).findChild(QLabel, "imageProblem").isVisible()
    traced.screenshot()
    traced.window.commands[ImageCommands].find(tmp_path / "moved.jpg")
    assert traced.message == ""
    assert panel_of(traced).findChild(QLabel, "imageProblem").isHidden()
    found = image_of(traced)
    assert (found.x, found.y, found.width) == (image.x, image.y, image.width)
    assert found.height == pytest.approx(found.width / 2)
    traced.trigger("undo")
    assert "There is no file" in traced.message


def test_the_warning_can_be_dismissed(traced, tmp_path):
    traced.session.save(tmp_path / "a.curve.json")
    (tmp_path / "red.png").unlink()
    traced.window.open_file(tmp_path / "a.curve.json")
    traced.window.message_bar.findChild(QToolButton, "closeMessage").click()
    traced.drag_point(2, to=(0.5, 4.2))
    assert traced.message == ""


# PySide6 6.12 wants a QPointF here, which 6.11 does not take.
def test_a_dropped_picture_is_one_to_trace(editor, tmp_path):
    mime = QMimeData()
    mime.setUrls([QUrl.fromLocalFile(str(picture(tmp_path / "drop.JPG")))])
    for kind, place in ((QDragEnterEvent, QPoint(300, 300)), (QDropEvent, QPointF(300, 300))):
        held = (Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier)
        QApplication.sendEvent(editor.window, kind(place, Qt.DropAction.CopyAction, mime, *held))
    assert image_of(editor).path == str(tmp_path / "drop.JPG")


# Files are data


def png_header(width, height):
    """A PNG that claims a size and holds nothing."""
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(b""))]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    )


def test_a_large_picture_is_scaled_down_on_reading(tmp_path):
    image = read_image(str(picture(tmp_path / "wide.png", 5000, 50)))
    assert (image.width(), image.height()) == (4096, 41)


def test_a_huge_picture_is_refused_before_decoding(editor, tmp_path):
    path = tmp_path / "huge.png"
    path.write_bytes(png_header(50_000, 40_000))
    document = editor.session.document
    editor.window.commands[ImageCommands].trace(path)
    assert "50000 × 40000 pixels" in editor.message
    assert editor.session.document is document


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("text.png", b"no picture at all", "not a PNG or JPEG image"),
        ("empty.jpg", b"", "not a PNG or JPEG image"),
        ("drawing.png", b"<svg xmlns='http://www.w3.org/2000/svg'/>", "not a PNG or JPEG image"),
        ("other.png", b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", "not a PNG or JPEG image"),
        ("bitmap.png", b"BM" + bytes(60), "not a PNG or JPEG image"),
    ],
)
def test_files_that_are_no_picture_are_refused(tmp_path, name, data, reason):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(ImageFileError, match=reason):
        read_image(str(tmp_path / name))


@pytest.mark.qt_log_ignore("libpng|Corrupt|Premature|Unsupported|allocation")
def test_a_broken_picture_is_refused(tmp_path):
    path = tmp_path / "broken.png"
    path.write_bytes(png_header(60, 80))
    with pytest.raises(ImageFileError, match="is damaged"):
        read_image(str(path))


def test_folders_and_devices_are_refused(tmp_path):
    for path in (tmp_path, "/dev/zero", tmp_path / "nothing.png"):
        with pytest.raises(ImageFileError):
            read_image(str(path))


def test_the_content_decides_not_the_name(tmp_path):
    path = picture(tmp_path / "really.jpg")
    path.rename(tmp_path / "named.png")
    assert read_image(str(tmp_path / "named.png")).width() == 60


def test_moving_the_image_does_not_read_its_file_again(traced, monkeypatch):
    monkeypatch.setattr(image_layer, "read", lambda _path: pytest.fail("read again"))
    traced.trigger("moveImage")
    traced.drag(middle(image_of(traced)), (1, 1))
    traced.trigger("undo")


def test_far_zooms_draw_without_complaint(qtbot, tmp_path):
    editor = Editor(qtbot)
    editor.window.commands[ImageCommands].trace(picture(tmp_path / "red.png", 300, 400))
    editor.trigger("moveImage")
    for notches in (-60, 110, -100):
        # Where the picture is in the end, far out of sight.
        canvas = editor.window.canvas
        editor.wheel(canvas.to_plane(canvas.camera.centre()), notches)
        editor.screenshot()


@pytest.mark.parametrize(
    "box", [((-0.1, 0.7), (0.3, 1.1)), ((1e5, 3e5), (-7e4, 1e5)), ((1e-4, 3e-4), (0, 2e-4))]
)
def test_a_new_picture_lies_at_short_numbers(editor, tmp_path, box):
    editor.window.canvas.camera.show_box(*box)
    editor.window.commands[ImageCommands].trace(picture(tmp_path / "red.png"))
    image = image_of(editor)
    for value in (image.x, image.y):
        assert float(f"{value:.6g}") == value
    x_min, y_min, x_max, y_max = editor.window.canvas.pixel_map.box
    assert middle(image) == pytest.approx(((x_min + x_max) / 2, (y_min + y_max) / 2), abs=1.01 * editor.pixel)


def test_the_import_dialog_accepts_a_picture(editor, tmp_path, monkeypatch):
    chosen = [str(picture(tmp_path / name, 60, 40)) for name in ("a.png", "b.PNG")]
    filters = []
    monkeypatch.setattr(
        QFileDialog, "getOpenFileNames", lambda *words: (filters.append(words[3]), (chosen, ""))[1]
    )
    editor.new()
    editor.key(Qt.Key.Key_I, Qt.KeyboardModifier.ControlModifier)
    assert "*.png" in filters[0].split(";;")[0]
    assert image_of(editor).path == chosen[0]
    assert editor.message == "b.PNG was not traced: a document has one reference image."


# Curves on a picture


def greys_across(editor, place, reach=5):
    """Return the lightness of the pixels above and below a place of the canvas."""
    return [colour.lightness() for colour in strip_at(editor, place, reach)]


@pytest.mark.parametrize("mode", [ThemeMode.LIGHT, ThemeMode.DARK])
def test_an_inactive_curve_is_visible_on_a_grey_picture(editor, tmp_path, mode):
    editor.window.store.change(theme_mode=mode)
    level = make_curve([(0.0, 1.0), (4.0, 1.0)], name="Level")
    slope = make_curve([(0.0, 0.0), (4.0, 3.0)], name="Slope")
    editor.session.commit(Document((level, slope)), "Begin", active=1)
    editor.fit()
    place = (3.1, 1.0)
    before = greys_across(editor, place)
    session = editor.session
    for grey in ("808080", "a0a0a0", "606060"):
        editor.window.commands[ImageCommands].trace(picture(tmp_path / f"{grey}.png", 400, 400, f"#{grey}"))
        large = replace(image_of(editor), x=-20.0, y=-20.0, width=40.0, height=40.0, opacity=0.86)
        session.commit(set_image(session.document, large), "Enlarge")
        across = greys_across(editor, place)
        # Without a casing the line was some 10 of 255 lighter or darker than what is beside it.
        assert max(across) - min(across) >= 60, grey
        editor.trigger("removeImage")
        assert greys_across(editor, place) == before, grey
