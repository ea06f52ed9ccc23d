"""Boxes around strokes with their caps, joins and miters, and stretches that fill a box with them."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.several_curves import whole_curves
from app.document.style import LineCap, LineJoin, Style
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.boxes.bounds import BARE, Strokes, bounds_of
from app.view_model.boxes.stretch import stretched
from app.view_model.curve.curve_view import view_of

PRINTED = Strokes()
ROOT = math.sqrt(2.0)
STYLES = [Style(width=0.6, cap=cap, join=join) for cap, join in product(LineCap, LineJoin)]


def line_through(points, style, *, closed=False):
    """A document with straight lines between points."""
    curve = make_curve(points, family=HERMITE)
    corners = tuple(point.as_corner() for point in curve.points)
    return Document((replace(curve, points=corners, closed=closed, style=style),))


def box(document, strokes=PRINTED, *, as_drawn=False):
    views = [view_of(curve) for curve in document.curves]
    group = whole_curves(document, range(len(views)))
    bounds = bounds_of(views, group, strokes, as_drawn=as_drawn)
    return np.array([bounds.low, bounds.high])


@pytest.mark.parametrize("as_drawn", [False, True])
@pytest.mark.parametrize(
    ("cap", "expected"),
    [
        (LineCap.BUTT, [[0, -1], [10, 1]]),
        (LineCap.ROUND, [[-1, -1], [11, 1]]),
        (LineCap.SQUARE, [[-1, -1], [11, 1]]),
    ],
)
def test_caps_lengthen_a_level_line(cap, expected, as_drawn):
    document = line_through([(0, 0), (10, 0)], Style(width=2.0, cap=cap))
    assert box(document, as_drawn=as_drawn) == pytest.approx(np.array(expected), abs=1e-12)


def test_a_square_cap_of_a_slanting_line_reaches_farther_than_a_round_one():
    for cap, reach in ((LineCap.BUTT, ROOT / 2), (LineCap.ROUND, 1.0), (LineCap.SQUARE, ROOT)):
        document = line_through([(0, 0), (5, 5)], Style(width=2.0, cap=cap))
        assert box(document) == pytest.approx(np.array([[-reach, -reach], [5 + reach] * 2]), abs=1e-12)


@pytest.mark.parametrize("as_drawn", [False, True])
@pytest.mark.parametrize(
    ("join", "limit", "top"),
    [
        (LineJoin.MITER, 4.0, 5 + ROOT),
        (LineJoin.MITER, 1.4, 5 + ROOT / 2),
        (LineJoin.ROUND, 4.0, 6.0),
        (LineJoin.BEVEL, 4.0, 5 + ROOT / 2),
    ],
)
def test_joins_raise_the_top_of_a_roof(join, limit, top, as_drawn):
    style = Style(width=2.0, cap=LineCap.BUTT, join=join, miter_limit=limit)
    found = box(line_through([(0, 0), (5, 5), (10, 0)], style), as_drawn=as_drawn)
    assert found[1][1] == pytest.approx(top, abs=1e-12)
    closed = box(line_through([(5, 5), (10, 0), (0, 0)], style, closed=True), as_drawn=as_drawn)
    assert closed[1][1] == pytest.approx(top, abs=1e-12), "where a closed line begins there is a joint, too"


def test_what_has_no_width_of_its_own_and_what_is_not_drawn_has_no_stroke():
    for style in (Style(), Style(width=0.0), Style(width=3.0, stroke="none", fill="#102030")):
        document = line_through([(0, 0), (5, 5)], style)
        assert (box(document) == box(document, BARE)).all()


@pytest.mark.parametrize("style", STYLES, ids=lambda each: f"{each.cap.value} {each.join.value}")
@pytest.mark.parametrize("family", FAMILIES)
def test_no_place_beside_a_smooth_curve_lies_outside_and_some_lie_on_every_side(family, style):
    points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 1.0)]
    curve = replace(make_curve(points, family=family), style=style)
    found = box(Document((curve,)))
    core = view_of(curve).curve
    t = np.linspace(*core.domain, 40_001)
    velocities = core.evaluate(t, 1)
    ways = velocities / np.hypot(*velocities.T)[:, None]
    aside = 0.3 * np.column_stack([-ways[:, 1], ways[:, 0]])
    beside = np.vstack([core.evaluate(t) + aside, core.evaluate(t) - aside])
    low, high = found
    assert (beside >= low - 1e-9).all()
    assert (beside <= high + 1e-9).all()
    if style.cap is LineCap.BUTT and not view_of(curve).corners and family.curve_class.name != "cosine_blend":
        reached = np.array([beside.min(axis=0), beside.max(axis=0)])
        # Half a millionth beside an extreme with |c''| up to some 10³.
        assert reached == pytest.approx(found, abs=1e-5)


@pytest.mark.parametrize("scaled", [True, False])
@pytest.mark.parametrize("style", STYLES, ids=lambda each: f"{each.cap.value} {each.join.value}")
@pytest.mark.parametrize("family", [HERMITE, LAGRANGE])
def test_a_box_is_filled_with_the_stroke_exactly(family, style, scaled):
    """Also where widths grow by less than the curve, and caps and miters turn."""
    points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 1.0)]
    curves = [replace(make_curve(points, family=family), style=style)]
    curves.append(replace(curves[0], points=tuple(point.as_corner() for point in curves[0].points)))
    curves.append(make_curve([(2, 3), (3, 4)], family=family))
    document = Document(tuple(curves))
    views, group = [view_of(curve) for curve in curves], whole_curves(document, range(3))
    wanted = ((-1.0, 2.0), (4.5, 9.5))
    new = stretched(document, views, group, wanted, Strokes(scaled=scaled))
    assert box(new) == pytest.approx(np.array(wanted), abs=1e-11)
    assert (new.curves[0].style.width != 0.6) is scaled


def test_a_drag_needs_no_corrections_where_strokes_are_round():
    """What is found at once is exact: r² = (w − r m)(v − r n) / (b c), or w − m where strokes stay."""
    curve = replace(make_curve([(0, 0), (4, 3), (8, 1)], family=HERMITE), style=Style(width=3.0))
    curve = replace(curve, parametrization=Parametrization(kind=ParametrizationKind.UNIFORM))
    document = Document((curve,))
    views, group = [view_of(curve)], whole_curves(document, {0})
    for scaled in (True, False):
        wanted = ((10.0, -2.0), (-20.0, 11.0))
        new = stretched(document, views, group, wanted, Strokes(scaled=scaled), tolerance=100.0)
        assert box(new) == pytest.approx(np.array([[-20.0, -2.0], [10.0, 11.0]]), abs=1e-11)


def test_a_level_line_gets_longer_and_no_thicker_than_its_stroke_grows():
    document = line_through([(0, 0), (10, 0)], Style(width=2.0))
    views, group = [view_of(document.curves[0])], whole_curves(document, {0})
    new = stretched(document, views, group, ((-1, -1), (23, 1)), PRINTED, about=(-1.0, 0.0))
    (left, bottom), (right, top) = box(new)
    assert (left, right) == pytest.approx((-1.0, 23.0), abs=1e-12)
    width = new.curves[0].style.width
    assert width == pytest.approx(2.0 * math.sqrt((24.0 - width) / 10.0), abs=1e-12)
    assert (bottom, top) == pytest.approx((-width / 2, width / 2), abs=1e-12)


def test_a_box_too_small_for_strokes_that_stay_leaves_a_curve_that_can_grow_again():
    document = line_through([(0, 0), (5, 5), (10, 0)], Style(width=2.0))
    views, group = [view_of(document.curves[0])], whole_curves(document, {0})
    new = stretched(document, views, group, ((0, -1), (1.5, 6)), Strokes(scaled=False), tolerance=0.05)
    assert 0.01 < np.ptp([point.x for point in new.curves[0].points]) < 0.5
