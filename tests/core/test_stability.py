"""Lebesgue constants, condition numbers."""

import math
from itertools import pairwise

import numpy as np
import pytest
from flint import fmpq, fmpq_mat, fmpq_poly

from curvecore import (
    Chain,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    QuinticHermiteCurve,
    chebyshev,
    derivative_sums,
    lebesgue_constant,
    lebesgue_function,
    monomial_condition,
    segment_conditions,
    uniform,
    vandermonde_condition,
)
from tests.rows import each_row

# J. Burkardt, LEBESGUE, the output that comes with it (2014): 2 .. 11 points from -1 to 1, the largest of the
# Lebesgue function's values at 501 equally spaced places, hence at most the constant and near it.
EQUALLY_SPACED = "1 1.25 1.63112 2.20782 3.10628 4.54872 6.92945 10.9444 17.8449 29.8907"
CHEBYSHEV = "1 1.25 1.66667 1.79876 1.98885 2.08255 2.20221 2.27461 2.36186 2.42097"
# The same for equally spaced points that lack both ends: 2^n - 1, which is at the ends.
INNER = [3, 7, 15, 31, 63, 127, 255, 511, 1023, 2047]
PLACES = np.linspace(-1.0, 1.0, 501)


def with_parameters(t):
    return LagrangeCurve(np.zeros((len(t), 2)), t)


def exact_constant(nodes):
    """The maximum of sum |L_i| in exact arithmetic: on each interval a polynomial, its slope halved down."""
    basis = []
    for i, node in enumerate(nodes):
        factor = fmpq_poly([1])
        for j, other in enumerate(nodes):
            if j != i:
                factor *= fmpq_poly([-other, 1]) / (node - other)
        basis.append(factor)
    best = fmpq(1)
    for left, right in pairwise(nodes):
        low, high = left, right
        middle = (low + high) / 2
        total = sum((p if p(middle) > 0 else -p for p in basis), fmpq_poly([0]))
        slope = total.derivative()
        if len(nodes) == 2:
            continue
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if slope(middle) > 0 else (low, middle)
        best = max(best, total(low))
    return float(int(best.p)) / float(int(best.q)) if best.q < 10**300 else int(best.p) / int(best.q)


@each_row("n", range(1, 21))
def test_uniform_parameters(n):
    found = lebesgue_constant(with_parameters(np.arange(n + 1.0)))
    assert found == pytest.approx(exact_constant([fmpq(k) for k in range(n + 1)]), rel=1e-12)
    assert lebesgue_constant(with_parameters(uniform(n + 1))) == pytest.approx(found, rel=1e-12)


@pytest.mark.parametrize(("published", "rule"), [(EQUALLY_SPACED, uniform), (CHEBYSHEV, chebyshev)])
def test_against_published_values(published, rule):
    for n, printed in enumerate(published.split(), start=2):
        curve = with_parameters(2.0 * rule(n) - 1.0)
        sampled = lebesgue_function(curve, PLACES).max()
        assert f"{sampled:.6g}" == printed
        # Between two places 1/250 apart the function rises by little.
        assert sampled <= lebesgue_constant(curve) * (1 + 1e-12) <= sampled * 1.0005


def test_outside_the_domain_against_published_values():
    for n, published in enumerate(INNER, start=2):
        t = np.linspace(-1.0, 1.0, n + 2)[1:-1]
        assert lebesgue_function(with_parameters(t), PLACES).max() == pytest.approx(published, rel=1e-13)


@each_row("seed", range(4))
def test_random_parameters(exact, seed):
    t = np.sort(np.random.default_rng(seed).random(9))
    expected = exact_constant([exact.rational(x) for x in t])
    assert lebesgue_constant(with_parameters(t)) == pytest.approx(expected, rel=1e-12)


@each_row("n", [3, 6, 12, 24, 49])
def test_chebyshev_points_of_odd_degree(n):
    """Below 2/pi log(n + 1) + 1; for odd n the cotangent sum of Ehlich and Zeller (1966)."""
    found = lebesgue_constant(with_parameters(chebyshev(n + 1)))
    assert found <= 2.0 / np.pi * np.log(n + 1) + 1.0
    if n % 2:
        k = np.arange(1, n + 1)
        cotangents = np.sum(1.0 / np.tan((2 * k - 1) * np.pi / (4 * n))) / n
        assert found == pytest.approx(cotangents, rel=1e-12)


def test_the_constant_is_reached_and_never_exceeded(rng):
    for t in (uniform(13), chebyshev(20), np.sort(rng.random(11)), 1e6 + uniform(8), 1e-150 * uniform(8)):
        curve = with_parameters(t)
        constant = lebesgue_constant(curve)
        samples = lebesgue_function(curve, np.linspace(t[0], t[-1], 20001))
        assert samples.max() <= constant * (1.0 + 1e-12)
        assert samples.max() >= constant * (1.0 - 1e-4)
        assert samples.min() >= 1.0 - 1e-14


def test_hundreds_of_uniform_parameters_stay_finite():
    assert np.isfinite(lebesgue_constant(with_parameters(uniform(300))))
    assert np.isfinite(lebesgue_constant(with_parameters(uniform(600))))


def test_hermite_families(rng):
    t = np.array([0.0, 0.5, 2.0])
    data = rng.standard_normal((3, 3, 2))
    where = np.linspace(0.0, 2.0, 4001)
    h = 1.5
    for curve, largest in (
        (HermiteCurve(*data[:2], t), [h / 4]),
        (QuinticHermiteCurve(*data, t), [5 * h / 16, h * h / 32]),
    ):
        assert lebesgue_constant(curve) == 1.0
        assert np.abs(lebesgue_function(curve, where) - 1.0).max() <= 1e-15
        assert derivative_sums(curve, where).max(axis=0) == pytest.approx(largest, rel=1e-6)
        basis = np.abs(curve.basis(where)).sum(axis=1)
        assert derivative_sums(curve, where) == pytest.approx(basis[:, 1:], abs=1e-15)
        assert derivative_sums(curve, 0.3).shape == (len(largest),)


def test_chains_and_scalars():
    chain = Chain([with_parameters(np.arange(6.0)), with_parameters(np.arange(5.0, 8.0))])
    assert lebesgue_constant(chain) == pytest.approx(3.1063, rel=1e-4)
    assert lebesgue_function(chain, [6.5])[0] == pytest.approx(1.25)
    assert lebesgue_function(chain, 1.0).shape == ()
    assert derivative_sums(with_parameters(uniform(4)), [0.1, 0.2]).shape == (2, 0)


def float_norm(matrix, norm):
    return np.linalg.norm(
        np.array([[float(int(x.p) / int(x.q)) for x in row] for row in matrix.tolist()]), norm
    )


def confluent(nodes, width):
    size = len(nodes) * width
    return fmpq_mat(
        [
            [math.perm(k, r) * node ** (k - r) if k >= r else fmpq(0) for k in range(size)]
            for node in nodes
            for r in range(width)
        ]
    )


@pytest.mark.parametrize("n", [2, 5, 10, 20])
def test_vandermonde_matrices(exact, n):
    for t in (uniform(n), chebyshev(n), 100.0 + uniform(n)):
        matrix = confluent([exact.rational(x) for x in t], 1)
        inverse = matrix.inv()
        for norm in (1, 2, np.inf):
            truth = float_norm(matrix, norm) * float_norm(inverse, norm)
            assert vandermonde_condition(t, norm) == pytest.approx(truth, rel=1e-12)


def test_known_condition_numbers():
    """Of the rows (1, 0) and (1, 1) the golden ratio squared; the farther from 0, the worse."""
    assert vandermonde_condition([0.0, 1.0]) == pytest.approx(((1.0 + 5.0**0.5) / 2.0) ** 2, rel=1e-14)
    shifts = [vandermonde_condition(np.linspace(a, b, 10)) for a, b in ((-1, 1), (0, 1), (1, 2), (100, 101))]
    assert shifts == sorted(shifts)
    assert shifts[-1] > 1e40  # numpy's own would say 1e20: the smallest singular value is noise


@pytest.mark.parametrize("derivatives", [1, 2])
def test_confluent_matrices(exact, derivatives):
    t = np.array([0.0, 0.3, 1.0, 1.75])
    matrix = confluent([exact.rational(x) for x in t], derivatives + 1)
    truth = float_norm(matrix, 2) * float_norm(matrix.inv(), 2)
    assert vandermonde_condition(t, 2, derivatives) == pytest.approx(truth, rel=1e-12)
    segments = segment_conditions(t, derivatives)
    assert segments.shape == (3,)
    for i in range(3):
        matrix = confluent([exact.rational(x) for x in t[i : i + 2]], derivatives + 1)
        assert segments[i] == pytest.approx(float_norm(matrix, 2) * float_norm(matrix.inv(), 2), rel=1e-12)


def test_the_condition_of_a_curve(rng):
    t = uniform(4)
    data = rng.standard_normal((3, 4, 2))
    lagrange, hermite = LagrangeCurve(data[0], t), HermiteCurve(*data[:2], t)
    assert monomial_condition(lagrange) == vandermonde_condition(t)
    assert monomial_condition(hermite, 1) == segment_conditions(t, 1, 1).max()
    assert monomial_condition(QuinticHermiteCurve(*data, t)) == segment_conditions(t, 2).max()
    assert monomial_condition(Chain([hermite])) == monomial_condition(hermite)


def test_unusable_arguments():
    with pytest.raises(CurveError, match="norm must be 1, 2 or infinity"):
        vandermonde_condition([0, 1], 3)
    with pytest.raises(CurveError, match="at most 128 rows"):
        vandermonde_condition(uniform(50), 2, 2)
    with pytest.raises(CurveError, match="strictly increasing"):
        vandermonde_condition([1, 0])
