"""Basis functions and points too many to be drawn one by one."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtWidgets import QLabel

from app.appearance.theme import LIGHT
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.document.rule_edits import set_parameters
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE, Family
from app.features.basis.function_lines import FunctionDrawing, FunctionLines, drawing_of
from app.plotting.pixel_map import PixelMap
from app.plotting.stamps import cells_of
from app.testing import Editor
from app.view_model.basis import basis_view
from app.view_model.curve.curve_view import view_of
from curvecore.bezier.flatten import segment_distance

CHEBYSHEV, UNIFORM = ParametrizationKind.CHEBYSHEV, ParametrizationKind.UNIFORM
SHOWN = PixelMap.of_ranges((-0.05, 1.05), (-0.6, 1.3), 880, 200)


def wave(n: int, family: Family, *, closed: bool = False) -> Curve:
    kind = CHEBYSHEV if family is LAGRANGE else UNIFORM
    s = np.linspace(0, 1, n)
    points = tuple(Point(float(4 * x), float(np.sin(9 * x))) for x in s)
    return Curve("Wave", family, Parametrization(kind), points, closed=closed)


def test_functions_beyond_all_pixels_are_drawn_without_a_warning():
    """Of 2000 points, 1.1e306 times 105 pixels was an overflow, told in a drag."""
    view = view_of(
        Curve("Steep", LAGRANGE, Parametrization(UNIFORM), tuple(Point(float(x), 0.0) for x in range(1045)))
    )
    basis = basis_view(view)
    assert np.abs(basis.envelope(0)).max() > 1e304
    lines = FunctionLines(basis, PixelMap.of_ranges((-0.05, 1.05), (-0.0006, 0.0013), 880, 200))
    for polygon in (lines.edge(0, upper=True), lines.edge(0, upper=False), lines.function(3, 0)):
        heights = [polygon[k].y() for k in range(polygon.size())]
        assert np.isfinite(heights).all()
        assert np.abs(heights).max() == 1e4


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize(
    ("n", "family", "way"),
    [
        (20, LAGRANGE, FunctionDrawing.EACH),
        (65, LAGRANGE, FunctionDrawing.ENVELOPE),
        (600, LAGRANGE, FunctionDrawing.ENVELOPE),
        (60, HERMITE, FunctionDrawing.EACH),
        (80, QUINTIC_HERMITE, FunctionDrawing.SPANS),
        (500, HERMITE, FunctionDrawing.ENVELOPE),
    ],
)
def test_the_drawing_follows_the_number_of_functions_and_the_envelope_contains_all(n, family, way, closed):
    basis = basis_view(view_of(wave(n, family, closed=closed)))
    assert drawing_of(basis) is way
    assert basis.point_count == n
    for kind in range(basis.kinds):
        t, low, high = basis.envelope(kind)
        at = basis.t[:: max(len(basis.t) // 97, 1)]
        every = basis.curve.basis(at)[:, :, kind] * basis.scales[:, kind]
        # To a sample: between two of them the envelope is a straight line.
        assert (every.max(axis=1) <= np.interp(at, t, high) + 0.02 * np.abs(every).max()).all()
        assert (every.min(axis=1) >= np.interp(at, t, low) - 0.02 * np.abs(every).max()).all()


@pytest.mark.parametrize("index", [0, 1, 250, 498, 499])
def test_one_function_among_many_is_sampled_finely(index):
    basis = basis_view(view_of(wave(500, QUINTIC_HERMITE)))
    for kind in range(3):
        t, values = basis.function(index, kind)
        assert len(t) >= 33
        exact = basis.curve.basis(t)[:, index, kind] * basis.scales[index, kind]
        # A joint belongs to the segment after it, where a function of two segments before is zero.
        assert values == pytest.approx(exact, abs=1e-12)


def test_the_spans_are_the_functions():
    basis = basis_view(view_of(wave(80, HERMITE)))
    lines = FunctionLines(basis, SHOWN)
    assert len(lines.spans(0)._shapes) == 2 * (len(basis.t) - (basis.count - 1))


@pytest.fixture
def open_wave(editor):
    def open_wave(n: int, family: Family) -> Editor:
        editor.session.commit(Document((wave(n, family),)), "Open")
        editor.fit()
        return editor

    return open_wave


def distance_from(chords, points):
    """Return how far the worst of some points is from the nearest of chords (m, 4)."""
    away = segment_distance(points[:, None], chords[None, :, :2], chords[None, :, 2:])
    return away.min(axis=1).max()


def exact_pixels(basis, shown, knot, kind):
    """Return points of a function in pixels where it is not zero, close together."""
    reach = basis.curve.parameters[[max(knot - 1, 0), min(knot + 1, basis.count - 1)]]
    t = np.linspace(*reach, 301)
    values = basis.curve.basis(t)[:, knot, kind] * basis.scales[knot, kind]
    return np.column_stack([shown.x(t), shown.y(values)])


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
def test_wide_functions_among_many_narrow_ones_are_smooth(open_wave, family):
    """Two pieces of two hundred took a fifth of the panel, with eight chords each: 0.8 pixels off."""
    editor = open_wave(200, family)
    points = tuple(Point(4.0 * k / 199, 0.0) for k in range(200))
    editor.session.commit(Document((Curve("Line", family, Parametrization(), points),)), "Open")
    editor.drag_point(99, to=(editor.point(99)[0], 0.5))
    assert editor.parameters[98:101:2] == pytest.approx([0.4, 0.6], abs=0.01)
    editor.screenshot()
    panel = editor.window.basis_panel
    basis, shown, lines = panel.drawing.basis, panel.pixel_map, panel.drawing.functions._lines
    assert lines.are_of(basis, shown)
    assert drawing_of(basis) is FunctionDrawing.SPANS
    # Of a quintic needle three pixels wide, eight chords cut off the tip.
    narrow = (0, 50, 97, 101, 199) if family is HERMITE else ()
    for kind in range(basis.kinds):
        spans = lines.spans(kind)._shapes.ndarray()
        spans = spans[(spans[:, 2] > shown.x(0.35)) & (spans[:, 0] < shown.x(0.65))]
        for knot in (*narrow, 98, 99, 100):
            exact = exact_pixels(basis, shown, knot, kind)
            points = np.array([(p.x(), p.y()) for p in lines.function(knot, kind)])
            assert distance_from(np.column_stack([points[:-1], points[1:]]), exact) < 0.5
            if knot not in narrow:
                assert distance_from(spans, exact) < 0.5


def test_a_curve_with_equal_pieces_is_drawn_with_its_samples_only():
    """Chords are added where a piece is wide only: a drag of many points must stay as fast as it is."""
    for n in (70, 200, 390):
        for family in (HERMITE, QUINTIC_HERMITE):
            basis = basis_view(view_of(wave(n, family)))
            chords = len(FunctionLines(basis, SHOWN).spans(0)._shapes)
            assert chords == 2 * (len(basis.t) - (basis.count - 1))


@pytest.mark.parametrize("family", [LAGRANGE, HERMITE])
def test_the_pane_has_a_note_on_functions_that_are_not_drawn(open_wave, family):
    editor = open_wave(450, family)
    note = editor.window.findChild(QLabel, "basisDrawing")
    assert "450 functions: envelope + selection" in note.text()
    editor.select([200])
    assert not editor.screenshot().isNull()


def test_a_point_among_very_many_is_hit_dragged_and_restored(open_wave):
    editor = open_wave(2000, HERMITE)
    before, place = editor.session.document, editor.point(1000)
    editor.press(place)
    editor.move((place[0], place[1] + 0.5))
    assert editor.session.document != before
    editor.escape()
    assert editor.session.document == before
    editor.release(place)


def test_many_points_share_colours_and_neighbours_still_differ():
    cells = cells_of(np.arange(10_000), 10_000)
    assert cells.max() < 256
    assert (np.diff(cells) != 0).all()
    assert (cells_of(np.arange(256), 256) == np.arange(256)).all()


def test_stamped_points_are_visible(open_wave):
    editor = open_wave(300, HERMITE)
    image = editor.window.canvas.grab().toImage()
    pixel = editor.window.canvas.to_pixel(*editor.point(150))
    offset = editor.window.canvas.viewport().mapTo(editor.window.canvas, pixel)
    ratio = image.devicePixelRatio()
    colour = image.pixelColor(round(offset.x() * ratio), round(offset.y() * ratio))
    assert colour.name() not in (LIGHT.paper.name(), LIGHT.curve.name())


def test_an_envelope_beyond_the_edge_of_the_panel_is_empty():
    """It raised: nothing can be written to the array of a polygon without points."""
    basis = basis_view(view_of(wave(65, LAGRANGE)))
    lines = FunctionLines(basis, PixelMap.of_ranges((5.0, 6.0), (-0.6, 1.3), 880, 200))
    assert len(lines.edge(0, upper=True)) == 0


def test_functions_at_the_edge_of_the_range_stay_finite_when_a_tick_moves():
    """Infinite on 1100 equal parameters: those from before the move were at the edge of the range."""
    points = tuple(Point(float(i), float(i % 3)) for i in range(1100))
    document = Document((Curve("Comb", LAGRANGE, Parametrization(UNIFORM), points),))
    view = view_of(document.curves[0])
    before = basis_view(view)
    parameters = view.parameters.tolist()
    parameters[550] += 3e-4
    after = view_of(set_parameters(document, 0, parameters).curves[0])
    values = basis_view(after, before).values
    assert np.isfinite(values).all()
    assert np.array_equal(values, basis_view(after).values)


def test_a_single_tick_among_many_is_drawn_as_large_as_ticks_get(open_wave):
    """Zoomed far out, all lie in one place: the gap to the next was infinite, and its half no number."""
    editor = open_wave(65, HERMITE)
    panel = editor.window.basis_panel
    panel.camera.zoom(1e-5, QPointF(panel.camera.centre()))
    image = panel.grab().toImage()
    place = panel.rail_pixel(0.5).toPoint()
    assert image.pixelColor(place) != image.pixelColor(place.x() + 60, place.y())
