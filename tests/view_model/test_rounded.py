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
from app.view_model.curve.curve_view import view_of
from app.view_model.points.rounded import rounded
from app.view_model.points.straight import with_straight_segments

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


def turns(view, among=None):
    """The largest angle between directions before and after a point, of all or of some."""
    indices = sorted(range(len(view.source.points)) if among is None else among)
    before, after = (each[indices, 1] for each in view.sides)
    a, b = (each / np.hypot(*each.T)[:, None] for each in (before, after))
    return float(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).max())


def distances(places, line):
    """How far places are from a polyline, given by its points."""
    starts, ways = line[:-1], np.diff(line, axis=0)
    lengths = np.einsum("kd,kd->k", ways, ways)
    share = np.einsum("mkd,kd->mk", places[:, None] - starts, ways) / lengths
    near = starts + np.clip(share, 0, 1)[..., None] * ways
    return np.hypot(*np.moveaxis(places[:, None] - near, 2, 0)).min(axis=1)


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
def test_the_rest_of_the_curve_stays_as_it_was(rule):
    """A door: an arch by estimates above, straight below; corners where the arch begins are round, too."""
    door = polygon((0, 0), (4, 0), (4, 6), (3, 9), (1, 9), (0, 6), rule=rule)
    points = list(door.source.points)
    for index in (2, 5):
        side = {"velocity_after": None} if index == 2 else {"velocity": None}
        points[index] = replace(points[index], **side)
    for index in (3, 4):
        points[index] = replace(points[index].without_corner(), velocity=None)
    view = view_of(replace(door.source, points=tuple(points)))
    made = rounded(view, (0, 1), 1.0)
    assert (made.radii, made.left) == (pytest.approx((1.0, 1.0)), 0)
    old, new = places(view)[2:5], places(checked(made))[4:7]
    assert new == pytest.approx(old, abs=1e-12)
    # Of all: what is left of the segments that were beside corners is a part of these.
    after = checked(rounded(view, range(6), 0.1))
    old, new = places(view, 4001)[2:5], places(after, 21)[[5, 6, 7]]
    assert new[1] == pytest.approx(old[1][::200], abs=1e-12)
    for kept, whole in zip(new[[0, 2]], old[[0, 2]], strict=True):
        assert distances(kept, whole).max() < 1e-6
    assert turns(after) < 1e-9


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


def curved(*points, closed=True, family=HERMITE):
    """The view of corners with a velocity on each side: x, y, that of arrival and that of departure."""
    made = tuple(
        Point(float(x), float(y), velocity=before, velocity_after=after, corner=True)
        for x, y, before, after in points
    )
    kind = Parametrization(ParametrizationKind.UNIFORM, start=0.0, end=float(len(made) - (not closed)))
    return view_of(Curve("Curved", family, kind, made, closed=closed))


LEAF = ((0, 0, (-6.0, 3.0), (6.0, 3.0)), (10, 0, (6.0, -3.0), (-6.0, -3.0)))
HALF_MOON = ((0, 0, (0.0, -9.0), (6.0, 0.0)), (6, 0, (6.0, 0.0), (0.0, 9.0)))
BOWL = ((0, 0, (2.0, -9.0), (7.0, 4.0)), (8, 1, (6.0, -4.0), (-3.0, 9.0)))
DROP = ((0, 0, (0.0, 0.0), (0.0, 0.0)), (8, 3, (4.0, 9.0), (-7.0, 5.0)))
"""Two curved sides; a straight one and a curved; bent outwards; handles retracted into a corner."""


@pytest.mark.parametrize("radius", [1e-3, 0.2, 0.5])
@pytest.mark.parametrize("points", [LEAF, HALF_MOON, BOWL, DROP], ids=["leaf", "moon", "bowl", "drop"])
@pytest.mark.parametrize(
    "family", [each for each in FAMILIES if each.derivatives], ids=lambda family: family.name
)
def test_beside_curves_the_centre_of_an_arc_is_at_the_radius_from_both_sides(family, points, radius):
    view = curved(*points, family=family)
    made = rounded(view, [0], radius)
    after = checked(made)
    count = len(made.new)
    assert (made.radii, made.left, made.new) == ((radius,), 0, frozenset(range(count)))
    assert turns(after, made.new) < 1e-7
    lines = places(after)
    centre = centre_of(lines[0], radius)
    arc = lines[: count - 1].reshape(-1, 2)
    assert np.abs(np.hypot(*(arc - centre).T) / radius - 1).max() < WITHIN
    sides = places(view, 20001)
    for side in sides:
        # Chords of 5e-4 stay within 1e-8 of sides whose curvature there is 0.3 at most.
        assert distances(centre[None], side)[0] == pytest.approx(radius, rel=1e-6, abs=1e-8)
    # What is left of the sides is a part of them.
    rest = places(after, 20)[count - 1 :].reshape(-1, 2)
    assert distances(rest, np.concatenate(sides)[::5]).max() < 1e-6


def test_the_largest_arc_beside_curves_is_as_exact():
    """A half disc of a quarter ellipse each: the arc is asked for larger than anything that fits."""
    view = curved(*HALF_MOON)
    made = rounded(view, [0], 1e6)
    (largest,) = made.radii
    assert 0.5 < largest < 5
    assert rounded(view, [0], largest * 0.999).radii == (largest * 0.999,)
    assert rounded(view, [0], largest * 1.001).radii == (pytest.approx(largest, rel=1e-9),)
    after = checked(made)
    centre = centre_of(places(after)[0], largest)
    # It touches, and neither side is nearer anywhere.
    for side in places(view, 20001):
        assert distances(centre[None], side)[0] == pytest.approx(largest, rel=1e-6)
    both = rounded(view, [0, 1], 1e6)
    assert len(both.radii) == 2
    # Where they meet, up to 1e-5 of a side is left out.
    assert turns(checked(both), both.new) < 1e-5


def test_a_corner_whose_sides_cross_at_once_is_left():
    """They leave room for an arc of a hundredth of a thousandth of their length."""
    back = math.radians(179)
    blade = curved((0, 0, (9.0, 0.0), (math.cos(back), math.sin(back))), (-8, -5, (-9.0, 0.0), (0.0, 9.0)))
    assert (rounded(blade, [0], 1.0).radii, rounded(blade, [0], 1.0).left) == ((), 1)


def centre_of(line, radius):
    """The middle of the circle of a radius on which a line begins and ends, where it lies as near."""
    start, end = line[0], line[-1]
    half, middle = (end - start) / 2, (start + end) / 2
    away = math.sqrt(radius**2 - half @ half) * np.array([-half[1], half[0]]) / math.hypot(*half)
    return min((middle + away, middle - away), key=lambda c: abs(math.dist(c, line[len(line) // 2]) - radius))
