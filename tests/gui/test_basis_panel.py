"""The basis panel: functions, t-rail and scrub line, with real mouse events."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import pixels_of
from PySide6.QtCore import QEvent, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QToolButton, QWidget

from app.appearance.colours import point_colours
from app.appearance.theme import DARK, LIGHT
from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.document.point_edits import move_points, set_position
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.basis.function_lines import apart, crests_of
from app.features.basis.scene import rail_height
from app.view_model.palette import contrast


@pytest.fixture
def panel(editor):
    return editor.window.basis_panel


def test_dragging_a_tick_changes_t_and_makes_the_parameters_manual(editor, panel):
    old = editor.parameters
    target = (old[3] + old[4]) / 2
    editor.drag_parameter(3, to=target)
    assert editor.parameters[3] == pytest.approx(target, abs=1.5 / panel.pixel_map.sx)
    assert editor.parameters[:3] + editor.parameters[4:] == old[:3] + old[4:]
    assert editor.curve.parametrization.kind is ParametrizationKind.MANUAL
    assert editor.session.undo_stack.undoText() == "Change t of point 3"
    assert editor.session.undo_stack.count() == 1
    editor.trigger("undo")
    assert editor.parameters == old
    assert editor.curve.parametrization.kind is ParametrizationKind.CHORD_LENGTH


@pytest.mark.parametrize("to", [0.8, "far to the right"])
def test_dragging_the_last_tick_changes_the_displayed_interval_and_undo_restores_the_interval(
    editor, panel, to
):
    """The range stayed -0.035 to 1.035, a tick at 1.4 out of sight; undo and redo showed another one."""
    before = panel.camera.t_range
    start = panel.rail_pixel(1.0)
    end = panel.rail_pixel(to) if to == 0.8 else start + QPointF(300, 0)
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    editor.send(panel, QEvent.Type.MouseMove, start + (end - start) / 2)
    editor.send(panel, QEvent.Type.MouseMove, end)
    assert panel.camera.t_range == before
    editor.send(panel, QEvent.Type.MouseButtonRelease, end, held=False)
    last = editor.parameters[-1]
    assert (last > 1.2) is (to != 0.8)
    assert panel.camera.t_range == pytest.approx((-0.035 * last, 1.035 * last))
    shown = panel.camera.t_range
    editor.trigger("undo")
    assert panel.camera.t_range == pytest.approx(before)
    editor.trigger("redo")
    assert panel.camera.t_range == pytest.approx(shown)


def test_escape_restores_the_visible_part_of_t(editor, panel):
    panel.camera.show_t(0.9, 1.1)
    editor.settle()
    start = panel.rail_pixel(1.0)
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    editor.send(panel, QEvent.Type.MouseMove, start + QPointF(60, 0))
    assert editor.parameters[-1] > 1.0
    editor.key(Qt.Key.Key_Escape)
    assert editor.parameters[-1] == 1.0
    assert panel.camera.t_range == pytest.approx((0.9, 1.1))
    editor.send(panel, QEvent.Type.MouseButtonRelease, start + QPointF(60, 0), held=False)
    assert panel.camera.t_range == pytest.approx((0.9, 1.1))


def test_a_drag_inside_the_interval_keeps_the_visible_part_of_t(editor, panel):
    panel.camera.show_t(0.2, 0.8)
    editor.settle()
    editor.drag_parameter(3, to=editor.parameters[3] + 0.02)
    assert panel.camera.t_range == pytest.approx((0.2, 0.8))


def test_functions_have_numbers_at_their_crests(editor, panel):
    """By colour alone functions 2 and 3 are the same grey to a deuteranope."""
    editor.choose_family(HERMITE)
    editor.wait_for_rest()
    basis, shown = panel.drawing.basis, panel.pixel_map
    found = crests_of(basis, [0, 1])
    for owner, kind, t, value in found:
        values = basis.value_at(t, kind)
        assert values[owner] == pytest.approx(value)
        if kind == 0:
            assert np.flatnonzero(np.abs(values) > 1e-12).tolist() == [owner]
        else:
            # s (1 − s)² h is 4/27 h at its crest, ahead of its knot; that of the last one lies behind it.
            gaps = np.diff(editor.parameters)
            beside = gaps[max(owner - 1, 0) : owner + 1]
            height = 2.5 * 4 / 27 * (gaps[owner] / beside.max() if owner < len(gaps) else -1.0)
            # Between two samples the crest is lower by a square of their distance.
            assert value == pytest.approx(height, rel=2e-3)
    picture, colours = panel.viewport().grab().toImage(), point_colours(basis.count, LIGHT)
    origin = panel.rail_pixel(0.0) - QPointF(shown.x(0.0), shown.height - rail_height(1.0) + 8)
    for owner, kind, t, _ in found:
        if kind == 0:
            x, y = origin.x() + shown.x(t), origin.y() + shown.y(1.0)
            above = [(round(x) + i, round(y) - 3 - j) for i in range(-5, 6) for j in range(8)]
            # Letters are thin, more so in some fonts: their darkest pixel is nearer to the colour of
            # the function than to the paper.
            hues = [picture.pixelColor(*place) for place in above]
            nearest = min(abs(hue.lightness() - colours[owner].lightness()) for hue in hues)
            contrast = LIGHT.paper.lightness() - colours[owner].lightness()
            assert 2 * nearest < contrast, owner
            assert contrast > 40


@pytest.mark.parametrize(
    ("family", "count", "least"),
    [(LAGRANGE, 12, 8), (HERMITE, 12, 18), (QUINTIC_HERMITE, 8, 16)],
)
def test_no_function_crosses_the_number_of_another(editor, panel, family, count, least):
    """Of twelve Lagrange functions the numbers at the ends were crossed."""
    points = [(float(i), float(i * i % 5)) for i in range(count)]
    editor.session.commit(Document((make_curve(points, family=family),)), "Begin")
    editor.fit()
    editor.wait_for_rest()
    names, shown, basis = panel.drawing.functions._names, panel.pixel_map, panel.drawing.basis
    cell = names._cell
    boxes = names._centres
    assert len(boxes) >= least
    for x, y in boxes:
        t = np.linspace(
            *(shown.plane(x + dx, 0)[0] for dx in (2 - cell.width() / 2, cell.width() / 2 - 2)), 60
        )
        functions = [basis.curve.basis(t)[:, :, kind] * basis.scales[:, kind] for kind in range(basis.kinds)]
        heights = np.abs(shown.y(np.concatenate(functions, axis=1)) - y)
        inside = (t >= 0) & (t <= 1)
        assert (heights[inside] >= cell.height() / 2 - 3).all(), (x, y)


def test_numbers_keep_their_sides_while_crests_move(editor, panel):
    """They went from one side to the other with every line that came by."""
    editor.wait_for_rest()
    names, start = panel.drawing.functions._names, panel.rail_pixel(editor.parameters[3])
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    before, crests = names._offsets, names._positions
    usual = names._choose_timer.interval()
    names._choose_timer.start(60_000)
    for step in range(1, 6):
        editor.send(panel, QEvent.Type.MouseMove, start + QPointF(4 * step, 0))
        panel.viewport().repaint()
        assert names._offsets is before
    assert not np.array_equal(names._positions, crests)
    editor.send(panel, QEvent.Type.MouseButtonRelease, start + QPointF(20, 0), held=False)
    names._choose_timer.start(usual)
    editor.wait_for_rest()
    at_rest = names._offsets.copy()
    names._sides_key = ()
    panel.viewport().repaint()
    assert np.array_equal(names._offsets, at_rest)


def test_the_picture_of_functions_at_rest_is_not_painted_again(editor, panel):
    """Both plots were painted twice for every change, in case a drag had gone on meanwhile."""
    plots, session = (editor.window.canvas, panel), editor.session
    timers = editor.window.canvas.drawing.points._soon, panel.drawing.functions._names._choose_timer

    def paint(x, scale=1.0):
        (curve,) = move_points(session.committed, 0, [1], (x, 0.0)).curves
        points = tuple(replace(each, x=scale * each.x, y=scale * each.y) for each in curve.points)
        session.preview(Document((replace(curve, points=points),)))
        for plot in plots:
            plot.viewport().repaint()

    def expire():
        """Let the time end in which a drag could go on; return which plots are painted again."""
        for timer in timers:
            assert timer.isActive()
            timer.stop()
            timer.timeout.emit()
        return [plot.layers.is_due for plot in plots]

    # What has been painted is what comes to rest.
    editor.settle()
    editor.wait_for_rest()
    paint(0.1)
    assert expire() == [False, False]
    # What was chosen for the first frame of a drag, the second has as well.
    paint(0.2)
    paint(0.3)
    assert expire() == [False, True]
    # Where that leaves them too large, discs as well.
    paint(0.2)
    paint(0.3, scale=0.02)
    assert expire() == [True, True]
    session.cancel()


def test_only_another_hovered_point_repaints_the_functions(editor, panel):
    editor.wait_for_rest()
    panel.drawing.set_hovered(-1)
    panel.drawing.set_selection(editor.session.selection)
    assert not panel.layers.is_due
    panel.drawing.set_hovered(1)
    assert panel.layers.is_due
    panel.drawing.set_hovered(-1)


def test_numbers_at_crests_do_not_overlap():
    cell = QSizeF(20, 12)
    places = np.array([[0.0, 5.0], [10.0, 5.0], [10.0, 30.0], [25.0, 5.0], [60.0, 5.0]])
    assert sorted(apart(places, cell).tolist()) == [0, 2, 3, 4]


def test_a_tick_stops_before_its_neighbours(editor):
    editor.drag_parameter(3, to=0.95)
    t = editor.parameters
    assert t[2] < t[3] < t[4]
    editor.drag_parameter(3, to=0.01)
    t = editor.parameters
    assert t[2] < t[3] < t[4]


def test_the_curve_follows_a_dragged_tick_and_escape_restores_the_curve(editor, panel):
    document, curve = editor.session.document, editor.session.active_view.curve
    start = panel.rail_pixel(editor.parameters[3])
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    editor.send(panel, QEvent.Type.MouseMove, start + QPointF(15, 0))
    assert not np.array_equal(editor.session.active_view.curve.parameters, curve.parameters)
    editor.key(Qt.Key.Key_Escape)
    editor.send(panel, QEvent.Type.MouseMove, start + QPointF(20, 0))
    editor.send(panel, QEvent.Type.MouseButtonRelease, start + QPointF(20, 0), held=False)
    assert editor.session.document is document
    assert editor.session.undo_stack.count() == 0


def test_the_panel_shows_the_functions_of_the_curve(editor, panel):
    for family in FAMILIES:
        editor.choose_family(family)
        basis, curve = panel.drawing.basis, editor.session.active_view.curve
        assert basis.curve.degree == curve.degree
        for index in range(8):
            for kind in range(basis.kinds):
                t, values = basis.function(index, kind)
                exact = curve.basis(t)[:, index, kind] * basis.scales[index, kind]
                assert values == pytest.approx(exact, abs=1e-9)


def test_at_a_parameter_only_the_function_of_the_point_equals_one(editor, panel):
    basis = panel.drawing.basis
    for index, t in enumerate(editor.parameters):
        assert basis.value_at(t, 0) == pytest.approx(np.eye(8)[index], abs=1e-14)


def test_hovering_a_function_highlights_the_point_and_a_click_selects_the_point(editor, panel):
    t = editor.parameters[2]
    pixel = panel.to_pixel(t, 1.0)
    editor.send(panel, QEvent.Type.MouseMove, pixel, held=False)
    assert editor.session.selected.hovered == 2
    editor.send(panel, QEvent.Type.MouseButtonPress, pixel)
    editor.send(panel, QEvent.Type.MouseButtonRelease, pixel, held=False)
    assert editor.session.selection == {2}
    assert editor.session.scrub.t is None


@pytest.mark.parametrize("theme", ["themeLight", "themeDark"])
@pytest.mark.parametrize("count", [4, 60, 100], ids=["each", "ramp", "outlines"])
def test_functions_beside_the_selected_one_have_contrast(editor, panel, theme, count):
    """In the dark theme at 45 % of their colour they were as dark as 1.3 : 1, and gone on a projector."""
    editor.trigger(theme)
    points = [(x, (x * x) % 7) for x in range(count)]
    editor.session.commit(Document((make_curve(points, family=HERMITE),)), "Begin")
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    panel.camera.show_t(0.5 - 2 / count, 0.5 + 2 / count)
    editor.select([0])
    image = panel.viewport().grab().toImage()
    left, top = panel.to_pixel(0.5 - 0.4 / count, 0.85).toTuple()
    right, bottom = panel.to_pixel(0.5 + 0.4 / count, 0.6).toTuple()
    part = pixels_of(image)[top:bottom, left:right]
    paper = (LIGHT if theme == "themeLight" else DARK).paper.name()
    seen = {f"#{code:06x}" for code in np.unique(part).tolist()}
    # No pixel of a slanted line has quite the colour of its pen, which has a contrast of 3.
    assert max(contrast(colour, paper) for colour in seen) >= 2.8


def test_the_panel_says_that_no_curve_is_selected(waves):
    """It showed the functions of the curve that was edited last as if that were selected."""
    editor = waves("AB")
    note = editor.window.findChild(QLabel, "basisDrawing")
    assert note.text() == ""
    editor.escape()
    # As a whole, the curve is selected.
    assert note.text() == ""
    editor.escape()
    assert note.text() == "No curve is selected; functions of “B”"
    assert note.isVisible()
    assert note.visibleRegion().boundingRect() == note.rect()
    editor.click((1, 1))
    assert note.text() == ""
    editor.new()
    assert note.text() == ""


def test_a_drag_from_a_function_scrubs_and_selects_nothing(editor, panel):
    """It used to select the point as well."""
    t = editor.parameters[2]
    editor.drag_pixels(panel, panel.to_pixel(t, 1.0), panel.to_pixel(0.5, 1.0))
    assert editor.session.selection == frozenset()
    assert editor.session.scrub.t == pytest.approx(0.5, abs=2e-3)


def test_without_parameters_the_panel_explains_why_there_are_no_functions(editor):
    editor.session.commit(set_position(editor.session.document, 0, 2, editor.point(1)), "Meet")
    editor.settle()
    assert "gives no parameters" in editor.window.findChild(QLabel, "basisDrawing").text()


def test_larger_drawing_enlarges_the_rail_and_the_numbers_at_the_axes(editor, panel):
    size = panel.getAxis("bottom").font.pointSizeF()

    def above_bottom():
        return panel.height() - panel.rail_pixel(0.5).y()

    height = above_bottom()
    editor.trigger("enlarge")
    editor.trigger("enlarge")
    assert panel.getAxis("bottom").font.pointSizeF() == pytest.approx(1.5 * size)
    assert above_bottom() > 1.3 * height
    editor.drag_parameter(3, to=0.45)
    assert editor.parameters[3] == pytest.approx(0.45, abs=1.5 / panel.pixel_map.sx)
    editor.trigger("usualSize")
    assert above_bottom() == pytest.approx(height, abs=1)


def test_hovering_a_point_of_the_canvas_highlights_the_tick(editor, panel):
    editor.hover(editor.point(5))
    assert panel.drawing.functions.emphasised == {5}
    editor.hover((-1.0, -0.2))
    assert panel.drawing.functions.emphasised == frozenset()


def test_scrubbing_shows_weights_that_add_up_to_one(editor):
    editor.scrub(0.37)
    canvas = editor.window.canvas
    assert editor.session.scrub.t == pytest.approx(0.37, abs=2e-3)
    assert canvas.drawing.points.weights.sum() == pytest.approx(1.0, abs=1e-12)
    exact = editor.session.active_view.curve.evaluate(editor.session.scrub.t)
    assert canvas.drawing.points.scrub[1:] == pytest.approx(tuple(exact))
    assert editor.session.undo_stack.count() == 0
    editor.escape()
    assert editor.session.scrub.t is None
    assert canvas.drawing.points.weights is None


def test_the_weights_follow_when_a_point_is_dragged_under_the_scrub_line(editor):
    editor.scrub(0.37)
    before = editor.window.canvas.drawing.points.weights.copy()
    editor.drag_point(2, to=(0.2, 4.5))
    assert not np.allclose(editor.window.canvas.drawing.points.weights, before)


def test_the_scrub_line_stays_on_the_curve(editor, panel):
    editor.scrub(0.5)
    editor.drag_pixels(panel, panel.to_pixel(0.5, 0.5), panel.to_pixel(1.02, 0.5))
    assert editor.session.scrub.t == 1.0


def test_kinds_can_be_switched(editor, panel):
    editor.choose_family(QUINTIC_HERMITE)
    for name, kind in (("velocityFunctions", 1), ("accelerationFunctions", 2)):
        button = editor.window.findChild(QToolButton, name)
        assert button.isVisible()
        button.click()
        assert kind not in panel.drawing.functions.kinds
        button.click()
        assert kind in panel.drawing.functions.kinds
    editor.choose_family(LAGRANGE)
    assert not editor.window.findChild(QToolButton, "velocityFunctions").isVisible()


def test_the_panel_reports_functions_outside_the_range_and_fit_extends_the_range(editor, panel):
    editor.drag_parameter(3, to=editor.parameters[4] - 0.02)
    note = editor.window.central["basisPane"].findChild(QWidget, "basisExtent").toolTip()
    assert "The functions range" in note
    assert editor.window.width() == 1200
    fit = editor.window.findChild(QToolButton, "fitBasis")
    assert fit.isVisible()
    fit.click()
    editor.settle()
    low, high = panel.drawing.basis.extent((0,))
    _, y_min, _, y_max = panel.pixel_map.box
    assert y_min < low
    assert high < y_max
    assert editor.window.central["basisPane"].findChild(QWidget, "basisExtent").toolTip() == ""
    # With nothing to fit any more, and the usual range shown, the button goes (it stayed, and did nothing).
    editor.trigger("undo")
    editor.fit()
    assert not fit.isVisible()


def test_a_drag_of_a_point_at_frozen_parameters_keeps_the_functions(editor, panel):
    editor.trigger("freezeParameters")
    basis = panel.drawing.basis
    editor.drag_point(2, to=(0.2, 4.5))
    assert panel.drawing.basis is basis


def test_the_wheel_zooms_along_t_only(editor, panel):
    _, y_min, _, y_max = panel.pixel_map.box
    panel.camera.zoom(2.0, QPointF(panel.to_pixel(0.5, 0.5)))
    editor.settle()
    x_min, new_y_min, x_max, new_y_max = panel.pixel_map.box
    assert x_max - x_min < 0.6
    assert (new_y_min, new_y_max) == pytest.approx((y_min, y_max))


def test_functions_of_derivatives_never_leave_the_usual_range(editor, panel):
    """They used to, by the program's own scaling, and set off its own warning: −0.79 at uneven spacing."""
    editor.choose_family(QUINTIC_HERMITE)
    editor.drag_parameter(3, to=editor.parameters[2] + 0.02)
    low, high = panel.drawing.basis.extent((1, 2))
    assert -0.5 <= low < -0.4
    assert 0.4 < high <= 0.5
    assert editor.window.central["basisPane"].findChild(QWidget, "basisExtent").toolTip() == ""


def test_functions_are_sampled_densely_enough_in_a_long_segment(editor, panel):
    editor.choose_family(HERMITE)
    for index in range(1, 6):
        editor.drag_parameter(index, to=0.01 * index)
    t, values = panel.drawing.basis.function(6, 0)
    rising = values[t < editor.parameters[6]]
    # Second differences of a function drawn smoothly are small against a pixel's height, 1/150.
    assert np.abs(np.diff(rising, 2)).max() < 1e-3


def test_the_switch_of_the_estimates_stays_under_the_pointer(editor):
    """It moved by 430 px: a second click at the same place missed it."""
    editor.choose_family(QUINTIC_HERMITE)
    switch = editor.window.findChild(QToolButton, "withEstimates")
    place = switch.mapTo(editor.window, switch.rect().center())
    for is_on in (True, False, True):
        QTest.mouseClick(editor.window.childAt(place), Qt.MouseButton.LeftButton)
        editor.settle()
        assert editor.window.store.state.with_estimates is is_on
        assert switch.mapTo(editor.window, switch.rect().center()) == place


def test_no_family_moves_the_plot(editor, panel):
    places = set()
    for family in FAMILIES:
        editor.choose_family(family)
        editor.settle()
        places.add(panel.geometry().getRect())
    assert len(places) == 1


def test_the_label_of_the_scrub_line_is_not_crossed_by_functions(editor, panel):
    """ "t = 1" stood in the number of a function."""
    for t in np.linspace(*editor.session.active_view.curve.domain, 9).tolist():
        editor.session.scrub.set(t)
        editor.settle()
        metrics = QFontMetrics(panel.drawing.rail.fonts.less(1.5, 1.0))
        text = f"t = {editor.session.active_view.t_text(t)}"
        width, x = metrics.horizontalAdvance(text), panel.pixel_map.point(t, 0.0)[0]
        left = x + 9 if x + 10 + width < panel.pixel_map.width else x - 8 - width
        zero = QPointF(panel.to_pixel(t, 0.0)) - QPointF(*panel.pixel_map.point(t, 0.0))
        part = QRectF(zero.x() + left, zero.y() + 3, width - 2, metrics.height() - 2).toRect()
        packed = pixels_of(panel.viewport().grab(part).toImage()).reshape(-1, 1)
        found = (packed >> np.array([16, 8, 0]) & 0xFF).astype(float)
        paper, accent = (np.array(colour.getRgb()[:3], float) for colour in (LIGHT.paper, LIGHT.accent))
        # Every pixel is a mixture of paper and accent.
        along = (found - paper) @ (accent - paper) / ((accent - paper) @ (accent - paper))
        apart = np.abs(found - paper - along[:, None] * (accent - paper)).max()
        assert apart < 40, t


@pytest.mark.parametrize("width", [1024, 1280])
def test_the_header_fits_with_every_note(editor, width):
    editor.window.resize(width, 700)
    # Two parameters close together, as after a drag.
    times = editor.parameters
    times[3] = times[4] - 0.02
    document = rule_edits.freeze_parameters(editor.session.document, 0, times)
    for family in FAMILIES:
        editor.session.commit(rule_edits.set_family(document, 0, family), "Begin")
        check_header(editor, family)


def check_header(editor, family):
    pane = editor.window.central["basisPane"]
    editor.settle()
    holder = pane.findChild(QWidget, "basisHeader")
    assert holder.width() <= pane.width()
    shown = [w for w in holder.findChildren(QWidget) if w.isVisible() and w.parent() is holder]
    header = sorted(shown, key=lambda w: w.x())
    assert len(header) >= 2, family
    for widget in header:
        assert widget.width() >= widget.sizeHint().width(), (family, widget.objectName())
    for left, right in pairwise(header):
        assert left.geometry().right() < right.geometry().left(), family
    # The functions of the Hermite families stay in the range, and nothing is to be said; Lagrange's do not.
    functions = editor.session.active_view.curve.basis(np.linspace(0.0, 1.0, 4001))[:, :, 0]
    leaves = bool(functions.min() < -0.5 or functions.max() > 1.2)
    assert leaves or family is not LAGRANGE
    assert bool(pane.findChild(QWidget, "basisExtent").toolTip()) is leaves, family
