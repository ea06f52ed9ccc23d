"""Many points leave the curve to be seen: discs and ticks have no more room than there is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.canvas.point_marks import RADIUS, discs_for, with_neighbours
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.features.basis.scene import spread_out


def row(count, gap):
    """Pixels of points in a row."""
    return np.column_stack([np.arange(count) * gap, np.zeros(count)]), np.arange(count)


@pytest.mark.parametrize("count", [2, 8, 60, 1000])
def test_discs_leave_half_of_the_curve_free(count):
    for gap in (4.0, 7.0, 10.0, 15.0):
        discs = discs_for(*row(count, gap), 1.0)
        assert discs.radius <= max(gap / 4, 1.25)
        assert discs.rim == 0
        assert not discs.crowded
    assert discs_for(*row(count, 18.5), 1.0).radius == RADIUS
    assert discs_for(*row(count, 18.5), 1.0).rim > 0


def test_closer_than_three_pixels_many_are_left_away_but_few_never():
    assert discs_for(*row(60, 2.5), 1.0).crowded
    assert not discs_for(*row(20, 2.5), 1.0).crowded
    assert not discs_for(*row(1, 1.0), 1.0).crowded


def test_one_close_pair_does_not_shrink_the_others():
    pixels, visible = row(6, 40.0)
    pixels[5] = pixels[4] + 2
    assert discs_for(pixels, visible, 1.0).radius == RADIUS


def test_neighbours_of_selected_points_are_drawn_unless_many_are_selected():
    among = np.arange(100)
    assert with_neighbours([0, 50], among).tolist() == [0, 1, 2, 48, 49, 50, 51, 52]
    assert with_neighbours(range(60), among).tolist() == []


def test_displayed_ticks_have_a_minimum_distance():
    x = np.cumsum(np.tile([0.3, 2.0, 9.0], 30))
    kept, gap = spread_out(x, np.arange(90), 4.0)
    assert np.diff(x[kept]).min() >= 4
    assert kept[0] == 0
    assert gap > 4
    everything, _ = spread_out(x * 100, np.arange(90), 4.0)
    assert everything.tolist() == list(range(90))
    assert spread_out(x, np.arange(1), 4.0)[1] == math.inf


@pytest.fixture
def wave(editor):
    """Sixty points on a wave, ten pixels apart."""
    points = [(0.1 * i, math.sin(0.1 * i)) for i in range(60)]
    editor.session.commit(Document((make_curve(points, family=HERMITE),)), "Begin")
    editor.fit()
    return editor


def ink_share(editor):
    """Between how many neighbours the middle of the curve is seen in its own colour."""
    image, canvas = editor.window.canvas.grab().toImage(), editor.window.canvas
    view = editor.session.active_view
    middles = view.curve.evaluate((view.parameters[1:] + view.parameters[:-1]) / 2)
    seen = []
    for x, y in middles.tolist():
        place = canvas.to_pixel(x, y)
        around = [image.pixelColor(place.x(), place.y() + dy) for dy in (-1, 0, 1)]
        seen.append(min(colour.lightness() for colour in around) < 60)
    return sum(seen) / len(seen)


def test_the_curve_is_visible_between_sixty_points(wave):
    wave.trigger("themeLight")
    canvas = wave.window.canvas
    far = math.dist(canvas.to_pixel(0, 0).toTuple(), canvas.to_pixel(0.1, 0.0998).toTuple())
    assert far < 16
    assert ink_share(wave) > 0.9
    assert canvas.drawing.points.note == ""


def test_of_a_ribbon_of_points_only_selected_ones_are_drawn_with_a_note(wave):
    canvas = wave.window.canvas
    canvas.camera.zoom(0.12, canvas.camera.centre())
    wave.settle()
    assert canvas.drawing.points.note == "60 points: selection only · zoom in to see all"
    wave.select([30])
    chosen = canvas.grab().toImage()
    wave.select([])
    assert canvas.grab().toImage() != chosen
    wave.fit()
    assert canvas.drawing.points.note == ""


def test_a_point_that_is_not_drawn_is_grabbed_all_the_same(wave):
    canvas = wave.window.canvas
    canvas.camera.zoom(0.12, canvas.camera.centre())
    wave.click(wave.point(59))
    assert wave.session.selection == {59}
    before = wave.point(59)
    wave.drag_point(59, to=(before[0] + 2, before[1] + 1))
    assert wave.point(59) == pytest.approx((before[0] + 2, before[1] + 1), abs=1.5 * wave.pixel)


def test_discs_shrink_after_points_came_together_without_another_event(wave):
    canvas = wave.window.canvas
    document = wave.session.document
    wave.session.commit(scaled(document, 0.1), "Shrink")
    wave.wait_for_rest()
    assert canvas.drawing.points.note.startswith("60 points")
    wave.session.undo_stack.undo()
    wave.wait_for_rest()
    assert canvas.drawing.points.note == ""


def scaled(document, factor):
    """The same points, closer together, seen at the same zoom."""
    points = [(factor * point.x, factor * point.y) for point in document.curves[0].points]
    return Document((make_curve(points, family=HERMITE),))
