"""Overlays in the window, switched with real events."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QLabel, QLineEdit, QSlider, QToolButton

from app.appearance.theme import ThemeMode
from app.document.model import ParametrizationKind
from app.document.point_edits import set_position
from app.families import HERMITE
from app.features.overlays.commands import OverlayCommands
from app.tasks.task import SETTLE_MS
from app.view_model.analysis.overlay import OVERLAYS, POINT_ERROR
from app.view_model.analysis.overlays import (
    band,
    bezier,
    circle,
    comb,
    ensemble,
    extrema,
    polygon,
    ticks,
    vectors,
)
from tests.gui.editor_facts import retype, until_settled
from tests.waiting import until

NEVER_MS = 600_000


def figures(editor, style):
    return [
        figure
        for figure in editor.window.canvas.drawing.annotations.figure_layer.figures
        if figure.style is style
    ]


def first(editor, style):
    return figures(editor, style)[0].points


def longest(editor, style=comb.TEETH):
    ends = np.vstack([figure.points for figure in figures(editor, style)]).reshape(-1, 2, 2)
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max()


def legend(editor):
    shown = editor.window.canvas.drawing.annotations.legend
    return [row.text for row in shown.rows] if shown is not None and shown.isVisible() else []


def panel(editor, kind, name):
    found = editor.window.findChild(kind, name)
    assert found is not None, name
    return found


def note(editor, name):
    """The words below a switch, once they have settled."""
    label = panel(editor, QLabel, f"{name}Note")
    until_settled(editor, lambda: label.text() not in ("", "…"))
    return label.text()


@pytest.fixture
def dock(editor):
    """The editor with the Analysis dock in front."""
    editor.show_dock("analysisDock")
    return editor


def type_into(line, text):
    retype(line, text)


LIVE = {
    "overlayComb": comb.TEETH,
    "overlayVelocities": vectors.VELOCITY,
    "overlayAccelerations": vectors.ACCELERATION,
    "overlayCircle": circle.LINE,
    "overlayTicks": ticks.TICK,
    "overlayPolygon": polygon.SIDES,
    "overlayBezier": bezier.SIDES,
    "overlayBand": band.AREA,
}


def test_an_overlay_follows_a_drag(editor):
    editor.choose_family(HERMITE)
    x, y = editor.point(3)
    for name, figure in LIVE.items():
        editor.trigger(name)
        before = first(editor, figure)
        editor.press((x, y))
        editor.move((x + 0.3, y + 0.3))
        assert not np.array_equal(first(editor, figure), before, equal_nan=True), name
        editor.escape()
        editor.release((x + 0.3, y + 0.3))
        assert np.array_equal(first(editor, figure), before, equal_nan=True), name
        editor.trigger(name)
        assert not editor.window.canvas.drawing.annotations.figure_layer.figures, name
        assert not legend(editor), name


def test_an_overlay_switched_on_during_a_drag_follows_the_drag(editor):
    editor.choose_family(HERMITE)
    x, y = editor.point(3)
    editor.press((x, y))
    for step in range(1, 4):
        # While nothing is shown, nobody but the basis functions and the table is asked.
        editor.move((x + 0.05 * step, y))
    editor.window.context.analysis.show(comb.COMB, visible=True)
    seen = []
    for step in range(1, 4):
        editor.move((x + 0.3 * step, y + 0.3))
        seen.append(first(editor, comb.TEETH).tobytes())
    assert len(set(seen)) == 3
    editor.escape()


HEAVY = {
    "overlayMarks": extrema.INFLECTION,
    "overlayEnsemble": ensemble.LINES,
    "overlayBezier": bezier.SIDES,
}


@pytest.mark.parametrize("name", list(HEAVY))
def test_a_heavy_overlay_settles_after_a_drag(dock, name):
    editor = dock
    editor.trigger(name)
    until_settled(editor, lambda: figures(editor, HEAVY[name]))
    before = first(editor, HEAVY[name])
    # However slow the machine is, the hand does not rest before it is let go.
    settling = editor.window.commands[OverlayCommands]._task._timer
    settling.setInterval(NEVER_MS)
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 0.3, y + 0.3))
    # What belongs to another curve is not shown, and the dock says that something is coming.
    assert not figures(editor, HEAVY[name])
    label = panel(editor, QLabel, f"{name}Note")
    until(lambda: label.text() == "…")
    editor.escape()
    settling.setInterval(SETTLE_MS)
    until_settled(editor, lambda: figures(editor, HEAVY[name]))
    assert np.array_equal(first(editor, HEAVY[name]), before, equal_nan=True)


def test_the_window_can_be_closed_during_a_computation(editor):
    editor.trigger("overlayMarks")
    editor.trigger("overlayEnsemble")


def test_switches_of_the_dock_and_actions_agree(dock, qtbot):
    editor = dock
    for name, overlay in ((each.action_name, each) for each in OVERLAYS):
        switch = panel(editor, QCheckBox, f"{name}Switch")
        qtbot.keyClick(switch, Qt.Key.Key_Space)
        assert editor.action(name).isChecked()
        editor.trigger(name)
        assert not switch.isChecked()
        assert overlay not in editor.window.analysis.settings.overlays


@pytest.mark.parametrize(
    ("name", "slider", "style"),
    [
        ("overlayComb", "combScale", comb.TEETH),
        ("overlayVelocities", "velocityScale", vectors.VELOCITY),
        ("overlayAccelerations", "accelerationScale", vectors.ACCELERATION),
    ],
)
def test_a_scale_is_set_by_key_and_displayed(dock, qtbot, name, slider, style):
    editor = dock
    editor.trigger(name)
    before = longest(editor, style)
    line = panel(editor, QSlider, slider)
    for _ in range(6):
        qtbot.keyClick(line, Qt.Key.Key_Right)
    assert longest(editor, style) == pytest.approx(before * 10**0.3)
    assert panel(editor, QLabel, f"{slider}Value").text() == "× 2"


def test_escape_reverts_a_drag_of_a_slider(dock, qtbot):
    editor = dock
    editor.trigger("overlayComb")
    before = longest(editor)
    slider = panel(editor, QSlider, "combScale")
    middle = QPoint(slider.width() // 2, slider.height() // 2)
    qtbot.mousePress(slider, Qt.MouseButton.LeftButton, pos=middle)
    qtbot.mouseMove(slider, middle + QPoint(30, 0))
    assert longest(editor) > before
    qtbot.keyClick(slider, Qt.Key.Key_Escape)
    assert longest(editor) == pytest.approx(before)
    qtbot.mouseMove(slider, middle + QPoint(40, 0))
    qtbot.mouseRelease(slider, Qt.MouseButton.LeftButton, pos=middle + QPoint(40, 0))
    assert longest(editor) == pytest.approx(before)
    assert slider.value() == 0


@pytest.mark.parametrize("away", [0.0, 1e6])
def test_the_comb_of_straight_lines_has_no_teeth(editor, away):
    """Rounding was drawn at full size: zigzags of 60 pixels."""
    editor.choose_family("hermite")
    editor.new()
    editor.window.canvas.camera.show_box((away - 1, away + 2), (-2, 1))
    editor.settle()
    editor.trigger("addTool")
    editor.click((away + 0.1, 0.37))
    for x, y in ((0.53, 0.36), (1.31, -1.7)):
        editor.click((away + x, y), keys=Qt.KeyboardModifier.AltModifier)
    editor.key(Qt.Key.Key_1, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier)
    assert longest(editor) == 0.0
    editor.trigger("selectTool")
    editor.bend(0.5, (away + 0.9, -0.3))
    assert longest(editor) > 0.1


def test_the_number_of_ticks(dock, qtbot):
    editor = dock
    editor.trigger("overlayTicks")
    qtbot.keyClick(panel(editor, QSlider, "tickCount"), Qt.Key.Key_Left)
    # A tick at both ends: 19 steps, 20 ticks.
    assert len(first(editor, ticks.TICK)) == 2 * 20


def test_the_circle_displays_the_scrub_line_and_follows_its_position(dock):
    editor = dock
    editor.trigger("overlayCircle")
    assert editor.session.scrub.t == pytest.approx(0.5)
    before = first(editor, circle.LINE)
    editor.scrub(0.8)
    assert not np.array_equal(first(editor, circle.LINE), before)
    radius = float(np.linalg.norm(np.diff(first(editor, circle.CENTRE), axis=0)))
    until_settled(editor, lambda: note(editor, "overlayCircle").startswith(f"Radius {radius:.3g}"))
    editor.trigger("toggleScrub")
    until_settled(editor, lambda: "scrub line" in note(editor, "overlayCircle"))
    assert not figures(editor, circle.LINE)


def test_an_arrow_at_the_scrub_line_has_its_length_as_a_label(editor):
    editor.trigger("overlayVelocities")
    editor.scrub(0.5)
    arrow = figures(editor, vectors.VELOCITY)[1]
    assert arrow.label.startswith("|c′| ")
    velocity = editor.session.active_view.curve.evaluate(editor.session.scrub.t, 1)
    assert float(arrow.label.split()[1]) == pytest.approx(np.hypot(*velocity), rel=0.01)


def test_errors_are_typed_as_expressions(dock, qtbot):
    editor = dock
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    editor.trigger("overlayBand")
    before = first(editor, band.AREA)
    line = panel(editor, QLineEdit, "pointError")
    type_into(line, "1/8")
    assert editor.window.analysis.settings.value(POINT_ERROR) == 0.125
    assert not np.array_equal(first(editor, band.AREA), before, equal_nan=True)
    # Eight uniform parameters: the Lebesgue constant is 6.9297.
    until_settled(editor, lambda: "half-width 0.866" in note(editor, "overlayBand"))
    assert "times ε" in note(editor, "overlayBand")
    assert legend(editor) == ["Worst case, ε = 0.125"]
    type_into(panel(editor, QLineEdit, "parameterError"), "1e-3")
    assert legend(editor) == ["Worst case to first order, ε = 0.125, δ = 0.001"]
    for text in ("-1", "abc"):
        type_into(line, text)
        assert panel(editor, QLabel, "analysisProblem").text().startswith("⚠")
        assert editor.window.analysis.settings.value(POINT_ERROR) == 0.125
    qtbot.keyClick(line, Qt.Key.Key_Escape)
    assert line.text() == "0.125"
    assert not panel(editor, QLabel, "analysisProblem").text()


def test_the_first_error_is_a_hundredth_of_the_size_and_stays(editor):
    editor.trigger("overlayBand")
    error = editor.window.analysis.settings.value(POINT_ERROR)
    size = np.ptp(editor.session.active_view.points, axis=0).max()
    assert error == pytest.approx(size / 100, rel=0.5)
    editor.drag_point(0, (4.0, 4.0))
    assert editor.window.analysis.settings.value(POINT_ERROR) == error


def test_another_seed_draws_other_curves(dock, qtbot):
    editor = dock
    editor.trigger("overlayEnsemble")
    until_settled(editor, lambda: figures(editor, ensemble.LINES))
    before = first(editor, ensemble.LINES)
    qtbot.mouseClick(panel(editor, QToolButton, "newSeedButton"), Qt.MouseButton.LeftButton)
    assert not figures(editor, ensemble.LINES)
    until_settled(editor, lambda: figures(editor, ensemble.LINES))
    assert not np.array_equal(first(editor, ensemble.LINES), before, equal_nan=True)
    qtbot.keyClick(panel(editor, QSlider, "ensembleCount"), Qt.Key.Key_Left)
    until_settled(editor, lambda: note(editor, "overlayEnsemble") == "29 curves, seed 1.")


def test_without_a_curve_no_overlay_is_drawn_and_the_dock_gives_the_reason(dock):
    editor = dock
    editor.trigger("overlayComb")
    editor.trigger("ghostUniform")
    # Point 1 onto point 0: chord length has no parameters for these.
    moved = set_position(editor.session.document, 0, 1, editor.point(0))
    editor.session.commit(moved, "Move")
    assert not editor.window.canvas.drawing.annotations.figure_layer.figures
    assert not editor.window.canvas.drawing.annotations.figure_layer.ghosts
    problem = panel(editor, QLabel, "analysisProblem")
    until_settled(editor, lambda: "distinct" in problem.text() or "coincide" in problem.text())
    editor.trigger("undo")
    assert figures(editor, comb.TEETH)
    until_settled(editor, lambda: not problem.text())


def test_the_band_is_one_even_shade(editor):
    """Where a band of half-width 0.87 folds over itself there are neither seams nor holes."""
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    editor.trigger("overlayBand")
    editor.window.analysis.set_value(POINT_ERROR, 0.125)
    editor.trigger("toggleGrid")
    canvas = editor.window.canvas
    image = canvas.grab().toImage()
    curve = editor.session.active_view.curve
    (dx, dy) = curve.evaluate(0.05, 1) / np.linalg.norm(curve.evaluate(0.05, 1))
    shades = set()
    for share in np.linspace(-0.9, 0.9, 60):
        x, y = curve.evaluate(0.05) + share * 0.3 * np.array([-dy, dx])
        pixel = canvas.viewport().mapTo(canvas, canvas.to_pixel(float(x), float(y)))
        shades.add(image.pixelColor(pixel).name())
    paper = image.pixelColor(canvas.viewport().mapTo(canvas, canvas.to_pixel(4.6, 0.3)))
    # The band alone, and what the curve and its points paint over it; never bare paper.
    assert paper.name() not in shades
    assert len(shades) < 12


def test_legend_and_dock_change_with_the_theme(dock):
    editor = dock
    editor.trigger("overlayBand")
    for mode in (ThemeMode.DARK, ThemeMode.LIGHT):
        editor.window.store.change(theme_mode=mode)
        editor.settle()
        shown = editor.window.canvas.drawing.annotations.legend
        image = shown.grab().toImage()
        dark = image.pixelColor(image.width() - 5, image.height() // 2).lightnessF() < 0.5
        assert dark == (mode is ThemeMode.DARK)


def test_a_press_on_the_legend_reaches_the_canvas(editor):
    """What lies below a line of the legend can be dragged all the same."""
    editor.trigger("overlayVelocities")
    canvas, shown = editor.window.canvas, editor.window.canvas.drawing.annotations.legend
    place = canvas.to_plane(QPointF(shown.geometry().center()))
    # It would make way for the point, on a slow machine before the press.
    pace = shown._move_timer.interval()
    shown._move_timer.setInterval(NEVER_MS)
    editor.drag_point(7, place)
    label = shown.findChildren(QLabel)[1]
    start = label.mapFrom(shown, shown.rect().center())
    for act, at in (
        (QTest.mousePress, start),
        (QTest.mouseMove, start - QPoint(40, 40)),
        (QTest.mouseMove, start - QPoint(80, 60)),
        (QTest.mouseRelease, start - QPoint(80, 60)),
    ):
        act(label, *(() if act is QTest.mouseMove else (Qt.MouseButton.LeftButton,)), pos=at)
        QApplication.processEvents()
    shown._move_timer.setInterval(pace)
    moved = np.subtract(editor.point(7), place) / editor.pixel
    assert moved == pytest.approx((-80, 60), abs=3)
