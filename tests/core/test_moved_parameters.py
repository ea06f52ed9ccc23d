"""Functions after parameters have moved, against those computed anew and against exact fractions."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from curvecore import LagrangeCurve, chebyshev
from curvecore.moved_parameters import MovedParameters

U = 2.0**-53


def curve_of(t, seed=1):
    return LagrangeCurve(np.random.default_rng(seed).normal(size=(len(t), 2)), t)


def moved(t, which, share=0.3):
    other = t.copy()
    for k in which:
        other[k] += share * (t[k + 1] - t[k])
    return other


def exact_basis(parameters, t):
    nodes, at = [Fraction(x) for x in parameters.tolist()], Fraction(float(t))
    result = []
    for i, own in enumerate(nodes):
        value = Fraction(1)
        for j, other in enumerate(nodes):
            if j != i:
                value *= (at - other) / (own - other)
        result.append(value)
    return result


@pytest.mark.parametrize("n", [5, 20, 40])
@pytest.mark.parametrize("which", [[1], [0], [1, 2], [1, 2, 3]])
def test_every_function_has_a_small_relative_error(n, which):
    t = chebyshev(n)
    # Places that are parameters, old and new, are among them.
    at = np.concatenate([np.linspace(0.0, 1.0, 8), t[:5], moved(t, which)[:5]])
    known = MovedParameters(curve_of(t), at)
    other = curve_of(moved(t, which))
    values = known.basis(other)[:, :, 0]
    for row, place in zip(values, at, strict=True):
        exact = exact_basis(other.parameters, place)
        errors = [abs(Fraction(float(v)) - e) for v, e in zip(row, exact, strict=True)]
        # The basis itself keeps c <= 25 n / 60 + 10 roundings, each quotient of the quotients three.
        bound = Fraction((60 + 8 * n) * U)
        assert all(error <= bound * abs(e) for error, e in zip(errors, exact, strict=True))


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


def test_what_has_moved_too_much_is_not_known():
    t = chebyshev(9)
    known = MovedParameters(curve_of(t), np.linspace(0.0, 1.0, 5))
    assert known.basis(curve_of(moved(t, [1, 2, 3, 4, 5]))) is None
    assert known.basis(curve_of(chebyshev(8))) is None


def test_weight_ratios_against_products():
    t = np.array([0.0, 0.1, 0.5, 0.75, 1.0])
    weights = [1 / np.prod([a - b for b in t if b != a]) for a in t]
    assert curve_of(t).weight_ratios(2) == pytest.approx(np.array(weights) / weights[2], rel=1e-14)
