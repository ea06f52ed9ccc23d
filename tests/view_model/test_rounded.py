"""Rounded corners against the geometry of circles."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.curve_edits import replace_curve
from app.document.edits import EditError
from app.document.lines import is_line
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.curve_view import view_of
from app.view_model.rounded import rounded
from app.view_model.straight import with_straight_segments

BOX = ((0, 0), (100, 0), (100, 60), (0, 60))
WITHIN = 3e-4
"""Share of the radius: 2.73e-4 is the error of a cubic piece over a right angle (Goldapp 1991)."""


def polygon(*corners, closed=True, family=HERMITE, rule=ParametrizationKind.CHORD_LENGTH):
    """The view of straight lines from corner to corner."""
    points = [Point(float(x), float(y), t=float(i) ** 1.5) for i, (x, y) in enumerate(corners)]
    end = float(len(points)) ** 1.5 if closed else points[-1].t
    curve = Curve("Polygon", family, Parametrization(rule, start=0.0, end=end), tuple(points), closed=closed)
    view = view_of(curve)
    return view_of(with_straight_segments(view, range(len(view.parameters) - 1)))


def checked(made):
    """The view of what was made, whose numbers a document holds."""
    return view_of(replace_curve(Document((made.curve,)), 0, made.curve).curves[0])


def places(view, count=400):
    """Places along each segment, (k, count, 2)."""
    assert view.is_current
    t = view.parameters
    return np.array([view.curve.evaluate(np.linspace(a, b, count)) for a, b in pairwise(t)])


def turns(view):
    """The largest angle between directions before and after a point."""
    before, after = (each[: len(view.source.points), 1] for each in view.sides)
    a, b = (each / np.hypot(*each.T)[:, None] for each in (before, after))
    return float(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).max())


@pytest.mark.parametrize("rule", ParametrizationKind)
@pytest.mark.parametrize(
    "family", [each for each in FAMILIES if each.derivatives], ids=lambda family: family.name
)
def test_a_rectangle_gets_quarter_circles_that_go_on_from_its_sides(family, rule):
    made = rounded(polygon(*BOX, family=family, rule=rule), range(4), 5.0)
    view = checked(made)
    assert (made.radii, made.left, made.new) == ((5.0,) * 4, 0, frozenset(range(8)))
    assert [point.position for point in made.curve.points[:3]] == [(0, 5), (5, 0), (95, 0)]
    arcs, centres = places(view)[::2], np.array([(5, 5), (95, 5), (95, 55), (5, 55)])
    away = np.hypot(*np.moveaxis(arcs - centres[:, None], 2, 0)) / 5.0 - 1
    assert 2e-4 < np.abs(away).max() < WITHIN
    assert turns(view) < 1e-12
    assert all(is_line(made.curve, side) for side in (1, 3, 5, 7))
    assert all(point.tied for point in made.curve.points)


@pytest.mark.parametrize("degrees", [1, 30, 89, 90, 91, 120, 179])
def test_an_arc_of_any_turn_is_within_its_bound_of_the_circle(degrees):
    """Also to the right; up to a right angle there is one piece, beyond there are two."""
    turn = math.radians(-degrees)
    corner = ((-1e4, 0), (0, 0), (1e4 * math.cos(turn), 1e4 * math.sin(turn)))
    made = rounded(polygon(*corner, closed=False), [0, 1, 2], 7.0)
    view = checked(made)
    assert len(made.curve.points) == (4 if degrees <= 90 else 5)
    # The circle touches both sides.
    centre = (-7.0 * math.tan(-turn / 2), -7.0)
    arc = places(view)[1:-1].reshape(-1, 2)
    assert np.abs(np.hypot(*(arc - centre).T) / 7.0 - 1).max() < WITHIN
    assert turns(view) < 1e-9


def test_the_largest_arc_that_fits():
    """Half of the shorter side where both ends are round: the arcs meet there in one point."""
    made = rounded(polygon(*BOX), range(4), 1e6)
    assert (made.radii, len(made.curve.points)) == ((30.0,) * 4, 6)
    pill = places(checked(made))
    assert pill[..., 1].min() == pytest.approx(0.0, abs=1e-9)
    assert pill.reshape(-1, 2).max(axis=0) == pytest.approx([100, 60], abs=1e-9)
    # A square becomes a circle of four points, each smooth with one velocity.
    circle = rounded(polygon((0, 0), (2, 0), (2, 2), (0, 2)), range(4), 1.0)
    assert [point.corner for point in circle.curve.points] == [False] * 4
    assert np.abs(np.hypot(*(places(checked(circle)).reshape(-1, 2) - 1.0).T) - 1).max() < WITHIN
    # One corner alone takes the whole side; what it reaches stays where it is, a corner with one side round.
    for index in range(4):
        alone = rounded(polygon(*BOX), [index], 1e6)
        assert (alone.radii, len(alone.curve.points), len(alone.new)) == ((60.0,), 4, 1)
        assert {point.position for point in alone.curve.points} > {BOX[each] for each in range(4)} - {
            BOX[index],
            *(BOX[each % 4] for each in (index - 1, index + 1)),
        }
        assert turns(checked(alone)) == pytest.approx(1.0)
    # A small arc at the other end leaves more than half.
    mixed = rounded(polygon((0, 0), (10, 0), (10, 100), (-100, 130)), [1, 2], 9.0)
    assert mixed.radii == pytest.approx((9.0, 9.0))


@pytest.mark.parametrize("closed", [False, True])
def test_parameters_set_by_hand_go_on_ascending_over_their_interval(closed):
    view = polygon(*BOX, closed=closed, rule=ParametrizationKind.MANUAL)
    made = rounded(view, range(4), 6.0)
    after = checked(made)
    assert after.parameters[[0, -1]].tolist() == view.parameters[[0, -1]].tolist()
    assert (np.diff(after.parameters) > 0).all()
    assert len(made.radii) == (4 if closed else 2)


@pytest.mark.parametrize("rule", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.CHEBYSHEV])
def test_the_rest_of_the_curve_stays_and_corners_beside_curves_are_counted(rule):
    """A door: an arch by estimates above, straight below; corners where the arch begins are left."""
    door = polygon((0, 0), (4, 0), (4, 6), (3, 9), (1, 9), (0, 6), rule=rule)
    points = list(door.source.points)
    for index in (2, 5):
        side = {"velocity_after": None} if index == 2 else {"velocity": None}
        points[index] = replace(points[index], **side)
    for index in (3, 4):
        points[index] = replace(points[index].without_corner(), velocity=None)
    view = view_of(replace(door.source, points=tuple(points)))
    made = rounded(view, range(6), 1.0)
    assert (made.radii, made.left) == (pytest.approx((1.0, 1.0)), 2)
    old, new = places(view)[2:5], places(checked(made))[4:7]
    assert new == pytest.approx(old, abs=1e-12)


def test_nothing_is_made_of_what_has_no_corners():
    circle = rounded(polygon((0, 0), (2, 0), (2, 2), (0, 2)), range(4), 1.0).curve
    again = rounded(view_of(circle), range(4), 0.5)
    assert (again.curve, again.radii, again.left) == (circle, (), 0)
    straight = polygon((0, 0), (1, 0), (2, 0), (1, 0), closed=False)
    assert rounded(straight, range(4), 0.1).radii == ()
    with pytest.raises(EditError, match="has no segments of its own"):
        rounded(view_of(replace(circle, family=LAGRANGE)), range(4), 0.5)
    with pytest.raises(EditError, match="too small"):
        rounded(polygon(*BOX), range(4), 1e-30)
