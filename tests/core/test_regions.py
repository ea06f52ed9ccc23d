"""Boolean operations on regions: against closed forms, winding numbers and sums of areas."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from curvecore import (
    CurveError,
    Region,
    WindingRule,
    difference,
    division,
    exclusion,
    intersection,
    simplified,
    union,
)

HANDLE = 4.0 / 3.0 * (math.sqrt(2.0) - 1.0)
CIRCLE = np.array([[[1, 0], [1, HANDLE], [HANDLE, 1], [0, 1]]])
CIRCLE = np.concatenate([CIRCLE @ np.array([[c, s], [-s, c]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))])
CIRCLE[:, 3] = np.roll(CIRCLE[:, 0], -1, axis=0)
OVAL = 4 * (HANDLE * 0.3 + 0.5 - 0.15 * HANDLE**2)  # the area of the four cubic arcs


def circle(x=0.0, y=0.0, radius=1.0):
    return Region([CIRCLE * radius + [x, y]])


def box(x, y, width=1.0, height=1.0):
    return Region.of_polygon([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def reversed_region(region):
    return Region([contour[::-1, ::-1] for contour in region.contours], region.rule)


def all_of(one, other):
    """The union, intersection, exclusion and difference of two regions."""
    return union([one, other]), intersection([one, other]), exclusion([one, other]), difference(one, [other])


def gap(contour):
    return np.abs(np.roll(contour[:, 0], -1, axis=0) - contour[:, 3]).max()


# What any operation keeps


def wild_regions(rng):
    """A region of one to three contours: loops, cusps, stars on a grid, circles, either way around."""
    contours = []
    for kind in rng.integers(0, 4, rng.integers(1, 4)):
        if kind == 0:
            points = rng.integers(0, 6, (rng.integers(3, 8), 2)).astype(float)
            contours += Region.of_polygon(points).contours
        elif kind == 3:
            contours.append(CIRCLE * rng.integers(1, 3) + rng.integers(0, 4, 2))
        else:
            count = rng.integers(1, 6)
            pieces = rng.normal(size=(count, 4, 2)) if kind == 1 else rng.integers(-3, 4, (count, 4, 2)) * 1.0
            pieces[:, 3] = np.roll(pieces[:, 0], -1, axis=0)
            contours.append(pieces)
    turned = [each[::-1, ::-1] if rng.random() < 0.5 else each for each in contours]
    return Region(turned, list(WindingRule)[rng.integers(2)])


@settings(max_examples=12)
@given(st.integers(0, 2**31))
def test_what_is_inside_of_the_outcome_is_what_the_operands_say(seed):
    """Of curves that cross themselves, touch on a grid and share parts, under either rule."""
    rng = np.random.default_rng(seed)
    one, other = wild_regions(rng), wild_regions(rng)
    if rng.random() < 0.3:
        other = Region([*one.contours[:1], *other.contours], other.rule)
    united, common, excluded, left = all_of(one, other)
    places = rng.uniform(-4.0, 7.0, (300, 2))
    a, b = one.contains(places), other.contains(places)
    for found, expected in ((united, a | b), (common, a & b), (excluded, a ^ b), (left, a & ~b)):
        assert (found.winding_numbers(places) == expected).all()
        assert all(gap(contour) == 0.0 for contour in found.contours)
    parts = division(one, [other])
    assert (sum(part.winding_numbers(places) for part in parts) == a).all()
    # What is left out, or off, is a strip of 1e-9 of the size, some 10, along the contours, of length 100.
    assert united.area + common.area == pytest.approx(simplified(one).area + simplified(other).area, abs=1e-5)
    assert united.area == pytest.approx(excluded.area + common.area, abs=1e-5)
    assert sum(part.area for part in parts) == pytest.approx(simplified(one).area, abs=1e-5)


@pytest.mark.parametrize("shift", [0.0, 1e6])
@pytest.mark.parametrize("size", [1e-6, 1.0, 1e9])
def test_any_size_far_from_the_origin(shift, size):
    """Circles of radius 1 at a distance of 1: (2 pi / 3 - sqrt(3) / 2), but for the 2.7e-4 of cubic arcs."""
    at = shift * size
    united, common, excluded, left = all_of(circle(at, at, size), circle(at + size, at, size))
    lens = (2.0 * math.pi / 3.0 - math.sqrt(3.0) / 2.0) * size**2
    assert common.area == pytest.approx(lens, rel=1e-3)
    assert united.area + common.area == pytest.approx(2.0 * math.pi * size**2, rel=1e-3)
    assert excluded.area == pytest.approx(2.0 * left.area, rel=1e-6)


# Control points


def test_what_is_not_cut_keeps_its_control_points():
    one, other = circle(), circle(1.0)
    found = union([one, other])
    own = {piece.tobytes() for piece in np.concatenate([*one.contours, *other.contours])}
    (contour,) = found.contours
    assert len(contour) == 8
    # The arcs through (1/2, +-sqrt(3)/2) are cut, two of each circle; the other four are as they were.
    assert sum(piece.tobytes() in own for piece in contour) == 4


def test_cut_pieces_are_parts_of_the_same_polynomial():
    """Third differences of a cubic scale with the cube of the length of the part."""
    found = intersection([circle(), circle(1.0)])
    third = np.diff(CIRCLE, n=3, axis=1)[:, 0]
    for piece in found.contours[0]:
        own = np.diff(piece, n=3, axis=0)[0]
        ratio = [np.dot(own, each) / np.dot(each, each) for each in (*third, *-third)]
        off = [np.abs(own - share * each).max() for share, each in zip(ratio, (*third, *-third), strict=True)]
        assert min(off) < 1e-13


def test_a_touch_cuts_nothing():
    """Where circles touch within an arc, as at an angle of 1 radian, no point is added."""
    angle = np.array([math.cos(1.0), math.sin(1.0)])
    turn = np.array([[0.8, 0.6], [-0.6, 0.8]])
    inner = Region([CIRCLE @ turn * 0.25 + 0.25 * angle])
    found = difference(circle(radius=2.0), [inner])
    assert sorted(map(len, found.contours)) == [4, 4]


# Degenerate cases, by name


def test_identical():
    one = circle()
    united, common, excluded, left = all_of(one, one)
    assert united.area == common.area == one.area
    assert [len(each.contours) for each in (united, common, excluded, left)] == [1, 1, 0, 0]


@pytest.mark.parametrize("other", [reversed_region(circle()), Region(np.roll(CIRCLE, 1, axis=0)[None])])
def test_identical_but_for_the_way_around_and_the_beginning(other):
    united, common, excluded, left = all_of(circle(), other)
    assert united.area == pytest.approx(circle().area, rel=1e-14)
    assert [len(each.contours) for each in (united, common, excluded, left)] == [1, 1, 0, 0]


def test_a_half_that_shares_its_arcs():
    upper = intersection([circle(), box(-3, 0, 6, 3)])
    assert upper.area == pytest.approx(circle().area / 2.0, rel=1e-14)
    assert not difference(upper, [circle()]).contours
    assert union([upper, circle()]).area == pytest.approx(circle().area, rel=1e-14)


def test_a_shared_edge():
    found = union([box(0, 0), box(1, 0)])
    assert found.area == pytest.approx(2.0, rel=1e-14)
    # What were corners lie on lines now; the point that a person had put on one of them stays.
    assert [len(contour) for contour in found.contours] == [4]
    with_more = Region.of_polygon([[0, 0], [0.4, 0], [1, 0], [1, 1], [0, 1]])
    assert (0.4, 0.0) in {tuple(each) for each in union([with_more, box(1, 0)]).contours[0][:, 0].tolist()}
    assert not intersection([box(0, 0), box(1, 0)]).contours
    assert difference(box(0, 0), [box(1, 0)]).area == pytest.approx(1.0, rel=1e-14)


def test_lines_of_any_pace_become_one():
    """As with handles that lie on the points: what is left of a cut one runs at another pace."""
    corners = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    lazy = np.stack([corners, corners, np.roll(corners, -1, axis=0), np.roll(corners, -1, axis=0)], axis=1)
    found = union([Region([lazy]), box(1, 0, 3, 2)])
    assert [len(contour) for contour in found.contours] == [4]
    assert found.area == pytest.approx(8.0, rel=1e-14)


def test_parts_of_edges_that_are_shared():
    """A step: the shorter edge lies on the longer one."""
    united, common, _, left = all_of(box(0, 0, 1, 3), box(1, 1, 1, 1))
    assert (round(united.area, 14), len(united.contours), len(united.contours[0])) == (4.0, 1, 8)
    assert not common.contours
    assert left.area == pytest.approx(3.0, rel=1e-14)


def test_a_vertex_on_an_edge():
    spike = Region.of_polygon([[1.0, 0.5], [2.0, 0.0], [2.0, 1.0]])
    united, common, _, _ = all_of(box(0, 0), spike)
    assert united.area == pytest.approx(1.5, rel=1e-14)
    assert [len(contour) for contour in united.contours] == [4, 3]
    assert not common.contours


def test_corners_that_touch():
    found = union([box(0, 0), box(1, 1)])
    assert [len(contour) for contour in found.contours] == [4, 4]
    assert found.area == pytest.approx(2.0, rel=1e-14)


def test_circles_that_touch_from_outside_and_from_inside():
    united, common, _, _ = all_of(circle(), circle(2.0))
    assert united.area == pytest.approx(2.0 * circle().area, rel=1e-14)
    assert not common.contours
    left = difference(circle(), [circle(0.5, 0.0, 0.5)])
    assert left.area == pytest.approx(0.75 * circle().area, rel=1e-14)


def test_a_line_that_touches_a_circle():
    found = union([circle(), box(-2, 1, 4, 1)])
    assert found.area == pytest.approx(4.0 + circle().area, rel=1e-14)


def test_circles_of_other_arcs():
    """Turned by half a radian they cross sixteen times, 1e-4 apart; the eight joints lie inside."""
    c, s = math.cos(0.5), math.sin(0.5)
    turned = Region([CIRCLE @ np.array([[c, s], [-s, c]])])
    united, common, _, _ = all_of(circle(), turned)
    assert [len(each.contours[0]) for each in (united, common)] == [16, 16 + 8]
    assert common.area < circle().area < united.area < math.pi * 1.001


def test_holes():
    ring = difference(circle(), [circle(0.0, 0.0, 0.5)])
    assert len(ring.contours) == 2
    assert ring.area == pytest.approx(0.75 * circle().area, rel=1e-14)
    assert not intersection([ring, circle(0.0, 0.0, 0.4)]).contours
    halves = division(ring, [box(-2, 0, 4, 2)])
    assert [part.area for part in halves] == pytest.approx([ring.area / 2.0] * 2, rel=1e-14)
    filled = union([ring, circle(0.0, 0.0, 0.5)])
    assert [len(contour) for contour in filled.contours] == [4]


def test_a_ring_divided_within_keeps_its_hole():
    """The part around and the part within: each with the contours that are its own."""
    parts = division(difference(box(0, 0, 9, 9), [box(4, 4)]), [box(2, 2, 5, 5)])
    assert [(len(part.contours), round(part.area, 12)) for part in parts] == [(2, 56.0), (2, 24.0)]


@pytest.mark.parametrize(("rule", "area"), [(WindingRule.NONZERO, 9.0), (WindingRule.EVEN_ODD, 8.0)])
def test_rules_say_what_is_inside(rule, area):
    both = Region([*box(0, 0, 3, 3).contours, *box(1, 1).contours], rule)
    assert simplified(both).area == pytest.approx(area, rel=1e-14)


def test_a_star_of_one_line():
    """The pentagram: nonzero has its middle, even-odd has not; s = sin 18 / sin 54 is the ratio of radii."""
    points = np.exp(2j * math.pi * np.arange(5) * 2 / 5)
    star = Region.of_polygon(np.stack((points.real, points.imag), axis=1))
    inner = math.sin(math.pi / 10.0) / math.sin(3.0 * math.pi / 10.0)
    outline = 5.0 * inner * math.sin(math.pi / 5.0)
    assert simplified(star).area == pytest.approx(outline, rel=1e-12)
    middle = 2.5 * inner**2 * math.sin(2.0 * math.pi / 5.0)
    even_odd = simplified(Region(star.contours, WindingRule.EVEN_ODD))
    assert even_odd.area == pytest.approx(outline - middle, rel=1e-12)
    assert len(even_odd.contours) == 5


def test_a_cubic_that_crosses_itself():
    """The loop of (t**2, t**3 - t) has the area 8/15, and lies in t from -1 to 1."""
    powers = np.array([[4.0, -6.0], [-16.0, 44.0], [16.0, -96.0], [0.0, 64.0]])
    controls = np.array([[1, 0, 0, 0], [1, 1 / 3, 0, 0], [1, 2 / 3, 1 / 3, 0], [1, 1, 1, 1]]) @ powers
    found = simplified(Region([[controls]]))
    loop = min(found.contours, key=len)
    assert Region([loop]).area == pytest.approx(8.0 / 15.0, rel=1e-12)


def test_specks_become_points():
    """Three pieces in a row of 1e-4 in all, between an arc and a line, whose direction stays."""
    arc = CIRCLE[0]
    ends = np.array(
        [arc[3], arc[3] + [-3e-5, 0], arc[3] + [-7e-5, 0], arc[3] + [-1e-4, 0], [-2.0, 1.0], arc[0]]
    )
    lines = [Region.of_polygon([a, b]).contours[0][0] for a, b in pairwise(ends)]
    region = Region([np.stack([arc, *lines])])
    (found,) = region.without_specks(1e-3).contours
    assert (len(found), gap(found)) == (3, 0.0)
    assert np.abs(found[0] - arc).max() < 2e-4
    assert found[1, 0].tolist() == ends[3].tolist()
    # The first is one, the second is longer than what is left then, the third is one.
    assert region.without_specks(5e-5).contours[0].shape == (4, 4, 2)
    assert region.without_specks(1e-6).contours[0].tolist() == region.contours[0].tolist()


def test_slivers():
    """A strip of 1e-7 is an area; one of 1e-12 is none."""
    assert difference(box(0, 0), [box(0, 0, 1 - 1e-7, 1)]).area == pytest.approx(1e-7, rel=1e-6)
    assert not difference(box(0, 0), [box(0, 0, 1 - 1e-12, 1)]).contours


def test_a_needle_that_goes_there_and_back_bounds_nothing():
    needle = Region.of_polygon([[0.0, 0.5], [2.0, 0.5]])
    assert union([box(0, 0), needle]).area == pytest.approx(1.0, rel=1e-14)
    assert not intersection([box(0, 0), needle]).contours


def test_open_contours_are_closed():
    assert Region([CIRCLE[:2]]).area == pytest.approx(circle().area / 2.0, rel=1e-14)


def test_nothing():
    nothing = Region([])
    assert union([nothing, circle()]).area == circle().area
    assert not intersection([nothing, circle()]).contours
    assert not union([]).contours
    assert nothing.contains([[0.0, 0.0]]).tolist() == [False]


def test_many_at_once():
    """A chain of a hundred circles, each of which crosses the next alone."""
    chain = [circle(1.5 * place) for place in range(100)]
    united = union(chain)
    lens = intersection(chain[:2]).area
    assert len(united.contours) == 1
    assert united.area == pytest.approx(100.0 * circle().area - 99.0 * lens, rel=1e-12)


def test_it_tells_how_far_it_is_and_can_be_stopped():
    told = []
    union([circle(), circle(1.0)], progress=told.append)
    assert told == sorted(told)
    assert 0.0 <= told[0] <= told[-1] <= 1.0

    def stop(_share):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        union([circle(), circle(1.0)], progress=stop)


@pytest.mark.parametrize(
    ("contour", "words"),
    [
        (np.zeros((0, 4, 2)), "must have the shape"),
        (np.zeros((2, 3, 2)), "must have the shape"),
        ([[[0, 0], [1, 0], [1, 1], [np.nan, 1]]], "finite"),
        (CIRCLE[[0, 2]], "must begin where"),
    ],
)
def test_what_is_no_contour(contour, words):
    with pytest.raises(CurveError, match=words):
        Region([contour])
