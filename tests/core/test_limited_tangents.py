"""Monotone (PCHIP) and Akima velocities against SciPy's, and their Jacobians by differences."""

import numpy as np
import pytest
from scipy.interpolate import Akima1DInterpolator, PchipInterpolator

from curvecore import (
    HermiteCurve,
    akima_changes,
    akima_velocities,
    monotone_changes,
    monotone_velocities,
    uniform,
)
from tests import exact_rules
from tests.exact_rules import changes
from tests.rows import each_row

RULES = {
    "monotone": (monotone_velocities, monotone_changes, PchipInterpolator),
    "akima": (akima_velocities, akima_changes, Akima1DInterpolator),
}
every_rule = pytest.mark.parametrize("name", RULES)


def spaced(rng, n):
    return np.cumsum(rng.random(n) + 0.01)


@every_rule
@each_row("n", [2, 3, 4, 5, 8, 30])
@each_row("whole", [False, True])
def test_scipy_agrees(rng, name, n, whole):
    """Whole numbers bring ties: equal points, straight runs, flat ones."""
    velocities, _, reference = RULES[name]
    for _ in range(40):
        t = spaced(rng, n)
        points = rng.integers(-2, 3, (n, 2)).astype(float) if whole else rng.standard_normal((n, 2))
        with np.errstate(all="ignore"):
            expected = reference(t, points).derivative()(t)
        size = np.abs(np.diff(points, axis=0) / np.diff(t)[:, None]).max() + 1.0
        # SciPy's are read off the derivative of a cubic at its ends: some roundings of its coefficients.
        assert np.abs(velocities(points, t) - expected).max() < 1e-12 * size


@every_rule
def test_ties(name):
    """Five points up a straight line and three along a flat one: no chord bends within its run."""
    velocities = RULES[name][0]
    points = np.array([[0.0], [1.0], [2.0], [3.0], [4.0], [4.0], [4.0], [4.0]])
    found = velocities(points, np.arange(8.0))[:, 0]
    corner = 0.0 if name == "monotone" else 0.5
    assert found == pytest.approx([1.0, 1.0, 1.0, 1.0, corner, 0.0, 0.0, 0.0], abs=1e-15)


def test_rounding_does_not_decide_at_a_corner_between_straight_runs():
    """Both weights are roundings there; their ratio could be anything."""
    t = np.array([0.0, 0.1, 0.3, 0.7, 1.1, 1.4, 1.9])
    points = np.where(t < 0.7, 0.3 * t, 0.21 + 0.7 * (t - 0.7))[:, None]
    assert akima_velocities(points, t)[3, 0] == pytest.approx(0.5, abs=1e-9)


def test_no_coordinate_swings_beyond_its_data(rng):
    for _ in range(50):
        t = spaced(rng, 12)
        points = np.cumsum(rng.random((12, 2)) ** 6, axis=0)
        curve = HermiteCurve(points, monotone_velocities(points, t), t)
        values = curve.evaluate(np.linspace(t[0], t[-1], 2000))
        assert (np.diff(values, axis=0) >= -1e-13).all()
    points = rng.standard_normal((12, 2))
    curve = HermiteCurve(points, monotone_velocities(points, t), t)
    for i in range(11):
        values = curve.evaluate(np.linspace(t[i], t[i + 1], 50))
        assert (values <= points[i : i + 2].max(axis=0) + 1e-13).all()
        assert (values >= points[i : i + 2].min(axis=0) - 1e-13).all()


@every_rule
@each_row("n", [2, 3, 4, 7, 20])
def test_the_jacobian_times_the_points_is_the_velocity(rng, name, n):
    """Both rules are homogeneous of degree one: Euler's theorem. Of ties, too, where one side counts."""
    velocities, changes, _ = RULES[name]
    for whole in (False, True):
        t = spaced(rng, n)
        points = rng.integers(-2, 3, (n, 2)).astype(float) if whole else rng.standard_normal((n, 2))
        jacobian = changes(points, t, np.eye(n))
        assert jacobian.shape == (n, 2, n)
        found = np.einsum("idj,jd->id", jacobian, points)
        assert found == pytest.approx(velocities(points, t), abs=1e-11 / np.diff(t).min())
        # A move of all points together changes nothing.
        assert jacobian.sum(axis=2) == pytest.approx(np.zeros((n, 2)), abs=1e-11 / np.diff(t).min())


@every_rule
@each_row("n", [2, 3, 4, 5, 6, 8])
def test_changes_on_one_side_are_those_of_exact_arithmetic(rng, name, n):
    """Whole numbers bring kinks."""
    for _ in range(12):
        points, t = rng.integers(-2, 3, n), np.cumsum(rng.integers(1, 3, n))
        moves = rng.integers(-1, 2, (n, 3))
        found = RULES[name][1](points[:, None].astype(float), t.astype(float), moves, one_sided=True)[:, 0]
        exact = [
            changes(getattr(exact_rules, name), points.tolist(), t.tolist(), each)
            for each in moves.T.tolist()
        ]
        exact = np.column_stack(exact)
        exact[np.abs(exact) > 1e30] = np.inf
        assert found == pytest.approx(exact, abs=1e-13)


def test_akimas_velocity_jumps_at_a_corner_between_straight_runs():
    """Unless both runs turn alike."""
    points, t = np.array([[0.0], [0.0], [0.0], [1.0], [2.0]]), np.arange(5.0)
    moves = np.array([[0, 1, 0, 0, 0], [0, 0, 0, 1, 0], [1, 0, 0, 0, 1], [0, 0, 1, 0, 0]]).T
    found = akima_changes(points, t, moves, one_sided=True)[2, 0]
    assert found.tolist() == [np.inf, np.inf, 0.0, 0.0]
    assert np.isfinite(akima_changes(points, t, moves)).all()


@every_rule
@each_row("n", [2, 3, 4, 7, 20])
def test_changes_are_those_of_small_moves(rng, name, n):
    velocities, changes, _ = RULES[name]
    t, points = spaced(rng, n), rng.standard_normal((n, 2))
    moves = rng.standard_normal((n, 3))
    found = changes(points, t, moves)
    step = 1e-6
    for j in range(3):
        by = step * moves[:, j : j + 1]
        slope = (velocities(points + by, t) - velocities(points - by, t)) / (2 * step)
        # Central differences: step**2 of a third derivative, and u / step.
        assert found[:, :, j] == pytest.approx(slope, abs=1e-5 * np.abs(slope).max())


@every_rule
def test_limited_tangents_are_local(rng, name):
    """A far point changes nothing, to the last bit."""
    velocities = RULES[name][0]
    points = rng.standard_normal((20, 2))
    moved = points.copy()
    moved[10] += 3.0
    same = (velocities(points, uniform(20)) == velocities(moved, uniform(20))).all(axis=1)
    reach = 1 if name == "monotone" else 2
    assert {9, 11} <= {*np.flatnonzero(~same).tolist()} <= {*range(10 - reach, 11 + reach)}
