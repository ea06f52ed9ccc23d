"""The hodograph, with real events."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDockWidget, QToolButton, QWidget

from app.document.point_edits import set_position
from app.families import HERMITE
from app.features.hodograph.panel import HodographPanel


def panel(editor):
    return editor.window.findChild(HodographPanel, "hodographPanel")


@pytest.fixture
def hodograph(editor):
    editor.trigger("plotHodograph")
    return panel(editor).plot


def test_the_hodograph_is_built_on_first_opening(new_editor):
    editor = new_editor
    dock = editor.window.findChild(QDockWidget, "hodographDock")
    assert dock.isHidden()
    assert panel(editor) is None
    editor.trigger("plotHodograph")
    assert panel(editor).isVisible()
    assert panel(editor).plot.hodograph.order == 1


def test_the_hodograph_has_equal_aspect_and_shows_the_curve_and_the_origin(editor, hodograph):
    shown = hodograph.pixel_map
    assert shown.sx == pytest.approx(shown.sy, rel=1e-6)
    x_min, y_min, x_max, y_max = shown.box
    points = np.vstack([hodograph.hodograph.points, np.zeros((1, 2))]) / hodograph.unit
    assert (points.min(axis=0) > (x_min, y_min)).all()
    assert (points.max(axis=0) < (x_max, y_max)).all()


def test_the_hodograph_follows_a_drag_and_the_view_only_grows(editor, hodograph):
    before = hodograph.hodograph.points
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 3, y + 3))
    assert not np.array_equal(hodograph.hodograph.points, before)
    grown = hodograph.pixel_map.box
    editor.move((x + 0.1, y))
    assert hodograph.pixel_map.box == pytest.approx(grown)
    editor.escape()
    assert np.array_equal(hodograph.hodograph.points, before)
    assert hodograph.pixel_map.box[2] < grown[2]


def test_the_dot_is_the_velocity_at_the_scrub_line(editor, hodograph):
    editor.scrub(0.37)
    t, value = hodograph.scrub
    assert t == editor.session.scrub.t
    assert value == pytest.approx(tuple(editor.session.active_view.curve.evaluate(t, 1)))
    assert panel(editor).findChild(QWidget, "hodographValue").text().startswith(f"c′({t:.4g}) = (")


def test_a_drag_along_the_hodograph_scrubs_and_escape_reverts(editor, hodograph):
    curve = editor.session.active_view.curve
    start, end = (hodograph.to_pixel(*(curve.evaluate(t, 1) / hodograph.unit)) for t in (0.3, 0.5))
    editor.drag_pixels(hodograph, start, end)
    reached = curve.evaluate(editor.session.scrub.t, 1)
    assert reached == pytest.approx(curve.evaluate(0.5, 1), abs=3 * hodograph.unit / hodograph.pixel_map.sx)
    before = editor.session.scrub.t
    editor.send(hodograph, QEvent.Type.MouseButtonPress, start)
    assert editor.session.scrub.t != before
    QTest.keyClick(hodograph, Qt.Key.Key_Escape)
    assert editor.session.scrub.t == before
    editor.send(hodograph, QEvent.Type.MouseMove, start)
    assert editor.session.scrub.t == before


def test_the_acceleration_can_be_drawn_instead(editor, qtbot, hodograph):
    editor.choose_family(HERMITE)
    qtbot.mouseClick(editor.window.findChild(QToolButton, "hodographAcceleration"), Qt.MouseButton.LeftButton)
    assert hodograph.hodograph.order == 2
    editor.scrub(0.5)
    assert "c″" in panel(editor).findChild(QWidget, "hodographValue").text()


def test_a_zoom_stays_until_fit_is_pressed(editor, qtbot, hodograph):
    fitted = hodograph.pixel_map.box
    hodograph.camera.zoom(4.0, hodograph.to_pixel(0, 0).toPointF())
    editor.drag_point(2, to=(1.0, 3.5))
    assert hodograph.pixel_map.box[2] - hodograph.pixel_map.box[0] < 0.5 * (fitted[2] - fitted[0])
    qtbot.mouseClick(editor.window.findChild(QToolButton, "fitHodograph"), Qt.MouseButton.LeftButton)
    assert hodograph.pixel_map.box[2] - hodograph.pixel_map.box[0] > 0.5 * (fitted[2] - fitted[0])


def test_without_a_curve_the_panel_gives_the_reason(editor, hodograph):
    editor.session.commit(set_position(editor.session.document, 0, 2, editor.point(1)), "Meet")
    editor.settle()
    assert hodograph.note == editor.session.active_view.problem
    assert hodograph.hodograph is None
    editor.trigger("undo")
    assert hodograph.hodograph is not None
