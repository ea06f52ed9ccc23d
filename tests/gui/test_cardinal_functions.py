"""The basis panel with the estimates: what each point really does, with real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QToolButton

from app.document.derivatives import VelocityRule
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.features.basis.function_lines import FunctionLines, crests_of
from app.settings.preferences import Preferences
from app.testing import Editor
from app.view_model.analysis.warnings import warnings_of

UNEVEN = [(0.0, 0.0), (0.5, 0.1), (1.0, 0.0), (5.0, 2.2), (5.4, 2.2), (5.8, 2.0), (6.2, 2.1)]


@pytest.fixture
def uneven(editor):
    """Seven points under chord length, velocities of the C² spline."""
    points = tuple(Point(x, y) for x, y in UNEVEN)
    editor.session.commit(Document((Curve("Uneven", HERMITE, Parametrization(), points),)), "Begin")
    editor.fit()
    return editor


def label(editor, name):
    editor.wait_for_rest()
    return editor.window.findChild(QLabel, name).text()


def switch(editor):
    return editor.window.findChild(QToolButton, "withEstimates")


def test_the_switch_shows_the_effect_of_each_point_and_the_title_changes(uneven):
    panel, cardinal = uneven.window.basis_panel, uneven.session.active_view.cardinal
    assert label(uneven, "basisTitle") == "Basis functions"
    assert panel.drawing.basis.kinds == 2
    QTest.mouseClick(switch(uneven), Qt.MouseButton.LeftButton)
    assert uneven.action("toggleEstimates").isChecked()
    assert label(uneven, "basisTitle").startswith("Cardinal functions")
    assert panel.accessibleName() == "Cardinal functions"
    assert not uneven.window.findChild(QToolButton, "velocityFunctions").isVisible()
    for point in range(7):
        t, values = panel.drawing.basis.function(point, 0)
        assert values == pytest.approx(cardinal.basis(t)[:, point])
        # All of it is drawn: beyond the neighbours of its point nothing was.
        lines = FunctionLines(panel.drawing.basis, panel.pixel_map)
        assert lines.function(point, 0).size() == len(t) == len(panel.drawing.basis.t)
    # Hovering a function lights its point: between points 2 and 3 the function of point 1 is at −1.8.
    panel.drawing.fit_values()
    uneven.settle()
    value = panel.drawing.basis.value_at(0.4, 0)[1]
    assert value == pytest.approx(-1.79, abs=0.01)
    uneven.send(panel, QEvent.Type.MouseMove, panel.to_pixel(0.4, value), held=False)
    assert uneven.session.selected.hovered == 1
    # By keyboard back, and for good with the space bar; a Lagrange curve has no estimates.
    switch(uneven).setFocus()
    QTest.keyClick(switch(uneven), Qt.Key.Key_Space)
    assert panel.drawing.basis.kinds == 2
    uneven.key(Qt.Key.Key_F8, Qt.KeyboardModifier.ShiftModifier)
    assert panel.drawing.basis.kinds == 1
    uneven.choose_family(LAGRANGE)
    assert label(uneven, "basisTitle") == "Basis functions"
    assert not switch(uneven).isVisible()
    assert not uneven.action("toggleEstimates").isEnabled()
    assert "Basis Functions with Estimates" in uneven.find_command("with estimates")
    uneven.trigger("undo")
    uneven.trigger("toggleEstimates")


def test_the_functions_follow_a_drag_and_a_handle_and_stay_without_a_change(uneven):
    panel = uneven.window.basis_panel
    uneven.trigger("toggleEstimates")
    for move in (lambda: uneven.drag_point(3, (4.0, 2.0)), lambda: uneven.drag_parameter(2, to=0.2)):
        before = panel.drawing.basis
        move()
        assert panel.drawing.basis is not before
        assert panel.drawing.basis.cardinal is uneven.session.active_view.cardinal
    # The parameters are set by hand now: a point changes nothing, a handle that is set does.
    before = panel.drawing.basis
    uneven.drag_point(3, (4.5, 2.0))
    assert panel.drawing.basis is before
    uneven.select_point(3)
    uneven.drag_handle((4.8, 3.0))
    assert panel.drawing.basis is not before
    assert uneven.curve.points[3].velocity is not None
    # Position functions that were put away are not missed here, where there are no others.
    uneven.trigger("toggleEstimates")
    QTest.mouseClick(uneven.window.findChild(QToolButton, "positionFunctions"), Qt.MouseButton.LeftButton)
    uneven.trigger("toggleEstimates")
    assert panel.drawing.basis.drawn_kinds(panel.drawing.functions.kinds) == [0]
    uneven.trigger("toggleEstimates")
    QTest.mouseClick(uneven.window.findChild(QToolButton, "positionFunctions"), Qt.MouseButton.LeftButton)


def test_the_constant_on_screen_is_that_of_the_points(uneven):
    """It was 1, and "no error of a point grows" stood in the plot."""
    uneven.trigger("plotLebesgue")
    assert label(uneven, "lebesgueConstant") == "Λ 8.56"
    (plot,) = uneven.window.central["plotPanel"].pane.canvas.plots
    assert plot.levels[0].name == "Lebesgue constant Λ = 8.56"
    uneven.scrub(0.4)
    weights = uneven.window.canvas.drawing.points.weights
    assert weights == pytest.approx(uneven.session.active_view.cardinal.basis(uneven.session.scrub.t))
    assert np.abs(weights).sum() > 7
    # A velocity that is set does not follow its point any more, though no parameter has changed.
    uneven.fit()
    uneven.select_point(2)
    start = uneven.window.canvas.to_pixel(*uneven.handle().position)
    canvas = uneven.window.canvas
    uneven.send(canvas, QEvent.Type.MouseButtonPress, QPointF(start))
    uneven.send(canvas, QEvent.Type.MouseMove, QPointF(start) + QPointF(12, 9))
    uneven.send(canvas, QEvent.Type.MouseButtonRelease, QPointF(start) + QPointF(12, 9), held=False)
    uneven.settle()
    (plot,) = uneven.window.central["plotPanel"].pane.canvas.plots
    assert plot.levels[0].value == pytest.approx(uneven.session.active_view.growth)
    assert plot.levels[0].value < 8
    assert label(uneven, "lebesgueConstant") == f"Λ {uneven.session.active_view.growth:.3g}"


def test_the_first_point_of_a_closed_spline_has_one_function(editor):
    """It had two, and Λ 2.73 stood there."""
    points = tuple(Point(x, y) for x, y in [(2.0, 1.0), (3.0, 1.0), (4.0, 0.0), (0.0, 4.0)])
    spline = Curve("Closed", FAMILIES.named("cubic_spline"), Parametrization(), points, closed=True)
    editor.session.commit(Document((spline,)), "Begin")
    assert label(editor, "lebesgueConstant") == "Λ 2.59"
    panel, cardinal = editor.window.basis_panel, editor.session.active_view.cardinal
    panel.drawing.fit_values()
    editor.settle()
    for t in (0.05, 0.4, 0.9):
        value = float(cardinal.basis(t)[0])
        others = np.abs(cardinal.basis(t)[1:] - value)
        assert others.min() * panel.pixel_map.sy > 3
        editor.send(panel, QEvent.Type.MouseMove, panel.to_pixel(t, value), held=False)
        assert editor.session.selected.hovered == 0
    editor.scrub(0.4)
    at = editor.session.scrub.t
    assert editor.window.canvas.drawing.points.weights == pytest.approx(cardinal.basis(at))
    assert len(crests_of(panel.drawing.basis, [0])) == 5  # its number stands at both ends


def test_the_growth_by_akimas_rule_is_marked_as_that_of_the_present_points(editor):
    """Λ 1.69 stood there: a mean of x and y. At a corner between straight runs it has no bound."""
    worse = ((1.0, 6.0), (0.0, 0.0), (3.0, 0.0), (1.0, 3.0), (2.0, 6.0), (4.0, 6.0), (2.0, 6.0))
    rule = VelocityRule.AKIMA
    points = tuple(Point(x, y) for x, y in worse)
    worse = Curve("Worse", HERMITE, Parametrization(), points, velocity_rule=rule)
    editor.trigger("plotLebesgue")
    editor.session.commit(Document((worse,)), "Begin")
    assert label(editor, "lebesgueConstant") == "Λ 9.16 at these points"
    assert "depends on the points" in editor.window.findChild(QLabel, "lebesgueConstant").toolTip()
    (plot,) = editor.window.central["plotPanel"].pane.canvas.plots
    assert plot.levels[0].name == "Lebesgue constant Λ = 9.16 at these points"
    uniform = Parametrization(ParametrizationKind.UNIFORM)
    points = tuple(Point(float(x), float(y)) for x, y in enumerate([0, 1, 2, 1, 0]))
    corner = replace(worse, points=points, parametrization=uniform)
    editor.session.commit(Document((corner,)), "A corner")
    assert label(editor, "lebesgueConstant") == "Λ ∞ at these points"
    (plot,) = editor.window.central["plotPanel"].pane.canvas.plots
    assert plot.levels[0].name == "Lebesgue constant Λ = ∞ at these points"
    (warned,) = warnings_of(editor.session.active_view, np.inf)
    assert warned.sentence.startswith(
        "Between two straight runs of x or y the smallest error in a point makes the velocity jump"
    )
    linear = replace(worse, velocity_rule=VelocityRule.BESSEL)
    editor.session.commit(Document((linear,)), "Another rule")
    assert "at these points" not in label(editor, "lebesgueConstant")
    assert "other points" not in editor.window.findChild(QLabel, "lebesgueConstant").toolTip()


def test_the_choice_is_remembered(qtbot, tmp_path):
    preferences = Preferences(tmp_path / "settings.ini")
    preferences.with_estimates = True
    editor = Editor(qtbot, preferences=Preferences(tmp_path / "settings.ini"))
    assert editor.action("toggleEstimates").isChecked()
    assert switch(editor).isChecked()
    editor.choose_family(HERMITE)
    editor.trigger("toggleEstimates")
    assert not Preferences(tmp_path / "settings.ini").with_estimates
