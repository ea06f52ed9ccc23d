"""Marks of handles that lie close together: each is seen, and can be grabbed."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from app.canvas.handle_marks import mark_sizes
from app.document.model import Document, make_curve
from app.families import FAMILIES


@pytest.mark.parametrize("count", [3, 20])
@pytest.mark.parametrize("family", ["hermite", "quintic_hermite", "septic_hermite"])
def test_marks_of_one_point_can_be_told_apart(editor, family, count):
    """Of 20 points under septic Hermite all three marks of a side lay over each other, 11 pixels wide."""
    points = [(float(k), 2.0 * math.sin(1.3 * k)) for k in range(count)]
    editor.session.commit(Document((make_curve(points, family=FAMILIES.named(family)),)), "Begin")
    editor.fit()
    editor.select_point(count // 2)
    shown, layer = editor.window.canvas.pixel_map, editor.window.canvas.drawing.points
    sizes = dict(zip(layer.handles, mark_sizes(layer.handles, shown, 1.0), strict=True))
    assert len(sizes) == 2 * editor.curve.family.derivatives
    for before, after in pairwise(layer.handles):
        if after.anchor == before.position:
            gap = math.dist(shown.point(*before.position), shown.point(*after.position))
            assert sizes[before] + sizes[after] < gap
            assert min(sizes[before], sizes[after]) >= 2.0
    if count == 3:
        assert all(size == (4.0, 5.5, 5.5)[each.kind - 1] for each, size in sizes.items())
    for each in layer.handles:
        editor.hover(each.position)
        assert f"{('velocity', 'acceleration', 'jerk')[each.kind - 1]}" in editor.status
