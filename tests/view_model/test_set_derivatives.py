"""What is set is given to the rules: at corners, ties and smooth points, of open and closed curves."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from msgspec.structs import replace

import curvecore
from app.document.derivatives import DERIVATIVES, AccelerationRule, JerkRule, VelocityRule
from app.document.model import Curve, Parametrization, ParametrizationKind, Point, make_curve
from app.families import FAMILIES, HERMITE
from app.view_model.analysis.wiggle import explain
from app.view_model.basis import set_weights_at
from app.view_model.bend import Bend, BendWith
from app.view_model.curve.core_curve import SetDerivative
from app.view_model.curve.curve_view import view_of
from tests import exact_rules
from tests.effort import noted_calls
from tests.rows import each_row

WITH_DERIVATIVES = [family for family in FAMILIES if family.derivatives]
SMOOTH, CORNER, TIED = {}, {"corner": True}, {"corner": True, "tied": True}
FREE = {"corner": False, "tied": False, "velocity": None, "velocity_after": None}


@pytest.fixture
def rng():
    return np.random.default_rng(34)


def vector(rng):
    return tuple(rng.uniform(-2.0, 2.0, 2).tolist())


def derivatives_set(rng, share, *, corner):
    """Some derivatives of a point, on both sides of a corner."""
    names = [row.name for row in DERIVATIVES] + [row.after for row in DERIVATIVES if corner]
    return {name: vector(rng) for name in names if rng.random() < share}


def random_curve(rng, family, count, *, closed, rule=VelocityRule.NATURAL_SPLINE, share=0.3, **rules):
    """Points of all kinds, some of whose derivatives are set, at manual parameters."""
    t = np.cumsum(rng.uniform(0.2, 2.0, count + 1)).tolist()
    points = []
    for at in t[:-1]:
        kind = [SMOOTH, SMOOTH, CORNER, TIED][rng.integers(4)]
        given = kind | derivatives_set(rng, share, corner="corner" in kind)
        if "tied" in kind:
            given["velocity"] = vector(rng)
            given["velocity_after"] = tuple(2.5 * each for each in given["velocity"])
        points.append(Point(*vector(rng), t=at, **given))
    manual = Parametrization(ParametrizationKind.MANUAL, end=t[-1])
    return Curve("Any", family, manual, tuple(points), closed=closed, velocity_rule=rule, **rules)


def set_to_present(rng, curve, sides, share):
    """The curve with some of its estimates set to what they are."""
    points = []
    for index, point in enumerate(curve.points):
        present = {}
        for row in DERIVATIVES[: curve.family.derivatives]:
            for side, name in enumerate((row.name, row.after)[: 1 + point.corner]):
                if getattr(point, name) is None and rng.random() < share:
                    present[name] = tuple(sides[side][index, row.order].tolist())
        points.append(replace(point, **present))
    return replace(curve, points=tuple(points))


@each_row("family", WITH_DERIVATIVES)
@each_row("closed", [False, True])
@each_row("rule", VelocityRule)
@each_row("others", [{}, {"acceleration_rule": AccelerationRule.ZERO}, {"jerk_rule": JerkRule.ZERO}])
def test_setting_estimates_to_what_they_are_changes_nothing(rng, family, closed, rule, others):
    """One, many or all, on one side or both, beside others that are set: of all families and rules."""
    for count in (2, 3, 4, 5, 8, 60):
        curve = random_curve(rng, family, count, closed=closed, rule=rule, **others)
        before = view_of(curve).sides
        for share in (0.1, 0.5, 1.0):
            after = view_of(set_to_present(rng, curve, before, share)).sides
            for order in range(1, family.derivatives + 1):
                was, now = (np.array(sides)[:, :, order] for sides in (before, after))
                # A few roundings of the slopes, which a short segment of 1/5 multiplies by 5 to the order.
                assert np.abs(now - was).max() <= 1e-13 * max(1.0, np.abs(was).max())


@each_row("closed", [False, True])
@each_row("family", WITH_DERIVATIVES)
def test_derivatives_are_linear_in_points_and_what_is_set(rng, family, closed):
    """d_r = E_r p + F_r s: twice one curve and three times another is the curve of these sums."""
    first = random_curve(rng, family, 7, closed=closed)

    def scaled(factor, more=None):
        points = []
        for index, point in enumerate(first.points):
            values = {name: getattr(point, name) for row in DERIVATIVES for name in (row.name, row.after)}
            changed = {"x": factor * point.x, "y": factor * point.y}
            changed |= {
                name: tuple(factor * each for each in value) for name, value in values.items() if value
            }
            if more:
                other = more.points[index]
                changed = {
                    name: tuple(np.add(value, np.multiply(3.0, getattr(other, name))).tolist())
                    if isinstance(value, tuple)
                    else value + 3.0 * getattr(other, name)
                    for name, value in changed.items()
                }
            points.append(replace(point, **changed))
        return replace(first, points=tuple(points))

    second = replace(
        first,
        points=tuple(
            replace(
                point,
                x=float(rng.uniform()),
                **{
                    name: vector(rng)
                    for row in DERIVATIVES
                    for name in (row.name, row.after)
                    if getattr(point, name)
                },
            )
            for point in first.points
        ),
    )
    sums = np.array(view_of(scaled(2.0, second)).sides)
    parts = 2.0 * np.array(view_of(first).sides) + 3.0 * np.array(view_of(second).sides)
    assert sums == pytest.approx(parts, abs=1e-12 * np.abs(parts).max())


@each_row("closed", [False, True])
@each_row("count", [3, 6, 40])
def test_the_acceleration_is_continuous_wherever_nothing_is_set(rng, count, closed):
    """Its jumps at the joints in exact fractions of the jets; at free corners it is 0 on each side."""
    checked = 0
    for _ in range(10):
        curve = random_curve(rng, HERMITE, count, closed=closed)
        view = view_of(curve)
        before, after = view.sides
        t = [Fraction(each) for each in view.parameters.tolist()]
        h = [float(end - start) for start, end in pairwise(t)]
        bends = []
        for j in range(len(h)):
            p, q, u, w = (
                [Fraction(each) for each in jets.tolist()]
                for jets in (after[j, 0], before[j + 1, 0], after[j, 1], before[j + 1, 1])
            )
            sides = [
                exact_rules.bends_beside([p[axis], q[axis]], t[j : j + 2], [u[axis], w[axis]])
                for axis in (0, 1)
            ]
            bends.append([(side[1][0], side[0][1]) for side in sides])
        size = max(np.abs(before[:, 1]).max(), np.abs(after[:, 1]).max())
        bound = 1e-14 * size / min(h)
        for index, point in enumerate(curve.points):
            if not closed and index in (0, count - 1):
                continue
            left, right = (bends[index - 1], bends[index])
            if point.velocity is None and not point.corner:
                checked += 1
                assert all(abs(float(left[axis][1] - right[axis][0])) <= bound for axis in (0, 1))
            elif not point.tied:
                if point.velocity is None:
                    assert all(abs(float(left[axis][1])) <= bound for axis in (0, 1))
                if point.corner and point.velocity_after is None:
                    assert all(abs(float(right[axis][0])) <= bound for axis in (0, 1))
    assert checked >= 2


def test_tied_velocities_of_a_local_rule_let_it_through(rng):
    """Inside, it looks at the points alone: also at those beyond a smooth point whose velocities are set."""
    smooth = random_curve(rng, HERMITE, 8, closed=False, rule=VelocityRule.AKIMA, share=0.0)
    smooth = replace(smooth, points=tuple(replace(point, **FREE) for point in smooth.points))
    points = list(smooth.points)
    points[3] = replace(points[3], corner=True, tied=True, velocity=(1.0, 3.0), velocity_after=(2.0, 6.0))
    before, after = view_of(replace(smooth, points=tuple(points))).sides
    others = np.arange(8) != 3
    assert (before[others] == view_of(smooth).sides.before[others]).all()
    assert before[3, 1].tolist() == [1.0, 3.0]
    assert after[3, 1].tolist() == [2.0, 6.0]


@each_row("family", WITH_DERIVATIVES)
@each_row("using", BendWith)
def test_a_bend_lands_where_it_is_pulled_to(rng, family, using):
    """The estimates of neighbours follow the derivatives that it sets; its own segment has these alone."""
    for closed in (False, True):
        curve = random_curve(rng, family, 7, closed=closed, share=0.1)
        view = view_of(curve)
        t = float(view.parameters[3:5].mean())
        target = view.curve.evaluate(t) + np.array([0.2, -0.1])
        bent = view_of(Bend(view, t, using).bent(tuple(target.tolist()), 1e-12))
        assert bent.curve.evaluate(t) == pytest.approx(target, abs=1e-12)


def test_a_wiggle_is_explained_by_a_velocity_that_is_set_far_away():
    """Only velocities at both ends of the segment were told, for no others had an effect."""
    curve = make_curve([(float(x), 0.0) for x in range(6)], family=HERMITE)
    points = list(curve.points)
    points[4] = replace(points[4], velocity=(0.0, 50.0))
    view = view_of(replace(curve, points=tuple(points)))
    t = float(view.parameters[2:4].mean())
    explanation = explain(view, t)
    (pull,) = [pull for pull in explanation.pulls if pull.order == 1]
    # The other points do not lift the curve off its line, of segments of length 1.
    assert pull.point == 4
    assert pull.weight == pytest.approx(abs(view.curve.evaluate(t)[1]), abs=1e-12)
    assert "the velocity set at point 4 moves the curve by" in explanation.sentences[1]


def test_corners_of_a_spline_take_one_system(monkeypatch, rng):
    """A drawing of 3,000 corners of which some sides are free: one call, not one from corner to corner."""
    calls = noted_calls(monkeypatch, curvecore, "natural_spline_velocities")
    positions = rng.uniform(-1.0, 1.0, (3000, 2)).tolist()
    points = tuple(Point(x, y, corner=True, velocity=(1.0, 0.0)) for x, y in positions)
    assert view_of(Curve("Many", HERMITE, Parametrization(), points)).is_current
    assert len(calls) == 1


@each_row("closed", [False, True])
@each_row("rule", VelocityRule)
@each_row("family", WITH_DERIVATIVES)
def test_the_weight_of_what_is_set_has_the_estimates_that_follow_it(rng, family, rule, closed):
    """Each derivative that is set is changed in turn; those without a weight change nothing there."""
    for count in (3, 7):
        curve = random_curve(rng, family, count, closed=closed, rule=rule)
        view = view_of(curve)
        t = float(rng.uniform(*view.curve.domain))
        weights = set_weights_at(view, t)
        for index, point in enumerate(curve.points):
            for row in DERIVATIVES[: family.derivatives]:
                for ahead, name in enumerate((row.name, row.after)[: 1 + point.corner]):
                    value = getattr(point, name)
                    if value is None:
                        continue
                    changed = replace(point, **{name: (value[0] + 1.0, value[1])})
                    points = (*curve.points[:index], changed, *curve.points[index + 1 :])
                    away = view_of(replace(curve, points=points)).curve.evaluate(t) - view.curve.evaluate(t)
                    weight = weights.get(SetDerivative(index, row.order, bool(ahead)), 0.0)
                    assert away == pytest.approx([weight, 0.0], abs=1e-12)
