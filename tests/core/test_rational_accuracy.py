"""Floater–Hormann curves against their definition in intervals of a thousand bits, and against SciPy.

The bound is |computed - exact| <= c u sum |B_i^(order) p_i|. A weight has 3 d roundings, a term of the
denominator as many, and nothing cancels: c grows like sqrt(6 d) / 2, times the four or five standard
deviations that the worst of some hundred samples shows, and would be 20 for d = 10; it is 10. The usual
formula misses the bound by the Lebesgue constant: see `test_the_usual_formula_would_not_do`.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from flint import arb, ctx, fmpq
from scipy.interpolate import FloaterHormannInterpolator

from curvecore import (
    CurveError,
    FloaterHormannCurve,
    LagrangeCurve,
    chebyshev,
    curvature,
    lebesgue_constant,
    uniform,
)
from tests.rows import each_row

NAMES = ["uniform", "random", "clustered", "geometric", "shifted", "small", "large", "chebyshev"]
LIMIT = 25.0
_BITS = 1200


def coefficient(a, b, power):
    """What the product of two series has of a power."""
    return sum((a[s] * b[power - s] for s in range(1, power + 1)), a[0] * b[power])


def product(a, b):
    return [coefficient(a, b, power) for power in range(len(a))]


def running(differences, one):
    """Series of the products of (difference + s) before each place."""
    products = [one]
    for each in differences:
        last = products[-1]
        products.append([last[0] * each, *(b * each + a for a, b in pairwise(last))])
    return products


def exact_weights(nodes, degree):
    """The weight of every node: signed products of the inverse distances in all windows that have it."""
    n, d = len(nodes), min(degree, len(nodes) - 1)
    with ctx.workprec(_BITS):
        nodes = [arb(x) for x in nodes]
        weights = []
        for k in range(n):
            weight = arb(0)
            for i in range(max(k - d, 0), min(k, n - 1 - d) + 1):
                one_window = arb((-1) ** i)
                for j in range(i, i + d + 1):
                    if j != k:
                        one_window /= nodes[k] - nodes[j]
                weight += one_window
            weights.append(weight)
        return weights


def exact_functions(t, nodes, degree, weights, order=0):
    """All functions at t, and their derivatives up to `order`: sum lambda_i L_ik over sum lambda_i.

    In intervals, [order][function].
    """
    n, d = len(nodes), min(degree, len(nodes) - 1)
    with ctx.workprec(_BITS):
        one = [arb(1)] + [arb(0)] * order
        nodes = [arb(x) for x in nodes]
        differences = [arb(t) - x for x in nodes]
        before, after = running(differences, one), running(differences[::-1], one)[::-1]
        # sum lambda_i times all differences: what is left are those outside of window i.
        below = [arb(0)] * (order + 1)
        for i in range(n - d):
            outside = product(before[i], after[i + d + 1])
            below = [a + (-1) ** i * b for a, b in zip(below, outside, strict=True)]
        inverse = [1 / below[0]]
        for power in range(1, order + 1):
            inverse.append(
                -sum((below[s] * inverse[power - s] for s in range(1, power + 1)), arb(0)) / below[0]
            )
        outside = [product(before[k], after[k + 1]) for k in range(n)]
        return [
            [
                weight * coefficient(each, inverse, power) * math.factorial(power)
                for weight, each in zip(weights, outside, strict=True)
            ]
            for power in range(order + 1)
        ]


def worst(exact, curve, t, orders=(0,)):
    """The largest constant c of the bound; each single function is that accurate, its derivatives are not."""
    nodes = [exact.rational(x) for x in curve.parameters]
    points = [exact.enclosed(map(exact.rational, column)) for column in curve.points.T]
    degree = curve.chosen["degree"]
    weights = exact_weights(nodes, degree)
    functions = [exact_functions(exact.rational(x), nodes, degree, weights, max(orders)) for x in t]
    found = [0.0]
    for order in orders:
        values, basis = curve.evaluate(t, order), curve.basis(t, order)[:, :, 0]
        assert np.isfinite(values).all()
        assert np.isfinite(basis).all()
        for k, at in enumerate(functions):
            terms = at[order]
            for d, coordinates in enumerate(points):
                found.append(exact.worst_constant(values[k, d], exact.products(terms, coordinates)))
            if order == 0:
                found += [
                    exact.worst_constant(b, [a]) for b, a in zip(basis[k], terms, strict=True) if a != 0
                ]
    return max(each for each in found if each is not None)


def curve_of(rng, parameters, degree, dim=2):
    return FloaterHormannCurve(rng.standard_normal((len(parameters), dim)), parameters, degree=degree)


@each_row("name", NAMES)
@each_row("n", [2, 5, 20])
@each_row("degree", [0, 3, 10])
def test_bound(exact, rng, n, name, degree):
    parameters = exact.parameter_sets(n, rng)[name]
    curve = curve_of(rng, parameters, degree)
    assert worst(exact, curve, exact.probes(parameters, rng, 2), range(4)) <= LIMIT


@pytest.mark.parametrize("name", NAMES)
def test_bound_for_many_points(exact, rng, name):
    parameters = exact.parameter_sets(60, rng)[name]
    curve = curve_of(rng, parameters, 3, 1)
    assert worst(exact, curve, exact.probes(parameters, rng, 1), (0, 1, 3)) <= LIMIT


def test_parameters_of_very_different_distances(exact, rng):
    """Values at any distances, derivatives up to 1e15: at 1e20 the third one missed the bound by c = 1e5."""
    for decades, orders in ((15, range(4)), (50, [1]), (280, [0])):
        for n, degree in ((5, 1), (8, 3), (8, 10)):
            parameters = np.concatenate([[0.0], 10.0 ** np.linspace(-decades, 0, n - 1)])
            curve = curve_of(rng, parameters, degree)
            places = np.concatenate([parameters, 0.5 * (parameters[1:] + parameters[:-1])])
            assert worst(exact, curve, places, orders) <= LIMIT


def test_the_usual_formula_would_not_do(exact, rng):
    """The quotient of two sums in double precision: its denominator cancels."""
    parameters = np.sort(rng.random(20)) ** 3
    curve = curve_of(rng, parameters, 8)
    t = 0.5 * (parameters[1:] + parameters[:-1])
    nodes = [exact.rational(x) for x in parameters]
    weights = exact_weights(nodes, 8)
    usual = FloaterHormannInterpolator(parameters, curve.points, d=8)(t)
    found = []
    for k, x in enumerate(t):
        (terms,) = exact_functions(exact.rational(x), nodes, 8, weights)
        coordinates = exact.enclosed(map(exact.rational, curve.points[:, 0]))
        found.append(exact.worst_constant(usual[k, 0], exact.products(terms, coordinates)))
    assert max(found) > 100.0 * LIMIT
    assert worst(exact, curve, t) <= LIMIT


@each_row("name", NAMES)
@each_row(("n", "degree"), [(5, 0), (6, 2), (20, 3), (60, 3)])
def test_quick_derivatives_are_within_their_stated_error(exact, rng, n, degree, name):
    parameters = exact.parameter_sets(n, rng)[name]
    curve = curve_of(rng, parameters, degree)
    t = np.clip(exact.probes(parameters, rng, 10), *curve.domain)
    with np.errstate(over="ignore", invalid="ignore"):
        for order, found in enumerate(curve.derivatives_at(t, (0, 1, 2, 3))):
            with np.errstate(under="ignore"):  # not by every kernel of BLAS
                scale = np.abs(curve.basis(t, order)[:, :, 0]) @ np.abs(curve.points)
            off = np.abs(found - curve.evaluate(t, order)) / np.maximum(scale, 1e-300)
            assert np.isfinite(found).all()
            assert np.nanmax(off, initial=0.0) <= 1e4 * LIMIT * 2.0**-53


def test_curvature_beside_near_points():
    """Of the cubic c' = (32, 0) and c'' = (-184, -72), but for 2e-6; 1.4 % were lost to sums in doubles."""
    points = [(1.0, 2.0), (1.0 + 2.0**-20, 2.0), (1.0, -3.0), (-3.0, -2.0)]
    curve = FloaterHormannCurve(points, [0.0, 2.0**-25, 0.5, 1.0], degree=2)
    # Divided differences in fractions.
    assert curvature(curve, 0.0) == pytest.approx(-0.07031248821294919, rel=1e-12)


# Against SciPy, and what the papers say


@each_row("degree", [0, 1, 3, 5])
@each_row("n", [6, 40])
def test_values_agree_with_scipy(rng, n, degree):
    parameters = uniform(n)
    curve = curve_of(rng, parameters, degree)
    t = rng.uniform(-0.1, 1.1, 200)
    theirs = FloaterHormannInterpolator(parameters, curve.points, d=degree)(t)
    # Both are off by rounding times the Lebesgue function.
    scale = np.abs(curve.basis(t)[:, :, 0]) @ np.abs(curve.points)
    growth = np.abs(curve.basis(t)).sum(axis=(1, 2))[:, None]
    assert (np.abs(curve.evaluate(t) - theirs) <= 100.0 * 2.0**-53 * growth * scale).all()


@each_row("order", [0, 1, 2, 3])
@each_row("degree", [0, 2, 3])
def test_polynomials_of_the_degree_are_reproduced(rng, degree, order):
    parameters = np.sort(rng.random(12))
    polynomial = np.polynomial.Polynomial(rng.standard_normal(degree + 1))
    curve = FloaterHormannCurve(polynomial(parameters)[:, None], parameters, degree=degree)
    t = rng.random(50)
    scale = np.abs(curve.basis(t, order)[:, :, 0]) @ np.abs(curve.points)
    true = (polynomial.deriv(order) if order else polynomial)(t)[:, None]
    assert (np.abs(curve.evaluate(t, order) - true) <= LIMIT * 2.0**-53 * scale + 1e-300).all()


def test_runge_converges_at_uniform_parameters():
    """The error falls like h**(d + 1), theorem 2 of the paper; the polynomial's grows like 1.5**n."""
    t = np.linspace(-1.0, 1.0, 4001)
    errors = []
    for n in (21, 41, 81):
        x = np.linspace(-1.0, 1.0, n)
        curve = FloaterHormannCurve(1.0 / (1.0 + 25.0 * x**2)[:, None], x)
        errors.append(np.abs(curve.evaluate(t)[:, 0] - 1.0 / (1.0 + 25.0 * t**2)).max())
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (rates > 3.5).all()


@each_row("degree", [0, 1, 3, 5])
def test_the_lebesgue_constant_is_within_its_bounds(degree):
    """At most 2**(d - 1) (2 + log n), and 2 + log n for d = 0, n the number of gaps (Bos et al.)."""
    for n in (20, 60):
        curve = FloaterHormannCurve(np.zeros((n, 1)), uniform(n), degree=degree)
        bound = 2.0 ** max(degree - 1, 0) * (2.0 + np.log(n - 1))
        assert 1.0 < lebesgue_constant(curve) <= bound


@pytest.mark.parametrize("n", [2, 3, 6])
def test_a_rational_curve_of_few_points_is_the_one_polynomial(rng, n):
    parameters, points = np.sort(rng.random(n)), rng.standard_normal((n, 2))
    curve, polynomial = FloaterHormannCurve(points, parameters, degree=9), LagrangeCurve(points, parameters)
    assert curve.chosen == {"degree": 9}
    t = rng.random(20)
    scale = np.abs(polynomial.basis(t)[:, :, 0]) @ np.abs(points)
    assert (np.abs(curve.evaluate(t) - polynomial.evaluate(t)) <= 2.0 * LIMIT * 2.0**-53 * scale).all()


@each_row("degree", [0, 1, 3, 9])
@each_row("beyond", [0, 1, 2])
def test_a_rational_curve_of_up_to_degree_plus_two_points_is_a_polynomial(degree, beyond):
    """n = d + 1 points: one polynomial. n = d + 2: two, blended as by Neville. Beyond: a quotient."""
    n = max(degree + 1 + beyond, 2)
    nodes = [fmpq(k * k) for k in range(n)]
    weights = exact_weights(nodes, degree)
    values = [exact_functions(k + fmpq(1, 3), nodes, degree, weights)[0][0] for k in range(n + 1)]
    with ctx.workprec(_BITS):
        # The n-th difference of a polynomial of degree n - 1 is 0.
        difference = sum(((-1) ** k * math.comb(n, k) * value for k, value in enumerate(values)), arb(0))
    curve = FloaterHormannCurve(np.zeros((n, 1)), np.arange(n) ** 2.0, degree=degree)
    assert curve.degree == (n - 1 if difference.contains(0) else None)
    assert (curve.degree is None) == (n > degree + 2)
    assert curve.kind == ("" if curve.degree is not None else f"rational, blended degree {degree}")


@pytest.mark.parametrize("n", [2, 3, 5])
def test_a_rational_curve_that_is_a_polynomial_has_exact_pieces(rng, n):
    points, parameters = rng.standard_normal((n, 2)), np.sort(rng.random(n))
    curve, polynomial = FloaterHormannCurve(points, parameters), LagrangeCurve(points, parameters)
    np.testing.assert_array_equal(curve.exact_pieces(), polynomial.exact_pieces())
    (own,), (known,) = curve.interpolants(), polynomial.interpolants()
    np.testing.assert_array_equal(own.parameters, known.parameters)
    np.testing.assert_array_equal(own.jets, known.jets)
    more = FloaterHormannCurve(rng.standard_normal((6, 2)), uniform(6))
    assert more.exact_pieces() is None
    assert more.interpolants() is None


def test_points_are_passed_exactly(rng):
    for parameters in (uniform(30), chebyshev(30), 1e6 + uniform(30), np.sort(rng.random(30)) ** 5):
        curve = curve_of(rng, parameters, 3)
        assert np.array_equal(curve.evaluate(parameters), curve.points)
        assert np.array_equal(curve.basis(parameters)[:, :, 0], np.eye(30))


def test_many_parameters_at_once_take_no_full_matrix(rng):
    """Two thousand points at two thousand t: parts of t are worked on one after the other."""
    n = 2000
    curve = curve_of(rng, uniform(n), 3)
    t = rng.random(2000)
    basis = curve.basis(t[:5])[:, :, 0]
    assert np.abs(basis.sum(axis=1) - 1.0).max() < 1e-13
    # Rounded differently in another number of rows by some kernels of BLAS.
    scale = np.abs(basis) @ np.abs(curve.points)
    assert (np.abs(curve.evaluate(t)[:5] - curve.evaluate(t[:5])) <= 2 * LIMIT * 2.0**-53 * scale).all()


def test_a_rational_curve_stays_finite_far_outside(rng):
    curve = curve_of(rng, uniform(9), 3)
    for order in (0, 1, 2):
        assert np.isfinite(curve.evaluate(np.array([-1e300, -1e9, 1e9, 1e300]), order)).all()


@each_row("degree", [-1, 11, 2.5, "3", None])
def test_the_degree_is_checked(degree):
    with pytest.raises(CurveError, match="degree must be a whole number from 0 to 10"):
        FloaterHormannCurve(np.zeros((4, 2)), uniform(4), degree=degree)
