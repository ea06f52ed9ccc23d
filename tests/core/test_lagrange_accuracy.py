"""Lagrange curves against exact rational arithmetic.

The bound is |computed - exact| <= c u sum |L_i p_i|. A product of n factors
over n factors, each of one rounding, has about 4 n roundings. As if they were
independent, c grows like sqrt(n), times the three or four standard deviations
that the worst of a few hundred samples shows; the roundings of t - t_j that are
not independent add up to n / 4, and are corrected from 65 nodes on.
Derivatives lack the numerator's roundings. 50 leaves no room for a method that
cancels: SciPy's misses it by 2e3 on 20 and by 1e9 on 40 uniform parameters.
"""

from functools import reduce

import numpy as np
import pytest

from curvecore import LagrangeCurve, chebyshev
from tests.rows import each_row

NAMES = ["uniform", "random", "clustered", "geometric", "shifted", "small", "large", "chebyshev"]
LIMIT = 50.0


def worst(exact, curve, t, order):
    nodes = [exact.rational(x) for x in curve.parameters]
    weights = exact.enclosed(exact.lagrange_weights(nodes))
    points = [exact.enclosed(map(exact.rational, column)) for column in curve.points.T]
    values = curve.evaluate(t, order)
    basis = curve.basis(t, order)[:, :, 0]
    assert np.isfinite(values).all()
    assert np.isfinite(basis).all()
    found = [0.0]
    for k, x in enumerate(t):
        terms = exact.enclosed(exact.lagrange_terms(exact.rational(x), nodes, order))
        terms = exact.products(terms, weights)
        for d, coordinates in enumerate(points):
            constant = exact.worst_constant(values[k, d], exact.products(terms, coordinates))
            if constant is not None:
                found.append(constant)
        if order == 0:
            # Each single function is that accurate.
            single = [exact.worst_constant(b, [a]) for b, a in zip(basis[k], terms, strict=True)]
            found += [c for c in single if c is not None]
    return max(found)


@each_row("order", [0, 1, 2, 3])
@each_row("name", NAMES)
@each_row("n", [2, 5, 20])
def test_bound(exact, rng, n, name, order):
    parameters = exact.parameter_sets(n, rng)[name]
    curve = LagrangeCurve(rng.standard_normal((n, 2)), parameters)
    assert worst(exact, curve, exact.probes(parameters, rng, 5), order) <= LIMIT


@pytest.mark.parametrize("order", [0, 2, 3])
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("n", [60])
def test_bound_for_many_points(exact, rng, n, name, order):
    parameters = exact.parameter_sets(n, rng)[name]
    curve = LagrangeCurve(rng.standard_normal((n, 1)), parameters)
    assert worst(exact, curve, exact.probes(parameters, rng, 2), order) <= LIMIT


@pytest.mark.parametrize(("n", "order"), [(200, 0), (100, 2), (5000, 0)])
def test_bound_for_chebyshev(exact, rng, n, order):
    """4 n roundings of standard deviation u / 2, but for single factors, five of those: 5 sqrt(n).

    Uncorrected differences gave c = 56 for n = 200 and 912 for n = 5000.
    """
    parameters = chebyshev(n)
    curve = LagrangeCurve(rng.standard_normal((n, 1)), parameters)
    t = np.array([parameters[n // 3], np.nextafter(parameters[n // 2], 1.0), 0.123456789, -1e-9])
    nodes = [exact.rational(x) for x in parameters]
    values = curve.evaluate(t, order)
    if n <= 200:
        assert worst(exact, curve, t, order) <= LIMIT
        return
    # Exact weights of 5000 nodes take minutes: all points 1 but for one, which leaves one product.
    for i, x in ((1700, t[2]), (0, t[1]), (4999, t[3])):
        others = [node for j, node in enumerate(nodes) if j != i]
        factors = exact.enclosed((exact.rational(x) - node) / (nodes[i] - node) for node in others)
        product = reduce(lambda a, b: exact.products([a], [b])[0], factors)
        computed = curve.basis(x)[i, 0]
        assert exact.worst_constant(computed, [product]) <= 5.0 * np.sqrt(n)
    assert np.isfinite(values).all()


def test_ten_thousand_chebyshev_points(rng):
    """The sum of the functions is 1 and their absolute sum at most 2/pi log n + 1 (Lebesgue)."""
    curve = LagrangeCurve(rng.standard_normal((10_000, 2)), chebyshev(10_000))
    basis = curve.basis(rng.random(5))[:, :, 0]
    absolute = np.abs(basis).sum(axis=1)
    assert (absolute < 2.0 / np.pi * np.log(10_000) + 1.0).all()
    # 40,000 roundings in every term: 5 sqrt(40,000) u = 1.1e-13.
    assert np.abs(basis.sum(axis=1) - 1.0).max() < 1.2e-13 * absolute.max()
    assert (curve.evaluate(curve.parameters[::101]) == curve.points[::101]).all()


def test_first_derivative_where_all_functions_cancel(exact):
    """Series in plain doubles missed this by c = 432 (n = 20) and 562 (n = 60)."""
    rng = np.random.default_rng(3)
    for _ in range(10):
        parameters = np.sort(rng.random(12)) ** 3
        curve = LagrangeCurve(rng.standard_normal((12, 1)), parameters)
        assert worst(exact, curve, rng.random(10), 2) <= LIMIT


def test_a_parameter_too_small_for_the_scale_is_evaluated(exact):
    """t = 5e-324 scaled to the interval of 1e150 is 0, but is not a node."""
    parameters = 1e150 * np.arange(20) / 19
    curve = LagrangeCurve(np.ones((20, 1)), parameters)
    assert abs(curve.evaluate(5e-324)[0] - 1.0) < 1e-15


def test_nodes_hundreds_of_orders_apart(exact, rng):
    parameters = np.array([-1e150, -1.0, -1e-150, 0.0, 1e-200, 1e-100, 1e100])
    curve = LagrangeCurve(rng.standard_normal((7, 2)), parameters)
    t = np.array([-1e120, -0.3, 1e-170, 3e-200, 1e-101, 5e99, 2e100])
    assert worst(exact, curve, t, 0) <= LIMIT


def test_unrepresentable_values_are_the_largest_number(rng):
    """2000 uniform parameters: L_i reaches 2**1985 next to the ends."""
    curve = LagrangeCurve(rng.standard_normal((2000, 2)), np.arange(2000) / 1999)
    t = np.array([0.5 / 1999, 0.5, 1.0 - 0.3 / 1999])
    for order in (0, 1):
        assert np.isfinite(curve.evaluate(t, order)).all()
        assert np.isfinite(curve.basis(t, order)).all()
    assert np.abs(curve.basis(t)).max() == np.finfo(float).max


@pytest.mark.parametrize(("decades", "orders"), [(50, range(4)), (280, [0])])
def test_parameters_of_very_different_distances(exact, decades, orders):
    """Values at any; derivatives up to 1e50, as the docstring says: at 1e100 they had no right digit."""
    for n in (3, 5, 8):
        t = np.concatenate([[0.0], 10.0 ** np.linspace(-decades, 0, n - 1)])
        curve = LagrangeCurve(np.ones((n, 1)), t)
        nodes = [exact.rational(x) for x in t]
        weights = exact.lagrange_weights(nodes)
        places = np.concatenate([t, 0.5 * (t[1:] + t[:-1])])
        for order in orders:
            basis = curve.basis(places, order)[:, :, 0]
            for row, place in zip(basis, places, strict=True):
                terms = exact.lagrange_terms(exact.rational(place), nodes, order)
                for computed, term, weight in zip(row, terms, weights, strict=True):
                    constant = exact.worst_constant(float(computed), [term * weight])
                    assert constant is None or constant <= 25
