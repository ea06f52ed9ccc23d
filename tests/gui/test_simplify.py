"""Simplify: fewer points for whole curves, by the key of Inkscape; corners and straight lines stay."""

from __future__ import annotations

import numpy as np
import pytest

from app.exchange.svg.reader import read_svg
from app.view_model.curve.curve_view import view_of


def ellipse(count):
    """An ellipse about (50, 50) with radii 40 and 25, of straight lines."""
    angles = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    places = np.column_stack([50.0 + 40.0 * np.cos(angles), 50.0 + 25.0 * np.sin(angles)])
    return "M" + "L".join(f"{x:.4f},{y:.4f}" for x, y in places.tolist()) + "Z"


# The block has four corners, ten points, and one rounded side.
BLOCK = "M0 0H10H20H30V10V20H20H10H0C-2 17 -3 14 -3 10C-3 6 -2 3 0 0Z"


@pytest.fixture
def drawing(editor):
    def draw(*paths):
        text = "".join(f'<path d="{path}" fill="#0088ff"/>' for path in paths)
        svg = f'<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">{text}</svg>'
        document = read_svg(svg.encode(), None).document
        editor.session.commit(document, "Begin", active=0)
        editor.session.selected.select_whole(range(len(document.curves)))
        editor.fit()
        return editor

    return draw


def test_simplifying_keeps_the_shape_with_few_points(drawing):
    editor = drawing(ellipse(120))
    editor.trigger("simplify")
    editor.wait_for_work()
    (curve,) = editor.session.document.curves
    assert len(curve.points) <= 6
    x, y = view_of(curve).polyline.T
    # From the closed form: a twentieth of the limit is what 120 chords are off.
    off = np.abs(np.hypot((x - 50.0) / 40.0, (y + 50.0) / 25.0) - 1.0) * 25.0
    assert off.max() < 0.002 * 80.0 * 1.1
    assert f"120 points became {len(curve.points)}; nothing moved by more than" in editor.status
    assert editor.session.undo_stack.undoText().startswith("Simplify ")
    editor.trigger("undo")
    assert len(editor.session.document.curves[0].points) == 120


def test_corners_and_straight_lines_stay_to_the_last_digit(drawing):
    editor = drawing(BLOCK)
    before = editor.session.document.curves[0]
    editor.trigger("simplify")
    editor.wait_for_work()
    (curve,) = editor.session.document.curves
    places = {(point.x, point.y) for point in curve.points}
    assert {(0.0, 0.0), (30.0, 0.0), (30.0, -20.0), (0.0, -20.0)} <= places
    assert places <= {(point.x, point.y) for point in before.points}
    assert len(curve.points) < len(before.points) == 10
    low, high = view_of(curve).drawn_box
    assert (high[0], low[1], high[1]) == (30.0, -20.0, 0.0)
    assert low[0] == pytest.approx(-3.0, abs=0.002 * 33.0)


def test_curves_without_a_removable_point_stay_and_the_status_reports_the_reason(drawing):
    editor = drawing("M0 0H30V20H0Z")
    before = editor.session.document
    editor.trigger("simplify")
    editor.wait_for_work()
    assert editor.session.document is before
    assert editor.status == "None of the curves keeps its shape with fewer points."
    assert not before.curves[0].locked
