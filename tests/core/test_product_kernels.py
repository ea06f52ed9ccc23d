"""Single Lagrange functions and their derivatives, by kernels and blocks, against exact fractions."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from curvecore import LagrangeCurve, chebyshev, uniform
from curvecore.families.lagrange import ProductForm
from curvecore.families.products import weight_blocks

profile = settings(derandomize=True, deadline=None, max_examples=60)
LIMIT = 50.0
"""The one of test_lagrange_accuracy."""


def assert_relatively_accurate(exact, parameters, t, order):
    nodes = [exact.rational(x) for x in parameters]
    weights = exact.enclosed(exact.lagrange_weights(nodes))
    basis = LagrangeCurve(np.ones((len(parameters), 1)), parameters).basis(t, order)[:, :, 0]
    for row, x in zip(basis, t, strict=True):
        terms = exact.enclosed(exact.lagrange_terms(exact.rational(x), nodes, order))
        for value, term in zip(row, exact.products(terms, weights), strict=True):
            constant = exact.worst_constant(value, [term])
            assert constant is None or constant <= LIMIT


@pytest.mark.parametrize("order", [1, 2, 3])
@profile
@given(data=st.data())
def test_every_derivative_has_a_small_relative_error(exact, order, data):
    gaps = data.draw(st.lists(st.floats(1e-4, 1.0), min_size=1, max_size=24))
    parameters = data.draw(st.sampled_from([0.0, -0.5, 1e3])) + np.cumsum([0.0, *gaps])
    places = data.draw(st.lists(st.floats(-0.2, 1.2), min_size=1, max_size=4))
    with np.errstate(under="ignore"):
        t = parameters[0] + (parameters[-1] - parameters[0]) * np.array(places)
        beside = np.nextafter(parameters[:3], np.inf)
    t = np.concatenate([t, parameters[:3], beside])
    assert_relatively_accurate(exact, parameters, t[(np.abs(t) > 1e-300) | (t == 0.0)], order)


@pytest.mark.parametrize("n", [5, 21])
def test_the_slope_that_symmetry_makes_tiny_keeps_its_digits(exact, n):
    """At the parameter in the middle its own function is as good as level: S_k is 0 or 1e-16 of its terms."""
    for parameters in (uniform(n), chebyshev(n), 0.1 * np.arange(n), np.arange(n) - (n - 1) / 2):
        assert_relatively_accurate(exact, parameters, parameters[n // 2 : n // 2 + 1], 1)


def derivatives_that_vanish(parameters, order):
    """The doubles nearest to where a derivative of the function in the middle changes its sign."""
    curve = LagrangeCurve(np.eye(len(parameters))[:, [len(parameters) // 2]], parameters)
    found = []
    for low, high in pairwise(parameters):
        start, end = np.nextafter(low, 9.0), np.nextafter(high, -9.0)
        a, b = (float(curve.evaluate(x, order)[0]) for x in (start, end))
        if a * b < 0.0:
            for _ in range(80):
                middle = 0.5 * (start + end)
                rising = float(curve.evaluate(middle, order)[0]) * a > 0.0
                start, end = (middle, end) if rising else (start, middle)
            found += [start, end]
    return np.array(found)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_derivatives_beside_their_zeros(exact, order):
    """A rounding of t away from a zero of one of L_i; 50 of 106 digits are left of what cancels."""
    parameters = np.sort(np.random.default_rng(2).random(9))
    t = derivatives_that_vanish(parameters, order)
    assert len(t) > 4
    assert_relatively_accurate(exact, parameters, t, order)


@pytest.mark.parametrize("order", range(4))
def test_weights_that_span_thousands_of_bits(exact, order):
    """At equal parameters from some 800 on no range holds them; sums of all functions are 1 and 0."""
    n = 1500
    parameters = uniform(n)
    assert len(ProductForm.of(parameters).blocks) > 2
    middle = np.array([0.5001, 0.49 + 1e-5, parameters[700], np.nextafter(parameters[701], 1.0)])
    curve = LagrangeCurve(np.stack([np.ones(n), parameters], axis=1), parameters)
    values, basis = curve.evaluate(middle, order), curve.basis(middle, order)[:, :, 0]
    size = np.abs(basis).sum(axis=1)
    # Roundings of 4 n factors, as if independent: five times 2 sqrt(n) / 2.
    bound = 5.0 * np.sqrt(n) * 2.0**-53 * size
    columns = {0: (np.ones(4), middle), 1: (np.zeros(4), np.ones(4))}
    expected = np.stack(columns.get(order, (np.zeros(4), np.zeros(4))), axis=1)
    assert (np.abs(values - expected) <= bound[:, None]).all()
    with np.errstate(under="ignore"):
        assert (np.abs(basis @ curve.points - expected) <= 2.0 * bound[:, None]).all()
    # Where functions are beyond all doubles.
    assert np.isfinite(curve.evaluate(0.5 / n, order)).all()
    assert np.isfinite(curve.basis(0.5 / n, order)).all()


def test_blocks_hold_all_weights():
    weights = ProductForm.of(uniform(1500)).weights
    blocks = weight_blocks(weights)
    assert [block.rows.start for block in blocks] == [0, *(block.rows.stop for block in blocks[:-1])]
    assert blocks[-1].rows.stop == 1500
    for block in blocks:
        assert (np.abs(np.log2(np.abs(block.weights))) <= 203).all()
        exponent = (weights.exponent[block.rows] - block.exponent).astype(np.intc)
        assert (block.weights == np.ldexp(weights.mantissa[block.rows], exponent)).all()
