"""Numbers at the edge of what can be drawn: nothing is divided by zero, and what is asked for is seen."""

from __future__ import annotations

import re

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget

from app.canvas.hit_test import PixelOutline
from app.document.constraints import rescaled
from app.document.limits import EditError
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.rule_edits import set_parameter
from app.document.words import number
from app.families import HERMITE, QUINTIC_HERMITE
from app.plotting.camera import GREATEST_SPAN
from app.plotting.pixel_map import PixelMap
from app.view_model.append import scale_of
from app.view_model.curve.curve_view import view_of


@pytest.fixture
def opened(editor):
    """Open curves in the editor, fitted; returns the editor."""

    def open_(*curves):
        editor.session.files.restore(Document(curves), None)
        editor.fit()
        return editor

    return open_


def uniform_wave(n):
    angle = np.linspace(0, 6, n)
    curve = make_curve(np.column_stack([angle, np.sin(angle)]).tolist())
    return replace(curve, parametrization=Parametrization(ParametrizationKind.UNIFORM))


def range_note(pane):
    """The note that functions leave the range, in full."""
    return pane.findChild(QWidget, "basisExtent").toolTip()


@pytest.mark.parametrize("n", [40, 60, 100])
def test_wild_functions_are_fitted_about_zero_as_far_as_an_axis_reaches(opened, n):
    """At n = 60 the range was -4.1e13 to -3.1e13; at n = 100 it was empty, and every paint failed."""
    editor = opened(uniform_wave(n))
    pane, panel = editor.window.central["basisPane"], editor.window.basis_panel
    said = range_note(pane)
    pane._fit.click()
    editor.settle()
    _, low, _, high = panel.pixel_map.box
    least, greatest = panel.drawing.basis.extent({0})
    assert low < 0.0 < high
    assert high - low <= GREATEST_SPAN * (1 + 1e-9)
    if n > 60:
        assert (low, high) == pytest.approx((-0.6 * GREATEST_SPAN, 0.4 * GREATEST_SPAN), rel=0.2)
    if greatest < high:
        assert low < least
        assert range_note(pane) == ""
    else:
        assert range_note(pane) == said  # what they reach in truth
    assert not editor.screenshot().isNull()


@pytest.mark.parametrize("empty", [(1.0, 1.0), (2.0, 1.0), (1e25, 1e25 + 1e8), (0.0, float("nan"))])
def test_an_empty_range_has_no_map(empty):
    with pytest.raises(ValueError, match="shows nothing"):
        PixelMap.of_ranges(empty, (0.0, 1.0), 100, 100)
    with pytest.raises(ValueError, match="shows nothing"):
        PixelMap.of_ranges((0.0, 1.0), empty, 100, 100)


def test_the_pen_far_away_on_an_interval_of_timestamps_divides_by_nothing(opened):
    """The points so far have no length in t any more beside the new one: ZeroDivisionError in the press."""
    interval = Parametrization(start=1.7e9, end=1.7e9 + 1)
    points = (Point(0.0, 0.0, velocity=(1.0, 0.0)), Point(1.0, 1.0))
    editor = opened(Curve("Time", HERMITE, interval, points))
    editor.window.canvas.camera.show_box((-3.3e7, 3.3e7), (-3e7, 3e7))
    editor.trigger("addTool")
    editor.click((3e7, 1e7))
    assert editor.curve.points[:2] == points
    assert editor.point(2) == pytest.approx((3e7, 1e7), rel=0.01)
    # "parameters must be strictly increasing, but parameters[1] = …" named nothing that is on the screen.
    assert editor.session.active_view.problem == (
        "t₀ and t₁ are the same number, 1700000000: for an interval from 1700000000 to 1700000001 "
        "points 0 and 1 lie too close together."
    )
    editor.trigger("undo")
    assert editor.curve.points == points


@pytest.mark.parametrize("closed", [False, True])
def test_a_squeezed_interval_keeps_the_derivatives(closed):
    interval = Parametrization(start=1.7e9, end=1.7e9 + 1)
    points = tuple(Point(float(x), float(x), velocity=(1.0, 0.0)) for x in range(3))
    before = view_of(Curve("Time", HERMITE, interval, points, closed=closed))
    after = replace(before.source, points=(*points, Point(3e9, 1e9)))
    assert scale_of(before, after) == 1.0


def test_a_derivative_too_large_for_a_squeezed_interval_is_refused():
    """The square of 1e-200 is nothing to divide by, and that of 1e200 more than a number holds."""
    point = Point(0.0, 0.0, acceleration=(1.0, 0.0))
    with pytest.raises(EditError, match="finite"):
        rescaled(point, 1e-200)
    assert rescaled(point, 1e200).acceleration == (0.0, 0.0)


@pytest.mark.parametrize("kind", [1, 2])
def test_a_handle_on_a_tiny_interval_is_refused_with_a_sentence(opened, kind):
    """The square of the spacing vanished: ZeroDivisionError in the drag of an acceleration."""
    rule = Parametrization(ParametrizationKind.UNIFORM, end=1e-200)
    points = tuple(Point(float(x), 0.0) for x in range(3))
    editor = opened(Curve("Brief", QUINTIC_HERMITE, rule, points))
    editor.select_point(1)
    editor.drag_handle((1.0, 0.5), kind)
    assert editor.curve.points == points
    assert "must" in editor.status


def test_a_tiny_box_is_scaled_in_proportion(opened):
    """The square of the way across it vanished below 1e-154: a warning of NumPy, and nothing moved."""
    for size in (1.0, 1e-100, 1e-200, 1e-300):
        editor = opened(make_curve([(0, 0), (size, 2 * size), (3 * size, size)]))
        editor.select([0, 1, 2])
        x, y = editor.grip(1, 1)
        way = 40 * editor.window.canvas.camera.pixel_size
        editor.drag((float(x), float(y)), (x + way, y + way), keys=Qt.KeyboardModifier.ControlModifier)
        x, y = editor.point(0)
        factor = (editor.point(2)[0] - x) / (3 * size)
        assert factor > 1.05, size
        expected = (x + factor * size, y + factor * 2 * size)
        assert editor.point(1) == pytest.approx(expected, rel=1e-9), size


def test_the_nearest_segment_of_several_polylines():
    """Vertices that leave every picture, points that coincide, and a tie, which the last one drawn wins."""
    far = np.array([(0.0, 0.0), (1e300, 0.0), (1e300, 1e300)])
    still = np.array([(5.0, 9.0), (5.0, 9.0)])
    segments = PixelOutline([far, still, np.array([(0.0, 0.0), (0.0, -8.0)])])
    assert segments.nearest((4.0, 1.0)) == (0, pytest.approx(4e-9), 1.0)
    assert segments.nearest((5.0, 8.0)) == (2, 0.0, 1.0)
    assert segments.nearest((-1.0, -2.0)) == (3, 0.25, 1.0)
    assert segments.nearest((-3.0, 0.0)).segment == 3
    assert PixelOutline([np.zeros((1, 2))]).nearest((0.0, 0.0)) is None


def test_a_line_with_too_few_vertices_has_a_note_on_its_deviation(opened):
    """A thousand points, 4 vertices for each: the line was off by 7 pixels and looked like the curve."""
    points = 2.0 * np.random.default_rng(0).normal(size=(1000, 2))
    rule = Parametrization(ParametrizationKind.CHEBYSHEV)
    editor = opened(replace(make_curve(points.tolist()), parametrization=rule))
    canvas = editor.window.canvas
    canvas.grab()
    assert re.fullmatch(r"Drawn to within [1-9][0-9.]* pixels", canvas.drawing.curve.deviation_text)
    opened(make_curve(points[:5].tolist()))
    canvas.grab()
    assert canvas.drawing.curve.deviation_text == ""


WAVE = ((0.0, 0.0), (0.25, 0.3), (0.5, 0.05), (0.55, 0.2), (1.0, 0.25))
FAR_AWAY = [(0.0, 1.0), (1e6, 1.0), (-1e6, 1.0), (1e9, 1.0), (1e6, 1e-6), (0.0, 1e-6), (1e11, 1.0)]


@pytest.mark.parametrize(("far", "size"), FAR_AWAY)
def test_a_small_curve_far_away_fills_the_view_and_its_numbers_differ(opened, far, size):
    """Around 1e9 a curve of one unit was a dot, and the column of x showed “1e6” five times."""
    points = [(far + size * x, far + size * y) for x, y in WAVE]
    editor = opened(make_curve(points, family=HERMITE))
    canvas, table = editor.window.canvas, editor.window.point_table
    seen = canvas.pixel_map.box[2] - canvas.pixel_map.box[0]
    assert seen == pytest.approx(1.24 * size, rel=0.01)
    left, right = (canvas.to_pixel(*points[k]).x() for k in (0, -1))
    assert right - left > 0.7 * canvas.viewport().width()
    for side in ("left", "bottom"):
        labels = canvas.getAxis(side).ticks_in(canvas.pixel_map).labels
        texts = [text for _, text in labels]
        assert len(texts) == len(set(texts)) >= 2
        # One scale for all: “1e9” between “999999950” and “1000000050” looked like another one.
        assert len({"e" in text for text in texts if text != "0"}) == 1
    for column in range(3):
        rows = range(len(points))
        texts = [table.cell_delegate.text(row, column) for row in rows]
        spoken = [table.model().index(row, column).data() for row in rows]
        for row in rows[1:]:
            differ = table.model().values[row, column] != table.model().values[row - 1, column]
            assert (texts[row] != texts[row - 1], spoken[row] != spoken[row - 1]) == (differ, differ)
        width = table.fontMetrics().horizontalAdvance(max(texts, key=len))
        assert width < table.columnWidth(column)


@pytest.mark.parametrize(("far", "size"), FAR_AWAY)
def test_positions_of_neighbouring_pixels_look_different(opened, far, size):
    """With four digits the status line said “x 1e6” wherever the pointer was."""
    editor = opened(make_curve([(far + size * x, far + size * y) for x, y in WAVE], family=HERMITE))
    place = editor.window.findChild(QWidget, "pointerPlace")
    start = editor.window.canvas.to_pixel(*editor.point(1))
    texts = []
    for step in (0, 8, 16):
        editor.hover(editor.window.canvas.to_plane(start + QPoint(step, step)))
        editor.window.status_line.readouts.render()
        texts.append(re.split(r"\s+", place.text().replace("x ", "").replace("y ", "")))
    assert all(len(set(axis)) == 3 for axis in zip(*texts, strict=True)), texts
    editor.select([1])
    said = []
    for _ in range(2):
        QTest.keyClick(editor.window.canvas, Qt.Key.Key_Right)
        said.append(editor.status)
    assert len(set(said)) == 2


@pytest.mark.parametrize("start", [0.0, 1e6, 1.7e9])
def test_a_t_of_a_large_interval_has_the_digits_to_tell_it_apart(opened, start):
    """A single t near 1e6 had four digits: “t 1e6” at the rail, in the status line and in messages."""
    interval = Parametrization(start=start, end=start + 1)
    points = tuple(Point(x, y) for x, y in WAVE)
    editor = opened(Curve("Time", HERMITE, interval, points))
    readout = editor.window.findChild(QWidget, "pointerT")
    panel = editor.window.basis_panel
    texts = []
    for t in (start + 0.612, start + 0.615):
        editor.session.scrub.set(t)
        editor.settle()
        editor.window.status_line.readouts.render()
        assert readout.text() == f"t {t:.15g}"
        texts.append(panel.viewport().grab().toImage())
    assert texts[0] != texts[1]
    wanted = editor.parameters[1]
    refusal = editor.session.change(
        "t", lambda document: set_parameter(document, 0, 2, start, editor.parameters)
    ).refusal
    said = float(re.search(r"greater than ([0-9.]*[0-9])", refusal)[1])
    assert said == pytest.approx(wanted, abs=1e-3)
    editor.trigger("splitCurve")
    assert f"at t = {start + 0.615:.15g}:" in editor.status


@pytest.mark.parametrize(
    ("value", "step", "text"),
    [
        (1000000.25, 0.0, "1e6"),
        (1000000.25, 0.01, "1000000.25"),
        (-1000000.25, 0.25, "−1000000.2"),
        (12.4031, 0.01, "12.4"),
        (1e6, 1e-30, "1000000"),
        (0.0, 1e-6, "0"),
        (1e-9, 1.0, "0"),
        (1e-3, 1.0, "0.001"),
    ],
)
def test_a_number_has_the_digits_that_show_a_step(value, step, text):
    assert number(value, step=step) == text
