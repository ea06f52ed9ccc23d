"""Documents of versions whose rules estimated derivatives from the points alone: they keep their shape."""

from __future__ import annotations

import itertools
import json
import random

import numpy as np
import pytest
from msgspec.structs import replace

import curvecore
from app.document.constraints import tie
from app.document.derivatives import AccelerationRule, JerkRule, VelocityRule
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE
from app.storage.format import decode_counting, encode
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

HILLS = ((0, 0), (1, 2), (2.5, 1), (4, 3), (5, 0.5), (6.5, 2), (8, 0))
WITH_RULES = [family for family in FAMILIES if family.derivatives]


def of_version(version, *curves):
    """The content of a file of an older version that holds these curves."""
    values = json.loads(encode(Document(curves))) | {"version": version}
    return json.dumps(values).encode()


def estimate(rule, curve, points, t):
    data = (points, t) if "parameters" in rule.takes else (points,)
    further = {"alpha": curve.parametrization.alpha} if "alpha" in rule.takes else {}
    return getattr(curvecore, rule.function)(*data, **further)


def older_jets(curve):
    """The jets before and after each knot by the rules of version 3, which saw the points alone."""
    t, points = view_of(curve).parameters, np.array([point.position for point in curve.points], dtype=float)
    count, closed = len(points), curve.is_closed
    corners = [i for i, point in enumerate(curve.points) if point.corner and not point.tied]
    steps = np.diff(t)
    if closed:
        cuts = [*corners, corners[0] + count] if corners else [-70, count + 70]
    else:
        cuts = sorted({0, count - 1, *corners})
    sides = np.full((2, count, curve.family.derivatives, 2), np.nan)
    for start, end in itertools.pairwise(cuts):
        rows = np.arange(start, end + 1)
        piece_t = np.concatenate([[0.0], np.cumsum(steps[rows[:-1] % len(steps)])])
        for order, rule in enumerate(curve.rules):
            values = estimate(rule, curve, points[rows % count], piece_t)
            for row, value in zip(rows.tolist(), values, strict=True):
                inside = 0 <= row < count or (closed and corners)
                if inside and row != end:
                    sides[1, row % count, order] = value
                if inside and row != start:
                    sides[0, row % count, order] = value
    for index, point in enumerate(curve.points):
        for order in range(curve.family.derivatives):
            for side, given in enumerate(point.explicit_sides(order + 1)):
                if given is not None:
                    sides[side, index, order] = given
    return t, points, sides


def older_shape(curve, share):
    """The points of the curve of version 3 at these shares of each segment, by Hermite interpolation."""
    t, points, sides = older_jets(curve)
    count, shape = len(points), []
    make = curve.family.curve_class
    for segment in range(len(t) - 1):
        start, end = segment, (segment + 1) % count
        jets = [[points[start], *sides[1, start]], [points[end], *sides[0, end]]]
        piece = make(*(np.array(row) for row in zip(*jets, strict=True)), t[segment : segment + 2])
        shape.append(piece.evaluate(t[segment] + share * (t[segment + 1] - t[segment])))
    return np.array(shape)


def shape_of(curve, share):
    view = view_of(curve)
    t = view.parameters
    return np.array([view.curve.evaluate(a + share * (b - a)) for a, b in itertools.pairwise(t)])


def mixed_curve(family, rules, random_numbers, *, closed):
    """A curve with some velocities and accelerations set, a corner, a tie and estimates between them."""
    curve = make_curve(HILLS, family=family)
    curve = replace(curve, closed=closed, velocity_rule=rules[0], acceleration_rule=rules[1])
    curve = replace(curve, jerk_rule=random_numbers.choice(list(JerkRule)))
    kind = random_numbers.choice([ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM])
    curve = replace(curve, parametrization=replace(curve.parametrization, kind=kind))

    def vector():
        return (random_numbers.uniform(-9, 9), random_numbers.uniform(-9, 9))

    def some(count):
        return [vector() if random_numbers.random() < 0.4 else None for _ in range(count)]

    points = list(curve.points)
    for index in random_numbers.sample(range(7), 4):
        what = random_numbers.choice(["set", "corner", "tie"])
        if what == "set":
            points[index] = points[index].with_derivatives(some(family.derivatives), ())
        elif what == "corner":
            cornered = points[index].as_corner()
            points[index] = cornered.with_derivatives(some(family.derivatives), some(family.derivatives))
        elif closed or 0 < index < 6:
            points[index] = tie(points[index], vector(), vector())
    return replace(curve, points=tuple(points))


@each_row("family", WITH_RULES)
@pytest.mark.parametrize("closed", [False, True])
def test_curves_that_mix_set_and_estimated_derivatives_keep_their_shape(family, closed):
    numbers, share = random.Random(f"{family.name}{closed}"), np.linspace(0, 1, 9)
    for rules in itertools.product(VelocityRule, AccelerationRule):
        for _ in range(3):
            curve = mixed_curve(family, rules, numbers, closed=closed)
            was = older_shape(curve, share)
            opened = decode_counting(of_version(3, curve))
            (now,) = opened.document.curves
            # Estimates and sampling each round at the size of the derivatives times powers of h.
            assert shape_of(now, share) == pytest.approx(was, abs=1e-11 * (1 + np.abs(was).max()))
            changed = sum(a != b for a, b in zip(now.points, curve.points, strict=True))
            assert opened.left_out.points_set == changed
            again = decode_counting(encode(opened.document))
            assert (again.document, again.left_out.points_set) == (opened.document, 0)


@each_row("family", WITH_RULES)
def test_a_curve_without_set_derivatives_or_without_estimates_is_not_changed(family):
    plain = make_curve(HILLS, family=family)
    vectors = [(1.0, 2.0)] * family.derivatives
    full = replace(plain, points=tuple(point.with_derivatives(vectors, ()) for point in plain.points))
    opened = decode_counting(of_version(3, plain, replace(full, name="b")))
    assert [each.points for each in opened.document.curves] == [plain.points, full.points]
    assert not opened.left_out


def test_local_rules_estimate_what_they_did_and_nothing_is_set():
    curve = replace(make_curve(HILLS, family=HERMITE), velocity_rule=VelocityRule.BESSEL)
    points = (*curve.points[:3], replace(curve.points[3], velocity=(1.0, 2.0)), *curve.points[4:])
    opened = decode_counting(of_version(3, replace(curve, points=points)))
    assert opened.document.curves[0].points == points
    assert not opened.left_out
