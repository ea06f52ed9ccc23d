"""Bezier curves and B-splines against exact fractions and SciPy: the functions, and curves refined and cut.

The bound is |computed - exact| <= 25 u sum |B_i^(order) p_i|. Powers of x of degree 60 in plain doubles miss
it: two roundings of x are 120 of the power.
"""

from fractions import Fraction
from itertools import accumulate, repeat
from math import comb, lcm, perm
from operator import mul

import numpy as np
import pytest
from flint import fmpq, fmpz
from scipy.interpolate import BPoly, BSpline

from curvecore import BezierCurve, BSplineCurve
from tests.rows import each_row

NAMES = ["uniform", "random", "clustered", "geometric", "shifted", "small", "large", "chebyshev"]
LIMIT = 25.0
CLASSES = [BezierCurve, BSplineCurve]


def powers(x, degree):
    """x^0 to x^degree."""
    return list(accumulate(repeat(x, degree), mul, initial=fmpz(1)))


def bernstein_terms(curve, t, order, exact):
    """The derivatives of all functions, enclosed, by products of x and y = 1 - x that are differentiated."""
    first, last = (exact.rational(x) for x in curve.domain)
    degree = curve.degree
    lengths = [t - first, last - t, last - first]
    # As whole numbers of their common unit: the fractions would each be reduced.
    unit = lcm(*(int(each.q) for each in lengths))
    above, below, h = (each.p * (unit // int(each.q)) for each in lengths)
    x, y = powers(above, degree), powers(below, degree)
    found = []
    for i in range(degree + 1):
        total = fmpz(0)
        for j in range(order + 1):
            if j <= i and order - j <= degree - i:
                factor = comb(order, j) * (-1) ** (order - j) * perm(i, j) * perm(degree - i, order - j)
                total += factor * x[i - j] * y[degree - i - order + j]
        found.append(comb(degree, i) * total)
    # What is left of x and y has as many factors; those that were taken away leave 1 / h.
    scale = fmpq(unit**order, h ** max(degree, order))
    return exact.products(exact.enclosed(found), exact.enclosed([scale]) * len(found))


def spline_terms(curve, t, order, exact):
    """The exact derivatives of all functions."""
    return spline_functions([exact.rational(x) for x in curve.knots], curve.degree, t, order)


def spline_functions(knots, p, t, order=0):
    """The same of exact knots, by the recurrence over all of them, as it is written in books."""
    n = len(knots) - p - 1
    inside = [j for j in range(p, n) if knots[j] <= t]
    here = inside[-1] if inside else p

    def over(a, b):
        return fmpq(0) if b == 0 else a / b

    values = [fmpq(int(j == here)) for j in range(len(knots) - 1)]
    for level in range(1, p + 1):
        before, values = values, [fmpq(0)] * (len(values) - 1)
        # Most functions are 0 there, and sums of zeros are.
        for i in [i for i in range(len(values)) if before[i] or before[i + 1]]:
            left, right = knots[i + level] - knots[i], knots[i + level + 1] - knots[i + 1]
            if level > p - order:
                values[i] = level * (over(before[i], left) - over(before[i + 1], right))
            else:
                values[i] = over((t - knots[i]) * before[i], left)
                values[i] += over((knots[i + level + 1] - t) * before[i + 1], right)
    return values if order <= p else [fmpq(0)] * n


TERMS = {BezierCurve: bernstein_terms, BSplineCurve: spline_terms}


@each_row("order", [0, 1, 2, 3])
@each_row("name", NAMES)
@each_row("n", [2, 3, 5, 8, 20, 60])
@pytest.mark.parametrize("make", CLASSES)
def test_bound(exact, rng, make, n, name, order):
    parameters = exact.parameter_sets(n, rng)[name]
    curve = make(rng.standard_normal((n, 2)), parameters)
    t = exact.probes(parameters, rng, 2)
    values, basis = curve.evaluate(t, order), curve.basis(t, order)[:, :, 0]
    points = [exact.enclosed(map(exact.rational, column)) for column in curve.points.T]
    found = [0.0]
    for k, x in enumerate(t):
        terms = TERMS[make](curve, exact.rational(x), order, exact)
        for d, coordinates in enumerate(points):
            found.append(exact.worst_constant(values[k, d], exact.products(terms, coordinates)))
        # Each single function is that accurate, also where it is about to vanish; near the end of the range
        # of numbers, as at t = 2e-308 of parameters up to 1e-150, the smallest of them are not.
        sizes = [abs(a) for a in exact.enclosed(terms)]
        least = max(sizes) / 10**150
        seen = [(b, a) for b, a, size in zip(basis[k], terms, sizes, strict=True) if size > least]
        found += [exact.worst_constant(b, [a]) for b, a in seen]
    assert max(c for c in found if c is not None) <= LIMIT


@pytest.mark.parametrize("n", [2, 20, 49, 50])
def test_bernstein_functions_at_and_beyond_the_ends(n):
    """Where powers leave the range of numbers, and where none does; n = 49 is the last of plain products."""
    curve = BezierCurve(np.zeros((n, 1)), np.linspace(0.0, 1.0, n))
    near = 2.0 ** (-900 / (n - 1))
    for t in (0.0, 5e-324, 1e-200, near / 2, 2 * near, 0.3, 1 - 2.0**-53, 1.0, 1e3, -1e9):
        x = Fraction(t)
        for i, computed in enumerate(curve.basis(t)[:, 0].tolist()):
            exact = comb(n - 1, i) * x**i * (1 - x) ** (n - 1 - i)
            if exact == 0 or Fraction(1, 10**300) < abs(exact) < 10**300:
                assert abs(Fraction(computed) - exact) <= LIMIT * 2.0**-53 * abs(exact)


@pytest.mark.parametrize("n", [300, 2000])
def test_bernstein_functions_of_high_degree(exact, rng, n):
    curve = BezierCurve(rng.standard_normal((n, 1)), np.linspace(0.0, 3.0, n))
    for t in (1e-3, 0.7, 1.9, 2.9999):
        x = Fraction(t) / 3
        for i in (0, 1, n // 3, n // 2, n - 1):
            value = comb(n - 1, i) * x**i * (1 - x) ** (n - 1 - i)
            if value > Fraction(1, 10**290):
                computed = Fraction(float(curve.basis(t)[i, 0]))
                assert abs(computed / value - 1) < LIMIT * 2.0**-53
    assert np.abs(curve.basis(rng.random(20) * 3.0).sum(axis=1) - 1.0).max() < 1e-14


@pytest.mark.parametrize(("n", "places"), [(200, (1e-9, 1e-3, 0.7, 1.9, 2.9999)), (1200, (1.3,))])
def test_values_of_high_degree(exact, rng, n, places):
    """Only the functions that count are summed there: a few hundred of any number."""
    curve = BezierCurve(rng.standard_normal((n, 1)), np.linspace(0.0, 3.0, n))
    points = [exact.rational(p) for p in curve.points[:, 0]]
    # As whole numbers of a unit: products of fractions would each be reduced.
    unit = lcm(*(int(p.q) for p in points))
    points = [(p * unit).p for p in points]
    for t in places:
        x = exact.rational(t) / 3
        above, rest = powers(x.p, n - 1), powers(x.q - x.p, n - 1)
        whole = x.q ** (n - 1) * unit
        terms = [comb(n - 1, i) * above[i] * rest[n - 1 - i] * points[i] for i in range(n)]
        off = abs(exact.rational(curve.evaluate(t)[0]) * whole - sum(terms))
        # A running product of a hundred factors before those that count most.
        assert off * 2**53 <= 50 * sum(map(abs, terms))


@pytest.mark.parametrize("order", [4, 5, 7])
def test_high_derivatives(exact, order):
    points = np.random.default_rng(5).standard_normal((8, 2))
    curve = BezierCurve(points, np.arange(8.0))
    poly = BPoly(points[:, None], [0.0, 7.0])
    t = np.linspace(-1.0, 8.0, 31)
    wanted = poly(t, nu=order)
    assert np.abs(curve.evaluate(t, order) - wanted).max() < 1e-12 * np.abs(wanted).max()
    assert (curve.evaluate(t, 8) == 0.0).all()


@each_row("order", [0, 1, 2, 3])
@each_row("n", [2, 3, 4, 5, 6, 30])
def test_scipys_splines(rng, n, order):
    parameters = np.sort(rng.random(n))
    curve = BSplineCurve(rng.standard_normal((n, 3)), parameters)
    t = np.linspace(parameters[0] - 0.1, parameters[-1] + 0.1, 99)
    wanted = BSpline(curve.knots, curve.points, curve.degree)(t, nu=order) * (order <= curve.degree)
    scale = np.einsum("mn,nd->md", np.abs(curve.basis(t, order)[:, :, 0]), np.abs(curve.points))
    assert (np.abs(curve.evaluate(t, order) - wanted) <= 1e-12 * scale).all()


def test_ten_thousand_points_of_a_spline(rng):
    parameters = np.cumsum(rng.random(10_000) + 0.1)
    curve = BSplineCurve(rng.standard_normal((10_000, 2)), parameters)
    t = np.linspace(*curve.domain, 20_001)
    wanted = BSpline(curve.knots, curve.points, 3)(t)
    assert np.abs(curve.evaluate(t) - wanted).max() < 1e-13 * np.abs(curve.points).max()
    assert curve.bezier_pieces().shape == (9997, 4, 2)


@each_row("n", [2, 3, 4, 5, 9])
@each_row("make", CLASSES)
def test_ends_and_positive_functions(rng, make, n):
    parameters = np.sort(rng.random(n))
    curve = make(rng.standard_normal((n, 2)), parameters)
    assert (curve.evaluate(parameters[[0, -1]]) == curve.points[[0, -1]]).all()
    t = np.linspace(*curve.domain, 57)
    basis = curve.basis(t)[:, :, 0]
    assert curve.is_positive
    assert basis.min() >= 0.0
    assert np.abs(basis.sum(axis=1) - 1.0).max() < 1e-15
    for i in range(n):
        low, high = curve.support(i)
        assert (basis[(t < low) | (t > high), i] == 0.0).all()
        assert (basis[(t > low) & (t < high), i] > 0.0).all()


@each_row("n", [2, 3, 4, 5, 9])
@each_row("make", CLASSES)
def test_nodes_reproduce_t(rng, make, n):
    """With the Greville abscissae as points the curve is t itself (linear precision)."""
    parameters = np.sort(rng.random(n))
    places = make(rng.standard_normal((n, 2)), parameters).nodes
    t = np.linspace(parameters[0], parameters[-1], 31)
    assert np.abs(make(places[:, None], parameters).evaluate(t)[:, 0] - t).max() < 1e-15


@each_row("share", [0.02, 0.31, 0.5, 0.93])
@each_row("n", [2, 3, 4, 5, 6, 9, 40])
@each_row("make", CLASSES)
def test_one_more_control_point_keeps_the_shape(rng, make, n, share):
    parameters = np.sort(rng.random(n))
    curve = make(rng.standard_normal((n, 2)), parameters)
    start, end = curve.domain
    place = start + share * (end - start)
    longer = curve.refined(place)
    t = np.linspace(start, end, 101)
    assert len(longer.points) == n + 1
    assert place in longer.parameters
    # Each coordinate is a convex combination: a few roundings of the largest.
    assert np.abs(longer.evaluate(t) - curve.evaluate(t)).max() < 4e-15


@each_row("stretch", [(0.0, 0.4), (0.1, 0.12), (0.3, 1.0), (0.0, 1.0)])
@each_row("n", [2, 3, 4, 5, 6, 9, 40])
@each_row("make", CLASSES)
def test_stretches(rng, make, n, stretch):
    parameters = np.sort(rng.random(n))
    curve = make(rng.standard_normal((n, 2)), parameters)
    start, end = (float(parameters[0] + x * (parameters[-1] - parameters[0])) for x in stretch)
    part = curve.restricted(start, end)
    t = np.linspace(start, end, 101)
    assert part.domain == (start, end)
    assert np.abs(part.evaluate(t) - curve.evaluate(t)).max() < 4e-15


@each_row("n", [2, 3, 4, 5, 9])
def test_knots_of_a_spline(n):
    """What stands next to the ends does nothing; of each parameter inside there is one knot."""
    curve = BSplineCurve(np.zeros((n, 2)), np.arange(n) ** 2.0)
    assert curve.breaks.tolist() == [0.0, *[k**2.0 for k in range(2, n - 2)], (n - 1) ** 2.0]
    moved = curve.parameters.copy()
    if n > 3:
        moved[1], moved[-2] = moved[1] * 0.5, moved[-2] + 0.1
        assert (BSplineCurve(np.zeros((n, 2)), moved).knots == curve.knots).all()


@pytest.mark.parametrize("make", CLASSES)
def test_changes_of_the_parameters(rng, make):
    """Against central differences of whole curves."""
    parameters = np.sort(rng.random(7))
    curve = make(rng.standard_normal((7, 2)), parameters)
    t = np.linspace(parameters[0] + 1e-3, parameters[-1] - 1e-3, 23)
    moves = curve.parameter_derivatives(t)
    for i in range(7):
        step = 1e-6 * np.eye(7)[i]
        ahead, behind = (make(curve.points, parameters + sign * step) for sign in (1.0, -1.0))
        wanted = (ahead.evaluate(t) - behind.evaluate(t)) / 2e-6
        assert np.abs(moves[:, i] - wanted).max() < 1e-5 * (1.0 + np.abs(wanted).max())


@each_row("name", ["random", "clustered", "geometric", "shifted", "large"])
@each_row("n", [2, 3, 4, 5, 9])
def test_changes_of_the_knots_are_those_of_exact_splines(exact, rng, n, name):
    """By differences of exact curves, which leave out 2**-400 of what is there; at knots and outside, too."""
    curve = BSplineCurve(rng.standard_normal((n, 1)), exact.parameter_sets(n, rng)[name])
    t = curve.parameters
    at = np.concatenate(
        [*(t[:-1] + share * np.diff(t) for share in (0.0, 0.3)), t[[0, -1]] + np.ptp(t) / 8.0]
    )
    knots, places = ([exact.rational(x) for x in each] for each in (curve.knots, at))
    points = [exact.rational(x) for x in curve.points[:, 0]]
    step = exact.rational(np.diff(t).min()) / 2**200
    found = curve.parameter_derivatives(at)[:, :, 0]
    for i in range(n):
        moved = [exact.rational(t[i])] if i in {0, n - 1} or not curve.idle_parameters[i] else []
        for k, x in enumerate(places):
            # The piece that holds t_i is the one to its right: that knot moves to the left.
            sides = [
                spline_functions([knot - side * step * (knot in moved) for knot in knots], curve.degree, x)
                for side in range(3)
            ]
            changes = [
                (3 * here - 4 * less + least) / (2 * step) for here, less, least in zip(*sides, strict=True)
            ]
            terms = [change * point for change, point in zip(changes, points, strict=True)]
            size = sum((abs(each) for each in terms), fmpq(0))
            assert (
                abs(exact.rational(found[k, i]) - sum(terms, fmpq(0))) <= 25 * exact.rational(2.0**-53) * size
            )


@pytest.mark.parametrize("make", CLASSES)
def test_joints(rng, make):
    """A spline has continuous curvature at its knots; one polynomial at all of its parameters."""
    curve = make(rng.standard_normal((9, 2)), np.sort(rng.random(9)))
    ahead, behind = (curve.joint_derivatives(before=before) for before in (False, True))
    error = np.abs(ahead.values[1:] - behind.values[:-1]).max(axis=2)
    smooth = 3 if make is BSplineCurve else 4
    assert (error <= 32 * 2.0**-53 * ahead.scale[1:])[:, :smooth].all()
    if make is BSplineCurve:
        # The third derivative of its cubic pieces jumps at the knots, and at no other parameter.
        knots = np.isin(curve.parameters[1:-1], curve.breaks)
        assert ((error[:, 3] > 1e-6 * ahead.scale[1:, 3]) == knots).all()
    assert (ahead.values[0, 0] == curve.points[0]).all()
