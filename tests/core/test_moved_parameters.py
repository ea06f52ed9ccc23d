"""Functions after parameters have moved, against those computed anew and against exact fractions."""

from __future__ import annotations

import numpy as np
import pytest

from curvecore import LagrangeCurve, chebyshev, uniform
from curvecore.drag.moved_parameters import MovedParameters
from tests.rows import each_row

U = 2.0**-53


def curve_of(t, seed=1):
    return LagrangeCurve(np.random.default_rng(seed).normal(size=(len(t), 2)), t)


def moved(t, which, share=0.3):
    other = t.copy()
    for k in which:
        other[k] += share * (t[k + 1] - t[k])
    return other


@each_row("n", [5, 20, 40])
@each_row("which", [[1], [0], [1, 2], [1, 2, 3]])
def test_every_function_has_a_small_relative_error(exact, n, which):
    t = chebyshev(n)
    # Places that are parameters, old and new, are among them.
    at = np.concatenate([np.linspace(0.0, 1.0, 8), t[:5], moved(t, which)[:5]])
    known = MovedParameters(curve_of(t), at)
    other = curve_of(moved(t, which))
    values = known.basis(other)[:, :, 0]
    # The basis itself keeps c <= 25 n / 60 + 10 roundings, each quotient of the quotients three.
    bound = exact.rational((60 + 8 * n) * U)
    nodes = [exact.rational(x) for x in other.parameters]
    weights = exact.lagrange_weights(nodes)
    for row, place in zip(values, at, strict=True):
        products = exact.lagrange_terms(exact.rational(place), nodes, 0)
        for value, product, weight in zip(row, products, weights, strict=True):
            true = product * weight
            assert abs(exact.rational(value) - true) <= bound * abs(true)


@pytest.mark.parametrize("n", [30, 1000])
def test_the_functions_are_the_same_as_evaluated_anew(n):
    t = chebyshev(n)
    at = np.concatenate([np.linspace(0.0, 1.0, 333), t[::7]])
    other = curve_of(moved(t, [n // 2]))
    known = MovedParameters(curve_of(t), at)
    assert np.allclose(known.basis(other), other.basis(at), rtol=8 * n * U, atol=0)


def test_without_a_move_nothing_is_computed():
    curve = curve_of(chebyshev(9))
    at = np.linspace(0.0, 1.0, 17)
    assert np.array_equal(MovedParameters(curve, at).basis(curve_of(chebyshev(9), 2)), curve.basis(at))


def test_functions_of_parameters_moved_too_far_are_unknown():
    t = chebyshev(9)
    known = MovedParameters(curve_of(t), np.linspace(0.0, 1.0, 5))
    assert known.basis(curve_of(moved(t, [1, 2, 3, 4, 5]))) is None
    assert known.basis(curve_of(chebyshev(8))) is None


def test_weight_ratios_against_products():
    t = np.array([0.0, 0.1, 0.5, 0.75, 1.0])
    weights = [1 / np.prod([a - b for b in t if b != a]) for a in t]
    assert curve_of(t).weight_ratios(2) == pytest.approx(np.array(weights) / weights[2], rel=1e-14)


@pytest.mark.parametrize("n", [1000, 1050, 1100, 1300])
@pytest.mark.parametrize("share", [3e-4, 0.3])
def test_values_at_the_edge_of_the_range_are_exact_or_not_known(n, share):
    """On 1100 equal parameters the functions reach the largest number: one tick moved made them infinite."""
    t = uniform(n)
    at = np.concatenate([np.linspace(0.0, 1.0, 23), t[1:4] + 1e-5])
    known = MovedParameters(curve_of(t), at)
    for which in (1, n // 2, n - 2):
        other = curve_of(moved(t, [which], share))
        values = known.basis(other)
        assert (values is None) is (n > 1000)
        fresh = other.basis(at)
        assert np.isfinite(fresh).all()
        with np.errstate(under="ignore"):
            assert values is None or (np.abs(values - fresh) <= 8 * n * U * np.abs(fresh)).all()


def test_values_that_would_leave_the_range_are_not_known():
    """In range before, and beyond it when two points all but meet: their functions grow without bound."""
    t = uniform(1000)
    known = MovedParameters(curve_of(t), np.array([5e-4, 0.4]))
    for share, is_known in ((1e-2, True), (1e-12, False)):
        other = t.copy()
        other[500] = t[499] + share * (t[500] - t[499])
        assert (known.basis(curve_of(other)) is not None) is is_known
