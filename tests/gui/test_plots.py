"""The plots over t, switched, scrubbed and zoomed with real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton, QWidget

from app.document.model import Parametrization, ParametrizationKind, make_curve
from app.document.point_edits import set_position
from app.families import HERMITE, LAGRANGE
from app.features.plots.commands import PlotCommands
from app.features.plots.layers import ValueScale
from app.settings.preferences import Preferences
from app.tasks.task import SETTLE_MS
from app.testing import Editor
from app.view_model.analysis.plot import PlotLine, Scale, plot_of
from app.view_model.analysis.plots import curvature, lebesgue, lengths
from app.view_model.line_styles import DASHED, LineStyle
from curvecore import lebesgue_function
from tests.gui.editor_facts import until_settled

ACTIONS = {
    "plotSpeed": lengths.SPEED,
    "plotAcceleration": lengths.ACCELERATION,
    "plotJerk": lengths.JERK,
    "plotSnap": lengths.SNAP,
    "plotCurvature": curvature.CURVATURE,
    "plotLebesgue": lebesgue.LEBESGUE,
}


def values(editor):
    """What is written of the functions at the scrub line."""
    return pane(editor).findChild(QWidget, "plotValues").text()


def pane(editor):
    return editor.window.central["plotPanel"].pane


def canvas(editor):
    return pane(editor).canvas


def line(editor, plot=lengths.SPEED):
    (found,) = (each for each in canvas(editor).plots if each.title == plot.title)
    return found.lines[0]


def wheel(editor, plot, place, notches):
    place = QPointF(place)
    event = QWheelEvent(
        place,
        plot.viewport().mapToGlobal(place),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(plot.viewport(), event)
    editor.settle()


def test_each_plot_is_switched_on_and_off(editor):
    panel = editor.window.findChild(QWidget, "plotPanel")
    for name, plot in ACTIONS.items():
        assert panel.isHidden(), name
        editor.trigger(name)
        assert panel.isVisible(), name
        assert [each.title for each in canvas(editor).plots] == [plot.title]
        assert editor.action(name).isChecked(), name
        editor.trigger(name)
    assert panel.isHidden()


def test_no_pane_is_built_before_the_first_plot(new_editor):
    new_editor.drag_point(1, to=(2, 3))
    assert new_editor.window.central["plotPanel"].pane is None


def test_the_buttons_of_the_header_switch_plots(editor, qtbot):
    editor.trigger("plotSpeed")
    qtbot.mouseClick(editor.window.findChild(QToolButton, "plotCurvatureChoice"), Qt.MouseButton.LeftButton)
    assert editor.action("plotCurvature").isChecked()
    assert [each.title for each in canvas(editor).plots] == [lengths.SPEED.title, curvature.CURVATURE.title]
    button = editor.window.findChild(QToolButton, "plotSpeedChoice")
    qtbot.keyClick(button, Qt.Key.Key_Space)
    assert not button.isChecked()
    assert [each.title for each in canvas(editor).plots] == [curvature.CURVATURE.title]
    qtbot.mouseClick(editor.window.findChild(QToolButton, "closePlots"), Qt.MouseButton.LeftButton)
    assert editor.window.central["plotPanel"].isHidden()
    assert not editor.action("plotCurvature").isChecked()


def test_a_plot_follows_a_drag_and_escape_restores_the_plot(editor):
    editor.trigger("plotSpeed")
    before = line(editor).values
    x, y = editor.point(1)
    editor.press((x, y))
    editor.move((x + 0.3, y + 0.3))
    moved = line(editor).values
    assert len(moved) != len(before) or not np.allclose(moved, before)
    editor.escape()
    assert np.array_equal(line(editor).values, before)


def test_the_scale_only_grows_during_a_drag_and_fits_afterwards(editor):
    editor.trigger("plotSpeed")
    title = lengths.SPEED.title
    rest = canvas(editor).scale_of(title).high
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 5, y + 5))
    grown = canvas(editor).scale_of(title).high
    assert grown > 1.3 * rest
    editor.move((x + 0.1, y))
    assert canvas(editor).scale_of(title).high == grown
    editor.release((x + 0.1, y))
    assert canvas(editor).scale_of(title).high < 1.3 * rest


def test_the_lebesgue_scale_fits_again_after_a_drag_of_a_tick(editor):
    editor.trigger("plotLebesgue")
    panel, title = editor.window.basis_panel, lebesgue.LEBESGUE.title
    rest = canvas(editor).scale_of(title).high
    t = editor.parameters
    start, wild = panel.rail_pixel(t[3]), panel.rail_pixel(t[2] + 0.004)
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    editor.send(panel, QEvent.Type.MouseMove, wild)
    grown = canvas(editor).scale_of(title).high
    assert grown > 3 * rest
    editor.send(panel, QEvent.Type.MouseMove, start + QPointF(6, 0))
    assert canvas(editor).scale_of(title).high == grown
    editor.send(panel, QEvent.Type.MouseButtonRelease, start + QPointF(6, 0), held=False)
    assert canvas(editor).scale_of(title).high < 2 * rest


def test_the_lebesgue_constant_of_the_plot_is_that_of_the_status_line(editor):
    editor.trigger("plotLebesgue")
    editor.drag_parameter(3, to=editor.parameters[2] + 0.02)
    (plot,) = canvas(editor).plots
    assert plot.levels[0].value == editor.window.basis_panel.drawing.basis.lebesgue_constant
    known = plot.lines[0]
    assert known.values == pytest.approx(lebesgue_function(editor.session.active_view.curve, known.t))


def test_zooming_or_panning_either_panel_keeps_both_at_the_same_part_of_t(editor):
    editor.trigger("plotSpeed")
    basis, plots = editor.window.basis_panel, canvas(editor)
    assert plots.camera.t_range == pytest.approx(basis.camera.t_range)
    wheel(editor, plots, plots.to_pixel(0.3, 0.5), 3)
    zoomed = basis.camera.t_range
    assert zoomed[1] - zoomed[0] < 0.7
    assert plots.camera.t_range == pytest.approx(zoomed)
    wheel(editor, basis, basis.to_pixel(0.3, 0.5), -2)
    assert plots.camera.t_range == pytest.approx(basis.camera.t_range)
    assert plots.camera.t_range != pytest.approx(zoomed)
    before = basis.camera.t_range
    start = plots.to_pixel(0.3, 0.5)
    editor.drag_pixels(plots, start, start + QPoint(40, 0), button=Qt.MouseButton.MiddleButton)
    assert basis.camera.t_range[0] < before[0]
    assert plots.camera.t_range == pytest.approx(basis.camera.t_range)


def test_the_t_axes_of_both_panels_are_aligned(editor):
    editor.trigger("plotLebesgue")
    basis, plots = editor.window.basis_panel, canvas(editor)
    for t in (0.0, 0.37, 1.0):
        left = basis.viewport().mapToGlobal(basis.to_pixel(t, 0.0)).x()
        assert plots.viewport().mapToGlobal(plots.to_pixel(t, 0.0)).x() == pytest.approx(left, abs=1)


def test_a_zoom_samples_the_visible_part_more_densely(editor):
    editor.trigger("plotSpeed")
    plots = canvas(editor)
    wheel(editor, plots, plots.to_pixel(0.3, 0.5), 12)
    start, end = plots.camera.t_range
    assert line(editor).t[0] >= start - 1e-12
    assert line(editor).t[-1] <= end + 1e-12
    assert len(line(editor).t) > 100


def test_the_scrub_line_is_dragged_in_either_panel(editor):
    editor.trigger("plotSpeed")
    editor.trigger("plotLebesgue")
    plots = canvas(editor)
    editor.drag_pixels(plots, plots.to_pixel(0.1, 0.5), plots.to_pixel(0.4, 0.5))
    t = editor.session.scrub.t
    assert t == pytest.approx(0.4, abs=3e-3)
    speed = np.linalg.norm(editor.session.active_view.curve.evaluate(t, 1))
    assert f"|c′| {speed:.4g}" in values(editor)
    editor.scrub(0.7)
    assert values(editor).startswith("t 0.7") or pane(editor).findChild(
        QWidget, "plotValues"
    ).text().startswith("t 0.69")
    assert "Λ(t)" in values(editor)


def test_a_curvature_that_rounding_hides_is_displayed_with_its_error(editor):
    """Between points 1e-9 apart the curvature was told as 1.5, and is −1.5."""
    editor.trigger("plotCurvature")
    chords = Parametrization(ParametrizationKind.CHORD_LENGTH)
    for gap, word in ((1e-3, "κ −1.499"), (1e-6, " ± 0.0"), (1e-9, "e4")):
        points = [(0, 0), (1, 1), (1 + gap, 1), (2, 0)]
        curve = replace(make_curve(points, family=HERMITE), parametrization=chords)
        editor.session.change("Set", lambda document, curve=curve: document.with_curve(0, curve))
        before, after = editor.parameters[1:3]
        editor.session.scrub.set(before + 0.3 * (after - before))
        editor.wait_for_rest()
        assert word in values(editor)


def test_escape_restores_the_scrub_line(editor):
    editor.trigger("plotSpeed")
    plots = canvas(editor)
    editor.scrub(0.3)
    before = editor.session.scrub.t
    editor.send(plots, QEvent.Type.MouseButtonPress, plots.to_pixel(0.6, 0.5))
    editor.send(plots, QEvent.Type.MouseMove, plots.to_pixel(0.8, 0.5))
    assert editor.session.scrub.t == pytest.approx(0.8, abs=3e-3)
    QTest.keyClick(plots, Qt.Key.Key_Escape)
    assert editor.session.scrub.t == before
    editor.send(plots, QEvent.Type.MouseMove, plots.to_pixel(0.2, 0.5))
    editor.send(plots, QEvent.Type.MouseButtonRelease, plots.to_pixel(0.2, 0.5), held=False)
    assert editor.session.scrub.t == before


def test_an_undo_during_a_scrub_ends_the_scrub(editor):
    editor.drag_point(1, to=(2.4, 4.2))
    editor.trigger("plotSpeed")
    plots = canvas(editor)
    editor.send(plots, QEvent.Type.MouseButtonPress, plots.to_pixel(0.6, 0.5))
    editor.trigger("undo")
    after = editor.session.scrub.t
    editor.send(plots, QEvent.Type.MouseMove, plots.to_pixel(0.2, 0.5))
    assert editor.session.scrub.t == after


def test_without_a_curve_the_plots_give_the_reason(editor):
    editor.trigger("plotSpeed")
    editor.session.commit(set_position(editor.session.document, 0, 2, editor.point(1)), "Meet")
    editor.settle()
    assert "coincide" in canvas(editor).note or "distinct" in canvas(editor).note
    assert not canvas(editor).plots
    editor.trigger("undo")
    assert canvas(editor).note == ""
    assert canvas(editor).plots


def test_other_panels_can_add_plots_after_one_was_closed(editor):
    """The panel stayed away: it took the plot that was shown before for the one that was added."""
    editor.trigger("plotSpeed")
    editor.trigger("plotSpeed")
    assert not canvas(editor).plots
    t = np.linspace(0, 1, 50)
    editor.window.analysis.add_plot(plot_of("Errors", [PlotLine("monomial", t, 1e-3 * (1 + t))], Scale.LOG))
    editor.settle()
    assert editor.window.central["plotPanel"].isVisible()
    assert [each.title for each in canvas(editor).plots] == ["Errors"]
    editor.window.analysis.remove_plot("Errors")


def test_other_panels_can_add_plots(editor):
    t = np.linspace(0, 1, 50)
    lines = [
        PlotLine("monomial", t, 1e-3 * (1 + t)),
        PlotLine("Newton", t, 1e-9 + 0 * t, LineStyle("warning", dashes=DASHED)),
    ]
    editor.window.analysis.add_plot(plot_of("Error of each method", lines, Scale.LOG))
    editor.settle()
    assert editor.window.central["plotPanel"].isVisible()
    editor.trigger("plotSpeed")
    assert [each.title for each in canvas(editor).plots] == [lengths.SPEED.title, "Error of each method"]
    editor.scrub(0.5)
    assert "Newton 1e−9" in values(editor)
    editor.trigger("plotSpeed")
    assert editor.window.central["plotPanel"].isVisible()
    editor.window.analysis.remove_plot("Error of each method")
    assert editor.window.central["plotPanel"].isHidden()


def test_the_height_of_the_plots_is_remembered(qtbot, tmp_path):
    first = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"))
    first.trigger("plotSpeed")
    sizes = first.window.splitter.sizes()
    first.window.splitter.setSizes([sizes[0] - 60, sizes[1], sizes[2] + 60])
    first.settle()
    height = first.window.central["plotPanel"].height()
    assert height == pytest.approx(sizes[2] + 60, abs=3)
    first._discard_changes()
    first.window.close()
    second = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"))
    assert second.window.central["plotPanel"].isHidden()
    second.trigger("plotLebesgue")
    assert second.window.central["plotPanel"].height() == pytest.approx(height, abs=3)


def test_all_plots_fit_a_small_window(qtbot):
    editor = Editor(qtbot, size=(1024, 700))
    for name in ACTIONS:
        editor.trigger(name)
    window = editor.window
    assert (window.width(), window.height()) == (1024, 700)
    bottom = window.central["plotPanel"].mapTo(window, QPoint(0, window.central["plotPanel"].height())).y()
    assert bottom <= window.status_line.y()
    assert window.canvas.height() >= 0.35 * window.splitter.height()
    assert window.central["basisPane"].height() >= 120
    assert canvas(editor).getViewBox().rect().height() > 150


def test_a_polynomial_of_many_points_is_plotted_after_the_drag(editor):
    document = editor.session.document
    from app.document.model import Curve, Document, Parametrization, Point

    x = np.cos(np.linspace(np.pi, 0, 80))
    points = tuple(Point(float(a), float(np.sin(5 * a))) for a in x)
    many = Curve("Many", LAGRANGE, Parametrization(ParametrizationKind.CHEBYSHEV), points)
    editor.session.commit(Document((many,)), "Many")
    editor.settle()
    assert editor.session.document is not document
    # However slow the machine is, it does not rest before it was looked at.
    settling = editor.window.commands[PlotCommands]._task._timer
    settling.setInterval(600_000)
    editor.trigger("plotSpeed")
    assert not canvas(editor).plots
    settling.setInterval(SETTLE_MS)
    until_settled(editor, lambda: canvas(editor).plots)
    exact = np.linalg.norm(editor.session.active_view.curve.evaluate(line(editor).t[::50], 1), axis=1)
    assert line(editor).values[::50] == pytest.approx(exact)


def test_larger_drawing_and_another_theme_reach_the_plots(editor):
    editor.trigger("plotSpeed")
    size = canvas(editor).getAxis("bottom").font.pointSizeF()
    editor.trigger("enlarge")
    assert canvas(editor).getAxis("bottom").font.pointSizeF() > size
    editor.trigger("themeDark")
    dark = canvas(editor).grab().toImage().pixelColor(100, 30).lightnessF()
    editor.trigger("themeLight")
    assert dark < 0.3 < canvas(editor).grab().toImage().pixelColor(100, 30).lightnessF()


@pytest.mark.parametrize(
    ("low", "high"), [(0.0, 1.0), (-3.0, 7e5), (-1e300, 1e300), (0.0, 3e-290), (-5e-12, 0.0), (0.0, 0.0)]
)
def test_an_axis_has_round_numbers_whatever_the_size_of_the_values(low, high):
    t = np.array([0.0, 1.0])
    scale = ValueScale.of(plot_of("", [PlotLine("", t, np.array([low, high]))], Scale.LINEAR))
    for most in (2, 5, 9):
        ticks = scale.ticks(most)
        assert 2 <= len(ticks) <= 2 * most + 1
        assert any(text == "0" for _, text in ticks)
        shares = [share for share, _ in ticks]
        assert shares == sorted(shares)
        assert -1e-6 <= shares[0] <= shares[-1] <= 1 + 1e-6


@pytest.mark.parametrize(("low", "high"), [(1.0, 1.0), (1.0, 2.1), (1.0, 512.0), (1.0, 1e297), (1e-17, 1e-2)])
def test_a_logarithmic_axis_has_powers_of_ten(low, high):
    t = np.array([0.0, 1.0])
    scale = ValueScale.of(plot_of("", [PlotLine("", t, np.array([low, high]))], Scale.LOG))
    for most in (2, 5, 9):
        assert 1 <= len(scale.ticks(most)) <= 3 * most
    assert scale.share(low) == pytest.approx(0.0, abs=1e-9)
    assert scale.share(high) <= 1.0
    assert scale.share(0.0) < -1.0


def test_the_plots_zoom_while_the_basis_functions_are_hidden(editor):
    editor.trigger("plotSpeed")
    editor.trigger("toggleBasis")
    plots = canvas(editor)
    before = plots.camera.t_range
    wheel(editor, plots, plots.to_pixel(0.3, 0.5), 3)
    assert plots.camera.t_range[1] - plots.camera.t_range[0] < 0.7 * (before[1] - before[0])
    editor.trigger("toggleBasis")
    assert editor.window.basis_panel.camera.t_range == pytest.approx(plots.camera.t_range)


def test_the_scale_stays_while_t_is_zoomed_and_fits_afterwards(editor):
    editor.trigger("plotCurvature")
    plots, title = canvas(editor), curvature.CURVATURE.title
    before = plots.scale_of(title)
    wheel(editor, plots, plots.to_pixel(0.25, 0.5), 8)
    assert plots.scale_of(title).holding(before) == plots.scale_of(title)
    until_settled(editor, lambda: plots.scale_of(title).high < 0.9 * before.high)


def test_arrow_keys_move_the_scrub_line(editor):
    editor.trigger("plotSpeed")
    plots = canvas(editor)
    plots.setFocus()
    QTest.keyClick(plots, Qt.Key.Key_Right)
    first = editor.session.scrub.t
    assert first == pytest.approx(0.5)
    QTest.keyClick(plots, Qt.Key.Key_Right)
    QTest.keyClick(plots, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    assert editor.session.scrub.t == pytest.approx(first - 9 / plots.pixel_map.sx)
    for _ in range(100):
        QTest.keyClick(plots, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    assert editor.session.scrub.t == 0.0


def test_added_lines_follow_a_drag_without_a_jump_of_the_scale(editor):
    title, t = "Errors", np.linspace(0, 1, 50)

    def show(size):
        lines = [PlotLine("", t, size * (1 + t))]
        editor.window.analysis.add_plot(plot_of(title, lines, Scale.LINEAR, "e"))

    editor.trigger("plotSpeed")
    show(1.0)
    rest = canvas(editor).scale_of(title).high
    x, y = editor.point(1)
    editor.press((x, y))
    editor.move((x + 0.3, y + 0.3))
    own = canvas(editor).plots[0]
    show(5.0)
    assert canvas(editor).plots[0] is own
    show(0.5)
    assert canvas(editor).scale_of(title).high == pytest.approx(5 * rest)
    editor.escape()
    show(1.0)
    assert canvas(editor).scale_of(title).high == pytest.approx(rest)
    editor.window.analysis.remove_plot(title)


def test_axes_write_the_minus_that_the_canvas_writes(editor):
    """The basis panel wrote "-0.5" beside the canvas' "−0.5"."""
    window = editor.window
    for plot in (window.canvas, window.basis_panel):
        for side in ("left", "bottom"):
            words = [text for _, text in plot.getAxis(side).ticks(-0.6, 0.6, 120.0).labels]
            assert any(text.startswith("−") for text in words)
            assert not any("-" in text for text in words)
