"""Explain this wiggle, with real events."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QEnterEvent, QFontMetricsF
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QPushButton

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.words import short, with_decimals
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.wiggle.commands import WiggleCommands
from app.features.wiggle.panel import WigglePanel
from app.testing import Editor
from tests.gui.editor_facts import until_settled

LEFT = Qt.MouseButton.LeftButton
HEIGHTS = (0.04, 0.06, 0.1, 0.2, 0.5, 1.0, 0.5, 0.2, 0.1, 0.06, 0.04)


@pytest.fixture
def runge(editor):
    """Runge's function over equally spaced points: it swings out at both ends."""
    return with_runge(editor)


def with_runge(editor):
    points = [(0.4 * i, 2 * y) for i, y in enumerate(HEIGHTS)]
    uniform = Parametrization(kind=ParametrizationKind.UNIFORM)
    editor.session.commit(Document((replace(make_curve(points), parametrization=uniform),)), "Begin")
    editor.fit()
    return editor


def commands(editor):
    return editor.window.commands[WiggleCommands]


def panel(editor):
    found = editor.window.findChild(WigglePanel, "wigglePanel")
    assert found is not None
    return found


def settled(editor):
    editor.settle()
    until_settled(editor, lambda: not commands(editor)._task.is_busy)
    editor.settle()


def button(editor, key):
    found = editor.window.findChild(QPushButton, f"cure_{key}")
    assert found is not None
    return found


def text(editor, name):
    return editor.window.findChild(QLabel, name).text()


def ghosts(editor):
    return editor.window.canvas.drawing.annotations.trace_layer.groups.get("cure", ((), False))[0]


def hover(widget):
    middle = QPointF(widget.rect().center())
    QApplication.sendEvent(widget, QEnterEvent(middle, middle, widget.mapToGlobal(middle)))


def leave(widget):
    QApplication.sendEvent(widget, QEvent(QEvent.Type.Leave))


def test_escape_hides_the_preview_of_a_cure(runge):
    """The scrub line went, the panel was empty, and the preview stayed on the canvas."""
    runge.trigger("explainWiggle")
    settled(runge)
    hover(button(runge, "chebyshev"))
    assert ghosts(runge)
    for _ in range(2):
        runge.escape()
    assert runge.session.scrub.t is None
    assert not ghosts(runge)


def test_the_tool_explains_the_widest_swing_at_once(runge):
    runge.trigger("explainWiggle")
    settled(runge)
    view = runge.session.active_view
    _, y = view.curve.evaluate(runge.session.scrub.t)
    assert abs(y) > 3  # twice as high as any point
    words = panel(runge).words.text()
    assert "overshoots by" in words
    assert "points away" in words
    weights = view.curve.basis(np.array([runge.session.scrub.t]))[0, :, 0]
    strongest = panel(runge).bars.pulls[0]
    assert strongest.point == np.argmax(np.abs(weights))
    assert strongest.weight == pytest.approx(weights[strongest.point])
    assert f"Λ(t) = {np.abs(weights).sum():.2g}" in text(runge, "wiggleTitle")


def test_a_click_with_the_tool_explains_another_t_and_escape_leaves_the_tool(runge):
    runge.trigger("explainWiggle")
    settled(runge)
    document = runge.session.document
    t = 0.46
    runge.click(tuple(runge.session.active_view.curve.evaluate(t).tolist()))
    settled(runge)
    assert runge.session.scrub.t == pytest.approx(t, abs=0.01)
    assert "Between points 4 and 5" in panel(runge).words.text()
    runge.click(runge.window.canvas.to_plane(QPoint(60, 60)))
    assert runge.status == "Click the curve where it oscillates."
    runge.escape()
    assert runge.action("selectTool").isChecked()
    assert runge.session.document is document


def test_the_menu_of_the_curve_explains_the_t_under_the_pointer(runge):
    t = 0.95
    runge.open_menu(tuple(runge.session.active_view.curve.evaluate(t).tolist()))
    runge.choose("explainHere")
    settled(runge)
    assert runge.session.scrub.t == pytest.approx(t, abs=0.01)
    assert panel(runge).isVisible()
    assert runge.action("selectTool").isChecked()


def test_hovering_a_cure_previews_the_cure_and_changes_nothing(runge):
    runge.trigger("explainWiggle")
    settled(runge)
    document, steps = runge.session.document, runge.session.undo_stack.count()
    assert not ghosts(runge)
    hover(button(runge, "centripetal"))
    (ghost,) = ghosts(runge)
    assert np.ptp(ghost.pieces[0][:, 1]) < 0.8 * np.ptp(runge.session.active_view.polyline[:, 1])
    leave(button(runge, "centripetal"))
    assert not ghosts(runge)
    button(runge, "spline").setFocus()
    assert len(ghosts(runge)) == 1
    QTest.keyClick(button(runge, "spline"), Qt.Key.Key_Escape)
    assert not ghosts(runge)
    assert runge.session.document is document
    assert runge.session.undo_stack.count() == steps


CURES = (
    ("chordLength", LAGRANGE, ParametrizationKind.CHORD_LENGTH),
    ("centripetal", LAGRANGE, ParametrizationKind.CENTRIPETAL),
    ("chebyshev", LAGRANGE, ParametrizationKind.CHEBYSHEV),
    ("hermite", HERMITE, ParametrizationKind.UNIFORM),
    ("quintic", QUINTIC_HERMITE, ParametrizationKind.UNIFORM),
    ("spline", HERMITE, ParametrizationKind.UNIFORM),
    *(
        (family.name, family, ParametrizationKind.UNIFORM)
        for family in FAMILIES
        if family.curve_class.is_calm
    ),
)


def test_a_click_applies_a_cure_as_one_step_with_the_promised_effect(runge):
    runge.trigger("explainWiggle")
    settled(runge)
    before, steps, t = runge.session.document, runge.session.undo_stack.count(), runge.session.scrub.t
    left = []
    for key, family, kind in CURES:
        promised = text(runge, f"swing_{key}")
        panel(runge).ensureWidgetVisible(button(runge, key))
        QTest.mouseClick(button(runge, key), LEFT)
        settled(runge)
        assert (runge.curve.family, runge.curve.parametrization.kind) == (family, kind)
        assert runge.session.undo_stack.count() == steps + 1
        assert not ghosts(runge)
        if button(runge, key).isVisible():
            left.append(key)
            assert text(runge, "swingNow") == f"Overshoot {promised} →"
            assert text(runge, f"swing_{key}") == "in use"
            assert not button(runge, key).isEnabled()
        else:
            stays = f"Nothing to cure here: the curve stays within {promised} "
            assert text(runge, "nothingToCure").startswith(stays)
        runge.trigger("undo")
        assert runge.session.document == before
        runge.session.scrub.set(t)
        settled(runge)
    # With these it still swings out.
    assert left == ["centripetal", "floater_hormann"]


def test_the_barycentric_rational_curve_calms_runges_function(runge):
    """Measured: it swings out by 0.14 where the polynomial does by 3.8; Λ falls from 30 to 3.7."""
    runge.trigger("explainWiggle")
    settled(runge)
    cure = next(each for each in commands(runge)._cures.cures if each.remedy.name == "floater_hormann")
    assert cure.overshoot < 0.05 * commands(runge)._cures.overshoot
    assert cure.lebesgue < 0.2 * commands(runge)._cures.lebesgue
    assert text(runge, "lebesgueNow") == "Λ 30 →"
    assert text(runge, "lebesgue_floater_hormann") == "3.7"


def test_the_explanation_follows_a_drag_and_the_scrub_line(runge):
    runge.trigger("explainWiggle")
    runge.trigger("selectTool")
    settled(runge)
    swing = panel(runge).words.text()
    # Which of the two ends swings more is a matter of the last digit: this point moves both.
    x, y = runge.point(5)
    runge.press((x, y))
    runge.move((x, y + 1.0))
    assert panel(runge).words.text() != swing
    assert text(runge, "curesState") == "trying cures…"
    runge.escape()
    settled(runge)
    assert panel(runge).words.text() == swing
    runge.scrub(0.46)
    assert "Between points 4 and 5" in panel(runge).words.text()


def test_a_cure_that_makes_the_swing_worse_is_marked_as_worse(editor):
    points = [(0.5 * i, float(np.sin(2.0 * i))) for i in range(20)]
    uniform = Parametrization(kind=ParametrizationKind.UNIFORM)
    editor.session.commit(Document((replace(make_curve(points), parametrization=uniform),)), "Begin")
    editor.trigger("explainWiggle")
    editor.session.scrub.set(0.02)
    settled(editor)
    # Measured: 124 as it is, 223 with chord-length parameters, 0.08 with Chebyshev's.
    assert text(editor, "swing_chordLength") == "worse, 223"
    assert text(editor, "swing_chebyshev") == "0.08"


def test_closed_curves_and_corners_are_explained(editor):
    points = [(0, 0), (8, 0.5), (9, 8), (1, 9), (-0.5, 1.5)]
    uniform = Parametrization(kind=ParametrizationKind.UNIFORM)
    closed = replace(make_curve(points, family=HERMITE), closed=True, parametrization=uniform)
    points = [replace(point, corner=index == 2) for index, point in enumerate(closed.points)]
    editor.session.commit(Document((replace(closed, points=tuple(points)),)), "Begin")
    editor.trigger("explainWiggle")
    editor.session.scrub.set(0.97)
    settled(editor)
    assert "Between points 4 and 0" in panel(editor).words.text()
    assert text(editor, "swing_chebyshev")


def explain(editor, points, family, t):
    uniform = Parametrization(kind=ParametrizationKind.UNIFORM)
    curve = replace(make_curve(points, family=FAMILIES.named(family)), parametrization=uniform)
    editor.session.commit(Document((curve,)), "Begin")
    editor.trigger("explainWiggle")
    editor.session.scrub.set(t)
    settled(editor)


def test_a_calm_segment_has_no_cures(editor):
    explain(editor, [(0.5 * i, float(np.sin(0.5 * i))) for i in range(12)], "lagrange", 0.5)
    assert "the curve stays within about" in panel(editor).words.text()
    assert text(editor, "nothingToCure").startswith("Nothing to cure here: the curve stays within 0.0")
    for key, *_ in CURES:
        assert not button(editor, key).isVisible()
    assert commands(editor)._asked is None


# Where two points lie close together between ones far apart.
UNEVEN = [(0.0, 0.0), (4.0, 0.0), (4.1, 0.3), (8.0, 0.0), (12.0, 1.0)]


@pytest.mark.parametrize("family", ["cubic_spline", "quintic_hermite"])
def test_a_remedy_that_gives_the_same_curve_is_no_cure(editor, family):
    """The natural spline rules give a quintic curve the velocities and accelerations of the C² spline."""
    explain(editor, UNEVEN, family, 0.37)
    assert button(editor, "spline").isVisible()
    assert text(editor, "swing_spline") == "same curve"
    assert not button(editor, "spline").isEnabled()
    assert button(editor, "spline").statusTip() == "It gives the same curve."
    assert text(editor, "swing_hermite") not in ("same curve", "in use", "")


def test_a_change_by_rounding_is_not_worse(editor):
    """Both are 2.3: the quintic curve was called worse by its last digits."""
    explain(editor, UNEVEN, "hermite", 0.37)
    for cure in commands(editor)._cures.cures:
        if cure.document is not None:
            is_worse = cure.overshoot > 1.05 * commands(editor)._cures.overshoot
            assert text(editor, f"swing_{cure.remedy.name}").startswith("worse") is is_worse
    assert text(editor, "swing_quintic") == "same curve"


def test_rules_of_parameters_have_their_usual_names(runge):
    runge.trigger("explainWiggle")
    settled(runge)
    for key, _, kind in CURES[:3]:
        assert button(runge, key).text() == kind.label
    assert button(runge, "chebyshev").text() == "Chebyshev (2nd kind)"


def test_escape_closes_the_explanation(runge):
    dock = runge.window.findChild(QDockWidget, "wiggleDock")
    runge.trigger("explainWiggle")
    settled(runge)
    assert dock.isVisible()
    runge.escape()
    assert not dock.isVisible()
    assert runge.action("selectTool").isChecked()
    # From the menu of the curve, without the tool.
    runge.open_menu(tuple(runge.session.active_view.curve.evaluate(0.46).tolist()))
    runge.choose("explainHere")
    settled(runge)
    assert dock.isVisible()
    runge.escape()
    assert not dock.isVisible()
    assert runge.session.scrub.t is None


def test_a_jerk_that_was_set_has_a_bar(editor):
    """The names of the bars ended with the acceleration: an IndexError while painting."""
    curve = make_curve(UNEVEN, family=FAMILIES.named("septic_hermite"))
    points = [replace(point, jerk=(0.0, 9e4)) for point in curve.points]
    editor.session.commit(Document((replace(curve, points=tuple(points)),)), "Begin")
    editor.trigger("explainWiggle")
    editor.session.scrub.set(0.2)
    settled(editor)
    bars = panel(editor).bars
    assert any(pull.order == 3 for pull in bars.pulls)
    assert "jerk 0: " in bars.accessibleDescription()


@pytest.mark.parametrize("count", [9, 20, 60])
def test_weights_at_the_points_do_not_cover_each_other(editor, count):
    """At 20 points of Runge's function they lay in heaps."""
    x = np.linspace(-1.0, 1.0, count)
    points = list(zip((3 * x).tolist(), (2 / (1 + 25 * x * x)).tolist(), strict=True))
    for family in ("lagrange", "hermite", "cubic_spline"):
        explain(editor, points, family, 0.985)
        editor.fit()
        assert_weights_do_not_cover_each_other(editor, family)


def assert_weights_do_not_cover_each_other(editor, family):
    for t in (0.985, 0.5, 0.26):
        editor.session.scrub.set(t)
        editor.settle()
        layer = editor.window.canvas.drawing.points
        assert layer.numbers
        strongest = int(np.abs(layer.weights).argmax())
        weight = float(layer.weights[strongest])
        text = short(weight) if abs(weight) >= 100.0 else with_decimals(weight, 2)
        assert len(f"{strongest}  {text}") == layer.numbers[0][1]
        metrics = QFontMetricsF(layer.fonts.times(0.95 * layer.scale))
        boxes = []
        for centre, length in layer.numbers:
            # Raised digits are narrower than others.
            box = QRectF(0, 0, 0.75 * metrics.averageCharWidth() * length, metrics.height() - 2)
            box.moveCenter(centre)
            boxes.append(box)
        assert not any(one.intersects(other) for one, other in combinations(boxes, 2)), (family, t)


def test_weights_at_the_edge_of_the_view_are_whole(runge):
    """ "1 −0.07" read "0.07" at the edge of the view."""
    canvas, layer = runge.window.canvas, runge.window.canvas.drawing.points
    runge.session.scrub.set(0.03)
    x, y = runge.point(1)
    for left, right in ((x - 0.01, x + 2.0), (x - 2.0, x + 0.01)):
        canvas.camera.show_box((left, right), (y - 1.0, y + 1.0))
        runge.settle()
        metrics = QFontMetricsF(layer.fonts.times(0.95 * layer.scale))
        visible = [index for index in range(len(HEIGHTS)) if left < runge.point(index)[0] < right]
        assert 1 in visible
        half = 0.35 * metrics.averageCharWidth()
        boxes = [(centre.x() - half * length, centre.x() + half * length) for centre, length in layer.numbers]
        near = [box for box in boxes if box[1] > 0 and box[0] < canvas.pixel_map.width]
        assert near
        assert all(low >= 0 and high <= canvas.pixel_map.width for low, high in near)


@pytest.mark.parametrize("size", [(1440, 900), (1024, 700)])
def test_the_explanation_takes_no_room_from_the_points(qtbot, size):
    runge = with_runge(Editor(qtbot, size=size))
    points = runge.window.findChild(QDockWidget, "pointsDock")
    before = points.geometry()
    runge.key(Qt.Key.Key_W)
    settled(runge)
    assert panel(runge).isVisible()
    assert points.geometry() == before


def test_a_hidden_explanation_computes_nothing(new_editor):
    runge = with_runge(new_editor)
    runge.drag_point(3, to=(1.2, 1.0))
    assert commands(runge)._panel is None
    runge.trigger("explainWiggle")
    settled(runge)
    runge.show_dock("curveDock")
    asked = commands(runge)._asked
    runge.trigger("selectTool")
    runge.drag_point(3, to=(1.2, 0.5))
    assert commands(runge)._asked == asked
