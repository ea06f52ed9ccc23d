"""Only the coefficients, or only the data, rounded to k digits: against fractions and hand rounding."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from curvecore import (
    CurveError,
    HermiteCurve,
    Rounding,
    available_methods,
    chebyshev,
    evaluate_rounded,
    exact_values,
    lebesgue_constant,
    natural_spline_velocities,
    round_significant,
    rounded_decimals,
    uniform,
)
from curvecore.families.lagrange import LagrangeCurve

NINE = np.array(
    [
        (0.0, 0.0),
        (1.0, 1.1),
        (2.0, 1.6),
        (3.1, 1.3),
        (4.0, 0.5),
        (5.1, 0.2),
        (6.0, 0.8),
        (7.0, 1.7),
        (8.0, 1.9),
    ]
)
CLOCK = np.arange(9.0)


def by_hand(value, digits):
    """Round a fraction to so many significant digits with integers alone, half to even."""
    if value == 0:
        return value
    size = abs(value)
    exponent = 0
    while size >= 10 ** (exponent + 1):
        exponent += 1
    while size < Fraction(10) ** exponent:
        exponent -= 1
    unit = Fraction(10) ** (exponent - digits + 1)
    return round(value / unit) * unit


def power_coefficients(nodes, values):
    """Solve the Vandermonde system in fractions."""
    n = len(nodes)
    rows = [[x**k for k in range(n)] + [y] for x, y in zip(nodes, values, strict=True)]
    for k in range(n):
        pivot = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [row[-1] for row in rows]


def newton_differences(nodes, values):
    column, found = list(values), [values[0]]
    for order in range(1, len(nodes)):
        column = [(b - a) / (nodes[i + order] - nodes[i]) for i, (a, b) in enumerate(pairwise(column))]
        found.append(column[0])
    return found


def newton_value(nodes, differences, t):
    result = Fraction(0)
    for node, difference in zip(reversed(nodes), reversed(differences), strict=True):
        result = result * (t - node) + difference
    return result


def fractions(values):
    return [Fraction(float(x)) for x in values]


@pytest.mark.parametrize("digits", [2, 6, 13])
def test_rounded_coefficients_are_those_of_fractions(rng, digits):
    nodes = np.sort(rng.uniform(0.0, 8.0, 9))
    points, where = rng.standard_normal((9, 2)), [0.1, 3.7, 8.0]
    t = fractions(nodes)
    for axis, column in enumerate(points.T):
        powers = [by_hand(a, digits) for a in power_coefficients(t, fractions(column))]
        divided = [by_hand(a, digits) for a in newton_differences(t, fractions(column))]
        kept = [by_hand(a, digits) for a in fractions(column)]
        expected = {
            "monomial": [sum(a * x**k for k, a in enumerate(powers)) for x in fractions(where)],
            "newton": [newton_value(t, divided, x) for x in fractions(where)],
            "lagrange": [newton_value(t, newton_differences(t, kept), x) for x in fractions(where)],
        }
        for method, values in expected.items():
            rows = rounded_decimals(points, nodes, where, method, digits, rounding="coefficients")
            for row, value in zip(rows, values, strict=True):
                # Shown to twenty digits.
                assert abs(Fraction(row[axis]) - value) <= abs(value) * Fraction(1, 10**19)


def test_monomials_get_worse_along_t_when_only_their_coefficients_are_rounded():
    """With every step rounded the error was 6e-2 at t = 0.1 and 2e-2 at t = 8: flat."""
    where = [0.1, 8.0]
    found = evaluate_rounded(NINE, CLOCK, where, "monomial", 6, rounding=Rounding.COEFFICIENTS)
    near, far = np.hypot(*(found - exact_values(NINE, CLOCK, where)).T)
    assert 1e-7 < near < 1e-6
    assert 1e-2 < far < 1e-1


def test_rounded_data_are_the_same_curve_for_every_method(rng):
    points, t = rng.standard_normal((7, 2)), chebyshev(7)
    where = rng.random(20)
    rounded_points, rounded_t = round_significant(points, 3), round_significant(t, 3)
    truth = exact_values(rounded_points, rounded_t, where)
    for method in available_methods(0):
        found = evaluate_rounded(points, t, where, method, 3, rounding="data")
        # Both are roundings of the same number to a double.
        np.testing.assert_allclose(found, truth, rtol=3e-16)


def test_errors_of_rounded_points_stay_below_the_lebesgue_constant(rng):
    points, t = rng.standard_normal((9, 2)), uniform(9)
    where = np.linspace(0.0, 1.0, 301)
    found = evaluate_rounded(points, t, where, "lagrange", 3, rounding="coefficients")
    unit = np.abs(round_significant(points, 3) - points).max()
    error = np.abs(found - exact_values(points, t, where)).max()
    assert unit < error < lebesgue_constant(LagrangeCurve(points, t)) * unit * (1 + 1e-9)


@pytest.mark.parametrize("shift", [0.0, 100.0, -3.25])
def test_sixteen_digits_of_the_coefficients_are_enough_away_from_powers_of_t(rng, shift):
    points, t = rng.standard_normal((60, 2)), uniform(60)
    velocities, where = natural_spline_velocities(points, t), np.linspace(0.0, 1.0, 7)
    truth = HermiteCurve(points, velocities, t + shift).evaluate(where + shift)
    found = evaluate_rounded(
        points, t + shift, where + shift, "basis", 16, velocities, rounding="coefficients"
    )
    # Velocities up to some hundred, each within half a unit of its sixteenth digit, weigh at most h/4.
    assert np.abs(found - truth).max() < 1e-14


def test_wrong_arguments_of_rounding_are_refused():
    close = np.append([0.0, 1e-90, 2e-90], np.arange(1.0, 58.0))
    with pytest.raises(CurveError, match="further apart"):
        evaluate_rounded(np.zeros((60, 2)), close, [0.5], "newton", 6, rounding="coefficients")
    with pytest.raises(CurveError, match=r"to 2 digits parameters\[0\] and parameters\[1\] are equal"):
        evaluate_rounded(NINE, CLOCK + 1000, [1000.0], "newton", 2, rounding="data")
    with pytest.raises(CurveError, match="rounding must be one of every_step, coefficients, data"):
        evaluate_rounded(NINE, CLOCK, [0.5], "newton", 2, rounding="nothing")


def test_round_significant_rounds_decimals_as_printed():
    assert round_significant([2.675, -0.125, 0.0, 1e-310], 3).tolist() == [2.68, -0.125, 0.0, 1e-310]
    assert round_significant([[2.665, 1234.5]], 3).tolist() == [[2.66, 1230.0]]
