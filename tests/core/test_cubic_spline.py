"""The C² cubic spline against exact rational arithmetic and against SciPy's.

A term is what a point does to c: a product of a power of t and an entry of the inverse of a system whose rows
are dominated by their diagonal, so that its error is a few roundings for every joint between; 25 u times the
sum of the sizes of the terms is not reached for 20 points.
"""

import copy
import itertools
import math
import pickle
import tracemalloc

import numpy as np
import pytest
from flint import fmpq, fmpq_mat
from scipy.interpolate import CubicSpline

from curvecore import (
    CubicSplineCurve,
    CurveError,
    HermiteCurve,
    LagrangeCurve,
    SplineEnds,
    joint_report,
    uniform,
)
from tests.rows import each_row

NAMES = ["uniform", "random", "clustered", "geometric", "shifted", "small", "large", "chebyshev"]
LIMIT = 25.0
U = 2.0**-53
ENDS = list(SplineEnds)


def exact_system(nodes, ends):
    """The second derivatives at the joints as combinations of the points, (n, n), in fractions."""
    n = len(nodes)
    h = [b - a for a, b in itertools.pairwise(nodes)]
    system, right = fmpq_mat(n, n), fmpq_mat(n, n)

    def slope(row, segment, factor):
        right[row, segment] -= factor / h[segment]
        right[row, segment + 1] += factor / h[segment]

    def balance(row, before, joint, after, left):
        """The joint's c' is the same on both sides."""
        system[row, before] += h[left]
        system[row, joint] += 2 * (h[left] + h[joint])
        system[row, after] += h[joint]
        slope(row, joint, fmpq(6))
        slope(row, left, fmpq(-6))

    for i in range(1, n - 1):
        balance(i, i - 1, i, i + 1, i - 1)
    if ends is SplineEnds.NATURAL:
        system[0, 0] = system[n - 1, n - 1] = fmpq(1)
    elif ends is SplineEnds.CLAMPED:
        system[0, 0], system[0, 1] = 2 * h[0], h[0]
        slope(0, 0, fmpq(6))
        system[n - 1, n - 1], system[n - 1, n - 2] = 2 * h[-1], h[-1]
        slope(n - 1, n - 2, fmpq(-6))
    elif ends is SplineEnds.NOT_A_KNOT:
        for row, (a, b, c), (u, v) in ((0, (0, 1, 2), h[:2]), (n - 1, (n - 1, n - 2, n - 3), h[:-3:-1])):
            system[row, a], system[row, b], system[row, c] = v, -u - v, u
    else:
        balance(0, n - 2, 0, 1, n - 2)
        system[n - 1, 0], system[n - 1, n - 1] = fmpq(1), fmpq(-1)
    return system.solve(right)


def exact_terms(t, nodes, seconds, orders):
    """The exact B_j^(order)(t) of all points, for each order."""
    n = len(nodes)
    i = max((k for k in range(n - 1) if nodes[k] <= t), default=0)
    h, x = nodes[i + 1] - nodes[i], t - nodes[i]
    # Power coefficients in x = t - t_i of c = p + x (slope - h (2 p'' + q'') / 6) + x^2 p'' / 2 + ...
    powers = []
    for j in range(n):
        p, q = fmpq(j == i), fmpq(j == i + 1)
        a, b = seconds[i, j], seconds[i + 1, j]
        powers.append([p, (q - p) / h - h * (2 * a + b) / 6, a / 2, (b - a) / (6 * h)])
    found = []
    for order in orders:
        # k (k - 1) ... x^(k - order) for the powers that are left.
        left = [math.perm(k, order) * x ** (k - order) for k in range(order, 4)]
        found.append(
            [sum((c * each for c, each in zip(own[order:], left, strict=True)), fmpq(0)) for own in powers]
        )
    return found


@pytest.mark.parametrize("ends", ENDS)
@pytest.mark.parametrize("name", NAMES)
def test_bound(exact, rng, name, ends):
    parameters = exact.parameter_sets(20, rng)[name]
    points = rng.standard_normal((20, 2))
    if ends is SplineEnds.PERIODIC:
        points[-1] = points[0]
    curve = CubicSplineCurve(points, parameters, ends=ends)
    nodes = [exact.rational(x) for x in parameters]
    seconds = exact_system(nodes, ends)
    data = [exact.enclosed(map(exact.rational, column)) for column in points.T]
    every = exact.probes(parameters, rng, 2)
    inside = every[(every >= parameters[0]) & (every <= parameters[-1])]
    terms_at = {t: exact_terms(exact.rational(t), nodes, seconds, range(4)) for t in every}
    for order in range(4):
        # What lies inside and nothing else is computed by another way.
        values = np.concatenate([curve.evaluate(each, order) for each in (every, inside)])
        basis = curve.basis(np.concatenate((every, inside)), order)[:, :, 0]
        assert np.isfinite(values).all()
        for k, t in enumerate(np.concatenate((every, inside))):
            functions = terms_at[t][order]
            errors = [b - exact.rational(found) for b, found in zip(functions, basis[k], strict=True)]
            for d in range(2):
                terms = exact.products(functions, data[d])
                off = sum(map(abs, exact.products(errors, data[d])))
                constant = exact.worst_constant(values[k, d], terms)
                if constant is None:
                    continue
                assert constant <= LIMIT
                # Certainly: both lie in intervals.
                assert off <= LIMIT * U * sum(map(abs, terms))


@each_row("ends", ENDS)
@each_row("spacing", [[0.6, 6e-9, 0.4], [4e-9, 5e-9, 1.0], [0.5, 2e-9, 0.5, 3e-7], [2e-5, 0.6, 1e-9, 0.02]])
def test_bound_beside_short_segments(exact, rng, ends, spacing):
    """c and c' missed it by c = 1e15 not a knot, 2e3 else: accelerations of long segments cancelled."""
    parameters = np.cumsum([0.0, *spacing])
    points = rng.standard_normal((len(parameters), 1))
    if ends is SplineEnds.PERIODIC:
        points[-1] = points[0]
    curve = CubicSplineCurve(points, parameters, ends=ends)
    nodes = [exact.rational(x) for x in parameters]
    seconds = exact_system(nodes, ends)
    data = exact.enclosed(map(exact.rational, curve.points[:, 0]))
    for t in np.concatenate((parameters, 0.5 * (parameters[1:] + parameters[:-1]))):
        for order, functions in enumerate(exact_terms(exact.rational(t), nodes, seconds, range(2))):
            constant = exact.worst_constant(curve.evaluate(t, order)[0], exact.products(functions, data))
            assert constant is None or constant <= LIMIT


@each_row("ends", ENDS)
@each_row("n", [2, 3, 4, 5, 9, 60, 300])
def test_scipy_agrees(rng, n, ends):
    t = np.sort(rng.random(n))
    points = rng.standard_normal((n, 2))
    if ends is SplineEnds.PERIODIC:
        points[-1] = points[0]
    curve, reference = (
        CubicSplineCurve(points, t, ends=ends),
        CubicSpline(t, points, bc_type=ends.replace("_", "-")),
    )
    # To SciPy the last parameter of a periodic spline is the first one, where the third derivative differs.
    at = np.linspace(t[0], t[-1], 400)[:-1]
    for order in range(4):
        expected = reference(at, order)
        size = np.abs(points).max() / np.diff(t).min() ** order
        assert np.abs(curve.evaluate(at, order) - expected).max() <= 1e-13 * max(np.abs(expected).max(), size)
        summed = curve.basis(at, order)[:, :, 0] @ points
        assert np.abs(summed - curve.evaluate(at, order)).max() <= 1e-13 * max(np.abs(expected).max(), size)


@each_row("ends", ENDS)
@each_row("order", [2, 3, 4])
def test_many_parameters_at_once_change_nothing(rng, order, ends):
    """A few at a time are summed from the data; c''' is then rounded once more for each end."""
    t = np.cumsum(rng.random(301) ** 3 + 1e-3)
    curve = CubicSplineCurve(rng.standard_normal((301, 2)), t, ends=ends)
    at = rng.permutation(np.concatenate([rng.uniform(t[0], t[-1], 5000), t, np.nextafter(t[1:], t[0])]))
    together = curve.evaluate(at, order)
    parts = np.concatenate([curve.evaluate(each, order) for each in np.array_split(at, 50)])
    bends = np.abs(curve.evaluate(t, 2))
    segment = np.searchsorted(t[1:-1], at, side="right")
    sizes = (bends[segment] + bends[segment + 1]) / np.diff(t)[segment, None]
    assert (np.abs(together - parts) <= (order == 3) * 4.0 * U * sizes).all()
    some = [*at[:3].tolist(), t[-1]]
    assert (curve.evaluate(some * 2000, order) == curve.evaluate(np.array(some * 2000), order)).all()
    beyond = np.append(at, t[-1] + 1.0)
    assert (curve.evaluate(beyond, order)[:-1] == parts).all()


@each_row("ends", ENDS)
def test_a_spline_is_the_hermite_curve_with_its_velocities(rng, ends):
    t = np.sort(rng.random(12))
    curve = CubicSplineCurve(rng.standard_normal((12, 3)), t, ends=ends)
    velocities = [*(each.jets[0, 1] for each in curve.interpolants()), curve.interpolants()[-1].jets[1, 1]]
    hermite = HermiteCurve(curve.points, velocities, t)
    # At a joint h times v is divided by h again.
    assert curve.evaluate(t, 1) == pytest.approx(np.array(velocities), rel=1e-15)
    at = np.linspace(t[0], t[-1], 200)
    assert (curve.evaluate(at) == hermite.evaluate(at)).all()
    assert (curve.bezier_pieces() == hermite.bezier_pieces()).all()
    for own, other in zip(curve.interpolants(), hermite.interpolants(), strict=True):
        assert (own.parameters == other.parameters).all()
        assert (own.jets == other.jets).all()


@each_row("ends", ENDS)
def test_joints_of_a_spline_are_smooth_to_the_second_derivative(rng, ends):
    t = np.sort(rng.random(12))
    points = rng.standard_normal((12, 2))
    points[-1] = points[0]
    curve = CubicSplineCurve(points, t, ends=ends)
    # At a joint that is not a knot two pieces are one polynomial.
    one = {1, 10} if ends is SplineEnds.NOT_A_KNOT else set()
    for joint in joint_report(curve):
        assert joint.label == ("C3" if joint.joint in one else "C2")
    *_, seam = joint_report(curve, closed=True)
    assert (seam.label == "C2") == (ends is SplineEnds.PERIODIC)
    for order, same in ((1, SplineEnds.CLAMPED), (2, SplineEnds.NATURAL)):
        edges = curve.evaluate(curve.domain, order)
        # The value at the last parameter is r q'' + s p'' of its segment with r = 0.
        assert (edges == 0.0).all() == (ends is same)


def test_the_natural_spline_bends_least(rng):
    """Of all curves through the points the natural spline has the least integral of c''^2."""
    t = np.sort(rng.random(8))
    points = rng.standard_normal((8, 1))
    integrals = []
    for ends in (SplineEnds.NATURAL, SplineEnds.CLAMPED, SplineEnds.NOT_A_KNOT):
        second = CubicSplineCurve(points, t, ends=ends).evaluate(t, 2)[:, 0]
        # c'' is linear on each segment.
        a, b = second[:-1], second[1:]
        integrals.append((np.diff(t) * (a * a + a * b + b * b)).sum() / 3.0)
    assert min(integrals) == integrals[0]


def test_ten_thousand_points_take_no_square_array(rng):
    n = 10_000
    t = np.sort(rng.random(n))
    points = rng.standard_normal((n, 2))
    tracemalloc.start()
    curve = CubicSplineCurve(points, t).with_jets(points[:, None] * 2.0)
    at = np.linspace(t[0], t[-1], 5000)
    for order in range(4):
        curve.evaluate(at, order)
    curve.bezier_pieces()
    curve.interpolants()
    joint_report(curve.with_data(curve.jets[:300], t[:300]))
    curve.joint_derivatives(before=True)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < n * 8 * 500
    expected = CubicSpline(t, 2.0 * points, bc_type="natural")(at)
    assert np.abs(curve.evaluate(at) - expected).max() <= 1e-12 * np.abs(expected).max()


def test_far_data_count_however_uneven_the_parameters(exact):
    """After six rounds of the reduction 3e-10 of a point 64 joints away were missing here."""
    t = 2.0 ** np.arange(80.0)
    points = np.zeros((80, 1))
    points[1] = 1.0
    seconds = exact_system([exact.rational(x) for x in t], SplineEnds.NATURAL)
    curve = CubicSplineCurve(points, t)
    for joint in (5, 40, 78):
        assert curve.evaluate(t[joint], 2)[0] == pytest.approx(float(seconds[joint, 1]), rel=1e-13)


def test_two_points_are_a_straight_line_unless_clamped():
    for ends in (SplineEnds.NATURAL, SplineEnds.NOT_A_KNOT):
        curve = CubicSplineCurve([[0.0, 1.0], [2.0, 0.0]], [1.0, 3.0], ends=ends)
        assert curve.evaluate(1.5).tolist() == [0.5, 0.75]
        assert curve.evaluate([0.0, 4.0]).tolist() == [[-1.0, 1.5], [3.0, -0.5]]
    clamped = CubicSplineCurve([[0.0], [2.0]], [1.0, 3.0], ends="clamped")
    assert clamped.evaluate(1.5)[0] == 2.0 * (3.0 * 0.25**2 - 2.0 * 0.25**3)


def test_periodic_data_that_do_not_close_are_carried_along(rng):
    """c(t + period) - c(t) is the same everywhere."""
    t = np.sort(rng.random(6))
    points = rng.standard_normal((6, 2))
    curve = CubicSplineCurve(points, t, ends=SplineEnds.PERIODIC)
    for order in (1, 2):
        start, end = curve.evaluate(curve.domain, order)
        assert end == pytest.approx(start, rel=1e-13)


@each_row("ends", ENDS)
@each_row("name", ["random", "geometric", "shifted", "large"])
@each_row("n", [2, 3, 5])
def test_parameter_derivatives_are_those_of_exact_splines(exact, rng, n, name, ends):
    """By differences of exact curves, which leave out 2**-400 of what is there.

    1.2e-13 is the largest error that was seen, where two distances differ by a factor of a thousand.
    """
    t = exact.parameter_sets(n, rng)[name]
    t[0] -= 0.125 * (t[-1] - t[0])
    points = rng.standard_normal((n, 1))
    curve = CubicSplineCurve(points, t, ends=ends)
    at = np.concatenate(
        [t[:-1] + share * np.diff(t) for share in (0.0, 0.3, 0.8)] + [[t[0] - 0.1 * np.ptp(t)]]
    )
    step = exact.rational(np.diff(t).min()) / 2**200

    def values(nodes):
        seconds = exact_system(nodes, ends)
        rows = [exact_terms(exact.rational(x), nodes, seconds, [0])[0] for x in at]
        data = [exact.rational(p) for p in points[:, 0]]
        return [sum((b * p for b, p in zip(row, data, strict=True)), fmpq(0)) for row in rows]

    if ends is SplineEnds.NOT_A_KNOT and n < 4:
        expected = LagrangeCurve(points, t).parameter_derivatives(at)[:, :, 0]
    else:
        exact_t = [exact.rational(x) for x in t]
        here, columns = values(exact_t), []
        for i in range(n):
            # The piece that holds t_i is the one to its right: that parameter moves to the left.
            less, least = (values([x - k * step * (j == i) for j, x in enumerate(exact_t)]) for k in (1, 2))
            columns.append(
                [float((3 * c - 4 * b + a) / (2 * step)) for a, b, c in zip(least, less, here, strict=True)]
            )
        expected = np.stack(columns, axis=1)
    found = curve.parameter_derivatives(at)[:, :, 0]
    assert np.abs(found - expected).max() <= 1e-12 * np.abs(expected).max()
    # A parameter that moves alone leaves the curve at the others where it is.
    joints = curve.parameter_derivatives(t)[:, :, 0]
    assert (joints[~np.eye(n, dtype=bool)] == 0.0).all()
    assert np.diag(joints) == pytest.approx(-curve.evaluate(t, 1)[:, 0], rel=1e-14)


def test_copies_and_pickles_keep_the_ends(rng):
    curve = CubicSplineCurve(rng.standard_normal((5, 2)), uniform(5), ends="not_a_knot")
    assert copy.deepcopy(curve) is curve
    again = pickle.loads(pickle.dumps(curve))
    at = np.linspace(-0.2, 1.2, 30)
    for order in range(4):
        assert (again.evaluate(at, order) == curve.evaluate(at, order)).all()
    assert again.ends is SplineEnds.NOT_A_KNOT
    assert curve.with_jets(curve.jets).ends is curve.with_data(curve.jets, uniform(5)).ends is again.ends


def test_wrong_arguments_of_a_spline_are_refused():
    points = [[0.0], [1.0], [0.0]]
    with pytest.raises(CurveError, match=r"ends must be one of natural, .*, periodic, not 'free'"):
        CubicSplineCurve(points, [0.0, 0.5, 1.0], ends="free")
    with pytest.raises(CurveError, match="points around 0 lie too far apart") as refusal:
        CubicSplineCurve(points, [0.0, 5e-324, 1.0])
    assert refusal.value.indices == (0,)
