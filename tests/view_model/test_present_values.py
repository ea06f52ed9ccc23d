"""Setting something to its present value: the curve stays, and under spline rules no other point is set."""

from __future__ import annotations

import itertools
import random

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.constraints import is_straight, tie
from app.document.curve_edits import set_closed
from app.document.derivatives import AccelerationRule, JerkRule, VelocityRule
from app.document.model import Document, ParametrizationKind, make_curve
from app.document.point_edits import explicit_points, set_derivative
from app.families import FAMILIES, HERMITE
from app.view_model.curve.curve_view import view_of
from app.view_model.join import joined
from app.view_model.point_kinds import with_corners, with_smooth_points, with_symmetric_points
from app.view_model.reshape import with_point_inserted
from app.view_model.split import split, without_segments
from tests.rows import each_row

WITH_RULES = [family for family in FAMILIES if family.derivatives]
COUNT = 9
ROUNDING = 1e-11
"""Of the size of a curve: a dozen times the share below which an estimate counts as the same."""


def random_curve(numbers, family, rules, *, closed, kinds=(ParametrizationKind.CHORD_LENGTH,)):
    """A curve of nine points: at up to three of them something is set, a corner, a tie or a velocity."""
    points = [(k + numbers.uniform(-0.3, 0.3), numbers.uniform(-2, 2)) for k in range(COUNT)]
    curve = replace(make_curve(points, family=family), **rules)
    kind = numbers.choice(kinds)
    curve = replace(curve, parametrization=replace(curve.parametrization, kind=kind))
    if closed:
        curve = set_closed(Document((curve,)), 0, closed=True).curves[0]
    view, held = view_of(curve), list(curve.points)
    for index in numbers.sample(range(1, COUNT - 1), numbers.randrange(4)):
        x, y = view.velocity_of(index)
        near = (x * numbers.uniform(0.5, 1.5), y + numbers.uniform(-5, 5))
        point, cornered = held[index], held[index].as_corner()
        held[index] = numbers.choice(
            [
                replace(point, velocity=near),
                replace(cornered, velocity=near, velocity_after=(x, -y)),
                tie(point, near, (2 * near[0], 2 * near[1])),
                cornered,
            ]
        )
    return replace(curve, points=tuple(held))


def sampled(curve, count=400):
    view = view_of(curve)
    return view.curve.evaluate(np.linspace(*view.parameters[[0, -1]], count))


def set_points(curve):
    return explicit_points(curve, range(len(curve.points)))


def with_present_derivatives(view, index):
    """What a handle that is pressed and let go where it was does at worst: every derivative as it is."""
    document = Document((view.source,))
    for order in range(1, view.source.family.derivatives + 1):
        for ahead in (False, True):
            vector = view.derivative_of(index, order, ahead=ahead)
            document = set_derivative(document, 0, index, order, vector, ahead=ahead)
    return document.curves[0]


PRESENT = {
    "corner": lambda view, index: with_corners(view, [index]),
    "handle": with_present_derivatives,
    "smooth": lambda view, index: with_smooth_points(view, [index]),
    "symmetric": lambda view, index: with_symmetric_points(view, [index]),
}
"""Changes of a point that leave the curve where the point is smooth already."""

KINDS = {"symmetric": (ParametrizationKind.UNIFORM,)}
"""Parameters under which a smooth point is one of the kind: handles are equal between equal segments."""

SPLINE = {
    "velocity_rule": VelocityRule.NATURAL_SPLINE,
    "acceleration_rule": AccelerationRule.NATURAL_SPLINE,
    "jerk_rule": JerkRule.NATURAL_SPLINE,
}


@each_row("family", WITH_RULES)
@pytest.mark.parametrize("what", PRESENT)
def test_under_the_spline_rules_only_the_point_itself_is_set(family, what):
    numbers = random.Random(f"{family.name} {what}")
    for closed in (False, True) * 12:
        kinds = KINDS.get(what, tuple(ParametrizationKind)[:2])
        curve = random_curve(numbers, family, SPLINE, closed=closed, kinds=kinds)
        index = numbers.randrange(1, COUNT - 1)
        if curve.points[index].corner and what in ("smooth", "symmetric"):
            continue
        changed = PRESENT[what](view_of(curve), index)
        scale = np.abs(sampled(curve)).max()
        assert sampled(changed) == pytest.approx(sampled(curve), abs=ROUNDING * scale), (what, index)
        assert set_points(changed) <= set_points(curve) | {index}, (what, index)


@each_row("family", WITH_RULES)
@pytest.mark.parametrize("what", ["corner", "smooth", "symmetric"])
def test_under_every_rule_the_curve_stays(family, what):
    """Under local rules some others are set: those beside what was set, and no others."""
    numbers = random.Random(f"{family.name} {what}")
    for velocity_rule, acceleration_rule in itertools.product(VelocityRule, AccelerationRule):
        rules = {"velocity_rule": velocity_rule, "acceleration_rule": acceleration_rule}
        for closed in (False, True):
            kinds = KINDS.get(what, tuple(ParametrizationKind)[:2])
            curve = random_curve(numbers, family, rules, closed=closed, kinds=kinds)
            index = numbers.randrange(1, COUNT - 1)
            if curve.points[index].corner and what != "corner":
                continue
            changed = PRESENT[what](view_of(curve), index)
            scale = np.abs(sampled(curve)).max()
            assert sampled(changed) == pytest.approx(sampled(curve), abs=ROUNDING * scale), (rules, index)


def in_parts(curve, parts):
    """Where parts are that go along a curve from its beginning, each sampled, and the curve there."""
    view = view_of(curve)
    start, end = view.parameters[[0, -1]]
    for part in map(view_of, parts):
        t = np.linspace(*part.parameters[[0, -1]], 100)
        yield part.curve.evaluate(t), view.curve.evaluate(np.where(t > end, t - (end - start), t))


@each_row("family", WITH_RULES)
@pytest.mark.parametrize("rule", VelocityRule)
def test_inserted_points_cuts_and_seams_keep_the_shape_and_few_others_are_set(family, rule):
    numbers = random.Random(f"{family.name} {rule.name}")
    acceleration_rule = AccelerationRule.NATURAL_SPLINE if rule.is_spline else AccelerationRule.ZERO
    rules = {"velocity_rule": rule, "acceleration_rule": acceleration_rule}
    for closed in (False, True) * 3:
        curve = random_curve(numbers, family, rules, closed=closed)
        view = view_of(curve)
        segment, at = numbers.randrange(2, COUNT - 2), numbers.randrange(3, COUNT - 3)
        t = float(view.parameters[segment : segment + 2] @ [0.6, 0.4])
        scale = np.abs(sampled(curve)).max()

        grown = with_point_inserted(view, t).curve
        ((new, old),) = in_parts(curve, [grown])
        assert new == pytest.approx(old, abs=ROUNDING * scale)

        for cut in (t, float(view.parameters[at])):
            parts = split(view, cut).curves
            for new, old in in_parts(curve, parts):
                assert new == pytest.approx(old, abs=ROUNDING * scale)
            if not closed:
                ((new, old),) = in_parts(curve, [joined(*map(view_of, parts)).curve])
                assert new == pytest.approx(old, abs=ROUNDING * scale)
        for new, old in in_parts(curve, without_segments(view, [segment]).curves):
            assert new == pytest.approx(old, abs=ROUNDING * scale)


@pytest.mark.parametrize("closed", [False, True])
def test_under_the_c2_spline_an_inserted_point_stays_estimated_and_a_cut_sets_its_ends_alone(closed):
    numbers = random.Random(7)
    for _ in range(20):
        curve = random_curve(numbers, HERMITE, SPLINE, closed=closed)
        view = view_of(curve)
        was = {curve.points[index].position for index in set_points(curve)}
        t = float(view.parameters[3:5] @ [0.3, 0.7])
        grown = with_point_inserted(view, t).curve
        straight = is_straight(curve, 3)
        assert {grown.points[index].position for index in set_points(grown)} <= was | (
            {grown.points[4].position} if straight else set()
        )
        for cut in (t, float(view.parameters[4])):
            parts = split(view, cut).curves
            ends = {tuple(view.curve.evaluate(cut))}
            for part in parts:
                now = {part.points[index].position for index in set_points(part)}
                assert all(min(np.hypot(*np.subtract(end, p)) for end in ends) < 1e-9 for p in now - was)


def test_a_long_curve_joined_to_one_of_another_rule_keeps_its_shape():
    """Nothing holds the estimates of a local rule under the spline: all are set, and not one by one."""
    waves = [[(x + k * 2999, np.sin(x / 7)) for x in range(3000)] for k in range(2)]
    first, second = (make_curve(wave, family=HERMITE) for wave in waves)
    second = replace(second, velocity_rule=VelocityRule.BESSEL)
    whole = joined(view_of(first), view_of(second))
    assert whole.keeps_shape
    assert len(set_points(whole.curve)) >= 2998
    assert not any(point.velocity for point in whole.curve.points[:2998])


def test_a_point_inserted_into_a_straight_curve_under_a_rule_stays_estimated():
    line = view_of(make_curve([(0.0, 0.0), (1.0, 2.0), (3.0, 6.0)], family=HERMITE))
    made = with_point_inserted(line, 0.6)
    assert made.keeps_shape
    assert not made.left_rule
    assert not made.curve.has_derivatives
