"""The C² cubic spline in the window, its ends and closing; and rules that are not linear, which say so."""

import json

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel
from scipy.interpolate import CubicSpline

from app.document.derivatives import VelocityRule
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE
from app.view_model.analysis.wiggle import explain
from app.view_model.basis import growth_of_points
from tests.waiting import until

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))
SMALL = "of small moves, averaged over x and y"


@pytest.fixture
def spline(editor):
    curve = make_curve(POINTS, family=FAMILIES.named("cubic_spline"))
    editor.session.commit(Document((curve,)), "Begin")
    editor.show_dock("curveDock")
    editor.fit()
    return editor


def ends(editor):
    box = editor.window.findChild(QComboBox, "settingEnds")
    assert box.isVisible()
    return box


def is_scipys(editor, bc_type):
    """Whether the curve is SciPy's with these conditions at its ends."""
    view = editor.session.active_view
    t = view.parameters
    t_inside = np.linspace(t[0], t[-1], 201)[:-1]
    expected = CubicSpline(t, view.at_knots, bc_type=bc_type)(t_inside)
    return np.abs(view.curve.evaluate(t_inside) - expected).max() < 1e-12


def choose(editor, word):
    box = ends(editor)
    box.setFocus()
    while box.currentText() != word:
        way = 1 if box.findText(word) > box.currentIndex() else -1
        QTest.keyClick(box, Qt.Key.Key_Down if way > 0 else Qt.Key.Key_Up)
    editor.settle()


@pytest.mark.parametrize(
    ("word", "value", "bc_type"),
    [("Clamped", "clamped", "clamped"), ("Not a knot", "not_a_knot", "not-a-knot")],
)
def test_the_end_conditions_are_selected_saved_and_undone(spline, tmp_path, word, value, bc_type):
    assert is_scipys(spline, "natural")
    assert [ends(spline).itemText(i) for i in range(4)] == ["Natural", "Clamped", "Not a knot", "Periodic"]
    choose(spline, word)
    assert dict(spline.curve.settings) == {"ends": value}
    assert is_scipys(spline, bc_type)
    spline.drag_point(2, (3.0, 1.5))
    assert is_scipys(spline, bc_type)
    path = tmp_path / "ends.curve.json"
    spline.session.save(path)
    assert json.loads(path.read_text())["curves"][0]["settings"] == {"ends": value}
    before = spline.session.document
    spline.session.open(path)
    assert spline.session.document == before
    assert is_scipys(spline, bc_type)


def test_a_closed_spline_has_periodic_ends_whatever_the_setting(spline):
    choose(spline, "Clamped")
    spline.trigger("closeCurve")
    assert is_scipys(spline, "periodic")
    assert ends(spline).currentText() == "Periodic"
    assert not ends(spline).isEnabled()
    view = spline.session.active_view
    start, end = (view.curve.evaluate(view.curve.domain, order) for order in (1, 2))
    assert start[0] == pytest.approx(start[1], rel=1e-13)
    assert end[0] == pytest.approx(end[1], rel=1e-13)
    spline.drag_point(0, (-0.5, 1.0))
    assert is_scipys(spline, "periodic")
    spline.trigger("closeCurve")
    assert ends(spline).currentText() == "Clamped"
    assert ends(spline).isEnabled()
    assert is_scipys(spline, "clamped")


def test_the_lebesgue_constant_of_a_closed_curve_counts_its_first_point_once(spline):
    """Both functions of the seam were counted each for itself."""
    spline.trigger("closeCurve")
    view = spline.session.active_view
    t = view.parameters
    dense = np.linspace(t[0], t[-1], 20_001)
    unit = np.vstack([np.eye(6), np.eye(6)[:1]])
    truth = np.abs(CubicSpline(t, unit, bc_type="periodic")(dense)).sum(axis=1).max()
    assert growth_of_points(view) == pytest.approx(truth, rel=1e-6)
    basis = spline.window.basis_panel.drawing.basis
    assert growth_of_points(view, basis) == pytest.approx(truth, rel=1e-6)
    shown = spline.window.findChild(QLabel, "lebesgueConstant")
    until(lambda: shown.text() == f"Λ {truth:.3g}")


@pytest.fixture(params=[VelocityRule.MONOTONE, VelocityRule.AKIMA])
def bent(editor, request):
    """A Hermite curve whose velocities are not linear in its points."""
    curve = replace(make_curve(POINTS, family=HERMITE), velocity_rule=request.param)
    editor.session.commit(Document((curve,)), "Begin")
    editor.fit()
    return editor


def test_the_basis_panel_notes_that_its_functions_are_those_of_small_moves(bent):
    note = bent.window.findChild(QLabel, "basisDrawing")
    assert note.text() == ""
    bent.trigger("toggleEstimates")
    assert note.text() == SMALL
    assert SMALL in bent.window.findChild(QLabel, "basisTitle").toolTip()
    linear = replace(bent.curve, velocity_rule=VelocityRule.BESSEL)
    bent.session.commit(Document((linear,)), "Another rule")
    bent.settle()
    assert note.text() == ""
    assert SMALL not in bent.window.findChild(QLabel, "basisTitle").toolTip()


def test_the_error_band_a_bend_and_the_explanation_mention_small_moves(bent):
    bent.show_dock("analysisDock")
    bent.trigger("overlayBand")
    note = bent.window.findChild(QLabel, "overlayBandNote")
    # The mean of x and y was too narrow a band.
    until(lambda: note.text().endswith("are those of small errors in x or y at these points."))
    rows = [row.text for row in bent.window.canvas.drawing.annotations.legend.rows]
    assert any(text.startswith("Worst case to first order") for text in rows)
    assert explain(bent.session.active_view, 0.3).sentences[-1] == f"The weights are those {SMALL}."
    x, y = bent.session.active_view.curve.evaluate(0.5)
    bent.press((float(x), float(y)), keys=Qt.KeyboardModifier.ControlModifier)
    bent.move((float(x) + 0.5, float(y) - 0.4), keys=Qt.KeyboardModifier.ControlModifier)
    assert f"only the points move, by weights {SMALL} ·" in bent.status
    bent.escape()
