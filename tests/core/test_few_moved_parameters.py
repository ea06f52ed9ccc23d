"""Curve with a few moving parameters, compared with the curve evaluated anew and exact fractions."""

from __future__ import annotations

import numpy as np
import pytest

from curvecore import LagrangeCurve, chebyshev, uniform
from curvecore.drag.moved_parameters import LeftOut

U = 2.0**-53


def points_of(n, seed=1):
    return np.random.default_rng(seed).normal(size=(n, 2))


def moved(t, which, share):
    other = t.copy()
    for k in which:
        other[k] += share * ((t[k + 1] if share > 0 else t[k]) - (t[k] if share > 0 else t[k - 1]))
    return other


CASES = [
    (n, which, share)
    for n in (3, 5, 20)
    for which in ([1], [1, 2], [2, 4, 9], [0], [3, 4, 5, 6])
    for share in (0.4, -0.4, 0.99)
    if which[-1] < n - 1 and len(which) <= n - 2 and (share > 0 or which[0] > 0)
]


@pytest.mark.parametrize("rule", [chebyshev, uniform])
@pytest.mark.parametrize(("n", "which", "share"), CASES)
def test_the_error_stays_below_the_estimate(exact, rule, n, which, share):
    t, points = rule(n), points_of(n)
    other = LagrangeCurve(points, moved(t, which, share))
    # Places that are parameters, old and new, are among them.
    at = np.unique(np.concatenate([np.linspace(0.0, 1.0, 21), t, other.parameters]))
    known = LeftOut(LagrangeCurve(points, t), np.array(which), at)
    assert known.serves(other)
    samples = known.evaluate(other)
    nodes = [exact.rational(x) for x in other.parameters]
    weights = exact.lagrange_weights(nodes)
    columns = [[exact.rational(x) for x in column] for column in points.T]
    for place, row in zip(at, samples.points, strict=True):
        size = float(np.abs(other.basis([place])[0, :, 0]) @ np.abs(points).max(axis=1))
        terms = exact.lagrange_terms(exact.rational(place), nodes, 0)
        terms = [a * w for a, w in zip(terms, weights, strict=True)]
        truth = [
            sum((a * p for a, p in zip(terms, each, strict=True)), exact.rational(0)) for each in columns
        ]
        errors = [abs(exact.rational(v) - e) for v, e in zip(row, truth, strict=True)]
        # Far from what was left out the functions are those of the curve, with the error that they have.
        assert max(errors) <= exact.rational(samples.rounding + 50 * U * size)


def test_a_thousand_points():
    n = 1000
    t, points = chebyshev(n), points_of(n)
    other = LagrangeCurve(points, moved(t, [n // 2], 0.9))
    at = np.linspace(0.0, 1.0, 777)
    known = LeftOut(LagrangeCurve(points, t), np.array([n // 2]), at)
    samples = known.evaluate(other)
    assert samples.rounding < 1e-9
    assert np.abs(samples.points - other.evaluate(at)).max() <= samples.rounding


def test_points_that_were_left_out_may_be_anywhere():
    t, points = chebyshev(9), points_of(9)
    at = np.linspace(0.0, 1.0, 50)
    known = LeftOut(LagrangeCurve(points, t), np.array([4]), at)
    elsewhere = points.copy()
    elsewhere[4] += 3.0
    other = LagrangeCurve(elsewhere, moved(t, [4], 0.5))
    assert known.serves(other)
    samples = known.evaluate(other)
    assert np.abs(samples.points - other.evaluate(at)).max() <= samples.rounding


def test_other_points_or_parameters_are_not_served():
    t, points = chebyshev(9), points_of(9)
    known = LeftOut(LagrangeCurve(points, t), np.array([4]), np.linspace(0.0, 1.0, 5))
    assert not known.serves(LagrangeCurve(points, moved(t, [3], 0.5)))
    assert not known.serves(LagrangeCurve(points[:8], t[:8]))
    assert not known.serves(LagrangeCurve(points_of(9, seed=2), t))


def test_a_gap_that_the_others_cannot_bridge_shows_in_the_estimate():
    """Two clusters and one point between them: without it the others say next to nothing there."""
    t = np.concatenate([np.linspace(0.0, 1e-3, 10), [0.5], np.linspace(0.999, 1.0, 10)])
    points = points_of(21)
    curve = LagrangeCurve(points, t)
    known = LeftOut(curve, np.array([10]), np.linspace(0.0, 1.0, 200))
    assert known.evaluate(curve).rounding > 1.0
