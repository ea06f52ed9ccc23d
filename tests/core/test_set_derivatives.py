"""Derivatives that are set are conditions of the rules: by exact fractions, and against SciPy."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from curvecore import (
    CurveError,
    bessel_velocities,
    catmull_rom_velocities,
    natural_spline_accelerations,
    natural_spline_jerks,
    natural_spline_velocities,
    uniform,
)
from tests import exact_rules
from tests.rows import each_row

NAN = np.nan
SPLINES = [natural_spline_velocities, natural_spline_accelerations, natural_spline_jerks]


def whole_numbers(rng, n):
    """Points and parameters in eighths, so that exact answers exist."""
    t = np.cumsum(rng.integers(1, 17, n)) / 8.0
    return rng.integers(-40, 41, n) / 8.0, t


def fractions(values):
    return [Fraction(float(value)) for value in values]


def rows(count, given):
    """Velocities of one coordinate that are set, by their joints, as an argument."""
    result = np.full((count, 1), NAN)
    for joint, value in given.items():
        result[joint] = float(value)
    return result


def conditions(rng, n):
    """Velocities at some joints: none, one, both ends, any, all."""
    joints = [[], [0], [n - 1], [0, n - 1], [n // 2], rng.permutation(n)[: n // 2].tolist(), list(range(n))]
    return [{joint: float(rng.integers(-40, 41)) / 8.0 for joint in chosen} for chosen in joints]


@each_row("n", [2, 3, 4, 7, 30, 60])
def test_what_is_set_is_a_condition_of_the_spline(rng, n):
    """The tridiagonal systems against elimination in exact fractions, for derivatives of all orders."""
    points, t = whole_numbers(rng, n)
    exact_points, exact_t = fractions(points), fractions(t)
    for given in conditions(rng, n):
        velocities = exact_rules.spline_velocities(exact_points, exact_t, given)
        bends = exact_rules.spline_accelerations(exact_points, exact_t, velocities)
        acceleration = {n // 2: Fraction(7, 4)} if n > 2 else {}
        with_set = [acceleration.get(i, bend) for i, bend in enumerate(bends)]
        data = points[:, None], t
        set_here = rows(n, given)
        found = [
            natural_spline_velocities(*data, velocities=set_here),
            natural_spline_accelerations(*data, velocities=set_here),
            natural_spline_jerks(*data, velocities=set_here, accelerations=rows(n, acceleration)),
        ]
        expected = [velocities, bends, exact_rules.spline_jerks(exact_t, with_set)]
        for ours, exact in zip(found, expected, strict=True):
            numbers = np.array([float(value) for value in exact])
            # The condition of the systems is below 3; a few roundings a joint.
            assert np.abs(ours[:, 0] - numbers).max() <= 2e-14 * max(np.abs(numbers).max(), 1.0)
        for joint, value in given.items():
            assert found[0][joint, 0] == value


@each_row("n", [2, 3, 5, 12])
def test_setting_a_velocity_to_its_estimate_changes_nothing(rng, n):
    """In exact fractions, with others set and without; accelerations and jerks follow from velocities."""
    points, t = (fractions(values) for values in whole_numbers(rng, n))
    for given in conditions(rng, n):
        estimated = exact_rules.spline_velocities(points, t, given)
        for joints in ([0], [n - 1], [n // 2], rng.permutation(n)[: n // 2].tolist(), range(n)):
            more = given | {joint: estimated[joint] for joint in joints}
            assert exact_rules.spline_velocities(points, t, more) == estimated


@each_row("n", [3, 5, 40, 200])
def test_the_acceleration_is_continuous_wherever_no_velocity_is_set(rng, n):
    """Its jumps in exact fractions of the numbers that were computed: they are roundings of these."""
    points, t = rng.standard_normal(n), np.cumsum(10.0 ** rng.uniform(-2, 0, n))
    for given in conditions(rng, n):
        velocities = natural_spline_velocities(points[:, None], t, velocities=rows(n, given))[:, 0]
        sides = exact_rules.bends_beside(*(fractions(values) for values in (points, t, velocities)))
        h = np.diff(t)
        size = np.abs(velocities).max() + np.abs(np.diff(points) / h).max()
        for joint, (before, after) in enumerate(zip(*sides, strict=True)):
            if joint in given:
                continue
            jump = float((before or 0) - (after or 0)) if 0 < joint < n - 1 else float(before or after)
            nearest = h[max(joint - 1, 0) : joint + 1].min()
            # A velocity has some roundings of the largest, which c'' multiplies by 4 over the length.
            assert abs(jump) <= 64 * 2.0**-53 * size / nearest


def test_scipy_agrees_on_clamped_ends(rng):
    points, t = rng.standard_normal((9, 2)), np.cumsum(rng.uniform(0.1, 1.0, 9))
    first, last = rng.standard_normal((2, 2))
    spline = CubicSpline(t, points, bc_type=((1, first), (1, last)))
    given = np.full((9, 2), NAN)
    given[0], given[-1] = first, last
    assert natural_spline_velocities(points, t, velocities=given) == pytest.approx(spline(t, 1), abs=1e-12)
    bends = natural_spline_accelerations(points, t, velocities=given)
    assert bends == pytest.approx(spline(t, 2), abs=1e-11)


def test_many_conditions_take_one_system(rng):
    """Of 2,000 joints with every third one set: as exact as the pieces between these, one by one."""
    n = 2000
    points, t = rng.standard_normal((n, 2)), np.cumsum(rng.uniform(0.5, 1.5, n))
    given = np.full((n, 2), NAN)
    given[::3] = rng.standard_normal((len(given[::3]), 2))
    ours = natural_spline_velocities(points, t, velocities=given)
    for start in range(0, n - 3, 3):
        piece = slice(start, start + 4)
        alone = natural_spline_velocities(points[piece], t[piece], velocities=given[piece])
        assert ours[piece] == pytest.approx(alone, abs=1e-13 * np.abs(ours).max())


@each_row("rule", [bessel_velocities, lambda *data, **given: catmull_rom_velocities(*data, 0.5, **given)])
def test_the_end_of_a_local_rule_follows_the_velocity_of_its_neighbour(rng, rule):
    """Inside, the rule looks at the points alone; its end is the parabola with the neighbour's velocity."""
    points, t = rng.standard_normal((6, 2)), np.cumsum(rng.uniform(0.5, 1.5, 6))
    given = np.full((6, 2), NAN)
    given[1] = given[3] = [3.0, -2.0]
    free, ours = rule(points, t), rule(points, t, velocities=given)
    assert (ours[[2, 4, 5]] == free[[2, 4, 5]]).all()
    assert (ours[[1, 3]] == given[[1, 3]]).all()
    assert ours[0] == pytest.approx(2 * (points[1] - points[0]) / (t[1] - t[0]) - given[1], abs=1e-13)
    given[1] = free[1]
    assert (rule(points, t, velocities=given)[0] == free[0]).all()
    two = rule(points[:2], t[:2], velocities=[[NAN, NAN], [3.0, -2.0]])
    assert two[0] == pytest.approx(2 * (points[1] - points[0]) / (t[1] - t[0]) - [3.0, -2.0], abs=1e-13)


@each_row("rule", [*SPLINES, bessel_velocities, catmull_rom_velocities])
def test_conditions_that_are_none(rule):
    points = [[0.0, 0.0], [1.0, 2.0], [4.0, 0.0]]
    free = rule(points, uniform(3))
    assert (rule(points, uniform(3), velocities=np.full((3, 2), NAN)) == free).all()
    with pytest.raises(CurveError, match=r"velocities must have the shape \(3, 2\), not \(2, 2\)"):
        rule(points, uniform(3), velocities=np.full((2, 2), NAN))
    with pytest.raises(CurveError, match=r"velocities\[1\] must be finite, or NaN throughout"):
        rule(points, uniform(3), velocities=[[NAN, NAN], [1.0, NAN], [NAN, NAN]])
