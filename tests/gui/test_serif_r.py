"""A serif R, both of its contours drawn with the pen over a picture and filled, by keys and clicks alone."""

from __future__ import annotations

import pytest
from hands import Hands
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QFileDialog, QToolButton

from app.document.lines import is_line
from app.document.style import NO_PAINT
from app.features.import_export.export_commands import ExportCommands
from app.view_model.points.point_kinds import CORNER, POINT_KINDS, kinds_of

Key = Qt.Key
ALT, CTRL, SHIFT = (
    Qt.KeyboardModifier.AltModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
)

# Places, and where a handle is drawn out to: ahead alone, after a line (Alt), or on both sides.
LINE, CURVE = ALT, Qt.KeyboardModifier.NoModifier
OUTER = (
    ((0, 0), None, LINE), ((14, 0), None, LINE), ((14, 2), (12, 2), LINE), ((10, 5), (10, 8), CURVE),
    ((10, 17), None, LINE), ((15, 17), None, LINE), ((25, 0), None, LINE), ((35, 0), None, LINE),
    ((35, 2), (33, 2), LINE), ((31, 4), (29, 7), CURVE), ((23, 18), (27, 20), LINE),
    ((31, 29), (31, 34), CURVE),
    ((19, 40), (14, 40), CURVE), ((0, 40), None, LINE), ((0, 38), (2, 38), LINE), ((4, 35), (4, 33), CURVE),
    ((4, 5), (4, 3), LINE), ((0, 2), None, CURVE),
)  # fmt: skip
INNER = (
    ((10, 20), None, LINE), ((17, 20), (20, 20), LINE), ((24, 28), (24, 33), CURVE),
    ((17, 37), (14, 37), CURVE), ((10, 37), None, LINE),
)  # fmt: skip

IN_INKSCAPE = 4 + (len(OUTER) + 1) + (len(INNER) + 1) + 3
"""Keys and clicks as counted in Inkscape 1.2.2, a key with modifiers as one; the file dialog is the same.

Ctrl+I, Enter in the questions about the picture, 3 to see it whole, B; a click or a drag for each node and
one to close, of both contours, which that pen fills with black and does not stroke; S, Shift+click on the
outer contour, Ctrl+K.
"""


@pytest.fixture
def sheet(editor, tmp_path, monkeypatch):
    """A new drawing, and a picture that the next file dialog chooses."""
    picture = QImage(320, 180, QImage.Format.Format_RGB32)
    picture.fill(QColor("white"))
    assert picture.save(str(tmp_path / "R.png"))
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([str(tmp_path / "R.png")], ""))
    editor.trigger("newDrawing")
    editor.window.context.store.change(grid=False)
    editor.window.canvas.camera.show_box((-10, 45), (-5, 45))
    editor.window.canvas.setFocus()
    editor.settle()
    return editor


def trace(hands, contour):
    for place, to, held in contour:
        if to is None:
            hands.click(place)
        else:
            hands.drag(place, to, held)
    hands.click(contour[0][0])


def test_both_contours_are_filled_in_no_more_keys_and_clicks_than_in_inkscape(sheet, tmp_path):
    hands = Hands(sheet)
    hands.press(Key.Key_I, CTRL)
    # It lies where the letter is drawn, and is out of the way.
    assert sheet.session.document.image is not None
    # Nothing snaps to the page.
    hands.press(Key.Key_Percent)
    trace(hands, OUTER)
    trace(hands, INNER)
    drawn = sheet.session.document.curves
    assert [len(curve.points) for curve in drawn] == [len(OUTER), len(INNER)]
    hands.press(Key.Key_A, CTRL | SHIFT)
    hands.press(Key.Key_K, CTRL)
    hands.click_on(QToolButton, "fillPaint_Ink")
    hands.click_on(QToolButton, "strokePaint_None")
    assert hands.count <= IN_INKSCAPE
    check_letter(sheet)
    check_file(sheet, tmp_path / "R.svg")


def check_letter(editor):
    """One shape with a hole, corners only where the letter has some, and lines that are straight."""
    outer, inner = editor.session.document.curves
    assert covers(editor.session.document.image, outer)
    assert outer.shape == inner.shape != ""
    assert outer.closed
    assert inner.closed
    assert (outer.style.fill, outer.style.stroke) == ("", NO_PAINT)
    assert [is_line(inner, segment) for segment in range(5)] == [True, False, False, True, True]
    kinds = [POINT_KINDS[kind] for kind in kinds_of(editor.session.views[1])]
    # Beside the stem, where two lines meet.
    assert [kind is CORNER for kind in kinds] == [True, False, False, False, True]
    image = editor.screenshot()
    ink, hole = (pixel_at(editor, image, place) for place in ((7, 25), (15, 30)))
    assert ink.lightnessF() < 0.3
    assert hole.lightnessF() > 0.9
    assert pixel_at(editor, image, (27, 26)).lightnessF() < 0.3


def covers(image, curve):
    """Whether all points of a curve lie on a picture."""
    return all(
        image.x <= point.x <= image.x + image.width and image.y <= point.y <= image.y + image.height
        for point in curve.points
    )


def pixel_at(editor, image, place):
    viewport = editor.window.canvas.viewport()
    pixel = viewport.mapTo(editor.window, editor.window.canvas.to_pixel(*place))
    return QColor(image.pixel(pixel))


def check_file(editor, path):
    editor.window.commands[ExportCommands].export(path)
    editor.wait_for_work()
    assert path.read_text(encoding="utf-8").count("<path") == 1
