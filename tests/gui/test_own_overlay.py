"""An overlay is one record in one file, and so is a plot: records that only these tests have."""

from __future__ import annotations

import threading

import numpy as np
import pytest
from pixels import is_colour
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QCheckBox, QLabel, QMenu, QSlider, QToolButton, QWidget

from app.features.plots.pane import PlotPane
from app.view_model.analysis.overlay import OVERLAYS, Figure, Figures, Group, Overlay, Shape
from app.view_model.analysis.plot import PLOTS, Plot
from app.view_model.line_styles import LineStyle, Sign
from app.view_model.settings import Count, Factor, SwitchSetting
from tests.gui.editor_facts import until_settled
from tests.waiting import LIMIT

RED, LIME = QColor("#ff0000"), QColor("#00ff00")
PLATE = LineStyle(RED.name(), sign=Sign.AREA)
DOTS = LineStyle(LIME.name(), width=3.0, sign=Sign.MARK)

SIZE = Factor("plateSize", "Size of the plate")
CORNERS = Count("plateCorners", "Number of corners", 4, limits=(3, 9))

HALF = SwitchSetting("plateHalf", "Half as large", False, tip="Draw the plate half as large")

MAY_END = threading.Event()
"""What is heavy takes until then."""


def _plate(shown):
    """A polygon around the point at the scrub line, half as large as the curve."""
    here = shown.at_scrub(0)
    if here is None:
        return Figures(note="Put the scrub line somewhere.")
    turn = np.linspace(0.0, 2 * np.pi, shown.value(CORNERS), endpoint=False)
    size = 0.125 if shown.value(HALF) else 0.25
    corners = here + size * shown.size * shown.value(SIZE) * np.column_stack([np.cos(turn), np.sin(turn)])
    plate = Figure(PLATE, Shape.AREA, np.vstack([corners, [[np.nan, np.nan]]]))
    return Figures([plate], f"{len(corners)} corners.")


def _dots(shown):
    """A mark in the middle between two points each."""
    assert MAY_END.wait(LIMIT)
    points = shown.view.points
    return Figures([Figure(DOTS, Shape.MARKS, (points[1:] + points[:-1]) / 2)], f"{len(points) - 1} dots.")


PLATES = Overlay(
    name="plate",
    text="Plate",
    full_name="Plate at the Scrub Line",
    tip="Draw a plate at the scrub line",
    group=Group.POLYGONS,
    rank=75,
    layer=1,
    draw=_plate,
    settings=(SIZE, CORNERS, HALF),
    follows_scrub=True,
    brings_scrub=True,
    legend=lambda _view, settings: [(PLATE, f"Plate with {settings.value(CORNERS)} corners")],
)
MIDDLES = Overlay(
    name="middles",
    text="Middles",
    tip="Mark the middles between points",
    group=Group.SHAPE,
    rank=1,
    layer=99,
    draw=_dots,
    settles=lambda _view: True,
    finds=((DOTS, "Middle"),),
)
DISTANCE = Plot(
    name="distance",
    text="Distance",
    tip="Plot how far the curve is from the origin",
    title="Distance |c|",
    symbol="|c|",
    rank=25,
    orders=(0,),
    values=lambda sampled: np.hypot(*sampled.derivatives[0].T),
)


@pytest.fixture(scope="module", autouse=True)
def _own_records(shared_editor):
    """Have windows that offer these; the one that is kept has fewer."""
    with (
        OVERLAYS.with_record(PLATES),
        OVERLAYS.with_record(MIDDLES),
        PLOTS.with_record(DISTANCE),
        shared_editor.another("overlays and a plot of these tests"),
    ):
        yield
    assert PLATES not in OVERLAYS
    assert DISTANCE not in PLOTS


def child(editor, kind, name):
    widget = editor.window.findChild(kind, name)
    assert widget is not None, name
    return widget


def entries(editor, submenu):
    (menu,) = (each for each in editor.window.findChildren(QMenu) if each.title().replace("&", "") == submenu)
    return [action.objectName() for action in menu.actions() if not action.isSeparator()]


def legend(editor):
    shown = editor.window.canvas.drawing.annotations.legend
    return [row.text for row in shown.rows] if shown is not None and shown.isVisible() else []


def share_of_colour(editor, colour):
    """How much of the drawing has a colour, the legend left out."""
    editor.settle()
    canvas = editor.window.canvas
    shown = canvas.drawing.annotations.legend
    is_there = is_colour(canvas.grab().toImage(), colour)
    if shown is not None and shown.isVisible():
        corner = canvas.viewport().mapTo(canvas, shown.geometry().topLeft())
        is_there[corner.y() : corner.y() + shown.height(), corner.x() : corner.x() + shown.width()] = False
    return int(is_there.sum())


def test_own_records_are_in_menus_and_the_palette(editor):
    overlays = entries(editor, "Overlays")
    own = ["overlayMiddles", "overlayBezier", "overlayPlate", "overlayPolygon"]
    assert [each for each in overlays if each in own] == own
    assert overlays[0] == own[0]
    between = ["plotAcceleration", "plotDistance", "plotJerk"]
    assert [each for each in entries(editor, "Plots") if each in between] == between
    assert editor.find_command("plate at the scrub")[0] == "Plate at the Scrub Line"
    assert editor.action("overlayPlate").toolTip().startswith("Draw a plate at the scrub line")


def test_an_overlay_is_drawn_and_explained_and_follows_drags_and_the_scrub_line(editor):
    assert not share_of_colour(editor, RED)
    editor.trigger("overlayPlate")
    assert editor.session.scrub.t == pytest.approx(0.5)
    assert share_of_colour(editor, RED) > 100
    assert legend(editor) == ["Plate with 4 corners"]
    (before,) = editor.window.canvas.drawing.annotations.figure_layer.figures
    editor.scrub(0.8)
    (after,) = editor.window.canvas.drawing.annotations.figure_layer.figures
    here = editor.session.active_view.curve.evaluate(editor.session.scrub.t)
    assert after.points[:4].mean(axis=0) == pytest.approx(here)
    assert not np.array_equal(after.points, before.points, equal_nan=True)
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 0.3, y + 0.3))
    (moved,) = editor.window.canvas.drawing.annotations.figure_layer.figures
    assert not np.array_equal(moved.points, after.points, equal_nan=True)
    editor.escape()
    editor.trigger("overlayPlate")
    assert not share_of_colour(editor, RED)
    assert legend(editor) == []


def test_the_dock_has_the_switch_the_settings_and_the_note_of_an_overlay(editor, qtbot):
    editor.show_dock("analysisDock")
    qtbot.keyClick(child(editor, QCheckBox, "overlayPlateSwitch"), Qt.Key.Key_Space)
    assert editor.action("overlayPlate").isChecked()
    note = child(editor, QLabel, "overlayPlateNote")
    until_settled(editor, lambda: note.text() == "4 corners.")
    small = share_of_colour(editor, RED)
    size, corners = child(editor, QSlider, "plateSize"), child(editor, QSlider, "plateCorners")
    assert not size.parentWidget().geometry().intersects(corners.parentWidget().geometry())
    for _ in range(4):
        qtbot.keyClick(size, Qt.Key.Key_Right)
    assert child(editor, QLabel, "plateSizeValue").text() == "× 1.6"
    large = share_of_colour(editor, RED)
    assert large > 1.5 * small
    half = child(editor, QCheckBox, "plateHalf")
    assert (half.isEnabled(), half.isChecked(), half.text()) == (True, False, "Half as large")
    qtbot.keyClick(half, Qt.Key.Key_Space)
    assert half.isChecked()
    assert share_of_colour(editor, RED) < large / 2
    qtbot.keyClick(half, Qt.Key.Key_Space)
    assert (share_of_colour(editor, RED), half.isChecked()) == (large, False)
    qtbot.keyClick(corners, Qt.Key.Key_Right)
    until_settled(editor, lambda: note.text() == "5 corners.")
    assert legend(editor) == ["Plate with 5 corners"]
    editor.trigger("toggleScrub")
    until_settled(editor, lambda: note.text() == "Put the scrub line somewhere.")
    editor.trigger("overlayPlate")
    assert not half.isEnabled()


def test_a_heavy_overlay_settles_and_the_legend_explains_its_findings(editor):
    editor.show_dock("analysisDock")
    MAY_END.clear()
    editor.trigger("overlayMiddles")
    assert legend(editor) == ["Middles …"]
    MAY_END.set()
    until_settled(editor, lambda: legend(editor) == ["Middle"])
    assert share_of_colour(editor, LIME) > 10
    MAY_END.clear()
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 0.3, y + 0.3))
    # What belongs to another curve is not shown.
    assert legend(editor) == ["Middles …"]
    assert not share_of_colour(editor, LIME)
    MAY_END.set()
    editor.escape()
    note = child(editor, QLabel, "overlayMiddlesNote")
    count = len(editor.session.active_view.points) - 1
    until_settled(editor, lambda: note.text() == f"{count} dots.")


def test_a_plot_is_switched_on_drawn_and_read_at_the_scrub_line(editor, qtbot):
    editor.trigger("plotSpeed")
    qtbot.mouseClick(child(editor, QToolButton, "plotDistanceChoice"), Qt.MouseButton.LeftButton)
    assert editor.action("plotDistance").isChecked()
    pane = child(editor, PlotPane, "plotPane")
    assert [plot.title for plot in pane.canvas.plots] == ["Speed |c′|", "Distance |c|"]
    (line,) = pane.canvas.plots[1].lines
    curve = editor.session.active_view.curve
    assert line.values == pytest.approx(np.linalg.norm(curve.evaluate(line.t), axis=1))
    editor.scrub(0.5)
    distance = np.linalg.norm(curve.evaluate(editor.session.scrub.t))
    assert f"|c| {distance:.4g}" in pane.findChild(QWidget, "plotValues").text()
    before = line.values
    editor.drag_point(3, (3.0, 3.0))
    assert not np.array_equal(pane.canvas.plots[1].lines[0].values, before)
