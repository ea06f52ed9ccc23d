"""The oracle: Lagrange and Hermite curves in exact rational arithmetic."""

import math
from math import prod
from types import SimpleNamespace

import numpy as np
import pytest
from flint import arb, ctx, fmpq, fmpz

UNIT_ROUNDOFF = 2.0**-53


def pytest_configure(config):
    """Marks of SciPy's tests, which `test_scipy_suite` imports."""
    for name in ("skip_xp_backends", "xfail_xp_backends", "parallel_threads_limit", "thread_unsafe"):
        config.addinivalue_line("markers", f"{name}: SciPy's")


_BITS = 512


def rational(x):
    numerator, denominator = float(x).as_integer_ratio()
    return fmpq(numerator, denominator)


def lagrange_terms(t, parameters, order):
    """The exact order-th derivatives of all L_i at t."""
    differences = [t - node for node in parameters]
    # As whole numbers of their common unit: products and sums of fractions would each be reduced.
    unit = math.lcm(*(int(each.q) for each in differences))
    whole = [each.p * (unit // int(each.q)) for each in differences]

    def times_factor(series, factor):
        return [a * factor + (series[k - 1] if k else 0) for k, a in enumerate(series)]

    one = [fmpz(1)] + [fmpz(0)] * order
    left, right = [one], [one]
    for factor in whole[:-1]:
        left.append(times_factor(left[-1], factor))
    for factor in whole[:0:-1]:
        right.append(times_factor(right[-1], factor))
    right.reverse()
    coefficients = [
        sum((a[k] * b[order - k] for k in range(order + 1)), fmpz(0))
        for a, b in zip(left, right, strict=True)
    ]
    # Every one is a sum of products of all factors but one and `order` more.
    scale = fmpq(math.factorial(order), unit ** max(len(whole) - 1 - order, 0))
    return [c * scale for c in coefficients]


def lagrange_weights(parameters):
    weights = []
    for i, node in enumerate(parameters):
        differences = [node - other for j, other in enumerate(parameters) if j != i]
        # Reduced once: the numerators of doubles' differences have little in common with powers of two.
        over = prod((each.p for each in differences), start=fmpz(1))
        weights.append(fmpq(prod((each.q for each in differences), start=fmpz(1)), over))
    return weights


HALF, SIXTH = fmpq(1, 2), fmpq(1, 6)
# Power coefficients in s of the cardinal functions, [end][derivative]; written out
# independently of the factored forms under test.
CARDINAL = {
    2: [[[1, 0, -3, 2], [0, 1, -2, 1]], [[0, 0, 3, -2], [0, 0, -1, 1]]],
    3: [
        [[1, 0, 0, -10, 15, -6], [0, 1, 0, -6, 8, -3], [0, 0, HALF, -3 * HALF, 3 * HALF, -HALF]],
        [[0, 0, 0, 10, -15, 6], [0, 0, 0, -4, 7, -3], [0, 0, 0, HALF, -1, HALF]],
    ],
    4: [
        [
            [1, 0, 0, 0, -35, 84, -70, 20],
            [0, 1, 0, 0, -20, 45, -36, 10],
            [0, 0, HALF, 0, -5, 10, -15 * HALF, 2],
            [0, 0, 0, SIXTH, -4 * SIXTH, 1, -4 * SIXTH, SIXTH],
        ],
        [
            [0, 0, 0, 0, 35, -84, 70, -20],
            [0, 0, 0, 0, -15, 39, -34, 10],
            [0, 0, 0, 0, 5 * HALF, -7, 13 * HALF, -2],
            [0, 0, 0, 0, -SIXTH, HALF, -HALF, SIXTH],
        ],
    ],
}


def hermite_terms(t, parameters, width, order):
    """The segment of t, and the exact B_ir of its two ends, [end][r]."""
    n = len(parameters)
    segment = max((i for i in range(n - 1) if parameters[i] <= t), default=0)
    h = parameters[segment + 1] - parameters[segment]
    s = (t - parameters[segment]) / h
    scales = [h**r / h**order for r in range(width)]
    values = []
    for end in CARDINAL[width]:
        row = []
        for r, polynomial in enumerate(end):
            coefficients = list(polynomial)
            for _ in range(order):
                coefficients = [k * c for k, c in enumerate(coefficients)][1:]
            value = fmpq(0)
            for c in reversed(coefficients):
                value = value * s + c
            row.append(value * scales[r])
        values.append(row)
    return segment, values


def enclosed(numbers):
    """Intervals of some 2^-512 of their size around exact numbers, to multiply without long fractions."""
    with ctx.workprec(_BITS):
        return [arb(x) for x in numbers]


def products(first, second):
    """The products of intervals in pairs, enclosed."""
    with ctx.workprec(_BITS):
        return [a * b for a, b in zip(first, second, strict=True)]


# No double holds a result outside of these to full precision.
_SMALLEST, _LARGEST = fmpq(1, 10**285), fmpq(10) ** 305


def worst_constant(computed, terms):
    """|computed - sum of terms| in units of u times the sum of their sizes; None if out of range.

    The terms are exact, or intervals of the precision below. Their sums, whose common denominators are longer
    by far than all of them, lie in intervals of some 2^-500 of their size; the upper end counts.
    """
    if not any(terms):
        return 0.0 if computed == 0 else math.inf
    with ctx.workprec(_BITS):
        enclosed = [arb(x) for x in terms]
        scale = sum((abs(x) for x in enclosed), arb(0))
        if not _SMALLEST < scale < _LARGEST:
            return None
        ratio = abs(arb(rational(computed)) - sum(enclosed, arb(0))) / scale
        return float((ratio / UNIT_ROUNDOFF).abs_upper())


def parameter_sets(n, rng):
    """The parameters that issue 2 names, for n points."""
    k = np.arange(n)
    uniform = k / (n - 1)
    near = min(6, n)
    return {
        "uniform": uniform,
        "random": np.sort(rng.random(n)),
        "clustered": np.sort(np.concatenate((rng.random(n - near), 0.4 + 1e-3 * rng.random(near)))),
        "geometric": 2.0 ** -k[::-1],
        "shifted": 1e6 + uniform,
        "small": 1e-150 * uniform,
        "large": 1e150 * uniform,
        "chebyshev": np.sin(k * (np.pi / (2 * (n - 1)))) ** 2,
    }


def probes(parameters, rng, count):
    """Parameters at, one ulp beside, between and outside some t_i."""
    i = rng.integers(0, len(parameters) - 1, count)
    first, last = parameters[0], parameters[-1]
    at = np.concatenate((parameters[i], [first, last]))
    # Next to 0 lie subnormals, whose products no format holds; the smallest normal stands for them.
    tiny = np.finfo(float).tiny
    with np.errstate(under="ignore"):
        above, below = np.nextafter(at, np.inf), np.nextafter(at, -np.inf)
    above[above < tiny], below[np.abs(below) < tiny] = np.maximum(above[above < tiny], tiny), -tiny
    between = first + (last - first) * rng.random(count)
    middle = 0.5 * (parameters[i] + parameters[i + 1])
    outside = [first - 0.1 * (last - first), last + 0.3 * (last - first)]
    return np.concatenate((at, above, below, between, middle, outside))


@pytest.fixture(scope="session")
def exact():
    return SimpleNamespace(
        rational=rational,
        lagrange_terms=lagrange_terms,
        lagrange_weights=lagrange_weights,
        hermite_terms=hermite_terms,
        enclosed=enclosed,
        products=products,
        worst_constant=worst_constant,
        parameter_sets=parameter_sets,
        probes=probes,
    )


@pytest.fixture
def rng():
    return np.random.default_rng(20240229)


@pytest.fixture(autouse=True)
def floating_point_errors_raise():
    """No operation of the core may overflow, underflow or be invalid, even unseen."""
    with np.errstate(all="raise"):
        yield
