"""k-digit results, digit for digit, against arithmetic on integers that knows nothing of `decimal`."""

import pkgutil
from functools import reduce
from operator import add, mul

import numpy as np
import pytest
from flint import fmpq

from curvecore import (
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    Method,
    QuinticHermiteCurve,
    SepticHermiteCurve,
    available_methods,
    chebyshev,
    digits_lost,
    evaluate_rounded,
    exact_values,
    natural_spline_accelerations,
    natural_spline_velocities,
    operation_counts,
    round_data,
    rounded_decimals,
    uniform,
)
from curvecore.arrays import parameter_array
from curvecore.rounding.decimal_methods import HERMITE_METHODS, LAGRANGE_METHODS, Data
from tests.effort import calls_of
from tests.rows import each_row

TEN = fmpq(10)


def exact(value):
    """A number of any kind, as a fraction."""
    return value if isinstance(value, fmpq) else fmpq(*value.as_integer_ratio())


class Digits:
    """A number whose every operation is rounded to k digits, half to even, by integer division."""

    def __init__(self, value, k):
        self.value, self.k = exact(value), k

    def rounded(self, value):
        if value == 0:
            return Digits(0, self.k)
        above, below = abs(value.p), value.q
        exponent = len(str(above)) - len(str(below)) - self.k
        if above >= below * TEN ** (exponent + self.k):
            exponent += 1
        unit = TEN**exponent
        whole, rest = divmod(above * unit.q, below * unit.p)
        whole += 2 * rest + whole % 2 > below * unit.p
        return Digits((whole if value > 0 else -whole) * unit, self.k)

    def __add__(self, other):
        return self.rounded(self.value + other.value) if isinstance(other, Digits) else NotImplemented

    def __sub__(self, other):
        return self.rounded(self.value - other.value) if isinstance(other, Digits) else NotImplemented

    def __mul__(self, other):
        return self.rounded(self.value * other.value) if isinstance(other, Digits) else NotImplemented

    def __truediv__(self, other):
        return self.rounded(self.value / other.value) if isinstance(other, Digits) else NotImplemented

    def __abs__(self):
        return Digits(abs(self.value), self.k)

    def __gt__(self, other):
        return self.value > other.value


def digits_array(values, k):
    array = np.empty(np.shape(values), dtype=object)
    for index, value in np.ndenumerate(values):
        array[index] = Digits(float(value), k)
    return array


def without(array, i):
    return [x for j, x in enumerate(array) if j != i]


def solved(matrix, right):
    """Elimination with whole rows of numpy objects."""
    work = np.concatenate((matrix, right), axis=1)
    n = len(matrix)
    for k in range(n):
        sizes = [abs(x) for x in work[k:, k]]
        pivot = k
        for offset, size in enumerate(sizes):
            if size > sizes[pivot - k]:
                pivot = k + offset
        work[[k, pivot]] = work[[pivot, k]]
        for i in range(k + 1, n):
            work[i, k + 1 :] = work[i, k + 1 :] - (work[i, k] / work[k, k]) * work[k, k + 1 :]
    result = work[:, n:].copy()
    for k in reversed(range(n)):
        for j in range(k + 1, n):
            result[k] = result[k] - work[k, j] * result[j]
        result[k] = result[k] / work[k, k]
    return result


def powers(t, count):
    row = [Digits(1, t.k), t]
    while len(row) < count:
        row.append(row[-1] * t)
    return row[:count]


def horner(coefficients, t):
    return reduce(lambda value, a: value * t + a, coefficients[:-1][::-1], coefficients[-1])


def independent(method, p, nodes, t):
    """The value at one t, as a row of objects."""
    n = len(nodes)
    if method == "monomial":
        matrix = np.array([powers(node, n) for node in nodes], dtype=object)
        return horner(solved(matrix, p), t)
    if method == "newton":
        table = [p]
        for order in range(1, n):
            above = table[-1]
            gaps = nodes[order:] - nodes[:-order]
            table.append((above[1:] - above[:-1]) / gaps[:, None])
        result = table[-1][0]
        for order in reversed(range(n - 1)):
            result = result * (t - nodes[order]) + table[order][0]
        return result
    if method == "lagrange":
        terms = []
        for i in range(n):
            above = reduce(mul, [t - node for node in without(nodes, i)])
            below = reduce(mul, [nodes[i] - node for node in without(nodes, i)])
            terms.append(p[i] * (above / below))
        return reduce(add, terms)
    one = Digits(1, t.k)
    for i, node in enumerate(nodes):
        if node.value == t.value:
            return np.array([one * x for x in p[i]])
    weights = [one / reduce(mul, [nodes[i] - node for node in without(nodes, i)]) for i in range(n)]
    shares = [w / (t - node) for w, node in zip(weights, nodes, strict=True)]
    return reduce(add, [q * x for q, x in zip(shares, p, strict=True)]) / reduce(add, shares)


def independent_hermite(method, jets, ends, t):
    """The value at one t on a segment between two ends with jets (2, R, dim) of objects."""
    k, width = t.k, jets.shape[1]
    if method == "monomial":
        rows = []
        for end in ends:
            row = powers(end, 2 * width)
            zero = Digits(0, k)
            slopes = [zero] + [Digits(j, k) * row[j - 1] for j in range(1, 2 * width)]
            bends = [zero, zero] + [Digits(j * (j - 1), k) * row[j - 2] for j in range(2, 2 * width)]
            turns = [zero] * 3 + [Digits(j * (j - 1) * (j - 2), k) * row[j - 3] for j in range(3, 2 * width)]
            rows.extend([row, slopes, bends, turns][:width])
        return horner(solved(np.array(rows, dtype=object), jets.reshape(2 * width, -1)), t)
    h = ends[1] - ends[0]
    s, r = (t - ends[0]) / h, (ends[1] - t) / h
    terms = []
    for data, near, far, step in ((jets[0], s, r, h), (jets[1], r, s, Digits(0, k) - h)):
        if width == 2:
            square = far * far
            weights = [square * (far + Digits(3, k) * near), square * near * step]
        elif width == 4:
            square, near_square, step_square = far * far, near * near, step * step
            fourth = square * square
            once = fourth * near
            twice = once * near
            inner = square * far + Digits(7, k) * square * near
            inner = inner + Digits(21, k) * far * near_square + Digits(35, k) * near_square * near
            slope = square + Digits(6, k) * far * near + Digits(15, k) * near * near
            weights = [
                fourth * inner,
                once * slope * step,
                twice / Digits(2, k) * (far + Digits(5, k) * near) * step_square,
                twice * near / Digits(6, k) * (step_square * step),
            ]
        else:
            square = far * far
            cube = square * far
            inner = square + Digits(5, k) * far * near + Digits(10, k) * near * near
            slope = cube * near * (far + Digits(4, k) * near) * step
            bend = cube * near * near / Digits(2, k) * (step * step)
            weights = [cube * inner, slope, bend]
        terms.extend(w * d for w, d in zip(weights, data, strict=True))
    return reduce(add, terms)


def as_fractions(decimals):
    return [[exact(x) for x in row] for row in decimals]


@each_row("method", available_methods(0))
@each_row("digits", [2, 3, 8, 16])
@each_row("n", [2, 3, 6, 10])
def test_polynomials_digit_for_digit(rng, method, digits, n):
    for t, shift in ((chebyshev(n), 0.0), (uniform(n), 100.0)):
        if digits < 5 and shift and method == "monomial":
            continue  # powers of 100 .. 101 with 3 digits make the system singular; see below
        points = rng.standard_normal((n, 2))
        where = shift + np.append(rng.random(3), t[1])
        found = as_fractions(rounded_decimals(points, shift + t, where, method, digits))
        p, nodes = digits_array(points, digits), digits_array(shift + t, digits)
        for x, row in zip(where, found, strict=True):
            expected = independent(method, p, nodes, Digits(float(x), digits))
            assert row == [each.value for each in expected]


@each_row("method", available_methods(1))
@each_row("digits", [2, 4, 8, 16])
@each_row("width", [2, 3, 4])
def test_hermite_curves_digit_for_digit(rng, method, digits, width):
    t = np.array([0.5, 1.0, 1.75, 3.0])
    jets = rng.standard_normal((4, width, 2))
    where = np.append(t, 0.5 + 2.5 * rng.random(6))
    found = as_fractions(
        rounded_decimals(jets[:, 0], t, where, method, digits, *np.moveaxis(jets[:, 1:], 1, 0))
    )
    data, nodes = digits_array(jets, digits), digits_array(t, digits)
    for x, row in zip(where, found, strict=True):
        i = min(int(np.searchsorted(t, x, side="right")) - 1, 2)
        expected = independent_hermite(method, data[i : i + 2], nodes[i : i + 2], Digits(float(x), digits))
        assert row == [each.value for each in expected]


def test_rounding_matches_a_computation_by_hand_with_two_digits():
    """Through (0, 1), (0.5, 0.33), (1, 2) at t = 0.3 with two digits.

    L: 0.14 / 0.5 = 0.28, -0.21 / -0.25 = 0.84, -0.06 / 0.5 = -0.12, all exact;
    0.28 + 0.84 0.33 (0.2772, rounded 0.28) = 0.56, minus 0.24 is 0.32.
    """
    points, t = [[1.0], [0.33], [2.0]], [0.0, 0.5, 1.0]
    (row,) = rounded_decimals(points, t, 0.3, "lagrange", 2)
    assert str(row[0]) == "0.32"
    assert evaluate_rounded(points, t, 0.3, "lagrange", 2).tolist() == [[0.32]]


def test_results_have_at_most_that_many_digits(rng):
    points = rng.standard_normal((8, 3))
    for method in available_methods(0):
        for digits in (2, 7, 16):
            rows = rounded_decimals(points, uniform(8), rng.random(20), method, digits)
            assert max(len(x.as_tuple().digits) for row in rows for x in row) <= digits


@each_row("digits", [4, 8, 12, 16])
def test_stable_methods_keep_the_digits(rng, digits):
    n = 8
    t = chebyshev(n)
    points, where = rng.standard_normal((n, 2)), np.linspace(0.0, 1.0, 37)
    truth = exact_values(points, t, where)
    lost = {
        m: digits_lost(evaluate_rounded(points, t, where, m, digits), truth, digits)
        for m in available_methods(0)
    }
    for method in ("lagrange", "barycentric"):
        # Some 4 n roundings of sum |L_i p_i|, which is at most 2.2 times the size.
        assert lost[method].max() <= np.log10(4 * n * 2.5)
    assert lost["monomial"].max() > lost["lagrange"].max() + 1.0


@pytest.mark.parametrize("digits", [5, 7])
def test_shifting_t_ruins_monomials_and_leaves_lagrange_alone(rng, digits):
    n = 6
    t = uniform(n)
    # Few bits, so that nothing is rounded when 100 is added.
    t = np.round(t * 64.0) / 64.0
    where = np.round(np.linspace(0.0, 1.0, 40) * 256.0) / 256.0
    points = rng.standard_normal((n, 2))
    velocities = natural_spline_velocities(points, t)
    truth = exact_values(points, t, where)
    assert (exact_values(points, t + 100.0, where + 100.0) == truth).all()
    for method in ("newton", "lagrange", "barycentric"):
        plain, shifted = (evaluate_rounded(points, t + s, where + s, method, digits) for s in (0.0, 100.0))
        assert (plain == shifted).all()
    shifted = evaluate_rounded(points, t + 100.0, where + 100.0, "monomial", digits)
    assert np.median(digits_lost(shifted, truth, digits)) > digits - 1.5
    plain, shifted = (
        evaluate_rounded(points, t + s, where + s, "basis", digits, velocities) for s in (0.0, 100.0)
    )
    assert (plain == shifted).all()
    smooth = exact_values(points, t, where, velocities)
    shifted = evaluate_rounded(points, t + 100.0, where + 100.0, "monomial", digits, velocities)
    assert digits_lost(shifted, smooth, digits).max() > 3.0


def test_a_system_that_rounding_makes_singular_is_not_a_number():
    """With two digits 1.01 and 1.02 squared are both 1.0, and the third power as well."""
    t = [1.0, 1.01, 1.02]
    found = evaluate_rounded([[0.0], [1.0], [2.0]], t, [1.0, 1.015], "monomial", 2)
    assert np.isnan(found).all()
    assert digits_lost(found, [[0.0], [1.5]], 2).tolist() == [2.0, 2.0]


@pytest.mark.parametrize("n", [2, 5, 9])
def test_exact_values_are_the_nearest_doubles(rng, exact, n):
    t = np.sort(rng.random(n))
    points, velocities, accelerations, jerks = rng.standard_normal((4, n, 2))
    where = np.append(rng.random(6), t[1])
    nodes = [exact.rational(x) for x in t]
    weights = exact.lagrange_weights(nodes)
    found = exact_values(points, t, where)
    for x, row in zip(where, found, strict=True):
        terms = exact.lagrange_terms(exact.rational(x), nodes, 0)
        for axis in range(2):
            total = sum(
                w * v * exact.rational(p[axis]) for w, v, p in zip(weights, terms, points, strict=True)
            )
            assert row[axis] == int(total.p) / int(total.q)
    for data, curve in (
        ((velocities, None), HermiteCurve(points, velocities, t)),
        ((velocities, accelerations), QuinticHermiteCurve(points, velocities, accelerations, t)),
        ((velocities, accelerations, jerks), SepticHermiteCurve(points, velocities, accelerations, jerks, t)),
    ):
        # Against the core, whose error is a few u sum |B d|, and that is of the size of the data here.
        expected = curve.evaluate(where[where >= t[0]])
        computed = exact_values(points, t, where[where >= t[0]], *data)
        assert computed == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.abs(expected).max())


def test_sixteen_digits_are_as_good_as_doubles(rng):
    points, t = rng.standard_normal((9, 2)), chebyshev(9)
    where = np.linspace(0.0, 1.0, 50)
    assert evaluate_rounded(points, t, where, "lagrange", 16) == pytest.approx(
        LagrangeCurve(points, t).evaluate(where), abs=1e-14
    )


def test_rounding_of_data():
    assert round_data([[0.125, 0.375], [2.675, -0.0051]], 2).tolist() == [[0.12, 0.38], [2.68, -0.01]]
    assert round_data(0.5, 0) == 0.0
    assert round_data(1.0 / 3.0, 3) == 0.333
    assert round_data([1e300, 5e-324], 3).tolist() == [1e300, 0.0]
    for bad in ([np.nan], [np.inf]):
        with pytest.raises(CurveError):
            round_data(bad, 2)
    with pytest.raises(CurveError, match="decimals must be at least 0"):
        round_data([1.0], -1)


def test_digits_lost():
    exact = np.array([[1.0, 0.0], [2.0, 1.0], [0.5, 0.5], [0.5, 0.5]])
    computed = np.add(exact, [[0.0, 0.0], [0.0, 1e-3], [1e-2, 0.0], [np.nan, 0.0]])
    # The scale is 2: half a unit of the fourth digit is 5e-4 times 2.
    assert digits_lost(computed, exact, 4) == pytest.approx([0.0, 0.0, 1.0, 4.0])
    assert digits_lost(computed, exact, 4, scale=0.2) == pytest.approx([0.0, 1.0, 2.0, 4.0])
    assert digits_lost(np.zeros((2, 1)), np.zeros((2, 1)), 4).tolist() == [0.0, 0.0]
    with pytest.raises(CurveError, match="same shape"):
        digits_lost(np.zeros((2, 1)), np.zeros((3, 1)), 4)


class Counting:
    """Counts the operations done by a context of 30 digits."""

    def __init__(self):
        from decimal import Context

        self.context, self.count = Context(prec=30), 0

    def __getattr__(self, name):
        operation = getattr(self.context, name)

        def counted(*numbers):
            self.count += 1
            return operation(*numbers)

        return counted


@each_row("derivatives", [0, 1, 2, 3])
@each_row("n", [2, 3, 7])
@each_row("dim", [1, 2, 3])
def test_operations_are_counted_right(rng, derivatives, n, dim):
    from decimal import Decimal

    t = parameter_array(np.arange(n), n)
    data = Data(t, rng.standard_normal((n, derivatives + 1, dim)))
    table = HERMITE_METHODS if derivatives else LAGRANGE_METHODS
    for method in available_methods(derivatives):
        for count in (n - 1, 2 * (n - 1)):  # every segment is used
            counting = Counting()
            where = [Decimal(float(x)) for x in np.linspace(0.2, n - 1.2, count)]
            if count == 1:
                where = [Decimal("0.3")]
            table[method](data, where, counting)
            assert operation_counts(method, n, dim, derivatives).total(count) == counting.count


def test_costs_grow_by_the_stated_power_of_the_points():
    big, small = (operation_counts("monomial", n).setup for n in (200, 100))
    assert big / small == pytest.approx(8.0, rel=0.05)
    big, small = (operation_counts("lagrange", n).per_point for n in (200, 100))
    assert big / small == pytest.approx(4.0, rel=0.05)
    with pytest.raises(CurveError, match="does not apply to data with 1 derivatives"):
        operation_counts("newton", 5, 2, 1)


def test_twice_the_parameters_are_at_most_twice_the_work(rng):
    n = 12
    points, t = rng.standard_normal((n, 2)), uniform(n)
    velocities, accelerations = natural_spline_velocities(points, t), natural_spline_accelerations(points, t)
    for derivatives in ((), (velocities, accelerations)):
        for method in available_methods(len(derivatives)):

            def calls_for(count, method=method, derivatives=derivatives):
                where = np.linspace(0.0, 1.0, count)
                return calls_of(lambda: evaluate_rounded(points, t, where, method, 6, *derivatives))

            calls = calls_for(200)
            assert calls < 2.2 * calls_for(100)
            assert calls < 100_000


def test_the_positional_form_and_enumerations_agree():
    points, t = [[0, 0], [1, 2], [3, 1]], [0, 0.5, 1]
    plain = evaluate_rounded(points, t, [0.1, 0.2], "barycentric", 5)
    assert plain.shape == (2, 2)
    assert (evaluate_rounded(points, t, [0.1, 0.2], Method.BARYCENTRIC, 5) == plain).all()
    assert evaluate_rounded(points, t, [], "newton", 5).shape == (0, 2)


def test_huge_and_tiny_numbers_are_limited():
    points = np.array([[1.7e308], [-1.7e308], [1.7e308]])
    found = evaluate_rounded(points, [0, 1, 2], [1e3], "newton", 4)
    assert found == np.finfo(float).max
    tiny = 1e-300 * (points / 1.7e308)
    assert evaluate_rounded(tiny, [0, 1, 2], [0.5], "lagrange", 4)[0, 0] == pytest.approx(-0.5e-300)


def test_unusable_arguments():
    points, t = [[0, 0], [1, 2]], [0, 1]
    for digits in (1, 17, 2.5):
        with pytest.raises(CurveError, match="digits must be"):
            evaluate_rounded(points, t, [0.5], "newton", digits)
    for method, rest in (("basis", ()), ("newton", (points,)), ("horner", ())):
        with pytest.raises(CurveError, match="method must be one of"):
            evaluate_rounded(points, t, [0.5], method, 5, *rest)
    with pytest.raises(CurveError, match="accelerations need velocities"):
        evaluate_rounded(points, t, [0.5], "basis", 5, accelerations=points)
    with pytest.raises(CurveError, match="jerks need accelerations"):
        evaluate_rounded(points, t, [0.5], "basis", 5, velocities=points, jerks=points)


def test_no_module_that_is_imported_late_has_the_name_of_a_function():
    """`from curvecore import OperationCounts, operation_counts` gave a module: importing it took the name."""
    import curvecore

    modules = {each.name for each in pkgutil.walk_packages(curvecore.__path__, "curvecore.")}
    assert not {name.rpartition(".")[2] for name in modules if name.count(".") == 1} & set(curvecore.__all__)
    assert "curvecore.rounding.operations" in modules
