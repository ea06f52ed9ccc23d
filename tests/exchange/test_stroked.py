"""Boxes around strokes with their caps, joins and miters."""

from __future__ import annotations

import math
from functools import cache
from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, make_curve
from app.document.style import LineCap, LineJoin, Style
from app.exchange.drawing.drawing import drawing_of
from app.exchange.drawing.outlines import painted_extent
from app.families import FAMILIES, HERMITE
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

ROOT = math.sqrt(2.0)
STYLES = [Style(width=0.6, cap=cap, join=join) for cap, join in product(LineCap, LineJoin)]


def line_through(points, style, *, closed=False):
    """A document with straight lines between points."""
    curve = make_curve(points, family=HERMITE)
    corners = tuple(point.as_corner() for point in curve.points)
    return Document((replace(curve, points=corners, closed=closed, style=style),))


def box(document):
    (outline,) = drawing_of(document).outlines
    return painted_extent(outline)


@pytest.mark.parametrize(
    ("cap", "expected"),
    [
        (LineCap.BUTT, [[0, -1], [10, 1]]),
        (LineCap.ROUND, [[-1, -1], [11, 1]]),
        (LineCap.SQUARE, [[-1, -1], [11, 1]]),
    ],
)
def test_caps_lengthen_a_level_line(cap, expected):
    document = line_through([(0, 0), (10, 0)], Style(width=2.0, cap=cap))
    assert box(document) == pytest.approx(np.array(expected), abs=1e-12)


def test_a_square_cap_of_a_slanting_line_reaches_farther_than_a_round_one():
    for cap, reach in ((LineCap.BUTT, ROOT / 2), (LineCap.ROUND, 1.0), (LineCap.SQUARE, ROOT)):
        document = line_through([(0, 0), (5, 5)], Style(width=2.0, cap=cap))
        assert box(document) == pytest.approx(np.array([[-reach, -reach], [5 + reach] * 2]), abs=1e-12)


@each_row(
    ("join", "limit", "top"),
    [
        (LineJoin.MITER, 4.0, 5 + ROOT),
        (LineJoin.MITER, 1.4, 5 + ROOT / 2),
        (LineJoin.ROUND, 4.0, 6.0),
        (LineJoin.BEVEL, 4.0, 5 + ROOT / 2),
    ],
)
def test_joins_raise_the_top_of_a_roof(join, limit, top):
    style = Style(width=2.0, cap=LineCap.BUTT, join=join, miter_limit=limit)
    found = box(line_through([(0, 0), (5, 5), (10, 0)], style))
    assert found[1][1] == pytest.approx(top, abs=1e-12)
    closed = box(line_through([(5, 5), (10, 0), (0, 0)], style, closed=True))
    assert closed[1][1] == pytest.approx(top, abs=1e-12), "where a closed line begins there is a joint, too"


def test_lines_without_a_width_add_nothing_to_the_box():
    for style in (Style(), Style(width=0.0), Style(width=3.0, stroke="none", fill="#102030")):
        document = line_through([(0, 0), (5, 5)], style)
        assert box(document).tolist() == [[0.0, 0.0], [5.0, 5.0]]


SMOOTH = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 1.0)]


@cache
def places_beside(family):
    """Return places on both sides of a curve through the points above, 0.3 away from it."""
    core = view_of(make_curve(SMOOTH, family=family)).curve
    t = np.linspace(*core.domain, 40_001)
    velocities = core.evaluate(t, 1)
    ways = velocities / np.hypot(*velocities.T)[:, None]
    aside = 0.3 * np.column_stack([-ways[:, 1], ways[:, 0]])
    at = core.evaluate(t)
    return np.vstack([at + aside, at - aside])


@each_row("style", STYLES, ids=lambda each: f"{each.cap.value} {each.join.value}")
@each_row("family", FAMILIES)
def test_the_extent_of_a_smooth_stroke_is_tight(family, style):
    curve = replace(make_curve(SMOOTH, family=family), style=style)
    drawing = drawing_of(Document((curve,)))
    found, off = painted_extent(drawing.outlines[0]), drawing.deviation
    beside = places_beside(family)
    low, high = found
    assert (beside >= low - off - 1e-9).all()
    assert (beside <= high + off + 1e-9).all()
    if style.cap is LineCap.BUTT and not view_of(curve).corners and family.curve_class.name != "cosine_blend":
        reached = np.array([beside.min(axis=0), beside.max(axis=0)])
        # Half a millionth beside an extreme with |c''| up to some 10³.
        assert reached == pytest.approx(found, abs=off + 1e-5)
