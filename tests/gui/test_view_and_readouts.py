"""The fitted view, the first messages over the canvas, readouts and lit tools."""

from __future__ import annotations

import math

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton

from app.document.model import Document, make_curve
from app.families import HERMITE
from app.features.reference_image.commands import ImageCommands
from app.session import Session
from app.settings.preferences import Preferences
from app.testing import wait_for_rest
from app.tools.pointer import Part
from app.window import MainWindow
from tests.gui.editor_facts import picture


@pytest.fixture
def red(tmp_path):
    return picture(tmp_path / "red.png")


# Fitting


def in_sight(editor, low, high):
    """Whether a box is in sight, and fills at least half of the canvas one way."""
    x_min, y_min, x_max, y_max = editor.window.canvas.pixel_map.box
    fills = max((high[0] - low[0]) / (x_max - x_min), (high[1] - low[1]) / (y_max - y_min))
    return x_min < low[0] < high[0] < x_max and y_min < low[1] < high[1] < y_max and fills > 0.5


def test_fit_shows_the_picture_while_there_are_no_points(editor, red):
    editor.new()
    editor.window.commands[ImageCommands].trace(red)
    image = editor.session.document.image
    corners = (image.x, image.y), (image.x + image.width, image.y + image.height)
    editor.window.canvas.camera.show_box((1000, 1010), (1000, 1010))
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_F)
    editor.settle()
    assert in_sight(editor, *corners)
    # With points there is something that matters more.
    editor.add_point(image.x, image.y)
    editor.add_point(image.x + image.width / 10, image.y)
    editor.fit()
    assert not in_sight(editor, *corners)
    assert "the reference image where there are no points" in editor.action("fitView").toolTip()


@pytest.fixture
def file(tmp_path):
    session = Session()
    session.commit(Document((make_curve(((10.0, 0.0), (11.0, 2.0), (13.0, 2.0))),)), "Begin")
    path = tmp_path / "three.curve.json"
    session.save(path)
    return path


def test_a_file_opens_with_the_margins_of_fit(editor, file):
    editor.session.new()
    assert editor.message
    editor.window.open_file(file)
    editor.settle()
    opened = editor.window.canvas.pixel_map.box
    editor.fit()
    assert editor.window.canvas.pixel_map.box == pytest.approx(opened)


def test_a_file_given_at_the_start_opens_with_the_margins_of_fit(qtbot, file, tmp_path):
    session = Session()
    session.open(file)
    window = MainWindow(session, Preferences(tmp_path / "settings.ini"))
    qtbot.addWidget(window)
    window.resize(1100, 750)
    with qtbot.waitExposed(window):
        window.show()
    wait_for_rest(window)
    QApplication.processEvents()
    opened = window.canvas.pixel_map.box
    window.canvas.framing.fit()
    assert window.canvas.pixel_map.box == pytest.approx(opened)
    assert window.canvas.framing.shows_all_points


# Words over the canvas


def test_the_first_message_fits_the_tool(editor):
    editor.session.new()
    editor.trigger("selectTool")
    assert editor.message.startswith("Press P, then click")
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_P)
    assert editor.message.startswith("Click on the canvas")
    editor.trigger("selectTool")
    assert editor.message.startswith("Press P")
    QTest.mouseClick(
        editor.window.message_bar.findChild(QToolButton, "closeMessage"), Qt.MouseButton.LeftButton
    )
    editor.trigger("addTool")
    assert editor.message == ""


def test_a_missing_picture_is_reported_before_the_greeting(editor, red, tmp_path):
    editor.new()
    editor.window.commands[ImageCommands].trace(red)
    path = tmp_path / "a.curve.json"
    editor.session.save(path)
    red.unlink()
    editor.window.open_file(path)
    assert editor.message.startswith("The reference image is not shown.")
    offer = editor.window.message_bar.findChild(QToolButton, "offeredAction")
    assert offer.isVisible()
    assert offer.isEnabled()


# What is lit, and what is there


def test_no_point_tool_is_highlighted_while_the_picture_is_moved(arch, red):
    arch.window.commands[ImageCommands].trace(red)
    arch.trigger("addTool")
    arch.trigger("moveImage")
    for name in ("selectTool", "addTool", "measureTool", "explainWiggle"):
        assert not arch.action(name).isChecked()
    arch.trigger("moveImage")
    assert arch.action("addTool").isChecked()
    assert not arch.action("selectTool").isChecked()


@pytest.mark.parametrize("name", ["selectTool", "addTool", "measureTool"])
def test_selecting_a_tool_ends_moving_the_picture(arch, red, name):
    arch.window.commands[ImageCommands].trace(red)
    arch.trigger("moveImage")
    arch.trigger(name)
    assert not arch.action("moveImage").isChecked()
    assert Part.IMAGE not in arch.window.canvas.tools.tool.hits
    assert [n for n in ("selectTool", "addTool", "measureTool") if arch.action(n).isChecked()] == [name]
    arch.trigger(name)
    assert arch.action(name).isChecked()


def test_escape_ends_moving_the_picture_and_highlights_the_tool(arch, red):
    arch.window.commands[ImageCommands].trace(red)
    arch.trigger("addTool")
    arch.trigger("moveImage")
    arch.escape()
    assert not arch.action("moveImage").isChecked()
    assert arch.action("addTool").isChecked()


def test_the_panel_of_the_picture_is_not_restored_with_the_layout(qtbot, red, tmp_path):
    preferences = tmp_path / "settings.ini"
    first = MainWindow(Session(), Preferences(preferences))
    qtbot.addWidget(first)
    with qtbot.waitExposed(first):
        first.show()
    first.commands[ImageCommands].trace(red)
    assert first.context.docks["imageDock"].isVisible()
    first.session.files.give_up_changes()
    first.close()
    second = MainWindow(Session(), Preferences(preferences))
    qtbot.addWidget(second)
    with qtbot.waitExposed(second):
        second.show()
    assert second.context.docks["imageDock"].isHidden()


def test_folding_the_side_panel_does_not_restore_the_dock_of_a_removed_image(arch, red):
    arch.window.commands[ImageCommands].trace(red)
    arch.trigger("toggleSidePanel")
    arch.trigger("undo")
    arch.trigger("toggleSidePanel")
    assert arch.window.context.docks["imageDock"].isHidden()


def test_a_locked_curve_has_no_scale_box(arch):
    arch.select([0, 1, 2])
    assert arch.window.canvas.marks.box is not None
    arch.trigger("curveLocked")
    assert arch.session.active_curve.locked
    assert arch.window.canvas.marks.box is None
    arch.trigger("curveLocked")
    assert arch.window.canvas.marks.box is not None


def test_derivatives_can_be_pasted_only_when_some_were_copied(arch):
    QGuiApplication.clipboard().setText("1 2")
    arch.choose_family(HERMITE)
    arch.select([1])
    assert not arch.action("pasteDerivatives").isEnabled()
    arch.trigger("copyDerivatives")
    assert arch.action("pasteDerivatives").isEnabled()
    arch.select([])
    assert not arch.action("pasteDerivatives").isEnabled()
    arch.select([2])
    assert arch.action("pasteDerivatives").isEnabled()
    arch.paste_text("something else")
    assert not arch.action("pasteDerivatives").isEnabled()


# Readouts


def readout(editor):
    """Where the readout stands, in pixels of the canvas."""
    editor.screenshot()
    return editor.window.canvas.drawing.marks.readout_rect


def test_a_readout_does_not_cover_the_grip_and_the_points(arch):
    for grip in ((1, 1), (-1, -1), (1, 0), (0, -1), (0, 0)):
        arch.select([0, 1, 2, 3])
        start = arch.grip(*grip)
        to = (start[0] + (0.4 if grip == (0, 0) else 0.2 * grip[0]), start[1] + 0.2 * grip[1])
        arch.press(start)
        arch.move(to)
        plate, canvas = readout(arch), arch.window.canvas
        assert arch.window.canvas.marks.note is not None, grip
        assert plate.width() > 30, grip
        hand = canvas.pixel_map.point(*to)
        for place in (hand, *(canvas.pixel_map.point(*arch.point(index)) for index in range(4))):
            assert not plate.adjusted(-8, -8, 8, 8).contains(*place), grip
        arch.escape()
        arch.release(to)


def test_a_measured_distance_does_not_cover_its_ends(arch):
    arch.trigger("measureTool")
    for to in ((1.1, 2.0), (3.0, 2.1), (1.0, 0.2), (0.2, 4.9), (6.9, -2.9)):
        arch.press((1.0, 2.0))
        arch.move(to)
        plate, canvas = readout(arch), arch.window.canvas
        for place in ((1.0, 2.0), to):
            assert not plate.adjusted(-8, -8, 8, 8).contains(*canvas.pixel_map.point(*place)), to
        assert math.isfinite(plate.x()), to
        arch.release(to)
