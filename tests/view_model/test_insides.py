"""Insides of outlines, compared with circles."""

from __future__ import annotations

import numpy as np

from app.document.style import FillRule
from app.view_model.geometry import fills_holes, is_inside, windings
from tests.effort import calls_of
from tests.rows import each_row


def circle(radius, x=0.0, way=1, count=64):
    angles = way * np.linspace(0.0, 2 * np.pi, count)
    return np.column_stack([x + radius * np.cos(angles), radius * np.sin(angles)])


def test_winding_numbers_count_the_circles_around_points():
    points = np.random.default_rng(13).uniform(-4, 4, (400, 2))
    outlines = [circle(3.0), circle(1.5, way=-1), circle(2.0, x=1.0)]
    away = [np.hypot(points[:, 0] - x, points[:, 1]) - radius for radius, x in ((3, 0), (1.5, 0), (2, 1))]
    # The polygons lie inside of their circles by 3 (1 - cos(pi / 63)) at most.
    clear = np.all(np.abs(away) > 4e-3, axis=0)
    expected = (away[0] < 0).astype(int) - (away[1] < 0) + (away[2] < 0)
    assert np.array_equal(windings(outlines, points)[clear], expected[clear])
    inside = is_inside(windings(outlines, points), FillRule.EVENODD)
    assert np.array_equal(inside[clear], (expected % 2 == 1)[clear])
    assert np.array_equal(
        is_inside(windings(outlines, points), FillRule.NONZERO)[clear], (expected != 0)[clear]
    )


@each_row(
    ("outlines", "expected"),
    [
        ([circle(3), circle(1)], True),
        ([circle(3), circle(1, way=-1)], False),
        ([circle(3, way=-1), circle(1, way=-1)], True),
        ([circle(3), circle(2, x=3)], False),
        ([circle(3), circle(1, x=9)], False),
        ([circle(3), circle(2, way=-1), circle(1)], False),
        ([circle(3), circle(2, way=-1), circle(1, way=-1)], False),
        ([circle(3)], False),
    ],
)
def test_holes_are_filled_where_both_outlines_have_one_direction(outlines, expected):
    assert fills_holes(outlines) is expected


def test_outlines_far_apart_are_not_compared():
    """Each was asked about all others: four minutes for two thousand that are combined."""
    side_by_side = [circle(1, x=3.0 * place) for place in range(200)]
    found = []
    assert calls_of(lambda: found.append(fills_holes(side_by_side))) < 60 * 200
    assert found == [False]
    assert fills_holes([*side_by_side, circle(0.5, x=300.0)])
